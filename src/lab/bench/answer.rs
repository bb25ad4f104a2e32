//! What an engineer asks of a benchmark: for each kind of rays, which method is right, what it costs, and
//! what is the cheapest that is right.

use super::{Benchmark, MeasuredMethod, MeasuredSet};
use crate::lab::bench::text::brief;
use crate::lab::errors::nearest_rank;
use crate::report::{Column, Table};

/// A method that is right enough on all sets of a kind.
#[derive(Debug, Clone, PartialEq)]
pub struct Choice {
    /// Its name.
    pub method: &'static str,
    /// Nanoseconds for one solve of a ray not seen before, of the cheapest set, the middle one and the dearest;
    /// none where it was not timed.
    pub ns: Option<[f64; 3]>,
    /// The greatest p99 of the sets, in ulp.
    pub p99: f64,
}

/// The answer for one kind of rays.
#[derive(Debug, Clone, PartialEq)]
pub struct Answer {
    /// The kind.
    pub kind: String,
    /// On how many sets.
    pub sets: usize,
    /// The methods without a wrong answer, no root of which is off by more than an ulp: the cheapest first.
    pub right: Vec<Choice>,
    /// How many of the first of these take about the same time; 1 if the cheapest is told apart.
    pub cheapest: usize,
    /// Of the methods without a wrong answer, however large their errors, the cheapest.
    pub without_wrong: Option<Choice>,
}

/// A method whose errors are no larger is right but for the last bit.
const RIGHT: f64 = 1.0;

/// The answers of a run, kind by kind in the order in which they come.
pub fn answers(bench: &Benchmark) -> Vec<Answer> {
    let mut kinds: Vec<&str> = Vec::new();
    for set in &bench.sets {
        if !kinds.contains(&set.kind.as_str()) {
            kinds.push(&set.kind);
        }
    }
    let of_kind = |kind: &str| {
        let sets: Vec<&MeasuredSet> = bench.sets.iter().filter(|set| set.kind == kind).collect();
        answer(kind, &sets)
    };
    kinds.into_iter().map(of_kind).collect()
}

fn answer(kind: &str, sets: &[&MeasuredSet]) -> Answer {
    let methods = sets[0].rows.len();
    let rows = |method: usize| sets.iter().map(move |set| &set.rows[method]);
    let no_wrong = |&method: &usize| rows(method).all(|row| row.errors.wrong.total() == 0);
    let mut candidates: Vec<usize> = (0..methods).filter(no_wrong).collect();
    // By the median over the sets; who was not timed comes last.
    candidates.sort_by(|&a, &b| typical_time(rows(a)).total_cmp(&typical_time(rows(b))));
    let is_right = |&&method: &&usize| rows(method).all(|row| row.errors.ulp.max <= RIGHT);
    let right: Vec<usize> = candidates.iter().filter(is_right).copied().collect();
    let alike = |&&other: &&usize| {
        let pairs = rows(right[0]).zip(rows(other));
        pairs.filter(|(a, b)| is_told_apart(a, b)).count() * 2 <= sets.len()
    };
    let cheapest = right.iter().take_while(alike).count();
    let choice = |method: usize| Choice {
        method: sets[0].rows[method].method,
        ns: span(rows(method)),
        p99: rows(method)
            .map(|row| row.errors.ulp.p99)
            .fold(0.0, f64::max),
    };
    Answer {
        kind: kind.to_owned(),
        sets: sets.len(),
        cheapest,
        without_wrong: candidates.first().map(|&method| choice(method)),
        right: right.into_iter().map(choice).collect(),
    }
}

fn is_told_apart(one: &MeasuredMethod, other: &MeasuredMethod) -> bool {
    match (&one.times, &other.times) {
        (Some(one), Some(other)) => one.unseen.is_told_apart_from(&other.unseen),
        _ => true,
    }
}

fn medians<'a>(rows: impl Iterator<Item = &'a MeasuredMethod>) -> Option<Vec<f64>> {
    let mut medians: Vec<f64> = rows
        .map(|row| Some(row.times.as_ref()?.unseen.ns.median))
        .collect::<Option<_>>()?;
    medians.sort_by(f64::total_cmp);
    Some(medians)
}

fn typical_time<'a>(rows: impl Iterator<Item = &'a MeasuredMethod>) -> f64 {
    medians(rows).map_or(f64::INFINITY, |sorted| nearest_rank(&sorted, 1, 2))
}

fn span<'a>(rows: impl Iterator<Item = &'a MeasuredMethod>) -> Option<[f64; 3]> {
    let sorted = medians(rows)?;
    Some([
        *sorted.first()?,
        nearest_rank(&sorted, 1, 2),
        *sorted.last()?,
    ])
}

impl Choice {
    /// What it costs in the middle set, as text.
    fn cost(&self) -> String {
        let short = |ns: f64| {
            if ns < 9.95 {
                format!("{ns:.1}")
            } else {
                format!("{ns:.0}")
            }
        };
        match self.ns {
            None => "not timed".to_owned(),
            Some([_, middle, _]) => short(middle),
        }
    }
}

impl Answer {
    /// The cheapest that is right; several where they take about the same time.
    fn cheapest(&self) -> String {
        let names: Vec<&str> = self.right[..self.cheapest]
            .iter()
            .map(|c| c.method)
            .collect();
        names.join(" or ")
    }
}

/// The answers as a table.
pub(super) fn table(bench: &Benchmark) -> Table {
    let columns = [
        "kind of rays",
        "right, ns",
        "cheapest right",
        "never wrong, p99",
    ];
    let none = || "none".to_owned();
    let row = |answer: Answer| {
        let right: Vec<String> = answer
            .right
            .iter()
            .map(|choice| format!("{} {}", choice.method, choice.cost()))
            .collect();
        let [right, cheapest] = if right.is_empty() {
            [none(), none()]
        } else {
            [right.join(", "), answer.cheapest()]
        };
        let without_wrong = answer.without_wrong.as_ref().map_or_else(none, |choice| {
            format!("{} {}, {}", choice.method, choice.cost(), brief(choice.p99))
        });
        vec![answer.kind, right, cheapest, without_wrong]
    };
    Table::new(
        columns.map(Column::left),
        answers(bench).into_iter().map(row),
    )
}

/// What the columns mean.
pub(super) const LEGEND: [&str; 2] = [
    "right: in no family of the kind a wrong answer, or a root off by over an ulp",
    "ns of the middle family; never wrong: the cheapest without a wrong answer",
];
