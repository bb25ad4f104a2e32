//! Linux, macOS and their kin.

use std::io;
use std::os::fd::OwnedFd;
#[cfg(target_os = "linux")]
use std::os::linux::net::SocketAddrExt as _;
#[cfg(target_os = "linux")]
use std::os::unix::net::{SocketAddr, UnixDatagram};

use rustix::fs::{FlockOperation, Mode, OFlags, flock, open};
use rustix::io::Errno;

/// A name of the whole host that one process at a time holds, until this is dropped.
///
/// The system takes it back from a process that dies. On Linux nothing is written, so nothing can be
/// tricked into overwriting and nothing goes stale.
#[derive(Debug)]
pub struct HostLock(#[expect(dead_code, reason = "held, not used")] Held);

#[derive(Debug)]
#[expect(dead_code, reason = "held, not used")]
enum Held {
    /// A socket's name in the namespace that has no files (unix(7), “abstract”).
    #[cfg(target_os = "linux")]
    Socket(UnixDatagram),
    /// A locked file, for systems without such names and for processes that may have no sockets.
    File(OwnedFd),
}

impl HostLock {
    /// Takes the lock of that name; none if another has it.
    pub fn take(name: &str) -> io::Result<Option<Self>> {
        #[cfg(target_os = "linux")]
        match SocketAddr::from_abstract_name(name).and_then(|a| UnixDatagram::bind_addr(&a)) {
            Ok(socket) => return Ok(Some(Self(Held::Socket(socket)))),
            Err(e) if e.kind() == io::ErrorKind::AddrInUse => return Ok(None),
            Err(_) => {}
        }
        Ok(lock_file(&lock_path(name))?.map(|file| Self(Held::File(file))))
    }

    /// Whether somebody has the lock of that name.
    pub fn is_taken(name: &str) -> io::Result<bool> {
        #[cfg(target_os = "linux")]
        if let Ok(socket) = UnixDatagram::unbound() {
            let address = SocketAddr::from_abstract_name(name)?;
            // To connect sends nothing; it is refused if nobody has the name.
            return match socket.connect_addr(&address) {
                Ok(()) => Ok(true),
                Err(e) if e.kind() == io::ErrorKind::ConnectionRefused => Ok(false),
                Err(e) => Err(e),
            };
        }
        let file = match open(&*lock_path(name), LOCK_FLAGS, Mode::empty()) {
            Err(Errno::NOENT) => return Ok(false),
            found => found?,
        };
        match flock(&file, FlockOperation::NonBlockingLockShared) {
            Ok(()) => Ok(false),
            Err(Errno::WOULDBLOCK) => Ok(true),
            Err(e) => Err(e.into()),
        }
    }
}

const LOCK_FLAGS: OFlags = OFlags::RDONLY
    .union(OFlags::NOFOLLOW)
    .union(OFlags::CLOEXEC)
    .union(OFlags::NONBLOCK);

/// The file of a lock lies where every user of the host looks, not in a folder of their own.
fn lock_path(name: &str) -> String {
    format!("/tmp/{name}.lock")
}

/// Locks a file, making it if it is not there. A link is not followed, and a file of somebody
/// else's serves as well: it is only read.
fn lock_file(path: &str) -> io::Result<Option<OwnedFd>> {
    let all_may_read = Mode::from(0o644);
    let file = match open(path, LOCK_FLAGS, Mode::empty()) {
        Err(Errno::NOENT) => {
            let made = open(
                path,
                LOCK_FLAGS | OFlags::CREATE | OFlags::EXCL,
                all_may_read,
            );
            match made {
                // Another process was quicker.
                Err(Errno::EXIST) => open(path, LOCK_FLAGS, Mode::empty()),
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
    use std::os::unix::fs::symlink;

    use super::*;

    #[test]
    fn a_file_serves_where_names_do_not() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("lock");
        let path = path.to_str().unwrap();
        let first = lock_file(path).unwrap();
        assert!(first.is_some() && lock_file(path).unwrap().is_none());
        drop(first);
        assert!(lock_file(path).unwrap().is_some());
    }

    #[test]
    fn a_link_in_the_place_of_the_file_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let [link, target] = ["lock", "precious"].map(|name| folder.path().join(name));
        symlink(&target, &link).unwrap();
        assert!(lock_file(link.to_str().unwrap()).is_err());
        assert!(!target.exists());
    }
}
