//! The pixel under the cursor to take away: copied, shown, or appended to a file.

use std::fs::OpenOptions;
use std::io::Write as _;
use std::path::Path;

use ratatui::layout::{Position, Rect};
use ratatui::style::Style as CellStyle;

use crate::door::{self, Expected};
use crate::explorer::command::Command;
use crate::explorer::dialog::Dialog;
use crate::explorer::draw::layout::Layout;
use crate::explorer::draw::pen::Pen;
use crate::explorer::draw::theme::Theme;
use crate::explorer::key::Key;
use crate::explorer::mode::overlay::{After, ModeArea, Overlay};
use crate::explorer::options::Request;
use crate::explorer::state::State;
use crate::lab::{Case, CaseForm, HEADER};

/// What was copied, in this form.
#[derive(Debug, PartialEq)]
pub(crate) struct ExportCase {
    pub(crate) form: CaseForm,
}

impl Overlay for ExportCase {
    fn press(&mut self, key: Key, _: &mut State) -> After {
        if key.is("&") || key.is("tab") {
            After::Do(Command::Copy(self.form.next()))
        } else if key.is("esc") || key.is("enter") {
            After::Close
        } else {
            After::Stay
        }
    }

    fn place(&self, _: &Layout) -> ModeArea {
        ModeArea::Body
    }

    /// What was copied, without a border: where the terminal does not let programs copy, it can be
    /// selected. A line that is too long goes on in the next.
    fn draw(&self, state: &State, pen: &mut Pen<'_>, area: Rect) -> Option<Position> {
        let title = format!(
            "Copied, where the terminal allows it: {}",
            self.form.title()
        );
        let mut y = pen.words(area, &title, Theme::strong()) + 1;
        for line in lines(state, self.form) {
            let chars: Vec<char> = line.chars().collect();
            for part in chars.chunks(usize::from(area.width).max(1)) {
                if y < area.bottom() {
                    let part: String = part.iter().collect();
                    pen.text(area.x, y, area.width, &part, CellStyle::new());
                    y += 1;
                }
            }
        }
        let hint = ":append FILE adds the row to a file.";
        if y + 1 < area.bottom() {
            pen.text(area.x, y + 1, area.width, hint, Theme::faint());
        }
        None
    }

    fn foot(&self) -> &[(&'static str, &'static str)] {
        &[("&", "copy the next form"), ("esc", "back")]
    }
}

/// The sphere that the panel shows, as a case.
fn case(state: &State) -> Option<Case> {
    let reading = state.reading()?;
    let subject = reading.subject.as_ref()?;
    let (x, y) = reading.pixel;
    let number = subject.body + 1;
    let words: Vec<_> = state.scene().name.split_whitespace().collect();
    let name = words.join(" ");
    Some(Case {
        problem: (reading.ray, subject.sphere),
        method: reading.method,
        origin: format!("rayscope: {name}, pixel ({x}, {y}), sphere {number}"),
    })
}

/// Copies the pixel in this form and shows what was copied: not every terminal lets programs copy.
pub(crate) fn copy(state: &mut State, form: CaseForm) {
    match case(state) {
        Some(case) => {
            state.request = Some(Request::Copy(case.text(form)));
            state.open(Dialog::Case(form));
        }
        None => state.say("The scene has no spheres: there is nothing to copy."),
    }
}

/// The lines of the case that is shown.
pub(crate) fn lines(state: &State, form: CaseForm) -> Vec<String> {
    let text = case(state).map_or(String::new(), |case| case.text(form));
    text.lines().map(str::to_owned).collect()
}

/// Appends the pixel's row to a file of rows, which is made if it is not there.
pub(crate) fn append(state: &mut State, path: &Path) {
    let Some(case) = case(state) else {
        return state.say("The scene has no spheres: there is nothing to append.");
    };
    match append_row(path, &case.row()) {
        Ok(rows) => {
            let plural = if rows == 1 { "" } else { "s" };
            state.say(format!("{} has {rows} row{plural} now.", path.display()));
        }
        Err(reason) => state.warn(format!("{}: not appended: {reason}", path.display())),
    }
}

/// The file that rows are appended to.
const CASES: Expected = Expected {
    what: "a CSV file",
    most: 256 << 20,
};

/// Appends a row to a file that has the header of rows; how many rows it has then.
fn append_row(path: &Path, row: &str) -> Result<usize, String> {
    let mut file = door::regular(OpenOptions::new().append(true).create(true), path)
        .map_err(|e| e.to_string())?;
    let before = CASES.text(path).map_err(|e| e.problem)?;
    let first = before.lines().next();
    if first.is_some_and(|line| line.trim_end() != HEADER) {
        return Err(format!("its first line is not {HEADER}"));
    }
    let mut added = String::new();
    if first.is_none() {
        added += HEADER;
        added.push('\n');
    } else if !before.ends_with('\n') {
        added.push('\n');
    }
    added += row;
    added.push('\n');
    file.write_all(added.as_bytes())
        .map_err(|e| e.to_string())?;
    let rows = before
        .lines()
        .skip(1)
        .filter(|line| !line.trim().is_empty());
    Ok(rows.count() + 1)
}
