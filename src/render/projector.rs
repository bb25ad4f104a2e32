//! Where a sphere can be met: a box of pixels, its columns in each row, and a lower bound of t.
//!
//! Worked out in binary64, one by one. [`super::windows`] does it in binary32 for many spheres that are
//! seen before the eye.

use glam::DVec3;

use super::bounds::Bounds;
use super::field::TILE;
use super::lanes::Real;
use crate::geometry::Sphere;
use crate::scene::{Rays, Size};

/// Which rays are of interest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Reach {
    /// Those that meet the sphere at t > 0, as `exact` has it.
    Seen,
    /// Those whose line passes the centre at so many radii or less, as any method may have it.
    Lines(f64),
    /// All.
    Everything,
}

/// A sphere is widened by this share of its distance and radius before it is projected.
///
/// A direction is off by 2⁻²⁴ in each component, so a ray passes within 2⁻²³(‖o‖ + r) of where it
/// should. The rest of 2⁻²⁰ is far more than the rounding of the projection, in binary64.
const RAY_ERROR: f64 = 1.0 / (1 << 20) as f64;

/// The error that a method can make in Δ/4A is at most this times ‖o‖² + r².
///
/// With u = 2⁻²⁴: o is off by u in each component; A, b and C by 4u of ‖d‖², ‖d‖‖o‖ and ‖o‖² + r²
/// at most, so b² − AC by less than 22u·A·(‖o‖² + r²). The perpendicular form is off by 10u·‖o‖ in
/// each component of its vector, so by less than 40u·‖o‖² in its square. 2⁻¹⁸ = 64u holds both.
const DISCRIMINANT_ERROR: f64 = 1.0 / (1 << 18) as f64;

/// Up to this distance and radius, and with directions up to `LONGEST`, no method in binary32
/// overflows: B² ≤ 4·‖d‖²·‖o‖² < 2¹²⁴.
const FARTHEST: f64 = (1_u64 << 40) as f64;
const LONGEST: f64 = (1_u64 << 20) as f64;

/// More than what underflow to zero can take from any product, as a length.
const UNDERFLOW: f64 = 1.0 / (1_u64 << 60) as f64;

/// How far from a pixel a bound may lie and still count as on it: more than the rounding of a
/// coordinate that is not beyond every picture.
const NEARLY: f64 = 1.0 / 1024.0;

/// Where a sphere can be met.
#[derive(Debug, Clone, Copy)]
pub(super) struct Window {
    /// The pixels whose rays can meet it so.
    pub bounds: Bounds,
    /// No visible root is below this; 0 if the sphere may lie behind the eye in part.
    pub least: f32,
    /// Whether it lies behind the eye, and that is of no interest.
    pub behind: bool,
}

/// What projecting needs of a camera: unit axes, and the pixel step along each.
#[derive(Debug, Clone, Copy)]
pub(super) struct Projector {
    pub(super) size: Size,
    pub(super) origin: DVec3,
    /// Right, down and forward.
    pub(super) axes: [DVec3; 3],
    /// Pixels to a unit of slope (perspective) or of length (orthographic).
    pub(super) scale: [f64; 2],
    /// The pixel, in fractions, of the middle of the picture.
    pub(super) middle: [f64; 2],
    pub(super) last: [f64; 2],
    pub(super) perspective: bool,
    /// How far off a ray may start.
    pub(super) origin_error: f64,
    /// How far from `origin` it starts at most, those beyond the right edge included.
    pub(super) spread: f64,
    /// How long a direction is at most, that at the centre being 1.
    longest: f64,
}

impl Projector {
    pub(super) fn new(rays: &Rays) -> Self {
        let step = [rays.right.length(), rays.down.length()];
        let size = [rays.size.width, rays.size.height].map(f64::from);
        let spread = (step[0] * (size[0] + TILE as f64)).hypot(step[1] * size[1]);
        let (spread, origin_error, longest) = if rays.perspective {
            (0.0, 0.0, 1.0_f64.hypot(spread))
        } else {
            (spread, RAY_ERROR * (rays.origin.length() + spread), 1.0)
        };
        Self {
            size: rays.size,
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
            longest,
        }
    }

    /// Where one sphere can be met.
    pub(super) fn window(&self, sphere: &Sphere, reach: Reach) -> Window {
        let o = sphere.center.as_dvec3() - self.origin;
        let [a, b, z] = self.axes.map(|axis| axis.dot(o));
        let Some(radius) = self.widened(o, sphere, reach) else {
            return Window {
                bounds: Bounds::whole(self.size),
                least: 0.0,
                behind: false,
            };
        };
        let [left, right] = self.pixels(self.span(a, z, radius, reach), 0);
        let [top, bottom] = self.pixels(self.span(b, z, radius, reach), 1);
        let bounds = Bounds {
            left,
            right,
            top,
            bottom,
        };
        // What is not a number is not behind.
        let behind = reach == Reach::Seen && z + radius <= 0.0;
        Window {
            bounds: if behind { Bounds::NONE } else { bounds },
            least: if reach == Reach::Seen {
                self.least(z, sphere, radius)
            } else {
                0.0
            },
            behind,
        }
    }

    /// Below this no root is seen: a ray goes no farther ahead than t, and no farther at all than t times
    /// the length of its direction.
    fn least(&self, z: f64, sphere: &Sphere, widened: f64) -> f32 {
        let to_the_front = z - widened;
        let from_within = self.inner(sphere) / self.longest;
        let least = to_the_front.at_least(from_within);
        (least * (1.0 - 2.0 * RAY_ERROR)).at_least(0.0) as f32
    }

    /// How far the eye is at least from the surface of a sphere that it is within; not above 0 for others.
    pub(super) fn inner(&self, sphere: &Sphere) -> f64 {
        let o = sphere.center.as_dvec3() - self.origin;
        let r = f64::from(sphere.radius);
        if self.perspective {
            r - o.length() - RAY_ERROR * (o.abs().element_sum() + r)
        } else {
            0.0
        }
    }

    /// The radius of a sphere that all lines of interest meet, those that the rays are off by included; none
    /// if that is not known.
    ///
    /// A method that errs by E in Δ/4A takes the line at distance p from the centre for one that passes
    /// within k radii, where Δ/4A > (1 − k²) r², only if p² ≤ (k r)² + E.
    fn widened(&self, o: DVec3, sphere: &Sphere, reach: Reach) -> Option<f64> {
        let radius = f64::from(sphere.radius);
        // At least |o| + r.
        let size = o.abs().element_sum() + radius + self.spread;
        match reach {
            Reach::Seen => Some(radius + RAY_ERROR * size + self.origin_error),
            Reach::Lines(times) => {
                let distance = o.length() + self.spread;
                let is_ordinary =
                    self.longest <= LONGEST && distance <= FARTHEST && radius <= FARTHEST;
                let error = DISCRIMINANT_ERROR * (distance * distance + radius * radius);
                let taken = (times * radius * times * radius + error).sqrt();
                let rays = RAY_ERROR * (size + self.origin.length());
                is_ordinary.then_some(taken + rays + UNDERFLOW)
            }
            Reach::Everything => None,
        }
    }

    /// The columns in which one sphere can be met in each row, where they can be told.
    pub(super) fn spans(&self, sphere: &Sphere, reach: Reach) -> Option<Spans> {
        let o = sphere.center.as_dvec3() - self.origin;
        let widened = self.widened(o, sphere, reach)?;
        let center = self.axes.map(|axis| o.dot(axis));
        let spans = Spans::new(center, widened, self.perspective);
        let spans = spans.in_pixels(self.scale, self.middle);
        Some(if reach == Reach::Seen {
            spans
        } else {
            spans.of_lines()
        })
    }

    /// What a circle of this radius about the point `a` to the side and `z` ahead covers, as seen from
    /// the origin: slopes (perspective) or lengths.
    fn span(&self, a: f64, z: f64, radius: f64, reach: Reach) -> [f64; 2] {
        if !self.perspective {
            return [a - radius, a + radius];
        }
        let of_lines = reach != Reach::Seen;
        // A line knows no front and back: what is behind the eye is seen upside down.
        let (a, z) = if of_lines && z < 0.0 {
            (-a, -z)
        } else {
            (a, z)
        };
        if of_lines && z <= radius * (1.0 + RAY_ERROR) {
            return [f64::NEG_INFINITY, f64::INFINITY];
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
