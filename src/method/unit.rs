//! What many engines run: half-b with d taken to be of length 1, so that A is 1 and drops out:
//! D = b² − C and t = −b ± √D, in binary32. Right only as far as ‖d‖ is 1.

use super::formula::Formula;
use super::number::{Input, Scalar};
use super::tape::Traced;
use super::trace::{self, StepText, Steps};
use super::truth::Truth;
use super::{Class, Solution};
use crate::geometry::vector::{dot, sub};

/// The method.
pub(super) struct Unit;

/// Every quantity that the formula names, in the order of the mathematics, and d.
pub(super) struct UnitQuantities<T> {
    d: [T; 3],
    o: [T; 3],
    b: T,
    oo: T,
    rr: T,
    c: T,
    bb: T,
    reduced: T,
}

/// √D and the two roots, −b ± √D.
#[inline]
fn roots<T: Scalar>(quantities: &UnitQuantities<T>) -> [T; 3] {
    let UnitQuantities { b, reduced, .. } = *quantities;
    let root = reduced.sqrt();
    let near = -b - root;
    let far = -b + root;
    [root, near, far]
}

impl Formula for Unit {
    type Float = f32;
    type Quantities<T: Scalar> = UnitQuantities<T>;

    #[inline]
    fn quantities<T: Scalar>(input: &Input<T>) -> UnitQuantities<T> {
        let Input { p0, d, center, r } = *input;

        let o = sub(p0, center);
        let b = dot(d, o);
        let oo = dot(o, o);
        let rr = r * r;
        let c = oo - rr;
        let bb = b * b;
        let reduced = bb - c;
        UnitQuantities {
            d,
            o,
            b,
            oo,
            rr,
            c,
            bb,
            reduced,
        }
    }

    #[inline]
    fn discriminant<T: Scalar>(quantities: &UnitQuantities<T>) -> T {
        quantities.reduced
    }

    /// A is taken to be 1; B = 2b, Δ = 4D.
    fn coefficients<T: Scalar>(k: &UnitQuantities<T>) -> [T; 4] {
        let [one, two, four] = [1.0, 2.0, 4.0].map(T::of);
        [one, two * k.b, k.c, four * k.reduced]
    }

    #[inline]
    fn solution(class: Class, quantities: &UnitQuantities<f32>) -> Solution {
        let [_, near, far] = roots(quantities);
        Solution::with_roots(class, near, far)
    }

    /// Beside A and D is what they are with d as it is.
    fn steps<'t>(steps: &mut Steps<'t>, quantities: &UnitQuantities<Traced<'t, f32>>) {
        let UnitQuantities { d, b, c, bb, .. } = *quantities;
        let a = dot(d, d);
        steps.vector(trace::O, quantities.o);
        steps.stated(
            StepText {
                symbol: "A",
                formula: "1",
                template: "1",
                code: "let reduced = bb - c;",
                why: "d·d, which multiplies t², is taken to be 1 and left out.",
            },
            1.0,
            a.exact(),
        );
        steps.scalar(trace::HALF_B, b);
        steps.scalar(trace::OO, quantities.oo);
        steps.scalar(trace::RR, quantities.rr);
        steps.scalar(trace::C, c);
        steps.scalar(
            StepText {
                code: "let bb = b * b;",
                ..trace::BB
            },
            bb,
        );
        steps.root(
            StepText {
                symbol: "D",
                formula: "b² − C",
                template: "{b²} − {C}",
                code: "let reduced = bb - c;",
                why: "The discriminant, Δ/4, if A is 1: its sign says whether the line meets the sphere.",
            },
            quantities.reduced,
            (bb - a * c).exact(),
        );
    }

    fn root_steps<'t>(
        steps: &mut Steps<'t>,
        quantities: &UnitQuantities<Traced<'t, f32>>,
        truth: &Truth,
    ) {
        let [root, near, far] = roots(quantities);
        steps.scalar(
            StepText {
                symbol: "√D",
                formula: "√D",
                template: "√{D}",
                code: "let root = reduced.sqrt();",
                why: "Half the distance between the two roots.",
            },
            root,
        );
        steps.root(
            StepText {
                symbol: "near",
                formula: "−b − √D",
                template: "−{b} − {√D}",
                code: "let near = -b - root;",
                why: "The smaller root: where the line enters the sphere.",
            },
            near,
            truth.near(),
        );
        steps.root(
            StepText {
                symbol: "far",
                formula: "−b + √D",
                template: "−{b} + {√D}",
                code: "let far = -b + root;",
                why: "The larger root: where the line leaves the sphere.",
            },
            far,
            truth.far(),
        );
    }
}
