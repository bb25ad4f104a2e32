//! What must hold besides: answers that scale with the scene bit for bit, and answers that are
//! defined where textbooks are silent.

use crate::geometry::{Ray, Sphere};
use crate::lab::families::Family;
use crate::lab::{Problem, Reference};
use crate::method::{Method, Solution};
use crate::number::power_of_two;

/// One thing that must hold, for one method.
#[derive(Debug, Clone, PartialEq)]
pub struct Check {
    /// What must hold.
    pub name: &'static str,
    /// For which method.
    pub method: Method,
    /// On how many rays it was tried.
    pub rays: usize,
    /// On how many of them it did not hold.
    pub failed: usize,
    /// The first of these.
    pub first: Option<Problem>,
}

/// How many rays each check has.
const RAYS: usize = 400;

/// All checks for all methods.
pub(super) fn checks(methods: &[Method], seed: u64) -> Vec<Check> {
    let typical = rays_of("typical", seed);
    let behind: Vec<Problem> = typical.iter().map(turned_round).collect();
    let mut checks = Vec::new();
    for &method in methods {
        checks.push(check(SCALE, method, &typical, |p| scales(method, p)));
        checks.push(check(LENGTH, method, &typical, |p| keeps_length(method, p)));
        let mut defined = |name, problems: &[Problem]| {
            checks.push(check(name, method, problems, |p| is_defined(method, p)));
        };
        defined(
            "inside: a root each side of the eye",
            &rays_of("inside", seed),
        );
        defined(
            "on the surface: one root is 0",
            &rays_of("surface-exact", seed),
        );
        defined("behind: both roots below 0", &behind);
        defined("r = 0: a tangent or a miss", &rays_of("point", seed));
        defined(
            "subnormal numbers: the right class",
            &rays_of("subnormal", seed),
        );
        defined("near overflow: the right class", &rays_of("overflow", seed));
    }
    // One row a check, the methods side by side.
    checks.sort_by_key(|check| NAMES.iter().position(|name| *name == check.name));
    checks
}

const SCALE: &str = "p0, c, r times 2^±40: t times 2^±40";
const LENGTH: &str = "d times 2^±40: t times 2^∓40";

/// The checks in the order of the report.
pub(super) const NAMES: [&str; 8] = [
    SCALE,
    LENGTH,
    "inside: a root each side of the eye",
    "on the surface: one root is 0",
    "behind: both roots below 0",
    "r = 0: a tangent or a miss",
    "subnormal numbers: the right class",
    "near overflow: the right class",
];

fn rays_of(family: &str, seed: u64) -> Vec<Problem> {
    Family::by_name(family).map_or(Vec::new(), |family| family.sample(seed, RAYS))
}

fn check(
    name: &'static str,
    method: Method,
    problems: &[Problem],
    holds: impl Fn(&Problem) -> bool,
) -> Check {
    let failed: Vec<&Problem> = problems.iter().filter(|p| !holds(p)).collect();
    Check {
        name,
        method,
        rays: problems.len(),
        failed: failed.len(),
        first: failed.first().copied().copied(),
    }
}

fn turned_round((ray, sphere): &Problem) -> Problem {
    let ray = Ray {
        direction: -ray.direction,
        ..*ray
    };
    (ray, *sphere)
}

/// How far the invariances are tried: no intermediate of binary32 is subnormal or infinite there.
const SHIFT: i32 = 40;

fn scales(method: Method, (ray, sphere): &Problem) -> bool {
    [SHIFT, -SHIFT].into_iter().all(|k| {
        let factor = power_of_two(k) as f32;
        let scaled_ray = Ray {
            origin: ray.origin * factor,
            ..*ray
        };
        let scaled_sphere = Sphere {
            center: sphere.center * factor,
            radius: sphere.radius * factor,
        };
        let plain = method.solve(ray, sphere);
        same(
            &times(plain, factor),
            &method.solve(&scaled_ray, &scaled_sphere),
        )
    })
}

fn keeps_length(method: Method, (ray, sphere): &Problem) -> bool {
    [SHIFT, -SHIFT].into_iter().all(|k| {
        let longer = Ray {
            direction: ray.direction * power_of_two(k) as f32,
            ..*ray
        };
        let plain = method.solve(ray, sphere);
        let factor = power_of_two(-k) as f32;
        same(&times(plain, factor), &method.solve(&longer, sphere))
    })
}

fn times(answer: Solution, factor: f32) -> Solution {
    let Solution {
        class, near, far, ..
    } = answer;
    Solution::with_roots(class, near * factor, far * factor)
}

/// The same answer bit for bit.
fn same(one: &Solution, other: &Solution) -> bool {
    let bits = |s: &Solution| [s.near, s.far].map(f32::to_bits);
    one.class == other.class && (!one.class.meets() || bits(one) == bits(other))
}

/// Whether class and place are those of the truth and the roots are numbers. Of roots that round to 0 a
/// method that has both right need not know more than they say.
fn is_defined(method: Method, problem: &Problem) -> bool {
    let truth = Reference::new(problem).solution;
    let answer = method.solve(&problem.0, &problem.1);
    let numbers = !answer.near.is_nan() && !answer.far.is_nan();
    let place = answer.place() == truth.place() || same(&answer, &truth);
    answer.class == truth.class && place && (numbers || !truth.class.meets())
}
