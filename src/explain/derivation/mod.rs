//! The derivation of one pixel, step by step: from the pixel to its ray, through the quadratic as the
//! method works it, to the point that is seen and the character that shows it.
//!
//! The steps of the quadratic are the method's own trace. The steps before and after it are those
//! of the camera and of the picture.

mod ray;
mod seen;

use glam::Vec3;

use super::{Digits, Reading, Subject, number, vector};
use crate::method::trace::{self, Measured, Quantity, Trace};
use crate::method::{Class, Method, Place, Precision};
use crate::render::{Frame, Image, Style, View};
use crate::scene::{Rays, Scene};
use crate::text::Glyphs;

/// What the picture made of a pixel.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawn {
    /// From 0 to 1, of the nearest hit.
    pub brightness: f32,
    /// The character of the cell that shows the pixel.
    pub glyph: char,
    /// Whether the cell has a ground of a colour of its own behind the character.
    pub has_ground: bool,
    /// The row of the pixel.
    pub row: u32,
    /// The brightness of the pixel that shares the cell in half blocks: of the row before or after.
    pub partner: f32,
    /// How samples become characters.
    pub style: Style,
    /// What the picture shows.
    pub view: View,
    /// Whether the picture is still being made, so that the others are not known.
    pub is_pending: bool,
}

impl Drawn {
    /// What a picture that is still being made will show of pixel (x, y).
    pub const fn pending((_, y): (u32, u32), view: View, style: Style) -> Self {
        Self {
            brightness: 0.0,
            glyph: ' ',
            has_ground: false,
            row: y,
            partner: 0.0,
            style,
            view,
            is_pending: true,
        }
    }

    /// What a frame and its image made of pixel (x, y).
    pub fn at((x, y): (u32, u32), frame: &Frame, image: &Image, style: Style) -> Self {
        let (col, row) = style.cell_of_pixel(x, y);
        let cell = image.cell(col, row);
        Self {
            brightness: frame.brightness(x, y),
            glyph: cell.map_or(' ', |cell| cell.glyph),
            has_ground: cell.is_some_and(|cell| cell.bg.is_some()),
            row: y,
            partner: frame.brightness(x, y ^ 1),
            style,
            view: frame.view(),
            is_pending: false,
        }
    }
}

/// One step of the derivation of a pixel.
#[derive(Debug, Clone)]
pub struct Step {
    /// A word or a letter for the list of steps.
    pub name: String,
    /// Why the step is done, in a sentence.
    pub why: String,
    /// The formula in letters.
    pub formula: String,
    /// The formula with this pixel's numbers.
    pub numbers: String,
    /// What comes out.
    pub result: String,
    /// The line of the program that does it.
    pub code: String,
    /// What would come out without rounding, and how far off the result is; nothing if it is right.
    pub exact: Option<String>,
    /// What the operations of the step lost, in sentences.
    pub losses: Vec<String>,
    /// Whether this is the first step that loses much.
    pub first_heavy: bool,
    /// What a student may be asked before the result is shown.
    pub question: Option<StepQuestion>,
    /// The numbers tell the result already.
    pub numbers_tell: bool,
    /// The number whose bits are worth a look.
    pub number: Option<Measured>,
}

/// A question that a step answers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StepQuestion {
    /// Is Δ below, equal to or above zero?
    Sign,
    /// How many points have line and sphere in common?
    Count,
    /// Which root is seen?
    Seen,
}

impl StepQuestion {
    /// All questions.
    pub const ALL: [Self; 3] = [Self::Sign, Self::Count, Self::Seen];

    /// The question as it is asked.
    pub const fn text(self) -> &'static str {
        match self {
            Self::Sign => "Is Δ negative, zero or positive?",
            Self::Count => "How many points do line and sphere share?",
            Self::Seen => "Which root is seen?",
        }
    }

    /// The keys that answer, each with what it says; the right one is at place [`StepQuestion::right`].
    pub const fn answers(self) -> [(char, &'static str); 3] {
        match self {
            Self::Sign => [('-', "negative"), ('0', "zero"), ('+', "positive")],
            Self::Count => [('0', "none"), ('1', "one"), ('2', "two")],
            Self::Seen => [('0', "neither"), ('n', "near"), ('f', "far")],
        }
    }

    /// The keys with their answers, in a line.
    pub fn keys(self) -> String {
        self.answers()
            .map(|(key, word)| format!("{key} {word}"))
            .join("   ")
    }

    /// The place of the right answer; none where the method has no answer.
    pub fn right(self, subject: &Subject) -> Option<usize> {
        let class = match subject.solution.class {
            Class::Miss => 0,
            Class::Tangent => 1,
            Class::Secant => 2,
            Class::Hit if self == Self::Seen => 2,
            Class::Hit | Class::Nan => return None,
        };
        Some(match self {
            Self::Sign | Self::Count => class,
            Self::Seen => match subject.solution.place() {
                Some(Place::Hit) => 1,
                Some(Place::Inside) => 2,
                Some(Place::Behind) | None => 0,
            },
        })
    }
}

/// All steps for the pixel of a reading; empty in a scene without spheres.
pub fn derivation(reading: &Reading, scene: &Scene, rays: &Rays, drawn: &Drawn) -> Vec<Step> {
    let Some(subject) = &reading.subject else {
        return Vec::new();
    };
    let mut steps = ray::steps(reading, subject, scene, rays);
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
    steps.extend(seen::steps(reading, subject, scene, drawn));
    steps
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

fn n32(x: f32) -> String {
    number(x.into(), Precision::Binary32, DIGITS)
}

fn n64(x: f64) -> String {
    number(x, Precision::Binary64, DIGITS)
}

fn v3(v: Vec3) -> String {
    format!("({})", vector(v, DIGITS))
}

impl Step {
    /// The step in the characters that are allowed, before it is laid out in lines.
    #[must_use]
    pub fn spelt(&self, glyphs: Glyphs) -> Self {
        let spell = |text: &String| glyphs.spell(text);
        Self {
            name: spell(&self.name),
            why: spell(&self.why),
            formula: spell(&self.formula),
            numbers: spell(&self.numbers),
            result: spell(&self.result),
            exact: self.exact.as_ref().map(spell),
            losses: self.losses.iter().map(spell).collect(),
            ..self.clone()
        }
    }

    fn plain(name: &str, why: &str, formula: &str) -> Self {
        Self {
            name: name.into(),
            why: why.into(),
            formula: formula.into(),
            numbers: String::new(),
            result: String::new(),
            code: String::new(),
            exact: None,
            losses: Vec::new(),
            first_heavy: false,
            question: None,
            numbers_tell: false,
            number: None,
        }
    }

    /// The numbers, as far as they don't tell a result that is kept back.
    pub fn numbers_beside(&self, hidden: bool) -> &str {
        if hidden && self.numbers_tell {
            ""
        } else {
            &self.numbers
        }
    }
}

/// The steps of the method itself, as it traced them.
fn quadratic_steps(trace: &Trace) -> Vec<Step> {
    let heavy = trace.first_heavy_loss();
    let glyphs = Glyphs::Unicode;
    let step = |(at, step): (usize, &trace::TraceStep)| Step {
        numbers: step.numbers.clone(),
        result: step.result.text(glyphs),
        code: step.code.clone().into_owned(),
        exact: exact(&step.result),
        losses: trace.loss_sentences(at, glyphs),
        first_heavy: heavy == Some(at),
        question: is_discriminant(&step.symbol, trace.method).then_some(StepQuestion::Sign),
        // A later stage of `exact` says what it has settled.
        numbers_tell: step.symbol.contains(", "),
        number: step.result.parts().first().cloned(),
        ..Step::plain(&step.symbol, &step.why, &step.formula)
    };
    trace.steps.iter().enumerate().map(step).collect()
}

/// What a result would be without rounding, and how far off it is; nothing if it is right.
fn exact(result: &Quantity) -> Option<String> {
    result.error_sentence(12, Glyphs::Unicode)
}

/// Whether the sign of the step of that symbol decides the class.
fn is_discriminant(symbol: &str, method: Method) -> bool {
    match method {
        Method::Textbook => symbol == "Δ",
        _ => symbol == "D" || symbol == "Δ",
    }
}

fn bracketed(value: &str) -> String {
    if value.starts_with('−') {
        format!("({value})")
    } else {
        value.to_owned()
    }
}
