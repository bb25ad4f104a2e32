//! The finish: what the view asks of the sphere that is seen, once for each pixel, not for those
//! spheres that lost.

use super::cover::Bounds;
use super::lanes::{LANES, Lanes, Real, sub};
use super::layer::{Contact, Layer};
use super::nearest::{ASK, INSIDE, NOBODY, Nearest, Question, number};
use super::plan::Counts;
use super::shade::{Hit, Spot};
use crate::geometry::Sphere;
use crate::method::{Method, Place};
use crate::scene::Light;

/// Names the sphere at each pixel and says how the line meets it; with `roots` rounds the root, too.
pub(super) fn identify(
    question: &Question,
    nearest: &Nearest,
    seen: &mut Layer,
    part: Bounds,
    roots: bool,
    counts: &mut Counts,
) {
    for place in question.field.runs_within(part) {
        let entries = nearest.bodies(place);
        let to_ask = |entry| entry != NOBODY && (roots || entry & ASK != 0);
        let body = &mut seen.body[place..place + LANES];
        let contact = &mut seen.contact[place..place + LANES];
        let t = &mut seen.t[place..place + LANES];
        for l in 0..LANES {
            body[l] = number(entries[l]).unwrap_or(NOBODY);
            contact[l] = known_contact(entries[l]);
            t[l] = if entries[l] == NOBODY {
                f32::INFINITY
            } else {
                nearest.t(place + l)
            };
        }
        if !entries.into_iter().any(to_ask) {
            continue;
        }
        for l in (0..LANES).filter(|&l| to_ask(entries[l])) {
            let sphere = &question.bodies[body[l] as usize].sphere;
            let answer = Method::Exact.solve(&question.field.ray(place + l), sphere);
            counts.rounded += 1;
            t[l] = answer.visible().unwrap_or(f32::INFINITY);
            contact[l] = Contact::of(&answer);
        }
    }
}

/// How the line meets a sphere about which no method had to be asked.
const fn known_contact(entry: u32) -> Contact {
    if entry == NOBODY {
        Contact::Miss
    } else if entry & INSIDE == 0 {
        Contact::Secant
    } else {
        Contact::Inside
    }
}

/// The brightness of each pixel within `part`; 0 where nothing is seen.
pub(super) fn shade(
    question: &Question,
    seen: &Layer,
    light: Option<Light>,
    part: Bounds,
    value: &mut [f32],
    counts: &mut Counts,
) {
    let position = light.map(|light| light.position.to_array().map(f64::from));
    for place in question.field.runs_within(part) {
        let bodies: &[u32] = &seen.body[place..place + LANES];
        let value = &mut value[place..place + LANES];
        let visible = bodies.iter().filter(|&&b| b != NOBODY).count();
        if visible == 0 {
            value.fill(0.0);
            continue;
        }
        counts.shaded += visible as u64;
        let lanes = spot(question, bodies, place).brightness(position);
        for l in 0..LANES {
            value[l] = if bodies[l] == NOBODY {
                0.0
            } else {
                lanes.0[l] as f32
            };
        }
        // The lanes take every root for the near one; without a light that does not matter.
        if light.is_some() {
            for l in (0..LANES).filter(|l| seen.contact[place + l] == Contact::Inside) {
                let hit = Hit {
                    method: Method::Exact,
                    ray: &question.field.ray(place + l),
                    sphere: &question.bodies[bodies[l] as usize].sphere,
                    t: seen.t[place + l],
                    place: Place::Inside,
                };
                value[l] = hit.brightness(light);
            }
        }
    }
}

/// The rays of a run of pixels and the spheres that they hit; any sphere where they hit none.
#[inline(always)]
fn spot(question: &Question, bodies: &[u32], place: usize) -> Spot<Lanes> {
    let mut spheres = [[0.0; LANES]; 4];
    for l in 0..LANES {
        let sphere = question
            .bodies
            .get(bodies[l] as usize)
            .map_or(NONE, |body| body.sphere);
        let [x, y, z] = sphere.center.to_array();
        for (lanes, v) in spheres.iter_mut().zip([x, y, z, sphere.radius]) {
            lanes[l] = v.into();
        }
    }
    let [x, y, z, r] = spheres.map(Lanes);
    let center = [x, y, z];
    let varying = question.field.varying(place);
    let shared = question.field.shared().map(Lanes::of);
    let (origin, d) = if question.field.perspective() {
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

const NONE: Sphere = Sphere {
    center: glam::Vec3::ZERO,
    radius: 1.0,
};
