//! The time of whole frames, with the plan and without it, for growing numbers of spheres.

use std::hint::black_box;
use std::time::Instant;

use glam::{DVec3, Vec3};

use super::Random;
use crate::geometry::Sphere;
use crate::method::Method;
use crate::render::{ColorDepth, Frame, Image, Look, Style, View};
use crate::scene::{Body, Camera, PixelShape, Projection, Rays, Scene, Size};

/// Half the side of the cube that holds the spheres.
const HALF_SIDE: f64 = 10.0;

/// `count` spheres at random places of a cube, all before the eye: their radii shrink as their
/// number grows, so that they fill about the same share of the cube.
pub fn scene(count: usize, seed: u64) -> Scene {
    let mut random = Random::new(seed);
    let spacing = 2.0 * HALF_SIDE / (count as f64).cbrt();
    let bodies = (0..count)
        .map(|_| {
            let radius = spacing * random.uniform(0.2, 0.45);
            let reach = HALF_SIDE - radius;
            let center = DVec3::from([0; 3].map(|_| random.uniform(-reach, reach)));
            Body {
                sphere: Sphere {
                    center: center.as_vec3(),
                    radius: radius as f32,
                },
                name: None,
                color: None,
            }
        })
        .collect();
    Scene {
        name: format!("{count} spheres"),
        about: None,
        camera: Camera {
            projection: Projection::Perspective {
                field_of_view: 45.0,
            },
            position: Vec3::new(0.0, 0.0, 30.0),
            look_at: Vec3::ZERO,
            up: Vec3::Y,
        },
        pixels: None,
        bodies,
        light: None,
        probes: Vec::new(),
    }
}

fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times[0]
}

/// Median milliseconds of `run`, which is told which of two scenes to take.
fn time(rounds: usize, mut run: impl FnMut(usize)) -> f64 {
    run(0);
    run(1);
    median(
        (0..rounds)
            .map(|round| {
                let start = Instant::now();
                run(round % 2);
                start.elapsed().as_secs_f64() * 1e3
            })
            .collect(),
    )
}

/// Prints a table for development.
pub fn sketch() {
    let size = Size::new(200, 120);
    for power in 0..=6 {
        let count = 10_usize.pow(power);
        let scenes = [1, 2].map(|seed| scene(count, seed));
        let rays = Rays::new(&scenes[0].camera, size, PixelShape::Aspect(1.0));
        let rounds = if count > 100_000 { 15 } else { 61 };
        let mut frame = Frame::new();
        let mut by_view = |view| {
            time(rounds, |i| {
                frame.render(&scenes[i], &rays, Method::Exact, view);
                black_box(frame.seen(100, 60));
            })
        };
        let shade = by_view(View::Shade);
        let outline = by_view(View::Outline);
        let depth = by_view(View::Depth);
        let textbook = time(if count > 1000 { 3 } else { rounds }, |i| {
            frame.render(&scenes[i], &rays, Method::Textbook, View::Shade);
        });
        frame.render(&scenes[0], &rays, Method::Exact, View::Shade);
        let mut image = Image::new();
        let look = Look {
            style: Style::Half,
            depth: ColorDepth::Ansi256,
            ascii_only: false,
        };
        let cells = time(rounds, |_| image.draw(&frame, &scenes[0], look));
        let seen = (0..size.height)
            .flat_map(|y| (0..size.width).map(move |x| (x, y)))
            .filter(|&(x, y)| frame.seen(x, y).is_some())
            .count();
        println!(
            "{count:8} shade {shade:8.3} outline {outline:8.3} depth {depth:8.3} textbook {textbook:8.3} cells {cells:8.3} seen {seen}"
        );
    }
}
