//! The roots of At² + 2bt + C = 0 without cancellation, given the reduced discriminant
//! D = b² − AC = Δ/4 ≥ 0: the quadratic formula solved for the sum whose terms have one sign.

use super::formula::Formula;
use super::number::{Input, Scalar};
use super::tape::{Float, Traced};
use super::trace::{self, StepText, Steps};
use super::truth::Truth;
use super::{Class, Solution};
use crate::geometry::vector::{dot, sub};

/// The roots and what they are made of.
#[derive(Debug, Clone, Copy)]
pub(super) struct QFormRoots<T> {
    /// √D.
    root: T,
    /// q = −(b + sign(b)√D), with sign(0) = +1.
    q: T,
    /// The smaller root.
    pub near: T,
    /// The larger root.
    pub far: T,
    /// Which quotient each root is.
    form: Form,
    /// Whether b < 0.
    b_negative: bool,
}

/// Which quotients the near and the far root are.
///
/// Without rounding the first is for b ≥ 0 and the second for b < 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Form {
    /// near = q/A, far = C/q.
    NearOverA,
    /// near = C/q, far = q/A.
    FarOverA,
    /// D = 0: both are q/A. With b = 0 too, q = 0 and C/q would be 0/0.
    Double,
}

/// Both roots; near ≤ far unless one of them is NaN.
#[inline]
fn roots<T: Scalar>(a: T, b: T, c: T, reduced: T) -> QFormRoots<T> {
    let zero = T::of(0.0);
    let root = reduced.sqrt();
    let signed_root = if b < zero { -root } else { root };
    let q = -(b + signed_root);
    let (near, far, form) = if reduced == zero {
        let both = q / a;
        (both, both, Form::Double)
    } else if b < zero {
        (c / q, q / a, Form::FarOverA)
    } else {
        (q / a, c / q, Form::NearOverA)
    };
    // C was rounded apart from D: where the two roots all but agree they can change places.
    let (near, far, form) = match form {
        Form::NearOverA if near > far => (far, near, Form::FarOverA),
        Form::FarOverA if near > far => (far, near, Form::NearOverA),
        form => (near, far, form),
    };
    QFormRoots {
        root,
        q,
        near,
        far,
        form,
        b_negative: b < zero,
    }
}

/// The coefficients that every method with half-b forms alike.
#[derive(Debug, Clone, Copy)]
pub(super) struct HalfB<T> {
    /// o = p0 − c.
    pub o: [T; 3],
    /// A = d·d.
    pub a: T,
    /// b = d·o = B/2.
    pub b: T,
    /// |o|².
    pub oo: T,
    /// r².
    pub rr: T,
    /// C = |o|² − r².
    pub c: T,
}

/// A, b and C of a ray and a sphere.
#[inline]
fn coefficients<T: Scalar>(input: &Input<T>) -> HalfB<T> {
    let Input { p0, d, center, r } = *input;

    let o = sub(p0, center);
    let a = dot(d, d);
    let b = dot(d, o);
    let oo = dot(o, o);
    let rr = r * r;
    let c = oo - rr;
    HalfB { o, a, b, oo, rr, c }
}

/// A method with half-b and the q-form: what it has of its own is how it comes to D.
pub(super) trait Reduced {
    /// What it computes with.
    type Float: RoundsRoots;
    /// What D is made of, in the order of the mathematics.
    type Parts<T: Scalar>: Copy;

    /// The formula itself: D = Δ/4, and what it is made of.
    fn reduced<T: Scalar>(input: &Input<T>, k: &HalfB<T>) -> (Self::Parts<T>, T);
    /// The steps from C to D.
    fn steps<'t>(
        steps: &mut Steps<'t>,
        parts: Self::Parts<Traced<'t, Self::Float>>,
        reduced: Traced<'t, Self::Float>,
    );
}

/// A float whose roots by the q-form become the answer in binary32.
pub(super) trait RoundsRoots: Float {
    /// The answer.
    fn solution(class: Class, roots: &QFormRoots<Self>) -> Solution;
    /// The steps from D to the answer.
    fn steps<'t>(steps: &mut Steps<'t>, roots: &QFormRoots<Traced<'t, Self>>, truth: &Truth);
}

impl RoundsRoots for f32 {
    #[inline]
    fn solution(class: Class, roots: &QFormRoots<Self>) -> Solution {
        Solution::with_roots(class, roots.near, roots.far)
    }

    fn steps<'t>(steps: &mut Steps<'t>, roots: &QFormRoots<Traced<'t, Self>>, truth: &Truth) {
        root_steps(steps, roots, ["near", "far"], truth);
    }
}

/// The coefficients, what D is made of, and D.
pub(super) struct ReducedQuantities<T, P> {
    k: HalfB<T>,
    parts: P,
    reduced: T,
}

impl<T: Scalar, P> ReducedQuantities<T, P> {
    #[inline]
    fn roots(&self) -> QFormRoots<T> {
        roots(self.k.a, self.k.b, self.k.c, self.reduced)
    }
}

impl<M: Reduced> Formula for M {
    type Float = M::Float;
    type Quantities<T: Scalar> = ReducedQuantities<T, M::Parts<T>>;

    #[inline]
    fn quantities<T: Scalar>(input: &Input<T>) -> Self::Quantities<T> {
        let k = coefficients(input);
        let (parts, reduced) = M::reduced(input, &k);
        ReducedQuantities { k, parts, reduced }
    }

    #[inline]
    fn discriminant<T: Scalar>(quantities: &Self::Quantities<T>) -> T {
        quantities.reduced
    }

    /// B = 2b, Δ = 4D.
    fn coefficients<T: Scalar>(
        ReducedQuantities { k, reduced, .. }: &Self::Quantities<T>,
    ) -> [T; 4] {
        [k.a, T::of(2.0) * k.b, k.c, T::of(4.0) * *reduced]
    }

    #[inline]
    fn solution(class: Class, quantities: &Self::Quantities<Self::Float>) -> Solution {
        M::Float::solution(class, &quantities.roots())
    }

    fn steps<'t>(steps: &mut Steps<'t>, quantities: &Self::Quantities<Traced<'t, Self::Float>>) {
        coefficient_steps(steps, &quantities.k);
        <M as Reduced>::steps(steps, quantities.parts, quantities.reduced);
    }

    fn root_steps<'t>(
        steps: &mut Steps<'t>,
        quantities: &Self::Quantities<Traced<'t, Self::Float>>,
        truth: &Truth,
    ) {
        M::Float::steps(steps, &quantities.roots(), truth);
    }
}

/// The steps from o to C.
fn coefficient_steps<'t, F: Float>(steps: &mut Steps<'t>, k: &HalfB<Traced<'t, F>>) {
    steps.vector(trace::O, k.o);
    steps.scalar(trace::A, k.a);
    steps.scalar(trace::HALF_B, k.b);
    steps.scalar(trace::OO, k.oo);
    steps.scalar(trace::RR, k.rr);
    steps.scalar(trace::C, k.c);
}

/// The steps from √D to the two quotients, which are called `names`, the near one first.
pub(super) fn root_steps<'t, F: Float>(
    steps: &mut Steps<'t>,
    roots: &QFormRoots<Traced<'t, F>>,
    names: [&'static str; 2],
    truth: &Truth,
) {
    steps.scalar(
        StepText {
            symbol: "√D",
            formula: "√D",
            template: "√{D}",
            code: "let root = reduced.sqrt();",
            why: "Half the distance between the two roots, times A.",
        },
        roots.root,
    );
    steps.scalar(
        StepText {
            symbol: "q",
            formula: "−(b + sign(b)√D)",
            template: if roots.b_negative {
                "−({b} − {√D})"
            } else {
                "−({b} + {√D})"
            },
            code: "let q = -(b + signed_root);",
            why: "Of the two sums −b ± √D, the one that does not cancel.",
        },
        roots.q,
    );
    let over_a = (
        "q/A",
        "{q} / {A}",
        "This root has q above the line: −b and √D add up.",
    );
    let over_q = (
        "C/q",
        "{C} / {q}",
        "The product of the roots is C/A, so this is the other root.",
    );
    let ([near, far], code) = match roots.form {
        Form::NearOverA => ([over_a, over_q], "(q / a, c / q, Form::NearOverA)"),
        Form::FarOverA => ([over_q, over_a], "(c / q, q / a, Form::FarOverA)"),
        Form::Double => {
            let why = "D = 0: both roots are one.";
            ([(over_a.0, over_a.1, why); 2], "let both = q / a;")
        }
    };
    let values = [
        (near, roots.near, truth.near()),
        (far, roots.far, truth.far()),
    ];
    for (symbol, ((formula, template, why), value, exact)) in names.into_iter().zip(values) {
        let line = StepText {
            symbol,
            formula,
            template,
            code,
            why,
        };
        steps.root(line, value, exact);
    }
}
