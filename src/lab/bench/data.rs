//! A bench report for programs: JSON and CSV. docs/accuracy.md lists the fields and columns.

use serde::Serialize;
use serde_json::{Map, Value};

use super::{Chapter, Report, Row};
use crate::lab::errors::{Census, Percentiles, Worst, Wrong};
use crate::lab::machine::Machine;
use crate::lab::numbers;
use crate::lab::timing::{Nanoseconds, SelfCheck};
use crate::method::exact::Stage;
use crate::text::hexadecimal;

#[derive(Serialize)]
struct Document<'a> {
    rayscope: &'static str,
    machine: &'a Machine,
    seed: u64,
    complete: bool,
    checksum: String,
    times_trusted: bool,
    self_checks: &'a [SelfCheck],
    sets: Vec<Set<'a>>,
    results: Vec<Entry<'a>>,
}

#[derive(Serialize)]
struct Set<'a> {
    name: &'a str,
    about: &'a str,
    #[serde(flatten)]
    census: Census,
    order: &'static str,
    timed: usize,
}

#[derive(Serialize)]
struct Entry<'a> {
    family: &'a str,
    method: &'static str,
    rays: usize,
    wrong: Wrong,
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

impl<'a> Entry<'a> {
    fn of(chapter: &'a Chapter, row: &Row) -> Self {
        let settled_by = row.stages.map(|counts| {
            let names = Stage::ALL.map(|stage| stage.name().to_owned());
            names.into_iter().zip(counts.map(Value::from)).collect()
        });
        Self {
            family: &chapter.name,
            method: row.method,
            rays: chapter.census.rays,
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
pub fn json(report: &Report, machine: &Machine) -> serde_json::Result<String> {
    let rows = report
        .chapters
        .iter()
        .flat_map(|chapter| chapter.rows.iter().map(move |row| Entry::of(chapter, row)));
    let sets = report.chapters.iter().map(|chapter| Set {
        name: &chapter.name,
        about: &chapter.about,
        census: chapter.census,
        order: "as drawn or as in the picture, not sorted by class",
        timed: chapter.timed,
    });
    let document = Document {
        rayscope: env!("CARGO_PKG_VERSION"),
        machine,
        seed: report.seed,
        complete: report.complete,
        checksum: report.checksum().to_string(),
        times_trusted: report.times_trusted(),
        self_checks: &report.self_checks,
        sets: sets.collect(),
        results: rows.collect(),
    };
    Ok(serde_json::to_string_pretty(&document)? + "\n")
}

/// The columns of the CSV, one row for each set and method.
const COLUMNS: [&str; 38] = [
    "family",
    "method",
    "rays",
    "miss",
    "tangent",
    "secant",
    "false_hit",
    "false_miss",
    "wrong_count",
    "not_finite",
    "judged",
    "p50",
    "p99",
    "p999",
    "max",
    "worst_answer",
    "worst_exact",
    "worst_input",
    "ns_median",
    "ns_min",
    "ns_iqr",
    "ratio",
    "batch_ns_median",
    "batch_ns_min",
    "batch_ns_iqr",
    "batch_ratio",
    "latency_ns_median",
    "latency_ns_min",
    "latency_ns_iqr",
    "latency_ratio",
    "pareto",
    "settled_by",
    "seed",
    "checksum",
    "times_trusted",
    "cpu",
    "compiler",
    "flags",
];

/// The report as CSV with a header; the ten numbers of the worst input stand in one column with
/// blanks between them, p0, d, c, r.
pub fn csv(report: &Report, machine: &Machine) -> Result<String, csv::Error> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(COLUMNS)?;
    for chapter in &report.chapters {
        for row in &chapter.rows {
            writer.write_record(record(report, machine, chapter, row))?;
        }
    }
    let bytes = writer
        .into_inner()
        .map_err(csv::IntoInnerError::into_error)?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

fn record(
    report: &Report,
    machine: &Machine,
    chapter: &Chapter,
    row: &Row,
) -> [String; COLUMNS.len()] {
    let Census {
        rays,
        miss,
        tangent,
        secant,
    } = chapter.census;
    let errors = &row.errors;
    let Wrong {
        false_hit,
        false_miss,
        wrong_count,
        not_finite,
    } = errors.wrong;
    let [answer, exact, input] = errors
        .worst
        .as_ref()
        .map(Largest::of)
        .map_or([const { String::new() }; 3], |worst| {
            [worst.answer, worst.exact, worst.input.join(" ")]
        });
    let (times, ulp) = (&row.times, errors.ulp);
    [
        chapter.name.clone(),
        row.method.to_owned(),
        rays.to_string(),
        miss.to_string(),
        tangent.to_string(),
        secant.to_string(),
        false_hit.to_string(),
        false_miss.to_string(),
        wrong_count.to_string(),
        not_finite.to_string(),
        errors.judged.to_string(),
        ulp.p50.to_string(),
        ulp.p99.to_string(),
        ulp.p999.to_string(),
        ulp.max.to_string(),
        answer,
        exact,
        input,
        times.throughput.median.to_string(),
        times.throughput.min.to_string(),
        times.throughput.iqr.to_string(),
        times.throughput_ratio.to_string(),
        times.batch.median.to_string(),
        times.batch.min.to_string(),
        times.batch.iqr.to_string(),
        times.batch_ratio.to_string(),
        times.latency.median.to_string(),
        times.latency.min.to_string(),
        times.latency.iqr.to_string(),
        times.latency_ratio.to_string(),
        row.pareto.to_string(),
        settled_by(row),
        report.seed.to_string(),
        report.checksum().to_string(),
        report.times_trusted().to_string(),
        machine.cpu.clone(),
        machine.compiler.clone(),
        machine.flags.clone(),
    ]
}

fn settled_by(row: &Row) -> String {
    let Some(counts) = row.stages else {
        return String::new();
    };
    let parts = Stage::ALL.map(Stage::name).into_iter().zip(counts);
    let parts: Vec<String> = parts.map(|(stage, n)| format!("{stage} {n}")).collect();
    parts.join(" ")
}
