//! Points of a figure with their names.

use super::canvas::{Canvas, Dot, FigureInk};
use crate::text::Glyphs;

/// A named point.
#[derive(Debug, Clone)]
pub(super) struct Mark {
    pub name: &'static str,
    /// Where it is drawn.
    pub dot: Dot,
    /// Where it is, in the figure's own units: along the line, and above it.
    pub at: (f64, f64),
    pub sign: Sign,
    pub ink: FigureInk,
}

/// The character that stands on a point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Sign {
    /// p0.
    Eye,
    /// The root that is seen.
    Seen,
    /// A root that is not seen.
    Unseen,
    /// A point that helps.
    Cross,
    /// c.
    Center,
    /// The point that is moved.
    Moved,
    /// A point above the figure.
    Above,
    /// A point below the figure.
    Below,
    /// A point to the left of the figure.
    Before,
    /// A point to the right of the figure.
    After,
}

impl Sign {
    pub(super) const fn glyph(self, glyphs: Glyphs) -> char {
        let [unicode, ascii] = match self {
            Self::Eye => ['■', '@'],
            Self::Seen => ['●', '*'],
            Self::Unseen => ['○', '#'],
            Self::Cross => ['×', 'x'],
            Self::Center => ['+', '+'],
            Self::Moved => ['◆', '%'],
            Self::Above => ['↑', '^'],
            Self::Below => ['↓', 'v'],
            Self::Before => ['←', '<'],
            Self::After => ['→', '>'],
        };
        match glyphs {
            Glyphs::Unicode => unicode,
            Glyphs::Ascii => ascii,
        }
    }
}

impl Mark {
    /// Whether it is the same point as another, as far as binary32 could tell.
    fn is_at(&self, other: &Self) -> bool {
        let close = |x: f64, y: f64| (x - y).abs() <= 4e-7 * x.abs().max(y.abs());
        close(self.at.0, other.at.0) && close(self.at.1, other.at.1)
    }
}

/// The names of points that share a cell: joined by = where they are one point.
fn joint_name(marks: &[Mark]) -> String {
    let mut name = String::new();
    for (i, mark) in marks.iter().enumerate() {
        if let Some(last) = i.checked_sub(1) {
            name += if marks[last].is_at(mark) { " = " } else { "," };
        }
        name += mark.name;
    }
    name
}

impl Canvas {
    /// Signs first, so that no name hides one; points in one cell share a name. Points off the
    /// sheet are left out.
    pub(super) fn write_marks(&mut self, marks: Vec<Mark>) {
        let mut groups: Vec<((usize, usize), Vec<Mark>)> = Vec::new();
        for mark in marks {
            let Some(cell) = self.cell_of(mark.dot) else {
                continue;
            };
            match groups.iter_mut().find(|(at, _)| *at == cell) {
                Some((_, group)) => group.push(mark),
                None => groups.push((cell, vec![mark])),
            }
        }
        for ((col, row), group) in &groups {
            // Of equals the first shows: p0 before q.
            if let Some(top) = group.iter().rev().max_by_key(|mark| mark.ink) {
                self.put(*col, *row, top.sign.glyph(self.glyphs()), top.ink);
            }
        }
        for (cell, group) in &groups {
            let ink = group.iter().map(|mark| mark.ink).max();
            let upwards = group.iter().any(|mark| mark.at.1 >= 0.0);
            let name = joint_name(group);
            self.label(*cell, &name, ink.unwrap_or(FigureInk::Point), upwards);
        }
    }

    /// The sign of a break that is so many dots wide, in the cells around its middle.
    pub(super) fn zigzag(&mut self, middle: Dot, room: f64, ink: FigureInk) {
        let Some((col, row)) = self.cell_of(middle) else {
            return;
        };
        let sign = if room < 10.0 { "~/~" } else { "~/~/~" };
        for (i, glyph) in sign.chars().enumerate() {
            if let Some(col) = (col + i).checked_sub(sign.len() / 2) {
                self.put(col, row, glyph, ink);
            }
        }
    }
}
