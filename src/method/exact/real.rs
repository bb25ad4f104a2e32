//! What stage 1 asks of the numbers it runs on.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// A binary64: each operation is rounded once.
pub trait Real:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// The same number in every lane.
    fn of(value: f64) -> Self;
    /// The magnitude.
    fn abs(self) -> Self;
    /// The square root, rounded once.
    fn sqrt(self) -> Self;
    /// The magnitude with the sign of `other`.
    fn copysign(self, other: Self) -> Self;
}

impl Real for f64 {
    #[inline(always)]
    fn of(value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn abs(self) -> Self {
        self.abs()
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        self.sqrt()
    }

    #[inline(always)]
    fn copysign(self, other: Self) -> Self {
        self.copysign(other)
    }
}
