//! Scene files on disk: read, written whole or not at all, and never over somebody else's change.

use std::fs;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use crate::door::{self, Expected};
use crate::scene::LARGEST_FILE;
use crate::system;

/// Whatever is in the place of a scene file.
const ANY: Expected = Expected {
    what: "a scene file",
    most: LARGEST_FILE,
};

/// A file as it was when it was last read or written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Stamp {
    path: PathBuf,
    contents: u64,
}

impl Stamp {
    /// The stamp of a file that is there; none if it can't be read.
    pub fn of(path: &Path) -> Option<Self> {
        Some(Self {
            path: path.to_owned(),
            contents: digest(&ANY.bytes(path).ok()?),
        })
    }

    /// The file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Whether the file still holds what was read or written; a file that is gone has not changed.
    pub fn is_current(&self) -> bool {
        match ANY.bytes(&self.path) {
            Ok(now) => digest(&now) == self.contents,
            Err(_) => !self.path.exists(),
        }
    }
}

fn digest(bytes: &[u8]) -> u64 {
    let mut hasher = DefaultHasher::new();
    bytes.hash(&mut hasher);
    hasher.finish()
}

/// Replaces the file by `text`, whole or not at all; keeps its permissions, follows a link.
pub fn save(path: &Path, text: &str) -> Result<Stamp, String> {
    write(path, text).map_err(|e| {
        let reason = match e.kind() {
            io::ErrorKind::NotFound => "its folder does not exist".to_owned(),
            _ => door::plain(&e),
        };
        format!("{}: not saved: {reason}", path.display())
    })?;
    Ok(Stamp {
        path: path.to_owned(),
        contents: digest(text.as_bytes()),
    })
}

fn write(path: &Path, text: &str) -> io::Result<()> {
    // A link is kept: what it points at is replaced.
    let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    if fs::metadata(&target).is_ok_and(|there| !there.is_file()) {
        return Err(io::Error::other("it is no file that could be replaced"));
    }
    // The name of the file that takes its place says nothing to the person.
    replace(&target, text).map_err(|e| e.kind().into())
}

fn replace(target: &Path, text: &str) -> io::Result<()> {
    let folder = target.parent().filter(|p| !p.as_os_str().is_empty());
    let mut builder = tempfile::Builder::new();
    builder.prefix(".rayscope-");
    // A new file gets what the umask leaves of the usual permissions, an old one keeps its own.
    if let Some(usual) = system::new_file_permissions() {
        builder.permissions(usual);
    }
    let mut file = builder.tempfile_in(folder.unwrap_or(Path::new(".")))?;
    file.write_all(text.as_bytes())?;
    if let Ok(old) = fs::metadata(target) {
        file.as_file().set_permissions(old.permissions())?;
    }
    file.as_file().sync_all()?;
    file.persist(target)?;
    Ok(())
}

/// Files and folders in `folder` whose names start like that, folders ending in `/`; each after `head`.
pub fn starting_with(folder: &Path, head: &str, start: &str) -> Vec<String> {
    let Ok(entries) = fs::read_dir(folder) else {
        return Vec::new();
    };
    let mut names: Vec<_> = entries
        .flatten()
        .filter_map(|entry| {
            let name = entry.file_name().into_string().ok()?;
            let hidden = name.starts_with('.') && !start.starts_with('.');
            let end = if entry.path().is_dir() { "/" } else { "" };
            let fits = end == "/" || entry.path().extension().is_some_and(|e| e == "toml");
            (name.starts_with(start) && fits && !hidden).then(|| format!("{head}{name}{end}"))
        })
        .collect();
    names.sort();
    names
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_changed_by_somebody_else_is_noticed() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.toml");
        let stamp = save(&path, "one").unwrap();
        assert!(stamp.is_current());
        fs::write(&path, "two").unwrap();
        assert!(!stamp.is_current());
        fs::remove_file(&path).unwrap();
        assert!(stamp.is_current());
    }

    #[test]
    fn a_save_that_fails_leaves_the_old_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("none").join("a.toml");
        assert!(save(&path, "one").unwrap_err().contains("not saved"));
        let blocked = folder.path().join("dir");
        fs::create_dir(&blocked).unwrap();
        assert!(save(&blocked, "one").is_err());
        let left: Vec<_> = fs::read_dir(folder.path()).unwrap().collect();
        assert_eq!(left.len(), 1, "no temporary file stays behind");
    }
}
