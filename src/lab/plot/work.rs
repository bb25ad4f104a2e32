//! The work–precision chart: time for one solve against its error, a panel for each set of rays.

use super::svg::{Anchor, Stroke, Svg};
use super::{INK, Panel, legend, look, power_label};
use crate::lab::bench::text::percent;
use crate::lab::bench::{Chapter, Report, Row};
use crate::lab::machine::Machine;

const COLUMNS: usize = 3;
const PANEL: [f64; 2] = [320.0, 170.0];
/// Room around a panel: left and right together, above and below together.
const GAP: [f64; 2] = [72.0, 52.0];
const LEFT: f64 = 58.0;
const TOP: f64 = 96.0;

/// The errors that the chart spans, as log₂ ulp: from a quarter of an ulp to nothing left, and room
/// for the methods that have no right answer.
const ERRORS: [f64; 2] = [-2.0, 36.0];

/// Where those stand.
const NONE_RIGHT: f64 = 35.0;

/// The chart of a report as an SVG document.
pub fn work_precision(report: &Report, machine: &Machine) -> String {
    let rows = report.chapters.len().div_ceil(COLUMNS);
    let columns = report.chapters.len().clamp(2, COLUMNS);
    let width = LEFT + columns as f64 * (PANEL[0] + GAP[0]) - 20.0;
    let height = TOP + rows as f64 * (PANEL[1] + GAP[1]);
    let mut svg = Svg::new(width, height, "Error against run time");
    header(&mut svg, report, machine);
    let times = span(report);
    for (i, chapter) in report.chapters.iter().enumerate() {
        let panel = Panel {
            at: [
                LEFT + (i % COLUMNS) as f64 * (PANEL[0] + GAP[0]),
                TOP + (i / COLUMNS) as f64 * (PANEL[1] + GAP[1]),
            ],
            size: PANEL,
            x: ERRORS,
            y: times,
        };
        draw(&mut svg, &panel, chapter);
    }
    svg.finish()
}

fn header(svg: &mut Svg, report: &Report, machine: &Machine) {
    let title = "Error (99th percentile, in ulp) against the time of one solve (ns): the lower left is best";
    svg.text([16.0, 24.0], title, 16.0, "#000000", Anchor::Start);
    let Machine {
        cpu,
        compiler,
        flags,
        ..
    } = machine;
    let trusted = if report.times_trusted() {
        ""
    } else {
        "; TIMES NOT TRUSTED"
    };
    let made = format!(
        "{cpu}; {compiler}, {flags}; seed {}{trusted}. Labels: rate of wrong answers. Grey: Pareto line.",
        report.seed
    );
    svg.text([16.0, 42.0], &made, 11.0, INK, Anchor::Start);
    let first = report.chapters.first();
    let methods: Vec<&str> =
        first.map_or(Vec::new(), |c| c.rows.iter().map(|r| r.method).collect());
    legend(svg, [16.0, 62.0], &methods);
}

/// log₁₀ of the shortest and the longest time, in whole steps of a factor of 10^(1/2).
fn span(report: &Report) -> [f64; 2] {
    let times = report
        .chapters
        .iter()
        .flat_map(|chapter| &chapter.rows)
        .map(log_time);
    let (least, most) = times.fold((f64::INFINITY, 0.0_f64), |(l, m), t| (l.min(t), m.max(t)));
    let [least, most] = [least.min(most), most];
    [
        (2.0 * least - 0.2).floor() / 2.0,
        (2.0 * most + 0.2).ceil() / 2.0,
    ]
}

fn log_time(row: &Row) -> f64 {
    row.times.throughput.median.max(0.1).log10()
}

fn draw(svg: &mut Svg, panel: &Panel, chapter: &Chapter) {
    panel.rules(svg, &time_ticks(panel.y));
    let mut ticks: Vec<(f64, String)> = [-1, 4, 9, 14, 19, 24, 29]
        .map(|k| (f64::from(k), power_label(k)))
        .into();
    ticks.push((NONE_RIGHT, "none right".into()));
    panel.columns(svg, &ticks);
    let rays = chapter.census.rays;
    panel.title(svg, &format!("{}, {rays} rays", chapter.name));
    let [x, y] = panel.at;
    svg.text_upwards([x - 42.0, y + PANEL[1] / 2.0], "ns", 10.0, INK);
    pareto_line(svg, panel, chapter);
    for row in &chapter.rows {
        let (color, marker) = look(row.method);
        svg.marker(point(panel, row), marker, color);
    }
    labels(svg, panel, chapter);
}

fn time_ticks([least, most]: [f64; 2]) -> Vec<(f64, String)> {
    let marks = [
        1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1e3, 2e3, 5e3, 1e4,
    ];
    marks
        .into_iter()
        .map(|ns: f64| (ns.log10(), ns.to_string()))
        .filter(|(log, _)| (least..=most).contains(log))
        .collect()
}

fn point(panel: &Panel, row: &Row) -> [f64; 2] {
    panel.place(error(row), log_time(row))
}

/// log₂ of the error.
fn error(row: &Row) -> f64 {
    if row.errors.judged == 0 {
        return NONE_RIGHT;
    }
    row.errors.ulp.p99.max(1e-3).log2()
}

/// Through the methods that no other dominates, by their error.
fn pareto_line(svg: &mut Svg, panel: &Panel, chapter: &Chapter) {
    let mut best: Vec<[f64; 2]> = chapter
        .rows
        .iter()
        .filter(|row| row.pareto && row.errors.judged > 0)
        .map(|row| point(panel, row))
        .collect();
    best.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    if best.len() > 1 {
        svg.polyline(&best, Stroke::solid("#d0d0d0", 5.0));
    }
}

/// The rate of wrong answers beside each point, higher where another label is in the way.
fn labels(svg: &mut Svg, panel: &Panel, chapter: &Chapter) {
    let rays = chapter.census.rays;
    let mut rows: Vec<&Row> = chapter.rows.iter().collect();
    rows.sort_by(|a, b| log_time(a).total_cmp(&log_time(b)));
    let mut placed: Vec<[f64; 2]> = Vec::new();
    for row in rows {
        let [x, y] = point(panel, row);
        let right_half = x > panel.at[0] + 0.72 * PANEL[0];
        let (left, anchor) = if right_half {
            (x - 9.0 - LABEL[0], Anchor::End)
        } else {
            (x + 9.0, Anchor::Start)
        };
        let mut at = [left, y];
        while placed.iter().any(|other| overlap(*other, at)) {
            at[1] -= 1.0;
        }
        placed.push(at);
        let wrong = match row.errors.wrong.total() {
            0 => "0 wrong".to_owned(),
            wrong => format!("{} wrong", percent(wrong, rays)),
        };
        let (color, _) = look(row.method);
        let edge = if right_half { left + LABEL[0] } else { left };
        svg.label([edge, at[1] + 3.5], &wrong, color, anchor);
    }
}

/// Width and height of a label.
const LABEL: [f64; 2] = [68.0, 11.0];

fn overlap(one: [f64; 2], other: [f64; 2]) -> bool {
    (one[0] - other[0]).abs() < LABEL[0] && (one[1] - other[1]).abs() < LABEL[1]
}
