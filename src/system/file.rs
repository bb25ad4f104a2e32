//! Files: opened without waiting for a process at the other end; what a file has beside its
//! contents.

use std::fs::{File, Metadata, OpenOptions};
use std::io;
use std::path::{Path, PathBuf};

/// Opens a file as `options` have it. A pipe without another end is not waited for, and a terminal
/// does not become the program's own.
pub fn open_without_waiting(options: &mut OpenOptions, path: &Path) -> io::Result<File> {
    #[cfg(unix)]
    {
        use rustix::fs::OFlags;
        use std::os::unix::fs::OpenOptionsExt;
        let flags = OFlags::NONBLOCK | OFlags::NOCTTY;
        options.custom_flags(flags.bits().cast_signed());
    }
    options.open(path)
}

/// What kind of thing a file is that is neither a regular file nor a folder.
pub fn kind_of_special(kind: std::fs::FileType) -> &'static str {
    #[cfg(unix)]
    {
        use std::os::unix::fs::FileTypeExt;
        if kind.is_fifo() {
            return "a pipe";
        }
        if kind.is_socket() {
            return "a socket";
        }
        if kind.is_char_device() || kind.is_block_device() {
            return "a device";
        }
    }
    let _ = kind;
    "no regular file"
}

/// Whether a file has other names, which would go on to be the old file if it were replaced.
pub fn has_other_names(there: &Metadata) -> bool {
    #[cfg(unix)]
    return std::os::unix::fs::MetadataExt::nlink(there) > 1;
    #[cfg(not(unix))]
    {
        let _ = there;
        false
    }
}

/// Whether a file has attributes beyond its permissions, such as a list of who may do what. Those
/// that the system gives to each file of its own accord do not count.
pub fn has_attributes(path: &Path) -> bool {
    #[cfg(target_os = "linux")]
    {
        let mut names = Vec::with_capacity(1 << 12);
        if rustix::fs::listxattr(path, rustix::buffer::spare_capacity(&mut names)).is_err() {
            return false;
        }
        let mut names = names.split(|&b| b == 0).filter(|name| !name.is_empty());
        names.any(|name| !name.starts_with(b"security."))
    }
    #[cfg(not(target_os = "linux"))]
    {
        let _ = path;
        false
    }
}

/// Gives a file the owner and the group of another.
pub fn give_owner(file: &File, of: &Metadata) -> io::Result<()> {
    #[cfg(unix)]
    {
        use std::os::unix::fs::{MetadataExt, fchown};
        let own = file.metadata()?;
        let other = |mine: u32, wanted: u32| (mine != wanted).then_some(wanted);
        let (owner, group) = (other(own.uid(), of.uid()), other(own.gid(), of.gid()));
        if owner.is_some() || group.is_some() {
            fchown(file, owner, group)?;
        }
    }
    let _ = (file, of);
    Ok(())
}

/// Gives each of two files the name of the other, at once; fails where the system can't.
pub fn exchange(one: &Path, other: &Path) -> io::Result<()> {
    #[cfg(any(target_os = "linux", target_vendor = "apple"))]
    {
        use rustix::fs::{CWD, RenameFlags, renameat_with};
        Ok(renameat_with(CWD, one, CWD, other, RenameFlags::EXCHANGE)?)
    }
    #[cfg(not(any(target_os = "linux", target_vendor = "apple")))]
    {
        let _ = (one, other);
        Err(io::ErrorKind::Unsupported.into())
    }
}

/// Locks a file for as long as it is open; false if another program has locked it.
pub fn lock(file: &File) -> io::Result<bool> {
    #[cfg(unix)]
    {
        use rustix::fs::{FlockOperation, flock};
        match flock(file, FlockOperation::NonBlockingLockExclusive) {
            Ok(()) => Ok(true),
            Err(rustix::io::Errno::WOULDBLOCK) => Ok(false),
            Err(error) => Err(error.into()),
        }
    }
    #[cfg(not(unix))]
    {
        let _ = file;
        Ok(true)
    }
}

/// Whether it is this file that has that name.
pub fn is_at(file: &File, path: &Path) -> bool {
    #[cfg(unix)]
    {
        use std::os::unix::fs::MetadataExt;
        let id = |there: Metadata| (there.dev(), there.ino());
        let (own, there) = (file.metadata(), path.metadata());
        own.is_ok_and(|own| there.is_ok_and(|there| id(own) == id(there)))
    }
    #[cfg(not(unix))]
    {
        let _ = file;
        path.exists()
    }
}

/// The home folder that the system has noted for who runs this process, whatever the environment
/// says.
pub fn noted_home() -> Option<PathBuf> {
    #[cfg(unix)]
    {
        let user = rustix::process::getuid().as_raw().to_string();
        let list = std::fs::read_to_string("/etc/passwd").ok()?;
        let line = list
            .lines()
            .map(|line| line.split(':').collect::<Vec<_>>())
            .find(|fields| fields.get(2) == Some(&user.as_str()))?;
        line.get(5).map(PathBuf::from)
    }
    #[cfg(not(unix))]
    None
}
