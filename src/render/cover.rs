//! Where a sphere can be seen: for each sphere a box of pixels and a lower bound of t, for many
//! spheres at once.
//!
//! Of what lies before the eye only, and for a method whose class is right: the box holds every
//! pixel whose ray, as rounded, meets the sphere at t > 0. Methods that may err are served by
//! [`super::bounds`].

use glam::DVec3;

use super::field::TILE;
use super::lanes::{LANES, Lanes, Real, dot};
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
    /// p0 − c (perspective), rounded.
    origin: [[f32; BLOCK]; 3],
    /// (p0 − c)² − r² (perspective) and r², rounded.
    c: [f32; BLOCK],
    r2: [f32; BLOCK],
    /// See [`Single`].
    doubt: [f32; BLOCK],
    accept: [f32; BLOCK],
}

impl Default for Block {
    fn default() -> Self {
        const ZEROS: [f32; BLOCK] = [0.0; BLOCK];
        Self {
            center: [ZEROS; 3],
            radius: ZEROS,
            left: [0; BLOCK],
            right: [0; BLOCK],
            top: [0; BLOCK],
            bottom: [0; BLOCK],
            least: ZEROS,
            behind: [false; BLOCK],
            origin: [ZEROS; 3],
            c: ZEROS,
            r2: ZEROS,
            doubt: ZEROS,
            accept: ZEROS,
        }
    }
}

/// What the certified test in binary32 needs of a sphere; the tests are in [`super::nearest`].
#[derive(Debug, Clone, Copy)]
pub(super) struct Single {
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
const LEAST_SHARE: f64 = 1.0 / (1 << 17) as f64;

/// D = A r² − ‖o × d‖² in binary32 is off by less than 2⁻¹⁹ A r(|o| + r), where |o × d| ≤ 2√A r.
///
/// With u = 2⁻²⁴: o, each product and each difference are off by u, so each component of o × d by 3u
/// of the sum of its products' sizes, and the vector by 3√2 u‖d‖|o| < 4.3u√A|o|. Its square, at most
/// 4A r², is off by 8.6u·2A r|o| + 18.5u²A o² + 12u A r², A r² by 3u A r², their difference by another
/// 4u A r². With u|o| < 2⁻⁷ r the sum is below u A r(17.4|o| + 19 r), and 2⁻¹⁹ = 32u.
///
/// A line that passes farther away, |o × d| = k > 2√A r, is off by less than
/// k²(8.6u√A|o|/k + 18.5u²A o²/k² + 8u) < 0.04k², while −D > 0.75k²: a miss beyond all doubt.
const SINGLE_ERROR: f64 = 1.0 / (1 << 19) as f64;

/// A root with this relative error still tells depths apart: half of [`super::nearest::SAME`], less
/// what the operations after the square root add.
const ROOT_ERROR: f64 = 1.0 / (1 << 14) as f64;

/// Between these no product of the test in binary32 leaves its normal range.
const LEAST_REACH: f64 = 1.0 / GREATEST_REACH;
const GREATEST_REACH: f64 = (1 << 20) as f64;

impl Block {
    /// Takes in at most [`BLOCK`] spheres.
    #[inline(always)]
    fn load(&mut self, bodies: &[Body]) {
        for (i, body) in bodies.iter().enumerate() {
            self.put(i, &body.sphere);
        }
    }

    #[inline(always)]
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

    /// What the test in binary32 needs of sphere `i` of the block, if it serves it.
    #[inline(always)]
    pub(super) fn single(&self, i: usize, perspective: bool) -> Option<Single> {
        let accept = self.accept[i];
        let origin = if perspective {
            &self.origin
        } else {
            &self.center
        };
        (!accept.is_nan()).then(|| Single {
            origin: [origin[0][i], origin[1][i], origin[2][i]],
            c: self.c[i],
            r2: self.r2[i],
            doubt: self.doubt[i],
            accept,
        })
    }

    /// Makes ready for the test in binary32; where it does not serve, `accept` is not a number.
    ///
    /// A root C/(|b| + √D) with D > kA·`doubt` is off by ½√(`doubt`/kC) of itself, plus 4u|o|/√C for b
    /// and a few u. Where C ≥ o²/4 that is below 2⁻¹⁴ + 12u if k·`doubt` ≥ 2²⁶`doubt`²/C. A root
    /// (|b| − √D)/A of parallel rays is no less than `least`, which takes the place of √C; |o| is then at
    /// most 64 times that, which makes 4u|o| no more than 2⁻¹⁶ of it.
    #[inline(always)]
    fn prepare_singles<const PERSPECTIVE: bool>(
        &mut self,
        i: usize,
        o: [Lanes; 3],
        reach: Lanes,
        radius: Lanes,
        least: Lanes,
    ) {
        let o2 = dot(o, o);
        let r2 = radius * radius;
        let c = o2 - r2;
        let (nearest2, served) = if PERSPECTIVE {
            (c, c - Lanes::of(0.25) * o2)
        } else {
            (least * least, Lanes::of(64.0) * least - reach)
        };
        let doubt = Lanes::of(SINGLE_ERROR) * radius * reach;
        let for_class = doubt + doubt;
        let for_root = doubt * doubt / (Lanes::of(4.0 * ROOT_ERROR * ROOT_ERROR) * nearest2);
        let accept = for_root.where_negative(for_class - for_root, for_class);
        let not = Lanes::of(f64::NAN);
        let accept = not.where_negative(served, accept);
        let accept = not.where_negative(radius - Lanes::of(LEAST_SHARE) * reach, accept);
        let accept = not.where_negative(reach - Lanes::of(LEAST_REACH), accept);
        let accept = not.where_negative(Lanes::of(GREATEST_REACH) - reach, accept);
        for l in 0..LANES {
            self.origin[0][i + l] = -o[0].0[l] as f32;
            self.origin[1][i + l] = -o[1].0[l] as f32;
            self.origin[2][i + l] = -o[2].0[l] as f32;
            self.c[i + l] = c.0[l] as f32;
            self.r2[i + l] = r2.0[l] as f32;
            self.doubt[i + l] = doubt.0[l] as f32;
            self.accept[i + l] = accept.0[l] as f32;
        }
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
    pub(super) perspective: bool,
    /// How far off a ray may start.
    origin_error: f64,
    /// How far from `origin` it starts at most, those beyond the right edge included.
    spread: f64,
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

    /// Bounds at most [`BLOCK`] spheres.
    #[inline(always)]
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

    /// Bounds one sphere, as the first of a block.
    pub(super) fn bound_one(&self, sphere: &Sphere, block: &mut Block) {
        block.put(0, sphere);
        if self.perspective {
            self.bound_lanes::<true>(block, 0);
        } else {
            self.bound_lanes::<false>(block, 0);
        }
    }

    /// The columns that one sphere can cover in each row.
    pub(super) fn spans(&self, sphere: &Sphere) -> Spans {
        let o = sphere.center.as_dvec3() - self.origin;
        let radius = f64::from(sphere.radius);
        let reach = o.abs().element_sum() + radius + self.spread;
        let widened = radius + RAY_ERROR * reach + self.origin_error;
        let center = self.axes.map(|axis| o.dot(axis));
        Spans::new(center, widened, self.perspective).in_pixels(self.scale, self.middle)
    }

    #[inline(always)]
    fn bound_lanes<const PERSPECTIVE: bool>(&self, block: &mut Block, i: usize) {
        let [x, y, z] = &block.center;
        let o = [
            Lanes::load(x, i) - Lanes::of(self.origin.x),
            Lanes::load(y, i) - Lanes::of(self.origin.y),
            Lanes::load(z, i) - Lanes::of(self.origin.z),
        ];
        let radius = Lanes::load(&block.radius, i);
        let [right, down, forward] = self.axes;
        let [a, b, z] = [along(right, o), along(down, o), along(forward, o)];
        // At least |o| + r.
        let reach = o[0].abs() + o[1].abs() + o[2].abs() + radius + Lanes::of(self.spread);
        let widened = radius + Lanes::of(RAY_ERROR) * reach + Lanes::of(self.origin_error);

        let across = span::<PERSPECTIVE>(a, z, widened);
        let down = span::<PERSPECTIVE>(b, z, widened);
        let last_depth = z + widened;
        let least = ((z - widened) * Lanes::of(1.0 - 2.0 * RAY_ERROR)).at_least(0.0);
        let [left, right] = self.pixels(across, 0);
        let [top, bottom] = self.pixels(down, 1);
        block.prepare_singles::<PERSPECTIVE>(i, o, reach, radius, least);
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
        let scale = Lanes::of(self.scale[axis]);
        let middle = Lanes::of(self.middle[axis]);
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

/// How far vectors reach along a unit axis.
#[inline(always)]
fn along(axis: DVec3, o: [Lanes; 3]) -> Lanes {
    Lanes::of(axis.x) * o[0] + Lanes::of(axis.y) * o[1] + Lanes::of(axis.z) * o[2]
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
    #[inline]
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
        is_met.then(|| [(a * g - half) / self.m, (a * g + half) / self.m])
    }
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
