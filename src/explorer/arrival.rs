//! Arriving at a place: a cursor that waits for the picture in which it counts, and a step that
//! waits for the derivation.

use glam::Vec3;

use crate::scene::Size;

/// A pixel, by what names it before there is a picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Target {
    /// The one in the middle.
    Center,
    /// The one in this column and row.
    Pixel(u32, u32),
    /// The place that this pixel has in a picture of this size.
    PixelOf((u32, u32), Size),
    /// The one whose ray passes nearest to this point.
    Point(Vec3),
}

/// What is still to be done once the picture is known.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Arrival {
    pub(crate) target: Option<Target>,
    /// A step's name or number.
    pub(crate) step: Option<String>,
}

/// The pixel of a picture of size `new` at the place of `pixel` in a picture of size `old`.
pub(crate) fn scaled((x, y): (u32, u32), old: Size, new: Size) -> (u32, u32) {
    let along = |at: u32, old: u32, new: u32| {
        let middle = (f64::from(at) + 0.5) * f64::from(new) / f64::from(old.max(1));
        (middle as u32).min(new.max(1) - 1)
    };
    (
        along(x, old.width, new.width),
        along(y, old.height, new.height),
    )
}
