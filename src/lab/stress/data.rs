//! The stability sweeps for programs: JSON and CSV. docs/stability.md lists the fields and columns.

use serde::Serialize;

use super::theory::agree;
use super::{MethodErrors, Stability};
use crate::lab::Problem;
use crate::lab::errors::{FaultCounts, Percentiles};
use crate::lab::numbers;
use crate::lab::second::SecondRays;
use crate::report::{self, DataColumn, Table};
use crate::text::hexadecimal;

#[derive(Serialize)]
struct StabilityJson {
    rayscope: &'static str,
    seed: u64,
    rays: usize,
    complete: bool,
    checksum: String,
    promises_kept: bool,
    promises: Vec<PromiseJson>,
    breakdowns: Vec<BreakdownJson>,
    checks: Vec<CheckJson>,
    settings: Vec<SettingJson>,
    inputs: Vec<InputsJson>,
}

/// What rounding the inputs of one setting did, in ulp of the exact roots.
#[derive(Serialize)]
struct InputsJson {
    dial: &'static str,
    k: i32,
    rays: usize,
    changed: usize,
    ulp: Percentiles,
}

#[derive(Serialize)]
struct PromiseJson {
    method: &'static str,
    asked: usize,
    broken: usize,
    first: Option<[String; 10]>,
}

#[derive(Serialize)]
struct BreakdownJson {
    dial: &'static str,
    quantity: &'static str,
    method: &'static str,
    wrong: EventJson,
    moved: EventJson,
}

/// Exponents of 2; null for never.
#[derive(Serialize)]
struct EventJson {
    found: Option<i32>,
    theory: Option<f64>,
    agree: bool,
}

#[derive(Serialize)]
struct CheckJson {
    name: &'static str,
    method: &'static str,
    rays: usize,
    failed: usize,
    passed: bool,
    first: Option<[String; 10]>,
}

#[derive(Serialize)]
struct SettingJson {
    dial: &'static str,
    k: i32,
    method: &'static str,
    rays: usize,
    miss: usize,
    meet: usize,
    wrong: FaultCounts,
    wrong_rate: f64,
    judged: usize,
    ulp: Percentiles,
    bits_lost: Bits,
    blame: Percentiles,
    moved: usize,
    second: SecondRays,
}

#[derive(Serialize)]
struct Bits {
    median: Option<f64>,
    worst: Option<f64>,
}

fn input(problem: &Problem) -> [String; 10] {
    numbers(problem).map(hexadecimal)
}

fn settings(stability: &Stability) -> impl Iterator<Item = SettingJson> {
    stability.sweeps.iter().flat_map(move |sweep| {
        sweep.steps.iter().flat_map(move |step| {
            let one = move |(method, cell): (&crate::method::Method, &MethodErrors)| {
                let errors = &cell.errors;
                let wrong = errors.wrong;
                SettingJson {
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
                    second: cell.second.clone(),
                }
            };
            stability.methods.iter().zip(&step.cells).map(one)
        })
    })
}

fn breakdowns(stability: &Stability) -> impl Iterator<Item = BreakdownJson> {
    stability.sweeps.iter().flat_map(move |sweep| {
        stability
            .methods
            .iter()
            .enumerate()
            .map(move |(i, method)| {
                let at = stability.breakdown(sweep, i);
                let place = |found, theory| EventJson {
                    found,
                    theory,
                    agree: agree(found, theory, sweep.dial.step()),
                };
                BreakdownJson {
                    dial: sweep.dial.name,
                    quantity: sweep.dial.quantity,
                    method: method.name(),
                    wrong: place(at.wrong, at.wrong_in_theory),
                    moved: place(at.moved, at.moved_in_theory),
                }
            })
    })
}

fn inputs(stability: &Stability) -> impl Iterator<Item = InputsJson> {
    stability.sweeps.iter().flat_map(|sweep| {
        sweep.steps.iter().filter_map(|step| {
            let super::InputRounding { changed, ulp } = step.inputs?;
            Some(InputsJson {
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
pub fn json(stability: &Stability) -> String {
    let promises = stability.kept.iter().map(|kept| PromiseJson {
        method: kept.method.name(),
        asked: kept.asked,
        broken: kept.broken,
        first: kept.first.as_ref().map(input),
    });
    let checks = stability.checks.iter().map(|check| CheckJson {
        name: check.name,
        method: check.method.name(),
        rays: check.rays,
        failed: check.failed,
        passed: check.failed == 0,
        first: check.first.as_ref().map(input),
    });
    report::json(&StabilityJson {
        rayscope: env!("CARGO_PKG_VERSION"),
        seed: stability.seed,
        rays: stability.rays,
        complete: stability.complete,
        checksum: stability.checksum().to_string(),
        promises_kept: stability.promises_kept(),
        promises: promises.collect(),
        breakdowns: breakdowns(stability).collect(),
        checks: checks.collect(),
        settings: settings(stability).collect(),
        inputs: inputs(stability).collect(),
    })
}

/// The columns of the CSV.
const COLUMNS: [DataColumn<SettingLine>; 21] = [
    ("dial", |(_, s)| s.dial.to_owned()),
    ("k", |(_, s)| s.k.to_string()),
    ("method", |(_, s)| s.method.to_owned()),
    ("rays", |(_, s)| s.rays.to_string()),
    ("miss", |(_, s)| s.miss.to_string()),
    ("meet", |(_, s)| s.meet.to_string()),
    ("false_hit", |(_, s)| s.wrong.false_hit.to_string()),
    ("false_miss", |(_, s)| s.wrong.false_miss.to_string()),
    ("wrong_count", |(_, s)| s.wrong.wrong_count.to_string()),
    ("not_finite", |(_, s)| s.wrong.not_finite.to_string()),
    ("judged", |(_, s)| s.judged.to_string()),
    ("p50", |(_, s)| s.ulp.p50.to_string()),
    ("p99", |(_, s)| s.ulp.p99.to_string()),
    ("p999", |(_, s)| s.ulp.p999.to_string()),
    ("max", |(_, s)| s.ulp.max.to_string()),
    ("bits_median", |(_, s)| optional(s.bits_lost.median)),
    ("bits_worst", |(_, s)| optional(s.bits_lost.worst)),
    ("blame_median", |(_, s)| s.blame.p50.to_string()),
    ("blame_worst", |(_, s)| s.blame.max.to_string()),
    ("moved", |(_, s)| s.moved.to_string()),
    ("seed", |(seed, _)| seed.to_string()),
];

/// The seed, and one setting.
type SettingLine = (u64, SettingJson);

fn optional(number: Option<f64>) -> String {
    number.map_or(String::new(), |number| number.to_string())
}

/// One row for each dial, setting and method.
pub fn records(stability: &Stability) -> Table {
    Table::of(&COLUMNS, settings(stability).map(|s| (stability.seed, s)))
}
