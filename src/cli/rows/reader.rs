//! The rows of a CSV file as they were written, each with the number of its line.
//!
//! One row is held at a time. A quote that is never closed, or a line too long to hold, spoils its
//! own line alone.

use std::collections::VecDeque;
use std::io::{self, BufRead, Read};

use csv_core::{ReadRecordResult, ReaderBuilder, Terminator};

use crate::door::BYTE_ORDER_MARK;

/// The most bytes that a row may have.
pub const LONGEST: usize = 1 << 16;

/// Reads rows one by one.
pub struct CsvRows<R> {
    input: R,
    /// Lines that were read in search of a closing quote and are rows of their own, each with
    /// whether its end was cut off.
    held_back: VecDeque<(Vec<u8>, bool)>,
    /// Lines taken so far.
    lines: u64,
    splitter: csv_core::Reader,
}

/// One row: its text, and its fields without their quotes.
#[derive(Debug, Default)]
pub struct CsvRow {
    /// The number of its first line, from 1.
    pub line: u64,
    /// The text as it was read, line ends inside it and at its end included.
    text: Vec<u8>,
    contents: Vec<u8>,
    ends: Vec<usize>,
    fields: usize,
    /// Whether all quotes in it are closed.
    pub closed: bool,
    /// Whether the line was longer than `LONGEST`; the field in which it was cut is left out.
    pub cut: bool,
}

/// A line that was added to a row's text.
struct LineTaken {
    /// Whether there was a line.
    any: bool,
    /// Whether it was longer than `LONGEST` and is cut there.
    cut: bool,
}

impl<R: BufRead> CsvRows<R> {
    /// The rows of `input`, from its first line.
    pub fn new(input: R) -> Self {
        Self {
            input,
            held_back: VecDeque::new(),
            lines: 0,
            // A carriage return ends no line by itself, so that it cannot hide what follows.
            splitter: ReaderBuilder::new()
                .terminator(Terminator::Any(b'\n'))
                .build(),
        }
    }

    /// Reads the next row that is not an empty line, of `expected` fields if it extends over
    /// several lines; false at the end.
    pub fn read(&mut self, row: &mut CsvRow, expected: Option<usize>) -> io::Result<bool> {
        loop {
            row.line = self.lines + 1;
            row.text.clear();
            let LineTaken { any, cut } = self.take_line(&mut row.text)?;
            if !any {
                return Ok(false);
            }
            row.cut = cut;
            self.lines += 1;
            if row.line == 1 && row.text.starts_with(BYTE_ORDER_MARK) {
                row.text.drain(..BYTE_ORDER_MARK.len());
            }
            if !row.bare_text().is_empty() {
                break;
            }
        }
        self.split(row);
        if row.cut {
            row.fields -= 1;
            row.closed = true;
        } else if !row.closed {
            self.read_on(row, expected)?;
        }
        Ok(true)
    }

    /// Appends the next line with its end, cut if it is too long.
    fn take_line(&mut self, text: &mut Vec<u8>) -> io::Result<LineTaken> {
        if let Some((line, cut)) = self.held_back.pop_front() {
            text.extend(line);
            return Ok(LineTaken { any: true, cut });
        }
        let most = LONGEST as u64 + 1;
        let taken = (&mut self.input).take(most).read_until(b'\n', text)?;
        let cut = taken > LONGEST && !text.ends_with(b"\n");
        if cut {
            // A header is nothing without its end.
            if self.lines == 0 {
                return Err(io::Error::other(format!(
                    "line 1 is longer than {LONGEST} bytes"
                )));
            }
            if self.skip_line()? {
                text.push(b'\n');
            }
        }
        let any = taken > 0;
        Ok(LineTaken { any, cut })
    }

    /// Passes over what is left of a line, its end included; false if it has none.
    fn skip_line(&mut self) -> io::Result<bool> {
        loop {
            let buffer = self.input.fill_buf()?;
            if buffer.is_empty() {
                return Ok(false);
            }
            let end = buffer.iter().position(|&b| b == b'\n');
            let length = end.map_or(buffer.len(), |end| end + 1);
            self.input.consume(length);
            if end.is_some() {
                return Ok(true);
            }
        }
    }

    /// Looks in the lines after an open quote for its end; if that makes no row, leaves them.
    fn read_on(&mut self, row: &mut CsvRow, expected: Option<usize>) -> io::Result<()> {
        let first = row.text.len();
        let mut starts = vec![first];
        let mut last_is_cut = false;
        while row.text.len() <= LONGEST {
            let LineTaken { any, cut } = self.take_line(&mut row.text)?;
            if !any {
                break;
            }
            let newest = starts[starts.len() - 1];
            let quoted = row.text[newest..].contains(&b'"');
            starts.push(row.text.len());
            last_is_cut = cut;
            if quoted && !cut {
                self.split(row);
                if row.closed {
                    break;
                }
            }
        }
        if row.closed && expected.is_none_or(|count| count == row.fields) {
            self.lines += starts.len() as u64 - 1;
            return Ok(());
        }
        for bounds in starts.windows(2).rev() {
            let line = row.text[bounds[0]..bounds[1]].to_vec();
            self.held_back.push_front((line, last_is_cut));
            last_is_cut = false;
        }
        row.text.truncate(first);
        self.split(row);
        Ok(())
    }

    /// Finds the fields of the row's text, and whether its quotes are closed.
    fn split(&mut self, row: &mut CsvRow) {
        let text = &row.text[..row.bare_length()];
        // Room for a comma at each place, and for the end.
        if row.ends.len() < text.len() + 2 {
            row.contents.resize(text.len() + 1, 0);
            row.ends.resize(text.len() + 2, 0);
        }

        let (written, fields) = self.start(text, &mut row.contents, &mut row.ends);
        let (contents, ends) = (&mut row.contents[written..], &mut row.ends[fields..]);
        let (result, ..) = self.splitter.read_record(b"\n", contents, ends);
        row.closed = result == ReadRecordResult::Record;
        row.fields = fields + 1;
        if !row.closed {
            // The line end went into the open field; once more, with the end of input instead.
            let (written, fields) = self.start(text, &mut row.contents, &mut row.ends);
            let (contents, ends) = (&mut row.contents[written..], &mut row.ends[fields..]);
            self.splitter.read_record(b"", contents, ends);
        }
    }

    /// Splits `text` but for its end; bytes and ends of fields written.
    fn start(&mut self, text: &[u8], contents: &mut [u8], ends: &mut [usize]) -> (usize, usize) {
        self.splitter.reset();
        let (_, _, written, fields) = self.splitter.read_record(text, contents, ends);
        (written, fields)
    }
}

impl CsvRow {
    /// The text without the line end after it.
    pub fn bare_text(&self) -> &[u8] {
        &self.text[..self.bare_length()]
    }

    fn bare_length(&self) -> usize {
        self.text.len() - self.line_end().len()
    }

    /// The line end that the row was read with; empty if the input ended without one.
    pub fn line_end(&self) -> &'static [u8] {
        [&b"\r\n"[..], b"\n"]
            .into_iter()
            .find(|end| self.text.ends_with(end))
            .unwrap_or(b"")
    }

    /// Number of fields.
    pub fn len(&self) -> usize {
        self.fields
    }

    /// The contents of a field, counted from 0.
    pub fn get(&self, field: usize) -> Option<&[u8]> {
        let end = *self.ends[..self.fields].get(field)?;
        let start = field.checked_sub(1).map_or(0, |before| self.ends[before]);
        self.contents.get(start..end)
    }

    /// The contents of all fields.
    pub fn iter(&self) -> impl Iterator<Item = &[u8]> {
        (0..self.fields).map(|i| self.get(i).unwrap_or_default())
    }
}

/// Appends a field to a row of CSV, in quotes if it needs them.
pub fn push_field(row: &mut Vec<u8>, contents: &[u8]) {
    if !contents.iter().any(|b| b"\",\r\n".contains(b)) {
        row.extend_from_slice(contents);
        return;
    }
    row.push(b'"');
    for &byte in contents {
        if byte == b'"' {
            row.push(b'"');
        }
        row.push(byte);
    }
    row.push(b'"');
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Line, fields and whether they are closed, of each row of a file of `count` columns.
    fn rows(text: &str, count: usize) -> Vec<(u64, Vec<String>, bool)> {
        let mut rows = CsvRows::new(text.as_bytes());
        let mut row = CsvRow::default();
        let mut found = Vec::new();
        while rows.read(&mut row, Some(count)).unwrap() {
            let fields = row.iter().map(|f| String::from_utf8(f.to_vec()).unwrap());
            found.push((row.line, fields.collect(), row.closed));
        }
        found
    }

    fn row(line: u64, fields: &[&str]) -> (u64, Vec<String>, bool) {
        (line, fields.iter().map(|&f| f.to_owned()).collect(), true)
    }

    #[test]
    fn counts_lines_through_empty_ones_and_either_line_end() {
        let found = rows("\u{feff}a,b\r\n\r\n1,\n\n\n,2\r\n3,4", 2);
        let expected = [
            row(1, &["a", "b"]),
            row(3, &["1", ""]),
            row(6, &["", "2"]),
            row(7, &["3", "4"]),
        ];
        assert_eq!(found, expected);
    }

    #[test]
    fn takes_quotes_and_what_they_hold() {
        let found = rows("\"a \"\"x\"\"\",\"1,2\"\n\"two\nlines\",b\n5\" nail,c\n", 2);
        let expected = [
            row(1, &["a \"x\"", "1,2"]),
            row(2, &["two\nlines", "b"]),
            row(4, &["5\" nail", "c"]),
        ];
        assert_eq!(found, expected);
    }

    #[test]
    fn an_open_quote_spoils_its_own_line_alone() {
        let expected = [
            (1, vec!["a".to_owned(), "b,c".to_owned()], false),
            row(2, &["1", "2", "3"]),
            row(3, &["4", "5", "6"]),
        ];
        assert_eq!(rows("a,\"b,c\n1,2,3\n4,5,6\n", 3), expected);
        // The quote that would close it makes no row of three fields.
        let mut found = rows("a,\"b,c\n1,2,3\n4,5,6\n7,8,\"9\"\n", 3);
        assert_eq!(found.pop(), Some(row(4, &["7", "8", "9"])));
        assert_eq!(found, expected);
    }

    #[test]
    fn a_carriage_return_within_a_line_hides_nothing() {
        let expected = [row(1, &["a\rb", "c"]), row(2, &["1", "2\r"])];
        assert_eq!(rows("a\rb,c\r\n1,2\r\r\n", 2), expected);
    }

    #[test]
    fn a_line_too_long_to_hold_spoils_itself_alone() {
        let long = "x".repeat(3 * LONGEST);
        let whole = [row(1, &["a", "b"]), row(2, &["1"]), row(3, &["2", "3"])];
        assert_eq!(rows(&format!("a,b\n1,{long}\n2,3\n"), 2), whole);
        assert_eq!(rows(&format!("a,b\n1,{long}"), 2), whole[..2]);
        // In search of a closing quote it is passed over and read again.
        let found = rows(&format!("a,b\n\"1,2\n3,{long}\n4,5\n"), 2);
        assert_eq!(found[2..], [row(3, &["3"]), row(4, &["4", "5"])]);
        assert!(!found[1].2);
    }

    #[test]
    fn refuses_a_header_without_end() {
        let mut rows = CsvRows::new(io::BufReader::new(io::repeat(b'1')));
        let error = rows.read(&mut CsvRow::default(), None).unwrap_err();
        assert_eq!(error.to_string(), "line 1 is longer than 65536 bytes");
    }

    #[test]
    fn quotes_what_needs_it() {
        let mut row = Vec::new();
        push_field(&mut row, b"plain");
        push_field(&mut row, b"a,\"b\"\n");
        assert_eq!(row, b"plain\"a,\"\"b\"\"\n\"");
    }
}
