//! The stability chart: for each dial the bits that every method loses, and its wrong answers.

use super::svg::{Marker, Stroke, Svg, TextAnchor};
use super::{INK, Plot, legend, look, power_label};
use crate::lab::chart::{BITS, DialPoint, Scale, dial_points};
use crate::lab::stress::{Stability, Sweep, bits_lost};

const COLUMNS: usize = 2;
const BITS_SIZE: [f64; 2] = [420.0, 150.0];
const RATES: f64 = 60.0;
const GAP: [f64; 2] = [70.0, 64.0];
const LEFT: f64 = 62.0;
const TOP: f64 = 92.0;

/// The chart of a report as an SVG document.
pub fn stability(report: &Stability) -> String {
    let rows = report.sweeps.len().div_ceil(COLUMNS);
    let columns = report.sweeps.len().clamp(1, COLUMNS);
    let height_of_one = BITS_SIZE[1] + RATES + GAP[1];
    let width = (LEFT + columns as f64 * (BITS_SIZE[0] + GAP[0])).max(760.0) - 20.0;
    let height = TOP + rows as f64 * height_of_one;
    let mut svg = Svg::new(width, height, "Bits lost against each dial");
    header(&mut svg, report);
    for (i, sweep) in report.sweeps.iter().enumerate() {
        let at = [
            LEFT + (i % COLUMNS) as f64 * (BITS_SIZE[0] + GAP[0]),
            TOP + (i / COLUMNS) as f64 * height_of_one,
        ];
        draw(&mut svg, at, report, sweep);
    }
    svg.finish()
}

fn header(svg: &mut Svg, report: &Stability) {
    let title = "Stability: bits lost (of 24, the worst of each setting) and wrong answers";
    svg.text([16.0, 24.0], title, 16.0, "#000000", TextAnchor::Start);
    let note = format!(
        "{} rays a setting, seed {}; dashed from the first wrong answer on, which × marks; lines that coincide are nested",
        report.rays, report.seed
    );
    svg.text([16.0, 42.0], &note, 11.0, INK, TextAnchor::Start);
    let methods: Vec<&str> = report.methods.iter().map(|method| method.name()).collect();
    legend(svg, [16.0, 62.0], &methods);
}

fn draw(svg: &mut Svg, at: [f64; 2], report: &Stability, sweep: &Sweep) {
    let Some((first, last)) = sweep.steps.first().zip(sweep.steps.last()) else {
        return;
    };
    let x = Scale::new(f64::from(first.k), f64::from(last.k));
    let bits = Plot {
        at,
        size: BITS_SIZE,
        x,
        y: BITS,
    };
    let rates = Plot {
        at: [at[0], at[1] + BITS_SIZE[1] + 12.0],
        size: [BITS_SIZE[0], RATES],
        x,
        y: Scale::new(0.0, 1.0),
    };
    frame(svg, &bits, &rates, sweep);
    let methods = report.methods.iter().enumerate();
    let curves: Vec<_> = methods
        .map(|(i, method)| (look(method.name()), dial_points(sweep, i)))
        .collect();
    for (i, ((color, _), points)) in curves.iter().enumerate() {
        // The later methods are thinner, and show those that they cover.
        let width = 5.5 - 4.0 * i as f64 / (curves.len() - 1).max(1) as f64;
        let stroke = Stroke::solid(color, width);
        let wrong: Vec<[f64; 2]> = points
            .iter()
            .map(|p| rates.place(f64::from(p.k), p.wrong))
            .collect();
        svg.polyline(&wrong, stroke);
        bits_line(svg, &bits, stroke, points);
    }
    inputs_line(svg, &bits, sweep);
    for (i, ((color, marker), points)) in curves.iter().enumerate() {
        mark(svg, &bits, points, i, *marker, color);
    }
}

fn frame(svg: &mut Svg, bits: &Plot, rates: &Plot, sweep: &Sweep) {
    let dial = sweep.dial;
    let name = |v: f64| (v, format!("{v:.0}"));
    bits.rules(svg, &[0.0, 6.0, 12.0, 18.0, 24.0].map(name));
    rates.rules(
        svg,
        &[0.0, 0.5, 1.0].map(|v| (v, format!("{:.0}", 100.0 * v))),
    );
    let steps = sweep.steps.len();
    let every = steps.div_ceil(8).max(1);
    let ticks: Vec<(f64, String)> = sweep
        .steps
        .iter()
        .step_by(every)
        .map(|step| (f64::from(step.k), power_label(step.k)))
        .collect();
    bits.columns(
        svg,
        &ticks
            .iter()
            .map(|(k, _)| (*k, String::new()))
            .collect::<Vec<_>>(),
    );
    rates.columns(svg, &ticks);
    bits.title(svg, &format!("{}: {}", dial.name, dial.quantity));
    let beside = |panel: &Plot| [panel.at[0] - 34.0, panel.at[1] + panel.size[1] / 2.0];
    svg.text_upwards(beside(bits), "bits lost", 10.0, INK);
    svg.text_upwards(beside(rates), "% wrong", 10.0, INK);
}

/// Solid up to the first wrong answer, dashed from there; it ends where no answer has an error.
fn bits_line(svg: &mut Svg, panel: &Plot, stroke: Stroke, points: &[DialPoint]) {
    let told = points.iter().map_while(|p| Some((p, p.bits?)));
    let mut sound = Vec::new();
    let mut unsound = Vec::new();
    for (point, bits) in told {
        let at = panel.place(f64::from(point.k), bits);
        if unsound.is_empty() && point.wrong == 0.0 {
            sound.push(at);
        } else {
            if unsound.is_empty() {
                unsound.extend(sound.last().copied());
            }
            unsound.push(at);
        }
    }
    svg.polyline(&sound, stroke);
    if !unsound.is_empty() {
        let width = stroke.width.min(2.5);
        svg.polyline(
            &unsound,
            Stroke {
                width,
                dashed: true,
                ..stroke
            },
        );
    }
}

/// What rounding the inputs cost, where the dial is about that.
fn inputs_line(svg: &mut Svg, panel: &Plot, sweep: &Sweep) {
    let line: Vec<[f64; 2]> = sweep
        .steps
        .iter()
        .filter_map(|step| {
            let worst = bits_lost(step.inputs?.ulp.max);
            Some(panel.place(f64::from(step.k), worst))
        })
        .collect();
    if let Some(&[x, y]) = line.get(line.len() / 2) {
        let stroke = Stroke {
            color: "#888888",
            width: 2.0,
            dashed: true,
        };
        svg.polyline(&line, stroke);
        let label = "rounding p0, d, c, r, before any method";
        svg.text([x - 8.0, y - 6.0], label, 10.0, INK, TextAnchor::End);
    }
}

/// The method's marker on its line, and a cross at its first wrong answer.
fn mark(
    svg: &mut Svg,
    panel: &Plot,
    points: &[DialPoint],
    method: usize,
    marker: Marker,
    color: &'static str,
) {
    let at = |point: &DialPoint, bits| panel.place(f64::from(point.k), bits);
    // Each method has a place of its own along the dial, so that markers do not cover each other.
    let quarter = points.len() / 8 + method * points.len() / 40;
    if let Some(point) = points.get(quarter)
        && let Some(bits) = point.bits
    {
        svg.marker(at(point, bits), marker, color);
    }
    if let Some(point) = points.iter().find(|p| p.wrong > 0.0) {
        let [x, y] = at(point, point.bits.unwrap_or(BITS.last));
        let stroke = Stroke::solid(color, 2.0);
        svg.line([x - 5.0, y - 5.0], [x + 5.0, y + 5.0], stroke);
        svg.line([x - 5.0, y + 5.0], [x + 5.0, y - 5.0], stroke);
    }
}
