//! The mathematics as pictures made of text: the slice through ray and centre, the curve f(t), the
//! bits of a number, the methods by error and run time.
//!
//! Shapes come from the exact quadratic ([`Section`](section::Section)), never from the method
//! that is shown; where a method answers otherwise, the figure says so. What is drawn on, and how
//! dots become characters, is in [`canvas`].

mod axis;
mod bits;
mod canvas;
mod caption;
#[cfg(test)]
mod cases;
mod curve;
mod landmark;
mod mark;
mod plane;
mod section;
mod slice;
#[cfg(test)]
mod tests;
mod turning;
mod view;
mod work;

pub use bits::{Float, bits};
pub use canvas::FigureInk;
pub use curve::curve;
pub use landmark::{Landmark, landmarks};
pub use plane::{PlaneLine, plane, plane_lines};
pub use slice::slice;
pub use turning::turning;
pub use work::work;
