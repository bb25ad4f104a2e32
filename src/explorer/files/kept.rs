//! The folder of unsaved work: a file for each session, locked for as long as the session lives.

use std::fs::{self, File};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::process;
use std::time::Duration;

use crate::door;
use crate::explorer::files::disk::TEMPORARY;
use crate::scene::Scene;
use crate::system::{create_private_folder, file as filesystem};

/// What the line starts with that says which scene a file belongs to.
const SCENE: &str = "# scene: ";
/// What the line starts with that says who a file belongs to, where several share an account.
const PERSON: &str = "# person: ";
/// The end of the name of a file that was offered and put off.
const PUT_OFF: &str = ".later.toml";
/// Where the unsaved work of a person is kept.
#[derive(Debug, Clone)]
pub(crate) struct KeptFolder {
    pub(crate) folder: PathBuf,
    /// Who it is, where several share an account; else nothing.
    pub(crate) person: String,
}

/// A kept file that no other session can have meanwhile.
#[derive(Debug)]
pub(crate) struct KeptFile {
    pub(crate) path: PathBuf,
    /// It is locked until it is closed.
    file: File,
}

impl KeptFolder {
    /// How many files of a person are kept.
    pub(crate) const MOST: usize = 5;

    /// Writes a file that nobody else may read, whole or not at all: the one at `own`, or a new one.
    pub(crate) fn write(
        &self,
        own: Option<&Path>,
        scene: &str,
        text: &str,
    ) -> io::Result<KeptFile> {
        create_private_folder(&self.folder)?;
        // A temporary file is its owner's alone from the start.
        let mut file = tempfile::Builder::new()
            .prefix(TEMPORARY)
            .tempfile_in(&self.folder)?;
        writeln!(
            file,
            "# Unsaved work, kept by rayscope in case its terminal goes away."
        )?;
        writeln!(file, "{SCENE}{scene}")?;
        if !self.person.is_empty() {
            writeln!(file, "{PERSON}{}", self.person)?;
        }
        write!(file, "\n{text}")?;
        // Where there are no locks, it may be offered to another session.
        let _ = filesystem::lock(file.as_file());
        if let Some(path) = own {
            let (file, path) = (file.persist(path)?, path.to_owned());
            return Ok(KeptFile { path, file });
        }
        let newest = self.files().last().map_or(0, |(number, _)| *number);
        let name = format!("{}-{}.toml", newest.saturating_add(1), process::id());
        let path = self.folder.join(name);
        let file = file.persist_noclobber(&path)?;
        self.prune(Self::MOST - 1);
        Ok(KeptFile { path, file })
    }

    /// The newest file that was kept for a scene that is wanted and not yet offered, and how old it
    /// is.
    pub(crate) fn newest(&self, is_wanted: impl Fn(&str) -> bool) -> Option<(KeptFile, Duration)> {
        let mut files = self.files();
        files.retain(|(_, path)| !path.to_string_lossy().ends_with(PUT_OFF));
        files.into_iter().rev().find_map(|(_, path)| {
            let kept = KeptFile::take(&path)?;
            let (scene, person) = kept.owner()?;
            // A file that is spoilt hides no other.
            if person != self.person || !is_wanted(&scene) || Scene::load(&path).is_err() {
                return None;
            }
            let age = kept.age()?;
            Some((kept, age))
        })
    }

    /// Deletes the oldest files of the person, but for the `most` newest and those of sessions that
    /// live.
    pub(crate) fn prune(&self, most: usize) {
        let own = |path: &Path| {
            let kept = KeptFile::take(path)?;
            let (_, person) = kept.owner()?;
            (person == self.person).then_some(kept)
        };
        let files = self.files();
        let mut over: Vec<_> = files.iter().filter_map(|(_, path)| own(path)).collect();
        over.truncate(over.len().saturating_sub(most));
        for kept in over {
            // One that can't be deleted is one more that is kept.
            let _ = kept.delete();
        }
    }

    /// All files with their numbers, the oldest first: a clock may have gone back.
    fn files(&self) -> Vec<(u128, PathBuf)> {
        let entries = fs::read_dir(&self.folder).into_iter().flatten().flatten();
        let mut files: Vec<_> = entries
            .map(|entry| entry.path())
            .filter(|path| path.extension().is_some_and(|e| e == "toml"))
            .map(|path| (number(&path), path))
            .collect();
        files.sort();
        files
    }
}

/// Writes a file that nobody else may read, whole or not at all, in a folder that is made if need be.
pub(crate) fn write_private(path: &Path, text: &str) -> io::Result<()> {
    let folder = path.parent().unwrap_or(Path::new("."));
    create_private_folder(folder)?;
    let mut file = tempfile::Builder::new()
        .prefix(TEMPORARY)
        .tempfile_in(folder)?;
    file.write_all(text.as_bytes())?;
    file.persist(path)?;
    Ok(())
}

/// The number that a kept file's name begins with.
fn number(path: &Path) -> u128 {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let digits = name.split(|c: char| !c.is_ascii_digit()).next();
    digits.and_then(|d| d.parse().ok()).unwrap_or(0)
}

impl KeptFile {
    /// The file, unless another session has it.
    fn take(path: &Path) -> Option<Self> {
        let file = door::regular(File::options().read(true).write(true), path).ok()?;
        let is_free = filesystem::lock(&file).unwrap_or(true);
        // The session that has it may have put another in its place meanwhile.
        let is_there = filesystem::is_at(&file, path);
        (is_free && is_there).then(|| Self {
            path: path.to_owned(),
            file,
        })
    }

    /// The scene and the person that it belongs to.
    pub(crate) fn owner(&self) -> Option<(String, String)> {
        const LONGEST_HEAD: u64 = 1 << 16;
        let mut head = Vec::new();
        let file = File::open(&self.path).ok()?;
        file.take(LONGEST_HEAD).read_to_end(&mut head).ok()?;
        let head = String::from_utf8_lossy(&head);
        let line = |start| head.lines().find_map(|line| line.strip_prefix(start));
        let scene = line(SCENE)?.to_owned();
        Some((scene, line(PERSON).unwrap_or_default().to_owned()))
    }

    /// How long ago it was written.
    pub(crate) fn age(&self) -> Option<Duration> {
        let written = fs::metadata(&self.path).ok()?.modified().ok()?;
        Some(written.elapsed().unwrap_or_default())
    }

    /// Makes sure that it outlives the whole host.
    pub(crate) fn sync(&self) -> io::Result<()> {
        self.file.sync_all()
    }

    pub(crate) fn delete(self) -> io::Result<()> {
        fs::remove_file(&self.path)
    }

    /// Leaves it where it is under a name that is not offered again.
    pub(crate) fn put_off(self) -> io::Result<PathBuf> {
        let stem = self.path.file_stem().unwrap_or_default();
        let name = stem.to_string_lossy().into_owned() + PUT_OFF;
        let path = self.path.with_file_name(name);
        fs::rename(&self.path, &path)?;
        Ok(path)
    }
}
