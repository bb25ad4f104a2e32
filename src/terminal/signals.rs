//! Signals as something to wait for beside the terminal.

use std::io;
use std::os::fd::{AsFd, BorrowedFd};
use std::os::unix::net::UnixStream;

use signal_hook::consts::{SIGCONT, SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGTSTP, SIGWINCH};
use signal_hook::iterator::backend::SignalDelivery;
use signal_hook::iterator::exfiltrator::SignalOnly;
use signal_hook::low_level;

/// What a signal asks for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Asked {
    /// To end; the exit status says by which signal.
    End(u8),
    /// To stop until somebody says to go on.
    Stop,
    /// To go on.
    GoOn,
    /// To look how large the terminal is.
    Resize,
}

/// The signals that have come in.
#[derive(Debug)]
pub struct Signals {
    delivery: SignalDelivery<UnixStream, SignalOnly>,
}

impl Signals {
    /// Takes over the signals that would end or stop this process.
    pub fn take() -> io::Result<Self> {
        let (read, write) = UnixStream::pair()?;
        let asked = [SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGTSTP, SIGCONT, SIGWINCH];
        Ok(Self {
            delivery: SignalDelivery::with_pipe(read, write, SignalOnly, asked)?,
        })
    }

    /// What the signals since the last call ask for.
    pub fn pending(&mut self) -> impl Iterator<Item = Asked> {
        self.delivery.pending().map(|signal| match signal {
            SIGTSTP => Asked::Stop,
            SIGCONT => Asked::GoOn,
            SIGWINCH => Asked::Resize,
            signal => Asked::End(128 + signal as u8),
        })
    }
}

impl AsFd for Signals {
    /// Readable once a signal has come in.
    fn as_fd(&self) -> BorrowedFd<'_> {
        self.delivery.get_read().as_fd()
    }
}

/// Stops this process until somebody says to go on.
pub fn stop() -> io::Result<()> {
    low_level::raise(signal_hook::consts::SIGSTOP)
}
