//! Lagrange's identity in binary64: D = A r² − ‖o × d‖² and the q-form; the roots are rounded to
//! binary32 at the end.

use super::number::{Input, Number, cross, dot};
use super::q_form::{self, roots};
use super::tape::Tape;
use super::trace::{Line, Step, Steps};
use super::truth::Truth;
use super::{Class, Coefficients, Precision, Solution};
use crate::geometry::{Ray, Sphere};

/// Every quantity that the formula names, in the order of the mathematics.
struct Quadratic<T> {
    k: q_form::Coefficients<T>,
    /// o × d: its length is that of d times the distance at which the line passes the centre.
    cross: [T; 3],
    /// ‖o × d‖².
    kk: T,
    /// A r².
    arr: T,
    /// D = Δ/4.
    reduced: T,
}

#[inline]
fn quadratic<T: Number>(input: &Input<T>) -> Quadratic<T> {
    let k = q_form::coefficients(input);
    let cross = cross(k.o, input.d);
    let kk = dot(cross, cross);
    let arr = k.a * k.rr;
    let reduced = arr - kk;
    Quadratic {
        k,
        cross,
        kk,
        arr,
        reduced,
    }
}

/// Class by the sign of D, roots by the q-form.
///
/// For a loop over arrays: it is compiled into the loop, for the vectors that the loop has.
#[expect(
    clippy::inline_always,
    reason = "a call would leave the loop's vectors"
)]
#[inline(always)]
pub(super) fn solve_in_loop(ray: &Ray, sphere: &Sphere) -> Solution {
    let Quadratic { k, reduced, .. } = quadratic(&Input::new(ray, sphere, f64::from));
    let class = Class::of_discriminant(reduced);
    if !class.meets() {
        return Solution::without_roots(class);
    }
    let roots = roots(k.a, k.b, k.c, reduced);
    Solution::with_roots(class, roots.near as f32, roots.far as f32)
}

/// As [`solve_in_loop`], one by one: a call of its own, so that it is not in the way of shorter ones.
#[inline(never)]
pub(super) fn solve(ray: &Ray, sphere: &Sphere) -> Solution {
    solve_in_loop(ray, sphere)
}

/// A, B = 2b, C and Δ = 4D in binary64.
pub(super) fn coefficients(ray: &Ray, sphere: &Sphere) -> Coefficients {
    let Quadratic { k, reduced, .. } = quadratic(&Input::new(ray, sphere, f64::from));
    Coefficients {
        precision: Precision::Binary64,
        a: k.a,
        b: 2.0 * k.b,
        c: k.c,
        discriminant: 4.0 * reduced,
    }
}

const NEAR: Line = Line {
    symbol: "near",
    formula: "near₆₄ rounded to binary32",
    template: "{near₆₄}",
    code: "Solution::with_roots(class, roots.near as f32, roots.far as f32)",
    why: "The answer is a binary32, as the inputs are.",
};

const FAR: Line = Line {
    symbol: "far",
    formula: "far₆₄ rounded to binary32",
    template: "{far₆₄}",
    ..NEAR
};

/// The derivation, by the same code over a number that keeps record.
pub(super) fn steps(ray: &Ray, sphere: &Sphere, truth: &Truth) -> Vec<Step> {
    let tape = Tape::default();
    let input = Input::new(ray, sphere, |x| tape.input(f64::from(x)));
    let mut steps = Steps::new(&tape, &input);
    let quadratic = quadratic(&input);
    let k = &quadratic.k;
    q_form::coefficient_steps(&mut steps, k);
    steps.vector(
        Line {
            symbol: "o×d",
            formula: "o×d",
            template: "{o} × {d}",
            code: "let cross = cross(k.o, input.d);",
            why: "At right angles to both; as long as d times the distance at which the line passes the centre.",
        },
        quadratic.cross,
    );
    steps.scalar(
        Line {
            symbol: "‖o×d‖²",
            formula: "(o×d)·(o×d)",
            template: "{o×d.x}² + {o×d.y}² + {o×d.z}²",
            code: "let kk = dot(cross, cross);",
            why: "That length, squared.",
        },
        quadratic.kk,
    );
    steps.scalar(
        Line {
            symbol: "A·r²",
            formula: "A·r²",
            template: "{A}·{r²}",
            code: "let arr = k.a * k.rr;",
            why: "What ‖o×d‖² would be if the line touched the sphere.",
        },
        quadratic.arr,
    );
    steps.scalar(
        Line {
            symbol: "D",
            formula: "A·r² − ‖o×d‖²",
            template: "{A·r²} − {‖o×d‖²}",
            code: "let reduced = arr - kk;",
            why: "The discriminant, Δ/4, by Lagrange's identity: nothing in it cancels but what the question cancels.",
        },
        quadratic.reduced,
    );
    if Class::of_discriminant(quadratic.reduced.value()).meets() {
        let roots = roots(k.a, k.b, k.c, quadratic.reduced);
        q_form::root_steps(&mut steps, &roots, ["near₆₄", "far₆₄"], truth);
        steps.rounded(NEAR, roots.near.value() as f32, truth.near());
        steps.rounded(FAR, roots.far.value() as f32, truth.far());
    }
    steps.finish()
}
