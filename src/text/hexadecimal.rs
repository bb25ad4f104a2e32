//! Floating-point numbers in hexadecimal: the number itself, with no decimal in between.

/// The number as C's `%a` writes it and as C, C++, Python and Java read it: `0x1.8p+1` for 3.
pub fn binary32(x: f32) -> String {
    written(x.into(), x.to_bits().into(), 23, 8)
}

/// The same for binary64.
pub fn binary64(x: f64) -> String {
    written(x, x.to_bits(), 52, 11)
}

/// A number and its bits, of which that many are its fraction and its exponent.
fn written(value: f64, bits: u64, fraction_bits: u32, exponent_bits: u32) -> String {
    if value.is_nan() {
        return "nan".into();
    }
    let sign = if value.is_sign_negative() { "-" } else { "" };
    if value.is_infinite() {
        return format!("{sign}inf");
    }
    if value == 0.0 {
        return format!("{sign}0x0p+0");
    }
    let bias = (1 << (exponent_bits - 1)) - 1;
    let biased = (bits >> fraction_bits) & ((1 << exponent_bits) - 1);
    let (lead, exponent) = match biased {
        0 => (0, 1 - bias),
        biased => (1, biased as i64 - bias),
    };
    // Zero bits on the right make the last digit whole.
    let count = fraction_bits.div_ceil(4);
    let fraction = (bits & ((1 << fraction_bits) - 1)) << (4 * count - fraction_bits);
    let digits = format!("{fraction:0count$x}", count = count as usize);
    match digits.trim_end_matches('0') {
        "" => format!("{sign}0x{lead}p{exponent:+}"),
        digits => format!("{sign}0x{lead}.{digits}p{exponent:+}"),
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::text::read;

    proptest! {
        #[test]
        fn what_is_written_reads_back(bits: u32, wide: u64) {
            let x = f32::from_bits(bits);
            let back = read::binary32(&binary32(x)).unwrap();
            prop_assert!(back.to_bits() == bits || (x.is_nan() && back.is_nan()));
            let x = f64::from_bits(wide);
            let back = read::binary64(&binary64(x)).unwrap();
            prop_assert!(back.to_bits() == wide || (x.is_nan() && back.is_nan()));
        }
    }

    #[test]
    fn writes_what_c_writes() {
        let cases = [
            (3.0, "0x1.8p+1"),
            (-1.0, "-0x1p+0"),
            (0.1, "0x1.99999ap-4"),
            (f32::MAX, "0x1.fffffep+127"),
            (f32::MIN_POSITIVE, "0x1p-126"),
            (f32::from_bits(1), "0x0.000002p-126"),
            (-0.0, "-0x0p+0"),
            (f32::NEG_INFINITY, "-inf"),
            (f32::NAN, "nan"),
        ];
        for (x, text) in cases {
            assert_eq!(binary32(x), text);
        }
        assert_eq!(binary64(0.1), "0x1.999999999999ap-4");
        assert_eq!(binary64(f64::from_bits(1)), "0x0.0000000000001p-1022");
    }
}
