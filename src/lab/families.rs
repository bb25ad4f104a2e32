//! Families: named kinds of rays, from the everyday to the hardest that binary32 can write down.
//!
//! Each is a seeded generator that uses + − × ÷ √ and bits, so that a seed means the same rays on
//! every machine.

use glam::Vec3;

use crate::geometry::vector::dot;
use crate::geometry::{Ray, Sphere};
use crate::method::Method;
use crate::number::power_of_two;
use crate::random::Random;

/// A named kind of rays.
#[derive(Debug, Clone, Copy)]
pub struct Family {
    /// The name on the command line and in reports.
    pub name: &'static str,
    /// One sentence on what its rays are.
    pub about: &'static str,
    /// What kind of rays these are, for those who want to know which method suits it.
    pub kind: RayKind,
    draw: fn(&mut Random) -> DrawnCase,
}

/// What families have in common.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RayKind {
    /// Near spheres of ordinary size, from outside or inside, d of length 1.
    Near,
    /// The same with a d that is not, or not quite.
    Unnormalised,
    /// Far away for their size.
    Far,
    /// All but tangents, and tangents.
    Touching,
    /// From on or just above the surface, as a second ray starts.
    Surface,
    /// Sizes and bits of every sort.
    Any,
}

impl RayKind {
    /// All kinds, the everyday ones first.
    pub const ALL: [Self; 6] = [
        Self::Near,
        Self::Unnormalised,
        Self::Far,
        Self::Touching,
        Self::Surface,
        Self::Any,
    ];

    /// The words for it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Near => "near",
            Self::Unnormalised => "d not 1 long",
            Self::Far => "far or tiny",
            Self::Touching => "touching",
            Self::Surface => "from a surface",
            Self::Any => "any bits",
        }
    }
}

/// A ray and a sphere before they are rounded to binary32.
pub(super) struct DrawnCase {
    pub origin: [f64; 3],
    pub direction: [f64; 3],
    pub center: [f64; 3],
    pub radius: f64,
}

impl DrawnCase {
    /// The ray and sphere in binary32, if they are a ray and a sphere.
    pub fn rounded(&self) -> Option<(Ray, Sphere)> {
        let vector = |v: [f64; 3]| Vec3::from(v.map(|x| x as f32));
        let ray = Ray::new(vector(self.origin), vector(self.direction)).ok()?;
        let sphere = Sphere::new(vector(self.center), self.radius as f32).ok()?;
        Some((ray, sphere))
    }

    /// The roots before any rounding to binary32, by Lagrange's identity in binary64.
    pub fn roots(&self) -> Option<[f64; 2]> {
        let (d, r) = (self.direction, self.radius);
        let o = [0, 1, 2].map(|i| self.origin[i] - self.center[i]);
        let k = [0, 1, 2].map(|i| {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            o[j] * d[k] - o[k] * d[j]
        });
        let (a, b) = (dot(d, d), dot(o, d));
        let root = (a * r * r - dot(k, k)).sqrt();
        (!root.is_nan()).then(|| [(-b - root) / a, (-b + root) / a])
    }
}

macro_rules! families {
    ($($name:literal $kind:ident $draw:ident $about:literal;)*) => {
        /// All families, the everyday ones first.
        pub const ALL: &'static [Self] = &[$(Self {
            name: $name,
            about: $about,
            kind: RayKind::$kind,
            draw: $draw,
        }),*];
    };
}

impl Family {
    families! {
        "typical" Near typical "A few radii away, aimed near the edge: about two of three hit.";
        "inside" Near inside "From inside the sphere.";
        "end-minus-start" Unnormalised end_minus_start "From one point towards another: d is the difference of the two, rounded.";
        "near-unit" Unnormalised near_unit "Typical rays with d of length 1 but for a few ulps in each coordinate.";
        "far-4e3" Far far_4e3 "4000 radii away: r² has all but vanished from |o|² in binary32.";
        "far-1e6" Far far_1e6 "A million radii away.";
        "grazing" Touching grazing "The line's distance from the centre is r to within one part in 10⁷.";
        "tangent" Touching tangent "Exact tangents in whole numbers.";
        "tangent-ulp" Touching tangent_ulp "Exact tangents with one coordinate moved by one ulp.";
        "tangent-wide" Touching tangent_wide "Exact tangents of exponents far apart, some tilted by the least subnormal.";
        "surface" Surface surface "From the surface, up to the rounding of the origin.";
        "surface-exact" Surface surface_exact "From the surface exactly, in whole numbers: C = 0.";
        "own-hit" Surface own_hit "From the point where textbook saw a typical ray hit, in any direction: a second ray.";
        "ground" Surface ground "From eye height and below, over a sphere of radius 10⁶.";
        "huge-radius" Surface huge_radius "Radii from 10⁶ to 10³⁰ times the distance to the surface.";
        "tiny-radius" Far tiny_radius "Radii down to 10⁻³⁰ of the distance.";
        "point" Touching point "Spheres of radius 0, most of them hit or missed by a hair.";
        "offset" Near offset "Everything 10⁶ to 10⁷ away from the world's origin.";
        "integers" Any integers "Small whole numbers, of every class.";
        "ties" Any ties "Roots half way between two binary32, or next to it.";
        "scaled-direction" Unnormalised scaled_direction "Typical rays with d of lengths from 2⁻¹⁴⁰ to 2¹²⁰.";
        "scaled" Any scaled "Typical rays, all of it scaled by 2^±100.";
        "overflow" Any overflow "Coordinates and roots near the end of the range and past it.";
        "subnormal" Any subnormal "Subnormal coordinates and roots.";
        "log-uniform" Any log_uniform "Each coordinate of any magnitude from 10⁻⁸ to 10⁸.";
        "bits" Any bits "Any finite bits.";
        "sparse-bits" Any sparse_bits "Few bits set or all, exponents near each other.";
    }

    /// The family of that name.
    pub fn by_name(name: &str) -> Option<&'static Self> {
        Self::ALL.iter().find(|family| family.name == name)
    }

    /// The endless sequence of its rays for a seed.
    pub fn rays(&self, seed: u64) -> impl Iterator<Item = (Ray, Sphere)> + use<> {
        // Each family has a sequence of its own under the same seed (FNV-1a of the name).
        let own = self.name.bytes().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
        });
        let mut random = Random::new(seed ^ own);
        let draw = self.draw;
        std::iter::repeat_with(move || draw(&mut random)).filter_map(|case| case.rounded())
    }

    /// The first `n` of its rays for a seed.
    pub fn sample(&self, seed: u64, n: usize) -> Vec<(Ray, Sphere)> {
        self.rays(seed).take(n).collect()
    }
}

/// A ray whose line passes the centre at distance `miss`, from a point at distance `distance`, in
/// any direction of space.
pub(super) fn aimed(
    random: &mut Random,
    center: [f64; 3],
    radius: f64,
    distance: f64,
    miss: f64,
) -> DrawnCase {
    let forward = random.unit_vector();
    let side = perpendicular(forward, random.unit_vector());
    let along = (distance * distance - miss * miss).abs().sqrt();
    DrawnCase {
        origin: [0, 1, 2].map(|i| center[i] + miss * side[i] - along * forward[i]),
        direction: forward,
        center,
        radius,
    }
}

/// The unit vector across `forward` nearest to `v`.
fn perpendicular(forward: [f64; 3], v: [f64; 3]) -> [f64; 3] {
    let along = dot(forward, v);
    let across = [0, 1, 2].map(|i| v[i] - along * forward[i]);
    let length = dot(across, across).sqrt();
    across.map(|x| x / length)
}

pub(super) fn typical(random: &mut Random) -> DrawnCase {
    let center = [0; 3].map(|_| random.uniform(-10.0, 10.0));
    let radius = random.uniform(0.5, 2.0);
    let distance = radius * random.uniform(2.0, 12.0);
    let miss = radius * random.uniform(0.0, 1.5);
    aimed(random, center, radius, distance, miss)
}

fn inside(random: &mut Random) -> DrawnCase {
    let center = [0; 3].map(|_| random.uniform(-10.0, 10.0));
    let radius = random.uniform(0.5, 2.0);
    let distance = radius * random.uniform(0.0, 1.0);
    let miss = distance * random.uniform(0.0, 1.0);
    aimed(random, center, radius, distance, miss)
}

fn end_minus_start(random: &mut Random) -> DrawnCase {
    let mut case = typical(random);
    let length = random.uniform(1.0, 30.0);
    case.direction = [0, 1, 2].map(|i| {
        let start = case.origin[i] as f32;
        let end = (case.origin[i] + length * case.direction[i]) as f32;
        f64::from(end - start)
    });
    case
}

fn near_unit(random: &mut Random) -> DrawnCase {
    let mut case = typical(random);
    for x in &mut case.direction {
        let ulps = random.integer(-4, 4);
        let (mut moved, away) = (*x as f32, ulps > 0);
        for _ in 0..ulps.abs() {
            moved = if away {
                moved.next_up()
            } else {
                moved.next_down()
            };
        }
        *x = moved.into();
    }
    case
}

/// p0 + t·d in binary32, with the near root of `textbook`.
fn own_hit(random: &mut Random) -> DrawnCase {
    loop {
        let mut case = typical(random);
        let Some((ray, sphere)) = case.rounded() else {
            continue;
        };
        let found = Method::Textbook.solve(&ray, &sphere);
        if found.class.meets() {
            case.origin = ray.at(found.near).to_array().map(f64::from);
            case.direction = random.unit_vector();
            return case;
        }
    }
}

fn far_4e3(random: &mut Random) -> DrawnCase {
    far(random, 4e3)
}

fn far_1e6(random: &mut Random) -> DrawnCase {
    far(random, 1e6)
}

fn far(random: &mut Random, distance: f64) -> DrawnCase {
    let radius = random.uniform(0.5, 2.0);
    let miss = radius * random.uniform(0.0, 1.5);
    aimed(random, [0.0; 3], radius, radius * distance, miss)
}

fn grazing(random: &mut Random) -> DrawnCase {
    let radius = random.uniform(0.5, 2.0);
    let distance = radius * random.uniform(2.0, 12.0);
    let miss = radius * (1.0 + random.uniform(-1e-7, 1e-7));
    aimed(random, [0.0; 3], radius, distance, miss)
}

/// Three vectors of whole numbers, across each other, all of the same whole length: the rotation of
/// a whole quaternion.
pub(super) fn whole_frame(random: &mut Random, size: i32) -> ([[f64; 3]; 3], f64) {
    loop {
        let [w, x, y, z] = [0; 4].map(|_| f64::from(random.integer(-size, size)));
        let length = w * w + x * x + y * y + z * z;
        if length > 0.0 {
            let frame = [
                [
                    w * w + x * x - y * y - z * z,
                    2.0 * (x * y + w * z),
                    2.0 * (x * z - w * y),
                ],
                [
                    2.0 * (x * y - w * z),
                    w * w - x * x + y * y - z * z,
                    2.0 * (y * z + w * x),
                ],
                [
                    2.0 * (x * z + w * y),
                    2.0 * (y * z - w * x),
                    w * w - x * x - y * y + z * z,
                ],
            ];
            return (frame, length);
        }
    }
}

/// A tangent in whole numbers: o = m·v + j·u, d = k·u, r = m·|v|, with u across v.
fn tangent(random: &mut Random) -> DrawnCase {
    let size = random.integer(1, 4);
    let ([u, v, _], length) = whole_frame(random, size);
    let [m, j, k] = [9, 20, 5].map(|most| f64::from(random.integer(-most, most)));
    let center = [0; 3].map(|_| f64::from(random.integer(-20, 20)));
    DrawnCase {
        origin: [0, 1, 2].map(|i| center[i] + m * v[i] + j * u[i]),
        direction: u.map(|x| k * x),
        center,
        radius: m.abs() * length,
    }
}

fn tangent_ulp(random: &mut Random) -> DrawnCase {
    let mut case = tangent(random);
    let moved = |x: f64, up: bool| {
        let x = x as f32;
        f64::from(if up { x.next_up() } else { x.next_down() })
    };
    let up = random.one_in(2);
    let axis = random.below(3) as usize;
    match random.below(4) {
        0 => case.origin[axis] = moved(case.origin[axis], up),
        1 => case.direction[axis] = moved(case.direction[axis], up),
        2 => case.center[axis] = moved(case.center[axis], up),
        _ => case.radius = moved(case.radius, up),
    }
    case
}

fn tangent_wide(random: &mut Random) -> DrawnCase {
    let [across, along, direction] = [
        random.log_uniform(-100, 100),
        random.log_uniform(-120, 120),
        random.log_uniform(-120, 120),
    ];
    let axes = [random.integer(0, 2) as usize, random.integer(1, 2) as usize];
    let (x, y) = (axes[0], (axes[0] + axes[1]) % 3);
    let mut case = DrawnCase {
        origin: [0.0; 3],
        direction: [0.0; 3],
        center: [0.0; 3],
        radius: across.abs(),
    };
    case.origin[x] = along;
    case.origin[y] = across;
    case.direction[x] = direction;
    if random.one_in(2) {
        case.direction[y] = f64::from(random.integer(-1, 1)) * power_of_two(-149);
    }
    case
}

fn surface(random: &mut Random) -> DrawnCase {
    let center = [0; 3].map(|_| random.uniform(-10.0, 10.0));
    let radius = random.uniform(0.5, 2.0);
    let normal = random.unit_vector();
    DrawnCase {
        origin: [0, 1, 2].map(|i| center[i] + radius * normal[i]),
        direction: random.unit_vector(),
        center,
        radius,
    }
}

fn surface_exact(random: &mut Random) -> DrawnCase {
    let ([_, v, _], length) = whole_frame(random, 3);
    let m = f64::from(random.integer(1, 9));
    let center = [0; 3].map(|_| f64::from(random.integer(-20, 20)));
    DrawnCase {
        origin: [0, 1, 2].map(|i| center[i] + m * v[i]),
        direction: [0; 3].map(|_| f64::from(random.integer(-9, 9))),
        center,
        radius: m * length,
    }
}

fn ground(random: &mut Random) -> DrawnCase {
    let height = 2.0 * power_of_two(random.integer(-20, 0)) * random.uniform(0.5, 1.0);
    let direction = random.unit_vector();
    DrawnCase {
        origin: [random.uniform(-10.0, 10.0), height, 0.0],
        direction: [direction[0], -direction[1].abs(), direction[2]],
        center: [0.0, -1e6, 0.0],
        radius: 1e6,
    }
}

fn huge_radius(random: &mut Random) -> DrawnCase {
    let radius = random.log_uniform(20, 100).abs();
    let normal = random.unit_vector();
    DrawnCase {
        origin: [0; 3].map(|_| random.uniform(-10.0, 10.0)),
        direction: random.unit_vector(),
        center: normal.map(|x| radius * x),
        radius,
    }
}

fn tiny_radius(random: &mut Random) -> DrawnCase {
    let radius = random.log_uniform(-100, -10).abs();
    let distance = random.uniform(1.0, 10.0);
    let miss = radius * random.uniform(0.0, 1.5);
    let mut case = aimed(random, [0.0; 3], radius, distance, miss);
    // Beyond a hair's breadth only a line along an axis still finds the sphere.
    if random.one_in(2) {
        case.origin = [distance, miss, 0.0];
        case.direction = [-1.0, 0.0, 0.0];
    }
    case
}

fn point(random: &mut Random) -> DrawnCase {
    let ([u, v, _], _) = whole_frame(random, 2);
    let j = f64::from(random.integer(-20, 20));
    let off = match random.below(3) {
        0 => 0.0,
        1 => power_of_two(random.integer(-149, 0)),
        _ => f64::from(random.integer(-1, 1)),
    };
    DrawnCase {
        origin: [0, 1, 2].map(|i| j * u[i] + off * v[i]),
        direction: u,
        center: [0.0; 3],
        radius: 0.0,
    }
}

fn offset(random: &mut Random) -> DrawnCase {
    let away = [0; 3].map(|_| random.uniform(1e6, 1e7));
    let mut case = typical(random);
    case.origin = [0, 1, 2].map(|i| case.origin[i] + away[i]);
    case.center = [0, 1, 2].map(|i| case.center[i] + away[i]);
    case
}

fn integers(random: &mut Random) -> DrawnCase {
    let size = [3, 10, 100][random.below(3) as usize];
    DrawnCase {
        origin: [0; 3].map(|_| f64::from(random.integer(-size, size))),
        direction: [0; 3].map(|_| f64::from(random.integer(-3, 3))),
        center: [0; 3].map(|_| f64::from(random.integer(-size, size))),
        radius: f64::from(random.integer(0, size)),
    }
}

fn ties(random: &mut Random) -> DrawnCase {
    let axis = random.below(3) as usize;
    let scale = power_of_two(random.integer(-60, 60));
    let speed = power_of_two(random.integer(-30, 30));
    // Whole numbers of 25 bits; odd ones are half way between two binary32.
    let along = f64::from(random.integer(1 << 24, 1 << 25));
    let radius = f64::from(random.integer(0, 3));
    let mut case = DrawnCase {
        origin: [0.0; 3],
        direction: [0.0; 3],
        center: [0.0; 3],
        radius: radius * scale,
    };
    let start = f64::from(random.integer(0, 3));
    case.origin[axis] = (start - along) * scale;
    case.center[axis] = start * scale;
    case.direction[axis] = if random.one_in(2) { speed } else { -speed };
    if random.one_in(4) {
        case.origin[(axis + 1) % 3] = case.radius;
    }
    case
}

fn scaled_direction(random: &mut Random) -> DrawnCase {
    let mut case = typical(random);
    let factor = power_of_two(random.integer(-140, 120)) * random.uniform(1.0, 2.0);
    case.direction = case.direction.map(|x| factor * x);
    case
}

fn scaled(random: &mut Random) -> DrawnCase {
    let mut case = typical(random);
    let factor = power_of_two(random.integer(-100, 100));
    case.origin = case.origin.map(|x| factor * x);
    case.center = case.center.map(|x| factor * x);
    case.radius *= factor;
    case
}

fn overflow(random: &mut Random) -> DrawnCase {
    let near_the_end = |random: &mut Random| random.log_uniform(120, 127);
    let origin = [0; 3].map(|_| near_the_end(random));
    let center = [0; 3].map(|_| near_the_end(random));
    let pull = random.uniform(0.9, 1.1) * power_of_two(-random.integer(100, 140));
    let direction = if random.one_in(4) {
        [0; 3].map(|_| near_the_end(random))
    } else {
        [0, 1, 2].map(|i| (center[i] - origin[i]) * pull)
    };
    DrawnCase {
        origin,
        direction,
        center,
        radius: near_the_end(random).abs(),
    }
}

fn subnormal(random: &mut Random) -> DrawnCase {
    let least = power_of_two(-149);
    let sizes = [5, 100, 1 << 23];
    let size = sizes[random.below(3) as usize];
    let mut small = |size: i32| f64::from(random.integer(-size, size)) * least;
    let origin = [0; 3].map(|_| small(size));
    let center = [0; 3].map(|_| small(size));
    let radius = small(size).abs();
    let direction = [0; 3].map(|_| small(size));
    let factor = if random.one_in(2) {
        1.0
    } else {
        power_of_two(random.integer(0, 250))
    };
    DrawnCase {
        origin,
        direction: direction.map(|x| x * factor),
        center,
        radius,
    }
}

fn log_uniform(random: &mut Random) -> DrawnCase {
    let mut any = || random.log_uniform(-27, 26);
    DrawnCase {
        origin: [0; 3].map(|_| any()),
        direction: [0; 3].map(|_| any()),
        center: [0; 3].map(|_| any()),
        radius: any().abs(),
    }
}

fn bits(random: &mut Random) -> DrawnCase {
    let mut any = || f64::from(random.any_single());
    DrawnCase {
        origin: [0; 3].map(|_| any()),
        direction: [0; 3].map(|_| any()),
        center: [0; 3].map(|_| any()),
        radius: any().abs(),
    }
}

fn sparse_bits(random: &mut Random) -> DrawnCase {
    let middle = random.integer(-100, 100);
    let mut sparse = |middle: i32| {
        let fraction = match random.below(4) {
            0 => 0,
            1 => random.bits() & random.bits() & random.bits(),
            2 => random.bits() | random.bits() | random.bits(),
            _ => 1 << random.below(23),
        } as u32
            & 0x7f_ffff;
        let exponent = (middle + random.integer(-4, 4) + 127) as u32;
        let sign = (random.bits() as u32) << 31;
        f64::from(f32::from_bits(sign | exponent << 23 | fraction))
    };
    DrawnCase {
        origin: [0; 3].map(|_| sparse(middle)),
        direction: [0; 3].map(|_| sparse(0)),
        center: [0; 3].map(|_| sparse(middle)),
        radius: sparse(middle).abs(),
    }
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use super::*;

    #[test]
    fn names_are_unique_and_find_their_family() {
        let names: HashSet<_> = Family::ALL.iter().map(|family| family.name).collect();
        assert_eq!(names.len(), Family::ALL.len());
        for name in names {
            assert_eq!(Family::by_name(name).map(|family| family.name), Some(name));
        }
        assert!(Family::by_name("none").is_none());
    }

    #[test]
    fn a_seed_means_the_same_rays_each_time_and_another_seed_others() {
        for family in Family::ALL {
            assert_eq!(
                family.sample(1, 20),
                family.sample(1, 20),
                "{}",
                family.name
            );
            assert_ne!(
                family.sample(1, 20),
                family.sample(2, 20),
                "{}",
                family.name
            );
        }
    }

    #[test]
    fn a_seed_means_the_same_rays_on_every_machine() {
        let mut hash = 0xcbf2_9ce4_8422_2325_u64;
        for family in Family::ALL {
            for (ray, sphere) in family.rays(3).take(100) {
                let vectors = [ray.origin, ray.direction, sphere.center];
                let numbers = vectors
                    .iter()
                    .flat_map(Vec3::to_array)
                    .chain([sphere.radius]);
                for x in numbers {
                    hash = (hash ^ u64::from(x.to_bits())).wrapping_mul(0x0100_0000_01b3);
                }
            }
        }
        assert_eq!(hash, 2_403_983_146_824_747_004);
    }
}
