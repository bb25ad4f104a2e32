//! Several numbers side by side, so that one formula runs for several pixels at once.
//!
//! An operation is a loop over a small array, which compilers turn into vector instructions. Each
//! lane is rounded as a single number would be, so a formula gives the same bits either way.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// How many binary64 go side by side.
pub(super) const LANES: usize = 4;

/// How many binary32 go side by side.
pub(super) const SINGLES: usize = 8;

/// What a formula asks of one number or of several in lanes.
pub(super) trait Real:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// The same number, rounded, in every lane.
    fn of(value: f64) -> Self;
    /// The square root, rounded once.
    fn sqrt(self) -> Self;
    /// The number if it is at least `least`, else `least`, as for what is not a number.
    fn at_least(self, least: f64) -> Self;
    /// The number if it is at most `most`, else `most`, as for what is not a number.
    fn at_most(self, most: f64) -> Self;
    /// This number where `sign` is below zero, elsewhere `other`.
    fn where_negative(self, sign: Self, other: Self) -> Self;
}

macro_rules! number {
    ($number:ty) => {
        impl Real for $number {
            #[inline(always)]
            fn of(value: f64) -> Self {
                value as Self
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                self.sqrt()
            }
            #[inline(always)]
            fn at_least(self, least: f64) -> Self {
                if self > least as Self {
                    self
                } else {
                    least as Self
                }
            }
            #[inline(always)]
            fn at_most(self, most: f64) -> Self {
                if self < most as Self {
                    self
                } else {
                    most as Self
                }
            }
            #[inline(always)]
            fn where_negative(self, sign: Self, other: Self) -> Self {
                if sign < 0.0 { self } else { other }
            }
        }
    };
}

number!(f32);
number!(f64);

/// Numbers side by side.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lanes(pub [f64; LANES]);

impl Lanes {
    #[inline(always)]
    fn each(f: impl Fn(usize) -> f64) -> Self {
        Self(std::array::from_fn(f))
    }

    /// The binary32 numbers from place `i` on.
    #[inline(always)]
    pub(super) fn load(from: &[f32], i: usize) -> Self {
        let from: &[f32] = &from[i..i + LANES];
        Self::each(|l| from[l].into())
    }
}

impl Real for Lanes {
    #[inline(always)]
    fn of(value: f64) -> Self {
        Self([value; LANES])
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self::each(|l| self.0[l].sqrt())
    }
    #[inline(always)]
    fn at_least(self, least: f64) -> Self {
        Self::each(|l| self.0[l].at_least(least))
    }
    #[inline(always)]
    fn at_most(self, most: f64) -> Self {
        Self::each(|l| self.0[l].at_most(most))
    }
    #[inline(always)]
    fn where_negative(self, sign: Self, other: Self) -> Self {
        Self::each(|l| self.0[l].where_negative(sign.0[l], other.0[l]))
    }
}

macro_rules! operator {
    ($($trait:ident $name:ident),*) => {$(
        impl $trait for Lanes {
            type Output = Self;
            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                Self::each(|l| self.0[l].$name(other.0[l]))
            }
        }
    )*};
}

operator!(Add add, Sub sub, Mul mul, Div div);

impl Neg for Lanes {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self::each(|l| -self.0[l])
    }
}

/// u·v, summed from the left.
#[inline(always)]
pub(super) fn dot<T: Real>(u: [T; 3], v: [T; 3]) -> T {
    u[0] * v[0] + u[1] * v[1] + u[2] * v[2]
}

/// u − v.
#[inline(always)]
pub(super) fn sub<T: Real>(u: [T; 3], v: [T; 3]) -> [T; 3] {
    [u[0] - v[0], u[1] - v[1], u[2] - v[2]]
}

/// p + t v.
#[inline(always)]
pub(super) fn along<T: Real>(p: [T; 3], t: T, v: [T; 3]) -> [T; 3] {
    [p[0] + t * v[0], p[1] + t * v[1], p[2] + t * v[2]]
}

/// u × v.
#[inline(always)]
pub(super) fn cross<T: Real>(u: [T; 3], v: [T; 3]) -> [T; 3] {
    [
        u[1] * v[2] - u[2] * v[1],
        u[2] * v[0] - u[0] * v[2],
        u[0] * v[1] - u[1] * v[0],
    ]
}
