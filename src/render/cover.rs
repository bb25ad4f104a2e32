//! Where a sphere can be seen: for each sphere a box of pixels and a lower bound of t, for many
//! spheres at once.
//!
//! Of what lies before the eye only, and for a method whose class is right: the box holds every
//! pixel whose ray, as rounded, meets the sphere at t > 0. Methods that may err are served by
//! [`super::bounds`].

use glam::DVec3;

use super::lanes::{LANES, Lanes, Real};
use crate::geometry::Sphere;
use crate::scene::{Body, Rays, Size};

/// A sphere is widened by this share of its distance and radius before it is projected.
///
/// A direction is off by 2⁻²⁴ in each component, so a ray passes within 2⁻²³(‖o‖ + r) of where it
/// should. The rest of 2⁻²⁰ is far more than the rounding of the projection, in binary64.
const RAY_ERROR: f64 = 1.0 / (1 << 20) as f64;

/// How far from a pixel a bound may lie and still count as on it: more than the rounding of a
/// coordinate that is not beyond every picture.
const NEARLY: f64 = 1.0 / 1024.0;

/// Spheres that are bounded together.
pub(super) const BLOCK: usize = 64;

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

    /// Whether the two have no pixel in common.
    #[inline(always)]
    pub(super) const fn is_apart_from(self, other: Self) -> bool {
        self.within(other).is_empty()
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

    /// The least rectangle of whole runs of `n` pixels that holds this one.
    pub(super) const fn in_runs_of(self, n: i16) -> Self {
        Self {
            left: self.left / n * n,
            right: self.right / n * n + n - 1,
            ..self
        }
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

/// What is known of the spheres of one block.
#[derive(Debug, Clone)]
pub(super) struct Block {
    center: [[f32; BLOCK]; 3],
    radius: [f32; BLOCK],
    left: [i32; BLOCK],
    right: [i32; BLOCK],
    top: [i32; BLOCK],
    bottom: [i32; BLOCK],
    /// No visible root is below this.
    least: [f32; BLOCK],
    behind: [bool; BLOCK],
}

impl Default for Block {
    fn default() -> Self {
        Self {
            center: [[0.0; BLOCK]; 3],
            radius: [0.0; BLOCK],
            left: [0; BLOCK],
            right: [0; BLOCK],
            top: [0; BLOCK],
            bottom: [0; BLOCK],
            least: [0.0; BLOCK],
            behind: [false; BLOCK],
        }
    }
}

impl Block {
    /// Takes in at most [`BLOCK`] spheres.
    fn load(&mut self, bodies: &[Body]) {
        for (i, body) in bodies.iter().enumerate() {
            self.put(i, &body.sphere);
        }
    }

    fn put(&mut self, i: usize, sphere: &Sphere) {
        self.center[0][i] = sphere.center.x;
        self.center[1][i] = sphere.center.y;
        self.center[2][i] = sphere.center.z;
        self.radius[i] = sphere.radius;
    }

    /// The pixels that sphere `i` of the block can cover; none if it lies behind the eye.
    pub(super) const fn bounds(&self, i: usize) -> Bounds {
        if self.behind[i] {
            return Bounds::NONE;
        }
        // No picture is larger than `Size::LARGEST`.
        Bounds {
            left: self.left[i] as i16,
            right: self.right[i] as i16,
            top: self.top[i] as i16,
            bottom: self.bottom[i] as i16,
        }
    }

    /// A lower bound of the visible roots of sphere `i` of the block.
    pub(super) const fn least(&self, i: usize) -> f32 {
        self.least[i]
    }

    /// Whether sphere `i` of the block lies behind the eye.
    pub(super) const fn is_behind(&self, i: usize) -> bool {
        self.behind[i]
    }
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
    /// How far off a ray may start, and how far from `origin` it does.
    origin_error: f64,
}

impl Projector {
    pub(super) fn new(rays: &Rays) -> Self {
        let step = [rays.right.length(), rays.down.length()];
        let size = [rays.size.width, rays.size.height].map(f64::from);
        let spread = (step[0] * size[0]).hypot(step[1] * size[1]);
        let origin_error = if rays.perspective {
            0.0
        } else {
            RAY_ERROR * (rays.origin.length() + spread)
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
        }
    }

    /// Bounds at most [`BLOCK`] spheres.
    pub(super) fn bound(&self, bodies: &[Body], block: &mut Block) {
        block.load(bodies);
        for i in (0..bodies.len()).step_by(LANES) {
            if self.perspective {
                self.bound_lanes::<true>(block, i);
            } else {
                self.bound_lanes::<false>(block, i);
            }
        }
    }

    /// The pixels that one sphere can cover, and a lower bound of its visible roots.
    pub(super) fn bound_one(&self, sphere: &Sphere) -> (Bounds, f32) {
        let mut block = Block::default();
        block.put(0, sphere);
        if self.perspective {
            self.bound_lanes::<true>(&mut block, 0);
        } else {
            self.bound_lanes::<false>(&mut block, 0);
        }
        (block.bounds(0), block.least(0))
    }

    #[inline(always)]
    fn bound_lanes<const PERSPECTIVE: bool>(&self, block: &mut Block, i: usize) {
        let o = [0, 1, 2].map(|k| Lanes::load(&block.center[k], i) - Lanes::of(self.origin[k]));
        let radius = Lanes::load(&block.radius, i);
        let [a, b, z] = self.axes.map(|axis| {
            Lanes::of(axis.x) * o[0] + Lanes::of(axis.y) * o[1] + Lanes::of(axis.z) * o[2]
        });
        let reach = o[0].abs() + o[1].abs() + o[2].abs() + radius;
        let widened = radius + Lanes::of(RAY_ERROR) * reach + Lanes::of(self.origin_error);

        let across = span::<PERSPECTIVE>(a, z, widened);
        let down = span::<PERSPECTIVE>(b, z, widened);
        let last_depth = z + widened;
        let least = ((z - widened) * Lanes::of(1.0 - 2.0 * RAY_ERROR)).at_least(0.0);
        let [left, right] = self.pixels(across, 0);
        let [top, bottom] = self.pixels(down, 1);
        for l in 0..LANES {
            block.left[i + l] = left[l];
            block.right[i + l] = right[l];
            block.top[i + l] = top[l];
            block.bottom[i + l] = bottom[l];
            block.least[i + l] = least.0[l] as f32;
            // What is not a number is not behind.
            block.behind[i + l] = last_depth.0[l] <= 0.0;
        }
    }

    /// The first and the last pixel between two coordinates, clipped to the picture. A coordinate
    /// that is not a number ends nowhere.
    #[inline(always)]
    fn pixels(&self, [low, high]: [Lanes; 2], axis: usize) -> [[i32; LANES]; 2] {
        let [scale, middle] = [self.scale[axis], self.middle[axis]].map(Lanes::of);
        let rounds_up = Lanes::of(0.5 - NEARLY);
        let first = (low * scale + middle + rounds_up)
            .at_least(0.0)
            .at_most(self.last[axis] + 1.0);
        let last = (high * scale + middle - rounds_up)
            .at_most(self.last[axis])
            .at_least(-1.0);
        [first.nearest(), last.nearest()]
    }
}

/// What a circle of this radius about the point `a` to the side and `z` ahead covers, as seen from
/// the origin: slopes (perspective) or lengths.
#[inline(always)]
fn span<const PERSPECTIVE: bool>(a: Lanes, z: Lanes, radius: Lanes) -> [Lanes; 2] {
    if !PERSPECTIVE {
        return [a - radius, a + radius];
    }
    // The tangents from the origin, l long, have the directions (a l ∓ z r, z l ± a r). One that
    // points backwards leaves that side open; without tangents l is not a number.
    let l = (a * a + z * z - radius * radius).sqrt();
    let [al, zl, ar, zr] = [a * l, z * l, a * radius, z * radius];
    let [low_ahead, high_ahead] = [zl + ar, zl - ar];
    let infinite = Lanes::of(f64::INFINITY);
    [
        (-infinite).where_negative(low_ahead, (al - zr) / low_ahead),
        infinite.where_negative(high_ahead, (al + zr) / high_ahead),
    ]
}

impl Lanes {
    /// The nearest integers of numbers within ±2³¹.
    #[inline(always)]
    fn nearest(self) -> [i32; LANES] {
        // Adding 1.5·2⁵² leaves the integer in the low bits: a conversion that any processor has
        // for many lanes at once.
        const SHIFT: f64 = 6_755_399_441_055_744.0;
        std::array::from_fn(|l| (self.0[l] + SHIFT).to_bits() as i32)
    }
}
