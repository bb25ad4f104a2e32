//! How a long run tells how far it is, and how Ctrl-C ends it.

use std::io::{IsTerminal as _, Write as _};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use super::Failure;
use crate::method::Method;
use crate::render::{Allowance, Frame, View};
use crate::scene::{Rays, Scene};
use crate::system;

/// 128 + SIGINT.
pub(super) const INTERRUPTED: u8 = 130;

/// How long a picture is worked on between two lines of progress.
const SLICE: Duration = Duration::from_millis(200);

/// Tells on standard error how far a long run is, if that is a terminal, and whether Ctrl-C was
/// pressed.
pub(super) struct Progress {
    what: &'static str,
    all: usize,
    shown: Option<usize>,
    /// The line that is on the terminal, if one is.
    line: Option<String>,
    interrupt: Arc<AtomicBool>,
}

impl Progress {
    /// A run of `all` parts that is about to begin.
    pub fn new(what: &'static str, all: usize) -> Result<Self, Failure> {
        let interrupt = system::interrupt_flag(INTERRUPTED)
            .map_err(|e| Failure::invalid(format_args!("signals: {e}")))?;
        Ok(Self {
            what,
            all,
            shown: None,
            line: None,
            interrupt,
        })
    }

    /// A run that Ctrl-C ends at once, as it ends any program.
    pub fn unheeded(what: &'static str, all: usize) -> Self {
        Self {
            what,
            all,
            shown: None,
            line: None,
            interrupt: Arc::default(),
        }
    }

    /// Notes that the part `number`, from 0, is being worked on; whether to go on with it.
    pub fn go_on(&mut self, number: usize, name: &str) -> bool {
        if self.shown != Some(number) {
            self.shown = Some(number);
            let Self { what, all, .. } = self;
            self.line = Some(format!("{what}: {name}, {} of {all}", number + 1));
            self.say_how_far("");
        }
        !self.interrupted()
    }

    /// Renders a frame; of one that takes long it tells how much is done.
    pub fn render(
        &mut self,
        frame: &mut Frame,
        (scene, rays): (&Scene, &Rays),
        (method, view): (Method, View),
    ) {
        frame.begin(scene, rays, method, view);
        let slice = || Allowance::until(Instant::now() + SLICE);
        while !frame.go_on(scene, rays, &mut slice()) {
            let percent = 100.0 * frame.share_done();
            self.line
                .get_or_insert_with(|| format!("{}: the picture", self.what));
            self.say_how_far(&format!(", {percent:.0}% drawn"));
        }
    }

    fn say_how_far(&self, more: &str) {
        if let Some(line) = &self.line {
            say(&format!("\r\x1b[K{line}{more}"));
        }
    }

    pub fn interrupted(&self) -> bool {
        self.interrupt.load(Ordering::Relaxed)
    }

    /// Takes the line of progress away.
    pub fn clear(&self) {
        if self.line.is_some() {
            say("\r\x1b[K");
        }
    }
}

/// Writes on standard error if somebody watches it.
fn say(text: &str) {
    let mut err = std::io::stderr();
    if err.is_terminal() {
        let _ = err.write_all(text.as_bytes());
    }
}
