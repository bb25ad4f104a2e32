//! Half-b and the q-form in binary32: D = b² − AC and roots that never subtract what they add.
//!
//! It mends the roots; what A, b and C lost when they were rounded is lost.

use super::number::{Input, Scalar};
use super::q_form::{HalfB, Reduced};
use super::tape::Traced;
use super::trace::{self, StepText, Steps};

/// The method.
pub(super) struct Citardauq;

impl Reduced for Citardauq {
    type Float = f32;
    /// b² and AC.
    type Parts<T: Scalar> = (T, T);

    #[inline]
    fn reduced<T: Scalar>(_: &Input<T>, k: &HalfB<T>) -> (Self::Parts<T>, T) {
        let bb = k.b * k.b;
        let ac = k.a * k.c;
        let reduced = bb - ac;
        ((bb, ac), reduced)
    }

    fn steps<'t>(
        steps: &mut Steps<'t>,
        (bb, ac): Self::Parts<Traced<'t, f32>>,
        reduced: Traced<'t, f32>,
    ) {
        steps.scalar(trace::BB, bb);
        steps.scalar(
            StepText {
                symbol: "AC",
                formula: "A·C",
                template: "{A}·{C}",
                code: "let ac = k.a * k.c;",
                why: "The second half: below 0 if the ray starts inside.",
            },
            ac,
        );
        steps.scalar(
            StepText {
                symbol: "D",
                formula: "b² − AC",
                template: "{b²} − {AC}",
                code: "let reduced = bb - ac;",
                why: "The discriminant, Δ/4: its sign says whether the line meets the sphere.",
            },
            reduced,
        );
    }
}
