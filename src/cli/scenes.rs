//! `rayscope scenes`: what scenes come with the program, and each as a scene file.

use clap::Args;

use super::{Outcome, choice, write_out};
use crate::scene::Builtin;

/// List the built-in scenes, or print one as a scene file
#[derive(Debug, Args)]
pub(super) struct Scenes {
    /// The scene to print
    #[arg(value_parser = choice(&Builtin::ALL, Builtin::name))]
    name: Option<Builtin>,
}

pub(super) fn run(arguments: &Scenes) -> Outcome {
    match arguments.name {
        Some(builtin) => write_out(&builtin.scene().to_toml()),
        None => write_out(&list()),
    }
}

/// A line for each scene: its name, and its sentence in a column of its own.
fn list() -> String {
    let names = Builtin::ALL.map(|builtin| builtin.name().len());
    let width = names.into_iter().max().unwrap_or(0);
    Builtin::ALL
        .map(|builtin| format!("{:width$}  {}\n", builtin.name(), builtin.about()))
        .concat()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_list_fits_eighty_columns_and_names_every_scene() {
        let list = list();
        assert_eq!(list.lines().count(), Builtin::ALL.len());
        for (line, builtin) in list.lines().zip(Builtin::ALL) {
            assert!(line.starts_with(builtin.name()), "{line}");
            assert!(line.chars().count() <= 80, "{line}");
        }
    }
}
