//! What the long measurements, `bench` and `stress`, are asked alike.

use std::path::PathBuf;

use clap::Args;

use super::{Failure, MethodName, choice, method_name, seed};
use crate::method::Method;
use crate::report::Format;

/// How much is measured, of what, and how it is told.
#[derive(Debug, Args)]
pub(super) struct SweepArgs {
    /// Fewer rays and rounds: seconds instead of minutes
    #[arg(long)]
    pub quick: bool,

    /// The seed that the rays come from; the same seed gives the same rays everywhere
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = seed, allow_negative_numbers = true)]
    pub seed: u64,

    /// Only these methods, separated by commas
    #[arg(long, value_name = "NAMES", value_delimiter = ',', value_parser = method_name())]
    method: Vec<MethodName>,

    /// Also draw a chart, as SVG
    #[arg(long, value_name = "FILE")]
    pub plot: Option<PathBuf>,

    /// How the report is written
    #[arg(long, value_parser = choice(&Format::ALL, Format::name), default_value = Format::Text.name())]
    pub format: Format,
}

impl SweepArgs {
    /// The methods that are asked for by name, if any is.
    pub fn named(&self) -> Result<Option<Vec<Method>>, Failure> {
        let methods: Result<Vec<_>, _> = self.method.iter().map(MethodName::method).collect();
        methods.map(|methods| (!methods.is_empty()).then_some(methods))
    }

    /// The methods that are asked for: all, if none is named.
    pub fn methods(&self) -> Result<Vec<Method>, Failure> {
        Ok(self.named()?.unwrap_or_else(|| Method::ALL.to_vec()))
    }
}
