//! One exercise: what is given, what is asked, and what is right.

use super::super::{Digits, number};
use super::decimal::{DecimalFraction, WrittenNumber, rounded, rounded_to};
use super::question::{PaperAnswers, PaperQuestion};
use super::{Kind, ProblemPixel};
use crate::method::trace::Measured;
use crate::method::{Class, Method, Place, Precision};
use crate::scene::Scene;
use crate::text::Glyphs;

/// One exercise.
#[derive(Debug, Clone)]
pub(super) struct Exercise {
    pub pixel: (u32, u32),
    /// What it is about, in a few words that do not give it away.
    pub title: &'static str,
    /// What is given, a sentence a line.
    pub given: Vec<String>,
    /// What is asked, easy things first.
    pub tasks: Vec<Task>,
}

impl Exercise {
    /// Whether the other one gives the same numbers, though it may be of another pixel.
    pub fn has_the_numbers_of(&self, other: &Self) -> bool {
        self.given[1..] == other.given[1..]
    }
}

/// One thing that is asked.
#[derive(Debug, Clone)]
pub(super) struct Task {
    pub asked: String,
    pub answer: String,
    /// Lines of room to work it out.
    pub room: usize,
}

impl Task {
    fn new(asked: impl Into<String>, room: usize, answer: impl Into<String>) -> Self {
        let (asked, answer) = (asked.into(), answer.into());
        Self {
            asked,
            answer,
            room,
        }
    }
}

/// The exercise of a pixel, and how much work it is; none where its numbers are too long.
pub(super) fn of(scene: &Scene, candidate: &ProblemPixel) -> Option<(u32, Exercise)> {
    if candidate.kind == Kind::Rounding {
        return rounding(scene, candidate);
    }
    let bodies = candidate.bodies;
    let distinct = if bodies[0] == bodies[1] { 1 } else { 2 };
    let mut questions = Vec::new();
    for &body in &bodies[..distinct] {
        let sphere = &scene.bodies[body].sphere;
        let found = Method::Exact.solve(&candidate.ray, sphere);
        let question = PaperQuestion::new(&candidate.ray, sphere, found.class, found.place())?;
        questions.push((body, question));
    }
    // Both spheres are met by the one ray on the sheet: the one with more digits.
    if let [(_, first), (_, second)] = &mut questions[..] {
        let longer = if first.direction[0].places < second.direction[0].places {
            *second
        } else {
            *first
        };
        if first.radius.places != second.radius.places {
            return None;
        }
        for question in [first, second] {
            question.direction = longer.direction;
            question.origin = longer.origin;
        }
    }
    let mut solved = Vec::new();
    for (body, question) in questions {
        solved.push((body, question, question.answers()?));
    }
    let effort = solved.iter().map(|(_, q, a)| effort(q, a)).sum();
    let (body, question, answers) = &solved[0];
    let mut given = ray_given(candidate, question);
    let (title, tasks) = match candidate.kind {
        Kind::Along => ("Along a ray", along(question)),
        Kind::Two => {
            given.extend(solved.iter().map(|(b, q, _)| sphere_given(scene, *b, q)));
            let [first, second] = &solved[..] else {
                return None;
            };
            ("Two spheres on one line", two(first, second)?)
        }
        _ => {
            given.push(sphere_given(scene, *body, question));
            ("Ray and sphere", one(question, answers))
        }
    };
    let exercise = Exercise {
        pixel: candidate.pixel,
        title,
        given,
        tasks,
    };
    Some((effort, exercise))
}

/// How many digits a person has to handle.
fn effort(question: &PaperQuestion, answers: &PaperAnswers) -> u32 {
    let digits = |v: &[DecimalFraction]| v.iter().map(|x| x.digits()).sum::<u32>();
    let long_root = match answers.roots {
        Some([WrittenNumber::Near(_), _]) => 4,
        _ => 0,
    };
    digits(&question.direction)
        + digits(&answers.o)
        + digits(&[question.radius, answers.a, answers.b, answers.c])
        + digits(&[answers.discriminant])
        + long_root
}

fn vector(v: &[DecimalFraction; 3]) -> String {
    format!("({})", v.map(DecimalFraction::text).join(", "))
}

fn ray_given(candidate: &ProblemPixel, question: &PaperQuestion) -> Vec<String> {
    let (x, y) = candidate.pixel;
    let rounded = if question.own {
        ""
    } else {
        ", its numbers rounded"
    };
    let [p0, d] = [question.origin, question.direction].map(|v| vector(&v));
    vec![
        format!("The ray of pixel ({x}, {y}){rounded}:"),
        format!("p0 = {p0}   d = {d}"),
    ]
}

fn sphere_given(scene: &Scene, body: usize, question: &PaperQuestion) -> String {
    let name = match &scene.bodies[body].name {
        Some(name) => format!("Sphere {}, {name}", body + 1),
        None => format!("Sphere {}", body + 1),
    };
    let (c, r) = (vector(&question.center), question.radius.text());
    format!("{name}:  c = {c}   r = {r}")
}

fn along(question: &PaperQuestion) -> Vec<Task> {
    let d = question.direction;
    // The axis along which the ray gets on fastest, and where the sphere's centre is on it.
    let axis = (0..3).max_by_key(|&i| d[i].units.abs()).unwrap_or(2);
    let name = ["x", "y", "z"][axis];
    let target = question.center[axis];
    let way = target.units - question.origin[axis].units;
    let t = scaled_quotient(way, target.places, d[axis]);
    let points = [1, 2, 5].map(|t| {
        let whole = WrittenNumber::Exact(DecimalFraction {
            units: t,
            places: 0,
        });
        format!("p({t}) {}", at(question, whole, 7))
    });
    vec![
        Task::new(
            "Where is the ray at t = 1, at t = 2 and at t = 5?",
            3,
            points.join(",  "),
        ),
        Task::new(
            format!(
                "For which t is {name} = {}? Which point of the ray is that?",
                target.text()
            ),
            3,
            format!("t {},  p {}", t.equation(), visible_point(question, t)),
        ),
        Task::new(
            "Which points of this line have t < 0, and does the eye see them?",
            2,
            "Those behind p0; the eye, which looks along d, does not see them.",
        ),
    ]
}

/// units/10^places over a decimal.
fn scaled_quotient(units: i128, places: u32, by: DecimalFraction) -> WrittenNumber {
    let [up, down] = [by.places, places].map(super::decimal::power_of_ten);
    let sign = by.units.signum();
    WrittenNumber::quotient(sign * units * up, sign * by.units * down)
}

/// The point p0 + t·d of the sphere with its sign, in as many digits as its place on the sphere needs.
fn visible_point(question: &PaperQuestion, t: WrittenNumber) -> String {
    let greatest = question
        .center
        .map(|x| x.value().abs())
        .into_iter()
        .fold(0.0, f64::max);
    let times = (greatest / question.radius.value()) as u64;
    let digits = 5 + times.checked_ilog10().unwrap_or(0);
    at(question, t, digits.min(10) as usize)
}

/// The point p0 + t·d in at most this many digits: `= (1, 2, 3)`, or `≈` if one of them is rounded.
fn at(question: &PaperQuestion, t: WrittenNumber, digits: usize) -> String {
    let way = t.value();
    let point = [0, 1, 2].map(|i| question.origin[i].value() + way * question.direction[i].value());
    // A sum of decimals is off in its last binary digit; nobody writes that down.
    let short = point.map(|x| rounded_to((x * 1e9).round() / 1e9, digits));
    let is_exact = |i: usize| {
        let WrittenNumber::Exact(t) = t else {
            return false;
        };
        let moved = t.times(question.direction[i]);
        let sum = moved.and_then(|moved| moved.plus(question.origin[i]));
        sum.is_some_and(|sum| sum.text() == short[i])
    };
    let sign = if [0, 1, 2].into_iter().all(is_exact) {
        "="
    } else {
        "≈"
    };
    format!("{sign} ({})", short.join(", "))
}

fn one(question: &PaperQuestion, answers: &PaperAnswers) -> Vec<Task> {
    let PaperAnswers { a, b, c, .. } = answers;
    let [a, b, c] = [a, b, c].map(|x| x.equation());
    let mut tasks = vec![
        Task::new(
            "Work out o = p0 − c, then A, B and C.",
            5,
            format!("o = {},  A {a},  B {b},  C {c}", vector(&answers.o)),
        ),
        Task::new(
            "Work out Δ. Does the line miss the sphere, touch it or cross it?",
            3,
            format!(
                "Δ {}: {}",
                answers.discriminant.equation(),
                match answers.class {
                    Class::Miss => "below 0, it misses",
                    Class::Tangent => "it touches, in one point",
                    _ => "above 0, it crosses, in two points",
                }
            ),
        ),
    ];
    let Some([near, far]) = answers.roots else {
        tasks.push(missed(question, answers));
        return tasks;
    };
    if matches!(answers.place, Some(Place::Inside | Place::Behind)) {
        let start = match answers.c.units.signum() {
            -1 => "C < 0: |o| < r, it starts inside",
            0 => "C = 0: |o| = r, it starts on the surface",
            _ => "C > 0: |o| > r, it starts outside",
        };
        tasks.push(Task::new(
            "What does the sign of C say of where the ray starts?",
            2,
            start,
        ));
    }
    tasks.push(Task::new(
        "Work out the roots, the smaller one first.",
        3,
        match answers.class {
            Class::Tangent => format!("both are −B/2A {}", near.equation()),
            _ => format!("near {},  far {}", near.equation(), far.equation()),
        },
    ));
    tasks.extend(match answers.place {
        Some(Place::Behind) => vec![Task::new(
            "The tutorial's function returns true for every Δ ≥ 0. Is the sphere seen? What would you \
             add to the function?",
            3,
            "Both roots are 0 or below: it is behind the eye and not seen. The function must work out \
             the roots and ask whether one of them is above 0.",
        )],
        place => {
            let inside = place == Some(Place::Inside);
            let t = if inside { far } else { near };
            let (which, why) = match (inside, answers.class) {
                (true, _) => ("far", "near ≤ 0 < far, p0 is inside the sphere"),
                (false, Class::Tangent) => ("only", "it is above 0"),
                (false, _) => ("near", "of the two above 0 it is the smaller"),
            };
            vec![
                Task::new(
                    "Which root is seen, and at which point p of the sphere?",
                    2,
                    format!("the {which} one, {why}: p {}", visible_point(question, t)),
                ),
                check(question, answers.class),
            ]
        }
    });
    tasks
}

/// What the negative number of a miss means.
fn missed(question: &PaperQuestion, answers: &PaperAnswers) -> Task {
    let t = answers.closest;
    let offset =
        [0, 1, 2].map(|i| answers.o[i].value() + t.value() * question.direction[i].value());
    let distance = offset.iter().map(|x| x * x).sum::<f64>().sqrt();
    Task::new(
        "The line comes closest to c at t = −B/2A. How far from c is that, and by how much does the \
         line miss the sphere?",
        4,
        format!(
            "t {}, {} from c; it misses by {}",
            t.equation(),
            rounded(distance),
            rounded(distance - question.radius.value())
        ),
    )
}

fn check(question: &PaperQuestion, class: Class) -> Task {
    if class == Class::Tangent {
        return Task::new(
            "Work out (p − c)·d. What does it say of the line and the radius that ends in p?",
            3,
            "it is 0: a tangent is at right angles to that radius",
        );
    }
    Task::new(
        "Check: put p into the sphere's equation (p − c)·(p − c) = r².",
        3,
        format!(
            "both sides are {}, but for what you rounded",
            rounded(question.radius.value() * question.radius.value())
        ),
    )
}

type Solved = (usize, PaperQuestion, PaperAnswers);

fn two(first: &Solved, second: &Solved) -> Option<Vec<Task>> {
    let visible = |(_, _, answers): &Solved| {
        let [near, far] = answers.roots?;
        match answers.place? {
            Place::Hit => Some(near),
            Place::Inside => Some(far),
            Place::Behind => None,
        }
    };
    let (seen, t) = match (visible(first)?, visible(second)?) {
        (one, other) if other.value() < one.value() => (second, other),
        (one, _) => (first, one),
    };
    let each = [first, second].map(|(body, _, answers)| {
        let roots = answers.roots.map_or_else(String::new, |[near, far]| {
            format!(",  near {},  far {}", near.equation(), far.equation())
        });
        format!(
            "sphere {}: A {},  B {},  C {},  Δ {}{roots}",
            body + 1,
            answers.a.equation(),
            answers.b.equation(),
            answers.c.equation(),
            answers.discriminant.equation(),
        )
    });
    Some(vec![
        Task::new(
            "Work out A, B, C, Δ and the roots for each sphere. Which letter is the same for both, and why?",
            9,
            format!("{}. A is the same: it knows only d", each.join("; ")),
        ),
        Task::new(
            "Which of the two is seen, at which t and where?",
            3,
            format!(
                "sphere {}, whose root is the least above 0: t {}, p {}",
                seen.0 + 1,
                t.equation(),
                visible_point(&seen.1, t)
            ),
        ),
    ])
}

/// What binary32 makes of a discriminant that it has too few digits for.
fn rounding(scene: &Scene, candidate: &ProblemPixel) -> Option<(u32, Exercise)> {
    let body = candidate.bodies[0];
    let ProblemPixel { ray, pixel, .. } = candidate;
    let trace = Method::Textbook.trace(ray, &scene.bodies[body].sphere);
    let part = |symbol| trace.step(symbol)?.result.parts().first();
    let [squared, product] = [part("B²")?, part("4AC")?];
    let ulp = spacing(squared.value)?;
    let exact = |m: &Measured| m.exact_text(12, Glyphs::Unicode);
    let right = trace.discriminant.exact.as_ref()?.to_f64();
    let said = trace.discriminant.value;
    let verdict = |class| match class {
        Class::Miss => "a miss",
        Class::Tangent => "a tangent",
        Class::Secant => "a secant",
        Class::Hit => "a hit",
        Class::Nan => "no answer",
    };
    let name = match &scene.bodies[body].name {
        Some(name) => format!("sphere {}, {name}", body + 1),
        None => format!("sphere {}", body + 1),
    };
    let whole = |x: f64| number(x, Precision::Binary64, Digits::Full);
    let (x, y) = *pixel;
    let steps = |x: f64| rounded(x / ulp);
    let methods = Method::ALL.map(|m| (m, m.solve(ray, &scene.bodies[body].sphere).class));
    let cured: Vec<_> = methods
        .iter()
        .filter(|(_, class)| *class == trace.truth.class)
        .map(|(method, _)| method.name())
        .collect();
    let exercise = Exercise {
        pixel: *pixel,
        title: "Too few digits",
        given: vec![
            format!(
                "The ray of pixel ({x}, {y}) and {name}, as a computer works them in binary32."
            ),
            format!(
                "Exactly   B² = {}   4AC = {}",
                exact(squared)?,
                exact(product)?
            ),
            format!(
                "Near these numbers binary32 has steps of {}: nothing in between can be written down.",
                rounded(ulp)
            ),
        ],
        tasks: vec![
            Task::new(
                "How large is Δ exactly? How many of those steps is that?",
                3,
                format!("Δ ≈ {}: {} steps", rounded(right), steps(right)),
            ),
            Task::new(
                format!(
                    "The program has B² = {} and 4AC = {}. What is its Δ, and its verdict?",
                    whole(squared.value),
                    whole(product.value)
                ),
                2,
                format!("Δ = {}: {}", whole(said), verdict(trace.solution.class)),
            ),
            Task::new(
                "What is the right verdict? Why is Δ rounded wrong here, though each number is right to \
                 seven digits?",
                4,
                format!(
                    "{}. B² and 4AC agree in all the digits that they have, and the difference is made \
                     of what was rounded away before",
                    verdict(trace.truth.class)
                ),
            ),
            Task::new(
                "Find out with the program (key m): which methods get this pixel right?",
                1,
                cured.join(", "),
            ),
        ],
    };
    // The plainer the miss, the better the example.
    let margin = (right / ulp).abs().min(1000.0);
    Some((1000 - margin as u32, exercise))
}

/// The spacing of binary32 at a number.
fn spacing(x: f64) -> Option<f64> {
    let x = (x as f32).abs();
    (x.is_finite() && x > 0.0).then(|| f64::from(x.next_up()) - f64::from(x))
}
