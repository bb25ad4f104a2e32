//! Numbers as people, programs and files write them: in decimal, or in hexadecimal as C's `%a` has
//! them. Each is rounded once, to the nearest, ties to even.

/// The binary32 nearest to the number that `text` is: a decimal such as `-1.5e3`, or hexadecimal
/// digits times a power of two such as `0x1.8p3` for 12.
///
/// A minus sign may be the mathematical one. What is past the range is an infinity; `inf` and `nan`
/// are read as what they name. None for anything else.
pub fn binary32(text: &str) -> Option<f32> {
    let (negative, digits) = parts(text);
    let magnitude = match hexadecimal(digits) {
        Some(rest) => f32::from_bits(Hexadecimal::read(rest)?.round(23, 127) as u32),
        None => unsigned(digits)?.parse().ok()?,
    };
    Some(if negative { -magnitude } else { magnitude })
}

/// The binary64 nearest to the number that `text` is, written as for [`binary32`].
pub fn binary64(text: &str) -> Option<f64> {
    let (negative, digits) = parts(text);
    let magnitude = match hexadecimal(digits) {
        Some(rest) => f64::from_bits(Hexadecimal::read(rest)?.round(52, 1023)),
        None => unsigned(digits)?.parse().ok()?,
    };
    Some(if negative { -magnitude } else { magnitude })
}

/// Whether the number is below zero, and what stands after its sign.
fn parts(text: &str) -> (bool, &str) {
    let text = text.trim();
    match text.strip_prefix(['-', '−']) {
        Some(rest) => (true, rest),
        None => (false, text.strip_prefix('+').unwrap_or(text)),
    }
}

/// Digits that have no sign left before them.
fn unsigned(digits: &str) -> Option<&str> {
    (!digits.starts_with(['+', '-'])).then_some(digits)
}

/// What hexadecimal digits say: significand·2^exponent, or a little more.
struct Hexadecimal {
    /// 64 bits at most; the last one is also set if ones that had no room were cut off.
    significand: u64,
    exponent: i64,
}

/// What stands after `0x`, if the number is hexadecimal.
fn hexadecimal(digits: &str) -> Option<&str> {
    digits
        .strip_prefix("0x")
        .or_else(|| digits.strip_prefix("0X"))
}

fn significand(whole: &str, fraction: &str) -> Option<(u64, i64)> {
    if whole.is_empty() && fraction.is_empty() {
        return None;
    }
    let (mut significand, mut exponent) = (0_u64, 0_i64);
    let places = whole.chars().map(|c| (c, 0));
    for (c, place) in places.chain(fraction.chars().map(|c| (c, -4))) {
        let digit = u64::from(c.to_digit(16)?);
        if significand >> 60 == 0 {
            significand = significand << 4 | digit;
            exponent += place;
        } else {
            significand |= u64::from(digit != 0);
            exponent += place + 4;
        }
    }
    Some((significand, exponent))
}

/// The power of two after `p`; one that no number reaches is as good as any other such.
fn power(text: &str) -> Option<i64> {
    let digits = text.strip_prefix(['+', '-']).unwrap_or(text);
    if digits.is_empty() || !digits.bytes().all(|b| b.is_ascii_digit()) {
        return None;
    }
    let magnitude = digits.parse().unwrap_or(i64::MAX / 4).min(i64::MAX / 4);
    Some(if text.starts_with('-') {
        -magnitude
    } else {
        magnitude
    })
}

impl Hexadecimal {
    /// The number that is written after `0x`.
    ///
    /// Without its power it would be a whole number, of which nobody knows whether it is meant.
    fn read(text: &str) -> Option<Self> {
        let (digits, power) = text.split_once(['p', 'P'])?;
        let (whole, fraction) = digits.split_once('.').unwrap_or((digits, ""));
        let (significand, exponent) = significand(whole, fraction)?;
        Some(Self {
            significand,
            exponent: exponent.saturating_add(self::power(power)?),
        })
    }

    /// The bits of the nearest number of a binary format with so many bits of fraction.
    fn round(&self, fraction: u32, bias: i64) -> u64 {
        if self.significand == 0 {
            return 0;
        }
        let infinity = (2 * bias as u64 + 1) << fraction;
        let leading = self
            .exponent
            .saturating_add(63 - i64::from(self.significand.leading_zeros()));
        if leading > bias {
            return infinity;
        }
        // The exponent of the last bit: that of the smallest subnormal at least.
        let least = 1 - bias - i64::from(fraction);
        let last = least.max(leading - i64::from(fraction));
        let units = in_units(self.significand, last.saturating_sub(self.exponent));
        // One more than all ones carries into the exponent, as it should, and past the largest
        // number into infinity.
        (((last - least) as u64) << fraction) + units
    }
}

/// significand·2^−shift as a whole number, to the nearest, ties to even.
fn in_units(significand: u64, shift: i64) -> u64 {
    match shift {
        ..=0 => significand << -shift,
        1..=64 => {
            let wide = u128::from(significand);
            let (kept, rest) = (wide >> shift, wide & ((1 << shift) - 1));
            let half = 1_u128 << (shift - 1);
            let up = rest > half || (rest == half && kept & 1 == 1);
            kept as u64 + u64::from(up)
        }
        _ => 0,
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn decimals_are_read_as_by_the_standard_library(x: f64) {
            prop_assert_eq!(binary64(&x.to_string()).map(f64::to_bits), Some(x.to_bits()));
            prop_assert_eq!(binary32(&format!(" {x:e} ")), format!("{x:e}").parse().ok());
        }

        #[test]
        fn no_text_is_too_odd(text in "[-+−0xX1fp.PeE in]{0,12}|.{0,8}") {
            let _ = (binary32(&text), binary64(&text));
        }
    }

    #[test]
    fn numbers_of_other_languages_are_read() {
        for (text, value) in [
            ("0x1.8p3", 12.0),
            ("0X1.8P+3", 12.0),
            ("+0x.8p0", 0.5),
            ("0x1.p0", 1.0),
            ("-0x0p0", -0.0),
            ("0x1.fffffep+127", f32::MAX),
            ("0x1.ffffffp+127", f32::INFINITY),
            ("0x1.fffffefffffffffffffffffp+127", f32::MAX),
            ("0x1p-149", f32::from_bits(1)),
            ("0x1p-150", 0.0),
            ("0x1.00000000000000000000001p-150", f32::from_bits(1)),
            ("0x1p99999999999999999999", f32::INFINITY),
            ("0x1p-99999999999999999999", 0.0),
            ("0x0p99999999999999999999", 0.0),
            ("−2.5", -2.5),
            ("1e39", f32::INFINITY),
            ("-inf", f32::NEG_INFINITY),
        ] {
            assert_eq!(
                binary32(text).map(f32::to_bits),
                Some(value.to_bits()),
                "{text}"
            );
        }
        for text in [
            "",
            "-",
            "0x",
            "0x10",
            "0x1.8",
            "0x.p1",
            "0xp3",
            "0x1p",
            "0x1p+",
            "0x1.8p3.5",
            "0x1g",
            "0x1.8.1",
            "--1",
            "-+1",
            "+-0x1",
            "0x-1",
            "0x1p-",
            "1x8",
            "0x1p 3",
            "0x1_0p0",
        ] {
            assert_eq!(binary32(text), None, "{text}");
            assert_eq!(binary64(text), None, "{text}");
        }
    }
}
