//! `rayscope grade`: somebody else's answers, from a CSV file, held against the truth.

use std::io::BufReader;
use std::path::{Path, PathBuf};

use clap::Args;

use super::failure::{DONE, INVALID};
use super::output::Complaints;
use super::rows::{CsvColumns, CsvFile, CsvRow, unreadable};
use super::{Failure, Outcome, choice, write_out};
use crate::door::{Expected, shown};
use crate::lab::Problem;
use crate::lab::grade::{self, Claim};
use crate::method::Class;
use crate::report::Format;
use crate::text::read;

/// Hold somebody else's answers against the truth, beside the methods here
#[derive(Debug, Args)]
pub(super) struct GradeArgs {
    /// CSV with the columns ox,oy,oz,dx,dy,dz,cx,cy,cz,r and class,near,far; `-` for standard input
    #[arg(value_name = "FILE")]
    file: PathBuf,

    /// How the report is written
    #[arg(long, value_parser = choice(&[Format::Text, Format::Json], Format::name), default_value = Format::Text.name())]
    format: Format,
}

/// Grades the file; exit status 1 if some row could not be graded.
pub(super) fn run(arguments: &GradeArgs) -> Outcome {
    let file = rows_of(&arguments.file)?;
    let graded = grade::grade(&file.problems, &file.claims);
    write_out(&match arguments.format {
        Format::Json => grade::json(&graded),
        _ => grade::text(&graded).text(),
    })?;
    Ok(if file.any_refused { INVALID } else { DONE })
}

const COLUMNS: [&str; 13] = [
    "ox", "oy", "oz", "dx", "dy", "dz", "cx", "cy", "cz", "r", "class", "near", "far",
];

/// The rows that are graded at once are held in memory.
const ROWS: Expected = Expected {
    what: "a CSV file",
    most: 256 << 20,
};

/// The most rows that are graded.
const MOST_ROWS: usize = 4_000_000;

/// The rows of a file that can be graded.
#[derive(Debug, Default)]
struct ClaimedRows {
    problems: Vec<Problem>,
    claims: Vec<Claim>,
    /// Whether there are others.
    any_refused: bool,
}

fn rows_of(path: &Path) -> Result<ClaimedRows, Failure> {
    let input = BufReader::new(ROWS.stream(path).map_err(|e| unreadable(&e))?);
    let (mut file, mut row) = CsvFile::open(ROWS, path, input, COLUMNS)?;
    let mut rows = ClaimedRows::default();
    let mut complaints = Complaints::about(path);
    while file.read(&mut row)? {
        match parse(&row, &file.columns) {
            Ok(_) if rows.problems.len() == MOST_ROWS => {
                return Err(Failure::invalid(format_args!(
                    "{}: line {}: found more than {MOST_ROWS} rows, expected at most that many",
                    shown(path),
                    row.line
                )));
            }
            Ok((problem, claim)) => {
                rows.problems.push(problem);
                rows.claims.push(claim);
            }
            Err(reason) => complaints.row(row.line, reason),
        }
    }
    rows.any_refused = complaints.end();
    if rows.problems.is_empty() && !rows.any_refused {
        return Err(Failure::invalid(format_args!(
            "{}: no row after the header; expected at least one to grade",
            shown(path)
        )));
    }
    Ok(rows)
}

fn parse(
    row: &CsvRow,
    columns: &CsvColumns<{ COLUMNS.len() }>,
) -> Result<(Problem, Claim), String> {
    let problem = columns.problem(row)?;
    let field = |i: usize| columns.field(row, i).unwrap_or_default();
    let class = class(&field(10))?;
    let meets = class.is_none_or(Class::meets);
    let root = |i: usize| match field(i) {
        _ if !meets => Ok(f32::NAN),
        text => root(&text).ok_or_else(|| {
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
