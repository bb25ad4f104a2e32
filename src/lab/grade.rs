//! Somebody else's answers held against the truth, beside the methods of this program.

use serde::Serialize;

use super::bench::text::{brief, error_lines};
use super::bench::{BenchPlan, Benchmark, Sample};
use super::errors::{Census, Errors, Fault, FaultCounts, Judgement, Percentiles, Worst, judge};
use super::numbers;
use super::timing::Clock;
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
    /// For each kind of fault the simplest claim that has it.
    pub simplest: Vec<FaultyClaim>,
    /// The errors of our methods on the same rays.
    pub ours: Vec<(Method, Errors)>,
}

/// A claim with a fault, beside the truth.
#[derive(Debug, Clone, PartialEq)]
pub struct FaultyClaim {
    /// What is wrong.
    pub fault: Fault,
    /// What was asked.
    pub problem: Problem,
    /// What was said.
    pub given: Solution,
    /// What is right.
    pub exact: Solution,
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
        simplest: simplest(problems, &references, &answers),
        claimed: Errors::of_answers(problems, &references, answers),
        ours: ours.into(),
    }
}

/// For each kind of fault the claim whose ten numbers take the fewest digits; of equals the first.
fn simplest(
    problems: &[Problem],
    references: &[Reference],
    answers: &[Solution],
) -> Vec<FaultyClaim> {
    let judged = answers.iter().zip(references).zip(problems);
    let faulty = judged.filter_map(|((given, truth), problem)| match judge(truth, given) {
        Judgement::Wrong(fault) => Some(FaultyClaim {
            fault,
            problem: *problem,
            given: *given,
            exact: truth.solution,
        }),
        Judgement::Agreed(_) => None,
    });
    let mut found: Vec<(usize, FaultyClaim)> = Vec::new();
    for claim in faulty {
        let digits = digits(&claim.problem);
        match found.iter_mut().find(|(_, one)| one.fault == claim.fault) {
            None => found.push((digits, claim)),
            Some(one) if digits < one.0 => *one = (digits, claim),
            Some(_) => {}
        }
    }
    found.sort_by_key(|(_, claim)| claim.fault);
    found.into_iter().map(|(_, claim)| claim).collect()
}

/// How many digits it takes to write a problem down; a 0 takes none.
fn digits(problem: &Problem) -> usize {
    let written = numbers(problem).map(|x| binary32(x, Glyphs::Ascii).to_string());
    let significant = |text: &String| {
        let digits = text.trim_start_matches(['-', '0', '.']);
        digits.bytes().filter(u8::is_ascii_digit).count()
    };
    written.iter().map(significant).sum()
}

/// The claims, which took these nanoseconds each, timed beside our methods on the same rays.
pub fn time(
    grade: &Grade,
    problems: &[Problem],
    nanoseconds: &[f64],
    plan: BenchPlan,
    clock: &dyn Clock,
    go_on: impl FnMut(usize, &str) -> bool,
) -> Benchmark {
    let sample = Sample::of_rows("the rows", problems.to_vec(), plan.schedule.seed);
    let seed = plan.schedule.seed;
    let mut measured = super::bench::run(plan, &[sample], seed, clock, go_on);
    for set in &mut measured.sets {
        set.add(CLAIMED, grade.claimed.clone(), nanoseconds);
    }
    measured
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
    let simplest = grade.simplest.iter().map(|claim| {
        let count = errors.wrong.of(claim.fault);
        let which = if count == 1 {
            "the one there is".to_owned()
        } else {
            format!("the simplest of {count}")
        };
        let [given, exact] = [claim.given, claim.exact].map(|answer| in_words(&answer));
        let fault = claim.fault.name();
        let sentence = format!("{fault}, {which}: given {given}; exact {exact}");
        input(sentence, &claim.problem)
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
    simplest.chain(largest).fold(table, Report::then)
}

/// The class, and the roots of what meets the sphere.
fn in_words(answer: &Solution) -> String {
    let root = |t: f32| binary32(t, Glyphs::Ascii);
    match answer.class {
        class @ (Class::Miss | Class::Nan) => class.to_string(),
        class => format!("{class} {}, {}", root(answer.near), root(answer.far)),
    }
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
    simplest: Vec<FaultyJson>,
}

#[derive(Serialize)]
struct FaultyJson {
    fault: &'static str,
    count: usize,
    input: [String; 10],
    given: AnswerJson,
    exact: AnswerJson,
}

#[derive(Serialize)]
struct AnswerJson {
    class: &'static str,
    near: Option<f32>,
    far: Option<f32>,
}

impl AnswerJson {
    fn of(answer: &Solution) -> Self {
        let root = |t: f32| answer.class.meets().then_some(t);
        Self {
            class: answer.class.name(),
            near: root(answer.near),
            far: root(answer.far),
        }
    }
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
    let faulty = |claim: &FaultyClaim| FaultyJson {
        fault: claim.fault.name(),
        count: grade.claimed.wrong.of(claim.fault),
        input: numbers(&claim.problem).map(hexadecimal),
        given: AnswerJson::of(&claim.given),
        exact: AnswerJson::of(&claim.exact),
    };
    report::json(&GradeJson {
        rayscope: env!("CARGO_PKG_VERSION"),
        census: grade.census,
        results: std::iter::once(AnswersJson::of(CLAIMED, rays, &grade.claimed))
            .chain(ours.map(|(method, errors)| AnswersJson::of(method.name(), rays, errors)))
            .collect(),
        simplest: grade.simplest.iter().map(faulty).collect(),
    })
}
