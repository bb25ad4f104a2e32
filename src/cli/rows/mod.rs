//! CSV files of rays and spheres: columns by name, in any order and among others, and rows that are
//! read or refused in a sentence.

mod reader;

use std::borrow::Cow;
use std::io::{self, BufRead};
use std::path::{Path, PathBuf};

use glam::Vec3;

pub(super) use reader::CsvRow;

use self::reader::{CsvRows, LONGEST, push_field};
use super::Failure;
use crate::door::{Expected, FileError, shown};
use crate::geometry::{Ray, Sphere};
use crate::text::read;

/// The columns of a ray and a sphere.
pub(super) const INPUTS: [&str; 10] = ["ox", "oy", "oz", "dx", "dy", "dz", "cx", "cy", "cz", "r"];

/// A CSV file of which the header has been read.
pub(super) struct CsvFile<R, const N: usize> {
    expected: Expected,
    path: PathBuf,
    rows: CsvRows<R>,
    pub columns: CsvColumns<N>,
}

impl<R: BufRead, const N: usize> CsvFile<R, N> {
    /// Reads the header, which has to have the columns `names`, the first ten being `INPUTS`.
    pub fn open(
        expected: Expected,
        path: &Path,
        input: R,
        names: [&'static str; N],
    ) -> Result<(Self, CsvRow), Failure> {
        let mut rows = CsvRows::new(input);
        let mut header = CsvRow::default();
        let found = rows.read(&mut header, None);
        if !found.map_err(|e| unread(expected, path, &e))? {
            let (path, columns) = (shown(path), names.join(","));
            let sentence = format!("{path} is empty: expected a header with {columns}");
            return Err(Failure::invalid(sentence));
        }
        let columns = CsvColumns::of(&header, names).map_err(|reason| {
            let (path, line) = (shown(path), header.line);
            Failure::invalid(format_args!("{path}: line {line}{reason}"))
        })?;
        let file = Self {
            expected,
            path: path.to_owned(),
            rows,
            columns,
        };
        Ok((file, header))
    }

    /// Reads the next row; false at the end.
    pub fn read(&mut self, row: &mut CsvRow) -> Result<bool, Failure> {
        let found = self.rows.read(row, Some(self.columns.count()));
        found.map_err(|e| unread(self.expected, &self.path, &e))
    }
}

/// What an error within a file means.
fn unread(expected: Expected, path: &Path, error: &io::Error) -> Failure {
    unreadable(&FileError {
        file: shown(path),
        ..expected.refusal(path, error)
    })
}

/// What a file means that cannot be read.
pub(super) fn unreadable(error: &FileError) -> Failure {
    Failure::invalid(format_args!("cannot read {error}"))
}

/// Where the columns that are wanted are in a row.
pub(super) struct CsvColumns<const N: usize> {
    wanted: [&'static str; N],
    /// For each column that is wanted, the field that holds it.
    places: [usize; N],
    /// The names of all columns as the header has them.
    names: Vec<String>,
}

impl<const N: usize> CsvColumns<N> {
    /// The columns by the names in the header; a name too few or twice is refused in a sentence.
    fn of(header: &CsvRow, wanted: [&'static str; N]) -> Result<Self, String> {
        let names: Vec<&[u8]> = header.iter().map(<[u8]>::trim_ascii).collect();
        let mut places = [0; N];
        for (place, name) in places.iter_mut().zip(wanted) {
            let mut found = (0..names.len()).filter(|&i| names[i] == name.as_bytes());
            *place = match (found.next(), found.next()) {
                (Some(place), None) => place,
                (Some(_), Some(_)) => {
                    return Err(format!(": there are two columns {name}; expected one"));
                }
                (None, _) if header.bare_text().contains(&b'\r') => {
                    return Err(
                        ": found a carriage return inside, expected each line to end in a newline"
                            .to_owned(),
                    );
                }
                (None, _) => {
                    let expected = wanted.join(",");
                    return Err(format!(": there is no column {name}; expected {expected}"));
                }
            };
        }
        let names = names.into_iter().map(String::from_utf8_lossy);
        Ok(Self {
            wanted,
            places,
            names: names.map(Cow::into_owned).collect(),
        })
    }

    /// The field of a column that may be there; twice is refused in a sentence.
    pub fn optional(&self, name: &'static str) -> Result<Option<OptionalColumn>, String> {
        let mut found = (0..self.names.len()).filter(|&i| self.names[i] == name);
        match (found.next(), found.next()) {
            (_, Some(_)) => Err(format!(": there are two columns {name}; expected one")),
            (place, None) => Ok(place.map(|place| OptionalColumn { name, place })),
        }
    }

    /// Whether the file has a column of that name.
    pub fn has(&self, name: &str) -> bool {
        self.names.iter().any(|n| n == name)
    }

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

    /// Appends the row as it was read, or, if it is none, as many fields as there are columns.
    ///
    /// A carriage return within goes into quotes: some readers take it for the end of a row.
    pub fn copy(&self, row: &CsvRow, text: &mut Vec<u8>) {
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

    /// The text of a wanted column, counted from 0; none if the row ends before it.
    pub fn field<'r>(&self, row: &'r CsvRow, wanted: usize) -> Option<Cow<'r, str>> {
        let field = row.get(self.places[wanted])?;
        Some(String::from_utf8_lossy(field.trim_ascii()))
    }

    /// The ray and the sphere of a row, or column, value and what was expected.
    pub fn problem(&self, row: &CsvRow) -> Result<(Ray, Sphere), String> {
        self.check(row)?;
        let mut x = [0.0; INPUTS.len()];
        for ((x, name), &place) in x.iter_mut().zip(self.wanted).zip(&self.places) {
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

    /// Refuses a row of which the fields are not those of the header.
    fn check(&self, row: &CsvRow) -> Result<(), String> {
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
        Ok(())
    }
}

/// A column that a file may have or not.
pub(super) struct OptionalColumn {
    name: &'static str,
    place: usize,
}

impl OptionalColumn {
    /// What a row has there, read by `parse`, or column, value and what was expected.
    pub fn read<T>(
        &self,
        row: &CsvRow,
        parse: impl Fn(&[u8]) -> Result<T, String>,
    ) -> Result<T, String> {
        let field = row.get(self.place).unwrap_or_default();
        parse(field).map_err(|reason| format!("column {}: {reason}", self.name))
    }
}

/// A number rounded once to binary32; refused with its text if it is none, or beyond the range.
pub fn number(field: &[u8]) -> Result<f32, String> {
    let field = field.trim_ascii();
    match str::from_utf8(field).ok().and_then(read::binary32) {
        Some(number) if f32::is_finite(number) => Ok(number),
        number => Err(refusal(field, number)),
    }
}

/// Why a field is no number that will do.
fn refusal(field: &[u8], number: Option<f32>) -> String {
    let text = String::from_utf8_lossy(field);
    let shown: String = text.chars().take(40).collect();
    let has_digits = text.contains(|c: char| c.is_ascii_digit());
    match number {
        None if text.is_empty() => "nothing there; expected a number".to_owned(),
        None => format!("`{shown}` is not a number; expected one like -1.5e3 or 0x1.8p3"),
        Some(x) if x.is_infinite() && has_digits => {
            format!("{shown} is past the range of binary32; expected at most 3.4028235e38")
        }
        Some(_) => format!("{shown} is no finite number; expected one"),
    }
}
