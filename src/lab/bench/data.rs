//! A benchmark for programs: JSON and CSV. docs/accuracy.md lists the fields and columns.

use serde::Serialize;
use serde_json::{Map, Value};

use super::{Benchmark, MeasuredMethod, MeasuredSet};
use crate::lab::errors::{Census, FaultCounts, Percentiles, Worst};
use crate::lab::machine::Machine;
use crate::lab::numbers;
use crate::lab::timing::{Nanoseconds, SelfCheck};
use crate::method::exact::Stage;
use crate::report::{self, DataColumn, Table};
use crate::text::hexadecimal;

#[derive(Serialize)]
struct BenchJson<'a> {
    rayscope: &'static str,
    machine: &'a Machine,
    seed: u64,
    complete: bool,
    checksum: String,
    times_trusted: bool,
    self_checks: &'a [SelfCheck],
    sets: Vec<SetJson<'a>>,
    results: Vec<MethodJson<'a>>,
}

#[derive(Serialize)]
struct SetJson<'a> {
    name: &'a str,
    about: &'a str,
    #[serde(flatten)]
    census: Census,
    order: &'static str,
    timed: usize,
}

#[derive(Serialize)]
struct MethodJson<'a> {
    family: &'a str,
    method: &'static str,
    rays: usize,
    wrong: FaultCounts,
    judged: usize,
    ulp: Percentiles,
    worst: Option<Largest>,
    ns: Nanoseconds,
    batch_ns: Nanoseconds,
    latency_ns: Nanoseconds,
    ratio: f64,
    batch_ratio: f64,
    latency_ratio: f64,
    pareto: bool,
    settled_by: Option<Map<String, Value>>,
}

#[derive(Serialize)]
struct Largest {
    ulp: f64,
    answer: String,
    exact: String,
    input: [String; 10],
}

impl Largest {
    fn of(worst: &Worst) -> Self {
        Self {
            ulp: worst.error.ulps,
            answer: hexadecimal(worst.error.answer),
            exact: hexadecimal(worst.error.exact),
            input: numbers(&worst.problem).map(hexadecimal),
        }
    }
}

impl<'a> MethodJson<'a> {
    fn of(set: &'a MeasuredSet, row: &MeasuredMethod) -> Self {
        let settled_by = row.stages.map(|counts| {
            let names = Stage::ALL.map(|stage| stage.name().to_owned());
            names.into_iter().zip(counts.map(Value::from)).collect()
        });
        Self {
            family: &set.name,
            method: row.method,
            rays: set.census.rays,
            wrong: row.errors.wrong,
            judged: row.errors.judged,
            ulp: row.errors.ulp,
            worst: row.errors.worst.as_ref().map(Largest::of),
            ns: row.times.throughput,
            batch_ns: row.times.batch,
            latency_ns: row.times.latency,
            ratio: row.times.throughput_ratio,
            batch_ratio: row.times.batch_ratio,
            latency_ratio: row.times.latency_ratio,
            pareto: row.pareto,
            settled_by,
        }
    }
}

/// The report as one JSON object.
pub fn json(bench: &Benchmark, machine: &Machine) -> String {
    let rows = bench
        .sets
        .iter()
        .flat_map(|set| set.rows.iter().map(move |row| MethodJson::of(set, row)));
    let sets = bench.sets.iter().map(|set| SetJson {
        name: &set.name,
        about: &set.about,
        census: set.census,
        order: "as drawn or as in the picture, not sorted by class",
        timed: set.timed,
    });
    report::json(&BenchJson {
        rayscope: env!("CARGO_PKG_VERSION"),
        machine,
        seed: bench.seed,
        complete: bench.complete,
        checksum: bench.checksum().to_string(),
        times_trusted: bench.times_trusted(),
        self_checks: &bench.self_checks,
        sets: sets.collect(),
        results: rows.collect(),
    })
}

/// One set and method, and what they were measured with.
struct BenchLine<'a> {
    bench: &'a Benchmark,
    machine: &'a Machine,
    set: &'a MeasuredSet,
    row: &'a MeasuredMethod,
    worst: Option<Largest>,
}

/// The columns of the CSV; the ten numbers of the worst input lie in one, with blanks between them, p0, d, c, r.
const fn columns<'a>() -> [DataColumn<BenchLine<'a>>; 38] {
    [
        ("family", |l| l.set.name.clone()),
        ("method", |l| l.row.method.to_owned()),
        ("rays", |l| l.set.census.rays.to_string()),
        ("miss", |l| l.set.census.miss.to_string()),
        ("tangent", |l| l.set.census.tangent.to_string()),
        ("secant", |l| l.set.census.secant.to_string()),
        ("false_hit", |l| l.row.errors.wrong.false_hit.to_string()),
        ("false_miss", |l| l.row.errors.wrong.false_miss.to_string()),
        ("wrong_count", |l| {
            l.row.errors.wrong.wrong_count.to_string()
        }),
        ("not_finite", |l| l.row.errors.wrong.not_finite.to_string()),
        ("judged", |l| l.row.errors.judged.to_string()),
        ("p50", |l| l.row.errors.ulp.p50.to_string()),
        ("p99", |l| l.row.errors.ulp.p99.to_string()),
        ("p999", |l| l.row.errors.ulp.p999.to_string()),
        ("max", |l| l.row.errors.ulp.max.to_string()),
        ("worst_answer", |l| l.of_worst(|w| w.answer.clone())),
        ("worst_exact", |l| l.of_worst(|w| w.exact.clone())),
        ("worst_input", |l| l.of_worst(|w| w.input.join(" "))),
        ("ns_median", |l| l.row.times.throughput.median.to_string()),
        ("ns_min", |l| l.row.times.throughput.min.to_string()),
        ("ns_iqr", |l| l.row.times.throughput.iqr.to_string()),
        ("ratio", |l| l.row.times.throughput_ratio.to_string()),
        ("batch_ns_median", |l| l.row.times.batch.median.to_string()),
        ("batch_ns_min", |l| l.row.times.batch.min.to_string()),
        ("batch_ns_iqr", |l| l.row.times.batch.iqr.to_string()),
        ("batch_ratio", |l| l.row.times.batch_ratio.to_string()),
        ("latency_ns_median", |l| {
            l.row.times.latency.median.to_string()
        }),
        ("latency_ns_min", |l| l.row.times.latency.min.to_string()),
        ("latency_ns_iqr", |l| l.row.times.latency.iqr.to_string()),
        ("latency_ratio", |l| l.row.times.latency_ratio.to_string()),
        ("pareto", |l| l.row.pareto.to_string()),
        ("settled_by", |l| settled_by(l.row)),
        ("seed", |l| l.bench.seed.to_string()),
        ("checksum", |l| l.bench.checksum().to_string()),
        ("times_trusted", |l| l.bench.times_trusted().to_string()),
        ("cpu", |l| l.machine.cpu.clone()),
        ("compiler", |l| l.machine.compiler.clone()),
        ("flags", |l| l.machine.flags.clone()),
    ]
}

impl BenchLine<'_> {
    /// What is said of the largest error; nothing if there is none.
    fn of_worst(&self, said: fn(&Largest) -> String) -> String {
        self.worst.as_ref().map(said).unwrap_or_default()
    }
}

/// One row for each set and method.
pub fn records(bench: &Benchmark, machine: &Machine) -> Table {
    let lines = bench.sets.iter().flat_map(|set| {
        set.rows.iter().map(move |row| BenchLine {
            bench,
            machine,
            set,
            row,
            worst: row.errors.worst.as_ref().map(Largest::of),
        })
    });
    Table::of(&columns(), lines)
}

fn settled_by(row: &MeasuredMethod) -> String {
    let Some(counts) = row.stages else {
        return String::new();
    };
    let parts = Stage::ALL.map(Stage::name).into_iter().zip(counts);
    let parts: Vec<String> = parts.map(|(stage, n)| format!("{stage} {n}")).collect();
    parts.join(" ")
}
