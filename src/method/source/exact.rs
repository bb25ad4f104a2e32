//! The first stage of `exact`, in C and Rust: certain or not, and it says which.

use super::SourceLanguage;

pub(super) fn source(language: SourceLanguage) -> Result<String, String> {
    match language {
        SourceLanguage::C => Ok(include_str!("exact.c").to_owned()),
        SourceLanguage::Rust => Ok(include_str!("exact.txt").to_owned()),
        SourceLanguage::Glsl | SourceLanguage::Wgsl => Err(
            "exact: its stages need bounds and whole numbers that shaders do not have; expected --lang c or rust, which print the first stage"
                .to_owned(),
        ),
    }
}
