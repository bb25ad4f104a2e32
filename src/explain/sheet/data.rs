//! A sheet as data for programs, and as Markdown for documents.

use serde::Serialize;

use super::text::step_written;
use super::{Equation, Step};
use crate::report::Report;

/// A step of a sheet, as programs read it.
#[derive(Debug, Serialize)]
pub struct StepData<'a> {
    name: &'a str,
    equations: Vec<EquationData<'a>>,
    outcome: &'a [String],
    why: &'a str,
    code: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    exact: Option<&'a str>,
    #[serde(skip_serializing_if = "<[String]>::is_empty")]
    losses: &'a [String],
}

#[derive(Debug, Serialize)]
struct EquationData<'a> {
    formula: &'a str,
    links: Vec<LinkData<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    ledger: Vec<TermData<'a>>,
}

#[derive(Debug, Serialize)]
struct LinkData<'a> {
    sign: &'static str,
    text: &'a str,
}

#[derive(Debug, Serialize)]
struct TermData<'a> {
    term: &'a str,
    number: &'a str,
}

impl<'a> StepData<'a> {
    /// What a step says.
    pub fn of(step: &'a Step) -> Self {
        Self {
            name: &step.name,
            equations: step.equations.iter().map(EquationData::of).collect(),
            outcome: &step.outcome,
            why: &step.why,
            code: &step.code,
            exact: step.exact.as_deref(),
            losses: &step.losses,
        }
    }
}

impl<'a> EquationData<'a> {
    fn of(equation: &'a Equation) -> Self {
        let longest = equation.ways.first().into_iter().flatten();
        Self {
            formula: &equation.formula,
            links: longest
                .map(|link| LinkData {
                    sign: link.sign.text(),
                    text: &link.text,
                })
                .collect(),
            ledger: equation
                .ledger
                .iter()
                .map(|entry| TermData {
                    term: &entry.label,
                    number: &entry.number,
                })
                .collect(),
        }
    }
}

/// A sheet as a part of a document: for each step its lines, its reason, and the statement that does it.
pub fn sheet_report(title: &str, steps: &[Step], width: usize) -> Report {
    steps
        .iter()
        .fold(Report::new().words(title), |report, step| {
            let report = report.heading(&step.name).fixed(step_written(step, width));
            let report = if step.why.is_empty() {
                report
            } else {
                report.words(&step.why)
            };
            match step.code.as_str() {
                "" => report,
                code => report.fixed(vec![code.to_owned()]),
            }
        })
}
