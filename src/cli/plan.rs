//! `rayscope plan`: what a frame of a scene needs, what is left out, and why.

use std::ffi::OsString;

use clap::Args;
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
use crate::report::{self, Column, DataColumn, Format, Report, Table};
use crate::scene::{PixelShape, Rays, Rgb, Scene, Size};
use crate::terminal::{Capability, Limits, Painter};

/// Show what a frame needs, what is left out, and why
#[derive(Debug, Args)]
pub(super) struct PlanArgs {
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
    #[arg(long, value_parser = choice(&[Format::Text, Format::Json, Format::Csv], Format::name), default_value = Format::Text.name())]
    format: Format,
}

/// The plans of some frames that follow each other.
#[derive(Debug, Serialize)]
struct Plans {
    scene: String,
    width: u32,
    height: u32,
    spheres: usize,
    projection: &'static str,
    method: &'static str,
    view: &'static str,
    style: &'static str,
    frames: Vec<FramePlan>,
}

#[derive(Debug, Serialize)]
struct FramePlan {
    frame: &'static str,
    what: String,
    how: &'static str,
    plan: Vec<PlanLine>,
}

/// Works out the plans, writes them and ends with the exit status.
pub(super) fn run(arguments: &PlanArgs) -> Outcome {
    let plans = plans(arguments)?;
    write_out(&match arguments.format {
        Format::Json => report::json(&plans),
        Format::Csv => records(&plans).csv(),
        _ => Capability::of_output().glyphs.spell(&text(&plans).text()),
    })
}

fn plans(arguments: &PlanArgs) -> Result<Plans, Failure> {
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
    Ok(Plans {
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
    fn new(arguments: &PlanArgs, view: View, size: Size, shape: PixelShape) -> Self {
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
    fn show(&mut self, scene: &Scene, frame: &'static str, what: impl Into<String>) -> FramePlan {
        let rays = Rays::new(&scene.camera, self.size, self.shape);
        self.frame.render(scene, &rays, self.method, self.view);
        self.image.draw(&self.frame, scene, self.look);
        let plan = self.frame.plan();
        let mut lines = explain::plan_lines(plan, &self.image);
        let how = explain::plan_sentence(plan);
        lines.push(self.bytes());
        FramePlan {
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

fn text(plans: &Plans) -> Report {
    let Plans {
        scene,
        width,
        height,
        spheres,
        projection,
        method,
        view,
        style,
        frames,
    } = plans;
    let plural = if *spheres == 1 { "" } else { "s" };
    let start = Report::new().words(format!(
        "{scene}: {width}×{height} pixels, {spheres} sphere{plural}, {projection}, {method}, {view}, {style}"
    ));
    frames.iter().fold(start, |report, frame| {
        report
            .gap()
            .words(&frame.what)
            .words(frame.how)
            .gap()
            .table(table(&frame.plan))
    })
}

fn table(plan: &[PlanLine]) -> Table {
    let row = |line: &PlanLine| {
        let [kept, left_out] = [line.kept, line.left_out].map(|n| n.to_string());
        vec![
            line.what.to_owned(),
            kept,
            left_out,
            line.because.to_string(),
        ]
    };
    let columns = [
        Column::left(""),
        Column::right("kept"),
        Column::right("left out"),
        Column::words("because"),
    ];
    Table::new(columns, plan.iter().map(row))
}

/// The columns of the CSV: of a frame, and of one line of its plan.
const COLUMNS: [DataColumn<(&'static str, PlanLine)>; 5] = [
    ("frame", |(frame, _)| (*frame).to_owned()),
    ("what", |(_, line)| line.what.trim_start().to_owned()),
    ("kept", |(_, line)| line.kept.to_string()),
    ("left_out", |(_, line)| line.left_out.to_string()),
    ("because", |(_, line)| line.because.to_string()),
];

fn records(plans: &Plans) -> Table {
    let lines = plans
        .frames
        .iter()
        .flat_map(|frame| frame.plan.iter().map(|line| (frame.frame, line.clone())));
    Table::of(&COLUMNS, lines)
}
