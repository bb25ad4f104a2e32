//! The system below the program: what differs from one operating system to the next.
//!
//! Nothing else in the crate asks which system it is built for.

pub mod file;
#[cfg_attr(unix, path = "unix.rs")]
#[cfg_attr(windows, path = "windows.rs")]
mod platform;

pub use platform::HostLock;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_at_a_time_holds_a_lock_and_it_comes_back() {
        let name = format!("rayscope-test-{}", std::process::id());
        let take = || HostLock::take(&name).unwrap();
        assert!(!HostLock::is_taken(&name).unwrap());
        let first = take();
        assert!(first.is_some() && take().is_none());
        assert!(HostLock::is_taken(&name).unwrap());
        drop(first);
        assert!(!HostLock::is_taken(&name).unwrap());
        assert!(take().is_some());
    }
}
