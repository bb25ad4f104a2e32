//! `rayscope routine`: the built-in methods as text, to copy out and change.

use clap::Args;

use super::{Failure, Outcome, choice, write_out};
use crate::method::Method;
use crate::method::source::{SourceLanguage, about, source};

/// List the built-in methods, or print one as a routine
#[derive(Debug, Args)]
pub(super) struct RoutineArgs {
    /// The method to print
    #[arg(value_parser = choice(&Method::ALL, Method::name))]
    name: Option<Method>,

    /// The language to print it in
    #[arg(long, value_name = "LANGUAGE", value_parser = choice(&SourceLanguage::ALL, SourceLanguage::name), default_value = SourceLanguage::Glsl.name())]
    lang: SourceLanguage,
}

pub(super) fn run(arguments: &RoutineArgs) -> Outcome {
    let Some(method) = arguments.name else {
        return write_out(&list());
    };
    write_out(&source(method, arguments.lang).map_err(Failure::misused)?)
}

/// A line for each method: its name, and a sentence in a column of its own.
fn list() -> String {
    let lines = Method::ALL.map(|method| {
        let (name, sentence) = about(method)
            .split_once(": ")
            .unwrap_or((method.name(), ""));
        format!("{name:<11} {sentence}\n")
    });
    lines.concat()
}
