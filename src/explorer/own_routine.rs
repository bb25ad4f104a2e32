//! A routine that was opened from a file, whether that file has changed since, and its text while it is typed.

use std::path::{Path, PathBuf};
use std::time::SystemTime;

use crate::explorer::files::disk::Stamp;
use crate::explorer::routine_text::RoutineText;
use crate::method::Method;

/// A routine and the file that it came from.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct OwnRoutine {
    pub(crate) method: Method,
    /// As it was named.
    pub(crate) name: String,
    pub(crate) path: PathBuf,
    /// What the file was like when it was read.
    pub(crate) stamp: FileStamp,
}

/// A routine whose text is open for typing.
#[derive(Debug)]
pub(crate) struct OpenText {
    pub(crate) text: RoutineText,
    /// As it was named, and the file that this names.
    pub(crate) name: String,
    pub(crate) path: PathBuf,
    /// The file as it was last read or written; none while there is none.
    pub(crate) file: Option<Stamp>,
    /// What nobody would miss: the text of the file, or what a new one begins with.
    pub(crate) known: String,
    /// The method that was chosen before.
    pub(crate) before: Method,
}

impl OpenText {
    /// Whether something was typed that is not saved.
    pub(crate) fn is_changed(&self) -> bool {
        self.text.text() != self.known
    }
}

/// By what a change of a file is noticed: when it was written, and how long it is.
pub(crate) type FileStamp = Option<(SystemTime, u64)>;

/// What a file is like now; none where there is none.
pub(crate) fn stamp(path: &Path) -> FileStamp {
    let found = std::fs::metadata(path).ok()?;
    Some((found.modified().ok()?, found.len()))
}
