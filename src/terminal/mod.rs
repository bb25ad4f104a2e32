//! The real terminal: enter, leave, restore, and the loop between events and the screen.
//!
//! Nothing is drawn unless something changed: the loop waits for an event, takes what else is
//! queued, updates, and draws once.

mod capability;
mod session;

use std::io;
use std::time::Duration;

use ratatui::Terminal;
use ratatui::backend::Backend;
use ratatui::crossterm::event::{self, Event};

pub use capability::{Capability, Unfit};
pub use session::Session;

use crate::explorer::Explorer;

/// Most events taken before a drawing, so that a flood of input can't keep the screen from it.
const MOST_AT_ONCE: usize = 512;

/// Where events come from: a terminal, a test, a connection.
pub trait Events {
    /// Waits for the next event.
    fn wait(&mut self) -> io::Result<Event>;
    /// Whether [`Events::wait`] would answer at once.
    fn is_pending(&mut self) -> io::Result<bool>;
}

/// The events of the terminal that this process runs in.
#[derive(Debug, Clone, Copy, Default)]
pub struct TerminalEvents;

impl Events for TerminalEvents {
    fn wait(&mut self) -> io::Result<Event> {
        event::read()
    }

    fn is_pending(&mut self) -> io::Result<bool> {
        event::poll(Duration::ZERO)
    }
}

/// A screen that can show the explorer's state as a unit.
pub trait Screen {
    /// What drawing can fail with.
    type Error;
    /// Brings the screen up to date.
    fn show(&mut self, explorer: &mut Explorer) -> Result<(), Self::Error>;
}

impl<B: Backend> Screen for Terminal<B> {
    type Error = B::Error;

    fn show(&mut self, explorer: &mut Explorer) -> Result<(), Self::Error> {
        self.draw(|frame| {
            let area = frame.area();
            explorer.prepare(area.width, area.height);
            if let Some(position) = explorer.draw(frame.buffer_mut()) {
                frame.set_cursor_position(position);
            }
        })?;
        Ok(())
    }
}

/// Runs the explorer until the person leaves; the exit status.
pub fn run<S: Screen>(
    explorer: &mut Explorer,
    screen: &mut S,
    events: &mut impl Events,
) -> io::Result<u8>
where
    io::Error: From<S::Error>,
{
    screen.show(explorer)?;
    loop {
        let mut changed = explorer.update(&events.wait()?);
        for _ in 1..MOST_AT_ONCE {
            if explorer.ended().is_some() || !events.is_pending()? {
                break;
            }
            changed |= explorer.update(&events.wait()?);
        }
        if let Some(status) = explorer.ended() {
            return Ok(status);
        }
        if changed {
            screen.show(explorer)?;
        }
    }
}
