//! Which characters may be written, and what to write for those that may not.

/// Which characters may be written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Glyphs {
    /// − · ² √ Δ θ and the like.
    #[default]
    Unicode,
    /// Nothing above 127: for files, and for terminals that have nothing else.
    Ascii,
}

impl Glyphs {
    /// What they are, in a few words.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Unicode => "Unicode",
            Self::Ascii => "ASCII",
        }
    }

    /// Text that was written for Unicode, in the characters that are allowed.
    pub fn spell(self, text: &str) -> String {
        if self == Self::Unicode {
            return text.to_owned();
        }
        let mut spelt = String::with_capacity(text.len());
        for c in text.chars() {
            if c.is_ascii() {
                spelt.push(c);
            } else {
                spelt.push_str(ascii(c));
            }
        }
        spelt
    }

    /// The minus sign.
    pub const fn minus(self) -> &'static str {
        match self {
            Self::Unicode => "−",
            Self::Ascii => ascii('−'),
        }
    }

    /// The sign for what is past the range.
    pub const fn infinity(self) -> &'static str {
        match self {
            Self::Unicode => "∞",
            Self::Ascii => ascii('∞'),
        }
    }

    /// The sign for what was cut off.
    pub const fn ellipsis(self) -> &'static str {
        match self {
            Self::Unicode => "…",
            Self::Ascii => ascii('…'),
        }
    }
}

/// What is written for a character above 127 where there is only ASCII.
const fn ascii(c: char) -> &'static str {
    match c {
        '−' | '–' | '—' => "-",
        '·' => "*",
        '×' => "x",
        '₁' => "1",
        '₂' => "2",
        '₆' => "6",
        '₄' => "4",
        '²' => "^2",
        '√' => "sqrt ",
        'Δ' => "disc",
        'θ' => "theta",
        'κ' => "kappa",
        '±' => "+-",
        '≥' => ">=",
        '≤' => "<=",
        '≠' => "!=",
        '≈' | '≃' => "~=",
        '°' => " deg",
        '…' => "...",
        '“' | '”' => "\"",
        '’' | '′' => "'",
        '▸' | '▶' => ">",
        '→' => "->",
        '◂' | '←' => "<",
        '▾' | '↓' => "v",
        '▴' | '↑' => "^",
        '÷' | '↗' | '↙' => "/",
        '↖' | '↘' => "\\",
        '‖' | '⌊' | '⌋' => "|",
        '½' => "1/2",
        '∞' => "inf",
        _ => "?",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ascii_has_nothing_above_127() {
        let text = "Δ = B² − 4AC, √Δ ± ∞ “θ” ▾ → ü";
        assert!(Glyphs::Ascii.spell(text).is_ascii());
        assert_eq!(Glyphs::Ascii.spell("B² − 4AC"), "B^2 - 4AC");
        assert_eq!(Glyphs::Ascii.spell("0.3… ü"), "0.3... ?");
        assert_eq!(Glyphs::Unicode.spell(text), text);
    }
}
