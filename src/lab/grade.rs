//! Somebody else's answers held against the truth, beside the methods of this program.

use serde::Serialize;

use super::bench::text::{brief, error_lines};
use super::errors::{Census, Errors, FaultCounts, Percentiles, Worst};
use super::numbers;
use super::{Problem, Reference};
use crate::method::format::binary32;
use crate::method::{Class, Method, Solution};
use crate::report::{self, Column, Report, Table};
use crate::text::{Glyphs, hexadecimal};

/// What somebody says of one ray and sphere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Claim {
    /// The class; none for a hit of which is not said whether it is a tangent or a secant.
    pub class: Option<Class>,
    /// The smaller root.
    pub near: f32,
    /// The larger root.
    pub far: f32,
}

impl Claim {
    /// The claim as an answer: a hit that is not told apart is what the truth makes of it.
    fn answer(&self, truth: &Reference) -> Solution {
        let class = self.class.unwrap_or(if truth.class.meets() {
            truth.class
        } else {
            Class::Secant
        });
        Solution::with_roots(class, self.near, self.far)
    }
}

/// What became of the claims.
#[derive(Debug, Clone, PartialEq)]
pub struct Grade {
    /// The classes of the rays, by the truth.
    pub census: Census,
    /// The errors of the claims.
    pub claimed: Errors,
    /// The errors of our methods on the same rays.
    pub ours: Vec<(Method, Errors)>,
}

/// Holds claims against the truth.
pub fn grade(problems: &[Problem], claims: &[Claim]) -> Grade {
    let references = Reference::all(problems);
    let answers: Vec<Solution> = claims
        .iter()
        .zip(&references)
        .map(|(claim, truth)| claim.answer(truth))
        .collect();
    let ours = Method::ALL.map(|method| {
        let errors = Errors::of(problems, &references, |r, s| method.solve(r, s));
        (method, errors)
    });
    Grade {
        census: Census::of(&references),
        claimed: Errors::of_answers(problems, &references, answers),
        ours: ours.into(),
    }
}

/// The name of somebody else's answers.
const CLAIMED: &str = "given";

/// The grade as text, with the inputs of the worst and the first wrong claim.
pub fn text(grade: &Grade) -> Report {
    let ours = grade.ours.iter().map(|(m, errors)| (' ', m.name(), errors));
    let rows: Vec<_> = std::iter::once(('>', CLAIMED, &grade.claimed))
        .chain(ours)
        .collect();
    let errors = &grade.claimed;
    let first = errors.first_wrong.as_ref().map(|(problem, fault)| {
        let sentence = format!("first wrong answer given: {}", fault.name());
        input(sentence, problem)
    });
    let largest = errors.worst.as_ref().map(|Worst { problem, error }| {
        let sentence = format!(
            "largest error given: {} ulp, {} for {}",
            brief(error.ulps),
            hexadecimal(error.answer),
            hexadecimal(error.exact)
        );
        input(sentence, problem)
    });
    let table = Report::new().table(error_lines(&grade.census, &rows));
    first.into_iter().chain(largest).fold(table, Report::then)
}

/// A problem in hexadecimal, and as the command that works it out step by step.
fn input(sentence: String, problem: &Problem) -> Report {
    let x = numbers(problem);
    let list = |x: &[f32]| {
        let decimals = x.iter().map(|&x| binary32(x, Glyphs::Ascii).to_string());
        decimals.collect::<Vec<_>>().join(",")
    };
    let [p0, d, c, r] = [&x[..3], &x[3..6], &x[6..9], &x[9..]].map(|x| {
        let exact: Vec<String> = x.iter().map(|&x| hexadecimal(x)).collect();
        exact.join(" ")
    });
    let input = [("p0", p0), ("d", d), ("c", c), ("r", r)];
    let input = input.map(|(name, value)| vec![name.to_owned(), value]);
    let (ray, sphere) = (list(&x[..6]), list(&x[6..]));
    Report::new()
        .gap()
        .words(sentence)
        .table(Table::new(["", ""].map(Column::left), input).indented(2))
        .words(format!("  rayscope solve --ray={ray} --sphere={sphere}"))
}

#[derive(Serialize)]
struct GradeJson {
    rayscope: &'static str,
    #[serde(flatten)]
    census: Census,
    results: Vec<AnswersJson>,
}

#[derive(Serialize)]
struct AnswersJson {
    method: &'static str,
    rays: usize,
    wrong: FaultCounts,
    judged: usize,
    ulp: Percentiles,
    worst_input: Option<[String; 10]>,
    first_wrong: Option<&'static str>,
    first_wrong_input: Option<[String; 10]>,
}

impl AnswersJson {
    fn of(method: &'static str, rays: usize, errors: &Errors) -> Self {
        let input = |problem: &Problem| numbers(problem).map(hexadecimal);
        let first = errors.first_wrong.as_ref();
        Self {
            method,
            rays,
            wrong: errors.wrong,
            judged: errors.judged,
            ulp: errors.ulp,
            worst_input: errors.worst.as_ref().map(|worst| input(&worst.problem)),
            first_wrong: first.map(|(_, fault)| fault.name()),
            first_wrong_input: first.map(|(problem, _)| input(problem)),
        }
    }
}

/// The grade as one JSON object; the answers that were given are the method `given`.
pub fn json(grade: &Grade) -> String {
    let rays = grade.census.rays;
    let ours = grade.ours.iter();
    report::json(&GradeJson {
        rayscope: env!("CARGO_PKG_VERSION"),
        census: grade.census,
        results: std::iter::once(AnswersJson::of(CLAIMED, rays, &grade.claimed))
            .chain(ours.map(|(method, errors)| AnswersJson::of(method.name(), rays, errors)))
            .collect(),
    })
}
