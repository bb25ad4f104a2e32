//! What a key costs on the way to the terminal, in bytes of the real encoder. Bytes do not depend
//! on the machine: they are held here to budgets, and to the table of docs/terminal.md.

use std::fmt::Write as _;
use std::fs;

use ratatui::buffer::Buffer;
use ratatui::crossterm::event::{Event, KeyCode, KeyEvent, KeyModifiers};
use ratatui::layout::Rect;
use rayscope::explorer::{Explorer, Options, Setting};
use rayscope::render::{ColorDepth, Style};
use rayscope::scene::Scene;
use rayscope::terminal::{Limits, Painter};
use rayscope::text::Glyphs;

/// An explorer on a terminal of which only the line to it is looked at.
struct Wire {
    explorer: Explorer,
    painter: Painter,
    size: (u16, u16),
    /// The columns whose cells count; the others are left blank.
    columns: u16,
}

impl Wire {
    fn opens(size: (u16, u16), columns: u16, start: Start) -> Self {
        Self::opens_as(false, size, columns, start)
    }

    /// The same, with the picture drawn coarsely or not.
    fn opens_as(coarse: bool, size: (u16, u16), columns: u16, start: Start) -> Self {
        let (scene, source) = Scene::open("trio").expect("a scene");
        let mut explorer = Explorer::new(scene, &source, start.options);
        let style = Setting::Style(start.style);
        explorer.set_out(&[style]).expect("a place");
        explorer.set_coarse(coarse);
        let mut wire = Self {
            explorer,
            painter: Painter::default(),
            size,
            columns,
        };
        wire.draws();
        wire
    }

    /// How many bytes bring the screen up to date.
    fn draws(&mut self) -> usize {
        let (cols, rows) = self.size;
        let mut buffer = Buffer::empty(Rect::new(0, 0, cols, rows));
        self.explorer.prepare(cols, rows);
        let cursor = self.explorer.draw(&mut buffer);
        for y in 0..rows {
            for x in self.columns..cols {
                buffer[(x, y)].reset();
            }
        }
        let limits = Limits::of(&self.explorer.options());
        self.painter.paint(&mut buffer, cursor, limits).len()
    }

    /// How many bytes a key costs.
    fn presses(&mut self, code: KeyCode) -> usize {
        let event = Event::Key(KeyEvent::new(code, KeyModifiers::NONE));
        self.explorer.update(&event);
        self.draws()
    }
}

const SMALL: (u16, u16) = (80, 24);
const LARGE: (u16, u16) = (200, 60);

/// How the explorer opens.
#[derive(Clone, Copy)]
struct Start {
    style: Style,
    options: Options,
}

fn half() -> Start {
    Start {
        style: Style::Half,
        options: Options::default(),
    }
}

fn ascii() -> Start {
    Start {
        style: Style::Ascii,
        options: Options {
            depth: ColorDepth::None,
            glyphs: Glyphs::Ascii,
            ..Options::default()
        },
    }
}

/// How many columns the picture takes, with its border.
fn picture((cols, _): (u16, u16)) -> u16 {
    if cols == SMALL.0 { 42 } else { 142 }
}

/// The costs of all steps that the camera can take from where it opens, ascending.
fn camera_steps(coarse: bool, size: (u16, u16), columns: u16, start: Start) -> Vec<usize> {
    let keys = "adwsADWSeE+-".chars();
    let mut costs: Vec<_> = keys
        .map(|key| Wire::opens_as(coarse, size, columns, start).presses(KeyCode::Char(key)))
        .collect();
    costs.sort_unstable();
    costs
}

/// The dearest of them.
fn camera_step(size: (u16, u16), columns: u16, start: Start) -> usize {
    dearest(&camera_steps(false, size, columns, start))
}

fn dearest(ascending: &[usize]) -> usize {
    *ascending.last().expect("a key")
}

/// The cost of a step of the orbit, half of which cost less, on the way about the scene.
fn orbit_step(size: (u16, u16), columns: u16, start: Start) -> usize {
    let mut wire = Wire::opens(size, columns, start);
    let mut costs: Vec<_> = (0..12).map(|_| wire.presses(KeyCode::Char('d'))).collect();
    costs.sort_unstable();
    costs[costs.len() / 2]
}

/// The cost of a cursor step, half of which cost less, on a walk over all three spheres.
fn cursor_step(size: (u16, u16), start: Start) -> usize {
    let mut wire = Wire::opens(size, size.0, start);
    let walk = [KeyCode::Right, KeyCode::Down, KeyCode::Left, KeyCode::Left];
    let mut costs: Vec<_> = (0..36).map(|i| wire.presses(walk[i / 3 % 4])).collect();
    costs.sort_unstable();
    costs[costs.len() / 2]
}

#[test]
fn a_step_keeps_to_its_budget() {
    for (what, size, start, budget) in [
        ("half blocks", SMALL, half(), 2500),
        ("ASCII", SMALL, ascii(), 1100),
        ("half blocks", LARGE, half(), 9000),
    ] {
        for bytes in [
            camera_step(size, size.0, start),
            orbit_step(size, size.0, start),
        ] {
            assert!(bytes <= budget, "{what} at {size:?}: {bytes} bytes");
        }
    }
    // While the link can't keep up the panels fit in, too.
    let costs = camera_steps(true, LARGE, LARGE.0, ascii());
    let median = costs[costs.len() / 2];
    assert!(median <= 2300, "coarse ASCII at {LARGE:?}: {median} bytes");
    // Else the panels that a large screen has room for come on top of it; the table has both.
    let bytes = orbit_step(LARGE, picture(LARGE), ascii());
    assert!(
        bytes <= 2300,
        "the picture in ASCII at {LARGE:?}: {bytes} bytes"
    );
    for start in [half(), ascii()] {
        let bytes = cursor_step(SMALL, start);
        // 0.3 KB of 1024 bytes.
        assert!(bytes <= 307, "a cursor step: {bytes} bytes");
    }
}

#[test]
fn what_changes_nothing_sends_nothing() {
    for size in [SMALL, LARGE] {
        let mut wire = Wire::opens(size, size.0, half());
        assert_eq!(wire.draws(), 0);
        wire.presses(KeyCode::Char('d'));
        assert_eq!(wire.draws(), 0);
    }
}

#[test]
fn the_table_of_the_docs_is_what_the_encoder_writes() {
    let mut table = String::from(
        "| style | colours | 80×24: camera | coarse | its picture | cursor | 200×60: camera | coarse | its picture | cursor |\n\
         |---|---|--:|--:|--:|--:|--:|--:|--:|--:|\n",
    );
    for style in Style::ALL {
        for depth in ColorDepth::ALL.into_iter().rev() {
            let options = Options {
                depth,
                ..Options::default()
            };
            let start = Start { style, options };
            // Writing to a string does not fail.
            let _ = write!(table, "| {} | {} |", style.name(), depth.name());
            for size in [SMALL, LARGE] {
                let _ = write!(
                    table,
                    " {} | {} | {} | {} |",
                    camera_step(size, size.0, start),
                    dearest(&camera_steps(true, size, size.0, start)),
                    camera_step(size, picture(size), start),
                    cursor_step(size, start),
                );
            }
            table.push('\n');
        }
    }
    hold_to_docs("docs/terminal.md", "bytes", &table);
}

/// What stands between the marks `NAME` and `end of NAME` of a page is `text`.
fn hold_to_docs(page: &str, name: &str, text: &str) {
    let path = format!("{}/{page}", env!("CARGO_MANIFEST_DIR"));
    let whole = fs::read_to_string(&path).expect("the page");
    let marks = [
        format!("<!-- {name} -->\n"),
        format!("<!-- end of {name} -->"),
    ];
    let (before, rest) = whole.split_once(&marks[0]).expect("the first mark");
    let (found, after) = rest.split_once(&marks[1]).expect("the last mark");
    if std::env::var_os("RAYSCOPE_UPDATE_DOCS").is_some() {
        let fresh = format!("{before}{}{text}{}{after}", marks[0], marks[1]);
        fs::write(path, fresh).expect("the page written");
    } else {
        assert_eq!(
            found, text,
            "RAYSCOPE_UPDATE_DOCS=1 cargo test rewrites {page}"
        );
    }
}
