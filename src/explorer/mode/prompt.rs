//! A line being typed: a command, or a file's name.

use ratatui::layout::{Position, Rect};
use ratatui::style::Style as CellStyle;
use unicode_width::UnicodeWidthChar;

use crate::explorer::command::{self, Command};
use crate::explorer::dialog::Purpose;
use crate::explorer::draw::pen::Pen;
use crate::explorer::draw::theme::Theme;
use crate::explorer::files::workplace::Workplace;
use crate::explorer::key::Key;
use crate::explorer::mode::line::TypedLine;
use crate::explorer::mode::overlay::{After, Overlay};
use crate::explorer::state::State;

/// A line being typed, and what for.
#[derive(Debug, PartialEq)]
pub(crate) struct Prompt {
    pub(crate) purpose: Purpose,
    line: TypedLine,
    /// Completions of what was typed, and which one is shown.
    completions: Option<(Vec<String>, usize)>,
}

impl Prompt {
    pub(crate) fn new(purpose: Purpose, text: &str) -> Self {
        Self {
            purpose,
            line: TypedLine::new(text),
            completions: None,
        }
    }

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
            self.line = TypedLine::new(line.strip_prefix(prefix).unwrap_or(line));
            self.completions = Some((lines, at));
        }
    }
}

impl Overlay for Prompt {
    fn press(&mut self, key: Key, state: &mut State) -> After {
        if key.is("esc") {
            return After::Close;
        }
        if key.is("enter") {
            let line = format!("{}{}", self.purpose.prefix(), self.line.text());
            return match Command::parse(&line) {
                Ok(command) => After::Do(command),
                Err(sentence) => {
                    state.warn(sentence);
                    After::Stay
                }
            };
        }
        if key.is("tab") || key.is("backtab") {
            self.complete(key.is("tab"), &state.workplace);
        } else if self.line.edit(key) {
            self.completions = None;
        }
        After::Stay
    }

    fn paste(&mut self, text: &str) -> bool {
        self.line.insert(text);
        self.completions = None;
        true
    }

    fn has_footer(&self) -> bool {
        true
    }

    fn draw_footer(&self, state: &State, pen: &mut Pen<'_>, area: Rect) -> Option<Position> {
        let question = self.purpose.question();
        let x = pen.text(area.x, area.y, area.width, question, Theme::strong());
        let room = area.right().saturating_sub(x);
        let text: Vec<char> = self.line.text().chars().collect();
        // A line that is longer than its room scrolls, so that the cursor is always seen.
        let most = usize::from(room.max(1)) - 1;
        let (mut first, mut width) = (self.line.cursor(), 0);
        for c in text[..self.line.cursor()].iter().rev() {
            width += c.width().unwrap_or(0);
            if width > most {
                break;
            }
            first -= 1;
        }
        let shown: String = text[first..].iter().collect();
        let before: usize = text[first..self.line.cursor()]
            .iter()
            .filter_map(|c| c.width())
            .sum();
        let end = pen.text(x, area.y, room, &shown, CellStyle::new());
        let aside = match (&state.message, &self.completions) {
            (Some(message), _) => Some((message.text.clone(), pen.theme.warning())),
            (None, Some((lines, at))) if lines.len() > 1 => {
                Some((format!("{} of {}", at + 1, lines.len()), Theme::faint()))
            }
            _ => None,
        };
        if let Some((text, style)) = aside {
            let room = area.right().saturating_sub(end + 2);
            pen.text(end + 2, area.y, room, &text, style);
        }
        Some(Position::new(x + before as u16, area.y))
    }
}
