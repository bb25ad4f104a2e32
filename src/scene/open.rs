//! A scene by the word a person gives for it: a built-in name, else a file.

use std::path::{Path, PathBuf};

use super::value::nearest;
use super::{Builtin, FileError, Scene};

/// Where a scene came from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Source {
    /// It is part of the program.
    Builtin(Builtin),
    /// It was read from this file.
    File(PathBuf),
}

impl Scene {
    /// The built-in scene of that name, else the scene in that file; a file that happens to have
    /// the name of a built-in scene is reached as `./name`.
    pub fn open(name: &str) -> Result<(Self, Source), FileError> {
        if let Some(builtin) = Builtin::by_name(name) {
            return Ok((builtin.scene(), Source::Builtin(builtin)));
        }
        let path = Path::new(name);
        if let Ok(false) = path.try_exists() {
            return Err(neither(name));
        }
        Ok((Self::load(path)?, Source::File(path.to_owned())))
    }
}

fn neither(name: &str) -> FileError {
    let names = Builtin::ALL.map(Builtin::name);
    let expected = match nearest(name, names) {
        Some(meant) => format!("perhaps {meant}"),
        None => format!("a scene file or one of {}", names.join(", ")),
    };
    FileError {
        file: name.to_owned(),
        position: None,
        problem: format!("found no such file and no such built-in scene, expected {expected}"),
    }
}
