//! A terminal of 256 colours that nobody looks at: how many bytes a picture takes.

use ratatui::backend::{Backend, CrosstermBackend};
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Color, Style as CellStyle};

use crate::lab::frames::CellOutput;
use crate::render::{AnsiColor, Cell, ColorDepth, Image};
use crate::scene::Rgb;
use crate::terminal::{Limits, Painter};

/// What such a terminal shows, and what one shows that ratatui's own backend writes to.
#[derive(Default)]
pub(super) struct UnseenTerminal {
    painter: Painter,
    shown_by_ratatui: Buffer,
    written: Vec<u8>,
}

impl UnseenTerminal {
    pub const DEPTH: ColorDepth = ColorDepth::Ansi256;
}

impl UnseenTerminal {
    /// Shows these cells; how many bytes that took. Others come back in their place.
    pub fn paint(&mut self, cells: &mut Buffer) -> usize {
        self.painter.paint(cells, None, Limits::default()).len()
    }

    /// The same by ratatui's own backend, on a screen of its own.
    pub fn paint_by_ratatui(&mut self, cells: &mut Buffer) -> usize {
        let shown = &mut self.shown_by_ratatui;
        if shown.area != cells.area {
            *shown = Buffer::empty(cells.area);
        }
        self.written.clear();
        // Writing to memory does not fail.
        let _ = CrosstermBackend::new(&mut self.written).draw(shown.diff(cells).into_iter());
        std::mem::swap(shown, cells);
        self.written.len()
    }
}

impl CellOutput for UnseenTerminal {
    fn show(&mut self, image: &Image) -> usize {
        self.paint(&mut buffer_of(image))
    }

    fn show_by_ratatui(&mut self, image: &Image) -> usize {
        self.paint_by_ratatui(&mut buffer_of(image))
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
