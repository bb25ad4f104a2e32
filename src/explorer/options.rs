//! How the explorer is drawn, why so, and what it asks of the loop that runs it.

use std::path::PathBuf;

use crate::explorer::draw::theme::Palette;
use crate::render::ColorDepth;
use crate::text::Glyphs;

/// What the terminal is like, and how the explorer is drawn on it.
#[derive(Debug, Clone, Copy)]
pub struct Options {
    /// Height of a cell over its width.
    pub aspect: f64,
    /// The colours that the terminal has.
    pub depth: ColorDepth,
    /// Which of them serve what.
    pub palette: Palette,
    /// Whether the theme goes by what the terminal says of its ground.
    pub follows_ground: bool,
    /// The characters that the terminal has.
    pub glyphs: Glyphs,
    /// Why these.
    pub reasons: Reasons,
}

/// Why the screen is drawn as it is, in a few words each, for the help page.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Reasons {
    /// Why this many colours.
    pub depth: &'static str,
    /// Why this theme.
    pub palette: &'static str,
    /// Why these characters.
    pub glyphs: &'static str,
}

impl Default for Reasons {
    fn default() -> Self {
        Self {
            depth: "the usual",
            palette: "the usual",
            glyphs: "the usual",
        }
    }
}

impl Options {
    /// The colours that are used: none in a theme without.
    pub const fn colors(&self) -> ColorDepth {
        match self.palette {
            Palette::Monochrome => ColorDepth::None,
            Palette::Dark | Palette::Light | Palette::Either | Palette::HighContrast => self.depth,
        }
    }
}

impl Default for Options {
    fn default() -> Self {
        Self {
            aspect: 2.0,
            depth: ColorDepth::Ansi256,
            palette: Palette::default(),
            follows_ground: false,
            glyphs: Glyphs::Unicode,
            reasons: Reasons::default(),
        }
    }
}

/// What the explorer can't do itself.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Request {
    /// Stop this process and give the terminal to the shell.
    Suspend,
    /// Put this text where the person can paste it from.
    Copy(String),
    /// Have the person edit this file of a routine, which is read again after that.
    Edit {
        /// As it was named.
        name: String,
        /// The file.
        path: PathBuf,
    },
    /// Draw all of the screen again, whatever the terminal shows.
    Redraw,
}
