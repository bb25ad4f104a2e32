//! Writes text, borders and lines with roles into cells.
//!
//! Borders are ratatui's blocks. Its paragraphs and tables are not used for text, since they cut
//! what is too long without a mark and know nothing of spelling in ASCII, where a longer spelling
//! takes its room from the gap behind it.

use ratatui::buffer::Buffer;
use ratatui::layout::{Position, Rect};
use ratatui::style::Style as CellStyle;
use ratatui::symbols::border;
use ratatui::widgets::{Block, Clear, Widget};
use unicode_width::UnicodeWidthStr;

use crate::explain::{Line, Role, Span};
use crate::explorer::draw::theme::Theme;
use crate::text::{self, Glyphs};

/// A border in ASCII.
const ASCII_BORDER: border::Set<'static> = border::Set {
    top_left: "+",
    top_right: "+",
    bottom_left: "+",
    bottom_right: "+",
    vertical_left: "|",
    vertical_right: "|",
    horizontal_top: "-",
    horizontal_bottom: "-",
};

/// Writes text into cells: cut at the edge, spelt in the characters that there are.
pub(crate) struct Pen<'a> {
    pub(crate) buffer: &'a mut Buffer,
    pub(crate) glyphs: Glyphs,
    pub(crate) theme: Theme,
}

impl Pen<'_> {
    /// Writes `text` from (x, y) in at most `room` columns; returns the column after it.
    pub(crate) fn text(&mut self, x: u16, y: u16, room: u16, text: &str, style: CellStyle) -> u16 {
        if !self.buffer.area.contains(Position::new(x, y)) {
            return x;
        }
        let text = self.glyphs.spell(text);
        let cut = if text.width() > room.into() {
            cut(&text, room.into(), self.glyphs.spell("…").as_str())
        } else {
            text
        };
        self.buffer.set_stringn(x, y, cut, room.into(), style).0
    }

    /// A border around `area` with a title in its upper and one in its lower edge.
    pub(crate) fn frame(&mut self, area: Rect, title: &str, foot: &str) {
        if area.width < 2 || area.height < 2 {
            return;
        }
        let lines = match self.glyphs {
            Glyphs::Unicode => border::PLAIN,
            Glyphs::Ascii => ASCII_BORDER,
        };
        Block::bordered()
            .border_set(lines)
            .border_style(Theme::border())
            .render(area, self.buffer);
        let bottom = area.bottom() - 1;
        for (y, text) in [(area.top(), title), (bottom, foot)] {
            self.border_text(area, y, text, None);
        }
    }

    /// Words in the border of `area`: on the left, or on the right if there they cover the mark in
    /// column `mark`.
    pub(crate) fn border_text(&mut self, area: Rect, y: u16, text: &str, mark: Option<u16>) {
        let room = area.width.saturating_sub(4);
        if text.is_empty() || room <= 4 {
            return;
        }
        let text = format!(" {text} ");
        let width = (text.width() as u16).min(room);
        let (left, right) = (area.x + 2, area.right() - 2 - width);
        let covers = |x: u16| mark.is_some_and(|mark| (x..x + width).contains(&mark));
        let x = if covers(left) && !covers(right) {
            right
        } else {
            left
        };
        self.text(x, y, width, &text, CellStyle::new());
    }

    /// Words at the right end of the upper edge of a border, if they leave its title room.
    pub(crate) fn corner(&mut self, area: Rect, text: &str) {
        let text = format!(" {text} ");
        let width = text.width() as u16;
        if 2 * (width + 2) <= area.width {
            let x = area.right() - width - 2;
            self.text(x, area.y, width, &text, CellStyle::new());
        }
    }

    /// A message over the footer; one that is too long for a line covers the lines above.
    pub(crate) fn message(&mut self, footer: Rect, text: &str, style: CellStyle) {
        let room = footer.width.saturating_sub(2);
        let lines = text::wrap(&self.glyphs.spell(text), room.into());
        let count = (lines.len() as u16).min(footer.y);
        let top = footer.bottom() - count;
        Clear.render(Rect::new(footer.x, top, footer.width, count), self.buffer);
        for (y, line) in (top..footer.bottom()).zip(&lines) {
            self.text(footer.x + 1, y, room, line, style);
        }
    }

    /// Words, wrapped to the width of `area`; returns the row after them.
    pub(crate) fn words(&mut self, area: Rect, text: &str, style: CellStyle) -> u16 {
        let lines = text::wrap(text, area.width.into());
        for (y, line) in (area.top()..area.bottom()).zip(&lines) {
            self.text(area.x, y, area.width, line, style);
        }
        area.bottom().min(area.y + lines.len() as u16)
    }

    /// Lines with roles, from the top of `area`.
    pub(crate) fn lines(&mut self, area: Rect, lines: &[Line]) {
        for (y, line) in (area.top()..area.bottom()).zip(lines) {
            let mut spelt = self.spelt(line, false);
            // A number may get longer: its formula is not to jump when it does.
            let room = |(text, role): &(String, Role)| match role {
                Role::Value => text.width().max(LONG),
                _ => text.width(),
            };
            // An equation has been laid out for its room.
            let is_table = line
                .spans
                .first()
                .is_some_and(|span| span.role == Role::Label);
            let width: usize = if is_table {
                spelt.iter().map(room).sum()
            } else {
                spelt.iter().map(|(text, _)| text.width()).sum()
            };
            if width > usize::from(area.width) {
                spelt = self.spelt(line, true);
            }
            let mut x = area.x;
            for (text, role) in spelt {
                let room = area.right().saturating_sub(x);
                x = self.text(x, y, room, &text, self.theme.role(role));
            }
        }
    }

    /// A line in the characters that there are; `tight` writes its formulas without blanks, so that
    /// the numbers behind them are not cut.
    fn spelt(&self, line: &Line, tight: bool) -> Vec<(String, Role)> {
        let mut longer = 0;
        let spell = |span: &Span| {
            let mut text = self.glyphs.spell(&span.text);
            if tight && span.role == Role::Formula {
                text = text.replace("sqrt disc", "sqrt(disc)").replace(' ', "");
            }
            longer += text.chars().count();
            longer = longer.saturating_sub(span.text.chars().count());
            // What is spelt longer takes its room from the gap behind it: columns stay columns.
            if text.len() > 1 && text.bytes().all(|b| b == b' ') {
                let taken = longer.min(text.len() - 1);
                text.truncate(text.len() - taken);
                longer -= taken;
            }
            (text, span.role)
        };
        line.spans.iter().map(spell).collect()
    }
}

/// As long as most values are: with its sign and six digits.
const LONG: usize = 9;

/// The first columns of `text`, ending in a mark that says it goes on.
fn cut(text: &str, room: usize, mark: &str) -> String {
    let Some(room) = room.checked_sub(mark.width()) else {
        return String::new();
    };
    let mut kept = String::new();
    for c in text.chars() {
        let next = format!("{kept}{c}");
        if next.width() > room {
            break;
        }
        kept = next;
    }
    kept + mark
}
