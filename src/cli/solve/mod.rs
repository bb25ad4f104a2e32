//! `rayscope solve`: one intersection step by step, or a file of them.

mod batch;
mod input;
mod json;
mod rows;
mod single;

use std::path::PathBuf;
use std::process::ExitCode;

pub(super) use input::number;

use super::{INVALID, choice, complain, written};
use crate::method::Method;

/// Work out where a line meets a sphere, step by step, or for a whole file of them
#[derive(Debug, clap::Args)]
pub(super) struct Solve {
    /// Where the ray starts and which way it goes
    #[arg(
        long,
        value_name = "OX,OY,OZ,DX,DY,DZ",
        allow_hyphen_values = true,
        requires = "sphere",
        required_unless_present = "batch"
    )]
    ray: Option<String>,
    /// The centre and the radius of the sphere
    #[arg(
        long,
        value_name = "CX,CY,CZ,R",
        allow_hyphen_values = true,
        requires = "ray",
        required_unless_present = "batch"
    )]
    sphere: Option<String>,
    /// Answer the rows of a CSV file with the columns ox,oy,oz,dx,dy,dz,cx,cy,cz,r instead; `-`
    /// for standard input
    #[arg(long, value_name = "FILE", conflicts_with_all = ["ray", "sphere", "format"])]
    batch: Option<PathBuf>,
    /// The way to evaluate the quadratic
    #[arg(long, value_name = "METHOD", env = "RAYSCOPE_METHOD", hide_env_values = true, value_parser = choice(&Method::ALL, Method::name), default_value_t = Method::default())]
    method: Method,
    /// How the derivation of one intersection is written
    #[arg(long, value_name = "FORMAT", value_enum, default_value_t)]
    format: Format,
}

/// How a derivation is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, clap::ValueEnum)]
enum Format {
    /// For people
    #[default]
    Text,
    /// For programs: the object that docs/methods.md describes
    Json,
}

/// Does what `rayscope solve` was asked to.
pub(super) fn run(arguments: &Solve) -> ExitCode {
    match (&arguments.batch, &arguments.ray, &arguments.sphere) {
        (Some(file), ..) => run_batch(file, arguments.method),
        (None, Some(ray), Some(sphere)) => {
            let derivation = single::written(ray, sphere, arguments.method, arguments.format);
            written(derivation)
        }
        // The parser asks for the two unless there is a batch.
        _ => ExitCode::SUCCESS,
    }
}

fn run_batch(file: &std::path::Path, method: Method) -> ExitCode {
    match batch::run(file, method) {
        Ok(batch::Outcome::AllValid) | Err(batch::Error::Closed) => ExitCode::SUCCESS,
        Ok(batch::Outcome::SomeInvalid) => INVALID.into(),
        Err(error) => {
            complain(error);
            INVALID.into()
        }
    }
}
