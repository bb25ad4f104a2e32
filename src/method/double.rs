//! Lagrange's identity in binary64: D = A r² − ‖o × d‖² and the q-form; the roots are rounded to
//! binary32 at the end.

use super::number::{Input, Number, cross, dot, sub};
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
    k: [T; 3],
    kk: T,
    arr: T,
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
    let k = cross(o, d);
    let kk = dot(k, k);
    let arr = a * rr;
    let reduced = arr - kk;
    Quadratic {
        o,
        a,
        b,
        oo,
        rr,
        c,
        k,
        kk,
        arr,
        reduced,
    }
}

/// Class by the sign of D, roots by the q-form.
pub(super) fn solve(ray: &Ray, sphere: &Sphere) -> Solution {
    let Quadratic {
        a, b, c, reduced, ..
    } = quadratic(&Input::new(ray, sphere, f64::from));
    let class = Class::of_discriminant(reduced);
    if !class.meets() {
        return Solution::without_roots(class);
    }
    let roots = roots(a, b, c, reduced);
    Solution::with_roots(class, roots.near as f32, roots.far as f32)
}

/// A, B = 2b, C and Δ = 4D in binary64.
pub(super) fn coefficients(ray: &Ray, sphere: &Sphere) -> Coefficients {
    let Quadratic {
        a, b, c, reduced, ..
    } = quadratic(&Input::new(ray, sphere, f64::from));
    Coefficients {
        precision: Precision::Binary64,
        a,
        b: 2.0 * b,
        c,
        discriminant: 4.0 * reduced,
    }
}
