//! Stage 1: the quadratic in binary64, each quantity with a bound on its error.
//!
//! docs/exactness.md derives every constant here. The bounds need no directed rounding: each has
//! slack for the few roundings of its own evaluation.

use super::error_free::{two_difference, two_square, two_sum};
use super::real::WorkingFloat;
use crate::geometry::vector::{cross, dot};
use crate::method::Class;
pub use crate::method::number::Input;

/// u = 2⁻⁵³, the unit roundoff of binary64.
pub const U: f64 = <f64 as WorkingFloat>::U;

/// E = A(13ur + 6uL)(r + 11uL), the bound on the error of D: its three constants.
pub(super) const E_RADIUS: f64 = 13.0;
pub(super) const E_LENGTH: f64 = 6.0;
pub(super) const E_ADDED: f64 = 11.0;

/// The error of b in u times the sum of the sizes of its terms.
pub(super) const HALF_B_ERROR: f64 = 4.25;

/// The error of s in E/s.
pub(super) const ROOT_ERROR: f64 = 0.5625;

/// What of the compensated C is left out or rounded, in u²(o·o + r²).
pub(super) const C_ERROR: f64 = 64.0;

/// What the error of C/q is at most multiplied by for standing on both sides of its bound.
pub(super) const SMALL_FACTOR: f64 = 1.75;

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

/// D by Lagrange's identity, A r² − |o × d|².
#[inline(always)]
pub fn discriminant<T: WorkingFloat>(input: &Input<T>) -> Discriminant<T> {
    let Input { p0, d, center, r } = *input;
    let o = [p0[0] - center[0], p0[1] - center[1], p0[2] - center[2]];
    let a = dot(d, d);
    let k = cross(o, d);

    let ar2 = a * (r * r);
    let k2 = dot(k, k);
    let length = (o[0].abs() + o[1].abs()) + o[2].abs();
    let spread = (T::of(E_RADIUS * T::U) * r + T::of(E_LENGTH * T::U) * length)
        * (r + T::of(E_ADDED * T::U) * length);
    Discriminant {
        o,
        a,
        ar2,
        k2,
        d: ar2 - k2,
        d_error: a * spread,
    }
}

impl Discriminant<f64> {
    /// Four times the error of D: farther from zero than that, D has the sign of the exact D, and
    /// its square root is good enough for the bounds on the roots.
    #[inline(always)]
    pub fn threshold(&self) -> f64 {
        4.0 * self.d_error
    }

    /// The class, if D is farther from zero than [`Discriminant::threshold`].
    #[inline(always)]
    pub fn class(&self) -> Option<Class> {
        let threshold = self.threshold();
        if self.d > threshold {
            Some(Class::Secant)
        } else if self.d < -threshold {
            Some(Class::Miss)
        } else {
            None
        }
    }

    /// Whether the numbers were finite and d was not zero.
    pub fn is_of_ray_and_sphere(&self) -> bool {
        self.d_error.is_finite() && self.a > 0.0
    }
}

/// Both roots by (−b ± s)/A, times 1 − ε and 1 + ε.
///
/// With 29 bits more than the answer needs, this form is good enough unless a root is all but zero
/// or the roots all but meet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Direct<T> {
    /// b = B/2 = o·d.
    pub half_b: T,
    /// s = √D.
    pub s: T,
    /// The smaller root times 1 − ε and 1 + ε.
    pub near: [T; 2],
    /// The larger root times 1 − ε and 1 + ε.
    pub far: [T; 2],
    /// What the error of D must stay below for both roots to be within ε of themselves.
    pub d_error_limit: T,
}

/// Both roots by (−b ± s)/A: one square root, and one division that need not wait for it.
#[inline(always)]
pub fn direct<T: WorkingFloat>(input: &Input<T>, discriminant: &Discriminant<T>) -> Direct<T> {
    let Discriminant { o, a, d, .. } = *discriminant;
    let half_b = dot(o, input.d);
    let inverse = T::of(1.0) / a;
    let less = T::of(1.0 - T::DIRECT_ERROR) * inverse;
    let more = T::of(1.0 + T::DIRECT_ERROR) * inverse;

    let s = d.sqrt();
    let near = -half_b - s;
    let far = s - half_b;
    Direct {
        half_b,
        s,
        near: [near * less, near * more],
        far: [far * less, far * more],
        d_error_limit: T::of(T::DIRECT_ERROR / 2.0) * (s * (half_b.abs() - s).abs()),
    }
}

impl Direct<f64> {
    /// Both roots with bounds on their errors, which are infinite where nothing is certain.
    pub fn roots(&self, discriminant: &Discriminant<f64>) -> [Bounded<f64>; 2] {
        let certain = discriminant.d_error < self.d_error_limit;
        [self.near, self.far].map(|[less, more]| Bounded {
            value: f64::midpoint(less, more),
            error: if certain {
                (more - less).abs() / 2.0
            } else {
                f64::INFINITY
            },
        })
    }
}

/// A, b, C and D with bounds on the errors of the last three; A is good to 2u of itself.
///
/// Each stage fills one in, and `roots` takes it from there.
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
    /// How far D may be from its exact value.
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

/// Both roots by q = b + sign(b) s, with bounds on their errors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Roots<T> {
    /// s = √D with the sign of b.
    pub s: T,
    /// q = b + s.
    pub q: T,
    /// q/A: one root is −q/A, the one farther from zero.
    pub great: Bounded<T>,
    /// C/q: the other root is −C/q.
    pub small: Bounded<T>,
}

impl Roots<f64> {
    /// The smaller root.
    #[inline(always)]
    pub fn near(&self) -> Bounded<f64> {
        if self.q < 0.0 { self.small } else { self.great }.negated()
    }

    /// The larger root.
    #[inline(always)]
    pub fn far(&self) -> Bounded<f64> {
        if self.q < 0.0 { self.great } else { self.small }.negated()
    }
}

impl Bounded<f64> {
    /// The least and the greatest number within the bound, each rounded.
    #[inline(always)]
    pub fn ends(self) -> [f64; 2] {
        [self.value - self.error, self.value + self.error]
    }

    #[inline(always)]
    fn negated(self) -> Self {
        Self {
            value: -self.value,
            error: self.error,
        }
    }
}

/// b, and C with the rounding errors of differences, squares and sums added back: for rays that
/// start so near the surface that the plain C cancels.
#[inline(always)]
pub fn compensated<T: WorkingFloat>(
    input: &Input<T>,
    discriminant: &Discriminant<T>,
) -> Estimate<T> {
    let Input { p0, center, d, r } = *input;
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

    let terms = [x * d[0], y * d[1], z * d[2]];
    let magnitude = (terms[0].abs() + terms[1].abs()) + terms[2].abs();
    Estimate {
        a: discriminant.a,
        half_b: (terms[0] + terms[1]) + terms[2],
        half_b_error: T::of(HALF_B_ERROR * T::U) * magnitude,
        c,
        c_error: T::of(2.0 * T::U) * c.abs() + T::of(C_ERROR * T::U * T::U) * (o2 + r2),
        d: discriminant.d,
        d_error: discriminant.d_error,
    }
}

/// Both roots with bounds on their errors, for D > 4 × its error.
#[inline(always)]
pub fn roots<T: WorkingFloat>(estimate: &Estimate<T>) -> Roots<T> {
    let Estimate {
        a,
        half_b,
        half_b_error,
        c,
        c_error,
        d,
        d_error,
    } = *estimate;
    let s = d.sqrt().copysign(half_b);
    let q = half_b + s;
    let great = q / a;
    let small = c / q;

    let s_error = T::of(ROOT_ERROR) * (d_error / s.abs());
    let q_error = (half_b_error + s_error) + T::of(8.0 * T::U) * q.abs();
    Roots {
        s,
        q,
        great: Bounded {
            value: great,
            error: q_error / a,
        },
        small: Bounded {
            value: small,
            error: T::of(SMALL_FACTOR) * ((c_error + q_error * small.abs()) / q.abs()),
        },
    }
}

/// The two equal roots −b/A of D = 0, for b and A rounded once.
pub fn double_root(estimate: &Estimate<f64>) -> Roots<f64> {
    let value = estimate.half_b / estimate.a;
    let root = Bounded {
        value,
        error: 6.0 * U * value.abs(),
    };
    Roots {
        s: 0.0,
        q: estimate.half_b,
        great: root,
        small: root,
    }
}
