//! What a method asks of its numbers, and the few formulas that several methods share.
//!
//! A method is written once over [`Number`]: with `f32` or `f64` it runs at full speed, with a
//! number that keeps record, each of its operations is shown.

use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::geometry::{Ray, Sphere};

/// A floating-point number: the operations of IEEE 754 that are rounded once, and comparison.
pub(super) trait Number:
    Copy
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// A number of the formula itself, such as the 4 of 4AC.
    fn constant(value: f32) -> Self;
    /// The square root, rounded once.
    fn sqrt(self) -> Self;
}

/// A number with a true fused multiply-add.
pub(super) trait Fused: Number {
    /// self·factor + term, rounded once.
    fn mul_add(self, factor: Self, term: Self) -> Self;
}

macro_rules! number {
    ($($float:ty),*) => {$(
        impl Number for $float {
            #[inline]
            fn constant(value: f32) -> Self {
                value.into()
            }
            #[inline]
            fn sqrt(self) -> Self {
                self.sqrt()
            }
        }
    )*};
}

number!(f32, f64);

impl Fused for f32 {
    #[inline]
    fn mul_add(self, factor: Self, term: Self) -> Self {
        self.mul_add(factor, term)
    }
}

/// A ray and a sphere in the numbers that a method computes with.
#[derive(Debug, Clone, Copy)]
pub(super) struct Input<T> {
    /// Where the ray starts.
    pub p0: [T; 3],
    /// The direction.
    pub d: [T; 3],
    /// The centre of the sphere.
    pub center: [T; 3],
    /// The radius.
    pub r: T,
}

impl<T> Input<T> {
    /// The same ray and sphere, each number taken through `lift`.
    #[inline]
    pub fn new(ray: &Ray, sphere: &Sphere, mut lift: impl FnMut(f32) -> T) -> Self {
        Self {
            p0: ray.origin.to_array().map(&mut lift),
            d: ray.direction.to_array().map(&mut lift),
            center: sphere.center.to_array().map(&mut lift),
            r: lift(sphere.radius),
        }
    }
}

/// u·v, summed from the left.
#[inline]
pub(super) fn dot<T: Number>(u: [T; 3], v: [T; 3]) -> T {
    u[0] * v[0] + u[1] * v[1] + u[2] * v[2]
}

/// u − v.
#[inline]
pub(super) fn sub<T: Number>(u: [T; 3], v: [T; 3]) -> [T; 3] {
    [u[0] - v[0], u[1] - v[1], u[2] - v[2]]
}

/// s·v.
#[inline]
pub(super) fn scale<T: Number>(s: T, v: [T; 3]) -> [T; 3] {
    [s * v[0], s * v[1], s * v[2]]
}

/// u × v.
#[inline]
pub(super) fn cross<T: Number>(u: [T; 3], v: [T; 3]) -> [T; 3] {
    [
        u[1] * v[2] - u[2] * v[1],
        u[2] * v[0] - u[0] * v[2],
        u[0] * v[1] - u[1] * v[0],
    ]
}
