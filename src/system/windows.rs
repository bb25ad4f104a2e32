//! Windows: crossterm reads the keys, sets the console's modes and knows its size.
//!
//! There is no signal that stops a process, and none for a console that is closed.

use std::fs::{File, OpenOptions, Permissions};
use std::io::{self, Read as _, Write as _};
use std::os::windows::fs::OpenOptionsExt as _;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use ratatui::crossterm::ansi_support::supports_ansi;
use ratatui::crossterm::event::{self, Event};
use ratatui::crossterm::terminal::{disable_raw_mode, enable_raw_mode, size};
use signal_hook::consts::SIGINT;

use super::{Arrivals, LinePart, SignalRequest, Waker};

/// The size of a console that does not tell its own.
const USUAL_SIZE: (u16, u16) = (80, 24);
/// How long another thread may have to wait until it is heard: the console can't be woken.
const TICK: Duration = Duration::from_millis(50);
/// What one read of lines takes.
const READ_BYTES: usize = 4096;

/// The console that this process reads keys from and draws on.
#[derive(Debug)]
pub struct Device;

impl Device {
    /// Answers to queries would come as keys, of which nobody could tell that they are none.
    pub const CAN_BE_ASKED: bool = false;

    /// Opens the console of this process.
    pub fn open() -> io::Result<Self> {
        if supports_ansi() {
            Ok(Self)
        } else {
            Err(io::Error::other("the console knows no escape sequences"))
        }
    }

    /// Keys come one by one and are not shown.
    pub fn make_raw(&self) -> io::Result<()> {
        enable_raw_mode()
    }

    /// The modes are those that the console came with.
    pub fn restore_modes(&self) -> io::Result<()> {
        disable_raw_mode()
    }

    /// Columns and rows.
    pub fn size(&self) -> (u16, u16) {
        match size() {
            Ok((cols, rows)) if cols > 0 && rows > 0 => (cols, rows),
            _ => USUAL_SIZE,
        }
    }

    /// Writes what the console takes, which is all; nothing if it is gone.
    pub fn write(&self, bytes: &[u8]) -> io::Result<Option<usize>> {
        let mut out = io::stdout().lock();
        match out.write_all(bytes).and_then(|()| out.flush()) {
            Ok(()) => Ok(Some(bytes.len())),
            Err(e) if is_terminal_gone(&e) => Ok(None),
            Err(e) => Err(e),
        }
    }

    /// Writes all.
    pub fn write_within(&self, bytes: &[u8], _patience: Duration) {
        let _ = self.write(bytes);
    }

    /// Throws away what was typed and not read.
    pub fn discard_input(&self) {
        while event::poll(Duration::ZERO).unwrap_or(false) && event::read().is_ok() {}
    }
}

/// What a loop that has the console waits for: keys and other threads.
#[derive(Debug)]
pub struct Inbox {
    is_rung: Arc<AtomicBool>,
    waker: Waker,
}

impl Inbox {
    /// An inbox with nothing in it.
    pub fn open() -> io::Result<Self> {
        let is_rung = Arc::new(AtomicBool::new(false));
        let ring = Arc::clone(&is_rung);
        let waker = Waker::new(move || ring.store(true, Ordering::Release));
        Ok(Self { is_rung, waker })
    }

    /// What ends [`Inbox::wait`] from any thread.
    pub fn waker(&self) -> Waker {
        self.waker.clone()
    }

    /// Waits for something to do, at most that long, without end if nothing is given; a console that
    /// there is `output` for takes it at once.
    pub fn wait(
        &mut self,
        _device: &Device,
        output: bool,
        patience: Option<Duration>,
    ) -> io::Result<Arrivals> {
        let deadline = patience.map(|patience| Instant::now() + patience);
        loop {
            let is_woken = self.is_rung.swap(false, Ordering::AcqRel);
            let left = deadline.map(|at| at.saturating_duration_since(Instant::now()));
            let is_over = output || is_woken || left.is_some_and(|left| left.is_zero());
            let tick = if is_over {
                Duration::ZERO
            } else {
                left.unwrap_or(TICK).min(TICK)
            };
            let has_event = event::poll(tick)?;
            if has_event || is_over {
                let mut arrivals = Arrivals {
                    is_woken,
                    is_writable: output,
                    ..Arrivals::default()
                };
                if has_event {
                    match event::read()? {
                        Event::Resize(..) => arrivals.signals.push(SignalRequest::Resize),
                        event => arrivals.events.push(event),
                    }
                }
                return Ok(arrivals);
            }
        }
    }
}

/// Standard input for lines of text.
#[derive(Debug)]
pub struct LineInput;

impl LineInput {
    /// The standard input of this process.
    pub fn open() -> io::Result<Self> {
        Ok(Self)
    }

    /// Waits for input.
    pub fn wait(&mut self) -> io::Result<LinePart> {
        let mut bytes = [0; READ_BYTES];
        Ok(match io::stdin().lock().read(&mut bytes)? {
            0 => LinePart::End,
            n => LinePart::Bytes(bytes[..n].to_vec()),
        })
    }
}

/// Whether an error says that the console is closed.
pub fn is_terminal_gone(error: &io::Error) -> bool {
    error.kind() == io::ErrorKind::BrokenPipe
}

/// Whether a shell takes over when this process stops.
pub const fn has_job_control() -> bool {
    false
}

/// Stops the whole job: it can't be.
pub const fn stop_job() -> bool {
    false
}

/// Stops this process until told to go on: nobody asks for it.
pub const fn stop_process() -> io::Result<()> {
    Ok(())
}

/// Runs another program of this job: nothing is, where there are no jobs.
pub fn run_in_job(_: &mut Command) -> io::Result<()> {
    Err(io::ErrorKind::Unsupported.into())
}

/// What is set once ctrl-c is pressed; pressed twice, it ends the program at once with that status.
pub fn interrupt_flag(status: u8) -> io::Result<Arc<AtomicBool>> {
    let flag = Arc::new(AtomicBool::new(false));
    let pressed = Arc::clone(&flag);
    signal_hook::flag::register_conditional_shutdown(SIGINT, status.into(), pressed)?;
    signal_hook::flag::register(SIGINT, Arc::clone(&flag))?;
    Ok(flag)
}

/// Makes a folder, and those above it; those of a person's profile are their own.
pub fn create_private_folder(path: &Path) -> io::Result<()> {
    std::fs::create_dir_all(path)
}

/// Whether nobody but its owner may read a file or folder: that is left to the profile.
#[cfg(test)]
pub const fn is_private(_path: &Path) -> bool {
    true
}

/// What a new file may be allowed: that of its folder.
pub const fn new_file_permissions() -> Option<Permissions> {
    None
}

/// A name that one process of this person at a time holds, until this is dropped: a file that
/// nobody else can open and that goes with its last handle.
#[derive(Debug)]
pub struct HostLock(#[expect(dead_code, reason = "held, not used")] File);

const FILE_FLAG_DELETE_ON_CLOSE: u32 = 0x0400_0000;
const ERROR_SHARING_VIOLATION: i32 = 32;

impl HostLock {
    /// Takes the lock of that name; none if another has it.
    pub fn take(name: &str) -> io::Result<Option<Self>> {
        let mut options = OpenOptions::new();
        options.write(true).create(true).truncate(true);
        options
            .share_mode(0)
            .custom_flags(FILE_FLAG_DELETE_ON_CLOSE);
        match options.open(lock_path(name)) {
            Ok(file) => Ok(Some(Self(file))),
            Err(e) if e.raw_os_error() == Some(ERROR_SHARING_VIOLATION) => Ok(None),
            Err(e) => Err(e),
        }
    }

    /// Whether somebody has the lock of that name.
    pub fn is_taken(name: &str) -> io::Result<bool> {
        match File::open(lock_path(name)) {
            Ok(_) => Ok(false),
            Err(e) if e.kind() == io::ErrorKind::NotFound => Ok(false),
            Err(e) if e.raw_os_error() == Some(ERROR_SHARING_VIOLATION) => Ok(true),
            Err(e) => Err(e),
        }
    }
}

fn lock_path(name: &str) -> PathBuf {
    std::env::temp_dir().join(format!("{name}.lock"))
}
