//! What a misspelt word most likely meant.

/// The candidate that a misspelt word most likely meant; none if all are far from it.
pub fn nearest<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    const ALIKE: f64 = 0.7;
    // A single letter is in many words.
    let word = Some(word).filter(|word| word.chars().nth(1).is_some())?;
    candidates
        .into_iter()
        .map(|candidate| (strsim::jaro_winkler(word, candidate), candidate))
        .filter(|(likeness, _)| *likeness >= ALIKE)
        .max_by(|(a, _), (b, _)| a.total_cmp(b))
        .map(|(_, candidate)| candidate)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_misspelt_word_finds_its_neighbour_and_nonsense_none() {
        let words = ["center", "radius", "color"];
        assert_eq!(nearest("colour", words), Some("color"));
        assert_eq!(nearest("raduis", words), Some("radius"));
        assert_eq!(nearest("xyz", words), None);
        assert_eq!(nearest("x", ["next-view"]), None);
    }
}
