//! Stage 2: the formulas of stage 1 in numbers of about 106 bits, each an unevaluated sum of two
//! binary64.

use std::cmp::Ordering;
use std::ops::{Add, Mul, Neg, Sub};

use super::binary64::{Estimate, Input, U};
use super::error_free::{fast_two_sum, two_difference, two_product, two_sum};
use super::rounding::{Quadratic, Signs};

/// ε = 2⁻¹⁰³: each operation below is within ε of its exact result, relatively. (The proved bounds,
/// by Joldes, Muller and Popescu, 2017, are 3u², 2u² and 7u² with u² = 2⁻¹⁰⁶, barring terms in u³.)
const EPSILON: f64 = 8.0 * U * U;

/// high + low, with |low| at most half an ulp of high.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DoubleDouble {
    /// The sum rounded once to binary64.
    pub high: f64,
    /// What that rounding left.
    pub low: f64,
}

impl DoubleDouble {
    const fn exact(high: f64) -> Self {
        Self { high, low: 0.0 }
    }

    fn difference(a: f64, b: f64) -> Self {
        two_difference(a, b).into()
    }

    fn square(self) -> Self {
        self * self
    }
}

impl From<(f64, f64)> for DoubleDouble {
    fn from((high, low): (f64, f64)) -> Self {
        Self { high, low }
    }
}

impl Add for DoubleDouble {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let (high, high_error) = two_sum(self.high, other.high);
        let (low, low_error) = two_sum(self.low, other.low);
        let (high, low) = fast_two_sum(high, high_error + low);
        fast_two_sum(high, low_error + low).into()
    }
}

impl Neg for DoubleDouble {
    type Output = Self;

    fn neg(self) -> Self {
        (-self.high, -self.low).into()
    }
}

impl Sub for DoubleDouble {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for DoubleDouble {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let (high, error) = two_product(self.high, other.high);
        let cross = self.high * other.low + self.low * other.high;
        fast_two_sum(high, error + cross).into()
    }
}

impl Mul<f64> for DoubleDouble {
    type Output = Self;

    fn mul(self, factor: f64) -> Self {
        self * Self::exact(factor)
    }
}

/// A, b, C and D in double-double, with bounds on their errors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Doubled {
    /// A = d·d.
    pub a: DoubleDouble,
    /// b = B/2 = o·d.
    pub half_b: DoubleDouble,
    /// C = o·o − r².
    pub c: DoubleDouble,
    /// D = Δ/4 = A r² − |o × d|².
    pub d: DoubleDouble,
    /// How far D may be from its exact value.
    pub d_error: f64,
    /// Σ|`o_i` `d_i`|, against which the error of b is measured.
    half_b_magnitude: f64,
    /// o·o + r², against which the error of C is measured.
    c_magnitude: f64,
}

impl Doubled {
    /// The quadratic in double-double.
    pub fn new(input: &Input<f64>) -> Self {
        let Input { p0, d, center, r } = *input;
        let o = [0, 1, 2].map(|i| DoubleDouble::difference(p0[i], center[i]));
        let a = sum(d.map(|x| DoubleDouble::exact(x * x)));
        let r2 = DoubleDouble::exact(r * r);
        let k = [
            o[1] * d[2] - o[2] * d[1],
            o[2] * d[0] - o[0] * d[2],
            o[0] * d[1] - o[1] * d[0],
        ];
        let terms = [o[0] * d[0], o[1] * d[1], o[2] * d[2]];
        let o2 = sum(o.map(DoubleDouble::square));

        let length: f64 = o.iter().map(|x| x.high.abs()).sum();
        let spread = r * (13.0 * r + 6.0 * length) + 64.0 * EPSILON * (length * length);
        Self {
            a,
            half_b: sum(terms),
            c: o2 - r2,
            d: a * r2 - sum(k.map(DoubleDouble::square)),
            d_error: a.high * (EPSILON * spread),
            half_b_magnitude: terms.iter().map(|x| x.high.abs()).sum(),
            c_magnitude: o2.high + r2.high,
        }
    }
}

impl Quadratic for Doubled {
    /// None if D is within four times its error of zero; never found to be zero.
    fn discriminant(&self) -> Option<Ordering> {
        certain_sign(self.d.high, 4.0 * self.d_error)
    }

    /// Each rounded to binary64, with what that adds to its error.
    fn estimate(&self) -> Estimate<f64> {
        Estimate {
            a: self.a.high,
            half_b: self.half_b.high,
            half_b_error: U * self.half_b.high.abs() + 4.25 * EPSILON * self.half_b_magnitude,
            c: self.c.high,
            c_error: U * self.c.high.abs() + 8.0 * EPSILON * self.c_magnitude,
            d: self.d.high,
            d_error: U * self.d.high + self.d_error,
        }
    }
}

impl Signs for Doubled {
    fn of_value(&self, m: f64) -> Option<Ordering> {
        let twice_b = self.half_b * 2.0;
        let value = (self.a * m + twice_b) * m + self.c;
        let magnitude =
            self.a.high * (m * m) + 2.0 * self.half_b_magnitude * m.abs() + self.c_magnitude;
        certain_sign(value.high, 8.0 * EPSILON * magnitude)
    }

    fn of_slope(&self, m: f64) -> Option<Ordering> {
        let slope = self.a * m + self.half_b;
        let magnitude = self.a.high * m.abs() + self.half_b_magnitude;
        certain_sign(slope.high, 8.0 * EPSILON * magnitude)
    }
}

fn certain_sign(value: f64, error: f64) -> Option<Ordering> {
    if value > error {
        Some(Ordering::Greater)
    } else if value < -error {
        Some(Ordering::Less)
    } else {
        None
    }
}

fn sum([x, y, z]: [DoubleDouble; 3]) -> DoubleDouble {
    x + y + z
}
