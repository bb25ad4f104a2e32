//! `rayscope plan`: what a frame of a scene needs, what is left out, and why.

use std::ffi::OsString;
use std::fmt::Write as _;

use clap::{Args, ValueEnum};
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Color, Style as CellStyle};
use serde::Serialize;

use super::print::{fit_in, size, view_in};
use super::{Failure, Outcome, aspect, choice, from_one, write_out};
use crate::explain::{self, PlanLine};
use crate::explorer::usual_step;
use crate::method::Method;
use crate::render::{AnsiColor, CELL_ASPECT, Cell, ColorDepth, Frame, Image, Look, Style, View};
use crate::scene::{PixelShape, Rays, Rgb, Scene, Size};
use crate::terminal::{Capability, Limits, Painter};
use crate::text;

/// Show what a frame needs, what is left out, and why
#[derive(Debug, Args)]
pub(super) struct Plan {
    /// A scene file, or the name of a built-in scene
    scene: OsString,

    /// How samples become characters
    #[arg(long, value_parser = choice(&Style::ALL, Style::name), default_value = Style::Half.name())]
    style: Style,

    /// What the picture shows [default: shade; in the style tutorial, class]
    #[arg(long, value_parser = choice(&View::ALL, View::name))]
    view: Option<View>,

    /// Width and height in pixels [default: the scene's own, else what fills 80 by 24 cells]
    #[arg(long, value_name = "WxH", value_parser = size)]
    size: Option<Size>,

    /// How the quadratic is evaluated
    #[arg(long, value_parser = choice(&Method::ALL, Method::name), default_value_t = Method::default())]
    method: Method,

    /// Height of a character cell over its width
    #[arg(long, default_value_t = CELL_ASPECT, value_parser = aspect)]
    aspect: f64,

    /// The sphere that moves in the last of the frames, from 1
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = from_one, allow_negative_numbers = true)]
    sphere: usize,

    /// How the plan is written
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    Text,
    Json,
    Csv,
}

/// The plans of some frames that follow each other.
#[derive(Debug, Serialize)]
struct Report {
    scene: String,
    width: u32,
    height: u32,
    spheres: usize,
    projection: &'static str,
    method: &'static str,
    view: &'static str,
    style: &'static str,
    frames: Vec<Entry>,
}

#[derive(Debug, Serialize)]
struct Entry {
    frame: &'static str,
    what: String,
    how: &'static str,
    plan: Vec<PlanLine>,
}

/// Works out the plans, writes them and ends with the exit status.
pub(super) fn run(arguments: &Plan) -> Outcome {
    let report = report(arguments)?;
    let text = match arguments.format {
        Format::Text => Ok(Capability::of_output().glyphs.spell(&text(&report))),
        Format::Json => serde_json::to_string_pretty(&report)
            .map(|json| json + "\n")
            .map_err(|e| format!("JSON: {e}")),
        Format::Csv => csv(&report).map_err(|e| format!("CSV: {e}")),
    };
    write_out(&text.map_err(Failure::invalid)?)
}

fn report(arguments: &Plan) -> Result<Report, Failure> {
    let (mut scene, _) = Scene::open(&arguments.scene).map_err(Failure::invalid)?;
    let (style, spheres) = (arguments.style, scene.bodies.len());
    if arguments.sphere == 0 || arguments.sphere > spheres.max(1) {
        let expected = format!("a sphere of the scene, from 1 to {}", spheres.max(1));
        let found = arguments.sphere;
        let sentence = format!("--sphere {found}: expected {expected}");
        return Err(Failure::misused(sentence));
    }
    let view = view_in(style, arguments.view).map_err(Failure::misused)?;
    let (size, shape) = fit_in(&scene, style, ROOM, arguments.size, arguments.aspect);
    let mut screen = Screen::new(arguments, view, size, shape);
    let mut frames = vec![screen.show(&scene, "whole", "the whole picture, on an empty screen")];
    frames.push(screen.show(&scene, "cursor", "the cursor has moved"));
    let step = usual_step(&scene);
    if let Some(body) = scene.bodies.get_mut(arguments.sphere - 1) {
        body.sphere.center.x += step;
        let what = format!("sphere {} has moved by one step", arguments.sphere);
        frames.push(screen.show(&scene, "sphere", what));
    }
    Ok(Report {
        scene: scene.name,
        width: size.width,
        height: size.height,
        spheres,
        projection: scene.camera.projection.name(),
        method: arguments.method.name(),
        view: view.name(),
        style: style.name(),
        frames,
    })
}

/// Columns and rows that a picture fills for which no size is asked.
const ROOM: (u32, u32) = (80, 24);

/// Follows what a terminal of 256 colours shows.
struct Screen {
    size: Size,
    shape: PixelShape,
    method: Method,
    view: View,
    look: Look,
    frame: Frame,
    image: Image,
    painter: Painter,
}

impl Screen {
    fn new(arguments: &Plan, view: View, size: Size, shape: PixelShape) -> Self {
        Self {
            size,
            shape,
            method: arguments.method,
            view,
            look: Look {
                style: arguments.style,
                depth: ColorDepth::Ansi256,
                ascii_only: false,
                coarse: false,
            },
            frame: Frame::new(),
            image: Image::new(),
            painter: Painter::default(),
        }
    }

    /// Draws the next frame; its plan.
    fn show(&mut self, scene: &Scene, frame: &'static str, what: impl Into<String>) -> Entry {
        let rays = Rays::new(&scene.camera, self.size, self.shape);
        self.frame.render(scene, &rays, self.method, self.view);
        self.image.draw(&self.frame, scene, self.look);
        let plan = self.frame.plan();
        let mut lines = explain::plan_lines(plan, &self.image);
        let how = explain::plan_sentence(plan);
        lines.push(self.bytes());
        Entry {
            frame,
            what: what.into(),
            how,
            plan: lines,
        }
    }

    fn bytes(&mut self) -> PlanLine {
        let limits = Limits::default();
        let cells = || buffer_of(&self.image, self.look.depth);
        let all = Painter::default().paint(&mut cells(), None, limits).len() as u64;
        let sent = self.painter.paint(&mut cells(), None, limits).len() as u64;
        PlanLine::new(
            "bytes sent",
            sent,
            all.saturating_sub(sent),
            "of what all cells would take on an empty screen of 256 colours: a cell that the terminal shows already is not sent",
        )
    }
}

/// An image as the cells of a terminal with so many colours.
pub(super) fn buffer_of(image: &Image, depth: ColorDepth) -> Buffer {
    let columns = u16::try_from(image.cols).unwrap_or(u16::MAX);
    let rows = u16::try_from(image.rows).unwrap_or(u16::MAX);
    let mut buffer = Buffer::empty(Rect::new(0, 0, columns, rows));
    for (y, line) in (0..rows).zip(image.lines()) {
        for (x, cell) in (0..columns).zip(line) {
            buffer[(x, y)]
                .set_char(cell.glyph)
                .set_style(style_of(cell, depth));
        }
    }
    buffer
}

fn style_of(cell: &Cell, depth: ColorDepth) -> CellStyle {
    let color = |color: Option<Rgb>| match color.and_then(|c| depth.nearest(c)) {
        None => Color::Reset,
        Some(AnsiColor::Basic(i) | AnsiColor::Indexed(i)) => Color::Indexed(i),
        Some(AnsiColor::Rgb(Rgb(r, g, b))) => Color::Rgb(r, g, b),
    };
    CellStyle::new().fg(color(cell.fg)).bg(color(cell.bg))
}

fn text(report: &Report) -> String {
    let Report {
        scene,
        width,
        height,
        spheres,
        projection,
        method,
        view,
        style,
        ..
    } = report;
    let plural = if *spheres == 1 { "" } else { "s" };
    let mut out = format!(
        "{scene}: {width}×{height} pixels, {spheres} sphere{plural}, {projection}, {method}, {view}, {style}\n"
    );
    // Writing to a string does not fail.
    for Entry {
        what, how, plan, ..
    } in &report.frames
    {
        let _ = writeln!(out, "\n{what}");
        for line in text::wrap(how, 80) {
            let _ = writeln!(out, "{line}");
        }
        out += "\n";
        out += &explain::plan_text(plan, 80);
    }
    out
}

fn csv(report: &Report) -> Result<String, Box<dyn std::error::Error>> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(["frame", "what", "kept", "left_out", "because"])?;
    for entry in &report.frames {
        for line in &entry.plan {
            let numbers = [line.kept, line.left_out].map(|n| n.to_string());
            let [kept, left_out] = &numbers;
            writer.write_record([
                entry.frame,
                line.what.trim_start(),
                kept,
                left_out,
                &line.because,
            ])?;
        }
    }
    Ok(String::from_utf8(writer.into_inner()?)?)
}
