//! The steps before the quadratic: from the pixel to its ray, and the ray put into the sphere's equation.

use glam::DVec3;

use super::machine::{MachineStep, bracketed, n32, n64, v3};
use crate::explain::{Reading, Subject};
use crate::scene::{Rays, Scene};

pub(super) fn steps(
    reading: &Reading,
    subject: &Subject,
    scene: &Scene,
    rays: &Rays,
) -> Vec<MachineStep> {
    vec![
        pixel_step(reading, scene, rays),
        ray_step(reading),
        sphere_step(subject),
        substitution_step(),
    ]
}

fn pixel_step(reading: &Reading, scene: &Scene, rays: &Rays) -> MachineStep {
    let (x, y) = reading.pixel;
    let from_center = |at: u32, count: u32| f64::from(at) - (f64::from(count) - 1.0) / 2.0;
    let [u, v] = [
        from_center(x, rays.size.width),
        from_center(y, rays.size.height),
    ];
    let vector = |v: DVec3| format!("({})", v.to_array().map(n64).join(", "));
    let eye = v3(scene.camera.position);
    let [ahead, right, down] = [rays.direction, rays.right, rays.down].map(vector);
    // A line for each vector: a number that gets longer moves no other.
    let shift = format!(
        "{}·{right} +\n{}·{down}",
        bracketed(&n64(u)),
        bracketed(&n64(v))
    );
    let (why, formula, numbers, code) = if rays.perspective {
        (
            "Every pixel looks from the same eye, each in its own direction: u pixels to the right of \
             the middle and v down.",
            "p0 = eye,  d = forward + u·right + v·down",
            format!("{ahead} +\n{shift}"),
            "vector d = vectorAdd(forward, shift);",
        )
    } else {
        (
            "Every pixel looks the same way, each from its own place on the screen: u pixels to the \
             right of the middle and v down.",
            "p0 = eye + u·right + v·down,  d = forward",
            format!("{eye} +\n{shift}"),
            "vector p0 = vectorAdd(eye, shift);",
        )
    };
    MachineStep {
        numbers: format!("pixel ({x}, {y}) of {}:\n{numbers}", rays.size),
        result: format!(
            "p0: {}\nd: {}",
            v3(reading.ray.origin),
            v3(reading.ray.direction)
        ),
        code: code.into(),
        ..MachineStep::plain("pixel", why, formula)
    }
}

fn ray_step(reading: &Reading) -> MachineStep {
    let [p, d] = [reading.ray.origin, reading.ray.direction].map(|v| v.to_array());
    let along = |i: usize| format!("{} + {}t", n32(p[i]), bracketed(&n32(d[i])));
    let [origin, direction] = [reading.ray.origin, reading.ray.direction].map(v3);
    MachineStep {
        numbers: format!("{origin} + t·{direction}"),
        result: format!("({}, {}, {})", along(0), along(1), along(2)),
        code: "vector p = vectorAdd(&r->start, vectorScale(t, &r->dir));".into(),
        ..MachineStep::plain(
            "ray",
            "One number t names every point of the line; t > 0 is in front of the eye.",
            "p(t) = p0 + t·d",
        )
    }
}

fn sphere_step(subject: &Subject) -> MachineStep {
    let center = subject.sphere.center.to_array();
    let [x, y, z] = [0, 1, 2].map(|i| {
        let name = ["x", "y", "z"][i];
        if center[i] == 0.0 {
            format!("{name}²")
        } else {
            format!("({name} − {})²", bracketed(&n32(center[i])))
        }
    });
    let r = n32(subject.sphere.radius);
    MachineStep {
        numbers: format!(
            "|p − {}| = {r} for a point p = (x, y, z) of it",
            v3(subject.sphere.center)
        ),
        result: format!("{x} + {y} + {z} = {r}²"),
        ..MachineStep::plain(
            "sphere",
            "A point is on the sphere if its distance from the centre is the radius.",
            "(p − c)·(p − c) = r²",
        )
    }
}

fn substitution_step() -> MachineStep {
    MachineStep {
        numbers: "(d·d) t² + 2 d·(p0−c) t + |p0−c|² − r² = 0".into(),
        result: "At² + Bt + C = 0".into(),
        ..MachineStep::plain(
            "insert",
            "Put the point of the ray into the sphere's equation: what is left is a quadratic in t.",
            "(p0 + t·d − c)·(p0 + t·d − c) = r²",
        )
    }
}
