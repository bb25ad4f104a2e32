//! Stage 1: the quadratic in binary64, each quantity with a bound on its error.
//!
//! docs/exactness.md derives every constant here. The bounds need no directed rounding: each has
//! slack for the few roundings of its own evaluation.

use super::error_free::{two_difference, two_square, two_sum};
use super::real::Real;
use crate::geometry::{Ray, Sphere};

/// u = 2⁻⁵³, the unit roundoff of binary64.
pub const U: f64 = f64::EPSILON / 2.0;

/// One ray and one sphere, or several in lanes: binary32 numbers held in binary64.
#[derive(Debug, Clone, Copy)]
pub struct Input<T> {
    /// Where the ray starts.
    pub p0: [T; 3],
    /// d, the direction.
    pub d: [T; 3],
    /// c, the centre of the sphere.
    pub center: [T; 3],
    /// r, the radius.
    pub r: T,
}

impl Input<f64> {
    /// The numbers of this ray and this sphere, which binary64 holds exactly.
    #[inline(always)]
    pub fn new(ray: &Ray, sphere: &Sphere) -> Self {
        Self {
            p0: ray.origin.to_array().map(f64::from),
            d: ray.direction.to_array().map(f64::from),
            center: sphere.center.to_array().map(f64::from),
            r: sphere.radius.into(),
        }
    }
}

/// D = Δ/4 with a bound on its error, and what both come from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Discriminant<T> {
    /// o = p0 − c.
    pub o: [T; 3],
    /// A = d·d.
    pub a: T,
    /// R = A r².
    pub ar2: T,
    /// K² = |o × d|².
    pub k2: T,
    /// D = R − K² (Lagrange's identity).
    pub d: T,
    /// How far D may be from its exact value.
    pub d_error: T,
}

/// A, b, C and D with bounds on the errors of the last three; A is good to 2u of itself.
///
/// Each stage fills one in, and [`roots`] takes it from there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate<T> {
    /// A = d·d.
    pub a: T,
    /// b = B/2 = o·d.
    pub half_b: T,
    /// How far b may be from its exact value.
    pub half_b_error: T,
    /// C = o·o − r².
    pub c: T,
    /// How far C may be from its exact value.
    pub c_error: T,
    /// D = Δ/4.
    pub d: T,
    /// How far D may be from its exact value: at most D/4.
    pub d_error: T,
}

/// A root with a bound on its error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounded<T> {
    /// The root as computed.
    pub value: T,
    /// How far it may be from the exact root.
    pub error: T,
}

/// Both roots by q = −(b + sign(b) s), and what they come from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Roots<T> {
    /// s = √D.
    pub s: T,
    /// Q = |b| + s, the magnitude of q.
    pub q: T,
    /// The smaller root.
    pub near: Bounded<T>,
    /// The larger root.
    pub far: Bounded<T>,
}

impl Discriminant<f64> {
    /// Whether the numbers were finite and d was not zero.
    pub fn is_of_ray_and_sphere(&self) -> bool {
        self.d_error.is_finite() && self.a > 0.0
    }
}

/// D by Lagrange's identity, A r² − |o × d|².
#[inline(always)]
pub fn discriminant<T: Real>(input: &Input<T>) -> Discriminant<T> {
    let Input { p0, d, center, r } = *input;
    let o = [p0[0] - center[0], p0[1] - center[1], p0[2] - center[2]];
    let a = dot(d, d);
    let k = cross(o, d);

    let ar2 = a * (r * r);
    let k2 = dot(k, k);
    let length = (o[0].abs() + o[1].abs()) + o[2].abs();
    let spread = r * (T::of(13.0) * r + T::of(6.0) * length) + T::of(64.0 * U) * (length * length);
    Discriminant {
        o,
        a,
        ar2,
        k2,
        d: ar2 - k2,
        d_error: a * (T::of(U) * spread),
    }
}

/// b and C, which the roots need beside the discriminant; C plain, not compensated.
#[inline(always)]
pub fn estimate<T: Real>(input: &Input<T>, discriminant: &Discriminant<T>) -> Estimate<T> {
    let Input { d, r, .. } = *input;
    let Discriminant {
        o,
        a,
        d: quarter_discriminant,
        d_error,
        ..
    } = *discriminant;
    let terms = [o[0] * d[0], o[1] * d[1], o[2] * d[2]];
    let magnitude = (terms[0].abs() + terms[1].abs()) + terms[2].abs();
    let o2 = dot(o, o);
    let c = o2 - r * r;
    Estimate {
        a,
        half_b: (terms[0] + terms[1]) + terms[2],
        half_b_error: T::of(4.25 * U) * magnitude,
        c,
        c_error: T::of(U) * (T::of(6.0) * o2 + T::of(2.0) * c.abs()),
        d: quarter_discriminant,
        d_error,
    }
}

/// C with the rounding errors of differences, squares and sums added back, for rays that start so
/// near the surface that the plain C cancels; with a bound on its error.
#[inline(always)]
pub fn compensated_c<T: Real>(input: &Input<T>) -> (T, T) {
    let Input { p0, center, r, .. } = *input;
    let (x, x_error) = two_difference(p0[0], center[0]);
    let (y, y_error) = two_difference(p0[1], center[1]);
    let (z, z_error) = two_difference(p0[2], center[2]);
    let (x2, x2_error) = two_square(x);
    let (y2, y2_error) = two_square(y);
    let (z2, z2_error) = two_square(z);
    let r2 = r * r;

    let (sum, sum_error) = two_sum(x2, y2);
    let (o2, o2_error) = two_sum(sum, z2);
    let (high, high_error) = two_sum(o2, -r2);
    let from_differences = (x * x_error + y * y_error) + z * z_error;
    let from_squares = (x2_error + y2_error) + z2_error;
    let from_sums = (sum_error + o2_error) + high_error;
    let c = high + ((from_sums + from_squares) + (from_differences + from_differences));
    let error = T::of(2.0 * U) * c.abs() + T::of(64.0 * U * U) * (o2 + r2);
    (c, error)
}

/// Both roots, for D > 4 × its error: one square root and one division.
#[inline(always)]
pub fn roots<T: Real>(estimate: &Estimate<T>) -> Roots<T> {
    let Estimate {
        a,
        half_b,
        half_b_error,
        c,
        c_error,
        d,
        d_error,
    } = *estimate;
    let s = d.sqrt();
    let q = half_b.abs() + s;

    let aq = a * q;
    let inverse = T::of(1.0) / (aq * s);
    let inverse_aq = s * inverse;
    let inverse_a = q * inverse_aq;
    let inverse_q = a * inverse_aq;
    let inverse_s = aq * inverse;

    let q_error = (half_b_error + T::of(0.5625) * (d_error * inverse_s)) + T::of(12.0 * U) * q;
    let great = q * inverse_a;
    let great_error = q_error * inverse_a;
    let small = c * inverse_q;
    let small_error = T::of(1.75) * ((c_error + q_error * small.abs()) * inverse_q);

    // b < 0: the roots are small ≤ great; otherwise −great ≤ −small.
    Roots {
        s,
        q,
        near: Bounded {
            value: half_b.where_negative(small, -great),
            error: half_b.where_negative(small_error, great_error),
        },
        far: Bounded {
            value: half_b.where_negative(great, -small),
            error: half_b.where_negative(great_error, small_error),
        },
    }
}

#[inline(always)]
fn dot<T: Real>(u: [T; 3], v: [T; 3]) -> T {
    (u[0] * v[0] + u[1] * v[1]) + u[2] * v[2]
}

#[inline(always)]
fn cross<T: Real>(u: [T; 3], v: [T; 3]) -> [T; 3] {
    [
        u[1] * v[2] - u[2] * v[1],
        u[2] * v[0] - u[0] * v[2],
        u[0] * v[1] - u[1] * v[0],
    ]
}
