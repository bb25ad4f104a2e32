//! The textbook formula in binary32, operation for operation as in the tutorial's
//! `intersectRaySphere`, and the roots that the tutorial leaves to its reader.

use super::{Class, Coefficients, Precision, Solution};
use crate::geometry::{Ray, Sphere};

/// Every quantity that the formula names, in the order of the mathematics.
struct Quadratic {
    a: f32,
    b: f32,
    c: f32,
    discriminant: f32,
}

fn dot(u: [f32; 3], v: [f32; 3]) -> f32 {
    u[0] * v[0] + u[1] * v[1] + u[2] * v[2]
}

fn quadratic(ray: &Ray, sphere: &Sphere) -> Quadratic {
    let d = ray.direction.to_array();
    let [px, py, pz] = ray.origin.to_array();
    let [cx, cy, cz] = sphere.center.to_array();
    let dist = [px - cx, py - cy, pz - cz];

    let a = dot(d, d);
    let b = 2.0 * dot(d, dist);
    let c = dot(dist, dist) - sphere.radius * sphere.radius;
    let discriminant = b * b - 4.0 * a * c;
    Quadratic {
        a,
        b,
        c,
        discriminant,
    }
}

/// Class and roots by (−B ± √Δ) / 2A.
pub(super) fn solve(ray: &Ray, sphere: &Sphere) -> Solution {
    let Quadratic {
        a, b, discriminant, ..
    } = quadratic(ray, sphere);
    let class = Class::of_discriminant(f64::from(discriminant));
    if !class.meets() {
        return Solution::without_roots(class);
    }
    let root = discriminant.sqrt();
    Solution {
        class,
        near: (-b - root) / (2.0 * a),
        far: (-b + root) / (2.0 * a),
    }
}

/// A, B, C and Δ in binary32.
pub(super) fn coefficients(ray: &Ray, sphere: &Sphere) -> Coefficients {
    let Quadratic {
        a,
        b,
        c,
        discriminant,
    } = quadratic(ray, sphere);
    Coefficients {
        precision: Precision::Binary32,
        a: a.into(),
        b: b.into(),
        c: c.into(),
        discriminant: discriminant.into(),
    }
}
