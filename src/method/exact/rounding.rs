//! From a root in binary64 to the one binary32 nearest to the exact root.
//!
//! If all numbers within the error bound round alike, that is the answer (Ziv's test). If two
//! neighbours are left, the exact root lies on one side of their midpoint m or on it, and the signs
//! of f(m) = Am² + 2bm + C and g(m) = Am + b say which: no square root is ever in doubt.

use std::cmp::Ordering;

use super::binary64::{Bounded, Estimate};
use crate::method::Which;

/// The signs that place a root beside a number; none where a stage cannot tell.
pub trait Signs {
    /// The sign of f(m) = Am² + 2bm + C.
    fn of_value(&self, m: f64) -> Option<Ordering>;
    /// The sign of g(m) = Am + b, which is that of m less the vertex.
    fn of_slope(&self, m: f64) -> Option<Ordering>;
}

/// What a stage beyond the first knows of the quadratic.
pub trait Quadratic: Signs {
    /// The sign of D; none where the stage cannot tell.
    fn discriminant(&self) -> Option<Ordering>;
    /// A, b, C and D in binary64, with bounds on their errors.
    fn estimate(&self) -> Estimate<f64>;
}

/// Nearest binary32, ties to even, ±∞ past the range; a root that rounds to zero gives +0.
#[inline(always)]
pub fn round(t: f64) -> f32 {
    t as f32 + 0.0
}

/// The answer, if the bound alone leaves one.
pub fn by_bound(root: Bounded<f64>) -> Option<f32> {
    let [low, high] = root.ends().map(round);
    (low == high).then_some(low)
}

/// The answer, if the bound leaves one, or two neighbours and the signs tell which.
pub fn by_signs(which: Which, root: Bounded<f64>, signs: &impl Signs) -> Option<f32> {
    let [low, high] = root.ends().map(round);
    if low == high {
        return Some(low);
    }
    if low.next_up() != high {
        return None;
    }
    let m = midpoint(low, high);
    let compared = which.compare(signs.of_slope(m)?, || signs.of_value(m))?;
    Some(match compared {
        Ordering::Less => low,
        Ordering::Equal => round(m),
        Ordering::Greater => high,
    })
}

/// Half way between neighbours, exactly; an infinity counts as the ±2¹²⁸ that would come next.
fn midpoint(low: f32, high: f32) -> f64 {
    f64::midpoint(in_range(low), in_range(high))
}

fn in_range(x: f32) -> f64 {
    const NEXT: f64 = 2.0 * (1_u128 << 127) as f64;
    f64::from(x).clamp(-NEXT, NEXT)
}
