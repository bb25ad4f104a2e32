//! The stability sweeps: what they say of methods that are broken on purpose, whether theory and
//! measurement agree, and the report as other programs see it.

use std::process::{Command, Output};
use std::sync::LazyLock;

use rayscope::lab::stress::{self, Stability, StressPlan, bits_lost, measure};
use rayscope::lab::{Dial, Reference};
use rayscope::method::{Class, Method, Solution};
use serde_json::Value;

fn plan(dials: &[&str], rays: usize) -> StressPlan {
    StressPlan {
        methods: Method::ALL.into(),
        dials: dials
            .iter()
            .map(|name| Dial::by_name(name).unwrap())
            .collect(),
        seed: 1,
        rays,
    }
}

/// All dials, few rays; made once.
static ALL_DIALS: LazyLock<Stability> = LazyLock::new(|| {
    let names: Vec<&str> = Dial::ALL.iter().map(|dial| dial.name).collect();
    stress::run(&plan(&names, 64), |_, _| true)
});

#[test]
fn bits_are_lost_from_half_an_ulp_on_and_no_more_than_there_are() {
    assert_eq!(bits_lost(0.3), 0.0);
    assert_eq!(bits_lost(0.5), 0.0);
    assert_eq!(bits_lost(4.0), 3.0);
    assert_eq!(bits_lost(1e12), 24.0);
}

#[test]
fn a_method_that_is_broken_on_purpose_is_caught() {
    let dial = Dial::by_name("altitude").unwrap();
    let k = -4;
    let problems = dial.sample(1, k, 200);
    let truths = Reference::all(&problems);
    let of = |spoil: &dyn Fn(Solution) -> Solution| {
        measure(dial, k, &problems, &truths, |r, s| {
            spoil(Method::Exact.solve(r, s))
        })
    };

    let right = of(&|answer| answer);
    assert_eq!(right.errors.wrong.total() + right.moved, 0);
    assert_eq!(right.blame.max, 0.0);
    assert_eq!(right.bits_worst(), Some(0.0));

    // 2⁻¹⁰ of the root is 2¹³ to 2¹⁴ ulp, and far more than κu.
    let near = |answer: Solution, near| Solution::with_roots(answer.class, near, answer.far);
    let off = of(&|answer| near(answer, answer.near * (1.0 + 1.0 / 1024.0)));
    assert_eq!(off.errors.wrong.total(), 0);
    assert!(
        (14.0..=15.1).contains(&off.bits_median().unwrap()),
        "{:?}",
        off.bits_median()
    );
    assert!(off.blame.p50 > 100.0, "{}", off.blame.p50);
    assert_eq!(
        off.moved, 0,
        "a thousandth of the way is less than half a pixel"
    );

    let far_off = of(&|answer| near(answer, answer.near * 1.1));
    assert_eq!(
        far_off.moved, far_off.errors.judged,
        "a tenth of the way is more"
    );

    let blind = of(&|_| Solution::MISS);
    assert_eq!(
        blind.errors.wrong.false_miss,
        truths.iter().filter(|t| t.class.meets()).count()
    );
    assert_eq!(blind.bits_worst(), None);

    // A hit seen where there is none to see: behind the eye.
    let behind = of(&|answer| Solution::with_roots(answer.class, -2.0, -1.0));
    assert_eq!(behind.moved, behind.errors.judged);
}

#[test]
fn the_methods_break_down_where_theory_says_they_should() {
    let report = &*ALL_DIALS;
    let json: Value = serde_json::from_str(&stress::json(report)).unwrap();
    let breakdowns = json["breakdowns"].as_array().unwrap();
    assert_eq!(breakdowns.len(), Dial::ALL.len() * Method::ALL.len());
    for place in breakdowns {
        for event in ["wrong", "moved"] {
            assert_eq!(place[event]["agree"], true, "{place}");
        }
    }
    // The famous figure: all of r² is gone from |o|² at 2¹² radii.
    let textbook = &breakdowns[0];
    assert_eq!(
        [&textbook["dial"], &textbook["method"]],
        ["distance", "textbook"]
    );
    assert!(textbook["wrong"]["found"].as_i64().unwrap() <= 12);
}

#[test]
fn both_promises_are_kept_and_a_broken_one_is_said() {
    let mut report = ALL_DIALS.clone();
    assert!(report.promises_kept() && report.complete);
    assert_eq!(report.kept.len(), 2);
    assert!(
        report
            .kept
            .iter()
            .all(|kept| kept.asked == report.kept[0].asked && kept.asked > 20_000)
    );
    report.kept[0].broken = 1;
    report.kept[0].first = Dial::ALL[0].sample(1, 1, 1).pop();
    assert!(!report.promises_kept());
    assert!(stress::text(&report).text().contains("promises BROKEN"));
    let json: Value = serde_json::from_str(&stress::json(&report)).unwrap();
    assert_eq!(json["promises_kept"], false);
    assert_eq!(json["promises"][0]["first"].as_array().unwrap().len(), 10);
}

#[test]
fn exact_and_double_pass_every_check_and_textbook_does_not() {
    for check in &ALL_DIALS.checks {
        assert_eq!(check.rays, 400, "{}", check.name);
        assert_eq!(check.failed > 0, check.first.is_some());
        if matches!(check.method, Method::Exact | Method::Double) {
            assert_eq!(check.failed, 0, "{}: {}", check.method, check.name);
        }
    }
    let textbook = ALL_DIALS
        .checks
        .iter()
        .filter(|c| c.method == Method::Textbook);
    let failed: Vec<&str> = textbook.filter(|c| c.failed > 0).map(|c| c.name).collect();
    assert_eq!(failed.len(), 3, "{failed:?}");
}

#[test]
fn rounding_the_inputs_is_shown_apart_from_the_methods() {
    let offset = ALL_DIALS
        .sweeps
        .iter()
        .find(|s| s.dial.name == "offset")
        .unwrap();
    let bits = |i: usize| bits_lost(offset.steps[i].inputs.unwrap().ulp.p50);
    assert!(bits(0) < 1.0);
    assert!(
        (offset.steps.len() - 1..)
            .take(1)
            .all(|last| bits(last) > 18.0)
    );
    let exact = Method::ALL
        .iter()
        .position(|&m| m == Method::Exact)
        .unwrap();
    assert!(
        offset
            .steps
            .iter()
            .all(|step| step.cells[exact].bits_worst() == Some(0.0))
    );
    assert!(ALL_DIALS.sweeps[0].steps[0].inputs.is_none());
}

#[test]
fn a_run_that_is_ended_early_reports_what_is_complete() {
    let report = stress::run(&plan(&["distance", "altitude"], 8), |number, _| number < 1);
    assert!(!report.complete);
    assert_eq!(report.sweeps.len(), 1);
    assert!(report.checks.is_empty());
    assert!(stress::text(&report).text().contains("Interrupted"));
}

fn rayscope(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_rayscope"))
        .args(arguments)
        .output()
        .unwrap()
}

#[test]
fn the_table_fits_eighty_columns() {
    for line in stress::text(&ALL_DIALS).text().lines() {
        assert!(line.chars().count() <= 80, "{line}");
    }
}

#[test]
fn csv_and_json_have_the_documented_fields_and_the_exit_status_is_good() {
    let documented = std::fs::read_to_string("docs/stability.md").unwrap_or_default();
    let small = ["stress", "--dial", "tangency", "--rays", "32", "--format"];
    let run = |format| rayscope(&[&small[..], &[format]].concat());

    let output = run("csv");
    assert!(output.status.success(), "{output:?}");
    let mut csv = csv::Reader::from_reader(output.stdout.as_slice());
    for column in csv.headers().unwrap() {
        assert!(
            documented.contains(&format!("`{column}`")),
            "{column} is not in docs/stability.md"
        );
    }
    let settings = Dial::by_name("tangency").unwrap().settings().count();
    assert_eq!(
        csv.records().map(Result::unwrap).count(),
        settings * Method::ALL.len()
    );

    let output = run("json");
    assert!(
        output.status.success() && output.stderr.is_empty(),
        "{output:?}"
    );
    let json: Value = serde_json::from_slice(&output.stdout).unwrap();
    for field in json.as_object().unwrap().keys() {
        assert!(
            documented.contains(&format!("`{field}`")),
            "{field} is not in docs/stability.md"
        );
    }
    assert_eq!(json["promises_kept"], true);
    assert_eq!(
        json["settings"].as_array().unwrap().len(),
        settings * Method::ALL.len()
    );
}

#[test]
fn the_same_seed_gives_the_same_answers() {
    let checksum = |seed| {
        let plan = StressPlan {
            seed,
            ..plan(&["short"], 8)
        };
        stress::run(&plan, |_, _| true).checksum()
    };
    assert_eq!(checksum(1), checksum(1));
    assert_ne!(checksum(1), checksum(2));
}

#[test]
fn nearly_tangent_rays_are_told_apart_only_by_what_is_exact() {
    let dial = Dial::by_name("tangency").unwrap();
    let problems = dial.sample(1, -40, 100);
    let truths = Reference::all(&problems);
    assert!(truths.iter().all(|truth| truth.class != Class::Tangent));
    let wrong = |method: Method| {
        measure(dial, -40, &problems, &truths, |r, s| method.solve(r, s))
            .errors
            .wrong
            .total()
    };
    assert_eq!(wrong(Method::Exact), 0);
    assert!(wrong(Method::Double) > 50);
}
