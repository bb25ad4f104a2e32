//! The figures in docs/accuracy.md and docs/stability.md, errors and not times, are what the code
//! gives. `RAYSCOPE_UPDATE_DOCS=1` rewrites them. And the charts are well-formed.

use std::fmt::Write as _;
use std::fs;

use rayscope::lab::bench::{self, BenchPlan, Benchmark, MeasuredMethod, MeasuredSet, Sample};
use rayscope::lab::chart::ChartAxes;
use rayscope::lab::stress;
use rayscope::lab::timing::{Clock, Schedule};
use rayscope::lab::{Dial, Family, Machine, plot};
use rayscope::method::Method;

/// Holds what stands between two marks of a document against what it should be, or rewrites it.
fn assert_documented(path: &str, mark: &str, fresh: &str) {
    let document = fs::read_to_string(path).unwrap();
    let (start, end) = (
        format!("<!-- {mark} -->\n"),
        format!("<!-- end of {mark} -->"),
    );
    let (before, rest) = document
        .split_once(&start)
        .unwrap_or_else(|| panic!("{start} in {path}"));
    let (listed, after) = rest
        .split_once(&end)
        .unwrap_or_else(|| panic!("{end} in {path}"));
    if std::env::var_os("RAYSCOPE_UPDATE_DOCS").is_some() {
        fs::write(path, format!("{before}{start}{fresh}{end}{after}")).unwrap();
    } else {
        assert!(
            listed == fresh,
            "{path}, {mark}: RAYSCOPE_UPDATE_DOCS=1 cargo test rewrites it; it should be\n{fresh}"
        );
    }
}

/// Times are not what is tested here.
struct NoClock;

impl Clock for NoClock {
    fn now(&self) -> u64 {
        0
    }
}

/// What `rayscope bench --quick` asks.
fn quick_bench() -> Benchmark {
    let plan = BenchPlan {
        methods: &Method::ALL,
        // Times are not looked at.
        schedule: Schedule {
            rounds: 1,
            passes: 1,
            unseen: 64,
            seed: 1,
        },
    };
    let sample = |family| Sample::of_family(family, 1, 2048);
    let samples: Vec<Sample> = Family::ALL.iter().map(sample).collect();
    bench::run(plan, &samples, 1, &NoClock, |_, _| true)
}

/// What `rayscope stress --quick` asks.
fn quick_stress() -> stress::Stability {
    let plan = stress::StressPlan {
        methods: Method::ALL.into(),
        dials: Dial::ALL.iter().collect(),
        seed: 1,
        rays: 256,
    };
    stress::run(&plan, |_, _| true)
}

fn details(set: &MeasuredSet) -> String {
    format!(
        "\n### {}\n\n{}\n\n{}",
        set.name,
        set.about,
        bench::error_table(set).markdown()
    )
}

#[test]
fn the_errors_in_the_docs_are_those_of_the_code_and_their_chart_is_well_formed() {
    let report = quick_bench();
    let path = "docs/accuracy.md";
    assert_documented(path, "overview", &bench::error_overview(&report).markdown());
    let all: String = report.sets.iter().map(details).collect();
    assert_documented(path, "errors", &format!("{all}\n"));

    let svg = plot::work_precision(&report, &Machine::detect(), ChartAxes::default());
    assert_well_formed(&svg);
    for set in &report.sets {
        assert!(svg.contains(&format!(">{}, 2048 rays<", set.name)));
    }
    let none_right = |row: &MeasuredMethod| row.errors.judged == 0;
    assert!(report.sets.iter().flat_map(|c| &c.rows).any(none_right));
    assert!(svg.contains("TIMES NOT TRUSTED"));
}

#[test]
fn the_sweeps_in_the_docs_are_those_of_the_code_and_their_chart_is_well_formed() {
    let report = quick_stress();
    let path = "docs/stability.md";
    assert_documented(path, "summary", &stress::summary_table(&report).markdown());
    assert_documented(path, "checks", &stress::check_table(&report).markdown());
    let mut all = String::new();
    for sweep in &report.sweeps {
        let _ = write!(all, "\n### {}\n\n{}\n\n", sweep.dial.name, sweep.dial.about);
        all += &stress::sweep_table(&report, sweep).markdown();
    }
    assert_documented(path, "sweeps", &format!("{all}\n"));

    let svg = plot::stability(&report);
    assert_well_formed(&svg);
    for dial in Dial::ALL {
        assert!(svg.contains(&format!(">{}: ", dial.name)), "{}", dial.name);
    }
}

/// Tags nest and close, attributes are quoted, and nothing is drawn at a place that is no number.
fn assert_well_formed(svg: &str) {
    let mut open: Vec<&str> = Vec::new();
    let mut rest = svg;
    while let Some(at) = rest.find('<') {
        let text = &rest[..at];
        assert!(
            !text.contains('>')
                && !text
                    .replace("&amp;", "")
                    .replace("&lt;", "")
                    .replace("&gt;", "")
                    .contains('&'),
            "{text}"
        );
        let end = rest[at..].find('>').expect("an open tag ends") + at;
        let tag = &rest[at + 1..end];
        assert_eq!(tag.matches('"').count() % 2, 0, "{tag}");
        assert!(!tag.contains("NaN") && !tag.contains("inf"), "{tag}");
        if let Some(name) = tag.strip_prefix('/') {
            assert_eq!(open.pop(), Some(name), "{tag}");
        } else if !tag.ends_with('/') {
            open.push(tag.split_whitespace().next().unwrap());
        }
        rest = &rest[end + 1..];
    }
    assert!(open.is_empty() && rest.trim().is_empty());
    assert!(svg.starts_with("<svg xmlns=\"http://www.w3.org/2000/svg\""));
}

#[test]
#[should_panic(expected = "left")]
fn what_is_not_well_formed_is_noticed() {
    assert_well_formed("<svg xmlns=\"http://www.w3.org/2000/svg\"><text>a</svg></text>");
}
