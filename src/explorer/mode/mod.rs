//! What keys mean now: actions, or text, or an answer.

pub(crate) mod export_case;
pub(crate) mod line;
pub(crate) mod mouse;

use std::path::PathBuf;
use std::time::Duration;

use crate::explorer::Explorer;
use crate::explorer::action::Action;
use crate::explorer::command::{self, Command};
use crate::explorer::edit::field::{Field, parse_number};
use crate::explorer::files::disk::Over;
use crate::explorer::files::rescue;
use crate::explorer::files::workplace::Workplace;
use crate::explorer::key::Key;
use crate::explorer::mode::line::Line;
use crate::explorer::tour::Tour;
use crate::geometry::Decimal;
use crate::lab::CaseForm;

/// What keys mean now.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Mode {
    Normal,
    Help {
        scroll: usize,
    },
    /// A pixel to take away is shown in this form.
    Case(CaseForm),
    Prompt(Prompt),
    Form(Form),
    Ask(Question),
}

/// A line being typed, and what for.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Prompt {
    pub(crate) purpose: Purpose,
    pub(crate) line: Line,
    /// Completions of what was typed, and which one is shown.
    pub(crate) completions: Option<(Vec<String>, usize)>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Purpose {
    Command,
    Open,
    SaveAs,
}

impl Purpose {
    pub(crate) const fn question(self) -> &'static str {
        match self {
            Self::Command => ":",
            Self::Open => "open: ",
            Self::SaveAs => "save as: ",
        }
    }

    /// The command that the typed text is an argument of.
    const fn prefix(self) -> &'static str {
        match self {
            Self::Command => "",
            Self::Open => "open ",
            Self::SaveAs => "save-as ",
        }
    }
}

/// The list of numbers that can be typed.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Form {
    pub(crate) at: usize,
    pub(crate) typing: Option<Line>,
}

/// What has to be answered before something is lost.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Question {
    Quit,
    Open(String),
    Recover { path: PathBuf, age: Duration },
    Tour,
    Overwrite { path: PathBuf, why: &'static str },
}

impl Question {
    pub(crate) fn text(&self) -> String {
        match self {
            Self::Quit => {
                "Unsaved changes.  s save and quit   D quit without saving   esc stay".into()
            }
            Self::Open(name) => {
                format!("Unsaved changes.  o open {name} without saving   esc stay")
            }
            Self::Recover { age, .. } => format!(
                "Unsaved work of {} ago was kept.  o open it   D delete it   any other key: later",
                rescue::words(*age)
            ),
            Self::Tour => {
                "Unsaved changes.  s save   t start the tour: your scene waits, ctrl-t comes back   esc stay".into()
            }
            Self::Overwrite { path, why } => {
                format!("{} {why}.  o overwrite   esc keep it", path.display())
            }
        }
    }
}

/// A sentence for the person, shown until the next key.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Message {
    pub(crate) text: String,
    pub(crate) warning: bool,
}

impl Explorer {
    /// Text that was pasted goes into a line being typed; it is never a burst of commands.
    pub(crate) fn paste(&mut self, text: &str) -> bool {
        match &mut self.mode {
            Mode::Prompt(Prompt {
                line, completions, ..
            }) => {
                line.insert(text);
                *completions = None;
            }
            Mode::Form(Form {
                typing: Some(line), ..
            }) => line.insert(text),
            _ => self.say("A paste is not taken for keys. Type : first to paste a command."),
        }
        true
    }

    pub(crate) fn press(&mut self, key: Key) {
        if key.is("ctrl-c") {
            return self.interrupt();
        }
        match std::mem::replace(&mut self.mode, Mode::Normal) {
            Mode::Normal => {
                self.quits_once_saved = false;
                if self.prediction.on || self.board {
                    self.refresh();
                }
                if self.answer_prediction(key) {
                    return;
                }
                if let Some(action) = Action::bound_to(key) {
                    self.act(action);
                } else if key.is("esc") {
                    self.picture.changed.fill(false);
                } else {
                    self.say("This key does nothing. ? shows the keys.");
                }
            }
            Mode::Help { scroll } => self.press_in_help(key, scroll),
            Mode::Case(form) => self.press_in_case(key, form),
            Mode::Prompt(prompt) => self.press_in_prompt(key, prompt),
            Mode::Form(form) => self.press_in_form(key, form),
            Mode::Ask(question) => self.answer(key, question),
        }
    }

    /// Ends the program, or asks first if that would lose something.
    pub(crate) fn quit(&mut self) {
        if self.is_worth_saving() {
            self.ask_before_quitting();
        } else {
            self.ended = Some(0);
        }
    }

    /// Ctrl-C ends the program as SIGINT would; with unsaved changes it asks first, once, and if it ends
    /// all the same they are kept as when the terminal is lost.
    pub(crate) fn interrupt(&mut self) {
        if self.is_worth_saving() && self.mode != Mode::Ask(Question::Quit) {
            self.ask_before_quitting();
        } else {
            self.ended = Some(130);
        }
    }

    /// Asks about what is unsaved, in front of it: work that waits behind the tour comes back first.
    pub(crate) fn ask_before_quitting(&mut self) {
        if self.tour.as_ref().is_some_and(Tour::hides_changes) {
            self.leave_tour();
        }
        // What would be saved is the person's own scene.
        self.document.turn_back();
        self.mode = Mode::Ask(Question::Quit);
    }

    pub(crate) fn press_in_help(&mut self, key: Key, scroll: usize) {
        let scroll = if key.is("down") || key.is("j") {
            scroll + 1
        } else if key.is("up") || key.is("k") {
            scroll.saturating_sub(1)
        } else if key.is("pagedown") || key.is("space") {
            scroll + 10
        } else if key.is("pageup") {
            scroll.saturating_sub(10)
        } else {
            return;
        };
        self.scroll_help(scroll);
    }

    pub(crate) fn scroll_help(&mut self, scroll: usize) {
        let scroll = scroll.min(self.help_lines() - 1);
        self.mode = Mode::Help { scroll };
    }

    pub(crate) fn press_in_prompt(&mut self, key: Key, mut prompt: Prompt) {
        if key.is("esc") {
            return;
        }
        if key.is("enter") {
            let line = format!("{}{}", prompt.purpose.prefix(), prompt.line.text());
            match Command::parse(&line) {
                Ok(command) => self.command(command),
                Err(sentence) => {
                    self.warn(sentence);
                    self.mode = Mode::Prompt(prompt);
                }
            }
            return;
        }
        if key.is("tab") || key.is("backtab") {
            prompt.complete(key.is("tab"), &self.workplace);
        } else if prompt.line.edit(key) {
            prompt.completions = None;
        }
        self.mode = Mode::Prompt(prompt);
    }

    pub(crate) fn press_in_form(&mut self, key: Key, mut form: Form) {
        let fields = Field::of(self.scene(), self.selected);
        let last = fields.len() - 1;
        form.at = form.at.min(last);
        if let Some(line) = &mut form.typing {
            if key.is("esc") {
                form.typing = None;
            } else if key.is("enter") {
                let field = fields[form.at];
                if self.set_typed(field, &line.text()) {
                    form.typing = None;
                    form.at = (form.at + 1).min(last);
                }
            } else {
                line.edit(key);
            }
        } else if key.is("esc") || key.is("=") || key.is("q") {
            return;
        } else if key.is("down") || key.is("tab") || key.is("j") {
            form.at = (form.at + 1) % (last + 1);
        } else if key.is("up") || key.is("backtab") || key.is("k") {
            form.at = (form.at + last) % (last + 1);
        } else if key.is("enter") {
            let value = fields[form.at].get(self.scene(), self.selected);
            form.typing = Some(Line::chosen(
                &value.map_or(String::new(), |v| Decimal(v).to_string()),
            ));
        } else if key
            .typed()
            .is_some_and(|c| c.is_ascii_digit() || "+-.−".contains(c))
        {
            let mut line = Line::default();
            line.edit(key);
            form.typing = Some(line);
        } else if key.is("u") {
            self.act(Action::Undo);
        }
        self.mode = Mode::Form(form);
    }

    /// Gives a field the number that was typed; false, with a sentence, if it can't have it.
    pub(crate) fn set_typed(&mut self, field: Field, text: &str) -> bool {
        let change = parse_number(&field.name(), text)
            .and_then(|value| field.set(self.scene(), self.selected, value));
        match change {
            Ok(change) => {
                self.document.apply(change);
                true
            }
            Err(refused) => {
                self.warn(refused.to_string());
                false
            }
        }
    }

    pub(crate) fn answer(&mut self, key: Key, question: Question) {
        match question {
            Question::Quit if key.is("s") => {
                self.quits_once_saved = true;
                self.save();
            }
            // Another key than the one that asked: it may be held down.
            Question::Quit if key.is("D") => self.ended = Some(0),
            Question::Open(name) if key.is("o") => self.open(&name),
            Question::Recover { path, .. } if key.is("o") => self.recover(&path),
            Question::Recover { path, .. } if key.is("D") => self.discard(&path),
            Question::Recover { .. } => {
                self.say(
                    "The unsaved work stays where it is; it is offered again at the next start.",
                );
                if !key.is("esc") {
                    self.press(key);
                }
            }
            Question::Tour if key.is("t") => self.visit_unsaved(),
            Question::Tour if key.is("s") => self.save(),
            Question::Overwrite { path, .. } if key.is("o") => {
                self.write(&path, Over::Anything);
            }
            _ if key.is("esc") || key.is("n") => self.say("Nothing was changed."),
            question => self.mode = Mode::Ask(question),
        }
    }
}

impl Prompt {
    /// Shows the next (or previous) line that what was typed could become.
    fn complete(&mut self, forward: bool, workplace: &Workplace) {
        let prefix = self.purpose.prefix();
        let (lines, at) = if let Some((lines, at)) = self.completions.take() {
            let by = if forward { 1 } else { lines.len() - 1 };
            let at = (at + by) % lines.len();
            (lines, at)
        } else {
            let typed = format!("{prefix}{}", self.line.text());
            (command::complete(&typed, workplace), 0)
        };
        if let Some(line) = lines.get(at) {
            self.line = Line::new(line.strip_prefix(prefix).unwrap_or(line));
            self.completions = Some((lines, at));
        }
    }
}
