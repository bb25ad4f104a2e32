//! Text from outside, on its way to a terminal.

use std::borrow::Cow;
use std::fmt::Write as _;

/// A text of several lines with nothing in it that a terminal acts on but line ends, tabs and form
/// feeds: all else is written as an escape, as in `\u{1b}`.
pub fn printable(text: &str) -> Cow<'_, str> {
    escaped(text, |c| matches!(c, '\n' | '\t' | '\u{c}'))
}

/// The same for a sentence, which stays in one line.
pub fn printable_line(text: &str) -> Cow<'_, str> {
    escaped(text, |c| c == '\t')
}

fn escaped(text: &str, is_harmless: impl Fn(char) -> bool) -> Cow<'_, str> {
    let is_bad = |c: char| steers(c) && !is_harmless(c);
    if !text.contains(is_bad) {
        return text.into();
    }
    let mut out = String::with_capacity(text.len() + 16);
    for c in text.chars() {
        if is_bad(c) {
            // Writing to a string does not fail.
            let _ = match c {
                '\n' => write!(out, "\\n"),
                '\r' => write!(out, "\\r"),
                c => write!(out, "{}", c.escape_unicode()),
            };
        } else {
            out.push(c);
        }
    }
    out.into()
}

/// Whether a character moves, colours or reorders what is written.
fn steers(c: char) -> bool {
    // The last are marks that change the direction of writing, and separators of lines.
    c.is_control()
        || matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_left_that_a_terminal_acts_on() {
        assert_eq!(printable_line("−B ± √Δ"), "−B ± √Δ");
        let hostile = "\u{1b}]0;x\u{7}\u{9b}31m\u{7f}\r\u{202e}a\nb\tc";
        assert_eq!(
            printable_line(hostile),
            "\\u{1b}]0;x\\u{7}\\u{9b}31m\\u{7f}\\r\\u{202e}a\\nb\tc"
        );
        assert!(printable(hostile).ends_with("\\u{202e}a\nb\tc"));
        for c in (0..=0x2_ffff).filter_map(char::from_u32) {
            let shown = printable_line(c.encode_utf8(&mut [0; 4])).into_owned();
            assert!(
                !shown.contains(|c: char| c.is_control() && c != '\t'),
                "{c:?}"
            );
        }
    }
}
