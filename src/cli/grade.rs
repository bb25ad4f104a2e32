//! `rayscope grade`: somebody else's answers, from a CSV file, held against the truth.

use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use csv::StringRecord;
use glam::Vec3;

use super::failure::{DONE, INVALID};
use super::solve::number;
use super::{Failure, Outcome, complain, shown, write_out};
use crate::geometry::{Ray, Sphere};
use crate::lab::Problem;
use crate::lab::grade::{self, Claim};
use crate::method::Class;
use crate::text::read;

/// Hold somebody else's answers against the truth, beside the methods here
#[derive(Debug, Args)]
pub(super) struct Grade {
    /// CSV with the columns ox,oy,oz,dx,dy,dz,cx,cy,cz,r and class,near,far; `-` for standard input
    #[arg(value_name = "FILE")]
    file: PathBuf,

    /// How the report is written
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    Text,
    Json,
}

/// Grades the file; exit status 1 if some row could not be graded.
pub(super) fn run(arguments: &Grade) -> Outcome {
    let shown = shown(&arguments.file);
    let file = rows_of(&arguments.file)
        .map_err(|reason| Failure::invalid(format_args!("{shown}: {reason}")))?;
    for refusal in &file.refused {
        complain(format_args!("{shown}: {refusal}"));
    }
    let graded = grade::grade(&file.problems, &file.claims);
    let text = match arguments.format {
        Format::Text => Ok(grade::table(&graded)),
        Format::Json => grade::json(&graded).map_err(|e| format!("JSON: {e}")),
    };
    write_out(&text.map_err(Failure::invalid)?)?;
    Ok(if file.refused.is_empty() {
        DONE
    } else {
        INVALID
    })
}

const COLUMNS: [&str; 13] = [
    "ox", "oy", "oz", "dx", "dy", "dz", "cx", "cy", "cz", "r", "class", "near", "far",
];

/// The rows of a file: those that can be graded, and a sentence for each of the others.
#[derive(Debug, Default)]
struct Rows {
    problems: Vec<Problem>,
    claims: Vec<Claim>,
    refused: Vec<String>,
}

fn rows_of(path: &Path) -> Result<Rows, String> {
    let input: Box<dyn Read> = if path == Path::new("-") {
        Box::new(io::stdin().lock())
    } else {
        Box::new(File::open(path).map_err(|e| e.to_string())?)
    };
    let mut reader = csv::ReaderBuilder::new()
        .flexible(true)
        .trim(csv::Trim::All)
        .from_reader(input);
    let places = places(reader.headers().map_err(|e| e.to_string())?)?;
    let mut rows = Rows::default();
    for row in reader.records() {
        let row = match row {
            Ok(row) => row,
            Err(error) if matches!(error.kind(), csv::ErrorKind::Io(_)) => {
                return Err(error.to_string());
            }
            Err(error) => {
                rows.refused.push(error.to_string());
                continue;
            }
        };
        let line = row.position().map_or(0, csv::Position::line);
        match parse(&row, &places) {
            Ok((problem, claim)) => {
                rows.problems.push(problem);
                rows.claims.push(claim);
            }
            Err(reason) => rows.refused.push(format!("line {line}, {reason}")),
        }
    }
    if rows.problems.is_empty() && rows.refused.is_empty() {
        return Err("no row after the header; expected at least one to grade".into());
    }
    Ok(rows)
}

/// Where each column stands, by the names in the header, in any order and among others.
fn places(header: &StringRecord) -> Result<[usize; COLUMNS.len()], String> {
    let mut places = [0; COLUMNS.len()];
    for (place, name) in places.iter_mut().zip(COLUMNS) {
        let mut found = (0..header.len()).filter(|&i| header[i] == *name);
        *place = match (found.next(), found.next()) {
            (Some(place), None) => place,
            (Some(_), Some(_)) => return Err(format!("line 1: there are two columns {name}")),
            (None, _) => {
                let expected = COLUMNS.join(",");
                return Err(format!(
                    "line 1: there is no column {name}; expected {expected}"
                ));
            }
        };
    }
    Ok(places)
}

fn parse(row: &StringRecord, places: &[usize; COLUMNS.len()]) -> Result<(Problem, Claim), String> {
    let field = |i: usize| row.get(places[i]).unwrap_or_default();
    let mut x = [0.0; 10];
    for (i, x) in x.iter_mut().enumerate() {
        *x = number(field(i).as_bytes()).map_err(|e| format!("column {}: {e}", COLUMNS[i]))?;
    }
    let ray = Ray::new(Vec3::from_slice(&x[0..]), Vec3::from_slice(&x[3..]));
    let sphere = Sphere::new(Vec3::from_slice(&x[6..]), x[9]);
    let problem = (
        ray.map_err(|e| e.to_string())?,
        sphere.map_err(|e| e.to_string())?,
    );
    let class = class(field(10))?;
    let meets = class.is_none_or(Class::meets);
    let root = |i: usize| match field(i) {
        _ if !meets => Ok(f32::NAN),
        text => root(text).ok_or_else(|| {
            format!(
                "column {}: `{text}`; expected a root, such as 12.5, inf or NaN",
                COLUMNS[i]
            )
        }),
    };
    let claim = Claim {
        class,
        near: root(11)?,
        far: root(12)?,
    };
    Ok((problem, claim))
}

/// The class by its name; none for `hit`, which leaves open whether it is a tangent.
fn class(text: &str) -> Result<Option<Class>, String> {
    match text {
        "hit" => Ok(None),
        "miss" => Ok(Some(Class::Miss)),
        "tangent" => Ok(Some(Class::Tangent)),
        "secant" => Ok(Some(Class::Secant)),
        "nan" => Ok(Some(Class::Nan)),
        _ => Err(format!(
            "column class: `{text}`; expected miss, tangent, secant, nan, or hit where the two are not told apart"
        )),
    }
}

/// A root in binary32, whatever it is: what is no number is judged, not refused.
fn root(text: &str) -> Option<f32> {
    read::binary32(text)
}
