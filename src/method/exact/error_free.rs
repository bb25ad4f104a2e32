//! Sums and products whose rounding error is itself a binary64 and is returned beside them.
//!
//! Exact as long as nothing over- or underflows, which binary32 inputs rule out here. No fused
//! multiply-add: the bits are the same on every processor, and so is the work.

use super::real::WorkingFloat;

/// a + b as rounded sum and error (Knuth, Møller).
#[inline(always)]
pub fn two_sum<T: WorkingFloat>(a: T, b: T) -> (T, T) {
    let sum = a + b;
    let b_part = sum - a;
    let a_part = sum - b_part;
    (sum, (a - a_part) + (b - b_part))
}

/// a − b as rounded difference and error.
#[inline(always)]
pub fn two_difference<T: WorkingFloat>(a: T, b: T) -> (T, T) {
    two_sum(a, -b)
}

/// a + b for |a| ≥ |b| or a = 0, as rounded sum and error (Dekker).
#[inline(always)]
pub fn fast_two_sum<T: WorkingFloat>(a: T, b: T) -> (T, T) {
    let sum = a + b;
    (sum, b - (sum - a))
}

/// a·b as rounded product and error (Veltkamp, Dekker).
#[inline(always)]
pub fn two_product<T: WorkingFloat>(a: T, b: T) -> (T, T) {
    let product = a * b;
    let (a_high, a_low) = split(a);
    let (b_high, b_low) = split(b);
    let error = ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low;
    (product, error)
}

/// a² as rounded square and error.
#[inline(always)]
pub fn two_square<T: WorkingFloat>(a: T) -> (T, T) {
    let square = a * a;
    let (high, low) = split(a);
    let cross = high * low;
    (
        square,
        ((high * high - square) + (cross + cross)) + low * low,
    )
}

#[inline(always)]
fn split<T: WorkingFloat>(a: T) -> (T, T) {
    let scaled = T::of(T::SPLITTER) * a;
    let high = scaled - (scaled - a);
    (high, a - high)
}
