//! The finish: what the view asks of the sphere that is seen, once for each pixel, not for those
//! spheres that lost.

use super::bounds::Bounds;
use super::field::Field;
use super::lanes::{LANES, Lanes, Real, sub};
use super::layer::{ASKED, Contact, Layer, NOBODY};
use super::plan::{Counts, Plan, Strategy};
use super::search::Found;
use super::shade::{Hit, Spot};
use super::view::View;
use crate::geometry::{Ray, Sphere};
use crate::method::simd::{self, Kernel};
use crate::method::{Class, Method, Place, exact, root_bits_lost};
use crate::scene::{Body, Light};

/// What is finished: the pixels of a field that see these bodies.
#[derive(Clone, Copy)]
pub(super) struct Scope<'a> {
    pub field: &'a Field,
    pub bodies: &'a [Body],
}

/// Works out within `part` what the view of the plan asks of what was found; the truth is what `exact`
/// found, if the method is held to it.
pub(super) fn finish(
    scope: Scope,
    plan: &mut Plan,
    part: Bounds,
    found: &mut Found,
    truth: &mut Found,
) {
    let is_certified = plan.way() == Strategy::Certified;
    match plan.view() {
        View::Depth | View::Acne if is_certified => {
            round_roots(scope, &mut found.layer, part, &mut plan.counts);
        }
        View::Shade if is_certified => simd::dispatch(Shading {
            scope,
            seen: &found.layer,
            light: plan.light(),
            part,
            value: &mut found.value,
            counts: &mut plan.counts,
        }),
        View::Lost if plan.compares() => {
            round_roots(scope, &mut truth.layer, part, &mut plan.truth);
            finish_pixels(scope, plan, part, found, &truth.layer);
        }
        View::Shade | View::Stage => finish_pixels(scope, plan, part, found, &truth.layer),
        _ => {}
    }
}

fn finish_pixels(scope: Scope, plan: &mut Plan, part: Bounds, found: &mut Found, truth: &Layer) {
    for place in scope.field.places_within(part) {
        let seen = found.layer.seen(place);
        let sphere = seen.map(|number| &scope.bodies[number as usize].sphere);
        let ray = &scope.field.ray(place);
        let (t, contact) = (found.layer.t[place], found.layer.contact(place));
        let value = &mut found.value[place];
        match (plan.view(), sphere) {
            (View::Shade, Some(sphere)) => {
                plan.counts.shaded += 1;
                let hit = Hit {
                    method: plan.method(),
                    ray,
                    sphere,
                    t,
                    place: contact.place(),
                };
                *value = hit.brightness(plan.light());
            }
            (View::Lost, _) => {
                let is_right = seen == truth.seen(place)
                    && sphere.is_none_or(|sphere| has_right_class(contact, ray, sphere));
                let bits = is_right
                    .then(|| root_bits_lost(t, truth.t[place]))
                    .flatten();
                *value = bits.map_or(f32::INFINITY, |bits| bits as f32);
            }
            // The stage that rounded the visible root counts, beside those that were sure of a class.
            (View::Stage, Some(sphere)) => {
                let (_, stages) = exact::solve_staged(ray, sphere);
                let root = match contact.place() {
                    Place::Inside => stages.far,
                    _ => stages.near,
                };
                let root = root.unwrap_or(stages.class) as u8;
                *value = value.max(root.into());
            }
            _ => {}
        }
    }
}

/// Whether the sphere that is seen is rightly touched or rightly crossed.
fn has_right_class(contact: Contact, ray: &Ray, sphere: &Sphere) -> bool {
    let touches = contact == Contact::Tangent;
    touches == (Method::Exact.solve(ray, sphere).class == Class::Tangent)
}

/// Rounds the roots that are seen within `part`; where the method was asked they are.
fn round_roots(scope: Scope, seen: &mut Layer, part: Bounds, counts: &mut Counts) {
    for place in scope.field.places_within(part) {
        let Some(number) = seen.seen(place).filter(|_| !seen.is_asked(place)) else {
            continue;
        };
        let sphere = &scope.bodies[number as usize].sphere;
        let (answer, stages) = exact::solve_staged(&scope.field.ray(place), sphere);
        counts.note_rounded(stages.last());
        seen.t[place] = answer.visible().unwrap_or(f32::INFINITY);
    }
}

/// Works out the brightness of each pixel within `part`; 0 where nothing is seen.
struct Shading<'a> {
    scope: Scope<'a>,
    seen: &'a Layer,
    light: Option<Light>,
    part: Bounds,
    value: &'a mut [f32],
    counts: &'a mut Counts,
}

impl Kernel for Shading<'_> {
    #[inline(always)]
    fn run(mut self) {
        let position = self
            .light
            .map(|light| light.position.to_array().map(f64::from));
        if self.part.is_empty() {
            return;
        }
        let first = self.part.left as usize / LANES * LANES;
        for y in self.part.top..=self.part.bottom {
            let row = y as usize * self.scope.field.stride();
            for x in (first..=self.part.right as usize).step_by(LANES) {
                self.shade(row + x, x as i16, position);
            }
        }
    }
}

impl Shading<'_> {
    #[inline(always)]
    fn shade(&mut self, place: usize, x: i16, position: Option<[f64; 3]>) {
        let entries: &[u32] = &self.seen.body[place..place + LANES];
        let value = &mut self.value[place..place + LANES];
        let visible: u32 = entries.iter().map(|&e| u32::from(e != NOBODY)).sum();
        if visible == 0 {
            value.fill(0.0);
            return;
        }
        let columns = (x..).zip(entries);
        self.counts.shaded += columns
            .filter(|&(x, &e)| e != NOBODY && x >= self.part.left && x <= self.part.right)
            .count() as u64;
        let lanes = spot(self.scope, entries, place).brightness(position);
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
                ray: &self.scope.field.ray(place),
                sphere: &self.scope.bodies[number as usize].sphere,
                t: self.seen.t[place],
                place: Place::Inside,
            };
            self.value[place] = hit.brightness(self.light);
        }
    }
}

/// The rays of a run of pixels and the spheres that they hit; any sphere where they hit none.
#[inline(always)]
fn spot(Scope { field, bodies }: Scope, entries: &[u32], place: usize) -> Spot<Lanes> {
    let last = bodies.len() - 1;
    let mut spheres = [[0.0; LANES]; 4];
    for l in 0..LANES {
        let number = (entries[l] & !ASKED) as usize;
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
