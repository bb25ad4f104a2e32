//! How bright a hit is.

use glam::DVec3;

use crate::geometry::{Ray, Sphere};
use crate::scene::Light;

/// What is seen of a surface that no light reaches.
const AMBIENT: f64 = 0.12;

/// The brightness, from 0 to 1, of the point p0 + t·d of `sphere`: a little everywhere, the rest by
/// Lambert's cosine, from the light or, without one, from the eye.
///
/// It is worked out from the root as the method gave it. A root that is far off the sphere shows
/// as a wrong brightness, not as a hole.
pub(super) fn brightness(ray: &Ray, sphere: &Sphere, t: f32, light: Option<Light>) -> f32 {
    let cosine = match light {
        None => headlight(ray, sphere, t),
        Some(light) => lambert(ray, sphere, t, light),
    };
    // A point sphere has no normal and a root past the range no place: both are lit in full.
    let cosine = if cosine.is_nan() { 1.0 } else { cosine };
    (AMBIENT + (1.0 - AMBIENT) * cosine.clamp(0.0, 1.0)) as f32
}

/// cos θ = √(Δ/(4Ar²)): since t solves the quadratic, √Δ = |2At + B|, so cos θ = |At + b|/(√A·r).
pub fn headlight(ray: &Ray, sphere: &Sphere, t: f32) -> f64 {
    let d = ray.direction.as_dvec3();
    let o = ray.origin.as_dvec3() - sphere.center.as_dvec3();
    let a = d.dot(d);
    (a * f64::from(t) + o.dot(d)).abs() / (a.sqrt() * f64::from(sphere.radius))
}

/// The cosine of the angle between the light and the normal on the side that is seen; below 0
/// where the surface turns away.
fn lambert(ray: &Ray, sphere: &Sphere, t: f32, light: Light) -> f64 {
    let d = ray.direction.as_dvec3();
    let p = ray.origin.as_dvec3() + f64::from(t) * d;
    let outward = p - sphere.center.as_dvec3();
    let normal = if outward.dot(d) > 0.0 {
        -outward
    } else {
        outward
    };
    cosine(light.position.as_dvec3() - p, normal)
}

fn cosine(u: DVec3, v: DVec3) -> f64 {
    u.dot(v) / (u.length() * v.length())
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;
    use crate::method::Method;

    fn ray(x: f32) -> Ray {
        Ray {
            origin: Vec3::new(x, 0.0, 10.0),
            direction: Vec3::new(0.0, 0.0, -2.0),
        }
    }

    const UNIT: Sphere = Sphere {
        center: Vec3::ZERO,
        radius: 1.0,
    };

    #[test]
    fn a_headlight_is_the_root_of_the_normalised_discriminant() {
        for x in [0.0, 0.25, 0.5, 0.9, 1.0] {
            let ray = ray(x);
            let q = Method::Textbook.coefficients(&ray, &UNIT);
            let t = Method::Textbook.solve(&ray, &UNIT).near;
            let expected = (q.discriminant / (4.0 * q.a)).sqrt();
            assert!((headlight(&ray, &UNIT, t) - expected).abs() < 1e-6);
        }
    }

    #[test]
    fn a_light_at_the_eye_and_an_orthographic_ray_agree_with_the_headlight_at_the_centre() {
        let light = Light {
            position: Vec3::new(0.0, 0.0, 10.0),
        };
        let t = 4.5;
        assert_eq!(brightness(&ray(0.0), &UNIT, t, Some(light)), 1.0);
        assert_eq!(brightness(&ray(0.0), &UNIT, t, None), 1.0);
        let behind = Light {
            position: Vec3::new(0.0, 0.0, -10.0),
        };
        assert_eq!(
            brightness(&ray(0.0), &UNIT, t, Some(behind)),
            AMBIENT as f32
        );
    }

    #[test]
    fn the_inside_is_lit_on_its_inner_side() {
        let from_centre = Ray {
            origin: Vec3::ZERO,
            direction: Vec3::Z,
        };
        let light = Light {
            position: Vec3::ZERO,
        };
        assert_eq!(brightness(&from_centre, &UNIT, 1.0, Some(light)), 1.0);
        assert_eq!(brightness(&from_centre, &UNIT, 1.0, None), 1.0);
    }

    #[test]
    fn every_root_and_radius_gives_a_brightness() {
        let point = Sphere {
            radius: 0.0,
            ..UNIT
        };
        for light in [
            None,
            Some(Light {
                position: Vec3::ZERO,
            }),
        ] {
            for sphere in [UNIT, point] {
                for t in [f32::MIN_POSITIVE, 5.0, f32::MAX, f32::INFINITY] {
                    let b = brightness(&ray(0.0), &sphere, t, light);
                    assert!((0.0..=1.0).contains(&b), "{b}");
                }
            }
        }
    }
}
