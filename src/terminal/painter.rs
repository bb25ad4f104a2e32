//! From a buffer of cells to the bytes that bring a terminal from what it shows to that.
//!
//! ratatui's own backend for crossterm writes a cursor position for each run of changed cells and
//! both colours wherever one changes. Over a slow link bytes are time, so this one writes the
//! cheapest that looks the same: a half block upside down if that spares a colour, a blank where
//! two halves are alike, the cells of a short gap again rather than a jump over it.

use ratatui::buffer::{Buffer, Cell};
use ratatui::layout::Position;
use ratatui::style::{Color, Modifier};
use unicode_width::UnicodeWidthStr;

use crate::explain::Glyphs;
use crate::explorer::Options;
use crate::render::ColorDepth;

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
        let mut pen = Pen {
            out: &mut self.out,
            limits,
            at: self.at,
            ink: self.ink,
        };
        for y in next.area.top()..next.area.bottom() {
            paint_row(&mut pen, &self.shown, next, y);
        }
        if let Some(position) = cursor {
            pen.go(position, &[]);
        }
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

/// What a cell looks like, whatever it is made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Look<'a> {
    /// An upper and a lower half, each of one colour.
    Halves(Paint, Paint),
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

/// The colour of half a cell. The terminal's own two colours are known by their names only.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Paint {
    Foreground,
    Background,
    Color(Color),
}

impl Paint {
    fn of_fg(color: Color) -> Self {
        match color {
            Color::Reset => Self::Foreground,
            color => Self::Color(color),
        }
    }

    fn of_bg(color: Color) -> Self {
        match color {
            Color::Reset => Self::Background,
            color => Self::Color(color),
        }
    }

    /// The colour to set for a foreground that looks like this, if there is one.
    const fn as_fg(self) -> Option<Color> {
        match self {
            Self::Foreground => Some(Color::Reset),
            Self::Background => None,
            Self::Color(color) => Some(color),
        }
    }

    const fn as_bg(self) -> Option<Color> {
        match self {
            Self::Foreground => None,
            Self::Background => Some(Color::Reset),
            Self::Color(color) => Some(color),
        }
    }
}

impl<'a> Look<'a> {
    fn of(cell: &'a Cell, limits: Limits) -> Self {
        let (mut fg, mut bg) = (cell.fg, cell.bg);
        if limits.colorless {
            (fg, bg) = (Color::Reset, Color::Reset);
        }
        let symbol = match cell.symbol() {
            "" => " ",
            symbol if limits.ascii && !symbol.is_ascii() => "?",
            symbol => symbol,
        };
        let modifier = cell.modifier;
        let halves = |upper, lower| Self::Halves(upper, lower);
        match symbol {
            " " if !modifier.intersects(SEEN_ON_BLANKS) => {
                halves(Paint::of_bg(bg), Paint::of_bg(bg))
            }
            "▀" if modifier.is_empty() => halves(Paint::of_fg(fg), Paint::of_bg(bg)),
            "▄" if modifier.is_empty() => halves(Paint::of_bg(bg), Paint::of_fg(fg)),
            "█" if modifier.is_empty() => halves(Paint::of_fg(fg), Paint::of_fg(fg)),
            _ => Self::Text {
                symbol,
                fg,
                bg,
                modifier,
            },
        }
    }

    /// The ways to write it: a character and what it wants of the pen.
    fn ways(self, limits: Limits) -> impl Iterator<Item = (&'a str, Want)> {
        let halves = |symbol, fg: Option<Option<Color>>, bg: Option<Option<Color>>| {
            // An outer none is a colour that does not show, an inner none one that can't be had.
            let fg = fg.map_or(Some(None), |c| c.map(Some))?;
            let bg = bg.map_or(Some(None), |c| c.map(Some))?;
            let touches = if symbol == " " {
                SEEN_ON_BLANKS
            } else {
                Modifier::all()
            };
            let modifier = Modifier::empty();
            Some((
                symbol,
                Want {
                    fg,
                    bg,
                    modifier,
                    touches,
                },
            ))
        };
        let ways = match self {
            Self::Covered => [None, None],
            Self::Text {
                symbol,
                fg,
                bg,
                modifier,
            } => {
                let want = Want {
                    fg: Some(fg),
                    bg: Some(bg),
                    modifier,
                    touches: Modifier::all(),
                };
                [Some((symbol, want)), None]
            }
            Self::Halves(upper, lower) if upper == lower => [
                halves(" ", None, Some(upper.as_bg())),
                halves("█", Some(upper.as_fg()), None).filter(|_| !limits.ascii),
            ],
            Self::Halves(upper, lower) => [
                halves("▀", Some(upper.as_fg()), Some(lower.as_bg())),
                halves("▄", Some(lower.as_fg()), Some(upper.as_bg())),
            ],
        };
        ways.into_iter().flatten()
    }
}

/// What a character wants the pen to be; what does not show on it is left open.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Want {
    fg: Option<Color>,
    bg: Option<Color>,
    modifier: Modifier,
    /// Which modifiers matter.
    touches: Modifier,
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

    fn after(self, want: Want) -> Self {
        Self {
            fg: want.fg.unwrap_or(self.fg),
            bg: want.bg.unwrap_or(self.bg),
            modifier: (self.modifier - want.touches) | (want.modifier & want.touches),
        }
    }
}

/// Writes at a place with an ink.
struct Pen<'a> {
    out: &'a mut Vec<u8>,
    limits: Limits,
    /// Where the terminal's cursor is, if that is known.
    at: Option<Position>,
    ink: Ink,
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

fn paint_row(pen: &mut Pen<'_>, shown: &Buffer, next: &Buffer, y: u16) {
    let row = |buffer: &Buffer| {
        let width = usize::from(buffer.area.width);
        let start = usize::from(y - buffer.area.y) * width;
        start..start + width
    };
    if shown.content[row(shown)] == next.content[row(next)] {
        return;
    }
    let before: Vec<_> = looks(shown, y, pen.limits).collect();
    let after: Vec<_> = looks(next, y, pen.limits).collect();
    for (i, look) in after.iter().enumerate() {
        if *look == before[i] || *look == Look::Covered {
            continue;
        }
        let place = Position::new(next.area.x + i as u16, y);
        pen.go(place, &after);
        pen.write(*look);
        if place.x + 1 == next.area.right() {
            // The cursor stays on the last column, or is past it: terminals differ.
            pen.at = None;
        }
    }
}

impl Pen<'_> {
    /// Writes a cell in the way that takes the fewest bytes.
    fn write(&mut self, look: Look<'_>) {
        let ways = look
            .ways(self.limits)
            .map(|(symbol, want)| (self.change(want), symbol, want));
        let Some((change, symbol, want)) = ways.min_by_key(|(c, s, _)| c.len() + s.len()) else {
            return;
        };
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
            let mut ways = look.ways(self.limits);
            let (symbol, _) = ways.find(|&(_, want)| self.ink.suits(want))?;
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
