//! A sheet as lines of text: each step under the one before, the last with its reason.

use super::{Equation, LedgerEntry, Step};
use crate::explain::panel::{EXACTLY, Line, Role, unit_lines};
use crate::explain::question::StepQuestion;
use crate::text::{Glyphs, wrap};

/// How a sheet is shown.
#[derive(Debug, Clone, Copy, Default)]
pub struct SheetLook<'a> {
    /// The step that it has grown to, from 0.
    pub current: usize,
    /// The results of that step are kept back until the person has thought about them.
    pub hidden: bool,
    /// The question that waits for an answer.
    pub question: Option<StepQuestion>,
    /// Which results are other ones than before the last move.
    pub changed: &'a [bool],
    /// The characters that there are.
    pub glyphs: Glyphs,
}

/// What stands for a result that is kept back.
const HIDDEN: &str = "= ?";
/// Where what belongs to a line stands under it.
const INDENT: usize = 3;

/// Columns for lines whose signs are spelt once they are laid out: some are longer then.
pub(in crate::explain) const fn room_for_signs(width: usize, glyphs: Glyphs) -> usize {
    match glyphs {
        Glyphs::Unicode => width,
        Glyphs::Ascii => width.saturating_sub(2),
    }
}

/// How much is said of a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Detail {
    /// What is written, and nothing else.
    Written,
    /// Its reason, too.
    Reasoned,
    /// The statement that does it, too.
    Coded,
}

/// The sheet as far as it has grown, in `height` lines of at most `width` characters: those that were
/// written first leave at the top, the current step is not cut.
pub fn sheet_lines(steps: &[Step], look: SheetLook<'_>, width: usize, height: usize) -> Vec<Line> {
    let last = look.current.min(steps.len().saturating_sub(1));
    let width = room_for_signs(width, look.glyphs);
    let Some(current) = steps.get(last) else {
        return Vec::new();
    };
    let block = |i: usize, detail| {
        let is_changed = look.changed.get(i).copied().unwrap_or(false);
        block(&steps[i], width, detail, is_changed)
    };
    let total = |detail| {
        (0..steps.len())
            .map(|i| block(i, detail).len())
            .sum::<usize>()
    };
    // The same for every step, so that nothing moves when the next line comes.
    let before = if total(Detail::Reasoned) + 2 <= height {
        Detail::Reasoned
    } else {
        Detail::Written
    };
    let mut above: Vec<Line> = (0..last).flat_map(|i| block(i, before)).collect();
    let details = [Detail::Coded, Detail::Reasoned, Detail::Written];
    let now = |detail| {
        let mut lines = if look.hidden {
            hidden_block(current, width)
        } else {
            block(last, detail)
        };
        if let Some(question) = look.question {
            lines.extend(question_lines(question, width));
        }
        if let Some(first) = lines.first_mut().and_then(|line| line.spans.first_mut()) {
            first.text = look.glyphs.spell("▸");
            first.role = Role::Current;
        }
        lines
    };
    let roomy = details
        .into_iter()
        .map(now)
        .find(|lines| lines.len() <= height);
    let mut now = roomy.unwrap_or_else(|| now(Detail::Written));
    now.truncate(height);
    let room = height - now.len();
    if above.len() > room {
        above.drain(..above.len() - room);
    }
    above.extend(now);
    above
}

/// The current step of a sheet alone, in lines of at most `width` characters.
pub fn step_lines(steps: &[Step], look: SheetLook<'_>, width: usize) -> Vec<Line> {
    let last = look.current.min(steps.len().saturating_sub(1));
    let Some(step) = steps.get(last) else {
        return Vec::new();
    };
    let mut lines = if look.hidden {
        hidden_block(step, width)
    } else {
        block(step, width, Detail::Coded, false)
    };
    lines.extend(
        look.question
            .into_iter()
            .flat_map(|q| question_lines(q, width)),
    );
    lines
}

/// The whole sheet as plain text, with its reasons and statements.
pub fn sheet_text(steps: &[Step], width: usize) -> String {
    let mut out = String::new();
    for step in steps {
        for line in block(step, width, Detail::Coded, false) {
            let text = line.text();
            out = out + text.strip_prefix(' ').unwrap_or(&text) + "\n";
        }
        out.push('\n');
    }
    for line in step_words(steps, width) {
        out = out + &line.text() + "\n";
    }
    out
}

/// What is written of a step, without its reason.
pub(super) fn step_written(step: &Step, width: usize) -> Vec<String> {
    let lines = block(step, width, Detail::Written, false);
    let text = |line: &Line| {
        let text = line.text();
        text.strip_prefix(' ').unwrap_or(&text).to_owned()
    };
    lines.iter().map(text).collect()
}

/// A step whose results are kept back.
fn hidden_block(step: &Step, width: usize) -> Vec<Line> {
    let mut out = Vec::new();
    for equation in &step.equations {
        let mut line = Line::new(0).with(Role::Plain, " ");
        // What is compared, and what is given, tells the answer.
        if !equation.ways.is_empty() {
            line = line.with(Role::Formula, format!("{} ", equation.formula));
            out.push(line.with(Role::Value, HIDDEN));
        }
    }
    if out.is_empty() {
        out.push(
            Line::new(0)
                .with(Role::Plain, " ")
                .with(Role::Formula, format!("{}: ?", step.name)),
        );
    }
    out.extend(indented(&step.why, width, Role::Plain));
    out
}

fn block(step: &Step, width: usize, detail: Detail, is_changed: bool) -> Vec<Line> {
    let mut out: Vec<Line> = Vec::new();
    for equation in &step.equations {
        out.extend(
            equation_lines(equation, width.saturating_sub(1), is_changed)
                .into_iter()
                .map(|mut line| {
                    line.spans.insert(
                        0,
                        crate::explain::Span {
                            text: " ".into(),
                            role: Role::Plain,
                        },
                    );
                    line
                }),
        );
    }
    for outcome in &step.outcome {
        let lines = indented(outcome, width, Role::Label);
        out.extend(lines);
    }
    if let Some(exact) = &step.exact {
        out.extend(indented(&format!("exactly {exact}"), width, Role::Faint));
    }
    for (i, loss) in step.losses.iter().enumerate() {
        let is_heavy = step.first_heavy && i == 0 || step.name == "verdict";
        let role = if is_heavy { Role::Warning } else { Role::Faint };
        out.extend(indented(loss, width, role));
    }
    if out.is_empty() {
        out.push(Line::new(0).with(Role::Plain, format!(" {}", step.name)));
    }
    if detail != Detail::Written {
        out.extend(indented(&step.why, width, Role::Faint));
    }
    if detail == Detail::Coded && !step.code.is_empty() {
        out.extend(indented(&step.code, width, Role::Formula));
    }
    out
}

fn indented(text: &str, width: usize, role: Role) -> Vec<Line> {
    let lines = wrap(text, width.saturating_sub(INDENT).max(8)).into_iter();
    lines
        .map(|text| {
            Line::new(0)
                .with(Role::Plain, " ".repeat(INDENT))
                .with(role, text)
        })
        .collect()
}

/// A piece of an equation, with the sign before it.
struct Piece<'a> {
    sign: &'static str,
    text: &'a str,
    role: Role,
}

/// An equation in lines of at most `width` characters, broken before its signs; the first way to write it
/// that fits, else its terms one under the other.
pub(in crate::explain) fn equation_lines(
    equation: &Equation,
    width: usize,
    is_changed: bool,
) -> Vec<Line> {
    let role = if is_changed {
        Role::Changed
    } else {
        Role::Value
    };
    if equation.ways.is_empty() {
        return hanging(&equation.formula, width, Role::Formula);
    }
    let count = equation.ways.len();
    let fitting = equation.ways.iter().enumerate().find(|(i, way)| {
        let fits = way
            .iter()
            .all(|link| link.text.chars().count() + 4 <= width);
        // The result alone tells less than the terms one under the other.
        let is_bare = *i + 1 == count && count > 1 || way.len() == 1;
        fits && (equation.ledger.is_empty() || !is_bare)
    });
    match fitting {
        Some((_, way)) => chain(equation, way, width, role),
        None if !equation.ledger.is_empty() => {
            let mut out = hanging(&equation.formula, width, Role::Formula);
            out.extend(ledger_lines(&equation.ledger, width, role));
            out
        }
        None => match equation.ways.last() {
            Some(way) => chain(equation, way, width, role),
            None => Vec::new(),
        },
    }
}

fn chain(equation: &Equation, way: &[super::Link], width: usize, role: Role) -> Vec<Line> {
    let formula = Piece {
        sign: "",
        text: &equation.formula,
        role: Role::Formula,
    };
    let count = way.len();
    // What r² is equal to is no result.
    let pieces = way.iter().enumerate().map(|(i, link)| Piece {
        sign: link.sign.text(),
        text: &link.text,
        role: if i + 1 == count { role } else { Role::Plain },
    });
    let mut out: Vec<Line> = Vec::new();
    let mut line = Line::new(0);
    let mut is_broken = false;
    for piece in std::iter::once(formula).chain(pieces) {
        let lead = if piece.sign.is_empty() {
            String::new()
        } else {
            format!("{} ", piece.sign)
        };
        let length = lead.chars().count() + piece.text.chars().count();
        // A line that starts in the middle of a sum would say that its rest is equal to the result.
        let starts_anew = piece.sign.is_empty() || is_broken;
        is_broken = false;
        if line.width() > 0 && (starts_anew || line.width() + 1 + length > width) {
            out.push(std::mem::replace(
                &mut line,
                Line::new(0).with(Role::Plain, "  "),
            ));
        } else if line.width() > 0 {
            line = line.with(Role::Plain, " ");
        }
        let room = width
            .saturating_sub(line.width() + lead.chars().count())
            .max(8);
        line = line.with(Role::Plain, lead);
        let mut parts = wrap(piece.text, room).into_iter();
        line = line.with(piece.role, parts.next().unwrap_or_default());
        for part in parts {
            out.push(std::mem::replace(
                &mut line,
                Line::new(0).with(Role::Plain, "    "),
            ));
            line = line.with(piece.role, part);
            is_broken = true;
        }
    }
    out.push(line);
    out
}

fn ledger_lines(ledger: &[LedgerEntry], width: usize, role: Role) -> Vec<Line> {
    let labels = ledger
        .iter()
        .map(|e| e.label.chars().count())
        .max()
        .unwrap_or(0);
    let numbers = ledger
        .iter()
        .map(|e| e.number.chars().count())
        .max()
        .unwrap_or(0);
    let indent = if labels + numbers + 4 <= width { 2 } else { 0 };
    let last = ledger.len().saturating_sub(1);
    let line = |(i, entry): (usize, &LedgerEntry)| {
        let role = if i == last { role } else { Role::Plain };
        let gap = labels + numbers + 2;
        let gap = gap.saturating_sub(entry.label.chars().count() + entry.number.chars().count());
        Line::new(0)
            .with(Role::Plain, " ".repeat(indent))
            .with(Role::Formula, entry.label.clone())
            .with(Role::Plain, " ".repeat(gap))
            .with(role, entry.number.clone())
    };
    ledger.iter().enumerate().map(line).collect()
}

fn hanging(text: &str, width: usize, role: Role) -> Vec<Line> {
    let lines = wrap(text, width).into_iter().enumerate();
    lines
        .map(|(i, text)| {
            let lead = if i == 0 { "" } else { "  " };
            Line::new(0).with(Role::Plain, lead).with(role, text)
        })
        .collect()
}

/// A question that waits for an answer, and how to answer it.
pub fn question_lines(question: StepQuestion, width: usize) -> Vec<Line> {
    let mut out = vec![Line::new(0)];
    out.extend(indented(question.text(), width, Role::Label));
    out.extend(indented(&question.hint(), width, Role::Plain));
    out
}

/// What the words mean in which the errors of these steps are told; nothing if all are right.
fn step_words(steps: &[Step], width: usize) -> Vec<Line> {
    let wrong: Vec<_> = steps.iter().filter(|step| step.exact.is_some()).collect();
    if wrong.is_empty() {
        return Vec::new();
    }
    let mut out = vec![Line::of(Role::Faint, EXACTLY)];
    let numbers = || wrong.iter().filter_map(|step| step.number.as_ref());
    out.extend(unit_lines(
        |p| numbers().any(|m| m.precision == p),
        width,
        4,
    ));
    out
}
