//! The finish: what the view asks of the sphere that is seen, once for each pixel, not for those
//! spheres that lost.

use super::cover::Bounds;
use super::field::Field;
use super::lanes::{LANES, Lanes, Real, sub};
use super::layer::{ASK, Contact, INSIDE, Layer, NOBODY, number};
use super::plan::Counts;
use super::shade::{Hit, Spot};
use crate::geometry::Sphere;
use crate::method::simd::Kernel;
use crate::method::{Method, Place, exact};
use crate::scene::{Body, Light};

/// Rounds the roots that are seen within `part`; where the method was asked they are.
pub(super) fn round_roots(
    field: &Field,
    bodies: &[Body],
    seen: &mut Layer,
    part: Bounds,
    counts: &mut Counts,
) {
    for place in field.places_within(part) {
        let entry = seen.body[place];
        let Some(number) = number(entry).filter(|_| entry & ASK == 0) else {
            continue;
        };
        let sphere = &bodies[number as usize].sphere;
        let (answer, stages) = exact::solve_staged(&field.ray(place), sphere);
        counts.note_rounded(stages.last());
        seen.t[place] = answer.visible().unwrap_or(f32::INFINITY);
    }
}

/// Works out the brightness of each pixel within `part`; 0 where nothing is seen.
pub(super) struct Shading<'a> {
    pub field: &'a Field,
    pub bodies: &'a [Body],
    pub seen: &'a Layer,
    pub light: Option<Light>,
    pub part: Bounds,
    pub value: &'a mut [f32],
    pub counts: &'a mut Counts,
}

impl Kernel for Shading<'_> {
    #[inline(always)]
    fn run(mut self) {
        let position = self
            .light
            .map(|light| light.position.to_array().map(f64::from));
        for place in self.field.runs_within(self.part) {
            self.shade(place, position);
        }
    }
}

impl Shading<'_> {
    #[inline(always)]
    fn shade(&mut self, place: usize, position: Option<[f64; 3]>) {
        let entries: &[u32] = &self.seen.body[place..place + LANES];
        let value = &mut self.value[place..place + LANES];
        let visible: u32 = entries.iter().map(|&e| u32::from(e != NOBODY)).sum();
        if visible == 0 {
            value.fill(0.0);
            return;
        }
        self.counts.shaded += u64::from(visible);
        let lanes = spot(self.field, self.bodies, entries, place).brightness(position);
        for l in 0..LANES {
            // All bits or none: a branch would split the lanes.
            let seen = u32::from(entries[l] != NOBODY).wrapping_neg();
            value[l] = f32::from_bits((lanes.0[l] as f32).to_bits() & seen);
        }
        // The lanes take every root for the near one; without a light that does not matter.
        if self.light.is_some() {
            self.light_from_inside(place);
        }
    }

    #[inline(never)]
    fn light_from_inside(&mut self, place: usize) {
        for place in place..place + LANES {
            if self.seen.contact(place) != Contact::Inside {
                continue;
            }
            let Some(number) = self.seen.seen(place) else {
                continue;
            };
            let hit = Hit {
                method: Method::Exact,
                ray: &self.field.ray(place),
                sphere: &self.bodies[number as usize].sphere,
                t: self.seen.t[place],
                place: Place::Inside,
            };
            self.value[place] = hit.brightness(self.light);
        }
    }
}

/// The rays of a run of pixels and the spheres that they hit; any sphere where they hit none.
#[inline(always)]
fn spot(field: &Field, bodies: &[Body], entries: &[u32], place: usize) -> Spot<Lanes> {
    let last = bodies.len() - 1;
    let mut spheres = [[0.0; LANES]; 4];
    for l in 0..LANES {
        let number = (entries[l] & !(ASK | INSIDE)) as usize;
        let Sphere { center, radius } = bodies[number.min(last)].sphere;
        for (lanes, v) in spheres
            .iter_mut()
            .zip([center.x, center.y, center.z, radius])
        {
            lanes[l] = v.into();
        }
    }
    let [x, y, z, r] = spheres.map(Lanes);
    let center = [x, y, z];
    let varying = field.varying(place);
    let shared = field.shared().map(Lanes::of);
    let (origin, d) = if field.perspective() {
        (shared, varying)
    } else {
        (varying, shared)
    };
    Spot {
        o: sub(origin, center),
        d,
        center,
        r,
        inside: false,
    }
}
