//! The text of a routine of one's own, typed beside the picture that follows it.

use ratatui::layout::{Position, Rect};

use crate::explorer::command::Command;
use crate::explorer::dialog::Confirmation;
use crate::explorer::draw::layout::{self, Layout};
use crate::explorer::draw::pen::Pen;
use crate::explorer::key::Key;
use crate::explorer::mode::overlay::{After, ModeArea, Overlay};
use crate::explorer::state::State;
use crate::explorer::typing;
use crate::text;

/// The text is part of the state: it outlives what opens over it.
#[derive(Debug, PartialEq)]
pub(crate) struct RoutineEditor;

/// The most rows that the sentence about an error takes.
const SENTENCE: usize = 4;

impl Overlay for RoutineEditor {
    fn press(&mut self, key: Key, state: &mut State) -> After {
        let Some(open) = &mut state.typing else {
            return After::Close;
        };
        if key.is("ctrl-s") {
            typing::save(state, false);
        } else if !key.is("esc") {
            if open.text.press(key) {
                typing::follow(state);
            }
        } else if open.is_changed() {
            state.ask(Confirmation::CloseText);
        } else {
            return After::Do(Command::CloseText { save: false });
        }
        After::Stay
    }

    fn paste(&mut self, text: &str, state: &mut State) -> bool {
        let Some(open) = &mut state.typing else {
            return false;
        };
        match open.text.paste(text) {
            Ok(()) => typing::follow(state),
            Err(sentence) => state.warn(sentence),
        }
        true
    }

    fn place(&self, _: &Layout) -> ModeArea {
        ModeArea::Panels
    }

    fn draw(&self, state: &State, pen: &mut Pen<'_>, area: Rect) -> Option<Position> {
        let open = state.typing.as_ref()?;
        let is_changed = if open.is_changed() { ", unsaved" } else { "" };
        pen.frame(area, &format!("{}{is_changed}", open.name), "");
        let mut room = layout::inner(area);
        let wrong = pen.theme.warning();
        if let Some((line, problem)) = open.text.error() {
            let sentence = format!("line {line}: {problem}");
            let mut lines = text::wrap(&pen.glyphs.spell(&sentence), room.width.into());
            lines.truncate(SENTENCE.min(usize::from(room.height / 2)));
            room.height -= lines.len() as u16;
            for (y, line) in (room.bottom()..).zip(&lines) {
                pen.text(room.x, y, room.width, line, wrong);
            }
        }
        Some(open.text.draw(room, pen.buffer, wrong))
    }

    fn foot(&self) -> &[(&'static str, &'static str)] {
        &[
            ("ctrl-s", "save"),
            ("esc", "leave"),
            ("ctrl-u", "undo"),
            ("ctrl-r", "redo"),
            ("ctrl-w", "delete the word before"),
        ]
    }
}
