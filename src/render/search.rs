//! The search: which sphere each pixel sees, for any method and view.
//!
//! Of each sphere, from front to back, it looks at the window of pixels that can meet it, and asks there: by
//! the certified test in binary32, which leaves to `exact` what it is not sure of, or the method itself, in
//! arrays. docs/plan.md has the proofs.

#![expect(
    clippy::needless_bitwise_bool,
    reason = "a comparison that may be skipped is a branch, and a loop with branches is not compiled to vectors"
)]

use std::array::from_fn;
use std::cmp::Ordering;
use std::ops::RangeInclusive;

use super::allowance::Allowance;
use super::bounds::Bounds;
use super::delta::{FARTHEST_MISS, normalised_discriminant};
use super::field::{Field, TILE};
use super::lanes::{SINGLES, cross, dot, sub};
use super::layer::{Layer, refill};
use super::plan::{Counts, Interest, Plan, Strategy};
use super::projected::{Projected, SAME, is_before};
use super::projector::{Projector, Reach, Spans};
use super::view::View;
use super::windows::{Lens, MOST, Windows};
use crate::geometry::Sphere;
use crate::method::batch::Solutions;
use crate::method::simd::{self, Kernel};
use crate::method::{Method, Solution, exact};
use crate::scene::{Body, Rays};

/// After this many runs of a tile changed, its bound is worked out again.
const STALE: u32 = 8;

/// From this width on a sphere's columns are worked out row by row.
const WORTH_SPANS: i16 = 16;

/// What is asked: which of these spheres the rays of a field meet, by a method.
#[derive(Clone, Copy)]
pub(super) struct Question<'a> {
    pub field: &'a Field,
    pub bodies: &'a [Body],
    pub method: Method,
    interest: Interest,
    /// Whether spheres are told apart by a root; else by where the ray comes closest to the centre,
    /// since no two of them have a point in common.
    roots: bool,
    projector: Projector,
    lens: Lens,
}

impl<'a> Question<'a> {
    /// The question of a plan.
    pub(super) fn new(plan: &Plan, field: &'a Field, bodies: &'a [Body], rays: &Rays) -> Self {
        let projector = Projector::new(rays);
        Self {
            field,
            bodies,
            method: plan.method(),
            interest: plan.interest(),
            roots: plan.roots_tell_depths(),
            projector,
            lens: Lens::new(&projector),
        }
    }

    /// The same asked of `exact`, to hold the method to it.
    pub(super) fn of_exact(self) -> Self {
        let way = match self.interest.way {
            Strategy::Everything if !matches!(self.method, Method::Unit | Method::Routine(_)) => {
                Strategy::Everything
            }
            _ => Strategy::Certified,
        };
        Self {
            method: Method::Exact,
            interest: Interest {
                way,
                ..self.interest
            },
            ..self
        }
    }

    /// Only finds out where each sphere can be met; how many can be.
    pub(super) fn bound(&self, room: &mut Room) -> usize {
        let whole = Bounds::whole(self.projector.size);
        let mut seen = 0;
        for bodies in self.bodies.chunks(MOST) {
            let mut counts = Counts::default();
            let windows = &mut room.windows;
            simd::dispatch(Gathering {
                question: self,
                bodies,
                part: whole,
                windows,
                counts: &mut counts,
            });
            seen += windows.in_order().len();
        }
        seen
    }

    fn is_certified(&self) -> bool {
        self.interest.way == Strategy::Certified
    }

    fn sphere(&self, number: u32) -> &'a Sphere {
        &self.bodies[number as usize].sphere
    }

    /// How what the method answered about one sphere compares with what is seen at `place`, in the order of
    /// roots and, where these are equal, of the list.
    fn order(
        &self,
        place: usize,
        (asked, answer): (u32, &Solution),
        (seen, found): (u32, SeenRoot),
        counts: &mut Counts,
    ) -> Ordering {
        let by_number = asked.cmp(&seen);
        let t = answer.visible().unwrap_or(f32::INFINITY);
        if self.method != Method::Exact {
            return t.total_cmp(&found.t).then(by_number);
        }
        if is_before(t, found.t) || found.is_exact && t < found.t {
            return Ordering::Less;
        }
        if is_before(found.t, t) || found.is_exact && t > found.t {
            return Ordering::Greater;
        }
        let [one, other] = [self.sphere(asked), self.sphere(seen)];
        if one == other {
            return by_number;
        }
        let ray = self.field.ray(place);
        let (of_other, stages) = exact::solve_staged(&ray, other);
        counts.note_solved(Some(stages.last()));
        counts.ties += u64::from(answer.visible() == of_other.visible());
        let order = self.method.order(&ray, (one, *answer), (other, of_other));
        order.then(by_number)
    }
}

/// The root of what is seen, and whether it is the method's own.
#[derive(Clone, Copy)]
struct SeenRoot {
    t: f32,
    is_exact: bool,
}

/// Which spheres of the scene are asked about.
#[derive(Clone, Copy)]
pub(super) enum Members<'a> {
    /// All of them.
    All,
    /// Those of these numbers.
    These(&'a [u32]),
}

impl Members<'_> {
    const fn count(&self, bodies: &[Body]) -> usize {
        match self {
            Self::All => bodies.len(),
            Self::These(numbers) => numbers.len(),
        }
    }
}

/// What is searched: for these spheres, within parts of the picture that have no pixel in common.
#[derive(Clone, Copy)]
pub(super) struct Search<'a> {
    pub question: Question<'a>,
    pub members: Members<'a>,
    pub parts: &'a [Bounds],
}

impl Search<'_> {
    fn count(&self) -> usize {
        self.members.count(self.question.bodies)
    }
}

/// How far a search has come: with the room, all that it needs to go on.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct SearchPosition {
    /// The first of the spheres that are asked about together; whether their windows are in the room.
    first: usize,
    is_gathered: bool,
    /// Which of them in their order is next, in which part and, if it was begun there, from which row on.
    place: usize,
    part: usize,
    row: Option<i16>,
    /// What came of it in the parts before, and the rows and spheres around the eye before it.
    was_asked: bool,
    was_hidden: bool,
    before: [u64; 2],
    /// The sphere that was last asked about.
    last: Option<u32>,
}

impl SearchPosition {
    /// Which share of the spheres is done with.
    pub(super) fn share(&self, spheres: usize) -> f64 {
        (self.first + self.place) as f64 / spheres.max(1) as f64
    }

    fn is_inside_a_sphere(&self) -> bool {
        self.part > 0 || self.row.is_some()
    }
}

/// Room to work in, kept from frame to frame.
#[derive(Debug, Clone, Default)]
pub(super) struct Room {
    windows: Windows,
    answers: Solutions,
}

/// What a search found: for each pixel the sphere that is seen so far, and at which root.
///
/// Where the certified test found it t is a root to within 2⁻¹³ of itself, or another point within the
/// sphere if no two spheres meet.
#[derive(Debug, Clone, Default)]
pub(super) struct Found {
    pub(super) layer: Layer,
    /// What a view that tells of more than what is seen notes of each pixel: Δ/(4Ar²), the place of the
    /// stage among all. For the other views what they show, once all is found.
    pub(super) value: Vec<f32>,
    tiles: Tiles,
}

/// For each tile an upper bound of its roots. Roots only fall, so a stale bound is still one.
#[derive(Debug, Clone, Default)]
struct Tiles {
    across: usize,
    far: Vec<f32>,
    changed: Vec<u32>,
}

/// One sphere, and where to ask about it.
struct Candidate<'a> {
    /// Its place in the list of bodies.
    number: u32,
    sphere: &'a Sphere,
    /// The pixels that can meet it.
    bounds: Bounds,
    /// Which columns of them in each row, if that is worked out.
    spans: Option<Spans>,
    /// No visible root is below this.
    least: f32,
    /// The row to begin with.
    from: i16,
    /// Once the method was asked so often, the rest waits.
    enough: u64,
}

impl Candidate<'_> {
    fn rows(&self) -> RangeInclusive<i16> {
        self.from..=self.bounds.bottom
    }

    /// Whether it is wide enough for the rows' own quadratics to pay.
    const fn is_wide(bounds: Bounds) -> bool {
        bounds.right - bounds.left >= WORTH_SPANS
    }

    #[inline(always)]
    fn columns(&self, y: i16) -> [i16; 2] {
        match &self.spans {
            Some(spans) => spans.at(y, self.bounds),
            None => [self.bounds.left, self.bounds.right],
        }
    }
}

impl Found {
    /// Forgets what a search will find again.
    pub(super) fn begin(&mut self, search: &Search) {
        match search.members {
            Members::All => self.clear(&search.question),
            Members::These(_) => {
                for &part in search.parts {
                    self.reopen(&search.question, part);
                }
            }
        }
    }

    /// Goes on with a search while the allowance lasts; whether it is done. `learn` is told where all of
    /// some spheres can be met.
    pub(super) fn go_on(
        &mut self,
        search: &Search,
        position: &mut SearchPosition,
        room: &mut Room,
        counts: &mut Counts,
        allowance: &mut Allowance,
        mut learn: impl FnMut(&[Body], &[Bounds]),
    ) -> bool {
        let all = search.count();
        while position.first < all {
            let count = MOST.min(all - position.first);
            simd::dispatch(Chunk {
                search,
                count,
                position,
                room,
                found: self,
                counts,
                allowance,
            });
            if position.place < room.windows.in_order().len() {
                return false;
            }
            if matches!(search.members, Members::All) {
                let bodies = &search.question.bodies[position.first..][..count];
                learn(bodies, &room.windows.bounds);
            }
            *position = SearchPosition {
                first: position.first + count,
                ..SearchPosition::default()
            };
        }
        self.trim(search.question.field);
        true
    }

    /// What a pixel has that no sphere was asked about.
    fn nothing(question: &Question) -> f32 {
        match question.interest.view {
            View::Delta => f32::NEG_INFINITY,
            _ => 0.0,
        }
    }

    /// Nothing is seen yet in a picture of the size of the field.
    fn clear(&mut self, question: &Question) {
        let field = question.field;
        self.layer.clear_all(field.places());
        refill(&mut self.value, field.places(), Self::nothing(question));
        self.tiles.across = field.stride() / TILE;
        let tiles = self.tiles.across * (field.size().height as usize).div_ceil(TILE);
        refill(&mut self.tiles.far, tiles, f32::INFINITY);
        refill(&mut self.tiles.changed, tiles, 0);
    }

    /// Forgets what was found within `part`.
    fn reopen(&mut self, question: &Question, part: Bounds) {
        for y in part.top..=part.bottom {
            let run = question.field.run(y, [part.left, part.right]);
            self.value[run.clone()].fill(Self::nothing(question));
            self.layer.clear_run(run);
            let tiles = y as usize / TILE * self.tiles.across;
            let run = tiles + part.left as usize / TILE..=tiles + part.right as usize / TILE;
            self.tiles.far[run].fill(f32::INFINITY);
        }
    }

    /// Forgets what was found for places beyond the right edge.
    fn trim(&mut self, field: &Field) {
        let (width, stride) = (field.size().width as usize, field.stride());
        if width < stride {
            for row in 0..field.size().height as usize {
                self.layer
                    .clear_run(row * stride + width..(row + 1) * stride);
            }
        }
    }

    /// Whether everything seen within `bounds` is nearer than `least`.
    #[inline(always)]
    fn hides(&self, field: &Field, bounds: Bounds, least: f32) -> bool {
        if !is_small(bounds) {
            self.hides_tiles(bounds, least)
        } else if bounds.right - bounds.left < SINGLES as i16 / 2 {
            self.hides_runs::<{ SINGLES / 2 }>(field, bounds, least)
        } else {
            self.hides_runs::<SINGLES>(field, bounds, least)
        }
    }

    /// The same of bounds that are at most `N` columns wide, pixel by pixel.
    #[inline(always)]
    fn hides_runs<const N: usize>(&self, field: &Field, bounds: Bounds, least: f32) -> bool {
        let bar = bar(least);
        let x = (bounds.left as usize).min(field.stride() - N);
        let mut open = [0; N];
        for y in bounds.top..=bounds.bottom {
            let place = y as usize * field.stride() + x;
            let seen = &self.layer.t[place..place + N];
            for l in 0..N {
                open[l] |= u32::from(seen[l] >= bar);
            }
        }
        !any(&open)
    }

    /// The same by the bounds of the tiles.
    fn hides_tiles(&self, bounds: Bounds, least: f32) -> bool {
        self.tiles
            .within(bounds)
            .all(|tile| is_before(self.tiles.far[tile], least))
    }

    /// Whether everything seen within `bounds` is nearer than a sphere around the eye can be.
    fn hides_around(&self, question: &Question, sphere: &Sphere, bounds: Bounds) -> bool {
        let inner = question.projector.inner(sphere) as f32;
        inner > 0.0
            && self
                .tiles
                .within(bounds)
                .all(|tile| is_before(self.tiles.far[tile] * question.field.longest(tile), inner))
    }

    /// Notes that a run of a tile changed, and after some looks how far the farthest root in it still is.
    #[inline(always)]
    fn note_change(&mut self, tile: usize, changed: bool) {
        let count = &mut self.tiles.changed[tile];
        *count += u32::from(changed);
        if *count >= STALE {
            self.measure(tile);
        }
    }

    #[inline(never)]
    fn measure(&mut self, tile: usize) {
        let stride = self.tiles.across * TILE;
        let first = tile / self.tiles.across * TILE * stride + tile % self.tiles.across * TILE;
        let mut far = [0.0_f32; TILE];
        for row in self.layer.t[first..].chunks(stride).take(TILE) {
            for (far, &t) in far.iter_mut().zip(row) {
                *far = if t > *far { t } else { *far };
            }
        }
        self.tiles.far[tile] = far.into_iter().fold(0.0, f32::max);
        self.tiles.changed[tile] = 0;
    }

    /// Notes what the method answered about a sphere at a pixel; whether that is now what is seen there.
    fn note(
        &mut self,
        question: &Question,
        place: usize,
        (asked, answer): (u32, &Solution),
        counts: &mut Counts,
    ) -> bool {
        let found = SeenRoot {
            t: self.layer.t[place],
            is_exact: self.layer.is_asked(place),
        };
        let also_behind = question.interest.view == View::Class;
        self.layer.note(place, asked, answer, also_behind, |seen| {
            let seen = (seen, found);
            question.order(place, (asked, answer), seen, counts).is_lt()
        })
    }

    /// Asks `exact` itself at the open places of a patch; whether any of them now sees this sphere.
    #[cold]
    #[inline(never)]
    fn ask_exact<const N: usize>(
        &mut self,
        question: &Question,
        asked: u32,
        places: [usize; N],
        open: [u32; N],
        counts: &mut Counts,
    ) -> bool {
        let mut changed = false;
        for l in (0..N).filter(|&l| open[l] != 0) {
            let place = places[l];
            if !question.field.is_pixel(place) || self.layer.seen(place) == Some(asked) {
                continue;
            }
            let ray = question.field.ray(place);
            let (answer, stages) = exact::solve_staged(&ray, question.sphere(asked));
            counts.note_solved(Some(stages.last()));
            changed |= self.note(question, place, (asked, &answer), counts);
        }
        changed
    }

    /// Asks the method itself, row by row; the row to go on from, if it was asked enough for now.
    #[inline(never)]
    fn ask_method(
        &mut self,
        question: &Question,
        candidate: &Candidate,
        answers: &mut Solutions,
        counts: &mut Counts,
    ) -> Option<i16> {
        let (field, bar) = (question.field, bar(candidate.least));
        let mut changed = false;
        let mut stopped = None;
        for y in candidate.rows() {
            if counts.solved >= candidate.enough {
                stopped = Some(y);
                break;
            }
            let columns = candidate.columns(y);
            let run = field.run(y, columns);
            if run.is_empty() {
                continue;
            }
            counts.note_rows(1, columns);
            if question.is_certified() && self.layer.t[run.clone()].iter().all(|&t| t < bar) {
                counts.hidden_runs += run.len().div_ceil(SINGLES) as u64;
                continue;
            }
            if question.interest.view == View::Stage {
                run.for_each(|place| self.ask_stage(question, candidate, place, counts));
                continue;
            }
            field.ask(question.method, candidate.sphere, run.clone(), answers);
            counts.note_answers(answers);
            for (i, place) in run.enumerate() {
                let answer = answers.get(i);
                let is_seen = self.note(question, place, (candidate.number, &answer), counts);
                changed |= is_seen;
                counts.roots += u64::from(!question.is_certified() && answer.class.meets());
                if question.interest.view == View::Delta {
                    self.note_delta(question, candidate, place, &answer, is_seen);
                }
            }
        }
        if changed && question.is_certified() && !is_small(candidate.bounds) {
            for tile in self.tiles.within(candidate.bounds) {
                self.measure(tile);
            }
        }
        stopped
    }

    /// Asks `exact` and notes which stage was sure of the class.
    fn ask_stage(
        &mut self,
        question: &Question,
        candidate: &Candidate,
        place: usize,
        counts: &mut Counts,
    ) {
        let ray = question.field.ray(place);
        let (answer, stages) = exact::solve_staged(&ray, candidate.sphere);
        counts.note_solved(Some(stages.last()));
        counts.roots += u64::from(answer.class.meets());
        self.value[place] = self.value[place].max(stages.class as u8 as f32);
        self.note(question, place, (candidate.number, &answer), counts);
    }

    /// Notes Δ/(4Ar²) of what is seen, else the greatest of all.
    fn note_delta(
        &mut self,
        question: &Question,
        candidate: &Candidate,
        place: usize,
        answer: &Solution,
        is_seen: bool,
    ) {
        let ray = question.field.ray(place);
        let sphere = candidate.sphere;
        let delta = normalised_discriminant(question.method, &ray, sphere, answer.class);
        if is_seen {
            self.value[place] = delta;
        } else if self.layer.seen(place).is_none() && delta > FARTHEST_MISS {
            self.value[place] = self.value[place].max(delta);
        }
    }
}

impl Tiles {
    /// The tiles with a pixel in `bounds`.
    fn within(&self, bounds: Bounds) -> impl Iterator<Item = usize> + use<> {
        let [left, right] = [bounds.left as usize / TILE, bounds.right as usize / TILE];
        let across = self.across;
        let rows = bounds.top as usize / TILE..=bounds.bottom as usize / TILE;
        rows.flat_map(move |row| (left..=right).map(move |column| row * across + column))
    }
}

/// Some spheres to find the windows of.
struct Gathering<'a> {
    question: &'a Question<'a>,
    bodies: &'a [Body],
    part: Bounds,
    windows: &'a mut Windows,
    counts: &'a mut Counts,
}

impl Kernel for Gathering<'_> {
    #[inline(always)]
    fn run(self) {
        let Question {
            lens,
            projector,
            interest,
            ..
        } = self.question;
        let sphere = |i: usize| &self.bodies[i].sphere;
        let count = self.bodies.len();
        self.windows.gather(
            (lens, projector),
            *interest,
            count,
            sphere,
            self.part,
            self.counts,
        );
    }
}

/// Some spheres to find the windows of and to ask about, or to go on with.
struct Chunk<'a> {
    search: &'a Search<'a>,
    count: usize,
    position: &'a mut SearchPosition,
    room: &'a mut Room,
    found: &'a mut Found,
    counts: &'a mut Counts,
    allowance: &'a mut Allowance,
}

impl Kernel for Chunk<'_> {
    #[inline(always)]
    fn run(mut self) {
        if !self.position.is_gathered {
            self.gather();
        }
        let question = &self.search.question;
        match (question.field.perspective(), question.roots) {
            (true, true) => self.ask_all::<true, true>(),
            (true, false) => self.ask_all::<true, false>(),
            (false, true) => self.ask_all::<false, true>(),
            (false, false) => self.ask_all::<false, false>(),
        }
    }
}

impl Chunk<'_> {
    #[inline(always)]
    fn gather(&mut self) {
        let Search {
            question,
            members,
            parts,
        } = self.search;
        let (lenses, interest) = ((&question.lens, &question.projector), question.interest);
        let windows = &mut self.room.windows;
        let part = parts.iter().copied().reduce(Bounds::union);
        let part = part.unwrap_or(Bounds::NONE);
        match members {
            Members::All => {
                let bodies = &question.bodies[self.position.first..][..self.count];
                let sphere = |i: usize| &bodies[i].sphere;
                windows.gather(lenses, interest, self.count, sphere, part, self.counts);
            }
            Members::These(numbers) => {
                let numbers = &numbers[self.position.first..];
                let sphere = |i: usize| question.sphere(numbers[i]);
                // Those that are not there are not outside the picture, but where nothing changed.
                let mut counts = Counts::default();
                windows.gather(lenses, interest, self.count, sphere, part, &mut counts);
            }
        }
        self.position.is_gathered = true;
        self.allowance.spend(self.count as u64);
    }

    /// Asks about the spheres that nothing hides.
    #[inline(always)]
    fn ask_all<const PERSPECTIVE: bool, const ROOTS: bool>(&mut self) {
        let question = &self.search.question;
        let is_certified = question.is_certified();
        let leaves_out = question.interest.way != Strategy::Everything;
        let mut at = *self.position;
        let mut work = self.counts.work();
        while at.place < self.room.windows.in_order().len() {
            let spent = self.counts.work();
            self.allowance.spend(spent - work);
            work = spent;
            if self.allowance.is_used_up() {
                break;
            }
            let i = self.room.windows.in_order()[at.place] as usize;
            let (bounds, least) = (self.room.windows.bounds[i], self.room.windows.least[i]);
            let number = match self.search.members {
                Members::All => (at.first + i) as u32,
                Members::These(numbers) => numbers[at.first + i],
            };
            let sphere = question.sphere(number);
            if !at.is_inside_a_sphere() {
                // Of equal spheres the first listed is seen.
                if leaves_out && at.last.is_some_and(|last| question.sphere(last) == sphere) {
                    self.counts.hidden += 1;
                    at.place += 1;
                    continue;
                }
                at.last = Some(number);
                (at.was_asked, at.was_hidden) = (false, false);
                at.before = [self.counts.rows, self.counts.around];
            }
            while let Some(&part) = self.search.parts.get(at.part) {
                let bounds = bounds.within(part);
                let hides = |found: &Found| {
                    found.hides(question.field, bounds, least)
                        || (PERSPECTIVE
                            && !is_small(bounds)
                            && found.hides_around(question, sphere, bounds))
                };
                if bounds.is_empty() {
                } else if is_certified && at.row.is_none() && hides(self.found) {
                    at.was_hidden = true;
                } else {
                    at.was_asked = true;
                    at.row = self.ask::<PERSPECTIVE, ROOTS>(number, bounds, least, at.row);
                    if at.row.is_some() {
                        break;
                    }
                }
                at.part += 1;
            }
            if at.row.is_some() {
                continue;
            }
            // Parts that lie side by side have rows in common.
            let height = u64::from(question.field.size().height);
            let [rows, around] = at.before;
            self.counts.rows = self.counts.rows.min(rows + height);
            self.counts.around = self.counts.around.min(around + 1);
            self.counts.asked += u64::from(at.was_asked);
            self.counts.hidden += u64::from(at.was_hidden & !at.was_asked);
            (at.place, at.part) = (at.place + 1, 0);
        }
        self.allowance.spend(self.counts.work() - work);
        *self.position = at;
    }

    /// Asks about a sphere within `bounds`, from a row on; the row to go on from, if it was asked about
    /// enough for now.
    #[inline(always)]
    fn ask<const PERSPECTIVE: bool, const ROOTS: bool>(
        &mut self,
        number: u32,
        bounds: Bounds,
        least: f32,
        from: Option<i16>,
    ) -> Option<i16> {
        let question = &self.search.question;
        let sphere = question.sphere(number);
        let reach = question.interest.reach(least);
        let projected = (question.is_certified() && reach == Reach::Seen)
            .then(|| question.lens.project::<PERSPECTIVE>(sphere, least))
            .flatten()
            .filter(|_| question.field.ordinary());
        // The method itself is dearer to ask than the test.
        let is_worth_spans = Candidate::is_wide(bounds) || !question.is_certified();
        let (found, counts) = (&mut *self.found, &mut *self.counts);
        let candidate = Candidate {
            number,
            sphere,
            bounds,
            spans: is_worth_spans
                .then(|| question.projector.spans(sphere, reach))
                .flatten(),
            least,
            from: from.unwrap_or(bounds.top),
            enough: counts.solved + self.allowance.questions(),
        };
        if let Some(projected) = &projected {
            ask_certified::<PERSPECTIVE, ROOTS>(question, &candidate, projected, found, counts)
        } else {
            counts.around += u64::from(PERSPECTIVE && question.projector.inner(sphere) > 0.0);
            found.ask_method(question, &candidate, &mut self.room.answers, counts)
        }
    }
}

/// Asks about a sphere by the certified test.
#[inline(always)]
fn ask_certified<const PERSPECTIVE: bool, const ROOTS: bool>(
    question: &Question,
    candidate: &Candidate,
    projected: &Projected,
    found: &mut Found,
    counts: &mut Counts,
) -> Option<i16> {
    let field = question.field;
    let number = candidate.number;
    if !PERSPECTIVE && field.constant_b() {
        // Worked out for one pixel, it holds for all of them.
        let [x, y, z] = field.varying_singles();
        let o = sub([x[0], y[0], z[0]], projected.origin);
        let test = CertifiedTest::<PERSPECTIVE, ROOTS, true, 1> {
            question,
            number,
            projected,
            b: dot(o, field.shared_singles()),
        };
        return test.ask_rows(found, candidate, counts);
    }
    let columns = candidate.bounds.right - candidate.bounds.left;
    let is_small = is_small(candidate.bounds);
    if PERSPECTIVE && is_small && columns < SINGLES as i16 / 2 && field.size().height > 1 {
        let test = CertifiedTest::<PERSPECTIVE, ROOTS, false, 2> {
            question,
            number,
            projected,
            b: 0.0,
        };
        test.ask_box(found, candidate, counts);
        None
    } else {
        let test = CertifiedTest::<PERSPECTIVE, ROOTS, false, 1> {
            question,
            number,
            projected,
            b: 0.0,
        };
        if is_small {
            test.ask_box(found, candidate, counts);
            None
        } else {
            test.ask_rows(found, candidate, counts)
        }
    }
}

/// The certified test in binary32 about one sphere, in patches of one row of eight pixels or two of four.
struct CertifiedTest<
    'a,
    const PERSPECTIVE: bool,
    const ROOTS: bool,
    const CONSTANT_B: bool,
    const ROWS: usize,
> {
    question: &'a Question<'a>,
    number: u32,
    projected: &'a Projected,
    /// b = o·d, if it is the same at all pixels.
    b: f32,
}

impl<const PERSPECTIVE: bool, const ROOTS: bool, const CONSTANT_B: bool, const ROWS: usize>
    CertifiedTest<'_, PERSPECTIVE, ROOTS, CONSTANT_B, ROWS>
{
    const COLUMNS: usize = SINGLES / ROWS;

    /// Tests the patches that may see the sphere, row by row; the row to go on from, if the method was
    /// asked enough for now.
    #[inline(always)]
    fn ask_rows(
        &self,
        found: &mut Found,
        candidate: &Candidate,
        counts: &mut Counts,
    ) -> Option<i16> {
        let stride = self.question.field.stride();
        let bar = bar(candidate.least);
        // Patches begin at the span's own left edge. One that would leave the picture begins earlier:
        // asking twice, or beyond an edge, changes nothing.
        let latest = stride - Self::COLUMNS;
        for y in candidate.rows() {
            let [left, right] = candidate.columns(y);
            if left > right {
                continue;
            }
            if counts.solved >= candidate.enough {
                return Some(y);
            }
            counts.note_rows(1, [left, right]);
            let (row, tiles) = (y as usize * stride, y as usize / TILE * found.tiles.across);
            for x in (left as usize..=right as usize).step_by(Self::COLUMNS) {
                let x = x.min(latest);
                let changed = self.ask(found, row + x, bar, counts);
                found.note_change(tiles + x / TILE, changed);
            }
        }
        None
    }

    /// Tests the patches of a sphere that is no wider than one of them.
    #[inline(always)]
    fn ask_box(&self, found: &mut Found, candidate: &Candidate, counts: &mut Counts) {
        let Bounds {
            left,
            right,
            top,
            bottom,
        } = candidate.bounds;
        counts.note_rows(bottom - top + 1, [left, right]);
        let field = self.question.field;
        let stride = field.stride();
        let x = (left as usize).min(stride - Self::COLUMNS);
        let lowest = field.size().height as usize - ROWS;
        let bar = bar(candidate.least);
        let mut y = top as usize;
        loop {
            self.ask(found, y.min(lowest) * stride + x, bar, counts);
            y += ROWS;
            if y > bottom as usize {
                break;
            }
        }
    }

    /// Tests one patch, unless all that is seen there is nearer; whether any of its pixels now sees the
    /// sphere.
    #[inline(always)]
    fn ask(&self, found: &mut Found, place: usize, bar: f32, counts: &mut Counts) -> bool {
        let stride = self.question.field.stride();
        let mut open = 0;
        for row in 0..ROWS {
            let place = place + row * stride;
            for &t in &found.layer.t[place..place + Self::COLUMNS] {
                open |= u32::from(t >= bar);
            }
        }
        if open == 0 {
            counts.hidden_runs += 1;
            return false;
        }
        self.test(found, place, counts)
    }

    /// Tests the patch that begins at `place`.
    #[inline(always)]
    fn test(&self, found: &mut Found, place: usize, counts: &mut Counts) -> bool {
        let field = self.question.field;
        let stride = field.stride();
        let [x, y, z] = field.varying_singles();
        let [x, y, z] = [
            patch::<_, ROWS>(x, place, stride),
            patch::<_, ROWS>(y, place, stride),
            patch::<_, ROWS>(z, place, stride),
        ];
        // Of parallel rays all have one A.
        let a = field.a_singles();
        let a = if PERSPECTIVE {
            patch::<_, ROWS>(a, place, stride)
        } else {
            [a[0]; SINGLES]
        };
        let shared = field.shared_singles();
        let seen_t = patch::<_, ROWS>(&found.layer.t, place, stride);
        let seen_body = patch::<_, ROWS>(&found.layer.body, place, stride);
        let (mut next_t, mut next_body) = (seen_t, seen_body);
        let [mut open, mut changed] = [[0; SINGLES]; 2];
        // All of it in one loop, without a branch: then it is compiled to vectors.
        for l in 0..SINGLES {
            let varying = [x[l], y[l], z[l]];
            let (o, d) = if PERSPECTIVE {
                (self.projected.origin, varying)
            } else {
                (sub(varying, self.projected.origin), shared)
            };
            let b = if CONSTANT_B { self.b } else { dot(o, d) };
            let k = cross(o, d);
            let discriminant = a[l] * self.projected.r2 - dot(k, k);
            let t = match (ROOTS, PERSPECTIVE) {
                (true, true) => self.projected.c / (discriminant.sqrt() - b),
                (true, false) => (-b - discriminant.sqrt()) / a[l],
                // Where the ray is nearest to the centre.
                (false, _) => -b / a[l],
            };
            // A ray that draws no nearer meets nothing.
            let draws_nearer = b < 0.0;
            let hit = draws_nearer & (discriminant > a[l] * self.projected.accept);
            let doubtful = draws_nearer & !hit & (discriminant >= -a[l] * self.projected.doubt);
            let before = seen_t[l] * (1.0 - SAME);
            let nearer = hit & (t < before);
            let tied = hit & (t >= before) & (t * (1.0 - SAME) <= seen_t[l]);
            next_t[l] = if nearer { t } else { seen_t[l] };
            next_body[l] = if nearer { self.number } else { seen_body[l] };
            open[l] = u32::from(doubtful | tied);
            changed[l] = u32::from(nearer);
        }

        counts.tested += SINGLES as u64;
        counts.roots += if ROOTS { SINGLES as u64 } else { 0 };
        let changed = any(&changed);
        // Stored in any case: a store costs less than a branch that goes either way.
        put_patch::<_, ROWS>(&mut found.layer.t, place, stride, &next_t);
        put_patch::<_, ROWS>(&mut found.layer.body, place, stride, &next_body);
        if any(&open) {
            let columns = Self::COLUMNS;
            let places = from_fn(|l| place + l / columns * stride + l % columns);
            changed | found.ask_exact(self.question, self.number, places, open, counts)
        } else {
            changed
        }
    }
}

/// The numbers of a patch of pixels, row by row.
#[inline(always)]
fn patch<T: Copy + Default, const ROWS: usize>(
    from: &[T],
    place: usize,
    stride: usize,
) -> [T; SINGLES] {
    let columns = SINGLES / ROWS;
    let mut patch = [T::default(); SINGLES];
    for row in 0..ROWS {
        let start = place + row * stride;
        patch[row * columns..][..columns].copy_from_slice(&from[start..start + columns]);
    }
    patch
}

/// Puts the numbers of a patch where [`patch`] takes them from.
#[inline(always)]
fn put_patch<T: Copy, const ROWS: usize>(
    to: &mut [T],
    place: usize,
    stride: usize,
    patch: &[T; SINGLES],
) {
    let columns = SINGLES / ROWS;
    for row in 0..ROWS {
        let start = place + row * stride;
        to[start..start + columns].copy_from_slice(&patch[row * columns..][..columns]);
    }
}

/// Whether any of them is not zero, without a branch for each.
#[inline(always)]
fn any<const N: usize>(lanes: &[u32; N]) -> bool {
    let mut any = 0;
    for &lane in lanes {
        any |= lane;
    }
    any != 0
}

/// Whether these are so few pixels that each is looked at, and not their tiles.
#[inline(always)]
const fn is_small(bounds: Bounds) -> bool {
    let [columns, rows] = [bounds.right - bounds.left, bounds.bottom - bounds.top];
    columns < SINGLES as i16 && rows < SINGLES as i16
}

/// Below this what is seen is nearer, beyond doubt, than what lies no nearer than `least`.
#[inline(always)]
fn bar(least: f32) -> f32 {
    least * (1.0 - SAME)
}
