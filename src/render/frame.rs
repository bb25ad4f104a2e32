//! The frame: for each pixel, which sphere is seen, at which root, and what the view shows of it.
//!
//! What the last frame found is kept where it still holds. What is asked again is decided in
//! [`super::plan`] and found by [`super::search`].

use std::sync::atomic::{AtomicU64, Ordering};

use glam::Vec3;

use super::View;
use super::acne::Acne;
use super::allowance::Allowance;
use super::bounds::Bounds;
use super::field::Field;
use super::finish::{Scope, finish};
use super::layer::Contact;
use super::memory::{MOST, Memory};
use super::plan::{Plan, Strategy};
use super::projected::is_before;
use super::projector::Projector;
use super::search::{Found, Members, Question, Room, Search, SearchPosition};
use super::shade;
use crate::method::Method;
use crate::method::exact::Stage;
use crate::scene::{Body, Rays, Scene, Size};

/// What is seen at a pixel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// The sphere's place in the scene's list.
    pub body: u32,
    /// The visible root, the least t > 0, as the method gave it; +∞ past the range of binary32.
    pub t: f32,
}

/// What a method lost of the visible root, held against the exact one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Lost {
    /// So many bits, 0 to 24: log₂ of the error in half ulps.
    Bits(f32),
    /// The method sees another sphere than there is, one where there is none, or none; a tangent
    /// for a secant or the reverse; a root that is wrongly infinite.
    Everything,
}

/// The answers for the pixels of one picture, in arrays that are kept from frame to frame.
///
/// A picture is the same in whatever order its spheres are asked: the least t wins, and of two
/// spheres at equal t the one listed first.
#[derive(Debug, Clone, Default)]
pub struct Frame {
    plan: Plan,
    field: Field,
    /// What the method sees.
    found: Found,
    /// What `exact` sees, where the view holds the method to it.
    truth: Found,
    /// Room to work in, and the numbers of the spheres in some parts of the picture.
    room: Room,
    there: Vec<u32>,
    /// The least and the greatest finite root seen.
    range: Option<[f32; 2]>,
    memory: Memory,
    /// Which of all pictures this is, and which one it differs from in nothing but its parts.
    edition: u64,
    differs_from: Option<u64>,
    /// The parts that are made, which have no pixel in common: the whole, or where spheres changed.
    parts: Vec<Bounds>,
    /// Whether they are the whole.
    is_whole: bool,
    stage: Work,
}

/// What a frame is at.
#[derive(Debug, Clone, Copy, Default)]
enum Work {
    /// What the method sees.
    Found(SearchPosition),
    /// What `exact` sees, to hold the method to it.
    Truth(SearchPosition),
    /// What the view shows of it, in this part from this row on.
    Finish(usize, i16),
    #[default]
    Done,
}

/// So many rows are finished at a time.
const BAND: i16 = 4;

/// Numbers all pictures of this process.
static EDITIONS: AtomicU64 = AtomicU64::new(1);

impl Frame {
    /// A frame of no pixels.
    pub fn new() -> Self {
        Self::default()
    }

    /// Asks `method` what the rays hit, and works out what the view shows of it. What the last frame
    /// found is kept where it still holds.
    pub fn render(&mut self, scene: &Scene, rays: &Rays, method: Method, view: View) {
        self.begin(scene, rays, method, view);
        self.go_on(scene, rays, &mut Allowance::endless());
    }

    /// Begins what [`Frame::render`] does; what was begun before is put away.
    pub fn begin(&mut self, scene: &Scene, rays: &Rays, method: Method, view: View) {
        if !self.is_done() {
            self.memory.forget();
        }
        let aimed = self.field.aim(rays);
        let constant_b = self.field.constant_b();
        let plan = Plan::new(scene, rays, constant_b, method, view);
        let same = !aimed && self.plan.asks_the_same(&plan);
        self.plan = plan;
        self.plan.counts.rays = if aimed { self.size().area() as u64 } else { 0 };
        if self.memory.find_changes(&scene.bodies, same) {
            self.begin_mending(scene, rays);
        } else {
            self.begin_whole(scene, rays);
        }
    }

    /// Goes on, while the allowance lasts, with what was begun for this scene and these rays; whether
    /// it is done. Until then nothing is to be asked of this frame.
    ///
    /// However often it is put down, what comes out is the same to the bit.
    pub fn go_on(&mut self, scene: &Scene, rays: &Rays, allowance: &mut Allowance) -> bool {
        while !self.is_done() && !allowance.is_used_up() {
            match self.stage {
                Work::Done => {}
                Work::Found(_) | Work::Truth(_) => self.go_on_searching(scene, rays, allowance),
                Work::Finish(part, row) => self.finish_rows(scene, (part, row), allowance),
            }
        }
        self.is_done()
    }

    /// Whether what was begun is done.
    pub const fn is_done(&self) -> bool {
        matches!(self.stage, Work::Done)
    }

    /// About which share of it is done, from 0 to 1.
    pub fn share_done(&self) -> f64 {
        let spheres = if self.is_whole {
            self.plan.spheres() as usize
        } else {
            self.there.len()
        };
        let searches = if self.plan.compares() { 2.0 } else { 1.0 };
        let searched = match self.stage {
            Work::Found(position) => position.share(spheres),
            Work::Truth(position) => 1.0 + position.share(spheres),
            Work::Finish(..) => searches,
            Work::Done => return 1.0,
        };
        0.95 * searched / searches
    }

    /// The range of depths; where it is another one, each pixel that is seen looks different.
    fn find_range(&mut self) {
        let before = self.range;
        self.range = (self.plan.view() == View::Depth)
            .then(|| range_of(&self.found.layer.t))
            .flatten();
        if self.range != before {
            self.differs_from = None;
        }
    }

    /// As [`Frame::render`], but asks about every sphere at every pixel: what `render` must equal,
    /// bit for bit.
    pub fn render_all(&mut self, scene: &Scene, rays: &Rays, method: Method, view: View) {
        self.field.aim(rays);
        self.plan = Plan::of_everything(scene, rays, method, view);
        self.begin_whole(scene, rays);
        self.go_on(scene, rays, &mut Allowance::endless());
    }

    /// Only works out where each sphere can be met, as the first part of a whole frame, and forgets it;
    /// how many can be. For measuring what planning costs.
    pub fn bound_only(&mut self, scene: &Scene, rays: &Rays, method: Method, view: View) -> usize {
        let plan = Plan::new(scene, rays, false, method, view);
        Question::new(&plan, &self.field, &scene.bodies, rays).bound(&mut self.room)
    }

    /// The whole picture from scratch.
    fn begin_whole(&mut self, scene: &Scene, rays: &Rays) {
        self.edition = EDITIONS.fetch_add(1, Ordering::Relaxed);
        self.differs_from = None;
        self.memory.forget();
        self.parts.clear();
        self.parts.push(Bounds::whole(rays.size));
        self.is_whole = true;
        self.begin_search(scene, rays);
    }

    /// Only the pixels where a sphere that changed was or is.
    fn begin_mending(&mut self, scene: &Scene, rays: &Rays) {
        let changes = self.memory.changes().len();
        let mut boxes = [Bounds::NONE; MOST];
        let mut parts = 0;
        let (projector, interest) = (Projector::new(rays), self.plan.interest());
        for i in 0..changes {
            let number = self.memory.changes()[i];
            let body = &scene.bodies[number as usize];
            let after = interest.window(&projector, &body.sphere).bounds;
            let before = self.memory.replace(number, body, after);
            for part in [before, after] {
                parts = add_apart(&mut boxes, parts, part);
            }
        }
        let parts = &boxes[..parts];
        let redone: u64 = parts.iter().map(|part| part.area()).sum();
        let all = self.size().area() as u64;
        if redone > all / 2 {
            self.begin_whole(scene, rays);
            return;
        }
        self.plan.counts.kept = all - redone;
        self.differs_from = Some(self.edition);
        self.edition = EDITIONS.fetch_add(1, Ordering::Relaxed);
        self.parts.clear();
        self.parts.extend(parts);
        self.is_whole = false;
        self.memory.find_within(parts, &mut self.there);
        self.begin_search(scene, rays);
    }

    fn begin_search(&mut self, scene: &Scene, rays: &Rays) {
        self.stage = Work::Found(SearchPosition::default());
        let question = Question::new(&self.plan, &self.field, &scene.bodies, rays);
        self.found
            .begin(&search(&question, self.is_whole, &self.there, &self.parts));
    }

    fn go_on_searching(&mut self, scene: &Scene, rays: &Rays, allowance: &mut Allowance) {
        let question = Question::new(&self.plan, &self.field, &scene.bodies, rays);
        let searched = search(&question, self.is_whole, &self.there, &self.parts);
        let checked = Search {
            question: question.of_exact(),
            ..searched
        };
        let (room, plan, memory) = (&mut self.room, &mut self.plan, &mut self.memory);
        match &mut self.stage {
            Work::Found(position) => {
                let learn = |bodies: &[Body], bounds: &[Bounds]| memory.learn(bodies, bounds);
                let (found, counts) = (&mut self.found, &mut plan.counts);
                if !found.go_on(&searched, position, room, counts, allowance, learn) {
                    return;
                }
                if self.is_whole {
                    memory.complete(&scene.bodies);
                }
                self.stage = if plan.compares() {
                    self.truth.begin(&checked);
                    Work::Truth(SearchPosition::default())
                } else {
                    Work::Finish(0, 0)
                };
            }
            Work::Truth(position) => {
                let (truth, counts) = (&mut self.truth, &mut plan.truth);
                let learn = |_: &[Body], _: &[Bounds]| ();
                if truth.go_on(&checked, position, room, counts, allowance, learn) {
                    self.stage = Work::Finish(0, 0);
                }
            }
            Work::Finish(..) | Work::Done => {}
        }
    }

    /// Whether the roots that are seen are only about where the method has them.
    fn roots_are_rough(&self) -> bool {
        self.plan.way() == Strategy::Certified && !self.plan.view().shows_roots()
    }

    /// Works out what the view shows of what was found in the next rows of a part.
    fn finish_rows(
        &mut self,
        scene: &Scene,
        (number, row): (usize, i16),
        allowance: &mut Allowance,
    ) {
        let Some(&part) = self.parts.get(number) else {
            self.stage = Work::Done;
            return self.find_range();
        };
        let top = row.max(part.top);
        let rows = Bounds {
            top,
            bottom: part.bottom.min(top.saturating_add(BAND - 1)),
            ..part
        };
        let scope = Scope {
            field: &self.field,
            bodies: &scene.bodies,
        };
        let work = |plan: &Plan| plan.counts.work() + plan.truth.work();
        let before = work(&self.plan);
        finish(
            scope,
            &mut self.plan,
            rows,
            &mut self.found,
            &mut self.truth,
        );
        allowance.spend(work(&self.plan) - before + rows.area() / 8);
        self.stage = if rows.bottom < part.bottom {
            Work::Finish(number, rows.bottom + 1)
        } else {
            Work::Finish(number + 1, 0)
        };
    }

    /// Which of all pictures this is.
    pub(super) const fn edition(&self) -> u64 {
        self.edition
    }

    /// Where this picture differs from the one of that edition; none if it may differ anywhere.
    pub(super) fn parts_changed_since(&self, edition: u64) -> Option<&[Bounds]> {
        if edition == self.edition {
            Some(&[])
        } else if self.differs_from == Some(edition) {
            Some(&self.parts)
        } else {
            None
        }
    }

    /// What was asked for this frame, and what was left out and why.
    pub const fn plan(&self) -> &Plan {
        &self.plan
    }

    /// The size of the picture.
    pub fn size(&self) -> Size {
        self.field.size()
    }

    /// The view for which the frame was rendered.
    pub const fn view(&self) -> View {
        self.plan.view()
    }

    fn index(&self, x: u32, y: u32) -> Option<usize> {
        let Size { width, height } = self.size();
        (x < width && y < height).then(|| self.field.place(x, y))
    }

    /// The place in the scene's list of the sphere that is seen at pixel (x, y), if one is.
    pub fn seen(&self, x: u32, y: u32) -> Option<u32> {
        self.found.layer.seen(self.index(x, y)?)
    }

    /// The nearest visible hit at pixel (x, y), if there is one; nothing outside the picture.
    ///
    /// Where the view shows no roots the method is asked for this one, in the `scene` that the frame
    /// was rendered from.
    pub fn hit(&self, scene: &Scene, x: u32, y: u32) -> Option<Hit> {
        let body = self.seen(x, y)?;
        let place = self.index(x, y)?;
        let t = if self.roots_are_rough() {
            let sphere = &scene.bodies.get(body as usize)?.sphere;
            let ray = self.field.ray(place);
            self.plan.method().solve(&ray, sphere).visible()?
        } else {
            self.found.layer.t[place]
        };
        Some(Hit { body, t })
    }

    /// What the line of pixel (x, y) does; a miss outside the picture.
    ///
    /// Only [`View::Class`] tells what is behind the eye; for the other views it is a miss.
    pub fn contact(&self, x: u32, y: u32) -> Contact {
        self.index(x, y)
            .map_or(Contact::Miss, |i| self.found.layer.contact(i))
    }

    fn value(&self, view: View, x: u32, y: u32) -> Option<f32> {
        let i = self.index(x, y)?;
        (self.plan.view() == view).then(|| self.found.value[i])
    }

    /// How bright the hit at pixel (x, y) is, from 0 to 1; 0 where nothing is hit, and in views
    /// without shades.
    pub fn brightness(&self, x: u32, y: u32) -> f32 {
        self.value(View::Shade, x, y).unwrap_or(0.0)
    }

    /// Δ/(4Ar²) of the sphere seen at pixel (x, y), else the greatest of all; nothing where every
    /// line passes at twice the radius or more, and in other views.
    pub fn delta(&self, x: u32, y: u32) -> Option<f32> {
        let delta = self.value(View::Delta, x, y)?;
        (delta > f32::NEG_INFINITY).then_some(delta)
    }

    /// What the method lost of the visible root at pixel (x, y); nothing where nothing is to be
    /// seen, and in other views.
    pub fn lost(&self, x: u32, y: u32) -> Option<Lost> {
        let lost = self.value(View::Lost, x, y)?;
        if lost == f32::INFINITY {
            Some(Lost::Everything)
        } else {
            self.seen(x, y).map(|_| Lost::Bits(lost))
        }
    }

    /// The slowest stage of `exact` that pixel (x, y) needed, for the classes of all spheres and
    /// for the visible root; nothing in other views.
    pub fn stage(&self, x: u32, y: u32) -> Option<Stage> {
        let place = self.value(View::Stage, x, y)?;
        Stage::ALL.get(place as usize).copied()
    }

    /// Where the computed point at pixel (x, y) lies and what a mirrored ray from there meets; nothing where
    /// nothing is seen, and in other views.
    pub fn acne(&self, scene: &Scene, x: u32, y: u32) -> Option<Acne> {
        if self.view() != View::Acne {
            return None;
        }
        let i = self.index(x, y)?;
        let Hit { body, t } = self.hit(scene, x, y)?;
        let place = self.found.layer.contact(i).place();
        let sphere = &scene.bodies.get(body as usize)?.sphere;
        Acne::of(self.plan.method(), &self.field.ray(i), sphere, (t, place))
    }

    /// The unit normal at pixel (x, y) on the side that is seen, along the axes of the screen:
    /// right, up, towards the eye. Nothing where no sphere is seen, and for a point sphere.
    pub fn normal(&self, scene: &Scene, x: u32, y: u32) -> Option<Vec3> {
        let camera = self.field.camera()?;
        let i = self.index(x, y)?;
        let hit = shade::Hit {
            method: self.plan.method(),
            ray: &self.field.ray(i),
            sphere: &scene.bodies.get(self.seen(x, y)? as usize)?.sphere,
            t: self.found.layer.t[i],
            place: self.found.layer.contact(i).place(),
        };
        let normal = hit.normal().try_normalize()?;
        let axes = [camera.right, -camera.down, -camera.direction];
        let along = axes.map(|axis| axis.normalize().dot(normal) as f32);
        Some(along.into()).filter(|n: &Vec3| n.is_finite())
    }

    /// How near `t` is among the roots that [`View::Depth`] shows, by its logarithm: 1 for the
    /// nearest, 0 for the farthest.
    pub fn nearness(&self, t: f32) -> f32 {
        let Some([nearest, farthest]) = self.range else {
            return 0.0;
        };
        let whole = (farthest / nearest).log2();
        let part = (farthest / t).log2();
        if whole > 0.0 {
            (part / whole).clamp(0.0, 1.0)
        } else {
            1.0
        }
    }

    /// The nearest and the farthest root that [`View::Depth`] shows, those at ∞ apart.
    pub const fn range(&self) -> Option<[f32; 2]> {
        self.range
    }

    /// Whether pixel (x, y) is an edge of what is seen there: whether a neighbour shows something
    /// else that is farther away. So an edge is one pixel wide and belongs to the nearer sphere.
    pub fn outline(&self, scene: &Scene, x: u32, y: u32) -> bool {
        self.seen(x, y).is_some()
            && [
                (x.wrapping_sub(1), y),
                (x + 1, y),
                (x, y.wrapping_sub(1)),
                (x, y + 1),
            ]
            .into_iter()
            .any(|there| self.is_beyond(scene, there, (x, y)))
    }

    /// Whether one pixel shows something else than another, and farther away.
    fn is_beyond(&self, scene: &Scene, there: (u32, u32), here: (u32, u32)) -> bool {
        let [Some(i), Some(j)] = [there, here].map(|(x, y)| self.index(x, y)) else {
            return false;
        };
        let layer = &self.found.layer;
        let [there_is, here_is] = [i, j].map(|place| (layer.t[place], layer.seen(place)));
        if there_is.1 == here_is.1 {
            return false;
        }
        if there_is.1.is_none() {
            return true;
        }
        if self.plan.roots_tell_depths() {
            if is_before(here_is.0, there_is.0) {
                return true;
            }
            if is_before(there_is.0, here_is.0) {
                return false;
            }
        }
        // About as far away as each other: only the method can tell.
        let order = |(x, y): (u32, u32)| self.hit(scene, x, y).map(|hit| (hit.t, hit.body));
        order(there) > order(here)
    }
}

/// What a frame searches: for all spheres, or for those that are `there` in its parts.
const fn search<'a>(
    question: &Question<'a>,
    is_whole: bool,
    there: &'a [u32],
    parts: &'a [Bounds],
) -> Search<'a> {
    Search {
        question: *question,
        members: if is_whole {
            Members::All
        } else {
            Members::These(there)
        },
        parts,
    }
}

/// Adds a box to the first so many, which have no pixel in common, so that this stays so: those that it
/// meets it swallows. How many there are then; without room for another one it joins one of them.
fn add_apart(boxes: &mut [Bounds], mut count: usize, mut part: Bounds) -> usize {
    if part.is_empty() {
        return count;
    }
    while let Some(i) = boxes[..count]
        .iter()
        .position(|other| count == boxes.len() || !other.is_apart_from(part))
    {
        part = part.union(boxes[i]);
        count -= 1;
        boxes.swap(i, count);
    }
    boxes[count] = part;
    count + 1
}

/// The least and the greatest number that is finite and has a logarithm.
fn range_of(t: &[f32]) -> Option<[f32; 2]> {
    let finite = || t.iter().copied().filter(|&t| t.is_finite() && t > 0.0);
    Some([finite().reduce(f32::min)?, finite().reduce(f32::max)?])
}
