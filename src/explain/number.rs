//! Numbers for people: as many digits as there is room and reason for, never a wrong one.

use glam::Vec3;

use crate::method::Precision;
use crate::method::format::{Shortest, Signs};

/// How many digits a number is shown with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Digits {
    /// At most this many significant digits.
    Significant(usize),
    /// As many as tell the number from its neighbours.
    Full,
}

/// Which characters may be written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Glyphs {
    /// − · ² √ Δ θ and the like.
    #[default]
    Unicode,
    /// Nothing above 127.
    Ascii,
}

impl Glyphs {
    /// What they are, in a few words.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Unicode => "Unicode",
            Self::Ascii => "ASCII",
        }
    }

    /// Text that was written for Unicode, in the characters that are allowed.
    pub fn spell(self, text: &str) -> String {
        if self == Self::Unicode {
            return text.to_owned();
        }
        let mut out = String::with_capacity(text.len());
        for c in text.chars() {
            match c {
                '−' | '–' | '—' => out.push('-'),
                '·' | '×' => out.push('*'),
                '²' => out.push_str("^2"),
                '√' => out.push_str("sqrt "),
                'Δ' => out.push_str("disc"),
                'θ' => out.push_str("theta"),
                'κ' => out.push_str("kappa"),
                '±' => out.push_str("+-"),
                '≥' => out.push_str(">="),
                '≤' => out.push_str("<="),
                '≠' => out.push_str("!="),
                '≈' | '≃' => out.push('~'),
                '°' => out.push_str(" deg"),
                '…' => out.push_str(".."),
                '“' | '”' => out.push('"'),
                '’' | '′' => out.push('\''),
                '▸' | '▶' | '→' => out.push('>'),
                '◂' | '←' => out.push('<'),
                '▾' | '↓' => out.push('v'),
                '▴' | '↑' => out.push('^'),
                '÷' | '↗' | '↙' => out.push('/'),
                '↖' | '↘' => out.push('\\'),
                '‖' => out.push('|'),
                '½' => out.push_str("1/2"),
                '∞' => out.push_str("inf"),
                'A'..='Z' | 'a'..='z' => out.push(c),
                c if c.is_ascii() => out.push(c),
                _ => out.push('?'),
            }
        }
        out
    }
}

/// A number of that precision as people read it.
pub fn number(value: f64, precision: Precision, digits: Digits) -> String {
    let shortest = Shortest {
        value,
        precision,
        signs: Signs::Typographic,
    };
    match digits {
        Digits::Significant(count) => shortest.rounded(count),
        Digits::Full => shortest.to_string(),
    }
}

/// Three binary32 numbers, with commas between.
pub fn vector(v: Vec3, digits: Digits) -> String {
    v.to_array()
        .map(|x| number(x.into(), Precision::Binary32, digits))
        .join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_has_no_more_digits_than_asked_for() {
        let show = |x: f64, n| number(x, Precision::Binary32, Digits::Significant(n));
        assert_eq!(show(-40.0, 6), "−40");
        assert_eq!(show(0.1f32.into(), 6), "0.1");
        assert_eq!(show(1.0 / 3.0, 4), "0.3333");
        assert_eq!(show(f64::NEG_INFINITY, 4), "−∞");
        let full = |x, precision| number(x, precision, Digits::Full);
        assert_eq!(full(0.1f32.into(), Precision::Binary32), "0.1");
        assert_eq!(
            full(0.1f32.into(), Precision::Binary64),
            "0.10000000149011612"
        );
    }

    #[test]
    fn ascii_has_nothing_above_127() {
        let text = "Δ = B² − 4AC, √Δ ± ∞ “θ” ▾ → ü";
        assert!(Glyphs::Ascii.spell(text).is_ascii());
        assert_eq!(Glyphs::Ascii.spell("B² − 4AC"), "B^2 - 4AC");
    }
}
