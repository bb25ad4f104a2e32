//! Scene files on disk: read, written whole or not at all, and never over somebody else's change.

use std::ffi::OsStr;
use std::fs::{self, File, Metadata, OpenOptions};
use std::hash::{DefaultHasher, Hash, Hasher};
use std::io::{self, Read, Seek, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

use tempfile::NamedTempFile;

use crate::door::{self, Expected};
use crate::scene::LARGEST_FILE;
use crate::system::{file as filesystem, new_file_permissions};

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
}

pub(crate) fn digest(bytes: &[u8]) -> u64 {
    let mut hasher = DefaultHasher::new();
    bytes.hash(&mut hasher);
    hasher.finish()
}

/// What names of files start with that are being written.
pub(crate) const TEMPORARY: &str = ".rayscope-";
/// Nobody writes for so long.
const OLD: Duration = Duration::from_secs(600);

/// Removes what processes left that were killed while they wrote.
pub(crate) fn remove_orphans(folder: &Path) {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    for entry in entries {
        let is_ours = entry.file_name().to_string_lossy().starts_with(TEMPORARY);
        let written = entry.metadata().and_then(|m| m.modified()).ok();
        let age = written.and_then(|at| at.elapsed().ok());
        if is_ours && age.is_some_and(|age| age > OLD) {
            // It may be another person's, and stays then.
            let _ = fs::remove_file(entry.path());
        }
    }
}

/// What a file that is saved may take the place of.
#[derive(Debug, Clone, Copy)]
pub enum Over<'a> {
    /// Nothing: it is a new file.
    Nothing,
    /// The file as it was last read or written, or nothing if it is gone.
    Known(&'a Stamp),
    /// Whatever is there.
    Anything,
}

impl Over<'_> {
    fn allows(self, there: &[u8]) -> bool {
        match self {
            Self::Nothing => false,
            Self::Known(stamp) => digest(there) == stamp.contents,
            Self::Anything => true,
        }
    }
}

/// Why a file was not saved.
#[derive(Debug)]
pub enum Unsaved {
    /// Something else is in its place than what it may take the place of.
    Occupied,
    /// The reason, with the name of the file.
    Failed(String),
}

impl From<io::Error> for Unsaved {
    fn from(error: io::Error) -> Self {
        Self::Failed(match error.kind() {
            io::ErrorKind::NotFound => "its folder does not exist".to_owned(),
            _ => door::plain(&error),
        })
    }
}

/// Writes `text` to a file, whole or not at all. A link is followed; a file that is there keeps its
/// permissions, its owner and its other names, and is replaced only if it is what may be replaced.
pub fn save(path: &Path, text: &str, over: Over<'_>) -> Result<Stamp, Unsaved> {
    match write(path, text.as_bytes(), over) {
        Ok(()) => Ok(Stamp {
            path: path.to_owned(),
            contents: digest(text.as_bytes()),
        }),
        Err(Unsaved::Occupied) => Err(Unsaved::Occupied),
        Err(Unsaved::Failed(reason)) => Err(Unsaved::Failed(format!(
            "{}: not saved: {reason}",
            path.display()
        ))),
    }
}

fn write(path: &Path, bytes: &[u8], over: Over<'_>) -> Result<(), Unsaved> {
    let target = followed(path)?;
    remove_orphans(folder_of(&target));
    loop {
        let there = match fs::metadata(&target) {
            Ok(there) => there,
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                match create(&target, bytes) {
                    // What appeared meanwhile is looked at first.
                    Err(error) if error.kind() == io::ErrorKind::AlreadyExists => continue,
                    created => return Ok(created?),
                }
            }
            Err(error) => return Err(error.into()),
        };
        if !there.is_file() {
            return Err(Unsaved::Failed(
                "it is not a file that can be replaced".into(),
            ));
        }
        if matches!(over, Over::Nothing) {
            return Err(Unsaved::Occupied);
        }
        check_writable(&target, &there)?;
        return match successor(&target, &there, bytes)? {
            Some(file) => replace(file, &target, over),
            None => overwrite(&target, bytes, over),
        };
    }
}

/// Where a link leads in the end, whether or not there is a file.
fn followed(path: &Path) -> io::Result<PathBuf> {
    const MOST_LINKS: usize = 40;
    let mut path = path.to_owned();
    for _ in 0..MOST_LINKS {
        match fs::read_link(&path) {
            Ok(next) => path = folder_of(&path).join(next),
            Err(_) => return Ok(path),
        }
    }
    Err(io::Error::other("its links form a circle"))
}

fn folder_of(path: &Path) -> &Path {
    let folder = path.parent().filter(|p| !p.as_os_str().is_empty());
    folder.unwrap_or(Path::new("."))
}

/// Refuses a file that may not be written, although another could be put in its place.
fn check_writable(target: &Path, there: &Metadata) -> Result<(), Unsaved> {
    if there.permissions().readonly() {
        return Err(Unsaved::Failed("it is write-protected".into()));
    }
    match door::regular(OpenOptions::new().write(true), target) {
        Ok(_) => Ok(()),
        Err(refusal) => Err(Unsaved::Failed(refusal.to_string())),
    }
}

/// Makes a new file, never over another.
fn create(target: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut builder = builder();
    // It gets what the umask leaves of the usual permissions.
    if let Some(usual) = new_file_permissions() {
        builder.permissions(usual);
    }
    let file = filled(builder.tempfile_in(folder_of(target))?, bytes)?;
    file.as_file().sync_all()?;
    file.persist_noclobber(target)?;
    Ok(())
}

fn builder() -> tempfile::Builder<'static, 'static> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(TEMPORARY);
    builder
}

fn filled(mut file: NamedTempFile, bytes: &[u8]) -> io::Result<NamedTempFile> {
    // The name of the file that takes its place says nothing to the person.
    let written = file.as_file_mut().write_all(bytes);
    written.map(|()| file)
}

/// A file that can take the place of the one that is there, private until then; none if something
/// of that one would be lost: other names, an owner that can't be given, attributes.
fn successor(
    target: &Path,
    there: &Metadata,
    bytes: &[u8],
) -> Result<Option<NamedTempFile>, Unsaved> {
    if filesystem::has_other_names(there) || filesystem::has_attributes(target) {
        return Ok(None);
    }
    let file = match builder().tempfile_in(folder_of(target)) {
        // A file may be written in a folder that may not.
        Err(error) if error.kind() == io::ErrorKind::PermissionDenied => return Ok(None),
        file => filled(file?, bytes)?,
    };
    if filesystem::give_owner(file.as_file(), there).is_err() {
        return Ok(None);
    }
    file.as_file().set_permissions(there.permissions())?;
    file.as_file().sync_all()?;
    Ok(Some(file))
}

/// Puts a file in the place of the one that is there; if that is another than it may take the place
/// of, all stays as it is.
fn replace(file: NamedTempFile, target: &Path, over: Over<'_>) -> Result<(), Unsaved> {
    let is_allowed = |path| ANY.bytes(path).is_ok_and(|there| over.allows(&there));
    match filesystem::exchange(file.path(), target) {
        // Both are there under each other's names: whatever was there can be looked at in peace.
        Ok(()) if is_allowed(file.path()) => Ok(()),
        Ok(()) => {
            filesystem::exchange(file.path(), target)?;
            Err(Unsaved::Occupied)
        }
        Err(_) if is_allowed(target) => match file.persist(target) {
            Ok(_) => Ok(()),
            Err(error) => Err(error.error.into()),
        },
        Err(_) => Err(Unsaved::Occupied),
    }
}

/// Writes over the contents of a file; if that fails, they are as they were.
fn overwrite(target: &Path, bytes: &[u8], over: Over<'_>) -> Result<(), Unsaved> {
    let mut file = door::regular(OpenOptions::new().read(true).write(true), target)
        .map_err(|refusal| Unsaved::Failed(refusal.to_string()))?;
    let mut before = Vec::new();
    Read::by_ref(&mut file)
        .take(LARGEST_FILE)
        .read_to_end(&mut before)?;
    if !over.allows(&before) {
        return Err(Unsaved::Occupied);
    }
    if let Err(error) = put(&mut file, bytes, before.len()) {
        // What was there needs no more room than it had.
        let _ = put(&mut file, &before, before.len());
        return Err(error.into());
    }
    Ok(())
}

/// Makes `bytes` the contents of a file that has `room` bytes. What needs more room comes first.
fn put(file: &mut File, bytes: &[u8], room: usize) -> io::Result<()> {
    let (begin, rest) = bytes.split_at(room.min(bytes.len()));
    file.seek(io::SeekFrom::Start(begin.len() as u64))?;
    file.write_all(rest)?;
    file.rewind()?;
    file.write_all(begin)?;
    file.set_len(bytes.len() as u64)?;
    file.sync_all()
}

/// Files with one of these endings and folders in `folder` whose names start like that, folders ending in `/`; each
/// after `head`.
pub fn starting_with(folder: &Path, head: &str, start: &str, endings: &[&str]) -> Vec<String> {
    let Ok(entries) = fs::read_dir(folder) else {
        return Vec::new();
    };
    let mut names: Vec<_> = entries
        .flatten()
        .filter_map(|entry| {
            let name = entry.file_name().into_string().ok()?;
            let hidden = name.starts_with('.') && !start.starts_with('.');
            let end = if entry.path().is_dir() { "/" } else { "" };
            let is_wanted = |e: &OsStr| endings.iter().any(|ending| e == *ending);
            let fits = end == "/" || entry.path().extension().is_some_and(is_wanted);
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
    fn what_a_killed_process_left_goes_with_the_next_save() {
        let folder = tempfile::tempdir().unwrap();
        let [old, new, mine] =
            [".rayscope-old", ".rayscope-new", ".mine"].map(|name| folder.path().join(name));
        for path in [&old, &new, &mine] {
            fs::write(path, "half a sce").unwrap();
        }
        let long_ago = std::time::SystemTime::now() - 2 * OLD;
        for path in [&old, &mine] {
            let file = File::options().write(true).open(path).unwrap();
            file.set_modified(long_ago).unwrap();
        }
        save(&folder.path().join("a.toml"), "one", Over::Nothing).unwrap();
        assert_eq!([&old, &new, &mine].map(|p| p.exists()), [false, true, true]);
    }

    /// What is in a folder.
    fn names(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).unwrap().flatten();
        let mut names: Vec<_> = entries
            .map(|entry| entry.file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }

    fn is_occupied(saved: &Result<Stamp, Unsaved>) -> bool {
        matches!(saved, Err(Unsaved::Occupied))
    }

    #[test]
    fn nothing_is_replaced_but_what_was_read_or_written() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.toml");
        let one = save(&path, "one", Over::Nothing).unwrap();
        let two = save(&path, "two", Over::Known(&one)).unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"two");
        assert!(is_occupied(&save(&path, "three", Over::Known(&one))));
        assert!(is_occupied(&save(&path, "three", Over::Nothing)));
        assert_eq!(fs::read(&path).unwrap(), b"two");
        fs::remove_file(&path).unwrap();
        save(&path, "four", Over::Known(&two)).unwrap();
        fs::write(&path, "five").unwrap();
        save(&path, "six", Over::Anything).unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"six");
        assert_eq!(names(folder.path()), ["a.toml"], "no temporary file stays");
    }

    #[test]
    fn what_changes_between_the_look_and_the_rename_is_put_back() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.toml");
        let known = save(&path, "one", Over::Nothing).unwrap();
        let there = fs::metadata(&path).unwrap();
        let file = successor(&path, &there, b"two").ok().flatten().unwrap();
        fs::write(&path, "somebody else's").unwrap();
        let replaced = replace(file, &path, Over::Known(&known));
        assert!(matches!(replaced, Err(Unsaved::Occupied)));
        assert_eq!(fs::read(&path).unwrap(), b"somebody else's");
        // What appears is not replaced, either.
        let error = create(&path, b"two").unwrap_err();
        assert_eq!(error.kind(), io::ErrorKind::AlreadyExists);
        assert_eq!(names(folder.path()), ["a.toml"]);
    }

    #[test]
    fn a_save_that_fails_leaves_the_old_file() {
        let folder = tempfile::tempdir().unwrap();
        let reason = |path: &Path| match save(path, "one", Over::Anything) {
            Err(Unsaved::Failed(reason)) => reason,
            saved => panic!("{saved:?}"),
        };
        let none = folder.path().join("none").join("a.toml");
        assert!(reason(&none).ends_with("not saved: its folder does not exist"));
        let blocked = folder.path().join("dir");
        fs::create_dir(&blocked).unwrap();
        assert!(reason(&blocked).ends_with("it is not a file that can be replaced"));
        assert_eq!(names(folder.path()), ["dir"]);
    }

    #[cfg(unix)]
    mod unix {
        use std::fs::Permissions;
        use std::os::unix::fs::{MetadataExt, PermissionsExt, symlink};

        use super::*;

        fn set_mode(path: &Path, mode: u32) {
            fs::set_permissions(path, Permissions::from_mode(mode)).unwrap();
        }

        #[test]
        fn a_file_that_may_not_be_written_is_not_replaced() {
            let folder = tempfile::tempdir().unwrap();
            let path = folder.path().join("a.toml");
            let known = save(&path, "one", Over::Nothing).unwrap();
            set_mode(&path, 0o444);
            for over in [Over::Known(&known), Over::Anything] {
                let Err(Unsaved::Failed(reason)) = save(&path, "two", over) else {
                    panic!("it is replaced");
                };
                assert!(
                    reason.ends_with("not saved: it is write-protected"),
                    "{reason}"
                );
            }
            assert_eq!(fs::read(&path).unwrap(), b"one");
        }

        #[test]
        fn a_private_file_stays_private_and_its_successor_is_never_anything_else() {
            let folder = tempfile::tempdir().unwrap();
            let path = folder.path().join("a.toml");
            save(&path, "one", Over::Nothing).unwrap();
            set_mode(&path, 0o600);
            let there = fs::metadata(&path).unwrap();
            let file = builder().tempfile_in(folder.path()).unwrap();
            let mode = |m: &Metadata| m.permissions().mode() & 0o777;
            assert_eq!(mode(&file.as_file().metadata().unwrap()), 0o600);
            drop(file);
            let file = successor(&path, &there, b"two").ok().flatten().unwrap();
            assert_eq!(mode(&file.as_file().metadata().unwrap()), 0o600);
            replace(file, &path, Over::Anything).unwrap();
            assert_eq!(mode(&fs::metadata(&path).unwrap()), 0o600);
            assert_eq!(fs::read(&path).unwrap(), b"two");
        }

        #[test]
        fn a_file_with_several_names_keeps_them() {
            let folder = tempfile::tempdir().unwrap();
            let path = folder.path().join("a.toml");
            let other = folder.path().join("b.toml");
            let mut known = save(&path, "one", Over::Nothing).unwrap();
            fs::hard_link(&path, &other).unwrap();
            for text in ["much longer than it was", "short", ""] {
                known = save(&path, text, Over::Known(&known)).unwrap();
                assert_eq!(fs::read_to_string(&other).unwrap(), text);
            }
            fs::write(&other, "somebody else's").unwrap();
            assert!(is_occupied(&save(&path, "two", Over::Known(&known))));
            assert_eq!(fs::metadata(&path).unwrap().nlink(), 2);
        }

        #[test]
        fn a_link_stays_a_link_even_if_it_leads_to_nothing_yet() {
            let folder = tempfile::tempdir().unwrap();
            let [link, file] = ["link.toml", "file.toml"].map(|name| folder.path().join(name));
            symlink("file.toml", &link).unwrap();
            let known = save(&link, "one", Over::Nothing).unwrap();
            assert_eq!(fs::read(&file).unwrap(), b"one");
            save(&link, "two", Over::Known(&known)).unwrap();
            assert_eq!(fs::read(&file).unwrap(), b"two");
            assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
            let round = folder.path().join("round.toml");
            symlink("round.toml", &round).unwrap();
            assert!(save(&round, "one", Over::Anything).is_err());
        }

        #[test]
        fn the_owner_stays_or_the_file_is_written_where_it_is() {
            let folder = tempfile::tempdir().unwrap();
            let path = folder.path().join("a.toml");
            let known = save(&path, "one", Over::Nothing).unwrap();
            // Only root can give a file away.
            let given = std::os::unix::fs::chown(&path, Some(4711), Some(4712)).is_ok();
            let before = fs::metadata(&path).unwrap();
            save(&path, "two", Over::Known(&known)).unwrap();
            let after = fs::metadata(&path).unwrap();
            assert_eq!((after.uid(), after.gid()), (before.uid(), before.gid()));
            assert!(!given || after.uid() == 4711);
        }
    }
}
