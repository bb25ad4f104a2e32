//! What opens over the screen and hears the keys first: each a file with its state, its keys, how it
//! is drawn and its foot. Modes form a stack; with none open, keys are actions.

pub(crate) mod export_case;
pub(crate) mod form;
pub(crate) mod help;
pub(crate) mod line;
mod menu;
pub(crate) mod overlay;
mod prompt;
mod question;
mod routine;

use crate::explorer::dialog::{Confirmation, Dialog};
use crate::explorer::mode::overlay::Overlay;

pub(crate) use export_case::ExportCase;
pub(crate) use form::NumbersForm;
pub(crate) use help::Help;
pub(crate) use menu::Menu;
pub(crate) use prompt::Prompt;
pub(crate) use question::Asking;
pub(crate) use routine::RoutineEditor;

/// A mode that is open.
#[derive(Debug, PartialEq)]
pub(crate) enum Mode {
    Menu(Menu),
    Help(Help),
    Case(ExportCase),
    Prompt(Prompt),
    Form(NumbersForm),
    Routine(RoutineEditor),
    Asking(Asking),
}

impl Mode {
    pub(crate) fn of(dialog: Dialog) -> Self {
        match dialog {
            Dialog::Menu => Self::Menu(Menu::default()),
            Dialog::Help => Self::Help(Help::default()),
            Dialog::Case(form) => Self::Case(ExportCase { form }),
            Dialog::Prompt(purpose, text) => Self::Prompt(Prompt::new(purpose, &text)),
            Dialog::Form => Self::Form(NumbersForm::default()),
            Dialog::RoutineText => Self::Routine(RoutineEditor),
            Dialog::Ask(question) => Self::Asking(Asking {
                question,
                is_shown: false,
            }),
        }
    }

    pub(crate) fn layer(&self) -> &dyn Overlay {
        match self {
            Self::Menu(mode) => mode,
            Self::Help(mode) => mode,
            Self::Case(mode) => mode,
            Self::Prompt(mode) => mode,
            Self::Form(mode) => mode,
            Self::Routine(mode) => mode,
            Self::Asking(mode) => mode,
        }
    }

    pub(crate) fn layer_mut(&mut self) -> &mut dyn Overlay {
        match self {
            Self::Menu(mode) => mode,
            Self::Help(mode) => mode,
            Self::Case(mode) => mode,
            Self::Prompt(mode) => mode,
            Self::Form(mode) => mode,
            Self::Routine(mode) => mode,
            Self::Asking(mode) => mode,
        }
    }

    /// The question that waits for an answer.
    pub(crate) const fn question(&self) -> Option<&Confirmation> {
        match self {
            Self::Asking(Asking { question, .. }) => Some(question),
            _ => None,
        }
    }
}
