//! From places on the line to columns of dots, with breaks where a long way is left out.
//!
//! ```text
//!   side   gap        main         gap   side
//! ├──p0──┤~/~/├───────P₁──P₂──────┤
//! ```

use super::section::{Anchor, LinePoint, Section};

/// A stretch of the line that is drawn to scale.
#[derive(Debug, Clone, Copy)]
pub(super) struct Piece {
    /// Where places are measured from.
    pub anchor: Anchor,
    /// The offset at the left edge, in lengths.
    first: f64,
    /// The left edge, in dots.
    pub left: f64,
    /// The right edge, in dots.
    pub right: f64,
}

/// The pieces of the line, from left to right, all to one scale.
#[derive(Debug, Clone)]
pub(super) struct Axis {
    /// Dots a length.
    pub scale: f64,
    pub pieces: Vec<Piece>,
}

/// Where a place of the line is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum AxisPosition {
    /// At this dot, to scale.
    On(f64),
    /// About at this dot, in a break.
    Break(f64),
    /// Further left than the figure reaches.
    Before,
    /// Further right than the figure reaches.
    After,
}

/// Which part of the line the widest piece shows: offsets from an anchor.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stretch {
    pub anchor: Anchor,
    pub from: f64,
    pub to: f64,
}

impl Stretch {
    fn length(self) -> f64 {
        self.to - self.from
    }
}

/// The room that a figure has for its shapes, in dots.
#[derive(Debug, Clone, Copy)]
pub(super) struct DrawingArea {
    pub left: f64,
    pub right: f64,
    pub top: f64,
    pub bottom: f64,
}

impl DrawingArea {
    pub(super) fn width(self) -> f64 {
        self.right - self.left
    }

    pub(super) fn height(self) -> f64 {
        self.bottom - self.top
    }

    pub(super) fn middle(self) -> f64 {
        f64::midpoint(self.top, self.bottom)
    }

    /// What the widest piece has left beside this number of pieces at its sides.
    pub(super) fn width_beside(self, sides: usize) -> f64 {
        self.width() - sides as f64 * (self.side() + self.gap())
    }

    fn side(self) -> f64 {
        (self.width() / 8.0).clamp(2.0, 10.0)
    }

    fn gap(self) -> f64 {
        (self.width() / 5.0).clamp(4.0, 24.0)
    }
}

impl Axis {
    /// `main` in the middle of the frame, and breaks to a place before and to a place after it.
    pub(super) fn lay(
        frame: DrawingArea,
        before: Option<Anchor>,
        main: Stretch,
        after: Option<Anchor>,
        most_scale: f64,
    ) -> Self {
        let beside = frame.side() + frame.gap();
        let left = frame.left + if before.is_some() { beside } else { 0.0 };
        let right = frame.right - if after.is_some() { beside } else { 0.0 };
        let fitting = (right - left) / main.length();
        let scale = fitting.min(most_scale);
        let scale = if scale.is_finite() { scale } else { 1.0 };
        let spare = (right - left) / scale - main.length();
        let side_piece = |anchor, left| Piece {
            anchor,
            first: -frame.side() / scale / 2.0,
            left,
            right: left + frame.side(),
        };
        let mut pieces = Vec::with_capacity(3);
        pieces.extend(before.map(|anchor| side_piece(anchor, frame.left)));
        pieces.push(Piece {
            anchor: main.anchor,
            first: main.from - spare / 2.0,
            left,
            right,
        });
        pieces.extend(after.map(|anchor| side_piece(anchor, frame.right - frame.side())));
        Self { scale, pieces }
    }

    /// The dot of a place, counted on beyond the edges of a piece.
    pub(super) fn dot(&self, piece: &Piece, section: &Section, spot: LinePoint) -> f64 {
        self.dot_at(piece, section.offset(spot, piece.anchor))
    }

    /// The dot at an offset from the piece's anchor.
    pub(super) fn dot_at(&self, piece: &Piece, offset: f64) -> f64 {
        piece.left + (offset - piece.first) * self.scale
    }

    /// The offset from the piece's anchor at a dot.
    pub(super) fn offset(&self, piece: &Piece, dot: f64) -> f64 {
        piece.first + (dot - piece.left) / self.scale
    }

    /// Where a place is drawn.
    pub(super) fn place(&self, section: &Section, spot: LinePoint) -> AxisPosition {
        let mut passed: Option<&Piece> = None;
        for piece in &self.pieces {
            let dot = self.dot(piece, section, spot);
            if dot < piece.left - EDGE {
                let Some(before) = passed else {
                    return AxisPosition::Before;
                };
                return AxisPosition::Break(self.in_break(before, piece, section, spot));
            }
            if dot <= piece.right + EDGE {
                return AxisPosition::On(dot);
            }
            passed = Some(piece);
        }
        AxisPosition::After
    }

    /// In proportion between the pieces on both sides of a break.
    fn in_break(&self, before: &Piece, after: &Piece, section: &Section, spot: LinePoint) -> f64 {
        let (from, to) = self.break_ends(before, after, section);
        let part = (section.position(spot) - from) / (to - from);
        let part = if part.is_nan() {
            0.5
        } else {
            part.clamp(0.0, 1.0)
        };
        before.right + part * (after.left - before.right)
    }

    fn break_ends(&self, before: &Piece, after: &Piece, section: &Section) -> (f64, f64) {
        let at = |piece: &Piece, dot| {
            section.position(LinePoint::At(piece.anchor)) + self.offset(piece, dot)
        };
        (at(before, before.right), at(after, after.left))
    }

    /// The piece that a place lies on, and its dot.
    pub(super) fn on(&self, section: &Section, spot: LinePoint) -> Option<(Piece, f64)> {
        let inside = |piece: &Piece| {
            let dot = self.dot(piece, section, spot);
            let on = (piece.left - EDGE..=piece.right + EDGE).contains(&dot);
            on.then_some((*piece, dot))
        };
        self.pieces.iter().find_map(inside)
    }

    /// The pieces with the dots from and up to which they are drawn: the outer ones reach into
    /// the margins of a sheet of that width.
    pub(super) fn drawn(&self, width: f64) -> Vec<(Piece, f64, f64)> {
        let last = self.pieces.len().saturating_sub(1);
        let edges = |(i, piece): (usize, &Piece)| {
            let left = if i == 0 { 0.0 } else { piece.left };
            let right = if i == last { width } else { piece.right };
            (*piece, left, right)
        };
        self.pieces.iter().enumerate().map(edges).collect()
    }

    /// The pieces before and after each break.
    pub(super) fn breaks(&self) -> Vec<(Piece, Piece)> {
        let pieces = self.pieces.iter().copied();
        pieces.clone().zip(pieces.skip(1)).collect()
    }

    /// The widest piece.
    pub(super) fn main(&self) -> Option<&Piece> {
        let width = |p: &Piece| p.right - p.left;
        self.pieces
            .iter()
            .max_by(|p, q| width(p).total_cmp(&width(q)))
    }

    /// The length of the line that a break leaves out.
    pub(super) fn left_out(&self, before: &Piece, after: &Piece, section: &Section) -> f64 {
        let (from, to) = self.break_ends(before, after, section);
        to - from
    }
}

/// How far beyond the edge of a piece, in dots, a place still counts as on it.
const EDGE: f64 = 0.5;
