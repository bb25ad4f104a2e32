//! The nearest hits of a picture by `exact`: only where a sphere can be seen, and by a certified
//! test in binary64 that leaves the rest to the method itself.

#![expect(
    clippy::needless_bitwise_bool,
    reason = "a comparison that may be skipped is a branch, and a loop with branches is not compiled to vectors"
)]

use std::array::from_fn;

use super::cover::{Bounds, Spans};
use super::field::{Field, TILE};
use super::lanes::{LANES, Lanes, Real, SINGLES, cross, dot, sub};
use super::layer::{ASK, Contact, Layer, number, refill};
use super::plan::Counts;
use super::single::Single;
use crate::geometry::Sphere;
use crate::method::exact;
use crate::scene::Body;

/// The share by which two roots in the buffer must differ to tell which is less.
///
/// A root there is off by less than 2⁻¹³ of itself: see [`Asked::new`] and [`Single`].
pub(super) const SAME: f32 = 1.0 / (1 << 12) as f32;

/// After so many runs of a tile changed its bound is worked out anew.
const STALE: u32 = 8;

/// From this width on a sphere's columns are worked out row by row.
const WORTH_SPANS: i16 = 16;

/// What is asked: which of these spheres the rays hit.
#[derive(Clone, Copy)]
pub(super) struct Question<'a> {
    pub field: &'a Field,
    pub bodies: &'a [Body],
    /// Whether spheres are told apart by a root; else by where the ray comes closest to the centre,
    /// since no two of them have a point in common.
    pub roots: bool,
}

/// One sphere, and where to ask about it.
#[derive(Clone, Copy)]
pub(super) struct Candidate<'a> {
    /// Its place in the list of bodies.
    pub number: u32,
    /// The pixels at which it may be seen.
    pub bounds: Bounds,
    /// Which columns of them in each row, if that is known.
    pub spans: Option<&'a Spans>,
    /// No visible root is below this.
    pub least: f32,
    /// What the test in binary32 needs, if it serves.
    pub single: Option<Single>,
}

impl Candidate<'_> {
    /// Whether it is wide enough for the rows' own quadratics to pay.
    pub(super) const fn is_wide(bounds: Bounds) -> bool {
        bounds.right - bounds.left >= WORTH_SPANS
    }

    #[inline(always)]
    fn columns(&self, y: i16) -> [i16; 2] {
        match self.spans {
            Some(spans) => spans.at(y, self.bounds),
            None => [self.bounds.left, self.bounds.right],
        }
    }
}

/// For each pixel the nearest visible sphere so far, and about where it is hit: a root to within 2⁻¹³
/// of itself, or another point within the sphere if no two spheres meet.
#[derive(Debug, Clone, Default)]
pub(super) struct Nearest {
    pub(super) layer: Layer,
    tiles: Tiles,
}

/// For each tile an upper bound of its roots. Roots only fall, so a stale bound is still one.
#[derive(Debug, Clone, Default)]
struct Tiles {
    across: usize,
    far: Vec<f32>,
    changed: Vec<u32>,
}

/// How a sphere is asked about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Way {
    /// The eye is well outside: the near root counts, where the ray draws nearer.
    Outside,
    /// The eye is well inside: every ray hits, at the far root.
    Inside,
    /// The method itself is asked.
    Alone,
}

/// A sphere with what does not change from pixel to pixel.
struct Asked {
    number: u32,
    way: Way,
    center: [f64; 3],
    /// o = p0 − c, in perspective.
    o: [f64; 3],
    /// C, in perspective; −r² else.
    c: f64,
    r2: f64,
    /// Above this share of the bound on its error a discriminant is accepted.
    accept: f64,
}

/// The computed D = b² − AC is off by less than this times A(o² + r²).
///
/// With u = 2⁻⁵³ and S = Σ|oₖ dₖ| ≤ √A·|o|: o is off by u, so b by 4.1u·S and b² by
/// 9.3u·A·o²; C by 7u(o² + r²), so AC by 12u·A(o² + r²); the difference by another u·A·o².
/// The sum is below 23u·A(o² + r²), and 2⁻⁴⁸ = 32u leaves room for the rounding of the bound.
const DISCRIMINANT_ERROR: f64 = 1.0 / (1_u64 << 48) as f64;

impl Asked {
    /// Chooses how to ask about a sphere, given the origin of all rays, or a depth that all rays
    /// have to go at least before they can meet it.
    ///
    /// Let E be the bound on the error of D. A root t = C/(|b| + √D) with D > kE is off by no more
    /// than √(E/k)/|b| of itself, but for a few u. In perspective |b| ≥ √(AC), so that is
    /// √(2⁻⁴⁸/k)·ρ with ρ² = (o² + r²)/C: below 2⁻¹⁹ for k = 4 where ρ < 2⁶, and for
    /// k = 2²⁰ where ρ < 2¹³. For rays that are parallel |b| = √A·z, where z is the depth of the
    /// centre, and o² + r² ≤ z² + 3r² at the pixels of its box; C ≥ 2⁻²⁶(o² + r²) makes sure that
    /// C, too, is good.
    fn new(number: u32, sphere: &Sphere, field: &Field, least: f32) -> Self {
        let center = sphere.center.to_array().map(f64::from);
        let r = f64::from(sphere.radius);
        let r2 = r * r;
        let o = sub(field.shared(), center);
        let o2 = dot(o, o);
        let size = o2 + r2;
        let ordinary = (LEAST_SIZE..GREATEST_SIZE).contains(&size);
        let (way, c, accept) = if field.perspective() {
            let c = o2 - r2;
            let way = match c.abs() > NEAR_SURFACE * size && ordinary {
                false => Way::Alone,
                true if c > 0.0 => Way::Outside,
                true => Way::Inside,
            };
            let close = c < size / 4096.0;
            (way, c, if close { (1 << 20) as f64 } else { 4.0 })
        } else {
            let ahead = f64::from(least) > r / 1024.0;
            let way = if ahead && ordinary {
                Way::Outside
            } else {
                Way::Alone
            };
            (way, -r2, 4.0)
        };
        Self {
            number,
            way,
            center,
            o,
            c,
            r2,
            accept,
        }
    }
}

/// Between these no root leaves the normal range of binary32.
const LEAST_SIZE: f64 = 1.0 / GREATEST_SIZE;
const GREATEST_SIZE: f64 = (1_u128 << 100) as f64;

/// So near to the surface, as a share of o² + r², C says too little.
const NEAR_SURFACE: f64 = 1.0 / (1_u64 << 26) as f64;

impl Nearest {
    /// Nothing is seen yet in a picture of the size of `field`.
    pub(super) fn clear(&mut self, field: &Field) {
        self.layer.clear_all(field.places());
        self.tiles.across = field.stride() / TILE;
        let tiles = self.tiles.across * (field.size().height as usize).div_ceil(TILE);
        refill(&mut self.tiles.far, tiles, f32::INFINITY);
        refill(&mut self.tiles.changed, tiles, 0);
    }

    /// Forgets what was found within `part`.
    pub(super) fn reopen(&mut self, field: &Field, part: Bounds) {
        for y in part.top as usize..=part.bottom as usize {
            let row = y * field.stride();
            self.layer
                .clear_run(row + part.left as usize..row + part.right as usize + 1);
            let tiles = y / TILE * self.tiles.across;
            let run = tiles + part.left as usize / TILE..=tiles + part.right as usize / TILE;
            self.tiles.far[run].fill(f32::INFINITY);
        }
    }

    /// Forgets what was found for places beyond the right edge.
    pub(super) fn trim(&mut self, field: &Field) {
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
    pub(super) fn hides(&self, field: &Field, bounds: Bounds, least: f32) -> bool {
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
        let [left, right] = [bounds.left as usize / TILE, bounds.right as usize / TILE];
        let [top, bottom] =
            [bounds.top, bounds.bottom].map(|y| y as usize / TILE * self.tiles.across);
        (top..=bottom).step_by(self.tiles.across).all(|row| {
            let mut tiles = self.tiles.far[row + left..=row + right].iter();
            tiles.all(|&far| is_before(far, least))
        })
    }

    /// Asks about one sphere: of rays that start at one point or are parallel, as `question` has it, and
    /// with roots if it has them.
    #[inline(always)]
    pub(super) fn ask<const PERSPECTIVE: bool, const ROOTS: bool>(
        &mut self,
        question: &Question,
        candidate: &Candidate,
        counts: &mut Counts,
    ) {
        match &candidate.single {
            Some(single) => {
                self.ask_singles::<PERSPECTIVE, ROOTS>(question, candidate, single, counts);
            }
            None => self.ask_beyond_singles(question, candidate, counts),
        }
    }

    /// Asks about a sphere that the test in binary32 does not serve: one that is near, or holds the
    /// eye, or is far smaller than it is far.
    #[cold]
    #[inline(never)]
    fn ask_beyond_singles(
        &mut self,
        question: &Question,
        candidate: &Candidate,
        counts: &mut Counts,
    ) {
        let Question { field, bodies, .. } = *question;
        let sphere = &bodies[candidate.number as usize].sphere;
        let asked = Asked::new(candidate.number, sphere, field, candidate.least);
        match (asked.way, field.perspective()) {
            (Way::Alone, _) => self.ask_alone(question, candidate, counts),
            (Way::Inside, _) => {
                counts.around += 1;
                self.ask_runs::<true, true>(question, &asked, candidate, counts);
            }
            (Way::Outside, true) => {
                self.ask_runs::<true, false>(question, &asked, candidate, counts);
            }
            (Way::Outside, false) => {
                self.ask_runs::<false, false>(question, &asked, candidate, counts);
            }
        }
    }

    /// Tests the runs of pixels that may see the sphere, each a patch of one row.
    #[inline(always)]
    fn test_runs<T: Test>(
        &mut self,
        test: &T,
        field: &Field,
        candidate: &Candidate,
        counts: &mut Counts,
    ) {
        let stride = field.stride();
        let bar = bar(candidate.least);
        // Runs begin at the span's own left edge. One that would leave the picture begins earlier:
        // asking twice, or beyond an edge, changes nothing.
        let latest = stride - T::COLUMNS;
        for y in candidate.bounds.top..=candidate.bounds.bottom {
            let [left, right] = candidate.columns(y);
            if left > right {
                continue;
            }
            counts.note_rows(1, [left, right]);
            let (row, tiles) = (y as usize * stride, y as usize / TILE * self.tiles.across);
            for x in (left as usize..=right as usize).step_by(T::COLUMNS) {
                let x = x.min(latest);
                let changed = self.test(test, row + x, stride, bar, counts);
                self.note_change(tiles + x / TILE, changed);
            }
        }
    }

    /// Tests one patch, unless all that is seen there is nearer.
    #[inline(always)]
    fn test<T: Test>(
        &mut self,
        test: &T,
        place: usize,
        stride: usize,
        bar: f32,
        counts: &mut Counts,
    ) -> bool {
        let mut open = 0;
        for row in 0..T::ROWS {
            let place = place + row * stride;
            for &t in &self.layer.t[place..place + T::COLUMNS] {
                open |= u32::from(t >= bar);
            }
        }
        if open == 0 {
            counts.hidden_runs += 1;
            return false;
        }
        test.run(self, place, counts)
    }

    /// Tests the patches of a sphere that is no wider than one of them, and hidden by no tile.
    #[inline(always)]
    fn test_few<T: Test>(
        &mut self,
        test: &T,
        field: &Field,
        candidate: &Candidate,
        counts: &mut Counts,
    ) {
        let Bounds {
            left,
            right,
            top,
            bottom,
        } = candidate.bounds;
        counts.note_rows(bottom - top + 1, [left, right]);
        let stride = field.stride();
        let x = (left as usize).min(stride - T::COLUMNS);
        let lowest = field.size().height as usize - T::ROWS;
        let bar = bar(candidate.least);
        let mut y = top as usize;
        loop {
            self.test(test, y.min(lowest) * stride + x, stride, bar, counts);
            y += T::ROWS;
            if y > bottom as usize {
                break;
            }
        }
    }

    #[inline(always)]
    fn ask_singles<const PERSPECTIVE: bool, const ROOTS: bool>(
        &mut self,
        question: &Question,
        candidate: &Candidate,
        single: &Single,
        counts: &mut Counts,
    ) {
        let (field, number) = (question.field, candidate.number);
        if !PERSPECTIVE && field.constant_b() {
            // Worked out for one pixel, it holds for all of them.
            let [x, y, z] = field.varying_singles();
            let o = sub([x[0], y[0], z[0]], single.origin);
            let test = InSingles::<PERSPECTIVE, ROOTS, true, 1> {
                question,
                number,
                single,
                b: dot(o, field.shared_singles()),
            };
            self.test_runs(&test, field, candidate, counts);
            return;
        }
        let columns = candidate.bounds.right - candidate.bounds.left;
        let is_small = is_small(candidate.bounds);
        if PERSPECTIVE && is_small && columns < SINGLES as i16 / 2 && field.size().height > 1 {
            let test = InSingles::<PERSPECTIVE, ROOTS, false, 2> {
                question,
                number,
                single,
                b: 0.0,
            };
            self.test_few(&test, field, candidate, counts);
        } else {
            let test = InSingles::<PERSPECTIVE, ROOTS, false, 1> {
                question,
                number,
                single,
                b: 0.0,
            };
            if is_small {
                self.test_few(&test, field, candidate, counts);
            } else {
                self.test_runs(&test, field, candidate, counts);
            }
        }
    }

    #[inline(always)]
    fn ask_runs<const PERSPECTIVE: bool, const INSIDE: bool>(
        &mut self,
        question: &Question,
        asked: &Asked,
        candidate: &Candidate,
        counts: &mut Counts,
    ) {
        let test = InDoubles::<PERSPECTIVE, INSIDE> { question, asked };
        self.test_runs(&test, question.field, candidate, counts);
    }

    /// Asks the method itself at the open places of a run; whether any of them now sees this sphere.
    #[cold]
    #[inline(never)]
    fn settle<const N: usize>(
        &mut self,
        question: &Question,
        number: u32,
        places: [usize; N],
        open: [u32; N],
        counts: &mut Counts,
    ) -> bool {
        let mut changed = false;
        for l in (0..N).filter(|&l| open[l] != 0) {
            changed |= self.ask_at(question, number, places[l], counts);
        }
        changed
    }

    fn ask_alone(&mut self, question: &Question, candidate: &Candidate, counts: &mut Counts) {
        let test = Alone {
            question,
            number: candidate.number,
        };
        self.test_runs(&test, question.field, candidate, counts);
    }

    /// Asks the method itself at one place; whether this sphere is now what is seen there.
    fn ask_at(
        &mut self,
        question: &Question,
        asked: u32,
        place: usize,
        counts: &mut Counts,
    ) -> bool {
        let seen = number(self.layer.body[place]);
        if !question.field.is_pixel(place) || seen == Some(asked) {
            return false;
        }
        let ray = question.field.ray(place);
        let mut solve = |number: u32| {
            let sphere = &question.bodies[number as usize].sphere;
            let (answer, stages) = exact::solve_staged(&ray, sphere);
            counts.note_solved(Some(stages.last()));
            answer
        };
        let answer = solve(asked);
        let Some(t) = answer.visible() else {
            return false;
        };
        let before = self.layer.t[place];
        let nearer = match seen {
            None => true,
            Some(_) if is_before(t, before) => true,
            Some(_) if is_before(before, t) => false,
            Some(seen) => {
                let other = solve(seen).visible();
                other.is_none_or(|other| (t, asked) < (other, seen))
            }
        };
        if nearer {
            self.layer.t[place] = t;
            self.layer.body[place] = asked | ASK;
            self.layer.contact[place] = Contact::of(&answer);
        }
        nearer
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
}

/// A test of a patch of pixels about one sphere.
trait Test {
    /// How many columns and rows of pixels.
    const COLUMNS: usize;
    const ROWS: usize;

    /// Tests the patch that begins at `place`; whether any of its pixels now sees the sphere.
    fn run(&self, nearest: &mut Nearest, place: usize, counts: &mut Counts) -> bool;
}

/// The certified test in binary32, of one row of eight pixels or two of four.
struct InSingles<
    'a,
    const PERSPECTIVE: bool,
    const ROOTS: bool,
    const CONSTANT_B: bool,
    const ROWS: usize,
> {
    question: &'a Question<'a>,
    number: u32,
    single: &'a Single,
    /// b = o·d, if it is the same at all pixels.
    b: f32,
}

impl<const PERSPECTIVE: bool, const ROOTS: bool, const CONSTANT_B: bool, const ROWS: usize> Test
    for InSingles<'_, PERSPECTIVE, ROOTS, CONSTANT_B, ROWS>
{
    const COLUMNS: usize = SINGLES / ROWS;
    const ROWS: usize = ROWS;

    #[inline(always)]
    fn run(&self, nearest: &mut Nearest, place: usize, counts: &mut Counts) -> bool {
        let Question { field, .. } = *self.question;
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
        let single = self.single;
        let seen = Run {
            t: patch::<_, ROWS>(&nearest.layer.t, place, stride),
            body: patch::<_, ROWS>(&nearest.layer.body, place, stride),
        };
        let mut next = seen;
        let [mut open, mut changed] = [[0; SINGLES]; 2];
        // All of it in one loop, without a branch: then it is compiled to vectors.
        for l in 0..SINGLES {
            let varying = [x[l], y[l], z[l]];
            let (o, d) = if PERSPECTIVE {
                (single.origin, varying)
            } else {
                (sub(varying, single.origin), shared)
            };
            let b = if CONSTANT_B { self.b } else { dot(o, d) };
            let k = cross(o, d);
            let discriminant = a[l] * single.r2 - dot(k, k);
            let t = match (ROOTS, PERSPECTIVE) {
                (true, true) => single.c / (discriminant.sqrt() - b),
                (true, false) => (-b - discriminant.sqrt()) / a[l],
                // Where the ray is nearest to the centre.
                (false, _) => -b / a[l],
            };
            // A ray that draws no nearer meets nothing.
            let draws_nearer = b < 0.0;
            let hit = draws_nearer & (discriminant > a[l] * single.accept);
            let doubtful = draws_nearer & !hit & (discriminant >= -a[l] * single.doubt);
            let before = seen.t[l] * (1.0 - SAME);
            let nearer = hit & (t < before);
            let tied = hit & (t >= before) & (t * (1.0 - SAME) <= seen.t[l]);
            next.t[l] = if nearer { t } else { seen.t[l] };
            next.body[l] = if nearer { self.number } else { seen.body[l] };
            open[l] = u32::from(doubtful | tied);
            changed[l] = u32::from(nearer);
        }

        counts.tested += SINGLES as u64;
        counts.roots += if ROOTS { SINGLES as u64 } else { 0 };
        let changed = any(&changed);
        // Stored in any case: a store costs less than a branch that goes either way.
        put_patch::<_, ROWS>(&mut nearest.layer.t, place, stride, &next.t);
        put_patch::<_, ROWS>(&mut nearest.layer.body, place, stride, &next.body);
        if any(&open) {
            let columns = Self::COLUMNS;
            let places = from_fn(|l| place + l / columns * stride + l % columns);
            changed | nearest.settle(self.question, self.number, places, open, counts)
        } else {
            changed
        }
    }
}

/// The certified test in binary64.
struct InDoubles<'a, const PERSPECTIVE: bool, const INSIDE: bool> {
    question: &'a Question<'a>,
    asked: &'a Asked,
}

impl<const PERSPECTIVE: bool, const INSIDE: bool> Test for InDoubles<'_, PERSPECTIVE, INSIDE> {
    const COLUMNS: usize = LANES;
    const ROWS: usize = 1;

    #[inline(always)]
    fn run(&self, nearest: &mut Nearest, place: usize, counts: &mut Counts) -> bool {
        let field = self.question.field;
        let varying = field.varying(place);
        let a = field.a(place);
        let r2 = Lanes::of(self.asked.r2);
        let (o, d, c, size) = if PERSPECTIVE {
            let o = self.asked.o.map(Lanes::of);
            let size = Lanes::of(dot(self.asked.o, self.asked.o) + self.asked.r2);
            (o, varying, Lanes::of(self.asked.c), size)
        } else {
            let o = sub(varying, self.asked.center.map(Lanes::of));
            let o2 = dot(o, o);
            (o, field.shared().map(Lanes::of), o2 - r2, o2 + r2)
        };
        let b = dot(o, d);
        let discriminant = b * b - a * c;
        let error = a * (Lanes::of(DISCRIMINANT_ERROR) * size);
        let accepted = Lanes::of(self.asked.accept) * error;
        let t = if self.question.roots {
            counts.roots += LANES as u64;
            let root = discriminant.sqrt();
            if INSIDE {
                // Every ray hits, and nothing cancels.
                ((root - b) / a).where_negative(b, -c / (root + b))
            } else {
                c / (root - b)
            }
        } else if INSIDE {
            // Any point within the sphere tells which comes first: here it is the eye.
            Lanes::of(f32::MIN_POSITIVE.into())
        } else {
            -b / a
        };

        // Outside, a ray that draws no nearer meets nothing.
        let discriminant = if INSIDE {
            discriminant
        } else {
            discriminant.where_negative(b, Lanes::of(f64::NEG_INFINITY))
        };
        let is_hit = |l: usize| INSIDE || discriminant.0[l] > accepted.0[l];
        let seen = Run::<LANES>::load(&nearest.layer, place);
        let mut next = seen;
        let [mut open, mut changed] = [[0; LANES]; 2];

        counts.tested += LANES as u64;
        let entry = self.asked.number | if INSIDE { super::layer::INSIDE } else { 0 };
        for l in 0..LANES {
            let hit = is_hit(l);
            let doubtful = !hit & (discriminant.0[l] >= -error.0[l]);
            let (t, before) = (t.0[l] as f32, seen.t[l] * (1.0 - SAME));
            let nearer = hit & (t < before);
            let tied = hit & (t >= before) & (t * (1.0 - SAME) <= seen.t[l]);
            next.t[l] = if nearer { t } else { seen.t[l] };
            next.body[l] = if nearer { entry } else { seen.body[l] };
            open[l] = u32::from(doubtful | tied);
            changed[l] = u32::from(nearer);
        }
        let changed = any(&changed);
        // Stored in any case: a store costs less than a branch that goes either way.
        next.store(&mut nearest.layer, place);
        if any(&open) {
            let places = from_fn(|l| place + l);
            changed | nearest.settle(self.question, self.asked.number, places, open, counts)
        } else {
            changed
        }
    }
}

/// No test but the method itself.
struct Alone<'a> {
    question: &'a Question<'a>,
    number: u32,
}

impl Test for Alone<'_> {
    const COLUMNS: usize = 1;
    const ROWS: usize = 1;

    #[inline(always)]
    fn run(&self, nearest: &mut Nearest, place: usize, counts: &mut Counts) -> bool {
        nearest.ask_at(self.question, self.number, place, counts)
    }
}

/// What is seen at a run of pixels.
#[derive(Clone, Copy)]
struct Run<const N: usize> {
    t: [f32; N],
    body: [u32; N],
}

impl<const N: usize> Run<N> {
    #[inline(always)]
    fn load(layer: &Layer, place: usize) -> Self {
        let run = place..place + N;
        let (t, body) = (&layer.t[run.clone()], &layer.body[run]);
        let mut run = Self {
            t: [0.0; N],
            body: [0; N],
        };
        run.t.copy_from_slice(t);
        run.body.copy_from_slice(body);
        run
    }

    #[inline(always)]
    fn store(&self, layer: &mut Layer, place: usize) {
        let run = place..place + N;
        layer.t[run.clone()].copy_from_slice(&self.t);
        layer.body[run].copy_from_slice(&self.body);
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

/// Whether a root in the buffer is less than another one, or than a bound, beyond doubt.
#[inline(always)]
pub(super) fn is_before(t: f32, other: f32) -> bool {
    t < other * (1.0 - SAME)
}
