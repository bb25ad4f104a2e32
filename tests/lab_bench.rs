//! `rayscope bench` as other programs see it: its JSON, its CSV, its exit status.

use std::cell::Cell;
use std::process::{Command, Output};

use rayscope::lab::bench::{self, BenchPlan, Earlier, Extras, Pareto, Sample};
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
        let wrong = |kind: &str| result["wrong"][kind].as_u64().unwrap();
        assert_eq!(
            wrong("hit_or_miss"),
            wrong("false_hit") + wrong("false_miss")
        );
        assert!(wrong("wrong_count") + wrong("not_finite") <= 300);
        for rank in ["p50", "p99", "p999", "max"] {
            assert!(result["ulp"][rank].is_number(), "{rank} of {result}");
        }
        for time in ["median", "min", "iqr"] {
            assert!(result["ns"][time].as_f64().unwrap() >= 0.0, "{result}");
            assert!(result["ns_learned"][time].as_f64().unwrap() >= 0.0);
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
        schedule: Schedule {
            rounds: 3,
            passes: 2,
            unseen: 2000,
            seed: 1,
        },
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
        bench::text(&report, &machine, false, None)
            .text()
            .contains("times_trusted: false")
    );
    let json: Value =
        serde_json::from_str(&bench::json(&report, &machine, Extras::default())).unwrap();
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
    let text = bench::text(&report, &rayscope::lab::Machine::detect(), false, None).text();
    assert!(text.contains("Interrupted"));
}

#[test]
fn a_method_is_marked_only_where_it_is_told_apart() {
    let report = bench::run(plan(), &samples(), 1, &SystemClock::new(), |_, _| true);
    for set in &report.sets {
        let marked = set.rows.iter().filter(|row| row.pareto == Pareto::Best);
        for row in marked {
            for other in set.rows.iter().filter(|other| other.method != row.method) {
                let [mine, theirs] =
                    [row, other].map(|r| (r.errors.wrong.total(), r.errors.ulp.p99));
                if theirs.0 <= mine.0 && theirs.1 <= mine.1 {
                    let [mine, theirs] = [row, other].map(|r| &r.times.as_ref().unwrap().unseen);
                    assert!(mine.is_told_apart_from(theirs) && mine.ns.median < theirs.ns.median);
                }
            }
        }
    }
    // A clock that stands still tells nothing apart: the only one with such errors is marked all the same.
    let report = bench::run(plan(), &samples(), 1, &Frozen, |_, _| true);
    let typical = &report.sets[0].rows;
    let place = |name: &str| {
        typical
            .iter()
            .find(|row| row.method == name)
            .unwrap()
            .pareto
    };
    assert_eq!([place("double"), place("exact")], [Pareto::Open; 2]);
    assert_ne!(place("textbook"), Pareto::Best);
}

#[test]
fn the_answer_names_who_is_right_and_comes_last() {
    let report = bench::run(plan(), &samples(), 1, &SystemClock::new(), |_, _| true);
    let answers = bench::answers(&report);
    let kinds: Vec<&str> = answers.iter().map(|answer| answer.kind.as_str()).collect();
    assert_eq!(kinds, ["near", "d not 1 long"]);
    for answer in &answers {
        let mut right: Vec<&str> = answer.right.iter().map(|choice| choice.method).collect();
        right.sort_unstable();
        assert_eq!(right, ["double", "exact"], "{}", answer.kind);
        assert!((1..=2).contains(&answer.cheapest));
        assert!(answer.without_wrong.is_some());
    }
    let machine = rayscope::lab::Machine::detect();
    let text = bench::text(&report, &machine, false, None).text();
    let answer = text.rsplit("\n\n").next().unwrap();
    assert!(answer.starts_with("which method, for which rays"), "{text}");
    assert!(answer.lines().count() <= 12, "half a screen: {answer}");
    let whole = rayscope(&["bench", "--quick", "--rays", "64", "--brief"]);
    let answer = stdout(&whole).rsplit("\n\n").next().unwrap().to_owned();
    assert!(answer.lines().count() <= 12, "half a screen: {answer}");
    for kind in ["near", "from a surface", "any bits"] {
        assert!(answer.contains(kind), "{answer}");
    }
}

#[test]
fn each_ray_of_the_headline_is_another() {
    let document = json(&["--family", "typical", "--rays", "100", "--samples"]);
    let set = &document["sets"][0];
    assert!(set["unseen"].as_u64().unwrap() >= 1 << 17, "{set}");
    assert_eq!(set["timed"], 100);
    for result in document["results"].as_array().unwrap() {
        let samples = &result["samples"];
        let count = |key: &str| samples[key].as_array().unwrap().len() as u64;
        assert_eq!(count("ns"), 2 * samples["parts"].as_u64().unwrap());
        assert_eq!([count("ns_learned"), count("batch_ns")], [15, 15]);
        let mut ns: Vec<f64> = samples["ns"]
            .as_array()
            .unwrap()
            .iter()
            .map(|x| x.as_f64().unwrap())
            .collect();
        ns.sort_by(f64::total_cmp);
        assert_eq!(result["ns"]["min"].as_f64().unwrap(), ns[0]);
        assert_eq!(
            result["ns"]["median"].as_f64().unwrap(),
            ns[ns.len() / 2 - 1]
        );
    }
    let without = json(&["--family", "typical", "--rays", "100", "--method", "exact"]);
    assert!(without["results"][0]["samples"].is_null());
    assert_eq!(
        without["why_not_trusted"].as_array().unwrap().is_empty(),
        without["times_trusted"]
    );
}

#[test]
fn only_what_is_beyond_the_noise_of_both_is_named() {
    let report = bench::run(plan(), &samples(), 1, &SystemClock::new(), |_, _| true);
    let machine = rayscope::lab::Machine::detect();
    let mut old: Value =
        serde_json::from_str(&bench::json(&report, &machine, Extras::default())).unwrap();
    old["times_trusted"] = true.into();
    let named = |old: &Value| {
        let earlier = Earlier::parse(&old.to_string()).unwrap();
        let said = bench::differences(&report, &machine.cpu, &earlier);
        said.into_iter()
            .filter(|line| !line.contains("trusted"))
            .collect::<Vec<_>>()
    };
    assert_eq!(
        named(&old),
        ["24 rows compared, no difference beyond the noise of both"]
    );
    let row = &mut old["results"][7];
    let [median, iqr] = ["median", "iqr"].map(|key| row["ns"][key].as_f64().unwrap());
    row["ns"]["median"] = (median + 1.9 * iqr).into();
    assert_eq!(named(&old).len(), 1);
    assert!(named(&old)[0].starts_with("24 rows"));
    old["results"][7]["ns"]["median"] = (median + 2.1 * iqr + 1.0).into();
    assert!(
        named(&old)[0].starts_with("typical, exact: "),
        "{:?}",
        named(&old)
    );
    old["results"][7]["wrong"]["false_hit"] = 3.into();
    assert!(
        named(&old)[0].contains("3 → 0 wrong answers"),
        "{:?}",
        named(&old)
    );
    old["machine"]["cpu"] = "another".into();
    assert!(named(&old)[0].contains("another machine"));

    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("old.json");
    let against = |arguments: &[&str]| {
        let base = [
            "bench",
            "--quick",
            "--rays",
            "64",
            "--family",
            "typical",
            "--against",
        ];
        rayscope(&[&base[..], &[file.to_str().unwrap()], arguments].concat())
    };
    assert_eq!(against(&[]).status.code(), Some(1));
    std::fs::write(&file, "{}").unwrap();
    let refused = against(&[]);
    assert!(
        refused.status.code() == Some(1)
            && String::from_utf8_lossy(&refused.stderr).contains("old.json")
    );
    std::fs::write(&file, old.to_string()).unwrap();
    assert!(stdout(&against(&[])).contains("against the earlier report"));
    let found: Value = serde_json::from_slice(&against(&["--format", "json"]).stdout).unwrap();
    assert!(found["against"].is_array());
    assert_eq!(against(&["--format", "csv"]).status.code(), Some(2));
}

#[test]
fn the_chart_has_the_axes_that_are_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("chart.svg");
    let draw = |axes: &[&str]| {
        let base = [
            "bench",
            "--quick",
            "--rays",
            "64",
            "--family",
            "typical,ties",
            "--plot",
        ];
        let drawn = rayscope(&[&base[..], &[file.to_str().unwrap()], axes].concat());
        assert!(drawn.status.success());
        std::fs::read_to_string(&file).unwrap()
    };
    let usual = draw(&[]);
    assert!(usual.find(">overview: ") < usual.find(">typical, 64 rays<"));
    for title in [
        "99 % of the errors are below, ulp",
        "ns a solve, unseen rays",
    ] {
        assert_eq!(usual.matches(title).count(), 3, "{title}");
    }
    let other = draw(&["--x", "wrong", "--y", "latency"]);
    assert!(
        other.contains("wrong answers of any kind, %") && other.contains("ns a solve, in a chain")
    );
}
