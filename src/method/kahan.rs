//! As `citardauq`, with Kahan's discriminant: b² − AC to within 2 ulp of the rounded A, b and C,
//! by two fused multiply-adds. What was lost before, in A, b and C, it cannot bring back.

use super::number::{Fused, Input};
use super::q_form;
use super::tape::Tape;
use super::trace::{Line, Step, Steps};
use super::truth::Truth;
use super::{Coefficients, Solution};
use crate::geometry::{Ray, Sphere};

/// Every quantity that the formula names, in the order of the mathematics.
struct Quadratic<T> {
    k: q_form::Coefficients<T>,
    /// w = AC, rounded.
    w: T,
    /// e = AC − w, the error of w.
    e: T,
    /// f = b² − w.
    f: T,
    /// D = Δ/4.
    reduced: T,
}

#[inline]
fn quadratic<T: Fused>(input: &Input<T>) -> Quadratic<T> {
    let k = q_form::coefficients(input);
    let w = k.a * k.c;
    let e = k.a.mul_add(k.c, -w);
    let f = k.b.mul_add(k.b, -w);
    let reduced = f - e;
    Quadratic {
        k,
        w,
        e,
        f,
        reduced,
    }
}

/// Class by the sign of D, roots by the q-form.
pub(super) fn solve(ray: &Ray, sphere: &Sphere) -> Solution {
    let Quadratic { k, reduced, .. } = quadratic(&Input::new(ray, sphere, |x| x));
    q_form::solution(&k, reduced)
}

/// A, B = 2b, C and Δ = 4D in binary32.
pub(super) fn coefficients(ray: &Ray, sphere: &Sphere) -> Coefficients {
    let Quadratic { k, reduced, .. } = quadratic(&Input::new(ray, sphere, |x| x));
    q_form::reported(&k, reduced)
}

/// The derivation, by the same code over a number that keeps record.
pub(super) fn steps(ray: &Ray, sphere: &Sphere, truth: &Truth) -> Vec<Step> {
    let tape = Tape::default();
    let input = Input::new(ray, sphere, |x| tape.input(x));
    let mut steps = Steps::new(&tape, &input);
    let quadratic = quadratic(&input);
    let k = &quadratic.k;
    q_form::coefficient_steps(&mut steps, k);
    steps.scalar(
        Line {
            symbol: "w",
            formula: "A·C",
            template: "{A}·{C}",
            code: "let w = k.a * k.c;",
            why: "The product, rounded; the next step finds what the rounding cost.",
        },
        quadratic.w,
    );
    steps.scalar(
        Line {
            symbol: "e",
            formula: "A·C − w, rounded once",
            template: "{A}·{C} − {w}",
            code: "let e = k.a.mul_add(k.c, -w);",
            why: "The error of w, exactly: a fused multiply-add rounds only the difference.",
        },
        quadratic.e,
    );
    steps.scalar(
        Line {
            symbol: "f",
            formula: "b² − w, rounded once",
            template: "{b}² − {w}",
            code: "let f = k.b.mul_add(k.b, -w);",
            why: "The difference, in which b² was not rounded.",
        },
        quadratic.f,
    );
    steps.scalar(
        Line {
            symbol: "D",
            formula: "f − e",
            template: "{f} − {e}",
            code: "let reduced = f - e;",
            why: "The discriminant, Δ/4: its sign says whether the line meets the sphere.",
        },
        quadratic.reduced,
    );
    q_form::solution_steps(&mut steps, k, quadratic.reduced, truth);
    steps.finish()
}
