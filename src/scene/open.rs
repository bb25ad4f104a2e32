//! A scene by the word a person gives for it: a built-in name, else a file.

use std::path::{Path, PathBuf};

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
    /// The built-in scene of that name, else the scene in that file.
    pub fn open(name: &str) -> Result<(Self, Source), FileError> {
        if let Some(builtin) = Builtin::by_name(name) {
            return Ok((builtin.scene(), Source::Builtin(builtin)));
        }
        let path = Path::new(name);
        Ok((Self::load(path)?, Source::File(path.to_owned())))
    }
}
