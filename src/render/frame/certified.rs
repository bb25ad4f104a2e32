//! Frames of `exact`: asked where a sphere can be seen, by a certified test, and finished once for
//! each pixel.

use super::Frame;
use crate::method::exact;
use crate::method::simd::{self, Kernel};
use crate::render::View;
use crate::render::bounds::Eye;
use crate::render::cover::{Bounds, Projector};
use crate::render::crowd::{CROWD, Crowd, Lens};
use crate::render::finish;
use crate::render::layer::{Contact, NOBODY};
use crate::render::nearest::{Candidate, Nearest, Question};
use crate::render::plan::{Counts, Way};
use crate::scene::{Body, Rays, Scene};

impl Frame {
    /// The whole picture.
    pub(super) fn start_certified(&mut self, scene: &Scene, rays: &Rays) {
        let eye = (self.plan.view() == View::Class).then(|| Eye::new(rays));
        self.find_nearest(scene, rays);
        if let Some(eye) = &eye {
            // What is not wholly ahead is seen behind the eye, too.
            for (number, body) in scene.bodies.iter().enumerate() {
                if eye.may_be_behind(&body.sphere) {
                    self.memory.add(number, eye.window(&body.sphere, 1.0));
                }
            }
        }
        self.value.clear();
        self.value.resize(self.field.places(), 0.0);
        let whole = Bounds::whole(rays.size);
        self.finish(scene, whole);
        if let Some(eye) = eye {
            self.find_what_is_behind(scene, &eye, whole);
        }
    }

    /// The pixels within `part`.
    pub(super) fn redo_certified(&mut self, scene: &Scene, rays: &Rays, part: Bounds) {
        self.find_nearest_within(scene, rays, part);
        self.finish(scene, part);
        if self.plan.view() == View::Class {
            self.find_what_is_behind(scene, &Eye::new(rays), part);
        }
    }

    /// Asks for the nearest hits of the whole picture.
    pub(super) fn find_nearest(&mut self, scene: &Scene, rays: &Rays) {
        self.nearest.clear(&self.field);
        let projector = Projector::new(rays);
        let lens = Lens::new(rays, &projector);
        for (first, bodies) in (0..).step_by(CROWD).zip(scene.bodies.chunks(CROWD)) {
            simd::dispatch(Search {
                projector: &projector,
                lens: &lens,
                question: Question {
                    field: &self.field,
                    bodies: &scene.bodies,
                    roots: self.plan.roots_tell_depths(),
                },
                members: Members::Run(first),
                count: bodies.len(),
                part: Bounds::whole(rays.size),
                crowd: &mut self.crowd,
                nearest: &mut self.nearest,
                counts: &mut self.plan.counts,
            });
            if self.plan.way() == Way::Certified {
                self.memory.learn(bodies, &self.crowd.bounds);
            }
        }
        self.nearest.trim(&self.field);
    }

    /// How many spheres can be seen, were it not for others.
    pub(super) fn bound_certified(&mut self, scene: &Scene, rays: &Rays) -> usize {
        let projector = Projector::new(rays);
        let lens = Lens::new(rays, &projector);
        let mut seen = 0;
        for spheres in scene.bodies.chunks(CROWD) {
            simd::dispatch(Gathering {
                projector: &projector,
                lens: &lens,
                spheres,
                part: Bounds::whole(rays.size),
                crowd: &mut self.crowd,
            });
            seen += self.crowd.in_order().len();
        }
        seen
    }

    /// Asks again for the nearest hits within `part`.
    pub(super) fn find_nearest_within(&mut self, scene: &Scene, rays: &Rays, part: Bounds) {
        self.nearest.reopen(&self.field, part);
        let projector = Projector::new(rays);
        let lens = Lens::new(rays, &projector);
        let mut there = std::mem::take(&mut self.there);
        self.memory.find_within(part, &mut there);
        for numbers in there.chunks(CROWD) {
            simd::dispatch(Search {
                projector: &projector,
                lens: &lens,
                question: Question {
                    field: &self.field,
                    bodies: &scene.bodies,
                    roots: self.plan.roots_tell_depths(),
                },
                members: Members::These(numbers),
                count: numbers.len(),
                part,
                crowd: &mut self.crowd,
                nearest: &mut self.nearest,
                counts: &mut self.plan.counts,
            });
        }
        self.there = there;
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
            let known = self.memory.bounds(number);
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

/// Bounds some spheres and puts them in order.
struct Gathering<'a> {
    projector: &'a Projector,
    lens: &'a Lens,
    spheres: &'a [Body],
    part: Bounds,
    crowd: &'a mut Crowd,
}

impl Kernel for Gathering<'_> {
    #[inline(always)]
    fn run(self) {
        let (lenses, count) = ((self.lens, self.projector), self.spheres.len());
        let sphere = |i: usize| &self.spheres[i].sphere;
        let mut counts = Counts::default();
        self.crowd
            .gather(lenses, count, sphere, self.part, &mut counts);
    }
}

/// Which spheres of the scene a crowd is made of.
#[derive(Clone, Copy)]
enum Members<'a> {
    /// Those from this number on.
    Run(u32),
    /// Those of these numbers.
    These(&'a [u32]),
}

/// Bounds some spheres and asks about each where it can be seen.
struct Search<'a> {
    projector: &'a Projector,
    lens: &'a Lens,
    question: Question<'a>,
    members: Members<'a>,
    count: usize,
    part: Bounds,
    crowd: &'a mut Crowd,
    nearest: &'a mut Nearest,
    counts: &'a mut Counts,
}

impl Kernel for Search<'_> {
    #[inline(always)]
    fn run(mut self) {
        let (lenses, bodies) = ((self.lens, self.projector), self.question.bodies);
        let crowd = &mut *self.crowd;
        match self.members {
            Members::Run(first) => {
                let bodies = &bodies[first as usize..][..self.count];
                let sphere = |i: usize| &bodies[i].sphere;
                crowd.gather(lenses, self.count, sphere, self.part, self.counts);
            }
            Members::These(numbers) => {
                let sphere = |i: usize| &bodies[numbers[i] as usize].sphere;
                // Not outside the picture, but where nothing changed.
                let mut counts = Counts::default();
                crowd.gather(lenses, self.count, sphere, self.part, &mut counts);
            }
        }
        match (self.question.field.perspective(), self.question.roots) {
            (true, true) => self.ask_all::<true, true>(),
            (true, false) => self.ask_all::<true, false>(),
            (false, true) => self.ask_all::<false, true>(),
            (false, false) => self.ask_all::<false, false>(),
        }
    }
}

impl Search<'_> {
    /// Asks about the spheres of the crowd that nothing hides.
    #[inline(always)]
    fn ask_all<const PERSPECTIVE: bool, const ROOTS: bool>(&mut self) {
        for place in 0..self.crowd.in_order().len() {
            let i = self.crowd.in_order()[place] as usize;
            let (bounds, least) = (self.crowd.bounds[i], self.crowd.least[i]);
            if self.nearest.hides(self.question.field, bounds, least) {
                self.counts.hidden += 1;
            } else {
                let number = match self.members {
                    Members::Run(first) => first + i as u32,
                    Members::These(numbers) => numbers[i],
                };
                self.ask::<PERSPECTIVE, ROOTS>(number, bounds, least);
            }
        }
    }

    /// Asks about a sphere within `bounds`.
    #[inline(always)]
    fn ask<const PERSPECTIVE: bool, const ROOTS: bool>(
        &mut self,
        number: u32,
        bounds: Bounds,
        least: f32,
    ) {
        self.counts.asked += 1;
        let sphere = &self.question.bodies[number as usize].sphere;
        let spans;
        let spans = if Candidate::is_wide(bounds) {
            spans = self.projector.spans(sphere);
            Some(&spans)
        } else {
            None
        };
        let candidate = Candidate {
            number,
            bounds,
            spans,
            least,
            single: self
                .lens
                .single::<PERSPECTIVE>(sphere, least)
                .filter(|_| self.question.field.ordinary()),
        };
        self.nearest
            .ask::<PERSPECTIVE, ROOTS>(&self.question, &candidate, self.counts);
    }
}
