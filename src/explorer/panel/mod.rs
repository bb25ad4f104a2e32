//! Which panels there are, and how they share the space beside the picture.

pub(crate) mod dial;
pub(crate) mod draw;
pub(crate) mod error;
pub(crate) mod steps;

use ratatui::layout::Rect;

/// A panel beside the picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Panel {
    /// A, B, C, Δ, the roots and the point of the ray under the cursor.
    #[default]
    Quadratic,
    /// The derivation, a step at a time.
    Steps,
    /// The plane through ray and centre.
    Slice,
    /// f(t) = At² + Bt + C.
    Curve,
    /// The bits of a number.
    Bits,
    /// The methods side by side.
    Compare,
    /// Error against run time for this picture.
    Error,
    /// What the frame needed, and what was left out.
    Plan,
    /// A dial on the scene, and what the method gets wrong.
    Dial,
}

/// The least width and height that a panel is useful in.
const LEAST: (u16, u16) = (46, 21);

impl Panel {
    /// All panels, in the order of their keys, which is also the order in which they fill what room
    /// there is.
    pub const ALL: [Self; 9] = [
        Self::Quadratic,
        Self::Steps,
        Self::Slice,
        Self::Curve,
        Self::Bits,
        Self::Compare,
        Self::Error,
        Self::Plan,
        Self::Dial,
    ];

    /// The name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Quadratic => "quadratic",
            Self::Steps => "steps",
            Self::Slice => "slice",
            Self::Curve => "curve",
            Self::Bits => "bits",
            Self::Compare => "compare",
            Self::Error => "error",
            Self::Plan => "plan",
            Self::Dial => "dial",
        }
    }

    /// The panels that fit into `side`, each with its place: `first`, then the others in order.
    pub fn tiles(side: Rect, first: Self) -> Vec<(Self, Rect)> {
        if side.is_empty() {
            return Vec::new();
        }
        let columns = (side.width / LEAST.0).max(1);
        let rows = (side.height / LEAST.1).max(1);
        let others = Self::ALL.into_iter().filter(|&p| p != first);
        let places = (0..columns).flat_map(|c| (0..rows).map(move |r| (c, r)));
        std::iter::once(first)
            .chain(others)
            .zip(places)
            .map(|(panel, (c, r))| (panel, tile(side, (columns, rows), (c, r))))
            .collect()
    }
}

/// The place in column `c` and row `r` of `side` when it is shared evenly.
fn tile(side: Rect, (columns, rows): (u16, u16), (c, r): (u16, u16)) -> Rect {
    let edge = |start: u16, length: u16, count: u16, at: u16| {
        start + (u32::from(length) * u32::from(at) / u32::from(count)) as u16
    };
    let [left, right] = [c, c + 1].map(|at| edge(side.x, side.width, columns, at));
    let [top, bottom] = [r, r + 1].map(|at| edge(side.y, side.height, rows, at));
    Rect::new(left, top, right - left, bottom - top)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_share_the_side_without_overlap() {
        for width in [0, 38, 58, 100, 158, 300] {
            for height in [0, 22, 48, 58, 118] {
                let side = Rect::new(42, 1, width, height);
                let tiles = Panel::tiles(side, Panel::Compare);
                assert_eq!(tiles.is_empty(), side.is_empty());
                for (i, (panel, area)) in tiles.iter().enumerate() {
                    assert_eq!(area.intersection(side), *area);
                    for (other, elsewhere) in &tiles[i + 1..] {
                        assert_ne!(panel, other);
                        assert!(!area.intersects(*elsewhere));
                    }
                }
            }
        }
        let small = Panel::tiles(Rect::new(42, 1, 38, 22), Panel::Compare);
        assert_eq!(small, [(Panel::Compare, Rect::new(42, 1, 38, 22))]);
    }
}
