//! Numbers: what formulas ask of them, and powers of two.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// A floating-point number: the operations of IEEE 754 that are rounded once.
pub(crate) trait Number:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// The nearest number of the format.
    fn of(value: f64) -> Self;
    /// The square root, rounded once.
    fn sqrt(self) -> Self;
}

macro_rules! number {
    ($($float:ty),*) => {$(
        impl Number for $float {
            #[inline(always)]
            fn of(value: f64) -> Self {
                value as Self
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                self.sqrt()
            }
        }
    )*};
}

number!(f32, f64);

/// 2ⁿ for −1074 ≤ n ≤ 1023.
pub fn power_of_two(n: i32) -> f64 {
    if n >= -1022 {
        f64::from_bits(((n + 1023) as u64) << 52)
    } else {
        f64::from_bits(1 << (n + 1074))
    }
}
