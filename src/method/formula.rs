//! What all methods do alike: a file each has the formula.

#![expect(
    clippy::inline_always,
    reason = "a call would leave the vectors of the loop that a formula is compiled into"
)]

use std::marker::PhantomData;

use super::number::{Input, Scalar};
use super::simd::{self, Kernel};
use super::tape::{Float, Tape, Traced};
use super::trace::{Steps, TraceStep};
use super::truth::Truth;
use super::{Class, Coefficients, Solution};
use crate::geometry::{Ray, Sphere};

/// One way to evaluate the quadratic, written once over its number.
pub(super) trait Formula {
    /// What it computes with.
    type Float: Float;
    /// Every quantity that it names up to the discriminant, in the order of the mathematics.
    type Quantities<T: Scalar>;

    /// The formula itself.
    fn quantities<T: Scalar>(input: &Input<T>) -> Self::Quantities<T>;
    /// Δ, or a quarter of it: its sign is the class.
    fn discriminant<T: Scalar>(quantities: &Self::Quantities<T>) -> T;
    /// A, B, C and Δ.
    fn coefficients<T: Scalar>(quantities: &Self::Quantities<T>) -> [T; 4];
    /// The answer for a line that meets the sphere.
    fn solution(class: Class, quantities: &Self::Quantities<Self::Float>) -> Solution;
    /// The steps up to the discriminant.
    fn steps<'t>(steps: &mut Steps<'t>, quantities: &Self::Quantities<Traced<'t, Self::Float>>);
    /// The steps from there to the roots of a line that meets the sphere.
    fn root_steps<'t>(
        steps: &mut Steps<'t>,
        quantities: &Self::Quantities<Traced<'t, Self::Float>>,
        truth: &Truth,
    );
}

/// Class by the sign of the discriminant, and both roots.
///
/// It is compiled into its caller: into a loop over arrays, for the vectors that the loop has, and into a loop over
/// rays, where a call of its own would wait for what the last one left in the registers.
#[inline(always)]
pub(super) fn solve<F: Formula>(ray: &Ray, sphere: &Sphere) -> Solution {
    let quantities = F::quantities(&Input::new(ray, sphere, F::Float::from));
    let class = Class::of_discriminant(F::discriminant(&quantities).into());
    if !class.meets() {
        return Solution::without_roots(class);
    }
    F::solution(class, &quantities)
}

/// The same for a formula with fused multiply-adds: where the processor has them, that is what runs.
#[inline]
pub(super) fn solve_fused<F: Formula>(ray: &Ray, sphere: &Sphere) -> Solution {
    let mut out = Solution::MISS;
    simd::dispatch(Single::<F> {
        ray,
        sphere,
        formula: PhantomData,
        out: &mut out,
    });
    out
}

/// One ray and one sphere.
struct Single<'a, F> {
    ray: &'a Ray,
    sphere: &'a Sphere,
    formula: PhantomData<F>,
    out: &'a mut Solution,
}

impl<F: Formula> Kernel for Single<'_, F> {
    #[inline(always)]
    fn run(self) {
        *self.out = solve::<F>(self.ray, self.sphere);
    }
}

/// A, B, C and Δ as the formula's own arithmetic has them.
pub(super) fn coefficients<F: Formula>(ray: &Ray, sphere: &Sphere) -> Coefficients {
    let quantities = F::quantities(&Input::new(ray, sphere, F::Float::from));
    let [a, b, c, discriminant] = F::coefficients(&quantities).map(Into::into);
    Coefficients {
        precision: F::Float::PRECISION,
        a,
        b,
        c,
        discriminant,
    }
}

/// The derivation, by the same code over a number that keeps record.
pub(super) fn steps<F: Formula>(ray: &Ray, sphere: &Sphere, truth: &Truth) -> Vec<TraceStep> {
    let tape = Tape::exact_throughout();
    let input = Input::new(ray, sphere, |x| tape.input(F::Float::from(x)));
    let mut steps = Steps::new(&tape, &input);
    let quantities = F::quantities(&input);
    F::steps(&mut steps, &quantities);
    let discriminant = F::discriminant(&quantities).value();
    if Class::of_discriminant(discriminant.into()).meets() {
        F::root_steps(&mut steps, &quantities, truth);
    }
    steps.finish()
}
