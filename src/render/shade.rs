//! How bright a hit is.

use glam::DVec3;

use crate::geometry::{Ray, Sphere};
use crate::method::{Coefficients, Method, Place};
use crate::scene::Light;

/// What is seen of a surface that no light reaches.
const AMBIENT: f64 = 0.12;

/// A point of a sphere that is seen.
pub(super) struct Hit<'a> {
    /// Who found it.
    pub method: Method,
    /// The ray that hits.
    pub ray: &'a Ray,
    /// The sphere that is hit.
    pub sphere: &'a Sphere,
    /// The visible root as the method gave it; `exact` is not asked for it.
    pub t: f32,
    /// Whether the visible root is the near or the far one.
    pub place: Place,
}

impl Hit<'_> {
    /// The brightness, from 0 to 1: a little everywhere, the rest by Lambert's cosine, from the
    /// light or, without one, from the eye.
    ///
    /// A method that is far off shows as a wrong brightness, not as a hole.
    pub(super) fn brightness(&self, light: Option<Light>) -> f32 {
        let cosine = match light {
            None => self.headlight(),
            Some(light) => self.lambert(light),
        };
        // A point sphere has no normal and a root past the range no place: both are lit in full.
        let cosine = if cosine.is_nan() { 1.0 } else { cosine };
        (AMBIENT + (1.0 - AMBIENT) * cosine.clamp(0.0, 1.0)) as f32
    }

    /// cos θ = √(Δ/(4Ar²)). A discriminant below 0 is one that only rounding put there.
    fn headlight(&self) -> f64 {
        let method = match self.method {
            // To the bits that a shade shows, binary64 has the exact Δ.
            Method::Exact => Method::Double,
            method => method,
        };
        let q = method.coefficients(self.ray, self.sphere);
        let r = f64::from(self.sphere.radius);
        (q.discriminant.max(0.0) / (4.0 * q.a * (r * r))).sqrt()
    }

    /// The cosine of the angle between the light and the normal on the side that is seen; below 0
    /// where the surface turns away.
    fn lambert(&self, light: Light) -> f64 {
        let p = self.point();
        cosine(light.position.as_dvec3() - p, self.normal_at(p))
    }

    /// A normal on the side that is seen, of any length.
    pub(super) fn normal(&self) -> DVec3 {
        self.normal_at(self.point())
    }

    fn normal_at(&self, p: DVec3) -> DVec3 {
        let outward = p - self.sphere.center.as_dvec3();
        if outward.dot(self.ray.direction.as_dvec3()) > 0.0 {
            -outward
        } else {
            outward
        }
    }

    /// p = p0 + t·d.
    fn point(&self) -> DVec3 {
        let t = match self.method {
            Method::Exact => self.root(),
            _ => self.t.into(),
        };
        self.ray.origin.as_dvec3() + t * self.ray.direction.as_dvec3()
    }

    /// The visible root in binary64: nothing shows the bits by which it differs from the exact one.
    fn root(&self) -> f64 {
        let Coefficients {
            a,
            b,
            c,
            discriminant,
            ..
        } = Method::Double.coefficients(self.ray, self.sphere);
        let half_b = b / 2.0;
        let s = discriminant.max(0.0).sqrt() / 2.0;
        let q = half_b.abs() + s;
        match (self.place, half_b < 0.0) {
            _ if q == 0.0 => 0.0,
            (Place::Inside, true) => q / a,
            (Place::Inside, false) => -c / q,
            (_, true) => c / q,
            (_, false) => -q / a,
        }
    }
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

    fn hit<'a>(method: Method, ray: &'a Ray, sphere: &'a Sphere) -> Hit<'a> {
        let solution = method.solve(ray, sphere);
        Hit {
            method,
            ray,
            sphere,
            t: solution.visible().expect("a hit"),
            place: solution.place().expect("a hit"),
        }
    }

    #[test]
    fn a_headlight_is_the_cosine_between_ray_and_normal() {
        for method in Method::ALL {
            for x in [0.0, 0.25, 0.5, 0.9, 1.0] {
                let ray = ray(x);
                let cosine = f64::from(1.0 - x * x).sqrt();
                let off = hit(method, &ray, &UNIT).headlight() - cosine;
                assert!(off.abs() < 1e-5, "{method} {x} {off}");
            }
        }
    }

    #[test]
    fn the_point_that_is_seen_lies_on_the_sphere() {
        let rays = [
            ray(0.6),
            Ray {
                origin: Vec3::new(0.2, 0.1, -0.3),
                direction: Vec3::new(1.0, 2.0, 3.0),
            },
            Ray {
                origin: Vec3::new(-0.2, 0.1, -0.3),
                direction: Vec3::new(1.0, 2.0, 3.0),
            },
            Ray {
                origin: Vec3::new(0.3, 0.1, 0.2),
                direction: Vec3::new(1.0, 2.0, 3.0),
            },
        ];
        for ray in &rays {
            for method in [Method::Exact, Method::Double] {
                let hit = hit(method, ray, &UNIT);
                assert!((hit.point().length() - 1.0).abs() < 1e-6);
                assert!(hit.normal().dot(ray.direction.as_dvec3()) <= 0.0);
            }
        }
    }

    #[test]
    fn a_light_at_the_eye_and_an_orthographic_ray_agree_with_the_headlight_at_the_centre() {
        let light = |z| {
            let position = Vec3::new(0.0, 0.0, z);
            Some(Light { position })
        };
        let ray = ray(0.0);
        let hit = hit(Method::Exact, &ray, &UNIT);
        assert_eq!(hit.brightness(light(10.0)), 1.0);
        assert_eq!(hit.brightness(None), 1.0);
        assert_eq!(hit.brightness(light(-10.0)), AMBIENT as f32);
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
        let hit = hit(Method::Exact, &from_centre, &UNIT);
        assert_eq!(hit.brightness(Some(light)), 1.0);
        assert_eq!(hit.brightness(None), 1.0);
    }

    #[test]
    fn every_root_and_radius_gives_a_brightness() {
        let point = Sphere {
            radius: 0.0,
            ..UNIT
        };
        let light = Light {
            position: Vec3::ZERO,
        };
        for light in [None, Some(light)] {
            for sphere in [UNIT, point] {
                for method in Method::ALL {
                    for t in [f32::MIN_POSITIVE, 5.0, f32::MAX, f32::INFINITY] {
                        let hit = Hit {
                            method,
                            ray: &ray(0.0),
                            sphere: &sphere,
                            t,
                            place: Place::Hit,
                        };
                        let b = hit.brightness(light);
                        assert!((0.0..=1.0).contains(&b), "{b}");
                    }
                }
            }
        }
    }
}
