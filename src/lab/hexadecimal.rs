//! Binary32 in hexadecimal: the number itself, with no decimal in between.

use super::Problem;

/// The number as C's `%a` writes it and as C, C++, Python and Java read it: `0x1.8p+1` for 3.
pub fn hexadecimal(x: f32) -> String {
    if x.is_nan() {
        return "nan".into();
    }
    let sign = if x.is_sign_negative() { "-" } else { "" };
    if x.is_infinite() {
        return format!("{sign}inf");
    }
    let bits = x.to_bits();
    let fraction = bits & 0x7f_ffff;
    let (lead, exponent) = match (bits >> 23) & 0xff {
        0 if fraction == 0 => return format!("{sign}0x0p+0"),
        0 => (0, -126),
        biased => (1, biased as i32 - 127),
    };
    // 23 bits are five digits and three bits: a zero bit on the right makes six digits.
    let digits = format!("{:06x}", fraction << 1);
    match digits.trim_end_matches('0') {
        "" => format!("{sign}0x{lead}p{exponent:+}"),
        digits => format!("{sign}0x{lead}.{digits}p{exponent:+}"),
    }
}

/// The ten numbers of a problem, in the order of the columns ox … r.
pub fn numbers((ray, sphere): &Problem) -> [f32; 10] {
    let [ox, oy, oz] = ray.origin.to_array();
    let [dx, dy, dz] = ray.direction.to_array();
    let [cx, cy, cz] = sphere.center.to_array();
    [ox, oy, oz, dx, dy, dz, cx, cy, cz, sphere.radius]
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::method::read;

    proptest! {
        #[test]
        fn what_is_written_reads_back(bits: u32) {
            let x = f32::from_bits(bits);
            let back = read::binary32(&hexadecimal(x)).unwrap();
            prop_assert!(back.to_bits() == bits || (x.is_nan() && back.is_nan()));
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
            assert_eq!(hexadecimal(x), text);
        }
    }
}
