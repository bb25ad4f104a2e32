//! Half-b and the q-form in binary32: D = b² − AC and roots that never subtract what they add.
//!
//! It mends the roots; what A, b and C lost when they were rounded is lost.

use super::number::{Input, Number, dot, sub};
use super::q_form::roots;
use super::{Class, Coefficients, Precision, Solution};
use crate::geometry::{Ray, Sphere};

/// Every quantity that the formula names, in the order of the mathematics.
#[expect(dead_code, reason = "the traced run is to show them")]
struct Quadratic<T> {
    o: [T; 3],
    a: T,
    b: T,
    oo: T,
    rr: T,
    c: T,
    bb: T,
    ac: T,
    /// D = Δ/4.
    reduced: T,
}

#[inline]
fn quadratic<T: Number>(input: &Input<T>) -> Quadratic<T> {
    let Input { p0, d, center, r } = *input;

    let o = sub(p0, center);
    let a = dot(d, d);
    let b = dot(d, o);
    let oo = dot(o, o);
    let rr = r * r;
    let c = oo - rr;
    let bb = b * b;
    let ac = a * c;
    let reduced = bb - ac;
    Quadratic {
        o,
        a,
        b,
        oo,
        rr,
        c,
        bb,
        ac,
        reduced,
    }
}

/// Class by the sign of D, roots by the q-form.
pub(super) fn solve(ray: &Ray, sphere: &Sphere) -> Solution {
    let Quadratic {
        a, b, c, reduced, ..
    } = quadratic(&Input::new(ray, sphere, |x| x));
    let class = Class::of_discriminant(reduced.into());
    if !class.meets() {
        return Solution::without_roots(class);
    }
    let roots = roots(a, b, c, reduced);
    Solution::with_roots(class, roots.near, roots.far)
}

/// A, B = 2b, C and Δ = 4D in binary32.
pub(super) fn coefficients(ray: &Ray, sphere: &Sphere) -> Coefficients {
    let Quadratic {
        a, b, c, reduced, ..
    } = quadratic(&Input::new(ray, sphere, |x| x));
    Coefficients {
        precision: Precision::Binary32,
        a: a.into(),
        b: (2.0 * b).into(),
        c: c.into(),
        discriminant: (4.0 * reduced).into(),
    }
}
