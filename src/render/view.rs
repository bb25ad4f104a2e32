//! Views: what of the answers is shown, and how to read it.

use super::Style;

/// What of the answers is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum View {
    /// The nearest visible hit, shaded by a headlight or by the scene's light.
    #[default]
    Shade,
    /// Miss, tangent, secant, inside and behind.
    Class,
    /// The edges of what is visible.
    Outline,
    /// How far the nearest visible hit is.
    Depth,
    /// Which way the surface faces where it is hit.
    Normal,
    /// Sign and size of Δ, in units of 4Ar²; of what is seen, else of what is nearest to being hit.
    Delta,
    /// How many bits of the visible root the method lost.
    Lost,
    /// Which stage of `exact` settled the pixel, whatever the method.
    Stage,
    /// On which side of the sphere the computed point lies, and whether a mirrored ray from there meets the
    /// sphere again.
    Acne,
}

impl View {
    /// All views, in the order in which lists show them.
    pub const ALL: [Self; 9] = [
        Self::Shade,
        Self::Class,
        Self::Outline,
        Self::Depth,
        Self::Normal,
        Self::Delta,
        Self::Lost,
        Self::Stage,
        Self::Acne,
    ];

    /// The name on the command line and on the screen.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Shade => "shade",
            Self::Class => "class",
            Self::Outline => "outline",
            Self::Depth => "depth",
            Self::Normal => "normal",
            Self::Delta => "delta",
            Self::Lost => "lost",
            Self::Stage => "stage",
            Self::Acne => "acne",
        }
    }

    /// The view of that name.
    pub fn by_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|v| v.name() == name)
    }

    /// The view after this one, round and round.
    #[must_use]
    pub fn next(self) -> Self {
        let next = (self as usize + 1) % Self::ALL.len();
        Self::ALL[next]
    }

    /// The view that a style can show: the tutorial's text knows hit and miss of the line, and
    /// nothing else.
    #[must_use]
    pub const fn shown_in(self, style: Style) -> Self {
        match style {
            Style::Tutorial => Self::Class,
            Style::Half | Style::Braille | Style::Ascii => self,
        }
    }

    /// How to read the picture: in `ascii` the characters, in the other styles light and dark.
    pub const fn legend(self, style: Style) -> &'static str {
        match (self.shown_in(style), style) {
            (_, Style::Tutorial) => "++ the line meets a sphere, -- it does not, ?? no answer",
            (Self::Shade, Style::Ascii) => "from . dark to @ bright; ? no answer",
            (Self::Shade, _) => "dark to bright: how squarely the light falls; ? no answer",
            (Self::Class, Style::Ascii) => {
                "# secant, o tangent, @ inside, - behind, ~ tangent behind, . miss, ? no answer"
            }
            (Self::Class, Style::Half) => {
                "full: secant or inside; left half: tangent; right half: behind; ? no answer"
            }
            (Self::Class, _) => "a dot wherever the line meets a sphere; ? no answer",
            (Self::Outline, _) => "the edges of what is seen; ? no answer",
            (Self::Depth, Style::Ascii) => "@ near to . far; ? no answer",
            (Self::Depth, _) => "bright is near, dark is far; ? no answer",
            (Self::Normal, Style::Ascii) => {
                "as on a number pad: 5 faces the eye, 8 up, 6 right, 2 down, 4 left; ? no answer"
            }
            (Self::Normal, _) => {
                "a relief lit from the upper left: bright faces up or left; ? no answer"
            }
            (Self::Delta, Style::Ascii) => {
                "0-9 tenths of 4Ar\u{b2}, o is 0 (tangent), - below 0, . below -4Ar\u{b2}; ? no answer"
            }
            (Self::Delta, Style::Half) => {
                "full: above 0; left half: 0 (tangent); right half: below 0; ? no answer"
            }
            (Self::Delta, _) => "dense inside the edge: above 0; sparse: below 0; ? no answer",
            (Self::Lost, Style::Ascii) => {
                "bits lost of 24: . none, 1-9, a = 10 ... o = 24; ! wrong sphere or class; ? no answer"
            }
            (Self::Lost, _) => "the brighter, the more bits lost; ? no answer",
            (Self::Stage, Style::Ascii) => {
                ". binary64, u unrounded, c compensated, w whole, d double-double, i integer"
            }
            (Self::Stage, _) => "the brighter, the later the stage that settled it",
            (Self::Acne, Style::Ascii) => {
                "point inside i, outside o, on =; * a mirrored ray meets its own sphere; ? no answer"
            }
            (Self::Acne, _) => {
                "bright: a mirrored ray meets its own sphere; dim: its point is inside or outside"
            }
        }
    }

    /// Whether nothing is shown but what is seen before the eye, of the sphere that is seen.
    pub const fn shows_only_what_is_seen(self) -> bool {
        !matches!(self, Self::Class | Self::Delta | Self::Stage)
    }

    /// Whether nothing is shown but where which sphere is seen and how lines meet it: no root, and
    /// nothing that depends on one.
    pub const fn shows_only_contours(self) -> bool {
        matches!(self, Self::Class | Self::Outline)
    }

    /// Whether the visible roots themselves are shown, or numbers that depend on their last bits.
    pub const fn shows_roots(self) -> bool {
        matches!(self, Self::Depth | Self::Acne)
    }

    /// Whether pixels differ by how bright they are, and not only by what they are.
    pub(super) const fn has_levels(self) -> bool {
        !matches!(self, Self::Class | Self::Outline)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_view_has_its_place_its_name_and_a_legend() {
        for (i, view) in View::ALL.into_iter().enumerate() {
            assert_eq!(view as usize, i);
            assert_eq!(View::by_name(view.name()), Some(view));
            assert_eq!(view.next(), View::ALL[(i + 1) % View::ALL.len()]);
            for style in Style::ALL {
                let legend = view.legend(style);
                assert!(!legend.is_empty() && legend.chars().count() <= 96);
            }
        }
    }
}
