//! Words on lines of a given width.

/// The words of `text` in lines of at most `width` characters; a longer word is cut in pieces.
pub fn wrap(text: &str, width: usize) -> Vec<String> {
    let width = width.max(1);
    let pieces = text.split_whitespace().flat_map(|word| pieces(word, width));
    let lines = fill(pieces, width, width);
    if lines.is_empty() {
        return vec![String::new()];
    }
    lines
}

/// The words of `text` on lines of 80 columns, each with its end: indented as the text is, those after
/// the first by two more. A longer word stays whole, so that it can be copied.
pub fn paragraph(text: &str) -> String {
    const COLUMNS: usize = 80;
    let first = text.len() - text.trim_start().len();
    let later = first + 2;
    let lines = fill(text.split_whitespace(), COLUMNS - first, COLUMNS - later);
    let lead = |line: &String| " ".repeat(first) + line;
    let mut out = lines.first().map_or_else(String::new, lead);
    for line in lines.iter().skip(1) {
        out = out + "\n" + &" ".repeat(later) + line;
    }
    out + "\n"
}

/// Lines of words: the first of at most `first` characters, the others of `later`, but for a longer word.
fn fill<'a>(words: impl Iterator<Item = &'a str>, first: usize, later: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    let mut room = first;
    for word in words {
        let length = word.chars().count();
        match lines.last_mut() {
            Some(line) if length < room => {
                line.push(' ');
                line.push_str(word);
                room -= length + 1;
            }
            last => {
                room = if last.is_some() { later } else { first }.saturating_sub(length);
                lines.push(word.to_owned());
            }
        }
    }
    lines
}

/// A word in pieces of `width` characters.
fn pieces(word: &str, width: usize) -> impl Iterator<Item = &str> {
    let mut rest = word;
    std::iter::from_fn(move || {
        let cut = rest
            .char_indices()
            .nth(width)
            .map_or(rest.len(), |(i, _)| i);
        let (piece, after) = rest.split_at(cut);
        rest = after;
        (!piece.is_empty()).then_some(piece)
    })
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn wrapped_lines_hold_every_word_and_no_more_than_the_width(
            text in "[a-zé ]{0,80}",
            width in 1..30_usize,
        ) {
            let lines = wrap(&text, width);
            prop_assert!(lines.iter().all(|l| l.chars().count() <= width));
            let letters = |s: &str| s.chars().filter(|c| *c != ' ').collect::<String>();
            prop_assert_eq!(letters(&lines.concat()), letters(&text));
        }
    }

    #[test]
    fn a_long_word_is_cut_and_its_rest_shares_a_line() {
        assert_eq!(wrap("a abcdefgh ij k", 5), ["a", "abcde", "fgh", "ij k"]);
        assert_eq!(wrap("abcde fgh", 3), ["abc", "de", "fgh"]);
        assert_eq!(wrap(" ", 3), [""]);
    }

    #[test]
    fn paragraphs_keep_their_indent_within_eighty_columns() {
        let text = paragraph(&format!("  {}", "words ".repeat(40)));
        assert!(text.lines().count() > 2);
        let (first, later) = text.split_once('\n').unwrap();
        assert!(first.starts_with("  w") && first.len() == 79);
        assert!(
            later
                .lines()
                .all(|line| line.len() <= 80 && line.starts_with("    w"))
        );
    }

    #[test]
    fn a_paragraph_cuts_no_word() {
        let word = "x".repeat(90);
        assert_eq!(
            paragraph(&format!("a {word} b")),
            format!("a\n  {word}\n  b\n")
        );
        assert_eq!(paragraph(""), "\n");
    }
}
