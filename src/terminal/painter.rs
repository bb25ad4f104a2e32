//! From a buffer of cells to the bytes that bring a terminal from what it shows to that.
//!
//! ratatui's own backend for crossterm writes a cursor position for each run of changed cells and
//! both colours wherever one changes. Over a slow link bytes are time, so this one writes the
//! cheapest that shows the same cells: no colour that does not show, the shortest way to the next
//! cell, the cells of a short gap again rather than a jump over it; and row by row or ink by ink,
//! whichever takes less. `rayscope bench --frames --explorer SCENE` has both beside each other: about half the
//! bytes, for up to twice the time. Once it has room it takes no memory.

use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hasher};

use ratatui::buffer::{Buffer, Cell};
use ratatui::layout::Position;
use ratatui::style::{Color, Modifier};
use unicode_width::UnicodeWidthStr;

use crate::explorer::Options;
use crate::render::ColorDepth;
use crate::text::Glyphs;

const BEGIN_UPDATE: &[u8] = b"\x1b[?2026h";
const END_UPDATE: &[u8] = b"\x1b[?2026l";
const SHOW_CURSOR: &[u8] = b"\x1b[?25h";
const HIDE_CURSOR: &[u8] = b"\x1b[?25l";
const RESET_AND_CLEAR: &[u8] = b"\x1b[m\x1b[2J";

/// What a blank may differ in and look the same: all but these.
const SEEN_ON_BLANKS: Modifier = Modifier::REVERSED
    .union(Modifier::UNDERLINED)
    .union(Modifier::CROSSED_OUT);

/// What the terminal must not be sent.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Limits {
    /// No colours.
    pub colorless: bool,
    /// No byte above 127.
    pub ascii: bool,
}

impl Limits {
    /// What these options rule out, whatever the explorer draws.
    pub fn of(options: &Options) -> Self {
        Self {
            colorless: options.colors() == ColorDepth::None,
            ascii: options.glyphs == Glyphs::Ascii,
        }
    }
}

/// Follows what a terminal shows and writes the difference.
#[derive(Debug)]
pub struct Painter {
    /// What the terminal shows, once all that was written has reached it.
    shown: Buffer,
    /// Whether the terminal shows something else than `shown` says.
    lost: bool,
    limits: Limits,
    cursor_visible: bool,
    pen: TerminalState,
    out: Vec<u8>,
    /// For each row whether it has or had wide characters.
    wide_rows: Vec<bool>,
    room: Scratch,
}

impl Default for Painter {
    /// A painter of a terminal that shows nobody knows what.
    fn default() -> Self {
        Self {
            shown: Buffer::default(),
            lost: true,
            limits: Limits::default(),
            cursor_visible: true,
            pen: TerminalState::default(),
            out: Vec::new(),
            wide_rows: Vec::new(),
            room: Scratch::default(),
        }
    }
}

impl Painter {
    /// Draws everything anew with the next frame.
    pub const fn forget(&mut self) {
        self.lost = true;
    }

    /// The bytes that make the terminal show `next`, with its cursor there or hidden; no bytes if it
    /// does so already. The buffer that is not needed any more comes back in place of `next`.
    pub fn paint(&mut self, next: &mut Buffer, cursor: Option<Position>, limits: Limits) -> &[u8] {
        self.out.clear();
        if self.shown.area != next.area || self.limits != limits {
            self.lost = true;
        }
        self.out.extend_from_slice(BEGIN_UPDATE);
        let start = self.out.len();
        if self.lost {
            self.out.extend_from_slice(RESET_AND_CLEAR);
            self.shown = Buffer::empty(next.area);
            self.pen = TerminalState::default();
        }
        self.room
            .find_stretches(&self.shown, next, limits, &mut self.wide_rows);
        let page = WantedCells {
            buffer: next,
            limits,
            wide_rows: &self.wide_rows,
        };
        self.pen = self.room.paint(self.pen, page, &mut self.out);
        if let Some(position) = cursor {
            self.pen.go(position, None, &mut self.out);
        }
        if self.lost || cursor.is_some() != self.cursor_visible {
            self.cursor_visible = cursor.is_some();
            self.out.extend_from_slice(if self.cursor_visible {
                SHOW_CURSOR
            } else {
                HIDE_CURSOR
            });
        }
        std::mem::swap(&mut self.shown, next);
        (self.lost, self.limits) = (false, limits);
        if self.out.len() == start {
            return &[];
        }
        self.out.extend_from_slice(END_UPDATE);
        &self.out
    }
}

/// What a cell looks like, or that it is the right half of the character before it. Two that look the same
/// are the same: what does not show is left at its default.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum CellLook<'a> {
    /// Characters.
    Text {
        symbol: &'a str,
        fg: Color,
        bg: Color,
        modifier: Modifier,
    },
    /// The right half of the character before it.
    Covered,
}

impl<'a> CellLook<'a> {
    fn of(cell: &'a Cell, limits: Limits) -> Self {
        let symbol = symbol(cell, limits);
        let (mut fg, mut bg, mut modifier) = (cell.fg, cell.bg, cell.modifier);
        if limits.colorless {
            (fg, bg) = (Color::Reset, Color::Reset);
        }
        if symbol == " " && !modifier.intersects(SEEN_ON_BLANKS) {
            (fg, modifier) = (Color::Reset, Modifier::empty());
        }
        Self::Text {
            symbol,
            fg,
            bg,
            modifier,
        }
    }

    /// The characters to write, and what they want of the pen; nothing where nothing is to write.
    fn written(self) -> Option<(&'a str, Want)> {
        let Self::Text {
            symbol,
            fg,
            bg,
            modifier,
        } = self
        else {
            return None;
        };
        let blank = symbol == " " && !modifier.intersects(SEEN_ON_BLANKS);
        let want = Want {
            fg: (!blank).then_some(fg),
            bg: Some(bg),
            modifier,
            touches: if blank {
                SEEN_ON_BLANKS
            } else {
                Modifier::all()
            },
        };
        Some((symbol, want))
    }
}

/// The characters that are sent for a cell.
fn symbol(cell: &Cell, limits: Limits) -> &str {
    match cell.symbol() {
        "" => " ",
        symbol if limits.ascii && !symbol.is_ascii() => "?",
        symbol => symbol,
    }
}

/// How many columns these characters take.
fn width(symbol: &str) -> u16 {
    match symbol.as_bytes() {
        // ASCII, and the lines, blocks and dots of which most screens consist.
        [_] | [0xe2, 0x94..=0x95 | 0xa0..=0xa3, _] | [0xe2, 0x96, 0x80..=0x9f] => 1,
        _ => symbol.width().max(1) as u16,
    }
}

/// What a character wants the pen to be; what does not show on it is left open.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
struct Want {
    fg: Option<Color>,
    bg: Option<Color>,
    modifier: Modifier,
    /// Which modifiers matter.
    touches: Modifier,
}

impl Want {
    /// What suits both, if anything does.
    fn and(self, other: Self) -> Option<Self> {
        let one_of = |a: Option<Color>, b: Option<Color>| match (a, b) {
            (Some(a), Some(b)) if a != b => None,
            _ => Some(a.or(b)),
        };
        let differ = (self.modifier ^ other.modifier) & self.touches & other.touches;
        differ.is_empty().then_some(())?;
        Some(Self {
            fg: one_of(self.fg, other.fg)?,
            bg: one_of(self.bg, other.bg)?,
            modifier: (self.modifier & self.touches) | (other.modifier & other.touches),
            touches: self.touches | other.touches,
        })
    }

    /// Whether only one ink suits.
    fn is_settled(self) -> bool {
        self.fg.is_some() && self.bg.is_some() && self.touches.is_all()
    }
}

/// About how many bytes another colour takes.
const ONE_COLOR: u8 = 8;

/// With which colours and modifiers the terminal writes now.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
struct TerminalInk {
    fg: Color,
    bg: Color,
    modifier: Modifier,
}

impl TerminalInk {
    fn suits(self, want: Want) -> bool {
        self.after(want) == self
    }

    /// About how many bytes the way to that ink takes.
    fn distance(self, want: Want) -> u8 {
        let after = self.after(want);
        let color = |one, other| if one == other { 0 } else { ONE_COLOR };
        color(self.fg, after.fg)
            + color(self.bg, after.bg)
            + if self.modifier == after.modifier {
                0
            } else {
                3
            }
    }

    fn after(self, want: Want) -> Self {
        Self {
            fg: want.fg.unwrap_or(self.fg),
            bg: want.bg.unwrap_or(self.bg),
            modifier: (self.modifier - want.touches) | (want.modifier & want.touches),
        }
    }
}

/// Changed cells beside each other that one ink can write.
#[derive(Debug, Clone, Copy)]
struct CellRun {
    /// The row, its first column, and the one after its last.
    y: u16,
    from: u16,
    to: u16,
    want: Want,
    /// The pass in which it is written, ink by ink.
    pass: u32,
}

/// Where and how the terminal writes now.
#[derive(Debug, Clone, Copy, Default)]
struct TerminalState {
    /// Where the terminal's cursor is, if that is known.
    at: Option<Position>,
    ink: TerminalInk,
}

/// The cells to be shown.
#[derive(Clone, Copy)]
struct WantedCells<'a> {
    buffer: &'a Buffer,
    limits: Limits,
    /// For each row whether it has or had wide characters.
    wide_rows: &'a [bool],
}

/// All that a frame needs to work in, kept from frame to frame.
#[derive(Debug, Default)]
struct Scratch {
    /// The changed cells of rows with wide characters, and of the others, from the top left on.
    wide: Vec<CellRun>,
    plain: Vec<CellRun>,
    passes: Passes,
    by_row: Vec<u8>,
    by_ink: Vec<u8>,
}

impl Scratch {
    /// Finds what differs between two buffers of one size, and the rows with wide characters.
    fn find_stretches(
        &mut self,
        shown: &Buffer,
        next: &Buffer,
        limits: Limits,
        wide_rows: &mut Vec<bool>,
    ) {
        self.wide.clear();
        self.plain.clear();
        wide_rows.clear();
        let columns = usize::from(next.area.width).max(1);
        let rows = shown
            .content
            .chunks(columns)
            .zip(next.content.chunks(columns));
        for (y, (before, after)) in (next.area.top()..).zip(rows) {
            let start = self.plain.len();
            let is_wide = before != after
                && find_in_row((before, after), (next.area.x, y), limits, &mut self.plain);
            if is_wide {
                self.wide.extend(self.plain.drain(start..));
            }
            wide_rows.push(is_wide);
        }
    }

    /// Writes all that changed, in the cheaper of two orders: row by row, or ink by ink. The pen after it.
    fn paint(
        &mut self,
        mut pen: TerminalState,
        page: WantedCells,
        out: &mut Vec<u8>,
    ) -> TerminalState {
        // Of two halves of a wide character none is written without the other.
        for stretch in &self.wide {
            pen.paint(stretch, page, out);
        }
        self.by_row.clear();
        let mut after_rows = pen;
        for stretch in &self.plain {
            after_rows.paint(stretch, page, &mut self.by_row);
        }
        self.by_ink.clear();
        let mut after_passes = pen;
        self.passes.sort(&mut self.plain, pen.ink);
        for &i in &self.passes.order {
            after_passes.paint(&self.plain[i as usize], page, &mut self.by_ink);
        }
        if self.by_ink.len() < self.by_row.len() {
            out.extend_from_slice(&self.by_ink);
            after_passes
        } else {
            out.extend_from_slice(&self.by_row);
            after_rows
        }
    }
}

/// Finds the stretches of a row; whether it has or had wide characters.
fn find_in_row(
    (before, after): (&[Cell], &[Cell]),
    (left, y): (u16, u16),
    limits: Limits,
    out: &mut Vec<CellRun>,
) -> bool {
    let start = out.len();
    let mut is_wide = false;
    // How many columns more the last character covers, as it was and as it is.
    let [mut covered_before, mut covered] = [0; 2];
    for (x, (before, after)) in (left..).zip(before.iter().zip(after)) {
        if covered_before == 0 && covered == 0 && before == after {
            covered = width(symbol(after, limits)) - 1;
            covered_before = covered;
            is_wide |= covered > 0;
            continue;
        }
        let look = |cell, covered: &mut u16| {
            if *covered > 0 {
                *covered -= 1;
                return CellLook::Covered;
            }
            *covered = width(symbol(cell, limits)) - 1;
            CellLook::of(cell, limits)
        };
        let (before, after) = (look(before, &mut covered_before), look(after, &mut covered));
        is_wide |= covered_before > 0 || covered > 0;
        let Some((symbol, want)) = after.written().filter(|_| before != after) else {
            continue;
        };
        let to = x + width(symbol);
        let last = out[start..].last_mut().filter(|last| last.to == x);
        match last.and_then(|last| Some((last.want.and(want)?, last))) {
            Some((both, last)) => (last.to, last.want) = (to, both),
            None => out.push(CellRun {
                y,
                from: x,
                to,
                want,
                pass: 0,
            }),
        }
    }
    is_wide
}

/// The inks of a frame, and the order of its stretches ink by ink.
#[derive(Debug, Default)]
struct Passes {
    /// What the stretches of a pass want, and how many these are.
    inks: Vec<(Want, u32)>,
    places: HashMap<Want, u32, BuildHasherDefault<WantHasher>>,
    /// The passes in the order in which they are written, then where each begins.
    turns: Vec<u32>,
    starts: Vec<u32>,
    /// The stretches in that order.
    order: Vec<u32>,
}

impl Passes {
    /// Puts the stretches in the order of their inks, those of an ink from the top left on.
    fn sort(&mut self, stretches: &mut [CellRun], ink: TerminalInk) {
        self.find(stretches);
        for row in stretches.chunk_by_mut(|one, other| one.y == other.y) {
            self.place_others(row);
        }
        self.take_turns(ink);
        self.starts.clear();
        self.starts.resize(self.inks.len(), 0);
        let mut start = 0;
        for &pass in &self.turns {
            self.starts[pass as usize] = start;
            start += self.inks[pass as usize].1;
        }
        self.order.clear();
        self.order.resize(stretches.len(), 0);
        for (i, stretch) in (0..).zip(stretches.iter()) {
            let start = &mut self.starts[stretch.pass as usize];
            self.order[*start as usize] = i;
            *start += 1;
        }
    }

    /// Finds the passes of the stretches that only one ink suits.
    fn find(&mut self, stretches: &mut [CellRun]) {
        self.inks.clear();
        self.places.clear();
        for stretch in stretches.iter_mut().filter(|s| s.want.is_settled()) {
            let new = self.inks.len() as u32;
            stretch.pass = *self.places.entry(stretch.want).or_insert(new);
            if stretch.pass == new {
                self.inks.push((stretch.want, 0));
            }
            self.inks[stretch.pass as usize].1 += 1;
        }
    }

    /// Gives what several inks can write to the nearest that can in its row, else to any.
    fn place_others(&mut self, row: &mut [CellRun]) {
        for i in 0..row.len() {
            let stretch = row[i];
            if stretch.want.is_settled() {
                continue;
            }
            let fits = |want: Want| want.and(stretch.want).is_some();
            let is_one = |s: &&CellRun| s.want.is_settled() && fits(s.want);
            let before = row[..i].iter().rev().find(is_one);
            let after = row[i + 1..].iter().find(is_one);
            let gap_before = before.map_or(u16::MAX, |s| stretch.from - s.to);
            let gap_after = after.map_or(u16::MAX, |s| s.from - stretch.to);
            let beside = if gap_before <= gap_after {
                before
            } else {
                after
            };
            let any = || self.inks.iter().position(|&(want, _)| fits(want));
            let place = beside.map(|s| s.pass).or_else(|| any().map(|i| i as u32));
            let pass = place.unwrap_or(self.inks.len() as u32);
            if pass as usize == self.inks.len() {
                self.inks.push((stretch.want, 0));
            }
            self.inks[pass as usize].1 += 1;
            row[i].pass = pass;
        }
    }

    /// From ink to ink, each time to one that has most in common with the last.
    fn take_turns(&mut self, mut ink: TerminalInk) {
        self.turns.clear();
        self.turns.extend(0..self.inks.len() as u32);
        for done in 0..self.turns.len() {
            let mut best = (u8::MAX, done);
            for (i, &pass) in self.turns.iter().enumerate().skip(done) {
                let distance = ink.distance(self.inks[pass as usize].0);
                best = best.min((distance, i));
                if distance <= ONE_COLOR {
                    break;
                }
            }
            self.turns.swap(done, best.1);
            ink = ink.after(self.inks[self.turns[done] as usize].0);
        }
    }
}

/// Hashes colours and modifiers: a product for each number.
#[derive(Debug, Default)]
struct WantHasher(u64);

impl Hasher for WantHasher {
    fn write(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            self.write_u64(byte.into());
        }
    }

    fn write_u8(&mut self, n: u8) {
        self.write_u64(n.into());
    }

    fn write_u16(&mut self, n: u16) {
        self.write_u64(n.into());
    }

    fn write_u32(&mut self, n: u32) {
        self.write_u64(n.into());
    }

    fn write_usize(&mut self, n: usize) {
        self.write_u64(n as u64);
    }

    fn write_isize(&mut self, n: isize) {
        self.write_u64(n as u64);
    }

    fn write_u64(&mut self, n: u64) {
        self.0 = (self.0.rotate_left(5) ^ n).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    }

    fn finish(&self) -> u64 {
        self.0 ^ self.0 >> 32
    }
}

impl TerminalState {
    /// Paints a stretch.
    fn paint(&mut self, stretch: &CellRun, page: WantedCells, out: &mut Vec<u8>) {
        let area = page.buffer.area;
        self.go(Position::new(stretch.from, stretch.y), Some(page), out);
        let row = usize::from(stretch.y - area.y) * usize::from(area.width);
        let mut x = stretch.from;
        while x < stretch.to.min(area.right()) {
            let cell = &page.buffer.content[row + usize::from(x - area.x)];
            let Some((symbol, want)) = CellLook::of(cell, page.limits).written() else {
                break;
            };
            self.change(want, out);
            out.extend_from_slice(symbol.as_bytes());
            x += width(symbol);
        }
        // At the end the cursor stays on the last column, or is past it: terminals differ.
        self.at = (x < area.right()).then_some(Position::new(x, stretch.y));
    }

    /// Makes the ink what is wanted: by what differs, or from nothing.
    fn change(&mut self, want: Want, out: &mut Vec<u8>) {
        let after = self.ink.after(want);
        if self.ink == after {
            return;
        }
        let mut best = Sequence::default();
        best.select(self.ink, after);
        // An empty first parameter is the reset.
        let mut anew = Sequence::default();
        if after != TerminalInk::default() {
            anew.push(b";");
            anew.select(TerminalInk::default(), after);
        }
        if anew.length < best.length {
            best = anew;
        }
        self.ink = after;
        out.extend_from_slice(b"\x1b[");
        out.extend_from_slice(best.bytes());
        out.push(b'm');
    }

    /// Moves to a cell; what is between may be written again, if it is on this page.
    fn go(&mut self, to: Position, page: Option<WantedCells>, out: &mut Vec<u8>) {
        if self.at == Some(to) {
            return;
        }
        let mut best = Sequence::default();
        best.jump(to);
        if let Some(at) = self.at {
            best.keep_shorter(|sequence| sequence.step(at, to));
            if let Some(page) = page {
                best.keep_shorter(|sequence| sequence.write_again(self.ink, at, to, page));
            }
        }
        out.extend_from_slice(best.bytes());
        self.at = Some(to);
    }
}

/// Some bytes for the terminal: the parameters of the longest selection fit.
#[derive(Debug, Clone, Copy)]
struct Sequence {
    bytes: [u8; 96],
    length: usize,
}

impl Default for Sequence {
    fn default() -> Self {
        Self {
            bytes: [0; 96],
            length: 0,
        }
    }
}

impl Sequence {
    fn bytes(&self) -> &[u8] {
        &self.bytes[..self.length]
    }

    fn push(&mut self, bytes: &[u8]) {
        self.bytes[self.length..][..bytes.len()].copy_from_slice(bytes);
        self.length += bytes.len();
    }

    fn push_number(&mut self, n: u16) {
        let digits = n.checked_ilog10().unwrap_or(0) + 1;
        for i in (0..digits).rev() {
            self.push(&[b'0' + (n / 10_u16.pow(i) % 10) as u8]);
        }
    }

    /// Takes another way to the same if there is one and it is shorter.
    fn keep_shorter(&mut self, way: impl FnOnce(&mut Self) -> Option<()>) {
        let mut other = Self::default();
        if way(&mut other).is_some() && other.length < self.length {
            *self = other;
        }
    }

    fn jump(&mut self, to: Position) {
        self.push(b"\x1b[");
        self.push_number(to.y + 1);
        if to.x > 0 {
            self.push(b";");
            self.push_number(to.x + 1);
        }
        self.push(b"H");
    }

    /// Down by line feeds, then along the row; none where neither is a step of that kind.
    fn step(&mut self, at: Position, to: Position) -> Option<()> {
        let down = to.y.checked_sub(at.y).filter(|&n| n < 8)?;
        self.push(&b"\n\n\n\n\n\n\n\n"[..down.into()]);
        let mut along = Self::default();
        if to.x >= at.x {
            along.steps(to.x - at.x, b'C');
        } else {
            let back = at.x - to.x;
            along.steps(back, b'D');
            along.keep_shorter(|sequence| {
                sequence.push(b"\r");
                sequence.steps(to.x, b'C');
                Some(())
            });
            along.keep_shorter(|sequence| {
                let backspaces: &[u8] = b"\x08\x08\x08\x08";
                sequence.push(backspaces.get(..back.into())?);
                Some(())
            });
        }
        self.push(along.bytes());
        Some(())
    }

    fn steps(&mut self, n: u16, last: u8) {
        if n > 0 {
            self.push(b"\x1b[");
            if n > 1 {
                self.push_number(n);
            }
            self.push(&[last]);
        }
    }

    /// The cells from here to there once more, if the ink suits them.
    fn write_again(
        &mut self,
        ink: TerminalInk,
        at: Position,
        to: Position,
        page: WantedCells,
    ) -> Option<()> {
        let area = page.buffer.area;
        let row = usize::from(at.y.checked_sub(area.y)?);
        let is_near = at.y == to.y && at.x <= to.x && to.x - at.x <= MOST_AGAIN;
        if !is_near || at.x < area.x || page.wide_rows.get(row).copied()? {
            return None;
        }
        let start = row * usize::from(area.width);
        let [from, to] = [at.x, to.x].map(|x| start + usize::from(x - area.x));
        for cell in &page.buffer.content[from..to] {
            let (symbol, want) = CellLook::of(cell, page.limits).written()?;
            if !ink.suits(want) || symbol.len() > LONGEST_AGAIN {
                return None;
            }
            self.push(symbol.as_bytes());
        }
        Some(())
    }
}

/// A jump takes no more bytes than this many cells.
const MOST_AGAIN: u16 = 12;
/// So many bytes of a cell are worth writing again.
const LONGEST_AGAIN: usize = 8;

impl Sequence {
    /// The parameters that select `after` where `before` is selected.
    fn select(&mut self, before: TerminalInk, after: TerminalInk) {
        let mut had = before.modifier;
        for (modifiers, off) in [
            (Modifier::BOLD | Modifier::DIM, 22),
            (Modifier::ITALIC, 23),
            (Modifier::UNDERLINED, 24),
            (Modifier::REVERSED, 27),
            (Modifier::CROSSED_OUT, 29),
        ] {
            if (had - after.modifier).intersects(modifiers) {
                self.add(off);
                had -= modifiers;
            }
        }
        for (modifier, on) in [
            (Modifier::BOLD, 1),
            (Modifier::DIM, 2),
            (Modifier::ITALIC, 3),
            (Modifier::UNDERLINED, 4),
            (Modifier::REVERSED, 7),
            (Modifier::CROSSED_OUT, 9),
        ] {
            if (after.modifier - had).contains(modifier) {
                self.add(on);
            }
        }
        if before.fg != after.fg {
            self.color(after.fg, 30);
        }
        if before.bg != after.bg {
            self.color(after.bg, 40);
        }
    }

    /// One more parameter.
    fn add(&mut self, parameter: u16) {
        if !matches!(self.bytes(), [] | [.., b';']) {
            self.push(b";");
        }
        self.push_number(parameter);
    }

    /// The parameters of a colour of the ground that starts at `base`: 30 or 40.
    fn color(&mut self, color: Color, base: u16) {
        let named = |color: Color| NAMED.iter().position(|&named| named == color);
        match color {
            Color::Reset => self.add(base + 9),
            Color::Indexed(i @ 0..16) => self.basic(i.into(), base),
            Color::Indexed(i) => {
                for parameter in [base + 8, 5, i.into()] {
                    self.add(parameter);
                }
            }
            Color::Rgb(r, g, b) => {
                for parameter in [base + 8, 2, r.into(), g.into(), b.into()] {
                    self.add(parameter);
                }
            }
            color => self.basic(named(color).unwrap_or(0) as u16, base),
        }
    }

    fn basic(&mut self, i: u16, base: u16) {
        self.add(if i < 8 { base + i } else { base + 60 + i - 8 });
    }
}

/// The sixteen colours that have names, in the order of their numbers.
const NAMED: [Color; 16] = [
    Color::Black,
    Color::Red,
    Color::Green,
    Color::Yellow,
    Color::Blue,
    Color::Magenta,
    Color::Cyan,
    Color::Gray,
    Color::DarkGray,
    Color::LightRed,
    Color::LightGreen,
    Color::LightYellow,
    Color::LightBlue,
    Color::LightMagenta,
    Color::LightCyan,
    Color::White,
];
