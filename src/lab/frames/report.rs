//! The times of frames for people and programs. docs/plan.md explains the columns.

use serde::Serialize;

use super::{FrameRow, FrameTimes};
use crate::lab::machine::Machine;
use crate::method::Method;
use crate::report::{self, DataColumn, Report, Table};

/// The times as text.
pub fn text(times: &FrameTimes, machine: &Machine) -> Report {
    Report::new()
        .lines(preface(times, machine))
        .gap()
        .words("milliseconds of a frame")
        .table(Table::of(&TIMES, times.rows.iter().copied()).numbers())
        .gap()
        .words("where they go, with the plan, up to the bytes for a terminal of 256 colours")
        .table(Table::of(&PARTS, times.rows.iter().copied()).numbers())
        .gap()
        .words("the bytes, beside those of ratatui's own backend for the same cells")
        .table(Table::of(&ENCODERS, times.rows.iter().copied()).numbers())
        .gap()
        .lines(remarks(times))
}

/// The times in Markdown.
pub fn markdown(times: &FrameTimes, machine: &Machine) -> Report {
    Report::new()
        .lines(preface(times, machine))
        .words("Milliseconds of a frame:")
        .table(Table::of(&TIMES, times.rows.iter().copied()).numbers())
        .words("Where they go, with the plan, up to the bytes for a terminal of 256 colours:")
        .table(Table::of(&PARTS, times.rows.iter().copied()).numbers())
        .words("The bytes, beside those of ratatui's own backend for the same cells:")
        .table(Table::of(&ENCODERS, times.rows.iter().copied()).numbers())
        .lines(remarks(times))
}

fn preface(times: &FrameTimes, machine: &Machine) -> [String; 3] {
    let [hardware, build] = machine.sentences();
    let (version, seed) = (env!("CARGO_PKG_VERSION"), times.seed);
    [
        format!(
            "rayscope {version} bench --frames, seed {seed}, one thread, every sphere moved in each frame, shaded, medians"
        ),
        hardware,
        format!("{build}, {}", dispatch()),
    ]
}

/// Which vectors the loops over arrays run with.
fn dispatch() -> &'static str {
    if crate::method::simd::is_wide() {
        "AVX2 and FMA found and used"
    } else {
        "no wider vectors than the flags say"
    }
}

const TIMES: [DataColumn<FrameRow>; 7] = [
    ("spheres", |row| row.spheres.to_string()),
    ("pixels", |row| row.size.to_string()),
    ("method", |row| row.method.to_string()),
    ("plan", |row| brief(row.plan_ms)),
    ("no plan", |row| {
        row.no_plan_ms.map_or("> 60000".into(), brief)
    }),
    ("ratio", |row| {
        ratio(row).map_or("-".into(), |ratio| format!("{ratio:.1}"))
    }),
    ("one moved", |row| brief(row.one_moved_ms)),
];

fn ratio(row: &FrameRow) -> Option<f64> {
    Some(row.no_plan_ms? / row.plan_ms)
}

const PARTS: [DataColumn<FrameRow>; 9] = [
    ("spheres", |row| row.spheres.to_string()),
    ("pixels", |row| row.size.to_string()),
    ("plan", |row| brief(row.parts.plan)),
    ("rays", |row| brief(row.parts.rays)),
    ("cells", |row| brief(row.parts.cells)),
    ("diff", |row| brief(row.parts.diff)),
    ("encode", |row| brief(row.parts.encode)),
    ("bytes", |row| row.bytes.to_string()),
    ("covered", |row| row.covered.to_string()),
];

const ENCODERS: [DataColumn<FrameRow>; 6] = [
    ("spheres", |row| row.spheres.to_string()),
    ("pixels", |row| row.size.to_string()),
    ("encode", |row| brief(row.parts.encode)),
    ("ratatui", |row| brief(row.parts.ratatui)),
    ("bytes", |row| row.bytes.to_string()),
    ("ratatui's", |row| row.ratatui_bytes.to_string()),
];

/// How the cost grows, and where the plan does not pay.
fn remarks(times: &FrameTimes) -> Vec<String> {
    let mut out = Vec::new();
    for method in Method::ALL {
        if let Some(slope) = times.slope(method) {
            out.push(format!(
                "{method}: time grows as (spheres + pixels covered)^{slope:.2}; proportion is 1."
            ));
        }
    }
    let loses: Vec<String> = times
        .rows
        .iter()
        .filter(|row| !row.pays())
        .map(|row| format!("{} at {} ({})", row.spheres, row.size, row.method))
        .collect();
    out.push(if loses.is_empty() {
        "The plan pays in every row.".into()
    } else {
        format!(
            "The plan does not pay for these numbers of spheres: {}.",
            loses.join(", ")
        )
    });
    if !times.complete {
        out.push("Interrupted: the remaining rows were not measured.".into());
    }
    out
}

/// Milliseconds with three digits that count, be there few of them.
pub fn brief(ms: f64) -> String {
    let decimals = match ms {
        _ if ms >= 99.95 => 0,
        _ if ms >= 9.995 => 1,
        _ if ms >= 0.9995 => 2,
        _ if ms >= 0.09995 => 3,
        _ if ms >= 0.0005 => 4,
        _ => 5,
    };
    format!("{ms:.decimals$}")
}

/// A row as programs read it.
#[derive(Debug, Serialize)]
struct FrameJson {
    spheres: usize,
    width: u32,
    height: u32,
    method: &'static str,
    plan_ms: f64,
    no_plan_ms: Option<f64>,
    best_ms: f64,
    one_moved_ms: f64,
    planning_ms: f64,
    rays_ms: f64,
    cells_ms: f64,
    diff_ms: f64,
    encode_ms: f64,
    bytes: usize,
    ratatui_ms: f64,
    ratatui_bytes: usize,
    covered: u64,
    pays: bool,
}

impl From<&FrameRow> for FrameJson {
    fn from(row: &FrameRow) -> Self {
        Self {
            spheres: row.spheres,
            width: row.size.width,
            height: row.size.height,
            method: row.method.name(),
            plan_ms: row.plan_ms,
            no_plan_ms: row.no_plan_ms,
            best_ms: row.best_ms,
            one_moved_ms: row.one_moved_ms,
            planning_ms: row.parts.plan,
            rays_ms: row.parts.rays,
            cells_ms: row.parts.cells,
            diff_ms: row.parts.diff,
            encode_ms: row.parts.encode,
            bytes: row.bytes,
            ratatui_ms: row.parts.ratatui,
            ratatui_bytes: row.ratatui_bytes,
            covered: row.covered,
            pays: row.pays(),
        }
    }
}

#[derive(Debug, Serialize)]
struct FramesJson<'a> {
    rayscope: &'static str,
    machine: &'a Machine,
    vectors: &'static str,
    seed: u64,
    complete: bool,
    slopes: Vec<Slope>,
    frames: Vec<FrameJson>,
}

#[derive(Debug, Serialize)]
struct Slope {
    method: &'static str,
    slope: f64,
}

/// The report as one JSON object.
pub fn json(times: &FrameTimes, machine: &Machine) -> String {
    let slope = |method: Method| {
        let slope = times.slope(method)?;
        let method = method.name();
        Some(Slope { method, slope })
    };
    report::json(&FramesJson {
        rayscope: env!("CARGO_PKG_VERSION"),
        machine,
        vectors: dispatch(),
        seed: times.seed,
        complete: times.complete,
        slopes: Method::ALL.into_iter().filter_map(slope).collect(),
        frames: times.rows.iter().map(FrameJson::from).collect(),
    })
}

/// The columns of the CSV; an empty `no_plan_ms` would take over a minute.
const COLUMNS: [DataColumn<FrameRow>; 18] = [
    ("spheres", |row| row.spheres.to_string()),
    ("width", |row| row.size.width.to_string()),
    ("height", |row| row.size.height.to_string()),
    ("method", |row| row.method.to_string()),
    ("plan_ms", |row| row.plan_ms.to_string()),
    ("no_plan_ms", |row| {
        row.no_plan_ms.map_or(String::new(), |ms| ms.to_string())
    }),
    ("best_ms", |row| row.best_ms.to_string()),
    ("one_moved_ms", |row| row.one_moved_ms.to_string()),
    ("planning_ms", |row| row.parts.plan.to_string()),
    ("rays_ms", |row| row.parts.rays.to_string()),
    ("cells_ms", |row| row.parts.cells.to_string()),
    ("diff_ms", |row| row.parts.diff.to_string()),
    ("encode_ms", |row| row.parts.encode.to_string()),
    ("bytes", |row| row.bytes.to_string()),
    ("ratatui_ms", |row| row.parts.ratatui.to_string()),
    ("ratatui_bytes", |row| row.ratatui_bytes.to_string()),
    ("covered", |row| row.covered.to_string()),
    ("pays", |row| row.pays().to_string()),
];

/// One row for each number of spheres, size and method.
pub fn records(times: &FrameTimes) -> Table {
    Table::of(&COLUMNS, times.rows.iter().copied())
}
