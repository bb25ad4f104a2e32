//! The plans of frames that follow each other, for people and for programs.

use serde::Serialize;

use super::PlanLine;
use crate::report::{Column, DataColumn, Report, Table};

/// The plans of some frames that follow each other.
#[derive(Debug, Serialize)]
pub struct Plans {
    /// The name of the scene.
    pub scene: String,
    /// Pixels in a row.
    pub width: u32,
    /// Rows of pixels.
    pub height: u32,
    /// How many spheres the scene has.
    pub spheres: usize,
    /// The projection of its camera.
    pub projection: &'static str,
    /// The method.
    pub method: &'static str,
    /// The view.
    pub view: &'static str,
    /// The style.
    pub style: &'static str,
    /// The frames, in the order in which they were drawn.
    pub frames: Vec<FramePlan>,
}

/// The plan of one frame.
#[derive(Debug, Serialize)]
pub struct FramePlan {
    /// What the frame is called.
    pub frame: &'static str,
    /// What has happened since the last one.
    pub what: String,
    /// How the spheres are asked about.
    pub how: &'static str,
    /// What it needed and left out.
    pub plan: Vec<PlanLine>,
}

/// The plans for people.
pub fn plans_report(plans: &Plans) -> Report {
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

/// The plans for programs, a row for each line of each frame.
pub fn plans_table(plans: &Plans) -> Table {
    let lines = plans
        .frames
        .iter()
        .flat_map(|frame| frame.plan.iter().map(|line| (frame.frame, line.clone())));
    Table::of(&COLUMNS, lines)
}
