//! The finish: what the view asks of the sphere that is seen, once for each pixel, not for those
//! spheres that lost.

use super::lanes::{LANES, Lanes, Real, sub};
use super::layer::{Contact, Layer};
use super::nearest::{ASK, INSIDE, NOBODY, Nearest, Question, number};
use super::shade::{Hit, Spot};
use crate::geometry::Sphere;
use crate::method::{Method, Place};
use crate::scene::Light;

/// Names the sphere at each pixel and says how the line meets it; with `roots` rounds the root, too.
pub(super) fn identify(question: &Question, nearest: &Nearest, seen: &mut Layer, roots: bool) {
    for place in 0..question.field.places() {
        let entry = if question.field.is_pixel(place) {
            nearest.body(place)
        } else {
            NOBODY
        };
        seen.body[place] = number(entry).unwrap_or(NOBODY);
        seen.t[place] = nearest.t(place);
        seen.contact[place] = match number(entry) {
            None => {
                seen.t[place] = f32::INFINITY;
                Contact::Miss
            }
            Some(_) if entry & ASK == 0 && !roots => {
                if entry & INSIDE == 0 {
                    Contact::Secant
                } else {
                    Contact::Inside
                }
            }
            Some(number) => {
                let sphere = &question.bodies[number as usize].sphere;
                let answer = Method::Exact.solve(&question.field.ray(place), sphere);
                seen.t[place] = answer.visible().unwrap_or(f32::INFINITY);
                Contact::of(&answer)
            }
        };
    }
}

/// Where light comes from.
pub(super) struct Lighting {
    light: Option<Light>,
    position: Option<[f64; 3]>,
}

impl Lighting {
    pub(super) fn new(light: Option<Light>) -> Self {
        Self {
            light,
            position: light.map(|l| l.position.to_array().map(f64::from)),
        }
    }
}

/// The brightness of each pixel; 0 where nothing is seen.
pub(super) fn shade(
    question: &Question,
    nearest: &Nearest,
    seen: &Layer,
    lighting: &Lighting,
    value: &mut [f32],
) {
    for place in (0..question.field.places()).step_by(LANES) {
        let bodies: &[u32] = &seen.body[place..place + LANES];
        let value = &mut value[place..place + LANES];
        if bodies.iter().all(|&b| b == NOBODY) {
            value.fill(0.0);
            continue;
        }
        let lanes = spot(question, bodies, place).brightness(lighting.position);
        for l in 0..LANES {
            value[l] = if bodies[l] == NOBODY {
                0.0
            } else {
                lanes.0[l] as f32
            };
        }
        // The lanes take every root for the near one.
        for l in 0..LANES {
            if lighting.light.is_some() && seen.contact[place + l] == Contact::Inside {
                let hit = Hit {
                    method: Method::Exact,
                    ray: &question.field.ray(place + l),
                    sphere: &question.bodies[bodies[l] as usize].sphere,
                    t: nearest.t(place + l),
                    place: Place::Inside,
                };
                value[l] = hit.brightness(lighting.light);
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
