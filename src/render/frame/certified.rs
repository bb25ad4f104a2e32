//! Frames of `exact`: asked where a sphere can be seen, by a certified test, and finished once for
//! each pixel.

use super::Frame;
use super::memory::Memory;
use crate::method::exact;
use crate::method::simd::{self, Kernel};
use crate::render::View;
use crate::render::bounds::Eye;
use crate::render::cover::{BLOCK, Block, Bounds, Projector};
use crate::render::finish;
use crate::render::lanes::SINGLES;
use crate::render::layer::{Contact, NOBODY};
use crate::render::nearest::{Candidate, Nearest, Question};
use crate::render::plan::Counts;
use crate::scene::{Body, Rays, Scene};

impl Frame {
    /// The whole picture.
    pub(super) fn start_certified(&mut self, scene: &Scene, rays: &Rays) {
        let eye = (self.plan.view() == View::Class).then(|| Eye::new(rays));
        self.find_nearest(scene, rays, |memory, body, front| {
            let line = eye.as_ref().map(|eye| eye.window(&body.sphere, 1.0));
            memory.learn(body, front.union(line.unwrap_or(Bounds::NONE)));
        });
        self.value.clear();
        self.value.resize(self.field.places(), 0.0);
        let whole = Bounds::whole(rays.size);
        self.finish(scene, whole);
        if let Some(eye) = eye {
            self.find_what_is_behind(scene, &eye, whole);
        }
    }

    /// The pixels within `part`, and what shares a run with them.
    pub(super) fn redo_certified(&mut self, scene: &Scene, rays: &Rays, part: Bounds) {
        let part = part
            .in_runs_of(SINGLES as i16)
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
        mut learn: impl FnMut(&mut Memory, &Body, Bounds),
    ) {
        self.nearest.clear(&self.field);
        let projector = Projector::new(rays);
        for (first, bodies) in (0..).step_by(BLOCK).zip(scene.bodies.chunks(BLOCK)) {
            simd::dispatch(Search {
                projector: &projector,
                question: Question {
                    field: &self.field,
                    bodies: &scene.bodies,
                    roots: self.plan.roots_tell_depths(),
                },
                first,
                chunk: bodies,
                block: &mut self.block,
                nearest: &mut self.nearest,
                counts: &mut self.plan.counts,
            });
            for (i, body) in bodies.iter().enumerate() {
                learn(&mut self.memory, body, self.block.bounds(i));
            }
        }
        self.nearest.trim(&self.field);
    }

    /// How many spheres can be seen, were it not for others.
    pub(super) fn bound_certified(&mut self, scene: &Scene, rays: &Rays) -> usize {
        let projector = Projector::new(rays);
        let mut seen = 0;
        for chunk in scene.bodies.chunks(BLOCK) {
            let block = &mut self.block;
            simd::dispatch(Bounding {
                projector: &projector,
                chunk,
                block,
            });
            let is_seen = |&i: &usize| !self.block.bounds(i).is_empty();
            seen += (0..chunk.len()).filter(is_seen).count();
        }
        seen
    }

    /// Asks again for the nearest hits within `part`.
    pub(super) fn find_nearest_within(&mut self, scene: &Scene, rays: &Rays, part: Bounds) {
        self.nearest.reopen(&self.field, part);
        let projector = Projector::new(rays);
        let question = Question {
            field: &self.field,
            bodies: &scene.bodies,
            roots: self.plan.roots_tell_depths(),
        };
        for (number, known) in (0..).zip(self.memory.bounds()) {
            if known.is_apart_from(part) {
                continue;
            }
            let sphere = &scene.bodies[number as usize].sphere;
            projector.bound_one(sphere, &mut self.block);
            let bounds = self.block.bounds(0).within(part);
            if !bounds.is_empty() {
                ask(
                    &mut self.nearest,
                    &question,
                    &projector,
                    (&self.block, 0),
                    (number, bounds),
                    &mut self.plan.counts,
                );
            }
        }
        self.nearest.trim(&self.field);
    }

    /// Works out, once for each pixel within `part`, what the view asks of what is seen there.
    fn finish(&mut self, scene: &Scene, part: Bounds) {
        let (view, light) = (self.plan.view(), self.plan.light());
        self.roots_are_rough = !view.shows_roots();
        let counts = &mut self.plan.counts;
        if view.shows_roots() {
            let layer = &mut self.nearest.layer;
            finish::round_roots(&self.field, &scene.bodies, layer, part, counts);
        }
        if view == View::Shade {
            simd::dispatch(finish::Shading {
                field: &self.field,
                bodies: &scene.bodies,
                seen: &self.nearest.layer,
                light,
                part,
                value: &mut self.value,
                counts,
            });
        }
    }

    /// Where nothing is seen, what the lines within `part` meet behind the eye.
    fn find_what_is_behind(&mut self, scene: &Scene, eye: &Eye, part: Bounds) {
        let layer = &mut self.nearest.layer;
        for (number, body) in scene.bodies.iter().enumerate() {
            let known = self.memory.bounds()[number];
            if known.is_apart_from(part) || !eye.may_be_behind(&body.sphere) {
                continue;
            }
            let window = eye.window(&body.sphere, 1.0).within(part);
            for place in self.field.places_within(window) {
                if layer.body[place] == NOBODY {
                    let ray = self.field.ray(place);
                    let (answer, stages) = exact::solve_staged(&ray, &body.sphere);
                    self.plan.counts.note_solved(Some(stages.last()));
                    let contact = &mut layer.contact[place];
                    *contact = (*contact).max(Contact::of(&answer));
                }
            }
        }
    }
}

/// Bounds the spheres of a block.
struct Bounding<'a> {
    projector: &'a Projector,
    chunk: &'a [Body],
    block: &'a mut Block,
}

impl Kernel for Bounding<'_> {
    #[inline(always)]
    fn run(self) {
        self.projector.bound(self.chunk, self.block);
    }
}

/// Bounds the spheres of a block and asks about each where it can be seen.
struct Search<'a> {
    projector: &'a Projector,
    question: Question<'a>,
    /// The number of the block's first sphere, and its spheres.
    first: u32,
    chunk: &'a [Body],
    block: &'a mut Block,
    nearest: &'a mut Nearest,
    counts: &'a mut Counts,
}

impl Kernel for Search<'_> {
    #[inline(always)]
    fn run(self) {
        let Self {
            projector,
            question,
            block,
            nearest,
            counts,
            ..
        } = self;
        projector.bound(self.chunk, block);
        for i in 0..self.chunk.len() {
            let (bounds, least) = (block.bounds(i), block.least(i));
            if bounds.is_empty() {
                if block.is_behind(i) {
                    counts.behind += 1;
                } else {
                    counts.outside += 1;
                }
            } else if nearest.hides(bounds, least) {
                counts.hidden += 1;
            } else {
                let asked = (self.first + i as u32, bounds);
                ask(nearest, &question, projector, (block, i), asked, counts);
            }
        }
    }
}

/// Asks about sphere `i` of a block within `bounds`.
#[inline(always)]
fn ask(
    nearest: &mut Nearest,
    question: &Question,
    projector: &Projector,
    (block, i): (&Block, usize),
    (number, bounds): (u32, Bounds),
    counts: &mut Counts,
) {
    counts.asked += 1;
    let spans;
    let is_wide = Candidate::is_wide(bounds);
    let spans = if is_wide {
        spans = projector.spans(&question.bodies[number as usize].sphere);
        Some(&spans)
    } else {
        None
    };
    let candidate = Candidate {
        number,
        bounds,
        spans,
        least: block.least(i),
        single: block
            .single(i, projector.perspective)
            .filter(|_| question.field.ordinary()),
    };
    nearest.ask(question, &candidate, counts);
}
