//! `--lens`, and what it is where it is not given: a method that is named asks for the machine's.

use clap::builder::TypedValueParser as _;
use clap::parser::ValueSource;
use clap::{Arg, ArgMatches, Args, Command, FromArgMatches};

use super::choice;
use crate::explain::Lens;

/// The flag for the lens, as given or as the others imply.
#[derive(Debug, Clone, Copy)]
pub(super) struct LensFlag(Lens);

impl LensFlag {
    /// Through which lens to look.
    pub(super) const fn chosen(self) -> Lens {
        self.0
    }
}

impl Args for LensFlag {
    fn augment_args(command: Command) -> Command {
        command.arg(
            Arg::new("lens")
                .long("lens")
                .value_name("LENS")
                .help("The mathematics of a pixel, or the machine's arithmetic [default: mathematics; machine if --method is given]")
                .value_parser(choice(&Lens::ALL, Lens::name).map(|lens| lens)),
        )
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl FromArgMatches for LensFlag {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        let is_method_given = matches.value_source("method") == Some(ValueSource::CommandLine);
        let implied = if is_method_given {
            Lens::Machine
        } else {
            Lens::Mathematics
        };
        Ok(Self(matches.get_one("lens").copied().unwrap_or(implied)))
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}
