//! What the commands write: reports to standard output and to files, complaints to standard error.

use std::fmt;
use std::io::{self, ErrorKind, Write};
use std::path::Path;

use super::failure::{DONE, Failure, Outcome};
use crate::door::{plain, shown};
use crate::text::{printable, printable_line};

/// Writes a report to standard output, with nothing from outside in it that steers a terminal.
pub(super) fn write_out(text: &str) -> Outcome {
    write_picture(&printable(text))
}

/// Writes a picture, whose colours are escape sequences, to standard output.
pub(super) fn write_picture(text: &str) -> Outcome {
    let mut out = io::stdout().lock();
    let written = out.write_all(text.as_bytes()).and_then(|()| out.flush());
    written.or_else(|error| unwritable(&error))?;
    Ok(DONE)
}

/// What a failed write to standard output means: a reader that closed it early has seen enough.
pub(super) fn unwritable(error: &io::Error) -> Result<(), Failure> {
    match error.kind() {
        ErrorKind::BrokenPipe => Ok(()),
        _ => Err(Failure::invalid(format_args!(
            "standard output: {}",
            plain(error)
        ))),
    }
}

/// Writes a file if one is asked for.
pub(super) fn save(path: Option<&Path>, contents: impl FnOnce() -> String) -> Result<(), Failure> {
    let Some(path) = path else {
        return Ok(());
    };
    std::fs::write(path, contents()).map_err(|error| {
        Failure::invalid(format_args!(
            "cannot write {}: {}",
            path.display(),
            plain(&error)
        ))
    })
}

/// Says a sentence on standard error. If nobody can read it, nobody is missing it.
pub(super) fn complain(sentence: impl fmt::Display) {
    let sentence = sentence.to_string();
    let _ = writeln!(io::stderr(), "rayscope: {}", printable_line(&sentence));
}

/// Complaints about the rows of a file: the first are said, the others counted.
pub(super) struct Complaints {
    file: String,
    count: u64,
}

impl Complaints {
    /// How many are said.
    const SAID: u64 = 100;

    /// No complaint yet about that file.
    pub fn about(path: &Path) -> Self {
        Self {
            file: shown(path),
            count: 0,
        }
    }

    /// Why the row that begins in that line is refused.
    pub fn row(&mut self, line: u64, reason: impl fmt::Display) {
        self.count += 1;
        if self.count <= Self::SAID {
            complain(format_args!("{}: line {line}, {reason}", self.file));
        }
    }

    /// Says how many were not said; whether there were any at all.
    pub fn end(&self) -> bool {
        let plural = |n| if n == 1 { "row is" } else { "rows are" };
        if let Some(more @ 1..) = self.count.checked_sub(Self::SAID) {
            complain(format_args!(
                "{}: {more} more {} invalid",
                self.file,
                plural(more)
            ));
        }
        self.count > 0
    }
}
