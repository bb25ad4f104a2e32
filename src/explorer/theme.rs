//! Colours and borders: what role is drawn how, with few colours, with many, with none.

use ratatui::style::{Color, Modifier, Style};

use crate::explain::{Ink, Role};
use crate::method::Class;
use crate::render::{AnsiColor, ColorDepth};
use crate::scene::Rgb;

/// How the text of the screen looks; never is hue alone the meaning.
#[derive(Debug, Clone, Copy)]
pub struct Theme {
    depth: ColorDepth,
}

impl Theme {
    /// The theme for a terminal of so many colours.
    pub const fn new(depth: ColorDepth) -> Self {
        Self { depth }
    }

    fn hue(self, color: Color) -> Style {
        if self.depth == ColorDepth::None {
            Style::new()
        } else {
            Style::new().fg(color)
        }
    }

    /// A piece of a panel.
    pub fn role(self, role: Role) -> Style {
        match role {
            Role::Plain => Style::new(),
            Role::Label => Style::new().add_modifier(Modifier::BOLD),
            Role::Formula => self.hue(Color::Cyan),
            Role::Value => self.hue(Color::LightYellow),
            Role::Faint => Style::new().add_modifier(Modifier::DIM),
            Role::Verdict(class) => self.class(class).add_modifier(Modifier::BOLD),
            Role::Warning => self.warning(),
            Role::Changed => self
                .hue(Color::LightYellow)
                .add_modifier(Modifier::UNDERLINED),
            Role::Current => Self::chosen(),
            Role::Ink(ink) => self.ink(ink),
        }
    }

    /// A part of a figure. Letters and dash patterns tell the parts apart, too.
    fn ink(self, ink: Ink) -> Style {
        match ink {
            Ink::Axis | Ink::Pareto | Ink::Radius => Style::new().add_modifier(Modifier::DIM),
            Ink::Behind => self.hue(Color::Yellow).add_modifier(Modifier::DIM),
            Ink::Circle | Ink::Curve => self.hue(Color::LightCyan),
            Ink::Ray => self.hue(Color::LightYellow),
            Ink::Tangent => self.hue(Color::LightMagenta),
            Ink::Normal => self.hue(Color::LightBlue),
            Ink::Note => Style::new(),
            Ink::Point => Style::new().add_modifier(Modifier::BOLD),
            Ink::Root => self.hue(Color::LightGreen).add_modifier(Modifier::BOLD),
            Ink::Scrub => self
                .hue(Color::LightMagenta)
                .add_modifier(Modifier::BOLD | Modifier::REVERSED),
        }
    }

    fn class(self, class: Class) -> Style {
        self.hue(match class {
            Class::Miss => Color::LightBlue,
            Class::Tangent => Color::LightYellow,
            Class::Secant => Color::LightGreen,
            Class::Nan => Color::LightRed,
        })
    }

    /// Something is wrong.
    pub fn warning(self) -> Style {
        self.hue(Color::LightRed).add_modifier(Modifier::BOLD)
    }

    /// A cell of the picture that is wrong, whatever it shows.
    pub fn wrong(self) -> Style {
        if self.depth == ColorDepth::None {
            Style::reset().add_modifier(Modifier::BOLD)
        } else {
            Style::reset()
                .fg(Color::LightRed)
                .add_modifier(Modifier::BOLD)
        }
    }

    /// Words, over whatever was there before.
    pub const fn plain() -> Style {
        Style::reset()
    }

    /// Borders.
    pub const fn border() -> Style {
        Style::new().add_modifier(Modifier::DIM)
    }

    /// Headings and the names of keys.
    pub const fn strong() -> Style {
        Style::new().add_modifier(Modifier::BOLD)
    }

    /// What may be skipped.
    pub const fn faint() -> Style {
        Style::new().add_modifier(Modifier::DIM)
    }

    /// The line of a list that keys act on.
    pub const fn chosen() -> Style {
        Style::new().add_modifier(Modifier::REVERSED)
    }

    /// The marks that say where the cursor is.
    pub fn mark(self) -> Style {
        self.hue(Color::LightYellow).add_modifier(Modifier::BOLD)
    }

    /// A colour of the picture.
    pub fn color(self, color: Option<Rgb>) -> Color {
        match color.and_then(|c| self.depth.nearest(c)) {
            None => Color::Reset,
            Some(AnsiColor::Basic(i) | AnsiColor::Indexed(i)) => Color::Indexed(i),
            Some(AnsiColor::Rgb(Rgb(r, g, b))) => Color::Rgb(r, g, b),
        }
    }
}
