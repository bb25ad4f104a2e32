//! The sheet of one pixel, a line at a time: from its ray, through the quadratic, to the point that is
//! seen and the light on it.
//!
//! Through the lens `mathematics` the lines are the tutorial's, worked exactly; through `machine` they
//! are the method's own trace, between the steps of the camera and those of the picture.

mod data;
mod machine;
mod mathematics;
mod quadratic;
mod ray;
mod seen;
mod text;

pub use data::{StepData, sheet_report};
pub(super) use quadratic::WorkedQuadratic;
pub use text::{SheetLook, question_lines, sheet_lines, sheet_text, step_lines};
pub(super) use text::{equation_lines, room_for_signs};

use super::equation::Sign;
use super::{Lens, Reading, Subject};
use crate::method::trace::Measured;
use crate::render::{Frame, Image, Style, View};
use crate::scene::{Rays, Scene};
use crate::text::Glyphs;

use super::question::StepQuestion;

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

/// One line of a sheet, with all that belongs to it.
#[derive(Debug, Clone, Default)]
pub struct Step {
    /// A word or a letter by which it is asked for.
    pub name: String,
    /// Why it is done, in a sentence.
    pub why: String,
    /// What is written.
    pub equations: Vec<Equation>,
    /// What follows from it, in words.
    pub outcome: Vec<String>,
    /// The statement of a program that does it, in C.
    pub code: String,
    /// What would come out without rounding, and how far off the result is; nothing if it is right.
    pub exact: Option<String>,
    /// What the operations of the step lost, in sentences.
    pub losses: Vec<String>,
    /// Whether this is the first step that loses much.
    pub first_heavy: bool,
    /// What a student may be asked before the result is shown, in this order.
    pub questions: Vec<StepQuestion>,
    /// The number whose bits are worth a look.
    pub number: Option<Measured>,
}

/// A formula, and what it comes to in numbers.
#[derive(Debug, Clone, Default)]
pub struct Equation {
    /// The formula in letters, from the letter on that it is for.
    pub formula: String,
    /// The formula with this pixel's numbers and what comes out, from the longest way to write it to
    /// the shortest.
    pub ways: Vec<Vec<Link>>,
    /// A sum term by term, for where that is easier to read.
    pub ledger: Vec<LedgerEntry>,
}

/// What is joined to what stands before it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Link {
    /// How it is joined.
    pub sign: Sign,
    /// What it says.
    pub text: String,
}

/// A line of a sum that is written term by term.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LedgerEntry {
    /// The sign and the letters of the term, or the sign before the result.
    pub label: String,
    /// The number.
    pub number: String,
}

impl Link {
    pub(super) fn new(sign: Sign, text: impl Into<String>) -> Self {
        let text = text.into();
        Self { sign, text }
    }
}

impl Equation {
    /// Letters alone.
    pub(super) fn letters(formula: impl Into<String>) -> Self {
        Self {
            formula: formula.into(),
            ..Self::default()
        }
    }

    /// A formula and one way to write what it comes to.
    pub(super) fn new(formula: impl Into<String>, links: Vec<Link>) -> Self {
        Self {
            ways: vec![links],
            ..Self::letters(formula)
        }
    }

    /// What comes out; the formula itself where it is no more than that.
    pub fn result(&self) -> &str {
        let last = self.ways.last().and_then(|way| way.last());
        last.map_or(self.formula.as_str(), |link| link.text.as_str())
    }
}

impl Step {
    pub(super) fn new(name: &str, why: &str, equations: Vec<Equation>) -> Self {
        Self {
            name: name.into(),
            why: why.into(),
            equations,
            ..Self::default()
        }
    }

    /// What comes out, in one line.
    pub fn result(&self) -> String {
        let results = self.equations.iter().map(Equation::result);
        results.collect::<Vec<_>>().join("  ")
    }

    /// The step in the characters that are allowed, before it is laid out in lines.
    #[must_use]
    pub fn spelt(&self, glyphs: Glyphs) -> Self {
        let spell = |text: &String| glyphs.spell(text);
        let link = |link: &Link| Link::new(link.sign, spell(&link.text));
        let entry = |entry: &LedgerEntry| LedgerEntry {
            label: spell(&entry.label),
            number: spell(&entry.number),
        };
        let equation = |e: &Equation| Equation {
            formula: spell(&e.formula),
            ways: e
                .ways
                .iter()
                .map(|way| way.iter().map(link).collect())
                .collect(),
            ledger: e.ledger.iter().map(entry).collect(),
        };
        Self {
            name: spell(&self.name),
            why: spell(&self.why),
            equations: self.equations.iter().map(equation).collect(),
            outcome: self.outcome.iter().map(spell).collect(),
            exact: self.exact.as_ref().map(spell),
            losses: self.losses.iter().map(spell).collect(),
            ..self.clone()
        }
    }
}

/// The lines of the mathematics, without those of the picture.
pub(super) fn mathematics(reading: &Reading, subject: &Subject) -> Vec<Step> {
    mathematics::steps(reading, subject, None, None)
}

/// The sheet for the pixel of a reading; empty in a scene without spheres.
///
/// Through the lens `mathematics` the reading must be that of `exact`.
pub fn sheet(
    lens: Lens,
    reading: &Reading,
    scene: Option<&Scene>,
    rays: Option<&Rays>,
    drawn: Option<&Drawn>,
) -> Vec<Step> {
    let Some(subject) = &reading.subject else {
        return Vec::new();
    };
    let light = scene.and_then(|scene| scene.light);
    match lens {
        Lens::Mathematics => mathematics::steps(reading, subject, light, drawn),
        Lens::Machine => machine::steps(reading, subject, light, scene.zip(rays), drawn),
    }
}
