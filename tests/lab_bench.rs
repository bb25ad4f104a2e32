//! `rayscope bench` as other programs see it: its JSON, its CSV, its exit status.

use std::cell::Cell;
use std::collections::BTreeSet;
use std::process::{Command, Output};

use rayscope::lab::bench::{self, BenchPlan, Sample};
use rayscope::lab::timing::{Clock, Schedule, SystemClock};
use rayscope::lab::{BenchQueue, Census, Errors, Family, Reference};
use rayscope::method::Method;
use serde_json::Value;

fn rayscope(arguments: &[&str]) -> Output {
    let queue = BenchQueue::private();
    let (variable, queue) = queue.variable();
    Command::new(env!("CARGO_BIN_EXE_rayscope"))
        .args(arguments)
        .env(variable, queue)
        .output()
        .unwrap()
}

fn stdout(output: &Output) -> &str {
    std::str::from_utf8(&output.stdout).unwrap()
}

fn json(arguments: &[&str]) -> Value {
    let mut all = vec!["bench", "--quick", "--format", "json"];
    all.extend(arguments);
    let output = rayscope(&all);
    assert!(output.status.success(), "{output:?}");
    assert!(output.stderr.is_empty(), "{output:?}");
    serde_json::from_slice(&output.stdout).unwrap()
}

const SMALL: [&str; 4] = ["--family", "typical,ties", "--rays", "300"];

#[test]
fn the_json_has_what_is_promised_for_each_family_and_method() {
    let document = json(&SMALL);
    let results = document["results"].as_array().unwrap();
    assert_eq!(results.len(), 2 * Method::ALL.len());
    for (result, method) in results.iter().zip(Method::ALL.iter().cycle()) {
        assert_eq!(result["method"], method.name());
        assert_eq!(result["rays"], 300);
        for kind in ["false_hit", "false_miss", "wrong_count", "not_finite"] {
            assert!(result["wrong"][kind].is_u64(), "{kind} of {result}");
        }
        for rank in ["p50", "p99", "p999", "max"] {
            assert!(result["ulp"][rank].is_number(), "{rank} of {result}");
        }
        for time in ["median", "min", "iqr"] {
            assert!(result["ns"][time].as_f64().unwrap() >= 0.0, "{result}");
            assert!(result["batch_ns"][time].as_f64().unwrap() >= 0.0);
            assert!(result["latency_ns"][time].as_f64().unwrap() >= 0.0);
        }
    }
    assert!(document["times_trusted"].is_boolean());
    assert!(document["complete"].as_bool().unwrap());
    assert!(
        document["machine"]["compiler"]
            .as_str()
            .unwrap()
            .starts_with("rustc")
    );
    let exact = &results[Method::ALL.len() - 1];
    let settled: u64 = exact["settled_by"]
        .as_object()
        .unwrap()
        .values()
        .map(|n| n.as_u64().unwrap())
        .sum();
    assert_eq!(settled, 300);
}

#[test]
fn the_errors_in_the_json_are_those_of_the_library() {
    let document = json(&SMALL);
    let mut results = document["results"].as_array().unwrap().iter();
    for family in ["typical", "ties"] {
        let problems = Family::by_name(family).unwrap().sample(1, 300);
        let references = Reference::all(&problems);
        for method in Method::ALL {
            let errors = Errors::of(&problems, &references, |r, s| method.solve(r, s));
            let result = results.next().unwrap();
            assert_eq!(result["family"], family);
            // Written and read as the document was: the reader is not exact to the last bit.
            let ulp = serde_json::to_string(&errors.ulp).unwrap();
            assert_eq!(result["ulp"], serde_json::from_str::<Value>(&ulp).unwrap());
            assert_eq!(result["wrong"], serde_json::to_value(errors.wrong).unwrap());
        }
        let census = serde_json::to_value(Census::of(&references)).unwrap();
        let set = document["sets"]
            .as_array()
            .unwrap()
            .iter()
            .find(|set| set["name"] == family);
        for key in ["rays", "miss", "tangent", "secant"] {
            assert_eq!(set.unwrap()[key], census[key]);
        }
    }
}

#[test]
fn the_same_seed_gives_the_same_errors_and_another_seed_others() {
    let errors = |seed: &str| {
        let mut arguments = SMALL.to_vec();
        arguments.extend(["--seed", seed]);
        let document = json(&arguments);
        let results = document["results"].as_array().unwrap();
        let errors: Vec<Value> = results
            .iter()
            .map(|r| {
                Value::from(vec![
                    r["rays"].clone(),
                    r["wrong"].clone(),
                    r["ulp"].clone(),
                ])
            })
            .collect();
        (document["checksum"].clone(), errors)
    };
    assert_eq!(errors("7"), errors("7"));
    assert_ne!(errors("7").0, errors("8").0);
    assert_ne!(errors("7").1, errors("8").1);
}

#[test]
fn the_csv_has_a_row_for_each_family_and_method_under_its_documented_columns() {
    let output = rayscope(&[
        "bench", "--quick", "--format", "csv", "--family", "grazing", "--rays", "200",
    ]);
    assert!(output.status.success());
    let mut csv = csv::Reader::from_reader(output.stdout.as_slice());
    let header: Vec<String> = csv.headers().unwrap().iter().map(str::to_owned).collect();
    let documented = std::fs::read_to_string("docs/accuracy.md").unwrap_or_default();
    for column in &header {
        assert!(
            documented.contains(&format!("`{column}`")),
            "{column} is not in docs/accuracy.md"
        );
    }
    let rows: Vec<csv::StringRecord> = csv.records().map(Result::unwrap).collect();
    assert_eq!(rows.len(), Method::ALL.len());
    let column = |name: &str| header.iter().position(|h| h == name).unwrap();
    for row in &rows {
        assert_eq!(&row[column("family")], "grazing");
        let inputs: Vec<&str> = row[column("worst_input")].split(' ').collect();
        assert_eq!(inputs.len(), 10);
        assert!(
            inputs
                .iter()
                .all(|x| x.trim_start_matches('-').starts_with("0x")),
            "{inputs:?}"
        );
        for name in [
            "p50",
            "p99",
            "p999",
            "max",
            "ns_median",
            "batch_ns_min",
            "latency_ns_iqr",
        ] {
            row[column(name)].parse::<f64>().unwrap();
        }
    }
}

#[test]
fn the_table_fits_eighty_columns_and_names_what_it_shows() {
    let output = rayscope(&["bench", "--quick", "--rays", "64"]);
    assert!(output.status.success());
    let text = stdout(&output);
    for line in text.lines() {
        assert!(line.chars().count() <= 80, "{line}");
    }
    for family in Family::ALL {
        assert!(
            text.contains(&format!("\n{}: ", family.name)),
            "{}",
            family.name
        );
    }
    assert!(text.contains("exact settled by binary64"));
    assert!(text.contains("times_trusted: "));
    let largest = text
        .lines()
        .filter(|line| line.contains(": largest ") && line.contains("0x"));
    // Where no method was right on any ray, there is none.
    assert!(largest.count() > 5 * Family::ALL.len());
    let brief = rayscope(&["bench", "--quick", "--rays", "64", "--brief"]);
    assert!(!stdout(&brief).contains("0x"));
}

#[test]
fn the_rays_of_a_scene_are_those_of_its_picture() {
    let document = json(&["--scene", "tutorial", "--method", "textbook,exact"]);
    let results = document["results"].as_array().unwrap();
    assert_eq!(results.len(), 2);
    assert_eq!(results[0]["rays"], 1600);
    let set = &document["sets"][0];
    // The tutorial's screen: 317 pixels hit, 12 of them exactly tangent.
    assert_eq!(
        [&set["miss"], &set["tangent"], &set["secant"]],
        [1283, 12, 305]
    );
}

#[test]
fn what_cannot_be_done_is_said_in_a_sentence() {
    let output = rayscope(&["bench", "--scene", "nowhere.toml"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&output.stderr).contains("nowhere.toml"));
    for misuse in [
        &["bench", "--family", "none"][..],
        &["bench", "--method", "none"],
        &["bench", "--rays", "0"],
        &["bench", "--scene", "tutorial", "--family", "typical"],
    ] {
        assert_eq!(rayscope(misuse).status.code(), Some(2), "{misuse:?}");
    }
}

/// A clock that stands still.
struct Frozen;

impl Clock for Frozen {
    fn now(&self) -> u64 {
        0
    }
}

fn plan() -> BenchPlan<'static> {
    BenchPlan {
        methods: &Method::ALL,
        schedule: Schedule { rounds: 3, seed: 1 },
    }
}

fn samples() -> Vec<Sample> {
    let of = |family| Sample::of_family(family, 1, 100);
    Family::ALL[..3].iter().map(of).collect()
}

#[test]
fn a_broken_timer_is_said_and_leaves_the_errors_as_they_are() {
    let report = bench::run(plan(), &samples(), 1, &Frozen, |_, _| true);
    assert!(!report.times_trusted());
    let honest = bench::run(plan(), &samples(), 1, &SystemClock::new(), |_, _| true);
    assert_eq!(report.checksum(), honest.checksum());
    let machine = rayscope::lab::Machine::detect();
    assert!(
        bench::text(&report, &machine, false)
            .text()
            .contains("times_trusted: false")
    );
    let json: Value = serde_json::from_str(&bench::json(&report, &machine)).unwrap();
    assert_eq!(json["times_trusted"], false);
}

#[test]
fn a_run_that_is_ended_early_reports_what_is_complete() {
    let asked = Cell::new(0);
    let report = bench::run(plan(), &samples(), 1, &SystemClock::new(), |number, _| {
        asked.set(asked.get() + 1);
        number < 2
    });
    assert!(!report.complete && asked.get() > 3);
    assert_eq!(report.sets.len(), 2);
    assert!(
        report
            .sets
            .iter()
            .all(|c| c.rows.len() == Method::ALL.len())
    );
    let text = bench::text(&report, &rayscope::lab::Machine::detect(), false).text();
    assert!(text.contains("Interrupted"));
}

#[test]
fn a_method_is_marked_unless_another_is_as_good_in_all_and_better_in_one() {
    let report = bench::run(plan(), &samples(), 1, &SystemClock::new(), |_, _| true);
    for set in &report.sets {
        let marked: BTreeSet<&str> = set
            .rows
            .iter()
            .filter(|r| r.pareto)
            .map(|r| r.method)
            .collect();
        for row in &set.rows {
            let better = set.rows.iter().any(|other| {
                let pair = |r: &bench::MeasuredMethod| {
                    (
                        r.errors.wrong.total(),
                        r.errors.ulp.p99,
                        r.times.throughput.median,
                    )
                };
                let (mine, theirs) = (pair(row), pair(other));
                theirs.0 <= mine.0 && theirs.1 <= mine.1 && theirs.2 <= mine.2 && theirs != mine
            });
            assert_eq!(
                marked.contains(row.method),
                !better,
                "{} in {}",
                row.method,
                set.name
            );
        }
    }
}
