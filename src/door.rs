//! The one door for every file from outside.
//!
//! A file is opened without blocking, checked once it is open, and read within a bound. What is
//! wrong with it is one sentence, with the line and the column where there are any.

use std::env;
use std::fmt;
use std::fs::{self, File, Metadata, OpenOptions};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use crate::system::file::{kind_of_special, noted_home, open_without_waiting};

/// The name of standard input in the place of a file.
const STANDARD_INPUT: &str = "-";

/// What a file should be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Expected {
    /// A noun phrase: `a scene file`.
    pub what: &'static str,
    /// The most bytes that are read of it.
    pub most: u64,
}

/// A file that could not be read, or does not hold what it should: one sentence when displayed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FileError {
    /// The file, as it was named.
    pub file: String,
    /// Where in the file; none if the file as a whole is at fault.
    pub position: Option<TextPosition>,
    /// What was found there and what was expected.
    pub problem: String,
}

/// A place in a text, counted from 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TextPosition {
    /// The line.
    pub line: usize,
    /// The character in that line.
    pub column: usize,
}

impl TextPosition {
    /// The place of a byte of a text.
    pub fn of(offset: usize, text: &[u8]) -> Self {
        let before = &text[..offset.min(text.len())];
        let lines = before.split(|&byte| byte == b'\n');
        let last = lines.clone().next_back().unwrap_or_default();
        Self {
            line: lines.count(),
            column: 1 + String::from_utf8_lossy(last).chars().count(),
        }
    }
}

impl fmt::Display for FileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:", self.file)?;
        if let Some(TextPosition { line, column }) = self.position {
            write!(f, "{line}:{column}:")?;
        }
        write!(f, " {}", self.problem)
    }
}

impl std::error::Error for FileError {}

impl FileError {
    /// A file that as a whole is at fault.
    pub fn whole(path: &Path, problem: impl Into<String>) -> Self {
        Self {
            file: path.display().to_string(),
            position: None,
            problem: problem.into(),
        }
    }
}

impl Expected {
    /// The text of a file in UTF-8, without a byte order mark.
    pub fn text(self, path: &Path) -> Result<String, FileError> {
        let mut bytes = self.bytes(path)?;
        if bytes.starts_with(BYTE_ORDER_MARK) {
            bytes.drain(..BYTE_ORDER_MARK.len());
        }
        String::from_utf8(bytes).map_err(|error| {
            let at = error.utf8_error().valid_up_to();
            let bytes = error.as_bytes();
            let byte = bytes[at];
            let problem = format!("found the byte 0x{byte:02x}, expected text in UTF-8");
            FileError {
                position: Some(TextPosition::of(at, bytes)),
                ..FileError::whole(path, problem)
            }
        })
    }

    /// The bytes of a file.
    pub fn bytes(self, path: &Path) -> Result<Vec<u8>, FileError> {
        let mut bytes = Vec::new();
        match self.open(path)?.read_to_end(&mut bytes) {
            Ok(_) => Ok(bytes),
            Err(error) => Err(self.refusal(path, &error)),
        }
    }

    /// A file to be read bit by bit; `-` is standard input.
    pub fn stream(self, path: &Path) -> Result<Box<dyn Read>, FileError> {
        if is_standard_input(path) {
            return Ok(Box::new(BoundedInput::new(io::stdin().lock(), self.most)));
        }
        match self.open(path) {
            Ok(file) => Ok(Box::new(file)),
            Err(error) => Err(FileError {
                problem: format!("{}, or - for standard input", error.problem),
                ..error
            }),
        }
    }

    /// A regular file, open for reading.
    fn open(self, path: &Path) -> Result<BoundedInput<File>, FileError> {
        let opened = regular(File::options().read(true), path);
        let opened = opened.map_err(|refusal| match refusal {
            Refusal::Special(kind) => self.found(path, kind),
            Refusal::System(error) => self.refusal(path, &error),
        })?;
        match opened.metadata() {
            Ok(found) if found.len() > self.most => Err(self.too_large(path)),
            Ok(_) => Ok(BoundedInput::new(opened, self.most)),
            Err(error) => Err(self.refusal(path, &error)),
        }
    }

    /// What it means that a file, or standard input for `-`, can not be read.
    pub fn refusal(self, path: &Path, error: &io::Error) -> FileError {
        use io::ErrorKind;
        let found = match error.kind() {
            ErrorKind::NotFound => "no such file",
            ErrorKind::NotADirectory => "a file where its path has a folder",
            ErrorKind::IsADirectory => "a directory",
            ErrorKind::PermissionDenied => "a file that may not be read",
            ErrorKind::InvalidInput | ErrorKind::InvalidFilename => "a name that no file can have",
            ErrorKind::FileTooLarge => return self.too_large(path),
            // The reader's own sentence.
            ErrorKind::Other => return FileError::whole(path, error.to_string()),
            _ => {
                return FileError::whole(
                    path,
                    format!("this file cannot be read: {}", plain(error)),
                );
            }
        };
        self.found(path, found)
    }

    fn too_large(self, path: &Path) -> FileError {
        let (what, mib) = (self.what, self.most >> 20);
        let problem = format!("found more than {mib} MiB, expected {what} of at most {mib} MiB");
        FileError::whole(path, problem)
    }

    fn found(self, path: &Path, found: &str) -> FileError {
        FileError::whole(path, format!("found {found}, expected {}", self.what))
    }
}

/// Input that fails once more than its bound has been read.
struct BoundedInput<R> {
    input: R,
    left: u64,
}

impl<R> BoundedInput<R> {
    const fn new(input: R, most: u64) -> Self {
        Self { input, left: most }
    }
}

impl<R: Read> Read for BoundedInput<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        if self.left == 0 {
            return match self.input.read(&mut [0])? {
                0 => Ok(0),
                _ => Err(io::ErrorKind::FileTooLarge.into()),
            };
        }
        let most = buffer
            .len()
            .min(usize::try_from(self.left).unwrap_or(usize::MAX));
        let count = self.input.read(&mut buffer[..most])?;
        self.left -= count as u64;
        Ok(count)
    }
}

/// A byte order mark, which some programs write before a text.
pub const BYTE_ORDER_MARK: &[u8] = "\u{feff}".as_bytes();

/// A text without the byte order mark before it.
pub fn without_mark(text: &str) -> &str {
    text.strip_prefix('\u{feff}').unwrap_or(text)
}

/// Why a file is not opened.
#[derive(Debug)]
pub enum Refusal {
    /// It is no regular file, but this.
    Special(&'static str),
    /// The system refuses.
    System(io::Error),
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Special(_) => f.write_str("it is not a regular file"),
            Self::System(error) => write!(f, "{}", plain(error)),
        }
    }
}

/// An error of the system without the number that it has there.
pub fn plain(error: &io::Error) -> String {
    let text = error.to_string();
    let end = text.rfind(" (os error ").unwrap_or(text.len());
    text[..end].to_owned()
}

/// Opens a regular file and nothing else.
pub fn regular(options: &mut OpenOptions, path: &Path) -> Result<File, Refusal> {
    // To open a device may do things, and to open a pipe may wake its writer.
    if let Ok(found) = fs::metadata(path) {
        check(&found)?;
    }
    let file = open_without_waiting(options, path).map_err(Refusal::System)?;
    // Another one may have taken its place meanwhile.
    check(&file.metadata().map_err(Refusal::System)?)?;
    Ok(file)
}

fn check(found: &Metadata) -> Result<(), Refusal> {
    match found.file_type() {
        kind if kind.is_file() => Ok(()),
        kind if kind.is_dir() => Err(Refusal::Special("a directory")),
        kind => Err(Refusal::Special(kind_of_special(kind))),
    }
}

/// Whether a file's name stands for standard input.
pub fn is_standard_input(path: &Path) -> bool {
    path == Path::new(STANDARD_INPUT)
}

/// What an input file is called in a sentence.
pub fn shown(path: &Path) -> String {
    if is_standard_input(path) {
        "standard input".to_owned()
    } else {
        path.display().to_string()
    }
}

/// A file's name as a person types it, with the home folder in the place of a `~` at its beginning.
pub fn typed(name: &str) -> String {
    let rest = match name.strip_prefix('~') {
        Some(rest) if rest.is_empty() || rest.starts_with('/') => rest,
        _ => return name.to_owned(),
    };
    let home = home().and_then(|home| home.into_os_string().into_string().ok());
    home.map_or_else(|| name.to_owned(), |home| home + rest)
}

/// The home folder: that of the environment, or where this names none, that which the system has
/// noted.
pub fn home() -> Option<PathBuf> {
    let is_usable = |home: &PathBuf| home.is_absolute();
    let home = env::home_dir().filter(is_usable);
    home.or_else(|| noted_home().filter(is_usable))
}

#[cfg(test)]
mod tests {
    use super::*;

    const SMALL: Expected = Expected {
        what: "a small file",
        most: 10,
    };

    #[test]
    fn what_grows_while_it_is_read_is_held_to_its_bound() {
        let read = |input: &mut dyn Read| {
            let mut bytes = Vec::new();
            let ended = BoundedInput::new(input, SMALL.most).read_to_end(&mut bytes);
            (bytes.len(), ended.map_err(|e| e.kind()))
        };
        assert_eq!(read(&mut &[b'x'; 10][..]), (10, Ok(10)));
        let too_large = Err(io::ErrorKind::FileTooLarge);
        assert_eq!(read(&mut io::repeat(b'x')), (10, too_large));
    }

    #[test]
    fn a_place_counts_lines_and_characters() {
        let text = "a\nbä\u{e9}c\n";
        let place = |offset| {
            let TextPosition { line, column } = TextPosition::of(offset, text.as_bytes());
            (line, column)
        };
        assert_eq!(place(0), (1, 1));
        assert_eq!(place(2), (2, 1));
        assert_eq!(place(text.find('c').unwrap()), (2, 4));
        assert_eq!(place(1000), (3, 1));
    }

    #[test]
    fn only_a_tilde_that_is_a_whole_name_is_the_home_folder() {
        let home = home().expect("a home").into_os_string().into_string();
        let home = home.expect("text");
        assert_eq!(typed("~/a b.toml"), format!("{home}/a b.toml"));
        assert_eq!(typed("~"), home);
        for name in ["~a", "a/~", "./~/a", "", "a~/b"] {
            assert_eq!(typed(name), name);
        }
    }
}
