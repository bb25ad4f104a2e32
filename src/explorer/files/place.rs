//! Where a scene came from and goes to.

use crate::explorer::files::disk::Stamp;
use crate::scene::{Builtin, Source};

/// Where the scene came from and goes to.
#[derive(Debug, Clone)]
pub(crate) enum FilePlace {
    /// It has no file yet.
    None,
    Builtin(Builtin),
    File(Stamp),
}

impl FilePlace {
    pub(crate) fn of(source: &Source) -> Self {
        match source {
            Source::File(path) => Stamp::of(path).map_or(Self::None, Self::File),
            Source::Builtin(builtin) => Self::Builtin(*builtin),
        }
    }
}
