//! Environment variables that stand for flags: what clap does not say about them.

use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Arg, Command, Error};

/// The command without those of its variables that are set to nothing, which is as good as not set.
pub(super) fn without_empty(command: Command) -> Command {
    let is_empty = |arg: &Arg| {
        arg.get_env()
            .and_then(std::env::var_os)
            .is_some_and(|v| v.is_empty())
    };
    // No variable has the empty name.
    let without = |arg: Arg| arg.env("").hide_env(true);
    command
        .mut_args(move |arg| if is_empty(&arg) { without(arg) } else { arg })
        .mut_subcommands(without_empty)
}

/// If a variable's value is what is wrong, a sentence that names it.
pub(super) fn at_fault(error: &Error, command: &Command) -> Option<String> {
    let text = |kind| match error.get(kind) {
        Some(ContextValue::String(text)) => Some(text.as_str()),
        _ => None,
    };
    if !matches!(
        error.kind(),
        ErrorKind::InvalidValue | ErrorKind::ValueValidation
    ) {
        return None;
    }
    let (flag, value) = (
        text(ContextKind::InvalidArg)?,
        text(ContextKind::InvalidValue)?,
    );
    let subcommands = command.get_subcommands();
    let named = flag.trim_start_matches('-').split([' ', '=']).next();
    let arg = std::iter::once(command)
        .chain(subcommands)
        .flat_map(Command::get_arguments)
        .find(|arg| arg.get_long() == named && arg.get_env().is_some())?;
    let long = format!("--{}", arg.get_long()?);
    if std::env::args_os().any(|word| word.to_string_lossy().starts_with(&long)) {
        return None;
    }
    let expected = match error.get(ContextKind::ValidValue) {
        Some(ContextValue::Strings(values)) => format!("one of {}", values.join(", ")),
        _ => format!("a value that {long} takes"),
    };
    let name = arg.get_env()?.to_string_lossy();
    Some(format!("{name} is “{value}”: expected {expected}"))
}
