//! One value of a scene: which numbers, colours and lines of text may stand where, and the sentence
//! for those that may not.
//!
//! Scene files and the fields that a person fills in by hand are read by the same rules.

use std::borrow::Cow;
use std::fmt;

use glam::Vec3;

use super::Rgb;
use crate::geometry::Decimal;
use crate::text::read;

/// What was found in place of a value, and what was expected there.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Refused {
    /// What was found, short enough for one line.
    pub found: String,
    /// What would have been right, as a noun phrase.
    pub expected: Cow<'static, str>,
}

impl Refused {
    /// A refusal of `found` where `expected` should have been.
    pub fn new(found: impl Into<String>, expected: impl Into<Cow<'static, str>>) -> Self {
        Self {
            found: found.into(),
            expected: expected.into(),
        }
    }
}

impl fmt::Display for Refused {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "found {}, expected {}", self.found, self.expected)
    }
}

impl std::error::Error for Refused {}

/// What a number stands for, and so which numbers it may be.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum NumberKind {
    /// A coordinate of a point or a direction: any finite number.
    Coordinate,
    /// The radius of a sphere: zero or more.
    Radius,
    /// A width or height that an orthographic camera sees: above zero.
    Extent,
    /// What the places of pixels are multiples of: a power of two.
    Step,
    /// The vertical angle that a perspective camera sees, in degrees.
    FieldOfView,
}

impl NumberKind {
    /// Reads a number in decimal or in hexadecimal, rounded once to binary32.
    pub fn read(self, text: &str) -> Result<f32, Refused> {
        let text = text.trim();
        let value =
            read::binary32(text).ok_or_else(|| Refused::new(quoted(text), self.expected()))?;
        let has_digits = text.contains(|c: char| c.is_ascii_digit());
        if value.is_infinite() && has_digits {
            return Err(Refused::new(shortened(text), WITHIN_RANGE));
        }
        self.check(value)
            .map_err(|refused| Refused::new(shortened(text), refused.expected))
    }

    /// The same rule for a number that is already in binary32.
    pub fn check(self, value: f32) -> Result<f32, Refused> {
        let allowed = match self {
            Self::Coordinate => true,
            Self::Radius => value >= 0.0,
            Self::Extent => value > 0.0,
            Self::Step => is_power_of_two(value),
            Self::FieldOfView => value > 0.0 && value < 180.0,
        };
        if allowed && value.is_finite() {
            Ok(value)
        } else {
            Err(Refused::new(Decimal(value).to_string(), self.expected()))
        }
    }

    /// The numbers allowed, as a noun phrase.
    pub const fn expected(self) -> &'static str {
        match self {
            Self::Coordinate => "a finite number",
            Self::Radius => "a finite number of zero or more",
            Self::Extent => "a finite number above 0",
            Self::Step => "a power of two, such as 1, 2 or 0.5",
            Self::FieldOfView => "an angle in degrees above 0 and below 180",
        }
    }
}

/// Whether `x` is 2^k for a whole number k.
fn is_power_of_two(x: f32) -> bool {
    x > 0.0 && x.is_finite() && f64::from(x).to_bits().trailing_zeros() >= 52
}

/// What is expected of a number that rounds to an infinity.
pub(super) const WITHIN_RANGE: &str =
    "a number that binary32 can hold, at most 3.4028235e38 in size";

/// Reads three coordinates, parted by commas or blanks, with or without square brackets.
pub fn vector(text: &str) -> Result<Vec3, Refused> {
    const EXPECTED: &str = "three finite numbers, x, y, z";
    let text = text.trim();
    let inner = text
        .strip_prefix('[')
        .and_then(|rest| rest.strip_suffix(']'))
        .unwrap_or(text);
    let parts: Vec<&str> = if inner.contains(',') {
        inner.split(',').collect()
    } else {
        inner.split_whitespace().collect()
    };
    let [x, y, z] = parts[..] else {
        return Err(Refused::new(quoted(text), EXPECTED));
    };
    let [x, y, z] = [x, y, z].map(|part| NumberKind::Coordinate.read(part));
    Ok(Vec3::new(x?, y?, z?))
}

/// Reads a colour as `#rrggbb`.
pub fn color(text: &str) -> Result<Rgb, Refused> {
    let text = text.trim();
    let refused = || {
        Refused::new(
            quoted(text),
            "a colour as \"#rrggbb\", two hexadecimal digits each for red, green and blue",
        )
    };
    let digits = text.strip_prefix('#').ok_or_else(refused)?;
    if digits.len() != 6 || !digits.bytes().all(|b| b.is_ascii_hexdigit()) {
        return Err(refused());
    }
    let [_, r, g, b] = u32::from_str_radix(digits, 16)
        .map_err(|_| refused())?
        .to_be_bytes();
    Ok(Rgb(r, g, b))
}

/// Reads a name, a title or a sentence: one line, without control characters, which could
/// reprogram the terminal that shows it.
pub fn line(text: &str) -> Result<&str, Refused> {
    match text.chars().find(|c| c.is_control()) {
        None => Ok(text),
        Some('\n' | '\r') => Err(Refused::new("a line break", "text in one line")),
        Some(c) => Err(control(c)),
    }
}

/// Reads text of several lines, by the same rule for each.
pub fn prose(text: &str) -> Result<&str, Refused> {
    match text.chars().find(|&c| c.is_control() && !c.is_whitespace()) {
        None => Ok(text),
        Some(c) => Err(control(c)),
    }
}

fn control(c: char) -> Refused {
    Refused::new(
        format!("the control character U+{:04X}", u32::from(c)),
        "text without control characters",
    )
}

/// Text in quotation marks, shortened, with nothing in it that a terminal would act on.
pub(super) fn quoted(text: &str) -> String {
    format!("{:?}", shortened(text))
}

/// At most the first 40 characters of a text.
pub(super) fn shortened(text: &str) -> String {
    const MOST: usize = 40;
    match text.char_indices().nth(MOST) {
        None => text.to_owned(),
        Some((end, _)) => format!("{}…", &text[..end]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_decimal_is_rounded_once() {
        // Just above the middle of two neighbours; rounded to binary64 it is the middle, and that
        // goes to the even neighbour below.
        let text = "1.00000005960464477540";
        assert_eq!(NumberKind::Coordinate.read(text), Ok(1.0 + f32::EPSILON));
        assert_eq!(text.parse::<f64>().unwrap() as f32, 1.0);
    }

    #[test]
    fn numbers_are_read_as_people_type_them() {
        for (text, value) in [
            (" 3 ", 3.0),
            ("−2.5", -2.5),
            (".5", 0.5),
            ("1e-3", 0.001),
            ("0x1.8p3", 12.0),
        ] {
            assert_eq!(NumberKind::Coordinate.read(text), Ok(value), "{text}");
        }
    }

    #[test]
    fn each_kind_of_number_says_what_it_may_be() {
        use NumberKind::{Coordinate, Extent, FieldOfView, Radius};
        for (kind, text, sentence) in [
            (Coordinate, "", "found \"\", expected a finite number"),
            (Coordinate, "1,5", "found \"1,5\", expected a finite number"),
            (Coordinate, "NaN", "found NaN, expected a finite number"),
            (
                Radius,
                "-3",
                "found -3, expected a finite number of zero or more",
            ),
            (
                Radius,
                "inf",
                "found inf, expected a finite number of zero or more",
            ),
            (Extent, "0", "found 0, expected a finite number above 0"),
            (
                FieldOfView,
                "180",
                "found 180, expected an angle in degrees above 0 and below 180",
            ),
            (
                Radius,
                "0x1p200",
                "found 0x1p200, expected a number that binary32 can hold, at most 3.4028235e38 in size",
            ),
            (
                Coordinate,
                "0x1.8q3",
                "found \"0x1.8q3\", expected a finite number",
            ),
            (
                Radius,
                "1e39",
                "found 1e39, expected a number that binary32 can hold, at most 3.4028235e38 in size",
            ),
        ] {
            assert_eq!(kind.read(text).unwrap_err().to_string(), sentence);
        }
    }

    #[test]
    fn a_vector_is_three_numbers_in_any_of_the_usual_spellings() {
        for text in ["1, -2, 0.5", "[1, -2, 0.5]", "1 −2  .5"] {
            assert_eq!(vector(text), Ok(Vec3::new(1.0, -2.0, 0.5)), "{text}");
        }
        assert_eq!(
            vector("1, 2").unwrap_err().to_string(),
            "found \"1, 2\", expected three finite numbers, x, y, z"
        );
        assert_eq!(
            vector("1, nan, 2").unwrap_err().to_string(),
            "found nan, expected a finite number"
        );
    }

    #[test]
    fn a_colour_is_six_hexadecimal_digits() {
        assert_eq!(color("#E69f00"), Ok(Rgb(0xe6, 0x9f, 0)));
        for text in [
            "e69f00",
            "#e69f0",
            "#e69f00ff",
            "#e69f0g",
            "#+69f00",
            "#é9f0",
        ] {
            assert!(color(text).is_err(), "{text}");
        }
    }

    #[test]
    fn prose_has_line_breaks_and_nothing_else_that_a_terminal_acts_on() {
        assert_eq!(prose("one\r\n\ttwo\n"), Ok("one\r\n\ttwo\n"));
        assert!(prose("a\u{9b}31m").is_err() && prose("\u{1b}[5n").is_err());
    }

    #[test]
    fn a_line_has_nothing_that_a_terminal_acts_on() {
        assert_eq!(line("−B ± √Δ"), Ok("−B ± √Δ"));
        assert_eq!(
            line("\u{1b}[2J").unwrap_err().to_string(),
            "found the control character U+001B, expected text without control characters"
        );
    }
}
