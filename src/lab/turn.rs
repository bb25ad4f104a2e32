//! A dial turned on a whole scene: the picture stays what it is, the numbers become harder.

use glam::{DVec3, Vec3};

use super::Dial;
use crate::geometry::Sphere;
use crate::number::power_of_two;
use crate::scene::{Projection, Scene};

/// A dial, and how far it is turned on a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Turn {
    /// The dial.
    pub dial: &'static Dial,
    /// It is turned by 2^k into the direction in which it breaks; at least 1.
    pub k: u32,
}

impl Turn {
    /// The quantity of the dial and its value, as a formula.
    pub fn formula(&self) -> String {
        let Self { dial, k } = self;
        match dial.name {
            // What is turned has a value of its own in each scene.
            "distance" => format!("{} × 2^{k}", dial.quantity),
            "altitude" => format!("{} × 2^-{k}", dial.quantity),
            "small" => format!("{} 2^-{k}", dial.quantity),
            _ => format!("{} 2^{k}", dial.quantity),
        }
    }
}

impl Dial {
    /// The dials that scenes have.
    pub fn of_scenes() -> impl Iterator<Item = &'static Self> {
        Self::ALL.iter().filter(|dial| dial.on_scenes().is_some())
    }

    /// What turning it does to a scene, as a sentence; none for a dial that scenes do not have: a
    /// camera's directions are about 1 long, and no scene is a single tangent.
    pub fn on_scenes(&self) -> Option<&'static str> {
        match self.name {
            "distance" => {
                Some("The camera backs away from what it looks at, and its view narrows.")
            }
            "altitude" => Some("The camera comes down on the sphere whose surface is nearest."),
            "offset" => Some("Everything moves away from the world's origin."),
            "large" => Some("Everything grows."),
            "small" => Some("Everything shrinks."),
            _ => None,
        }
    }

    /// The settings k of a scene from 1 on, as far as the dial goes there.
    pub fn turns(&self) -> impl Iterator<Item = u32> + use<> {
        let most = match self.name {
            // Farther away binary32 has no two directions between which the picture would lie.
            "distance" => 24,
            _ => u32::MAX,
        };
        let settings = self.settings().map(i32::unsigned_abs);
        settings.filter(move |k| (1..=most).contains(k))
    }

    /// The scene with this dial turned by 2^k, k from 0 on into the direction in which the dial
    /// breaks; none for a dial that scenes do not have, and where a number would leave the range of
    /// binary32 or the camera would no longer move.
    ///
    /// * `distance`: the camera backs away from what it looks at, and its field of view narrows.
    /// * `altitude`: the camera comes straight down to 2^-k of its height over the nearest surface,
    ///   and goes on looking the same way.
    /// * `offset`: everything moves away from the origin, by 2^k times the camera's distance.
    /// * `large`, `small`: everything is scaled.
    pub fn turn(&self, scene: &Scene, k: u32) -> Option<Scene> {
        let k = i32::try_from(k).ok().filter(|&k| k <= 200)?;
        let turned = match self.name {
            "distance" => back_away(scene, power_of_two(k)),
            "altitude" => come_down(scene, power_of_two(-k))?,
            "offset" => offset(scene, power_of_two(k)),
            "large" => moved(scene, |p| power_of_two(k) * p, power_of_two(k)),
            "small" => moved(scene, |p| power_of_two(-k) * p, power_of_two(-k)),
            _ => return None,
        };
        is_sound(&turned).then_some(turned)
    }
}

/// The camera at `part` of its height over the surface that is nearest to it, from outside or
/// inside; none where binary32 cannot tell that place from the surface.
fn come_down(scene: &Scene, part: f64) -> Option<Scene> {
    let mut turned = scene.clone();
    let camera = &mut turned.camera;
    let eye = camera.position.as_dvec3();
    let height = |sphere: &Sphere| {
        let out = eye - sphere.center.as_dvec3();
        (out.length() - f64::from(sphere.radius), out)
    };
    let heights = scene.bodies.iter().map(|body| height(&body.sphere));
    let (height, out) = heights.min_by(|(one, _), (other, _)| one.abs().total_cmp(&other.abs()))?;
    let down = out.try_normalize()? * (height * (part - 1.0));
    let position = (eye + down).as_vec3();
    let rounding = (position.as_dvec3() - (eye + down)).length();
    if rounding > 0.25 * (height * part).abs() {
        return None;
    }
    camera.look_at = (camera.look_at.as_dvec3() + down).as_vec3();
    camera.position = position;
    Some(turned)
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
    if let Projection::Orthographic { extent, step } = &mut turned.camera.projection {
        let scaled = |length: f32| (factor * f64::from(length)) as f32;
        *extent = extent.map(scaled);
        *step = step.map(scaled);
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
    fn the_camera_comes_down_to_a_part_of_its_height() {
        let scene = Builtin::by_name("planet").unwrap().scene();
        let altitude = Dial::by_name("altitude").unwrap();
        let height = |scene: &Scene| {
            let ground = scene.bodies[0].sphere;
            let out = scene.camera.position.as_dvec3() - ground.center.as_dvec3();
            out.length() - f64::from(ground.radius)
        };
        let before = height(&scene);
        for k in [1, 5, 10] {
            let turned = altitude.turn(&scene, k).unwrap();
            let part = height(&turned) / before * power_of_two(k as i32);
            assert!((0.7..1.3).contains(&part), "2^-{k}: {part}");
            let way = |s: &Scene| s.camera.look_at - s.camera.position;
            assert!(way(&turned).angle_between(way(&scene)) < 1e-3);
        }
        let trio = Builtin::by_name("trio").unwrap().scene();
        assert!(altitude.turn(&trio, 60).is_none(), "on the surface");
    }

    #[test]
    fn every_dial_of_scenes_can_be_turned_and_no_other() {
        let scene = Builtin::by_name("trio").unwrap().scene();
        for dial in Dial::ALL {
            let turned = dial.turn(&scene, 1).is_some();
            assert_eq!(turned, dial.on_scenes().is_some(), "{}", dial.name);
            assert!(dial.turns().all(|k| k as i32 % dial.step() == 0));
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
