//! The spheres of the scene `crowd`: a flower. One sphere follows another at the golden angle, as
//! florets do in the head of a sunflower, and five petals wind about the middle.
//!
//! Only + − × ÷ √ and bits, so that every machine makes the same spheres.

use glam::{DVec2, DVec3};

use crate::geometry::Sphere;
use crate::random::Random;
use crate::scene::{Body, Rgb};

const SPHERES: u32 = 10_000;
/// Radius of the flower.
const REACH: f64 = 10.0;
/// Cosine and sine of the golden angle, π(3 − √5), by which one sphere follows another.
const GOLDEN_TURN: DVec2 = DVec2::new(-0.737_368_878_078_319_7, 0.675_490_294_261_523_8);
/// Cosine and sine of a ten-thousandth of 0.3 turns, by which the petals wind.
const WINDING_TURN: DVec2 = DVec2::new(0.999_999_982_234_712_1, 0.000_188_495_558_090_6);

const YELLOW: Rgb = Rgb(0xf0, 0xe4, 0x42);
const ORANGE: Rgb = Rgb(0xe6, 0x9f, 0x00);
const VERMILION: Rgb = Rgb(0xd5, 0x5e, 0x00);
const SKY: Rgb = Rgb(0x56, 0xb4, 0xe9);
const BLUE: Rgb = Rgb(0x00, 0x72, 0xb2);

/// All of them, from the middle outwards.
pub(super) fn bodies() -> Vec<Body> {
    let mut random = Random::new(2011);
    let mut along = DVec2::X;
    let mut axis = DVec2::X;
    (0..SPHERES)
        .map(|n| {
            along = turned(along, GOLDEN_TURN);
            axis = turned(axis, WINDING_TURN);
            let share = (f64::from(n) + 0.5) / f64::from(SPHERES);
            body(share, along, axis, &mut random)
        })
        .collect()
}

/// The sphere in the direction `along` that has this share of all spheres nearer to the middle;
/// a petal lies in the direction `axis`.
fn body(share: f64, along: DVec2, axis: DVec2, random: &mut Random) -> Body {
    let out = share.sqrt();
    let petal = cosine_of_five_times(along, axis);
    let disc = REACH * out * (1.0 + 0.12 * petal * out) * along;
    let dome = 2.4 * (1.0 - share) + 0.7 * petal * out;
    let radius = 0.13 + 0.06 * random.uniform(0.0, 1.0);
    Body {
        sphere: Sphere {
            center: DVec3::new(disc.x, dome, disc.y).as_vec3(),
            radius: radius as f32,
        },
        name: None,
        color: Some(color(out, petal + 0.3 * (random.uniform(0.0, 1.0) - 0.5))),
    }
}

/// Petals of yellow and orange on blue, about a middle of vermilion.
fn color(out: f64, petal: f64) -> Rgb {
    match (out, petal) {
        (..0.18, _) => VERMILION,
        (..0.3, _) | (_, 0.4..) => YELLOW,
        (_, -0.1..) => ORANGE,
        (_, -0.5..) => SKY,
        _ => BLUE,
    }
}

/// cos 5φ for the angle φ between two unit vectors: the real part of a fifth power.
fn cosine_of_five_times(u: DVec2, v: DVec2) -> f64 {
    let once = turned(u, DVec2::new(v.x, -v.y));
    let twice = turned(once, once);
    let four_times = turned(twice, twice);
    turned(four_times, once).x
}

/// `v` turned by the angle whose cosine and sine are `turn`: a product of complex numbers.
fn turned(v: DVec2, turn: DVec2) -> DVec2 {
    DVec2::new(v.x * turn.x - v.y * turn.y, v.x * turn.y + v.y * turn.x)
}
