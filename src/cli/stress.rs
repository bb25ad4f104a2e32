//! `rayscope stress`: the stability sweeps.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, ValueEnum};

use super::progress::{INTERRUPTED, Progress};
use super::{INVALID, choice, complain, save, seed, whole, write_out};
use crate::lab::stress::{self, Plan, Report};
use crate::lab::{Dial, plot};
use crate::method::Method;

/// Turn one dial after the other from tame to broken: where does each method break down?
#[derive(Debug, Args)]
pub(super) struct Stress {
    /// Fewer rays at each setting: seconds instead of minutes
    #[arg(long)]
    quick: bool,

    /// What the rays are drawn from; the same seed gives the same rays everywhere
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = seed, allow_negative_numbers = true)]
    seed: u64,

    /// Only these methods, separated by commas
    #[arg(long, value_name = "NAMES", value_delimiter = ',', value_parser = choice(&Method::ALL, Method::name))]
    method: Vec<Method>,

    /// Only these dials, separated by commas
    #[arg(long, value_name = "NAMES", value_delimiter = ',', value_parser = dial())]
    dial: Vec<&'static Dial>,

    /// How many rays at each setting
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = whole(1_u32, 1_000_000))]
    rays: Option<u32>,

    /// Also draw a chart, as SVG
    #[arg(long, value_name = "FILE")]
    plot: Option<PathBuf>,

    /// How the report is written
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    Text,
    Csv,
    Json,
    Markdown,
}

fn dial() -> impl TypedValueParser<Value = &'static Dial> {
    PossibleValuesParser::new(Dial::ALL.iter().map(|dial| dial.name))
        .try_map(|name| Dial::by_name(&name).ok_or("no such dial"))
}

/// Runs what was asked for; the exit status says whether `exact` and `double` kept their promises.
pub(super) fn run(arguments: &Stress) -> ExitCode {
    let plan = plan(arguments);
    let mut progress = match Progress::new("stress", plan.dials.len() + 1) {
        Ok(progress) => progress,
        Err(error) => {
            complain(format_args!("signals: {error}"));
            return ExitCode::from(INVALID);
        }
    };
    let report = stress::run(&plan, |number, name| progress.go_on(number, name));
    progress.clear();
    let drawn = save(arguments.plot.as_deref(), || plot::stability(&report));
    let written = match in_format(&report, arguments.format) {
        Ok(text) => write_out(&text),
        Err(sentence) => {
            complain(sentence);
            ExitCode::from(INVALID)
        }
    };
    if progress.interrupted() {
        ExitCode::from(INTERRUPTED)
    } else if report.promises_kept() && drawn.is_ok() {
        written
    } else {
        ExitCode::from(INVALID)
    }
}

fn plan(arguments: &Stress) -> Plan {
    let usual = if arguments.quick { 256 } else { 2048 };
    Plan {
        methods: if arguments.method.is_empty() {
            Method::ALL.into()
        } else {
            arguments.method.clone()
        },
        dials: if arguments.dial.is_empty() {
            Dial::ALL.iter().collect()
        } else {
            arguments.dial.clone()
        },
        seed: arguments.seed,
        rays: arguments.rays.map_or(usual, |rays| rays as usize),
    }
}

fn in_format(report: &Report, format: Format) -> Result<String, String> {
    match format {
        Format::Text => Ok(stress::table(report)),
        Format::Markdown => Ok(stress::markdown(report)),
        Format::Csv => stress::csv(report).map_err(|e| format!("CSV: {e}")),
        Format::Json => stress::json(report).map_err(|e| format!("JSON: {e}")),
    }
}
