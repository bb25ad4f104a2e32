//! The view: rays → nearest hits → shade → glyphs. No terminal in it.
//!
//! A [`Frame`] holds what is known of each pixel; an [`Image`] holds the cells that show it in a
//! [`Style`]. Both are kept and filled again from frame to frame.

#![expect(
    clippy::inline_always,
    reason = "a formula in lanes vectorises only if all of it is in one place"
)]

mod acne;
mod allowance;
mod bounds;
mod color;
mod delta;
mod field;
mod finish;
mod frame;
mod image;
mod ink;
mod lanes;
mod layer;
mod look;
mod memory;
mod plan;
mod projected;
mod projector;
mod ramp;
mod search;
mod shade;
mod style;
mod view;
mod windows;

pub use acne::{Acne, height};
pub use allowance::Allowance;
pub use color::{AnsiColor, ColorDepth, color_of, xterm};
pub use frame::{Frame, Hit, Lost};
pub use image::{Cell, Image};
pub use ink::RAMP;
pub use layer::Contact;
pub use look::Look;
pub use plan::{Counts, Plan, Strategy};
pub use shade::AMBIENT;
pub use style::{CELL_ASPECT, Style, fit};
pub use view::View;
