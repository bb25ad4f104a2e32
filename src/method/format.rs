//! Numbers for people and for files: the shortest decimal that reads back as the same number, and
//! exact values to as many digits as there is room for.

use std::fmt;

use super::Precision;
use super::surd::{DecimalDigits, Surd};
use crate::text::Glyphs;

/// A number as the shortest decimal that reads back as the same number of its precision.
///
/// `inf` or `∞` past the range, `NaN` for what is no number. Numbers from 10⁻⁴ to below 10⁹, and
/// whole numbers without zeros at the end, are written out; others have an exponent.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shortest {
    /// The number; of precision binary32 it must be one.
    pub value: f64,
    /// Of which numbers it is one.
    pub precision: Precision,
    /// In which characters; in Unicode a zero has no sign, in ASCII it reads back as the zero it is.
    pub glyphs: Glyphs,
}

/// The shortest decimal for a binary32.
pub fn binary32(value: f32, glyphs: Glyphs) -> Shortest {
    Shortest {
        value: value.into(),
        precision: Precision::Binary32,
        glyphs,
    }
}

/// The shortest decimal for a binary64.
pub fn binary64(value: f64, glyphs: Glyphs) -> Shortest {
    Shortest {
        value,
        precision: Precision::Binary64,
        glyphs,
    }
}

impl Shortest {
    /// The same number to at most `count` significant digits, the last one rounded: for where there
    /// is no room for all of them.
    pub fn rounded(self, count: usize) -> String {
        if !self.value.is_finite() || self.digits().text().len() <= count {
            return self.to_string();
        }
        let digits = Scientific::of(format_args!("{:.*e}", count.max(1) - 1, self.value));
        digits.layout(self.glyphs).text()
    }

    fn write(self, out: &mut impl fmt::Write) -> fmt::Result {
        if self.value.is_finite() {
            self.digits().layout(self.glyphs).write(out)
        } else if self.value.is_nan() {
            out.write_str("NaN")
        } else {
            let minus = if self.value < 0.0 {
                self.glyphs.minus()
            } else {
                ""
            };
            write!(out, "{minus}{}", self.glyphs.infinity())
        }
    }

    fn digits(self) -> Scientific {
        match self.precision {
            Precision::Binary32 => Scientific::of(format_args!("{:e}", self.value as f32)),
            Precision::Binary64 => Scientific::of(format_args!("{:e}", self.value)),
        }
    }
}

impl fmt::Display for Shortest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if f.width().is_none() {
            return self.write(f);
        }
        let mut text = String::new();
        self.write(&mut text)?;
        f.pad(&text)
    }
}

/// An exact value in decimal, to at most `count` digits: all of it, or the first of its digits
/// and an ellipsis.
pub fn exact(value: &Surd, count: usize, glyphs: Glyphs) -> String {
    let DecimalDigits {
        negative,
        digits,
        exponent,
        exact,
    } = value.digits(count.max(1));
    let layout = DecimalLayout {
        negative,
        digits: &digits,
        exponent,
        exact,
        glyphs,
    };
    layout.text()
}

/// The digits and the exponent of a finite number, read off Rust's `-d.ddde-x` and kept without
/// allocating: a table of a million rows passes here.
struct Scientific {
    digits: [u8; Self::CAPACITY],
    count: usize,
    negative: bool,
    exponent: i64,
    in_exponent: bool,
    exponent_negative: bool,
}

impl Scientific {
    /// Enough for the 17 digits of a binary64, and for as many as are worth asking for.
    const CAPACITY: usize = 40;

    fn of(number: fmt::Arguments<'_>) -> Self {
        let mut read = Self {
            digits: [0; Self::CAPACITY],
            count: 0,
            negative: false,
            exponent: 0,
            in_exponent: false,
            exponent_negative: false,
        };
        // Writing to `Scientific` cannot fail.
        let _ = fmt::Write::write_fmt(&mut read, number);
        if read.exponent_negative {
            read.exponent = -read.exponent;
        }
        while read.count > 0 && read.digits[read.count - 1] == b'0' {
            read.count -= 1;
        }
        read
    }

    fn text(&self) -> &str {
        str::from_utf8(&self.digits[..self.count]).unwrap_or_default()
    }

    fn layout(&self, glyphs: Glyphs) -> DecimalLayout<'_> {
        DecimalLayout {
            negative: self.negative,
            digits: self.text(),
            exponent: self.exponent + 1,
            exact: true,
            glyphs,
        }
    }
}

impl fmt::Write for Scientific {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        for byte in text.bytes() {
            match byte {
                b'e' => self.in_exponent = true,
                b'-' if self.in_exponent => self.exponent_negative = true,
                b'-' => self.negative = true,
                b'0'..=b'9' if self.in_exponent => {
                    self.exponent = self.exponent * 10 + i64::from(byte - b'0');
                }
                b'0'..=b'9' if self.count < Self::CAPACITY => {
                    self.digits[self.count] = byte;
                    self.count += 1;
                }
                _ => {}
            }
        }
        Ok(())
    }
}

/// Digits ±0.d₁d₂d₃…·10^exponent, the decimal point yet to be placed among them.
struct DecimalLayout<'a> {
    negative: bool,
    digits: &'a str,
    exponent: i64,
    exact: bool,
    glyphs: Glyphs,
}

fn zeros(out: &mut impl fmt::Write, count: i64) -> fmt::Result {
    (0..count).try_for_each(|_| out.write_char('0'))
}

impl DecimalLayout<'_> {
    fn text(&self) -> String {
        let mut text = String::new();
        // Writing to a `String` cannot fail.
        let _ = self.write(&mut text);
        text
    }

    fn write(&self, f: &mut impl fmt::Write) -> fmt::Result {
        let Self {
            negative,
            digits,
            exponent: point,
            exact,
            glyphs,
        } = *self;
        let more = if exact { "" } else { glyphs.ellipsis() };
        // In print a zero has no sign; in a file it reads back as the zero it was.
        if negative && !(digits.is_empty() && glyphs == Glyphs::Unicode) {
            f.write_str(glyphs.minus())?;
        }
        if digits.is_empty() {
            return f.write_str("0");
        }
        let count = digits.len() as i64;
        // Written out, zeros up to the point would pass for known digits if some were cut off.
        let widest = if exact { count.max(9) } else { count };
        if (-3..=0).contains(&point) {
            f.write_str("0.")?;
            zeros(f, -point)?;
            write!(f, "{digits}{more}")
        } else if (1..=widest).contains(&point) {
            let (whole, fraction) = digits.split_at(point.min(count) as usize);
            f.write_str(whole)?;
            zeros(f, point - count)?;
            if !fraction.is_empty() || !exact {
                f.write_str(".")?;
            }
            write!(f, "{fraction}{more}")
        } else {
            let (first, rest) = digits.split_at(1);
            let dot = if rest.is_empty() { "" } else { "." };
            let minus = if point < 1 { glyphs.minus() } else { "" };
            write!(f, "{first}{dot}{rest}{more}e{minus}{}", (point - 1).abs())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn ascii(x: f32) -> String {
        binary32(x, Glyphs::Ascii).to_string()
    }

    #[test]
    fn writes_plain_numbers_plainly() {
        let written = [
            (0.0, "0"),
            (-0.0, "-0"),
            (1.0, "1"),
            (-40.0, "-40"),
            (0.1, "0.1"),
            (0.0001, "0.0001"),
            (0.000_012, "1.2e-5"),
            (1.1, "1.1"),
            (16_777_216.0, "16777216"),
            (1e8, "100000000"),
            (1e9, "1e9"),
            (-3.402_823_5e38, "-3.4028235e38"),
            (f32::from_bits(1), "1e-45"),
            (f32::INFINITY, "inf"),
            (f32::NEG_INFINITY, "-inf"),
            (f32::NAN, "NaN"),
        ];
        for (x, text) in written {
            assert_eq!(ascii(x), text);
        }
        let print = |x| binary32(x, Glyphs::Unicode).to_string();
        assert_eq!(print(-40.0), "−40");
        assert_eq!(print(-0.0), "0");
        assert_eq!(print(-1.5e-7), "−1.5e−7");
        assert_eq!(print(f32::NEG_INFINITY), "−∞");
        assert_eq!(format!("{:>4}", binary32(7.0, Glyphs::Ascii)), "   7");
    }

    #[test]
    fn a_whole_number_keeps_all_its_digits() {
        let big = binary64(281_474_976_710_657.0, Glyphs::Ascii);
        assert_eq!(big.to_string(), "281474976710657");
    }

    #[test]
    fn rounds_where_room_is_short() {
        let third = binary32(1.0 / 3.0, Glyphs::Ascii);
        assert_eq!(third.rounded(3), "0.333");
        assert_eq!(binary32(9.996, Glyphs::Ascii).rounded(3), "10");
        assert_eq!(binary32(-40.0, Glyphs::Unicode).rounded(3), "−40");
        assert_eq!(binary32(1_234_567.0, Glyphs::Ascii).rounded(3), "1230000");
        assert_eq!(binary32(f32::NAN, Glyphs::Ascii).rounded(3), "NaN");
    }

    #[test]
    fn shows_exact_values_to_the_digits_there_is_room_for() {
        let tenth = Surd::from_f64(0.1_f32.into()).unwrap();
        assert_eq!(exact(&tenth, 13, Glyphs::Unicode), "0.1000000014901…");
        assert_eq!(exact(&tenth, 13, Glyphs::Ascii), "0.1000000014901...");
        assert_eq!(
            exact(&tenth, 40, Glyphs::Ascii),
            "0.100000001490116119384765625"
        );
        let odd = Surd::from_f64(-16_777_217.0).unwrap();
        assert_eq!(exact(&odd, 20, Glyphs::Unicode), "−16777217");
        assert_eq!(exact(&odd, 3, Glyphs::Unicode), "−1.67…e7");
        assert_eq!(
            exact(&Surd::from_f64(12.5).unwrap(), 2, Glyphs::Unicode),
            "12.…"
        );
    }

    proptest! {
        #[test]
        fn reads_back_as_the_same_number(bits in any::<u32>(), wide in any::<u64>()) {
            let x = f32::from_bits(bits);
            let back: f32 = ascii(x).parse().unwrap();
            prop_assert!(back.to_bits() == x.to_bits() || x.is_nan() && back.is_nan());
            let y = f64::from_bits(wide);
            let back: f64 = binary64(y, Glyphs::Ascii).to_string().parse().unwrap();
            prop_assert!(back.to_bits() == y.to_bits() || y.is_nan() && back.is_nan());
        }
    }
}
