//! Acne: on which side of a sphere the computed point of a hit lies, and whether a second ray from there meets
//! its own sphere again.

use glam::Vec3;

use crate::geometry::{Ray, Sphere};
use crate::method::{Method, Place};

/// The computed point of a hit, and what a mirrored ray from there meets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Acne {
    /// How far the point lies outside the sphere, below 0 inside, in units of the world.
    pub height: f64,
    /// Where the ray that is mirrored at the point, of length 1, meets the same sphere; none if it goes free.
    pub self_hit: Option<f32>,
}

impl Acne {
    /// Of the hit at t, all in binary32 but the height; none for a point sphere, and for a point past the range.
    pub(super) fn of(
        method: Method,
        ray: &Ray,
        sphere: &Sphere,
        (t, place): (f32, Place),
    ) -> Option<Self> {
        let point = ray.at(t);
        let normal = (point - sphere.center).try_normalize()?;
        let direction = ray.direction.try_normalize()?;
        let mirrored = direction - 2.0 * direction.dot(normal) * normal;
        let origin = point.is_finite().then_some(point)?;
        let second = Ray {
            origin,
            direction: mirrored.try_normalize()?,
        };
        let found = method.solve(&second, sphere);
        // From inside the mirrored ray crosses the sphere and meets its other side: that is no acne, but what lies
        // nearer than half of the way is.
        let chord = 2.0 * mirrored.dot(normal).abs() * sphere.radius;
        let self_hit = found
            .visible()
            .filter(|&t| place != Place::Inside || t < chord / 2.0);
        Some(Self {
            height: height(point, sphere),
            self_hit,
        })
    }
}

/// How far a point lies outside a sphere, below 0 inside.
pub fn height(point: Vec3, sphere: &Sphere) -> f64 {
    let from_center = point.as_dvec3() - sphere.center.as_dvec3();
    let r = f64::from(sphere.radius);
    (from_center.length_squared() - r * r) / (from_center.length() + r)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::{Frame, View};
    use crate::scene::{Builtin, Rays, Size};

    #[test]
    fn planet_has_acne_and_whole_numbers_have_none() {
        let count = |name: &str, method: Method| {
            let scene = Builtin::by_name(name).unwrap().scene();
            let size = scene.pixels.unwrap_or(Size::new(60, 40));
            let shape = crate::scene::PixelShape::Own;
            let rays = Rays::new(&scene.camera, size, shape);
            let mut frame = Frame::new();
            frame.render(&scene, &rays, method, View::Acne);
            let pixels = (0..size.height).flat_map(|y| (0..size.width).map(move |x| (x, y)));
            let found: Vec<Acne> = pixels
                .filter_map(|(x, y)| frame.acne(&scene, x, y))
                .collect();
            let inside = found.iter().filter(|acne| acne.height < 0.0).count();
            let outside = found.iter().filter(|acne| acne.height > 0.0).count();
            let again = found.iter().filter(|acne| acne.self_hit.is_some()).count();
            [found.len(), inside, outside, again]
        };
        let [all, inside, outside, again] = count("planet", Method::Exact);
        assert!(
            all > 500 && inside > all / 10 && outside > all / 10,
            "{inside} {outside}"
        );
        // From an inside point the sphere is in front of every ray.
        assert!(again * 2 > inside, "{again} of {inside}");
        let [.., again] = count("planet", Method::Textbook);
        assert!(again > 20, "{again}");
        // From (20, 20, 0) the tutorial's sphere is met at exactly (20, 20, 10).
        let scene = Builtin::Tutorial.scene();
        let rays = Rays::new(
            &scene.camera,
            Size::new(40, 40),
            crate::scene::PixelShape::Own,
        );
        let mut frame = Frame::new();
        frame.render(&scene, &rays, Method::Exact, View::Acne);
        let middle = frame.acne(&scene, 20, 20).unwrap();
        assert_eq!(
            middle,
            Acne {
                height: 0.0,
                self_hit: None
            }
        );
        assert!(frame.acne(&scene, 0, 0).is_none());
        frame.render(&scene, &rays, Method::Exact, View::Shade);
        assert!(frame.acne(&scene, 20, 20).is_none());
    }
}
