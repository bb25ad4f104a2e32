//! The command line: parses the arguments and calls the part that does the work.

mod print;

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
enum Command {
    Print(print::Print),
}

/// Runs the program with the arguments of this process.
pub fn main() -> ExitCode {
    let Arguments { command } = Arguments::parse();
    match command {
        None => ExitCode::SUCCESS,
        Some(Command::Print(arguments)) => print::run(&arguments),
    }
}
