//! The ladder of methods: the tutorial's numbers, what each buys, and what each loses.

use proptest::prelude::*;
use rayscope::geometry::{Ray, Sphere};
use rayscope::lab::Family;
use rayscope::method::{Class, Method, Precision, Solution, Surd, Truth, ulp_error};
use rayscope::text::read::binary32;

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
    // d is not of length 1, so that `unit` works another circle.
    for method in Method::ALL.into_iter().filter(|&m| m != Method::Unit) {
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

/// u = 2⁻²⁴, the unit roundoff of binary32.
const U: f64 = 1.0 / 16_777_216.0;

/// The families in which no method leaves the range of binary32.
const WITHIN_RANGE: [&str; 10] = [
    "typical",
    "inside",
    "far-4e3",
    "far-1e6",
    "grazing",
    "surface",
    "ground",
    "offset",
    "integers",
    "log-uniform",
];

fn sample(family: &str, n: usize) -> Vec<(Ray, Sphere)> {
    Family::by_name(family).unwrap().sample(11, n)
}

/// |o|, |d| and r, to binary64.
fn lengths(ray: &Ray, sphere: &Sphere) -> [f64; 3] {
    let o = ray.origin.as_dvec3() - sphere.center.as_dvec3();
    [
        o.length(),
        ray.direction.as_dvec3().length(),
        sphere.radius.into(),
    ]
}

/// Whether A is 1 to within the rounding of d: where it is not, `unit` answers another question.
fn is_unit(ray: &Ray) -> bool {
    (ray.direction.as_dvec3().length_squared() - 1.0).abs() <= 4.0 * U
}

/// λ of docs/methods.md: κ with the sizes that B and C were summed from in the place of B and C.
fn sensitivity(truth: &Truth, root: &Surd, [o, d, r]: [f64; 3]) -> f64 {
    let t = root.to_f64().abs();
    let root_of_discriminant = Surd::from(truth.discriminant()).to_f64().sqrt();
    (d * d * t * t + 2.0 * o * d * t + o * o + r * r) / (t * root_of_discriminant)
}

/// The error that docs/methods.md states for roots: 14 λu relatively, and for `double` the last
/// rounding and 14 λ·2⁻⁵³.
#[test]
fn roots_are_as_good_as_is_stated() {
    let mut judged = [0; Method::ALL.len()];
    for family in WITHIN_RANGE {
        for (ray, sphere) in sample(family, 500) {
            let truth = Truth::new(&ray, &sphere);
            for (i, method) in Method::ALL.into_iter().enumerate() {
                let found = method.solve(&ray, &sphere);
                let asked = method != Method::Unit || is_unit(&ray);
                if !(asked && truth.class().meets() && found.class == truth.class()) {
                    continue;
                }
                for (root, t) in [(truth.near(), found.near), (truth.far(), found.far)] {
                    let root = root.unwrap();
                    let sensitivity = sensitivity(&truth, &root, lengths(&ray, &sphere));
                    let ulps = ulp_error(t, &root);
                    let bound = match method {
                        Method::Exact | Method::Routine(_) => 0.5,
                        // A relative error of 2⁻⁵³ is at most 2⁻²⁹ of an ulp of binary32.
                        Method::Double => 0.5 + 14.0 * sensitivity / 536_870_912.0,
                        // One of u is at most one ulp; beyond 2⁻¹⁰ the first order is not all.
                        _ if sensitivity > 16_384.0 => continue,
                        _ => 14.0 * sensitivity,
                    };
                    assert!(
                        ulps <= bound,
                        "{method}: {ulps} > {bound} for {ray:?} {sphere:?}"
                    );
                    judged[i] += 1;
                }
            }
        }
    }
    assert!(judged.iter().all(|&n| n > 3500), "{judged:?}");
}

/// The ray at which docs/methods.md says that `textbook` is off by 3.28 λu.
#[test]
fn the_largest_error_that_is_stated_was_found() {
    let text = "-0x1.b3622ap-3,-0x1.2180aep+2,0x1.de0b22p-3,-0x1.1e9d88p-1,-0x1.a84246p-1,0x1.91c9ap-12,\
                -0x1.741aecp-3,-0x1.206542p+2,0x1.c5841ap-3,0x1.060f9ep+1";
    let x: Vec<f32> = text.split(',').map(|x| binary32(x).unwrap()).collect();
    let at = |i: usize| [x[i], x[i + 1], x[i + 2]];
    let (line, ball) = (ray(at(0), at(3)), sphere(at(6), x[9]));
    let truth = Truth::new(&line, &ball);
    let found = Method::Textbook.solve(&line, &ball);
    let roots = [(truth.near(), found.near), (truth.far(), found.far)];
    let worst = roots.map(|(root, t)| {
        let root = root.unwrap();
        let off = (f64::from(t) - root.to_f64()).abs() / root.to_f64().abs();
        off / (U * sensitivity(&truth, &root, lengths(&line, &ball)))
    });
    let worst = worst[0].max(worst[1]);
    assert!((3.27..3.29).contains(&worst), "{worst}");
}

/// How large Δ/4A must be for its sign to be right, as docs/methods.md states it.
#[test]
fn classes_are_as_good_as_is_stated() {
    let mut judged = [0; Method::ALL.len()];
    for family in WITHIN_RANGE {
        for (ray, sphere) in sample(family, 500) {
            let truth = Truth::new(&ray, &sphere);
            let [o, d, r] = lengths(&ray, &sphere);
            let height = Surd::from(truth.quarter_discriminant.clone())
                .to_f64()
                .abs()
                / (d * d);
            for (i, method) in Method::ALL.into_iter().enumerate() {
                let bound = match method {
                    Method::Unit if !is_unit(&ray) => continue,
                    Method::Textbook
                    | Method::Contracted
                    | Method::Unit
                    | Method::Citardauq
                    | Method::Kahan => 24.0 * U * (o * o + r * r),
                    Method::Haines => 32.0 * U * (r * (o + r) + 32.0 * U * o * o),
                    Method::Double => {
                        let u = f64::EPSILON / 2.0;
                        32.0 * u * (r * (o + r) + 32.0 * u * o * o)
                    }
                    Method::Exact | Method::Routine(_) => 0.0,
                };
                if height < bound {
                    continue;
                }
                let found = method.solve(&ray, &sphere).class;
                assert_eq!(found, truth.class(), "{method}: {ray:?} {sphere:?}");
                judged[i] += 1;
            }
        }
    }
    assert!(judged.iter().all(|&n| n > 2000), "{judged:?}");
}

/// What a method says of the rays of a family: how many in a hundred it classifies wrongly, and the
/// median error in ulps of the worse root of the others.
fn score(method: Method, rays: &[(Ray, Sphere)]) -> (f64, f64) {
    let mut wrong = 0;
    let mut errors = Vec::new();
    for (ray, sphere) in rays {
        let truth = Truth::new(ray, sphere);
        let found = method.solve(ray, sphere);
        if found.class != truth.class() {
            wrong += 1;
        } else if found.class.meets() {
            let near = ulp_error(found.near, &truth.near().unwrap());
            let far = ulp_error(found.far, &truth.far().unwrap());
            // What is not a number is as wrong as can be.
            errors.push(if near.is_nan() || far.is_nan() {
                f64::INFINITY
            } else {
                near.max(far)
            });
        }
    }
    errors.sort_by(f64::total_cmp);
    let median = errors.get(errors.len() / 2).copied().unwrap_or(f64::NAN);
    (100.0 * f64::from(wrong) / rays.len() as f64, median)
}

/// The table of docs/methods.md, computed again.
fn table() -> String {
    let families = [
        "typical",
        "inside",
        "far-4e3",
        "far-1e6",
        "grazing",
        "tangent",
        "tangent-ulp",
        "surface",
        "ground",
        "log-uniform",
        "overflow",
    ];
    let row = |first: &str, cells: [String; Method::ALL.len()]| {
        format!("| {first} | {} |\n", cells.join(" | "))
    };
    let mut table = row("family", Method::ALL.map(|method| method.to_string()));
    table += &("|---".repeat(Method::ALL.len() + 1) + "|\n");
    for family in families {
        let rays = sample(family, 2000);
        let cells = Method::ALL.map(|method| {
            let (wrong, median) = score(method, &rays);
            match median {
                m if m.is_nan() => format!("{wrong:.1} / –"),
                m if m.is_infinite() => format!("{wrong:.1} / ∞"),
                m if m < 10.0 => format!("{wrong:.1} / {m:.1}"),
                m if m < 1e4 => format!("{wrong:.1} / {m:.0}"),
                m => format!("{wrong:.1} / {m:.0e}"),
            }
        });
        table += &row(family, cells);
    }
    table
}

/// The figures of docs/methods.md are these; the generators and the methods give the same on every
/// machine.
#[test]
fn the_table_of_the_docs_is_what_comes_out() {
    let table = table();
    println!("{table}");
    let docs = include_str!("../docs/methods.md");
    assert!(
        docs.contains(&table),
        "docs/methods.md should have this table:\n{table}"
    );
}

/// The failures that docs/methods.md names.
#[test]
fn each_method_fails_where_it_is_said_to() {
    let share = |method, family| score(method, &sample(family, 1000)).0;
    let median = |method, family| score(method, &sample(family, 1000)).1;
    for method in [Method::Textbook, Method::Citardauq, Method::Kahan] {
        assert!(share(method, "far-4e3") > 20.0, "{method}");
        assert!(share(method, "far-1e6") > 40.0, "{method}");
        assert!(share(method, "grazing") > 40.0, "{method}");
    }
    assert!(share(Method::Haines, "far-4e3") < 0.5);
    assert!(share(Method::Haines, "far-1e6") < 2.0);
    assert!(share(Method::Haines, "grazing") > 10.0);
    for method in [
        Method::Textbook,
        Method::Citardauq,
        Method::Kahan,
        Method::Haines,
    ] {
        assert!(median(method, "surface") > 1e5, "{method}");
        assert!(median(method, "ground") > 1e5, "{method}");
        assert!(share(method, "overflow") > 90.0, "{method}");
    }
    for family in ["far-1e6", "grazing", "surface", "ground", "overflow"] {
        assert_eq!(share(Method::Double, family), 0.0, "{family}");
        assert!(median(Method::Double, family) <= 0.5, "{family}");
    }
    assert!(share(Method::Double, "tangent-ulp") > 1.0);
    assert_eq!(share(Method::Exact, "tangent-ulp"), 0.0);
}

/// Where the roots all but agree, q/A and C/q can come out in the wrong order.
#[test]
fn near_comes_before_far_in_every_family() {
    let quotients_swapped = (
        ray([-30_284_792.0, 0.0, 0.0], [512.0, 0.0, 0.0]),
        sphere([0.0; 3], 1.0),
    );
    let families = Family::ALL.iter().flat_map(|family| family.sample(3, 500));
    for (ray, sphere) in families.chain([quotients_swapped]) {
        for method in Method::ALL {
            let Solution {
                class, near, far, ..
            } = method.solve(&ray, &sphere);
            let ordered = near <= far || near.is_nan() || far.is_nan();
            assert!(ordered, "{method}: {near} {far} for {ray:?} {sphere:?}");
            assert!(class.meets() || near.is_nan() && far.is_nan(), "{method}");
            let same = near.to_bits() == far.to_bits() || near.is_nan();
            assert!(class != Class::Tangent || same, "{method}: {near} {far}");
        }
    }
}

/// Half-b is speed, never accuracy: barring over- and underflow it gives the textbook's very bits.
#[test]
fn half_b_is_the_textbook_bit_for_bit() {
    for family in WITHIN_RANGE {
        for (ray, sphere) in sample(family, 300) {
            let textbook = Method::Textbook.coefficients(&ray, &sphere);
            let half_b = Method::Citardauq.coefficients(&ray, &sphere);
            assert_eq!(textbook, half_b, "{ray:?} {sphere:?}");
        }
    }
}

/// In every family, the steps of a trace are the operations of the plain run.
#[test]
fn a_trace_is_the_plain_run_in_every_family() {
    let same = |x: f64, y: f64| x.to_bits() == y.to_bits() || x.is_nan() && y.is_nan();
    for family in Family::ALL {
        for (ray, sphere) in family.sample(5, 20) {
            for method in Method::ALL {
                let trace = method.trace(&ray, &sphere);
                let Solution {
                    class, near, far, ..
                } = method.solve(&ray, &sphere);
                assert_eq!(trace.solution.class, class);
                let step = |symbol| {
                    trace
                        .step(symbol)
                        .map(|step| step.result.parts()[0].clone())
                };
                if class.meets() {
                    for (symbol, root) in [("near", near), ("far", far)] {
                        let found = step(symbol).unwrap();
                        assert_eq!(found.precision, Precision::Binary32);
                        assert!(
                            same(found.value + 0.0, root.into()),
                            "{method} {}",
                            family.name
                        );
                    }
                }
                let k = method.coefficients(&ray, &sphere);
                let last = match method {
                    Method::Textbook | Method::Contracted => step("Δ").unwrap().value,
                    Method::Exact | Method::Routine(_) => continue,
                    Method::Double => 4.0 * step("D").unwrap().value,
                    _ => f64::from(4.0 * step("D").unwrap().value as f32),
                };
                assert!(same(last, k.discriminant), "{method} {}", family.name);
            }
        }
    }
}

/// Multiples of 2⁻⁶ up to 16: sums, differences and products of three of them are exact.
fn coordinate() -> impl Strategy<Value = f32> {
    (-1024_i16..=1024).prop_map(|n| f32::from(n) / 64.0)
}

fn vector() -> impl Strategy<Value = [f32; 3]> {
    prop::array::uniform3(coordinate())
}

fn question() -> impl Strategy<Value = (Ray, Sphere)> {
    (vector(), vector(), vector(), coordinate()).prop_filter_map("d = 0", |(p0, d, c, r)| {
        let ray = Ray::new(p0.into(), d.into()).ok()?;
        Some((ray, Sphere::new(c.into(), r.abs()).ok()?))
    })
}

/// Class and both roots, to the bit.
fn bits(found: Solution) -> (Class, [u32; 2]) {
    (
        found.class,
        [found.near, found.far].map(|t| if t.is_nan() { 0 } else { t.to_bits() }),
    )
}

proptest! {
    #[test]
    fn moving_everything_changes_nothing((ray, sphere) in question(), by in vector()) {
        let moved = Ray { origin: ray.origin + glam::Vec3::from(by), ..ray };
        let along = Sphere { center: sphere.center + glam::Vec3::from(by), ..sphere };
        for method in Method::ALL {
            prop_assert_eq!(bits(method.solve(&ray, &sphere)), bits(method.solve(&moved, &along)));
        }
    }

    #[test]
    fn scaling_by_a_power_of_two_scales_the_roots((ray, sphere) in question(), k in -12_i32..=12) {
        let s = 2.0_f32.powi(k);
        let larger = Ray { origin: ray.origin * s, ..ray };
        let around = Sphere { center: sphere.center * s, radius: sphere.radius * s };
        for method in Method::ALL {
            let Solution { class, near, far, .. } = method.solve(&ray, &sphere);
            let expected = Solution::with_roots(class, near * s, far * s);
            prop_assert_eq!(bits(method.solve(&larger, &around)), bits(expected));
        }
    }

    #[test]
    fn turning_the_ray_swaps_and_negates_the_roots((ray, sphere) in question()) {
        let turned = Ray { direction: -ray.direction, ..ray };
        for method in Method::ALL {
            // With b = 0 the q-form takes +√D either way, and C/q is not q/A to the last bit.
            if method.coefficients(&ray, &sphere).b == 0.0 && method != Method::Textbook {
                continue;
            }
            let Solution { class, near, far, .. } = method.solve(&ray, &sphere);
            let expected = Solution::with_roots(class, -far, -near);
            prop_assert_eq!(bits(method.solve(&turned, &sphere)), bits(expected));
        }
    }

    #[test]
    fn the_nearer_root_comes_first((ray, sphere) in question()) {
        for method in Method::ALL {
            let Solution { class, near, far, .. } = method.solve(&ray, &sphere);
            prop_assert!(!class.meets() || near <= far, "{method}: {near} {far}");
            prop_assert!(class != Class::Tangent || near == far, "{method}: {near} {far}");
        }
    }

    /// p0 + t·d lies on the ray as it is; on the sphere it lies as near as t is to the root, along
    /// d, and the last rounding of t: |p − c| is off by |d|·|t|·(14 λ + 1)u at most.
    #[test]
    fn every_point_lies_on_the_sphere((ray, sphere) in question()) {
        let truth = Truth::new(&ray, &sphere);
        if truth.class() != Class::Secant {
            return Ok(());
        }
        for method in Method::ALL {
            let found = method.solve(&ray, &sphere);
            if found.class != Class::Secant || method == Method::Unit && !is_unit(&ray) {
                continue;
            }
            for (root, t) in [(truth.near(), found.near), (truth.far(), found.far)] {
                let root = root.unwrap();
                let sensitivity = sensitivity(&truth, &root, lengths(&ray, &sphere));
                if root.is_zero() || sensitivity > 16_384.0 {
                    continue;
                }
                let point = ray.origin.as_dvec3() + f64::from(t) * ray.direction.as_dvec3();
                let from_center = (point - sphere.center.as_dvec3()).length();
                let off = (from_center - f64::from(sphere.radius)).abs();
                let d = ray.direction.as_dvec3().length();
                let bound = d * root.to_f64().abs() * (14.0 * sensitivity + 1.0) * U;
                prop_assert!(off <= bound, "{method}: {off} > {bound}");
            }
        }
    }
}
