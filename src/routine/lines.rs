//! The lines of a routine: code and comments apart, for `naga` knows no comments and we show them.

/// A line of the text.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(crate) struct SourceLine {
    /// What is code, without space around it.
    pub code: String,
    /// What the comment on it says.
    pub comment: String,
}

/// The text with spaces where comments were, byte for byte as long, and its lines.
pub(super) fn split(text: &str, comments_nest: bool) -> (String, Vec<SourceLine>) {
    let mut code = String::with_capacity(text.len());
    let mut comments: Vec<String> = vec![String::new()];
    let mut state = ScanState::Code;
    let mut rest = text;
    while let Some(c) = rest.chars().next() {
        let two = rest.get(..2).unwrap_or("");
        let (next, taken) = match (state, two) {
            (ScanState::Code, "//") => (ScanState::ToEnd, 2),
            (ScanState::Code, "/*") => (ScanState::Within(1), 2),
            (ScanState::Within(depth), "/*") if comments_nest => (ScanState::Within(depth + 1), 2),
            (ScanState::Within(1), "*/") => (ScanState::Code, 2),
            (ScanState::Within(depth), "*/") => (ScanState::Within(depth - 1), 2),
            (ScanState::ToEnd, _) if c == '\n' => (ScanState::Code, 1),
            (state, _) => (state, c.len_utf8()),
        };
        if c == '\n' {
            code.push('\n');
            comments.push(String::new());
        } else if state == ScanState::Code && next == ScanState::Code {
            code.push_str(&rest[..taken]);
        } else {
            code.extend(std::iter::repeat_n(' ', taken));
            if state != ScanState::Code && next != ScanState::Code {
                comments
                    .last_mut()
                    .expect("one line at least")
                    .push_str(&rest[..taken]);
            }
        }
        state = next;
        rest = &rest[taken..];
    }
    let lines = code
        .split('\n')
        .zip(&comments)
        .map(|(code, comment)| SourceLine {
            code: code.trim().to_owned(),
            comment: comment.trim().trim_start_matches('*').trim().to_owned(),
        });
    let lines = lines.collect();
    (code, lines)
}

/// What a character belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum ScanState {
    Code,
    /// A comment to the end of the line.
    ToEnd,
    /// A comment that needs an end, and in how many it lies.
    Within(usize),
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_are_kept_apart_and_leave_no_byte_out_of_place() {
        let text = "float a; // größer\n/* one\n * two */ b; a/b;\r\n";
        let (code, lines) = split(text, false);
        assert_eq!(code.len(), text.len());
        assert_eq!(code.find("b;"), text.find("b;"));
        assert_eq!(
            (&*lines[0].code, &*lines[0].comment),
            ("float a;", "größer")
        );
        assert_eq!(lines[1].comment, "one");
        assert_eq!((&*lines[2].code, &*lines[2].comment), ("b; a/b;", "two"));
        assert!(split("/* /* */ x", true).0.trim().is_empty());
        assert_eq!(split("/* /* */ x", false).0.trim(), "x");
    }
}
