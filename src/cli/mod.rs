//! The command line: parses the arguments and calls the part that does the work.

use std::process::ExitCode;

use clap::{Parser, Subcommand};

/// A terminal explorer for ray–sphere intersection.
#[derive(Debug, Parser)]
#[command(version, about)]
struct Arguments {
    #[command(subcommand)]
    command: Option<Command>,
}

#[derive(Debug, Subcommand)]
enum Command {}

/// Runs the program with the arguments of this process.
pub fn main() -> ExitCode {
    let Arguments { command: None } = Arguments::parse();
    ExitCode::SUCCESS
}
