//! The roots of At² + 2bt + C = 0 without cancellation, given the reduced discriminant
//! D = b² − AC = Δ/4 ≥ 0: the quadratic formula solved for the sum whose terms have one sign.

use super::number::{Input, Number, dot, sub};
use super::tape::{Float, Traced};
use super::trace::{self, Line, Steps};
use super::truth::Truth;
use super::{Class, Precision, Solution};

/// The roots and what they are made of.
#[derive(Debug, Clone, Copy)]
pub(super) struct Roots<T> {
    /// √D.
    pub root: T,
    /// q = −(b + sign(b)√D), with sign(0) = +1.
    pub q: T,
    /// The smaller root.
    pub near: T,
    /// The larger root.
    pub far: T,
    /// Which quotient each root is.
    pub form: Form,
    /// Whether b < 0.
    pub b_negative: bool,
}

/// Which quotients the near and the far root are.
///
/// Without rounding the first is for b ≥ 0 and the second for b < 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Form {
    /// near = q/A, far = C/q.
    NearOverA,
    /// near = C/q, far = q/A.
    FarOverA,
    /// D = 0: both are q/A. With b = 0 too, q = 0 and C/q would be 0/0.
    Double,
}

/// Both roots; near ≤ far unless one of them is NaN.
#[inline]
pub(super) fn roots<T: Number>(a: T, b: T, c: T, reduced: T) -> Roots<T> {
    let zero = T::constant(0.0);
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
    Roots {
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
pub(super) struct Coefficients<T> {
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
pub(super) fn coefficients<T: Number>(input: &Input<T>) -> Coefficients<T> {
    let Input { p0, d, center, r } = *input;

    let o = sub(p0, center);
    let a = dot(d, d);
    let b = dot(d, o);
    let oo = dot(o, o);
    let rr = r * r;
    let c = oo - rr;
    Coefficients { o, a, b, oo, rr, c }
}

/// The answer in binary32: the class by the sign of D, the roots by the q-form.
#[inline]
pub(super) fn solution(k: &Coefficients<f32>, reduced: f32) -> Solution {
    let class = Class::of_discriminant(reduced.into());
    if !class.meets() {
        return Solution::without_roots(class);
    }
    let roots = roots(k.a, k.b, k.c, reduced);
    Solution::with_roots(class, roots.near, roots.far)
}

/// What is told of the coefficients in binary32: A, B = 2b, C and Δ = 4D.
pub(super) fn reported(k: &Coefficients<f32>, reduced: f32) -> super::Coefficients {
    super::Coefficients {
        precision: Precision::Binary32,
        a: k.a.into(),
        b: (2.0 * k.b).into(),
        c: k.c.into(),
        discriminant: (4.0 * reduced).into(),
    }
}

/// The steps from o to C.
pub(super) fn coefficient_steps<'t, F: Float>(
    steps: &mut Steps<'t>,
    k: &Coefficients<Traced<'t, F>>,
) {
    steps.vector(trace::O, k.o);
    steps.scalar(trace::A, k.a);
    steps.scalar(
        Line {
            symbol: "b",
            formula: "d·o",
            template: "{d.x}·{o.x} + {d.y}·{o.y} + {d.z}·{o.z}",
            code: "let b = dot(d, o);",
            why: "Half of B: below 0 if the ray comes nearer to the centre as it starts.",
        },
        k.b,
    );
    steps.scalar(trace::OO, k.oo);
    steps.scalar(trace::RR, k.rr);
    steps.scalar(trace::C, k.c);
}

/// The steps from √D to the roots in binary32, if the line meets the sphere.
pub(super) fn solution_steps<'t>(
    steps: &mut Steps<'t>,
    k: &Coefficients<Traced<'t, f32>>,
    reduced: Traced<'t, f32>,
    truth: &Truth,
) {
    if Class::of_discriminant(reduced.value().into()).meets() {
        let roots = roots(k.a, k.b, k.c, reduced);
        root_steps(steps, &roots, ["near", "far"], truth);
    }
}

/// The steps from √D to the two quotients, which are called `names`, the near one first.
pub(super) fn root_steps<'t, F: Float>(
    steps: &mut Steps<'t>,
    roots: &Roots<Traced<'t, F>>,
    names: [&'static str; 2],
    truth: &Truth,
) {
    steps.scalar(
        Line {
            symbol: "√D",
            formula: "√D",
            template: "√{D}",
            code: "let root = reduced.sqrt();",
            why: "Half the distance between the two roots, times A.",
        },
        roots.root,
    );
    steps.scalar(
        Line {
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
        "The product of the roots is C/A, so this is the other.",
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
        let line = Line {
            symbol,
            formula,
            template,
            code,
            why,
        };
        steps.root(line, value, exact);
    }
}
