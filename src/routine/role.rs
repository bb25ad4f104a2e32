//! What a parameter is for: by its name, by its place, or by a comment line that says so.

/// A part of the question.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) enum ParameterRole {
    /// p0.
    Origin,
    /// p0 − c, where no centre is asked for.
    FromCenter,
    /// d.
    Direction,
    /// c.
    Center,
    /// r.
    Radius,
    /// r².
    RadiusSquared,
    /// c and r in one.
    Sphere,
    /// The least t that counts.
    Least,
    /// The greatest t that counts.
    Most,
    /// What the routine gives there: the smaller root, or the only one.
    Near,
    /// The larger root.
    Far,
    /// A point or a direction that it gives beside.
    Other,
}

const NAMES: [(ParameterRole, &str); 12] = [
    (ParameterRole::Origin, "origin"),
    (ParameterRole::FromCenter, "origin from the centre"),
    (ParameterRole::Direction, "direction"),
    (ParameterRole::Center, "center"),
    (ParameterRole::Radius, "radius"),
    (ParameterRole::RadiusSquared, "radius squared"),
    (ParameterRole::Sphere, "sphere"),
    (ParameterRole::Least, "least t"),
    (ParameterRole::Most, "greatest t"),
    (ParameterRole::Near, "near"),
    (ParameterRole::Far, "far"),
    (ParameterRole::Other, "other"),
];

impl ParameterRole {
    /// The word for it.
    pub fn name(self) -> &'static str {
        let named = NAMES.iter().find(|(role, _)| *role == self);
        named.map_or("other", |(_, name)| name)
    }

    /// The role that a comment line names.
    pub fn said(word: &str) -> Option<Self> {
        let word = word.trim().to_ascii_lowercase();
        let word = if word == "centre" { "center" } else { &word };
        let named = NAMES.iter().find(|(_, name)| *name == word);
        named.map(|&(role, _)| role).or_else(|| Self::usual(word))
    }

    /// What a name usually means; none for a name that may mean anything.
    #[expect(clippy::too_many_lines, reason = "a list of names")]
    pub fn usual(name: &str) -> Option<Self> {
        let name: String = name
            .trim_start_matches("in_")
            .chars()
            .filter(|c| *c != '_')
            .map(|c| c.to_ascii_lowercase())
            .collect();
        let known: &[(Self, &[&str])] = &[
            (
                Self::Origin,
                &[
                    "ro",
                    "origin",
                    "rayorigin",
                    "rayorig",
                    "orig",
                    "org",
                    "o",
                    "p0",
                    "start",
                    "raystart",
                    "raypos",
                    "rorg",
                    "eye",
                    "campos",
                    "raypoint",
                    "rayo",
                ],
            ),
            (
                Self::Direction,
                &[
                    "rd",
                    "direction",
                    "raydirection",
                    "raydir",
                    "dir",
                    "d",
                    "rdir",
                    "rayd",
                    "v",
                    "viewdir",
                ],
            ),
            (
                Self::Center,
                &[
                    "ce",
                    "center",
                    "centre",
                    "spherecenter",
                    "spherecentre",
                    "spherepos",
                    "sc",
                    "cen",
                    "c",
                    "so",
                    "sphereorigin",
                    "sphcenter",
                    "s0",
                    "pos",
                    "position",
                    "sphereposition",
                ],
            ),
            (
                Self::Radius,
                &["ra", "radius", "sphereradius", "r", "rad", "sr", "spherer"],
            ),
            (
                Self::RadiusSquared,
                &[
                    "r2",
                    "rr",
                    "ra2",
                    "radius2",
                    "radiussquared",
                    "sqradius",
                    "rsq",
                    "radiussq",
                ],
            ),
            (Self::Sphere, &["sph", "sphere", "s", "ball"]),
            (Self::Least, &["tmin", "mint", "raytmin", "tstart"]),
            (
                Self::Most,
                &["tmax", "maxt", "raytmax", "tend", "maxdist", "maxdistance"],
            ),
            (
                Self::Near,
                &[
                    "t0", "tnear", "near", "tn", "t", "dist", "distance", "tin", "tenter", "thit",
                    "hit", "tc0",
                ],
            ),
            (
                Self::Far,
                &["t1", "t2", "tfar", "far", "tf", "tout", "texit"],
            ),
        ];
        known
            .iter()
            .find(|(_, names)| names.contains(&name.as_str()))
            .map(|&(role, _)| role)
    }
}
