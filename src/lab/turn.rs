//! A dial turned on a whole scene: the picture stays what it is, the numbers become harder.

use glam::{DVec3, Vec3};

use super::Dial;
use super::random::power_of_two;
use crate::geometry::Sphere;
use crate::scene::{Projection, Scene};

impl Dial {
    /// The scene with this dial turned by 2^k, k from 0 on into the direction in which the dial
    /// breaks; none for a dial that scenes do not have (a camera's directions are about 1 long, and
    /// no scene is a single tangent), and where a number would leave the range of binary32.
    ///
    /// * `distance`: the camera backs away from what it looks at, and its field of view narrows.
    /// * `offset`: everything moves away from the origin, by 2^k times the camera's distance.
    /// * `large`, `small`: everything is scaled.
    pub fn turn(&self, scene: &Scene, k: u32) -> Option<Scene> {
        let k = i32::try_from(k).ok().filter(|&k| k <= 200)?;
        let turned = match self.name {
            "distance" => back_away(scene, power_of_two(k)),
            "offset" => offset(scene, power_of_two(k)),
            "large" => moved(scene, |p| power_of_two(k) * p, power_of_two(k)),
            "small" => moved(scene, |p| power_of_two(-k) * p, power_of_two(-k)),
            _ => return None,
        };
        is_sound(&turned).then_some(turned)
    }
}

fn back_away(scene: &Scene, factor: f64) -> Scene {
    let mut turned = scene.clone();
    let camera = &mut turned.camera;
    let target = camera.look_at.as_dvec3();
    let away = camera.position.as_dvec3() - target;
    camera.position = (target + factor * away).as_vec3();
    if let Projection::Perspective { field_of_view } = &mut camera.projection {
        let half = (f64::from(*field_of_view) / 2.0).to_radians().tan() / factor;
        *field_of_view = (2.0 * half.atan().to_degrees()) as f32;
    }
    turned
}

fn offset(scene: &Scene, factor: f64) -> Scene {
    let camera = &scene.camera;
    let distance = (camera.position.as_dvec3() - camera.look_at.as_dvec3()).length();
    // A direction that no axis of the scene has.
    let shift = factor * distance * DVec3::new(0.48, 0.6, 0.64);
    moved(scene, |p| p + shift, 1.0)
}

/// Each point where `place` puts it, and each length times `factor`.
fn moved(scene: &Scene, place: impl Fn(DVec3) -> DVec3, factor: f64) -> Scene {
    let mut turned = scene.clone();
    let place = |p: &mut Vec3| *p = place(p.as_dvec3()).as_vec3();
    place(&mut turned.camera.position);
    place(&mut turned.camera.look_at);
    if let Projection::Orthographic { extent } = &mut turned.camera.projection {
        *extent = extent.map(|side| (factor * f64::from(side)) as f32);
    }
    for body in &mut turned.bodies {
        place(&mut body.sphere.center);
        body.sphere.radius = (factor * f64::from(body.sphere.radius)) as f32;
    }
    if let Some(light) = &mut turned.light {
        place(&mut light.position);
    }
    turned
}

fn is_sound(scene: &Scene) -> bool {
    let sphere = |sphere: &Sphere| Sphere::new(sphere.center, sphere.radius).is_ok();
    scene.camera.check().is_ok() && scene.bodies.iter().all(|body| sphere(&body.sphere))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::method::Method;
    use crate::render::{Frame, View};
    use crate::scene::{Builtin, PixelShape, Rays, Size};

    fn bodies(scene: &Scene) -> Vec<Option<u32>> {
        let rays = Rays::new(&scene.camera, Size::new(40, 20), PixelShape::Aspect(2.0));
        let mut frame = Frame::new();
        frame.render(scene, &rays, Method::Exact, View::Class);
        let pixels = (0..20).flat_map(|y| (0..40).map(move |x| (x, y)));
        pixels.map(|(x, y)| frame.seen(x, y)).collect()
    }

    #[test]
    fn the_picture_stays_the_same_at_every_scale() {
        let scene = Builtin::by_name("trio").unwrap().scene();
        let plain = bodies(&scene);
        for (dial, k) in [("large", 90), ("small", 90), ("large", 1), ("small", 1)] {
            let turned = Dial::by_name(dial).unwrap().turn(&scene, k).unwrap();
            assert_eq!(bodies(&turned), plain, "{dial} 2^{k}");
        }
    }

    #[test]
    fn a_small_offset_and_a_little_distance_change_little() {
        let scene = Builtin::by_name("trio").unwrap().scene();
        let plain = bodies(&scene);
        for dial in ["offset", "distance"] {
            let turned = Dial::by_name(dial).unwrap().turn(&scene, 3).unwrap();
            let changed = bodies(&turned)
                .iter()
                .zip(&plain)
                .filter(|(a, b)| a != b)
                .count();
            assert!(changed < 120, "{dial}: {changed} of 800 pixels");
        }
    }

    #[test]
    fn what_cannot_be_turned_is_left_alone() {
        let scene = Builtin::by_name("trio").unwrap().scene();
        assert!(Dial::by_name("tangency").unwrap().turn(&scene, 3).is_none());
        assert!(Dial::by_name("large").unwrap().turn(&scene, 128).is_none());
        assert!(
            Dial::by_name("large")
                .unwrap()
                .turn(&scene, u32::MAX)
                .is_none()
        );
    }
}
