//! A terminal of 256 colours that nobody looks at: how many bytes a picture takes.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Color, Style as CellStyle};

use crate::lab::frames::CellOutput;
use crate::render::{AnsiColor, Cell, ColorDepth, Image};
use crate::scene::Rgb;
use crate::terminal::{Limits, Painter};

/// What such a terminal shows.
#[derive(Default)]
pub(super) struct UnseenTerminal(Painter);

impl UnseenTerminal {
    pub const DEPTH: ColorDepth = ColorDepth::Ansi256;
}

impl CellOutput for UnseenTerminal {
    fn show(&mut self, image: &Image) -> usize {
        self.0
            .paint(&mut buffer_of(image), None, Limits::default())
            .len()
    }
}

/// An image as cells.
fn buffer_of(image: &Image) -> Buffer {
    let columns = u16::try_from(image.cols).unwrap_or(u16::MAX);
    let rows = u16::try_from(image.rows).unwrap_or(u16::MAX);
    let mut buffer = Buffer::empty(Rect::new(0, 0, columns, rows));
    for (y, line) in (0..rows).zip(image.lines()) {
        for (x, cell) in (0..columns).zip(line) {
            buffer[(x, y)]
                .set_char(cell.glyph)
                .set_style(style_of(cell));
        }
    }
    buffer
}

fn style_of(cell: &Cell) -> CellStyle {
    let color = |color: Option<Rgb>| match color.and_then(|c| UnseenTerminal::DEPTH.nearest(c)) {
        None => Color::Reset,
        Some(AnsiColor::Basic(i) | AnsiColor::Indexed(i)) => Color::Indexed(i),
        Some(AnsiColor::Rgb(Rgb(r, g, b))) => Color::Rgb(r, g, b),
    };
    CellStyle::new().fg(color(cell.fg)).bg(color(cell.bg))
}
