//! `rayscope solve`: one intersection step by step, or a file of them.

mod batch;
mod input;
mod json;
mod single;

use std::path::PathBuf;

pub(super) use json::{RayOut, SphereOut};

use super::failure::{DONE, INVALID};
use super::lens::LensFlag;
use super::{Failure, MethodName, Outcome, method_name, write_out};
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
    // Before the method: it looks at whether that was given.
    #[command(flatten)]
    lens: LensFlag,

    /// How the quadratic is evaluated
    #[arg(long, value_name = "METHOD", env = "RAYSCOPE_METHOD", hide_env_values = true, value_parser = method_name(), default_value = Method::default().name())]
    method: MethodName,
    /// How the derivation of one intersection is written
    #[arg(long, value_name = "FORMAT", value_enum, default_value_t)]
    format: DerivationFormat,
}

/// How a derivation is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, clap::ValueEnum)]
enum DerivationFormat {
    /// For people
    #[default]
    Text,
    /// For programs: the object that docs/methods.md describes
    Json,
}

/// Does what `rayscope solve` was asked to.
pub(super) fn run(arguments: &Solve) -> Outcome {
    let method = arguments.method.method()?;
    match (&arguments.batch, &arguments.ray, &arguments.sphere) {
        (Some(file), ..) => match batch::run(file, method)? {
            batch::Validity::All => Ok(DONE),
            batch::Validity::Some => Ok(INVALID),
        },
        (None, Some(ray), Some(sphere)) => {
            let (lens, format) = (arguments.lens.chosen(), arguments.format);
            let text =
                single::written((ray, sphere), (lens, method), format).map_err(Failure::invalid)?;
            write_out(&text)
        }
        // The parser asks for the two unless there is a batch.
        _ => Ok(DONE),
    }
}
