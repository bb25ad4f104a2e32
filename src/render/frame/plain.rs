//! Frames of any method: the method itself is asked, about each sphere at the pixels of its window.

use std::slice;

use super::{FARTHEST_MISS, Frame};
use crate::geometry::{Ray, Sphere};
use crate::method::exact;
use crate::method::{Class, Method, Place, root_bits_lost};
use crate::render::View;
use crate::render::bounds::Eye;
use crate::render::cover::Bounds;
use crate::render::finish;
use crate::render::layer::{Contact, NOBODY};
use crate::render::plan::Way;
use crate::render::shade;
use crate::scene::{Rays, Scene};

impl Frame {
    /// The whole picture.
    pub(super) fn start_plain(&mut self, scene: &Scene, rays: &Rays) {
        let whole = Bounds::whole(rays.size);
        let eye = Eye::new(rays);
        for body in &scene.bodies {
            let bounds = match self.plan.way() {
                Way::Everything => whole,
                _ => eye.window(&body.sphere, self.reach()),
            };
            self.plan.counts.outside += u64::from(bounds.is_empty());
            self.memory.learn(slice::from_ref(body), &[bounds]);
        }
        self.asked.clear_all(self.field.places());
        self.value.clear();
        self.value.resize(self.field.places(), 0.0);
        if self.compares() {
            self.find_nearest(scene, rays);
        } else if self.plan.view() == View::Lost {
            self.nearest.clear(&self.field);
        }
        self.ask_within(scene, rays, whole);
    }

    /// The pixels within `part`.
    pub(super) fn redo_plain(&mut self, scene: &Scene, rays: &Rays, part: Bounds) {
        if self.compares() {
            self.find_nearest_within(scene, rays, part);
        }
        self.ask_within(scene, rays, part);
    }

    /// Up to how many radii from a sphere's centre a line is of interest.
    pub(super) fn reach(&self) -> f64 {
        if self.plan.view() == View::Delta {
            2.0
        } else {
            1.0
        }
    }

    /// Whether the answers are held against those of the certified way.
    fn compares(&self) -> bool {
        self.plan.view() == View::Lost && self.plan.way() == Way::Widened
    }

    fn ask_within(&mut self, scene: &Scene, rays: &Rays, part: Bounds) {
        self.roots_are_rough = false;
        let none = match self.plan.view() {
            View::Delta => f32::NEG_INFINITY,
            _ => 0.0,
        };
        for y in part.top..=part.bottom {
            let run = self.field.run(y, [part.left, part.right]);
            self.value[run.clone()].fill(none);
            self.asked.clear_run(run);
        }
        let eye = Eye::new(rays);
        for (number, body) in (0..NOBODY).zip(&scene.bodies) {
            let bounds = self.memory.bounds(number as usize).within(part);
            if bounds.is_empty() {
                continue;
            }
            self.plan.counts.asked += 1;
            let spans = match self.plan.way() {
                Way::Everything => None,
                _ => eye.spans(&body.sphere, self.reach()),
            };
            for y in bounds.top..=bounds.bottom {
                let columns = match &spans {
                    Some(spans) => spans.at(y, bounds),
                    None => [bounds.left, bounds.right],
                };
                self.plan.counts.note_rows(1, columns);
                for place in self.field.run(y, columns) {
                    self.ask(place, number, &body.sphere);
                }
            }
        }
        if self.plan.view() == View::Lost {
            self.find_truth(scene, part);
        }
        for place in self.field.places_within(part) {
            self.finish_pixel(scene, place);
        }
    }

    /// Asks about one sphere at one pixel.
    fn ask(&mut self, place: usize, number: u32, sphere: &Sphere) {
        let ray = &self.field.ray(place);
        let method = self.plan.method();
        let (answer, stage) = match method {
            Method::Exact => {
                let (answer, stages) = exact::solve_staged(ray, sphere);
                if self.plan.view() == View::Stage {
                    let value = &mut self.value[place];
                    *value = value.max(stages.class as u8 as f32);
                }
                (answer, Some(stages.last()))
            }
            method => (method.solve(ray, sphere), None),
        };
        self.plan.counts.note_solved(stage);
        self.plan.counts.roots += u64::from(answer.class.meets());
        let is_seen = self
            .asked
            .note(place, number, &answer, self.plan.view() == View::Class);
        if self.plan.view() == View::Delta {
            let delta = normalised_discriminant(method, ray, sphere, answer.class);
            if is_seen {
                self.value[place] = delta;
            } else if self.asked.seen(place).is_none() && delta > FARTHEST_MISS {
                self.value[place] = self.value[place].max(delta);
            }
        }
    }

    /// What `exact` sees within `part`.
    fn find_truth(&mut self, scene: &Scene, part: Bounds) {
        if self.plan.way() == Way::Widened {
            let (layer, counts) = (&mut self.nearest.layer, &mut self.plan.counts);
            finish::round_roots(&self.field, &scene.bodies, layer, part, counts);
            return;
        }
        for (number, body) in (0..NOBODY).zip(&scene.bodies) {
            for place in self.field.places_within(part) {
                let answer = Method::Exact.solve(&self.field.ray(place), &body.sphere);
                self.nearest.layer.note(place, number, &answer, false);
            }
        }
    }

    /// Whether the sphere that is seen is rightly touched or rightly crossed.
    fn has_right_class(&self, place: usize, ray: &Ray, sphere: &Sphere) -> bool {
        let touches = self.asked.contact(place) == Contact::Tangent;
        touches == (Method::Exact.solve(ray, sphere).class == Class::Tangent)
    }

    /// What the view asks of the sphere that is seen at one pixel.
    fn finish_pixel(&mut self, scene: &Scene, place: usize) {
        let seen = self.asked.seen(place);
        let sphere = seen.map(|number| &scene.bodies[number as usize].sphere);
        let ray = &self.field.ray(place);
        let which = self.asked.contact(place).visible_root();
        match (self.plan.view(), sphere) {
            (View::Shade, Some(sphere)) => {
                self.plan.counts.shaded += 1;
                let hit = shade::Hit {
                    method: self.plan.method(),
                    ray,
                    sphere,
                    t: self.asked.t[place],
                    place: which,
                };
                self.value[place] = hit.brightness(scene.light);
            }
            (View::Lost, _) => {
                let truth = &self.nearest.layer;
                let is_right = seen == truth.seen(place)
                    && sphere.is_none_or(|s| self.has_right_class(place, ray, s));
                let bits = is_right
                    .then(|| root_bits_lost(self.asked.t[place], truth.t[place]))
                    .flatten();
                self.value[place] = bits.map_or(f32::INFINITY, |bits| bits as f32);
            }
            // The stage that rounded the visible root counts, beside those that were sure of a class.
            (View::Stage, Some(sphere)) => {
                let (_, stages) = exact::solve_staged(ray, sphere);
                let root = match which {
                    Place::Inside => stages.far,
                    _ => stages.near,
                };
                let root = root.unwrap_or(stages.class) as u8;
                self.value[place] = self.value[place].max(root.into());
            }
            _ => {}
        }
    }
}

/// Δ/(4Ar²) as `method` has it: −∞ for a miss, 0 for a meeting where that is not a number, as with
/// a point sphere.
///
/// The size of an exact Δ is taken from the method `double`, which has it to all the bits that a
/// picture can show; its sign is that of the exact class.
fn normalised_discriminant(method: Method, ray: &Ray, sphere: &Sphere, class: Class) -> f32 {
    let size = match method {
        Method::Exact => Method::Double,
        _ => method,
    }
    .coefficients(ray, sphere);
    let r = f64::from(sphere.radius);
    let delta = (size.discriminant / (4.0 * size.a * r * r)) as f32;
    let delta = match (method, class) {
        (Method::Exact, Class::Miss) => -delta.abs(),
        (Method::Exact, Class::Tangent) => 0.0,
        (Method::Exact, Class::Secant) => delta.abs(),
        _ => delta,
    };
    match class {
        _ if !delta.is_nan() => delta,
        Class::Tangent | Class::Secant => 0.0,
        Class::Miss | Class::Nan => f32::NEG_INFINITY,
    }
}
