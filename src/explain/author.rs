//! What the author of a scene says of a pixel, with the numbers of that pixel as they are now.

use super::sheet::WorkedQuadratic;
use super::{Reading, Sign, Subject};

/// A text in which each `{A}`, `{B}`, `{C}`, `{Δ}`, `{near}` and `{far}` is that number of the reading, with its
/// letter: `Δ = 400`. A sentence about a number that the pixel has not is left out.
pub fn told(text: &str, reading: &Reading) -> String {
    let worked = reading.subject.as_ref().map(Subject::worked);
    let sentences = text.split_inclusive(". ");
    let told = sentences.filter_map(|sentence| filled(sentence, worked.as_deref()));
    told.collect::<String>().trim_end().to_owned()
}

/// The sentences that stay true whatever becomes of the scene: those with such numbers and no other.
pub fn always_true(text: &str) -> String {
    let sentences = text.split_inclusive(". ");
    let stays = |sentence: &&str| sentence.contains('{') && !has_numbers(sentence);
    sentences
        .filter(stays)
        .collect::<String>()
        .trim_end()
        .to_owned()
}

/// Whether a text has figures in it.
pub fn has_numbers(text: &str) -> bool {
    text.contains(|c: char| c.is_ascii_digit())
}

fn filled(sentence: &str, worked: Option<&WorkedQuadratic>) -> Option<String> {
    let mut out = String::new();
    let mut rest = sentence;
    while let Some((before, name, after)) = placeholder(rest) {
        out += before;
        out += &named(name, worked?)?;
        rest = after;
    }
    Some(out + rest)
}

/// The text before the first name in braces, the name, and the text after it.
fn placeholder(text: &str) -> Option<(&str, &str, &str)> {
    let (before, rest) = text.split_once('{')?;
    let (name, after) = rest.split_once('}')?;
    Some((before, name, after))
}

/// A number by its name; none if there is none.
fn named(name: &str, worked: &WorkedQuadratic) -> Option<String> {
    let root = |n: usize| Some(&worked.roots.as_ref()?[n].written);
    let number = match name {
        "A" => &worked.a,
        "B" => &worked.b,
        "C" => &worked.c,
        "Δ" => &worked.delta,
        "near" => root(0)?,
        "far" => root(1)?,
        _ => return None,
    };
    let sign = Sign::of_letters(number.is_whole).text();
    Some(format!("{name} {sign} {}", number.text))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Ray, Sphere};
    use crate::method::Method;

    fn reading(x: f32) -> Reading {
        let ray = Ray::new(glam::Vec3::new(x, 20.0, 0.0), glam::Vec3::Z).expect("a ray");
        let sphere = Sphere::new(glam::Vec3::splat(20.0), 10.0).expect("a sphere");
        Reading::alone(ray, sphere, Method::Exact)
    }

    #[test]
    fn the_numbers_are_those_of_the_pixel() {
        let text = "{A}, {B}, {C}, so {Δ}. It goes in at {near}.";
        assert_eq!(
            told(text, &reading(20.0)),
            "A = 1, B = −40, C = 300, so Δ = 400. It goes in at near = 10."
        );
        assert_eq!(
            told(text, &reading(9.0)),
            "A = 1, B = −40, C = 421, so Δ = −84."
        );
        assert_eq!(told("{near}.", &reading(21.0)), "near ≈ 10.0501.");
    }

    #[test]
    fn what_holds_for_one_scene_only_is_told_from_the_rest() {
        assert_eq!(always_true("{Δ}. So it touches. {C} at 3."), "{Δ}.");
        assert_eq!(always_true("8 across and 6 up make 10."), "");
    }
}
