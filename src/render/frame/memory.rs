//! What a frame remembers of its spheres, to find out which of them the next one changes.

use crate::geometry::Sphere;
use crate::render::cover::Bounds;
use crate::scene::{Body, Rgb};

/// With more changes than this a picture is made anew.
pub(super) const MOST: usize = 32;

/// The spheres of the last frame with their colours, and where each of them can be seen.
#[derive(Debug, Clone, Default)]
pub(super) struct Memory {
    is_complete: bool,
    spheres: Vec<(Sphere, Option<Rgb>)>,
    bounds: Vec<Bounds>,
    changes: Vec<u32>,
}

impl Memory {
    /// Forgets all spheres.
    pub(super) fn forget(&mut self) {
        self.is_complete = false;
        self.spheres.clear();
        self.bounds.clear();
    }

    /// Remembers the next sphere of the list and where it can be seen.
    #[inline]
    pub(super) fn learn(&mut self, body: &Body, bounds: Bounds) {
        self.spheres.push((body.sphere, body.color));
        self.bounds.push(bounds);
    }

    /// Notes whether all of these were learnt.
    pub(super) fn complete(&mut self, bodies: &[Body]) {
        self.is_complete = self.bounds.len() == bodies.len();
    }

    /// Finds the spheres that are not what they were; whether they are few and the rest is known.
    pub(super) fn find_changes(&mut self, bodies: &[Body]) -> bool {
        self.changes.clear();
        if !self.is_complete || self.spheres.len() != bodies.len() {
            return false;
        }
        for (number, (before, body)) in (0..).zip(self.spheres.iter().zip(bodies)) {
            if *before != (body.sphere, body.color) {
                if self.changes.len() == MOST {
                    return false;
                }
                self.changes.push(number);
            }
        }
        true
    }

    /// The spheres that [`Memory::find_changes`] found.
    pub(super) fn changes(&self) -> &[u32] {
        &self.changes
    }

    /// Remembers what a sphere is now and where it can be seen; where it could be seen before.
    pub(super) fn replace(&mut self, number: u32, body: &Body, bounds: Bounds) -> Bounds {
        let i = number as usize;
        self.spheres[i] = (body.sphere, body.color);
        std::mem::replace(&mut self.bounds[i], bounds)
    }

    /// Where each sphere can be seen.
    pub(super) fn bounds(&self) -> &[Bounds] {
        &self.bounds
    }
}
