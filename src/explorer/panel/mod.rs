//! Which panels there are, and how they share the space beside the picture.
//!
//! A panel is a line of the list below and a file, which owns its state, its actions, its lines and
//! its foot.

pub(crate) mod all;
pub(crate) mod bits;
pub(crate) mod board;
pub(crate) mod compare;
pub(crate) mod component;
pub(crate) mod curve;
pub(crate) mod dial;
pub(crate) mod error;
pub(crate) mod plan;
pub(crate) mod quadratic;
pub(crate) mod slice;
pub(crate) mod steps;

use ratatui::layout::Rect;

/// Hands the list of panels to a macro: name in the code, file and name on the command line, the
/// component, what it shows. The order is that of the keys, and the one in which panels fill what
/// room there is.
macro_rules! with_panels {
    ($use:ident) => {
        $use! {
            Quadratic quadratic QuadraticPanel "A, B, C, Δ, the roots and the point of the ray under the cursor.";
            Steps steps StepsPanel "The derivation, a step at a time.";
            Slice slice SlicePanel "The plane through ray and centre.";
            Curve curve CurvePanel "f(t) = At² + Bt + C.";
            Bits bits BitsPanel "The bits of a number.";
            Compare compare ComparePanel "The methods side by side.";
            Error error ErrorPanel "Error against run time for this picture.";
            Plan plan PlanPanel "What the frame needed, and what was left out.";
            Dial dial DialPanel "A dial on the scene, and what the method gets wrong.";
        }
    };
}
pub(crate) use with_panels;

macro_rules! names {
    ($($panel:ident $name:ident $component:ident $about:literal;)*) => {
        /// A panel beside the picture.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
        pub enum Panel {
            $(
                #[doc = $about]
                $panel,
            )*
        }

        impl Default for Panel {
            fn default() -> Self {
                Self::ALL[0]
            }
        }

        impl Panel {
            /// All panels, in the order of their keys.
            pub const ALL: [Self; [$(stringify!($name)),*].len()] = [$(Self::$panel),*];

            /// The name on the command line.
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$panel => stringify!($name),)*
                }
            }
        }
    };
}
with_panels!(names);

/// The least width and height that a panel is useful in.
const LEAST: (u16, u16) = (46, 21);

impl Panel {
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
