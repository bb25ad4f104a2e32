//! `exact` against the named cases and, by property, against the truth.

use glam::Vec3;
use proptest::prelude::*;
use rayscope::geometry::{Ray, Sphere};
use rayscope::method::exact::{self, Stage};
use rayscope::method::{Class, Method, Precision, Solution, Truth};

fn problem(x: [f32; 10]) -> Option<(Ray, Sphere)> {
    let ray = Ray::new(Vec3::from_slice(&x[0..]), Vec3::from_slice(&x[3..])).ok()?;
    let sphere = Sphere::new(Vec3::from_slice(&x[6..]), x[9]).ok()?;
    Some((ray, sphere))
}

fn bits(solution: Solution) -> (Class, Option<[u32; 2]>) {
    let roots = [solution.near, solution.far].map(f32::to_bits);
    (solution.class, solution.class.meets().then_some(roots))
}

fn assert_right(x: [f32; 10]) {
    if let Some((ray, sphere)) = problem(x) {
        let found = exact::solve(&ray, &sphere);
        let expected = Truth::new(&ray, &sphere).solution();
        assert_eq!(bits(found), bits(expected), "{ray:?} {sphere:?}");
    }
}

#[test]
fn gives_the_expected_answer_of_every_named_case() {
    let mut file = csv::Reader::from_path("tests/cases/named.csv").unwrap();
    let mut cases = 0;
    for row in file.records() {
        let row = row.unwrap();
        let x: Vec<f32> = (1..=10).map(|i| row[i].parse().unwrap()).collect();
        let (ray, sphere) = problem(x.try_into().unwrap()).unwrap();
        let found = Method::Exact.solve(&ray, &sphere);
        let roots = [&row[12], &row[13]].map(|t| t.parse::<f32>().ok().map(f32::to_bits));
        assert_eq!(found.class.name(), &row[11], "{}", &row[0]);
        assert_eq!(
            bits(found).1.map_or([None; 2], |roots| roots.map(Some)),
            roots,
            "{}",
            &row[0]
        );
        cases += 1;
    }
    assert_eq!(cases, 51);
}

/// Any bits; now and then a number that is special, or near one.
fn any_single() -> impl Strategy<Value = f32> {
    prop_oneof![
        6 => any::<u32>().prop_map(f32::from_bits),
        2 => (-20_i16..=20).prop_map(f32::from),
        1 => prop::sample::select(vec![0.0, -0.0, f32::MAX, f32::MIN, f32::MIN_POSITIVE]),
        1 => (0_u32..=3).prop_map(f32::from_bits),
    ]
}

/// ±fraction·2^exponent of few bits, so that cancellations are often complete.
fn short(exponents: std::ops::RangeInclusive<i32>) -> impl Strategy<Value = f32> {
    (-40_i16..=40, exponents).prop_map(|(m, e)| f32::from(m) * (e as f32).exp2())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    #[test]
    fn agrees_with_the_truth_for_any_bits(x in prop::array::uniform10(any_single())) {
        assert_right(x.map(|x| if x.is_finite() { x } else { 1.0 }));
    }

    #[test]
    fn agrees_with_the_truth_for_short_numbers(
        x in prop::array::uniform10(short(-3..=3)),
    ) {
        let mut x = x;
        x[9] = x[9].abs();
        assert_right(x);
    }

    #[test]
    fn agrees_with_the_truth_for_short_numbers_far_apart(
        x in prop::array::uniform10(short(-140..=120)),
    ) {
        let mut x = x;
        x[9] = x[9].abs();
        assert_right(x);
    }

    /// On a line through the axis of a sphere, with one coordinate next to a tangent's.
    #[test]
    fn agrees_with_the_truth_beside_tangents(
        r in any::<u32>(),
        (along, speed) in (any_single(), any_single()),
        (place, steps) in (0_usize..10, -2_i32..=2),
    ) {
        let r = f32::from_bits(r & 0x7fff_ffff);
        let mut x = [along, r, 0.0, speed, 0.0, 0.0, 0.0, 0.0, 0.0, r];
        for _ in 0..steps.unsigned_abs() {
            x[place] = if steps > 0 { x[place].next_up() } else { x[place].next_down() };
        }
        x[9] = x[9].abs();
        assert_right(x);
    }

    #[test]
    fn a_recorded_run_gives_the_answer_and_stages_of_the_plain_one(
        x in prop::array::uniform10(short(-30..=30)),
    ) {
        let mut x = x;
        x[9] = x[9].abs();
        if let Some((ray, sphere)) = problem(x) {
            let record = exact::record(&ray, &sphere);
            let (solution, stages) = exact::solve_staged(&ray, &sphere);
            prop_assert_eq!(bits(record.solution), bits(solution));
            prop_assert_eq!(bits(exact::solve(&ray, &sphere)), bits(solution));
            prop_assert_eq!(record.stages, stages);
            prop_assert_eq!(record.findings.first().map(|f| f.stage), Some(Stage::Binary64));
            prop_assert_eq!(record.findings.last().map(|f| f.stage), Some(stages.last()));
        }
    }

    #[test]
    fn gives_the_exact_coefficients_rounded_once(x in prop::array::uniform10(any_single())) {
        let Some((ray, sphere)) = problem(x) else { return Ok(()) };
        let found = exact::coefficients(&ray, &sphere);
        let truth = Truth::new(&ray, &sphere);
        let expected = [truth.a.clone(), truth.b(), truth.c.clone(), truth.discriminant()];
        let expected = expected.map(|x| rayscope::method::Surd::from(x).to_f64());
        prop_assert_eq!([found.a, found.b, found.c, found.discriminant], expected);
        prop_assert_eq!(found.precision, Precision::Binary64);
    }
}

#[test]
fn each_stage_settles_what_it_is_for() {
    let cases = [
        // The tutorial's pixel (20, 20).
        (
            [20., 20., 0., 0., 0., 1., 20., 20., 20., 10.],
            Stage::Binary64,
        ),
        // One and a half millimetres above a sphere of a thousand kilometres.
        (
            [0., 0.0015, 0., 0.3, -1., 0., 0., -1e6, 0., 1e6],
            Stage::Compensated,
        ),
        // The tutorial's tangent, pixel (30, 20).
        ([30., 20., 0., 0., 0., 1., 20., 20., 20., 10.], Stage::Plain),
        // From the surface, and a root half way between two binary32.
        ([1., 0., 0., -1., 0., 0., 0., 0., 0., 1.], Stage::Plain),
        (
            [-16_777_216., 0., 0., 1., 0., 0., 0., 0., 0., 1.],
            Stage::Plain,
        ),
        // A sphere of 10⁻²⁰ seen from 1 away.
        (
            [-1., 0.5e-20, 0., 1., 0., 0., 0., 0., 0., 1e-20],
            Stage::DoubleDouble,
        ),
        // Tangents tilted by the least subnormal, away and inward.
        ([-3., 1., 0., 1., 1e-45, 0., 0., 0., 0., 1.], Stage::Integer),
        (
            [-3., 1., 0., 1., -1e-45, 0., 0., 0., 0., 1.],
            Stage::Integer,
        ),
    ];
    for (x, expected) in cases {
        let (ray, sphere) = problem(x).unwrap();
        let (_, stages) = exact::solve_staged(&ray, &sphere);
        assert_eq!(stages.last(), expected, "{x:?}: {stages:?}");
        assert_right(x);
    }
}

#[test]
fn what_is_no_ray_or_sphere_gives_no_answer_and_no_panic() {
    let good = [20., 20., 0., 0., 0., 1., 20., 20., 20., 10.];
    for place in 0..10 {
        for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            let mut x: [f32; 10] = good;
            x[place] = bad;
            let ray = Ray {
                origin: Vec3::from_slice(&x[0..]),
                direction: Vec3::from_slice(&x[3..]),
            };
            let sphere = Sphere {
                center: Vec3::from_slice(&x[6..]),
                radius: x[9],
            };
            assert_eq!(exact::solve(&ray, &sphere).class, Class::Nan, "{x:?}");
        }
    }
    let (ray, sphere) = problem(good).unwrap();
    let still = Ray {
        direction: Vec3::ZERO,
        ..ray
    };
    assert_eq!(exact::solve(&still, &sphere).class, Class::Nan);
}
