//! Numbers for people: as many digits as there is room and reason for, never a wrong one.

use glam::Vec3;

use crate::method::Precision;
use crate::method::format::Shortest;
use crate::text::Glyphs;

/// How many digits a number is shown with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Digits {
    /// At most this many significant digits.
    Significant(usize),
    /// As many as tell the number from its neighbours.
    Full,
}

/// A number of that precision as people read it.
pub fn number(value: f64, precision: Precision, digits: Digits) -> String {
    let shortest = Shortest {
        value,
        precision,
        glyphs: Glyphs::Unicode,
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
}
