//! The perpendicular form in binary32 (Haines et al., Ray Tracing Gems, chapter 7): how far the
//! line passes from the centre, against the radius. It keeps far spheres.

use super::number::{Input, Scalar};
use super::q_form::{HalfB, Reduced};
use super::tape::Traced;
use super::trace::{StepText, Steps};
use crate::geometry::vector::{dot, scale, sub};

/// The method.
pub(super) struct Haines;

impl Reduced for Haines {
    type Float = f32;
    /// Less its sign, the t at which the line comes closest to the centre; from the centre to that point;
    /// its length squared; half the chord squared.
    type Parts<T: Scalar> = (T, [T; 3], T, T);

    #[inline]
    fn reduced<T: Scalar>(input: &Input<T>, k: &HalfB<T>) -> (Self::Parts<T>, T) {
        let foot = k.b / k.a;
        let l = sub(k.o, scale(foot, input.d));
        let ll = dot(l, l);
        let h = k.rr - ll;
        let reduced = k.a * h;
        ((foot, l, ll, h), reduced)
    }

    fn steps<'t>(
        steps: &mut Steps<'t>,
        (foot, l, ll, h): Self::Parts<Traced<'t, f32>>,
        reduced: Traced<'t, f32>,
    ) {
        steps.scalar(
            StepText {
                symbol: "b/A",
                formula: "b/A",
                template: "{b} / {A}",
                code: "let foot = k.b / k.a;",
                why: "Its negative is the t at which the line comes closest to the centre.",
            },
            foot,
        );
        steps.vector(
            StepText {
                symbol: "l",
                formula: "o − (b/A)d",
                template: "{o} − {b/A}·{d}",
                code: "let l = sub(k.o, scale(foot, input.d));",
                why: "From the centre to that closest point.",
            },
            l,
        );
        steps.scalar(
            StepText {
                symbol: "‖l‖²",
                formula: "l·l",
                template: "{l.x}² + {l.y}² + {l.z}²",
                code: "let ll = dot(l, l);",
                why: "How far the line passes from the centre, squared.",
            },
            ll,
        );
        steps.scalar(
            StepText {
                symbol: "r² − ‖l‖²",
                formula: "r² − ‖l‖²",
                template: "{r²} − {‖l‖²}",
                code: "let h = k.rr - ll;",
                why: "Half the chord, squared: below 0 if the line passes farther away than r.",
            },
            h,
        );
        steps.scalar(
            StepText {
                symbol: "D",
                formula: "A(r² − ‖l‖²)",
                template: "{A}·{r² − ‖l‖²}",
                code: "let reduced = k.a * h;",
                why: "The discriminant, Δ/4: its sign says whether the line meets the sphere.",
            },
            reduced,
        );
    }
}
