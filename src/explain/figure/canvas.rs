//! A sheet of braille dots, 2 × 4 a cell, with characters on top; in ASCII, a character a cell.
//!
//! Coordinates are dots from the top left corner, also in ASCII, where 2 × 4 of them share one
//! character: a dot is then as high as it is wide, since cells are twice as high as wide.

use crate::explain::{Line, Role};
use crate::text::Glyphs;

/// What a mark in a figure stands for. Of two that share a cell, the later one in this list shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum FigureInk {
    /// Axes, and lines that only help.
    Axis,
    /// The line through the methods that no other beats.
    Pareto,
    /// The line from the centre to the surface.
    Radius,
    /// The circle that the slice leaves of the sphere.
    Circle,
    /// The part of the line, or of f(t), behind the eye: t < 0.
    Behind,
    /// The ray, t ≥ 0.
    Ray,
    /// f(t) for t ≥ 0.
    Curve,
    /// The tangent of a miss.
    Tangent,
    /// The normal at the visible point.
    Normal,
    /// Words and numbers.
    Note,
    /// p0, c and the point of closest approach.
    Point,
    /// Where the line meets the sphere.
    Root,
    /// The point p = t·d + p0 that is moved along the line.
    Scrub,
}

impl FigureInk {
    /// The character that draws it where there are no dots.
    const fn ascii(self) -> char {
        match self {
            Self::Axis | Self::Pareto | Self::Behind => '.',
            Self::Radius => 'r',
            Self::Circle | Self::Curve => 'o',
            Self::Ray => '-',
            Self::Tangent => 't',
            Self::Normal => 'n',
            Self::Note | Self::Point | Self::Root | Self::Scrub => '*',
        }
    }
}

/// Dots to a cell.
pub(super) const CELL: (f64, f64) = (2.0, 4.0);

/// How much of a line is drawn: `on` dots out of `of`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Dash {
    on: u32,
    of: u32,
}

impl Dash {
    pub(super) const SOLID: Self = Self { on: 1, of: 1 };
    pub(super) const DOTTED: Self = Self { on: 1, of: 2 };
    pub(super) const SPARSE: Self = Self { on: 1, of: 3 };

    pub(super) const fn draws(self, step: u32) -> bool {
        step % self.of < self.on
    }
}

#[derive(Debug, Clone, Copy, Default)]
struct CanvasCell {
    dots: u8,
    ink: Option<FigureInk>,
    text: Option<(char, FigureInk)>,
}

/// The sheet.
#[derive(Debug, Clone)]
pub(super) struct Canvas {
    cols: usize,
    rows: usize,
    glyphs: Glyphs,
    cells: Vec<CanvasCell>,
}

/// A point in dots: x to the right, y down.
pub(super) type Dot = (f64, f64);

impl Canvas {
    pub(super) fn new(cols: usize, rows: usize, glyphs: Glyphs) -> Self {
        Self {
            cols,
            rows,
            glyphs,
            cells: vec![CanvasCell::default(); cols * rows],
        }
    }

    pub(super) fn glyphs(&self) -> Glyphs {
        self.glyphs
    }

    /// Width and height in dots.
    pub(super) fn size(&self) -> Dot {
        (self.cols as f64 * CELL.0, self.rows as f64 * CELL.1)
    }

    /// Width and height of the smallest mark, in dots.
    pub(super) fn grain(&self) -> Dot {
        match self.glyphs {
            Glyphs::Unicode => (1.0, 1.0),
            Glyphs::Ascii => CELL,
        }
    }

    /// The cell that a point lies in.
    pub(super) fn cell_of(&self, (x, y): Dot) -> Option<(usize, usize)> {
        let (width, height) = self.size();
        let inside = (0.0..width).contains(&x) && (0.0..height).contains(&y);
        inside.then(|| ((x / CELL.0) as usize, (y / CELL.1) as usize))
    }

    fn cell(&self, col: usize, row: usize) -> Option<&CanvasCell> {
        (col < self.cols)
            .then(|| self.cells.get(row * self.cols + col))
            .flatten()
    }

    fn cell_mut(&mut self, col: usize, row: usize) -> Option<&mut CanvasCell> {
        if col < self.cols {
            self.cells.get_mut(row * self.cols + col)
        } else {
            None
        }
    }

    /// Sets the dot at a point; nothing happens off the sheet.
    pub(super) fn plot(&mut self, (x, y): Dot, ink: FigureInk) {
        let Some((col, row)) = self.cell_of((x, y)) else {
            return;
        };
        let bit = BRAILLE[y as usize % 4][x as usize % 2];
        if let Some(cell) = self.cell_mut(col, row) {
            cell.dots |= bit;
            cell.ink = cell.ink.max(Some(ink));
        }
    }

    /// A straight line, cut at the edges of the sheet.
    pub(super) fn line(&mut self, from: Dot, to: Dot, ink: FigureInk, dash: Dash) {
        let Some((from, to)) = self.clip(from, to) else {
            return;
        };
        let grain = self.grain();
        let (dx, dy) = (to.0 - from.0, to.1 - from.1);
        let steps = (dx.abs() / grain.0).max(dy.abs() / grain.1);
        let step = if steps > 0.0 {
            (dx / steps, dy / steps)
        } else {
            (0.0, 0.0)
        };
        for i in 0..=steps as u32 {
            if dash.draws(i) {
                let n = f64::from(i);
                self.plot((from.0 + n * step.0, from.1 + n * step.1), ink);
            }
        }
    }

    /// The part of a line that lies on the sheet, after Liang and Barsky.
    pub(super) fn clip(&self, from: Dot, to: Dot) -> Option<(Dot, Dot)> {
        let (width, height) = self.size();
        let (dx, dy) = (to.0 - from.0, to.1 - from.1);
        let (mut first, mut last) = (0.0_f64, 1.0_f64);
        // The far edges themselves are off the sheet.
        let edge = 1e-6;
        for (step, room) in [
            (-dx, from.0),
            (dx, width - edge - from.0),
            (-dy, from.1),
            (dy, height - edge - from.1),
        ] {
            if step == 0.0 {
                if room < 0.0 {
                    return None;
                }
            } else if step < 0.0 {
                first = first.max(room / step);
            } else {
                last = last.min(room / step);
            }
        }
        let at = |part: f64| (from.0 + part * dx, from.1 + part * dy);
        (first <= last).then(|| (at(first), at(last)))
    }

    /// Whether a cell is on the sheet and has neither dots nor text.
    pub(super) fn is_blank(&self, col: usize, row: usize) -> bool {
        self.cell(col, row)
            .is_some_and(|c| c.dots == 0 && c.text.is_none())
    }

    fn has_text(&self, col: usize, row: usize) -> bool {
        self.cell(col, row).is_some_and(|c| c.text.is_some())
    }

    /// Writes a character over whatever is in the cell.
    pub(super) fn put(&mut self, col: usize, row: usize, glyph: char, ink: FigureInk) {
        if let Some(cell) = self.cell_mut(col, row) {
            cell.text = Some((glyph, ink));
        }
    }

    /// Writes text from a cell on, in the characters that are allowed.
    pub(super) fn write(&mut self, col: usize, row: usize, text: &str, ink: FigureInk) {
        for (i, glyph) in self.glyphs.spell(text).chars().enumerate() {
            self.put(col + i, row, glyph, ink);
        }
    }

    /// Writes a label beside a cell, where it hides the least; false if there is no room for it.
    ///
    /// `upwards` prefers places above the cell to places below it.
    pub(super) fn label(
        &mut self,
        (col, row): (usize, usize),
        text: &str,
        ink: FigureInk,
        upwards: bool,
    ) -> bool {
        let length = self.glyphs.spell(text).chars().count() as i64;
        let (up, middle, right, left) = (
            if upwards { -1 } else { 1 },
            -((length - 1) / 2),
            1,
            -length,
        );
        let places = [
            (middle, up),
            (right, up),
            (left, up),
            (right, 0),
            (left, 0),
            (middle, -up),
            (right, -up),
            (left, -up),
            (right + 1, 0),
            (left - 1, 0),
            (middle, 2 * up),
            (right, 2 * up),
            (left, 2 * up),
            (middle, -2 * up),
        ];
        let best = places
            .into_iter()
            .enumerate()
            .filter_map(|(rank, (dx, dy))| {
                let at = (col as i64 + dx, row as i64 + dy);
                let hidden = self.hidden_by(at, length, (col, row))?;
                Some((hidden * 6 + rank, at))
            })
            .min();
        let Some((_, (col, row))) = best else {
            return false;
        };
        self.write(col as usize, row as usize, text, ink);
        true
    }

    /// Writes a label in the row of a cell, a blank away from it, where it hides nothing; false if
    /// there is no room for it.
    pub(super) fn label_beside(
        &mut self,
        (col, row): (usize, usize),
        text: &str,
        ink: FigureInk,
    ) -> bool {
        let length = self.glyphs.spell(text).chars().count() as i64;
        for by in [2, -1 - length] {
            let at = (col as i64 + by, row as i64);
            if self.hidden_by(at, length, (col, row)) == Some(0) {
                self.write(at.0 as usize, row, text, ink);
                return true;
            }
        }
        false
    }

    /// How many dotted cells a text would hide; none if it does not fit or would touch other text.
    fn hidden_by(&self, at: (i64, i64), length: i64, own: (usize, usize)) -> Option<usize> {
        let row = usize::try_from(at.1).ok()?;
        let first = usize::try_from(at.0).ok()?;
        let end = first + length as usize;
        if end > self.cols || row >= self.rows {
            return None;
        }
        let neighbours = [first.checked_sub(1), Some(end)];
        let touches = neighbours
            .into_iter()
            .flatten()
            .any(|col| (col, row) != own && self.has_text(col, row));
        if touches || (first..end).any(|col| self.has_text(col, row)) {
            return None;
        }
        Some((first..end).filter(|&col| !self.is_blank(col, row)).count())
    }

    /// The blank rectangle of so many cells that is closest to the bottom, and then to the right.
    pub(super) fn blank_room(&self, cols: usize, rows: usize) -> Option<(usize, usize)> {
        let tops = 0..(self.rows + 1).checked_sub(rows)?;
        let lefts = 0..(self.cols + 1).checked_sub(cols)?;
        let blank = |col: usize, row: usize| {
            (row..row + rows).all(|y| (col..col + cols).all(|x| self.is_blank(x, y)))
        };
        tops.rev()
            .flat_map(|row| lefts.clone().rev().map(move |col| (col, row)))
            .find(|&(col, row)| blank(col, row))
    }

    /// Copies a smaller sheet onto this one.
    pub(super) fn paste(&mut self, (col, row): (usize, usize), other: &Self) {
        for y in 0..other.rows {
            for x in 0..other.cols {
                let (Some(&cell), Some(place)) =
                    (other.cell(x, y), self.cell_mut(col + x, row + y))
                else {
                    continue;
                };
                *place = cell;
            }
        }
    }

    /// The middles of all dots that are set.
    #[cfg(test)]
    pub(super) fn dots(&self) -> Vec<Dot> {
        let cells = self.cells.iter().enumerate();
        let dots = cells.flat_map(|(i, cell)| {
            let (col, row) = (i % self.cols, i / self.cols);
            (0..8).filter_map(move |k| {
                let (x, y) = (k % 2, k / 2);
                (cell.dots & BRAILLE[y][x] != 0)
                    .then(|| ((col * 2 + x) as f64 + 0.5, (row * 4 + y) as f64 + 0.5))
            })
        });
        dots.collect()
    }

    /// The sheet as lines, blanks at their ends left out.
    pub(super) fn lines(&self) -> Vec<Line> {
        (0..self.rows).map(|row| self.row(row)).collect()
    }

    fn row(&self, row: usize) -> Line {
        let cells = &self.cells[row * self.cols..(row + 1) * self.cols];
        let used = cells
            .iter()
            .rposition(|c| c.dots != 0 || c.text.is_some())
            .map_or(0, |last| last + 1);
        let mut line = Line::new(0);
        for cell in &cells[..used] {
            let (glyph, role) = match (cell.text, cell.ink) {
                (Some((glyph, ink)), _) => (glyph, Role::Ink(ink)),
                (None, Some(ink)) => (self.glyph_of(cell.dots, ink), Role::Ink(ink)),
                (None, None) => (' ', Role::Plain),
            };
            line.push(role, glyph);
        }
        line
    }

    fn glyph_of(&self, dots: u8, ink: FigureInk) -> char {
        match self.glyphs {
            Glyphs::Ascii => ink.ascii(),
            Glyphs::Unicode => char::from_u32(0x2800 + u32::from(dots)).unwrap_or(' '),
        }
    }
}

/// The bit of each dot in a braille character, by row and column.
const BRAILLE: [[u8; 2]; 4] = [[0x01, 0x08], [0x02, 0x10], [0x04, 0x20], [0x40, 0x80]];
