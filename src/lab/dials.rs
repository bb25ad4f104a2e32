//! Dials: families of rays with one quantity that is turned from tame to broken.
//!
//! The rays of a dial are exact binary32 numbers at every setting, so that what is measured is the
//! method and not the rounding of its inputs; `offset` is there to show that rounding.

use super::Problem;
use super::families::{DrawnCase, aimed, typical, whole_frame};
use crate::number::power_of_two;
use crate::random::Random;

/// The roots of a ray that was not yet rounded, near and far; none for a miss.
pub type Intent = Option<[f64; 2]>;

/// A family of rays with one quantity to turn.
#[derive(Debug, Clone, Copy)]
pub struct Dial {
    /// The name on the command line and in reports.
    pub name: &'static str,
    /// What is turned, as a formula; it takes the values 2^k.
    pub quantity: &'static str,
    /// One sentence on what the rays are.
    pub about: &'static str,
    /// The first k, the last, and the step between them.
    settings: [i32; 3],
    draw: fn(&mut Random, i32) -> DrawnCase,
    pixel: fn(i32) -> f64,
}

/// No two dials have the same name.
impl PartialEq for Dial {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl Eq for Dial {}

impl Dial {
    /// All dials, in the order of reports.
    pub const ALL: &'static [Self] = &[
        Self {
            name: "distance",
            quantity: "‖o‖/r",
            about: "The sphere moves away; the line passes anywhere from its centre to half a radius beside it.",
            settings: [1, 60, 1],
            draw: distance,
            pixel: whole_sphere,
        },
        Self {
            name: "altitude",
            quantity: "height/r",
            about: "The eye comes down to the surface and looks down.",
            settings: [0, -60, -1],
            draw: altitude,
            pixel: ground,
        },
        Self {
            name: "tangency",
            quantity: "cos θ",
            about: "The line comes near a tangent, from four radii away; every other ray misses by as much as the others hit.",
            settings: [-1, -40, -1],
            draw: tangency,
            pixel: whole_sphere,
        },
        Self {
            name: "offset",
            quantity: "‖p0‖/‖o‖",
            about: "Ray and sphere together move away from the world's origin.",
            settings: [0, 22, 1],
            draw: offset,
            pixel: whole_sphere,
        },
        Self {
            name: "large",
            quantity: "scale",
            about: "p0, c and r of typical rays, all times 2^k.",
            settings: [0, 120, 2],
            draw: scale,
            pixel: whole_sphere,
        },
        Self {
            name: "small",
            quantity: "scale",
            about: "p0, c and r of typical rays, all times 2^k.",
            settings: [0, -140, -2],
            draw: scale,
            pixel: whole_sphere,
        },
        Self {
            name: "long",
            quantity: "‖d‖",
            about: "Typical rays with a long direction.",
            settings: [0, 120, 2],
            draw: length,
            pixel: whole_sphere,
        },
        Self {
            name: "short",
            quantity: "‖d‖",
            about: "Typical rays with a short direction.",
            settings: [0, -140, -2],
            draw: length,
            pixel: whole_sphere,
        },
    ];

    /// The dial of that name.
    pub fn by_name(name: &str) -> Option<&'static Self> {
        Self::ALL.iter().find(|dial| dial.name == name)
    }

    /// The exponents k of the values 2^k, from tame to broken.
    pub fn settings(&self) -> impl Iterator<Item = i32> + use<> {
        let [first, last, step] = self.settings;
        (0..=(last - first) / step).map(move |i| first + i * step)
    }

    /// Whether the value 2^k lies within the settings.
    pub fn reaches(&self, k: f64) -> bool {
        let [first, last, _] = self.settings.map(f64::from);
        (first.min(last)..=first.max(last)).contains(&k)
    }

    /// The step between two settings, as |k' − k|.
    pub const fn step(&self) -> i32 {
        self.settings[2].abs()
    }

    /// The first `n` of its rays at the setting 2^k; at every setting they are made of the same
    /// random numbers.
    pub fn sample(&self, seed: u64, k: i32, n: usize) -> Vec<Problem> {
        self.drawn(seed, k)
            .take(n)
            .map(|(_, problem)| problem)
            .collect()
    }

    /// The same rays, each with the roots that it had before it was rounded to binary32; none for
    /// a miss.
    pub fn sample_with_intent(&self, seed: u64, k: i32, n: usize) -> Vec<(Problem, Intent)> {
        let drawn = self.drawn(seed, k).take(n);
        drawn
            .map(|(case, problem)| (problem, case.roots()))
            .collect()
    }

    fn drawn(&self, seed: u64, k: i32) -> impl Iterator<Item = (DrawnCase, Problem)> + use<> {
        // The same numbers at every setting: what changes is what the dial changes.
        let mut random = Random::new(seed);
        let draw = self.draw;
        std::iter::repeat_with(move || draw(&mut random, k))
            .filter_map(|case| case.rounded().map(|problem| (case, problem)))
    }

    /// Whether the inputs lose bits when they are rounded to binary32, before any method is asked.
    pub fn rounds_inputs(&self) -> bool {
        self.name == "offset"
    }

    /// The width of a pixel at the hit, in radii: a tenth of what there is to see, the radius or,
    /// from near by, the height above the surface.
    pub fn pixel(&self, k: i32) -> f64 {
        (self.pixel)(k)
    }
}

/// The sphere fills 20 pixels, as on the tutorial's screen.
fn whole_sphere(_: i32) -> f64 {
    0.1
}

fn ground(k: i32) -> f64 {
    0.1 * power_of_two(k.min(0))
}

/// The power of two next below a positive number.
fn leading_power(x: f64) -> f64 {
    f64::from_bits(x.to_bits() & 0x7ff0_0000_0000_0000)
}

/// A whole number of 13 bits.
fn thirteen_bits(random: &mut Random) -> f64 {
    f64::from(random.integer(1 << 12, (1 << 13) - 1))
}

/// o = −j·u + m·v and d = i·u with u across v in whole numbers of 11 bits and i, j, m of 13: exact
/// in binary32 at any distance, and the line passes the centre at exactly m·|v|.
fn distance(random: &mut Random, k: i32) -> DrawnCase {
    let ([u, v, _], length) = whole_frame(random, 20);
    let miss = thirteen_bits(random) * length;
    let radius = f64::from((miss / random.uniform(0.01, 1.5)) as f32);
    let distance = power_of_two(k) * radius;
    let away = (distance * distance - miss * miss).sqrt() / length;
    // The next number of 13 bits below it.
    let unit = leading_power(away) * power_of_two(-12);
    let along = (away / unit).trunc() * unit;
    DrawnCase {
        origin: u.map(|x| -along * x),
        direction: nearly_unit(u, length, random),
        center: v.map(|x| -miss / length * x),
        radius,
    }
}

/// A direction along the whole vector `u` that is about 1 long, exact in binary32.
fn nearly_unit(u: [f64; 3], length: f64, random: &mut Random) -> [f64; 3] {
    let factor = thirteen_bits(random);
    let scale = factor / (2.0 * leading_power(factor * length));
    u.map(|x| scale * x)
}

/// The surface passes through the world's origin, so that a height far below the spacing of the
/// centre's coordinates can be written down.
fn altitude(random: &mut Random, k: i32) -> DrawnCase {
    let radius = f64::from(random.uniform(1.0, 2.0) as f32);
    let height = power_of_two(k) * radius;
    let (up, east, north) = axes(random);
    let [x, z] = [0; 2].map(|_| height * random.uniform(-0.5, 0.5));
    let down = loop {
        let v = random.unit_vector();
        if v[0] < -0.2 {
            break v;
        }
    };
    let place = |[y, x, z]: [f64; 3]| {
        let mut p = [0.0; 3];
        (p[up], p[east], p[north]) = (y, x, z);
        p
    };
    DrawnCase {
        origin: place([height, x, z]),
        direction: place(down),
        center: place([-radius, 0.0, 0.0]),
        radius,
    }
}

/// The three axes, beginning with any.
fn axes(random: &mut Random) -> (usize, usize, usize) {
    let first = random.below(3) as usize;
    (first, (first + 1) % 3, (first + 2) % 3)
}

/// o = 4m·u + (m ∓ ε)·v and r = m·|v|: the line passes the centre at r·(1 ∓ cos²θ/2), exactly.
fn tangency(random: &mut Random, k: i32) -> DrawnCase {
    let ([u, v, _], length) = whole_frame(random, 20);
    let m = f64::from(random.integer(256, 511));
    let inward = if random.one_in(2) { 1.0 } else { -1.0 };
    let epsilon = inward * m * power_of_two(2 * k - 1);
    DrawnCase {
        origin: v.map(|x| -epsilon * x),
        direction: nearly_unit(u, length, random),
        center: [0, 1, 2].map(|i| -m * (4.0 * u[i] + v[i])),
        radius: m * length,
    }
}

fn offset(random: &mut Random, k: i32) -> DrawnCase {
    let radius = random.uniform(0.5, 2.0);
    let distance = radius * random.uniform(2.0, 12.0);
    // Not so near a tangent that a method may fail without any offset.
    let miss = loop {
        let part = random.uniform(0.0, 1.5);
        if !(0.99..1.01).contains(&part) {
            break radius * part;
        }
    };
    let mut case = aimed(random, [0.0; 3], radius, distance, miss);
    let away = random.unit_vector();
    let far = power_of_two(k) * distance;
    let moved = |p: [f64; 3]| [0, 1, 2].map(|i| p[i] + far * away[i]);
    (case.origin, case.center) = (moved(case.origin), moved(case.center));
    case
}

/// Typical rays in binary32, then scaled: what the scale changes is the scale alone.
fn rounded_typical(random: &mut Random) -> DrawnCase {
    let case = typical(random);
    let single = |v: [f64; 3]| v.map(|x| f64::from(x as f32));
    DrawnCase {
        origin: single(case.origin),
        direction: single(case.direction),
        center: single(case.center),
        radius: f64::from(case.radius as f32),
    }
}

fn scale(random: &mut Random, k: i32) -> DrawnCase {
    let mut case = rounded_typical(random);
    let factor = power_of_two(k);
    case.origin = case.origin.map(|x| factor * x);
    case.center = case.center.map(|x| factor * x);
    case.radius *= factor;
    case
}

fn length(random: &mut Random, k: i32) -> DrawnCase {
    let mut case = rounded_typical(random);
    case.direction = case.direction.map(|x| power_of_two(k) * x);
    case
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;
    use crate::lab::Reference;
    use crate::method::{Class, Truth};

    /// The quantity of a dial for one of its rays, from the ray itself.
    fn measured(dial: &Dial, (ray, sphere): &Problem) -> f64 {
        let [o, d, p0] =
            [ray.origin - sphere.center, ray.direction, ray.origin].map(Vec3::as_dvec3);
        let r = f64::from(sphere.radius);
        let exact_o = ray.origin.as_dvec3() - sphere.center.as_dvec3();
        match dial.name {
            "distance" => exact_o.length() / r,
            "altitude" => {
                let c = Truth::new(ray, sphere).c;
                // |o| − r = C / (|o| + r)
                crate::method::Surd::from(c).to_f64() / (exact_o.length() + r) / r
            }
            "tangency" => {
                let truth = Reference::new(&(*ray, *sphere));
                (truth.quarter_discriminant.abs() / d.length_squared()).sqrt() / r
            }
            "offset" => p0.length() / o.length(),
            "large" | "small" => r,
            _ => d.length(),
        }
    }

    #[test]
    fn each_dial_shows_the_value_it_is_set_to() {
        for dial in Dial::ALL {
            for k in dial.settings().step_by(3) {
                let slack = match dial.name {
                    "large" | "small" => 2.01,
                    // The eye is not straight above the point that it looks down on.
                    "altitude" | "offset" => 1.5,
                    _ => 1.05,
                };
                for problem in dial.sample(1, k, 5) {
                    let found = measured(dial, &problem) / power_of_two(k);
                    // Of an offset, o keeps what binary32 leaves it; subnormal numbers likewise.
                    let whole = k > -120 && (dial.name != "offset" || k > 1 && k < 18);
                    assert!(
                        !whole || (1.0 / slack..slack).contains(&found),
                        "{} at 2^{k}: {found}",
                        dial.name
                    );
                }
            }
        }
    }

    #[test]
    fn rays_of_the_tangency_dial_hit_and_miss_by_as_much() {
        let dial = Dial::by_name("tangency").unwrap();
        for k in dial.settings() {
            let truths = Reference::all(&dial.sample(3, k, 40));
            let hits = truths.iter().filter(|t| t.class == Class::Secant).count();
            let misses = truths.iter().filter(|t| t.class == Class::Miss).count();
            assert!(hits > 8 && hits + misses == 40, "{hits} of 40 hit at 2^{k}");
        }
    }
}
