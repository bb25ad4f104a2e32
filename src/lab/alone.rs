//! The right to measure, which one thread of the whole host has at a time: two measurements at
//! once would time each other.
//!
//! Whoever holds it and dies gives it back, since the system closes what it holds. Nothing is
//! written, so nothing can be tricked into overwriting, and nothing is left to go stale.

use std::ffi::CStr;
use std::io;
use std::os::fd::OwnedFd;
#[cfg(target_os = "linux")]
use std::os::unix::net::UnixListener;

use rustix::fs::{FlockOperation, Mode, OFlags, flock, open};
use rustix::io::Errno;

/// The right to measure, until it is dropped.
#[derive(Debug)]
pub struct Alone(#[expect(dead_code, reason = "held, not used")] Held);

#[derive(Debug)]
#[expect(dead_code, reason = "held, not used")]
enum Held {
    /// A socket's name: the system gives it to one socket at a time.
    #[cfg(target_os = "linux")]
    Name(UnixListener),
    /// A locked file.
    File(OwnedFd),
}

/// What is fought for: a name of the host's own, and a file for systems without such names. It
/// lies where every user of the host looks, and not in a folder of their own.
const NAME: &str = "rayscope-measures";
const FILE: &CStr = c"/tmp/rayscope-measures.lock";

impl Alone {
    /// The right to measure; none if somebody else on this host has it.
    pub fn take() -> io::Result<Option<Self>> {
        Self::take_as(NAME, FILE)
    }

    fn take_as(name: &str, file: &CStr) -> io::Result<Option<Self>> {
        #[cfg(target_os = "linux")]
        if let Ok(held) = take_name(name) {
            return Ok(held.map(|name| Self(Held::Name(name))));
        }
        // Who is forbidden to have sockets may still lock files.
        let _ = name;
        Ok(lock_file(file)?.map(|file| Self(Held::File(file))))
    }
}

/// Binds a socket in the namespace that has no files (unix(7), “abstract”).
#[cfg(target_os = "linux")]
fn take_name(name: &str) -> io::Result<Option<UnixListener>> {
    use std::os::linux::net::SocketAddrExt as _;
    use std::os::unix::net::SocketAddr;

    match UnixListener::bind_addr(&SocketAddr::from_abstract_name(name)?) {
        Ok(listener) => Ok(Some(listener)),
        Err(e) if e.kind() == io::ErrorKind::AddrInUse => Ok(None),
        Err(e) => Err(e),
    }
}

/// Locks a file, making it if it is not there. A link is not followed, and a file of somebody
/// else's serves as well: it is only read.
fn lock_file(path: &CStr) -> io::Result<Option<OwnedFd>> {
    let flags = OFlags::RDONLY | OFlags::NOFOLLOW | OFlags::CLOEXEC | OFlags::NONBLOCK;
    let all_may_read = Mode::from(0o644);
    let file = match open(path, flags, Mode::empty()) {
        Err(Errno::NOENT) => {
            match open(path, flags | OFlags::CREATE | OFlags::EXCL, all_may_read) {
                // Somebody was quicker.
                Err(Errno::EXIST) => open(path, flags, Mode::empty()),
                made => made,
            }
        }
        found => found,
    }?;
    match flock(&file, FlockOperation::NonBlockingLockExclusive) {
        Ok(()) => Ok(Some(file)),
        Err(Errno::WOULDBLOCK) => Ok(None),
        Err(e) => Err(e.into()),
    }
}

#[cfg(test)]
mod tests {
    use std::ffi::CString;
    use std::os::unix::fs::symlink;

    use super::*;

    #[test]
    fn one_at_a_time_has_it_and_it_comes_back() {
        let name = format!("rayscope-test-{}", std::process::id());
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("lock");
        let file = CString::new(file.to_str().unwrap()).unwrap();
        let take = || Alone::take_as(&name, &file).unwrap();
        let first = take();
        assert!(first.is_some() && take().is_none());
        drop(first);
        assert!(take().is_some());
    }

    #[test]
    fn a_file_serves_where_names_do_not() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("lock");
        let path = CString::new(path.to_str().unwrap()).unwrap();
        let first = lock_file(&path).unwrap();
        assert!(first.is_some() && lock_file(&path).unwrap().is_none());
        drop(first);
        assert!(lock_file(&path).unwrap().is_some());
    }

    #[test]
    fn a_link_in_the_place_of_the_file_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let [link, target] = ["lock", "precious"].map(|name| folder.path().join(name));
        symlink(&target, &link).unwrap();
        let link = CString::new(link.to_str().unwrap()).unwrap();
        assert!(lock_file(&link).is_err());
        assert!(!target.exists());
    }
}
