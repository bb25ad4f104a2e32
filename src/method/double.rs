//! Lagrange's identity in binary64: D = A r² − ‖o × d‖² and the q-form; the roots are rounded to
//! binary32 at the end.

use super::number::{Input, Scalar};
use super::q_form::{HalfB, QFormRoots, Reduced, RoundsRoots, root_steps};
use super::tape::Traced;
use super::trace::{StepText, Steps};
use super::truth::Truth;
use super::{Class, Solution};
use crate::geometry::vector::{cross, dot};

/// The method.
pub(super) struct Double;

impl Reduced for Double {
    type Float = f64;
    /// o × d, which is as long as d times the distance at which the line passes the centre; its length
    /// squared; A r².
    type Parts<T: Scalar> = ([T; 3], T, T);

    #[inline]
    fn reduced<T: Scalar>(input: &Input<T>, k: &HalfB<T>) -> (Self::Parts<T>, T) {
        let cross = cross(k.o, input.d);
        let kk = dot(cross, cross);
        let arr = k.a * k.rr;
        let reduced = arr - kk;
        ((cross, kk, arr), reduced)
    }

    fn steps<'t>(
        steps: &mut Steps<'t>,
        (cross, kk, arr): Self::Parts<Traced<'t, f64>>,
        reduced: Traced<'t, f64>,
    ) {
        steps.vector(
            StepText {
                symbol: "o×d",
                formula: "o×d",
                template: "{o} × {d}",
                code: "let cross = cross(k.o, input.d);",
                why: "At right angles to o and d. Its length is |d| times the distance of the line from the centre.",
            },
            cross,
        );
        steps.scalar(
            StepText {
                symbol: "‖o×d‖²",
                formula: "(o×d)·(o×d)",
                template: "{o×d.x}² + {o×d.y}² + {o×d.z}²",
                code: "let kk = dot(cross, cross);",
                why: "That length, squared.",
            },
            kk,
        );
        steps.scalar(
            StepText {
                symbol: "A·r²",
                formula: "A·r²",
                template: "{A}·{r²}",
                code: "let arr = k.a * k.rr;",
                why: "What ‖o×d‖² would be if the line touched the sphere.",
            },
            arr,
        );
        steps.scalar(
            StepText {
                symbol: "D",
                formula: "A·r² − ‖o×d‖²",
                template: "{A·r²} − {‖o×d‖²}",
                code: "let reduced = arr - kk;",
                why: "The discriminant, Δ/4, by Lagrange's identity: only what has to cancel cancels.",
            },
            reduced,
        );
    }
}

impl RoundsRoots for f64 {
    #[inline]
    fn solution(class: Class, roots: &QFormRoots<Self>) -> Solution {
        Solution::with_roots(class, roots.near as f32, roots.far as f32)
    }

    fn steps<'t>(steps: &mut Steps<'t>, roots: &QFormRoots<Traced<'t, Self>>, truth: &Truth) {
        root_steps(steps, roots, ["near₆₄", "far₆₄"], truth);
        let near = StepText {
            symbol: "near",
            formula: "near₆₄ rounded to binary32",
            template: "{near₆₄}",
            code: "Solution::with_roots(class, roots.near as f32, roots.far as f32)",
            why: "The answer is a binary32, as the inputs are.",
        };
        let far = StepText {
            symbol: "far",
            formula: "far₆₄ rounded to binary32",
            template: "{far₆₄}",
            ..near
        };
        steps.stated(near, roots.near.value() as f32, truth.near());
        steps.stated(far, roots.far.value() as f32, truth.far());
    }
}
