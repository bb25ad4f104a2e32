//! Which pixels a sphere can cover: a window that holds every pixel at which any method may answer
//! anything but a miss.
//!
//! Of the whole line, not only of the part before the eye: the class view shows what is behind.

use std::ops::Range;

use glam::DVec3;

use super::cover::{Bounds, Spans};
use crate::geometry::Sphere;
use crate::scene::{Rays, Size};

/// What the bounds need of the camera, in binary64: unit axes, and the pixel step along each.
pub(super) struct Eye {
    size: Size,
    origin: DVec3,
    /// Right, down and forward.
    axes: [DVec3; 3],
    /// A pixel to the right and a pixel down: a length (orthographic) or a slope (perspective).
    step: [f64; 2],
    perspective: bool,
    /// How far a ray starts from `origin` at most.
    spread: f64,
    /// Whether no direction is so long that a method could overflow.
    ordinary: bool,
}

/// Up to this distance and radius, and with directions up to `LONGEST`, no method in binary32
/// overflows: B² ≤ 4·‖d‖²·‖o‖² < 2¹²⁴.
const FARTHEST: f64 = (1_u64 << 40) as f64;
const LONGEST: f64 = (1_u64 << 20) as f64;

/// The error that a method in binary32 can make in Δ/4A is at most this times ‖o‖² + r².
///
/// With u = 2⁻²⁴: o is off by u in each component; A, b and C by 4u of ‖d‖², ‖d‖‖o‖ and ‖o‖² + r²
/// at most, so b² − AC by less than 22u·A·(‖o‖² + r²). The perpendicular form is off by 10u·‖o‖ in
/// each component of its vector, so by less than 40u·‖o‖² in its square. 2⁻¹⁸ = 64u holds both.
const DISCRIMINANT_ERROR: f64 = 1.0 / (1 << 18) as f64;

/// A ray is rounded to binary32: by no more than 2⁻²⁴ of its direction and of where it starts in
/// each component. A multiple of it also covers the rounding of the bounds, which are in binary64.
const RAY_ERROR: f64 = 1.0 / (1 << 20) as f64;

/// More than what underflow to zero can take from any product, as a length.
const UNDERFLOW: f64 = 1.0 / (1_u64 << 60) as f64;

impl Eye {
    pub(super) fn new(rays: &Rays) -> Self {
        let step = [rays.right.length(), rays.down.length()];
        let [w, h] = [rays.size.width, rays.size.height].map(f64::from);
        let corner = (step[0] * w).hypot(step[1] * h) / 2.0;
        let (spread, longest) = if rays.perspective {
            (0.0, 1.0_f64.hypot(corner))
        } else {
            (corner, 1.0)
        };
        Self {
            size: rays.size,
            origin: rays.origin,
            axes: [
                rays.right / step[0],
                rays.down / step[1],
                rays.direction.normalize(),
            ],
            step,
            perspective: rays.perspective,
            spread,
            ordinary: longest <= LONGEST,
        }
    }

    /// The pixels at which a method may find that the line passes the centre of `sphere` at no more
    /// than `reach` times its radius, or fail to tell. With a reach of 1 these are hits.
    pub(super) fn window(&self, sphere: &Sphere, reach: f64) -> Bounds {
        let o = sphere.center.as_dvec3() - self.origin;
        let distance = o.length() + self.spread;
        let radius = f64::from(sphere.radius);
        if !(self.ordinary && distance <= FARTHEST && radius <= FARTHEST) {
            return Bounds::whole(self.size);
        }
        let radius = self.inflated(radius, reach, distance);
        let [a, b, z] = self.axes.map(|axis| o.dot(axis));
        let columns = self.span(a, z, radius, self.step[0], self.size.width);
        let rows = self.span(b, z, radius, self.step[1], self.size.height);
        Bounds {
            left: columns.start as i16,
            right: columns.end as i16 - 1,
            top: rows.start as i16,
            bottom: rows.end as i16 - 1,
        }
    }

    /// The columns of each row of that window, where they can be told.
    pub(super) fn spans(&self, sphere: &Sphere, reach: f64) -> Option<Spans> {
        let o = sphere.center.as_dvec3() - self.origin;
        let distance = o.length() + self.spread;
        let radius = f64::from(sphere.radius);
        if !(self.ordinary && distance <= FARTHEST && radius <= FARTHEST) {
            return None;
        }
        let radius = self.inflated(radius, reach, distance);
        let center = self.axes.map(|axis| o.dot(axis));
        let size = [self.size.width, self.size.height].map(f64::from);
        let spans = Spans::new(center, radius, self.perspective)
            .of_lines()
            .in_pixels(
                self.step.map(|step| 1.0 / step),
                size.map(|n| (n - 1.0) / 2.0),
            );
        Some(spans)
    }

    /// Whether a line may meet `sphere` behind the eye.
    pub(super) fn may_be_behind(&self, sphere: &Sphere) -> bool {
        let o = sphere.center.as_dvec3() - self.origin;
        let radius = f64::from(sphere.radius);
        let error = RAY_ERROR * (o.length() + self.spread + self.origin.length() + radius);
        let ahead = o.dot(self.axes[2]);
        // What is not a number may be anywhere.
        ahead <= radius + error || (ahead - radius - error).is_nan()
    }

    /// The radius of a sphere that every line meets of which a method may say that it meets the
    /// sphere of this `radius` at this `distance`. A method that errs by E in Δ/4A takes the line
    /// at distance p from the centre for a hit if p² ≤ r² + E at most; with a `reach` of k, for one
    /// that passes within k r, where Δ/4A > (1 − k²) r², if p² ≤ (k r)² + E.
    fn inflated(&self, radius: f64, reach: f64, distance: f64) -> f64 {
        let square = radius * radius;
        let taken = reach * reach * square + DISCRIMINANT_ERROR * (distance * distance + square);
        taken.sqrt() + RAY_ERROR * (distance + self.origin.length()) + UNDERFLOW
    }

    /// The pixels along one axis of the screen that a circle of this radius covers, whose centre
    /// lies at `a` along the axis and at `z` into the screen.
    fn span(&self, a: f64, z: f64, radius: f64, step: f64, pixels: u32) -> Range<u32> {
        let whole = 0..pixels;
        let [low, high] = if self.perspective {
            // A line knows no front and back: what is behind the eye is seen upside down.
            let (a, z) = if z < 0.0 { (-a, -z) } else { (a, z) };
            // Nearer than this to the plane of the eye a slope is too steep to be computed well:
            // elsewhere its error stays below 2⁻²⁹, and `RAY_ERROR` widens it by 2⁻²⁰ or more.
            if z <= radius * (1.0 + RAY_ERROR) {
                return whole;
            }
            let [z_plus, z_minus] = [z + radius, z - radius];
            let root = radius * (a * a + z_plus * z_minus).sqrt();
            [a * z - root, a * z + root].map(|s| s / (z_plus * z_minus))
        } else {
            [a - radius, a + radius]
        };
        let pixel = |s: f64| s / step + (f64::from(pixels) - 1.0) / 2.0;
        let [first, last] = [pixel(low).ceil(), pixel(high).floor()];
        if first.is_nan() || last.is_nan() {
            return whole;
        }
        // A float too small or too large for the picture becomes its first or last pixel.
        first.clamp(0.0, f64::from(pixels)) as u32
            ..(last + 1.0).clamp(0.0, f64::from(pixels)) as u32
    }
}
