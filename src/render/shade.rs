//! How bright a hit is.

use std::ops::Neg;

use glam::DVec3;

use super::lanes::{Real, along, cross, dot, sub};
use crate::geometry::{Ray, Sphere};
use crate::method::{Method, Place};
use crate::scene::Light;

/// What is seen of a surface that no light reaches.
pub const AMBIENT: f64 = 0.12;

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
        let cosine = match (self.method, light) {
            (Method::Exact, light) => {
                return self.spot().brightness(light.as_ref().map(position)) as f32;
            }
            // A routine has no discriminant of its own: the light is where the eye is.
            (Method::Routine(_), None) if self.t.is_finite() => {
                let (outward, spot) = (self.outward(), self.spot());
                let to_eye = sub(spot.o, outward);
                cosine(to_eye, facing(outward, self.is_inside()))
            }
            (Method::Routine(_), None) => {
                return self.spot().brightness(None) as f32;
            }
            (method, None) => {
                // A discriminant below 0 is one that only rounding put there.
                let q = method.coefficients(self.ray, self.sphere);
                let r = f64::from(self.sphere.radius);
                (q.discriminant.at_least(0.0) / (4.0 * q.a * (r * r))).sqrt()
            }
            (_, Some(light)) => {
                let outward = self.outward();
                let center = self.sphere.center.to_array().map(f64::from);
                let to_light = sub(sub(position(&light), center), outward);
                cosine(to_light, facing(outward, self.is_inside()))
            }
        };
        dimmed(cosine) as f32
    }

    /// A normal on the side that is seen, of any length.
    pub(super) fn normal(&self) -> DVec3 {
        facing(self.outward(), self.is_inside()).into()
    }

    /// p − c, where p is the visible point.
    fn outward(&self) -> [f64; 3] {
        let spot = self.spot();
        match self.method {
            Method::Exact => spot.outward(),
            _ => along(spot.o, self.t.into(), spot.d),
        }
    }

    fn is_inside(&self) -> bool {
        self.place == Place::Inside
    }

    fn spot(&self) -> Spot<f64> {
        let [origin, d, center] = [self.ray.origin, self.ray.direction, self.sphere.center]
            .map(|v| v.to_array().map(f64::from));
        Spot {
            o: sub(origin, center),
            d,
            center,
            r: self.sphere.radius.into(),
            inside: self.is_inside(),
        }
    }
}

/// Where `exact` sees a sphere, for one ray or for several in lanes.
///
/// It is worked out in binary64: nothing shows the bits by which that differs from the rounded root,
/// so no root needs to be rounded for a shade.
pub(super) struct Spot<T> {
    /// o = p0 − c.
    pub o: [T; 3],
    /// The direction of the ray.
    pub d: [T; 3],
    /// c.
    pub center: [T; 3],
    /// r.
    pub r: T,
    /// Whether the visible root is the far one.
    pub inside: bool,
}

impl<T: Real> Spot<T> {
    /// As [`Hit::brightness`].
    #[inline(always)]
    pub(super) fn brightness(&self, light: Option<[f64; 3]>) -> T {
        dimmed(match light {
            None => self.headlight(),
            Some(light) => self.lambert(light.map(T::of)),
        })
    }

    /// A r² and D = A r² − ‖o × d‖².
    #[inline(always)]
    fn discriminant(&self) -> [T; 2] {
        let k = cross(self.o, self.d);
        let arr = dot(self.d, self.d) * (self.r * self.r);
        [arr, arr - dot(k, k)]
    }

    /// cos θ = √(Δ/(4Ar²)).
    #[inline(always)]
    fn headlight(&self) -> T {
        let [arr, reduced] = self.discriminant();
        (reduced.at_least(0.0) / arr).sqrt()
    }

    /// The cosine of the angle between the light and the normal on the side that is seen; below 0
    /// where the surface turns away.
    #[inline(always)]
    fn lambert(&self, light: [T; 3]) -> T {
        let outward = self.outward();
        let to_light = sub(sub(light, self.center), outward);
        cosine(to_light, facing(outward, self.inside))
    }

    /// o + t·d.
    #[inline(always)]
    fn outward(&self) -> [T; 3] {
        along(self.o, self.root(), self.d)
    }

    /// The visible root.
    #[inline(always)]
    fn root(&self) -> T {
        let [_, reduced] = self.discriminant();
        let a = dot(self.d, self.d);
        let b = dot(self.o, self.d);
        let c = dot(self.o, self.o) - self.r * self.r;
        let root = reduced.at_least(0.0).sqrt();
        if self.inside {
            ((root - b) / a).where_negative(b, -c / (root + b))
        } else {
            (c / (root - b)).where_negative(b, -(root + b) / a)
        }
    }
}

/// The brightness that a cosine gives. A point sphere has no normal and a root past the range no
/// place: where there is no cosine a surface is lit in full.
#[inline(always)]
fn dimmed<T: Real>(cosine: T) -> T {
    T::of(AMBIENT) + T::of(1.0 - AMBIENT) * cosine.at_most(1.0).at_least(0.0)
}

/// The side of a surface that is seen.
#[inline(always)]
fn facing<T: Real>(outward: [T; 3], inside: bool) -> [T; 3] {
    if inside {
        outward.map(Neg::neg)
    } else {
        outward
    }
}

#[inline(always)]
fn cosine<T: Real>(u: [T; 3], v: [T; 3]) -> T {
    dot(u, v) / (dot(u, u) * dot(v, v)).sqrt()
}

fn position(light: &Light) -> [f64; 3] {
    light.position.to_array().map(f64::from)
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
        // d is 2 long, so that `unit` sees another sphere.
        for method in Method::ALL.into_iter().filter(|&m| m != Method::Unit) {
            for x in [0.0, 0.25, 0.5, 0.9, 1.0] {
                let ray = ray(x);
                let cosine = f64::from(1.0 - x * x).sqrt();
                let expected = AMBIENT + (1.0 - AMBIENT) * cosine;
                let off = f64::from(hit(method, &ray, &UNIT).brightness(None)) - expected;
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
                let p = DVec3::from(hit.outward());
                assert!((p.length() - 1.0).abs() < 1e-6);
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
        let outward = Ray {
            origin: Vec3::ZERO,
            direction: Vec3::Z,
        };
        let light = Light {
            position: Vec3::ZERO,
        };
        let hit = hit(Method::Exact, &outward, &UNIT);
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
