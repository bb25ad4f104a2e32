//! A scene by the word a person gives for it: a built-in name, else a file.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use super::{Builtin, Scene};
use crate::door::FileError;
use crate::text::nearest;

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
    pub fn open(name: impl AsRef<OsStr>) -> Result<(Self, Source), FileError> {
        let name = name.as_ref();
        if let Some(builtin) = name.to_str().and_then(Builtin::by_name) {
            return Ok((builtin.scene(), Source::Builtin(builtin)));
        }
        let path = Path::new(name);
        if let Ok(false) = path.try_exists() {
            return Err(neither(path));
        }
        Ok((Self::load(path)?, Source::File(path.to_owned())))
    }
}

fn neither(path: &Path) -> FileError {
    let names = Builtin::ALL.map(Builtin::name);
    let expected = match nearest(&path.to_string_lossy(), names) {
        Some(meant) => format!("perhaps {meant}"),
        None => format!("a scene file or one of {}", names.join(", ")),
    };
    let found = "found no such file and no such built-in scene";
    FileError::whole(path, format!("{found}, expected {expected}"))
}
