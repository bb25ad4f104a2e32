//! A benchmark beside an earlier one: what has changed by more than the noise of both.

use serde::Deserialize;

use super::text::brief;
use super::{Benchmark, MeasuredMethod, MeasuredSet};
use crate::lab::timing::Nanoseconds;

/// What is read of an earlier report in JSON.
#[derive(Debug, Clone, Deserialize)]
pub struct Earlier {
    seed: u64,
    times_trusted: bool,
    machine: EarlierMachine,
    results: Vec<EarlierRow>,
}

#[derive(Debug, Clone, Deserialize)]
struct EarlierMachine {
    cpu: String,
}

#[derive(Debug, Clone, Deserialize)]
struct EarlierRow {
    family: String,
    method: String,
    rays: usize,
    wrong: EarlierWrong,
    ulp: EarlierUlp,
    ns: Option<EarlierTimes>,
}

#[derive(Debug, Clone, Deserialize)]
struct EarlierWrong {
    false_hit: usize,
    false_miss: usize,
    wrong_count: usize,
    not_finite: usize,
}

#[derive(Debug, Clone, Deserialize)]
struct EarlierUlp {
    p99: f64,
}

#[derive(Debug, Clone, Deserialize)]
struct EarlierTimes {
    median: f64,
    iqr: f64,
}

impl Earlier {
    /// The report that `text` is, or what is wrong with it.
    pub fn parse(text: &str) -> Result<Self, String> {
        serde_json::from_str(text).map_err(|e| format!("{e}; expected the JSON of rayscope bench"))
    }
}

/// What differs from an earlier report beyond the noise of both, a sentence each; what can't be compared first.
pub fn differences(bench: &Benchmark, cpu: &str, earlier: &Earlier) -> Vec<String> {
    let mut said = Vec::new();
    let untrusted = match [bench.times_trusted(), earlier.times_trusted] {
        [true, true] => None,
        [false, true] => Some("of this run"),
        [true, false] => Some("of the earlier run"),
        [false, false] => Some("of both runs"),
    };
    if let Some(which) = untrusted {
        said.push(format!("the times {which} are not to be trusted"));
    }
    if earlier.machine.cpu != cpu {
        said.push(format!(
            "the earlier run was on another machine: {}",
            earlier.machine.cpu
        ));
    }
    let before = said.len();
    let mut compared = 0;
    for set in &bench.sets {
        for row in &set.rows {
            let same = |old: &&EarlierRow| old.family == set.name && old.method == row.method;
            if let Some(old) = earlier.results.iter().find(same) {
                compared += 1;
                said.extend(error_difference(set, row, old, bench.seed == earlier.seed));
                said.extend(time_difference(set, row, old));
            }
        }
    }
    if said.len() == before {
        let rows = if compared == 1 { "row" } else { "rows" };
        said.push(format!(
            "{compared} {rows} compared, no difference beyond the noise of both"
        ));
    }
    said
}

/// The same rays have the same errors, without any noise.
fn error_difference(
    set: &MeasuredSet,
    row: &MeasuredMethod,
    old: &EarlierRow,
    same_seed: bool,
) -> Option<String> {
    if !same_seed || old.rays != set.census.rays {
        return None;
    }
    let wrong = &old.wrong;
    let old_wrong = wrong.false_hit + wrong.false_miss + wrong.wrong_count + wrong.not_finite;
    let (new_wrong, new_p99) = (row.errors.wrong.total(), row.errors.ulp.p99);
    // The reader of JSON is good to the last digits but one.
    let same_p99 = (new_p99 - old.ulp.p99).abs() <= 1e-12 * old.ulp.p99.abs();
    if old_wrong == new_wrong && same_p99 {
        return None;
    }
    Some(format!(
        "{}, {}: {old_wrong} → {new_wrong} wrong answers, p99 {} → {} ulp",
        set.name,
        row.method,
        brief(old.ulp.p99),
        brief(new_p99),
    ))
}

fn time_difference(set: &MeasuredSet, row: &MeasuredMethod, old: &EarlierRow) -> Option<String> {
    let old = old.ns.as_ref()?;
    let Nanoseconds { median, iqr, .. } = row.times.as_ref()?.unseen.ns;
    let beyond = (median - old.median).abs() > iqr + old.iqr;
    beyond.then(|| {
        format!(
            "{}, {}: {} → {} ns, {:.2} times (iqr {} and {})",
            set.name,
            row.method,
            brief(old.median),
            brief(median),
            median / old.median,
            brief(old.iqr),
            brief(iqr),
        )
    })
}
