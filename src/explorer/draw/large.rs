//! Letters of several cells, for the back row.

use font8x8::{BASIC_FONTS, GREEK_FONTS, LATIN_FONTS, UnicodeFonts};
use ratatui::layout::Rect;

use crate::explorer::draw::pen::Pen;
use crate::explorer::draw::theme::Theme;
use crate::text::{Glyphs, wrap};

/// A letter is a square of so many dots.
const DOTS: u16 = 8;

/// How many dots a cell holds, across and down.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Grain {
    /// A letter of 8 × 4 cells.
    Half,
    /// A letter of 4 × 4 cells.
    Quadrant,
    /// A letter of 8 × 8 cells, in plain characters.
    Whole,
    /// A letter of one cell: there is no room for more.
    Letter,
}

impl Grain {
    const fn dots(self) -> (u16, u16) {
        match self {
            Self::Half => (1, 2),
            Self::Quadrant => (2, 2),
            Self::Whole => (1, 1),
            Self::Letter => (DOTS, DOTS),
        }
    }

    /// Columns and rows of a letter.
    const fn cells(self) -> (u16, u16) {
        let (across, down) = self.dots();
        (DOTS / across, DOTS / down)
    }
}

/// Writes `text` from row `y` of `room`, as large as `rows` rows allow; returns the row below it.
pub(crate) fn draw(pen: &mut Pen<'_>, room: Rect, y: u16, rows: u16, text: &str) -> u16 {
    let grains: &[Grain] = match pen.glyphs {
        Glyphs::Unicode => &[Grain::Half, Grain::Quadrant, Grain::Letter],
        Glyphs::Ascii => &[Grain::Whole, Grain::Letter],
    };
    let fitting = grains.iter().copied().find_map(|grain| {
        let (cols, height) = grain.cells();
        let lines = wrap(text, (room.width / cols).into());
        let needed = lines.len() as u16 * height;
        (needed <= rows || grain == Grain::Letter).then_some((grain, lines))
    });
    let Some((grain, lines)) = fitting else {
        return y;
    };
    let mut y = y;
    for line in &lines {
        draw_line(pen, room, y, line, grain);
        y = y.saturating_add(grain.cells().1);
    }
    y.min(room.bottom())
}

fn draw_line(pen: &mut Pen<'_>, room: Rect, y: u16, line: &str, grain: Grain) {
    let style = Theme::strong();
    if grain == Grain::Letter {
        if y < room.bottom() {
            pen.text(room.x, y, room.width, line, style);
        }
        return;
    }
    let (cols, rows) = grain.cells();
    for (i, letter) in line.chars().enumerate() {
        let left = room.x + i as u16 * cols;
        let bitmap = bitmap(letter);
        for row in (0..rows).take_while(|row| y + row < room.bottom()) {
            let cells: String = (0..cols).map(|col| cell(bitmap, grain, col, row)).collect();
            pen.text(left, y + row, cols, &cells, style);
        }
    }
}

/// The character for the dots of one cell of a letter.
fn cell(bitmap: [u8; 8], grain: Grain, col: u16, row: u16) -> char {
    let dot = |x: u16, y: u16| bitmap[usize::from(y)] >> x & 1 == 1;
    match grain {
        Grain::Half => match (dot(col, 2 * row), dot(col, 2 * row + 1)) {
            (false, false) => ' ',
            (true, false) => '▀',
            (false, true) => '▄',
            (true, true) => '█',
        },
        Grain::Quadrant => {
            const QUADRANTS: [char; 16] = [
                ' ', '▘', '▝', '▀', '▖', '▌', '▞', '▛', '▗', '▚', '▐', '▜', '▄', '▙', '▟', '█',
            ];
            let [x, y] = [2 * col, 2 * row];
            let corners = [dot(x, y), dot(x + 1, y), dot(x, y + 1), dot(x + 1, y + 1)];
            let bit = |(i, &on): (usize, &bool)| usize::from(on) << i;
            QUADRANTS[corners.iter().enumerate().map(bit).sum::<usize>()]
        }
        Grain::Whole | Grain::Letter if dot(col, row) => '#',
        Grain::Whole | Grain::Letter => ' ',
    }
}

/// Which dots a letter has: a byte a row, its lowest bit on the left.
fn bitmap(letter: char) -> [u8; 8] {
    const ROOT: [u8; 8] = [0xe0, 0x20, 0x20, 0x10, 0x13, 0x14, 0x18, 0x08];
    const AT_MOST: [u8; 8] = [0x60, 0x18, 0x06, 0x18, 0x60, 0x00, 0x7e, 0x00];
    const INFINITY: [u8; 8] = [0x00, 0x00, 0x66, 0x99, 0x99, 0x66, 0x00, 0x00];
    let plain = match letter {
        '√' => return ROOT,
        '≤' => return AT_MOST,
        '∞' => return INFINITY,
        '−' | '–' => '-',
        '“' | '”' => '"',
        '…' => '.',
        other => other,
    };
    BASIC_FONTS
        .get(plain)
        .or_else(|| LATIN_FONTS.get(plain))
        .or_else(|| GREEK_FONTS.get(plain))
        .or_else(|| BASIC_FONTS.get('?'))
        .unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_sign_of_the_formulas_has_a_letter() {
        let unknown = bitmap('?');
        for letter in "ABCDΔθ²·−√±≤∞()=+0123456789./|'tpdcrn".chars() {
            assert_ne!(bitmap(letter), unknown, "{letter}");
        }
    }

    #[test]
    fn a_letter_is_the_same_in_every_grain() {
        let one = bitmap('1');
        let dots = |grain: Grain| -> u32 {
            let (cols, rows) = grain.cells();
            let cells = (0..rows).flat_map(|r| (0..cols).map(move |c| (c, r)));
            cells
                .map(|(c, r)| match cell(one, grain, c, r) {
                    ' ' => 0,
                    '▘' | '▝' | '▖' | '▗' | '#' => 1,
                    '█' if grain == Grain::Quadrant => 4,
                    '▛' | '▜' | '▙' | '▟' => 3,
                    '▀' | '▄' if grain == Grain::Half => 1,
                    _ => 2,
                })
                .sum()
        };
        let all: u32 = one.iter().map(|row| row.count_ones()).sum();
        for grain in [Grain::Half, Grain::Quadrant, Grain::Whole] {
            assert_eq!(dots(grain), all, "{grain:?}");
        }
    }
}
