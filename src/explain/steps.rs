//! The steps of a derivation as lines of text: one step large, and the list of all.

use super::derivation::{Step, StepQuestion};
use super::panel::{EXACTLY, Line, Role, unit_lines};
use crate::text::{Glyphs, wrap};

/// How a step is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct StepLook {
    /// The result is kept back until the person has thought about it.
    pub hidden: bool,
    /// The result is another one than before the last move.
    pub changed: bool,
}

/// What stands for a result that is kept back.
const HIDDEN: &str = "?";

/// One step, in lines of at most `width` characters.
pub fn step_lines(step: &Step, width: usize, look: StepLook) -> Vec<Line> {
    let mut out = Vec::new();
    out.extend(hanging(&step.why, width, Role::Plain, "", 2));
    out.push(Line::new(5));
    let name = format!("{} = ", step.name);
    let names_itself = step.formula.contains('=') || step.formula == step.name;
    let head = if names_itself || step.name.len() > 4 {
        String::new()
    } else {
        name
    };
    out.extend(hanging(
        &format!("{head}{}", step.formula),
        width,
        Role::Formula,
        "",
        0,
    ));
    let numbers = step.numbers_beside(look.hidden);
    if !numbers.is_empty() {
        out.extend(hanging(numbers, width, Role::Plain, lead(numbers), 1));
    }
    if look.hidden {
        out.extend(hanging(HIDDEN, width, Role::Value, "= ", 0));
    } else if !step.result.is_empty() {
        let role = if look.changed {
            Role::Changed
        } else {
            Role::Value
        };
        out.extend(hanging(&step.result, width, role, lead(&step.result), 0));
    }
    if !look.hidden {
        out.extend(loss_lines(step, width));
    }
    // The line of the program that was taken tells which way it went.
    let code_tells = look.hidden && (step.question.is_some() || step.numbers_tell);
    if !step.code.is_empty() && !code_tells {
        out.push(Line::new(5));
        out.extend(hanging(&step.code, width, Role::Faint, "", 3));
    }
    out
}

/// What stands before a line: an equals sign, unless the line is a sentence or an equation itself.
fn lead(text: &str) -> &'static str {
    if text.contains(['<', '>', '≤']) || text.contains(": ") || text.contains(" = ") {
        ""
    } else {
        "= "
    }
}

/// A question that waits for an answer, and the keys that answer it.
pub fn question_lines(question: StepQuestion, width: usize, glyphs: Glyphs) -> Vec<Line> {
    let mut out = vec![Line::new(4)];
    let text = glyphs.spell(question.text());
    out.extend(hanging(&text, width, Role::Label, "", 0));
    out.extend(hanging(&question.keys(), width, Role::Plain, "", 0));
    out
}

/// What rounding did in this step.
fn loss_lines(step: &Step, width: usize) -> Vec<Line> {
    let mut out = Vec::new();
    if let Some(exact) = &step.exact {
        out.extend(hanging(
            &format!("exactly {exact}"),
            width,
            Role::Faint,
            "",
            1,
        ));
    }
    for (i, loss) in step.losses.iter().enumerate() {
        let role = if step.first_heavy && i == 0 {
            Role::Warning
        } else {
            Role::Faint
        };
        out.extend(hanging(loss, width, role, "", 1));
    }
    out
}

/// What the words mean in which the errors of these steps are told; nothing if all are right.
pub fn step_words(steps: &[Step], width: usize) -> Vec<Line> {
    let wrong: Vec<_> = steps.iter().filter(|step| step.exact.is_some()).collect();
    if wrong.is_empty() {
        return Vec::new();
    }
    let mut out = hanging(EXACTLY, width, Role::Faint, "", 4);
    let numbers = || wrong.iter().filter_map(|step| step.number.as_ref());
    out.extend(unit_lines(
        |p| numbers().any(|m| m.precision == p),
        width,
        4,
    ));
    out
}

/// The names of all steps, wrapped, the current one marked; those whose result has changed have a
/// star, the first that loses much an exclamation mark.
///
/// Without `foresight` the list ends with the current one: which steps follow tells how it comes out.
pub fn step_list(
    steps: &[Step],
    current: usize,
    changed: &[bool],
    foresight: bool,
    width: usize,
) -> Vec<Line> {
    let count = if foresight { steps.len() } else { current + 1 };
    let mut out = Vec::new();
    let mut line = Line::new(4);
    for (i, step) in steps.iter().enumerate().take(count) {
        let mut name = step.name.clone();
        if step.first_heavy {
            name.push('!');
        }
        // The star has a place of its own, so that the names stay where they are.
        let is_changed = changed.get(i).copied().unwrap_or(false);
        let star = if is_changed { '*' } else { ' ' };
        let (role, text) = match (i == current, step.first_heavy) {
            (true, _) if is_changed => (Role::Current, format!("[{name}*]")),
            (true, _) => (Role::Current, format!("[{name}]")),
            (false, true) => (Role::Warning, format!(" {name}{star}")),
            (false, false) => (Role::Faint, format!(" {name}{star}")),
        };
        if line.width() + text.chars().count() > width && line.width() > 0 {
            out.push(std::mem::replace(&mut line, Line::new(4)));
        }
        line = line.with(role, text);
        if i == current && !is_changed {
            line = line.with(Role::Plain, " ");
        }
    }
    out.push(line);
    out
}

/// The whole derivation as plain text, a paragraph for each step.
pub fn steps_text(steps: &[Step], width: usize) -> String {
    let mut out = String::new();
    for (i, step) in steps.iter().enumerate() {
        out = out + &(i + 1).to_string() + ". " + &step.name + "\n";
        let lines = step_lines(
            step,
            width.saturating_sub(INDENT.len()),
            StepLook::default(),
        );
        let texts = lines.iter().map(Line::text).filter(|t| !t.is_empty());
        for text in texts {
            out = out + INDENT + &text + "\n";
        }
        out.push('\n');
    }
    for line in step_words(steps, width) {
        out = out + &line.text() + "\n";
    }
    out
}

/// Where a step's lines stand under its name.
const INDENT: &str = "    ";

/// Text, whose lines stay apart, in lines of at most `width` characters; those after the first stand
/// under it, and go with it: a sentence that ends in its middle says less than none.
fn hanging(text: &str, width: usize, role: Role, lead: &str, spare: u8) -> Vec<Line> {
    let room = width.saturating_sub(lead.chars().count()).max(1);
    text.lines()
        .flat_map(|part| wrap(part, room))
        .enumerate()
        .map(|(i, part)| {
            let lead = if i == 0 {
                lead.to_owned()
            } else {
                " ".repeat(lead.chars().count())
            };
            let line = if i == 0 {
                Line::new(spare)
            } else {
                Line::joined(spare)
            };
            line.with(Role::Plain, lead).with(role, part)
        })
        .collect()
}
