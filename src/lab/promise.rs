//! What two of the methods promise, and whether an answer keeps it. docs/stability.md derives the
//! bounds for `double`.

use super::Problem;
use super::reference::{Reference, ReferenceRoot};
use crate::method::{Class, Method, Solution};

/// u = 2⁻⁵³, the unit roundoff of binary64.
const U: f64 = f64::EPSILON / 2.0;

/// Whether the answer of a method is what it promises; none for methods that promise nothing.
///
/// * `exact`: the class is right, and both roots are the exact roots rounded once.
/// * `double`: the class is right if |D| > [`ErrorBounds::class`], and where it is, each root is at most
///   [`ErrorBounds::root`] and the rounding to binary32 away.
pub fn kept(
    method: Method,
    problem: &Problem,
    truth: &Reference,
    answer: &Solution,
) -> Option<bool> {
    match method {
        Method::Exact => Some(exact(truth, answer)),
        Method::Double => Some(double(&ErrorBounds::new(problem, truth), truth, answer)),
        _ => None,
    }
}

fn exact(truth: &Reference, answer: &Solution) -> bool {
    let expected = truth.solution;
    let bits = |s: &Solution| (s.near.to_bits(), s.far.to_bits());
    answer.class == expected.class && (!expected.class.meets() || bits(answer) == bits(&expected))
}

fn double(bounds: &ErrorBounds, truth: &Reference, answer: &Solution) -> bool {
    if answer.class != truth.class {
        return answer.class != Class::Nan && truth.quarter_discriminant.abs() <= bounds.class;
    }
    let roots = truth.roots.iter().flatten();
    roots
        .zip([answer.near, answer.far])
        .all(|(root, answer)| is_within(root, answer, bounds.root))
}

/// Whether a binary32 is the rounding of some number no farther than `bound` from the root.
fn is_within(root: &ReferenceRoot, answer: f32, bound: f64) -> bool {
    let [least, greatest] = [-bound, bound].map(|shift| (root.value() + shift) as f32);
    (least..=greatest).contains(&answer)
}

/// How far `double` may be off for one ray and sphere, u = 2⁻⁵³.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ErrorBounds {
    /// Of |D|: 8u·(A r² + K² + K·‖o‖·√A + 2u·A·‖o‖²) with K = ‖o × d‖.
    pub class: f64,
    /// Of t, before it is rounded to binary32: 32u·(‖o‖·r + r² + u·‖o‖²)/√D, and for a tangent
    /// 8u·‖o‖/√A.
    pub root: f64,
}

impl ErrorBounds {
    /// The bounds for a problem whose truth is known.
    pub fn new((ray, sphere): &Problem, truth: &Reference) -> Self {
        let o = ray.origin.as_dvec3() - sphere.center.as_dvec3();
        let a = ray.direction.as_dvec3().length_squared();
        let (r, oo) = (f64::from(sphere.radius), o.length_squared());
        let (distance, d) = (oo.sqrt(), truth.quarter_discriminant);
        let a_rr = a * r * r;
        // K² = A r² − D, and D is known best.
        let kk = (a_rr - d).max(0.0);
        Self {
            class: 8.0 * U * (a_rr + kk + (kk * a).sqrt() * distance + 2.0 * U * a * oo),
            root: match truth.class {
                Class::Tangent => 8.0 * U * distance / a.sqrt(),
                _ => 32.0 * U * (distance * r + r * r + U * oo) / d.sqrt(),
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::{Dial, Family};

    fn broken(problems: &[Problem], solve: impl Fn(&Problem) -> Solution, method: Method) -> usize {
        let broken = |problem: &&Problem| {
            kept(method, problem, &Reference::new(problem), &solve(problem)) == Some(false)
        };
        problems.iter().filter(broken).count()
    }

    #[test]
    fn both_promises_are_kept_in_every_family_and_at_every_setting() {
        let families = Family::ALL.iter().map(|family| family.sample(2, 100));
        let settings = Dial::ALL.iter().flat_map(|dial| {
            dial.settings()
                .map(|k| dial.sample(2, k, 6))
                .collect::<Vec<_>>()
        });
        for problems in families.chain(settings) {
            for method in [Method::Exact, Method::Double] {
                let solve = |(r, s): &Problem| method.solve(r, s);
                assert_eq!(broken(&problems, solve, method), 0, "{method}");
            }
        }
    }

    /// `double` with its root in error by `factor` times what is promised.
    fn worse_double(problem: &Problem, factor: f64) -> Solution {
        let truth = Reference::new(problem);
        let bound = ErrorBounds::new(problem, &truth).root;
        match truth.roots {
            None => Solution::MISS,
            Some(roots) => {
                let [near, far] = roots.map(|root| (root.value() + factor * bound) as f32);
                Solution::with_roots(truth.class, near, far)
            }
        }
    }

    #[test]
    fn a_broken_promise_is_noticed() {
        let typical = Family::ALL[0].sample(1, 100);
        let textbook = |(r, s): &Problem| Method::Textbook.solve(r, s);
        assert!(broken(&typical, textbook, Method::Exact) > 50);
        assert!(broken(&typical, textbook, Method::Double) > 50);
        // The bound has room, but not for two and a half times as much where it exceeds an ulp.
        let stiff = Dial::by_name("altitude").unwrap().sample(1, -40, 100);
        assert_eq!(broken(&stiff, |p| worse_double(p, 0.99), Method::Double), 0);
        assert!(broken(&stiff, |p| worse_double(p, 2.5), Method::Double) > 50);
        let never = |_: &Problem| Solution::MISS;
        assert!(broken(&typical, never, Method::Double) > 50);
    }

    #[test]
    fn the_bounds_are_of_use() {
        // A class bound that excuses everything, or a root bound of many ulps, promises nothing.
        for problem in Family::ALL[0].sample(1, 100) {
            let truth = Reference::new(&problem);
            let bounds = ErrorBounds::new(&problem, &truth);
            let [a, r] = [problem.0.direction.length_squared(), problem.1.radius];
            assert!(bounds.class < 1e-12 * f64::from(a * r * r));
            if let Some([_, far]) = truth.roots {
                assert!(bounds.root < 1e-9 * far.value().abs(), "{}", bounds.root);
            }
        }
    }
}
