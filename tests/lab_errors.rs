//! What the laboratory says of errors, against arithmetic of its own: whole numbers and nothing of
//! the library but the inputs. A method that is broken on purpose must be caught.

use dashu_int::ops::{Abs, BitTest, SquareRoot};
use dashu_int::{IBig, UBig};
use glam::Vec3;
use rayscope::geometry::{Ray, Sphere};
use rayscope::lab::{Census, Errors, Family, Fault, Judgement, Problem, Reference, judge, numbers};
use rayscope::method::{Class, Method, Solution};

/// x·2¹⁴⁹, a whole number for every finite binary32.
fn whole(x: f32) -> IBig {
    let bits = x.to_bits();
    let fraction = IBig::from(bits & 0x7f_ffff);
    let magnitude = match (bits >> 23) & 0xff {
        0 => fraction,
        biased => (fraction + IBig::from(1 << 23)) << (biased as usize - 1),
    };
    if x < 0.0 { -magnitude } else { magnitude }
}

/// A·2²⁹⁸, b·2²⁹⁸, C·2²⁹⁸.
fn coefficients(problem: &Problem) -> [IBig; 3] {
    let [ox, oy, oz, dx, dy, dz, cx, cy, cz, r] = numbers(problem).map(whole);
    let o = [ox - cx, oy - cy, oz - cz];
    let d = [dx, dy, dz];
    let dot = |u: &[IBig; 3], v: &[IBig; 3]| &u[0] * &v[0] + &u[1] * &v[1] + &u[2] * &v[2];
    [dot(&d, &d), dot(&d, &o), dot(&o, &o) - &r * &r]
}

/// How far the fixed point reaches: 2⁻⁹⁰⁰ is far below every root's last bit.
const PLACES: usize = 900;

/// The class, and both roots times 2⁹⁰⁰ cut off to whole numbers.
fn truth(problem: &Problem) -> (Class, Option<[IBig; 2]>) {
    let [a, b, c] = coefficients(problem);
    let d = &b * &b - &a * &c;
    let class = match &d {
        d if *d < IBig::ZERO => return (Class::Miss, None),
        d if *d == IBig::ZERO => Class::Tangent,
        _ => Class::Secant,
    };
    let square = UBig::try_from(d << (2 * PLACES)).unwrap();
    let root = IBig::from(square.sqrt());
    let minus_b = -b << PLACES;
    (
        class,
        Some([(&minus_b - &root) / &a, (&minus_b + &root) / &a]),
    )
}

/// |answer − root| over the spacing of binary32 at the root.
fn ulps(answer: f32, root: &IBig) -> f64 {
    let error = ((whole(answer) << (PLACES - 149)) - root).abs();
    let floor_log2 = root.clone().abs().bit_len() as i64 - 1 - PLACES as i64;
    let spacing = floor_log2.max(-126) - 23;
    // The leading 60 bits are enough.
    let drop = error.bit_len().saturating_sub(60);
    let head = i64::try_from(error >> drop).unwrap() as f64;
    head * ((drop as i64 - PLACES as i64 - spacing) as f64).exp2()
}

/// Whether binary32 rounds the root to ±∞: from (2 − 2⁻²⁴)·2¹²⁷ on.
fn past_the_range(root: &IBig) -> bool {
    root.clone().abs() >= (IBig::from((1 << 25) - 1) << (127 - 24 + PLACES))
}

/// The judgement, worked out once more from the definitions.
fn judged_again(problem: &Problem, answer: &Solution) -> Result<Option<f64>, Fault> {
    let (class, roots) = truth(problem);
    match (class.meets(), answer.class) {
        (_, Class::Nan) => return Err(Fault::NotFinite),
        (true, Class::Miss) => return Err(Fault::FalseMiss),
        (false, Class::Tangent | Class::Secant) => return Err(Fault::FalseHit),
        (true, found) if found != class => return Err(Fault::WrongCount),
        _ => {}
    }
    let mut worse = None;
    for (root, answer) in roots.iter().flatten().zip([answer.near, answer.far]) {
        let negative = *root < IBig::ZERO;
        if answer.is_infinite() && past_the_range(root) && negative == (answer < 0.0) {
            continue;
        }
        if !answer.is_finite() {
            return Err(Fault::NotFinite);
        }
        let error = ulps(answer, root);
        worse = Some(worse.map_or(error, |worse: f64| worse.max(error)));
    }
    Ok(worse)
}

/// Holds the report of `solve` on `problems` against one worked out again.
fn assert_reported(name: &str, problems: &[Problem], solve: impl Fn(&Ray, &Sphere) -> Solution) {
    let reported = Errors::of(problems, &Reference::all(problems), &solve);
    let mut faults = [0; 4];
    let mut errors = Vec::new();
    for problem in problems {
        match judged_again(problem, &solve(&problem.0, &problem.1)) {
            Err(fault) => faults[fault as usize] += 1,
            Ok(error) => errors.extend(error),
        }
    }
    assert_eq!(
        Fault::ALL.map(|fault| reported.wrong.of(fault)),
        faults,
        "{name}"
    );
    assert_eq!(reported.judged, errors.len(), "{name}");
    errors.sort_by(f64::total_cmp);
    let rank = |q: f64| match errors.len() {
        0 => 0.0,
        n => errors[((q * n as f64 - 1e-9).ceil() as usize).clamp(1, n) - 1],
    };
    let ulp = reported.ulp;
    for (found, q) in [
        (ulp.p50, 0.5),
        (ulp.p99, 0.99),
        (ulp.p999, 0.999),
        (ulp.max, 1.0),
    ] {
        let expected = rank(q);
        assert!(
            (found - expected).abs() <= 1e-14 * expected,
            "{name}: {found} at {q}, expected {expected}"
        );
    }
    if let Some(worst) = reported.worst {
        let (ray, sphere) = worst.problem;
        let again = judged_again(&worst.problem, &solve(&ray, &sphere)).unwrap();
        assert!(
            (again.unwrap() - ulp.max).abs() <= 1e-14 * ulp.max,
            "{name}"
        );
    }
}

fn problem(x: [f32; 10]) -> Problem {
    let ray = Ray::new(Vec3::from_slice(&x[0..]), Vec3::from_slice(&x[3..])).unwrap();
    (ray, Sphere::new(Vec3::from_slice(&x[6..]), x[9]).unwrap())
}

#[test]
fn reports_what_arithmetic_in_whole_numbers_finds_in_every_family() {
    for family in Family::ALL {
        let problems = family.sample(11, 60);
        for method in Method::ALL {
            let name = format!("{method} on {}", family.name);
            assert_reported(&name, &problems, |r, s| method.solve(r, s));
        }
    }
}

#[test]
fn reports_what_arithmetic_in_whole_numbers_finds_in_the_named_cases() {
    let mut file = csv::Reader::from_path("tests/cases/named.csv").unwrap();
    let problems: Vec<Problem> = file
        .records()
        .map(|row| {
            let row = row.unwrap();
            let x: Vec<f32> = (1..=10).map(|i| row[i].parse().unwrap()).collect();
            problem(x.try_into().unwrap())
        })
        .collect();
    for method in Method::ALL {
        assert_reported(method.name(), &problems, |r, s| method.solve(r, s));
    }
}

#[test]
fn a_method_that_is_broken_on_purpose_is_caught_in_its_very_kind_of_fault() {
    let problems = Family::by_name("typical").unwrap().sample(5, 200);
    let truths = Reference::all(&problems);
    let census = Census::of(&truths);
    assert!(census.miss > 20 && census.meet() > 20);
    let of = |solve: &dyn Fn(Solution) -> Solution| {
        Errors::of(&problems, &truths, |r, s| solve(Method::Exact.solve(r, s)))
    };

    let right = of(&|answer| answer);
    assert_eq!(right.wrong.total(), 0);
    assert_eq!(right.judged, census.meet());
    assert!(right.ulp.max <= 0.5 && right.ulp.p50 > 0.0);

    let always_hits = of(&|_| Solution::with_roots(Class::Secant, 1.0, 2.0));
    assert_eq!(always_hits.wrong.false_hit, census.miss);
    assert_eq!(always_hits.wrong.total(), census.miss);
    assert_eq!(always_hits.first_wrong.unwrap().1, Fault::FalseHit);

    let never_hits = of(&|_| Solution::MISS);
    assert_eq!(never_hits.wrong.false_miss, census.meet());
    assert_eq!(never_hits.judged, 0);

    let tangent = of(&|mut answer| {
        if answer.class == Class::Secant {
            answer.class = Class::Tangent;
        }
        answer
    });
    assert_eq!(tangent.wrong.wrong_count, census.secant);

    for not_finite in [f32::NAN, f32::INFINITY] {
        let lost =
            of(&|Solution { class, near, .. }| Solution::with_roots(class, near, not_finite));
        assert_eq!(lost.wrong.not_finite, census.meet(), "{not_finite}");
    }

    let off =
        of(&|Solution {
                 class, near, far, ..
             }| { Solution::with_roots(class, near.next_up().next_up(), far) });
    assert!(off.ulp.p50 >= 1.5 && off.ulp.max <= 5.0, "{:?}", off.ulp);
    assert_ne!(off.checksum, right.checksum);
}

#[test]
fn a_rightly_infinite_root_is_neither_a_fault_nor_an_error() {
    // The roots are 2¹²⁸ ± r/d, about 3.4e38 + 0.5e38: past the range, the near one not.
    let problem = problem([-3e38, 0.0, 0.0, 1.0, 0.0, 0.0, 3e37, 0.0, 0.0, 2e37]);
    let truth = Reference::new(&problem);
    let exact = Method::Exact.solve(&problem.0, &problem.1);
    assert!(
        exact.near.is_finite() && exact.far == f32::INFINITY,
        "{exact:?}"
    );
    assert!(matches!(judge(&truth, &exact), Judgement::Agreed(Some(error)) if error.ulps <= 0.5));
    let both = Solution::with_roots(exact.class, f32::INFINITY, exact.far);
    assert_eq!(judge(&truth, &both), Judgement::Wrong(Fault::NotFinite));
    let other_side = Solution::with_roots(exact.class, exact.near, f32::NEG_INFINITY);
    assert_eq!(
        judge(&truth, &other_side),
        Judgement::Wrong(Fault::NotFinite)
    );
}

#[test]
fn the_least_subnormal_is_the_unit_at_zero() {
    let problem = problem([-1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]);
    let [near, far] = Reference::new(&problem).roots.unwrap();
    assert_eq!(near.ulps(f32::from_bits(3)), 3.0);
    assert_eq!(near.blame(f32::from_bits(3)), None);
    assert_eq!(far.ulps(2.0_f32.next_down()), 0.5);
}
