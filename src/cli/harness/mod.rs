//! `rayscope harness`: a program, in another language, that times a routine and prints rows for `grade`.

use clap::Args;

use super::{Outcome, choice, write_out};

/// Write a program that times your own routine and prints rows for `grade`
#[derive(Debug, Args)]
pub(super) struct HarnessArgs {
    /// The language of the program
    #[arg(long, value_name = "LANGUAGE", value_parser = choice(&HarnessLanguage::ALL, HarnessLanguage::name))]
    lang: HarnessLanguage,
}

/// What the program is written in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum HarnessLanguage {
    C,
    Cpp,
    Rust,
    Python,
}

impl HarnessLanguage {
    const ALL: [Self; 4] = [Self::C, Self::Cpp, Self::Rust, Self::Python];

    const fn name(self) -> &'static str {
        match self {
            Self::C => "c",
            Self::Cpp => "c++",
            Self::Rust => "rust",
            Self::Python => "python",
        }
    }

    fn program(self) -> String {
        // One text is good C and good C++.
        let compiled_by = |command| include_str!("harness.c").replace("COMPILE", command);
        match self {
            Self::C => compiled_by("cc -O2 -ffp-contract=off bench.c -lm -o bench"),
            Self::Cpp => compiled_by("c++ -O2 -ffp-contract=off bench.cpp -o bench"),
            Self::Rust => include_str!("harness.txt").to_owned(),
            Self::Python => include_str!("harness.py").to_owned(),
        }
    }
}

pub(super) fn run(arguments: &HarnessArgs) -> Outcome {
    write_out(&arguments.lang.program())
}
