//! The bits of a floating-point number, and how they compare with those of another.
//!
//! ```text
//! C = 300
//!       s exponent fraction
//! C     0 10000111 00101100000000000000000
//! exact 0 10000111 00101100000000000000011
//!                                       ^
//! ```

use std::cmp::Ordering;

use super::caption::{Caption, rounded};
use crate::explain::{Digits, Line, Role, number};
use crate::method::Precision;
use crate::text::{self, Glyphs};

/// A number in one of the two formats.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Float {
    /// binary32: 1 + 8 + 23 bits.
    Single(f32),
    /// binary64: 1 + 11 + 52 bits.
    Double(f64),
}

/// The fields of a number as it is stored.
#[derive(Debug, Clone, Copy)]
struct Fields {
    format: &'static str,
    exponent_bits: u32,
    fraction_bits: u32,
    bits: u64,
}

impl Float {
    /// The same number as a binary64.
    pub fn widened(self) -> f64 {
        match self {
            Self::Single(x) => x.into(),
            Self::Double(x) => x,
        }
    }

    fn fields(self) -> Fields {
        match self {
            Self::Single(x) => Fields {
                format: "binary32",
                exponent_bits: 8,
                fraction_bits: 23,
                bits: x.to_bits().into(),
            },
            Self::Double(x) => Fields {
                format: "binary64",
                exponent_bits: 11,
                fraction_bits: 52,
                bits: x.to_bits(),
            },
        }
    }

    /// Hexadecimal notation, in which no bit is rounded: `0x1.2cp8` is (1 + 0x2c/256)·2⁸.
    fn hexadecimal(self) -> String {
        if !self.widened().is_finite() {
            return self.decimal(true);
        }
        let written = match self {
            Self::Single(x) => text::hexadecimal(x),
            Self::Double(x) => text::hexadecimal_binary64(x),
        };
        written.replace("p+", "p")
    }

    /// The shortest decimal that tells the number from all others of its format, or of binary64.
    fn decimal(self, widened: bool) -> String {
        let precision = match self {
            Self::Single(_) if !widened => Precision::Binary32,
            _ => Precision::Binary64,
        };
        if self.widened() == 0.0 && self.fields().negative() {
            return "−0".into();
        }
        number(self.widened(), precision, Digits::Full)
    }
}

impl Fields {
    fn negative(self) -> bool {
        self.bits >> (self.exponent_bits + self.fraction_bits) == 1
    }

    fn exponent(self) -> u64 {
        (self.bits >> self.fraction_bits) & ((1 << self.exponent_bits) - 1)
    }

    fn fraction(self) -> u64 {
        self.bits & ((1 << self.fraction_bits) - 1)
    }

    fn bias(self) -> i64 {
        (1 << (self.exponent_bits - 1)) - 1
    }

    fn is_subnormal(self) -> bool {
        self.exponent() == 0
    }

    /// Infinities and NaN have an exponent of ones.
    fn is_finite(self) -> bool {
        self.exponent() != (1 << self.exponent_bits) - 1
    }

    /// The exponent that is meant: the one stored less the bias; subnormals share the least.
    fn power(self) -> i64 {
        (self.exponent() as i64).max(1) - self.bias()
    }

    /// log2 of the distance to the next greater magnitude.
    fn ulp_power(self) -> i64 {
        self.power() - i64::from(self.fraction_bits)
    }

    /// The significand, from 1 to below 2; below 1 for a subnormal.
    fn significand(self) -> f64 {
        let scale = (1_u64 << self.fraction_bits) as f64;
        let lead = if self.is_subnormal() { 0.0 } else { 1.0 };
        lead + self.fraction() as f64 / scale
    }

    /// Binary places of the significand, without zeros at the end.
    fn places(self) -> u32 {
        let zeros = self.fraction().trailing_zeros().min(self.fraction_bits);
        self.fraction_bits - zeros
    }

    /// Sign, exponent and fraction in binary digits.
    fn digits(self) -> [String; 3] {
        let [e, f] = [self.exponent_bits, self.fraction_bits].map(|n| n as usize);
        [
            u8::from(self.negative()).to_string(),
            format!("{:0e$b}", self.exponent()),
            format!("{:0f$b}", self.fraction()),
        ]
    }

    /// Where the number stands among all of its format, in their order.
    fn rank(self) -> i128 {
        let magnitude = i128::from(self.bits & !(1 << (self.exponent_bits + self.fraction_bits)));
        if self.negative() {
            -magnitude
        } else {
            magnitude
        }
    }
}

/// The bits of `value` with what they mean, beside those of `other` if there is one: the first bit
/// that differs is marked. Lines of at most `width` columns.
///
/// Numbers of two formats are compared as binary64, which changes neither.
pub fn bits(label: &str, value: Float, other: Option<(&str, Float)>, width: usize) -> Vec<Line> {
    let fields = value.fields();
    let mixed = other.is_some_and(|(_, other)| other.fields().format != fields.format);
    let mut title = caption();
    title.add(label, "=", &value.decimal(mixed));
    title.say(Role::Faint, fields.format);
    title.say(Role::Faint, &value.hexadecimal());
    let mut lines = title.lines(width, usize::MAX);
    match other {
        None => lines.extend(rows(&[(label, fields)], None, width)),
        Some((name, other)) => {
            let [mine, theirs] = if mixed {
                [value, other].map(|x| Float::Double(x.widened()).fields())
            } else {
                [value, other].map(Float::fields)
            };
            let differs = first_difference(mine, theirs);
            lines.extend(rows(&[(label, mine), (name, theirs)], differs, width));
            lines.extend(
                comparison(
                    [label, name],
                    &other.decimal(mixed),
                    [mine, theirs],
                    differs,
                )
                .lines(width, usize::MAX),
            );
        }
    }
    lines.extend(meaning(fields).lines(width, usize::MAX));
    for line in &mut lines {
        line.cut(width);
    }
    lines
}

/// What is written here keeps its width in ASCII, so that it need not be known here.
fn caption() -> Caption {
    Caption::new(Glyphs::Unicode)
}

/// The first digit that differs: which field, and which place in it.
fn first_difference(mine: Fields, theirs: Fields) -> Option<(usize, usize)> {
    let (mine, theirs) = (mine.digits(), theirs.digits());
    (0..3).find_map(|field| {
        let place = mine[field]
            .chars()
            .zip(theirs[field].chars())
            .position(|(m, t)| m != t)?;
        Some((field, place))
    })
}

/// The digits in a line, or the fraction below the rest if there is no room.
fn rows(numbers: &[(&str, Fields)], differs: Option<(usize, usize)>, width: usize) -> Vec<Line> {
    let Some((_, first)) = numbers.first() else {
        return Vec::new();
    };
    let [e, f] = [first.exponent_bits, first.fraction_bits].map(|n| n as usize);
    let longest = numbers.iter().map(|(name, _)| name.chars().count() + 1);
    let margin = match longest.max() {
        Some(margin) if numbers.len() > 1 && margin + e + 2 <= width => margin,
        _ => 0,
    };
    let room = width.saturating_sub(margin).max(1);
    let whole = (0, 0..f);
    // Pieces of a line: fields from the first one on, and which digits of the fraction.
    let pieces: Vec<(usize, std::ops::Range<usize>)> = if e + f + 3 <= room {
        vec![whole]
    } else {
        let count = f.div_ceil(room);
        let length = f.div_ceil(count);
        let parts = (0..count).map(|i| (2, i * length..((i + 1) * length).min(f)));
        std::iter::once((0, 0..0)).chain(parts).collect()
    };
    let mut lines = Vec::new();
    for (field, range) in pieces {
        lines.push(heading(margin, e, field, &range));
        for (name, fields) in numbers {
            lines.push(row(name, *fields, margin, field, &range));
        }
        if let Some(column) = differs.and_then(|d| column(d, e, field, &range)) {
            let mut line = Line::new(0);
            line.append(Role::Plain, &" ".repeat(margin + column));
            line.append(Role::Warning, "^");
            lines.push(line);
        }
    }
    lines
}

/// The names of the fields, over their digits.
fn heading(margin: usize, e: usize, field: usize, range: &std::ops::Range<usize>) -> Line {
    let mut text = " ".repeat(margin);
    if field == 0 {
        let name = "exponent";
        text.push_str("s ");
        text.push_str(name);
        text.push_str(&" ".repeat(e.saturating_sub(name.len())));
        if !range.is_empty() {
            text += " fraction";
        }
    } else if range.start == 0 {
        text += "fraction";
    } else {
        text += "fraction, continued";
    }
    let mut line = Line::new(0);
    line.append(Role::Faint, text.trim_end());
    line
}

fn row(
    name: &str,
    fields: Fields,
    margin: usize,
    field: usize,
    range: &std::ops::Range<usize>,
) -> Line {
    let [sign, exponent, fraction] = fields.digits();
    let mut line = Line::new(0);
    if margin > 0 {
        line.append(Role::Label, name);
        let gap = margin.saturating_sub(line.width());
        line.append(Role::Plain, &" ".repeat(gap));
    }
    if field == 0 {
        line.append(Role::Label, &sign);
        line.append(Role::Plain, " ");
        line.append(Role::Formula, &exponent);
        line.append(Role::Plain, if range.is_empty() { "" } else { " " });
    }
    line.append(Role::Value, fraction.get(range.clone()).unwrap_or_default());
    line
}

/// The column of a digit in a piece, if it is there.
fn column(
    (at, place): (usize, usize),
    e: usize,
    field: usize,
    range: &std::ops::Range<usize>,
) -> Option<usize> {
    match (at, field) {
        (0, 0) => Some(0),
        (1, 0) => Some(2 + place),
        (2, _) if range.contains(&place) => {
            let before = if field == 0 { e + 3 } else { 0 };
            Some(before + place - range.start)
        }
        _ => None,
    }
}

fn comparison(
    [label, name]: [&str; 2],
    decimal: &str,
    [mine, theirs]: [Fields; 2],
    differs: Option<(usize, usize)>,
) -> Caption {
    let mut caption = caption();
    caption.add(name, "=", decimal);
    let significant = mine.fraction_bits + 1;
    match differs {
        None => caption.say(Role::Plain, "the same bits"),
        Some((0, _)) => caption.say(Role::Plain, "the signs differ"),
        Some((1, _)) => caption.say(Role::Plain, "the exponents differ"),
        Some((_, place)) => {
            // The bit before the point is there, though it is not stored.
            let agree = place + usize::from(!mine.is_subnormal());
            let words = format!("the first {agree} of {significant} significant bits agree");
            caption.say(Role::Plain, &words);
        }
    }
    let steps = (mine.rank() - theirs.rank()).unsigned_abs();
    if steps > 0 && mine.is_finite() && theirs.is_finite() {
        let about = if steps > 9999 { "about " } else { "" };
        let count = rounded(steps as f64, 4);
        let plural = if steps == 1 { "" } else { "s" };
        let side = match mine.rank().cmp(&theirs.rank()) {
            Ordering::Greater => "above",
            _ => "below",
        };
        let format = mine.format;
        let words = format!("{label} is {about}{count} step{plural} of {format} {side} {name}");
        caption.say(Role::Plain, &words);
    }
    caption
}

/// What the fields stand for.
fn meaning(fields: Fields) -> Caption {
    let mut caption = caption();
    let sign = if fields.negative() { "−" } else { "+" };
    let (stored, bias, power) = (fields.exponent(), fields.bias(), fields.power());
    if !fields.is_finite() {
        let (rest, what) = if fields.fraction() == 0 {
            ("fraction 0", "infinity")
        } else {
            ("fraction not 0", "not a number")
        };
        caption.say(Role::Plain, &format!("exponent all ones, {rest}: {what}"));
        return caption;
    }
    if fields.exponent() == 0 && fields.fraction() == 0 {
        let words = format!("all bits but the sign are 0: zero, with the sign {sign}");
        caption.say(Role::Plain, &words);
    } else if fields.is_subnormal() {
        let count = fields.fraction();
        let unit = fields.ulp_power();
        caption.say(
            Role::Plain,
            "exponent 0: a subnormal, without a 1 before the point",
        );
        caption.add("value", "=", &signed(&format!("{sign}{count} · 2^{unit}")));
    } else {
        let significand = rounded(fields.significand(), 9);
        // k binary places are k decimal ones.
        let equals = if fields.places() <= 8 { "=" } else { "≈" };
        let product = format!("{sign}{significand} · 2^{power}");
        caption.add("value", equals, &signed(&product));
        let words = format!("{stored} − bias {bias} = {power}");
        caption.add("exponent:", "", &signed(&words));
        let words = format!("{significand}, its leading 1 is not stored");
        caption.add("significand:", "", &words);
    }
    let ulp = fields.ulp_power();
    let distance = rounded(2.0_f64.powi(ulp as i32), 4);
    let words = format!("2^{ulp} ≈ {distance} to the next number");
    caption.add("ulp:", "", &signed(&words));
    caption
}

/// Hyphens as the minus signs that they are.
fn signed(text: &str) -> String {
    text.replace('-', "−")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::explain::plain_text;
    use proptest::prelude::*;

    fn text(value: Float, other: Option<Float>, width: usize) -> String {
        let other = other.map(|other| ("exact", other));
        plain_text(&bits("C", value, other, width))
    }

    #[test]
    fn hexadecimal_rounds_nothing() {
        let cases = [
            (Float::Single(300.0), "0x1.2cp8"),
            (Float::Single(-0.1), "-0x1.99999ap-4"),
            (Float::Single(f32::from_bits(1)), "0x0.000002p-126"),
            (Float::Single(f32::MAX), "0x1.fffffep127"),
            (Float::Double(0.1), "0x1.999999999999ap-4"),
            (Float::Double(f64::from_bits(1)), "0x0.0000000000001p-1022"),
            (Float::Double(-0.0), "-0x0p0"),
        ];
        for (value, written) in cases {
            assert_eq!(value.hexadecimal(), written);
        }
    }

    #[test]
    fn a_number_alone() {
        insta::assert_snapshot!(text(Float::Single(300.0), None, 58), @r#"
        C = 300   binary32   0x1.2cp8
        s exponent fraction
        0 10000111 00101100000000000000000
        value = +1.171875 · 2^8   exponent: 135 − bias 127 = 8
        significand: 1.171875, its leading 1 is not stored
        ulp: 2^−15 ≈ 3.052e−5 to the next number
        "#);
        insta::assert_snapshot!(text(Float::Double(0.1), None, 36), @r#"
        C = 0.1   binary64
        0x1.999999999999ap-4
        s exponent
        0 01111111011
        fraction
        10011001100110011001100110
        fraction, continued
        01100110011001100110011010
        value ≈ +1.6 · 2^−4
        exponent: 1019 − bias 1023 = −4
        significand: 1.6, its leading 1 is
        not stored
        ulp: 2^−56 ≈ 1.388e−17 to the next
        number
        "#);
        insta::assert_snapshot!(text(Float::Single(1e-45), None, 58), @r#"
        C = 1e−45   binary32   0x0.000002p-126
        s exponent fraction
        0 00000000 00000000000000000000001
        exponent 0: a subnormal, without a 1 before the point
        value = +1 · 2^−149
        ulp: 2^−149 ≈ 1.401e−45 to the next number
        "#);
        insta::assert_snapshot!(text(Float::Single(f32::NEG_INFINITY), None, 58), @r#"
        C = −∞   binary32   −∞
        s exponent fraction
        1 11111111 00000000000000000000000
        exponent all ones, fraction 0: infinity
        "#);
    }

    #[test]
    fn two_numbers() {
        let pair = |value: f32, other: f32, width| {
            text(Float::Single(value), Some(Float::Single(other)), width)
        };
        insta::assert_snapshot!(pair(4099.1357, 4099.134, 58), @r#"
        C = 4099.1357   binary32   0x1.00322cp12
              s exponent fraction
        C     0 10001011 00000000001100100010110
        exact 0 10001011 00000000001100100010010
                                             ^
        exact = 4099.134
        the first 21 of 24 significant bits agree
        C is 4 steps of binary32 above exact
        value ≈ +1.00076556 · 2^12   exponent: 139 − bias 127 = 12
        significand: 1.00076556, its leading 1 is not stored
        ulp: 2^−11 ≈ 0.0004883 to the next number
        "#);
        insta::assert_snapshot!(pair(0.999_999_94, 1.0, 36), @r#"
        C = 0.99999994   binary32
        0x1.fffffep-1
              s exponent
        C     0 01111110
        exact 0 01111111
                       ^
              fraction
        C     11111111111111111111111
        exact 00000000000000000000000
        exact = 1   the exponents differ
        C is 1 step of binary32 below exact
        value ≈ +1.99999988 · 2^−1
        exponent: 126 − bias 127 = −1
        significand: 1.99999988, its leading
        1 is not stored
        ulp: 2^−24 ≈ 5.96e−8 to the next
        number
        "#);
        insta::assert_snapshot!(pair(3.0, 3.0, 58), @r#"
        C = 3   binary32   0x1.8p1
              s exponent fraction
        C     0 10000000 10000000000000000000000
        exact 0 10000000 10000000000000000000000
        exact = 3   the same bits
        value = +1.5 · 2^1   exponent: 128 − bias 127 = 1
        significand: 1.5, its leading 1 is not stored
        ulp: 2^−22 ≈ 2.384e−7 to the next number
        "#);
        let wide = Some(Float::Double(0.1));
        insta::assert_snapshot!(text(Float::Single(0.1), wide, 58), @r#"
        C = 0.10000000149011612   binary32   0x1.99999ap-4
              s exponent
        C     0 01111111011
        exact 0 01111111011
              fraction
        C     1001100110011001100110100000000000000000000000000000
        exact 1001100110011001100110011001100110011001100110011010
                                    ^
        exact = 0.1   the first 23 of 53 significant bits agree
        C is about 107400000 steps of binary64 above exact
        value ≈ +1.60000002 · 2^−4   exponent: 123 − bias 127 = −4
        significand: 1.60000002, its leading 1 is not stored
        ulp: 2^−27 ≈ 7.451e−9 to the next number
        "#);
    }

    fn any_float() -> impl Strategy<Value = Float> {
        prop_oneof![
            any::<u32>().prop_map(|bits| Float::Single(f32::from_bits(bits))),
            any::<u64>().prop_map(|bits| Float::Double(f64::from_bits(bits))),
        ]
    }

    proptest! {
        #[test]
        fn lines_keep_within_any_width(
            value in any_float(),
            other in prop::option::of(any_float()),
            width in 0_usize..120,
        ) {
            let other = other.map(|other| ("exact", other));
            for line in bits("C", value, other, width) {
                prop_assert!(line.width() <= width);
            }
        }

        #[test]
        fn the_caret_stands_under_the_first_bit_that_differs(
            value in any::<u32>(),
            flip in 0_u32..32,
            width in 34_usize..120,
        ) {
            let other = Float::Single(f32::from_bits(value ^ 1 << flip));
            let text = text(Float::Single(f32::from_bits(value)), Some(other), width);
            let lines: Vec<&str> = text.lines().collect();
            let (i, caret) = lines
                .iter()
                .enumerate()
                .find(|(_, line)| line.trim() == "^")
                .expect("two numbers that differ");
            let digit = |line: &str| line.as_bytes().get(caret.len() - 1).copied();
            let (mine, theirs) = (lines[i - 2], lines[i - 1]);
            prop_assert_ne!(digit(mine), digit(theirs));
            let after = |line: &str| line[caret.len()..].to_owned();
            prop_assert_eq!(after(mine), after(theirs));
            let sum: usize = [mine, theirs].map(|l| l.matches('1').count()).iter().sum();
            prop_assert_eq!(sum % 2, 1);
        }
    }
}
