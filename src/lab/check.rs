//! A routine held against the truth without a screen: slips that are known, answers that no rounding explains, and apart from
//! these what a right formula is weak at.

use glam::Vec3;
use serde::Serialize;

use super::errors::Errors;
use super::families::Family;
use super::reference::Reference;
use super::slip::Slip;
use super::{Problem, numbers};
use crate::geometry::{Ray, Sphere};
use crate::method::{Class, Method, Place, RoutineId, Solution};
use crate::random::Random;
use crate::routine::{AnswerKind, RealNote, listen};
use crate::text::hexadecimal;

/// How far off an answer may be, as a part of the sizes around, before it is no matter of rounding.
const TOLERANCE: f64 = 2e-3;
/// Of how many answers a slip must be the reason.
const MOST: f64 = 0.98;
/// Rays of each kind.
const RAYS: usize = 400;
/// Rays of a family, and the error in ulp that is a weakness.
const FAMILY_RAYS: usize = 512;
const WEAK_ULPS: f64 = 4096.0;

/// What was found.
#[derive(Debug, Clone, PartialEq)]
pub struct RoutineCheck {
    /// Whether no slip was made, and every plain ray is answered rightly up to rounding.
    pub right: bool,
    /// The slips that explain the answers.
    pub slips: Vec<Slip>,
    /// A ray whose answer no rounding explains.
    pub example: Option<(Problem, Solution, Solution)>,
    /// The first line whose value is none of the mathematics, from 1.
    pub line: Option<usize>,
    /// Families on which a right formula is far off, with what is wrong there.
    pub weaknesses: Vec<(&'static str, String)>,
}

/// Plain rays, far from any edge: what one does rightly is right up to rounding.
fn plain_rays() -> Vec<Problem> {
    let mut random = Random::new(16);
    let mut problems = Vec::new();
    let mut between = |from: f64, to: f64| random.uniform(from, to);
    while problems.len() < 3 * RAYS {
        let kind = problems.len() % 3;
        let vector = |between: &mut dyn FnMut(f64, f64) -> f64| {
            let v = [between(-1.0, 1.0), between(-1.0, 1.0), between(-1.0, 1.0)];
            Vec3::from(v.map(|x| x as f32))
        };
        let (center, d, side) = (
            vector(&mut between) * 4.0,
            vector(&mut between),
            vector(&mut between),
        );
        let r = between(0.6, 2.0) as f32;
        if d.length() < 0.2 || d.cross(side).length() < 0.1 {
            continue;
        }
        let d = d.normalize();
        let across = d.cross(side).normalize();
        // Kind 0 before the eye, 1 around it, 2 behind it; of those before, two of three are hit.
        let off = match kind {
            0 if problems.len() % 9 == 0 => between(1.2, 2.0),
            _ => between(0.0, 0.8),
        } as f32;
        let half = (1.0 - off * off).max(0.0).sqrt();
        let along = match kind {
            0 => -(half + between(0.5, 3.0) as f32),
            1 => half * between(-0.7, 0.7) as f32,
            _ => half + between(0.5, 3.0) as f32,
        };
        let origin = center + r * (off * across + along * d);
        if let (Ok(ray), Ok(sphere)) = (Ray::new(origin, d), Sphere::new(center, r)) {
            problems.push((ray, sphere));
        }
    }
    problems
}

/// Exact tangents along the axes, in small whole numbers: every right formula has Δ = 0.
fn tangents() -> Vec<Problem> {
    let mut problems = Vec::new();
    for i in 0..48_u8 {
        let r = f32::from(1 + i % 6);
        let center = Vec3::new(f32::from(i % 5), f32::from(i % 7), f32::from(i % 3));
        let axis = usize::from(i % 3);
        let mut off = Vec3::ZERO;
        off[(axis + 1) % 3] = if i % 2 == 0 { r } else { -r };
        let mut d = Vec3::ZERO;
        d[axis] = 1.0;
        let origin = center + off - d * f32::from(2 + i % 4) * r;
        if let (Ok(ray), Ok(sphere)) = (Ray::new(origin, d), Sphere::new(center, r)) {
            problems.push((ray, sphere));
        }
    }
    problems
}

/// Holds a routine against the truth.
pub fn check(id: RoutineId) -> RoutineCheck {
    let method = Method::Routine(id);
    let answers = id.answers();
    let problems = plain_rays();
    let mut wrong: Vec<(Problem, Solution, Solution)> = Vec::new();
    let mut negative = 0;
    for problem in &problems {
        let (ray, sphere) = problem;
        let given = method.solve(ray, sphere);
        let truth = Method::Exact.solve(ray, sphere);
        if answers == AnswerKind::Visible && given.class == Class::Hit && given.near < 0.0 {
            negative += 1;
        }
        if !agrees(&given, &truth, answers) {
            wrong.push((*problem, given, truth));
        }
    }
    let mut slips: Vec<Slip> = Vec::new();
    if !wrong.is_empty() {
        slips.extend(
            Slip::ALL
                .into_iter()
                .find(|slip| explains(*slip, method, answers, &problems)),
        );
    }
    if slips.is_empty() && negative > 0 {
        let others = wrong
            .iter()
            .filter(|(_, given, _)| given.near >= 0.0 || given.class != Class::Hit);
        if others.count() == 0 {
            slips.push(Slip::NegativeT);
        }
    }
    let missed = |(ray, sphere): &Problem| method.solve(ray, sphere).class == Class::Miss;
    if slips.is_empty() && wrong.is_empty() && tangents().iter().all(missed) {
        slips.push(Slip::TangentIsAMiss);
    }
    let right = slips.is_empty() && wrong.is_empty();
    let example = wrong.first().copied();
    let line = match (&example, right) {
        (Some((problem, ..)), false) => {
            // A length other than 1 tells A from 1 and 2A from 2.
            let (mut ray, sphere) = *problem;
            ray.direction *= 1.75;
            parting_line(id, problem).or_else(|| parting_line(id, &(ray, sphere)))
        }
        _ => None,
    };
    let weaknesses = if right {
        weaknesses(method)
    } else {
        Vec::new()
    };
    RoutineCheck {
        right,
        slips,
        example,
        line,
        weaknesses,
    }
}

fn near_to(given: f32, wanted: f64, size: f64) -> bool {
    (f64::from(given) - wanted).abs() <= TOLERANCE * (wanted.abs() + size)
}

/// Whether an answer is the truth's up to rounding.
fn agrees(given: &Solution, truth: &Solution, answers: AnswerKind) -> bool {
    let seen = truth.visible();
    match answers {
        // Behind the eye, either is fine.
        AnswerKind::Whether => {
            truth.place() == Some(Place::Behind) || given.class.meets() == truth.class.meets()
        }
        AnswerKind::Visible => match (given.visible(), seen) {
            (Some(t), Some(wanted)) => near_to(t, wanted.into(), 0.1),
            (None, None) => given.class != Class::Nan,
            _ => false,
        },
        AnswerKind::Roots => {
            given.class.meets() == truth.class.meets()
                && given.class != Class::Nan
                && (!truth.class.meets()
                    || near_to(given.near, truth.near.into(), 0.1) && near_to(given.far, truth.far.into(), 0.1))
                // What says by a bool that it sees nothing behind the eye is fine.
                || !given.class.meets() && truth.place() == Some(Place::Behind)
        }
    }
}

/// Whether the answers are those of the slip.
fn explains(slip: Slip, method: Method, answers: AnswerKind, problems: &[Problem]) -> bool {
    let mut asked = 0;
    let mut found = 0;
    for problem in problems {
        let (ray, sphere) = problem;
        let x = numbers(problem).map(f64::from);
        let o = [x[0] - x[6], x[1] - x[7], x[2] - x[8]];
        let Some((discriminant, [near, far])) = slip.formula(o, [x[3], x[4], x[5]], x[9]) else {
            return false;
        };
        let given = method.solve(ray, sphere);
        asked += 1;
        let meets = discriminant >= 0.0;
        let fits = match answers {
            AnswerKind::Whether => given.class.meets() == meets,
            AnswerKind::Roots if meets => {
                let says_none = !given.class.meets() && near.max(far) <= 0.0;
                says_none || near_to(given.near, near, 0.1) && near_to(given.far, far, 0.1)
            }
            AnswerKind::Roots => !given.class.meets(),
            AnswerKind::Visible => {
                let seen = [near, far].into_iter().find(|t| *t > 0.0);
                let t = f64::from(given.near);
                match given.class {
                    Class::Hit => {
                        meets
                            && [Some(near), seen]
                                .into_iter()
                                .flatten()
                                .any(|wanted| near_to(t as f32, wanted, 0.1))
                    }
                    _ => !meets || seen.is_none() || near <= 0.0,
                }
            }
        };
        found += usize::from(fits);
    }
    f64::from(found as u32) >= MOST * f64::from(asked as u32)
}

/// The first line with a value that is none of the mathematics.
fn parting_line(id: RoutineId, problem: &Problem) -> Option<usize> {
    let x = numbers(problem).map(f64::from);
    let [p0, d, c] = [[x[0], x[1], x[2]], [x[3], x[4], x[5]], [x[6], x[7], x[8]]];
    let r = x[9];
    let o = [p0[0] - c[0], p0[1] - c[1], p0[2] - c[2]];
    let dot = |u: [f64; 3], v: [f64; 3]| u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
    let (a, b, oo) = (dot(d, d), dot(d, o), dot(o, o));
    let reduced = b * b - a * (oo - r * r);
    let s = reduced.max(0.0).sqrt();
    let foot = oo - b * b / a;
    let q = [-b - s, -b + s];
    let numbers = [
        a,
        a.sqrt(),
        b,
        2.0 * b,
        -b,
        -2.0 * b,
        oo,
        oo.sqrt(),
        r,
        r * r,
        oo - r * r,
        b * b,
        4.0 * b * b,
        a * (oo - r * r),
        4.0 * a * (oo - r * r),
        reduced,
        4.0 * reduced,
        s,
        2.0 * s,
        -s,
        q[0] / a,
        q[1] / a,
        q[0],
        q[1],
        2.0 * q[0],
        2.0 * q[1],
        2.0 * a,
        1.0 / a,
        0.5 / a,
        b / a,
        -b / a,
        foot,
        foot.max(0.0).sqrt(),
        r * r - foot,
        (r * r - foot).max(0.0).sqrt(),
        0.0,
        1.0,
        -1.0,
        s / a,
    ];
    let known = |value: f64| {
        numbers
            .iter()
            .any(|n| (n - value).abs() <= TOLERANCE * (n.abs() + 0.01))
    };
    let notes = listen(
        &id.get().program,
        [p0, d, c].map(|v| v.map(|x| x as f32)),
        r as f32,
    );
    let odd =
        |note: &&RealNote| note.values.len() <= 2 && note.values.iter().any(|value| !known(*value));
    notes.iter().find(odd).map(|note| note.line)
}

/// Families on which the answers are wrong, or far off.
fn weaknesses(method: Method) -> Vec<(&'static str, String)> {
    let mut found = Vec::new();
    for family in Family::ALL {
        let problems = family.sample(1, FAMILY_RAYS);
        let references = Reference::all(&problems);
        let errors = Errors::of(&problems, &references, |r, s| method.solve(r, s));
        let wrong = errors.wrong.total();
        if wrong > 0 {
            found.push((
                family.name,
                format!("{wrong} of {} answers wrong", problems.len()),
            ));
        } else if errors.ulp.p99 > WEAK_ULPS {
            found.push((
                family.name,
                format!("99 % within {:.0} ulp", errors.ulp.p99),
            ));
        }
    }
    found
}

#[derive(Serialize)]
struct RoutineCheckJson<'a> {
    routine: &'a str,
    verdict: &'static str,
    slips: Vec<&'static str>,
    line: Option<usize>,
    weaknesses: Vec<&'static str>,
    example: Option<[String; 10]>,
}

/// What was found, as one JSON object.
pub fn json(name: &str, check: &RoutineCheck) -> String {
    crate::report::json(&RoutineCheckJson {
        routine: name,
        verdict: if check.right { "right" } else { "wrong" },
        slips: check.slips.iter().map(|slip| slip.name()).collect(),
        line: check.line,
        weaknesses: check.weaknesses.iter().map(|(name, _)| *name).collect(),
        example: check
            .example
            .map(|(problem, ..)| numbers(&problem).map(hexadecimal)),
    })
}
