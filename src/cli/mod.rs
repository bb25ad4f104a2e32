//! The command line: parses the arguments and calls the part that does the work.

mod appearance;
mod bench;
#[cfg(feature = "routine")]
mod check;
mod completions;
mod explore;
mod failure;
mod grade;
mod harness;
mod lens;
mod output;
mod place;
mod plan;
mod print;
mod progress;
mod routine;
mod rows;
mod scenes;
mod screens;
mod solve;
mod stress;
mod sweep;
mod tour;
mod unseen;
mod variables;
mod worksheet;

use std::borrow::Cow;
use std::ffi::OsStr;
use std::fmt;
use std::io::{self, Write as _};
use std::path::Path;
use std::process::ExitCode;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Arg, Command, CommandFactory, FromArgMatches, Parser, Subcommand};

use crate::door;
use crate::method::Method;
use crate::text::{by_name, former_names, printable, read};
use failure::{DONE, Failure, Outcome};
use output::{complain, save, unwritable, write_out, write_picture};

/// A terminal explorer for ray–sphere intersection.
#[derive(Debug, Parser)]
#[command(version, about, args_conflicts_with_subcommands = true)]
struct Arguments {
    #[command(subcommand)]
    command: Option<CliCommand>,

    #[command(flatten)]
    explore: explore::Explore,

    /// In routines, fuse a product and a sum into one operation, as compilers do by default on some processors
    #[cfg(feature = "routine")]
    #[arg(long, global = true)]
    contract: bool,
}

#[derive(Debug, Subcommand)]
enum CliCommand {
    Bench(bench::BenchArgs),
    #[cfg(feature = "routine")]
    Check(check::CheckArgs),
    Completions(completions::Completions),
    Grade(grade::GradeArgs),
    Harness(harness::HarnessArgs),
    Plan(plan::PlanArgs),
    Print(print::Print),
    Routine(routine::RoutineArgs),
    Scenes(scenes::Scenes),
    Solve(solve::Solve),
    Stress(stress::StressArgs),
    Tour(Box<tour::TourArgs>),
    Worksheet(worksheet::WorksheetArgs),
}

/// Runs the program with the arguments of this process.
pub fn main() -> ExitCode {
    let outcome = arguments().and_then(|arguments| arguments.map_or(Ok(DONE), |a| run(&a)));
    ExitCode::from(outcome.unwrap_or_else(|Failure { status, sentence }| {
        complain(sentence);
        status
    }))
}

fn run(arguments: &Arguments) -> Outcome {
    #[cfg(feature = "routine")]
    if arguments.contract {
        Method::contract_routines();
    }
    match &arguments.command {
        None => explore::run(&arguments.explore),
        #[cfg(feature = "routine")]
        Some(CliCommand::Check(arguments)) => check::run(arguments),
        Some(CliCommand::Completions(arguments)) => completions::run(arguments),
        Some(CliCommand::Bench(arguments)) => bench::run(arguments),
        Some(CliCommand::Grade(arguments)) => grade::run(arguments),
        Some(CliCommand::Harness(arguments)) => harness::run(arguments),
        Some(CliCommand::Plan(arguments)) => plan::run(arguments),
        Some(CliCommand::Print(arguments)) => print::run(arguments),
        Some(CliCommand::Routine(arguments)) => routine::run(arguments),
        Some(CliCommand::Scenes(arguments)) => scenes::run(arguments),
        Some(CliCommand::Solve(arguments)) => solve::run(arguments),
        Some(CliCommand::Stress(arguments)) => stress::run(arguments),
        Some(CliCommand::Tour(arguments)) => tour::run(arguments),
        Some(CliCommand::Worksheet(arguments)) => worksheet::run(arguments),
    }
}

/// The arguments of this process; none if they asked for help, which is written then.
fn arguments() -> Result<Option<Arguments>, Failure> {
    let mut command = variables::without_empty(Arguments::command());
    let matches = command.try_get_matches_from_mut(std::env::args_os());
    let arguments = matches.and_then(|matches| {
        let arguments = Arguments::from_arg_matches(&matches);
        arguments.map_err(|error| error.format(&mut command))
    });
    match arguments {
        Ok(arguments) => Ok(Some(arguments)),
        Err(error) => match variables::at_fault(&error, &command) {
            Some(sentence) => Err(Failure::misused(sentence)),
            None if error.use_stderr() => exit(&error),
            None => error.print().or_else(|e| unwritable(&e)).map(|()| None),
        },
    }
}

/// Ends the program where it was called wrongly; what is wrong may hold what steers a terminal.
fn exit(error: &clap::Error) -> ! {
    let plain = error.render().to_string();
    match printable(&plain) {
        Cow::Borrowed(_) => error.exit(),
        Cow::Owned(shown) => {
            // If nobody can read it, nobody is missing it.
            let _ = io::stderr().write_all(shown.as_bytes());
            std::process::exit(error.exit_code())
        }
    }
}

/// Reads one of several values by its name.
fn choice<T: Copy + Send + Sync + 'static>(
    all: &'static [T],
    name: fn(T) -> &'static str,
) -> impl TypedValueParser<Value = T> {
    let names = all.iter().map(|&v| name(v));
    let values = names.map(|name| PossibleValue::new(name).aliases(former_names(name)));
    PossibleValuesParser::new(values)
        .try_map(move |given| by_name(all.iter().copied(), name, &given).ok_or("no such name"))
}

/// A method as it is named: built in, or the file of a routine, which is read when it is asked for.
#[derive(Debug, Clone, PartialEq, Eq)]
struct MethodName(String);

impl MethodName {
    /// The method; a file is read now.
    fn method(&self) -> Result<Method, Failure> {
        match Method::by_name(&self.0) {
            Some(method) => Ok(method),
            None => {
                Method::load(&self.0, Path::new(&door::typed(&self.0))).map_err(Failure::invalid)
            }
        }
    }
}

/// Reads a built-in method by its name, or takes the name of a file.
#[derive(Clone)]
struct MethodParser;

fn method_name() -> MethodParser {
    MethodParser
}

impl TypedValueParser for MethodParser {
    type Value = MethodName;

    fn parse_ref(
        &self,
        command: &Command,
        arg: Option<&Arg>,
        value: &OsStr,
    ) -> Result<MethodName, clap::Error> {
        match value.to_str() {
            Some(name) if Method::is_file(name) => Ok(MethodName(name.to_owned())),
            _ => {
                let builtin = choice(&Method::ALL, Method::name).parse_ref(command, arg, value)?;
                Ok(MethodName(builtin.name().to_owned()))
            }
        }
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        let values: Vec<_> = Method::ALL
            .iter()
            .map(|m| PossibleValue::new(m.name()))
            .collect();
        Some(Box::new(values.into_iter()))
    }
}

/// Reads how many times as high as wide a cell is.
fn aspect(text: &str) -> Result<f64, String> {
    match read::binary64(text) {
        Some(aspect) if (0.5..=4.0).contains(&aspect) => Ok(aspect),
        _ => Err("expected a number from 0.5 to 4".into()),
    }
}

/// Reads a whole number within bounds.
fn whole<T>(least: T, most: T) -> impl Fn(&str) -> Result<T, String> + Clone
where
    T: std::str::FromStr + PartialOrd + fmt::Display + Clone,
{
    move |text| match text.parse() {
        Ok(number) if (&least..=&most).contains(&&number) => Ok(number),
        _ => Err(format!("expected a whole number from {least} to {most}")),
    }
}

/// Reads a number that counts from 1.
fn from_one(text: &str) -> Result<usize, String> {
    text.parse()
        .map_err(|_| "expected a whole number from 1".into())
}

/// Reads what random numbers start from.
fn seed(text: &str) -> Result<u64, String> {
    whole(0, u64::MAX)(text)
}
