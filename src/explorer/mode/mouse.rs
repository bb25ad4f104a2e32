//! The mouse, where the person has asked for it: a click moves the cursor, the wheel zooms.

use ratatui::crossterm::event::{MouseButton, MouseEvent, MouseEventKind};
use ratatui::layout::Rect;

use crate::explorer::Explorer;
use crate::explorer::action::Action;
use crate::explorer::draw::layout;
use crate::explorer::mode::Mode;

/// How many lines of the help page a turn of the wheel scrolls.
const WHEEL: usize = 3;

impl Explorer {
    /// Takes the mouse, or leaves it to the terminal, which selects text with it.
    pub(crate) fn toggle_mouse(&mut self) {
        self.mouse = !self.mouse;
        self.say(if self.mouse {
            "The mouse: a click moves the cursor, the wheel zooms. $ gives it back."
        } else {
            "The mouse selects text again."
        });
    }

    /// Heeds the mouse; false if that changes nothing.
    pub(crate) fn point(&mut self, event: MouseEvent) -> bool {
        if !self.mouse {
            return false;
        }
        match (&self.mode, event.kind) {
            (Mode::Normal, MouseEventKind::ScrollUp) => self.by_mouse(Action::ZoomIn),
            (Mode::Normal, MouseEventKind::ScrollDown) => self.by_mouse(Action::ZoomOut),
            (Mode::Normal, MouseEventKind::Down(MouseButton::Left)) => {
                self.click(event.column, event.row)
            }
            (&Mode::Help { scroll }, MouseEventKind::ScrollUp) => {
                self.scroll_help(scroll.saturating_sub(WHEEL));
                true
            }
            (&Mode::Help { scroll }, MouseEventKind::ScrollDown) => {
                self.scroll_help(scroll + WHEEL);
                true
            }
            _ => false,
        }
    }

    fn by_mouse(&mut self, action: Action) -> bool {
        self.message = None;
        self.act(action);
        true
    }

    /// Puts the cursor on the pixel in that cell of the screen, if there is one.
    fn click(&mut self, col: u16, row: u16) -> bool {
        self.refresh();
        let (cols, rows) = self.screen;
        let layout = self.layout(Rect::new(0, 0, cols, rows));
        let layout = layout.filter(|layout| !self.is_picture_covered(layout));
        let shown = layout.map(|layout| {
            let image = &self.picture.image;
            let (left, top) = self.picture.offset;
            (layout::centered(layout.view, image, (left, top)), left, top)
        });
        let Some((area, left, top)) = shown.filter(|(area, ..)| area.contains((col, row).into()))
        else {
            return false;
        };
        if self.board {
            return false;
        }
        let cell = (
            left + u32::from(col - area.x),
            top + u32::from(row - area.y),
        );
        let (x, y) = self.options.style.pixel_of_cell(cell.0, cell.1);
        let size = self.size();
        if x < size.width && y < size.height {
            self.message = None;
            self.put_cursor(x, y);
        }
        true
    }
}
