//! `rayscope plan`: what a frame of a scene needs, what is left out, and why.

use std::ffi::OsString;

use clap::Args;

use super::print::{fit_in, size, view_in};
use super::progress::Progress;
use super::unseen::UnseenTerminal;
use super::{Failure, MethodName, Outcome, aspect, choice, from_one, method_name, write_out};
use crate::explain::{self, FramePlan, PlanLine, Plans};
use crate::explorer::usual_step;
use crate::lab::frames::CellOutput;
use crate::method::Method;
use crate::render::{CELL_ASPECT, Frame, Image, Look, Style, View};
use crate::report::{self, Format};
use crate::scene::{PixelShape, Rays, Scene, Size};
use crate::terminal::Capability;

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
    #[arg(long, value_parser = method_name(), default_value = Method::default().name())]
    method: MethodName,

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

/// Works out the plans, writes them and ends with the exit status.
pub(super) fn run(arguments: &PlanArgs) -> Outcome {
    let plans = plans(arguments)?;
    write_out(&match arguments.format {
        Format::Json => report::json(&plans),
        Format::Csv => explain::plans_table(&plans).csv(),
        _ => Capability::of_output()
            .glyphs
            .spell(&explain::plans_report(&plans).text()),
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
    let mut screen = FrameSeries::new(arguments, (arguments.method.method()?, view), size, shape);
    let mut progress = Progress::unheeded("plan", 3);
    progress.go_on(0, "the whole picture");
    let what = "the whole picture, on an empty screen";
    let mut frames = vec![screen.show(&scene, "whole", what, &mut progress)];
    progress.go_on(1, "the cursor");
    let what = "the cursor has moved";
    frames.push(screen.show(&scene, "cursor", what, &mut progress));
    progress.go_on(2, "one sphere");
    let step = usual_step(&scene);
    if let Some(body) = scene.bodies.get_mut(arguments.sphere - 1) {
        body.sphere.center.x += step;
        let what = format!("sphere {} has moved by one step", arguments.sphere);
        frames.push(screen.show(&scene, "sphere", what, &mut progress));
    }
    progress.clear();
    Ok(Plans {
        scene: scene.name,
        width: size.width,
        height: size.height,
        spheres,
        projection: scene.camera.projection.name(),
        method: screen.method.name(),
        view: view.name(),
        style: style.name(),
        frames,
    })
}

/// Columns and rows that a picture fills for which no size is asked.
const ROOM: (u32, u32) = (80, 24);

/// Frames that follow each other on a terminal that shows them.
struct FrameSeries {
    size: Size,
    shape: PixelShape,
    method: Method,
    view: View,
    look: Look,
    frame: Frame,
    image: Image,
    terminal: UnseenTerminal,
    /// The bytes of all cells of the last frame.
    all: Option<usize>,
}

impl FrameSeries {
    fn new(
        arguments: &PlanArgs,
        (method, view): (Method, View),
        size: Size,
        shape: PixelShape,
    ) -> Self {
        Self {
            size,
            shape,
            method,
            view,
            look: Look {
                style: arguments.style,
                depth: UnseenTerminal::DEPTH,
                ascii_only: false,
                coarse: false,
            },
            frame: Frame::new(),
            image: Image::new(),
            terminal: UnseenTerminal::default(),
            all: None,
        }
    }

    /// Draws the next frame; its plan.
    fn show(
        &mut self,
        scene: &Scene,
        frame: &'static str,
        what: impl Into<String>,
        progress: &mut Progress,
    ) -> FramePlan {
        let rays = Rays::new(&scene.camera, self.size, self.shape);
        let asked = (self.method, self.view);
        progress.render(&mut self.frame, (scene, &rays), asked);
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
        let sent = self.terminal.show(&self.image);
        let all = match self.all {
            None => sent,
            Some(all) if self.image.cells_changed() == 0 => all,
            Some(_) => UnseenTerminal::default().show(&self.image),
        };
        self.all = Some(all);
        PlanLine::new(
            "bytes sent",
            sent as u64,
            all.saturating_sub(sent) as u64,
            "of the bytes of all cells on an empty screen in 256 colours: a cell that the terminal already shows is not sent",
        )
    }
}
