//! `rayscope solve`: one intersection step by step, or a file of them.

mod batch;
mod rows;

use std::path::PathBuf;
use std::process::ExitCode;

use super::{INVALID, complain, method_parser};
use crate::method::Method;

#[derive(Debug, clap::Args)]
pub(super) struct Arguments {
    /// CSV with the columns ox,oy,oz,dx,dy,dz,cx,cy,cz,r; `-` for standard input.
    #[arg(long, value_name = "FILE")]
    batch: PathBuf,
    /// The way to evaluate the quadratic.
    #[arg(long, value_name = "METHOD", value_parser = method_parser(), default_value_t = Method::default())]
    method: Method,
}

/// Does what `rayscope solve` was asked to.
pub(super) fn run(arguments: &Arguments) -> ExitCode {
    match batch::run(&arguments.batch, arguments.method) {
        Ok(batch::Outcome::AllValid) | Err(batch::Error::Closed) => ExitCode::SUCCESS,
        Ok(batch::Outcome::SomeInvalid) => INVALID.into(),
        Err(error) => {
            complain(error);
            INVALID.into()
        }
    }
}
