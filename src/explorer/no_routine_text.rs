//! Built without routines: none can be typed.

use std::path::Path;

use ratatui::buffer::Buffer;
use ratatui::layout::{Position, Rect};
use ratatui::style::Style;

use crate::explorer::key::Key;
use crate::method::Method;

/// A text that is typed: none can be had in this build.
#[derive(Debug)]
pub(crate) enum RoutineText {}

impl RoutineText {
    pub(crate) fn of_file(name: &str, _: &Path, _: Method) -> Result<String, String> {
        Err(format!("{name}: this program was built without routines"))
    }

    pub(crate) fn new(name: &str, _: &str) -> Result<Self, String> {
        Err(format!("{name}: this program was built without routines"))
    }

    pub(crate) fn text(&self) -> String {
        match *self {}
    }

    pub(crate) fn error(&self) -> Option<(usize, &str)> {
        match *self {}
    }

    pub(crate) fn press(&mut self, _: Key) -> bool {
        match *self {}
    }

    pub(crate) fn paste(&mut self, _: &str) -> Result<(), String> {
        match *self {}
    }

    pub(crate) fn compile(&mut self, _: &str, _: &Path) -> Option<Method> {
        match *self {}
    }

    pub(crate) fn draw(&self, _: Rect, _: &mut Buffer, _: Style) -> Position {
        match *self {}
    }
}
