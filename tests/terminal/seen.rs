//! What a person sees in a cell: the colour of a blank's characters does not show.

use vt100::Color;

/// The look of one cell: characters in a colour on a colour; bold, dim, reversed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Seen {
    symbol: String,
    fg: Color,
    bg: Color,
    style: [bool; 3],
}

impl Seen {
    pub fn new(symbol: &str, fg: Color, bg: Color, style: [bool; 3]) -> Self {
        let symbol = if symbol.is_empty() { " " } else { symbol };
        let shows = symbol != " " || style[2];
        Self {
            symbol: symbol.to_owned(),
            fg: if shows { fg } else { Color::Default },
            bg,
            style: if shows { style } else { [false; 3] },
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
