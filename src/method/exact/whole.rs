//! Short ways for plain cases: o and r are whole numbers in one unit, d in another.
//!
//! Then A, b and C are integers of 64 bits and D of 128, so that tangents, rays from the surface
//! and ties are settled for certain in a few nanoseconds.

use std::cmp::Ordering;

use super::binary64::{Discriminant, Estimate, Input, U};
use super::error_free::two_difference;
use super::rounding::{Quadratic, Signs};
use crate::geometry::vector::dot;
use crate::number::power_of_two;

/// A, b, C and D as stage 1 computes them, if it rounds nothing: o and r are whole numbers of 12
/// bits in one unit, d in another, so that D has at most 52.
pub fn unrounded(input: &Input<f64>, discriminant: &Discriminant<f64>) -> Option<Estimate<f64>> {
    let Input { p0, d, center, r } = *input;
    let Discriminant {
        o,
        a,
        d: quarter_discriminant,
        ..
    } = *discriminant;
    let [x, y, z] = p0;
    let [cx, cy, cz] = center;
    let lengths = are_whole([x, y, z, cx, cy, cz, r], greatest(o).max(r));
    (lengths && are_whole(d, greatest(d))).then(|| Estimate {
        a,
        half_b: dot(o, d),
        half_b_error: 0.0,
        c: dot(o, o) - r * r,
        c_error: 0.0,
        d: quarter_discriminant,
        d_error: 0.0,
    })
}

/// Whether all are whole numbers of the unit in which `greatest` has 12 bits, and below 2⁵¹ units.
fn are_whole<const N: usize>(values: [f64; N], greatest: f64) -> bool {
    // To add 1.5·2⁵² units, and to take them away again, rounds to whole units.
    let shift = 1.5 * power_of_two(exponent(greatest) + 52 - 11);
    let rounded = values.map(|x| (x + shift) - shift);
    rounded == values
}

/// Magnitudes of the integers for o, r and d stay below 2³⁰, so that |A|, |b|, |C| < 2⁶² and
/// |D| < 2¹²⁴.
const BITS: i32 = 30;

/// The quadratic in whole units.
#[derive(Debug, Clone, Copy)]
pub struct Whole {
    a: i64,
    half_b: i64,
    c: i64,
    /// D = Δ/4.
    d: i128,
    /// log2 of the unit of o and r.
    length_unit: i32,
    /// log2 of the unit of d.
    direction_unit: i32,
}

impl Whole {
    /// The quadratic in whole units, if o, d and r allow it.
    pub fn of(input: &Input<f64>) -> Option<Self> {
        let Input { p0, d, center, r } = *input;
        let differences = [0, 1, 2].map(|i| two_difference(p0[i], center[i]));
        if differences.iter().any(|&(_, error)| error != 0.0) {
            return None;
        }
        let o = differences.map(|(o, _)| o);

        let length_unit = unit(greatest(o).max(r));
        let direction_unit = unit(greatest(d));
        let o = whole(o, length_unit)?;
        let [r] = whole([r], length_unit)?;
        let d = whole(d, direction_unit)?;

        let a = dot(d, d);
        let k = [
            o[1] * d[2] - o[2] * d[1],
            o[2] * d[0] - o[0] * d[2],
            o[0] * d[1] - o[1] * d[0],
        ];
        let square = |x: i64| i128::from(x) * i128::from(x);
        Some(Self {
            a,
            half_b: dot(o, d),
            c: dot(o, o) - r * r,
            d: i128::from(a) * i128::from(r * r) - k.map(square).iter().sum::<i128>(),
            length_unit,
            direction_unit,
        })
    }

    /// m in whole units of t over 2ⁿ: (X, n). None where m has more bits than fit.
    fn in_units(&self, m: f64) -> Option<(i128, u32)> {
        let t = m * power_of_two(self.direction_unit - self.length_unit);
        let (mantissa, exponent) = odd_mantissa(t);
        if exponent >= 0 {
            let x = shifted(mantissa.into(), exponent.unsigned_abs())?;
            Some((x, 0))
        } else {
            Some((mantissa.into(), exponent.unsigned_abs()))
        }
    }
}

impl Quadratic for Whole {
    fn discriminant(&self) -> Option<Ordering> {
        Some(self.d.cmp(&0))
    }

    /// Each the exact value rounded once.
    fn estimate(&self) -> Estimate<f64> {
        let half_b = self.half_b as f64 * power_of_two(self.length_unit + self.direction_unit);
        let c = self.c as f64 * power_of_two(2 * self.length_unit);
        let d = self.d as f64 * power_of_two(2 * (self.length_unit + self.direction_unit));
        Estimate {
            a: self.a as f64 * power_of_two(2 * self.direction_unit),
            half_b,
            half_b_error: U * half_b.abs(),
            c,
            c_error: U * c.abs(),
            d,
            d_error: U * d,
        }
    }
}

impl Signs for Whole {
    fn of_value(&self, m: f64) -> Option<Ordering> {
        let (x, n) = self.in_units(m)?;
        let square = i128::from(self.a).checked_mul(x.checked_mul(x)?)?;
        let linear = shifted(i128::from(self.half_b).checked_mul(x)?, n + 1)?;
        let constant = shifted(self.c.into(), 2 * n)?;
        let value = square.checked_add(linear)?.checked_add(constant)?;
        Some(value.cmp(&0))
    }

    fn of_slope(&self, m: f64) -> Option<Ordering> {
        let (x, n) = self.in_units(m)?;
        let linear = i128::from(self.a).checked_mul(x)?;
        let slope = linear.checked_add(shifted(self.half_b.into(), n)?)?;
        Some(slope.cmp(&0))
    }
}

/// log2 of a unit in which `greatest` lies between 2²⁹ and 2³⁰.
fn unit(greatest: f64) -> i32 {
    if greatest == 0.0 {
        0
    } else {
        exponent(greatest) + 1 - BITS
    }
}

/// The numbers in units of 2^unit, if that makes each an integer.
fn whole<const N: usize>(values: [f64; N], unit: i32) -> Option<[i64; N]> {
    let scale = power_of_two(-unit);
    let integers = values.map(|x| (x * scale) as i64);
    let fits = (0..N).all(|i| integers[i] as f64 == values[i] * scale);
    fits.then_some(integers)
}

/// x·2ⁿ, if it fits.
fn shifted(x: i128, n: u32) -> Option<i128> {
    let shifted = x.checked_shl(n)?;
    (shifted >> n == x).then_some(shifted)
}

/// t as m·2^e with m odd, or (0, 0).
fn odd_mantissa(t: f64) -> (i64, i32) {
    if t == 0.0 {
        return (0, 0);
    }
    let bits = t.to_bits();
    let magnitude = (bits & ((1 << 52) - 1) | 1 << 52) as i64;
    let zeros = magnitude.trailing_zeros() as i32;
    let odd = magnitude >> zeros;
    let signed = if t < 0.0 { -odd } else { odd };
    (signed, exponent(t) - 52 + zeros)
}

/// ⌊log2 |x|⌋ of a normal number.
fn exponent(x: f64) -> i32 {
    ((x.to_bits() >> 52) & 0x7ff) as i32 - 1023
}

fn greatest(v: [f64; 3]) -> f64 {
    v[0].abs().max(v[1].abs()).max(v[2].abs())
}
