//! The nearest hits of a picture by `exact`: only where a sphere can be seen, and by a certified
//! test in binary64 that leaves the rest to the method itself.

use std::array::from_fn;

use super::cover::Bounds;
use super::field::{Field, TILE};
use super::lanes::{LANES, Lanes, Real, dot, sub};
use super::layer::refill;
use super::plan::Counts;
use crate::geometry::Sphere;
use crate::method::exact;
use crate::scene::Body;

/// No sphere: greater than the number of any.
pub(super) const NOBODY: u32 = u32::MAX;

/// Marks the number of a sphere about which the method itself was asked at this pixel.
pub(super) const ASK: u32 = 1 << 31;

/// Marks the number of a sphere that holds the eye.
pub(super) const INSIDE: u32 = 1 << 30;

/// The share by which two roots in the buffer must differ to tell which is less.
///
/// A root there is off by less than 2⁻¹⁸ of itself: see [`Asked::new`].
const SAME: f32 = 1.0 / (1 << 16) as f32;

/// After so many pixels of a tile changed its bound is worked out anew.
const STALE: u32 = 24;

/// What is asked: which of these spheres the rays hit.
#[derive(Clone, Copy)]
pub(super) struct Question<'a> {
    pub field: &'a Field,
    pub bodies: &'a [Body],
}

/// For each pixel the nearest visible sphere so far, and about where it is hit.
#[derive(Debug, Clone, Default)]
pub(super) struct Nearest {
    /// The root, to within 2⁻¹⁸ of itself; ∞ where nothing is hit.
    t: Vec<f32>,
    /// Which sphere, perhaps with [`ASK`].
    body: Vec<u32>,
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
struct Asked<'a> {
    number: u32,
    sphere: &'a Sphere,
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

impl<'a> Asked<'a> {
    /// Chooses how to ask about a sphere, given the origin of all rays, or a depth that all rays
    /// have to go at least before they can meet it.
    ///
    /// Let E be the bound on the error of D. A root t = C/(|b| + √D) with D > kE is off by no more
    /// than √(E/k)/|b| of itself, but for a few u. In perspective |b| ≥ √(AC), so that is
    /// √(2⁻⁴⁸/k)·ρ with ρ² = (o² + r²)/C: below 2⁻¹⁹ for k = 4 where ρ < 2⁶, and for
    /// k = 2²⁰ where ρ < 2¹³. For rays that are parallel |b| = √A·z, where z is the depth of the
    /// centre, and o² + r² ≤ z² + 3r² at the pixels of its box; C ≥ 2⁻²⁶(o² + r²) makes sure that
    /// C, too, is good.
    fn new(number: u32, sphere: &'a Sphere, field: &Field, least: f32) -> Self {
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
            sphere,
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
        refill(&mut self.t, field.places(), f32::INFINITY);
        refill(&mut self.body, field.places(), NOBODY);
        self.tiles.across = field.stride() / TILE;
        let tiles = self.tiles.across * (field.size().height as usize).div_ceil(TILE);
        refill(&mut self.tiles.far, tiles, f32::INFINITY);
        refill(&mut self.tiles.changed, tiles, 0);
    }

    /// About where the sphere at a place is hit.
    pub(super) fn t(&self, place: usize) -> f32 {
        self.t[place]
    }

    /// Forgets what was found within `part`.
    pub(super) fn reopen(&mut self, field: &Field, part: Bounds) {
        for y in part.top as usize..=part.bottom as usize {
            let row = y * field.stride();
            let run = row + part.left as usize..=row + part.right as usize;
            self.t[run.clone()].fill(f32::INFINITY);
            self.body[run].fill(NOBODY);
            let tiles = y / TILE * self.tiles.across;
            let run = tiles + part.left as usize / TILE..=tiles + part.right as usize / TILE;
            self.tiles.far[run].fill(f32::INFINITY);
        }
    }

    /// Forgets what was found for places beyond the right edge.
    pub(super) fn trim(&mut self, field: &Field) {
        let width = field.size().width as usize;
        for row in self.body.chunks_mut(field.stride().max(1)) {
            row[width..].fill(NOBODY);
        }
    }

    /// The entries of a run of places.
    pub(super) fn bodies(&self, place: usize) -> [u32; LANES] {
        let bodies = &self.body[place..place + LANES];
        from_fn(|l| bodies[l])
    }

    /// Whether everything seen within `bounds` is nearer than `least`.
    #[inline]
    pub(super) fn hides(&self, bounds: Bounds, least: f32) -> bool {
        let [left, right, top, bottom] = [bounds.left, bounds.right, bounds.top, bounds.bottom]
            .map(|pixel| pixel as usize / TILE);
        (top..=bottom).all(|row| {
            let row = row * self.tiles.across;
            self.tiles.far[row + left..=row + right]
                .iter()
                .all(|&far| is_before(far, least))
        })
    }

    /// Asks about one sphere within `bounds`, where no visible root of it is below `least`.
    pub(super) fn ask(
        &mut self,
        question: &Question,
        number: u32,
        bounds: Bounds,
        least: f32,
        counts: &mut Counts,
    ) {
        let Question { field, bodies } = *question;
        let asked = Asked::new(number, &bodies[number as usize].sphere, field, least);
        match (asked.way, field.perspective()) {
            (Way::Alone, _) => self.ask_alone(question, &asked, bounds, least, counts),
            (Way::Inside, _) => {
                self.ask_runs::<true, true>(question, &asked, bounds, least, counts);
            }
            (Way::Outside, true) => {
                self.ask_runs::<true, false>(question, &asked, bounds, least, counts);
            }
            (Way::Outside, false) => {
                self.ask_runs::<false, false>(question, &asked, bounds, least, counts);
            }
        }
    }

    #[inline(always)]
    fn ask_runs<const PERSPECTIVE: bool, const INSIDE: bool>(
        &mut self,
        question: &Question,
        asked: &Asked,
        bounds: Bounds,
        least: f32,
        counts: &mut Counts,
    ) {
        let stride = question.field.stride();
        // Runs begin at the sphere's own left edge: a small one takes one run a row. A run that would
        // leave the row begins earlier: asking twice, or beyond an edge, changes nothing.
        let latest = stride - LANES;
        for y in bounds.top as usize..=bounds.bottom as usize {
            let tiles = y / TILE * self.tiles.across;
            for x in (bounds.left as usize..=bounds.right as usize).step_by(LANES) {
                let x = x.min(latest);
                let [first, last] = [x / TILE, (x + LANES - 1) / TILE].map(|column| tiles + column);
                let far = self.tiles.far[first].max(self.tiles.far[last]);
                if is_before(far, least) {
                    counts.hidden_runs += 1;
                    continue;
                }
                let changed =
                    self.test::<PERSPECTIVE, INSIDE>(question, asked, y * stride + x, counts);
                self.note_change(first, changed);
            }
        }
    }

    /// Tests one run of pixels; how many of them now see this sphere.
    #[inline(always)]
    fn test<const PERSPECTIVE: bool, const INSIDE: bool>(
        &mut self,
        question: &Question,
        asked: &Asked,
        place: usize,
        counts: &mut Counts,
    ) -> u32 {
        let field = question.field;
        let varying = field.varying(place);
        let a = field.a(place);
        let r2 = Lanes::of(asked.r2);
        let (o, d, c, size) = if PERSPECTIVE {
            let o = asked.o.map(Lanes::of);
            let size = Lanes::of(dot(asked.o, asked.o) + asked.r2);
            (o, varying, Lanes::of(asked.c), size)
        } else {
            let o = sub(varying, asked.center.map(Lanes::of));
            let o2 = dot(o, o);
            (o, field.shared().map(Lanes::of), o2 - r2, o2 + r2)
        };
        let b = dot(o, d);
        let discriminant = b * b - a * c;
        let error = a * (Lanes::of(DISCRIMINANT_ERROR) * size);
        let accepted = Lanes::of(asked.accept) * error;
        let root = discriminant.sqrt();
        let t = if INSIDE {
            // Every ray hits, and nothing cancels.
            ((root - b) / a).where_negative(b, -c / (root + b))
        } else {
            c / (root - b)
        };

        // Outside, a ray that draws no nearer meets nothing.
        let discriminant = if INSIDE {
            discriminant
        } else {
            discriminant.where_negative(b, Lanes::of(f64::NEG_INFINITY))
        };
        let is_hit = |l: usize| INSIDE || discriminant.0[l] > accepted.0[l];
        let new: [f32; LANES] = from_fn(|l| {
            if is_hit(l) {
                t.0[l] as f32
            } else {
                f32::INFINITY
            }
        });
        let doubtful: [u32; LANES] =
            from_fn(|l| u32::from(!is_hit(l)) & u32::from(discriminant.0[l] >= -error.0[l]));

        counts.tested += LANES as u64;
        let entry = asked.number | if INSIDE { self::INSIDE } else { 0 };
        let (changed, tied) = self.keep_nearer(entry, place, &new);
        let open: [u32; LANES] = from_fn(|l| doubtful[l] | tied[l]);
        if open.iter().fold(0, |any, o| any | o) == 0 {
            changed
        } else {
            changed + self.settle(question, asked, place, open, counts)
        }
    }

    /// Notes the roots of one sphere where they are nearer: at how many places they are, and where it
    /// cannot tell.
    #[inline(always)]
    fn keep_nearer(&mut self, entry: u32, place: usize, new: &[f32; LANES]) -> (u32, [u32; LANES]) {
        let t: &mut [f32] = &mut self.t[place..place + LANES];
        let body: &mut [u32] = &mut self.body[place..place + LANES];
        let old: [f32; LANES] = from_fn(|l| t[l]);
        let nearer: [bool; LANES] = from_fn(|l| is_before(new[l], old[l]));
        let tied: [u32; LANES] = from_fn(|l| {
            let farther = is_before(old[l], new[l]) || new[l] == f32::INFINITY;
            u32::from(!nearer[l]) & u32::from(!farther)
        });
        for l in 0..LANES {
            t[l] = if nearer[l] { new[l] } else { old[l] };
            body[l] = if nearer[l] { entry } else { body[l] };
        }
        (nearer.iter().map(|&n| u32::from(n)).sum(), tied)
    }

    /// Asks the method itself at the open places of a run.
    #[cold]
    #[inline(never)]
    fn settle(
        &mut self,
        question: &Question,
        asked: &Asked,
        place: usize,
        open: [u32; LANES],
        counts: &mut Counts,
    ) -> u32 {
        (0..LANES)
            .filter(|&l| open[l] != 0)
            .filter(|l| self.ask_at(question, asked, place + l, counts))
            .count() as u32
    }

    fn ask_alone(
        &mut self,
        question: &Question,
        asked: &Asked,
        bounds: Bounds,
        least: f32,
        counts: &mut Counts,
    ) {
        for y in bounds.top as u32..=bounds.bottom as u32 {
            for x in bounds.left as u32..=bounds.right as u32 {
                let tile = y as usize / TILE * self.tiles.across + x as usize / TILE;
                if !is_before(self.tiles.far[tile], least) {
                    let changed = self.ask_at(question, asked, question.field.place(x, y), counts);
                    self.note_change(tile, changed.into());
                }
            }
        }
    }

    /// Asks the method itself at one place; whether this sphere is now what is seen there.
    fn ask_at(
        &mut self,
        question: &Question,
        asked: &Asked,
        place: usize,
        counts: &mut Counts,
    ) -> bool {
        let seen = number(self.body[place]);
        if !question.field.is_pixel(place) || seen == Some(asked.number) {
            return false;
        }
        let ray = question.field.ray(place);
        let mut solve = |sphere| {
            let (answer, stages) = exact::solve_staged(&ray, sphere);
            counts.solved += 1;
            counts.stages[stages.last() as usize] += 1;
            answer.visible()
        };
        let Some(t) = solve(asked.sphere) else {
            return false;
        };
        let before = self.t[place];
        let nearer = match seen {
            None => true,
            Some(_) if is_before(t, before) => true,
            Some(_) if is_before(before, t) => false,
            Some(seen) => {
                let other = solve(&question.bodies[seen as usize].sphere);
                other.is_none_or(|other| (t, asked.number) < (other, seen))
            }
        };
        if nearer {
            self.t[place] = t;
            self.body[place] = asked.number | ASK;
        }
        nearer
    }

    /// Counts changes in a tile, and after some looks how far the farthest root in it still is.
    #[inline(always)]
    fn note_change(&mut self, tile: usize, changed: u32) {
        self.tiles.changed[tile] += changed;
        if self.tiles.changed[tile] >= STALE {
            self.measure(tile);
        }
    }

    #[inline(never)]
    fn measure(&mut self, tile: usize) {
        let stride = self.tiles.across * TILE;
        let first = tile / self.tiles.across * TILE * stride + tile % self.tiles.across * TILE;
        let far = self.t[first..]
            .chunks(stride)
            .take(TILE)
            .flat_map(|row| &row[..TILE])
            .fold(0.0_f32, |far, &t| if t > far { t } else { far });
        self.tiles.far[tile] = far;
        self.tiles.changed[tile] = 0;
    }
}

/// The number of the sphere that an entry of the buffer names.
pub(super) const fn number(body: u32) -> Option<u32> {
    if body == NOBODY {
        None
    } else {
        Some(body & !(ASK | INSIDE))
    }
}

/// Whether a root in the buffer is less than another one, or than a bound, beyond doubt.
#[inline(always)]
pub(super) fn is_before(t: f32, other: f32) -> bool {
    t < other * (1.0 - SAME)
}
