//! The terminal as a device: its modes, its size, and writing to it without waiting for it.

use std::io;
use std::os::fd::{AsFd, BorrowedFd, OwnedFd};
use std::time::{Duration, Instant};

use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::fs::{Mode, OFlags, open};
use rustix::io::{Errno, dup, read, write};
use rustix::process::{getpgrp, getsid};
use rustix::stdio::{stdin, stdout};
use rustix::termios::{
    OptionalActions, QueueSelector, Termios, tcflush, tcgetattr, tcgetwinsize, tcsetattr, ttyname,
};

/// The size of a terminal that does not tell its own, as serial lines do not.
const USUAL_SIZE: (u16, u16) = (80, 24);

/// The terminal that this process reads keys from and draws on.
#[derive(Debug)]
pub struct Device {
    /// Where keys are read from.
    input: BorrowedFd<'static>,
    /// Where the screen is written to. If possible a file of its own that never blocks: standard
    /// output is shared with the shell, whose writes should go on blocking.
    out: OwnedFd,
    /// The modes that the terminal had and gets back.
    modes: Termios,
}

/// What can be done now.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "facts that poll tells, in any combination"
)]
pub struct Ready {
    /// Something was typed.
    pub input: bool,
    /// A signal came in.
    pub signal: bool,
    /// Another thread woke us.
    pub woken: bool,
    /// More can be written.
    pub output: bool,
    /// The terminal is gone.
    pub gone: bool,
}

impl Device {
    /// Opens the terminal of this process.
    pub fn open() -> io::Result<Self> {
        let flags = OFlags::RDWR | OFlags::NOCTTY | OFlags::NONBLOCK | OFlags::CLOEXEC;
        let by_name = |name: &std::ffi::CStr| open(name, flags, Mode::empty());
        // The name may be missing in a container, and closed to who became another user; the
        // terminal of the session is open to all in it.
        let out = ttyname(stdout(), Vec::new())
            .and_then(|name| by_name(&name))
            .or_else(|_| by_name(c"/dev/tty"))
            .or_else(|_| dup(stdout()))?;
        let input = stdin();
        Ok(Self {
            input,
            out,
            modes: tcgetattr(input)?,
        })
    }

    /// Keys come one by one and are not shown; what is written is not changed on its way.
    pub fn make_raw(&self) -> io::Result<()> {
        let mut modes = self.modes.clone();
        modes.make_raw();
        Ok(tcsetattr(self.input, OptionalActions::Now, &modes)?)
    }

    /// The modes are those that the terminal came with.
    pub fn restore_modes(&self) -> io::Result<()> {
        Ok(tcsetattr(self.input, OptionalActions::Now, &self.modes)?)
    }

    /// Columns and rows.
    pub fn size(&self) -> (u16, u16) {
        match tcgetwinsize(&self.out) {
            Ok(size) if size.ws_col > 0 && size.ws_row > 0 => (size.ws_col, size.ws_row),
            _ => USUAL_SIZE,
        }
    }

    /// Writes what the terminal takes at once; how many bytes, or none if the terminal is gone.
    pub fn write(&self, bytes: &[u8]) -> io::Result<Option<usize>> {
        match write(&self.out, bytes) {
            Ok(n) => Ok(Some(n)),
            Err(Errno::AGAIN | Errno::INTR) => Ok(Some(0)),
            Err(Errno::IO | Errno::PIPE) => Ok(None),
            Err(e) => Err(e.into()),
        }
    }

    /// Writes all, or what the terminal takes in that time.
    pub fn write_within(&self, mut bytes: &[u8], patience: Duration) {
        let deadline = Instant::now() + patience;
        while !bytes.is_empty() {
            let Ok(Some(n)) = self.write(bytes) else {
                return;
            };
            bytes = &bytes[n..];
            if n == 0 {
                let left = deadline.saturating_duration_since(Instant::now());
                let out = PollFd::new(&self.out, PollFlags::OUT);
                if !matches!(poll(&mut [out], Some(&timespec(left))), Ok(1..)) {
                    return;
                }
            }
        }
    }

    /// Reads what was typed, of which there must be some; no bytes if the terminal is gone.
    pub fn read(&self, into: &mut [u8]) -> io::Result<usize> {
        match read(self.input, into) {
            Ok(n) => Ok(n),
            Err(Errno::IO) => Ok(0),
            Err(e) => Err(e.into()),
        }
    }

    /// Waits for something to do, at most that long.
    pub fn wait(
        &self,
        [signals, alarm]: [BorrowedFd<'_>; 2],
        output: bool,
        patience: Option<Duration>,
    ) -> io::Result<Ready> {
        let mut wanted = PollFlags::empty();
        wanted.set(PollFlags::OUT, output);
        let mut files = [
            PollFd::from_borrowed_fd(self.input, PollFlags::IN),
            PollFd::from_borrowed_fd(signals, PollFlags::IN),
            PollFd::from_borrowed_fd(alarm, PollFlags::IN),
            PollFd::from_borrowed_fd(self.out.as_fd(), wanted),
        ];
        match poll(&mut files, patience.map(timespec).as_ref()) {
            Ok(_) => {}
            Err(Errno::INTR) => return Ok(Ready::default()),
            Err(e) => return Err(e.into()),
        }
        let [input, signal, alarm, output] = files.map(|f| f.revents());
        let gone = PollFlags::HUP | PollFlags::ERR | PollFlags::NVAL;
        Ok(Ready {
            input: input.contains(PollFlags::IN),
            signal: signal.contains(PollFlags::IN),
            woken: alarm.contains(PollFlags::IN),
            output: output.contains(PollFlags::OUT),
            gone: input.intersects(gone) || output.intersects(gone),
        })
    }

    /// Throws away what was typed and not read.
    pub fn discard_input(&self) {
        let _ = tcflush(self.input, QueueSelector::IFlush);
    }

    /// Whether a shell with job control started this process, and takes over when it stops.
    pub fn can_stop() -> bool {
        // Such a shell puts each job in a process group of its own.
        getsid(None).is_ok_and(|session| session != getpgrp())
    }
}

fn timespec(duration: Duration) -> Timespec {
    Timespec {
        tv_sec: duration.as_secs().cast_signed(),
        tv_nsec: duration.subsec_nanos().into(),
    }
}
