//! The numbers that stage 1 runs on: binary64, or in tests a format so small that all its inputs
//! can be tried.
//!
//! Stage 1 is written once over [`WorkingFloat`], its constants in units of the format's roundoff.

use crate::number::Number;

/// A floating-point format whose operations round to nearest.
pub trait WorkingFloat: Number {
    /// u, the unit roundoff: half the distance from 1 to the next number.
    const U: f64;
    /// ε: how far a direct root may be from the exact one, relatively, where it is certain.
    const DIRECT_ERROR: f64;
    /// 2ˢ + 1, s being half the number of bits, rounded up: multiplying by it and subtracting cuts a
    /// number into two halves.
    const SPLITTER: f64;

    /// The magnitude.
    fn abs(self) -> Self;
    /// The magnitude with the sign of `other`.
    fn copysign(self, other: Self) -> Self;
}

impl WorkingFloat for f64 {
    const U: f64 = f64::EPSILON / 2.0;
    /// 2⁻³⁶.
    const DIRECT_ERROR: f64 = 131_072.0 * Self::U;
    const SPLITTER: f64 = 134_217_729.0;

    #[inline(always)]
    fn abs(self) -> Self {
        self.abs()
    }

    #[inline(always)]
    fn copysign(self, other: Self) -> Self {
        self.copysign(other)
    }
}
