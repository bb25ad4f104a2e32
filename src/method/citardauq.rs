//! Half-b and the q-form in binary32: D = b² − AC and roots that never subtract what they add.
//!
//! It mends the roots; what A, b and C lost when they were rounded is lost.

use super::number::{Input, Number};
use super::q_form;
use super::tape::Tape;
use super::trace::{Line, Step, Steps};
use super::truth::Truth;
use super::{Coefficients, Solution};
use crate::geometry::{Ray, Sphere};

/// Every quantity that the formula names, in the order of the mathematics.
struct Quadratic<T> {
    k: q_form::Coefficients<T>,
    bb: T,
    ac: T,
    /// D = Δ/4.
    reduced: T,
}

#[inline]
fn quadratic<T: Number>(input: &Input<T>) -> Quadratic<T> {
    let k = q_form::coefficients(input);
    let bb = k.b * k.b;
    let ac = k.a * k.c;
    let reduced = bb - ac;
    Quadratic { k, bb, ac, reduced }
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
            symbol: "b²",
            formula: "b·b",
            template: "{b}²",
            code: "let bb = k.b * k.b;",
            why: "The first half of the discriminant.",
        },
        quadratic.bb,
    );
    steps.scalar(
        Line {
            symbol: "AC",
            formula: "A·C",
            template: "{A}·{C}",
            code: "let ac = k.a * k.c;",
            why: "The second half: below 0 if the ray starts inside.",
        },
        quadratic.ac,
    );
    steps.scalar(
        Line {
            symbol: "D",
            formula: "b² − AC",
            template: "{b²} − {AC}",
            code: "let reduced = bb - ac;",
            why: "The discriminant, Δ/4: its sign says whether the line meets the sphere.",
        },
        quadratic.reduced,
    );
    q_form::solution_steps(&mut steps, k, quadratic.reduced, truth);
    steps.finish()
}
