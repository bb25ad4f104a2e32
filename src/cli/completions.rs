//! `rayscope completions`: a script that teaches a shell the commands and flags.

use clap::{Args, CommandFactory};
use clap_complete::{Shell, generate};

use super::{Arguments, Outcome, write_out};

/// Write a script that completes commands and flags in a shell
///
/// For bash, `eval "$(rayscope completions bash)"` in ~/.bashrc; for zsh and fish, a file in the folder
/// where they look for completions.
#[derive(Debug, Args)]
pub(super) struct Completions {
    /// The shell
    shell: Shell,
}

/// Writes the script.
pub(super) fn run(arguments: &Completions) -> Outcome {
    let mut script = Vec::new();
    let mut command = Arguments::command();
    generate(arguments.shell, &mut command, "rayscope", &mut script);
    write_out(&String::from_utf8_lossy(&script))
}
