//! How an image is to look.

use super::color::ColorDepth;
use super::style::Style;

/// How an image is to look.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Look {
    /// How many pixels a cell shows, and with what.
    pub style: Style,
    /// How many colours there are.
    pub depth: ColorDepth,
    /// Whether to keep to the characters of ASCII, in every style.
    pub ascii_only: bool,
    /// Whether two shades do: less changes from picture to picture, for links that can't keep up.
    pub coarse: bool,
}
