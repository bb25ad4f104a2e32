//! Files of unsaved work: written for their owner alone, found again by the scene they belong to.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process;
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use crate::door::Expected;
use crate::explorer::files::disk::TEMPORARY;
use crate::scene::{LARGEST_FILE, Source};
use crate::system;

/// A file that was kept: a scene, and a few lines before it.
const KEPT: Expected = Expected {
    what: "a scene file",
    most: LARGEST_FILE,
};

/// What the line starts with that says which scene a file belongs to.
const BELONGS: &str = "# scene: ";

/// Where unsaved work is kept.
#[derive(Debug)]
pub(crate) struct Rescue {
    pub(crate) folder: PathBuf,
    /// What the scene was opened as: a built-in's name, or the path of a file.
    pub(crate) scene: String,
    /// The file that the work at hand was taken from.
    pub(crate) taken: Option<PathBuf>,
    /// Files that go when the person leaves.
    pub(crate) discarded: Vec<PathBuf>,
}

impl Rescue {
    /// Writes a file that nobody else may read, whole or not at all, and over no other.
    pub(crate) fn keep(&self, text: &str) -> io::Result<PathBuf> {
        system::create_private_folder(&self.folder)?;
        // A temporary file is its owner's alone from the start.
        let mut file = tempfile::Builder::new()
            .prefix(TEMPORARY)
            .tempfile_in(&self.folder)?;
        write!(
            file,
            "# Unsaved work that rayscope kept when its terminal was gone.\n{BELONGS}{}\n\n{text}",
            self.scene
        )?;
        file.as_file().sync_all()?;
        let since = SystemTime::now().duration_since(UNIX_EPOCH);
        let since = since.unwrap_or_default().as_nanos();
        let path = self.folder.join(format!("{since}-{}.toml", process::id()));
        file.persist_noclobber(&path)?;
        Ok(path)
    }

    /// The newest file kept for a scene that is wanted, and how old it is.
    pub(crate) fn newest(&self, is_wanted: impl Fn(&str) -> bool) -> Option<(PathBuf, Duration)> {
        fs::read_dir(&self.folder)
            .ok()?
            .flatten()
            .map(|entry| entry.path())
            .filter(|path| path.extension().is_some_and(|e| e == "toml"))
            .filter(|path| owner(path).is_some_and(|scene| is_wanted(&scene)))
            .filter(|path| !self.discarded.contains(path))
            .filter_map(|path| {
                let age = age(&path)?;
                Some((path, age))
            })
            .min_by_key(|(_, age)| *age)
    }

    pub(crate) fn remove_discarded(&mut self) {
        for path in self.discarded.drain(..) {
            // One that can't be deleted is offered once more, which loses nothing.
            let _ = fs::remove_file(path);
        }
    }

    pub(crate) fn forget_taken(&mut self) {
        if let Some(path) = self.taken.take() {
            // One that can't be deleted is offered once more, which loses nothing.
            let _ = fs::remove_file(path);
        }
    }
}

/// How long ago a file was written.
pub(crate) fn age(path: &Path) -> Option<Duration> {
    let written = fs::metadata(path).ok()?.modified().ok()?;
    Some(written.elapsed().unwrap_or_default())
}

/// The scene that a kept file belongs to.
pub(crate) fn owner(path: &Path) -> Option<String> {
    let text = KEPT.text(path).ok()?;
    let mut lines = text.lines().filter_map(|l| l.strip_prefix(BELONGS));
    lines.next().map(str::to_owned)
}

/// What a scene was opened as, in one line.
pub(crate) fn identity(source: &Source) -> String {
    match source {
        Source::Builtin(builtin) => builtin.name().to_owned(),
        Source::File(path) => {
            let path = fs::canonicalize(path).unwrap_or_else(|_| path.clone());
            path.to_string_lossy().replace(['\n', '\r'], "?")
        }
    }
}
