//! `rayscope print`: draws a scene once to standard output. No state of a terminal is touched.

use std::ffi::OsString;
use std::fmt::Write as _;
use std::io::{self, IsTerminal as _};

use clap::Args;
use crossterm::terminal::window_size;
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use serde::Serialize;

use super::appearance::{Color, ColorChoice, default_style};
use super::lens::LensFlag;
use super::progress::Progress;
use super::solve::{RayOut, SphereOut};
use super::{Failure, MethodName, Outcome, aspect, choice, method_name, write_out, write_picture};
use crate::explain::{self, Digits, Drawn, Lens, Reading, Step, StepData};
use crate::explorer::{self, Explorer, Options, Palette, Panel, Setting};
use crate::method::Method;
use crate::render::{
    AnsiColor, CELL_ASPECT, Cell, ColorDepth, Frame, Image, Look, Style, View, fit,
};
use crate::report::{self, Format};
use crate::scene::{PixelShape, Rays, Scene, Size};
use crate::terminal::Capability;
use crate::text::Glyphs;

pub(super) use crate::explorer::read_size as size;

/// Draw a scene once, as text
#[derive(Debug, Args)]
pub(super) struct Print {
    /// A scene file, or the name of a built-in scene
    scene: OsString,

    /// How samples become characters [default: half where there are colours, else ascii]
    #[arg(long, env = "RAYSCOPE_STYLE", hide_env_values = true, value_parser = choice(&Style::ALL, Style::name))]
    style: Option<Style>,

    /// What the picture shows [default: shade; in the style tutorial, class]
    #[arg(long, value_parser = choice(&View::ALL, View::name))]
    view: Option<View>,

    /// Width and height in pixels [default: the scene's own, else what fills the terminal]
    #[arg(long, value_name = "WxH", value_parser = size)]
    size: Option<Size>,

    // Before the method: it looks at whether that was given.
    #[command(flatten)]
    lens: LensFlag,

    /// How the quadratic is evaluated
    #[arg(long, env = "RAYSCOPE_METHOD", hide_env_values = true, value_parser = method_name(), default_value = Method::default().name())]
    method: MethodName,

    #[command(flatten)]
    color: Color,

    /// Height of a character cell over its width
    #[arg(long, default_value_t = CELL_ASPECT, value_parser = aspect)]
    aspect: f64,

    /// Instead of the picture, what the ray of one of its pixels finds
    #[arg(long, value_name = "X,Y", value_parser = pixel, allow_hyphen_values = true)]
    pixel: Option<(u32, u32)>,

    /// The explorer's screen as SVG: the picture, and the panel of the pixel (of the one in the middle
    /// without --pixel)
    #[arg(long)]
    svg: bool,

    /// The colours of the SVG [default: dark]
    #[arg(long, env = "RAYSCOPE_THEME", hide_env_values = true, value_parser = choice(&Palette::ALL, Palette::name))]
    theme: Option<Palette>,

    /// The whole derivation of that pixel, step by step
    #[arg(long, requires = "pixel")]
    steps: bool,

    /// How that pixel is written; json and markdown always have the whole derivation
    #[arg(long, requires = "pixel", conflicts_with = "svg", value_parser = choice(&FORMATS, Format::name), default_value = Format::Text.name())]
    format: Format,
}

/// How a pixel can be written.
const FORMATS: [Format; 3] = [Format::Text, Format::Json, Format::Markdown];

impl Print {
    /// Through which lens the pixel is looked at.
    fn lens(&self) -> Lens {
        self.lens.chosen()
    }
}

/// Draws the scene, or reads one pixel of it, and ends with the exit status.
pub(super) fn run(arguments: &Print) -> Outcome {
    if arguments.svg {
        return write_out(&screen_as_svg(arguments)?);
    }
    let text = text(arguments)?;
    match arguments.pixel {
        None => write_picture(&text),
        Some(_) => write_out(&text),
    }
}

/// The screen of an explorer that opens at what is asked for.
fn screen_as_svg(arguments: &Print) -> Result<String, Failure> {
    let (scene, source) = Scene::open(&arguments.scene).map_err(Failure::invalid)?;
    let style = arguments.style.unwrap_or(Style::Half);
    view_in(style, arguments.view).map_err(Failure::misused)?;
    let palette = arguments.theme.unwrap_or_default();
    let options = Options {
        aspect: arguments.aspect,
        depth: match arguments.color.color {
            ColorChoice::Auto => ColorDepth::True,
            choice => choice.over(Capability::of_output()).depth,
        },
        palette,
        ..Options::default()
    };
    let wanted = arguments.size.or(scene.pixels);
    let (cols, rows) = explorer::screen_for(wanted.map(|size| style.cells_of(size)));
    let mut settings = vec![
        Setting::Style(style),
        Setting::Method(arguments.method.method()?),
    ];
    settings.extend(arguments.view.map(Setting::View));
    settings.extend(arguments.pixel.map(|(x, y)| Setting::Cursor(x, y)));
    if arguments.steps {
        settings.push(Setting::Panel(Panel::Steps));
    }
    let title = format!("rayscope: {}", scene.name);
    let mut explorer = Explorer::new(scene, &source, options);
    explorer.set_out(&settings).map_err(Failure::misused)?;
    let mut buffer = Buffer::empty(Rect::new(0, 0, cols, rows));
    explorer.prepare(cols, rows);
    explorer.draw(&mut buffer);
    Ok(explorer::svg(&buffer, palette, &title))
}

/// What is asked for.
fn text(arguments: &Print) -> Result<String, Failure> {
    let (scene, _) = Scene::open(&arguments.scene).map_err(Failure::invalid)?;
    let method = arguments.method.method()?;
    let capability = arguments.color.color.over(Capability::of_output());
    let style = arguments
        .style
        .unwrap_or_else(|| default_style(capability.depth, capability.glyphs));
    let (size, shape) = fit_as_asked(&scene, style, arguments);
    let rays = Rays::new(&scene.camera, size, shape);
    let view = view_in(style, arguments.view).map_err(Failure::misused)?;
    match arguments.pixel {
        None => {
            let depth = capability.depth;
            Ok(picture(&scene, &rays, (method, view), (style, depth)))
        }
        Some((x, y)) if x < size.width && y < size.height => {
            let ray = rays.ray(x, y);
            let take = |method| Reading::take(&scene, (x, y), ray, method, None, None);
            let lens = arguments.lens();
            let asked = take(method);
            let (reading, wrong) = match lens {
                Lens::Machine => (asked, None),
                Lens::Mathematics => {
                    let exact = take(Method::Exact);
                    let wrong = asked.disagreement(&exact);
                    (exact, wrong)
                }
            };
            let glyphs = capability.glyphs;
            let steps = || {
                let look = Look {
                    style,
                    depth: ColorDepth::None,
                    ascii_only: glyphs == Glyphs::Ascii,
                    coarse: false,
                };
                steps(&scene, &rays, method, (lens, &reading), (view, look))
            };
            match arguments.format {
                Format::Json => {
                    let picture = (scene.name.as_str(), size);
                    return Ok(json(picture, (lens, &reading), wrong, &steps()));
                }
                Format::Markdown => {
                    let title = title((lens, &reading), size);
                    let report = explain::sheet_report(&title, &steps(), DEFAULT_ROOM.0 as usize);
                    return Ok(glyphs.spell(&report.markdown()));
                }
                Format::Text | Format::Csv => {}
            }
            let text = if arguments.steps {
                match steps() {
                    none if none.is_empty() => "The scene has no spheres.\n".into(),
                    steps => explain::sheet_text(&steps, DEFAULT_ROOM.0 as usize),
                }
            } else {
                panel(lens, &reading)
            };
            let acne = acne_line(&scene, &rays, method, view, (x, y));
            let wrong = wrong.map_or(String::new(), |wrong| {
                format!("{wrong}: --lens machine shows why\n")
            });
            let text = format!("{}\n{acne}{text}{wrong}", title((lens, &reading), size));
            Ok(capability.glyphs.spell(&text))
        }
        Some((x, y)) => {
            let [right, bottom] = [size.width, size.height].map(|n| n.saturating_sub(1));
            let expected = format!("a pixel of the picture, from 0,0 to {right},{bottom}");
            let sentence = format!("--pixel {x},{y}: expected {expected}");
            Err(Failure::misused(sentence))
        }
    }
}

/// What the picture shows: what is asked for, if the style can show it.
pub(super) fn view_in(style: Style, asked: Option<View>) -> Result<View, String> {
    let shown = asked.unwrap_or_default().shown_in(style);
    match asked {
        Some(view) if view != shown => Err(format!(
            "--view {}: the style {} shows only {}; expected another style or no view",
            view.name(),
            style.name(),
            shown.name()
        )),
        _ => Ok(shown),
    }
}

/// For which pixel the lines below are.
fn title((lens, reading): (Lens, &Reading), size: Size) -> String {
    let Size { width, height } = size;
    let (x, y) = reading.pixel;
    let by = match lens {
        Lens::Mathematics => String::new(),
        Lens::Machine => format!(", method {}", reading.method),
    };
    format!(
        "ray at ({x}, {y}) of {width} by {height} pixels, lens {}{by}",
        lens.name()
    )
}

/// What the view `acne` says of a pixel, on a line; nothing in other views.
fn acne_line(scene: &Scene, rays: &Rays, method: Method, view: View, (x, y): (u32, u32)) -> String {
    if view != View::Acne {
        return String::new();
    }
    let mut frame = Frame::new();
    frame.render(scene, rays, method, view);
    match frame.acne(scene, x, y) {
        Some(acne) => format!("{}\n", explain::acne_words(&acne)),
        None => "no point is seen here\n".to_owned(),
    }
}

/// What the side panel of the explorer shows for a pixel.
fn panel(lens: Lens, reading: &Reading) -> String {
    let lines = explain::lines(
        lens,
        reading,
        DEFAULT_ROOM.0 as usize,
        match lens {
            Lens::Mathematics => Digits::Significant(6),
            Lens::Machine => Digits::Full,
        },
        Glyphs::Unicode,
    );
    explain::plain_text(&lines)
}

/// The derivation of a pixel, from its place to the character that shows it.
fn steps(
    scene: &Scene,
    rays: &Rays,
    method: Method,
    (lens, reading): (Lens, &Reading),
    (view, look): (View, Look),
) -> Vec<Step> {
    let frame = rendered(scene, rays, method, view);
    let mut image = Image::new();
    image.draw(&frame, scene, look);
    let drawn = Drawn::at(reading.pixel, &frame, &image, look.style);
    explain::sheet(lens, reading, Some(scene), Some(rays), Some(&drawn))
}

/// A pixel and its sheet, as programs read it.
#[derive(Serialize)]
struct PixelJson<'a> {
    rayscope: &'static str,
    scene: &'a str,
    size: [u32; 2],
    pixel: [u32; 2],
    lens: &'static str,
    method: &'static str,
    ray: RayOut,
    spheres: usize,
    /// The number of the sphere that is shown, from 1, and the sphere; none in an empty scene.
    number: Option<usize>,
    sphere: Option<SphereOut>,
    class: Option<&'static str>,
    /// The sentence that says what the chosen method gets wrong here.
    wrong: Option<String>,
    steps: Vec<StepData<'a>>,
}

/// The object of a pixel; through the lens `mathematics` its method is `exact`.
fn json(
    (scene, size): (&str, Size),
    (lens, reading): (Lens, &Reading),
    wrong: Option<String>,
    steps: &[Step],
) -> String {
    let subject = reading.subject.as_ref();
    report::json(&PixelJson {
        rayscope: env!("CARGO_PKG_VERSION"),
        scene,
        size: [size.width, size.height],
        pixel: reading.pixel.into(),
        lens: lens.name(),
        method: reading.method.name(),
        ray: RayOut::of(&reading.ray),
        spheres: reading.spheres,
        number: subject.map(|subject| subject.body + 1),
        sphere: subject.map(|subject| SphereOut::of(&subject.sphere)),
        class: subject.map(|subject| subject.solution.class.name()),
        wrong,
        steps: steps.iter().map(StepData::of).collect(),
    })
}

/// The picture as text, with escape sequences for its colours if there are any.
fn picture(
    scene: &Scene,
    rays: &Rays,
    (method, view): (Method, View),
    (style, depth): (Style, ColorDepth),
) -> String {
    let frame = rendered(scene, rays, method, view);
    let mut image = Image::new();
    let look = Look {
        style,
        depth,
        ascii_only: false,
        coarse: false,
    };
    image.draw(&frame, scene, look);
    encode(image.lines(), depth)
}

/// The frame, of which somebody who waits for long is told how much is done.
fn rendered(scene: &Scene, rays: &Rays, method: Method, view: View) -> Frame {
    let mut frame = Frame::new();
    let mut progress = Progress::unheeded("print", 1);
    progress.render(&mut frame, (scene, rays), (method, view));
    progress.clear();
    frame
}

/// Columns and rows where there is no terminal to ask.
const DEFAULT_ROOM: (u32, u32) = (80, 24);

/// Columns and rows that the output has room for.
fn room() -> (u32, u32) {
    match window_size() {
        // The last row is left to the prompt that follows.
        Ok(size) if io::stdout().is_terminal() && size.columns > 0 && size.rows > 1 => {
            (size.columns.into(), u32::from(size.rows) - 1)
        }
        _ => DEFAULT_ROOM,
    }
}

/// The size of the picture: as asked, else the scene's own, else what fills the room.
fn fit_as_asked(scene: &Scene, style: Style, arguments: &Print) -> (Size, PixelShape) {
    fit_in(scene, style, room(), arguments.size, arguments.aspect)
}

/// The size of a picture in a room of these columns and rows, if no other is asked for.
pub(super) fn fit_in(
    scene: &Scene,
    style: Style,
    (cols, rows): (u32, u32),
    asked: Option<Size>,
    aspect: f64,
) -> (Size, PixelShape) {
    let (own, shape) = fit(scene, style, cols, rows, aspect);
    match asked {
        Some(asked) if asked != own => (asked, PixelShape::Aspect(style.pixel_aspect(aspect))),
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

pub(super) fn pixel(text: &str) -> Result<(u32, u32), String> {
    text.split_once(',')
        .and_then(|(x, y)| Some((x.trim().parse().ok()?, y.trim().parse().ok()?)))
        .ok_or_else(|| "expected a column and a row, counted from 0, such as 20,20".into())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Rgb;

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
