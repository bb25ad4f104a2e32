//! Vectors of any number: of one float, of several side by side, of integers.

#![expect(
    clippy::inline_always,
    reason = "a call would leave the vectors of the loop that a formula is compiled into"
)]

use std::ops::{Add, Mul, Sub};

/// u·v, summed from the left.
#[inline(always)]
pub fn dot<T: Copy + Add<Output = T> + Mul<Output = T>>(u: [T; 3], v: [T; 3]) -> T {
    u[0] * v[0] + u[1] * v[1] + u[2] * v[2]
}

/// u − v.
#[inline(always)]
pub fn sub<T: Copy + Sub<Output = T>>(u: [T; 3], v: [T; 3]) -> [T; 3] {
    [u[0] - v[0], u[1] - v[1], u[2] - v[2]]
}

/// s·v.
#[inline(always)]
pub fn scale<T: Copy + Mul<Output = T>>(s: T, v: [T; 3]) -> [T; 3] {
    [s * v[0], s * v[1], s * v[2]]
}

/// p + t v.
#[inline(always)]
pub fn along<T: Copy + Add<Output = T> + Mul<Output = T>>(p: [T; 3], t: T, v: [T; 3]) -> [T; 3] {
    [p[0] + t * v[0], p[1] + t * v[1], p[2] + t * v[2]]
}

/// u × v.
#[inline(always)]
pub fn cross<T: Copy + Sub<Output = T> + Mul<Output = T>>(u: [T; 3], v: [T; 3]) -> [T; 3] {
    [
        u[1] * v[2] - u[2] * v[1],
        u[2] * v[0] - u[0] * v[2],
        u[0] * v[1] - u[1] * v[0],
    ]
}
