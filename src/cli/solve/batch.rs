//! `solve --batch`: CSV in, the same rows with the answers of one method out, one row at a time.

use std::cell::RefCell;
use std::io::{self, BufReader, BufWriter, IsTerminal as _, Read, Write};
use std::path::Path;

use super::super::output::Complaints;
use super::super::rows::{CsvColumns, CsvFile, CsvRow, INPUTS, OptionalColumn, number, unreadable};
use super::super::{Failure, unwritable};
use crate::door::{Expected, shown};
use crate::geometry::{Ray, Sphere};
use crate::method::format::{self, Shortest};
use crate::method::{Class, Method, Solution};
use crate::text::Glyphs;
use crate::text::printable;

/// Rows are answered one by one, so that there may be any number of them.
const ROWS: Expected = Expected {
    what: "a CSV file",
    most: u64::MAX,
};

/// The columns that are added at the end.
const OUTPUTS: [&str; 7] = ["class", "near", "far", "a", "b", "c", "discriminant"];

/// The column after these where a row says between which t it looks.
const VISIBLE: &str = "visible";

/// The columns that say so, where a file has them: from 0 and to ∞ else.
struct Between {
    from: Option<OptionalColumn>,
    to: Option<OptionalColumn>,
}

impl Between {
    /// The columns of a file; none if it has neither.
    fn of<const N: usize>(columns: &CsvColumns<N>) -> Result<Option<Self>, String> {
        let (from, to) = (columns.optional("tmin")?, columns.optional("tmax")?);
        let any = from.is_some() || to.is_some();
        Ok(any.then_some(Self { from, to }))
    }

    /// What a row has there.
    fn read(&self, row: &CsvRow) -> Result<[f32; 2], String> {
        let to = |field: &[u8]| match field.trim_ascii().to_ascii_lowercase().as_slice() {
            b"inf" | b"+inf" | b"infinity" | b"+infinity" => Ok(f32::INFINITY),
            _ => number(field),
        };
        let from = self
            .from
            .as_ref()
            .map_or(Ok(0.0), |c| c.read(row, number))?;
        let to = self
            .to
            .as_ref()
            .map_or(Ok(f32::INFINITY), |c| c.read(row, to))?;
        if from <= to {
            Ok([from, to])
        } else {
            let [from, to] = [from, to].map(|t| format::binary32(t, Glyphs::Ascii));
            Err(format!(
                "columns tmin, tmax: {from} is above {to}; expected tmin <= tmax"
            ))
        }
    }
}

/// Bytes read or written at once.
const BUFFER: usize = 1 << 16;

/// What the rows of a batch were.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Validity {
    All,
    /// Some rows are `invalid`; each was explained on standard error.
    Some,
}

/// Why a batch could not go on.
enum Stop {
    Failed(Failure),
    Unwritten(io::Error),
}

impl From<Failure> for Stop {
    fn from(failure: Failure) -> Self {
        Self::Failed(failure)
    }
}

/// Answers every row of the file, or of standard input for `-`, on standard output.
pub(super) fn run(path: &Path, method: Method) -> Result<Validity, Failure> {
    let input = ROWS.stream(path).map_err(|e| unreadable(&e))?;
    answer(path, input, io::stdout().lock(), method).or_else(|stop| match stop {
        Stop::Failed(failure) => Err(failure),
        Stop::Unwritten(error) => unwritable(&error).map(|()| Validity::All),
    })
}

/// Input that lets go of what has been answered before it waits for more, so that a program at
/// the other end of two pipes gets each answer without closing its end.
struct Patient<'a, R, W: Write> {
    input: R,
    output: &'a RefCell<BufWriter<W>>,
    failed: &'a RefCell<Option<io::Error>>,
}

impl<R: Read, W: Write> Read for Patient<'_, R, W> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        if let Err(error) = self.output.borrow_mut().flush() {
            // An end of input stops the reader; what failed is told apart afterwards.
            *self.failed.borrow_mut() = Some(error);
            return Ok(0);
        }
        self.input.read(buffer)
    }
}

fn answer(
    path: &Path,
    input: impl Read,
    output: impl Write,
    method: Method,
) -> Result<Validity, Stop> {
    let output = RefCell::new(BufWriter::with_capacity(BUFFER, output));
    let failed = RefCell::new(None);
    let input = Patient {
        input,
        output: &output,
        failed: &failed,
    };
    let input = BufReader::with_capacity(BUFFER, input);
    let (mut file, mut row) = CsvFile::open(ROWS, path, input, INPUTS)?;
    let between = Between::of(&file.columns).map_err(|reason| {
        let (path, line) = (shown(path), row.line);
        Failure::invalid(format_args!("{path}: line {line}{reason}"))
    })?;
    let visible = between.is_some().then_some(VISIBLE);
    let outputs = || OUTPUTS.into_iter().chain(visible);
    if let Some(name) = outputs().find(|name| file.columns.has(name)) {
        let (path, line) = (shown(path), row.line);
        return Err(Stop::Failed(Failure::invalid(format_args!(
            "{path}: line {line}, column {name}: an answer has this name; rename the column"
        ))));
    }
    let is_watched = io::stdout().is_terminal();
    let write = |text: &[u8]| {
        let mut output = output.borrow_mut();
        let written = if is_watched {
            let text = String::from_utf8_lossy(text).replace("\r\n", "\n");
            output.write_all(printable(&text).as_bytes())
        } else {
            output.write_all(text)
        };
        written.map_err(Stop::Unwritten)
    };
    let mut text = Vec::new();
    file.columns.copy(&row, &mut text);
    for name in outputs() {
        text.push(b',');
        text.extend_from_slice(name.as_bytes());
    }
    end(&row, &mut text);
    write(&text)?;

    let mut complaints = Complaints::about(path);
    while file.read(&mut row)? {
        // Input that ended since nobody reads the answers may have ended within a row.
        if failed.borrow().is_some() {
            break;
        }
        text.clear();
        file.columns.copy(&row, &mut text);
        let asked = file.columns.problem(&row).and_then(|problem| {
            let between = between.as_ref().map(|between| between.read(&row));
            Ok((problem, between.transpose()?))
        });
        match asked {
            Ok(((ray, sphere), between)) => {
                push_answers(&mut text, method, (&ray, &sphere), between)
                    .map_err(Stop::Unwritten)?;
            }
            Err(reason) => {
                complaints.row(row.line, reason);
                text.extend_from_slice(b",invalid");
                text.extend(outputs().skip(1).map(|_| b','));
            }
        }
        end(&row, &mut text);
        write(&text)?;
    }
    if let Some(error) = failed.take() {
        return Err(Stop::Unwritten(error));
    }
    output.borrow_mut().flush().map_err(Stop::Unwritten)?;
    Ok(if complaints.end() {
        Validity::Some
    } else {
        Validity::All
    })
}

/// Appends what a method says of one row, in the order of `OUTPUTS`, and the visible root between two t.
fn push_answers(
    text: &mut Vec<u8>,
    method: Method,
    (ray, sphere): (&Ray, &Sphere),
    between: Option<[f32; 2]>,
) -> io::Result<()> {
    let solution = method.solve(ray, sphere);
    let Solution {
        class, near, far, ..
    } = solution;
    write!(text, ",{}", class.name())?;
    // A routine that says no more than that it hits gives one root, or none.
    let is_given = |t: f32| class != Class::Miss && (class != Class::Hit || !t.is_nan());
    for t in [near, far] {
        text.push(b',');
        if is_given(t) {
            write!(text, "{}", format::binary32(t, Glyphs::Ascii))?;
        }
    }
    if method.is_routine() {
        text.extend_from_slice(b",,,,");
    } else {
        push_coefficients(text, method, ray, sphere)?;
    }
    if let Some([from, to]) = between {
        text.push(b',');
        if let Some(t) = solution
            .visible_between(from, to)
            .filter(|t| t.is_finite() || class != Class::Hit)
        {
            write!(text, "{}", format::binary32(t, Glyphs::Ascii))?;
        }
    }
    Ok(())
}

fn push_coefficients(
    text: &mut Vec<u8>,
    method: Method,
    ray: &Ray,
    sphere: &Sphere,
) -> io::Result<()> {
    let k = method.coefficients(ray, sphere);
    for value in [k.a, k.b, k.c, k.discriminant] {
        let (precision, glyphs) = (k.precision, Glyphs::Ascii);
        let number = Shortest {
            value,
            precision,
            glyphs,
        };
        write!(text, ",{number}")?;
    }
    Ok(())
}

fn end(row: &CsvRow, text: &mut Vec<u8>) {
    text.extend_from_slice(match row.line_end() {
        b"" => b"\n",
        end => end,
    });
}
