//! A stress report for programs: JSON and CSV. docs/stability.md lists the fields and columns.

use serde::Serialize;

use super::theory::agree;
use super::{Cell, Report};
use crate::lab::Problem;
use crate::lab::errors::{Percentiles, Wrong};
use crate::lab::numbers;
use crate::text::hexadecimal;

#[derive(Serialize)]
struct Document {
    rayscope: &'static str,
    seed: u64,
    rays: usize,
    complete: bool,
    checksum: String,
    promises_kept: bool,
    promises: Vec<Promise>,
    breakdowns: Vec<Breakdown>,
    checks: Vec<Check>,
    settings: Vec<Setting>,
    inputs: Vec<Inputs>,
}

/// What rounding the inputs of one setting did, in ulp of the exact roots.
#[derive(Serialize)]
struct Inputs {
    dial: &'static str,
    k: i32,
    rays: usize,
    changed: usize,
    ulp: Percentiles,
}

#[derive(Serialize)]
struct Promise {
    method: &'static str,
    asked: usize,
    broken: usize,
    first: Option<[String; 10]>,
}

#[derive(Serialize)]
struct Breakdown {
    dial: &'static str,
    quantity: &'static str,
    method: &'static str,
    wrong: Place,
    moved: Place,
}

/// Exponents of 2; null for never.
#[derive(Serialize)]
struct Place {
    found: Option<i32>,
    theory: Option<f64>,
    agree: bool,
}

#[derive(Serialize)]
struct Check {
    name: &'static str,
    method: &'static str,
    rays: usize,
    failed: usize,
    passed: bool,
    first: Option<[String; 10]>,
}

#[derive(Serialize)]
struct Setting {
    dial: &'static str,
    k: i32,
    method: &'static str,
    rays: usize,
    miss: usize,
    meet: usize,
    wrong: Wrong,
    wrong_rate: f64,
    judged: usize,
    ulp: Percentiles,
    bits_lost: Bits,
    blame: Percentiles,
    moved: usize,
}

#[derive(Serialize)]
struct Bits {
    median: Option<f64>,
    worst: Option<f64>,
}

fn input(problem: &Problem) -> [String; 10] {
    numbers(problem).map(hexadecimal)
}

fn settings(report: &Report) -> impl Iterator<Item = Setting> {
    report.sweeps.iter().flat_map(move |sweep| {
        sweep.steps.iter().flat_map(move |step| {
            let one = move |(method, cell): (&crate::method::Method, &Cell)| {
                let errors = &cell.errors;
                let wrong = errors.wrong;
                Setting {
                    dial: sweep.dial.name,
                    k: step.k,
                    method: method.name(),
                    rays: step.census.rays,
                    miss: step.census.miss,
                    meet: step.census.meet(),
                    wrong,
                    wrong_rate: wrong.total() as f64 / step.census.rays as f64,
                    judged: errors.judged,
                    ulp: errors.ulp,
                    bits_lost: Bits {
                        median: cell.bits_median(),
                        worst: cell.bits_worst(),
                    },
                    blame: cell.blame,
                    moved: cell.moved,
                }
            };
            report.methods.iter().zip(&step.cells).map(one)
        })
    })
}

fn breakdowns(report: &Report) -> impl Iterator<Item = Breakdown> {
    report.sweeps.iter().flat_map(move |sweep| {
        report.methods.iter().enumerate().map(move |(i, method)| {
            let at = report.breakdown(sweep, i);
            let place = |found, theory| Place {
                found,
                theory,
                agree: agree(found, theory, sweep.dial.step()),
            };
            Breakdown {
                dial: sweep.dial.name,
                quantity: sweep.dial.quantity,
                method: method.name(),
                wrong: place(at.wrong, at.wrong_in_theory),
                moved: place(at.moved, at.moved_in_theory),
            }
        })
    })
}

fn inputs(report: &Report) -> impl Iterator<Item = Inputs> {
    report.sweeps.iter().flat_map(|sweep| {
        sweep.steps.iter().filter_map(|step| {
            let super::Inputs { changed, ulp } = step.inputs?;
            Some(Inputs {
                dial: sweep.dial.name,
                k: step.k,
                rays: step.census.rays,
                changed,
                ulp,
            })
        })
    })
}

/// The report as one JSON object.
pub fn json(report: &Report) -> serde_json::Result<String> {
    let promises = report.kept.iter().map(|kept| Promise {
        method: kept.method.name(),
        asked: kept.asked,
        broken: kept.broken,
        first: kept.first.as_ref().map(input),
    });
    let checks = report.checks.iter().map(|check| Check {
        name: check.name,
        method: check.method.name(),
        rays: check.rays,
        failed: check.failed,
        passed: check.failed == 0,
        first: check.first.as_ref().map(input),
    });
    let document = Document {
        rayscope: env!("CARGO_PKG_VERSION"),
        seed: report.seed,
        rays: report.rays,
        complete: report.complete,
        checksum: report.checksum().to_string(),
        promises_kept: report.promises_kept(),
        promises: promises.collect(),
        breakdowns: breakdowns(report).collect(),
        checks: checks.collect(),
        settings: settings(report).collect(),
        inputs: inputs(report).collect(),
    };
    Ok(serde_json::to_string_pretty(&document)? + "\n")
}

/// The columns of the CSV, one row for each dial, setting and method.
const COLUMNS: [&str; 21] = [
    "dial",
    "k",
    "method",
    "rays",
    "miss",
    "meet",
    "false_hit",
    "false_miss",
    "wrong_count",
    "not_finite",
    "judged",
    "p50",
    "p99",
    "p999",
    "max",
    "bits_median",
    "bits_worst",
    "blame_median",
    "blame_worst",
    "moved",
    "seed",
];

/// The settings as CSV with a header.
pub fn csv(report: &Report) -> Result<String, csv::Error> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(COLUMNS)?;
    for setting in settings(report) {
        writer.write_record(record(report.seed, &setting))?;
    }
    let bytes = writer
        .into_inner()
        .map_err(csv::IntoInnerError::into_error)?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

fn record(seed: u64, setting: &Setting) -> [String; COLUMNS.len()] {
    let Wrong {
        false_hit,
        false_miss,
        wrong_count,
        not_finite,
    } = setting.wrong;
    let (ulp, blame) = (setting.ulp, setting.blame);
    let bits = |bits: Option<f64>| bits.map_or(String::new(), |bits| bits.to_string());
    [
        setting.dial.to_owned(),
        setting.k.to_string(),
        setting.method.to_owned(),
        setting.rays.to_string(),
        setting.miss.to_string(),
        setting.meet.to_string(),
        false_hit.to_string(),
        false_miss.to_string(),
        wrong_count.to_string(),
        not_finite.to_string(),
        setting.judged.to_string(),
        ulp.p50.to_string(),
        ulp.p99.to_string(),
        ulp.p999.to_string(),
        ulp.max.to_string(),
        bits(setting.bits_lost.median),
        bits(setting.bits_lost.worst),
        blame.p50.to_string(),
        blame.max.to_string(),
        setting.moved.to_string(),
        seed.to_string(),
    ]
}
