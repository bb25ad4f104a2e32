//! `rayscope stress`: the stability sweeps.

use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};

use super::failure::{DONE, INVALID};
use super::progress::{INTERRUPTED, Progress};
use super::sweep::{Format, Sweep};
use super::{Failure, Outcome, save, whole, write_out};
use crate::lab::stress::{self, Plan, Report};
use crate::lab::{Dial, plot};

/// Turn one dial after the other from tame to broken: where does each method break down?
#[derive(Debug, Args)]
pub(super) struct Stress {
    #[command(flatten)]
    sweep: Sweep,

    /// Only these dials, separated by commas
    #[arg(long, value_name = "NAMES", value_delimiter = ',', value_parser = dial())]
    dial: Vec<&'static Dial>,

    /// How many rays at each setting
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = whole(1_u32, 1_000_000))]
    rays: Option<u32>,
}

fn dial() -> impl TypedValueParser<Value = &'static Dial> {
    PossibleValuesParser::new(Dial::ALL.iter().map(|dial| dial.name))
        .try_map(|name| Dial::by_name(&name).ok_or("no such dial"))
}

/// Runs what was asked for; the exit status says whether `exact` and `double` kept their promises.
pub(super) fn run(arguments: &Stress) -> Outcome {
    let plan = plan(arguments);
    let mut progress = Progress::new("stress", plan.dials.len() + 1)?;
    let report = stress::run(&plan, |number, name| progress.go_on(number, name));
    progress.clear();
    let drawn = save(arguments.sweep.plot.as_deref(), || plot::stability(&report));
    let text = in_format(&report, arguments.sweep.format).map_err(Failure::invalid)?;
    write_out(&text)?;
    drawn?;
    Ok(if progress.interrupted() {
        INTERRUPTED
    } else if report.promises_kept() {
        DONE
    } else {
        INVALID
    })
}

fn plan(arguments: &Stress) -> Plan {
    let usual = if arguments.sweep.quick { 256 } else { 2048 };
    Plan {
        methods: arguments.sweep.methods().into(),
        dials: if arguments.dial.is_empty() {
            Dial::ALL.iter().collect()
        } else {
            arguments.dial.clone()
        },
        seed: arguments.sweep.seed,
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
