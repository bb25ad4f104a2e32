//! Where a sphere can be seen: a box of pixels, its columns in each row, and a lower bound of t.
//!
//! Of what lies before the eye only, and for a method whose class is right: the box holds every
//! pixel whose ray, as rounded, meets the sphere at t > 0. [`super::crowd`] does the same for many
//! spheres at once. Methods that may err are served by [`super::bounds`].

use glam::DVec3;

use super::field::TILE;
use super::lanes::Real;
use crate::geometry::Sphere;
use crate::scene::{Rays, Size};

/// A sphere is widened by this share of its distance and radius before it is projected.
///
/// A direction is off by 2⁻²⁴ in each component, so a ray passes within 2⁻²³(‖o‖ + r) of where it
/// should. The rest of 2⁻²⁰ is far more than the rounding of the projection, in binary64.
const RAY_ERROR: f64 = 1.0 / (1 << 20) as f64;

/// How far from a pixel a bound may lie and still count as on it: more than the rounding of a
/// coordinate that is not beyond every picture.
const NEARLY: f64 = 1.0 / 1024.0;

/// Pixels from `left` to `right` and from `top` to `bottom`, all inclusive; none if a first one is
/// beyond its last.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Bounds {
    pub left: i16,
    pub right: i16,
    pub top: i16,
    pub bottom: i16,
}

impl Bounds {
    /// No pixel.
    pub(super) const NONE: Self = Self {
        left: i16::MAX,
        right: -1,
        top: i16::MAX,
        bottom: -1,
    };

    /// All pixels of a picture.
    pub(super) const fn whole(size: Size) -> Self {
        Self {
            left: 0,
            right: size.width as i16 - 1,
            top: 0,
            bottom: size.height as i16 - 1,
        }
    }

    /// Whether there is no pixel.
    pub(super) const fn is_empty(self) -> bool {
        self.left > self.right || self.top > self.bottom
    }

    /// How many rows there are.
    pub(super) const fn rows(self) -> u64 {
        if self.is_empty() {
            0
        } else {
            (self.bottom - self.top) as u64 + 1
        }
    }

    /// How many pixels there are.
    pub(super) const fn area(self) -> u64 {
        if self.is_empty() {
            0
        } else {
            self.rows() * ((self.right - self.left) as u64 + 1)
        }
    }

    /// Whether the two have no pixel in common, if `other` has any.
    #[inline(always)]
    #[expect(clippy::needless_bitwise_bool, reason = "one branch for all")]
    pub(super) const fn is_apart_from(self, other: Self) -> bool {
        (self.left > other.right)
            | (self.right < other.left)
            | (self.top > other.bottom)
            | (self.bottom < other.top)
    }

    /// The pixels that the two have in common.
    #[inline(always)]
    pub(super) const fn within(self, other: Self) -> Self {
        const fn most(a: i16, b: i16) -> i16 {
            if a > b { a } else { b }
        }
        const fn least(a: i16, b: i16) -> i16 {
            if a < b { a } else { b }
        }
        Self {
            left: most(self.left, other.left),
            right: least(self.right, other.right),
            top: most(self.top, other.top),
            bottom: least(self.bottom, other.bottom),
        }
    }

    /// With the pixels beside it, as far as the picture goes.
    pub(super) fn widened(self, size: Size) -> Self {
        if self.is_empty() {
            return self;
        }
        Self {
            left: self.left - 1,
            right: self.right + 1,
            top: self.top - 1,
            bottom: self.bottom + 1,
        }
        .within(Self::whole(size))
    }

    /// The least rectangle that holds both.
    pub(super) fn union(self, other: Self) -> Self {
        if self.is_empty() {
            return other;
        }
        if other.is_empty() {
            return self;
        }
        Self {
            left: self.left.min(other.left),
            right: self.right.max(other.right),
            top: self.top.min(other.top),
            bottom: self.bottom.max(other.bottom),
        }
    }
}

/// Where a sphere can be seen.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cover {
    /// The pixels that it can cover; none if it lies behind the eye.
    pub bounds: Bounds,
    /// No visible root is below this.
    pub least: f32,
    /// Whether it lies behind the eye.
    pub behind: bool,
}

/// What projecting needs of a camera: unit axes, and the pixel step along each.
#[derive(Debug, Clone, Copy)]
pub(super) struct Projector {
    origin: DVec3,
    /// Right, down and forward.
    axes: [DVec3; 3],
    /// Pixels to a unit of slope (perspective) or of length (orthographic).
    scale: [f64; 2],
    /// The pixel, in fractions, of the middle of the picture.
    middle: [f64; 2],
    last: [f64; 2],
    perspective: bool,
    /// How far off a ray may start.
    pub(super) origin_error: f64,
    /// How far from `origin` it starts at most, those beyond the right edge included.
    pub(super) spread: f64,
}

impl Projector {
    pub(super) fn new(rays: &Rays) -> Self {
        let step = [rays.right.length(), rays.down.length()];
        let size = [rays.size.width, rays.size.height].map(f64::from);
        let spread = (step[0] * (size[0] + TILE as f64)).hypot(step[1] * size[1]);
        let (spread, origin_error) = if rays.perspective {
            (0.0, 0.0)
        } else {
            (spread, RAY_ERROR * (rays.origin.length() + spread))
        };
        Self {
            origin: rays.origin,
            axes: [
                rays.right / step[0],
                rays.down / step[1],
                rays.direction.normalize(),
            ],
            scale: step.map(|s| 1.0 / s),
            middle: size.map(|s| (s - 1.0) / 2.0),
            last: size.map(|s| s - 1.0),
            perspective: rays.perspective,
            origin_error,
            spread,
        }
    }

    /// Where one sphere can be seen.
    pub(super) fn cover(&self, sphere: &Sphere) -> Cover {
        let center = sphere.center.as_dvec3();
        let o = center - self.origin;
        let radius = f64::from(sphere.radius);
        let [a, b, z] = self.axes.map(|axis| axis.dot(o));
        let widened = self.widened(o, radius);
        let behind = z + widened <= 0.0;
        let least = ((z - widened) * (1.0 - 2.0 * RAY_ERROR)).at_least(0.0);
        let [left, right] = self.pixels(self.span(a, z, widened), 0);
        let [top, bottom] = self.pixels(self.span(b, z, widened), 1);
        let bounds = Bounds {
            left,
            right,
            top,
            bottom,
        };
        Cover {
            // What is not a number is not behind.
            bounds: if behind { Bounds::NONE } else { bounds },
            least: least as f32,
            behind,
        }
    }

    /// The radius, and more than what the rays are off by where they pass.
    fn widened(&self, o: DVec3, radius: f64) -> f64 {
        // At least |o| + r.
        let reach = o.abs().element_sum() + radius + self.spread;
        radius + RAY_ERROR * reach + self.origin_error
    }

    /// The columns that one sphere can cover in each row.
    pub(super) fn spans(&self, sphere: &Sphere) -> Spans {
        let o = sphere.center.as_dvec3() - self.origin;
        let widened = self.widened(o, sphere.radius.into());
        let center = self.axes.map(|axis| o.dot(axis));
        Spans::new(center, widened, self.perspective).in_pixels(self.scale, self.middle)
    }

    /// What a circle of this radius about the point `a` to the side and `z` ahead covers, as seen from
    /// the origin: slopes (perspective) or lengths.
    fn span(&self, a: f64, z: f64, radius: f64) -> [f64; 2] {
        if !self.perspective {
            return [a - radius, a + radius];
        }
        // The tangents from the origin, l long, have the directions (a l ∓ z r, z l ± a r). One that
        // points backwards leaves that side open; without tangents l is not a number.
        let l = (a * a + z * z - radius * radius).sqrt();
        let [al, zl, ar, zr] = [a * l, z * l, a * radius, z * radius];
        let [low_ahead, high_ahead] = [zl + ar, zl - ar];
        [
            f64::NEG_INFINITY.where_negative(low_ahead, (al - zr) / low_ahead),
            f64::INFINITY.where_negative(high_ahead, (al + zr) / high_ahead),
        ]
    }

    /// The first and the last pixel between two coordinates, clipped to the picture. A coordinate
    /// that is not a number ends nowhere.
    fn pixels(&self, [low, high]: [f64; 2], axis: usize) -> [i16; 2] {
        let [scale, middle, last] = [self.scale, self.middle, self.last].map(|of| of[axis]);
        let first_one = (low * scale + middle - NEARLY).ceil();
        let last_one = (high * scale + middle + NEARLY).floor();
        [
            first_one.at_least(0.0).at_most(last + 1.0) as i16,
            last_one.at_most(last).at_least(-1.0) as i16,
        ]
    }
}

/// Which columns a sphere covers in a row of pixels: the row's own quadratic, since along a row the
/// rays are affine in the column.
///
/// With the centre at (a, b, z) in the axes of the camera, the rays (s, v, 1) of the row at slope v meet
/// the sphere where D(s) = (as + bv + z)² − K(s² + v² + 1) ≥ 0, K = a² + b² + z² − r².
#[derive(Debug, Clone, Copy)]
pub(super) struct Spans {
    center: [f64; 3],
    r2: f64,
    /// b² + z² − r²: above zero every row cuts the cone of rays in an ellipse.
    m: f64,
    perspective: bool,
    /// Whether only what lies before the eye counts, and not the lines behind it.
    before_the_eye: bool,
    /// Whether rounding leaves the ends as good as the margin by which the radius is widened.
    sound: bool,
    /// Pixels to a unit of slope or length, and the pixel of the middle, across and down.
    scale: [f64; 2],
    middle: [f64; 2],
}

impl Spans {
    /// For a sphere of this widened radius about (a, b, z), in unit steps about the middle.
    ///
    /// Sound is b² + z² − r² > 2⁻¹⁰(b² + z² + r²) and a² < 2¹⁶(b² + z²): an end is then off by less than
    /// 2⁻³² of the length of its ray, while widening has moved it by 2⁻²⁰.
    pub(super) fn new(center: [f64; 3], radius: f64, perspective: bool) -> Self {
        let [a, b, z] = center;
        let (r2, ahead) = (radius * radius, b * b + z * z);
        let m = ahead - r2;
        let is_ellipse = m > (ahead + r2) / 1024.0 && a * a < ahead * 65536.0;
        Self {
            center,
            r2,
            m,
            perspective,
            before_the_eye: true,
            sound: is_ellipse || !perspective,
            scale: [1.0; 2],
            middle: [0.0; 2],
        }
    }

    /// The same for a picture of so many pixels to a unit about this pixel in its middle.
    pub(super) fn in_pixels(self, scale: [f64; 2], middle: [f64; 2]) -> Self {
        Self {
            scale,
            middle,
            ..self
        }
    }

    /// The same for whole lines, be what they meet behind the eye.
    pub(super) fn of_lines(self) -> Self {
        Self {
            before_the_eye: false,
            ..self
        }
    }

    /// The first and the last column of those of `bounds` that can be covered in row `y`; the first
    /// is beyond the last where there is none.
    #[inline(always)]
    pub(super) fn at(&self, y: i16, bounds: Bounds) -> [i16; 2] {
        let whole = [bounds.left, bounds.right];
        if !self.sound {
            return whole;
        }
        let v = (f64::from(y) - self.middle[1]) / self.scale[1];
        let Some(ends) = self.ends(v) else {
            return [bounds.right + 1, bounds.right];
        };
        let [low, high] = ends.map(|s| s * self.scale[0] + self.middle[0]);
        if low.is_nan() || high.is_nan() {
            return whole;
        }
        let within = |x: f64| x.clamp(f64::from(bounds.left) - 1.0, f64::from(bounds.right) + 1.0);
        [
            (within((low - NEARLY).ceil()) as i16).max(bounds.left),
            (within((high + NEARLY).floor()) as i16).min(bounds.right),
        ]
    }

    /// Where D(s) = 0 in the row at `v`.
    #[inline(always)]
    fn ends(&self, v: f64) -> Option<[f64; 2]> {
        let [a, b, z] = self.center;
        if !self.perspective {
            let half2 = self.r2 - (b - v) * (b - v);
            let half = half2.sqrt();
            return (half2 >= 0.0).then_some([a - half, a + half]);
        }
        let past = b - v * z;
        let rho2 = self.r2 * (1.0 + v * v) - past * past;
        let g = b * v + z;
        // Of the two halves of the cone the row cuts the one before the eye only if g is above zero.
        let half = (rho2 * (a * a + self.m)).sqrt();
        let is_met = rho2 >= 0.0 && (g > 0.0 || !self.before_the_eye);
        let scale = 1.0 / self.m;
        is_met.then_some([(a * g - half) * scale, (a * g + half) * scale])
    }
}
