//! The command line: parses the arguments and calls the part that does the work.

mod solve;

use std::fmt;
use std::io::Write;
use std::process::ExitCode;

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Parser, Subcommand};

use crate::method::Method;

/// A terminal explorer for ray–sphere intersection.
#[derive(Debug, Parser)]
#[command(version, about)]
struct Arguments {
    #[command(subcommand)]
    command: Option<Command>,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Work out where a line meets a sphere, step by step, or for a whole file of them.
    Solve(solve::Arguments),
}

/// Runs the program with the arguments of this process.
pub fn main() -> ExitCode {
    match Arguments::parse().command {
        None => ExitCode::SUCCESS,
        Some(Command::Solve(arguments)) => solve::run(&arguments),
    }
}

/// The exit status where some input was invalid.
const INVALID: u8 = 1;

/// Reads the value of `--method`.
fn method_parser() -> impl TypedValueParser<Value = Method> {
    PossibleValuesParser::new(Method::ALL.map(Method::name))
        .try_map(|name| Method::by_name(&name).ok_or("no such method"))
}

/// Says a sentence on standard error. If nobody can read it, nobody is missing it.
fn complain(sentence: impl fmt::Display) {
    let _ = writeln!(std::io::stderr(), "rayscope: {sentence}");
}
