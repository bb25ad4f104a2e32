//! The shades of a colour, from dark to bright, in the colours that a terminal has.

use std::collections::HashMap;
use std::sync::LazyLock;

use super::ColorDepth;
use super::color::{BASIC, CUBE};
use crate::scene::Rgb;

/// The shades of all colours that were asked for, kept from image to image.
#[derive(Debug, Clone, Default)]
pub(super) struct Ramps {
    depth: ColorDepth,
    places: HashMap<Rgb, usize>,
    shades: Vec<Vec<Rgb>>,
    /// The colour asked for last, and its place: neighbours mostly share it.
    last: Option<(Rgb, usize)>,
}

impl Ramps {
    /// Makes ready for a terminal of this depth.
    pub(super) fn set_depth(&mut self, depth: ColorDepth) {
        if self.depth != depth {
            *self = Self {
                depth,
                ..Self::default()
            };
        }
    }

    /// The shades of `color`, as many as the depth tells apart, the darkest first. Each is a colour
    /// that a terminal of this depth has.
    pub(super) fn of(&mut self, color: Rgb) -> &[Rgb] {
        let place = match self.last {
            Some((last, place)) if last == color => place,
            _ => self.place(color),
        };
        self.last = Some((color, place));
        &self.shades[place]
    }

    fn place(&mut self, Rgb(r, g, b): Rgb) -> usize {
        let color = match self.depth {
            ColorDepth::None | ColorDepth::Ansi16 | ColorDepth::True => Rgb(r, g, b),
            // A ramp takes some time to find: colours that differ little share one.
            ColorDepth::Ansi256 => Rgb(r & 0xf0 | r >> 4, g & 0xf0 | g >> 4, b & 0xf0 | b >> 4),
        };
        *self.places.entry(color).or_insert_with(|| {
            self.shades.push(shades(color, self.depth));
            self.shades.len() - 1
        })
    }
}

fn shades(color: Rgb, depth: ColorDepth) -> Vec<Rgb> {
    match depth {
        ColorDepth::None | ColorDepth::True => exact_shades(color, depth).collect(),
        ColorDepth::Ansi256 => nearest_shades(color, depth),
        ColorDepth::Ansi16 => two_shades(color).to_vec(),
    }
}

fn exact_shades(color: Rgb, depth: ColorDepth) -> impl Iterator<Item = Rgb> {
    let shades = depth.shades();
    // Brightness is light; the channels of a colour are about its square root.
    (0..shades).map(move |i| dimmed(color, ((f32::from(i) + 0.5) / f32::from(shades)).sqrt()))
}

/// `color` with each channel multiplied by `factor`, between 0 and 1.
fn dimmed(Rgb(r, g, b): Rgb, factor: f32) -> Rgb {
    let dim = |v: u8| (f32::from(v) * factor).round() as u8;
    Rgb(dim(r), dim(g), dim(b))
}

/// The colours of the terminal that have this hue, spread over the shades by their lightness.
///
/// The terminal has few dark colours and many light ones, so the ramp begins at the darkest of them
/// and ends a little above `color` itself, as a light would have it: more shades, each a clean one.
fn nearest_shades(color: Rgb, depth: ColorDepth) -> Vec<Rgb> {
    let base = perceived(color);
    let alike: Vec<_> = XTERM
        .iter()
        .filter(|(_, seen)| seen.is_shade_of(base))
        .collect();
    let lightness = alike.iter().map(|(_, seen)| seen.lightness);
    let (least, most) = lightness.fold((1.0_f32, 0.0_f32), |(l, m), x| (l.min(x), m.max(x)));
    let last = f32::from(depth.shades() - 1);
    let mut shades: Vec<_> = (0..depth.shades())
        .map(|i| base.at(least + (most - least) * f32::from(i) / last))
        .filter_map(|wanted| {
            let nearest = wanted.nearest_of(alike.iter().copied());
            nearest.or_else(|| base.nearest_of(XTERM.iter()))
        })
        .copied()
        .collect();
    shades.sort_by(|(_, a), (_, b)| a.lightness.total_cmp(&b.lightness));
    shades.into_iter().map(|(there_is, _)| there_is).collect()
}

/// The dull and the bright one of the sixteen that are nearest in hue. They tell spheres apart, and
/// light from dark; a finer ramp would have to borrow from other hues.
fn two_shades(color: Rgb) -> [Rgb; 2] {
    let wanted = perceived(color);
    if wanted.chroma() < GREY {
        return [BASIC[7], BASIC[6]];
    }
    let likeness = |dull: &usize| {
        let seen = perceived(BASIC[*dull]);
        (wanted.a * seen.a + wanted.b * seen.b) / seen.chroma()
    };
    let dull = (0..6)
        .max_by(|i, j| likeness(i).total_cmp(&likeness(j)))
        .unwrap_or(0);
    [BASIC[dull], BASIC[dull + 8]]
}

/// Chroma in Oklab below which a colour is a grey to the eye.
const GREY: f32 = 0.03;
/// The cosine of 29°, between neighbours among six named hues: what is farther off is another hue.
const ONE_HUE: f32 = 0.87;
/// The part of its chroma that a shade must keep not to look grey beside the others.
const STILL_COLORED: f32 = 0.8;
/// How much lighter than a colour its lightest shade may be.
const LIT: f32 = 0.19;

/// A colour in Oklab (Ottosson, 2020), where distance is about what the eye makes of it.
#[derive(Debug, Clone, Copy)]
struct Perceived {
    lightness: f32,
    a: f32,
    b: f32,
}

impl Perceived {
    fn chroma(self) -> f32 {
        self.a.hypot(self.b)
    }

    /// This colour lighter or darker, with less chroma where it is darker.
    fn at(self, lightness: f32) -> Self {
        let part = (lightness / self.lightness).min(1.0);
        Self {
            lightness,
            a: self.a * part,
            b: self.b * part,
        }
    }

    /// Whether this passes for a shade of `base`. A coloured sphere is never shown in grey, nor a grey
    /// one in colour: it would look like another.
    fn is_shade_of(self, base: Self) -> bool {
        if self.lightness > base.lightness + LIT {
            return false;
        }
        if base.chroma() < GREY {
            return self.chroma() < GREY;
        }
        let same_way = self.a * base.a + self.b * base.b;
        same_way > ONE_HUE * self.chroma() * base.chroma()
            && self.chroma() > STILL_COLORED * base.at(self.lightness).chroma()
    }

    /// The one of these colours that is most like this.
    fn nearest_of<'a>(
        self,
        colors: impl Iterator<Item = &'a (Rgb, Self)>,
    ) -> Option<&'a (Rgb, Self)> {
        colors.min_by(|(_, a), (_, b)| self.distance(*a).total_cmp(&self.distance(*b)))
    }

    /// The square of a distance in which colour counts more than lightness: a shade may be somewhat
    /// lighter or darker, not paler or of another hue.
    fn distance(self, other: Self) -> f32 {
        let lightness = (self.lightness - other.lightness).powi(2);
        lightness + 4.0 * ((self.a - other.a).powi(2) + (self.b - other.b).powi(2))
    }
}

fn perceived(Rgb(r, g, b): Rgb) -> Perceived {
    let linear = |v: u8| {
        let v = f32::from(v) / 255.0;
        if v <= 0.040_45 {
            v / 12.92
        } else {
            ((v + 0.055) / 1.055).powf(2.4)
        }
    };
    let [r, g, b] = [r, g, b].map(linear);
    let l = (0.412_221_46 * r + 0.536_332_55 * g + 0.051_445_995 * b).cbrt();
    let m = (0.211_903_5 * r + 0.680_699_5 * g + 0.107_396_96 * b).cbrt();
    let s = (0.088_302_46 * r + 0.281_718_85 * g + 0.629_978_7 * b).cbrt();
    Perceived {
        lightness: 0.210_454_26 * l + 0.793_617_8 * m - 0.004_072_047 * s,
        a: 1.977_998_5 * l - 2.428_592_2 * m + 0.450_593_7 * s,
        b: 0.025_904_037 * l + 0.782_771_77 * m - 0.808_675_77 * s,
    }
}

/// The colours 16 to 255 of xterm, but for black.
static XTERM: LazyLock<Vec<(Rgb, Perceived)>> = LazyLock::new(|| {
    let cube = (1..216).map(|i| Rgb(CUBE[i / 36], CUBE[i / 6 % 6], CUBE[i % 6]));
    let greys = (0..24).map(|i| 8 + 10 * i).map(|v| Rgb(v, v, v));
    cube.chain(greys).map(|c| (c, perceived(c))).collect()
});

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::AnsiColor;

    #[test]
    fn a_shade_is_a_colour_that_the_terminal_has() {
        for depth in [ColorDepth::Ansi16, ColorDepth::Ansi256] {
            let mut ramps = Ramps::default();
            ramps.set_depth(depth);
            for color in [Rgb(230, 159, 0), Rgb(0, 0, 0), Rgb(255, 255, 255)] {
                let shades = ramps.of(color);
                assert_eq!(shades.len(), usize::from(depth.shades()));
                for &shade in shades {
                    let shown = match depth.nearest(shade) {
                        Some(AnsiColor::Basic(i)) => BASIC[usize::from(i) - 1],
                        Some(AnsiColor::Indexed(i @ 16..=231)) => {
                            let i = usize::from(i) - 16;
                            Rgb(CUBE[i / 36], CUBE[i / 6 % 6], CUBE[i % 6])
                        }
                        Some(AnsiColor::Indexed(i)) => {
                            let grey = 8 + 10 * (i - 232);
                            Rgb(grey, grey, grey)
                        }
                        other => panic!("{other:?}"),
                    };
                    assert_eq!(shown, shade);
                }
            }
        }
    }

    #[test]
    fn the_three_spheres_of_a_scene_stay_apart_in_sixteen_colours() {
        let shades = [
            Rgb(0xe6, 0x9f, 0),
            Rgb(0x56, 0xb4, 0xe9),
            Rgb(0, 0x9e, 0x73),
        ]
        .map(two_shades);
        let [yellow, blue, green] = [2, 3, 1].map(|i| [BASIC[i], BASIC[i + 8]]);
        assert_eq!(shades, [yellow, blue, green]);
    }

    #[test]
    fn shades_get_no_darker_and_keep_their_hue() {
        let mut ramps = Ramps::default();
        ramps.set_depth(ColorDepth::Ansi256);
        for color in [
            Rgb(0xe6, 0x9f, 0),
            Rgb(0x56, 0xb4, 0xe9),
            Rgb(0, 0x9e, 0x73),
        ] {
            let shades = ramps.of(color);
            let lightness = |c: &Rgb| perceived(*c).lightness;
            assert!(shades.is_sorted_by_key(lightness), "{shades:?}");
            assert!(shades.iter().all(|c| perceived(*c).chroma() > GREY));
            let mut apart = shades.to_vec();
            apart.dedup();
            assert!(apart.len() >= 4, "{shades:?}");
        }
    }

    #[test]
    fn any_color_has_shades() {
        let mut ramps = Ramps::default();
        ramps.set_depth(ColorDepth::Ansi256);
        let values = [0, 1, 40, 127, 200, 255];
        for r in values {
            for (g, b) in values.into_iter().flat_map(|g| values.map(|b| (g, b))) {
                let shades = ramps.of(Rgb(r, g, b));
                let lightness = |c: &Rgb| perceived(*c).lightness;
                assert!(
                    shades.is_sorted_by_key(lightness),
                    "{r} {g} {b}: {shades:?}"
                );
            }
        }
    }
}
