//! A question that has to be answered before something is lost.

use ratatui::layout::{Position, Rect};

use crate::explorer::action::Action;
use crate::explorer::command::Command;
use crate::explorer::dialog::Confirmation;
use crate::explorer::draw::pen::Pen;
use crate::explorer::draw::theme::Theme;
use crate::explorer::files::keep;
use crate::explorer::key::Key;
use crate::explorer::mode::overlay::{After, Overlay};
use crate::explorer::state::State;

/// A question that waits for its answer.
#[derive(Debug, PartialEq)]
pub(crate) struct Asking {
    pub(crate) question: Confirmation,
    /// Whether it was on the screen when the next key was pressed, as far as is known.
    pub(crate) is_shown: bool,
}

impl Confirmation {
    /// Whether something is lost by this answer.
    fn loses_by(&self, key: Key) -> bool {
        match self {
            Self::Quit | Self::CloseText | Self::Recover { .. } => key.is("D"),
            Self::Open(_) | Self::Go(_) | Self::Overwrite { .. } => key.is("o"),
            Self::Tour => false,
        }
    }
}

impl Overlay for Asking {
    fn press(&mut self, key: Key, state: &mut State) -> After {
        match &self.question {
            // Nobody can have meant it who had not read it.
            question if question.loses_by(key) && !self.is_shown => After::Stay,
            Confirmation::Quit if key.is("s") => After::Do(Command::SaveAndQuit),
            // Another key than the one that asked: it may be held down.
            Confirmation::Quit if key.is("D") => After::Do(Command::QuitNow),
            Confirmation::Open(name) if key.is("o") => After::Do(Command::OpenNow(name.clone())),
            Confirmation::Go(link) if key.is("o") => After::Do(Command::GoNow(link.clone())),
            Confirmation::Recover { path, .. } if key.is("o") => {
                After::Do(Command::Recover(path.clone()))
            }
            Confirmation::Recover { .. } if key.is("D") => After::Do(Command::Discard),
            Confirmation::Recover { .. } if key.is("esc") || key.is("n") => {
                keep::put_off(state);
                After::Close
            }
            Confirmation::Recover { .. } if key.is("q") => {
                keep::put_off(state);
                After::Do(Command::Do(Action::Quit))
            }
            Confirmation::CloseText if key.is("s") => After::Do(Command::CloseText { save: true }),
            Confirmation::CloseText if key.is("D") => After::Do(Command::CloseText { save: false }),
            Confirmation::Tour if key.is("t") => After::Do(Command::TourNow),
            Confirmation::Tour if key.is("s") => After::Do(Command::Do(Action::Save)),
            Confirmation::Overwrite { path, .. } if key.is("o") => {
                After::Do(Command::Overwrite(path.clone()))
            }
            _ if key.is("esc") => {
                state.say("Nothing was changed.");
                After::Close
            }
            _ => After::Stay,
        }
    }

    fn has_footer(&self) -> bool {
        true
    }

    fn draw_footer(&self, _: &State, pen: &mut Pen<'_>, area: Rect) -> Option<Position> {
        pen.message(area, &self.question.text(), Theme::strong());
        None
    }
}
