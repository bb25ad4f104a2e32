//! The lines of the machine: from the pixel to its ray, through the quadratic as the method works it, to
//! the character that shows the point.

use glam::Vec3;

use super::{Drawn, Equation, Link, Step, ray, seen};
use crate::explain::equation::Sign;
use crate::explain::question::StepQuestion;
use crate::explain::{Digits, Reading, Subject, number, vector};
use crate::method::trace::{self, Measured, Quantity, Trace};
use crate::method::{Method, Precision};
use crate::scene::{Light, Rays, Scene};
use crate::text::Glyphs;

/// A step of the machine before it is laid out: a formula, the numbers in it, and what it gave.
#[derive(Debug, Clone, Default)]
pub(super) struct MachineStep {
    pub name: String,
    pub why: String,
    /// The formula in letters.
    pub formula: String,
    /// The formula with this pixel's numbers.
    pub numbers: String,
    /// What came out.
    pub result: String,
    /// What follows from it, in words.
    pub outcome: Vec<String>,
    pub code: String,
    pub exact: Option<String>,
    pub losses: Vec<String>,
    pub first_heavy: bool,
    pub questions: Vec<StepQuestion>,
    pub number: Option<Measured>,
}

impl From<MachineStep> for Step {
    fn from(step: MachineStep) -> Self {
        let is_sentence = matches!(step.name.as_str(), "seen" | "shade" | "glyph" | "bound");
        let names_itself = is_sentence || step.formula.contains('=') || step.formula == step.name;
        let formula = if names_itself || step.name.chars().count() > 6 {
            step.formula
        } else {
            format!("{} = {}", step.name, step.formula)
        };
        let numbers = step
            .numbers
            .lines()
            .map(|line| Link::new(Sign::Nothing, line));
        let mut links: Vec<_> = numbers.collect();
        links.extend(step.result.lines().enumerate().map(|(i, line)| {
            let sign = if i == 0 { Sign::Gives } else { Sign::Nothing };
            Link::new(sign, line)
        }));
        Self {
            name: step.name,
            why: step.why,
            equations: vec![Equation::new(formula, links)],
            outcome: step.outcome,
            code: step.code,
            exact: step.exact,
            losses: step.losses,
            first_heavy: step.first_heavy,
            questions: step.questions,
            number: step.number,
        }
    }
}

/// The steps of the camera, those of the method, those of the picture.
pub(super) fn steps(
    reading: &Reading,
    subject: &Subject,
    light: Option<Light>,
    camera: Option<(&Scene, &Rays)>,
    drawn: Option<&Drawn>,
) -> Vec<Step> {
    let mut steps = camera.map_or_else(Vec::new, |(scene, rays)| {
        ray::steps(reading, subject, scene, rays)
    });
    let mut quadratic = quadratic_steps(&subject.trace);
    // The sign of Δ says how many roots there are before one is worked out.
    // A routine says so in its own lines.
    let roots = if subject.trace.method.is_routine() {
        quadratic.len()
    } else {
        first_of_roots(&subject.trace)
    };
    quadratic.insert(roots, seen::count_step(subject));
    steps.extend(quadratic);
    steps.extend(seen::steps(reading, subject, light, drawn));
    steps.into_iter().map(Step::from).collect()
}

/// The place of the first step of the method that is for the roots; its end if there is none.
fn first_of_roots(trace: &Trace) -> usize {
    const ROOTS: [&str; 6] = ["b", "√D", "√Δ", "q", "near₆₄", "near"];
    let steps = &trace.steps;
    let decides = |step: &trace::TraceStep| is_discriminant(&step.symbol, trace.method);
    let from = steps.iter().position(decides).unwrap_or(0);
    let is_for_roots = |step: &trace::TraceStep| ROOTS.contains(&&*step.symbol);
    let after = steps[from..].iter().position(is_for_roots);
    after.map_or(steps.len(), |after| from + after)
}

const DIGITS: Digits = Digits::Significant(7);

pub(super) fn n32(x: f32) -> String {
    number(x.into(), Precision::Binary32, DIGITS)
}

pub(super) fn n64(x: f64) -> String {
    number(x, Precision::Binary64, DIGITS)
}

pub(super) fn v3(v: Vec3) -> String {
    format!("({})", vector(v, DIGITS))
}

impl MachineStep {
    pub(super) fn plain(name: &str, why: &str, formula: &str) -> Self {
        Self {
            name: name.into(),
            why: why.into(),
            formula: formula.into(),
            ..Self::default()
        }
    }
}

/// The steps of the method itself, as it traced them.
fn quadratic_steps(trace: &Trace) -> Vec<MachineStep> {
    let heavy = trace.first_heavy_loss();
    let glyphs = Glyphs::Unicode;
    let step = |(at, step): (usize, &trace::TraceStep)| MachineStep {
        numbers: step.numbers.clone(),
        result: step.result.text(glyphs),
        code: step.statement(),
        exact: exact(&step.result),
        losses: trace.loss_sentences(at, glyphs),
        first_heavy: heavy == Some(at),
        questions: StepQuestion::of_symbol(&step.symbol).into_iter().collect(),
        number: step.result.parts().first().cloned(),
        ..MachineStep::plain(&step.symbol, &step.why, &step.formula)
    };
    trace.steps.iter().enumerate().map(step).collect()
}

/// What a result would be without rounding, and how far off it is; nothing if it is right.
pub(super) fn exact(result: &Quantity) -> Option<String> {
    result.error_sentence(12, Glyphs::Unicode)
}

/// Whether the sign of the step of that symbol decides the class.
fn is_discriminant(symbol: &str, method: Method) -> bool {
    match method {
        Method::Textbook => symbol == "Δ",
        _ => symbol == "D" || symbol == "Δ",
    }
}

pub(super) fn bracketed(value: &str) -> String {
    if value.starts_with('−') {
        format!("({value})")
    } else {
        value.to_owned()
    }
}
