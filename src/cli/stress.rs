//! `rayscope stress`: the stability sweeps.

use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};

use super::failure::{DONE, INVALID};
use super::progress::{INTERRUPTED, Progress};
use super::sweep::SweepArgs;
use super::{Failure, Outcome, save, whole, write_out};
use crate::lab::stress::{self, Stability, StressPlan};
use crate::lab::{Dial, plot};
use crate::report::Format;

/// Turn one dial after the other until methods fail: where does each break down?
#[derive(Debug, Args)]
pub(super) struct StressArgs {
    #[command(flatten)]
    sweep: SweepArgs,

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
pub(super) fn run(arguments: &StressArgs) -> Outcome {
    let plan = plan(arguments)?;
    let mut progress = Progress::new("stress", plan.dials.len() + 1)?;
    let swept = stress::run(&plan, |number, name| progress.go_on(number, name));
    progress.clear();
    let drawn = save(arguments.sweep.plot.as_deref(), || plot::stability(&swept));
    write_out(&in_format(&swept, arguments.sweep.format))?;
    drawn?;
    Ok(if progress.interrupted() {
        INTERRUPTED
    } else if swept.promises_kept() {
        DONE
    } else {
        INVALID
    })
}

fn plan(arguments: &StressArgs) -> Result<StressPlan, Failure> {
    let usual = if arguments.sweep.quick { 256 } else { 2048 };
    Ok(StressPlan {
        methods: arguments.sweep.methods()?,
        dials: if arguments.dial.is_empty() {
            Dial::ALL.iter().collect()
        } else {
            arguments.dial.clone()
        },
        seed: arguments.sweep.seed,
        rays: arguments.rays.map_or(usual, |rays| rays as usize),
    })
}

fn in_format(swept: &Stability, format: Format) -> String {
    match format {
        Format::Text => stress::text(swept).text(),
        Format::Markdown => stress::markdown(swept).markdown(),
        Format::Csv => stress::records(swept).csv(),
        Format::Json => stress::json(swept),
    }
}
