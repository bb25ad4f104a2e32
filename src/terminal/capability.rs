//! What this terminal can do, and how that is known.

use std::env;
use std::io::{self, IsTerminal};

use crate::explorer::Palette;
use crate::render::ColorDepth;
use crate::text::Glyphs;

/// Colours and characters of a terminal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Capability {
    /// How many colours.
    pub depth: ColorDepth,
    /// Why as many.
    pub depth_reason: &'static str,
    /// Which characters.
    pub glyphs: Glyphs,
    /// Why these.
    pub glyphs_reason: &'static str,
    /// The theme for its ground, as far as that is known.
    pub palette: Palette,
    /// Why this one.
    pub palette_reason: &'static str,
}

/// Why the explorer can't run here, as a sentence that says what to use instead.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Unfit(pub &'static str);

/// The variables that say what a terminal can do.
#[derive(Debug, Clone, Default)]
struct Environment {
    no_color: Option<String>,
    color_term: Option<String>,
    term: Option<String>,
    term_program: Option<String>,
    color_fg_bg: Option<String>,
    locale: Option<String>,
    ssh: bool,
}

impl Environment {
    fn of_process() -> Self {
        let get = |name: &str| env::var(name).ok().filter(|v| !v.is_empty());
        Self {
            no_color: get("NO_COLOR"),
            color_term: get("COLORTERM"),
            term: get("TERM"),
            term_program: get("TERM_PROGRAM"),
            color_fg_bg: get("COLORFGBG"),
            // The first of the three that is set decides.
            locale: get("LC_ALL")
                .or_else(|| get("LC_CTYPE"))
                .or_else(|| get("LANG")),
            ssh: get("SSH_CONNECTION").is_some() || get("SSH_TTY").is_some(),
        }
    }
}

impl Capability {
    /// What the terminal of this process can do; refuses one that can't show the explorer.
    pub fn detect() -> Result<Self, Unfit> {
        if !io::stdin().is_terminal() || !io::stdout().is_terminal() {
            return Err(Unfit(
                "the explorer needs a terminal for input and output; `rayscope --plain` explores \
                 through pipes, `rayscope print SCENE` writes a picture",
            ));
        }
        Self::of(&Environment::of_process())
    }

    /// What can be written to standard output, wherever it goes: no colours but on a terminal.
    pub fn of_output() -> Self {
        let environment = Environment::of_process();
        Self::of(&environment)
            .ok()
            .filter(|_| io::stdout().is_terminal())
            .unwrap_or_else(|| {
                environment.with(
                    ColorDepth::None,
                    "the output is not a terminal with colours",
                )
            })
    }

    fn of(environment: &Environment) -> Result<Self, Unfit> {
        let term = environment.term.as_deref().unwrap_or("dumb");
        if term == "dumb" {
            return Err(Unfit(
                "the explorer can't draw on this terminal (TERM is dumb or not set); \
                 `rayscope --plain` explores in lines of text, `rayscope print SCENE` writes a \
                 picture",
            ));
        }
        let (depth, depth_reason) = environment.depth(term);
        Ok(environment.with(depth, depth_reason))
    }
}

/// Whether terminals of that name have all colours, whatever the environment says.
fn is_direct(term: &str) -> bool {
    let name = |known: &&str| term == *known || term.starts_with(&format!("{known}-"));
    term.ends_with("-direct") || ["alacritty", "foot"].iter().any(name)
}

impl Environment {
    fn with(&self, depth: ColorDepth, depth_reason: &'static str) -> Capability {
        let (glyphs, glyphs_reason) = self.glyphs();
        let (palette, palette_reason) = self.palette();
        Capability {
            depth,
            depth_reason,
            glyphs,
            glyphs_reason,
            palette,
            palette_reason,
        }
    }

    fn depth(&self, term: &str) -> (ColorDepth, &'static str) {
        if self.no_color.is_some() {
            return (ColorDepth::None, "NO_COLOR is set");
        }
        let direct = matches!(self.color_term.as_deref(), Some("truecolor" | "24bit"));
        // That program sets COLORTERM for shells that it can't show the colours of.
        if direct && self.term_program.as_deref() != Some("Apple_Terminal") {
            return (ColorDepth::True, "COLORTERM says so");
        }
        if is_direct(term) {
            return (ColorDepth::True, "TERM names a terminal with 24 bits");
        }
        if term.contains("256") {
            return (ColorDepth::Ansi256, "TERM names 256 colours");
        }
        if self.ssh && term.starts_with("xterm") {
            return (ColorDepth::Ansi256, "TERM is xterm-like, over SSH");
        }
        if term.starts_with("vt") {
            return (ColorDepth::None, "TERM is a terminal without colours");
        }
        (ColorDepth::Ansi16, "no sign of more colours")
    }

    fn glyphs(&self) -> (Glyphs, &'static str) {
        let locale = self.locale.as_deref().unwrap_or("C").to_ascii_lowercase();
        if locale.contains("utf-8") || locale.contains("utf8") {
            (Glyphs::Unicode, "the locale is UTF-8")
        } else if self.locale.is_none() {
            (Glyphs::Ascii, "LC_ALL, LC_CTYPE and LANG are not set")
        } else {
            (Glyphs::Ascii, "the locale is not UTF-8")
        }
    }

    /// The theme for the ground that some terminals tell of: the last of COLORFGBG's numbers is one
    /// of the sixteen colours, and of those 7 and 15 are light.
    fn palette(&self) -> (Palette, &'static str) {
        let ground = self
            .color_fg_bg
            .as_deref()
            .and_then(|v| v.rsplit(';').next());
        match ground {
            Some("7" | "15") => (Palette::Light, "COLORFGBG says the background is light"),
            Some(_) => (Palette::Dark, "COLORFGBG says the background is dark"),
            None => (Palette::Either, "the background is not known yet"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with(change: impl Fn(&mut Environment)) -> Result<Capability, Unfit> {
        let mut environment = Environment {
            term: Some("xterm-256color".into()),
            locale: Some("en_US.UTF-8".into()),
            ..Environment::default()
        };
        change(&mut environment);
        Capability::of(&environment)
    }

    #[test]
    fn colours_follow_what_the_variables_say() {
        let depth = |change: fn(&mut Environment)| with(change).unwrap().depth;
        assert_eq!(depth(|_| ()), ColorDepth::Ansi256);
        assert_eq!(depth(|e| e.no_color = Some("1".into())), ColorDepth::None);
        let direct = |e: &mut Environment| e.color_term = Some("truecolor".into());
        assert_eq!(depth(direct), ColorDepth::True);
        assert_eq!(
            depth(|e| {
                e.color_term = Some("truecolor".into());
                e.term_program = Some("Apple_Terminal".into());
            }),
            ColorDepth::Ansi256
        );
        assert_eq!(depth(|e| e.term = Some("linux".into())), ColorDepth::Ansi16);
        assert_eq!(depth(|e| e.term = Some("xterm".into())), ColorDepth::Ansi16);
        assert_eq!(depth(|e| e.term = Some("vt100".into())), ColorDepth::None);
        for term in [
            "alacritty",
            "alacritty-direct",
            "foot",
            "foot-extra",
            "tmux-direct",
        ] {
            let found = with(|e| e.term = Some(term.into())).unwrap().depth;
            assert_eq!(found, ColorDepth::True, "{term}");
        }
        assert_eq!(
            depth(|e| {
                e.term = Some("xterm".into());
                e.ssh = true;
            }),
            ColorDepth::Ansi256
        );
    }

    #[test]
    fn a_light_ground_that_is_told_of_gets_the_theme_for_it() {
        let palette = |v: Option<&str>| {
            with(|e| e.color_fg_bg = v.map(str::to_owned))
                .unwrap()
                .palette
        };
        assert_eq!(palette(Some("0;15")), Palette::Light);
        assert_eq!(palette(Some("0;default;7")), Palette::Light);
        assert_eq!(palette(Some("15;0")), Palette::Dark);
        assert_eq!(palette(None), Palette::Either);
    }

    #[test]
    fn a_terminal_that_is_none_is_told_what_to_use() {
        let said = with(|e| e.term = Some("dumb".into())).unwrap_err().0;
        assert!(said.contains("rayscope --plain") && said.contains("rayscope print"));
        assert!(with(|e| e.term = None).is_err());
    }

    #[test]
    fn a_locale_that_is_not_utf_8_gets_ascii() {
        let glyphs = |l: Option<&str>| with(|e| e.locale = l.map(str::to_owned)).unwrap().glyphs;
        assert_eq!(glyphs(Some("C")), Glyphs::Ascii);
        assert_eq!(glyphs(None), Glyphs::Ascii);
        assert_eq!(glyphs(Some("de_DE.utf8")), Glyphs::Unicode);
    }
}
