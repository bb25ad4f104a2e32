//! Flags that say how things are drawn, and the variables that say it once for all starts.

use std::io::{self, IsTerminal as _};

use clap::{Args, ValueEnum};

use super::{Failure, choice};
use crate::explorer::{Options, Palette, Reasons, Setting};
use crate::render::{ColorDepth, Style};
use crate::terminal::Capability;
use crate::text::Glyphs;

/// How the explorer is drawn.
#[derive(Debug, Args)]
#[command(next_help_heading = "How it is drawn")]
pub(super) struct Appearance {
    #[command(flatten)]
    color: Color,

    /// The colours for a kind of screen [default: dark, or light where the terminal reports a light background]
    #[arg(long, env = "RAYSCOPE_THEME", hide_env_values = true, value_parser = choice(&Palette::ALL, Palette::name))]
    theme: Option<Palette>,

    /// Write only ASCII, for fonts and lines that garble other characters
    #[arg(long)]
    ascii: bool,

    /// Read commands and answer in lines of text, without a screen: for screen readers, pipes and scripts
    #[arg(long)]
    pub(super) plain: bool,
}

/// The flag for colours.
#[derive(Debug, Args)]
pub(super) struct Color {
    /// How many colours; auto: as many as the terminal has, in a pipe or file none
    #[arg(
        long,
        value_name = "WHEN",
        env = "RAYSCOPE_COLOR",
        hide_env_values = true,
        default_value = "auto"
    )]
    pub(super) color: ColorChoice,
}

/// How many colours, as it is asked for.
#[derive(Debug, Clone, Copy, ValueEnum)]
pub(super) enum ColorChoice {
    Auto,
    Never,
    #[value(name = "16")]
    Ansi16,
    #[value(name = "256")]
    Ansi256,
    True,
}

impl ColorChoice {
    /// What the terminal can do, with as many colours as are asked for.
    pub(super) const fn over(self, capability: Capability) -> Capability {
        let depth = match self {
            Self::Auto => return capability,
            Self::Never => ColorDepth::None,
            Self::Ansi16 => ColorDepth::Ansi16,
            Self::Ansi256 => ColorDepth::Ansi256,
            Self::True => ColorDepth::True,
        };
        Capability {
            depth,
            depth_reason: "--color or RAYSCOPE_COLOR says so",
            ..capability
        }
    }
}

/// Whether somebody sits there who can be asked.
pub(super) fn is_anybody_present() -> bool {
    io::stdin().is_terminal() && io::stdout().is_terminal()
}

impl Appearance {
    /// The options with what this terminal has and the person wants; fails where the terminal has
    /// too little.
    /// What was chosen at an earlier start serves where no flag and no variable says otherwise.
    pub(super) fn fitted(
        &self,
        options: Options,
        remembered: &[Setting],
    ) -> Result<Options, Failure> {
        let theme = remembered.iter().rev().find_map(|setting| match setting {
            Setting::Theme(palette) => Some(*palette),
            _ => None,
        });
        let capability = if self.plain {
            let depth_reason = "lines of text have none";
            Capability {
                depth: ColorDepth::None,
                depth_reason,
                ..Capability::of_output()
            }
        } else {
            let found = Capability::detect().map_err(|unfit| Failure::invalid(unfit.0))?;
            self.color.color.over(found)
        };
        let mut reasons = Reasons {
            depth: capability.depth_reason,
            palette: capability.palette_reason,
            glyphs: capability.glyphs_reason,
        };
        let mut glyphs = capability.glyphs;
        if self.ascii {
            (glyphs, reasons.glyphs) = (Glyphs::Ascii, "--ascii says so");
        }
        if self.theme.is_some() {
            reasons.palette = "--theme or RAYSCOPE_THEME says so";
        } else if theme.is_some() {
            reasons.palette = "chosen at an earlier start";
        }
        let theme = self.theme.or(theme);
        Ok(Options {
            depth: capability.depth,
            palette: theme.unwrap_or(capability.palette),
            follows_ground: theme.is_none(),
            glyphs,
            reasons,
            ..options
        })
    }
}

/// The style for who asks for none: half blocks need colours and characters of their own.
pub(super) fn default_style(depth: ColorDepth, glyphs: Glyphs) -> Style {
    if depth == ColorDepth::None || glyphs == Glyphs::Ascii {
        Style::Ascii
    } else {
        Style::Half
    }
}
