//! What everything that opens over the screen can do.

use ratatui::layout::{Position, Rect};

use crate::explorer::command::Command;
use crate::explorer::draw::layout::Layout;
use crate::explorer::draw::pen::Pen;
use crate::explorer::key::Key;
use crate::explorer::state::State;

/// What is to happen after a key.
#[derive(Debug, PartialEq)]
pub(crate) enum After {
    /// The mode stays open.
    Stay,
    /// The mode is over.
    Close,
    /// The mode stays open, and this is done.
    Run(Command),
    /// The mode is over, and this is done.
    Do(Command),
}

/// A mode: its keys, its picture, its foot.
pub(crate) trait Overlay {
    fn press(&mut self, key: Key, state: &mut State) -> After;

    /// Takes text that was pasted; false if nothing is typed here.
    fn paste(&mut self, _text: &str, _state: &mut State) -> bool {
        false
    }

    /// Takes a click on a cell of the screen.
    fn click(&mut self, _at: Position, _state: &State) -> After {
        After::Stay
    }

    /// Scrolls by lines; false if there is nothing to scroll.
    fn scroll(&mut self, _lines: isize, _state: &State) -> bool {
        false
    }

    /// Draws what takes the place of picture and panels, or of the panels alone.
    fn draw(&self, _state: &State, _pen: &mut Pen<'_>, _area: Rect) -> Option<Position> {
        None
    }

    /// Where it is drawn.
    fn place(&self, _layout: &Layout) -> ModeArea {
        ModeArea::Footer
    }

    /// The keys that matter here, for the footer.
    fn foot(&self) -> &[(&'static str, &'static str)] {
        &[]
    }

    /// Whether it draws the whole footer, not only its keys.
    fn has_footer(&self) -> bool {
        false
    }

    /// Draws the footer, if it has one of its own; where the text cursor belongs.
    fn draw_footer(&self, _state: &State, _pen: &mut Pen<'_>, _area: Rect) -> Option<Position> {
        None
    }
}

/// Where a mode is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ModeArea {
    /// In the footer alone.
    Footer,
    /// In the place of the panels; without panels, of the picture too.
    Panels,
    /// In the place of picture and panels.
    Body,
}
