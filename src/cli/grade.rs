//! `rayscope grade`: somebody else's answers, from a CSV file, held against the truth.

use std::io::BufReader;
use std::path::{Path, PathBuf};
use std::time::Duration;

use clap::Args;

use super::bench::right_to_measure;
use super::failure::{DONE, INVALID};
use super::output::Complaints;
use super::progress::{INTERRUPTED, Progress};
use super::rows::{CsvColumns, CsvFile, CsvRow, unreadable};
use super::{Failure, Outcome, choice, save, write_out};
use crate::door::{Expected, shown};
use crate::lab::bench::BenchPlan;
use crate::lab::grade::{self, Claim, Grade};
use crate::lab::timing::{Schedule, SelfCheck, SystemClock};
use crate::lab::{Machine, Problem, plot};
use crate::method::{Class, Method};
use crate::report::Format;
use crate::text::read;

/// Compare answers in a file with the truth, and with the methods here
#[derive(Debug, Args)]
pub(super) struct GradeArgs {
    /// CSV with the columns ox,oy,oz,dx,dy,dz,cx,cy,cz,r and class,near,far; `-` for standard input
    #[arg(value_name = "FILE")]
    file: PathBuf,

    /// How the report is written
    #[arg(long, value_parser = choice(&[Format::Text, Format::Json], Format::name), default_value = Format::Text.name())]
    format: Format,

    /// Also draw the answers beside the methods here, error against time, as SVG; the file needs a column `ns`
    #[arg(long, value_name = "FILE")]
    plot: Option<PathBuf>,
}

/// Grades the file; exit status 1 if some row could not be graded.
pub(super) fn run(arguments: &GradeArgs) -> Outcome {
    let file = rows_of(&arguments.file, arguments.plot.is_some())?;
    let graded = grade::grade(&file.problems, &file.claims);
    let drawn = match &arguments.plot {
        // Of a file without a row that can be graded there is nothing to draw.
        Some(plot) if !file.problems.is_empty() => draw(plot, &file, &graded)?,
        _ => DONE,
    };
    write_out(&match arguments.format {
        Format::Json => grade::json(&graded),
        _ => grade::text(&graded).text(),
    })?;
    Ok(if file.any_refused { INVALID } else { drawn })
}

/// Times our methods on the rows, and draws theirs beside them.
fn draw(plot: &Path, file: &ClaimedRows, graded: &Grade) -> Outcome {
    let plan = BenchPlan {
        methods: &Method::ALL,
        schedule: Schedule::new(true, 1),
    };
    let mut progress = Progress::new("grade", 1)?;
    let lock = right_to_measure(Duration::from_secs(1), &progress);
    let clock = SystemClock::new();
    let (problems, nanoseconds) = (&file.problems, &file.nanoseconds);
    let mut measured = grade::time(
        graded,
        problems,
        nanoseconds,
        plan,
        &clock,
        |number, name| progress.go_on(number, name),
    );
    let alone = lock.as_ref().ok().map(Option::is_some);
    measured.self_checks.extend(alone.map(SelfCheck::alone));
    drop(lock);
    progress.clear();
    let notes = grade::text(graded).text();
    let notes: Vec<&str> = notes.lines().collect();
    save(Some(plot), || {
        plot::graded(&measured, &Machine::detect(), &notes)
    })?;
    Ok(if progress.interrupted() {
        INTERRUPTED
    } else {
        DONE
    })
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
    /// How long each took, if that was asked for.
    nanoseconds: Vec<f64>,
    /// Whether there are others.
    any_refused: bool,
}

fn rows_of(path: &Path, with_times: bool) -> Result<ClaimedRows, Failure> {
    let input = BufReader::new(ROWS.stream(path).map_err(|e| unreadable(&e))?);
    let (mut file, mut row) = CsvFile::open(ROWS, path, input, COLUMNS)?;
    let mut rows = ClaimedRows::default();
    let mut complaints = Complaints::about(path);
    let header =
        |reason: &str| Failure::invalid(format_args!("{}: line {}{reason}", shown(path), row.line));
    let times = match file.columns.optional("ns") {
        _ if !with_times => None,
        Ok(None) => {
            return Err(header(
                ": there is no column ns; to draw the answers, expected the nanoseconds that each took, as a program of \
                 `rayscope harness` writes them",
            ));
        }
        found => found.map_err(|reason| header(&reason))?,
    };
    while file.read(&mut row)? {
        let time = times.as_ref().map(|column| column.read(&row, nanoseconds));
        match parse(&row, &file.columns).and_then(|row| Ok((row, time.transpose()?))) {
            Ok(_) if rows.problems.len() == MOST_ROWS => {
                return Err(Failure::invalid(format_args!(
                    "{}: line {}: found more than {MOST_ROWS} rows, expected at most that many",
                    shown(path),
                    row.line
                )));
            }
            Ok(((problem, claim), time)) => {
                rows.problems.push(problem);
                rows.claims.push(claim);
                rows.nanoseconds.extend(time);
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

/// How long an answer took.
fn nanoseconds(field: &[u8]) -> Result<f64, String> {
    let text = String::from_utf8_lossy(field.trim_ascii());
    let number = read::binary64(&text).filter(|ns| ns.is_finite() && *ns > 0.0);
    number.ok_or_else(|| format!("`{text}`; expected nanoseconds above 0, such as 12.5"))
}

/// A root in binary32, whatever it is: what is no number is judged, not refused.
fn root(text: &str) -> Option<f32> {
    read::binary32(text)
}
