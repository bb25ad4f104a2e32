//! What the explorer may have to ask or show before it goes on: data only.

use std::path::PathBuf;
use std::time::Duration;

use crate::explorer::link::Link;
use crate::lab::CaseForm;

/// Something that opens over the screen and hears the keys first.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Dialog {
    /// All actions, in columns.
    Menu,
    /// The keys.
    Help,
    /// A pixel to take away, in this form.
    Case(CaseForm),
    /// A line to be typed, which begins with this text.
    Prompt(Purpose, String),
    /// The numbers that can be typed.
    Form,
    /// The text of a routine.
    RoutineText,
    /// A question to be answered.
    Ask(Confirmation),
}

/// What a typed line is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Purpose {
    Command,
    Open,
    SaveAs,
}

impl Purpose {
    /// What is written before the line.
    pub(crate) const fn question(self) -> &'static str {
        match self {
            Self::Command => ":",
            Self::Open => "open: ",
            Self::SaveAs => "save as: ",
        }
    }

    /// The command that the typed text is an argument of.
    pub(crate) const fn prefix(self) -> &'static str {
        match self {
            Self::Command => "",
            Self::Open => "open ",
            Self::SaveAs => "save-as ",
        }
    }
}

/// What has to be answered before something is lost.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Confirmation {
    Quit,
    Open(String),
    Go(Link),
    Recover { path: PathBuf, age: Duration },
    Tour,
    CloseText,
    Overwrite { path: PathBuf, why: &'static str },
}

impl Confirmation {
    /// The question and the keys that answer it.
    pub(crate) fn text(&self) -> String {
        match self {
            Self::Quit => {
                "Unsaved changes.  s save and quit   D quit without saving   esc stay".into()
            }
            Self::Open(name) => {
                format!("Unsaved changes.  o open {name} without saving   esc stay")
            }
            Self::Go(_) => {
                "Unsaved changes.  o open the pasted view without saving   esc stay".into()
            }
            Self::Recover { age, .. } => format!(
                "Unsaved work of {} ago was kept.  o open it   D delete it   esc later",
                in_words(*age)
            ),
            Self::Tour => {
                "Unsaved changes.  s save   t start the tour: your scene waits   esc stay".into()
            }
            Self::CloseText => {
                "The text is not saved.  s save   D drop what was typed   esc go on typing".into()
            }
            Self::Overwrite { path, why } => {
                format!("{} {why}.  o overwrite   esc keep it", path.display())
            }
        }
    }
}

/// An age in the largest unit of which there is one: `3 hours`.
pub(crate) fn in_words(age: Duration) -> String {
    let seconds = age.as_secs();
    let (count, unit) = match seconds {
        0..60 => (seconds, "second"),
        60..3600 => (seconds / 60, "minute"),
        3600..86400 => (seconds / 3600, "hour"),
        _ => (seconds / 86400, "day"),
    };
    let plural = if count == 1 { "" } else { "s" };
    format!("{count} {unit}{plural}")
}

/// A sentence for the person, shown until the next key.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Message {
    pub(crate) text: String,
    pub(crate) warning: bool,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ages_are_in_words() {
        let age = |seconds| in_words(Duration::from_secs(seconds));
        assert_eq!(age(1), "1 second");
        assert_eq!(age(7300), "2 hours");
        assert_eq!(age(90_000), "1 day");
    }
}
