//! Where many spheres can be met, and which of them to ask about first: bounds in binary32, as many
//! spheres at once as a vector holds, and an order from front to back.
//!
//! The bounds hold what those of [`super::projector`] hold, with proof; the sphere is widened a little
//! more. Spheres that they do not serve, near the plane of the eye or around it, beyond 2²⁰ or within
//! 2⁻²⁰, and whole lines, take those of [`super::projector`], one by one.

#![expect(
    clippy::manual_range_contains,
    clippy::needless_bitwise_bool,
    reason = "a comparison that may be skipped is a branch, and a loop with branches is not compiled to vectors"
)]

use glam::{DVec3, Vec3};

use super::bounds::Bounds;
use super::lanes::{Real, dot, sub};
use super::layer::refill;
use super::plan::{Counts, Interest, Strategy};
use super::projected::{GREATEST_REACH, LEAST_REACH, Projected};
use super::projector::Projector;
use super::view::View;
use crate::geometry::Sphere;

/// Spheres that are bounded and put in order together: few enough for all that is known of them to
/// stay near the processor.
pub(super) const MOST: usize = 16_384;

/// A sphere is widened by this share of its distance and radius before it is projected.
///
/// With u = 2⁻²⁴, in perspective: the rays pass within 2u|o| of where they should. o is off by u in
/// each component, the centre (a, b, z) in the axes of the camera, rounded too, by 5.1u|o| in each of
/// its own, so by 9u|o|. With m = z² − r², l² = a² + m: where z ≥ 1.5 r, m is off by 8u·m, l by 6u·l, so
/// az ± rl by 8u(a² + z²), and a slope (az ± rl)/m by 8u(a² + z²)/m + 10u of itself. The directions of
/// the two tangents have slopes s and s′ with (a² + z²)/m = √(1 + s²)√(1 + s′²), and
/// (1 + s′²) ≤ 25(1 + s²) where z ≥ 1.5 r: the tangent turns by less than 40u + 5u and passes the sphere
/// within 45u|o| of where it should. All that, 56u|o|, is less than half of 2⁻¹⁷ = 128u of |o| + r.
/// Parallel rays: 2u for where they start, 9u for the centre, u for a ± r.
const SLACK: f32 = 1.0 / (1 << 17) as f32;

/// How far from a pixel a bound may lie and still count as on it: more than the three roundings of a
/// coordinate below [`Size::LARGEST`](crate::scene::Size::LARGEST), each by 2⁻¹³.
const NEARLY: f32 = 1.0 / 1024.0;

/// From this share of the radius on, ahead of the eye, the bounds in binary32 serve.
const LEAST_AHEAD: f32 = 1.5;

/// As many buckets of depth.
const BUCKETS: usize = 256;

/// Fewer spheres than this are asked about as they come.
const WORTH_ORDER: usize = 4;

/// Some spheres of a scene: where each can be met, and those that can, from front to back.
#[derive(Debug, Clone, Default)]
pub(super) struct Windows {
    pub(super) bounds: Vec<Bounds>,
    /// No visible root is below this.
    pub(super) least: Vec<f32>,
    /// Those with pixels to be asked about.
    seen: Vec<u32>,
    order: Vec<u32>,
}

/// The camera in binary32: unit axes, and the pixel step along each.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lens {
    origin: [f32; 3],
    /// Right, down and forward.
    axes: [[f32; 3]; 3],
    /// Pixels to a unit of slope (perspective) or of length (orthographic).
    scale: [f32; 2],
    /// The pixel, in fractions, of the middle of the picture.
    middle: [f32; 2],
    last: [f32; 2],
    perspective: bool,
    /// How far off a ray may start, and how far from `origin`.
    spread: f32,
    origin_error: f32,
}

/// Spheres that are bounded in one loop.
const BLOCK: usize = 64;

/// Some spheres in arrays, and where they can be seen.
struct SphereBlock {
    x: [f32; BLOCK],
    y: [f32; BLOCK],
    z: [f32; BLOCK],
    radius: [f32; BLOCK],
    left: [i32; BLOCK],
    right: [i32; BLOCK],
    top: [i32; BLOCK],
    bottom: [i32; BLOCK],
    least: [f32; BLOCK],
    /// 1 if it lies behind the eye; if all of this is true of it; if it can be seen.
    behind: [u32; BLOCK],
    served: [u32; BLOCK],
    seen: [u32; BLOCK],
}

impl Lens {
    pub(super) fn new(projector: &Projector) -> Self {
        let vector = |v: DVec3| v.as_vec3().to_array();
        let pair = |pair: [f64; 2]| pair.map(|x| x as f32);
        Self {
            origin: vector(projector.origin),
            axes: projector.axes.map(vector),
            scale: pair(projector.scale),
            middle: pair(projector.middle),
            last: pair(projector.last),
            perspective: projector.perspective,
            // What they start off by is 2⁻²⁴ of where they start at most; rounded up, and more.
            spread: (projector.spread + 2.0 * projector.origin_error) as f32,
            origin_error: 2.0 * projector.origin_error as f32,
        }
    }

    /// What the test in binary32 needs of a sphere that no ray meets before `least`, if it serves it.
    #[inline(always)]
    pub(super) fn project<const PERSPECTIVE: bool>(
        &self,
        sphere: &Sphere,
        least: f32,
    ) -> Option<Projected> {
        if PERSPECTIVE {
            Projected::from_point(self.origin, sphere)
        } else {
            Projected::of_parallels(self.origin, self.spread, sphere, least)
        }
    }

    /// Bounds the spheres of a block within `part`.
    ///
    /// All of it in one loop, without a branch: then it is compiled to vectors.
    #[inline(always)]
    fn bound<const PERSPECTIVE: bool>(
        &self,
        block: &mut SphereBlock,
        part: Bounds,
        lines_too: bool,
    ) {
        let [lefts, rights, tops, bottoms] =
            [part.left, part.right, part.top, part.bottom].map(i32::from);
        for i in 0..BLOCK {
            let [x, y, z] = [block.x[i], block.y[i], block.z[i]];
            let o = sub([x, y, z], self.origin);
            let [a, b, z] = self.axes.map(|axis| dot(axis, o));
            // At least |o| + r.
            let reach = o[0].abs() + o[1].abs() + o[2].abs() + block.radius[i] + self.spread;
            let r = block.radius[i] + SLACK * reach + self.origin_error;
            let m = z * z - r * r;
            let [across, down] = if PERSPECTIVE {
                let scale = 1.0 / m;
                [a, b].map(|a| {
                    let (az, rl) = (a * z, r * (a * a + m).sqrt());
                    [(az - rl) * scale, (az + rl) * scale]
                })
            } else {
                [a, b].map(|a| [a - r, a + r])
            };
            let behind = z + r <= 0.0;
            let is_ahead = if PERSPECTIVE {
                z >= LEAST_AHEAD * r
            } else {
                true
            };
            let in_range = (reach >= LEAST_REACH) & (reach <= GREATEST_REACH);
            let served = (is_ahead | behind) & in_range & !(lines_too & (z - r <= 0.0));
            let [left, right] = self.pixels(across, 0);
            let [top, bottom] = self.pixels(down, 1);
            let left = if left > lefts { left } else { lefts };
            let right = if right < rights { right } else { rights };
            let top = if top > tops { top } else { tops };
            let bottom = if bottom < bottoms { bottom } else { bottoms };
            block.left[i] = left;
            block.right[i] = right;
            block.top[i] = top;
            block.bottom[i] = bottom;
            block.least[i] = (z - r).at_least(0.0);
            block.behind[i] = u32::from(behind);
            block.served[i] = u32::from(served);
            block.seen[i] = u32::from(!behind & (left <= right) & (top <= bottom));
        }
    }

    /// The first and the last pixel between two coordinates, clipped to the picture.
    #[inline(always)]
    fn pixels(&self, [low, high]: [f32; 2], axis: usize) -> [i32; 2] {
        let (scale, middle, last) = (self.scale[axis], self.middle[axis], self.last[axis]);
        let first_one = (low * scale + middle + (0.5 - NEARLY))
            .max(0.0)
            .min(last + 1.0);
        let last_one = (high * scale + middle - (0.5 - NEARLY)).min(last).max(-1.0);
        [nearest(first_one), nearest(last_one)]
    }
}

/// The nearest integer of a number within ±2²².
#[inline(always)]
fn nearest(x: f32) -> i32 {
    // Adding 1.5·2²³ leaves the integer in the low bits: a conversion that any processor has for
    // many lanes at once.
    const SHIFT: f32 = 12_582_912.0;
    (x + SHIFT).to_bits() as i32 - SHIFT.to_bits() as i32
}

impl SphereBlock {
    const fn new() -> Self {
        const ZEROS: [f32; BLOCK] = [0.0; BLOCK];
        const ZERO: [i32; BLOCK] = [0; BLOCK];
        Self {
            x: ZEROS,
            y: ZEROS,
            z: ZEROS,
            radius: ZEROS,
            left: ZERO,
            right: ZERO,
            top: ZERO,
            bottom: ZERO,
            least: ZEROS,
            behind: [0; BLOCK],
            served: [0; BLOCK],
            seen: [0; BLOCK],
        }
    }

    /// Takes in the spheres, at most [`BLOCK`] of them.
    #[inline(always)]
    fn load<'a>(&mut self, count: usize, sphere: impl Fn(usize) -> &'a Sphere) {
        for i in 0..count {
            let Sphere { center, radius } = *sphere(i);
            self.x[i] = center.x;
            self.y[i] = center.y;
            self.z[i] = center.z;
            self.radius[i] = radius;
        }
    }

    /// Bounds those that binary32 does not serve.
    #[cold]
    #[inline(never)]
    fn bound_others(
        &mut self,
        projector: &Projector,
        interest: Interest,
        count: usize,
        part: Bounds,
    ) {
        for i in (0..count).filter(|&i| self.served[i] == 0) {
            let sphere = Sphere {
                center: Vec3::new(self.x[i], self.y[i], self.z[i]),
                radius: self.radius[i],
            };
            let window = interest.window(projector, &sphere);
            let bounds = window.bounds.within(part);
            self.left[i] = bounds.left.into();
            self.right[i] = bounds.right.into();
            self.top[i] = bounds.top.into();
            self.bottom[i] = bounds.bottom.into();
            self.least[i] = window.least;
            self.behind[i] = window.behind.into();
            self.seen[i] = (!bounds.is_empty()).into();
        }
    }
}

impl Windows {
    /// Bounds `count` spheres, of which this is the i-th, within `part`, and puts those with pixels there
    /// in order.
    #[inline(always)]
    pub(super) fn gather<'a>(
        &mut self,
        (lens, projector): (&Lens, &Projector),
        interest: Interest,
        count: usize,
        sphere: impl Fn(usize) -> &'a Sphere,
        part: Bounds,
        counts: &mut Counts,
    ) {
        refill(&mut self.bounds, count, Bounds::NONE);
        refill(&mut self.least, count, 0.0);
        refill(&mut self.seen, count, 0);
        let is_certified = interest.way == Strategy::Certified;
        let lines_too = interest.view == View::Class;
        let mut block = SphereBlock::new();
        let mut seen = 0;
        let mut behind = 0;
        for first in (0..count).step_by(BLOCK) {
            let taken = (count - first).min(BLOCK);
            block.load(taken, |i| sphere(first + i));
            match (is_certified, lens.perspective) {
                (true, true) => lens.bound::<true>(&mut block, part, lines_too),
                (true, false) => lens.bound::<false>(&mut block, part, lines_too),
                (false, _) => block.served[..taken].fill(0),
            }
            let served: u32 = block.served[..taken].iter().sum();
            if served < taken as u32 {
                block.bound_others(projector, interest, taken, part);
            }
            behind += block.behind[..taken].iter().sum::<u32>();
            self.least[first..first + taken].copy_from_slice(&block.least[..taken]);
            // No picture is larger than `Size::LARGEST`.
            for (i, bounds) in self.bounds[first..first + taken].iter_mut().enumerate() {
                *bounds = Bounds {
                    left: block.left[i] as i16,
                    right: block.right[i] as i16,
                    top: block.top[i] as i16,
                    bottom: block.bottom[i] as i16,
                };
            }
            for i in 0..taken {
                self.seen[seen] = (first + i) as u32;
                seen += block.seen[i] as usize;
            }
        }
        counts.behind += u64::from(behind);
        counts.outside += count as u64 - seen as u64 - u64::from(behind);
        self.seen.truncate(seen);
        // Which is asked first saves work only where what is hidden may be left out.
        self.put_in_order(if is_certified {
            WORTH_ORDER
        } else {
            usize::MAX
        });
    }

    /// Those that can be seen, were it not for others, about from front to back.
    pub(super) fn in_order(&self) -> &[u32] {
        &self.order
    }

    /// Sorts by counting, by the bits of `least`: these are in the order of the numbers.
    #[inline(always)]
    fn put_in_order(&mut self, worth_it: usize) {
        self.order.clear();
        if self.seen.len() < worth_it {
            self.order.extend_from_slice(&self.seen);
            return;
        }
        let bits = |i: &u32| self.least[*i as usize].to_bits();
        let (mut low, mut high) = (u32::MAX, 0);
        for bits in self.seen.iter().map(bits) {
            low = low.min(bits);
            high = high.max(bits);
        }
        // So many low bits of what lies between the two are left out.
        let shift = (u32::BITS - (high - low).leading_zeros()).saturating_sub(BUCKETS.ilog2());
        let bucket = |i: &u32| ((bits(i) - low) >> shift) as usize;
        let mut ends = [0_u32; BUCKETS + 1];
        for i in &self.seen {
            ends[bucket(i) + 1] += 1;
        }
        for i in 0..BUCKETS {
            ends[i + 1] += ends[i];
        }
        self.order.resize(self.seen.len(), 0);
        for i in &self.seen {
            let place = &mut ends[bucket(i)];
            self.order[*place as usize] = *i;
            *place += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use proptest::strategy::Strategy;

    use super::*;
    use crate::method::Method;
    use crate::render::projector::Reach;
    use crate::scene::{Camera, PixelShape, Projection, Rays, Size};

    /// Anything from far less to far more, as a power of two.
    fn any_scale(least: f32, most: f32) -> impl Strategy<Value = f32> {
        (least..most).prop_map(f32::exp2)
    }

    fn any_direction() -> impl Strategy<Value = Vec3> {
        prop::array::uniform3(-1.0_f32..1.0)
            .prop_map(Vec3::from)
            .prop_filter("a direction", |v| v.length() > 0.01)
            .prop_map(Vec3::normalize)
    }

    fn any_projection() -> impl Strategy<Value = Projection> {
        prop_oneof![
            (0.01_f32..179.0).prop_map(|field_of_view| Projection::Perspective { field_of_view }),
            any_scale(-6.0, 6.0).prop_map(|side| Projection::Orthographic {
                extent: [side, side],
                step: None
            }),
        ]
    }

    fn any_camera() -> impl Strategy<Value = Camera> {
        let position = (any_direction(), any_scale(-10.0, 12.0)).prop_map(|(v, d)| v * d);
        (any_projection(), position, any_direction()).prop_map(
            |(projection, position, direction)| Camera {
                projection,
                position,
                look_at: position + direction * position.length(),
                up: direction.any_orthogonal_vector(),
            },
        )
    }

    /// A sphere at a distance from the eye, of a size in its proportion; many where binary32 begins and
    /// ends to serve.
    fn any_sphere(camera: Camera) -> impl Strategy<Value = Sphere> {
        let share = prop_oneof![any_scale(-16.0, 2.0), 0.6_f32..0.7];
        let off = prop_oneof![any_scale(-12.0, 2.0), Just(0.0)];
        (any_direction(), any_scale(-8.0, 10.0), share, off).prop_map(
            move |(direction, distance, share, off)| {
                let ahead = (camera.look_at - camera.position).normalize();
                let towards = (ahead + direction * off).normalize_or(ahead);
                Sphere {
                    center: camera.position + towards * distance,
                    radius: distance * share,
                }
            },
        )
    }

    fn any_size() -> impl Strategy<Value = Size> {
        let sides = prop_oneof![
            (1_u32..200, 1_u32..200),
            (Size::LARGEST - 9..=Size::LARGEST, 1_u32..8),
            (1_u32..8, Size::LARGEST - 9..=Size::LARGEST),
        ];
        sides.prop_map(|(width, height)| Size::new(width, height))
    }

    const SEEN: Interest = Interest {
        way: super::Strategy::Certified,
        view: View::Shade,
    };

    /// Where one sphere can be seen.
    fn bound(rays: &Rays, sphere: &Sphere) -> (Bounds, f32) {
        let projector = Projector::new(rays);
        let lenses = (&Lens::new(&projector), &projector);
        let mut windows = Windows::default();
        let whole = Bounds::whole(rays.size);
        let mut counts = Counts::default();
        windows.gather(lenses, SEEN, 1, |_| sphere, whole, &mut counts);
        let found = windows.in_order().len() as u64;
        assert_eq!(found + counts.behind + counts.outside, 1);
        (windows.bounds[0], windows.least[0])
    }

    /// The pixels beside a box, some rows and columns of them, and those within it.
    fn pixels_about(bounds: Bounds, size: Size) -> Vec<(u32, u32)> {
        let [w, h] = [size.width, size.height];
        let all = || (0..h).flat_map(move |y| (0..w).map(move |x| (x, y)));
        if bounds.is_empty() || w * h < 1000 {
            return all().step_by(1 + (w * h) as usize / 1000).collect();
        }
        let Bounds {
            left,
            right,
            top,
            bottom,
        } = bounds;
        let beside = |x: u32, y: u32| {
            let (x, y) = (x as i16, y as i16);
            let columns = x + 1 == left || x == right + 1;
            let rows = y + 1 == top || y == bottom + 1;
            columns || rows || (x % 16 == left % 16 && y % 16 == top % 16)
        };
        all().filter(|&(x, y)| beside(x, y)).collect()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1500))]
        #[test]
        fn no_pixel_outside_the_bounds_and_no_root_below_the_least(
            (sphere, camera) in any_camera().prop_flat_map(|c| (any_sphere(c), Just(c))),
            size in any_size(),
        ) {
            prop_assume!(camera.check().is_ok());
            let rays = Rays::new(&camera, size, PixelShape::Aspect(1.0));
            let (bounds, least) = bound(&rays, &sphere);
            for (x, y) in pixels_about(bounds, size) {
                let Some(t) = Method::Exact.solve(&rays.ray(x, y), &sphere).visible() else {
                    continue;
                };
                let (column, row) = (x as i16, y as i16);
                let within = (bounds.left..=bounds.right).contains(&column)
                    && (bounds.top..=bounds.bottom).contains(&row);
                prop_assert!(within, "({x}, {y}) of {bounds:?}");
                prop_assert!(least <= t, "{least} above {t} at ({x}, {y})");
            }
        }

        /// They hold those in binary64, and are hardly wider.
        #[test]
        fn the_bounds_are_close(
            (sphere, camera) in any_camera().prop_flat_map(|c| (any_sphere(c), Just(c))),
            size in any_size(),
        ) {
            prop_assume!(camera.check().is_ok());
            let rays = Rays::new(&camera, size, PixelShape::Aspect(1.0));
            let (bounds, _) = bound(&rays, &sphere);
            let close = Projector::new(&rays).window(&sphere, Reach::Seen).bounds;
            prop_assert!(close.area() <= bounds.area(), "{close:?} {bounds:?}");
            // Where a pixel is far more than what the spheres are widened by.
            let is_coarse = rays.perspective && rays.down.length().min(rays.right.length()) > 1e-3;
            if is_coarse {
                let grown = close.widened(size);
                prop_assert!(bounds.within(grown) == bounds || close.is_empty(), "{close:?} {bounds:?}");
            }
        }
    }

    #[test]
    fn the_order_is_from_front_to_back_to_within_a_bucket() {
        let camera = Camera {
            projection: Projection::Perspective {
                field_of_view: 45.0,
            },
            position: Vec3::new(0.0, 0.0, 30.0),
            look_at: Vec3::ZERO,
            up: Vec3::Y,
        };
        let rays = Rays::new(&camera, Size::new(200, 120), PixelShape::Aspect(1.0));
        let projector = Projector::new(&rays);
        let lens = Lens::new(&projector);
        let (count, whole) = (5000, Bounds::whole(rays.size));
        let spheres: Vec<_> = (0..count)
            .map(|i| {
                let part = |step: f64| ((f64::from(i) * step).fract() * 20.0 - 10.0) as f32;
                Sphere {
                    center: Vec3::new(part(0.618_034), part(0.754_878), part(0.569_840)),
                    radius: 0.4,
                }
            })
            .collect();
        let mut windows = Windows::default();
        let lenses = (&lens, &projector);
        windows.gather(
            lenses,
            SEEN,
            spheres.len(),
            |i| &spheres[i],
            whole,
            &mut Counts::default(),
        );
        let mut order = windows.in_order().to_vec();
        let depth = |i: &u32| windows.least[*i as usize];
        // The eye is 30 from the middle of a cube of side 20, whose depths fall into 128 to 256 buckets.
        let steps = order
            .windows(2)
            .map(|pair| depth(&pair[0]) - depth(&pair[1]));
        assert!(steps.fold(0.0, f32::max) < 20.0 / 64.0);
        order.sort_unstable();
        order.dedup();
        assert_eq!(order, windows.seen);
    }
}
