//! As `citardauq`, with Kahan's discriminant: b² − AC to within 2 ulp of the rounded A, b and C,
//! by two fused multiply-adds. What was lost before, in A, b and C, it cannot bring back.

use super::number::{Input, Scalar};
use super::q_form::{HalfB, Reduced};
use super::tape::Traced;
use super::trace::{StepText, Steps};

/// The method.
pub(super) struct Kahan;

impl Reduced for Kahan {
    type Float = f32;
    /// AC rounded, the error of that, and b² less it.
    type Parts<T: Scalar> = (T, T, T);

    #[inline]
    fn reduced<T: Scalar>(_: &Input<T>, k: &HalfB<T>) -> (Self::Parts<T>, T) {
        let w = k.a * k.c;
        let e = k.a.mul_add(k.c, -w);
        let f = k.b.mul_add(k.b, -w);
        let reduced = f - e;
        ((w, e, f), reduced)
    }

    fn steps<'t>(
        steps: &mut Steps<'t>,
        (w, e, f): Self::Parts<Traced<'t, f32>>,
        reduced: Traced<'t, f32>,
    ) {
        steps.scalar(
            StepText {
                symbol: "w",
                formula: "A·C",
                template: "{A}·{C}",
                code: "let w = k.a * k.c;",
                why: "The product, rounded; the next step finds what the rounding cost.",
            },
            w,
        );
        steps.scalar(
            StepText {
                symbol: "e",
                formula: "A·C − w, rounded once",
                template: "{A}·{C} − {w}",
                code: "let e = k.a.mul_add(k.c, -w);",
                why: "The error of w, exactly: a fused multiply-add rounds only the difference.",
            },
            e,
        );
        steps.scalar(
            StepText {
                symbol: "f",
                formula: "b² − w, rounded once",
                template: "{b}² − {w}",
                code: "let f = k.b.mul_add(k.b, -w);",
                why: "The difference, in which b² was not rounded.",
            },
            f,
        );
        steps.scalar(
            StepText {
                symbol: "D",
                formula: "f − e",
                template: "{f} − {e}",
                code: "let reduced = f - e;",
                why: "The discriminant, Δ/4: its sign says whether the line meets the sphere.",
            },
            reduced,
        );
    }
}
