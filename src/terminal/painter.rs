//! From a buffer of cells to the bytes that bring a terminal from what it shows to that.
//!
//! ratatui's own backend for crossterm writes a cursor position for each run of changed cells and
//! both colours wherever one changes. Over a slow link bytes are time, so this one writes the
//! cheapest that shows the same cells: no colour that does not show, the shortest way to the next
//! cell, the cells of a short gap again rather than a jump over it; and row by row or ink by ink,
//! whichever takes less. `rayscope bench --frames --explorer SCENE` has both beside each other: less than half the
//! bytes in about the same time. Once it has room it takes no memory.

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
    /// Draws everything again with the next frame.
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

/// The characters to write for a cell, and what they want of the pen. Two cells of which both are the same look the same:
/// what does not show is left open.
fn written(cell: &Cell, limits: Limits) -> (&str, Want) {
    let symbol = symbol(cell, limits);
    let color = |color: Color| {
        if limits.colorless {
            Color::Reset
        } else {
            color
        }
    };
    let is_blank = symbol == " " && !cell.modifier.intersects(SEEN_ON_BLANKS);
    let want = Want {
        fg: (!is_blank).then_some(color(cell.fg)),
        bg: Some(color(cell.bg)),
        modifier: if is_blank {
            Modifier::empty()
        } else {
            cell.modifier
        },
        touches: if is_blank {
            SEEN_ON_BLANKS
        } else {
            Modifier::all()
        },
    };
    (symbol, want)
}

/// Whether two cells are the same, without a call for the text of a usual cell.
fn is_same(one: &Cell, other: &Cell) -> bool {
    one.fg == other.fg
        && one.bg == other.bg
        && one.modifier == other.modifier
        && match (one.symbol().as_bytes(), other.symbol().as_bytes()) {
            ([a], [b]) => a == b,
            (&[a, b, c], &[d, e, f]) => [a, b, c] == [d, e, f],
            (a, b) => a == b,
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

/// About how many bytes select a colour.
const fn color_length(color: Color) -> u8 {
    match color {
        Color::Indexed(16..=99) => 8,
        Color::Indexed(100..) => 9,
        Color::Rgb(..) => 15,
        _ => 3,
    }
}

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
        let color = |one, other| if one == other { 0 } else { color_length(other) };
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
            let differs = before.iter().zip(after).any(|(a, b)| !is_same(a, b));
            let is_wide =
                differs && find_in_row((before, after), (next.area.x, y), limits, &mut self.plain);
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
        self.passes.sort(&mut self.plain, pen.ink);
        let saved = self.passes.saved_by_ink(&self.plain, pen.ink);
        self.by_row.clear();
        let mut after_rows = pen;
        if saved < TOLD_APART {
            for stretch in &self.plain {
                after_rows.paint(stretch, page, &mut self.by_row);
            }
        }
        self.by_ink.clear();
        let mut after_passes = pen;
        if saved > -TOLD_APART {
            for &i in &self.passes.order {
                after_passes.paint(&self.plain[i as usize], page, &mut self.by_ink);
            }
        }
        let by_ink =
            saved >= TOLD_APART || saved > -TOLD_APART && self.by_ink.len() < self.by_row.len();
        out.extend_from_slice(if by_ink { &self.by_ink } else { &self.by_row });
        if by_ink { after_passes } else { after_rows }
    }
}

/// From this difference on, in bytes, the estimate decides which of two orders is written.
const TOLD_APART: i64 = 100;
/// About how many bytes it takes to go on elsewhere.
const WAY: i64 = 5;

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
        if covered_before == 0 && covered == 0 && is_same(before, after) {
            covered = width(symbol(after, limits)) - 1;
            covered_before = covered;
            is_wide |= covered > 0;
            continue;
        }
        let look = |cell, covered: &mut u16| {
            // The right half of the character before it.
            if *covered > 0 {
                *covered -= 1;
                return None;
            }
            let written = written(cell, limits);
            *covered = width(written.0) - 1;
            Some(written)
        };
        let (before, after) = (look(before, &mut covered_before), look(after, &mut covered));
        is_wide |= covered_before > 0 || covered > 0;
        let Some((symbol, want)) = after.filter(|_| before != after) else {
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
    /// About how many bytes it takes to change from ink to ink.
    changes: u32,
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

    /// About how many bytes fewer the stretches take ink by ink than row by row: fewer changes of ink, and more ways to go.
    fn saved_by_ink(&self, stretches: &[CellRun], mut ink: TerminalInk) -> i64 {
        let mut saved = -i64::from(self.changes);
        for stretch in stretches {
            saved += i64::from(ink.distance(stretch.want));
            ink = ink.after(stretch.want);
        }
        let beside = |two: &[CellRun]| (two[0].y, two[0].to) == (two[1].y, two[1].from);
        saved - WAY * stretches.windows(2).filter(|two| beside(two)).count() as i64
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
        self.changes = 0;
        self.turns.clear();
        self.turns.extend(0..self.inks.len() as u32);
        for done in 0..self.turns.len() {
            let mut best = (u8::MAX, done);
            for (i, &pass) in self.turns.iter().enumerate().skip(done).take(LOOKED_AT) {
                let distance = ink.distance(self.inks[pass as usize].0);
                best = best.min((distance, i));
            }
            self.changes += u32::from(best.0);
            self.turns.swap(done, best.1);
            ink = ink.after(self.inks[self.turns[done] as usize].0);
        }
    }
}

/// Among how many inks the next is sought: in true colours there can be thousands.
const LOOKED_AT: usize = 64;

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
        self.change(stretch.want, out);
        let row = usize::from(stretch.y - area.y) * usize::from(area.width);
        let mut x = stretch.from;
        while x < stretch.to.min(area.right()) {
            let cell = &page.buffer.content[row + usize::from(x - area.x)];
            let symbol = symbol(cell, page.limits);
            push_symbol(symbol, out);
            x += width(symbol);
        }
        // At the end the cursor stays on the last column, or is past it: terminals differ.
        self.at = (x < area.right()).then_some(Position::new(x, stretch.y));
    }

    /// Makes the ink what is wanted: by what differs, or from nothing, whichever is shorter.
    fn change(&mut self, want: Want, out: &mut Vec<u8>) {
        let after = self.ink.after(want);
        if self.ink == after {
            return;
        }
        out.extend_from_slice(b"\x1b[");
        let start = out.len();
        select(self.ink, after, out);
        let length = out.len() - start;
        // What was selected has to be undone, or is most of what is to be: only then the other way can be shorter.
        if self.ink.modifier != after.modifier
            || after.fg == Color::Reset
            || after.bg == Color::Reset
        {
            // An empty first parameter is the reset.
            if after != TerminalInk::default() {
                out.push(b';');
                select(TerminalInk::default(), after, out);
            }
            if out.len() - start < 2 * length {
                out.drain(start..start + length);
            } else {
                out.truncate(start + length);
            }
        }
        out.push(b'm');
        self.ink = after;
    }

    /// Moves to a cell; what is between may be written again, if it is on this page.
    fn go(&mut self, to: Position, page: Option<WantedCells>, out: &mut Vec<u8>) {
        if self.at == Some(to) {
            return;
        }
        let step = self.at.map(|at| Step::between(at, to));
        let shortest = step.map_or(u16::MAX, Step::length).min(jump_length(to));
        let written = self
            .at
            .zip(page)
            .is_some_and(|(at, page)| write_again(self.ink, (at, to), page, shortest.into(), out));
        if !written {
            match step.filter(|step| step.length() == shortest) {
                Some(step) => step.write(out),
                None => jump(to, out),
            }
        }
        self.at = Some(to);
    }
}

/// Appends the characters of a cell.
fn push_symbol(symbol: &str, out: &mut Vec<u8>) {
    match *symbol.as_bytes() {
        // Of a length that is known where this is compiled.
        [a] => out.push(a),
        [a, b, c] => out.extend_from_slice(&[a, b, c]),
        ref bytes => out.extend_from_slice(bytes),
    }
}

fn push_number(n: u16, out: &mut Vec<u8>) {
    let digit = |n: u16| b'0' + (n % 10) as u8;
    match n {
        0..10 => out.push(digit(n)),
        10..100 => out.extend_from_slice(&[digit(n / 10), digit(n)]),
        100..1000 => out.extend_from_slice(&[digit(n / 100), digit(n / 10), digit(n)]),
        _ => {
            push_number(n / 10, out);
            out.push(digit(n));
        }
    }
}

/// How many digits a number has.
const fn digits(n: u16) -> u16 {
    match n {
        0..10 => 1,
        10..100 => 2,
        100..1000 => 3,
        1000..10_000 => 4,
        _ => 5,
    }
}

fn jump(to: Position, out: &mut Vec<u8>) {
    out.extend_from_slice(b"\x1b[");
    push_number(to.y + 1, out);
    if to.x > 0 {
        out.push(b';');
        push_number(to.x + 1, out);
    }
    out.push(b'H');
}

const fn jump_length(to: Position) -> u16 {
    let column = if to.x > 0 { 1 + digits(to.x + 1) } else { 0 };
    3 + digits(to.y + 1) + column
}

/// To another row, then along it.
#[derive(Debug, Clone, Copy)]
struct Step {
    rows: Rows,
    along: Along,
}

/// The shortest way to another row.
#[derive(Debug, Clone, Copy)]
enum Rows {
    /// Down by line feeds, which keep the column.
    Down(u16),
    /// The row by its number, from 0.
    To(u16),
}

/// The shortest way along a row.
#[derive(Debug, Clone, Copy)]
enum Along {
    Forward(u16),
    Back(u16),
    Backspaces(u16),
    /// The column by its number, from 0.
    To(u16),
}

/// A column forward or back in one sequence.
const fn move_length(n: u16) -> u16 {
    match n {
        0 => 0,
        1 => 3,
        n => 3 + digits(n),
    }
}

impl Step {
    fn between(at: Position, to: Position) -> Self {
        let rows = match to.y.checked_sub(at.y) {
            Some(down @ 0..=3) => Rows::Down(down),
            _ => Rows::To(to.y),
        };
        let along = match to.x.checked_sub(at.x) {
            Some(forward) => Along::Forward(forward),
            None if at.x - to.x <= 4 => Along::Backspaces(at.x - to.x),
            None => Along::Back(at.x - to.x),
        };
        let along = if along.length() <= Along::To(to.x).length() {
            along
        } else {
            Along::To(to.x)
        };
        Self { rows, along }
    }

    const fn length(self) -> u16 {
        let rows = match self.rows {
            Rows::Down(n) => n,
            Rows::To(y) => 3 + digits(y + 1),
        };
        rows + self.along.length()
    }

    fn write(self, out: &mut Vec<u8>) {
        match self.rows {
            Rows::Down(n) => out.extend_from_slice(&b"\n\n\n"[..n.into()]),
            Rows::To(y) => {
                out.extend_from_slice(b"\x1b[");
                push_number(y + 1, out);
                out.push(b'd');
            }
        }
        let move_by = |n: u16, last: u8, out: &mut Vec<u8>| {
            if n > 0 {
                out.extend_from_slice(b"\x1b[");
                if n > 1 {
                    push_number(n, out);
                }
                out.push(last);
            }
        };
        match self.along {
            Along::Forward(n) => move_by(n, b'C', out),
            Along::Back(n) => move_by(n, b'D', out),
            Along::Backspaces(n) => out.extend_from_slice(&b"\x08\x08\x08\x08"[..n.into()]),
            Along::To(0) => out.push(b'\r'),
            Along::To(x) => move_by(x + 1, b'G', out),
        }
    }
}

impl Along {
    const fn length(self) -> u16 {
        match self {
            Self::Forward(n) | Self::Back(n) => move_length(n),
            Self::Backspaces(n) => n,
            Self::To(0) => 1,
            Self::To(x) => move_length(x + 1),
        }
    }
}

/// Writes the cells from here to there once more, if the ink suits them and that is shorter than `shortest`.
fn write_again(
    ink: TerminalInk,
    (at, to): (Position, Position),
    page: WantedCells,
    shortest: usize,
    out: &mut Vec<u8>,
) -> bool {
    let area = page.buffer.area;
    let is_near = at.y == to.y && at.x <= to.x && usize::from(to.x - at.x) < shortest;
    if !is_near || at.x < area.x || at.y < area.y {
        return false;
    }
    let row = usize::from(at.y - area.y);
    if page.wide_rows.get(row).copied() != Some(false) {
        return false;
    }
    let first = row * usize::from(area.width);
    let [from, to] = [at.x, to.x].map(|x| first + usize::from(x - area.x));
    let start = out.len();
    for cell in &page.buffer.content[from..to] {
        let (symbol, want) = written(cell, page.limits);
        if !ink.suits(want) || out.len() - start + symbol.len() >= shortest {
            out.truncate(start);
            return false;
        }
        push_symbol(symbol, out);
    }
    true
}

/// Each modifier, what selects it, and what takes it back. Bold and dim go together.
const OFF: [(Modifier, u16); 5] = [
    (Modifier::BOLD.union(Modifier::DIM), 22),
    (Modifier::ITALIC, 23),
    (Modifier::UNDERLINED, 24),
    (Modifier::REVERSED, 27),
    (Modifier::CROSSED_OUT, 29),
];
const ON: [(Modifier, u16); 6] = [
    (Modifier::BOLD, 1),
    (Modifier::DIM, 2),
    (Modifier::ITALIC, 3),
    (Modifier::UNDERLINED, 4),
    (Modifier::REVERSED, 7),
    (Modifier::CROSSED_OUT, 9),
];

/// Appends the parameters that select `after` where `before` is selected.
fn select(before: TerminalInk, after: TerminalInk, out: &mut Vec<u8>) {
    if before.modifier != after.modifier {
        let mut had = before.modifier;
        for (modifiers, off) in OFF {
            if (had - after.modifier).intersects(modifiers) {
                add(off, out);
                had -= modifiers;
            }
        }
        for (modifier, on) in ON {
            if (after.modifier - had).contains(modifier) {
                add(on, out);
            }
        }
    }
    if before.fg != after.fg {
        add_color(after.fg, 30, out);
    }
    if before.bg != after.bg {
        add_color(after.bg, 40, out);
    }
}

/// One more parameter.
fn add(parameter: u16, out: &mut Vec<u8>) {
    if !out.ends_with(b"[") && !out.ends_with(b";") {
        out.push(b';');
    }
    push_number(parameter, out);
}

/// The parameters of a colour of the ground that starts at `base`: 30 or 40.
fn add_color(color: Color, base: u16, out: &mut Vec<u8>) {
    let basic = |i: u16| if i < 8 { base + i } else { base + 60 + i - 8 };
    match color {
        Color::Reset => add(base + 9, out),
        Color::Indexed(i @ 0..16) => add(basic(i.into()), out),
        Color::Indexed(i) => {
            add(base + 8, out);
            out.extend_from_slice(b";5;");
            push_number(i.into(), out);
        }
        Color::Rgb(r, g, b) => {
            add(base + 8, out);
            out.extend_from_slice(b";2");
            for channel in [r, g, b] {
                out.push(b';');
                push_number(channel.into(), out);
            }
        }
        color => {
            let place = NAMED.iter().position(|&named| named == color);
            add(basic(place.unwrap_or(0) as u16), out);
        }
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
