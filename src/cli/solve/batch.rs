//! `solve --batch`: CSV in, the same rows with the answers of one method out, one row at a time.

use std::borrow::Cow;
use std::cell::RefCell;
use std::fs::File;
use std::io::{self, BufReader, BufWriter, Read, Write};
use std::path::Path;

use glam::Vec3;

use super::super::{Failure, complain, shown, unwritable};
use super::input::number;
use super::rows::{LONGEST, Row, Rows, push_field};
use crate::geometry::{Ray, Sphere};
use crate::method::format::{self, Shortest};
use crate::method::{Class, Method, Solution};
use crate::text::Glyphs;

/// The columns that are read, wherever they stand.
const INPUTS: [&str; 10] = ["ox", "oy", "oz", "dx", "dy", "dz", "cx", "cy", "cz", "r"];

/// The columns that are added at the end.
const OUTPUTS: [&str; 7] = ["class", "near", "far", "a", "b", "c", "discriminant"];

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

/// Answers every row of the file, or of standard input for `-`, on standard output.
pub(super) fn run(path: &Path, method: Method) -> Result<Validity, Failure> {
    let input: Box<dyn Read> = if path == Path::new("-") {
        Box::new(io::stdin().lock())
    } else {
        Box::new(File::open(path).map_err(|e| unreadable(path, &e))?)
    };
    answer(path, input, io::stdout().lock(), method).or_else(|stop| match stop {
        Stop::Failed(failure) => Err(failure),
        Stop::Unwritten(error) => unwritable(&error).map(|()| Validity::All),
    })
}

fn unreadable(path: &Path, error: &io::Error) -> Failure {
    Failure::invalid(format_args!("cannot read {}: {error}", shown(path)))
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
    let mut rows = Rows::new(BufReader::with_capacity(BUFFER, input));
    let unread = |e: io::Error| Stop::Failed(unreadable(path, &e));
    let refused =
        |reason: String| Stop::Failed(Failure::invalid(format_args!("{}: {reason}", shown(path))));

    let mut row = Row::default();
    if !rows.read(&mut row, None).map_err(unread)? {
        let (path, columns) = (shown(path), INPUTS.join(","));
        let sentence = format!("{path} is empty: expected a header with {columns}");
        return Err(Stop::Failed(Failure::invalid(sentence)));
    }
    let columns = Columns::of(&row).map_err(refused)?;
    let mut text = Vec::new();
    columns.copy(&row, &mut text);
    for name in OUTPUTS {
        text.push(b',');
        text.extend_from_slice(name.as_bytes());
    }
    end(&row, &mut text);
    output
        .borrow_mut()
        .write_all(&text)
        .map_err(Stop::Unwritten)?;

    let mut validity = Validity::All;
    while rows.read(&mut row, Some(columns.count())).map_err(unread)? {
        // Input that ended since nobody reads the answers may have ended within a row.
        if failed.borrow().is_some() {
            break;
        }
        text.clear();
        columns.copy(&row, &mut text);
        match columns.read(&row) {
            Ok((ray, sphere)) => {
                push_answers(&mut text, method, &ray, &sphere).map_err(Stop::Unwritten)?;
            }
            Err(reason) => {
                validity = Validity::Some;
                complain(format_args!("{}: line {}, {reason}", shown(path), row.line));
                text.extend_from_slice(b",invalid,,,,,,");
            }
        }
        end(&row, &mut text);
        output
            .borrow_mut()
            .write_all(&text)
            .map_err(Stop::Unwritten)?;
    }
    if let Some(error) = failed.take() {
        return Err(Stop::Unwritten(error));
    }
    output.borrow_mut().flush().map_err(Stop::Unwritten)?;
    Ok(validity)
}

/// Where the ten inputs stand in a row.
struct Columns {
    /// For each of `INPUTS`, the field that holds it.
    places: [usize; INPUTS.len()],
    /// The names of all columns as the header has them.
    names: Vec<String>,
}

impl Columns {
    /// Fields in a row.
    fn count(&self) -> usize {
        self.names.len()
    }

    /// What a field is called, counted from 0: its column's name, or its number where there is none.
    fn name(&self, field: usize) -> Cow<'_, str> {
        match self.names.get(field) {
            Some(name) if !name.is_empty() => name.into(),
            _ => (field + 1).to_string().into(),
        }
    }

    /// The columns by the names in the header, in any order; a name too few, twice or already
    /// taken is refused in a sentence.
    fn of(header: &Row) -> Result<Self, String> {
        let line = header.line;
        let names: Vec<&[u8]> = header.iter().map(<[u8]>::trim_ascii).collect();
        let find = |name: &str| {
            let mut places = (0..names.len()).filter(|&i| names[i] == name.as_bytes());
            (places.next(), places.next())
        };
        if let Some(name) = OUTPUTS.into_iter().find(|name| find(name).0.is_some()) {
            return Err(format!(
                "line {line}, column {name}: an answer has this name; rename the column"
            ));
        }
        let mut places = [0; INPUTS.len()];
        for (place, name) in places.iter_mut().zip(INPUTS) {
            *place = match find(name) {
                (Some(place), None) => place,
                (Some(_), Some(_)) => {
                    return Err(format!(
                        "line {line}: there are two columns {name}; expected one"
                    ));
                }
                (None, _) if header.bare_text().contains(&b'\r') => {
                    return Err(format!(
                        "line {line}: a carriage return stands inside; expected each line to end \
                         in a newline"
                    ));
                }
                (None, _) => {
                    return Err(format!(
                        "line {line}: there is no column {name}; expected {}",
                        INPUTS.join(",")
                    ));
                }
            };
        }
        let names = names.into_iter().map(String::from_utf8_lossy);
        Ok(Self {
            places,
            names: names.map(Cow::into_owned).collect(),
        })
    }

    /// Appends the row as it was read, or, if it is none, as many fields as there are columns.
    ///
    /// A carriage return within goes into quotes: some readers take it for the end of a row.
    fn copy(&self, row: &Row, text: &mut Vec<u8>) {
        let bare = row.bare_text();
        if row.closed && !row.cut && row.len() == self.count() && !bare.contains(&b'\r') {
            text.extend_from_slice(bare);
            return;
        }
        for field in 0..self.count() {
            if field > 0 {
                text.push(b',');
            }
            push_field(text, row.get(field).unwrap_or_default());
        }
    }

    /// The ray and the sphere of a row, or column, value and what was expected.
    fn read(&self, row: &Row) -> Result<(Ray, Sphere), String> {
        if row.cut {
            let column = self.name(row.len());
            return Err(format!(
                "column {column}: the line is longer than {LONGEST} bytes; what is beyond was left \
                 out"
            ));
        }
        if !row.closed {
            let column = self.name(row.len() - 1);
            return Err(format!(
                "column {column}: a quote opens and is never closed"
            ));
        }
        if row.len() > self.count() {
            return Err(format!(
                "column {}: {} fields, but the header has {}; what is beyond was left out",
                self.count() + 1,
                row.len(),
                self.count()
            ));
        }
        let mut x = [0.0; INPUTS.len()];
        for ((x, name), &place) in x.iter_mut().zip(INPUTS).zip(&self.places) {
            let field = row.get(place).ok_or_else(|| {
                format!(
                    "column {name}: nothing there; expected {} fields",
                    self.count()
                )
            })?;
            *x = number(field).map_err(|reason| format!("column {name}: {reason}"))?;
        }
        let [ox, oy, oz, dx, dy, dz, cx, cy, cz, r] = x;
        let ray = Ray::new(Vec3::new(ox, oy, oz), Vec3::new(dx, dy, dz))
            .map_err(|e| format!("columns dx, dy, dz: {}; expected {}", e.found, e.expected))?;
        let sphere = Sphere::new(Vec3::new(cx, cy, cz), r)
            .map_err(|e| format!("column r: {}; expected {}", e.found, e.expected))?;
        Ok((ray, sphere))
    }
}

/// Appends what a method says of one row, in the order of `OUTPUTS`.
fn push_answers(text: &mut Vec<u8>, method: Method, ray: &Ray, sphere: &Sphere) -> io::Result<()> {
    let Solution {
        class, near, far, ..
    } = method.solve(ray, sphere);
    write!(text, ",{}", class.name())?;
    if class == Class::Miss {
        text.extend_from_slice(b",,");
    } else {
        let [near, far] = [near, far].map(|t| format::binary32(t, Glyphs::Ascii));
        write!(text, ",{near},{far}")?;
    }
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

fn end(row: &Row, text: &mut Vec<u8>) {
    text.extend_from_slice(match row.line_end() {
        b"" => b"\n",
        end => end,
    });
}
