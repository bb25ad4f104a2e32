//! The textbook formula in binary32, operation for operation as in the tutorial's
//! `intersectRaySphere`, and the roots that the tutorial leaves to its reader.

use super::number::{Input, Number, dot, sub};
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
    four_ac: T,
    discriminant: T,
}

#[inline]
fn quadratic<T: Number>(input: &Input<T>) -> Quadratic<T> {
    let Input { p0, d, center, r } = *input;
    let [two, four] = [2.0, 4.0].map(T::constant);

    let o = sub(p0, center);
    let a = dot(d, d);
    let b = two * dot(d, o);
    let oo = dot(o, o);
    let rr = r * r;
    let c = oo - rr;
    let bb = b * b;
    let four_ac = four * a * c;
    let discriminant = bb - four_ac;
    Quadratic {
        o,
        a,
        b,
        oo,
        rr,
        c,
        bb,
        four_ac,
        discriminant,
    }
}

/// √Δ and the two roots.
#[expect(dead_code, reason = "the traced run is to show them")]
struct Roots<T> {
    root: T,
    near: T,
    far: T,
}

#[inline]
fn roots<T: Number>(a: T, b: T, discriminant: T) -> Roots<T> {
    let two = T::constant(2.0);
    let root = discriminant.sqrt();
    let near = (-b - root) / (two * a);
    let far = (-b + root) / (two * a);
    Roots { root, near, far }
}

/// Class and roots by (−B ± √Δ) / 2A.
pub(super) fn solve(ray: &Ray, sphere: &Sphere) -> Solution {
    let Quadratic {
        a, b, discriminant, ..
    } = quadratic(&Input::new(ray, sphere, |x| x));
    let class = Class::of_discriminant(discriminant.into());
    if !class.meets() {
        return Solution::without_roots(class);
    }
    let Roots { near, far, .. } = roots(a, b, discriminant);
    Solution::with_roots(class, near, far)
}

/// A, B, C and Δ in binary32.
pub(super) fn coefficients(ray: &Ray, sphere: &Sphere) -> Coefficients {
    let Quadratic {
        a,
        b,
        c,
        discriminant,
        ..
    } = quadratic(&Input::new(ray, sphere, |x| x));
    Coefficients {
        precision: Precision::Binary32,
        a: a.into(),
        b: b.into(),
        c: c.into(),
        discriminant: discriminant.into(),
    }
}
