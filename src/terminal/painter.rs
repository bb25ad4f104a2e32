//! From a buffer of cells to the bytes that bring a terminal from what it shows to that.
//!
//! ratatui's own backend for crossterm writes a cursor position for each run of changed cells and
//! both colours wherever one changes. Over a slow link bytes are time, so this one writes the
//! cheapest that shows the same cells: no colour that does not show, the shortest way to the next
//! cell, the cells of a short gap again rather than a jump over it; and row by row or ink by ink,
//! whichever takes less.

use std::collections::HashMap;

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
    /// Where the terminal's cursor is, if that is known, and how the terminal writes.
    at: Option<Position>,
    ink: Ink,
    out: Vec<u8>,
}

impl Default for Painter {
    /// A painter of a terminal that shows nobody knows what.
    fn default() -> Self {
        Self {
            shown: Buffer::default(),
            lost: true,
            limits: Limits::default(),
            cursor_visible: true,
            at: None,
            ink: Ink::default(),
            out: Vec::new(),
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
            (self.at, self.ink) = (None, Ink::default());
        }
        let rows: Vec<_> = changed_rows(&self.shown, next, limits).collect();
        let start_of_rows = Pen {
            out: Vec::new(),
            at: self.at,
            ink: self.ink,
        };
        let mut pen = start_of_rows.shortest(&rows);
        if let Some(position) = cursor {
            pen.go(position, &[]);
        }
        self.out.extend_from_slice(&pen.out);
        (self.at, self.ink) = (pen.at, pen.ink);
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

/// What a cell looks like. Two that look the same are the same: what does not show is left at its
/// default.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Look<'a> {
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

impl<'a> Look<'a> {
    fn of(cell: &'a Cell, limits: Limits) -> Self {
        let symbol = match cell.symbol() {
            "" => " ",
            symbol if limits.ascii && !symbol.is_ascii() => "?",
            symbol => symbol,
        };
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

/// How the terminal writes now.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
struct Ink {
    fg: Color,
    bg: Color,
    modifier: Modifier,
}

impl Ink {
    fn suits(self, want: Want) -> bool {
        self.after(want) == self
    }

    /// About how many bytes the way to that ink takes.
    fn distance(self, want: Want) -> u8 {
        let after = self.after(want);
        let color = |one, other| if one == other { 0 } else { 8 };
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

/// Writes at a place with an ink.
#[derive(Debug, Clone)]
struct Pen {
    out: Vec<u8>,
    /// Where the terminal's cursor is, if that is known.
    at: Option<Position>,
    ink: Ink,
}

/// A row of which something changed: where it starts, and how it looked and looks.
struct Row<'a> {
    start: Position,
    before: Vec<Look<'a>>,
    after: Vec<Look<'a>>,
}

fn changed_rows<'a>(
    shown: &'a Buffer,
    next: &'a Buffer,
    limits: Limits,
) -> impl Iterator<Item = Row<'a>> {
    let width = usize::from(next.area.width);
    let cells = move |buffer: &'a Buffer, i: usize| &buffer.content[i * width..(i + 1) * width];
    let rows = (next.area.top()..next.area.bottom()).enumerate();
    let changed = rows.filter(move |&(i, _)| cells(shown, i) != cells(next, i));
    changed.map(move |(_, y)| Row {
        start: Position::new(next.area.x, y),
        before: looks(shown, y, limits).collect(),
        after: looks(next, y, limits).collect(),
    })
}

/// Looks at a row from the left, with the right halves of wide characters told apart.
fn looks(buffer: &Buffer, y: u16, limits: Limits) -> impl Iterator<Item = Look<'_>> {
    let mut covered = 0;
    let area = buffer.area;
    (area.left()..area.right()).map(move |x| {
        if covered > 0 {
            covered -= 1;
            return Look::Covered;
        }
        let look = Look::of(&buffer[(x, y)], limits);
        if let Look::Text { symbol, .. } = look {
            covered = symbol.width().saturating_sub(1);
        }
        look
    })
}

/// Changed cells beside each other that one ink can write.
#[derive(Debug, Clone, Copy)]
struct Stretch {
    /// Index of the row.
    row: usize,
    /// The first column, and the one after the last.
    from: usize,
    to: usize,
    want: Want,
}

/// The changed cells of all rows in stretches, from the top left on.
fn stretches(rows: &[Row<'_>]) -> Vec<Stretch> {
    let mut out: Vec<Stretch> = Vec::new();
    for (row, looks) in rows.iter().enumerate() {
        let pairs = looks.before.iter().zip(&looks.after).enumerate();
        for (x, (_, look)) in pairs.filter(|(_, (before, after))| before != after) {
            let Some((symbol, want)) = look.written() else {
                continue;
            };
            let to = x + symbol.width().max(1);
            let last = out
                .last_mut()
                .filter(|last| last.row == row && last.to == x);
            match last.and_then(|last| Some((last.want.and(want)?, last))) {
                Some((both, last)) => (last.to, last.want) = (to, both),
                None => out.push(Stretch {
                    row,
                    from: x,
                    to,
                    want,
                }),
            }
        }
    }
    out
}

/// The stretches in the order of their inks, those of an ink from the top left on. What several inks
/// can write goes with the nearest in its row, else with any.
fn by_ink(stretches: &[Stretch], mut ink: Ink) -> Vec<Stretch> {
    let mut passes: Vec<(Want, Vec<Stretch>)> = Vec::new();
    let mut places: HashMap<Want, usize> = HashMap::new();
    for stretch in stretches.iter().filter(|s| s.want.is_settled()) {
        let place = *places.entry(stretch.want).or_insert(passes.len());
        if place == passes.len() {
            passes.push((stretch.want, Vec::new()));
        }
        passes[place].1.push(*stretch);
    }
    for row in stretches.chunk_by(|one, other| one.row == other.row) {
        for stretch in row.iter().filter(|s| !s.want.is_settled()) {
            let fits = |want: Want| want.and(stretch.want).is_some();
            let gap = |s: &&Stretch| (s.from.abs_diff(stretch.to)).min(s.to.abs_diff(stretch.from));
            let beside = row.iter().filter(|s| s.want.is_settled() && fits(s.want));
            let near = beside.min_by_key(gap).and_then(|s| places.get(&s.want));
            let any = || passes.iter().position(|&(want, _)| fits(want));
            match near.copied().or_else(any) {
                Some(place) => passes[place].1.push(*stretch),
                None => passes.push((stretch.want, vec![*stretch])),
            }
        }
    }
    let mut out = Vec::with_capacity(stretches.len());
    while let Some(next) = (0..passes.len()).min_by_key(|&i| ink.distance(passes[i].0)) {
        let (want, mut pass) = passes.swap_remove(next);
        pass.sort_unstable_by_key(|s| (s.row, s.from));
        out.extend(pass);
        ink = ink.after(want);
    }
    out
}

impl Pen {
    /// This pen once all that changed is painted, in the cheaper of two orders: row by row, or ink by
    /// ink.
    fn shortest(self, rows: &[Row<'_>]) -> Self {
        let (plain, wide): (Vec<_>, Vec<_>) = stretches(rows).into_iter().partition(|stretch| {
            let Row { before, after, .. } = &rows[stretch.row];
            !before
                .iter()
                .chain(after)
                .any(|look| *look == Look::Covered)
        });
        let mut start = self;
        // Of two halves of a wide character none is written without the other.
        start.paint(&wide, rows);
        let mut by_row = start.clone();
        by_row.paint(&plain, rows);
        let mut by_pass = start;
        by_pass.paint(&by_ink(&plain, by_pass.ink), rows);
        if by_pass.out.len() < by_row.out.len() {
            by_pass
        } else {
            by_row
        }
    }

    /// Paints stretches in this order.
    fn paint(&mut self, stretches: &[Stretch], rows: &[Row<'_>]) {
        for stretch in stretches {
            let row = &rows[stretch.row];
            let end = row.start.x + row.after.len() as u16;
            self.go(
                Position::new(row.start.x + stretch.from as u16, row.start.y),
                &row.after,
            );
            for look in &row.after[stretch.from..stretch.to.min(row.after.len())] {
                self.write(*look);
            }
            if self.at.is_some_and(|at| at.x >= end) {
                // The cursor stays on the last column, or is past it: terminals differ.
                self.at = None;
            }
        }
    }

    /// Writes a cell.
    fn write(&mut self, look: Look<'_>) {
        let Some((symbol, want)) = look.written() else {
            return;
        };
        let change = self.change(want);
        self.out.extend_from_slice(&change);
        self.ink = self.ink.after(want);
        self.out.extend_from_slice(symbol.as_bytes());
        if let Some(at) = &mut self.at {
            at.x += symbol.width().max(1) as u16;
        }
    }

    /// The sequence that makes the ink what is wanted: by what differs, or from nothing.
    fn change(&self, want: Want) -> Vec<u8> {
        if self.ink.suits(want) {
            return Vec::new();
        }
        let after = self.ink.after(want);
        let step = select(self.ink, after);
        let mut anew = select(Ink::default(), after);
        if !anew.is_empty() {
            // An empty first parameter is the reset.
            anew.insert(0, b';');
        }
        let shorter = if anew.len() < step.len() { anew } else { step };
        [b"\x1b[", shorter.as_slice(), b"m"].concat()
    }

    /// Moves to a cell of which `row` holds the looks; what is between may be written again.
    fn go(&mut self, to: Position, row: &[Look<'_>]) {
        if self.at == Some(to) {
            return;
        }
        let mut best = absolute(to);
        if let Some(at) = self.at {
            for way in [relative(at, to), self.again(at, to, row)] {
                if let Some(way) = way.filter(|w| w.len() < best.len()) {
                    best = way;
                }
            }
        }
        self.out.extend_from_slice(&best);
        self.at = Some(to);
    }

    /// The cells from here to there once more, if the ink suits them.
    fn again(&self, at: Position, to: Position, row: &[Look<'_>]) -> Option<Vec<u8>> {
        if at.y != to.y || at.x > to.x || usize::from(to.x) > row.len() {
            return None;
        }
        let mut bytes = Vec::new();
        for look in &row[usize::from(at.x)..usize::from(to.x)] {
            let (symbol, _) = look.written().filter(|&(_, want)| self.ink.suits(want))?;
            bytes.extend_from_slice(symbol.as_bytes());
        }
        Some(bytes)
    }
}

fn absolute(to: Position) -> Vec<u8> {
    let (row, column) = (to.y + 1, to.x + 1);
    if column == 1 {
        format!("\x1b[{row}H").into()
    } else {
        format!("\x1b[{row};{column}H").into()
    }
}

/// Down by line feeds, then along the row; none where neither is a step of that kind.
fn relative(at: Position, to: Position) -> Option<Vec<u8>> {
    let down = to.y.checked_sub(at.y).filter(|&n| n < 8)?;
    let mut bytes = vec![b'\n'; down.into()];
    let steps = |n: u16, last: char| match n {
        0 => String::new(),
        1 => format!("\x1b[{last}"),
        n => format!("\x1b[{n}{last}"),
    };
    let along = if to.x >= at.x {
        steps(to.x - at.x, 'C')
    } else {
        let back = at.x - to.x;
        let by_backspace = "\x08".repeat(back.min(4).into());
        let by_return = "\r".to_owned() + &steps(to.x, 'C');
        let mut ways = vec![steps(back, 'D'), by_return];
        if back <= 4 {
            ways.push(by_backspace);
        }
        ways.into_iter().min_by_key(String::len)?
    };
    bytes.extend_from_slice(along.as_bytes());
    Some(bytes)
}

/// The parameters that select `after` where `before` is selected.
fn select(before: Ink, after: Ink) -> Vec<u8> {
    let mut out = Vec::new();
    let mut add = |parameter: &str| {
        if !out.is_empty() {
            out.push(b';');
        }
        out.extend_from_slice(parameter.as_bytes());
    };
    let mut had = before.modifier;
    for (modifiers, off) in [
        (Modifier::BOLD | Modifier::DIM, "22"),
        (Modifier::ITALIC, "23"),
        (Modifier::UNDERLINED, "24"),
        (Modifier::REVERSED, "27"),
        (Modifier::CROSSED_OUT, "29"),
    ] {
        if (had - after.modifier).intersects(modifiers) {
            add(off);
            had -= modifiers;
        }
    }
    for (modifier, on) in [
        (Modifier::BOLD, "1"),
        (Modifier::DIM, "2"),
        (Modifier::ITALIC, "3"),
        (Modifier::UNDERLINED, "4"),
        (Modifier::REVERSED, "7"),
        (Modifier::CROSSED_OUT, "9"),
    ] {
        if (after.modifier - had).contains(modifier) {
            add(on);
        }
    }
    if before.fg != after.fg {
        add(&color(after.fg, 30));
    }
    if before.bg != after.bg {
        add(&color(after.bg, 40));
    }
    out
}

/// The parameters of a colour of the ground that starts at `base`: 30 or 40.
fn color(color: Color, base: u8) -> String {
    let basic = |i: u8| match i {
        0..8 => (base + i).to_string(),
        _ => (base + 60 + i - 8).to_string(),
    };
    match color {
        Color::Reset => (base + 9).to_string(),
        Color::Black => basic(0),
        Color::Red => basic(1),
        Color::Green => basic(2),
        Color::Yellow => basic(3),
        Color::Blue => basic(4),
        Color::Magenta => basic(5),
        Color::Cyan => basic(6),
        Color::Gray => basic(7),
        Color::DarkGray => basic(8),
        Color::LightRed => basic(9),
        Color::LightGreen => basic(10),
        Color::LightYellow => basic(11),
        Color::LightBlue => basic(12),
        Color::LightMagenta => basic(13),
        Color::LightCyan => basic(14),
        Color::White => basic(15),
        Color::Indexed(i @ 0..16) => basic(i),
        Color::Indexed(i) => format!("{};5;{i}", base + 8),
        Color::Rgb(r, g, b) => format!("{};2;{r};{g};{b}", base + 8),
    }
}
