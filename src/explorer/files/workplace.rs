//! Where an explorer works: the files it may reach, where it keeps unsaved work, whom it queues with.

use std::path::{Component, Path, PathBuf};

use crate::door::typed;
use crate::explorer::files::disk;
use crate::explorer::files::kept::KeptFolder;
use crate::lab::BenchQueue;

/// The surroundings of an explorer. By default it has none: no name of a file reaches anything, and
/// nobody shares its queue.
#[derive(Debug, Clone)]
pub struct Workplace {
    /// What relative names start from; nothing stands for the folder that the process works in.
    folder: PathBuf,
    /// Whether only files in that folder can be reached.
    is_confined: bool,
    /// Where unsaved work is kept.
    pub state: Option<PathBuf>,
    /// Who works here, where several share an account; else nothing.
    person: String,
    /// The queue to measure in.
    pub queue: BenchQueue,
}

impl Default for Workplace {
    fn default() -> Self {
        Self {
            folder: PathBuf::new(),
            is_confined: true,
            state: None,
            person: String::new(),
            queue: BenchQueue::private(),
        }
    }
}

impl Workplace {
    /// That of this process and its host; unsaved work is kept in `state`.
    pub fn of_process(state: Option<PathBuf>) -> Self {
        Self {
            folder: PathBuf::new(),
            is_confined: false,
            state,
            person: String::new(),
            queue: BenchQueue::of_host(),
        }
    }

    /// The same for one of several people who share an account.
    #[must_use]
    pub fn of_person(self, person: String) -> Self {
        Self { person, ..self }
    }

    /// Whether unsaved work is to be kept, with a folder for it or without.
    pub(crate) fn keeps(&self) -> bool {
        self.state.is_some() || !self.is_confined
    }

    /// What is remembered for the next start, if there is a place: for each person who shares an
    /// account by a name of their own.
    pub(crate) fn settings_file(&self) -> Option<PathBuf> {
        let folder = self.state.as_ref()?;
        let letters = self.person.chars().filter(char::is_ascii_alphanumeric);
        let letters: Vec<char> = letters.collect();
        let own: String = letters[letters.len().saturating_sub(16)..].iter().collect();
        Some(folder.join(format!("settings{own}")))
    }

    /// Where it is kept, if there is a place.
    pub(crate) fn kept_folder(&self) -> Option<KeptFolder> {
        self.state.clone().map(|folder| KeptFolder {
            folder,
            person: self.person.clone(),
        })
    }

    /// Where it is kept how predictions went.
    pub(crate) fn progress_file(&self) -> Option<PathBuf> {
        let person: String = self
            .person
            .chars()
            .filter(char::is_ascii_alphanumeric)
            .collect();
        let tail = &person[person.len().saturating_sub(32)..];
        let name = if tail.is_empty() {
            "progress.json".to_owned()
        } else {
            format!("progress-{tail}.json")
        };
        Some(self.state.as_ref()?.join(name))
    }

    /// Where the unsaved text of a routine is kept, for each file of each person.
    pub(crate) fn kept_text(&self, path: &Path) -> Option<PathBuf> {
        let path = std::path::absolute(path).ok()?;
        let name = disk::digest(format!("{} {}", self.person, path.display()).as_bytes());
        Some(self.state.as_ref()?.join(format!("routine-{name:016x}")))
    }

    /// Whether programs of the person may be started here.
    pub(crate) const fn starts_programs(&self) -> bool {
        !self.is_confined
    }

    /// No place but a folder to keep unsaved work in.
    #[cfg(test)]
    pub(crate) fn keeping_in(state: &Path) -> Self {
        Self {
            state: Some(state.to_owned()),
            ..Self::default()
        }
    }

    /// A place where names reach files in this folder only.
    pub fn within(folder: &Path) -> Self {
        Self {
            folder: folder.to_owned(),
            ..Self::default()
        }
    }

    /// The file that a person means by this name, or why they can't have it.
    pub(crate) fn reach(&self, name: &str) -> Result<PathBuf, String> {
        let path = self.folder.join(typed(name));
        let leads_out = path.components().any(|part| part == Component::ParentDir);
        let is_inside = path.starts_with(&self.folder) && !leads_out;
        let has_folder = !self.folder.as_os_str().is_empty();
        if !self.is_confined || has_folder && is_inside {
            Ok(path)
        } else {
            Err(format!(
                "{name}: it lies outside of the folder of this explorer"
            ))
        }
    }

    /// Names of files with one of these endings and of folders that start with what was typed, folders ending in `/`.
    pub(crate) fn names_starting_with(&self, typed: &str, endings: &[&str]) -> Vec<String> {
        let folder = typed.rfind('/').map_or("", |at| &typed[..=at]);
        let folder_of = if folder.is_empty() { "." } else { folder };
        match self.reach(folder_of) {
            Ok(path) => disk::starting_with(&path, folder, &typed[folder.len()..], endings),
            Err(_) => Vec::new(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_outside_of_the_folder_is_reached() {
        let nowhere = Workplace::default();
        let within = Workplace::within(Path::new("/tmp/mine"));
        let process = Workplace::of_process(None);
        for name in ["a.toml", "b/a.toml", "./a.toml", "/tmp/mine/a.toml"] {
            assert!(nowhere.reach(name).is_err(), "{name}");
            assert!(within.reach(name).unwrap().starts_with("/tmp/mine"));
            assert_eq!(process.reach(name), Ok(name.into()));
        }
        for name in [
            "/a.toml",
            "../a.toml",
            "b/../../a.toml",
            "/tmp/mine/../a",
            "/",
        ] {
            assert!(
                nowhere.reach(name).is_err() && within.reach(name).is_err(),
                "{name}"
            );
        }
    }
}
