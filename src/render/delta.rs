//! Δ/(4Ar²), which the view of Δ shows.

use crate::geometry::{Ray, Sphere};
use crate::method::{Class, Method};

/// The least Δ/(4Ar²) of a miss that is shown: the line passes the centre at 2r.
pub(super) const FARTHEST_MISS: f32 = -3.0;

/// Δ/(4Ar²) as `method` has it: −∞ for a miss, 0 for a meeting where that is not a number, as with
/// a point sphere.
///
/// The size of an exact Δ, and of a routine's, is taken from the method `double`, which has it to all the bits that a
/// picture can show; its sign is that of the exact class.
pub(super) fn normalised_discriminant(
    method: Method,
    ray: &Ray,
    sphere: &Sphere,
    class: Class,
) -> f32 {
    let size = match method {
        Method::Exact | Method::Routine(_) => Method::Double,
        _ => method,
    }
    .coefficients(ray, sphere);
    let r = f64::from(sphere.radius);
    let delta = (size.discriminant / (4.0 * size.a * r * r)) as f32;
    let delta = match (method, class) {
        (Method::Exact | Method::Routine(_), Class::Miss) => -delta.abs(),
        (Method::Exact | Method::Routine(_), Class::Tangent) => 0.0,
        (Method::Exact | Method::Routine(_), Class::Secant | Class::Hit) => delta.abs(),
        _ => delta,
    };
    match class {
        _ if !delta.is_nan() => delta,
        Class::Tangent | Class::Secant | Class::Hit => 0.0,
        Class::Miss | Class::Nan => f32::NEG_INFINITY,
    }
}
