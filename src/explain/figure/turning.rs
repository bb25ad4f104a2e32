//! What a dial does to a picture, from tame to broken, in characters.
//!
//! ```text
//! wrong pixels ─   bits lost ·
//! 100┤           ──────────── 24
//!    │         ··
//!    │     ···/
//!   0┤┬────────┬────────┬─────
//!     0   ▲    2^20     2^40
//! ```

use super::canvas::{Canvas, Dash, Dot, FigureInk};
use crate::explain::Line;
use crate::lab::chart::{BITS, DialPoint, Scale};
use crate::text::Glyphs;

/// The lowest figure that says more than words.
const LEAST: (usize, usize) = (24, 6);
/// The columns for the numbers at the sides.
const SIDES: (usize, usize) = (4, 3);

/// The share of wrong pixels and the bits lost over the settings that were tried, in `cols` × `rows`
/// characters; nothing where that is too little.
pub fn turning(
    settings: &[DialPoint],
    now: u32,
    most: u32,
    cols: usize,
    rows: usize,
    glyphs: Glyphs,
) -> Vec<Line> {
    if cols < LEAST.0 || rows < LEAST.1 {
        return Vec::new();
    }
    let mut sheet = Sheet {
        canvas: Canvas::new(cols, rows, glyphs),
        cols: cols - SIDES.0 - SIDES.1,
        foot: rows - 2,
        dial: Scale::new(0.0, f64::from(most.max(1))),
    };
    sheet.axes(most);
    let bits = settings
        .iter()
        .filter_map(|s| Some((s.k, BITS.part(s.bits?))));
    sheet.line(bits, FigureInk::Behind, Dash::DOTTED);
    sheet.line(
        settings.iter().map(|s| (s.k, s.wrong)),
        FigureInk::Curve,
        Dash::SOLID,
    );
    sheet.mark(now);
    sheet.canvas.lines()
}

struct Sheet {
    canvas: Canvas,
    /// Columns between the numbers at the sides, and the row of the axis.
    cols: usize,
    foot: usize,
    dial: Scale,
}

impl Sheet {
    /// The dot of a setting and a share from 0 to 1.
    fn place(&self, k: f64, share: f64) -> Dot {
        let (width, height) = ((self.cols * 2 - 1) as f64, (self.foot * 4 - 5) as f64);
        (
            (SIDES.0 * 2) as f64 + 0.5 + self.dial.part(k) * width,
            4.5 + (1.0 - share) * height,
        )
    }

    fn axes(&mut self, most: u32) {
        let (foot, right) = (self.foot, SIDES.0 + self.cols);
        let ascii = self.canvas.glyphs() == Glyphs::Ascii;
        let [line, up, tick] = if ascii {
            ['-', '|', '+']
        } else {
            ['─', '│', '┬']
        };
        let legend = if ascii {
            "o % wrong   . bits lost"
        } else {
            "— % wrong   … bits lost"
        };
        self.canvas.write(SIDES.0, 0, legend, FigureInk::Note);
        for row in 1..foot {
            self.canvas.put(SIDES.0 - 1, row, up, FigureInk::Axis);
            self.canvas.put(right, row, up, FigureInk::Axis);
        }
        for col in SIDES.0 - 1..=right {
            self.canvas.put(col, foot, line, FigureInk::Axis);
        }
        self.canvas.write(0, 1, "100", FigureInk::Note);
        self.canvas.write(right + 1, 1, "24", FigureInk::Note);
        self.canvas.write(2, foot - 1, "0", FigureInk::Note);
        self.canvas.write(right + 1, foot - 1, "0", FigureInk::Note);
        let step = [5, 10, 20, 40]
            .into_iter()
            .find(|s| most as usize * 7 <= s * self.cols);
        for k in (0..=most).step_by(step.unwrap_or(80)) {
            let label = if k == 0 { "0".into() } else { format!("2^{k}") };
            let cell = self.canvas.cell_of(self.place(k.into(), 0.0));
            let fits = |(col, _): &(usize, usize)| col + label.len() <= right + SIDES.1;
            if let Some((col, _)) = cell.filter(fits) {
                self.canvas.put(col, foot, tick, FigureInk::Axis);
                self.canvas.write(col, foot + 1, &label, FigureInk::Note);
            }
        }
    }

    /// A line through settings that follow each other; a gap in the tries is bridged.
    fn line(&mut self, points: impl Iterator<Item = (i32, f64)>, ink: FigureInk, dash: Dash) {
        let mut last: Option<Dot> = None;
        for (k, share) in points {
            let dot = self.place(k.into(), share);
            self.canvas.line(last.unwrap_or(dot), dot, ink, dash);
            self.canvas.plot(dot, ink);
            last = Some(dot);
        }
    }

    /// Where the dial stands.
    fn mark(&mut self, now: u32) {
        let glyph = match self.canvas.glyphs() {
            Glyphs::Unicode => '▲',
            Glyphs::Ascii => '^',
        };
        if let Some((col, _)) = self.canvas.cell_of(self.place(now.into(), 0.0)) {
            self.canvas.put(col, self.foot, glyph, FigureInk::Scrub);
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn text(lines: &[Line]) -> String {
        lines.iter().map(|line| line.text() + "\n").collect()
    }

    #[test]
    fn the_line_rises_where_the_picture_breaks() {
        let settings = [(0, 0.0), (10, 0.0), (11, 1.0), (20, 1.0)];
        let settings = settings.map(|(k, wrong)| DialPoint {
            k,
            wrong,
            bits: None,
        });
        let lines = turning(&settings, 10, 20, 47, 10, Glyphs::Ascii);
        assert_eq!(
            text(&lines),
            "    o % wrong   . bits lost
100|                     ooooooooooooooooooo|24
   |                     o                  |
   |                     o                  |
   |                    o                   |
   |                    o                   |
   |                    o                   |
  0|ooooooooooooooooooooo                   |0
   -+---------+---------^--------+---------+-
    0         2^5       2^10     2^15      2^20
"
        );
    }

    proptest! {
        #[test]
        fn any_figure_keeps_to_its_room(
            tried in prop::collection::btree_map(0_i32..150, (0.0..=1.0, prop::option::of(0.0..=24.0)), 0..20),
            now in 0_u32..200,
            most in 0_u32..200,
            cols in 0_usize..120,
            rows in 0_usize..40,
            ascii in any::<bool>(),
        ) {
            let settings: Vec<_> = tried
                .into_iter()
                .map(|(k, (wrong, bits))| DialPoint { k, wrong, bits })
                .collect();
            let glyphs = if ascii { Glyphs::Ascii } else { Glyphs::Unicode };
            let lines = turning(&settings, now, most, cols, rows, glyphs);
            prop_assert!(lines.is_empty() || lines.len() == rows);
            for line in lines {
                prop_assert!(line.width() <= cols && (!ascii || line.text().is_ascii()));
            }
        }
    }
}
