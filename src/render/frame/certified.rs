//! Frames of `exact`: asked where a sphere can be seen, by a certified test, and finished once for
//! each pixel.

use super::Frame;
use crate::method::Method;
use crate::render::View;
use crate::render::bounds::Eye;
use crate::render::cover::{BLOCK, Bounds, Projector};
use crate::render::finish;
use crate::render::lanes::LANES;
use crate::render::layer::Contact;
use crate::render::nearest::{NOBODY, Question};
use crate::scene::{Rays, Scene};

impl Frame {
    /// The whole picture.
    pub(super) fn start_certified(&mut self, scene: &Scene, rays: &Rays) {
        let eye = (self.plan.view() == View::Class).then(|| Eye::new(rays));
        self.find_nearest(scene, rays, |frame, number, front| {
            let line = eye
                .as_ref()
                .map(|eye| eye.window(&scene.bodies[number as usize].sphere, 1.0));
            frame
                .memory
                .learn(front.union(line.unwrap_or(Bounds::NONE)));
        });
        let whole = Bounds::whole(rays.size);
        self.make_room();
        self.finish(scene, whole);
        if let Some(eye) = eye {
            self.find_what_is_behind(scene, &eye, whole);
        }
    }

    /// The pixels within `part`, and what shares a run with them.
    pub(super) fn redo_certified(&mut self, scene: &Scene, rays: &Rays, part: Bounds) {
        let part = part
            .in_runs_of(LANES as i16)
            .within(Bounds::whole(rays.size));
        self.find_nearest_within(scene, rays, part);
        self.finish(scene, part);
        if self.plan.view() == View::Class {
            self.find_what_is_behind(scene, &Eye::new(rays), part);
        }
    }

    /// Asks for the nearest hits of the whole picture; `learn` is told where each sphere can be seen.
    pub(super) fn find_nearest(
        &mut self,
        scene: &Scene,
        rays: &Rays,
        mut learn: impl FnMut(&mut Self, u32, Bounds),
    ) {
        self.nearest.clear(&self.field);
        let projector = Projector::new(rays);
        let mut block = std::mem::take(&mut self.block);
        for (first, bodies) in (0..).step_by(BLOCK).zip(scene.bodies.chunks(BLOCK)) {
            projector.bound(bodies, &mut block);
            for i in 0..bodies.len() {
                let (bounds, least) = (block.bounds(i), block.least(i));
                let number = first + i as u32;
                learn(self, number, bounds);
                if bounds.is_empty() {
                    if block.is_behind(i) {
                        self.plan.counts.behind += 1;
                    } else {
                        self.plan.counts.outside += 1;
                    }
                } else if self.nearest.hides(bounds, least) {
                    self.plan.counts.hidden += 1;
                } else {
                    self.ask_nearest(scene, number, bounds, least);
                }
            }
        }
        self.block = block;
        self.nearest.trim(&self.field);
    }

    /// Asks again for the nearest hits within `part`.
    pub(super) fn find_nearest_within(&mut self, scene: &Scene, rays: &Rays, part: Bounds) {
        self.nearest.reopen(&self.field, part);
        let projector = Projector::new(rays);
        for number in 0..scene.bodies.len() {
            if self.memory.bounds()[number].is_apart_from(part) {
                continue;
            }
            let (bounds, least) = projector.bound_one(&scene.bodies[number].sphere);
            let bounds = bounds.within(part);
            if !bounds.is_empty() {
                self.ask_nearest(scene, number as u32, bounds, least);
            }
        }
        self.nearest.trim(&self.field);
    }

    fn ask_nearest(&mut self, scene: &Scene, number: u32, bounds: Bounds, least: f32) {
        self.plan.note_box(bounds);
        let question = Question {
            field: &self.field,
            bodies: &scene.bodies,
        };
        self.nearest
            .ask(&question, number, bounds, least, &mut self.plan.counts);
    }

    /// Works out, once for each pixel within `part`, what the view asks of what is seen there.
    fn finish(&mut self, scene: &Scene, part: Bounds) {
        let question = Question {
            field: &self.field,
            bodies: &scene.bodies,
        };
        let roots = self.plan.view().shows_roots();
        let counts = &mut self.plan.counts;
        self.roots_are_rough = !roots;
        finish::identify(
            &question,
            &self.nearest,
            &mut self.seen,
            part,
            roots,
            counts,
        );
        if self.plan.view() == View::Shade {
            let light = self.plan.light();
            let counts = &mut self.plan.counts;
            finish::shade(&question, &self.seen, light, part, &mut self.value, counts);
        }
    }

    /// Where nothing is seen, what the lines within `part` meet behind the eye.
    fn find_what_is_behind(&mut self, scene: &Scene, eye: &Eye, part: Bounds) {
        for (number, body) in scene.bodies.iter().enumerate() {
            if self.memory.bounds()[number].is_apart_from(part) || !eye.may_be_behind(&body.sphere)
            {
                continue;
            }
            let window = eye.window(&body.sphere, 1.0).within(part);
            for place in self.field.places_within(window) {
                if self.seen.body[place] != NOBODY {
                    continue;
                }
                self.plan.note_solved(None);
                let answer = Method::Exact.solve(&self.field.ray(place), &body.sphere);
                let contact = &mut self.seen.contact[place];
                *contact = (*contact).max(Contact::of(&answer));
            }
        }
    }
}
