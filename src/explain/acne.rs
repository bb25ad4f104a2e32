//! What the view `acne` shows at a pixel, as a number in words.

use super::number::{Digits, number};
use crate::method::Precision;
use crate::render::Acne;

/// On which side of the sphere the computed point lies and by how much, and where a mirrored ray meets the sphere.
pub fn acne_words(acne: &Acne) -> String {
    let digits = |x: f64| number(x, Precision::Binary32, Digits::Significant(3));
    let size = digits(acne.height.abs());
    let point = if acne.height < 0.0 {
        format!("p {size} inside")
    } else if acne.height > 0.0 {
        format!("p {size} outside")
    } else {
        "p on the sphere".to_owned()
    };
    match acne.self_hit {
        Some(t) => format!("{point}, hits itself at {}", digits(t.into())),
        None => point,
    }
}
