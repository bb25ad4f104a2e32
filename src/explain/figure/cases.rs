//! Telling rays and spheres, shared by the tests of the figures.

use glam::Vec3;
use proptest::prelude::*;

use crate::explain::{Subject, Why};
use crate::geometry::{Ray, Sphere};
use crate::method::{Method, Truth};

/// A ray and a sphere with the subject that they give.
pub(super) fn case(o: [f32; 3], d: [f32; 3], c: [f32; 3], r: f32) -> (Subject, Ray) {
    let ray = Ray::new(Vec3::from(o), Vec3::from(d)).unwrap();
    let sphere = Sphere::new(Vec3::from(c), r).unwrap();
    let subject = Subject {
        body: 0,
        sphere,
        name: None,
        why: Why::NearestHit,
        coefficients: Method::Textbook.coefficients(&ray, &sphere),
        trace: Method::Textbook.trace(&ray, &sphere),
        solution: Truth::new(&ray, &sphere).solution(),
        worked: std::sync::OnceLock::new(),
        ray,
        sight: None,
    };
    (subject, ray)
}

/// The cases by name.
pub(super) fn named(name: &str) -> (Subject, Ray) {
    let down = [0.0, 0.0, 1.0];
    let tutorial = |x, y| case([x, y, 0.0], down, [20.0; 3], 10.0);
    let across = [1.0, 0.0, 0.0];
    let marble = |o| case(o, across, [0.0; 3], 1.0);
    let earth = |y, d| case([0.0, y, 0.0], d, [0.0, -6.371e6, 0.0], 6.371e6);
    match name {
        "tutorial centre" => tutorial(20.0, 20.0),
        "tutorial off centre" => tutorial(14.0, 20.0),
        "tutorial tangent" => tutorial(30.0, 20.0),
        "tutorial miss" => tutorial(31.0, 20.0),
        "tutorial wide miss" => tutorial(0.0, 0.0),
        "inside" => case([0.25, 0.5, -0.25], [1.0, 1.0, 0.0], [0.0; 3], 1.0),
        "behind" => case([0.0; 3], down, [0.0, 5.0, -20.0], 10.0),
        "far" => marble([-4100.0, 0.5, 0.0]),
        "far behind" => marble([1e12, 0.5, 0.0]),
        "grazing" => marble([-1000.0, 0.999_999, 0.0]),
        "grazing miss" => marble([-3.0, 1.000_000_1, 0.0]),
        "surface" => marble([-1.0, 0.0, 0.0]),
        "stiff" => case([1.000_000_1, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0; 3], 1.0),
        "planet" => earth(1.7, [1.0, -1.0, 0.0]),
        "planet down" => earth(1.7, [0.0, -1.0, 0.0]),
        "planet up" => earth(1.7, [1.0, 2.0, 0.0]),
        "planet horizon" => earth(1.7, [1.0, -0.000_731, 0.0]),
        "planet level" => earth(1.7, across),
        "point hit" => case([-3.0, 0.0, 0.0], across, [0.0; 3], 0.0),
        "point missed" => case([-3.0, 1.0, 0.0], across, [0.0; 3], 0.0),
        "tiny far off" => case([-3.0, 100.0, 0.0], across, [0.0; 3], 0.1),
        _ => panic!("no case {name}"),
    }
}

/// All their names.
pub(super) const NAMES: [&str; 21] = [
    "tutorial centre",
    "tutorial off centre",
    "tutorial tangent",
    "tutorial miss",
    "tutorial wide miss",
    "inside",
    "behind",
    "far",
    "far behind",
    "grazing",
    "grazing miss",
    "surface",
    "stiff",
    "planet",
    "planet down",
    "planet up",
    "planet horizon",
    "planet level",
    "point hit",
    "point missed",
    "tiny far off",
];

/// Any finite numbers at all.
pub(super) fn wild() -> impl Strategy<Value = (Subject, Ray)> {
    let finite = any::<u32>()
        .prop_map(f32::from_bits)
        .prop_filter("finite", |x| x.is_finite());
    let vector = || prop::array::uniform3(finite.clone());
    let direction = vector().prop_filter("d is not 0", |d| *d != [0.0; 3]);
    (vector(), direction, vector(), finite.clone()).prop_map(|(o, d, c, r)| case(o, d, c, r.abs()))
}

/// Whole numbers of a few digits: tangents, p0 on the surface and in the centre are among them.
pub(super) fn whole() -> impl Strategy<Value = (Subject, Ray)> {
    let vector = |n: i8| prop::array::uniform3((-n..=n).prop_map(f32::from));
    let direction = vector(2).prop_filter("d is not 0", |d| *d != [0.0; 3]);
    (vector(6), direction, vector(3), 0_u8..6).prop_map(|(o, d, c, r)| case(o, d, c, f32::from(r)))
}

/// A ray from anywhere around, towards a sphere of any size, p0 from just above it to far away.
pub(super) fn aimed() -> impl Strategy<Value = (Subject, Ray)> {
    let unit = || prop::array::uniform3(-1.0_f32..1.0).prop_map(Vec3::from);
    let altitude = (-7.0_f32..7.0).prop_map(|exponent| exponent.exp2() * 8.0_f32.powf(exponent));
    (unit(), unit(), altitude, -3_i8..8).prop_filter_map(
        "d is not 0",
        |(from, to, altitude, size)| {
            let r = 10.0_f32.powi(size.into());
            let out = from.try_normalize()?;
            let target = to.try_normalize()? * r;
            let origin = out * (r + altitude * r);
            let direction = target - origin;
            (direction != Vec3::ZERO).then(|| case(origin.into(), direction.into(), [0.0; 3], r))
        },
    )
}
