//! Which story of a pixel is told: that of the quadratic, or that of its floating point.

/// Through what a pixel is looked at.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Lens {
    /// The quadratic of the ray, worked exactly and shown rounded; the same for every method.
    #[default]
    Mathematics,
    /// What the operations of the chosen method gave, with the exact values beside.
    Machine,
}

impl Lens {
    /// Both, in the order in which lists show them.
    pub const ALL: [Self; 2] = [Self::Mathematics, Self::Machine];

    /// The name on the command line and on the screen.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Mathematics => "mathematics",
            Self::Machine => "machine",
        }
    }

    /// The other one.
    #[must_use]
    pub const fn other(self) -> Self {
        match self {
            Self::Mathematics => Self::Machine,
            Self::Machine => Self::Mathematics,
        }
    }
}
