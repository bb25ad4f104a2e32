//! The perpendicular form in binary32 (Haines et al., Ray Tracing Gems, chapter 7): how far the
//! line passes from the centre, against the radius. It keeps far spheres.

use super::number::{Input, Number, dot, scale, sub};
use super::q_form;
use super::tape::Tape;
use super::trace::{Line, Step, Steps};
use super::truth::Truth;
use super::{Coefficients, Solution};
use crate::geometry::{Ray, Sphere};

/// Every quantity that the formula names, in the order of the mathematics.
struct Quadratic<T> {
    k: q_form::Coefficients<T>,
    /// b/A: minus the t at which the line comes closest to the centre.
    foot: T,
    /// From the centre to that closest point.
    l: [T; 3],
    /// The square of its length.
    ll: T,
    /// r² less that: half the chord, squared.
    h: T,
    /// D = Δ/4.
    reduced: T,
}

#[inline]
fn quadratic<T: Number>(input: &Input<T>) -> Quadratic<T> {
    let k = q_form::coefficients(input);
    let foot = k.b / k.a;
    let l = sub(k.o, scale(foot, input.d));
    let ll = dot(l, l);
    let h = k.rr - ll;
    let reduced = k.a * h;
    Quadratic {
        k,
        foot,
        l,
        ll,
        h,
        reduced,
    }
}

/// Class by the sign of D = A(r² − ‖l‖²), roots by the q-form.
///
/// For a loop over arrays: it is compiled into the loop, for the vectors that the loop has.
#[expect(
    clippy::inline_always,
    reason = "a call would leave the loop's vectors"
)]
#[inline(always)]
pub(super) fn solve_in_loop(ray: &Ray, sphere: &Sphere) -> Solution {
    let Quadratic { k, reduced, .. } = quadratic(&Input::new(ray, sphere, |x| x));
    q_form::solution(&k, reduced)
}

/// As [`solve_in_loop`], one by one: a call of its own, so that it is not in the way of shorter ones.
#[inline(never)]
pub(super) fn solve(ray: &Ray, sphere: &Sphere) -> Solution {
    solve_in_loop(ray, sphere)
}

/// A, B = 2b, C and Δ = 4D in binary32, D being A(r² − ‖l‖²): C does not enter Δ here.
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
            symbol: "b/A",
            formula: "b/A",
            template: "{b} / {A}",
            code: "let foot = k.b / k.a;",
            why: "Less its sign, the t at which the line comes closest to the centre.",
        },
        quadratic.foot,
    );
    steps.vector(
        Line {
            symbol: "l",
            formula: "o − (b/A)d",
            template: "{o} − {b/A}·{d}",
            code: "let l = sub(k.o, scale(foot, input.d));",
            why: "From the centre to that closest point.",
        },
        quadratic.l,
    );
    steps.scalar(
        Line {
            symbol: "‖l‖²",
            formula: "l·l",
            template: "{l.x}² + {l.y}² + {l.z}²",
            code: "let ll = dot(l, l);",
            why: "How far the line passes from the centre, squared.",
        },
        quadratic.ll,
    );
    steps.scalar(
        Line {
            symbol: "r² − ‖l‖²",
            formula: "r² − ‖l‖²",
            template: "{r²} − {‖l‖²}",
            code: "let h = k.rr - ll;",
            why: "Half the chord, squared: below 0 if the line passes farther away than r.",
        },
        quadratic.h,
    );
    steps.scalar(
        Line {
            symbol: "D",
            formula: "A(r² − ‖l‖²)",
            template: "{A}·{r² − ‖l‖²}",
            code: "let reduced = k.a * h;",
            why: "The discriminant, Δ/4: its sign says whether the line meets the sphere.",
        },
        quadratic.reduced,
    );
    q_form::solution_steps(&mut steps, k, quadratic.reduced, truth);
    steps.finish()
}
