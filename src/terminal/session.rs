//! The terminal while the explorer has it: raw, on the alternate screen, and given back as it was
//! on return, error, panic and signal, and while the process is stopped.

use std::collections::VecDeque;
use std::io;
use std::panic;
use std::path::Path;
use std::process::Command;
use std::sync::{Arc, Mutex, MutexGuard, Once, PoisonError};
use std::thread::{self, ThreadId};
use std::time::{Duration, Instant};

use super::TerminalInput;
use super::clipboard;
use super::keyboard::{Keyboard, TerminalMessage};
use super::pace::{Detail, Pace, QUERY};
use super::painter::{Limits, Painter};
use crate::door;
use crate::explorer::Explorer;
use crate::system::{
    Device, HUNG_UP, Inbox, SignalRequest, Waker, has_job_control, run_in_job, stop_job,
    stop_process,
};
use ratatui::buffer::Buffer;
use ratatui::crossterm::event::Event;
use ratatui::layout::Rect;

/// The alternate screen; pastes marked as such.
const ENTER: &[u8] = b"\x1b[?1049h\x1b[?2004h";
/// All that may have been turned on, the screen cleared for terminals without an alternate one.
const LEAVE: &[u8] =
    b"\x1b[?2026l\x1b[?2031l\x1b[?1006l\x1b[?1000l\x1b[?2004l\x1b[m\x1b[2J\x1b[H\x1b[?1049l\x1b[?25h";
/// Asks for the colour of the ground, and to be told when it changes between light and dark.
const ASK_GROUND: &[u8] = b"\x1b[?2031h\x1b]11;?\x1b\\";
/// Presses and the wheel are reported, motion is not.
const MOUSE_ON: &[u8] = b"\x1b[?1000h\x1b[?1006h";
const MOUSE_OFF: &[u8] = b"\x1b[?1006l\x1b[?1000l";

/// How long a picture is worked on before input has a turn: two of these, and what the rest of the screen
/// takes, are well below what a person notices.
const SLICE: Duration = Duration::from_millis(20);
/// How long a terminal that does not read may hold up the end.
const END_PATIENCE: Duration = Duration::from_millis(500);
/// The largest screen that is drawn, in columns and rows; a terminal can say any size of itself.
const LARGEST_SCREEN: (u16, u16) = (1000, 400);

/// The terminal that is ours now, for a panic to give back.
static HELD: Mutex<Option<Held>> = Mutex::new(None);

/// A terminal, and the thread that draws on it.
struct Held {
    device: Arc<Device>,
    by: ThreadId,
}

/// The terminal of this process, ours until this is dropped.
#[derive(Debug)]
pub struct Session {
    device: Arc<Device>,
    inbox: Inbox,
    keyboard: Keyboard,
    /// When the rest of what has begun on the keyboard is no longer waited for.
    gives_up: Option<Instant>,
    /// When a question was written that the terminal has not shown yet, as far as is known.
    unseen: Option<Instant>,
    /// The size that the terminal had when it was last too large.
    too_large: Option<(u16, u16)>,
    asked_ground: bool,
    /// What came in and has not been asked for.
    inputs: VecDeque<TerminalInput>,
    painter: Painter,
    canvas: Buffer,
    pace: Pace,
    detail: Detail,
    /// The frame on its way, and how much of it has been written.
    frame: Vec<u8>,
    written: usize,
    mouse: bool,
    standing: Standing,
}

/// Whose the terminal is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Standing {
    Ours,
    /// It is as it was found: we have not begun, or have stopped, or ended.
    GivenBack,
    /// It is closed.
    Gone,
}

impl Session {
    /// Takes the terminal over.
    pub fn enter() -> io::Result<Self> {
        restore_on_panic();
        let mut session = Self {
            device: Arc::new(Device::open()?),
            inbox: Inbox::open()?,
            keyboard: Keyboard::default(),
            gives_up: None,
            // What was typed before the first frame answers nothing.
            unseen: Some(Instant::now()),
            too_large: None,
            asked_ground: false,
            inputs: VecDeque::new(),
            painter: Painter::default(),
            canvas: Buffer::default(),
            pace: Pace::new(Device::CAN_BE_ASKED),
            detail: Detail::default(),
            frame: Vec::new(),
            written: 0,
            mouse: false,
            standing: Standing::GivenBack,
        };
        session.take_over()?;
        Ok(session)
    }

    /// Makes the terminal ours, whatever state it is in.
    fn take_over(&mut self) -> io::Result<()> {
        self.device.make_raw()?;
        *held() = Some(Held {
            device: Arc::clone(&self.device),
            by: thread::current().id(),
        });
        self.standing = Standing::Ours;
        self.frame.clear();
        self.frame.extend_from_slice(ENTER);
        self.written = 0;
        self.mouse = false;
        self.asked_ground = false;
        self.painter.forget();
        self.pace.forget();
        self.detail = Detail::default();
        self.flush()
    }

    /// Gives the terminal back as it was found.
    fn give_back(&mut self) {
        // A panic has given it back already: to do so twice would clear what it says.
        let is_held = held().take().is_some();
        if is_held && self.standing == Standing::Ours {
            // Half a frame would end in half a sequence.
            let rest = &self.frame[self.written..];
            self.device.write_within(rest, END_PATIENCE);
            self.device.write_within(LEAVE, END_PATIENCE);
            self.await_answers();
        }
        if self.standing == Standing::Ours {
            self.standing = Standing::GivenBack;
        }
        // Where the terminal is gone, so are its modes.
        let _ = self.device.restore_modes();
    }

    /// Waits for the answers to what was asked: later they would be typed at the shell.
    fn await_answers(&mut self) {
        let deadline = Instant::now() + self.pace.last_patience();
        while self.pace.is_waiting() {
            let left = deadline.saturating_duration_since(Instant::now());
            if left.is_zero() || self.look(Some(left)).is_err() {
                return self.device.discard_input();
            }
        }
    }

    /// Writes what the terminal takes of the frame.
    fn flush(&mut self) -> io::Result<()> {
        while self.written < self.frame.len() {
            match self.device.write(&self.frame[self.written..])? {
                Some(0) => return Ok(()),
                Some(n) => self.written += n,
                None => {
                    self.hang_up();
                    break;
                }
            }
        }
        self.frame.clear();
        self.written = 0;
        Ok(())
    }

    /// Whether a frame would go out at once.
    fn has_room(&mut self, now: Instant) -> bool {
        self.standing == Standing::Ours && self.frame.is_empty() && self.pace.due(now).is_none()
    }

    fn hang_up(&mut self) {
        if self.standing != Standing::Gone {
            self.standing = Standing::Gone;
            self.inputs.push_back(TerminalInput::End(HUNG_UP));
        }
    }

    /// Waits at most that long, without end if none is given, and takes in what there is.
    fn look(&mut self, patience: Option<Duration>) -> io::Result<()> {
        let unwritten = !self.frame.is_empty();
        let arrivals = self.inbox.wait(&self.device, unwritten, patience)?;
        if arrivals.is_gone {
            self.hang_up();
        }
        for request in arrivals.signals {
            self.handle_signal(request)?;
        }
        if arrivals.is_woken {
            self.inputs.push_back(TerminalInput::Woken);
        }
        for event in arrivals.events {
            self.take_event(event);
        }
        if !arrivals.bytes.is_empty() {
            let mut messages = VecDeque::new();
            self.keyboard.feed(&arrivals.bytes, &mut messages);
            self.take_in(messages);
        } else if self.gives_up.is_some_and(|at| at <= Instant::now()) {
            let mut messages = VecDeque::new();
            self.keyboard.give_up(&mut messages);
            self.take_in(messages);
        }
        if arrivals.is_writable {
            self.flush()?;
        }
        Ok(())
    }

    fn handle_signal(&mut self, request: SignalRequest) -> io::Result<()> {
        match request {
            SignalRequest::End(status) => self.inputs.push_back(TerminalInput::End(status)),
            SignalRequest::Resize => {
                // What a terminal makes of its cells when it grows or shrinks is its own affair.
                self.painter.forget();
                self.inputs.push_back(TerminalInput::Redraw);
            }
            // Without a shell that waits nobody would tell it to go on.
            SignalRequest::Stop if !has_job_control() => {}
            SignalRequest::Stop => self.inputs.push_back(TerminalInput::Stop),
            SignalRequest::GoOn => {
                self.take_over()?;
                self.inputs.push_back(TerminalInput::Redraw);
            }
        }
        Ok(())
    }

    fn take_in(&mut self, messages: VecDeque<TerminalMessage>) {
        let now = Instant::now();
        self.gives_up = self.keyboard.patience().map(|patience| now + patience);
        for message in messages {
            match message {
                TerminalMessage::Event(event) => self.take_event(event),
                TerminalMessage::Ground { is_light } => {
                    self.inputs.push_back(TerminalInput::Ground { is_light });
                }
                TerminalMessage::Ready => {
                    self.pace.answered(now);
                    if !self.pace.is_waiting() {
                        self.unseen = None;
                    }
                }
            }
        }
    }

    fn take_event(&mut self, event: Event) {
        // Whether the terminal does not show yet what there is to answer.
        let patience = self.pace.patience();
        let is_ahead = self
            .unseen
            .is_some_and(|written| written.elapsed() < patience);
        self.inputs.push_back(if is_ahead {
            TerminalInput::TypedAhead(event)
        } else {
            TerminalInput::Event(event)
        });
    }

    /// The size to draw in; says so where the terminal is larger.
    fn sane_size(&mut self, explorer: &mut Explorer) -> (u16, u16) {
        let size = self.device.size();
        let sane = (size.0.min(LARGEST_SCREEN.0), size.1.min(LARGEST_SCREEN.1));
        if sane != size && self.too_large != Some(size) {
            explorer.tell(&format!(
                "The terminal says that it has {} columns and {} rows: {} and {} of them are drawn.",
                size.0, size.1, sane.0, sane.1
            ));
        }
        self.too_large = (sane != size).then_some(size);
        sane
    }

    /// The next frame: what brings the terminal from what it shows to the explorer's state; whether all
    /// of that is done.
    fn compose(&mut self, explorer: &mut Explorer) -> bool {
        let (cols, rows) = self.sane_size(explorer);
        self.canvas.resize(Rect::new(0, 0, cols, rows));
        self.canvas.reset();
        explorer.set_coarse(self.detail.draws(Instant::now()));
        let is_done = explorer.prepare_within(cols, rows, SLICE);
        let cursor = explorer.draw(&mut self.canvas);
        let limits = Limits::of(&explorer.options());
        let bytes = self.painter.paint(&mut self.canvas, cursor, limits);
        explorer.note_sent(bytes.len());
        self.frame.extend_from_slice(bytes);
        if explorer.wants_mouse() != self.mouse {
            self.mouse = explorer.wants_mouse();
            let change = if self.mouse { MOUSE_ON } else { MOUSE_OFF };
            self.frame.extend_from_slice(change);
        }
        is_done
    }
}

impl Session {
    /// What ends [`Session::wait`] from any thread, and makes [`Session::next`] give [`TerminalInput::Woken`].
    pub(super) fn waker(&self) -> Waker {
        self.inbox.waker()
    }

    /// Waits for input and, if a frame is `due`, for room for it.
    pub(super) fn wait(&mut self, due: bool) -> io::Result<()> {
        if !self.inputs.is_empty() {
            return Ok(());
        }
        let now = Instant::now();
        // What is due, or else the detail that a person who rests gets back.
        let room = self.pace.due(now);
        let detail = self.detail.due().filter(|_| self.frame.is_empty());
        let due = if due {
            room
        } else {
            detail.map(|at| room.map_or(at, |room| room.max(at)))
        };
        let until = [due, self.gives_up].into_iter().flatten().min();
        self.look(until.map(|at| at.saturating_duration_since(now)))
    }

    /// Takes in what there is, without waiting.
    pub(super) fn look_in(&mut self) -> io::Result<()> {
        if self.inputs.is_empty() {
            self.look(Some(Duration::ZERO))?;
        }
        Ok(())
    }

    /// What came in next, if anything has.
    pub(super) fn next(&mut self) -> io::Result<Option<TerminalInput>> {
        self.look_in()?;
        let now = Instant::now();
        let is_idle = self.inputs.is_empty() && self.has_room(now);
        if is_idle && self.detail.rests(now) {
            return Ok(Some(TerminalInput::Redraw));
        }
        Ok(self.inputs.pop_front())
    }

    /// Whether a frame would go out at once.
    pub(super) fn is_ready(&mut self) -> bool {
        let now = Instant::now();
        let is_ready = self.has_room(now);
        if !is_ready {
            self.detail.holds(now);
        }
        is_ready
    }

    /// Brings the screen up to date, or nearer to that; whether it is.
    pub(super) fn show(&mut self, explorer: &mut Explorer) -> io::Result<bool> {
        let is_done = self.compose(explorer);
        if self.frame.is_empty() {
            return Ok(is_done);
        }
        let (bytes, now) = (self.frame.len(), Instant::now());
        self.unseen = explorer.is_asking().then_some(now);
        // Answered or not: the status query that follows is answered after it.
        let asks_ground = !self.asked_ground && explorer.options().follows_ground;
        if asks_ground && self.pace.can_ask() && clipboard::swallows_strings() {
            self.frame.extend_from_slice(ASK_GROUND);
            self.asked_ground = true;
        }
        let asks = self.pace.asks(bytes) || self.unseen.is_some() && self.pace.can_ask();
        if asks {
            self.frame.extend_from_slice(QUERY);
        }
        self.pace.wrote(bytes, asks, now);
        self.flush()?;
        Ok(is_done)
    }

    /// Puts text into the clipboard of the person, if their terminal does such things.
    pub(super) fn copy(&mut self, text: &str) -> io::Result<()> {
        if self.standing == Standing::Ours && clipboard::swallows_strings() {
            self.frame.extend(clipboard::set(text).bytes());
            self.flush()?;
        }
        Ok(())
    }

    /// Takes the screen to show nobody knows what.
    pub(super) fn forget(&mut self) {
        self.painter.forget();
    }

    /// Stops the explorer, for its shell to take over; false if nobody would let it go on.
    pub(super) fn suspend() -> bool {
        // The whole job stops, as it would if the terminal had made a signal of the key.
        has_job_control() && stop_job()
    }

    /// Gives the terminal to the person's editor, for this file, until that ends; or says why not.
    pub(super) fn edit(&mut self, path: &Path) -> io::Result<Result<(), String>> {
        // A person who has this program in the place of a shell must not reach one through an editor.
        if !has_job_control() {
            return Ok(Err(
                "edit: no shell started rayscope; `:routine` opens the text here.".into(),
            ));
        }
        let editor = editor();
        let words = shell_words::split(&editor).unwrap_or_default();
        let Some((program, flags)) = words.split_first() else {
            return Ok(Err(format!(
                "edit: $VISUAL or $EDITOR is “{editor}”, expected a program"
            )));
        };
        self.give_back();
        let ran = run_in_job(Command::new(program).args(flags).arg(path));
        // What asked to stop meant the editor.
        let arrivals = self.inbox.wait(&self.device, false, Some(Duration::ZERO))?;
        self.take_over()?;
        for request in arrivals.signals {
            if request != SignalRequest::Stop {
                self.handle_signal(request)?;
            }
        }
        Ok(ran.map_err(|error| format!("edit: {program}: {}", door::plain(&error))))
    }

    /// Gives the terminal back and stops, as [`TerminalInput::Stop`] asks.
    pub(super) fn stop(&mut self) -> io::Result<()> {
        self.give_back();
        stop_process()
    }
}

impl Drop for Session {
    fn drop(&mut self) {
        self.give_back();
    }
}

/// The editor that the person has chosen, with its flags.
fn editor() -> String {
    let named = |name| std::env::var(name).ok().filter(|editor| !editor.is_empty());
    named("VISUAL")
        .or_else(|| named("EDITOR"))
        .unwrap_or_else(|| "vi".to_owned())
}

fn held() -> MutexGuard<'static, Option<Held>> {
    HELD.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Lets a panic say what it has to say on the screen that the person came from.
///
/// Another thread's panic ends that thread alone: the screen stays, and what waits for the thread says so.
fn restore_on_panic() {
    static HOOK: Once = Once::new();
    HOOK.call_once(|| {
        let before = panic::take_hook();
        panic::set_hook(Box::new(move |info| {
            let this = thread::current().id();
            if held().as_ref().is_some_and(|held| held.by != this) {
                return;
            }
            if let Some(Held { device, .. }) = held().take() {
                device.write_within(LEAVE, END_PATIENCE);
                let _ = device.restore_modes();
            }
            before(info);
        }));
    });
}
