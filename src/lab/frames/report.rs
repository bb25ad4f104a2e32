//! The report of `bench --frames`: a table of 80 columns, Markdown, CSV and JSON.

use std::fmt::Write as _;

use serde::Serialize;

use super::{Report, Row};
use crate::lab::machine::Machine;
use crate::method::Method;
use crate::text::wrap;

/// The report as tables of 80 columns.
pub fn table(report: &Report, machine: &Machine) -> String {
    let mut out = String::new();
    for line in preface(report, machine) {
        out += &(wrap(&line, 80).join("\n") + "\n");
    }
    out += "\nmilliseconds of a frame\n";
    out += &in_columns(&TIMES, &report.rows, times);
    out += "\nwhere they go, with the plan, up to the bytes for a terminal of 256 colours\n";
    out += &in_columns(&PARTS, &report.rows, parts);
    out.push('\n');
    for line in remarks(report) {
        out += &(wrap(&line, 80).join("\n") + "\n");
    }
    out
}

/// The report in Markdown.
pub fn markdown(report: &Report, machine: &Machine) -> String {
    let mut out = preface(report, machine).join("  \n") + "\n\nMilliseconds of a frame:\n\n";
    out += &in_markdown(&TIMES, &report.rows, times);
    out += "\nWhere they go, with the plan, up to the bytes for a terminal of 256 colours:\n\n";
    out += &in_markdown(&PARTS, &report.rows, parts);
    out + "\n" + &remarks(report).join("  \n") + "\n"
}

fn preface(report: &Report, machine: &Machine) -> Vec<String> {
    let Machine {
        cpu,
        threads,
        target,
        compiler,
        flags,
    } = machine;
    vec![
        format!(
            "rayscope {} bench --frames, seed {}, one thread, every sphere moved in each frame, shaded, medians",
            env!("CARGO_PKG_VERSION"),
            report.seed,
        ),
        format!("{cpu}, {threads} threads, {target}"),
        format!("{compiler}, {flags}, {}", dispatch()),
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

const TIMES: [&str; 7] = [
    "spheres",
    "pixels",
    "method",
    "plan",
    "no plan",
    "ratio",
    "one moved",
];

fn times(row: &Row) -> Vec<String> {
    vec![
        row.spheres.to_string(),
        row.size.to_string(),
        row.method.to_string(),
        brief(row.plan_ms),
        row.no_plan_ms.map_or("> 60000".into(), brief),
        row.no_plan_ms.map_or("-".into(), |without| {
            format!("{:.1}", without / row.plan_ms)
        }),
        brief(row.one_moved_ms),
    ]
}

const PARTS: [&str; 9] = [
    "spheres", "pixels", "plan", "rays", "cells", "diff", "encode", "bytes", "covered",
];

fn parts(row: &Row) -> Vec<String> {
    let parts = row.parts;
    let mut out = vec![row.spheres.to_string(), row.size.to_string()];
    let numbers = [
        parts.plan,
        parts.rays,
        parts.cells,
        parts.diff,
        parts.encode,
    ];
    out.extend(numbers.map(brief));
    out.extend([row.bytes.to_string(), row.covered.to_string()]);
    out
}

fn in_columns(heads: &[&str], rows: &[Row], cells: fn(&Row) -> Vec<String>) -> String {
    let rows: Vec<Vec<String>> = rows.iter().map(cells).collect();
    let width = |i: usize| {
        let of_rows = rows.iter().map(|row| row[i].chars().count()).max();
        heads[i].len().max(of_rows.unwrap_or(0))
    };
    let heads = heads.iter().map(|&head| head.to_owned()).collect();
    let mut out = String::new();
    for row in std::iter::once(&heads).chain(&rows) {
        let line: Vec<String> = row
            .iter()
            .enumerate()
            .map(|(i, cell)| format!("{cell:>0$}", width(i)))
            .collect();
        out += &line.join("  ");
        out.push('\n');
    }
    out
}

fn in_markdown(heads: &[&str], rows: &[Row], cells: fn(&Row) -> Vec<String>) -> String {
    let mut out = format!(
        "| {} |\n|{}\n",
        heads.join(" | "),
        "---:|".repeat(heads.len())
    );
    for row in rows {
        // Writing to a string does not fail.
        let _ = writeln!(out, "| {} |", cells(row).join(" | "));
    }
    out
}

/// How the cost grows, and where the plan does not pay.
fn remarks(report: &Report) -> Vec<String> {
    let mut out = Vec::new();
    for method in Method::ALL {
        if let Some(slope) = report.slope(method) {
            out.push(format!(
                "{method}: time grows as (spheres + pixels covered)^{slope:.2}; proportion is 1."
            ));
        }
    }
    let loses: Vec<String> = report
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
    if !report.complete {
        out.push("Interrupted: the remaining rows were not measured.".into());
    }
    out
}

/// Milliseconds with three digits that count, be there few of them.
fn brief(ms: f64) -> String {
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
struct Entry {
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
    covered: u64,
    pays: bool,
}

impl From<&Row> for Entry {
    fn from(row: &Row) -> Self {
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
            covered: row.covered,
            pays: row.pays(),
        }
    }
}

#[derive(Debug, Serialize)]
struct Document<'a> {
    rayscope: &'static str,
    machine: &'a Machine,
    vectors: &'static str,
    seed: u64,
    complete: bool,
    slopes: Vec<Slope>,
    frames: Vec<Entry>,
}

#[derive(Debug, Serialize)]
struct Slope {
    method: &'static str,
    slope: f64,
}

/// The report as one JSON object.
pub fn json(report: &Report, machine: &Machine) -> serde_json::Result<String> {
    let slope = |method: Method| {
        let slope = report.slope(method)?;
        let method = method.name();
        Some(Slope { method, slope })
    };
    let document = Document {
        rayscope: env!("CARGO_PKG_VERSION"),
        machine,
        vectors: dispatch(),
        seed: report.seed,
        complete: report.complete,
        slopes: Method::ALL.into_iter().filter_map(slope).collect(),
        frames: report.rows.iter().map(Entry::from).collect(),
    };
    Ok(serde_json::to_string_pretty(&document)? + "\n")
}

/// The rows as CSV; an empty `no_plan_ms` would take over a minute.
pub fn csv(report: &Report) -> Result<String, Box<dyn std::error::Error>> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in &report.rows {
        writer.serialize(Entry::from(row))?;
    }
    Ok(String::from_utf8(writer.into_inner()?)?)
}
