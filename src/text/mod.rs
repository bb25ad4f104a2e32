//! Text as people, programs and files write it: characters, numbers, lines, names.

mod glyphs;
mod hexadecimal;
mod lines;
mod names;
mod nearest;
mod printable;
pub mod read;

pub use glyphs::Glyphs;
pub use hexadecimal::{binary32 as hexadecimal, binary64 as hexadecimal_binary64};
pub use lines::{paragraph, wrap};
pub use names::{by_name, former_names};
pub use nearest::nearest;
pub use printable::{printable, printable_line};
