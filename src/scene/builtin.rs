//! The scenes that come with the program: files beside this one, and one made by a rule.

use super::Scene;

/// A scene that comes with the program.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Builtin {
    /// The tutorial's screen.
    #[default]
    Seed,
    /// Three spheres in perspective, overlapping.
    Trio,
}

impl Builtin {
    /// All of them, in the order in which lists show them.
    pub const ALL: [Self; 2] = [Self::Seed, Self::Trio];

    /// The name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Seed => "seed",
            Self::Trio => "trio",
        }
    }

    /// The scene of that name.
    pub fn by_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|b| b.name() == name)
    }

    const fn text(self) -> &'static str {
        match self {
            Self::Seed => include_str!("builtin/seed.toml"),
            Self::Trio => include_str!("builtin/trio.toml"),
        }
    }

    /// The scene itself.
    pub fn scene(self) -> Scene {
        Scene::parse(self.text(), self.name())
            .unwrap_or_else(|error| unreachable!("a built-in scene is refused: {error}"))
    }
}
