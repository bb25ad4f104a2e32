//! The command line: parses the arguments and calls the part that does the work.

mod appearance;
mod bench;
mod completions;
mod explore;
mod grade;
mod place;
mod plan;
mod print;
mod progress;
mod scenes;
mod solve;
mod stress;
mod sweep;
mod tour;
mod variables;
mod worksheet;

use std::fmt;
use std::io::{ErrorKind, Write};
use std::path::Path;
use std::process::ExitCode;

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};

use crate::method::read;

/// A terminal explorer for ray–sphere intersection.
#[derive(Debug, Parser)]
#[command(version, about, args_conflicts_with_subcommands = true)]
struct Arguments {
    #[command(subcommand)]
    command: Option<Command>,

    #[command(flatten)]
    explore: explore::Explore,
}

#[derive(Debug, Subcommand)]
enum Command {
    Bench(bench::Bench),
    Completions(completions::Completions),
    Grade(grade::Grade),
    Plan(plan::Plan),
    Print(print::Print),
    Scenes(scenes::Scenes),
    Solve(solve::Solve),
    Stress(stress::Stress),
    Tour(Box<tour::Tour>),
    Worksheet(worksheet::Worksheet),
}

/// Runs the program with the arguments of this process.
pub fn main() -> ExitCode {
    let arguments = arguments();
    match arguments.command {
        None => explore::run(&arguments.explore),
        Some(Command::Completions(arguments)) => completions::run(&arguments),
        Some(Command::Bench(arguments)) => bench::run(&arguments),
        Some(Command::Grade(arguments)) => grade::run(&arguments),
        Some(Command::Plan(arguments)) => plan::run(&arguments),
        Some(Command::Print(arguments)) => print::run(&arguments),
        Some(Command::Scenes(arguments)) => scenes::run(&arguments),
        Some(Command::Solve(arguments)) => solve::run(&arguments),
        Some(Command::Stress(arguments)) => stress::run(&arguments),
        Some(Command::Tour(arguments)) => tour::run(&arguments),
        Some(Command::Worksheet(arguments)) => worksheet::run(&arguments),
    }
}

/// The arguments of this process; ends it where they are wrong, or help was asked for.
fn arguments() -> Arguments {
    let mut command = variables::without_empty(Arguments::command());
    let matches = command.try_get_matches_from_mut(std::env::args_os());
    let arguments = matches.and_then(|matches| {
        let arguments = Arguments::from_arg_matches(&matches);
        arguments.map_err(|error| error.format(&mut command))
    });
    arguments.unwrap_or_else(|error| match variables::at_fault(&error, &command) {
        Some(sentence) => {
            complain(sentence);
            std::process::exit(MISUSED.into())
        }
        None => error.exit(),
    })
}

/// The exit status where some input was invalid.
const INVALID: u8 = 1;

/// The exit status where the program was called wrongly.
const MISUSED: u8 = 2;

/// Reads one of several values by its name.
fn choice<T: Copy + Send + Sync + 'static>(
    all: &'static [T],
    name: fn(T) -> &'static str,
) -> impl TypedValueParser<Value = T> {
    PossibleValuesParser::new(all.iter().map(|&v| name(v))).try_map(move |given| {
        let found = all.iter().copied().find(|&v| name(v) == given);
        found.ok_or("no such name")
    })
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

/// Reads a finite number.
fn finite(text: &str) -> Result<f64, String> {
    read::binary64(text)
        .filter(|x| x.is_finite())
        .ok_or_else(|| "expected a finite number, such as 7.5".into())
}

/// Writes to standard output. Whoever closes it early has seen enough.
fn write_out(text: &str) -> ExitCode {
    let mut out = std::io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) if error.kind() == ErrorKind::BrokenPipe => ExitCode::SUCCESS,
        Err(error) => {
            complain(format_args!("standard output: {error}"));
            ExitCode::from(INVALID)
        }
    }
}

/// Writes a report to standard output, or says why there is none.
fn written(report: Result<String, String>) -> ExitCode {
    match report {
        Ok(text) => write_out(&text),
        Err(sentence) => {
            complain(sentence);
            ExitCode::from(INVALID)
        }
    }
}

/// Writes a file if one is asked for; says why if that fails.
fn save(path: Option<&Path>, contents: impl FnOnce() -> String) -> Result<(), ()> {
    let Some(path) = path else {
        return Ok(());
    };
    std::fs::write(path, contents()).map_err(|error| {
        complain(format_args!("cannot write {}: {error}", path.display()));
    })
}

/// What an input file is called in a sentence; `-` is standard input.
fn shown(path: &Path) -> String {
    if path == Path::new("-") {
        "standard input".to_owned()
    } else {
        path.display().to_string()
    }
}

/// Says a sentence on standard error. If nobody can read it, nobody is missing it.
fn complain(sentence: impl fmt::Display) {
    let _ = writeln!(std::io::stderr(), "rayscope: {sentence}");
}
