//! What the certified test in binary32 needs of a sphere, and how good its answers are. The test itself is
//! in `search`.

use super::lanes::{dot, sub};
use crate::geometry::Sphere;

/// A sphere that the test in binary32 serves.
#[derive(Debug, Clone, Copy)]
pub(super) struct Projected {
    /// o = p0 − c where all rays start at p0, else c.
    pub origin: [f32; 3],
    /// C = o² − r² where all rays start at one point.
    pub c: f32,
    /// r².
    pub r2: f32,
    /// The computed D = A r² − ‖o × d‖² is off by less than A times this.
    pub doubt: f32,
    /// Above A times this it is so large that its root is good for telling depths apart.
    pub accept: f32,
}

/// The test in binary32 serves spheres whose radius is at least this share of their distance.
const LEAST_SHARE: f32 = 1.0 / (1 << 17) as f32;

/// D = A r² − ‖o × d‖² in binary32 is off by less than 2⁻¹⁹ A r(|o| + r), where |o × d| ≤ 2√A r.
///
/// With u = 2⁻²⁴: o, each product and each difference are off by u, so each component of o × d by 3u
/// of the sum of its products' sizes, and the vector by 3√2 u‖d‖|o| < 4.3u√A|o|. Its square, at most
/// 4A r², is off by 8.6u·2A r|o| + 18.5u²A o² + 12u A r², A r² by 3u A r², their difference by another
/// 4u A r². With u|o| < 2⁻⁷ r the sum is below u A r(17.4|o| + 19 r), and 2⁻¹⁹ = 32u, which leaves room
/// for the rounding of the bound.
///
/// A line that passes farther away, |o × d| = k > 2√A r, is off by less than
/// k²(8.6u√A|o|/k + 18.5u²A o²/k² + 8u) < 0.04k², while −D > 0.75k²: a miss beyond all doubt.
const TEST_ERROR: f32 = 1.0 / (1 << 19) as f32;

/// A root with this relative error still tells depths apart: half of [`SAME`], less
/// what the operations before and after the square root add.
const ROOT_ERROR: f32 = 1.0 / (1 << 14) as f32;

/// The share by which two roots must differ to tell which is less, where they are not the method's own:
/// each of them is off by less than 2⁻¹³ of itself.
pub(super) const SAME: f32 = 1.0 / (1 << 12) as f32;

/// Whether a root is less than another one, or than a bound, beyond doubt.
#[inline(always)]
pub(super) fn is_before(t: f32, other: f32) -> bool {
    t < other * (1.0 - SAME)
}

/// Between these no product of the test in binary32 leaves its normal range.
pub(super) const LEAST_REACH: f32 = 1.0 / GREATEST_REACH;
pub(super) const GREATEST_REACH: f32 = (1 << 20) as f32;

impl Projected {
    /// For rays that all start at `p0`; none where the test does not serve.
    ///
    /// A root C/(|b| + √D) with D > kA·`doubt` is off by ½√(`doubt`/kC) of itself, plus 4u|o|/√C for b
    /// and a few u. Where C ≥ o²/4 that is below 2⁻¹⁴ + 12u if k·`doubt` ≥ 2²⁶`doubt`²/C. C itself is
    /// off by no more than 5u·o² + 2u·r² + uC < 30u·C.
    #[inline(always)]
    pub(super) fn from_point(p0: [f32; 3], sphere: &Sphere) -> Option<Self> {
        let r = sphere.radius;
        let o = sub(p0, sphere.center.to_array());
        let reach = o[0].abs() + o[1].abs() + o[2].abs() + r;
        let o2 = dot(o, o);
        let r2 = r * r;
        let c = o2 - r2;
        let is_outside = c >= 0.25 * o2;
        Self::new(o, c, r, reach, c).filter(|_| is_outside)
    }

    /// For parallel rays that start at most `spread` from `p0` and go at least `least` before they meet
    /// the sphere; none where the test does not serve.
    ///
    /// A root (|b| − √D)/A is no less than `least`, which takes the place of √C; |o| is at most 64 times
    /// that, which makes 4u|o| no more than 2⁻¹⁶ of it.
    #[inline(always)]
    pub(super) fn of_parallels(
        p0: [f32; 3],
        spread: f32,
        sphere: &Sphere,
        least: f32,
    ) -> Option<Self> {
        let r = sphere.radius;
        let center = sphere.center.to_array();
        let o = sub(p0, center);
        let reach = o[0].abs() + o[1].abs() + o[2].abs() + r + spread;
        let is_ahead = 64.0 * least >= reach;
        Self::new(center, -(r * r), r, reach, least * least).filter(|_| is_ahead)
    }

    /// With `nearest2` in the place of C, and `reach` at least |o| + r.
    #[inline(always)]
    fn new(origin: [f32; 3], c: f32, r: f32, reach: f32, nearest2: f32) -> Option<Self> {
        let doubt = TEST_ERROR * r * reach;
        let for_class = doubt + doubt;
        let for_root = doubt * (doubt / (4.0 * ROOT_ERROR * ROOT_ERROR * nearest2));
        let serves = (r >= LEAST_SHARE * reach) & (LEAST_REACH..=GREATEST_REACH).contains(&reach);
        serves.then(|| Self {
            origin,
            c,
            r2: r * r,
            doubt,
            accept: for_class.max(for_root),
        })
    }
}
