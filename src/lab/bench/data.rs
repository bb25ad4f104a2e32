//! A benchmark for programs: JSON and CSV. docs/accuracy.md lists the fields and columns.

use serde::Serialize;
use serde_json::{Map, Value};

use super::{Answer, Benchmark, Choice, MeasuredMethod, MeasuredSet, Pareto, answers};
use crate::lab::errors::{Census, FaultCounts, Percentiles, Worst};
use crate::lab::machine::Machine;
use crate::lab::numbers;
use crate::lab::second::{Clearance, SecondRays};
use crate::lab::timing::{Nanoseconds, SelfCheck, Times};
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
    why_not_trusted: Vec<String>,
    self_checks: &'a [SelfCheck],
    sets: Vec<SetJson<'a>>,
    results: Vec<MethodJson<'a>>,
    answers: Vec<AnswerJson>,
    #[serde(skip_serializing_if = "Option::is_none")]
    against: Option<&'a [String]>,
}

#[derive(Serialize)]
struct SetJson<'a> {
    name: &'a str,
    about: &'a str,
    #[serde(flatten)]
    census: Census,
    kind: &'a str,
    order: &'static str,
    timed: usize,
    unseen: usize,
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
    second: &'a SecondRays,
    ns: Option<Nanoseconds>,
    ns_learned: Option<Nanoseconds>,
    batch_ns: Option<Nanoseconds>,
    latency_ns: Option<Nanoseconds>,
    ratio: Option<f64>,
    ratio_told_apart: Option<bool>,
    ratio_learned: Option<f64>,
    batch_ratio: Option<f64>,
    latency_ratio: Option<f64>,
    pareto: bool,
    settled_by: Option<Map<String, Value>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    samples: Option<SamplesJson<'a>>,
}

/// Nanoseconds for one solve, each repeat in its order; `parts` samples of `ns` are one pass over all rays.
#[derive(Serialize)]
struct SamplesJson<'a> {
    parts: usize,
    ns: &'a [f64],
    ns_learned: &'a [f64],
    batch_ns: &'a [f64],
    latency_ns: &'a [f64],
}

#[derive(Serialize)]
struct AnswerJson {
    kind: String,
    sets: usize,
    right: Vec<ChoiceJson>,
    cheapest: Vec<&'static str>,
    without_wrong: Option<ChoiceJson>,
}

#[derive(Serialize)]
struct ChoiceJson {
    method: &'static str,
    ns: Option<[f64; 3]>,
    p99: f64,
}

impl From<&Choice> for ChoiceJson {
    fn from(&Choice { method, ns, p99 }: &Choice) -> Self {
        Self { method, ns, p99 }
    }
}

impl From<Answer> for AnswerJson {
    fn from(answer: Answer) -> Self {
        let cheapest = answer.right[..answer.cheapest].iter();
        Self {
            cheapest: cheapest.map(|choice| choice.method).collect(),
            right: answer.right.iter().map(ChoiceJson::from).collect(),
            without_wrong: answer.without_wrong.as_ref().map(ChoiceJson::from),
            kind: answer.kind,
            sets: answer.sets,
        }
    }
}

/// What is written besides what always is.
#[derive(Debug, Clone, Copy, Default)]
pub struct Extras<'a> {
    /// Each repeat of each method.
    pub samples: bool,
    /// What differs from an earlier report.
    pub against: Option<&'a [String]>,
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
    fn of(set: &'a MeasuredSet, row: &'a MeasuredMethod, samples: bool) -> Self {
        let times = row.times.as_ref();
        let first = set.run.times.first().map(|times| &times.unseen);
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
            second: &row.second,
            ns: times.map(|t| t.unseen.ns),
            ns_learned: times.map(|t| t.learned.ns),
            batch_ns: times.map(|t| t.batch.ns),
            latency_ns: times.map(|t| t.latency.ns),
            ratio: times.map(|t| t.unseen.ratio),
            ratio_told_apart: times
                .zip(first)
                .map(|(t, first)| t.unseen.is_told_apart_from(first)),
            ratio_learned: times.map(|t| t.learned.ratio),
            batch_ratio: times.map(|t| t.batch.ratio),
            latency_ratio: times.map(|t| t.latency.ratio),
            pareto: row.pareto == Pareto::Best,
            settled_by,
            samples: times.filter(|_| samples).map(|t| SamplesJson {
                parts: set.run.parts,
                ns: &t.unseen.samples,
                ns_learned: &t.learned.samples,
                batch_ns: &t.batch.samples,
                latency_ns: &t.latency.samples,
            }),
        }
    }
}

/// The report as one JSON object.
pub fn json(bench: &Benchmark, machine: &Machine, extras: Extras) -> String {
    let row = |set, row| MethodJson::of(set, row, extras.samples);
    let rows = bench
        .sets
        .iter()
        .flat_map(|set| set.rows.iter().map(move |of| row(set, of)));
    let sets = bench.sets.iter().map(|set| SetJson {
        name: &set.name,
        about: &set.about,
        kind: &set.kind,
        census: set.census,
        order: "as drawn or as in the picture, not sorted by class",
        timed: set.timed,
        unseen: set.unseen,
    });
    report::json(&BenchJson {
        rayscope: env!("CARGO_PKG_VERSION"),
        machine,
        seed: bench.seed,
        complete: bench.complete,
        checksum: bench.checksum().to_string(),
        times_trusted: bench.times_trusted(),
        why_not_trusted: bench.complaints(),
        self_checks: &bench.self_checks,
        sets: sets.collect(),
        results: rows.collect(),
        answers: answers(bench).into_iter().map(AnswerJson::from).collect(),
        against: extras.against,
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
const fn columns<'a>() -> [DataColumn<BenchLine<'a>>; 53] {
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
        ("hit_or_miss", |l| {
            l.row.errors.wrong.hit_or_miss().to_string()
        }),
        ("judged", |l| l.row.errors.judged.to_string()),
        ("p50", |l| l.row.errors.ulp.p50.to_string()),
        ("p99", |l| l.row.errors.ulp.p99.to_string()),
        ("p999", |l| l.row.errors.ulp.p999.to_string()),
        ("max", |l| l.row.errors.ulp.max.to_string()),
        ("worst_answer", |l| l.of_worst(|w| w.answer.clone())),
        ("worst_exact", |l| l.of_worst(|w| w.exact.clone())),
        ("worst_input", |l| l.of_worst(|w| w.input.join(" "))),
        ("hits", |l| l.row.second.hits.to_string()),
        ("point_p99", |l| l.row.second.point.p99.to_string()),
        ("point_of_radius_p99", |l| {
            l.row.second.point_of_radius.p99.to_string()
        }),
        ("normal_p99", |l| l.row.second.normal.p99.to_string()),
        ("normal_of_radius_p99", |l| {
            l.row.second.normal_of_radius.p99.to_string()
        }),
        ("self_hits", |l| l.row.second.self_hits.to_string()),
        ("t_min", |l| epsilon(l.row.second.t_min)),
        ("t_min_missed", |l| l.row.second.t_min.missed.to_string()),
        ("along_normal", |l| epsilon(l.row.second.along_normal)),
        ("along_normal_missed", |l| {
            l.row.second.along_normal.missed.to_string()
        }),
        ("ns_median", |l| l.of_times(|t| t.unseen.ns.median)),
        ("ns_min", |l| l.of_times(|t| t.unseen.ns.min)),
        ("ns_iqr", |l| l.of_times(|t| t.unseen.ns.iqr)),
        ("ratio", |l| l.of_times(|t| t.unseen.ratio)),
        ("ns_learned_median", |l| l.of_times(|t| t.learned.ns.median)),
        ("ns_learned_min", |l| l.of_times(|t| t.learned.ns.min)),
        ("ns_learned_iqr", |l| l.of_times(|t| t.learned.ns.iqr)),
        ("ratio_learned", |l| l.of_times(|t| t.learned.ratio)),
        ("batch_ns_median", |l| l.of_times(|t| t.batch.ns.median)),
        ("batch_ns_min", |l| l.of_times(|t| t.batch.ns.min)),
        ("batch_ns_iqr", |l| l.of_times(|t| t.batch.ns.iqr)),
        ("batch_ratio", |l| l.of_times(|t| t.batch.ratio)),
        ("latency_ns_median", |l| l.of_times(|t| t.latency.ns.median)),
        ("latency_ns_min", |l| l.of_times(|t| t.latency.ns.min)),
        ("latency_ns_iqr", |l| l.of_times(|t| t.latency.ns.iqr)),
        ("latency_ratio", |l| l.of_times(|t| t.latency.ratio)),
        ("pareto", |l| (l.row.pareto == Pareto::Best).to_string()),
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
    /// A time as text; nothing if there is none.
    fn of_times(&self, time: fn(&Times) -> f64) -> String {
        self.row
            .times
            .as_ref()
            .map(|t| time(t).to_string())
            .unwrap_or_default()
    }

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

/// What clears every self-hit, in units of the world; nothing if a radius does not.
fn epsilon(clearance: Clearance) -> String {
    clearance.epsilon.map(|x| x.to_string()).unwrap_or_default()
}

fn settled_by(row: &MeasuredMethod) -> String {
    let Some(counts) = row.stages else {
        return String::new();
    };
    let parts = Stage::ALL.map(Stage::name).into_iter().zip(counts);
    let parts: Vec<String> = parts.map(|(stage, n)| format!("{stage} {n}")).collect();
    parts.join(" ")
}
