//! `rayscope check`: a routine held against the truth, without a screen.

use std::fmt::Write as _;

use clap::Args;

use super::failure::{DONE, INVALID};
use super::{Failure, MethodName, Outcome, choice, write_out};
use crate::lab::check::{self, RoutineCheck};
use crate::method::Method;
use crate::report::Format;

/// Compare a routine with the truth: known slips, and rays that it is weak at
#[derive(Debug, Args)]
pub(super) struct CheckArgs {
    /// A routine in GLSL or WGSL
    #[arg(value_name = "FILE")]
    file: String,

    /// How the report is written
    #[arg(long, value_parser = choice(&[Format::Text, Format::Json], Format::name), default_value = Format::Text.name())]
    format: Format,
}

/// Checks the routine; exit status 1 for a slip, or for an answer that no rounding explains.
pub(super) fn run(arguments: &CheckArgs) -> Outcome {
    if !Method::is_file(&arguments.file) {
        let name = &arguments.file;
        return Err(Failure::misused(format_args!(
            "{name}: expected a file that ends in .glsl or .wgsl"
        )));
    }
    let Method::Routine(id) = MethodName(arguments.file.clone()).method()? else {
        return Err(Failure::misused("expected the file of a routine"));
    };
    let found = check::check(id);
    write_out(&match arguments.format {
        Format::Json => check::json(&arguments.file, &found),
        _ => text(&arguments.file, id, &found),
    })?;
    Ok(if found.right { DONE } else { INVALID })
}

/// What was found, for people; writing to a `String` can't fail.
fn text(name: &str, id: crate::method::RoutineId, found: &RoutineCheck) -> String {
    let routine = id.get();
    let program = &routine.program;
    let roles: Vec<String> = program
        .roles()
        .map(|(name, role)| format!("{name} {role}"))
        .collect();
    let mut out = format!(
        "{name}: {}, {}\n  takes {}\n\n",
        program.name(),
        id.words(),
        roles.join(", ")
    );
    for slip in &found.slips {
        let _ = writeln!(out, "slip {}: {}", slip.name(), slip.words());
    }
    if let Some(line) = found.line {
        let _ = writeln!(
            out,
            "  line {line} departs from the mathematics: {}",
            program.line(line).0
        );
    }
    if let Some(((ray, sphere), given, truth)) = &found.example {
        let list = |v: glam::Vec3| format!("{},{},{}", v.x, v.y, v.z);
        let _ = writeln!(
            out,
            "  it says {}, the truth is {}:\n  rayscope solve --method {name} --ray={},{} --sphere={},{}",
            said(given),
            said(truth),
            list(ray.origin),
            list(ray.direction),
            list(sphere.center),
            sphere.radius
        );
    }
    if found.right {
        out += "right: on plain rays every answer is right up to rounding\n";
    } else if found.slips.is_empty() {
        out += "wrong: no rounding explains this answer, and it is none of the known slips\n";
    }
    for (family, what) in &found.weaknesses {
        let _ = writeln!(out, "  weak on {family}: {what}");
    }
    out
}

fn said(solution: &crate::method::Solution) -> String {
    let mut text = solution.class.name().to_owned();
    for t in [solution.near, solution.far] {
        if !t.is_nan() {
            let _ = write!(text, " {t}");
        }
    }
    text
}
