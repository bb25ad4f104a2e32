//! The scenes that come with the program: a file each beside this one, embedded, and for `crowd`
//! a rule that makes its spheres.

mod crowd;

use super::Scene;
use crate::text::by_name;

/// A scene that comes with the program.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Builtin {
    /// What opens where no scene is asked for: three spheres in the tutorial's geometry.
    #[default]
    Opening,
    /// The tutorial's screen.
    Tutorial,
    /// A line that misses, one that touches, one that crosses.
    ThreeLines,
    /// Three spheres in perspective, overlapping.
    Trio,
    /// The eye inside a sphere.
    Inside,
    /// Spheres behind the eye.
    Behind,
    /// A sphere the size of the Earth underfoot.
    Planet,
    /// A small sphere far away, which binary32 garbles in the textbook's formula.
    Far,
    /// Rays that are all but tangent.
    Grazing,
    /// Ten thousand spheres.
    Crowd,
}

impl Builtin {
    /// All of them, in the order in which lists show them.
    pub const ALL: [Self; 10] = [
        Self::Opening,
        Self::Tutorial,
        Self::ThreeLines,
        Self::Trio,
        Self::Inside,
        Self::Behind,
        Self::Planet,
        Self::Far,
        Self::Grazing,
        Self::Crowd,
    ];

    /// The name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Opening => "opening",
            Self::Tutorial => "tutorial",
            Self::ThreeLines => "three-lines",
            Self::Trio => "trio",
            Self::Inside => "inside",
            Self::Behind => "behind",
            Self::Planet => "planet",
            Self::Far => "far",
            Self::Grazing => "grazing",
            Self::Crowd => "crowd",
        }
    }

    /// The built-in scene of that name.
    pub fn by_name(name: &str) -> Option<Self> {
        by_name(Self::ALL, Self::name, name)
    }

    /// One sentence on what there is to see.
    pub fn about(self) -> String {
        self.file().about.unwrap_or_default()
    }

    /// The scene itself.
    pub fn scene(self) -> Scene {
        let mut scene = self.file();
        if self == Self::Crowd {
            scene.bodies = crowd::bodies();
        }
        scene
    }

    /// What the embedded file says; of `crowd`, all but the spheres.
    fn file(self) -> Scene {
        let text = match self {
            Self::Opening => include_str!("builtin/opening.toml"),
            Self::Tutorial => include_str!("builtin/tutorial.toml"),
            Self::ThreeLines => include_str!("builtin/three-lines.toml"),
            Self::Trio => include_str!("builtin/trio.toml"),
            Self::Inside => include_str!("builtin/inside.toml"),
            Self::Behind => include_str!("builtin/behind.toml"),
            Self::Planet => include_str!("builtin/planet.toml"),
            Self::Far => include_str!("builtin/far.toml"),
            Self::Grazing => include_str!("builtin/grazing.toml"),
            Self::Crowd => include_str!("builtin/crowd.toml"),
        };
        Scene::parse(text, self.name())
            .unwrap_or_else(|error| unreachable!("a built-in scene is refused: {error}"))
    }
}
