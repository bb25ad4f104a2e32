//! The work–precision chart: time for one solve against its error, a panel for each set of rays.

use super::svg::{Stroke, Svg, TextAnchor};
use super::{INK, Plot, legend, look, power_label};
use crate::lab::bench::text::percent;
use crate::lab::bench::{Benchmark, MeasuredSet};
use crate::lab::chart::{Scale, WorkPoint, best, work_points};
use crate::lab::machine::Machine;

const COLUMNS: usize = 3;
const PANEL: [f64; 2] = [320.0, 210.0];
/// Room around a panel: left and right together, above and below together.
const GAP: [f64; 2] = [72.0, 52.0];
const LEFT: f64 = 58.0;
const TOP: f64 = 96.0;

/// The errors that the chart spans, as log₂ ulp: from a quarter of an ulp to nothing left, and room
/// for the methods that have no right answer.
const ERRORS: Scale = Scale::new(-2.0, 36.0);

/// Where those stand.
const NONE_RIGHT: f64 = 35.0;

/// The chart of a report as an SVG document.
pub fn work_precision(report: &Benchmark, machine: &Machine) -> String {
    let rows = report.sets.len().div_ceil(COLUMNS);
    let columns = report.sets.len().clamp(2, COLUMNS);
    let width = LEFT + columns as f64 * (PANEL[0] + GAP[0]) - 20.0;
    let height = TOP + rows as f64 * (PANEL[1] + GAP[1]);
    let mut svg = Svg::new(width, height, "Error against run time");
    header(&mut svg, report, machine);
    let times = span(report);
    for (i, set) in report.sets.iter().enumerate() {
        let panel = Plot {
            at: [
                LEFT + (i % COLUMNS) as f64 * (PANEL[0] + GAP[0]),
                TOP + (i / COLUMNS) as f64 * (PANEL[1] + GAP[1]),
            ],
            size: PANEL,
            x: ERRORS,
            y: times,
        };
        draw(&mut svg, &panel, set);
    }
    svg.finish()
}

fn header(svg: &mut Svg, report: &Benchmark, machine: &Machine) {
    let title = "Error (99th percentile, in ulp) against the time of one solve (ns): the lower left is best";
    svg.text([16.0, 24.0], title, 16.0, "#000000", TextAnchor::Start);
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
    svg.text([16.0, 42.0], &made, 11.0, INK, TextAnchor::Start);
    let first = report.sets.first();
    let methods: Vec<&str> =
        first.map_or(Vec::new(), |c| c.rows.iter().map(|r| r.method).collect());
    legend(svg, [16.0, 62.0], &methods);
}

/// log₂ of the shortest and the longest time, in whole steps of a factor of 10^(1/2).
fn span(report: &Benchmark) -> Scale {
    let half_decade = 10_f64.log2() / 2.0;
    let times = report.sets.iter().flat_map(work_points).map(|p| p.time);
    let (least, most) = times.fold((f64::INFINITY, 0.0_f64), |(l, m), t| (l.min(t), m.max(t)));
    let [least, most] = [least.min(most), most].map(|time| time / half_decade);
    Scale::new(
        (least - 0.2).floor() * half_decade,
        (most + 0.2).ceil() * half_decade,
    )
}

fn draw(svg: &mut Svg, panel: &Plot, set: &MeasuredSet) {
    panel.rules(svg, &time_ticks(panel.y));
    let mut ticks: Vec<(f64, String)> = [-1, 4, 9, 14, 19, 24, 29]
        .map(|k| (f64::from(k), power_label(k)))
        .into();
    ticks.push((NONE_RIGHT, "none right".into()));
    panel.columns(svg, &ticks);
    let rays = set.census.rays;
    panel.title(svg, &format!("{}, {rays} rays", set.name));
    let [x, y] = panel.at;
    svg.text_upwards([x - 42.0, y + PANEL[1] / 2.0], "ns", 10.0, INK);
    let points = work_points(set);
    let line: Vec<[f64; 2]> = best(&points).iter().map(|p| place(panel, p)).collect();
    if line.len() > 1 {
        svg.polyline(&line, Stroke::solid("#d0d0d0", 5.0));
    }
    for point in &points {
        let (color, marker) = look(point.method);
        svg.marker(place(panel, point), marker, color);
    }
    labels(svg, panel, points, &line, rays);
}

fn time_ticks(scale: Scale) -> Vec<(f64, String)> {
    let marks = [
        1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1e3, 2e3, 5e3, 1e4,
    ];
    marks
        .into_iter()
        .map(|ns: f64| (ns.log2(), ns.to_string()))
        .filter(|&(log, _)| scale.contains(log))
        .collect()
}

fn place(panel: &Plot, point: &WorkPoint) -> [f64; 2] {
    panel.place(point.error.unwrap_or(NONE_RIGHT), point.time)
}

/// The rate of wrong answers beside each point, where it covers neither a point nor a line nor
/// another label; a thin line leads to one that is not right beside its point.
fn labels(svg: &mut Svg, panel: &Plot, mut points: Vec<WorkPoint>, line: &[[f64; 2]], rays: usize) {
    let mut taken: Vec<Area> = points.iter().map(|p| around(place(panel, p))).collect();
    for pair in line.windows(2) {
        taken.extend(along(pair[0], pair[1]));
    }
    points.sort_by(|a, b| a.time.total_cmp(&b.time));
    for point in points {
        let wrong = match point.wrong {
            0 => "0 wrong".to_owned(),
            wrong => format!("{} wrong", percent(wrong, rays)),
        };
        let at = place(panel, &point);
        let area = free_area(panel, at, 5.6 * wrong.chars().count() as f64, &taken);
        taken.push(area);
        let Area { left, top, .. } = area;
        let (color, _) = look(point.method);
        let to_the_right = left > at[0];
        let edge = if to_the_right {
            left
        } else {
            left + area.width
        };
        let middle = top + area.height / 2.0;
        if (middle - at[1]).abs() > area.height || (edge - at[0]).abs() > 2.0 * BESIDE {
            let towards = if to_the_right { -1.0 } else { 1.0 };
            svg.line(at, [edge + towards, middle], Stroke::solid(color, 0.8));
        }
        let anchor = if to_the_right {
            TextAnchor::Start
        } else {
            TextAnchor::End
        };
        svg.label(
            [edge, middle + 3.5],
            &wrong,
            text_color(point.method),
            anchor,
        );
    }
}

/// A rectangle that is taken.
#[derive(Debug, Clone, Copy)]
struct Area {
    left: f64,
    top: f64,
    width: f64,
    height: f64,
}

impl Area {
    fn overlaps(&self, other: &Self) -> bool {
        let apart = |a: f64, size_a: f64, b: f64, size_b: f64| a + size_a <= b || b + size_b <= a;
        !apart(self.left, self.width, other.left, other.width)
            && !apart(self.top, self.height, other.top, other.height)
    }
}

/// Height of a label, and how far it stands from its point.
const LABEL_HEIGHT: f64 = 11.0;
const BESIDE: f64 = 8.0;

/// What a marker covers.
fn around([x, y]: [f64; 2]) -> Area {
    let size = 9.0;
    Area {
        left: x - size / 2.0,
        top: y - size / 2.0,
        width: size,
        height: size,
    }
}

/// What a line covers, in small pieces.
fn along(from: [f64; 2], to: [f64; 2]) -> impl Iterator<Item = Area> {
    let length = (to[0] - from[0]).hypot(to[1] - from[1]);
    let pieces = (length / 4.0).ceil().max(1.0);
    (0..=pieces as u32).map(move |i| {
        let part = f64::from(i) / pieces;
        Area {
            left: from[0] + part * (to[0] - from[0]) - 2.0,
            top: from[1] + part * (to[1] - from[1]) - 2.0,
            width: 4.0,
            height: 4.0,
        }
    })
}

/// The free place for a label that is nearest to its point; beside it, if all are taken.
fn free_area(panel: &Plot, [x, y]: [f64; 2], width: f64, taken: &[Area]) -> Area {
    let [x0, y0] = panel.at;
    let place = |dx: f64, dy: f64| Area {
        left: if dx > 0.0 { x + dx } else { x + dx - width },
        top: y + dy - LABEL_HEIGHT / 2.0,
        width,
        height: LABEL_HEIGHT,
    };
    let inside = |a: &Area| {
        a.left >= x0 + 2.0
            && a.left + a.width <= x0 + PANEL[0] + 30.0
            && a.top >= y0
            && a.top + a.height <= y0 + PANEL[1]
    };
    let far = (0..12).map(|i| BESIDE + 8.0 * f64::from(i));
    let places = far.flat_map(|dx| {
        let up_and_down = (0..120).flat_map(|i| [-f64::from(i), f64::from(i)]);
        up_and_down.flat_map(move |dy| [(dx, dy), (-dx, dy)])
    });
    let free = places
        .map(|(dx, dy)| (dx.abs() + dy.abs(), place(dx, dy)))
        .filter(|(_, a)| inside(a) && !taken.iter().any(|other| a.overlaps(other)))
        .min_by(|(one, _), (other, _)| one.total_cmp(other));
    free.map_or_else(|| place(BESIDE, 0.0), |(_, area)| area)
}

/// The colour of a method, dark enough for small letters on white.
fn text_color(method: &str) -> &'static str {
    match method {
        "textbook" => "#b34e00",
        "contracted" => "#1f6fa5",
        "unit" => "#666666",
        "citardauq" => "#946600",
        "haines" => "#007d5b",
        "kahan" => "#a3507d",
        "double" => "#005f94",
        _ => "#000000",
    }
}
