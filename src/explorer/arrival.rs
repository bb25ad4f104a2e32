//! Arriving at a place: a cursor that waits for the picture in which it counts, and a step that
//! waits for the derivation.

use glam::Vec3;

use crate::explorer::Explorer;
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

impl Explorer {
    /// Puts the cursor where it was wanted.
    pub(crate) fn arrive(&mut self) {
        let Some(target) = self.arrival.target.take() else {
            return;
        };
        let size = self.size();
        let pixel = match target {
            Target::Center => Some((size.width / 2, size.height / 2)),
            Target::Pixel(x, y) => Some((x, y)),
            Target::PixelOf(pixel, old) => Some(scaled(pixel, old, size)),
            Target::Point(p) => self.pixel_of(p),
        };
        match pixel.filter(|&(x, y)| x < size.width && y < size.height) {
            Some((x, y)) => self.cursor = (x, y),
            None => self.warn(match target {
                Target::Pixel(x, y) => {
                    format!("cursor: found {x} {y}, expected a pixel of {size}, counted from 0")
                }
                _ => "The place of the cursor is out of the picture.".into(),
            }),
        }
    }

    /// The pixel that shows the point `p`, if the picture shows it.
    pub(crate) fn pixel_of(&self, p: Vec3) -> Option<(u32, u32)> {
        let [x, y] = self.picture.rays.project(p.as_dvec3())?.map(f64::round);
        (x >= 0.0 && y >= 0.0).then_some((x as u32, y as u32))
    }

    /// Goes to the step that was wanted; the panel stays as it is.
    pub(crate) fn arrive_at_step(&mut self) {
        let Some(name) = self.arrival.step.take() else {
            return;
        };
        match self.step_named(&name) {
            Ok(at) => self.step_at = at,
            Err(sentence) => self.warn(sentence),
        }
    }
}
