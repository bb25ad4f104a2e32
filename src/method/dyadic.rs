//! Dyadic rationals m·2^e: what sums, differences and products of floating-point numbers are,
//! exactly. Nothing here is rounded.

use std::cmp::Ordering;
use std::ops::{Add, Mul, Neg, Sub};

use dashu_int::ops::BitTest;
use dashu_int::{IBig, Sign};

/// The number mantissa·2^exponent, its mantissa odd or the whole number zero.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Dyadic {
    mantissa: IBig,
    exponent: i64,
}

impl Dyadic {
    /// The number zero.
    pub const ZERO: Self = Self {
        mantissa: IBig::ZERO,
        exponent: 0,
    };

    /// The number mantissa·2^exponent.
    pub fn new(mantissa: IBig, exponent: i64) -> Self {
        match mantissa.trailing_zeros() {
            None => Self::ZERO,
            Some(0) => Self { mantissa, exponent },
            Some(zeros) => Self {
                mantissa: mantissa >> zeros,
                exponent: exponent + zeros as i64,
            },
        }
    }

    /// The number that a binary64, and so any binary32, stands for; none for NaN and ±∞.
    pub fn from_f64(x: f64) -> Option<Self> {
        if !x.is_finite() {
            return None;
        }
        let bits = x.to_bits();
        let fraction = bits & ((1 << 52) - 1);
        let (mantissa, exponent) = match (bits >> 52) & 0x7ff {
            0 => (fraction, -1074),
            biased => (fraction | 1 << 52, biased as i64 - 1075),
        };
        let mantissa = IBig::from(mantissa);
        Some(Self::new(
            if x < 0.0 { -mantissa } else { mantissa },
            exponent,
        ))
    }

    /// The odd integer m of m·2^e, or zero.
    pub fn mantissa(&self) -> &IBig {
        &self.mantissa
    }

    /// The e of m·2^e, m odd; 0 for zero.
    pub fn exponent(&self) -> i64 {
        self.exponent
    }

    /// This number as an integer multiple of 2^exponent; the exponent must not exceed its own.
    pub(super) fn in_units_of(&self, exponent: i64) -> IBig {
        if self.is_zero() {
            return IBig::ZERO;
        }
        debug_assert!(exponent <= self.exponent);
        self.mantissa.clone() << (self.exponent - exponent) as usize
    }

    /// Whether this is zero.
    pub fn is_zero(&self) -> bool {
        self.mantissa.is_zero()
    }

    /// How the number compares with zero.
    pub fn sign(&self) -> Ordering {
        match self.mantissa.sign() {
            _ if self.is_zero() => Ordering::Equal,
            Sign::Positive => Ordering::Greater,
            Sign::Negative => Ordering::Less,
        }
    }

    /// ⌊log2|x|⌋; none for zero.
    pub fn floor_log2(&self) -> Option<i64> {
        let bits = match self.mantissa.sign() {
            Sign::Positive => self.mantissa.bit_len(),
            Sign::Negative => (-&self.mantissa).bit_len(),
        };
        (bits > 0).then(|| self.exponent + bits as i64 - 1)
    }

    /// |x|.
    #[must_use]
    pub fn abs(self) -> Self {
        if self.sign() == Ordering::Less {
            -self
        } else {
            self
        }
    }

    /// x², which is never negative.
    #[must_use]
    pub fn squared(&self) -> Self {
        self * self
    }

    /// x·2^k.
    #[must_use]
    pub fn shifted(self, k: i64) -> Self {
        if self.is_zero() {
            return self;
        }
        Self {
            exponent: self.exponent + k,
            ..self
        }
    }
}

impl From<f32> for Dyadic {
    /// The number that a finite binary32 stands for. NaN and ±∞ have none and give zero; where
    /// they can come in, ask [`Dyadic::from_f64`].
    fn from(x: f32) -> Self {
        Self::from_f64(x.into()).unwrap_or(Self::ZERO)
    }
}

impl Add for &Dyadic {
    type Output = Dyadic;
    fn add(self, other: Self) -> Dyadic {
        if self.is_zero() {
            return other.clone();
        }
        if other.is_zero() {
            return self.clone();
        }
        let unit = self.exponent.min(other.exponent);
        Dyadic::new(self.in_units_of(unit) + other.in_units_of(unit), unit)
    }
}

impl Sub for &Dyadic {
    type Output = Dyadic;
    fn sub(self, other: Self) -> Dyadic {
        self + &-other.clone()
    }
}

impl Mul for &Dyadic {
    type Output = Dyadic;
    fn mul(self, other: Self) -> Dyadic {
        Dyadic::new(
            &self.mantissa * &other.mantissa,
            self.exponent + other.exponent,
        )
    }
}

impl Neg for Dyadic {
    type Output = Self;
    fn neg(self) -> Self {
        Self {
            mantissa: -self.mantissa,
            ..self
        }
    }
}

impl PartialOrd for Dyadic {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Dyadic {
    fn cmp(&self, other: &Self) -> Ordering {
        (self - other).sign()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn dyadic(x: f64) -> Dyadic {
        Dyadic::from_f64(x).unwrap()
    }

    #[test]
    fn takes_floats_for_what_they_stand_for() {
        assert_eq!(dyadic(-40.0), Dyadic::new(IBig::from(-5), 3));
        assert_eq!(
            Dyadic::from(f32::from_bits(1)),
            Dyadic::new(IBig::ONE, -149)
        );
        assert_eq!(dyadic(f64::from_bits(3)), Dyadic::new(IBig::from(3), -1074));
        assert_eq!(dyadic(-0.0), Dyadic::ZERO);
        assert_eq!(Dyadic::from_f64(f64::NEG_INFINITY), None);
        assert_eq!(Dyadic::from_f64(f64::NAN), None);
    }

    #[test]
    fn adds_and_multiplies_without_rounding() {
        let tiny = dyadic(1e-300);
        let sum = &dyadic(1e300) + &tiny;
        assert_eq!(&sum - &dyadic(1e300), tiny);
        assert_eq!(&dyadic(0.375) * &dyadic(-8.0), dyadic(-3.0));
        assert_eq!(dyadic(-0.375).floor_log2(), Some(-2));
        assert_eq!(dyadic(-0.25).floor_log2(), Some(-2));
        assert_eq!(Dyadic::ZERO.floor_log2(), None);
        assert!(dyadic(-2.0) < dyadic(-1.5) && dyadic(1e-40) > Dyadic::ZERO);
    }
}
