//! Slice and curve as text, at the sizes that a panel has, and at all others.

use proptest::prelude::*;
use unicode_width::UnicodeWidthStr;

use super::cases::{NAMES, aimed, named, whole, wild};
use super::{curve, slice};
use crate::explain::{Line, Subject, plain_text};
use crate::geometry::Ray;
use crate::text::Glyphs;

type Figure = fn(&Subject, &Ray, f64, usize, usize, Glyphs) -> Vec<Line>;

/// All cases at one size, each under its name, p half way to what is seen.
fn gallery(figure: Figure, cols: usize, rows: usize, glyphs: Glyphs) -> String {
    let picture = |name: &&str| {
        let (subject, ray) = named(name);
        let t = subject.solution.visible().map_or(2.0, |t| t / 2.0);
        let lines = figure(&subject, &ray, t.into(), cols, rows, glyphs);
        format!("=== {name}\n{}", plain_text(&lines))
    };
    NAMES.iter().map(picture).collect()
}

#[test]
fn slices_beside_a_view() {
    insta::assert_snapshot!(gallery(slice, 36, 20, Glyphs::Unicode));
}

#[test]
fn slices_on_a_wide_screen() {
    insta::assert_snapshot!(gallery(slice, 56, 18, Glyphs::Unicode));
}

#[test]
fn slices_in_ascii() {
    insta::assert_snapshot!(gallery(slice, 56, 18, Glyphs::Ascii));
}

#[test]
fn curves_beside_a_view() {
    insta::assert_snapshot!(gallery(curve, 36, 20, Glyphs::Unicode));
}

#[test]
fn curves_on_a_wide_screen() {
    insta::assert_snapshot!(gallery(curve, 56, 18, Glyphs::Unicode));
}

#[test]
fn curves_in_ascii() {
    insta::assert_snapshot!(gallery(curve, 56, 18, Glyphs::Ascii));
}

#[test]
fn a_method_that_answers_otherwise_is_named_as_such() {
    let (mut subject, ray) = named("far");
    subject.solution = crate::method::Solution::MISS;
    for figure in [slice as Figure, curve] {
        let text = plain_text(&figure(&subject, &ray, 0.0, 56, 18, Glyphs::Unicode));
        assert!(
            text.contains("this is the truth; the method says miss"),
            "{text}"
        );
    }
}

fn any_case() -> impl Strategy<Value = (Subject, Ray)> {
    prop_oneof![wild(), whole(), aimed()]
}

fn any_time() -> impl Strategy<Value = f64> {
    let bits = any::<u64>().prop_map(f64::from_bits);
    prop_oneof![bits, -10.0..10.0, Just(f64::NAN), Just(f64::INFINITY)]
}

proptest! {
    #[test]
    fn every_figure_fills_its_room_and_no_more(
        (subject, ray) in any_case(),
        t in any_time(),
        cols in 0_usize..170,
        rows in 0_usize..64,
        ascii in any::<bool>(),
    ) {
        let glyphs = if ascii { Glyphs::Ascii } else { Glyphs::Unicode };
        for figure in [slice as Figure, curve] {
            let lines = figure(&subject, &ray, t, cols, rows, glyphs);
            prop_assert_eq!(lines.len(), rows);
            for line in &lines {
                let text: String = line.spans.iter().map(|s| s.text.as_str()).collect();
                prop_assert!(text.width() <= cols && text.width() == line.width());
                prop_assert!(!ascii || text.is_ascii(), "{}", text);
                prop_assert!(!text.contains("NaN"), "{}", text);
            }
        }
    }
}
