//! One line of text being typed.

use crate::explorer::key::Key;

/// Longest line taken: a paste of a whole file is no answer to a question.
const LONGEST: usize = 4096;

/// A line of text with a cursor in it.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct TypedLine {
    chars: Vec<char>,
    at: usize,
    /// The text is an old one, which goes when another is typed, and stays when it is edited.
    is_chosen: bool,
}

impl TypedLine {
    /// A line that holds `text`, its cursor at the end.
    pub fn new(text: &str) -> Self {
        let mut line = Self::default();
        line.insert(text);
        line
    }

    /// A line that holds `text` until another is typed in its place.
    pub fn chosen(text: &str) -> Self {
        Self {
            is_chosen: !text.is_empty(),
            ..Self::new(text)
        }
    }

    /// Whether what is typed takes the place of the text.
    pub const fn is_chosen(&self) -> bool {
        self.is_chosen
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
        if std::mem::take(&mut self.is_chosen) {
            *self = Self::default();
        }
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
            return true;
        }
        self.is_chosen = false;
        if is("backspace") {
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

#[cfg(test)]
mod tests {
    use super::*;

    fn typed(line: &mut TypedLine, keys: &[&str]) -> String {
        for name in keys {
            assert!(line.edit(Key::parse(name).expect("a key")), "{name}");
        }
        line.text()
    }

    #[test]
    fn a_chosen_text_is_typed_over_or_edited() {
        let over = || TypedLine::chosen("12.5");
        assert_eq!(typed(&mut over(), &["7", "5"]), "75");
        assert_eq!(typed(&mut over(), &["backspace", "2"]), "12.2");
        assert_eq!(typed(&mut over(), &["left", "0"]), "12.05");
        assert_eq!(typed(&mut over(), &["home", "-"]), "-12.5");
        let mut pasted = over();
        pasted.insert("0x1p3");
        assert_eq!(pasted.text(), "0x1p3");
        assert_eq!(typed(&mut TypedLine::new("ab"), &["c"]), "abc");
    }
}
