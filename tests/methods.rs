//! The ladder of methods: the tutorial's numbers, what each buys, and what each loses.

use rayscope::geometry::{Ray, Sphere};
use rayscope::method::{Class, Method, Truth};

fn ray(p0: [f32; 3], d: [f32; 3]) -> Ray {
    Ray::new(p0.into(), d.into()).unwrap()
}

fn sphere(center: [f32; 3], radius: f32) -> Sphere {
    Sphere::new(center.into(), radius).unwrap()
}

#[test]
fn the_tutorials_pixel_comes_out_alike_everywhere() {
    let ball = sphere([20.0; 3], 10.0);
    for method in Method::ALL {
        let middle = ray([20.0, 20.0, 0.0], [0.0, 0.0, 1.0]);
        let found = method.solve(&middle, &ball);
        assert_eq!((found.near, found.far), (10.0, 30.0), "{method}");
        let k = method.coefficients(&middle, &ball);
        let abc = [k.a, k.b, k.c, k.discriminant];
        assert_eq!(abc, [1.0, -40.0, 300.0, 400.0], "{method}");

        let edge = ray([26.0, 28.0, 0.0], [0.0, 0.0, 1.0]);
        let found = method.solve(&edge, &ball);
        assert_eq!(found.class, Class::Tangent, "{method}");
        assert_eq!((found.near, found.far), (20.0, 20.0), "{method}");

        let past = ray([31.0, 20.0, 0.0], [0.0, 0.0, 1.0]);
        assert_eq!(method.solve(&past, &ball).class, Class::Miss, "{method}");
    }
}

/// The circle of radius 5 about the origin and the line y = 1.1x + 0.2: with p0 = (0, 0.2, 0) and
/// d = (1, 1.1, 0), t is x.
#[test]
fn the_tutorials_circle_and_line() {
    let line = ray([0.0, 0.2, 0.0], [1.0, 1.1, 0.0]);
    let circle = sphere([0.0; 3], 5.0);
    let near = |found: f64, expected: f64, within: f64| {
        assert!(
            (found - expected).abs() <= within,
            "{found} is not {expected}"
        );
    };
    for method in Method::ALL {
        let k = method.coefficients(&line, &circle);
        near(k.a, 2.21, 1e-6);
        near(k.b, 0.44, 1e-6);
        near(k.c, -24.96, 1e-5);
        near(k.discriminant, 0.44 * 0.44 - 4.0 * 2.21 * -24.96, 1e-4);
        near(k.discriminant, 220.84, 5e-3);
        let found = method.solve(&line, &circle);
        near(found.far.into(), 3.26, 5e-3);
        near(found.near.into(), -3.46, 5e-3);
        // The tutorial puts the rounded roots into the line: hence its 3.786 and −3.606.
        near(1.1 * 3.26 + 0.2, 3.786, 1e-12);
        near(line.at(found.far).y.into(), 3.786, 5e-3);
        near(line.at(found.near).y.into(), -3.606, 5e-3);
    }
}

/// A tangent where the ray starts: q = 0, and C/q would be 0/0.
#[test]
fn a_double_root_at_the_origin_is_zero() {
    for (line, ball) in [
        (ray([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]), sphere([0.0; 3], 1.0)),
        (ray([0.0; 3], [1.0, 0.0, 0.0]), sphere([0.0; 3], 0.0)),
    ] {
        for method in Method::ALL {
            let found = method.solve(&line, &ball);
            assert_eq!(found.class, Class::Tangent, "{method}");
            assert_eq!(found.near.to_bits(), 0, "{method}");
            assert_eq!(found.far.to_bits(), 0, "{method}");
        }
    }
}

#[test]
fn binary32_loses_the_far_sphere_unless_its_discriminant_does_not_cancel() {
    let line = ray([-1e5, 0.5, 0.0], [1.0, 0.0, 0.0]);
    let ball = sphere([0.0; 3], 1.0);
    let truth = Truth::new(&line, &ball).solution();
    assert_eq!(truth.class, Class::Secant);
    for lost in [Method::Textbook, Method::Citardauq, Method::Kahan] {
        assert_ne!(lost.solve(&line, &ball).class, Class::Secant, "{lost}");
    }
    for kept in [Method::Haines, Method::Double] {
        let found = kept.solve(&line, &ball);
        assert_eq!(found.class, Class::Secant, "{kept}");
        assert!((found.near - truth.near).abs() <= 0.01, "{kept}");
    }
}

/// Just above the ground, C = |o|² − r² cancels: only binary64 keeps the near root.
#[test]
fn binary32_loses_the_ground_under_its_feet() {
    let line = ray([0.0, 0.001, 0.0], [0.0, -1.0, 0.0]);
    let ground = sphere([0.0, -1e6, 0.0], 1e6);
    let truth = Truth::new(&line, &ground).solution();
    assert_eq!(truth.near, 0.001);
    for method in [
        Method::Textbook,
        Method::Citardauq,
        Method::Kahan,
        Method::Haines,
    ] {
        assert_eq!(method.solve(&line, &ground).near, 0.0, "{method}");
    }
    let found = Method::Double.solve(&line, &ground).near;
    assert!((found - 0.001).abs() < 1e-6, "{found}");
}

/// What leaves the range of binary32 on the way is lost to the methods that stay within it.
#[test]
fn binary32_overflows_where_binary64_does_not() {
    let line = ray([-3e20, 0.0, 0.0], [1.0, 0.0, 0.0]);
    let ball = sphere([0.0; 3], 1e20);
    for method in [
        Method::Textbook,
        Method::Citardauq,
        Method::Kahan,
        Method::Haines,
    ] {
        let found = method.solve(&line, &ball);
        assert!(
            !found.near.is_finite() || !found.far.is_finite(),
            "{method}"
        );
    }
    assert_eq!(Method::Textbook.solve(&line, &ball).class, Class::Nan);
    let found = Method::Double.solve(&line, &ball);
    assert_eq!((found.near, found.far), (2e20, 4e20));
}
