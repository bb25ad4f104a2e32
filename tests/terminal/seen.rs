//! What a person sees in a cell, however it was written: a half block upside down with its colours
//! exchanged looks the same.

use vt100::Color;

/// The look of one cell.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Seen {
    /// An upper and a lower half.
    Halves(Paint, Paint),
    /// Characters in a colour on a colour; bold, dim, reversed.
    Text(String, Color, Color, [bool; 3]),
}

/// The colour of a half.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Paint {
    Foreground,
    Background,
    Color(Color),
}

impl Seen {
    pub fn new(symbol: &str, fg: Color, bg: Color, style: [bool; 3]) -> Self {
        let ink = match fg {
            Color::Default => Paint::Foreground,
            color => Paint::Color(color),
        };
        let paper = match bg {
            Color::Default => Paint::Background,
            color => Paint::Color(color),
        };
        let plain = style == [false; 3];
        match symbol {
            "" | " " if !style[2] => Self::Halves(paper, paper),
            "▀" if plain => Self::Halves(ink, paper),
            "▄" if plain => Self::Halves(paper, ink),
            "█" if plain => Self::Halves(ink, ink),
            _ => Self::Text(symbol.to_owned(), fg, bg, style),
        }
    }
}

/// All cells of a screen, row by row.
pub fn cells(screen: &vt100::Screen) -> Vec<Vec<Seen>> {
    let (rows, cols) = screen.size();
    (0..rows.get())
        .map(|row| {
            (0..cols.get())
                .filter_map(|col| screen.cell(row, col))
                .map(|cell| {
                    let style = [cell.bold(), cell.dim(), cell.inverse()];
                    Seen::new(cell.contents(), cell.fgcolor(), cell.bgcolor(), style)
                })
                .collect()
        })
        .collect()
}
