//! A line being typed: a command, or a file's name. What it could become is listed above it.

use ratatui::layout::{Position, Rect};
use ratatui::style::Style as CellStyle;
use ratatui::widgets::{Clear, Widget};
use unicode_width::{UnicodeWidthChar, UnicodeWidthStr};

use crate::explorer::command::{Candidate, Command, candidates};
use crate::explorer::dialog::Purpose;
use crate::explorer::draw::pen::Pen;
use crate::explorer::draw::theme::Theme;
use crate::explorer::key::Key;
use crate::explorer::mode::line::TypedLine;
use crate::explorer::mode::overlay::{After, Overlay};
use crate::explorer::state::State;

/// The most candidates that are listed at once.
const LISTED: usize = 9;

/// A line being typed, and what for.
#[derive(Debug, PartialEq)]
pub(crate) struct Prompt {
    pub(crate) purpose: Purpose,
    line: TypedLine,
    /// What the text that was typed could become, and which of it is on the line now.
    candidates: Vec<Candidate>,
    chosen: Option<usize>,
}

impl Prompt {
    pub(crate) fn new(purpose: Purpose, text: &str) -> Self {
        Self {
            purpose,
            line: TypedLine::new(text),
            candidates: Vec::new(),
            chosen: None,
        }
    }

    /// Looks up what the line could become.
    fn look_up(&mut self, state: &State) {
        let typed = format!("{}{}", self.purpose.prefix(), self.line.text());
        self.candidates = candidates(&typed, &state.workplace);
        self.chosen = None;
    }

    /// Puts the next (or previous) candidate on the line.
    fn choose(&mut self, forward: bool, state: &State) {
        if self.chosen.is_none() {
            self.look_up(state);
        }
        let Some(last) = self.candidates.len().checked_sub(1) else {
            return;
        };
        let at = match (self.chosen, forward) {
            (Some(at), true) if at < last => at + 1,
            (Some(at), false) if at > 0 => at - 1,
            (_, true) => 0,
            (_, false) => last,
        };
        let line = &self.candidates[at].line;
        let line = line.strip_prefix(self.purpose.prefix()).unwrap_or(line);
        self.line = TypedLine::new(line);
        self.chosen = Some(at);
    }

    /// The candidates over the footer.
    fn draw_candidates(&self, pen: &mut Pen<'_>, footer: Rect) {
        let first = (self.chosen.unwrap_or(0) + 1).saturating_sub(LISTED);
        let room = usize::from(footer.y.saturating_sub(1)).min(LISTED);
        let shown = self.candidates.iter().enumerate().skip(first).take(room);
        let top = footer.y - shown.len() as u16;
        let area = Rect::new(footer.x, top, footer.width, footer.y - top);
        Clear.render(area, pen.buffer);
        for (y, (n, candidate)) in (top..).zip(shown) {
            let style = if Some(n) == self.chosen {
                Theme::chosen()
            } else {
                CellStyle::new()
            };
            let line = Rect {
                y,
                height: 1,
                ..area
            };
            candidate.draw(pen, line, style);
        }
    }
}

impl Candidate {
    fn draw(&self, pen: &mut Pen<'_>, area: Rect, style: CellStyle) {
        let Rect { x, y, width, .. } = area;
        pen.text(x, y, width, &" ".repeat(width.into()), style);
        let room = |from: u16| area.right().saturating_sub(from);
        let end = pen.text(
            x + 1,
            y,
            room(x + 1),
            &self.line,
            style.patch(Theme::strong()),
        );
        let keys = (x + 22).max(end + 1);
        let end = pen.text(keys, y, room(keys), &self.keys, style);
        let help = (x + 33).max(end + 1);
        pen.text(help, y, room(help), self.help, style);
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
        if key.is("tab") || key.is("down") {
            self.choose(true, state);
        } else if key.is("backtab") || key.is("up") {
            self.choose(false, state);
        } else if self.line.edit(key) {
            self.look_up(state);
        }
        After::Stay
    }

    fn paste(&mut self, text: &str, _: &mut State) -> bool {
        self.line.insert(text);
        self.candidates.clear();
        self.chosen = None;
        true
    }

    fn has_footer(&self) -> bool {
        true
    }

    fn draw_footer(&self, state: &State, pen: &mut Pen<'_>, area: Rect) -> Option<Position> {
        if !self.line.text().is_empty() {
            self.draw_candidates(pen, area);
        }
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
        let before: String = text[first..self.line.cursor()].iter().collect();
        let end = pen.text(x, area.y, room, &shown, CellStyle::new());
        let aside = match (&state.message, self.candidates.len()) {
            (Some(message), _) => (message.text.clone(), pen.theme.warning()),
            (None, 0) if text.is_empty() => {
                let hint = "type a word, tab chooses, enter does it, esc leaves";
                (hint.to_owned(), Theme::faint())
            }
            (None, 0) => (String::new(), Theme::faint()),
            (None, count) => {
                let at = self
                    .chosen
                    .map_or(String::new(), |at| format!("{} of ", at + 1));
                (format!("{at}{count}   tab chooses"), Theme::faint())
            }
        };
        let room = area.right().saturating_sub(end + 2);
        pen.text(end + 2, area.y, room, &aside.0, aside.1);
        Some(Position::new(x + before.width() as u16, area.y))
    }
}
