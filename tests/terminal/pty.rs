//! The whole program in a terminal of its own, watched from outside.

use std::io::{Read, Write};
use std::num::NonZeroU16;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, sync_channel};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use portable_pty::{Child, CommandBuilder, MasterPty, PtySize, native_pty_system};
use rayscope::lab::BenchQueue;
use rustix::process::{Pid, Signal, kill_process};
use rustix::termios::{self, OptionalActions, SpecialCodeIndex};
use tempfile::TempDir;

/// How long anything may take before it counts as not happening.
const PATIENCE: Duration = Duration::from_secs(20);
/// What one read takes at most: small, so that a reader that stalls holds little.
const CHUNK: usize = 1024;
/// The status query that a terminal answers with “ready”.
const QUERY: &[u8] = b"\x1b[5n";

/// How the program is started.
pub struct Start {
    size: (u16, u16),
    environment: Vec<(String, String)>,
    arguments: Vec<String>,
    home: Option<Arc<TempDir>>,
    queue: BenchQueue,
    through: Option<String>,
}

impl Default for Start {
    fn default() -> Self {
        let environment = [("TERM", "xterm-256color"), ("LANG", "C.UTF-8")];
        Self {
            size: (80, 24),
            environment: environment
                .map(|(n, v)| (n.to_owned(), v.to_owned()))
                .into(),
            arguments: Vec::new(),
            home: None,
            queue: BenchQueue::private(),
            through: None,
        }
    }
}

impl Start {
    pub fn size(mut self, cols: u16, rows: u16) -> Self {
        self.size = (cols, rows);
        self
    }

    pub fn env(mut self, name: &str, value: &str) -> Self {
        self.environment.retain(|(n, _)| n != name);
        self.environment.push((name.into(), value.into()));
        self
    }

    pub fn args(mut self, arguments: &[&str]) -> Self {
        self.arguments = arguments.iter().map(|&a| a.into()).collect();
        self
    }

    /// The home folder of an earlier start.
    pub fn home(mut self, home: &Arc<TempDir>) -> Self {
        self.home = Some(Arc::clone(home));
        self
    }

    /// The queue to measure in, which is its own otherwise.
    pub fn queue(mut self, queue: &BenchQueue) -> Self {
        self.queue = queue.clone();
        self
    }

    /// Runs a line of shell, in which `"$@"` is the program.
    pub fn through(mut self, line: &str) -> Self {
        self.through = Some(line.into());
        self
    }

    pub fn open(self) -> Pty {
        let home = self
            .home
            .clone()
            .unwrap_or_else(|| Arc::new(tempfile::tempdir().expect("a home")));
        let pair = native_pty_system()
            .openpty(pty_size(self.size))
            .expect("a pty");
        let before = settings(pair.master.as_ref());
        let child = pair
            .slave
            .spawn_command(self.command(home.path()))
            .expect("the program");
        drop(pair.slave);
        Pty {
            reader: Reader::of(pair.master.as_ref()),
            writer: pair.master.take_writer().expect("a writer"),
            master: pair.master,
            child: Running(child),
            screen: screen(self.size),
            before,
            bytes: Vec::new(),
            answered: 0,
            owed: 0,
            answers: true,
            home,
        }
    }

    fn command(&self, home: &Path) -> CommandBuilder {
        let program = env!("CARGO_BIN_EXE_rayscope");
        let mut command = CommandBuilder::new(program);
        if let Some(line) = &self.through {
            command = CommandBuilder::new("/bin/sh");
            command.args(["-c", line, "sh", program]);
        }
        command.args(&self.arguments);
        command.env_clear();
        command.env("PATH", "/usr/bin:/bin");
        command.env("HOME", home);
        let (variable, queue) = self.queue.variable();
        command.env(variable, queue);
        command.cwd(home);
        for (name, value) in &self.environment {
            command.env(name, value);
        }
        command
    }
}

fn pty_size((cols, rows): (u16, u16)) -> PtySize {
    PtySize {
        rows,
        cols,
        ..PtySize::default()
    }
}

/// What a terminal of that size shows; one without cells is followed as one of a single cell.
fn screen((cols, rows): (u16, u16)) -> vt100::Parser {
    let [cols, rows] = [cols, rows].map(|n| NonZeroU16::new(n).unwrap_or(NonZeroU16::MIN));
    vt100::Parser::new(rows, cols, 0)
}

/// Reads what the program writes, as long as somebody takes it.
struct Reader {
    chunks: Receiver<Vec<u8>>,
    stop: Arc<AtomicBool>,
    thread: JoinHandle<()>,
}

impl Reader {
    fn of(master: &dyn MasterPty) -> Self {
        let mut from = master.try_clone_reader().expect("a reader");
        let stop = Arc::new(AtomicBool::new(false));
        let stopped = Arc::clone(&stop);
        // A rendezvous: nothing is read ahead of who asks for it, but for one chunk.
        let (sender, chunks) = sync_channel(0);
        let thread = thread::spawn(move || {
            let mut chunk = [0; CHUNK];
            while let Ok(n @ 1..) = from.read(&mut chunk) {
                if stopped.load(Ordering::SeqCst) || sender.send(chunk[..n].to_vec()).is_err() {
                    break;
                }
            }
        });
        Self {
            chunks,
            stop,
            thread,
        }
    }
}

/// The program, running.
pub struct Pty {
    reader: Reader,
    writer: Box<dyn Write + Send>,
    master: Box<dyn MasterPty + Send>,
    child: Running,
    screen: vt100::Parser,
    /// The terminal's settings before the program had it.
    before: String,
    /// Everything that the program has written.
    bytes: Vec<u8>,
    /// Up to where they have been looked at for queries, and the queries that got no answer.
    answered: usize,
    owed: usize,
    answers: bool,
    home: Arc<TempDir>,
}

impl Pty {
    /// Opens the explorer and waits for its first screen.
    pub fn explorer(start: Start) -> Self {
        let mut pty = start.open();
        // The frame ends in a query: what comes after it is another frame.
        pty.waits_for("the first screen", |p| p.answered > 0);
        pty
    }

    pub fn pid(&self) -> u32 {
        self.child.0.process_id().expect("a process")
    }

    pub fn home(&self) -> Arc<TempDir> {
        Arc::clone(&self.home)
    }

    pub fn file(&self, name: &str) -> PathBuf {
        self.home.path().join(name)
    }

    /// All text on the screen.
    pub fn text(&self) -> String {
        self.screen.screen().contents()
    }

    pub fn screen(&self) -> &vt100::Screen {
        self.screen.screen()
    }

    /// Everything that the program has written so far.
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    pub fn shows(&self, text: &str) -> bool {
        self.text().contains(text)
    }

    /// Makes the terminal one that answers no query.
    pub fn answers_nothing(&mut self) {
        self.answers = false;
    }

    /// Gives all answers from now on, and those that are owed.
    pub fn answers_again(&mut self) {
        self.answers = true;
        self.answers_late();
    }

    /// Gives the answers that are owed.
    pub fn answers_late(&mut self) {
        let owed = std::mem::take(&mut self.owed);
        self.sends(&"\x1b[0n".repeat(owed));
    }

    pub fn sends(&mut self, keys: &str) {
        let sent = self.writer.write_all(keys.as_bytes());
        sent.and_then(|()| self.writer.flush())
            .expect("the terminal takes keys");
    }

    /// Shows on the terminal what somebody else has written.
    pub fn garbles(&mut self, bytes: &str) {
        self.screen.process(bytes.as_bytes());
    }

    pub fn resizes(&mut self, cols: u16, rows: u16) {
        self.master.resize(pty_size((cols, rows))).expect("a size");
        let [cols, rows] = [cols, rows].map(|n| NonZeroU16::new(n).unwrap_or(NonZeroU16::MIN));
        self.screen.screen_mut().set_size(rows, cols);
    }

    /// Tells the program a size without having it.
    pub fn claims(&self, cols: u16, rows: u16) {
        self.master.resize(pty_size((cols, rows))).expect("a size");
    }

    pub fn is_sent(&self, signal: Signal) {
        let pid = Pid::from_raw(self.pid().cast_signed()).expect("a process");
        kill_process(pid, signal).expect("the signal is sent");
    }

    /// Takes one chunk of output, if one comes in this time; false once there is no more to come.
    fn takes(&mut self, patience: Duration) -> bool {
        match self.reader.chunks.recv_timeout(patience) {
            Ok(chunk) => {
                self.screen.process(&chunk);
                self.bytes.extend(chunk);
                self.answer();
                true
            }
            Err(RecvTimeoutError::Timeout) => true,
            Err(RecvTimeoutError::Disconnected) => false,
        }
    }

    fn answer(&mut self) {
        let fresh = &self.bytes[self.answered..];
        if let Some(at) = fresh.windows(QUERY.len()).position(|w| w == QUERY) {
            self.answered += at + QUERY.len();
            if self.answers {
                // Where the program has ended meanwhile there is nobody to answer.
                let _ = self.writer.write_all(b"\x1b[0n");
            } else {
                self.owed += 1;
            }
            self.answer();
        }
    }

    /// Reads until the condition holds.
    pub fn waits_for(&mut self, what: &str, condition: impl Fn(&Self) -> bool) {
        let deadline = Instant::now() + PATIENCE;
        while !condition(self) {
            let more = self.takes(Duration::from_millis(20));
            let late = Instant::now() >= deadline;
            assert!(
                condition(self) || more && !late,
                "no {what}; on the screen was\n{}",
                self.text()
            );
        }
    }

    /// Reads what comes in this time.
    pub fn reads_for(&mut self, time: Duration) {
        let end = Instant::now() + time;
        while Instant::now() < end && self.takes(Duration::from_millis(5)) {}
    }

    pub fn waits_to_show(&mut self, text: &str) {
        self.waits_for(&format!("“{text}”"), |p| p.shows(text));
    }

    /// Reads to the end; the exit status.
    pub fn ends(&mut self) -> u32 {
        let deadline = Instant::now() + PATIENCE;
        while self.takes(Duration::from_millis(20)) {
            assert!(Instant::now() < deadline, "no end:\n{}", self.text());
        }
        self.child.status()
    }

    /// Ends it as `kill -9` does.
    pub fn dies(mut self) {
        self.is_sent(Signal::KILL);
        let ended = self.child.0.wait().expect("a status");
        assert!(ended.signal().is_some());
    }

    /// Closes the terminal under the program; its exit status.
    pub fn hangs_up(mut self) -> u32 {
        self.reader.stop.store(true, Ordering::SeqCst);
        // What the program writes next lets the reader see that it is to stop.
        self.resizes(81, 25);
        self.sends("\n");
        let Self {
            reader,
            writer,
            master,
            mut child,
            ..
        } = self;
        drop(reader.chunks);
        reader.thread.join().expect("the reader");
        forget_end_of_file(&*master);
        drop(writer);
        drop(master);
        child.status()
    }

    /// Whether the terminal is as the program found it.
    pub fn is_restored(&self) {
        let screen = self.screen();
        assert!(!screen.alternate_screen(), "on the alternate screen");
        assert!(!screen.hide_cursor(), "the cursor is hidden");
        assert!(!screen.bracketed_paste(), "pastes are bracketed");
        assert_eq!(
            screen.mouse_protocol_mode(),
            vt100::MouseProtocolMode::None,
            "the mouse is reported"
        );
        assert_eq!(screen.fgcolor(), vt100::Color::Default);
        assert_eq!(screen.bgcolor(), vt100::Color::Default);
        assert!(!screen.bold() && !screen.dim() && !screen.inverse());
        assert_eq!(settings(self.master.as_ref()), self.before, "termios");
        assert!(
            self.last(b"\x1b[?2026l") >= self.last(b"\x1b[?2026h"),
            "frozen"
        );
    }

    /// Where the program has last written these bytes.
    fn last(&self, what: &[u8]) -> Option<usize> {
        self.bytes.windows(what.len()).rposition(|w| w == what)
    }

    /// How often the program has written these bytes.
    pub fn occurrences(&self, what: &[u8]) -> usize {
        self.bytes
            .windows(what.len())
            .filter(|w| *w == what)
            .count()
    }
}

/// A program that does not outlive its test.
struct Running(Box<dyn Child + Send + Sync>);

impl Running {
    /// Waits for the end; the exit status.
    fn status(&mut self) -> u32 {
        let deadline = Instant::now() + PATIENCE;
        loop {
            if let Some(status) = self.0.try_wait().expect("a status") {
                assert_eq!(status.signal(), None, "killed");
                return status.exit_code();
            }
            assert!(Instant::now() < deadline, "it does not end");
            thread::yield_now();
        }
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        if let Ok(None) = self.0.try_wait() {
            // It may end by itself meanwhile.
            let _ = self.0.kill();
        }
    }
}

/// How the terminal treats what is typed and written.
fn settings(master: &dyn MasterPty) -> String {
    format!("{:?}", master.get_termios())
}

/// Lets no character end the input: a writer that is dropped would send it, and a terminal that hangs
/// up sends nothing.
fn forget_end_of_file(master: &dyn MasterPty) {
    let name = master.tty_name().expect("a terminal's name");
    let terminal = std::fs::File::open(name).expect("the terminal");
    let mut modes = termios::tcgetattr(&terminal).expect("its modes");
    modes.special_codes[SpecialCodeIndex::VEOF] = 0;
    termios::tcsetattr(&terminal, OptionalActions::Now, &modes).expect("its modes taken");
}
