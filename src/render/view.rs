//! Views: what of the answers is shown.

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
}

impl View {
    /// All views, in the order in which lists show them.
    pub const ALL: [Self; 3] = [Self::Shade, Self::Class, Self::Outline];

    /// The name on the command line and on the screen.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Shade => "shade",
            Self::Class => "class",
            Self::Outline => "outline",
        }
    }

    /// The view of that name.
    pub fn by_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|v| v.name() == name)
    }

    /// The view after this one, round and round.
    #[must_use]
    pub const fn next(self) -> Self {
        match self {
            Self::Shade => Self::Class,
            Self::Class => Self::Outline,
            Self::Outline => Self::Shade,
        }
    }

    /// The view that a style can show: the tutorial's text knows hit and miss of the line, and
    /// nothing else.
    #[must_use]
    pub const fn shown_in(self, style: Style) -> Self {
        match style {
            Style::Seed => Self::Class,
            Style::Half | Style::Braille | Style::Ascii => self,
        }
    }
}
