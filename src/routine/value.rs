//! What a routine computes with: numbers of two widths, plain or such that keep record.

#![expect(
    clippy::inline_always,
    reason = "a call would leave the vectors of the loop that an operation is compiled into"
)]

use crate::number::Number;

/// A number that a routine can be run over.
pub(crate) trait Real: Number + PartialOrd {
    fn mul_add(self, factor: Self, term: Self) -> Self;
    fn abs(self) -> Self;
    /// The smaller; the first if the second is NaN.
    fn min(self, other: Self) -> Self;
    /// The greater; the first if the second is NaN.
    fn max(self, other: Self) -> Self;
    fn floor(self) -> Self;
    fn ceil(self) -> Self;
    fn trunc(self) -> Self;
    /// To the nearest whole number, of two the even one.
    fn round(self) -> Self;
    /// −1, 0 or 1; NaN for NaN.
    fn sign(self) -> Self;
    fn to_f64(self) -> f64;
}

/// The two widths that belong together.
pub(crate) trait Arithmetic {
    type Single: Real;
    type Double: Real;
    fn widen(x: Self::Single) -> Self::Double;
    fn narrow(x: Self::Double) -> Self::Single;
}

/// Plain numbers.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Plain;

impl Arithmetic for Plain {
    type Single = f32;
    type Double = f64;
    #[inline(always)]
    fn widen(x: f32) -> f64 {
        x.into()
    }
    #[inline(always)]
    fn narrow(x: f64) -> f32 {
        x as f32
    }
}

macro_rules! real {
    ($($float:ty),*) => {$(
        impl Real for $float {
            #[inline(always)]
            fn mul_add(self, factor: Self, term: Self) -> Self {
                self.mul_add(factor, term)
            }
            #[inline(always)]
            fn abs(self) -> Self {
                self.abs()
            }
            #[inline(always)]
            fn min(self, other: Self) -> Self {
                // As the languages define it: y < x ? y : x.
                if other < self { other } else { self }
            }
            #[inline(always)]
            fn max(self, other: Self) -> Self {
                if self < other { other } else { self }
            }
            #[inline(always)]
            fn floor(self) -> Self {
                self.floor()
            }
            #[inline(always)]
            fn ceil(self) -> Self {
                self.ceil()
            }
            #[inline(always)]
            fn trunc(self) -> Self {
                self.trunc()
            }
            #[inline(always)]
            fn round(self) -> Self {
                self.round_ties_even()
            }
            #[inline(always)]
            fn sign(self) -> Self {
                if self > 0.0 {
                    1.0
                } else if self < 0.0 {
                    -1.0
                } else {
                    self
                }
            }
            #[inline(always)]
            fn to_f64(self) -> f64 {
                self.into()
            }
        }
    )*};
}

real!(f32, f64);
