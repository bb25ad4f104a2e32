//! The textbook formula in binary32, operation for operation as in the tutorial's
//! `intersectRaySphere`, and the roots that the tutorial leaves to its reader.

use super::formula::Formula;
use super::number::{Input, Scalar};
use super::tape::Traced;
use super::trace::{self, StepText, Steps};
use super::truth::Truth;
use super::{Class, Solution};
use crate::geometry::vector::{dot, sub};

/// The method.
pub(super) struct Textbook;

/// Every quantity that the formula names, in the order of the mathematics.
pub(super) struct TextbookQuantities<T> {
    o: [T; 3],
    a: T,
    b: T,
    oo: T,
    rr: T,
    c: T,
    bb: T,
    four_ac: T,
    discriminant: T,
}

/// B.
pub(super) const B: StepText = StepText {
    symbol: "B",
    formula: "2 d·o",
    template: "2·({d.x}·{o.x} + {d.y}·{o.y} + {d.z}·{o.z})",
    code: "let b = two * dot(d, o);",
    why: "What multiplies t: below 0 if the ray comes nearer to the centre as it starts.",
};

/// 4AC.
pub(super) const FOUR_AC: StepText = StepText {
    symbol: "4AC",
    formula: "4·A·C",
    template: "4·{A}·{C}",
    code: "let four_ac = four * a * c;",
    why: "The second half: below 0 if the ray starts inside.",
};

/// Δ.
pub(super) const DELTA: StepText = StepText {
    symbol: "Δ",
    formula: "B² − 4AC",
    template: "{B²} − {4AC}",
    code: "let discriminant = bb - four_ac;",
    why: "The discriminant: below 0 a miss, 0 a single point, above 0 two points.",
};

/// √Δ and the two roots, (−B ± √Δ) / 2A.
#[inline]
pub(super) fn roots<T: Scalar>(a: T, b: T, discriminant: T) -> [T; 3] {
    let two = T::of(2.0);
    let root = discriminant.sqrt();
    let near = (-b - root) / (two * a);
    let far = (-b + root) / (two * a);
    [root, near, far]
}

impl Formula for Textbook {
    type Float = f32;
    type Quantities<T: Scalar> = TextbookQuantities<T>;

    #[inline]
    fn quantities<T: Scalar>(input: &Input<T>) -> TextbookQuantities<T> {
        let Input { p0, d, center, r } = *input;
        let [two, four] = [2.0, 4.0].map(T::of);

        let o = sub(p0, center);
        let a = dot(d, d);
        let b = two * dot(d, o);
        let oo = dot(o, o);
        let rr = r * r;
        let c = oo - rr;
        let bb = b * b;
        let four_ac = four * a * c;
        let discriminant = bb - four_ac;
        TextbookQuantities {
            o,
            a,
            b,
            oo,
            rr,
            c,
            bb,
            four_ac,
            discriminant,
        }
    }

    #[inline]
    fn discriminant<T: Scalar>(quantities: &TextbookQuantities<T>) -> T {
        quantities.discriminant
    }

    fn coefficients<T: Scalar>(quantities: &TextbookQuantities<T>) -> [T; 4] {
        let TextbookQuantities { a, b, c, .. } = *quantities;
        [a, b, c, quantities.discriminant]
    }

    #[inline]
    fn solution(class: Class, k: &TextbookQuantities<f32>) -> Solution {
        let [_, near, far] = roots(k.a, k.b, k.discriminant);
        Solution::with_roots(class, near, far)
    }

    fn steps<'t>(steps: &mut Steps<'t>, quantities: &TextbookQuantities<Traced<'t, f32>>) {
        steps.vector(trace::O, quantities.o);
        steps.scalar(trace::A, quantities.a);
        steps.scalar(B, quantities.b);
        steps.scalar(trace::OO, quantities.oo);
        steps.scalar(trace::RR, quantities.rr);
        steps.scalar(trace::C, quantities.c);
        steps.scalar(
            StepText {
                symbol: "B²",
                formula: "B·B",
                template: "{B}²",
                code: "let bb = b * b;",
                why: "The first half of the discriminant.",
            },
            quantities.bb,
        );
        steps.scalar(FOUR_AC, quantities.four_ac);
        steps.scalar(DELTA, quantities.discriminant);
    }

    fn root_steps<'t>(
        steps: &mut Steps<'t>,
        k: &TextbookQuantities<Traced<'t, f32>>,
        truth: &Truth,
    ) {
        root_steps(steps, roots(k.a, k.b, k.discriminant), truth);
    }
}

/// The steps from Δ to the roots.
pub(super) fn root_steps<'t>(
    steps: &mut Steps<'t>,
    [root, near, far]: [Traced<'t, f32>; 3],
    truth: &Truth,
) {
    steps.scalar(
        StepText {
            symbol: "√Δ",
            formula: "√Δ",
            template: "√{Δ}",
            code: "let root = discriminant.sqrt();",
            why: "Real only because Δ is not below 0.",
        },
        root,
    );
    steps.root(
        StepText {
            symbol: "near",
            formula: "(−B − √Δ) / 2A",
            template: "(−{B} − {√Δ}) / (2·{A})",
            code: "let near = (-b - root) / (two * a);",
            why: "The smaller root: where the line enters the sphere.",
        },
        near,
        truth.near(),
    );
    steps.root(
        StepText {
            symbol: "far",
            formula: "(−B + √Δ) / 2A",
            template: "(−{B} + {√Δ}) / (2·{A})",
            code: "let far = (-b + root) / (two * a);",
            why: "The larger root: where the line leaves the sphere.",
        },
        far,
        truth.far(),
    );
}
