//! Colours and borders: what role is drawn how, with few colours, with many, with none.

use ratatui::buffer::Buffer;
use ratatui::style::{Color, Modifier, Style};

use crate::explain::{FigureInk, Role};
use crate::method::Class;
use crate::render::{AnsiColor, ColorDepth};
use crate::scene::Rgb;

/// A set of colours for one kind of screen, or of eyes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Palette {
    /// Bright text on the terminal's own dark ground.
    #[default]
    Dark,
    /// Dark text on the terminal's own light ground.
    Light,
    /// Middling colours that can be read on both grounds, until it is known which it is.
    Either,
    /// White and bright colours on black, whatever the terminal's ground is; nothing is faint.
    HighContrast,
    /// No colours; bold, faint and reversed tell things apart.
    Monochrome,
}

impl Palette {
    /// All themes that can be chosen, in the order of the key that turns them.
    pub const ALL: [Self; 4] = [
        Self::Dark,
        Self::Light,
        Self::HighContrast,
        Self::Monochrome,
    ];

    /// The name on the command line and on the screen.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Dark => "dark",
            Self::Light => "light",
            Self::Either => "either",
            Self::HighContrast => "high-contrast",
            Self::Monochrome => "monochrome",
        }
    }

    /// What it is for, in a few words.
    pub const fn words(self) -> &'static str {
        match self {
            Self::Dark => "for a dark background",
            Self::Light => "for a light background",
            Self::Either => "for either background",
            Self::HighContrast => "white on black, nothing faint",
            Self::Monochrome => "no colours",
        }
    }
}

/// How the text of the screen looks; never is hue alone the meaning.
#[derive(Debug, Clone, Copy)]
pub struct Theme {
    palette: Palette,
    depth: ColorDepth,
}

impl Theme {
    /// The theme for a terminal with this colour depth.
    pub fn new(palette: Palette, depth: ColorDepth) -> Self {
        let depth = match palette {
            Palette::Monochrome => ColorDepth::None,
            _ => depth,
        };
        Self { palette, depth }
    }

    fn hue(self, color: Color) -> Style {
        match (self.palette, self.depth) {
            (_, ColorDepth::None) | (Palette::Monochrome, _) => Style::new(),
            (Palette::Light, ColorDepth::Ansi16) => Style::new().fg(dark_of_16(color)),
            (Palette::Light, _) => Style::new().fg(dark_of_256(color)),
            (Palette::Either, ColorDepth::Ansi16) => Style::new().fg(middling_of_16(color)),
            (Palette::Either, _) => Style::new().fg(middling_of_256(color)),
            (Palette::HighContrast, _) => Style::new().fg(bright(color)),
            (Palette::Dark, _) => Style::new().fg(color),
        }
    }

    /// Gives the whole screen what the theme asks of all of it, once everything is drawn.
    pub fn finish(self, buffer: &mut Buffer) {
        if self.palette != Palette::HighContrast {
            return;
        }
        for cell in &mut buffer.content {
            cell.modifier -= Modifier::DIM;
            if self.depth != ColorDepth::None {
                if cell.fg == Color::Reset {
                    cell.fg = Color::White;
                }
                if cell.bg == Color::Reset {
                    cell.bg = Color::Black;
                }
            }
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
    fn ink(self, ink: FigureInk) -> Style {
        match ink {
            FigureInk::Axis | FigureInk::Pareto | FigureInk::Radius => {
                Style::new().add_modifier(Modifier::DIM)
            }
            FigureInk::Behind => self.hue(Color::Yellow).add_modifier(Modifier::DIM),
            FigureInk::Circle | FigureInk::Curve => self.hue(Color::LightCyan),
            FigureInk::Ray => self.hue(Color::LightYellow),
            FigureInk::Tangent => self.hue(Color::LightMagenta),
            FigureInk::Normal => self.hue(Color::LightBlue),
            FigureInk::Note => Style::new(),
            FigureInk::Point => Style::new().add_modifier(Modifier::BOLD),
            FigureInk::Root => self.hue(Color::LightGreen).add_modifier(Modifier::BOLD),
            FigureInk::Scrub => self
                .hue(Color::LightMagenta)
                .add_modifier(Modifier::BOLD | Modifier::REVERSED),
        }
    }

    fn class(self, class: Class) -> Style {
        self.hue(match class {
            Class::Miss => Color::LightBlue,
            Class::Tangent => Color::LightYellow,
            Class::Secant | Class::Hit => Color::LightGreen,
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

    /// Borders, over whatever was there before.
    pub const fn border() -> Style {
        Style::reset().add_modifier(Modifier::DIM)
    }

    /// Headings and the names of keys. Over a border they are not faint as well: terminals differ in
    /// what they make of both at once.
    pub const fn strong() -> Style {
        Style::new()
            .add_modifier(Modifier::BOLD)
            .remove_modifier(Modifier::DIM)
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
        // They stand in a border, which is faint.
        self.hue(Color::LightYellow)
            .add_modifier(Modifier::BOLD)
            .remove_modifier(Modifier::DIM)
    }

    /// A colour of the picture.
    pub fn color(self, color: Option<Rgb>) -> Color {
        let color = color.map(|color| match self.palette {
            Palette::HighContrast => lifted(color),
            _ => color,
        });
        match color.and_then(|c| self.depth.nearest(c)) {
            None => Color::Reset,
            Some(AnsiColor::Basic(i) | AnsiColor::Indexed(i)) => Color::Indexed(i),
            Some(AnsiColor::Rgb(Rgb(r, g, b))) => Color::Rgb(r, g, b),
        }
    }
}

/// The colour of xterm's 256 that says on white what `color` says on black: at least 5 to 1.
const fn dark_of_256(color: Color) -> Color {
    Color::Indexed(match color {
        Color::Yellow | Color::LightYellow => 94,
        Color::Green | Color::LightGreen => 22,
        Color::Cyan | Color::LightCyan => 24,
        Color::Blue | Color::LightBlue => 19,
        Color::Magenta | Color::LightMagenta => 90,
        Color::Red | Color::LightRed => 88,
        _ => return color,
    })
}

/// The same among the terminal's own sixteen, of which yellow, cyan and all bright ones are too
/// light on white.
const fn dark_of_16(color: Color) -> Color {
    match color {
        Color::Yellow | Color::LightYellow | Color::LightMagenta => Color::Magenta,
        Color::LightGreen => Color::Green,
        Color::Cyan | Color::LightCyan | Color::LightBlue => Color::Blue,
        Color::LightRed => Color::Red,
        other => other,
    }
}

/// The colour of xterm's 256 that can be read on black and on white: about 4 to 1.
const fn middling_of_256(color: Color) -> Color {
    Color::Indexed(match color {
        Color::Yellow | Color::LightYellow => 130,
        Color::Green | Color::LightGreen => 28,
        Color::Cyan | Color::LightCyan => 30,
        Color::Blue | Color::LightBlue => 62,
        Color::Magenta | Color::LightMagenta => 133,
        Color::Red | Color::LightRed => 196,
        _ => return color,
    })
}

/// The same among the sixteen, of which green, yellow and cyan are too light on white.
const fn middling_of_16(color: Color) -> Color {
    match color {
        Color::Yellow | Color::LightYellow | Color::LightMagenta => Color::Magenta,
        Color::Cyan | Color::LightCyan | Color::Blue => Color::LightBlue,
        Color::Green | Color::LightGreen => Color::Reset,
        Color::LightRed => Color::Red,
        other => other,
    }
}

/// The bright one of a pair.
const fn bright(color: Color) -> Color {
    match color {
        Color::Yellow => Color::LightYellow,
        Color::Green => Color::LightGreen,
        Color::Cyan => Color::LightCyan,
        // Blue is the darkest of all hues, bright or not.
        Color::Blue | Color::LightBlue => Color::White,
        Color::Magenta => Color::LightMagenta,
        Color::Red => Color::LightRed,
        other => other,
    }
}

/// Two fifths of the way to white: even the darkest shade stands out from black.
fn lifted(Rgb(r, g, b): Rgb) -> Rgb {
    let lift = |v: u8| 255 - (u32::from(255 - v) * 3 / 5) as u8;
    Rgb(lift(r), lift(g), lift(b))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Relative luminance of WCAG 2, for xterm's colours.
    fn luminance(color: Color) -> f64 {
        const BASIC: [[u8; 3]; 16] = [
            [0, 0, 0],
            [205, 0, 0],
            [0, 205, 0],
            [205, 205, 0],
            [0, 0, 238],
            [205, 0, 205],
            [0, 205, 205],
            [229, 229, 229],
            [127, 127, 127],
            [255, 0, 0],
            [0, 255, 0],
            [255, 255, 0],
            [92, 92, 255],
            [255, 0, 255],
            [0, 255, 255],
            [255, 255, 255],
        ];
        const CUBE: [u8; 6] = [0, 95, 135, 175, 215, 255];
        let rgb = match color {
            Color::Indexed(i @ 16..232) => {
                let i = usize::from(i - 16);
                [CUBE[i / 36], CUBE[i / 6 % 6], CUBE[i % 6]]
            }
            Color::Indexed(i @ 232..) => [8 + 10 * (i - 232); 3],
            Color::Indexed(i) => BASIC[usize::from(i)],
            Color::Rgb(r, g, b) => [r, g, b],
            named => {
                let names = [
                    Color::Black,
                    Color::Red,
                    Color::Green,
                    Color::Yellow,
                    Color::Blue,
                    Color::Magenta,
                    Color::Cyan,
                    Color::Gray,
                    Color::DarkGray,
                    Color::LightRed,
                    Color::LightGreen,
                    Color::LightYellow,
                    Color::LightBlue,
                    Color::LightMagenta,
                    Color::LightCyan,
                    Color::White,
                ];
                let at = names.iter().position(|&n| n == named);
                BASIC[at.expect("a colour")]
            }
        };
        let [r, g, b] = rgb.map(|v| {
            let v = f64::from(v) / 255.0;
            if v <= 0.04045 {
                v / 12.92
            } else {
                ((v + 0.055) / 1.055).powf(2.4)
            }
        });
        0.2126 * r + 0.7152 * g + 0.0722 * b
    }

    fn contrast(one: Color, other: Color) -> f64 {
        let [a, b] = [one, other].map(luminance);
        (a.max(b) + 0.05) / (a.min(b) + 0.05)
    }

    /// Every colour that text can have in a theme.
    fn text(theme: Theme) -> Vec<Color> {
        let classes = [Class::Miss, Class::Tangent, Class::Secant, Class::Nan];
        let roles = [Role::Formula, Role::Value, Role::Warning, Role::Changed];
        let inks = [
            FigureInk::Behind,
            FigureInk::Circle,
            FigureInk::Ray,
            FigureInk::Tangent,
            FigureInk::Normal,
            FigureInk::Root,
            FigureInk::Scrub,
        ];
        let all = roles.into_iter().chain(classes.map(Role::Verdict));
        let all = all.chain(inks.map(Role::Ink)).map(|r| theme.role(r));
        all.chain([theme.mark(), theme.warning()])
            .filter_map(|style| style.fg)
            .collect()
    }

    #[test]
    fn text_stands_out_from_the_ground_that_its_theme_is_for() {
        for (palette, depth, ground, least) in [
            (Palette::Dark, ColorDepth::Ansi256, Color::Black, 4.0),
            (Palette::Light, ColorDepth::Ansi256, Color::White, 5.0),
            (Palette::Light, ColorDepth::True, Color::White, 5.0),
            (Palette::Either, ColorDepth::Ansi256, Color::Black, 3.9),
            (Palette::Either, ColorDepth::Ansi256, Color::White, 3.9),
            (Palette::Either, ColorDepth::True, Color::White, 3.9),
            // Where the sixteen are the terminal's own, xterm's stand for them.
            (
                Palette::HighContrast,
                ColorDepth::Ansi256,
                Color::Black,
                5.0,
            ),
        ] {
            for color in text(Theme::new(palette, depth)) {
                let ratio = contrast(color, ground);
                assert!(ratio >= least, "{palette:?}: {color:?} has {ratio:.1}");
            }
        }
        // A terminal with a light ground has its sixteen darkened for it; but never these.
        for color in text(Theme::new(Palette::Light, ColorDepth::Ansi16)) {
            let light = [Color::Yellow, Color::Cyan, Color::LightYellow, Color::White];
            assert!(!light.contains(&color), "{color:?}");
        }
    }

    #[test]
    fn a_theme_without_colours_has_none() {
        assert!(text(Theme::new(Palette::Monochrome, ColorDepth::True)).is_empty());
        assert!(text(Theme::new(Palette::Dark, ColorDepth::None)).is_empty());
    }

    #[test]
    fn high_contrast_leaves_nothing_faint_and_no_ground_to_chance() {
        let theme = Theme::new(Palette::HighContrast, ColorDepth::Ansi256);
        let mut buffer = Buffer::empty(ratatui::layout::Rect::new(0, 0, 3, 1));
        buffer.set_string(0, 0, "ab", Theme::faint());
        theme.finish(&mut buffer);
        for cell in &buffer.content {
            assert_eq!((cell.fg, cell.bg), (Color::White, Color::Black));
            assert!(!cell.modifier.contains(Modifier::DIM));
        }
        for depth in [ColorDepth::Ansi256, ColorDepth::True] {
            let theme = Theme::new(Palette::HighContrast, depth);
            let dark = theme.color(Some(Rgb(0, 4, 10)));
            assert!(contrast(dark, Color::Black) >= 3.0, "{dark:?}");
        }
    }
}
