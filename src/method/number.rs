//! What a method asks of its numbers, and a ray and a sphere in such numbers.

#![expect(
    clippy::inline_always,
    reason = "a call would leave the vectors of the loop that a formula is compiled into"
)]

use crate::geometry::{Ray, Sphere};
use crate::number::Number;

/// A number that a method is written over: with `f32` or `f64` it runs at full speed, with a number that
/// keeps record, each of its operations is shown.
pub(super) trait Scalar: Number + PartialOrd {
    /// self·factor + term, rounded once.
    fn mul_add(self, factor: Self, term: Self) -> Self;
}

macro_rules! scalar {
    ($($float:ty),*) => {$(
        impl Scalar for $float {
            #[inline(always)]
            fn mul_add(self, factor: Self, term: Self) -> Self {
                self.mul_add(factor, term)
            }
        }
    )*};
}

scalar!(f32, f64);

/// A ray and a sphere in the numbers that a method computes with.
#[derive(Debug, Clone, Copy)]
pub struct Input<T> {
    /// Where the ray starts.
    pub p0: [T; 3],
    /// d, the direction.
    pub d: [T; 3],
    /// c, the centre of the sphere.
    pub center: [T; 3],
    /// r, the radius.
    pub r: T,
}

impl<T> Input<T> {
    /// The same ray and sphere, each number taken through `lift`.
    #[inline(always)]
    pub fn new(ray: &Ray, sphere: &Sphere, mut lift: impl FnMut(f32) -> T) -> Self {
        Self {
            p0: ray.origin.to_array().map(&mut lift),
            d: ray.direction.to_array().map(&mut lift),
            center: sphere.center.to_array().map(&mut lift),
            r: lift(sphere.radius),
        }
    }
}
