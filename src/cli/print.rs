//! `rayscope print`: draws a scene once to standard output. No state of a terminal is touched.

use std::fmt::Write as _;
use std::io::{self, ErrorKind, IsTerminal as _, Write as _};
use std::path::Path;
use std::process::ExitCode;

use clap::builder::PossibleValuesParser;
use clap::{Args, ValueEnum};
use crossterm::terminal::window_size;

use crate::method::Method;
use crate::render::{
    AnsiColor, CELL_ASPECT, Cell, ColorDepth, Frame, Image, Look, Style, View, fit,
};
use crate::scene::{Builtin, PixelShape, Rays, Scene, Size};

/// Draws a scene once, as text.
#[derive(Debug, Args)]
pub(super) struct Print {
    /// A scene file, or the name of a built-in scene.
    scene: String,

    /// Pixels to a cell: two (half), eight (braille), one (ascii), or one in two cells (seed).
    ///
    /// Without it half where there are colours, else ascii.
    #[arg(long, value_parser = PossibleValuesParser::new(Style::ALL.map(Style::name)))]
    style: Option<String>,

    /// What is shown.
    #[arg(long, default_value = View::default().name(),
          value_parser = PossibleValuesParser::new(View::ALL.map(View::name)))]
    view: String,

    /// Width and height in pixels; without it the scene's own, else what fills the terminal.
    #[arg(long, value_name = "WxH", value_parser = size)]
    size: Option<Size>,

    /// How the quadratic is evaluated.
    #[arg(long, default_value = Method::default().name(),
          value_parser = PossibleValuesParser::new(Method::ALL.map(Method::name)))]
    method: String,

    /// How many colours; auto: those of the terminal, none in a pipe or file.
    #[arg(long, value_name = "WHEN", default_value = "auto")]
    color: ColorChoice,

    /// How many times as high as wide a cell is.
    #[arg(long, value_name = "RATIO", default_value_t = CELL_ASPECT, value_parser = aspect)]
    aspect: f64,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum ColorChoice {
    Auto,
    Never,
    #[value(name = "16")]
    Ansi16,
    #[value(name = "256")]
    Ansi256,
    True,
}

/// What is known of where the output goes.
#[derive(Debug, Clone, Copy)]
struct Output {
    depth: ColorDepth,
    /// Whether characters beyond ASCII can be expected to show.
    unicode: bool,
    cols: u32,
    rows: u32,
}

pub(super) fn run(arguments: &Print) -> ExitCode {
    let scene = match open(&arguments.scene) {
        Ok(scene) => scene,
        Err(sentence) => {
            return failed(&sentence);
        }
    };
    match print(&picture(&scene, arguments, Output::detect(arguments.color))) {
        Ok(()) => ExitCode::SUCCESS,
        // Whoever read the picture has seen enough of it.
        Err(error) if error.kind() == ErrorKind::BrokenPipe => ExitCode::SUCCESS,
        Err(error) => failed(&format!("standard output: {error}")),
    }
}

fn failed(sentence: &str) -> ExitCode {
    // Where standard error is closed there is nobody left to tell.
    let _ = writeln!(io::stderr(), "rayscope: {sentence}");
    ExitCode::from(1)
}

fn open(name: &str) -> Result<Scene, String> {
    Builtin::by_name(name).map_or_else(
        || Scene::load(Path::new(name)).map_err(|error| error.to_string()),
        |builtin| Ok(builtin.scene()),
    )
}

fn print(text: &str) -> io::Result<()> {
    let mut out = io::stdout().lock();
    out.write_all(text.as_bytes())?;
    out.flush()
}

/// The picture as text, with escape sequences for its colours if there are any.
fn picture(scene: &Scene, arguments: &Print, output: Output) -> String {
    let by_colors = if output.depth == ColorDepth::None || !output.unicode {
        Style::Ascii
    } else {
        Style::Half
    };
    let asked = arguments.style.as_deref().and_then(Style::by_name);
    let style = asked.unwrap_or(by_colors);
    let (size, shape) = fit_as_asked(scene, style, arguments, output);
    let view = View::by_name(&arguments.view).unwrap_or_default();
    let method = Method::by_name(&arguments.method).unwrap_or_default();

    let mut frame = Frame::new();
    let rays = Rays::new(&scene.camera, size, shape);
    frame.render(scene, &rays, method, view.shown_in(style));
    let mut image = Image::new();
    let look = Look {
        style,
        depth: output.depth,
        ascii_only: false,
    };
    image.draw(&frame, scene, look);
    encode(image.lines(), output.depth)
}

/// The size of the picture: as asked, else the scene's own, else what fills the room.
fn fit_as_asked(
    scene: &Scene,
    style: Style,
    arguments: &Print,
    output: Output,
) -> (Size, PixelShape) {
    let (own, shape) = fit(scene, style, output.cols, output.rows, arguments.aspect);
    match arguments.size {
        Some(asked) if asked != own => {
            let aspect = style.pixel_aspect(arguments.aspect);
            (asked, PixelShape::Aspect(aspect))
        }
        _ => (own, shape),
    }
}

/// The rows of the image, each ended by a newline in the terminal's own colours.
fn encode<'a>(lines: impl Iterator<Item = &'a [Cell]>, depth: ColorDepth) -> String {
    let mut text = String::new();
    for line in lines {
        let mut colors = [None, None];
        for cell in line {
            change_colors(&mut text, &mut colors, cell, depth);
            text.push(cell.glyph);
        }
        if colors != [None, None] {
            text += "\x1b[0m";
        }
        text.push('\n');
    }
    text
}

/// Switches to the colours of `cell`; a blank has no foreground to switch to.
fn change_colors(
    text: &mut String,
    colors: &mut [Option<AnsiColor>; 2],
    cell: &Cell,
    depth: ColorDepth,
) {
    let [fg, bg] = [cell.fg, cell.bg].map(|c| c.and_then(|c| depth.nearest(c)));
    let fg = if cell.glyph == ' ' { colors[0] } else { fg };
    let changed = [(fg, 30), (bg, 40)];
    for (current, (wanted, ground)) in colors.iter_mut().zip(changed) {
        if *current != wanted {
            *current = wanted;
            // Writing to a string does not fail.
            let _ = match wanted {
                None => write!(text, "\x1b[{}m", ground + 9),
                Some(AnsiColor::Basic(i @ 0..=7)) => write!(text, "\x1b[{}m", ground + i),
                Some(AnsiColor::Basic(i)) => write!(text, "\x1b[{}m", ground + 60 + i - 8),
                Some(AnsiColor::Indexed(i)) => write!(text, "\x1b[{};5;{i}m", ground + 8),
                Some(AnsiColor::Rgb(c)) => {
                    write!(text, "\x1b[{};2;{};{};{}m", ground + 8, c.0, c.1, c.2)
                }
            };
        }
    }
}

impl Output {
    fn detect(choice: ColorChoice) -> Self {
        let variable = |name: &str| std::env::var(name).ok().filter(|value| !value.is_empty());
        let terminal = io::stdout().is_terminal();
        let (cols, rows) = match window_size() {
            // The last row is left to the prompt that follows.
            Ok(size) if terminal && size.columns > 0 && size.rows > 1 => {
                (u32::from(size.columns), u32::from(size.rows) - 1)
            }
            _ => (80, 24),
        };
        Self {
            depth: match choice {
                ColorChoice::Ansi16 => ColorDepth::Ansi16,
                ColorChoice::Ansi256 => ColorDepth::Ansi256,
                ColorChoice::True => ColorDepth::True,
                ColorChoice::Auto if terminal => depth_by(variable),
                ColorChoice::Auto | ColorChoice::Never => ColorDepth::None,
            },
            unicode: unicode_by(variable),
            cols,
            rows,
        }
    }
}

/// The colours that a terminal has by its environment, of which empty variables are no part.
fn depth_by(variable: impl Fn(&str) -> Option<String>) -> ColorDepth {
    let is = |name: &str, value: &str| variable(name).is_some_and(|v| v == value);
    let term = variable("TERM").unwrap_or_default();
    // Apple's Terminal passes COLORTERM on from elsewhere, and shows 256.
    let colorterm = !is("TERM_PROGRAM", "Apple_Terminal")
        && (is("COLORTERM", "truecolor") || is("COLORTERM", "24bit"));
    if variable("NO_COLOR").is_some() || term == "dumb" {
        ColorDepth::None
    } else if colorterm {
        ColorDepth::True
    } else if term.contains("256")
        || term.starts_with("xterm") && variable("SSH_CONNECTION").is_some()
    {
        ColorDepth::Ansi256
    } else {
        ColorDepth::Ansi16
    }
}

/// Whether the locale's characters are those of Unicode.
fn unicode_by(variable: impl Fn(&str) -> Option<String>) -> bool {
    ["LC_ALL", "LC_CTYPE", "LANG"]
        .into_iter()
        .find_map(variable)
        .is_some_and(|locale| {
            let locale = locale.to_ascii_lowercase();
            locale.contains("utf-8") || locale.contains("utf8")
        })
}

fn size(text: &str) -> Result<Size, String> {
    let side = |digits: &str| {
        let number = digits.parse().ok()?;
        (1..=Size::LARGEST).contains(&number).then_some(number)
    };
    text.split_once(['x', 'X', '×'])
        .and_then(|(width, height)| Some(Size::new(side(width)?, side(height)?)))
        .ok_or_else(|| {
            let most = Size::LARGEST;
            format!("expected a width and a height, each from 1 to {most}, such as 80x48")
        })
}

fn aspect(text: &str) -> Result<f64, String> {
    text.parse()
        .ok()
        .filter(|aspect| (0.1..=10.0).contains(aspect))
        .ok_or_else(|| "expected a number from 0.1 to 10, such as 2".into())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Rgb;

    fn with(variables: &[(&str, &str)]) -> impl Fn(&str) -> Option<String> {
        move |name| {
            let found = variables.iter().find(|(n, _)| *n == name);
            found.map(|(_, value)| (*value).into())
        }
    }

    #[test]
    fn the_environment_decides_on_colours_in_the_order_of_its_words() {
        let truecolor = ("COLORTERM", "truecolor");
        let cases: [(&[(&str, &str)], _); 9] = [
            (&[("NO_COLOR", "1"), truecolor], ColorDepth::None),
            (&[("TERM", "dumb")], ColorDepth::None),
            (&[truecolor, ("TERM", "xterm")], ColorDepth::True),
            (&[("COLORTERM", "24bit")], ColorDepth::True),
            (
                &[truecolor, ("TERM_PROGRAM", "Apple_Terminal")],
                ColorDepth::Ansi16,
            ),
            (&[("TERM", "screen-256color")], ColorDepth::Ansi256),
            (
                &[("TERM", "xterm"), ("SSH_CONNECTION", "a")],
                ColorDepth::Ansi256,
            ),
            (&[("TERM", "linux")], ColorDepth::Ansi16),
            (&[], ColorDepth::Ansi16),
        ];
        for (variables, expected) in cases {
            assert_eq!(depth_by(with(variables)), expected, "{variables:?}");
        }
    }

    #[test]
    fn the_first_locale_that_is_set_decides_on_characters() {
        assert!(unicode_by(with(&[("LANG", "de_DE.UTF-8")])));
        assert!(unicode_by(with(&[("LC_CTYPE", "C.utf8"), ("LANG", "C")])));
        assert!(!unicode_by(with(&[("LC_ALL", "C"), ("LANG", "C.UTF-8")])));
        assert!(!unicode_by(with(&[])));
    }

    #[test]
    fn sizes_are_two_numbers_in_range() {
        assert_eq!(size("80x48"), Ok(Size::new(80, 48)));
        assert_eq!(size("1X4096"), Ok(Size::new(1, 4096)));
        for bad in [
            "", "80", "80x", "x48", "0x1", "80x-1", "80x48x2", "4097x1", "8e1x1",
        ] {
            assert!(size(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn a_colour_is_written_where_it_changes_and_ends_with_its_line() {
        let [red, blue] = [Rgb(255, 0, 0), Rgb(0, 0, 255)].map(Some);
        let cell = |glyph, fg, bg| Cell { glyph, fg, bg };
        let cells = [
            cell('▀', red, None),
            cell(' ', None, None),
            cell('▀', red, None),
            cell('▀', red, blue),
            cell('a', None, None),
            cell('b', None, None),
            cell('▀', blue, None),
            cell('c', None, None),
        ];
        let encode = |depth| encode(cells.chunks(4), depth);
        assert_eq!(
            encode(ColorDepth::True),
            "\x1b[38;2;255;0;0m▀ ▀\x1b[48;2;0;0;255m▀\x1b[0m\nab\x1b[38;2;0;0;255m▀\x1b[39mc\n"
        );
        assert_eq!(
            encode(ColorDepth::Ansi256).lines().next(),
            Some("\x1b[38;5;196m▀ ▀\x1b[48;5;21m▀\x1b[0m")
        );
        assert_eq!(
            encode(ColorDepth::Ansi16).lines().next(),
            Some("\x1b[91m▀ ▀\x1b[44m▀\x1b[0m")
        );
        assert_eq!(encode(ColorDepth::None), "▀ ▀▀\nab▀c\n");
    }
}
