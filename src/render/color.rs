//! Colours: the palette, and what a terminal of 16, 256 or all colours makes of them.

use crate::scene::{Body, Rgb};

/// The colours that Okabe and Ito chose to be told apart by every kind of eye, without black.
const PALETTE: [Rgb; 7] = [
    Rgb(0xe6, 0x9f, 0x00), // orange
    Rgb(0x56, 0xb4, 0xe9), // sky blue
    Rgb(0x00, 0x9e, 0x73), // bluish green
    Rgb(0xf0, 0xe4, 0x42), // yellow
    Rgb(0xcc, 0x79, 0xa7), // reddish purple
    Rgb(0xd5, 0x5e, 0x00), // vermilion
    Rgb(0x00, 0x72, 0xb2), // blue
];

/// The colour of the sphere that is listed at place `index`: its own, else one of the palette.
pub fn color_of(index: usize, body: &Body) -> Rgb {
    body.color.unwrap_or(PALETTE[index % PALETTE.len()])
}

/// How many colours a terminal shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum ColorDepth {
    /// None: only characters tell things apart.
    None,
    /// The sixteen that every colour terminal has, as its user has set them.
    Ansi16,
    /// The 256 of xterm.
    #[default]
    Ansi256,
    /// 24 bits.
    True,
}

/// A colour as a terminal is asked for it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum AnsiColor {
    /// One of the sixteen, 0 to 15.
    Basic(u8),
    /// One of the 256 of xterm.
    Indexed(u8),
    /// Any.
    Rgb(Rgb),
}

impl ColorDepth {
    /// All depths, fewest colours first.
    pub const ALL: [Self; 4] = [Self::None, Self::Ansi16, Self::Ansi256, Self::True];

    /// The name on the command line and on the screen.
    pub const fn name(self) -> &'static str {
        match self {
            Self::None => "never",
            Self::Ansi16 => "16",
            Self::Ansi256 => "256",
            Self::True => "true",
        }
    }

    /// What it is, in a few words.
    pub const fn words(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Ansi16 => "the terminal's own 16",
            Self::Ansi256 => "256",
            Self::True => "24 bits",
        }
    }

    /// The depth of that name.
    pub fn by_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|d| d.name() == name)
    }

    /// The nearest colour that there is; nothing where there are none.
    pub fn nearest(self, color: Rgb) -> Option<AnsiColor> {
        match self {
            Self::None => None,
            Self::Ansi16 => Some(AnsiColor::Basic(nearest_of_16(color))),
            Self::Ansi256 => Some(AnsiColor::Indexed(nearest_of_256(color))),
            Self::True => Some(AnsiColor::Rgb(color)),
        }
    }

    /// How many shades of one hue are worth telling apart. Few of them make long runs of equal
    /// cells, and a run costs no bytes of colour.
    pub(super) const fn shades(self) -> u8 {
        match self {
            Self::None | Self::Ansi16 => 2,
            Self::Ansi256 => 12,
            Self::True => 24,
        }
    }
}

/// The channel values of xterm's 6 × 6 × 6 colour cube.
pub(super) const CUBE: [u8; 6] = [0, 95, 135, 175, 215, 255];

/// What xterm shows for one of its 256 colours.
pub fn xterm(index: u8) -> Rgb {
    match index {
        0 => Rgb(0, 0, 0),
        1..=15 => BASIC[usize::from(index) - 1],
        16..=231 => {
            let n = usize::from(index) - 16;
            let [r, g, b] = [n / 36, n / 6 % 6, n % 6].map(|step| CUBE[step]);
            Rgb(r, g, b)
        }
        232.. => {
            let grey = 8 + 10 * (index - 232);
            Rgb(grey, grey, grey)
        }
    }
}

fn nearest_of_256(Rgb(r, g, b): Rgb) -> u8 {
    let step = |v: u8| {
        let by_distance = |i: &usize| CUBE[*i].abs_diff(v);
        (0..CUBE.len()).min_by_key(by_distance).unwrap_or(0)
    };
    let [i, j, k] = [r, g, b].map(step);
    let in_cube = Rgb(CUBE[i], CUBE[j], CUBE[k]);
    // The greys 232 to 255 are 8, 18, … 238. They serve greys only: a dark orange shown as grey
    // would look like another sphere.
    let mean = (u32::from(r) + u32::from(g) + u32::from(b)) / 3;
    let grey_step = (mean.saturating_sub(3) / 10).min(23) as u8;
    let grey = 8 + 10 * grey_step;
    let spread = r.max(g).max(b) - r.min(g).min(b);
    let color = Rgb(r, g, b);
    if spread < 16 && distance(color, Rgb(grey, grey, grey)) < distance(color, in_cube) {
        232 + grey_step
    } else {
        (16 + 36 * i + 6 * j + k) as u8
    }
}

/// xterm's defaults for colours 1 to 15. Black is left out: what is hit must not vanish into the
/// background.
pub(super) const BASIC: [Rgb; 15] = [
    Rgb(205, 0, 0),
    Rgb(0, 205, 0),
    Rgb(205, 205, 0),
    Rgb(0, 0, 238),
    Rgb(205, 0, 205),
    Rgb(0, 205, 205),
    Rgb(229, 229, 229),
    Rgb(127, 127, 127),
    Rgb(255, 0, 0),
    Rgb(0, 255, 0),
    Rgb(255, 255, 0),
    Rgb(92, 92, 255),
    Rgb(255, 0, 255),
    Rgb(0, 255, 255),
    Rgb(255, 255, 255),
];

fn nearest_of_16(color: Rgb) -> u8 {
    (1..=15)
        .min_by_key(|i| distance(color, BASIC[*i as usize - 1]))
        .unwrap_or(7)
}

/// Squared distance of two colours, green counting most and blue least, as the eye has it.
fn distance(Rgb(r, g, b): Rgb, Rgb(s, h, c): Rgb) -> u32 {
    let square = |u: u8, v: u8| u32::from(u.abs_diff(v)).pow(2);
    2 * square(r, s) + 4 * square(g, h) + square(b, c)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_that_xterm_has_are_found_exactly() {
        for (i, &r) in CUBE.iter().enumerate() {
            for (j, &g) in CUBE.iter().enumerate() {
                let index = 16 + 36 * i + 6 * j + 5;
                assert_eq!(nearest_of_256(Rgb(r, g, 255)), index as u8);
            }
        }
        assert_eq!(nearest_of_256(Rgb(8, 8, 8)), 232);
        assert_eq!(nearest_of_256(Rgb(238, 238, 238)), 255);
        for i in 1..=15 {
            assert_eq!(nearest_of_16(BASIC[i as usize - 1]), i);
        }
    }

    #[test]
    fn a_dark_colour_is_never_shown_as_black_or_as_grey() {
        assert_ne!(nearest_of_16(Rgb(1, 1, 1)), 0);
        let orange = Rgb(92, 64, 0);
        assert!(nearest_of_256(orange) < 232);
    }
}
