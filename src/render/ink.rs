//! The ink: what a pixel contributes to its cell, in each view.

use glam::Vec3;

use super::color::color_of;
use super::delta::FARTHEST_MISS;
use super::look::Look;
use super::ramp::Ramps;
use super::{Acne, ColorDepth, Contact, Frame, Lost, Style, View};
use crate::method::exact::Stage;
use crate::scene::{Rgb, Scene};

/// What a pixel contributes to its cell.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ink {
    /// What shows the pixel where it has a cell of its own, in ASCII.
    pub glyph: char,
    /// 0 to 1: how much of it there is to see.
    pub level: f32,
    /// The left (0b10) and the right (0b01) half of it that is set where there is no colour.
    pub quarters: usize,
    /// Among the pixels of a cell the rarest gives its colour to all.
    pub rarity: u8,
    /// Its colour, where there are colours.
    pub color: Option<Rgb>,
}

/// What marks a pixel for which a method has no answer.
pub(super) const NO_ANSWER: char = '?';

/// What marks a pixel that is wrong and not only inexact.
pub(super) const WRONG: char = '!';

/// From dark to bright. Even the darkest is no blank: it is a hit.
pub const RAMP: &[u8] = b".,:-=+*#%@";

const WHITE: Rgb = Rgb(0xff, 0xff, 0xff);
const ORANGE: Rgb = Rgb(0xe6, 0x9f, 0x00);
const SKY: Rgb = Rgb(0x56, 0xb4, 0xe9);
const GREEN: Rgb = Rgb(0x00, 0x9e, 0x73);
const YELLOW: Rgb = Rgb(0xf0, 0xe4, 0x42);
const PURPLE: Rgb = Rgb(0xcc, 0x79, 0xa7);
const VERMILION: Rgb = Rgb(0xd5, 0x5e, 0x00);
const BLUE: Rgb = Rgb(0x00, 0x72, 0xb2);

/// Set wholly, on the left, on the right.
const FULL: usize = 0b11;
const LEFT: usize = 0b10;
const RIGHT: usize = 0b01;

impl Ink {
    /// Whether the method has no answer here, or a wrong one: every style shows that by its glyph.
    pub(super) fn is_alarm(&self) -> bool {
        [NO_ANSWER, WRONG].contains(&self.glyph)
    }

    /// Which of several pixels gives its colour to the cell: what is rare, then what is bright.
    pub(super) fn rank(&self) -> (u8, f32) {
        (self.rarity, self.level)
    }
}

/// The ink before it has a colour of the terminal: `base` is dimmed by `level`.
struct Tone {
    glyph: char,
    level: f32,
    quarters: usize,
    rarity: u8,
    base: Rgb,
}

/// What is to be seen at a pixel of `frame`; nothing where nothing is.
pub(super) fn ink(
    frame: &Frame,
    scene: &Scene,
    look: Look,
    ramps: &mut Ramps,
    (x, y): (u32, u32),
) -> Option<Ink> {
    let contact = frame.contact(x, y);
    let colored = look.depth != ColorDepth::None;
    // A character says how bright it is: with one colour a sphere it is read more easily, and far
    // fewer changes of colour go over the line.
    let level_is_in_glyph = look.style == Style::Ascii;
    if contact == Contact::Nan || frame.view() == View::Class {
        return of_class(contact, colored);
    }
    let tone = match frame.view() {
        View::Shade | View::Class => shade(frame, scene, look, (x, y)),
        View::Outline => outline(frame, scene, x, y),
        View::Depth => depth_tone(frame, scene, look, (x, y)),
        View::Normal => normal(frame, scene, x, y),
        View::Delta => delta(frame, x, y),
        View::Lost => lost(frame, x, y),
        View::Stage => stage(frame, x, y),
        View::Acne => acne(frame, scene, x, y),
    }?;
    Some(Ink {
        glyph: tone.glyph,
        level: tone.level,
        quarters: tone.quarters,
        rarity: tone.rarity,
        color: colored.then(|| {
            let shades = ramps.of(tone.base);
            let level = if level_is_in_glyph { 1.0 } else { tone.level };
            shades[step(level, shades.len())]
        }),
    })
}

/// Which of `steps` equal parts of 0 to 1 holds `level`.
fn step(level: f32, steps: usize) -> usize {
    ((level * steps as f32) as usize).min(steps - 1)
}

fn ramp(level: f32) -> char {
    RAMP[step(level, RAMP.len())].into()
}

impl Look {
    /// The brightness that is shown for one from 0 to 1.
    fn level(self, level: f32) -> f32 {
        if self.coarse {
            [DARK, BRIGHT][step(level, 2)]
        } else {
            level
        }
    }
}

/// The shades of a coarse picture.
const DARK: f32 = 0.3;
const BRIGHT: f32 = 0.8;

/// Both halves of what is bright, one half by turns of what is dark.
fn checkered(level: f32, x: u32, y: u32) -> usize {
    match (level >= 0.5, (x ^ y) & 1) {
        (true, _) => FULL,
        (false, 0) => LEFT,
        (false, _) => RIGHT,
    }
}

fn shade(frame: &Frame, scene: &Scene, look: Look, (x, y): (u32, u32)) -> Option<Tone> {
    let base = color_at(frame, scene, x, y)?;
    let level = look.level(frame.brightness(x, y));
    Some(Tone {
        glyph: ramp(level),
        level,
        quarters: FULL,
        rarity: 0,
        base,
    })
}

fn outline(frame: &Frame, scene: &Scene, x: u32, y: u32) -> Option<Tone> {
    frame.outline(scene, x, y).then_some(Tone {
        glyph: '#',
        level: 1.0,
        quarters: FULL,
        rarity: 0,
        base: color_at(frame, scene, x, y)?,
    })
}

/// The colour of the sphere seen at pixel (x, y).
fn color_at(frame: &Frame, scene: &Scene, x: u32, y: u32) -> Option<Rgb> {
    let seen = frame.seen(x, y)? as usize;
    Some(scene.bodies.get(seen).map_or(WHITE, |b| color_of(seen, b)))
}

fn depth_tone(frame: &Frame, scene: &Scene, look: Look, (x, y): (u32, u32)) -> Option<Tone> {
    let t = frame.hit(scene, x, y)?.t;
    let level = look.level(frame.nearness(t));
    Some(Tone {
        glyph: ramp(level),
        level,
        quarters: checkered(level, x, y),
        rarity: 0,
        base: WHITE,
    })
}

/// Where the light of the relief comes from: left, above, and before the picture.
const RELIEF: Vec3 = Vec3::new(-0.53, 0.53, 0.66);

fn normal(frame: &Frame, scene: &Scene, x: u32, y: u32) -> Option<Tone> {
    frame.seen(x, y)?;
    // A point sphere has no normal: it faces the eye as much as anything else.
    let n = frame.normal(scene, x, y).unwrap_or(Vec3::Z);
    let level = (0.1 + 0.9 * n.dot(RELIEF)).clamp(0.05, 1.0);
    let base = match (n.z > FACING, n.x.abs() > n.y.abs()) {
        (true, _) => WHITE,
        (_, true) if n.x > 0.0 => ORANGE,
        (_, true) => SKY,
        (_, false) if n.y > 0.0 => YELLOW,
        (_, false) => GREEN,
    };
    Some(Tone {
        glyph: number_pad(n),
        level,
        quarters: checkered(level, x, y),
        rarity: 0,
        base,
    })
}

/// The cosine of the angle up to which a surface counts as facing the eye.
const FACING: f32 = 0.94;

/// The direction of a normal on the screen as a number pad has it: 5 faces the eye, 8 is up.
fn number_pad(n: Vec3) -> char {
    if n.z > FACING {
        return '5';
    }
    // tan 22.5°: beyond it a direction is nearer to the diagonal than to the axis.
    let third = |v: f32, other: f32| {
        if v.abs() <= 0.414 * other.abs() {
            1
        } else if v > 0.0 {
            2
        } else {
            0
        }
    };
    let place = 3 * third(n.y, n.x) + third(n.x, n.y);
    char::from(b'1' + place)
}

/// Sign and size of Δ/(4Ar²).
fn delta(frame: &Frame, x: u32, y: u32) -> Option<Tone> {
    let delta = frame.delta(x, y)?;
    let (glyph, level, quarters, base) = if delta > 0.0 {
        let tenth = step(delta, 10) as u8;
        let level = 0.45 + 0.55 * delta.min(1.0);
        (char::from(b'0' + tenth), level, FULL, ORANGE)
    } else if delta == 0.0 {
        ('o', 1.0, LEFT, WHITE)
    } else {
        let glyph = if delta > -1.0 { '-' } else { '.' };
        let level = 0.05 + 0.2 * (1.0 - delta / FARTHEST_MISS);
        (glyph, level, RIGHT, BLUE)
    };
    Some(Tone {
        glyph,
        level,
        quarters,
        rarity: u8::from(glyph == 'o'),
        base,
    })
}

fn lost(frame: &Frame, x: u32, y: u32) -> Option<Tone> {
    let (glyph, level, quarters, rarity, base) = match frame.lost(x, y)? {
        Lost::Everything => (WRONG, 1.0, FULL, 2, PURPLE),
        Lost::Bits(0.0) => ('.', 0.2, RIGHT, 0, WHITE),
        Lost::Bits(bits) => {
            let whole = (bits.ceil() as u32).clamp(1, 24);
            let glyph = char::from_digit(whole, 36).unwrap_or('o');
            let quarters = if whole > 12 { FULL } else { LEFT };
            (glyph, 0.3 + 0.6 * bits / 24.0, quarters, 1, VERMILION)
        }
    };
    Some(Tone {
        glyph,
        level,
        quarters,
        rarity,
        base,
    })
}

fn stage(frame: &Frame, x: u32, y: u32) -> Option<Tone> {
    let (glyph, level, quarters, base) = match frame.stage(x, y)? {
        Stage::Binary64 if frame.seen(x, y).is_none() => return None,
        Stage::Binary64 => ('.', 0.3, RIGHT, BLUE),
        Stage::Unrounded => ('u', 0.4, RIGHT, SKY),
        Stage::Compensated => ('c', 0.5, LEFT, SKY),
        Stage::Whole => ('w', 0.65, LEFT, GREEN),
        Stage::DoubleDouble => ('d', 0.8, FULL, YELLOW),
        Stage::Integer => ('i', 1.0, FULL, VERMILION),
    };
    Some(Tone {
        glyph,
        level,
        quarters,
        rarity: 0,
        base,
    })
}

fn acne(frame: &Frame, scene: &Scene, x: u32, y: u32) -> Option<Tone> {
    let Acne { height, self_hit } = frame.acne(scene, x, y)?;
    let (glyph, level, quarters, rarity, base) = if self_hit.is_some() {
        ('*', 1.0, FULL, 1, YELLOW)
    } else if height < 0.0 {
        ('i', 0.55, LEFT, 0, VERMILION)
    } else if height > 0.0 {
        ('o', 0.45, RIGHT, 0, BLUE)
    } else {
        ('=', 0.35, RIGHT, 0, WHITE)
    };
    Some(Tone {
        glyph,
        level,
        quarters,
        rarity,
        base,
    })
}

fn of_class(contact: Contact, colored: bool) -> Option<Ink> {
    let rarity = match contact {
        Contact::Nan => 3,
        Contact::Tangent => 2,
        Contact::TangentBehind => 1,
        Contact::Miss | Contact::SecantBehind | Contact::Secant | Contact::Inside => 0,
    };
    (contact != Contact::Miss).then(|| Ink {
        glyph: class_glyph(contact),
        level: 1.0,
        quarters: class_quarters(contact),
        rarity,
        color: colored.then(|| class_color(contact)),
    })
}

const fn class_glyph(contact: Contact) -> char {
    match contact {
        Contact::Miss => '.',
        Contact::Nan => NO_ANSWER,
        Contact::TangentBehind => '~',
        Contact::SecantBehind => '-',
        Contact::Tangent => 'o',
        Contact::Secant => '#',
        Contact::Inside => '@',
    }
}

const fn class_color(contact: Contact) -> Rgb {
    match contact {
        Contact::Miss => Rgb(0x60, 0x60, 0x60),
        Contact::Nan => VERMILION,
        Contact::TangentBehind => Rgb(0x98, 0x90, 0x28),
        Contact::SecantBehind => Rgb(0x80, 0x80, 0x80),
        Contact::Tangent => YELLOW,
        Contact::Secant => SKY,
        Contact::Inside => GREEN,
    }
}

/// In the class view a half block is whole for a secant, its left quarter for a tangent, its right
/// quarter for what is behind.
pub(super) const fn class_quarters(contact: Contact) -> usize {
    match contact {
        Contact::Secant | Contact::Inside => FULL,
        Contact::Tangent | Contact::TangentBehind => LEFT,
        Contact::SecantBehind => RIGHT,
        Contact::Miss | Contact::Nan => 0b00,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_pad_says_where_a_normal_points() {
        let places = [
            ("1", [-0.7, -0.7, 0.1]),
            ("2", [0.1, -0.9, 0.3]),
            ("3", [0.6, -0.6, 0.5]),
            ("4", [-0.9, 0.2, 0.3]),
            ("5", [0.1, 0.2, 0.97]),
            ("6", [0.8, 0.0, 0.6]),
            ("7", [-0.6, 0.6, 0.5]),
            ("8", [0.0, 1.0, 0.0]),
            ("9", [0.7, 0.7, 0.0]),
        ];
        for (key, n) in places {
            assert_eq!(number_pad(n.into()).to_string(), key);
        }
    }
}
