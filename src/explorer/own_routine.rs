//! A routine that was opened from a file, and whether that file has changed since.

use std::path::{Path, PathBuf};
use std::time::SystemTime;

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

/// By what a change of a file is noticed: when it was written, and how long it is.
pub(crate) type FileStamp = Option<(SystemTime, u64)>;

/// What a file is like now; none where there is none.
pub(crate) fn stamp(path: &Path) -> FileStamp {
    let found = std::fs::metadata(path).ok()?;
    Some((found.modified().ok()?, found.len()))
}
