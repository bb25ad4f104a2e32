//! Stage 3: A, b and C as integers of 576 bits, D and the midpoint tests in 1152. Nothing is
//! rounded, nothing is allocated, and every question has an answer.

use std::cmp::Ordering;

use super::binary64::{Estimate, Input, U};
use super::rounding::{Quadratic, Signs};
use crate::number::power_of_two;

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
    /// The integer of these words in two's complement.
    fn from_signed(words: [u64; N]) -> Self {
        let negative = words[N - 1] >> 63 == 1;
        Self {
            negative,
            words: negated_if(negative, words),
        }
    }

    fn to_signed(self) -> [u64; N] {
        negated_if(self.negative, self.words)
    }

    fn sign(&self) -> Ordering {
        if self.words.iter().fold(0, |any, word| any | word) == 0 {
            Ordering::Equal
        } else if self.negative {
            Ordering::Less
        } else {
            Ordering::Greater
        }
    }

    fn plus(self, other: Self) -> Self {
        let mut words = self.to_signed();
        let mut carry = false;
        for (word, other) in words.iter_mut().zip(other.to_signed()) {
            let (sum, over) = word.overflowing_add(other);
            let (sum, over_too) = sum.overflowing_add(carry.into());
            (*word, carry) = (sum, over | over_too);
        }
        Self::from_signed(words)
    }

    /// This integer times 2^unit, rounded once to binary64 (nearest, ties to even).
    fn to_f64(self, unit: i32) -> f64 {
        let Some(top) = self.words.iter().rposition(|&word| word != 0) else {
            return 0.0;
        };
        let zeros = self.words[top].leading_zeros();
        let below = if top == 0 { 0 } else { self.words[top - 1] };
        let pair = (u128::from(self.words[top]) << 64 | u128::from(below)) << zeros;
        // What lies below the leading 64 bits only matters by not being zero.
        let lower = &self.words[..top.saturating_sub(1)];
        let rest = lower.iter().fold(pair as u64, |any, word| any | word) != 0;
        let leading = ((pair >> 64) as u64 | u64::from(rest)) as f64;
        let exponent = unit + 64 * top as i32 - zeros as i32;
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

    /// ±factor·2^shift times this integer.
    fn scaled(&self, negative: bool, factor: u64, shift: u32) -> Integer<DOUBLE> {
        let mut words = [0; DOUBLE];
        let (skipped, shift) = ((shift / 64) as usize, shift % 64);
        let (mut carry, mut below) = (0, 0);
        for i in 0..DOUBLE - skipped {
            let word = self.words.get(i).copied().unwrap_or(0);
            let product = u128::from(word) * u128::from(factor) + carry;
            carry = product >> 64;
            let pair = u128::from(product as u64) << 64 | u128::from(below);
            words[skipped + i] = (pair << shift >> 64) as u64;
            below = product as u64;
        }
        Integer {
            negative: self.negative != negative,
            words,
        }
    }
}

/// The words of −x in two's complement if `negate`, of x otherwise; without a branch.
fn negated_if<const N: usize>(negate: bool, mut words: [u64; N]) -> [u64; N] {
    let flip = u64::from(negate).wrapping_neg();
    let mut carry = negate;
    for word in &mut words {
        (*word, carry) = (*word ^ flip).overflowing_add(carry.into());
    }
    words
}

/// A sum of products of two binary32, in units of 2^[`UNIT`]: digits of 32 bits, each with room to
/// grow, so that no carry is passed on before the end.
#[derive(Debug, Clone, Copy)]
struct Sum([i64; 2 * SINGLE]);

impl Sum {
    const ZERO: Self = Self([0; 2 * SINGLE]);

    /// Adds x·y, or subtracts it.
    fn add_product(&mut self, x: Single, y: Single, subtract: bool) {
        const DIGIT: i128 = 0xffff_ffff;
        let magnitude = (x.mantissa * y.mantissa) as i64;
        let negative = x.negative ^ y.negative ^ subtract;
        let signed = if negative { -magnitude } else { magnitude };
        let shift = x.shift + y.shift;
        let at = (shift / 32) as usize;
        let shifted = i128::from(signed) << (shift % 32);
        self.0[at] += (shifted & DIGIT) as i64;
        self.0[at + 1] += (shifted >> 32 & DIGIT) as i64;
        self.0[at + 2] += (shifted >> 64) as i64;
    }

    fn finish(self) -> Integer<SINGLE> {
        let mut carry = 0;
        let digits = self.0.map(|digit| {
            let sum = digit + carry;
            carry = sum >> 32;
            sum as u32
        });
        let mut words = [0; SINGLE];
        for (word, pair) in words.iter_mut().zip(digits.chunks_exact(2)) {
            *word = u64::from(pair[0]) | u64::from(pair[1]) << 32;
        }
        Integer::from_signed(words)
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
        let bits = x.to_bits();
        let exponent = (bits >> 52 & 0x7ff) as i32 - 1023;
        // The 24 bits that a binary32 has; a subnormal one has fewer.
        let mantissa = (bits >> 29 & 0x7f_ffff) | 1 << 23;
        let shift = exponent + 126;
        Self {
            negative: x < 0.0,
            mantissa: mantissa >> (-shift).clamp(0, 63),
            shift: shift.max(0) as u32,
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
pub struct IntegerQuadratic {
    a: Integer<SINGLE>,
    half_b: Integer<SINGLE>,
    c: Integer<SINGLE>,
    /// D = b² − AC.
    d: Integer<DOUBLE>,
}

impl IntegerQuadratic {
    /// The quadratic of these binary32 numbers.
    pub fn new(input: &Input<f64>) -> Self {
        let p0 = input.p0.map(Single::new);
        let d = input.d.map(Single::new);
        let center = input.center.map(Single::new);
        let r = Single::new(input.r);

        let [mut a, mut half_b, mut c] = [Sum::ZERO; 3];
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

        let minus_c = Integer {
            negative: !c.negative,
            ..c
        };
        Self {
            a,
            half_b,
            c,
            d: half_b.times(&half_b).plus(a.times(&minus_c)),
        }
    }

    fn value(&self, m: f64) -> Ordering {
        let m = Midpoint::new(m);
        let unit = MIDPOINT_UNIT.unsigned_abs();
        let square = self.a.scaled(false, m.mantissa * m.mantissa, 2 * m.shift);
        let linear = self
            .half_b
            .scaled(m.negative, 2 * m.mantissa, m.shift + unit);
        let constant = self.c.scaled(false, 1, 2 * unit);
        square.plus(linear).plus(constant).sign()
    }

    fn slope(&self, m: f64) -> Ordering {
        let m = Midpoint::new(m);
        let linear = self.a.scaled(m.negative, m.mantissa, m.shift);
        let constant = self.half_b.scaled(false, 1, MIDPOINT_UNIT.unsigned_abs());
        linear.plus(constant).sign()
    }
}

impl Quadratic for IntegerQuadratic {
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

impl Signs for IntegerQuadratic {
    fn of_value(&self, m: f64) -> Option<Ordering> {
        Some(self.value(m))
    }

    fn of_slope(&self, m: f64) -> Option<Ordering> {
        Some(self.slope(m))
    }
}
