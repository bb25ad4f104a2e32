//! What a frame remembers of its spheres, to find out which of them the next one changes.

use super::bounds::Bounds;
use crate::geometry::Sphere;
use crate::scene::{Body, Rgb};

/// With more changes than this a picture is made from scratch.
pub(super) const MOST: usize = 32;

/// Of a scene in which everything moves so many spheres are remembered, to see when it rests.
const SAMPLE: usize = 2 * MOST;

/// Up to this many spheres all are remembered in any case.
const FEW: usize = 4096;

/// The spheres of the last frame with their colours, and where each of them can be seen.
///
/// While everything moves the frames are whole ones, and what is remembered serves none of them. For
/// many spheres that is memory to be written in vain: only a sample is then, until it rests.
#[derive(Debug, Clone, Default)]
pub(super) struct Memory {
    is_complete: bool,
    /// Whether nearly everything moved before this frame, as far as the sample tells.
    is_restless: bool,
    spheres: Vec<Look>,
    bounds: Boxes,
    changes: Vec<u32>,
}

/// The bits of all that a sphere looks like: its centre, its radius and its colour.
type Look = [u32; 5];

#[inline(always)]
fn look(body: &Body) -> Look {
    let Sphere { center, radius } = body.sphere;
    let color = body
        .color
        .map_or(u32::MAX, |Rgb(r, g, b)| u32::from_le_bytes([r, g, b, 0]));
    let [x, y, z] = center.to_array().map(f32::to_bits);
    [x, y, z, radius.to_bits(), color]
}

/// Whether two looks are not the same, with one branch for all.
#[inline(always)]
fn differs(before: &Look, after: &Look) -> bool {
    before
        .iter()
        .zip(after)
        .fold(0, |all, (b, a)| all | (b ^ a))
        != 0
}

impl Memory {
    /// Forgets all spheres, for a whole frame.
    pub(super) fn forget(&mut self) {
        self.is_complete = false;
        self.spheres.clear();
        self.bounds.clear();
    }

    /// Remembers the next spheres of the list and where they can be seen.
    pub(super) fn learn(&mut self, bodies: &[Body], bounds: &[Bounds]) {
        let known = self.spheres.len();
        let wanted = if self.is_restless {
            SAMPLE.saturating_sub(known).min(bodies.len())
        } else {
            bodies.len()
        };
        let bodies = bodies[..wanted].iter();
        self.spheres.extend(bodies.map(look));
        self.bounds.extend(&bounds[..wanted]);
    }

    /// Notes whether all of these were learnt.
    pub(super) fn complete(&mut self, bodies: &[Body]) {
        self.is_complete = self.bounds.len() == bodies.len();
    }

    /// Finds the spheres that are not what they were, if all else is `the_same`; whether they are few and
    /// the rest is known.
    pub(super) fn find_changes(&mut self, bodies: &[Body], the_same: bool) -> bool {
        self.changes.clear();
        self.is_restless = false;
        let known = self.spheres.len();
        if !the_same || (known != bodies.len() && known != SAMPLE) {
            return false;
        }
        for (number, (before, body)) in (0..).zip(self.spheres.iter().zip(bodies)) {
            if differs(before, &look(body)) {
                if self.changes.len() == MOST {
                    self.is_restless = bodies.len() > FEW && number < SAMPLE as u32;
                    return false;
                }
                self.changes.push(number);
            }
        }
        self.is_complete && known == bodies.len()
    }

    /// The spheres that [`Memory::find_changes`] found.
    pub(super) fn changes(&self) -> &[u32] {
        &self.changes
    }

    /// Remembers what a sphere is now and where it can be seen; where it could be seen before.
    pub(super) fn replace(&mut self, number: u32, body: &Body, bounds: Bounds) -> Bounds {
        let i = number as usize;
        self.spheres[i] = look(body);
        let before = self.bounds.get(i);
        self.bounds.set(i, bounds);
        before
    }

    /// The spheres that can be seen within any of the parts.
    pub(super) fn find_within(&self, parts: &[Bounds], found: &mut Vec<u32>) {
        found.clear();
        self.bounds.find(parts, found);
    }
}

/// Boxes of pixels, side by side in arrays: few of very many can so be found in little time.
#[derive(Debug, Clone, Default)]
struct Boxes {
    left: Vec<i16>,
    right: Vec<i16>,
    top: Vec<i16>,
    bottom: Vec<i16>,
}

/// So many boxes are looked at in one loop.
const BLOCK: usize = 64;

impl Boxes {
    fn clear(&mut self) {
        self.left.clear();
        self.right.clear();
        self.top.clear();
        self.bottom.clear();
    }

    fn len(&self) -> usize {
        self.left.len()
    }

    fn extend(&mut self, boxes: &[Bounds]) {
        self.left.extend(boxes.iter().map(|bounds| bounds.left));
        self.right.extend(boxes.iter().map(|bounds| bounds.right));
        self.top.extend(boxes.iter().map(|bounds| bounds.top));
        self.bottom.extend(boxes.iter().map(|bounds| bounds.bottom));
    }

    fn get(&self, i: usize) -> Bounds {
        Bounds {
            left: self.left[i],
            right: self.right[i],
            top: self.top[i],
            bottom: self.bottom[i],
        }
    }

    fn set(&mut self, i: usize, bounds: Bounds) {
        self.left[i] = bounds.left;
        self.right[i] = bounds.right;
        self.top[i] = bounds.top;
        self.bottom[i] = bounds.bottom;
    }

    /// The numbers of those that have a pixel in common with any of the parts.
    fn find(&self, parts: &[Bounds], found: &mut Vec<u32>) {
        for first in (0..self.len()).step_by(BLOCK) {
            let length = BLOCK.min(self.len() - first);
            let [left, right, top, bottom] = [&self.left, &self.right, &self.top, &self.bottom]
                .map(|ends| &ends[first..first + length]);
            let mut here = [0; BLOCK];
            let mut any = 0;
            for part in parts {
                for i in 0..length {
                    here[i] |= i16::from(left[i] <= part.right)
                        & i16::from(right[i] >= part.left)
                        & i16::from(top[i] <= part.bottom)
                        & i16::from(bottom[i] >= part.top);
                    any |= here[i];
                }
            }
            if any != 0 {
                let numbered = (first as u32..).zip(&here[..length]);
                found.extend(numbered.filter_map(|(number, &is)| (is != 0).then_some(number)));
            }
        }
    }
}
