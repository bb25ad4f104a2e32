//! The pixel under the cursor to take away: copied, shown, or appended to a file.

use std::fs::OpenOptions;
use std::io::Write as _;
use std::path::Path;

use crate::door::{self, Expected};
use crate::explorer::key::Key;
use crate::explorer::mode::Mode;
use crate::explorer::{Explorer, Request};
use crate::lab::{Case, CaseForm, HEADER};

impl Explorer {
    /// The sphere that the panel shows, as a case.
    fn case(&self) -> Option<Case> {
        let reading = self.reading()?;
        let subject = reading.subject.as_ref()?;
        let (x, y) = reading.pixel;
        let number = subject.body + 1;
        let name: String = self
            .scene()
            .name
            .split_whitespace()
            .collect::<Vec<_>>()
            .join(" ");
        Some(Case {
            problem: (reading.ray, subject.sphere),
            method: reading.method,
            origin: format!("rayscope: {name}, pixel ({x}, {y}), sphere {number}"),
        })
    }

    /// Copies the pixel in this form and shows what was copied: not every terminal lets programs
    /// copy.
    pub(crate) fn copy_case(&mut self, form: CaseForm) {
        // The cursor may have moved since the pixel was last read.
        let (cols, rows) = self.screen;
        self.prepare(cols, rows);
        match self.case() {
            Some(case) => {
                self.request = Some(Request::Copy(case.text(form)));
                self.mode = Mode::Case(form);
            }
            None => self.say("The scene has no spheres: there is nothing to copy."),
        }
    }

    /// The lines of the case that is shown.
    pub(crate) fn case_lines(&self, form: CaseForm) -> Vec<String> {
        let text = self.case().map_or(String::new(), |case| case.text(form));
        text.lines().map(str::to_owned).collect()
    }

    pub(crate) fn press_in_case(&mut self, key: Key, form: CaseForm) {
        if key.is("&") || key.is("tab") {
            self.copy_case(form.next());
        }
    }

    /// Appends the pixel's row to a file of rows, which is made if it is not there.
    pub(crate) fn append_case(&mut self, path: &Path) {
        let (cols, rows) = self.screen;
        self.prepare(cols, rows);
        let Some(case) = self.case() else {
            return self.say("The scene has no spheres: there is nothing to append.");
        };
        match append(path, &case.row()) {
            Ok(rows) => {
                let plural = if rows == 1 { "" } else { "s" };
                self.say(format!("{} has {rows} row{plural} now.", path.display()));
            }
            Err(reason) => self.warn(format!("{}: not appended: {reason}", path.display())),
        }
    }
}

/// The file that rows are appended to.
const CASES: Expected = Expected {
    what: "a CSV file",
    most: 256 << 20,
};

/// Appends a row to a file that has the header of rows; how many rows it has then.
fn append(path: &Path, row: &str) -> Result<usize, String> {
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
