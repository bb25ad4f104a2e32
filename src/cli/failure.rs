//! How a command ends: with an exit status, or with a failure that has a status and a sentence.

use std::fmt;

/// The exit status where all was done.
pub(super) const DONE: u8 = 0;

/// The exit status where some input was invalid.
pub(super) const INVALID: u8 = 1;

/// The exit status where the program was called wrongly.
const MISUSED: u8 = 2;

/// The exit status of a command, or why it could not do what was asked.
pub(super) type Outcome = Result<u8, Failure>;

/// Why a command could not do what was asked, and the exit status that says so.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Failure {
    pub status: u8,
    pub sentence: String,
}

impl Failure {
    /// Some input was invalid, or something could not be read or written.
    pub fn invalid(sentence: impl fmt::Display) -> Self {
        Self {
            status: INVALID,
            sentence: sentence.to_string(),
        }
    }

    /// The program was called wrongly.
    pub fn misused(sentence: impl fmt::Display) -> Self {
        Self {
            status: MISUSED,
            sentence: sentence.to_string(),
        }
    }
}
