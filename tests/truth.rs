//! The truth against the named cases and against properties that need no second computation.

use std::cmp::Ordering;

use dashu_int::IBig;
use glam::Vec3;
use proptest::prelude::*;
use rayscope::geometry::{Ray, Sphere};
use rayscope::method::{Class, Dyadic, Surd, Truth, ulp_error};
use rayscope::text::read;

#[test]
fn gives_the_expected_answer_of_every_named_case() {
    let mut file = csv::Reader::from_path("tests/cases/named.csv").unwrap();
    let mut cases = 0;
    for row in file.records() {
        let row = row.unwrap();
        let x: Vec<f32> = (1..=10).map(|i| row[i].parse().unwrap()).collect();
        let ray = Ray::new(Vec3::from_slice(&x[0..]), Vec3::from_slice(&x[3..])).unwrap();
        let sphere = Sphere::new(Vec3::from_slice(&x[6..]), x[9]).unwrap();
        let found = Truth::new(&ray, &sphere).solution();
        assert_eq!(found.class.name(), &row[11], "{}", &row[0]);
        if found.class != Class::Miss {
            let expected = [&row[12], &row[13]].map(|t| t.parse::<f32>().unwrap().to_bits());
            let found = [found.near.to_bits(), found.far.to_bits()];
            assert_eq!(found, expected, "{}", &row[0]);
        }
        cases += 1;
    }
    assert_eq!(cases, 51);
}

#[test]
fn knows_the_tutorials_pixel() {
    let ray = Ray::new(Vec3::new(20.0, 20.0, 0.0), Vec3::Z).unwrap();
    let sphere = Sphere::new(Vec3::splat(20.0), 10.0).unwrap();
    let truth = Truth::new(&ray, &sphere);
    let values = [
        truth.a.clone(),
        truth.b(),
        truth.c.clone(),
        truth.discriminant(),
    ];
    assert_eq!(values, [1.0, -40.0, 300.0, 400.0].map(|x: f32| x.into()));
    let near = truth.near().unwrap();
    assert_eq!(ulp_error(10.0, &near), 0.0);
    assert_eq!(ulp_error(10.0_f32.next_up(), &near), 1.0);
    // (1·100 + 40·10 + 300)/(10·20)
    assert_eq!(truth.condition(&near), Some(4.0));
    assert_eq!(truth.blame(&near, 10.0), Some(0.0));
}

/// A binary32 as an exact number, with ±∞ as the ±2¹²⁸ at which rounding places them.
fn exactly(x: f32) -> Dyadic {
    Dyadic::from_f64(if x.is_infinite() {
        2.0_f64.powi(128).copysign(x.into())
    } else {
        x.into()
    })
    .unwrap()
}

/// How the root t on the given side compares with m, by the signs of f(m) = Am² + 2bm + C and
/// g(m) = Am + b = f′(m)/2 alone: t is beyond the vertex where g = 0.
fn compare(truth: &Truth, far: bool, m: &Dyadic) -> Ordering {
    let g = &(&truth.a * m) + &truth.half_b;
    let f = &(&(&g + &truth.half_b) * m) + &truth.c;
    if far {
        if g < Dyadic::ZERO {
            Ordering::Greater
        } else {
            f.sign().reverse()
        }
    } else if g > Dyadic::ZERO {
        Ordering::Less
    } else {
        f.sign()
    }
}

/// Whether `rounded` is the root rounded to nearest, ties to even.
fn rounds_to(truth: &Truth, far: bool, rounded: f32) -> bool {
    let even = rounded.to_bits().is_multiple_of(2);
    let beyond = |neighbour: f32| {
        let middle = (&exactly(rounded) + &exactly(neighbour)).shifted(-1);
        compare(truth, far, &middle)
    };
    let above_lower = rounded == f32::NEG_INFINITY
        || match beyond(rounded.next_down()) {
            Ordering::Greater => true,
            Ordering::Equal => even,
            Ordering::Less => false,
        };
    let below_upper = rounded == f32::INFINITY
        || match beyond(rounded.next_up()) {
            Ordering::Less => true,
            Ordering::Equal => even,
            Ordering::Greater => false,
        };
    above_lower && below_upper
}

fn any_bits() -> impl Strategy<Value = f32> {
    any::<u32>()
        .prop_map(f32::from_bits)
        .prop_filter("finite", |x| x.is_finite())
}

/// Few bits and near exponents: hits, tangents and ties turn up often.
fn small() -> impl Strategy<Value = f32> {
    (-20_i16..=20, -2_i32..=2).prop_map(|(m, e)| f32::from(m) * 2.0_f32.powi(e))
}

fn coordinates() -> impl Strategy<Value = [f32; 10]> {
    prop_oneof![
        prop::array::uniform10(any_bits()),
        prop::array::uniform10(small()),
        prop::array::uniform10(-3.0_f32..3.0),
        prop::array::uniform10(prop_oneof![small(), any_bits(), Just(0.0)]),
    ]
}

proptest! {
    #[test]
    fn rounds_to_the_nearest_binary32(x in coordinates()) {
        let ray = Ray::new(Vec3::from_slice(&x[0..]), Vec3::from_slice(&x[3..]));
        let sphere = Sphere::new(Vec3::from_slice(&x[6..]), x[9].abs()).unwrap();
        prop_assume!(ray.is_ok());
        let truth = Truth::new(&ray.unwrap(), &sphere);
        let found = truth.solution();
        if found.class == Class::Miss {
            prop_assert!(truth.near().is_none() && found.near.is_nan());
            return Ok(());
        }
        prop_assert!(found.near <= found.far);
        for (root, far, rounded) in
            [(truth.near(), false, found.near), (truth.far(), true, found.far)]
        {
            let off = ulp_error(rounded, &root.unwrap());
            prop_assert!(off <= 0.5, "{rounded} is {off} ulp from the root");
            prop_assert!(rounds_to(&truth, far, rounded), "{rounded}");
            prop_assert!(rounded == f32::INFINITY || !rounds_to(&truth, far, rounded.next_up()));
        }
    }
}

/// Hexadecimal digits, the place of the point among them, and a power of two.
fn hexadecimals() -> impl Strategy<Value = (String, usize, i32)> {
    let power = prop_oneof![-200..200, -1200..1200_i32];
    // Halfway between two numbers of either format, and a little beside.
    let halfway = (
        prop_oneof![Just(24_u32), Just(53)],
        any::<u64>(),
        "0{0,20}1?",
    )
        .prop_map(|(bits, m, rest)| format!("{:x}{rest}", m >> (63 - bits) | 1 << bits | 1));
    let digits = prop_oneof!["[0-9a-f]{1,40}".prop_map(String::from), halfway];
    (digits, 0..40_usize, power)
}

fn of_digits(digits: &str, point: usize, power: i32) -> Dyadic {
    let mantissa = IBig::from_str_radix(digits, 16).unwrap();
    let places = digits.len() - point.min(digits.len());
    Dyadic::new(mantissa, i64::from(power) - 4 * places as i64)
}

/// Whether no neighbour of `x` is nearer to `exact`, or as near and even.
fn is_nearest(exact: &Dyadic, x: f64, [down, up]: [f64; 2], is_even: bool) -> bool {
    let off = |y: f64| (exact - &Dyadic::from_f64(y).unwrap()).abs();
    [down, up]
        .into_iter()
        .filter(|y| y.is_finite())
        .all(|y| match off(x).cmp(&off(y)) {
            Ordering::Less => true,
            Ordering::Equal => is_even,
            Ordering::Greater => false,
        })
}

proptest! {
    #[test]
    fn hexadecimal_digits_are_rounded_once((digits, point, power) in hexadecimals()) {
        let exact = of_digits(&digits, point, power);
        let (whole, fraction) = digits.split_at(point.min(digits.len()));
        let text = format!("0x{whole}.{fraction}p{power:+}");
        // Big rationals have a rounding of their own.
        let surd = Surd::from(exact.clone());
        prop_assert_eq!(read::binary32(&text), Some(surd.to_f32()), "{}", &text);
        let minus = format!("−{}", text.to_uppercase().replace('−', "-"));
        prop_assert_eq!(read::binary32(&minus), Some(-surd.to_f32()), "{}", &minus);
        prop_assert_eq!(read::binary64(&text), Some(surd.to_f64()), "{}", &text);
        // And by the definition: nothing that binary32 has is nearer.
        let x = read::binary32(&text).unwrap();
        if x.is_finite() {
            let neighbours = [x.next_down(), x.next_up()].map(f64::from);
            prop_assert!(is_nearest(&exact, x.into(), neighbours, x.to_bits().is_multiple_of(2)));
        }
    }
}
