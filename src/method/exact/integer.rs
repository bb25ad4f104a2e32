//! Stage 3: A, b and C as integers of 576 bits, D and the midpoint tests in 1152. Nothing is
//! rounded, nothing is allocated, and every question has an answer.

use std::cmp::Ordering;

use super::binary64::{Estimate, Input, U};
use super::plain::power_of_two;
use super::rounding::{Quadratic, Signs};

/// Words of A, b and C: multiples of 2⁻²⁹⁸ below 2²⁶⁰.
const SINGLE: usize = 9;
/// Words of D, f(m) and g(m).
const DOUBLE: usize = 2 * SINGLE;

/// Every product of two binary32 is a whole number of 2⁻²⁹⁸.
const UNIT: i32 = -298;
/// A midpoint between neighbouring binary32 is a whole number of 2⁻¹⁵⁰.
const MIDPOINT_UNIT: i32 = -150;

/// A sign and a magnitude of 64·N bits, least word first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Integer<const N: usize> {
    negative: bool,
    words: [u64; N],
}

impl<const N: usize> Integer<N> {
    fn sign(&self) -> Ordering {
        if self.words.iter().all(|&word| word == 0) {
            Ordering::Equal
        } else if self.negative {
            Ordering::Less
        } else {
            Ordering::Greater
        }
    }

    /// This integer times 2^unit, rounded once to binary64 (nearest, ties to even).
    fn to_f64(self, unit: i32) -> f64 {
        let Some(top) = self.words.iter().rposition(|&word| word != 0) else {
            return 0.0;
        };
        let zeros = self.words[top].leading_zeros();
        let below = if top == 0 { 0 } else { self.words[top - 1] };
        let pair = (u128::from(self.words[top]) << 64 | u128::from(below)) << zeros;
        // What lies below the leading 128 bits only matters by not being zero.
        let rest = self.words[..top.saturating_sub(1)].iter().any(|&w| w != 0);
        let leading = (pair | u128::from(rest)) as f64;
        let exponent = unit + 64 * (top as i32 - 1) - zeros as i32;
        let magnitude = leading * power_of_two(exponent);
        if self.negative { -magnitude } else { magnitude }
    }
}

impl Integer<SINGLE> {
    fn times(&self, other: &Self) -> Integer<DOUBLE> {
        let mut words = [0; DOUBLE];
        for (i, &x) in self.words.iter().enumerate() {
            if x == 0 {
                continue;
            }
            let mut carry = 0;
            for (j, &y) in other.words.iter().enumerate() {
                let sum = u128::from(x) * u128::from(y) + u128::from(words[i + j]) + carry;
                words[i + j] = sum as u64;
                carry = sum >> 64;
            }
            words[i + SINGLE] = carry as u64;
        }
        Integer {
            negative: self.negative != other.negative,
            words,
        }
    }
}

/// A sum in two's complement, wide enough never to overflow.
#[derive(Debug, Clone, Copy)]
struct Sum<const N: usize>([u64; N]);

impl<const N: usize> Sum<N> {
    const ZERO: Self = Self([0; N]);

    /// Adds ±magnitude·2^shift.
    fn add(&mut self, negative: bool, magnitude: u64, shift: u32) {
        let at = (shift / 64) as usize;
        let shifted = u128::from(magnitude) << (shift % 64);
        let parts = [shifted as u64, (shifted >> 64) as u64];
        for (i, part) in parts.into_iter().enumerate() {
            if part != 0 {
                self.add_word(negative, part, at + i);
            }
        }
    }

    fn add_word(&mut self, negative: bool, word: u64, at: usize) {
        let mut carry = word;
        for place in &mut self.0[at..] {
            let (sum, overflow) = if negative {
                place.overflowing_sub(carry)
            } else {
                place.overflowing_add(carry)
            };
            *place = sum;
            if !overflow {
                return;
            }
            carry = 1;
        }
    }

    /// Adds x·y for two binary32 in units of 2^[`UNIT`], or subtracts it.
    fn add_product(&mut self, x: Single, y: Single, subtract: bool) {
        let negative = x.negative != y.negative;
        let shift = x.shift + y.shift;
        self.add(negative != subtract, x.mantissa * y.mantissa, shift);
    }

    /// Adds ±x·factor·2^shift.
    fn add_scaled(&mut self, x: &Integer<SINGLE>, negative: bool, factor: u64, shift: u32) {
        let negative = negative != x.negative;
        for (i, &word) in x.words.iter().enumerate() {
            let product = u128::from(word) * u128::from(factor);
            let shift = shift + 64 * i as u32;
            if word != 0 {
                self.add(negative, product as u64, shift);
                self.add(negative, (product >> 64) as u64, shift + 64);
            }
        }
    }

    fn finish(mut self) -> Integer<N> {
        let negative = self.0[N - 1] >> 63 == 1;
        if negative {
            let mut carry = true;
            for word in &mut self.0 {
                (*word, carry) = (!*word).overflowing_add(carry.into());
            }
        }
        Integer {
            negative,
            words: self.0,
        }
    }
}

/// A binary32 as ±mantissa·2^(shift − 149).
#[derive(Debug, Clone, Copy)]
struct Single {
    negative: bool,
    mantissa: u64,
    shift: u32,
}

impl Single {
    fn new(x: f64) -> Self {
        let bits = (x as f32).to_bits();
        let exponent = bits >> 23 & 0xff;
        let fraction = u64::from(bits & 0x7f_ffff);
        Self {
            negative: bits >> 31 == 1,
            mantissa: if exponent == 0 {
                fraction
            } else {
                fraction | 1 << 23
            },
            shift: exponent.saturating_sub(1),
        }
    }

    fn doubled(self) -> Self {
        Self {
            mantissa: 2 * self.mantissa,
            ..self
        }
    }
}

/// A midpoint as ±mantissa·2^(shift + [`MIDPOINT_UNIT`]), mantissa below 2²⁶.
#[derive(Debug, Clone, Copy)]
struct Midpoint {
    negative: bool,
    mantissa: u64,
    shift: u32,
}

impl Midpoint {
    fn new(m: f64) -> Self {
        let exponent = (m.to_bits() >> 52 & 0x7ff) as i32 - 1023;
        let unit = (exponent - 25).max(MIDPOINT_UNIT);
        Self {
            negative: m < 0.0,
            mantissa: (m.abs() * power_of_two(-unit)) as u64,
            shift: (unit - MIDPOINT_UNIT) as u32,
        }
    }
}

/// The quadratic without any rounding, in units of 2^[`UNIT`]; D in units of its square.
#[derive(Debug, Clone, Copy)]
pub struct Exact {
    a: Integer<SINGLE>,
    half_b: Integer<SINGLE>,
    c: Integer<SINGLE>,
    /// D = b² − AC.
    d: Integer<DOUBLE>,
}

impl Exact {
    /// The quadratic of these binary32 numbers.
    pub fn new(input: &Input<f64>) -> Self {
        let p0 = input.p0.map(Single::new);
        let d = input.d.map(Single::new);
        let center = input.center.map(Single::new);
        let r = Single::new(input.r);

        let [mut a, mut half_b, mut c] = [Sum::<SINGLE>::ZERO; 3];
        for i in 0..3 {
            a.add_product(d[i], d[i], false);
            half_b.add_product(p0[i], d[i], false);
            half_b.add_product(center[i], d[i], true);
            c.add_product(p0[i], p0[i], false);
            c.add_product(p0[i].doubled(), center[i], true);
            c.add_product(center[i], center[i], false);
        }
        c.add_product(r, r, true);
        let [a, half_b, c] = [a, half_b, c].map(Sum::finish);

        let mut d = Sum(half_b.times(&half_b).words);
        let ac = a.times(&c);
        for (i, &word) in ac.words.iter().enumerate() {
            d.add_word(!ac.negative, word, i);
        }
        Self {
            a,
            half_b,
            c,
            d: d.finish(),
        }
    }

    fn value(&self, m: f64) -> Ordering {
        let m = Midpoint::new(m);
        let mut f = Sum::<DOUBLE>::ZERO;
        let unit = MIDPOINT_UNIT.unsigned_abs();
        f.add_scaled(&self.a, false, m.mantissa * m.mantissa, 2 * m.shift);
        f.add_scaled(&self.half_b, m.negative, 2 * m.mantissa, m.shift + unit);
        f.add_scaled(&self.c, false, 1, 2 * unit);
        f.finish().sign()
    }

    fn slope(&self, m: f64) -> Ordering {
        let m = Midpoint::new(m);
        let mut g = Sum::<DOUBLE>::ZERO;
        g.add_scaled(&self.a, m.negative, m.mantissa, m.shift);
        g.add_scaled(&self.half_b, false, 1, MIDPOINT_UNIT.unsigned_abs());
        g.finish().sign()
    }
}

impl Quadratic for Exact {
    fn discriminant(&self) -> Option<Ordering> {
        Some(self.d.sign())
    }

    /// Each the exact value rounded once.
    fn estimate(&self) -> Estimate<f64> {
        let half_b = self.half_b.to_f64(UNIT);
        let c = self.c.to_f64(UNIT);
        let d = self.d.to_f64(2 * UNIT);
        Estimate {
            a: self.a.to_f64(UNIT),
            half_b,
            half_b_error: U * half_b.abs(),
            c,
            c_error: U * c.abs(),
            d,
            d_error: U * d,
        }
    }
}

impl Signs for Exact {
    fn of_value(&self, m: f64) -> Option<Ordering> {
        Some(self.value(m))
    }

    fn of_slope(&self, m: f64) -> Option<Ordering> {
        Some(self.slope(m))
    }
}
