//! Decimal numbers as they are written by hand: whole multiples of a power of ten, without rounding.

use super::super::{Digits, number};
use crate::method::Precision;

/// units/10^places.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct DecimalFraction {
    pub units: i128,
    pub places: u32,
}

/// The most digits of a number that comes out without a division: what a pocket calculator shows.
const MOST_DIGITS: u32 = 12;
/// The most digits of a quotient that is no rounded one.
const QUOTIENT_DIGITS: u32 = 7;
/// The digits that are left of a number that is rounded.
const ROUNDED_DIGITS: usize = 5;
/// The most digits behind the point.
pub(super) const MOST_PLACES: u32 = 6;
/// Whole numbers up to here keep everything below within 127 bits.
const MOST_UNITS: i128 = 1_000_000_000;

impl DecimalFraction {
    /// The number as it is written, rounded to `places` digits behind the point; none if it is too
    /// long to work with.
    pub fn of(x: f32, places: u32) -> Option<Self> {
        let text = format!("{x:.*}", places as usize);
        let units: i128 = text.replace('.', "").parse().ok()?;
        (units.abs() <= MOST_UNITS).then_some(Self { units, places })
    }

    /// Digits behind the point of the shortest decimal that reads back as `x`.
    pub fn places_of(x: f32) -> u32 {
        let text = x.to_string();
        text.split_once('.').map_or(0, |(_, d)| d.len() as u32)
    }

    /// The nearest binary64.
    pub fn value(self) -> f64 {
        ratio(self.units, power_of_ten(self.places))
    }

    /// The digits from the first to the last that is not zero.
    pub fn digits(self) -> u32 {
        let mut units = self.units.unsigned_abs();
        while units != 0 && units.is_multiple_of(10) {
            units /= 10;
        }
        units.checked_ilog10().map_or(0, |log| log + 1)
    }

    /// As it is written by hand, a minus sign before it and no zeros behind it.
    pub fn text(self) -> String {
        let one = 10_u128.pow(self.places);
        let magnitude = self.units.unsigned_abs();
        let mut text = format!("{}", magnitude / one);
        if !magnitude.is_multiple_of(one) {
            let behind = format!("{:0w$}", magnitude % one, w = self.places as usize);
            text = format!("{text}.{}", behind.trim_end_matches('0'));
        }
        if self.units < 0 {
            text.insert(0, '−');
        }
        text
    }

    /// The sum, unless it is too long.
    pub fn plus(self, other: Self) -> Option<Self> {
        let places = self.places.max(other.places);
        let scaled = |x: Self| {
            let factor = 10_i128.checked_pow(places - x.places)?;
            x.units.checked_mul(factor)
        };
        let units = scaled(self)?.checked_add(scaled(other)?)?;
        Some(Self { units, places })
    }

    /// The product, unless it is too long.
    pub fn times(self, other: Self) -> Option<Self> {
        Some(Self {
            units: self.units.checked_mul(other.units)?,
            places: self.places.checked_add(other.places)?,
        })
    }

    /// `= 2.5`, or rounded, `≈ 2.5123`, where it is longer than anybody wants to read.
    pub fn equation(self) -> String {
        if self.digits() <= MOST_DIGITS {
            format!("= {}", self.text())
        } else {
            format!("≈ {}", rounded(self.value()))
        }
    }
}

/// 10^n; n is at most 4·`MOST_PLACES`.
pub(super) fn power_of_ten(n: u32) -> i128 {
    10_i128.pow(n)
}

/// The quotient of two whole numbers in binary64.
pub(super) fn ratio(numerator: i128, denominator: i128) -> f64 {
    numerator as f64 / denominator as f64
}

/// A number that a student writes down after a calculation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum WrittenNumber {
    /// A short decimal, exactly.
    Exact(DecimalFraction),
    /// A number with no end.
    Near(f64),
}

impl WrittenNumber {
    /// numerator/denominator, exactly if that has few digits.
    pub fn quotient(numerator: i128, denominator: i128) -> Self {
        let exact = || {
            let scaled = numerator.checked_mul(power_of_ten(MOST_PLACES))?;
            (scaled % denominator == 0).then(|| DecimalFraction {
                units: scaled / denominator,
                places: MOST_PLACES,
            })
        };
        match exact() {
            Some(decimal) if decimal.digits() <= QUOTIENT_DIGITS => Self::Exact(decimal),
            _ => Self::Near(ratio(numerator, denominator)),
        }
    }

    /// The nearest binary64.
    pub fn value(self) -> f64 {
        match self {
            Self::Exact(decimal) => decimal.value(),
            Self::Near(value) => value,
        }
    }

    /// `= 10`, `≈ 3.1623`.
    pub fn equation(self) -> String {
        match self {
            Self::Exact(decimal) => decimal.equation(),
            Self::Near(value) => format!("≈ {}", rounded(value)),
        }
    }
}

/// A number of few digits.
pub(super) fn rounded(value: f64) -> String {
    rounded_to(value, ROUNDED_DIGITS)
}

/// A number of at most so many digits.
pub(super) fn rounded_to(value: f64, digits: usize) -> String {
    number(value, Precision::Binary64, Digits::Significant(digits))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_written_as_by_hand() {
        let text = |x, places| DecimalFraction::of(x, places).unwrap().text();
        assert_eq!(text(-0.75, 2), "−0.75");
        assert_eq!(text(20.0, 3), "20");
        assert_eq!(text(0.007_643_267, 3), "0.008");
        assert_eq!(text(-0.0004, 3), "0");
        assert_eq!(DecimalFraction::of(1e30, 0), None);
        assert_eq!(DecimalFraction::places_of(0.1), 1);
        assert_eq!(DecimalFraction::places_of(-40.0), 0);
    }

    #[test]
    fn an_answer_says_whether_it_is_rounded() {
        assert_eq!(WrittenNumber::quotient(-7, 4).equation(), "= −1.75");
        assert_eq!(WrittenNumber::quotient(1, 3).equation(), "≈ 0.33333");
        let long = |units| DecimalFraction { units, places: 9 };
        assert_eq!(long(123_456_789_012).equation(), "= 123.456789012");
        assert_eq!(long(1_234_567_890_123).equation(), "≈ 1234.6");
        assert_eq!(long(1_200_000_000_000).digits(), 2);
    }
}
