//! The time of the explorer's whole screen while the camera moves, to the last byte, beside ratatui's own
//! backend on the same cells.

use std::time::Instant;

use ratatui::buffer::Buffer;
use ratatui::crossterm::event::{Event, KeyCode, KeyEvent, KeyModifiers};
use ratatui::layout::Rect;
use serde::Serialize;

use super::unseen::UnseenTerminal;
use crate::explorer::{Explorer, Options, Setting};
use crate::lab::Machine;
use crate::lab::frames::brief;
use crate::method::Method;
use crate::report::{self, DataColumn, Format, Report, Table};
use crate::scene::{Scene, Source};

/// The screens, in columns and rows.
pub(super) const SCREENS: [(u16, u16); 2] = [(80, 24), (200, 60)];

/// The camera goes on with each of these keys for this many steps.
const KEYS: [char; 4] = ['d', 'w', 'a', 's'];
const STEPS: usize = 15;

/// The times of some screens, as programs read them.
#[derive(Debug, Serialize)]
pub(super) struct ScreenTimes {
    rayscope: &'static str,
    machine: Machine,
    complete: bool,
    frames: Vec<ScreenRow>,
}

/// What a camera step takes in the mean: each step's least time of some rounds.
#[derive(Debug, Clone, Serialize)]
struct ScreenRow {
    scene: String,
    spheres: usize,
    width: u16,
    height: u16,
    method: &'static str,
    steps: usize,
    /// To bring picture, reading and panels up to date.
    plan_ms: f64,
    /// To write all of it into cells.
    cells_ms: f64,
    /// To compare the cells with those that are shown and to write the difference, and its bytes.
    encode_ms: f64,
    bytes: usize,
    /// The same by ratatui's own backend.
    ratatui_ms: f64,
    ratatui_bytes: usize,
}

/// What one step took: milliseconds of the four parts, bytes of the two encoders.
#[derive(Debug, Clone, Copy)]
struct StepTimes {
    ms: [f64; 4],
    bytes: [usize; 2],
}

impl ScreenTimes {
    /// Measures a scene by each of the methods on each of the screens. `go_on` is told which row comes, and
    /// asked before each round.
    pub(super) fn measure(
        (scene, source): (&Scene, &Source),
        methods: &[Method],
        rounds: usize,
        mut go_on: impl FnMut(usize, &str) -> bool,
    ) -> Self {
        let mut times = Self {
            rayscope: env!("CARGO_PKG_VERSION"),
            machine: Machine::detect(),
            complete: true,
            frames: Vec::new(),
        };
        for &method in methods {
            for screen in SCREENS {
                let (cols, rows) = screen;
                let name = format!("{}, {cols}×{rows}, {method}", scene.name);
                let mut least: Option<Vec<StepTimes>> = None;
                for _ in 0..rounds {
                    if !go_on(times.frames.len(), &name) {
                        times.complete = false;
                        return times;
                    }
                    let round = walk(scene, source, method, screen);
                    least =
                        Some(least.map_or_else(|| round.clone(), |least| lower(&least, &round)));
                }
                let steps = least.unwrap_or_default();
                times.frames.push(row(scene, method, screen, &steps));
            }
        }
        times
    }

    /// The report in a format.
    pub(super) fn in_format(&self, format: Format) -> String {
        let table = |columns| Table::of(columns, self.frames.iter().cloned());
        let report = || {
            let [hardware, build] = self.machine.sentences();
            let version = self.rayscope;
            Report::new()
                .words(format!(
                    "rayscope {version} bench --frames --explorer: milliseconds and bytes of a camera step"
                ))
                .lines([hardware, build])
                .gap()
                .table(table(&COLUMNS).numbers())
        };
        match format {
            Format::Text => report().text(),
            Format::Markdown => report().markdown(),
            Format::Csv => table(&DATA).csv(),
            Format::Json => report::json(self),
        }
    }
}

/// Each step of the walk that the camera takes.
fn walk(
    scene: &Scene,
    source: &Source,
    method: Method,
    (cols, rows): (u16, u16),
) -> Vec<StepTimes> {
    let options = Options {
        depth: UnseenTerminal::DEPTH,
        ..Options::default()
    };
    let mut explorer = Explorer::new(scene.clone(), source, options);
    // Any method can be chosen in any scene.
    let _ = explorer.set_out(&[Setting::Method(method)]);
    let mut terminal = UnseenTerminal::default();
    let mut cells = [(); 2].map(|()| Buffer::empty(Rect::new(0, 0, cols, rows)));
    let mut step = |key: Option<char>| {
        if let Some(key) = key {
            let key = KeyEvent::new(KeyCode::Char(key), KeyModifiers::NONE);
            explorer.update(&Event::Key(key));
        }
        let [ours, theirs] = &mut cells;
        let prepare = timed(|| explorer.prepare(cols, rows)).0;
        let draw = timed(|| {
            ours.reset();
            explorer.draw(ours);
        });
        theirs.clone_from(ours);
        let (encode, bytes) = timed(|| terminal.paint(ours));
        let (ratatui, ratatui_bytes) = timed(|| terminal.paint_by_ratatui(theirs));
        StepTimes {
            ms: [prepare, draw.0, encode, ratatui],
            bytes: [bytes, ratatui_bytes],
        }
    };
    step(None);
    let keys = KEYS.into_iter().flat_map(|key| [key; STEPS]);
    keys.map(|key| step(Some(key))).collect()
}

/// Milliseconds that something takes, and what comes of it.
fn timed<T>(run: impl FnOnce() -> T) -> (f64, T) {
    let start = Instant::now();
    let result = run();
    (start.elapsed().as_secs_f64() * 1e3, result)
}

/// The lesser times of each step; its bytes are the same.
fn lower(one: &[StepTimes], other: &[StepTimes]) -> Vec<StepTimes> {
    let lesser = |(one, other): (&StepTimes, &StepTimes)| StepTimes {
        ms: [0, 1, 2, 3].map(|i| one.ms[i].min(other.ms[i])),
        bytes: other.bytes,
    };
    one.iter().zip(other).map(lesser).collect()
}

fn row(
    scene: &Scene,
    method: Method,
    (width, height): (u16, u16),
    steps: &[StepTimes],
) -> ScreenRow {
    let count = steps.len().max(1);
    let ms = |i: usize| steps.iter().map(|step| step.ms[i]).sum::<f64>() / count as f64;
    let bytes = |i: usize| steps.iter().map(|step| step.bytes[i]).sum::<usize>() / count;
    ScreenRow {
        scene: scene.name.clone(),
        spheres: scene.bodies.len(),
        width,
        height,
        method: method.name(),
        steps: steps.len(),
        plan_ms: ms(0),
        cells_ms: ms(1),
        encode_ms: ms(2),
        bytes: bytes(0),
        ratatui_ms: ms(3),
        ratatui_bytes: bytes(1),
    }
}

const COLUMNS: [DataColumn<ScreenRow>; 8] = [
    ("screen", |row| format!("{}×{}", row.width, row.height)),
    ("method", |row| row.method.into()),
    ("plan", |row| brief(row.plan_ms)),
    ("cells", |row| brief(row.cells_ms)),
    ("encode", |row| brief(row.encode_ms)),
    ("ratatui", |row| brief(row.ratatui_ms)),
    ("bytes", |row| row.bytes.to_string()),
    ("ratatui's", |row| row.ratatui_bytes.to_string()),
];

const DATA: [DataColumn<ScreenRow>; 12] = [
    ("scene", |row| row.scene.clone()),
    ("spheres", |row| row.spheres.to_string()),
    ("width", |row| row.width.to_string()),
    ("height", |row| row.height.to_string()),
    ("method", |row| row.method.into()),
    ("steps", |row| row.steps.to_string()),
    ("plan_ms", |row| row.plan_ms.to_string()),
    ("cells_ms", |row| row.cells_ms.to_string()),
    ("encode_ms", |row| row.encode_ms.to_string()),
    ("bytes", |row| row.bytes.to_string()),
    ("ratatui_ms", |row| row.ratatui_ms.to_string()),
    ("ratatui_bytes", |row| row.ratatui_bytes.to_string()),
];
