//! The work–precision chart: time for one solve against its error, a panel for each set of rays.

use super::svg::{Stroke, Svg, TextAnchor};
use super::{INK, Plot, legend, look, power_label};
use crate::lab::bench::Benchmark;
use crate::lab::bench::text::percent;
use crate::lab::chart::{ChartAxes, ErrorAxis, Scale, WorkPoint, best, work_points};
use crate::lab::errors::nearest_rank;
use crate::lab::machine::Machine;

const COLUMNS: usize = 3;
const PANEL: [f64; 2] = [320.0, 230.0];
/// Room around a panel: left and right together, above and below together.
const GAP: [f64; 2] = [72.0, 68.0];
const LEFT: f64 = 58.0;
const TOP: f64 = 112.0;
/// The width of the lines above the panels.
const HEADER: f64 = 960.0;
/// The height of a line of text below the panels.
const NOTE: f64 = 14.0;

/// The chart of a report as an SVG document: all sets in one panel if there are several, then each in its own.
pub fn work_precision(report: &Benchmark, machine: &Machine, axes: ChartAxes) -> String {
    chart(report, machine, axes, &[])
}

/// The chart of graded answers as an SVG document, with lines of text below it.
pub fn graded(report: &Benchmark, machine: &Machine, notes: &[&str]) -> String {
    chart(report, machine, ChartAxes::default(), notes)
}

fn chart(report: &Benchmark, machine: &Machine, axes: ChartAxes, notes: &[&str]) -> String {
    let sets: Vec<Vec<WorkPoint>> = report
        .sets
        .iter()
        .map(|set| work_points(set, axes))
        .collect();
    let overviews = usize::from(sets.len() > 1);
    let panels = overviews + sets.len();
    let columns = panels.clamp(1, COLUMNS);
    let width = (LEFT + columns as f64 * (PANEL[0] + GAP[0]) - 20.0).max(HEADER);
    let below = TOP + panels.div_ceil(COLUMNS) as f64 * (PANEL[1] + GAP[1]);
    let height = below + NOTE * notes.len() as f64;
    let mut svg = Svg::new(width, height, "Error against run time");
    header(&mut svg, report, machine);
    let times = span(&sets);
    let panel = |i: usize| Plot {
        at: [
            LEFT + (i % COLUMNS) as f64 * (PANEL[0] + GAP[0]),
            TOP + (i / COLUMNS) as f64 * (PANEL[1] + GAP[1]),
        ],
        size: PANEL,
        x: errors(axes.x),
        y: times,
    };
    if overviews > 0 {
        overview(&mut svg, &panel(0), &sets, axes);
    }
    for (i, (set, points)) in report.sets.iter().zip(sets).enumerate() {
        let title = format!("{}, {} rays", set.name, set.census.rays);
        let panel = panel(overviews + i);
        frame(&mut svg, &panel, &title, axes);
        draw(&mut svg, &panel, points, set.census.rays);
    }
    for (i, note) in notes.iter().enumerate() {
        let at = [16.0, below + NOTE * i as f64];
        svg.fixed(at, note, 10.0, INK);
    }
    svg.finish()
}

/// The errors that a chart spans: as log₂ ulp from a quarter of an ulp to nothing left, and room
/// for the methods that have no right answer; or all per cent.
const fn errors(axis: ErrorAxis) -> Scale {
    match axis {
        ErrorAxis::Wrong => Scale::new(-4.0, 104.0),
        _ => Scale::new(-2.0, 36.0),
    }
}

/// Where those stand.
const NONE_RIGHT: f64 = 35.0;

fn header(svg: &mut Svg, report: &Benchmark, machine: &Machine) {
    let title = "Error against run time: the lower left is best";
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
    let made = format!("{cpu}; {compiler}, {flags}; seed {}{trusted}.", report.seed);
    svg.text([16.0, 42.0], &made, 11.0, INK, TextAnchor::Start);
    let labels = "Labels: wrong hit-or-miss / wrong count (/ no number) in per cent of the rays. Bars: from \
        quartile to quartile. Grey: Pareto line, through methods that are told apart.";
    svg.text([16.0, 58.0], labels, 11.0, INK, TextAnchor::Start);
    let first = report.sets.first();
    let methods: Vec<&str> =
        first.map_or(Vec::new(), |c| c.rows.iter().map(|r| r.method).collect());
    legend(svg, [16.0, 78.0], &methods);
}

/// log₂ of the shortest and the longest time, in whole steps of a factor of 10^(1/2).
fn span(sets: &[Vec<WorkPoint>]) -> Scale {
    let half_decade = 10_f64.log2() / 2.0;
    let times = sets.iter().flatten().map(|p| p.time);
    let (least, most) = times.fold((f64::INFINITY, 0.0_f64), |(l, m), t| (l.min(t), m.max(t)));
    let [least, most] = [least.min(most), most].map(|time| time / half_decade);
    Scale::new(
        (least - 0.2).floor() * half_decade,
        (most + 0.2).ceil() * half_decade,
    )
}

/// The axes of a panel with their titles.
fn frame(svg: &mut Svg, panel: &Plot, title: &str, axes: ChartAxes) {
    panel.rules(svg, &time_ticks(panel.y));
    let ticks: Vec<(f64, String)> = if axes.x == ErrorAxis::Wrong {
        [0, 25, 50, 75, 100]
            .map(|k| (f64::from(k), k.to_string()))
            .into()
    } else {
        let powers = [-1, 4, 9, 14, 19, 24, 29].map(|k| (f64::from(k), power_label(k)));
        powers
            .into_iter()
            .chain([(NONE_RIGHT, "none right".into())])
            .collect()
    };
    panel.columns(svg, &ticks);
    panel.title(svg, title);
    let [x, y] = panel.at;
    svg.text_upwards([x - 42.0, y + PANEL[1] / 2.0], axes.y.title(), 10.0, INK);
    let below = [x + PANEL[0] / 2.0, y + PANEL[1] + 28.0];
    svg.text(below, axes.x.title(), 10.0, INK, TextAnchor::Middle);
}

/// Each method once: the median over the sets, and bars from quartile to quartile of the sets.
fn overview(svg: &mut Svg, panel: &Plot, sets: &[Vec<WorkPoint>], axes: ChartAxes) {
    let title = format!("overview: medians over {} sets of rays", sets.len());
    frame(svg, panel, &title, axes);
    let methods = sets.first().into_iter().flatten().map(|point| point.method);
    for method in methods {
        let points = sets.iter().flatten().filter(|point| point.method == method);
        let quartiles = |value: &dyn Fn(&WorkPoint) -> f64| {
            let mut values: Vec<f64> = points.clone().map(value).collect();
            values.sort_by(f64::total_cmp);
            [1, 2, 3].map(|n| nearest_rank(&values, n, 4))
        };
        let [left, x, right] = quartiles(&|point| point.error.unwrap_or(NONE_RIGHT));
        let [low, y, high] = quartiles(&|point| point.time);
        let (color, marker) = look(method);
        let bar = Stroke::solid(color, 1.2);
        svg.line(panel.place(left, y), panel.place(right, y), bar);
        svg.line(panel.place(x, low), panel.place(x, high), bar);
        let at = panel.place(x, y);
        svg.marker(at, marker, color);
        let beside = [at[0] + 7.0, at[1] - 5.0];
        svg.label(beside, method, text_color(method), TextAnchor::Start);
    }
}

fn draw(svg: &mut Svg, panel: &Plot, points: Vec<WorkPoint>, rays: usize) {
    let line: Vec<[f64; 2]> = best(&points).iter().map(|p| place(panel, p)).collect();
    if line.len() > 1 {
        svg.polyline(&line, Stroke::solid("#d0d0d0", 5.0));
    }
    for point in &points {
        let (color, marker) = look(point.method);
        let x = point.error.unwrap_or(NONE_RIGHT);
        let bar = point.spread.map(|time| panel.place(x, time));
        svg.line(bar[0], bar[1], Stroke::solid(color, 1.2));
        svg.marker(place(panel, point), marker, color);
    }
    labels(svg, panel, points, &line, rays);
}

/// The rates of a point's wrong answers: hit-or-miss, count, and no number where there is any.
fn rates(point: &WorkPoint, rays: usize) -> String {
    let [hit_or_miss, count, none] = point.wrong;
    let rate = |wrong: usize| percent(wrong, rays).replace(" %", "").replace("0.0", "0");
    match [hit_or_miss, count, none] {
        [0, 0, 0] => "0 wrong".to_owned(),
        [.., 0] => format!("{}/{} %", rate(hit_or_miss), rate(count)),
        _ => format!("{}/{}/{} %", rate(hit_or_miss), rate(count), rate(none)),
    }
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
        let wrong = rates(&point, rays);
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
        "exact" => "#000000",
        _ => "#5d3a9b",
    }
}
