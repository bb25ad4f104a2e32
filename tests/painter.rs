//! What a terminal shows after the painter's bytes is what is in the buffer.

use proptest::prelude::*;
use ratatui::buffer::Buffer;
use ratatui::crossterm::event::{Event, KeyCode, KeyEvent, KeyModifiers};
use ratatui::layout::{Position, Rect};
use ratatui::style::{Color, Modifier, Style};
use rayscope::explorer::{Explorer, Options, Palette};
use rayscope::render::ColorDepth;
use rayscope::scene::Scene;
use rayscope::terminal::{Limits, Painter};
use rayscope::text::Glyphs;

#[path = "terminal/seen.rs"]
mod seen;

use seen::Seen;

/// A terminal, and who paints on it.
struct Easel {
    painter: Painter,
    terminal: vt100::Parser,
    limits: Limits,
}

impl Easel {
    fn new(cols: u16, rows: u16, limits: Limits) -> Self {
        let [cols, rows] = [cols, rows].map(|n| n.try_into().expect("a size"));
        let mut terminal = vt100::Parser::new(rows, cols, 0);
        terminal.process("whatever was there\x1b[1;31;44m".as_bytes());
        Self {
            painter: Painter::default(),
            terminal,
            limits,
        }
    }

    /// Paints, and compares cell by cell; how many bytes it took.
    fn shows(&mut self, buffer: &Buffer, cursor: Option<Position>) -> usize {
        let mut next = buffer.clone();
        let bytes = self.painter.paint(&mut next, cursor, self.limits);
        self.terminal.process(bytes);
        let screen = self.terminal.screen();
        for (y, row) in seen::cells(screen).into_iter().enumerate() {
            for (x, cell) in row.into_iter().enumerate() {
                let wide_half = screen
                    .cell(y as u16, x as u16)
                    .is_some_and(vt100::Cell::is_wide_continuation);
                if !wide_half {
                    let wanted = wanted(buffer, x as u16, y as u16, self.limits);
                    assert_eq!(cell, wanted, "at {x}, {y}");
                }
            }
        }
        assert_eq!(screen.hide_cursor(), cursor.is_none());
        if let Some(at) = cursor {
            assert_eq!(screen.cursor_position(), (at.y, at.x));
        }
        bytes.len()
    }
}

/// The sixteen, in the order of their numbers.
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

fn wanted(buffer: &Buffer, x: u16, y: u16, limits: Limits) -> Seen {
    let cell = &buffer[(x, y)];
    let color = |color| match color {
        _ if limits.colorless => vt100::Color::Default,
        Color::Reset => vt100::Color::Default,
        Color::Indexed(i) => vt100::Color::Idx(i),
        Color::Rgb(r, g, b) => vt100::Color::Rgb(r, g, b),
        named => {
            let at = NAMED.iter().position(|&n| n == named);
            vt100::Color::Idx(at.expect("a colour") as u8)
        }
    };
    let style =
        [Modifier::BOLD, Modifier::DIM, Modifier::REVERSED].map(|m| cell.modifier.contains(m));
    let symbol = match cell.symbol() {
        symbol if limits.ascii && !symbol.is_ascii() => "?",
        symbol => symbol,
    };
    Seen::new(symbol, color(cell.fg), color(cell.bg), style)
}

fn style() -> impl Strategy<Value = Style> {
    let color = || {
        prop_oneof![
            4 => Just(Color::Reset),
            1 => Just(Color::Cyan),
            1 => Just(Color::LightRed),
            2 => (16u8..20).prop_map(Color::Indexed),
            1 => (0u8..3).prop_map(|v| Color::Rgb(v, 200, v)),
        ]
    };
    let modifier = prop_oneof![
        6 => Just(Modifier::empty()),
        1 => Just(Modifier::BOLD),
        1 => Just(Modifier::DIM),
        1 => Just(Modifier::REVERSED),
        1 => Just(Modifier::BOLD | Modifier::REVERSED),
    ];
    (color(), color(), modifier)
        .prop_map(|(fg, bg, m)| Style::reset().fg(fg).bg(bg).add_modifier(m))
}

/// Strokes of cells: where, what, how often.
fn strokes() -> impl Strategy<Value = Vec<(u16, u16, &'static str, usize, Style)>> {
    let symbol = prop_oneof![
        Just("▀"),
        Just("▄"),
        Just("█"),
        Just(" "),
        Just("a"),
        Just("Δ"),
        Just("漢"),
        Just("─"),
    ];
    let stroke = (0u16..30, 0u16..6, symbol, 1usize..12, style());
    prop::collection::vec(stroke, 0..30)
}

proptest! {
    #[test]
    fn any_picture_after_any_other_is_what_the_terminal_shows(
        frames in prop::collection::vec(
            (strokes(), prop::option::of((0u16..30, 0u16..6))), 1..6,
        ),
        colorless: bool,
        ascii: bool,
    ) {
        let mut easel = Easel::new(30, 6, Limits { colorless, ascii });
        let mut buffer = Buffer::empty(Rect::new(0, 0, 30, 6));
        for (strokes, cursor) in frames {
            for (x, y, symbol, n, style) in strokes {
                buffer.set_stringn(x, y, symbol.repeat(n), usize::from(30 - x), style);
            }
            let cursor = cursor.map(|(x, y)| Position::new(x, y));
            easel.shows(&buffer, cursor);
            prop_assert_eq!(easel.shows(&buffer, cursor), 0, "nothing changed");
        }
    }
}

#[test]
fn the_explorers_screen_is_what_the_terminal_shows_cell_by_cell() {
    for depth in ColorDepth::ALL {
        for (palette, glyphs) in [
            (Palette::Dark, Glyphs::Unicode),
            (Palette::Light, Glyphs::Ascii),
            (Palette::HighContrast, Glyphs::Unicode),
        ] {
            let options = Options {
                depth,
                palette,
                glyphs,
                ..Options::default()
            };
            let (scene, source) = Scene::open("trio").expect("a scene");
            let mut explorer = Explorer::new(scene, &source, options);
            let mut easel = Easel::new(100, 30, Limits::of(&options));
            for key in "d2lbv.wb3Gv?x".chars() {
                let key = KeyEvent::new(KeyCode::Char(key), KeyModifiers::NONE);
                explorer.update(&Event::Key(key));
                let mut buffer = Buffer::empty(Rect::new(0, 0, 100, 30));
                explorer.prepare(100, 30);
                let cursor = explorer.draw(&mut buffer);
                easel.shows(&buffer, cursor);
            }
        }
    }
}

#[test]
fn what_does_not_show_costs_nothing() {
    let mut easel = Easel::new(30, 1, Limits::default());
    let mut buffer = Buffer::empty(Rect::new(0, 0, 30, 1));
    easel.shows(&buffer, None);
    let [red, blue] = [160, 20].map(Color::Indexed);
    buffer.set_string(0, 0, "▀", Style::new().fg(red).bg(blue));
    buffer.set_string(1, 0, "  ", Style::new().bg(blue));
    buffer.set_string(3, 0, "▀", Style::new().fg(red).bg(blue));
    let frame = "\x1b[?2026h\x1b[1H\x1b[38;5;160;48;5;20m▀  ▀\x1b[?2026l";
    assert_eq!(easel.shows(&buffer, None), frame.len());
}
