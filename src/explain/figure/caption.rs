//! The lines under a figure: what its letters stand for, in numbers.

use super::section::Section;
use crate::explain::{Digits, Line, Role, Subject, number, sign_of_shown};
use crate::method::Precision;
use crate::text::Glyphs;

/// Entries in the order of their weight, each a few words with roles.
#[derive(Debug)]
pub(super) struct Caption {
    glyphs: Glyphs,
    entries: Vec<Vec<(Role, String)>>,
}

/// Blanks between two entries on a line.
const GAP: usize = 3;

impl Caption {
    pub(super) fn new(glyphs: Glyphs) -> Self {
        Self {
            glyphs,
            entries: Vec::new(),
        }
    }

    /// Adds an entry: its letter, its words, its number.
    pub(super) fn add(&mut self, label: &str, words: &str, value: &str) {
        let parts = [
            (Role::Label, label),
            (Role::Plain, words),
            (Role::Value, value),
        ];
        self.entries.push(self.words(&parts));
    }

    /// Adds a sentence.
    pub(super) fn say(&mut self, role: Role, words: &str) {
        self.entries.push(self.words(&[(role, words)]));
    }

    fn words(&self, parts: &[(Role, &str)]) -> Vec<(Role, String)> {
        let mut words = Vec::new();
        for (role, text) in parts {
            let text = self.glyphs.spell(text);
            words.extend(text.split_whitespace().map(|word| (*role, word.to_owned())));
        }
        words
    }

    /// At most `rows` lines of at most `cols` columns; entries stay whole where that is possible.
    pub(super) fn lines(&self, cols: usize, rows: usize) -> Vec<Line> {
        let mut lines: Vec<Line> = Vec::new();
        for entry in &self.entries {
            let length = entry.iter().map(|(_, word)| width(word) + 1).sum::<usize>() - 1;
            let room = lines.last().map_or(0, |l| cols.saturating_sub(l.width()));
            let mut gap = GAP;
            if room < length + GAP {
                lines.push(Line::new(0));
                gap = 0;
            }
            for (role, word) in entry {
                let Some(line) = lines.last_mut() else {
                    continue;
                };
                if line.width() == 0 || line.width() + gap + width(word) <= cols {
                    let blanks = if line.width() == 0 { 0 } else { gap };
                    line.append(Role::Plain, &" ".repeat(blanks));
                    let kept: String = word.chars().take(cols).collect();
                    line.append(*role, &kept);
                } else {
                    let kept: String = word.chars().take(cols).collect();
                    lines.push(Line::new(0));
                    if let Some(line) = lines.last_mut() {
                        line.append(*role, &kept);
                    }
                }
                gap = 1;
            }
        }
        lines.truncate(rows);
        lines
    }
}

fn width(word: &str) -> usize {
    word.chars().count()
}

/// How many lines a caption may have under a figure of that size.
pub(super) fn caption_room(cols: usize, rows: usize) -> usize {
    match rows {
        _ if cols < 16 => 0,
        0..=4 => 0,
        5..=8 => 1,
        _ => (rows * 2 / 5).min(8),
    }
}

/// A caption that says first if the method that is shown has another answer than the figure.
pub(super) fn caption_of(section: &Section, subject: &Subject, glyphs: Glyphs) -> Caption {
    let mut caption = Caption::new(glyphs);
    let class = subject.solution.class;
    if class != section.class {
        let words = format!("this is the truth; the method says {class}");
        caption.say(Role::Warning, &words);
    }
    caption
}

/// A number with this number of digits.
pub(super) fn rounded(value: f64, digits: usize) -> String {
    // + 0 takes the sign off a zero: "−0" says nothing on a figure.
    let value = value + 0.0;
    number(value, Precision::Binary64, Digits::Significant(digits))
}

/// A number with six digits.
pub(super) fn show(value: f64) -> String {
    rounded(value, 6)
}

/// A letter and the number that is shown for it, joined as they may be.
pub(super) fn joined(letter: &str, value: f64, shown: &str) -> String {
    let sign = sign_of_shown(value, shown).text();
    format!("{letter} {sign} {shown}")
}

/// The smaller root, the foot and the larger root as `t = …`.
pub(super) fn times_joined(section: &Section) -> [String; 3] {
    let values = [section.near, section.foot, section.far].map(|s| s / section.speed + 0.0);
    let shown = times(section);
    [0, 1, 2].map(|i| joined("t", values[i], &shown[i]))
}

/// The smaller root, the foot and the larger root in t, with as many digits as tell them apart.
pub(super) fn times(section: &Section) -> [String; 3] {
    let [x, y, z] = [section.near, section.foot, section.far].map(|s| s / section.speed + 0.0);
    let written = |digits| [x, y, z].map(|v| number(v, Precision::Binary64, digits));
    let differ = |texts: &[String; 3]| {
        (x == y || texts[0] != texts[1])
            && (y == z || texts[1] != texts[2])
            && (x == z || texts[0] != texts[2])
    };
    (6..17)
        .map(|count| written(Digits::Significant(count)))
        .find(differ)
        .unwrap_or_else(|| written(Digits::Full))
}
