//! The terminal while the explorer has it: raw, on the alternate screen, and given back as it was
//! on return, error and panic.

use std::io::{self, BufWriter, Stdout, Write};
use std::panic;
use std::sync::Once;
use std::sync::atomic::{AtomicBool, Ordering};

use ratatui::Terminal;
use ratatui::backend::CrosstermBackend;
use ratatui::crossterm::cursor::Show;
use ratatui::crossterm::event::{DisableBracketedPaste, EnableBracketedPaste};
use ratatui::crossterm::terminal::{
    BeginSynchronizedUpdate, EndSynchronizedUpdate, EnterAlternateScreen, LeaveAlternateScreen,
    disable_raw_mode, enable_raw_mode,
};
use ratatui::crossterm::{execute, queue};

use super::Screen;
use crate::explorer::Explorer;

/// Holds a whole frame of a large screen, so that each is one write.
const FRAME_BYTES: usize = 1 << 20;

/// Whether the terminal is ours now, so that it is given back once.
static ENTERED: AtomicBool = AtomicBool::new(false);

/// The terminal of this process, ours until this is dropped.
#[derive(Debug)]
pub struct Session {
    terminal: Terminal<CrosstermBackend<BufWriter<Stdout>>>,
}

impl Session {
    /// Takes the terminal over.
    pub fn enter() -> io::Result<Self> {
        restore_on_panic();
        enable_raw_mode()?;
        ENTERED.store(true, Ordering::SeqCst);
        let mut out = BufWriter::with_capacity(FRAME_BYTES, io::stdout());
        let entered = queue!(out, EnterAlternateScreen, EnableBracketedPaste)
            .and_then(|()| Terminal::new(CrosstermBackend::new(out)));
        if entered.is_err() {
            leave();
        }
        Ok(Self { terminal: entered? })
    }
}

impl Screen for Session {
    type Error = io::Error;

    fn show(&mut self, explorer: &mut Explorer) -> io::Result<()> {
        queue!(self.terminal.backend_mut(), BeginSynchronizedUpdate)?;
        let shown = self.terminal.show(explorer);
        execute!(self.terminal.backend_mut(), EndSynchronizedUpdate)?;
        shown
    }
}

impl Drop for Session {
    fn drop(&mut self) {
        // What is still in the buffer was meant for a screen that is about to go.
        let _ = self.terminal.backend_mut().flush();
        leave();
    }
}

/// Gives the terminal back, once; what fails is left, the rest still tried.
fn leave() {
    if ENTERED.swap(false, Ordering::SeqCst) {
        let _ = execute!(
            io::stdout(),
            EndSynchronizedUpdate,
            DisableBracketedPaste,
            Show,
            LeaveAlternateScreen
        );
        let _ = disable_raw_mode();
    }
}

/// Lets a panic say what it has to say on the screen that the person came from.
fn restore_on_panic() {
    static HOOK: Once = Once::new();
    HOOK.call_once(|| {
        let before = panic::take_hook();
        panic::set_hook(Box::new(move |info| {
            leave();
            before(info);
        }));
    });
}
