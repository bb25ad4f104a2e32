//! Many rays, many spheres, in arrays: the same answers as one by one, bit for bit.
//!
//! `exact` runs in binary64 on a block of lanes at once and sets aside the few that need more; the
//! other methods are loops over the single call, which the compiler makes vectors of where it can.

#![expect(
    clippy::inline_always,
    reason = "a kernel is compiled for wider vectors only with all that it calls inside it"
)]

use std::marker::PhantomData;

use glam::Vec3;

use super::citardauq::Citardauq;
use super::contracted::Contracted;
use super::double::Double;
use super::exact::lanes::{self, Inputs, LANES};
use super::exact::{self, Input, Stage};
use super::formula::{self, Formula};
use super::haines::Haines;
use super::kahan::Kahan;
use super::simd::{self, Kernel};
use super::textbook::Textbook;
use super::unit::Unit;
use super::{Class, Method, Place, Solution};
use crate::geometry::{Ray, Sphere};

/// A vector for each lane: three slices of equal length, or a [`Vec3`] that all lanes share.
pub trait Vectors: Copy {
    /// The number of lanes; none if any number will do.
    fn count(&self) -> Option<usize>;
    /// The vector of lane i.
    fn at(&self, i: usize) -> [f32; 3];
    /// A block of lanes from lane i on; all must be there.
    fn block(&self, i: usize) -> impl Vectors;
    /// A block of lanes from lane i on, the last one repeated past the end.
    fn tail(&self, i: usize) -> impl Vectors;
}

/// A number for each lane: a slice, or an `f32` that all lanes share.
pub trait Scalars: Copy {
    /// The number of lanes; none if any number will do.
    fn count(&self) -> Option<usize>;
    /// The number of lane i.
    fn at(&self, i: usize) -> f32;
    /// A block of lanes from lane i on; all must be there.
    fn block(&self, i: usize) -> impl Scalars;
    /// A block of lanes from lane i on, the last one repeated past the end.
    fn tail(&self, i: usize) -> impl Scalars;
}

impl Scalars for f32 {
    #[inline(always)]
    fn count(&self) -> Option<usize> {
        None
    }

    #[inline(always)]
    fn at(&self, _: usize) -> f32 {
        *self
    }

    #[inline(always)]
    fn block(&self, _: usize) -> impl Scalars {
        *self
    }

    fn tail(&self, _: usize) -> impl Scalars {
        *self
    }
}

impl Scalars for &[f32] {
    #[inline(always)]
    fn count(&self) -> Option<usize> {
        Some(self.len())
    }

    #[inline(always)]
    fn at(&self, i: usize) -> f32 {
        self[i]
    }

    #[inline(always)]
    fn block(&self, i: usize) -> impl Scalars {
        &self[i..i + LANES]
    }

    fn tail(&self, i: usize) -> impl Scalars {
        let last = self.len() - 1;
        std::array::from_fn::<_, LANES, _>(|lane| self[last.min(i + lane)])
    }
}

impl Scalars for [f32; LANES] {
    #[inline(always)]
    fn count(&self) -> Option<usize> {
        Some(LANES)
    }

    #[inline(always)]
    fn at(&self, i: usize) -> f32 {
        self[i]
    }

    #[inline(always)]
    fn block(&self, _: usize) -> impl Scalars {
        *self
    }

    fn tail(&self, _: usize) -> impl Scalars {
        *self
    }
}

impl Vectors for Vec3 {
    #[inline(always)]
    fn count(&self) -> Option<usize> {
        None
    }

    #[inline(always)]
    fn at(&self, _: usize) -> [f32; 3] {
        self.to_array()
    }

    #[inline(always)]
    fn block(&self, _: usize) -> impl Vectors {
        *self
    }

    fn tail(&self, _: usize) -> impl Vectors {
        *self
    }
}

impl<S: Scalars> Vectors for [S; 3] {
    #[inline(always)]
    fn count(&self) -> Option<usize> {
        let [x, y, z] = [self[0].count(), self[1].count(), self[2].count()];
        assert!(
            x == y && y == z,
            "coordinates of different numbers of lanes"
        );
        x
    }

    #[inline(always)]
    fn at(&self, i: usize) -> [f32; 3] {
        [self[0].at(i), self[1].at(i), self[2].at(i)]
    }

    #[inline(always)]
    fn block(&self, i: usize) -> impl Vectors {
        [self[0].block(i), self[1].block(i), self[2].block(i)]
    }

    fn tail(&self, i: usize) -> impl Vectors {
        [self[0].tail(i), self[1].tail(i), self[2].tail(i)]
    }
}

/// Rays and spheres, lane by lane; any part may be shared by all lanes: one sphere against many
/// rays, one ray against many spheres, rays that start in one eye.
#[derive(Debug, Clone, Copy)]
pub struct Batch<O, D, C, R> {
    /// p0 of the rays.
    pub origin: O,
    /// d of the rays, other than zero.
    pub direction: D,
    /// c of the spheres.
    pub center: C,
    /// r of the spheres, at least zero.
    pub radius: R,
}

/// An answer for each lane.
#[derive(Debug, Clone, Default)]
pub struct Solutions {
    /// Miss, tangent or secant.
    pub class: Vec<Class>,
    /// The smaller root, NaN where there is none.
    pub near: Vec<f32>,
    /// The larger root, NaN where there is none.
    pub far: Vec<f32>,
    /// Where the sphere lies, if the line meets it.
    place: Vec<Option<Place>>,
    /// How many lanes each stage of `exact` settled, if it was asked.
    pub stages: [u64; Stage::ALL.len()],
}

impl Solutions {
    /// The answer of lane i.
    pub fn get(&self, i: usize) -> Solution {
        Solution {
            class: self.class[i],
            near: self.near[i],
            far: self.far[i],
            place: self.place[i],
        }
    }

    /// Puts these answers in the place of those that are there.
    pub fn replace(&mut self, answers: impl Iterator<Item = Solution>) {
        self.resize(0);
        for Solution {
            class,
            near,
            far,
            place,
        } in answers
        {
            self.class.push(class);
            self.near.push(near);
            self.far.push(far);
            self.place.push(place);
        }
    }

    fn put_at(&mut self, i: usize, answer: Solution) {
        (self.class[i], self.place[i]) = (answer.class, answer.place);
        (self.near[i], self.far[i]) = (answer.near, answer.far);
    }

    /// Makes room for n answers, in what is there already if it suffices.
    fn resize(&mut self, n: usize) {
        self.class.resize(n, Class::Miss);
        self.near.resize(n, f32::NAN);
        self.far.resize(n, f32::NAN);
        self.place.resize(n, None);
        self.stages = Default::default();
    }
}

impl<O: Vectors, D: Vectors, C: Vectors, R: Scalars> Batch<O, D, C, R> {
    /// The number of lanes: that of every part that is not shared; 1 if all are.
    ///
    /// Panics if two parts have different numbers of lanes.
    pub fn count(&self) -> usize {
        let counts = [
            self.origin.count(),
            self.direction.count(),
            self.center.count(),
            self.radius.count(),
        ];
        let mut counts = counts.into_iter().flatten();
        let first = counts.next().unwrap_or(1);
        assert!(
            counts.all(|count| count == first),
            "parts of different numbers of lanes"
        );
        first
    }

    /// The ray and the sphere of lane i.
    #[inline(always)]
    pub fn get(&self, i: usize) -> (Ray, Sphere) {
        let ray = Ray {
            origin: self.origin.at(i).into(),
            direction: self.direction.at(i).into(),
        };
        let sphere = Sphere {
            center: self.center.at(i).into(),
            radius: self.radius.at(i),
        };
        (ray, sphere)
    }

    /// Class and both roots of each lane, as [`Method::solve`] gives them.
    pub fn solve(&self, method: Method, out: &mut Solutions) {
        out.resize(self.count());
        match method {
            Method::Textbook => self.each::<Textbook>(out),
            Method::Contracted => self.each::<Contracted>(out),
            Method::Unit => self.each::<Unit>(out),
            Method::Citardauq => self.each::<Citardauq>(out),
            Method::Haines => self.each::<Haines>(out),
            Method::Kahan => self.each::<Kahan>(out),
            Method::Double => self.each::<Double>(out),
            Method::Exact => simd::dispatch(Exactly { batch: self, out }),
            Method::Routine(id) => id.solve_all(self, |i, answer| out.put_at(i, answer)),
        }
    }

    /// What [`Batch::solve`] does for `exact` on a processor without AVX2: the same answers.
    pub fn solve_portably(&self, out: &mut Solutions) {
        out.resize(self.count());
        Exactly { batch: self, out }.run();
    }

    /// The visible root of each lane, the least t > 0; NaN where nothing is seen.
    ///
    /// Panics if `out` has not as many lanes.
    pub fn visible(&self, method: Method, out: &mut [f32]) {
        assert_eq!(self.count(), out.len(), "lanes and room for answers");
        if method == Method::Exact {
            simd::dispatch(Exactly { batch: self, out });
        } else if let Method::Routine(id) = method {
            id.solve_all(self, |i, answer| {
                out[i] = answer.visible().unwrap_or(f32::NAN);
            });
        } else {
            for (i, t) in out.iter_mut().enumerate() {
                let (ray, sphere) = self.get(i);
                *t = method.solve(&ray, &sphere).visible().unwrap_or(f32::NAN);
            }
        }
    }

    /// The class of each lane: no roots, for outlines and shadows.
    ///
    /// Panics if `out` has not as many lanes.
    pub fn classes(&self, method: Method, out: &mut [Class]) {
        assert_eq!(self.count(), out.len(), "lanes and room for answers");
        if method == Method::Exact {
            simd::dispatch(Exactly { batch: self, out });
        } else if let Method::Routine(id) = method {
            id.solve_all(self, |i, answer| out[i] = answer.class);
        } else {
            for (i, class) in out.iter_mut().enumerate() {
                let (ray, sphere) = self.get(i);
                *class = method.solve(&ray, &sphere).class;
            }
        }
    }

    fn each<F: Formula>(&self, out: &mut Solutions) {
        simd::dispatch(Each {
            batch: self,
            formula: PhantomData::<F>,
            out,
        });
    }

    /// A block of lanes from lane i on; all must be there.
    #[inline(always)]
    fn block(&self, i: usize) -> Batch<impl Vectors, impl Vectors, impl Vectors, impl Scalars> {
        Batch {
            origin: self.origin.block(i),
            direction: self.direction.block(i),
            center: self.center.block(i),
            radius: self.radius.block(i),
        }
    }

    /// A block of lanes from lane i on, the last one repeated past the end.
    fn tail(&self, i: usize) -> Batch<impl Vectors, impl Vectors, impl Vectors, impl Scalars> {
        Batch {
            origin: self.origin.tail(i),
            direction: self.direction.tail(i),
            center: self.center.tail(i),
            radius: self.radius.tail(i),
        }
    }
}

impl<O: Vectors, D: Vectors, C: Vectors, R: Scalars> Inputs for Batch<O, D, C, R> {
    #[inline(always)]
    fn input(&self, lane: usize) -> Input<f64> {
        Input {
            p0: self.origin.at(lane).map(f64::from),
            d: self.direction.at(lane).map(f64::from),
            center: self.center.at(lane).map(f64::from),
            r: self.radius.at(lane).into(),
        }
    }
}

/// A loop over the single call, which is compiled into it: a call of its own for each lane, from the code
/// for wide vectors into code without, costs more than the work.
struct Each<'a, B, F> {
    batch: &'a B,
    formula: PhantomData<F>,
    out: &'a mut Solutions,
}

impl<O, D, C, R, F> Kernel for Each<'_, Batch<O, D, C, R>, F>
where
    O: Vectors,
    D: Vectors,
    C: Vectors,
    R: Scalars,
    F: Formula,
{
    #[inline(always)]
    fn run(self) {
        let out = self.out;
        let roots = out.near.iter_mut().zip(&mut out.far);
        let out = out.class.iter_mut().zip(&mut out.place).zip(roots);
        for (i, ((class, place), (near, far))) in out.enumerate() {
            let (ray, sphere) = self.batch.get(i);
            let solution = formula::solve::<F>(&ray, &sphere);
            (*class, *place) = (solution.class, solution.place);
            (*near, *far) = (solution.near, solution.far);
        }
    }
}

/// What is asked of `exact`: where the answers go, and so which are computed.
trait Answers {
    fn count(&self) -> usize;
    /// Fills in a block from lane `first` on, and marks the lanes that binary64 leaves open.
    fn fill(&mut self, first: usize, inputs: &impl Inputs) -> [bool; LANES];
    /// Fills in lane i, which that stage settled.
    fn put(&mut self, i: usize, solution: Solution, settled_by: Stage);
}

impl Answers for &mut Solutions {
    #[inline(always)]
    fn count(&self) -> usize {
        self.class.len()
    }

    #[inline(always)]
    fn fill(&mut self, first: usize, inputs: &impl Inputs) -> [bool; LANES] {
        let block = lanes::solve(inputs);
        store(&mut self.class[first..], &block.class);
        store(&mut self.near[first..], &block.near);
        store(&mut self.far[first..], &block.far);
        for (i, place) in self.place[first..].iter_mut().take(LANES).enumerate() {
            let meets = block.class[i].meets();
            *place = meets.then_some(Place::by_roots(block.near[i], block.far[i]));
            let stage = if block.compensated[i] {
                Stage::Compensated
            } else {
                Stage::Binary64
            };
            self.stages[stage as usize] += u64::from(!block.open[i]);
        }
        block.open
    }

    fn put(&mut self, i: usize, solution: Solution, settled_by: Stage) {
        self.class[i] = solution.class;
        self.near[i] = solution.near;
        self.far[i] = solution.far;
        self.place[i] = solution.place;
        self.stages[settled_by as usize] += 1;
    }
}

impl Answers for &mut [f32] {
    #[inline(always)]
    fn count(&self) -> usize {
        self.len()
    }

    #[inline(always)]
    fn fill(&mut self, first: usize, inputs: &impl Inputs) -> [bool; LANES] {
        let block = lanes::solve(inputs);
        let mut visible = block.near;
        for (t, far) in visible.iter_mut().zip(block.far) {
            let ahead = if far > 0.0 { far } else { f32::NAN };
            *t = if *t > 0.0 { *t } else { ahead };
        }
        store(&mut self[first..], &visible);
        block.open
    }

    fn put(&mut self, i: usize, solution: Solution, _: Stage) {
        self[i] = solution.visible().unwrap_or(f32::NAN);
    }
}

impl Answers for &mut [Class] {
    #[inline(always)]
    fn count(&self) -> usize {
        self.len()
    }

    #[inline(always)]
    fn fill(&mut self, first: usize, inputs: &impl Inputs) -> [bool; LANES] {
        let (class, open) = lanes::classes(inputs);
        store(&mut self[first..], &class);
        open
    }

    fn put(&mut self, i: usize, solution: Solution, _: Stage) {
        self[i] = solution.class;
    }
}

/// As many of the block's values as there is room for.
#[inline(always)]
fn store<T: Copy>(out: &mut [T], block: &[T; LANES]) {
    match out.first_chunk_mut::<LANES>() {
        Some(out) => *out = *block,
        None => out.copy_from_slice(&block[..out.len()]),
    }
}

/// `exact` in blocks; what binary64 leaves open goes to the single call.
struct Exactly<'a, B, A> {
    batch: &'a B,
    out: A,
}

impl<O, D, C, R, A> Kernel for Exactly<'_, Batch<O, D, C, R>, A>
where
    O: Vectors,
    D: Vectors,
    C: Vectors,
    R: Scalars,
    A: Answers,
{
    #[inline(always)]
    fn run(self) {
        let Self { batch, mut out } = self;
        let count = out.count();
        let whole = count - count % LANES;
        for first in (0..whole).step_by(LANES) {
            let block = batch.block(first);
            let open = out.fill(first, &block);
            if open.contains(&true) {
                set_aside(batch, first, &open, &mut out);
            }
        }
        if whole < count {
            let tail = batch.tail(whole);
            let open = out.fill(whole, &tail);
            set_aside(batch, whole, &open[..count - whole], &mut out);
        }
    }
}

/// Solves the open ones of the lanes from lane `first` on, each by itself.
#[cold]
#[inline(never)]
fn set_aside<O: Vectors, D: Vectors, C: Vectors, R: Scalars>(
    batch: &Batch<O, D, C, R>,
    first: usize,
    open: &[bool],
    out: &mut impl Answers,
) {
    for (lane, _) in open.iter().enumerate().filter(|&(_, &open)| open) {
        let (ray, sphere) = batch.get(first + lane);
        let (solution, stages) = exact::solve_staged(&ray, &sphere);
        out.put(first + lane, solution, stages.last());
    }
}
