//! The terminal: what it can do; taken over and given back; the loop between it and the explorer.
//!
//! Nothing is drawn unless something changed: the loop waits for input, takes what else is queued,
//! updates, and draws once, as soon as the terminal has dealt with what was drawn before. A picture that takes
//! long is drawn as far as it is, and gone on with while no input comes.

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
pub use keyboard::{Keyboard, TerminalMessage};
pub use painter::{Limits, Painter};
pub use plain::converse;
pub use session::Session;

use crate::explorer::{Explorer, Request};

/// Most events taken before a drawing, so that a flood of input can't keep the screen from it.
const MOST_AT_ONCE: usize = 512;

/// What comes in from outside.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum TerminalInput {
    /// A key, the mouse, a paste.
    Event(Event),
    /// The same, from before the screen showed what there is to answer.
    TypedAhead(Event),
    /// The terminal says what its ground is.
    Ground {
        /// Rather than dark.
        is_light: bool,
    },
    /// The screen has another size, or shows something else.
    Redraw,
    /// Somebody woke the loop through the waker.
    Woken,
    /// Somebody wants the whole program to stop until it is told to go on.
    Stop,
    /// It is over, with this exit status, whatever the person wants.
    End(u8),
}

/// Runs the explorer until the person leaves or the terminal is gone; the exit status.
pub fn run(explorer: &mut Explorer, session: &mut Session) -> io::Result<u8> {
    // Something changed, or the picture is not done.
    let [mut due, mut unfinished] = [true, false];
    explorer.wake_by(session.waker());
    loop {
        if due && session.is_ready() {
            unfinished = !session.show(explorer)?;
            due = false;
        }
        if unfinished && session.is_ready() {
            session.look_in()?;
        } else {
            session.wait(due || unfinished)?;
        }
        due |= unfinished;
        for _ in 0..MOST_AT_ONCE {
            match session.next()? {
                Some(TerminalInput::Event(event)) => due |= explorer.update(&event),
                Some(TerminalInput::TypedAhead(event)) => {
                    due |= explorer.update_typed_ahead(&event);
                }
                Some(TerminalInput::Ground { is_light }) => due |= explorer.set_ground(is_light),
                Some(TerminalInput::Redraw) => due = true,
                Some(TerminalInput::Woken) => due |= explorer.catch_up(),
                Some(TerminalInput::Stop) => {
                    explorer.pause();
                    session.stop()?;
                }
                Some(TerminalInput::End(status)) => return Ok(status),
                None => break,
            }
            match explorer.take_request() {
                Some(Request::Suspend) if !Session::suspend() => {
                    explorer.tell("There is no shell to go back to; q quits.");
                }
                Some(Request::Copy(text)) => session.copy(&text)?,
                Some(Request::Edit { name, path }) => {
                    explorer.pause();
                    match session.edit(&path)? {
                        Ok(()) => explorer.take_edited(name),
                        Err(sentence) => explorer.tell(&sentence),
                    }
                    due = true;
                }
                Some(Request::Redraw) => session.forget(),
                Some(Request::Suspend) | None => {}
            }
            if let Some(status) = explorer.ended() {
                return Ok(status);
            }
        }
    }
}
