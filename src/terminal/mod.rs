//! The terminal: what it can do; taken over and given back; the loop between it and the explorer.
//!
//! Nothing is drawn unless something changed: the loop waits for input, takes what else is queued,
//! updates, and draws once, as soon as the terminal has dealt with what was drawn before.

mod capability;
mod clipboard;
mod keyboard;
mod pace;
mod painter;
mod plain;
mod session;

use std::io;

use ratatui::crossterm::event::Event;

pub use capability::{Capability, Unfit};
pub use keyboard::{Heard, Keyboard};
pub use painter::{Limits, Painter};
pub use plain::converse;
pub use session::Session;

use crate::explorer::{Explorer, Request};
use crate::system::Waker;

/// Most events taken before a drawing, so that a flood of input can't keep the screen from it.
const MOST_AT_ONCE: usize = 512;

/// What comes in from outside.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Input {
    /// A key, the mouse, a paste.
    Event(Event),
    /// The screen has another size, or shows something else.
    Redraw,
    /// Somebody woke the loop through [`Link::waker`].
    Woken,
    /// Somebody wants the whole program to stop until it is told to go on.
    Stop,
    /// It is over, with this exit status, whatever the person wants.
    End(u8),
}

/// One person's terminal, near or far: where input comes from and frames go to.
pub trait Link {
    /// What ends [`Link::wait`] from any thread, and makes [`Link::next`] give [`Input::Woken`].
    fn waker(&self) -> Waker;
    /// Waits for input and, if a frame is `due`, for room for it.
    fn wait(&mut self, due: bool) -> io::Result<()>;
    /// What came in next, if anything has.
    fn next(&mut self) -> io::Result<Option<Input>>;
    /// Whether a frame would go out at once.
    fn is_ready(&mut self) -> bool;
    /// Brings the screen up to date.
    fn show(&mut self, explorer: &mut Explorer) -> io::Result<()>;
    /// Puts text into the clipboard of whoever sits there, if their terminal does such things.
    fn copy(&mut self, text: &str) -> io::Result<()>;
    /// Takes the screen to show nobody knows what.
    fn forget(&mut self);
    /// Stops the explorer, for its shell to take over; false if nobody would let it go on.
    fn suspend(&mut self) -> bool;
    /// Gives the terminal back and stops, as [`Input::Stop`] asks.
    fn stop(&mut self) -> io::Result<()>;
}

/// Runs the explorer until the person leaves or the link ends; the exit status.
pub fn run(explorer: &mut Explorer, link: &mut impl Link) -> io::Result<u8> {
    let mut due = true;
    explorer.wake_by(link.waker());
    loop {
        if due && link.is_ready() {
            link.show(explorer)?;
            due = false;
        }
        link.wait(due)?;
        for _ in 0..MOST_AT_ONCE {
            match link.next()? {
                Some(Input::Event(event)) => due |= explorer.update(&event),
                Some(Input::Redraw) => due = true,
                Some(Input::Woken) => due |= explorer.catch_up(),
                Some(Input::Stop) => {
                    explorer.pause();
                    link.stop()?;
                }
                Some(Input::End(status)) => return Ok(status),
                None => break,
            }
            match explorer.take_request() {
                Some(Request::Suspend) if !link.suspend() => {
                    explorer.tell("There is no shell to go back to; q quits.");
                }
                Some(Request::Copy(text)) => link.copy(&text)?,
                Some(Request::Redraw) => link.forget(),
                Some(Request::Suspend) | None => {}
            }
            if let Some(status) = explorer.ended() {
                return Ok(status);
            }
        }
    }
}
