//! The textbook formula as compilers run it that fuse a product into the sum around it: GCC on every
//! target with FMA, clang within one expression. docs/methods.md says which products these are.

use super::formula::Formula;
use super::number::{Input, Scalar};
use super::tape::Traced;
use super::textbook;
use super::trace::{self, StepText, Steps};
use super::truth::Truth;
use super::{Class, Solution};
use crate::geometry::vector::sub;

/// The method.
pub(super) struct Contracted;

/// Every quantity that is rounded and has a name; r² and B² are not.
pub(super) struct ContractedQuantities<T> {
    o: [T; 3],
    a: T,
    b: T,
    oo: T,
    c: T,
    four_ac: T,
    discriminant: T,
}

/// u·v, of whose products only the middle one is rounded.
#[inline]
fn dot<T: Scalar>(u: [T; 3], v: [T; 3]) -> T {
    u[2].mul_add(v[2], u[0].mul_add(v[0], u[1] * v[1]))
}

impl Formula for Contracted {
    type Float = f32;
    type Quantities<T: Scalar> = ContractedQuantities<T>;

    #[inline]
    fn quantities<T: Scalar>(input: &Input<T>) -> ContractedQuantities<T> {
        let Input { p0, d, center, r } = *input;
        let [two, four] = [2.0, 4.0].map(T::of);

        let o = sub(p0, center);
        let a = dot(d, d);
        let b = two * dot(d, o);
        let oo = dot(o, o);
        let c = (-r).mul_add(r, oo);
        let four_ac = four * a * c;
        let discriminant = b.mul_add(b, -four_ac);
        ContractedQuantities {
            o,
            a,
            b,
            oo,
            c,
            four_ac,
            discriminant,
        }
    }

    #[inline]
    fn discriminant<T: Scalar>(quantities: &ContractedQuantities<T>) -> T {
        quantities.discriminant
    }

    fn coefficients<T: Scalar>(quantities: &ContractedQuantities<T>) -> [T; 4] {
        let ContractedQuantities { a, b, c, .. } = *quantities;
        [a, b, c, quantities.discriminant]
    }

    #[inline]
    fn solution(class: Class, k: &ContractedQuantities<f32>) -> Solution {
        let [_, near, far] = textbook::roots(k.a, k.b, k.discriminant);
        Solution::with_roots(class, near, far)
    }

    fn steps<'t>(steps: &mut Steps<'t>, quantities: &ContractedQuantities<Traced<'t, f32>>) {
        steps.vector(trace::O, quantities.o);
        steps.scalar(trace::A, quantities.a);
        steps.scalar(textbook::B, quantities.b);
        steps.scalar(trace::OO, quantities.oo);
        steps.scalar(
            StepText {
                template: "{|o|²} − {r}²",
                code: "let c = (-r).mul_add(r, oo);",
                why: "What is left without t; r² is fused into the difference and not rounded.",
                ..trace::C
            },
            quantities.c,
        );
        steps.scalar(textbook::FOUR_AC, quantities.four_ac);
        steps.scalar(
            StepText {
                template: "{B}² − {4AC}",
                code: "let discriminant = b.mul_add(b, -four_ac);",
                why: "The discriminant: B² is fused and exact, 4AC was rounded, so what should cancel may not.",
                ..textbook::DELTA
            },
            quantities.discriminant,
        );
    }

    fn root_steps<'t>(
        steps: &mut Steps<'t>,
        k: &ContractedQuantities<Traced<'t, f32>>,
        truth: &Truth,
    ) {
        let roots = textbook::roots(k.a, k.b, k.discriminant);
        textbook::root_steps(steps, roots, truth);
    }
}
