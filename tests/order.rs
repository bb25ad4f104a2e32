//! Which sphere `exact` sees and where it lies, against integers of thousands of bits: not against rounded
//! roots, nor against anything that the program works with.

use std::cmp::Ordering;

use dashu_int::IBig;
use dashu_int::ops::SquareRootRem;
use glam::Vec3;
use proptest::prelude::*;
use rayscope::geometry::{Ray, Sphere};
use rayscope::method::{Method, Place};

/// Bits below the point of √D. Two different roots times A differ by more than 2⁻¹⁹⁰⁰ in the units
/// below: the product with their conjugates, each below 2⁶⁰⁰, is a whole number.
const BITS: usize = 2000;

/// A binary32 in units of 2⁻¹⁴⁹.
fn whole(x: f32) -> IBig {
    let bits = x.to_bits();
    let fraction = IBig::from(bits & 0x7f_ffff);
    let magnitude = match (bits >> 23 & 0xff) as usize {
        0 => fraction,
        exponent => (fraction + IBig::from(1_u32 << 23)) << (exponent - 1),
    };
    if x < 0.0 { -magnitude } else { magnitude }
}

fn dot(u: &[IBig; 3], v: &[IBig; 3]) -> IBig {
    &u[0] * &v[0] + &u[1] * &v[1] + &u[2] * &v[2]
}

/// A·near and A·far in units of 2⁻²⁹⁸⁻²⁰⁰⁰, to within a unit each; none for a miss.
fn roots(ray: &Ray, sphere: &Sphere) -> Option<[IBig; 2]> {
    let [p0, d, c] = [ray.origin, ray.direction, sphere.center].map(|v| v.to_array().map(whole));
    let o = [0, 1, 2].map(|i| &p0[i] - &c[i]);
    let r = whole(sphere.radius);
    let (a, b) = (dot(&d, &d), dot(&o, &d));
    let discriminant = &b * &b - &a * (dot(&o, &o) - &r * &r);
    if discriminant < IBig::ZERO {
        return None;
    }
    let (_, magnitude) = (discriminant << (2 * BITS)).into_parts();
    let root = IBig::from(magnitude.sqrt_rem().0);
    let b = b << BITS;
    Some([-&b - &root, root - b])
}

/// How two such numbers compare: equal if they are within their errors.
fn compare(one: &IBig, other: &IBig) -> Ordering {
    let apart = one - other;
    if apart > IBig::from(4) {
        Ordering::Greater
    } else if apart < IBig::from(-4) {
        Ordering::Less
    } else {
        Ordering::Equal
    }
}

/// Where the sphere lies and A times the visible root.
fn seen(ray: &Ray, sphere: &Sphere) -> Option<(Place, Option<IBig>)> {
    let [near, far] = roots(ray, sphere)?;
    let is_above = |root: &IBig| compare(root, &IBig::ZERO).is_gt();
    Some(if is_above(&near) {
        (Place::Hit, Some(near))
    } else if is_above(&far) {
        (Place::Inside, Some(far))
    } else {
        (Place::Behind, None)
    })
}

fn assert_like_integers(ray: &Ray, spheres: [&Sphere; 2]) -> Result<(), TestCaseError> {
    let found = spheres.map(|sphere| Method::Exact.solve(ray, sphere));
    let truth = spheres.map(|sphere| seen(ray, sphere));
    for i in 0..2 {
        let place = truth[i].as_ref().map(|(place, _)| *place);
        prop_assert_eq!(found[i].place(), place, "{:?} {:?}", ray, spheres[i]);
    }
    let expected = match truth.map(|seen| seen.and_then(|(_, root)| root)) {
        [Some(one), Some(other)] => compare(&one, &other),
        [one, other] => one.is_none().cmp(&other.is_none()),
    };
    let order = Method::Exact.order(ray, (spheres[0], found[0]), (spheres[1], found[1]));
    prop_assert_eq!(order, expected, "{:?} {:?}", ray, spheres);
    Ok(())
}

fn any_number() -> impl Strategy<Value = f32> {
    prop_oneof![
        (-8_i8..=8).prop_map(f32::from),
        -10.0_f32..10.0,
        (-10.0_f32..10.0, -120_i32..120).prop_map(|(x, k)| x * (k as f32).exp2()),
    ]
}

fn any_vector() -> impl Strategy<Value = Vec3> {
    prop::array::uniform3(any_number()).prop_map(Vec3::from)
}

fn any_sphere() -> impl Strategy<Value = Sphere> {
    (any_vector(), any_number()).prop_map(|(center, radius)| Sphere {
        center,
        radius: radius.abs(),
    })
}

/// A sphere that is all but the same, one that touches it from inside or outside, or any other.
fn any_other(sphere: Sphere) -> impl Strategy<Value = Sphere> {
    let near_by = (-2_i32..=2, 0_usize..4).prop_map(move |(steps, which)| {
        let mut other = sphere;
        let x = match which {
            3 => &mut other.radius,
            axis => &mut other.center[axis],
        };
        for _ in 0..steps.abs() {
            *x = if steps > 0 {
                x.next_up()
            } else {
                x.next_down()
            };
        }
        other.radius = other.radius.max(0.0);
        other
    });
    let touching = (0_usize..3, 0_u8..=4, any::<bool>()).prop_map(move |(axis, part, outside)| {
        let radius = sphere.radius * f32::from(part) / 4.0;
        let mut center = sphere.center;
        center[axis] += if outside {
            sphere.radius + radius
        } else {
            sphere.radius - radius
        };
        Sphere { center, radius }
    });
    let larger = (1.0_f32..3.0).prop_map(move |by| Sphere {
        radius: sphere.radius * by,
        ..sphere
    });
    prop_oneof![near_by, touching, larger, any_sphere()]
}

/// A ray that most often goes to a point of the sphere, often straight along an axis and from far away.
fn any_ray(sphere: Sphere) -> impl Strategy<Value = Ray> {
    let towards = (any_vector(), 0_usize..3).prop_map(move |(origin, axis)| {
        let mut target = sphere.center;
        target[axis] += sphere.radius;
        (origin, target - origin)
    });
    let straight = (any_number(), -30_i32..60, 0_usize..3, 0_usize..3).prop_map(
        move |(share, far, axis, off)| {
            let mut origin = sphere.center;
            origin[off] += sphere.radius * share / 8.0;
            origin[axis] -= (far as f32).exp2();
            (origin, Vec3::AXES[axis])
        },
    );
    let on_it = (any_vector(), 0_usize..3).prop_map(move |(direction, axis)| {
        let mut origin = sphere.center;
        origin[axis] += sphere.radius;
        (origin, direction)
    });
    prop_oneof![towards, straight, on_it, (any_vector(), any_vector())]
        .prop_filter_map("a ray", |(p0, d)| Ray::new(p0, d).ok())
}

fn any_case() -> impl Strategy<Value = (Ray, [Sphere; 2])> {
    any_sphere()
        .prop_flat_map(|sphere| (any_ray(sphere), any_other(sphere), Just(sphere)))
        .prop_filter_map("spheres", |(ray, other, sphere)| {
            let finite = |s: &Sphere| s.center.is_finite() && s.radius.is_finite();
            (finite(&sphere) && finite(&other)).then_some((ray, [sphere, other]))
        })
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: std::env::var("RAYSCOPE_FRAMES").map_or(4000, |n| n.parse().expect("a number")),
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn order_and_place_follow_from_exact_signs((ray, [one, other]) in any_case()) {
        assert_like_integers(&ray, [&one, &other])?;
        assert_like_integers(&ray, [&other, &one])?;
    }
}

fn sphere(center: [f32; 3], radius: f32) -> Sphere {
    Sphere::new(center.into(), radius).expect("a sphere")
}

#[test]
fn of_spheres_about_one_point_the_outer_one_is_seen_from_any_distance() {
    let [inner, outer] = [1.0, 1.2].map(|r| sphere([0.0; 3], r));
    let ray = Ray::new(Vec3::new(0.0, 0.0, 1e7), Vec3::NEG_Z).expect("a ray");
    let [found, found_outer] = [&inner, &outer].map(|s| Method::Exact.solve(&ray, s));
    assert_eq!(found.visible(), found_outer.visible());
    let order = Method::Exact.order(&ray, (&inner, found), (&outer, found_outer));
    assert_eq!(order, Ordering::Greater);
    // The others go by their own numbers.
    let order = Method::Double.order(&ray, (&inner, found), (&outer, found_outer));
    assert_eq!(order, Ordering::Equal);
}

#[test]
fn a_sphere_whose_roots_round_to_0_lies_in_front() {
    // Its roots are 2e-76 and 4e-76.
    let ray = Ray::new(Vec3::ZERO, Vec3::new(1e38, 0.0, 0.0)).expect("a ray");
    let ahead = sphere([3e-38, 0.0, 0.0], 1e-38);
    let found = Method::Exact.solve(&ray, &ahead);
    assert_eq!((found.near, found.far), (0.0, 0.0));
    assert_eq!(found.place(), Some(Place::Hit));
    assert_eq!(found.visible(), Some(0.0));
    let behind = sphere([-3e-38, 0.0, 0.0], 1e-38);
    assert_eq!(
        Method::Exact.solve(&ray, &behind).place(),
        Some(Place::Behind)
    );
    let around = sphere([0.0; 3], 1e-38);
    assert_eq!(
        Method::Exact.solve(&ray, &around).place(),
        Some(Place::Inside)
    );
}
