//! The system below the program: the terminal as a device, what wakes a loop, signals, locks of the
//! host, private files. A file for each system; nothing else in the crate asks which one it is.
//!
//! Where systems have what others lack: Windows has no signal to stop, none for a terminal that is
//! gone, and no bytes of keys, but events. On macOS `poll` calls `/dev/tty` invalid, so that a
//! terminal has to be reached by its own name there; nobody has run it there yet.

pub mod file;
#[cfg_attr(unix, path = "unix.rs")]
#[cfg_attr(windows, path = "windows.rs")]
mod platform;

use std::fmt;
use std::sync::Arc;

use ratatui::crossterm::event::Event;

#[cfg(test)]
pub use platform::is_private;
pub use platform::{
    Device, HostLock, Inbox, LineInput, create_private_folder, has_job_control, interrupt_flag,
    is_terminal_gone, new_file_permissions, run_in_job, stop_job, stop_process,
};

/// The exit status of a program that lost its terminal: 128 and the number of SIGHUP.
pub const HUNG_UP: u8 = 129;

/// What a signal asks for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SignalRequest {
    /// To end; the exit status says by which signal.
    End(u8),
    /// To stop until told to go on.
    Stop,
    /// To go on.
    GoOn,
    /// To look how large the terminal is.
    Resize,
}

/// What came in while a loop waited.
#[derive(Debug, Default)]
pub struct Arrivals {
    /// What was typed, as the terminal sends it.
    pub bytes: Vec<u8>,
    /// What was typed, where the system reads the keys itself.
    pub events: Vec<Event>,
    /// What signals ask for.
    pub signals: Vec<SignalRequest>,
    /// Another thread used the [`Waker`].
    pub is_woken: bool,
    /// More can be written.
    pub is_writable: bool,
    /// The terminal is gone.
    pub is_gone: bool,
}

/// What a look at the lines of standard input found.
#[derive(Debug)]
pub enum LinePart {
    /// Bytes, of which the last line need not be whole; none if nothing came.
    Bytes(Vec<u8>),
    /// The input has ended.
    End,
    /// The process is to end with this status.
    Leave(u8),
}

/// Wakes the thread that waits for input, from any thread; does nothing if none is set.
#[derive(Clone, Default)]
pub struct Waker(Option<Arc<dyn Fn() + Send + Sync>>);

impl Waker {
    /// Wakes by calling this.
    pub fn new(wake: impl Fn() + Send + Sync + 'static) -> Self {
        Self(Some(Arc::new(wake)))
    }

    /// Wakes.
    pub fn wake(&self) {
        if let Some(wake) = &self.0 {
            wake();
        }
    }
}

impl fmt::Debug for Waker {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Waker")
    }
}

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
