//! The first stage of `exact`, in C and Rust: certain or not, and it says which.

use super::SourceLanguage;

pub(super) fn source(language: SourceLanguage) -> Result<String, String> {
    match language {
        SourceLanguage::C => Ok(include_str!("exact.c").to_owned()),
        SourceLanguage::Rust => Ok(include_str!("exact.txt").to_owned()),
        SourceLanguage::Glsl | SourceLanguage::Wgsl => Err(
            "exact: its stages take bounds and whole numbers that shaders have no use for; c and rust have the first"
                .to_owned(),
        ),
    }
}
