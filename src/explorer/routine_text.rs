//! The text of a routine while it is typed: its keys, its cells, and what is wrong with it.

use std::path::Path;

use ratatui::buffer::Buffer;
use ratatui::layout::{Position, Rect};
use ratatui::style::{Modifier, Style};
use ratatui::widgets::Widget;
use ratatui_textarea::{TextArea, WrapMode};

use crate::explorer::key::Key;
use crate::method::{Method, RoutineId};
use crate::routine::{LONGEST, Language, RoutineError, template};

/// What marks the line with the error, in the column that its number leaves blank.
const MARK: &str = "!";

/// A text that is typed, and whether it is a routine.
#[derive(Debug)]
pub(crate) struct RoutineText {
    area: TextArea<'static>,
    language: Language,
    error: Option<RoutineError>,
}

impl RoutineText {
    /// The text to begin with: that of the file; where there is none yet, that of the chosen method if it has the
    /// name, as on a page of the tour, or the tutorial's function.
    pub(crate) fn of_file(name: &str, path: &Path, chosen: Method) -> Result<String, String> {
        let language = language(name)?;
        if path.symlink_metadata().is_err() {
            return Ok(match chosen {
                Method::Routine(id) if id.name() == name => id.get().text.clone(),
                _ => template(language).to_owned(),
            });
        }
        RoutineId::text_of(path).map_err(|error| error.to_string())
    }

    pub(crate) fn new(name: &str, text: &str) -> Result<Self, String> {
        let mut area: TextArea<'static> = TextArea::from(text.split('\n'));
        area.set_wrap_mode(WrapMode::WordOrGlyph);
        area.set_line_number_style(Style::new().add_modifier(Modifier::DIM));
        // The terminal's own cursor shows where one types.
        area.set_cursor_line_style(Style::new());
        area.set_cursor_style(Style::new());
        Ok(Self {
            area,
            language: language(name)?,
            error: None,
        })
    }

    pub(crate) fn text(&self) -> String {
        self.area.lines().join("\n")
    }

    /// The line with the error, from 1, and what is wrong with it.
    pub(crate) fn error(&self) -> Option<(usize, &str)> {
        let error = self.error.as_ref()?;
        Some((error.line, &error.problem))
    }

    /// Lets a key edit the text; false if it is not for editing.
    pub(crate) fn press(&mut self, key: Key) -> bool {
        if key.typed().is_some() && self.text().len() >= LONGEST {
            return false;
        }
        self.area.input(key.event())
    }

    /// Takes what was pasted, without the characters that nobody sees; why not, if it is too long.
    pub(crate) fn paste(&mut self, text: &str) -> Result<(), String> {
        let text = text.replace("\r\n", "\n").replace('\r', "\n");
        let is_seen = |c: &char| !c.is_control() || matches!(c, '\n' | '\t');
        let text: String = text.chars().filter(is_seen).collect();
        if self.text().len() + text.len() > LONGEST {
            let most = LONGEST / 1024;
            return Err(format!(
                "The paste is not taken: a routine has at most {most} KiB."
            ));
        }
        self.area.insert_str(text);
        Ok(())
    }

    /// The method in the text; with an error, there is none.
    pub(crate) fn compile(&mut self, name: &str, path: &Path) -> Option<Method> {
        let key = path.to_string_lossy();
        let learnt = RoutineId::learn(&key, name, &self.text(), self.language);
        self.error = learnt.as_ref().err().cloned();
        learnt.ok().map(Method::Routine)
    }

    /// Draws the text with the numbers of its lines, and in the style `wrong` the line with the error; the place of
    /// the cursor.
    pub(crate) fn draw(&self, room: Rect, buffer: &mut Buffer, wrong: Style) -> Position {
        let area = &self.area;
        area.render(room, buffer);
        let (top, left) = area.scroll_offset();
        let mut before = None;
        for y in 0..room.height {
            let at = area.screen_to_data(usize::from(top + y), 0);
            // Below the text each row counts as its last.
            if before.replace(at) == Some(at) {
                break;
            }
            if self
                .error
                .as_ref()
                .is_some_and(|error| error.line == at.0 + 1)
            {
                let row = Rect::new(room.x, room.y + y, room.width, 1);
                buffer.set_style(row, wrong);
                buffer[(row.x, row.y)].set_symbol(MARK);
            }
        }
        let cursor = area.screen_cursor();
        let x = (area.line_number_width() + cursor.col as u16).saturating_sub(left);
        let y = (cursor.row as u16).saturating_sub(top);
        Position::new(
            room.x + x.min(room.width.saturating_sub(1)),
            room.y + y.min(room.height.saturating_sub(1)),
        )
    }
}

fn language(name: &str) -> Result<Language, String> {
    Language::of(name).ok_or_else(|| format!("{name}: expected a file that ends in .glsl or .wgsl"))
}
