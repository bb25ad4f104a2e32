//! Letters of several cells, for the back row.

use font8x8::{BASIC_FONTS, GREEK_FONTS, LATIN_FONTS, UnicodeFonts};
use ratatui::layout::Rect;

use crate::explorer::draw::pen::Pen;
use crate::explorer::draw::theme::Theme;
use crate::text::{Glyphs, wrap};

/// The dots on each side of a letter's square.
const DOTS: u16 = 8;
/// No letter is larger than this many times the smallest of its kind.
const LARGEST: u16 = 16;

/// How a letter is made of cells.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Grain {
    /// Half blocks: 8 × 4 cells, or a multiple of that each way.
    Half(u16),
    /// Quarter blocks: 4 × 4 cells, or a multiple of that each way.
    Quadrant(u16),
    /// Plain characters: 8 × 8 cells, or a multiple of that each way.
    Whole(u16),
    /// One cell: there is no room for more.
    Letter,
}

impl Grain {
    /// Columns and rows of a letter.
    const fn cells(self) -> (u16, u16) {
        match self {
            Self::Half(times) => (DOTS * times, DOTS / 2 * times),
            Self::Quadrant(times) => (DOTS / 2 * times, DOTS / 2 * times),
            Self::Whole(times) => (DOTS * times, DOTS * times),
            Self::Letter => (1, 1),
        }
    }

    /// All that can be drawn in these characters, the largest first.
    fn all(glyphs: Glyphs) -> Vec<Self> {
        let times = (1..=LARGEST).rev();
        let mut all: Vec<_> = match glyphs {
            Glyphs::Unicode => times
                .flat_map(|n| [Self::Half(n), Self::Quadrant(n)])
                .collect(),
            Glyphs::Ascii => times.map(Self::Whole).collect(),
        };
        all.sort_by_key(|grain| {
            let (cols, rows) = grain.cells();
            std::cmp::Reverse(u32::from(cols) * u32::from(rows))
        });
        all.push(Self::Letter);
        all
    }
}

/// Writes lines of text into the first `rows` rows of `room`, as large as these allow; returns the row
/// below them.
pub(crate) fn draw(pen: &mut Pen<'_>, room: Rect, rows: u16, lines: &[String]) -> u16 {
    let spelt: Vec<_> = lines.iter().map(|line| pen.glyphs.spell(line)).collect();
    let wrapped = |grain: Grain| -> Vec<String> {
        let width = room.width / grain.cells().0;
        spelt
            .iter()
            .flat_map(|line| wrap(line, width.into()))
            .collect()
    };
    // A number in two pieces is no number.
    let cuts_words = |grain: Grain| {
        let width = usize::from(room.width / grain.cells().0);
        spelt
            .iter()
            .flat_map(|l| l.split_whitespace())
            .any(|word| word.chars().count() > width)
    };
    let fits = |&grain: &Grain| {
        let needed = wrapped(grain).len() * usize::from(grain.cells().1);
        grain == Grain::Letter || needed <= rows.into() && !cuts_words(grain)
    };
    let grain = Grain::all(pen.glyphs)
        .into_iter()
        .find(fits)
        .unwrap_or(Grain::Letter);
    let mut y = room.y;
    for line in wrapped(grain) {
        draw_line(pen, room, y, &line, grain);
        y = y.saturating_add(grain.cells().1).min(room.bottom());
    }
    y
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
        Grain::Half(n) => match (dot(col / n, 2 * row / n), dot(col / n, (2 * row + 1) / n)) {
            (false, false) => ' ',
            (true, false) => '▀',
            (false, true) => '▄',
            (true, true) => '█',
        },
        Grain::Quadrant(n) => {
            const QUADRANTS: [char; 16] = [
                ' ', '▘', '▝', '▀', '▖', '▌', '▞', '▛', '▗', '▚', '▐', '▜', '▄', '▙', '▟', '█',
            ];
            let at = |x: u16, y: u16| dot((2 * col + x) / n, (2 * row + y) / n);
            let corners = [at(0, 0), at(1, 0), at(0, 1), at(1, 1)];
            let bit = |(i, &on): (usize, &bool)| usize::from(on) << i;
            QUADRANTS[corners.iter().enumerate().map(bit).sum::<usize>()]
        }
        Grain::Whole(n) if dot(col / n, row / n) => '#',
        Grain::Whole(_) | Grain::Letter => ' ',
    }
}

/// Letters that the fonts lack, or draw as something else.
const OWN: [(char, [u8; 8]); 16] = [
    ('√', [0xe0, 0x20, 0x20, 0x10, 0x13, 0x14, 0x18, 0x08]),
    ('≤', [0x60, 0x18, 0x06, 0x18, 0x60, 0x00, 0x7e, 0x00]),
    ('≥', [0x06, 0x18, 0x60, 0x18, 0x06, 0x00, 0x7e, 0x00]),
    ('∞', [0x00, 0x00, 0x66, 0x99, 0x99, 0x66, 0x00, 0x00]),
    ('≈', [0x00, 0x4c, 0x32, 0x00, 0x4c, 0x32, 0x00, 0x00]),
    ('≠', [0x40, 0x20, 0x7e, 0x10, 0x7e, 0x04, 0x02, 0x00]),
    ('→', [0x00, 0x10, 0x20, 0x7f, 0x20, 0x10, 0x00, 0x00]),
    ('²', [0x0e, 0x10, 0x0c, 0x02, 0x1e, 0x00, 0x00, 0x00]),
    ('×', [0x00, 0x42, 0x24, 0x18, 0x18, 0x24, 0x42, 0x00]),
    ('‖', [0x24, 0x24, 0x24, 0x24, 0x24, 0x24, 0x24, 0x00]),
    ('₆', [0x00, 0x00, 0x00, 0x0c, 0x02, 0x0e, 0x12, 0x0c]),
    ('₄', [0x00, 0x00, 0x00, 0x08, 0x0c, 0x0a, 0x1e, 0x08]),
    ('⌊', [0x06, 0x06, 0x06, 0x06, 0x06, 0x06, 0x7e, 0x00]),
    ('⌋', [0x60, 0x60, 0x60, 0x60, 0x60, 0x60, 0x7e, 0x00]),
    ('·', [0x00, 0x00, 0x00, 0x18, 0x18, 0x00, 0x00, 0x00]),
    ('…', [0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0xdb, 0x00]),
];

/// Which dots a letter has: a byte a row, its lowest bit on the left.
fn bitmap(letter: char) -> [u8; 8] {
    if let Some((_, bitmap)) = OWN.iter().find(|(own, _)| *own == letter) {
        return *bitmap;
    }
    let plain = match letter {
        '−' | '–' => '-',
        '“' | '”' => '"',
        '’' | '′' => '\'',
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
    use std::collections::BTreeSet;

    use super::*;
    use crate::explain::{Lens, Reading, sheet};
    use crate::method::Method;
    use crate::render::{Style, fit};
    use crate::scene::{Builtin, Rays};

    #[test]
    fn every_character_that_a_step_can_have_has_a_letter() {
        let mut letters = BTreeSet::new();
        for builtin in Builtin::ALL {
            let scene = builtin.scene();
            let (size, shape) = fit(&scene, Style::Ascii, 12, 8, 2.0);
            let rays = Rays::new(&scene.camera, size, shape);
            let pixels = (0..size.height).flat_map(|y| (0..size.width).map(move |x| (x, y)));
            for (x, y) in pixels.step_by(size.width as usize * size.height as usize / 24 + 1) {
                for method in Method::ALL {
                    let reading = Reading::take(&scene, (x, y), rays.ray(x, y), method, None, None);
                    for lens in Lens::ALL {
                        let steps = sheet(lens, &reading, Some(&scene), Some(&rays), None);
                        for equation in steps.iter().flat_map(|step| &step.equations) {
                            letters.extend(equation.formula.chars());
                            let links = equation.ways.iter().flatten();
                            letters.extend(
                                links.flat_map(|l| l.text.chars().chain(l.sign.text().chars())),
                            );
                        }
                    }
                }
            }
        }
        let unknown = bitmap('?');
        assert!(letters.len() > 40);
        for letter in letters.into_iter().filter(|&letter| letter != '?') {
            assert_ne!(bitmap(letter), unknown, "{letter}");
        }
        // A square is written small and high, and nothing but a square is.
        assert_ne!(bitmap('²'), bitmap('\u{b4}'));
    }

    #[test]
    fn a_letter_is_the_same_in_every_grain() {
        let one = bitmap('1');
        let dots = |grain: Grain, n: u32| -> u32 {
            let (cols, rows) = grain.cells();
            let cells = (0..rows).flat_map(|r| (0..cols).map(move |c| (c, r)));
            let all: u32 = cells
                .map(|(c, r)| match cell(one, grain, c, r) {
                    ' ' => 0,
                    '▘' | '▝' | '▖' | '▗' | '#' => 1,
                    '█' if matches!(grain, Grain::Quadrant(_)) => 4,
                    '▛' | '▜' | '▙' | '▟' => 3,
                    '▀' | '▄' if matches!(grain, Grain::Half(_)) => 1,
                    _ => 2,
                })
                .sum();
            all / (n * n)
        };
        let all: u32 = one.iter().map(|row| row.count_ones()).sum();
        for n in [1, 2, 5] {
            for grain in [Grain::Half(n), Grain::Quadrant(n), Grain::Whole(n)] {
                assert_eq!(dots(grain, n.into()), all, "{grain:?}");
            }
        }
    }
}
