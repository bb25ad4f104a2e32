//! Linux, macOS and their kin.

use std::fs::{DirBuilder, Permissions};
use std::io::{self, IsTerminal as _, PipeReader, Read as _, Write as _, pipe};
use std::os::fd::{AsFd as _, BorrowedFd, OwnedFd};
#[cfg(target_os = "linux")]
use std::os::linux::net::SocketAddrExt as _;
use std::os::unix::fs::{DirBuilderExt as _, PermissionsExt as _};
use std::os::unix::net::UnixStream;
#[cfg(target_os = "linux")]
use std::os::unix::net::{SocketAddr, UnixDatagram};
use std::path::Path;
use std::process::Command;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::fs::{FlockOperation, Mode, OFlags, flock, open};
use rustix::io::{Errno, dup, read, retry_on_intr, write};
use rustix::process::{
    Pid, Signal, WaitOptions, getpgrp, getsid, kill_current_process_group, waitpid,
};
use rustix::stdio::{stdin, stdout};
use rustix::termios::{
    OptionalActions, QueueSelector, Termios, tcflush, tcgetattr, tcgetwinsize, tcsetattr, ttyname,
};
use signal_hook::consts::{
    SIGALRM, SIGCONT, SIGHUP, SIGINT, SIGPROF, SIGQUIT, SIGSTOP, SIGTERM, SIGTSTP, SIGUSR1,
    SIGUSR2, SIGVTALRM, SIGWINCH, SIGXCPU, SIGXFSZ,
};
use signal_hook::iterator::backend::SignalDelivery;
use signal_hook::iterator::exfiltrator::SignalOnly;
use signal_hook::low_level;

use super::{Arrivals, HUNG_UP, LinePart, SignalRequest, Waker};

/// The size of a terminal that does not tell its own, as serial lines do not.
const USUAL_SIZE: (u16, u16) = (80, 24);
/// What one read takes: some thousand keys.
const READ_BYTES: usize = 4096;
/// What poll says of a terminal that is closed.
const GONE: PollFlags = PollFlags::HUP.union(PollFlags::ERR);

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

impl Device {
    /// Answers to queries come between the keys, in bytes of their own.
    pub const CAN_BE_ASKED: bool = true;

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

    /// Throws away what was typed and not read.
    pub fn discard_input(&self) {
        let _ = tcflush(self.input, QueueSelector::IFlush);
    }
}

/// What a loop that has the terminal waits for: keys, signals, other threads.
#[derive(Debug)]
pub struct Inbox {
    signals: SignalInbox,
    alarm: Alarm,
}

impl Inbox {
    /// Takes over the signals that would end or stop this process.
    pub fn open() -> io::Result<Self> {
        Ok(Self {
            signals: SignalInbox::open()?,
            alarm: Alarm::new()?,
        })
    }

    /// What ends [`Inbox::wait`] from any thread.
    pub fn waker(&self) -> Waker {
        self.alarm.waker.clone()
    }

    /// Waits for something to do, at most that long, without end if nothing is given; for room to
    /// write, too, if there is `output`.
    pub fn wait(
        &mut self,
        device: &Device,
        output: bool,
        patience: Option<Duration>,
    ) -> io::Result<Arrivals> {
        let mut wanted = PollFlags::empty();
        wanted.set(PollFlags::OUT, output);
        let mut files = [
            PollFd::from_borrowed_fd(device.input, PollFlags::IN),
            PollFd::from_borrowed_fd(self.signals.as_fd(), PollFlags::IN),
            PollFd::new(&self.alarm.reader, PollFlags::IN),
            PollFd::new(&device.out, wanted),
        ];
        match poll(&mut files, patience.map(timespec).as_ref()) {
            Ok(_) => {}
            Err(Errno::INTR) => return Ok(Arrivals::default()),
            Err(e) => return Err(e.into()),
        }
        let [input, signal, alarm, output] = files.map(|f| f.revents());
        let gone = GONE | PollFlags::NVAL;
        let mut arrivals = Arrivals {
            is_writable: output.contains(PollFlags::OUT),
            is_gone: input.intersects(gone) || output.intersects(gone),
            ..Arrivals::default()
        };
        if arrivals.is_gone {
            return Ok(arrivals);
        }
        if signal.contains(PollFlags::IN) {
            arrivals.signals = self.signals.pending();
        }
        if alarm.contains(PollFlags::IN) {
            self.alarm.quiet()?;
            arrivals.is_woken = true;
        }
        if input.contains(PollFlags::IN) {
            let mut bytes = [0; READ_BYTES];
            let n = match read(device.input, &mut bytes) {
                Err(Errno::IO) => 0,
                n => n?,
            };
            arrivals.bytes = bytes[..n].to_vec();
            arrivals.is_gone = n == 0;
        }
        Ok(arrivals)
    }
}

/// Standard input for lines of text, and the signals beside it.
#[derive(Debug)]
pub struct LineInput {
    signals: SignalInbox,
    /// It is a terminal, whose end is no end of a script.
    is_terminal: bool,
}

impl LineInput {
    /// Takes over the signals that would end or stop this process.
    pub fn open() -> io::Result<Self> {
        Ok(Self {
            signals: SignalInbox::open()?,
            is_terminal: io::stdin().is_terminal(),
        })
    }

    /// Waits for input or a signal.
    pub fn wait(&mut self) -> io::Result<LinePart> {
        let mut files = [
            PollFd::from_borrowed_fd(stdin(), PollFlags::IN),
            PollFd::from_borrowed_fd(self.signals.as_fd(), PollFlags::IN),
        ];
        match poll(&mut files, None) {
            Ok(_) | Err(Errno::INTR) => {}
            Err(e) => return Err(e.into()),
        }
        let [input, signal] = files.map(|f| f.revents());
        if !signal.is_empty() {
            for request in self.signals.pending() {
                match request {
                    SignalRequest::End(status) => return Ok(LinePart::Leave(status)),
                    SignalRequest::Stop => stop_process()?,
                    SignalRequest::GoOn | SignalRequest::Resize => {}
                }
            }
        }
        if input.is_empty() {
            return Ok(LinePart::Bytes(Vec::new()));
        }
        if self.is_terminal && input.intersects(GONE) {
            return Ok(LinePart::Leave(HUNG_UP));
        }
        let mut bytes = [0; READ_BYTES];
        Ok(match read(stdin(), &mut bytes) {
            // A terminal that went away after the question reads as one where ctrl-d was pressed.
            Ok(0) if self.is_terminal && is_input_hung_up()? => LinePart::Leave(HUNG_UP),
            Ok(0) => LinePart::End,
            Ok(n) => LinePart::Bytes(bytes[..n].to_vec()),
            Err(Errno::INTR | Errno::AGAIN) => LinePart::Bytes(Vec::new()),
            // The terminal is closed.
            Err(Errno::IO) => LinePart::Leave(HUNG_UP),
            Err(e) => return Err(e.into()),
        })
    }
}

fn is_input_hung_up() -> io::Result<bool> {
    let mut input = [PollFd::from_borrowed_fd(stdin(), PollFlags::empty())];
    poll(&mut input, Some(&Timespec::default()))?;
    Ok(input[0].revents().intersects(GONE))
}

fn timespec(duration: Duration) -> Timespec {
    Timespec {
        tv_sec: duration.as_secs().cast_signed(),
        tv_nsec: duration.subsec_nanos().into(),
    }
}

/// Whether an error says that the terminal is closed.
pub fn is_terminal_gone(error: &io::Error) -> bool {
    Errno::from_io_error(error) == Some(Errno::IO)
}

/// Whether a shell with job control started this process, and takes over when it stops.
pub fn has_job_control() -> bool {
    // Such a shell puts each job in a process group of its own.
    getsid(None).is_ok_and(|session| session != getpgrp())
}

/// Stops the whole job, as the terminal does that makes a signal of the key; false if that fails.
pub fn stop_job() -> bool {
    kill_current_process_group(Signal::TSTP).is_ok()
}

/// Stops this process until told to go on.
pub fn stop_process() -> io::Result<()> {
    low_level::raise(SIGSTOP)
}

/// Runs another program of this job to its end; while that is stopped, so is this process.
pub fn run_in_job(program: &mut Command) -> io::Result<()> {
    let child = Pid::from_child(&program.spawn()?);
    loop {
        let changed = retry_on_intr(|| waitpid(Some(child), WaitOptions::UNTRACED))?;
        if !changed.is_some_and(|(_, status)| status.stopped()) {
            return Ok(());
        }
        stop_process()?;
    }
}

/// What is set once ctrl-c is pressed; pressed twice, it ends the program at once with that status.
pub fn interrupt_flag(status: u8) -> io::Result<Arc<AtomicBool>> {
    let flag = Arc::new(AtomicBool::new(false));
    let pressed = Arc::clone(&flag);
    signal_hook::flag::register_conditional_shutdown(SIGINT, status.into(), pressed)?;
    signal_hook::flag::register(SIGINT, Arc::clone(&flag))?;
    Ok(flag)
}

/// The signals that have come in.
#[derive(Debug)]
struct SignalInbox {
    delivery: SignalDelivery<UnixStream, SignalOnly>,
}

impl SignalInbox {
    fn open() -> io::Result<Self> {
        let (read, write) = UnixStream::pair()?;
        Ok(Self {
            delivery: SignalDelivery::with_pipe(read, write, SignalOnly, HANDLED)?,
        })
    }

    /// What the signals since the last call ask for.
    fn pending(&mut self) -> Vec<SignalRequest> {
        let request = |signal| match signal {
            // The write that is too long fails by itself, and says so.
            SIGXFSZ => None,
            SIGTSTP => Some(SignalRequest::Stop),
            SIGCONT => Some(SignalRequest::GoOn),
            SIGWINCH => Some(SignalRequest::Resize),
            signal => Some(SignalRequest::End(128 + signal as u8)),
        };
        self.delivery.pending().filter_map(request).collect()
    }
}

/// All signals whose default ends or stops a process and that it can handle, faults of its own aside.
const HANDLED: [i32; 14] = [
    SIGALRM, SIGCONT, SIGHUP, SIGINT, SIGPROF, SIGQUIT, SIGTERM, SIGTSTP, SIGUSR1, SIGUSR2,
    SIGVTALRM, SIGWINCH, SIGXCPU, SIGXFSZ,
];

impl SignalInbox {
    /// Readable once a signal has come in.
    fn as_fd(&self) -> BorrowedFd<'_> {
        self.delivery.get_read().as_fd()
    }
}

/// What other threads wake a loop with: a byte in a pipe.
#[derive(Debug)]
struct Alarm {
    reader: PipeReader,
    /// Whether that byte is there. There is never a second one, so that nobody waits for room.
    is_rung: Arc<AtomicBool>,
    waker: Waker,
}

impl Alarm {
    fn new() -> io::Result<Self> {
        let (reader, writer) = pipe()?;
        let is_rung = Arc::new(AtomicBool::new(false));
        let already = Arc::clone(&is_rung);
        let waker = Waker::new(move || {
            if !already.swap(true, Ordering::AcqRel) {
                // The loop is gone: then nobody is to be woken.
                let _ = (&writer).write_all(&[0]);
            }
        });
        Ok(Self {
            reader,
            is_rung,
            waker,
        })
    }

    /// Takes the byte out, which must be there.
    fn quiet(&mut self) -> io::Result<()> {
        self.reader.read_exact(&mut [0])?;
        self.is_rung.store(false, Ordering::Release);
        Ok(())
    }
}

/// Makes a folder, and those above it, that nobody else may read.
pub fn create_private_folder(path: &Path) -> io::Result<()> {
    DirBuilder::new().recursive(true).mode(0o700).create(path)
}

/// Whether nobody but its owner, and the system's own, may read a file or folder.
#[cfg(test)]
pub fn is_private(path: &Path) -> bool {
    let others = Mode::RWXG | Mode::RWXO;
    let found = rustix::fs::stat(path).expect("a file");
    !Mode::from_raw_mode(found.st_mode).intersects(others)
}

/// What a new file of a person's may be allowed, before the umask takes its part; nothing where that
/// is the system's affair.
pub fn new_file_permissions() -> Option<Permissions> {
    Some(Permissions::from_mode(0o666))
}

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
