//! How the camera moves: small steps that keep it a camera.

use glam::{DQuat, DVec3, Vec3};

use crate::scene::{Camera, Projection, Scene};

/// An orbit step at step size 1, in radians: 7.5°.
const ORBIT_STEP: f64 = std::f64::consts::PI / 24.0;
/// The camera never comes nearer than this to looking along `up`, in radians.
const POLE_MARGIN: f64 = 0.02;
/// A pan or dolly step as a part of the distance to the point looked at.
const PAN_STEP: f64 = 0.05;
/// What one step of zoom multiplies the window by.
const ZOOM_STEP: f64 = 0.9;
/// The widest and the narrowest field of view that zooming reaches, in degrees.
const FIELD_RANGE: (f64, f64) = (1e-4, 150.0);

/// Turns the camera about the point that it looks at: `right` and `up` in steps.
pub fn orbit(camera: &Camera, right: f64, up: f64) -> Camera {
    let target = camera.look_at.as_dvec3();
    let axis = camera.up.as_dvec3().normalize_or(DVec3::Y);
    let arm = camera.position.as_dvec3() - target;
    let polar = arm.angle_between(axis);
    // Upwards the arm turns towards the pole, and stops short of it.
    let least = (polar - (std::f64::consts::PI - POLE_MARGIN)).min(0.0);
    let most = (polar - POLE_MARGIN).max(0.0);
    let rise = (up * ORBIT_STEP).clamp(least, most);
    let arm = DQuat::from_axis_angle(camera.basis().right, -rise) * arm;
    let arm = DQuat::from_axis_angle(axis, right * ORBIT_STEP) * arm;
    keep_if_valid(
        camera,
        Camera {
            position: (target + arm).as_vec3(),
            ..*camera
        },
    )
}

/// Moves the camera and the point looked at, across the screen: `right` and `up` in steps; where the
/// pixels are on a grid, they stay on it.
pub fn pan(camera: &Camera, right: f64, up: f64) -> Camera {
    let basis = camera.basis();
    let length = PAN_STEP * window(camera);
    let shift = [right, up].map(|steps| match camera.step().map(f64::from) {
        Some(grid) if steps != 0.0 => {
            (2.0 * steps.abs() * length / grid).round().max(1.0) * grid * steps.signum()
        }
        _ => steps * length,
    });
    shifted(camera, basis.right * shift[0] - basis.down * shift[1])
}

/// Moves the camera forward, the point looked at with it only when it would be reached.
pub fn dolly(camera: &Camera, steps: f64) -> Camera {
    let arm = camera.look_at.as_dvec3() - camera.position.as_dvec3();
    let factor = (1.0 - PAN_STEP).powf(steps);
    keep_if_valid(
        camera,
        Camera {
            position: (camera.look_at.as_dvec3() - arm * factor).as_vec3(),
            ..*camera
        },
    )
}

/// Narrows (positive) or widens what is seen, without moving; where the pixels are on a grid, to half
/// or twice as much, and so is the grid.
pub fn zoom(camera: &Camera, steps: f64) -> Camera {
    let factor = match camera.step() {
        Some(_) => (-steps.signum()).exp2(),
        None => ZOOM_STEP.powf(steps),
    };
    let scaled = |length: f32| (f64::from(length) * factor) as f32;
    let projection = match camera.projection {
        Projection::Orthographic { extent, step } => Projection::Orthographic {
            extent: extent.map(scaled),
            step: step.map(scaled),
        },
        Projection::Perspective { field_of_view } => {
            let half = (f64::from(field_of_view).to_radians() / 2.0).tan() * factor;
            let angle = 2.0 * half.atan().to_degrees();
            Projection::Perspective {
                field_of_view: angle.clamp(FIELD_RANGE.0, FIELD_RANGE.1) as f32,
            }
        }
    };
    keep_if_valid(
        camera,
        Camera {
            projection,
            ..*camera
        },
    )
}

/// Turns the camera, from where it is, to a point.
pub fn look_at(camera: &Camera, point: Vec3) -> Camera {
    match camera.projection {
        // A parallel camera that turned would see another picture: it slides over instead.
        Projection::Orthographic { .. } => {
            let basis = camera.basis();
            let way = point.as_dvec3() - camera.look_at.as_dvec3();
            let across = way - basis.forward * way.dot(basis.forward);
            let slid = shifted(camera, across);
            keep_if_valid(
                &slid,
                Camera {
                    look_at: point,
                    ..slid
                },
            )
        }
        Projection::Perspective { .. } => keep_if_valid(
            camera,
            Camera {
                look_at: point,
                ..*camera
            },
        ),
    }
}

/// The height of what is seen at the point looked at, in units of the world.
pub fn window(camera: &Camera) -> f64 {
    match camera.projection {
        Projection::Orthographic { extent, .. } => f64::from(extent[1]),
        Projection::Perspective { field_of_view } => {
            let distance = (camera.look_at.as_dvec3() - camera.position.as_dvec3()).length();
            2.0 * distance * (f64::from(field_of_view).to_radians() / 2.0).tan()
        }
    }
}

fn shifted(camera: &Camera, shift: DVec3) -> Camera {
    let by = |v: Vec3| (v.as_dvec3() + shift).as_vec3();
    keep_if_valid(
        camera,
        Camera {
            position: by(camera.position),
            look_at: by(camera.look_at),
            ..*camera
        },
    )
}

/// The new camera, or the old one where rounding or range would leave it looking nowhere.
fn keep_if_valid(old: &Camera, new: Camera) -> Camera {
    if new.check().is_ok() { new } else { *old }
}

/// A step that suits what the camera sees: a power of two, so that sums of steps stay exact.
pub fn usual_step(scene: &Scene) -> f32 {
    let step = window(&scene.camera) / 32.0;
    let exponent = (step.log2().round()).clamp(-126.0, 120.0) as i32;
    2.0_f32.powi(exponent)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn camera() -> Camera {
        Camera {
            projection: Projection::Perspective {
                field_of_view: 40.0,
            },
            position: Vec3::new(1.0, 2.0, 10.0),
            look_at: Vec3::new(0.0, 0.5, 0.0),
            up: Vec3::Y,
        }
    }

    proptest! {
        #[test]
        fn any_walk_leaves_a_camera(steps in prop::collection::vec((0..5u8, -9i8..=9), 0..200)) {
            let mut c = camera();
            for (kind, n) in steps {
                let n = f64::from(n);
                c = match kind {
                    0 => orbit(&c, n, 0.0),
                    1 => orbit(&c, 0.0, n),
                    2 => pan(&c, n, -n),
                    3 => dolly(&c, n),
                    _ => zoom(&c, n),
                };
                prop_assert!(c.check().is_ok(), "{c:?}");
            }
        }

        #[test]
        fn an_orbit_keeps_its_distance(right in -5.0..5.0f64, up in -5.0..5.0f64) {
            let c = orbit(&camera(), right, up);
            let distance = |c: &Camera| c.position.distance(c.look_at);
            prop_assert!((distance(&c) - distance(&camera())).abs() < 1e-4);
        }
    }

    #[test]
    fn right_moves_the_eye_to_the_right() {
        let before = camera();
        let after = orbit(&before, 1.0, 0.0);
        let moved = (after.position - before.position).as_dvec3();
        assert!(moved.dot(before.basis().right) > 0.0);
        assert!(orbit(&before, 0.0, 1.0).position.y > before.position.y);
        assert!(pan(&before, 0.0, 1.0).position.y > before.position.y);
    }
}
