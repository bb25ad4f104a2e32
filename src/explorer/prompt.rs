//! One line of text being typed.

use super::key::Key;

/// Longest line taken: a paste of a whole file is no answer to a question.
const LONGEST: usize = 4096;

/// A line of text with a cursor in it.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Line {
    chars: Vec<char>,
    at: usize,
}

impl Line {
    /// A line that holds `text`, its cursor at the end.
    pub fn new(text: &str) -> Self {
        let mut line = Self::default();
        line.insert(text);
        line
    }

    /// The text.
    pub fn text(&self) -> String {
        self.chars.iter().collect()
    }

    /// Number of characters before the cursor.
    pub const fn cursor(&self) -> usize {
        self.at
    }

    /// Types the first line of a text; whatever is no printable character is left out.
    pub fn insert(&mut self, text: &str) {
        let first = text.split(['\n', '\r']).next().unwrap_or_default();
        for c in first.chars().filter(|c| !c.is_control()) {
            if self.chars.len() < LONGEST {
                self.chars.insert(self.at, c);
                self.at += 1;
            }
        }
    }

    /// Lets a key edit the line; false if it is not for editing.
    pub fn edit(&mut self, key: Key) -> bool {
        let is = |name| key.is(name);
        if let Some(c) = key.typed() {
            self.insert(c.encode_utf8(&mut [0; 4]));
        } else if is("backspace") {
            if self.at > 0 {
                self.at -= 1;
                self.chars.remove(self.at);
            }
        } else if is("delete") {
            if self.at < self.chars.len() {
                self.chars.remove(self.at);
            }
        } else if is("left") {
            self.at = self.at.saturating_sub(1);
        } else if is("right") {
            self.at = (self.at + 1).min(self.chars.len());
        } else if is("home") || is("ctrl-a") {
            self.at = 0;
        } else if is("end") || is("ctrl-e") {
            self.at = self.chars.len();
        } else if is("ctrl-u") {
            self.chars.drain(..self.at);
            self.at = 0;
        } else if is("ctrl-w") {
            let blank = |c: &char| !c.is_alphanumeric();
            let end = self.at;
            while self.at > 0 && blank(&self.chars[self.at - 1]) {
                self.at -= 1;
            }
            while self.at > 0 && !blank(&self.chars[self.at - 1]) {
                self.at -= 1;
            }
            self.chars.drain(self.at..end);
        } else {
            return false;
        }
        true
    }
}
