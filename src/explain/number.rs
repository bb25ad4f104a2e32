//! Numbers for people: as many digits as there is room and reason for, never a wrong one.

use glam::Vec3;

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
                '↗' | '↙' => out.push('/'),
                '↖' | '↘' => out.push('\\'),
                '∞' => out.push_str("inf"),
                'A'..='Z' | 'a'..='z' => out.push(c),
                c if c.is_ascii() => out.push(c),
                _ => out.push('?'),
            }
        }
        out
    }
}

/// A binary32 or binary64 number: fixed notation where that is short, else with an exponent.
///
/// `single` tells that the value is a binary32, so that [`Digits::Full`] shows the shortest decimal
/// that reads back as the same binary32.
pub fn number(value: f64, single: bool, digits: Digits) -> String {
    if value.is_nan() {
        return "NaN".into();
    }
    let magnitude = value.abs();
    let sign = if value < 0.0 { "−" } else { "" };
    if magnitude.is_infinite() {
        return format!("{sign}∞");
    }
    if magnitude == 0.0 {
        return "0".into();
    }
    let shortest = if single {
        format!("{:e}", magnitude as f32)
    } else {
        format!("{magnitude:e}")
    };
    let scientific = match digits {
        Digits::Full => shortest,
        Digits::Significant(n) => {
            let n = n.max(1);
            let rounded = format!("{magnitude:.*e}", n - 1);
            // Rounding never shows more digits than the number needs.
            if shortest.len() <= rounded.len() {
                shortest
            } else {
                rounded
            }
        }
    };
    format!("{sign}{}", positional(&scientific))
}

/// `d.ddde±x` as fixed notation if its exponent is moderate, without idle zeros.
fn positional(scientific: &str) -> String {
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((scientific, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    let digits: String = mantissa.chars().filter(char::is_ascii_digit).collect();
    let digits = digits.trim_end_matches('0');
    let digits = if digits.is_empty() { "0" } else { digits };
    let count = digits.len() as i32;
    match exponent {
        0..=9 if count <= exponent + 1 => {
            let zeros = (exponent + 1 - count) as usize;
            format!("{digits}{}", "0".repeat(zeros))
        }
        0..=9 => {
            let (whole, rest) = digits.split_at(exponent as usize + 1);
            format!("{whole}.{rest}")
        }
        -4..=-1 => format!("0.{}{digits}", "0".repeat((-exponent - 1) as usize)),
        _ => {
            let (first, rest) = digits.split_at(1);
            let point = if rest.is_empty() { "" } else { "." };
            let sign = if exponent < 0 { "−" } else { "" };
            format!("{first}{point}{rest}e{sign}{}", exponent.abs())
        }
    }
}

/// Three binary32 numbers, with commas between.
pub fn vector(v: Vec3, digits: Digits) -> String {
    v.to_array()
        .map(|x| number(x.into(), true, digits))
        .join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_right() {
        let show = |x: f64, n| number(x, true, Digits::Significant(n));
        assert_eq!(show(-40.0, 6), "−40");
        assert_eq!(show(300.0, 2), "300");
        assert_eq!(show(0.1f32.into(), 6), "0.1");
        assert_eq!(show(1.0 / 3.0, 4), "0.3333");
        assert_eq!(show(6_371_000.0, 6), "6371000");
        assert_eq!(show(4.058_964_2e13, 4), "4.059e13");
        assert_eq!(show(1e-45, 4), "1e−45");
        assert_eq!(show(999_999.94, 3), "1000000");
        assert_eq!(number(f64::NEG_INFINITY, true, Digits::Full), "−∞");
        assert_eq!(number(0.1f32.into(), true, Digits::Full), "0.1");
        assert_eq!(
            number(0.1f32.into(), false, Digits::Full),
            "0.10000000149011612"
        );
        assert_eq!(number(16_777_216.0, true, Digits::Full), "16777216");
    }

    #[test]
    fn ascii_has_nothing_above_127() {
        let text = "Δ = B² − 4AC, √Δ ± ∞ “θ” ▾ → ü";
        assert!(Glyphs::Ascii.spell(text).is_ascii());
        assert_eq!(Glyphs::Ascii.spell("B² − 4AC"), "B^2 - 4AC");
    }
}
