//! Two methods side by side for the same pixel, quantity by quantity, bit by bit.

use super::figure::{Float, bits};
use super::panel::{Line, Role, unit_lines};
use crate::method::Precision;
use crate::method::trace::{Measured, Trace, error_text};
use crate::text::Glyphs;

/// Width of a quantity's name.
const LABEL: usize = 5;

/// A, B, C, Δ and both roots by two methods, with the first bit in which they differ.
pub fn comparison(one: &Trace, other: &Trace, width: usize) -> Vec<Line> {
    let column = (width.saturating_sub(LABEL) / 2).max(8);
    let mut out = vec![
        Line::new(0)
            .to(LABEL)
            .with(Role::Label, one.method.name())
            .to(LABEL + column)
            .with(Role::Label, other.method.name()),
    ];
    let pairs = [
        ("A", Some(&one.a), Some(&other.a)),
        ("B", Some(&one.b), Some(&other.b)),
        ("C", Some(&one.c), Some(&other.c)),
        ("Δ", Some(&one.discriminant), Some(&other.discriminant)),
        ("near", one.near.as_ref(), other.near.as_ref()),
        ("far", one.far.as_ref(), other.far.as_ref()),
    ];
    for (label, x, y) in pairs {
        out.push(Line::new(5));
        out.push(values(label, x, y, column));
        out.extend(errors(x, y, column));
        out.extend(differing_bits(x, y, width));
    }
    let verdicts = [one, other].map(|t| t.verdict(Glyphs::Unicode));
    for wrong in verdicts.into_iter().flatten() {
        out.push(Line::new(4));
        out.extend(Line::wrapped(&wrong, width, Role::Warning, 0));
    }
    let mut numbers = pairs.into_iter().flat_map(|(_, x, y)| [x, y]).flatten();
    let any_finer = numbers.clone().any(has_own_unit);
    if numbers.any(|m| m.ulps().is_some_and(|ulps| ulps != 0.0)) {
        out.extend(unit_lines(|p| p == Precision::Binary32, width, 1));
        out.extend(unit_lines(
            |p| p != Precision::Binary32 && any_finer,
            width,
            3,
        ));
    }
    out
}

/// The bits of a number, beside those of the exact value rounded once to the same precision.
pub fn measured_bits(label: &str, number: &Measured, width: usize) -> Vec<Line> {
    let float = |value: f64| match number.precision {
        Precision::Binary32 => Float::Single(value as f32),
        Precision::Binary64 => Float::Double(value),
    };
    let exact = number.exact.as_ref().map(|e| e.round(number.precision));
    let differing = exact.filter(|e| e.to_bits() != number.value.to_bits());
    let other = differing.map(|e| ("exact, rounded", float(e)));
    bits(label, float(number.value), other, width)
}

fn values(label: &str, x: Option<&Measured>, y: Option<&Measured>, column: usize) -> Line {
    let show = |m: Option<&Measured>| {
        m.map_or("none".into(), |m| {
            let shortest = m.shortest(Glyphs::Unicode);
            shortest.rounded(column.saturating_sub(8).clamp(3, 17))
        })
    };
    let same = x.map(|m| m.value.to_bits()) == y.map(|m| m.value.to_bits());
    let role = if same { Role::Value } else { Role::Changed };
    Line::new(0)
        .with(Role::Label, label)
        .to(LABEL)
        .with(Role::Value, show(x))
        .to(LABEL + column)
        .with(role, show(y))
}

/// Both errors in one unit, the spacing of binary32, so that they can be compared; under it, in its
/// own unit, that of a number with more bits.
fn errors(x: Option<&Measured>, y: Option<&Measured>, column: usize) -> Vec<Line> {
    let both = |spare: u8, [x, y]: [String; 2]| {
        Line::new(spare)
            .to(LABEL)
            .with(Role::Faint, x)
            .to(LABEL + column)
            .with(Role::Faint, y)
    };
    let error = |m: Option<&Measured>, unit| {
        m.and_then(|m| m.ulps_in(unit))
            .map(|ulps| match ulps {
                0.0 => "exact".to_owned(),
                ulps => error_text(ulps, unit, Glyphs::Unicode),
            })
            .unwrap_or_default()
    };
    let own = |m: Option<&Measured>| match m.filter(|m| has_own_unit(m)) {
        Some(m) => format!("= {}", error(Some(m), m.precision)),
        None => String::new(),
    };
    let mut out = vec![both(1, [x, y].map(|m| error(m, Precision::Binary32)))];
    if [x, y].into_iter().flatten().any(has_own_unit) {
        out.push(both(3, [own(x), own(y)]));
    }
    out
}

/// Whether a number's error has another unit than the one that all are compared in.
fn has_own_unit(m: &Measured) -> bool {
    m.precision != Precision::Binary32 && m.ulps().is_some_and(|ulps| ulps != 0.0)
}

/// Both numbers as binary32 in sign, exponent and fraction, the first differing bit marked.
fn differing_bits(x: Option<&Measured>, y: Option<&Measured>, width: usize) -> Vec<Line> {
    let (Some(x), Some(y)) = (x, y) else {
        return Vec::new();
    };
    let [x, y] = [x, y].map(|m| (m.value as f32).to_bits());
    let bits = [x, y].map(written_bits);
    if x == y || bits[0].len() > width {
        return Vec::new();
    }
    let at = bits[0]
        .bytes()
        .zip(bits[1].bytes())
        .position(|(a, b)| a != b);
    let caret = format!("{}^", " ".repeat(at.unwrap_or(0)));
    let [first, second] = bits;
    vec![
        Line::new(2).with(Role::Plain, first),
        Line::joined(2).with(Role::Plain, second),
        Line::joined(2).with(Role::Warning, caret),
    ]
}

/// `s eeeeeeee fffffffffffffffffffffff`: 34 characters.
fn written_bits(bits: u32) -> String {
    let all = format!("{bits:032b}");
    format!("{} {} {}", &all[..1], &all[1..9], &all[9..])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_binary32_is_written_in_its_three_parts() {
        assert_eq!(
            written_bits(1.0_f32.to_bits()),
            "0 01111111 00000000000000000000000"
        );
        assert_eq!(
            written_bits((-2.5_f32).to_bits()),
            "1 10000000 01000000000000000000000"
        );
    }
}
