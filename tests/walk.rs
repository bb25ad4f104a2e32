//! A long walk of random deeds: nothing panics or overflows, what the terminal shows after each deed
//! is what a full redraw shows, and undo leads back to the scene that was opened.
//!
//! `RAYSCOPE_WALK` is how many deeds there are, `RAYSCOPE_WALK_SECONDS` how long they may take,
//! `RAYSCOPE_WALK_SEED` where the random numbers start.

use std::fs;
use std::time::{Duration, Instant};

use ratatui::buffer::Buffer;
use ratatui::crossterm::event::{
    Event, KeyCode, KeyEvent, KeyModifiers, MouseButton, MouseEvent, MouseEventKind,
};
use ratatui::layout::{Position, Rect};
use rayscope::explorer::{Explorer, Options, Palette, Setting, Workplace};
use rayscope::random::Random;
use rayscope::render::{ColorDepth, Style, View};
use rayscope::scene::{Builtin, Scene, Source};
use rayscope::terminal::{Limits, Painter};
use rayscope::text::Glyphs;

#[path = "terminal/seen.rs"]
mod seen;

/// How many deeds one explorer lives through.
const LIFE: u64 = 60;

#[test]
fn a_walk_of_random_deeds_shows_what_a_full_redraw_shows_and_undo_leads_back() {
    let deeds = number("RAYSCOPE_WALK").unwrap_or(1500);
    let limit = Duration::from_secs(number("RAYSCOPE_WALK_SECONDS").unwrap_or(60));
    let first = number("RAYSCOPE_WALK_SEED").unwrap_or(1);
    let start = Instant::now();
    let mut longest = (Duration::ZERO, String::new());
    let mut done = 0;
    let mut seed = first;
    while done < deeds && start.elapsed() < limit {
        let mut walk = Walk::begins(seed);
        for _ in 0..LIFE {
            let deed = walk.deed();
            let before = Instant::now();
            walk.does(&deed);
            longest = longest.max((before.elapsed(), format!("{deed:?}, seed {seed}")));
            walk.holds(&deed);
            done += 1;
            if walk.explorer.ended().is_some() {
                break;
            }
        }
        walk.goes_back();
        seed += 1;
    }
    let (time, deed) = longest;
    println!(
        "{done} deeds from seed {first}; the longest: {time:.1?}, {deed}; {}",
        memory()
    );
}

/// What a person, a terminal or a file may do to an explorer.
#[derive(Debug, Clone)]
enum Deed {
    Key(KeyCode, KeyModifiers),
    Command(String),
    Paste(String),
    Click(u16, u16, MouseEventKind),
    Resize(u16, u16),
    /// Somebody else writes into the folder.
    File(&'static str, &'static str),
}

/// One explorer, its terminal, and what it began with.
struct Walk {
    seed: u64,
    random: Random,
    explorer: Explorer,
    folder: tempfile::TempDir,
    /// The scene it began with, until a file is opened: that one may bear the same name.
    opened: Option<Scene>,
    size: (u16, u16),
    painter: Painter,
    terminal: vt100::Parser,
}

impl Walk {
    fn begins(seed: u64) -> Self {
        let mut random = Random::new(seed);
        let builtin = pick(&mut random, &Builtin::ALL);
        let options = Options {
            palette: pick(&mut random, &Palette::ALL),
            depth: pick(&mut random, &ColorDepth::ALL),
            glyphs: pick(&mut random, &[Glyphs::Unicode, Glyphs::Ascii]),
            ..Options::default()
        };
        let source = Source::Builtin(builtin);
        let folder = tempfile::tempdir().expect("a folder");
        let mut explorer = Explorer::new(builtin.scene(), &source, options);
        let mut workplace = Workplace::within(folder.path());
        workplace.state = Some(folder.path().join("state"));
        explorer.work_in(workplace, &source);
        let settings = [
            Setting::Style(pick(&mut random, &Style::ALL)),
            Setting::View(pick(&mut random, &View::ALL)),
        ];
        explorer.set_out(&settings).expect("a place");
        Self {
            seed,
            random,
            explorer,
            folder,
            opened: Some(builtin.scene()),
            size: (80, 24),
            painter: Painter::default(),
            terminal: terminal(80, 24),
        }
    }

    fn deed(&mut self) -> Deed {
        let random = &mut self.random;
        match random.below(40) {
            0 => Deed::Resize(random.below(140) as u16, random.below(50) as u16),
            1 => Deed::Paste(pick(random, &PASTES).into()),
            2..5 => Deed::Command(pick(random, &COMMANDS).into()),
            5 => {
                let kinds = [
                    MouseEventKind::Down(MouseButton::Left),
                    MouseEventKind::ScrollUp,
                    MouseEventKind::ScrollDown,
                ];
                let (x, y) = (random.below(80) as u16, random.below(24) as u16);
                Deed::Click(x, y, pick(random, &kinds))
            }
            6 => {
                let (name, text) = pick(random, &FILES);
                Deed::File(name, text)
            }
            7..12 => Deed::Key(pick(random, &SPECIAL), KeyModifiers::NONE),
            12 => Deed::Key(
                KeyCode::Char(char::from(b'a' + random.below(26) as u8)),
                KeyModifiers::CONTROL,
            ),
            _ => Deed::Key(
                KeyCode::Char(char::from(b' ' + random.below(95) as u8)),
                KeyModifiers::NONE,
            ),
        }
    }

    fn does(&mut self, deed: &Deed) {
        match deed {
            Deed::Key(code, modifiers) => {
                self.press(*code, *modifiers);
            }
            Deed::Command(line) => {
                if line.starts_with("open") {
                    self.opened = None;
                }
                self.press(KeyCode::Esc, KeyModifiers::NONE);
                self.press(KeyCode::Char(':'), KeyModifiers::NONE);
                for c in line.chars() {
                    self.press(KeyCode::Char(c), KeyModifiers::NONE);
                }
                self.press(KeyCode::Enter, KeyModifiers::NONE);
            }
            Deed::Paste(text) => {
                self.explorer.update(&Event::Paste(text.clone()));
            }
            Deed::Click(column, row, kind) => {
                self.explorer.update(&Event::Mouse(MouseEvent {
                    kind: *kind,
                    column: *column,
                    row: *row,
                    modifiers: KeyModifiers::NONE,
                }));
            }
            Deed::Resize(cols, rows) => {
                self.size = (*cols, *rows);
                self.explorer.update(&Event::Resize(*cols, *rows));
                self.painter = Painter::default();
                self.terminal = terminal(*cols, *rows);
            }
            Deed::File(name, text) => {
                // A folder of that name may be there already.
                let _ = fs::write(self.folder.path().join(name), text);
            }
        }
        self.explorer.catch_up();
        self.explorer.take_request();
        let (cols, rows) = self.size;
        self.explorer.prepare(cols, rows);
    }

    fn press(&mut self, code: KeyCode, modifiers: KeyModifiers) {
        self.explorer
            .update(&Event::Key(KeyEvent::new(code, modifiers)));
    }

    /// What must hold after each deed.
    fn holds(&mut self, deed: &Deed) {
        let scene = self.explorer.scene();
        assert!(scene.camera.check().is_ok(), "{deed:?}, seed {}", self.seed);
        assert!(scene.bodies.iter().all(|b| b.sphere.radius >= 0.0));
        let (cols, rows) = self.size;
        if cols == 0 || rows == 0 {
            return;
        }
        let mut buffer = Buffer::empty(Rect::new(0, 0, cols, rows));
        let cursor = self.explorer.draw(&mut buffer);
        let limits = Limits::of(&self.explorer.options());
        paint(
            &mut self.painter,
            &mut self.terminal,
            &buffer,
            cursor,
            limits,
        );
        let mut fresh = terminal(cols, rows);
        paint(&mut Painter::default(), &mut fresh, &buffer, cursor, limits);
        let cells = |terminal: &vt100::Parser| seen::cells(terminal.screen());
        let (shown, wanted) = (cells(&self.terminal), cells(&fresh));
        assert!(
            shown == wanted,
            "after {deed:?}, seed {}: the screen is not what a full redraw shows",
            self.seed
        );
    }

    /// Undo leads back to the scene that was opened, if it is still that one.
    fn goes_back(&mut self) {
        let Some(opened) = self.opened.clone() else {
            return;
        };
        if self.explorer.ended().is_some() {
            return;
        }
        for _ in 0..3 {
            self.press(KeyCode::Esc, KeyModifiers::NONE);
        }
        let in_tour = |explorer: &Explorer| explorer.link().is_ok_and(|words| words[0] == "tour");
        if in_tour(&self.explorer) || self.explorer.scene().name != opened.name {
            return;
        }
        // A scene that is saved takes the file's name and loses sentences about its old numbers.
        let is_back = |explorer: &Explorer| {
            let scene = explorer.scene();
            (&scene.camera, &scene.bodies) == (&opened.camera, &opened.bodies)
        };
        for _ in 0..8 * LIFE {
            if is_back(&self.explorer) {
                return;
            }
            self.press(KeyCode::Char('u'), KeyModifiers::NONE);
        }
        assert!(
            is_back(&self.explorer),
            "undo does not lead back, seed {}",
            self.seed
        );
    }
}

fn terminal(cols: u16, rows: u16) -> vt100::Parser {
    let [cols, rows] = [cols, rows].map(|n| n.max(1).try_into().expect("a size"));
    vt100::Parser::new(rows, cols, 0)
}

fn paint(
    painter: &mut Painter,
    terminal: &mut vt100::Parser,
    buffer: &Buffer,
    cursor: Option<Position>,
    limits: Limits,
) {
    let mut next = buffer.clone();
    terminal.process(painter.paint(&mut next, cursor, limits));
}

const SPECIAL: [KeyCode; 14] = [
    KeyCode::Enter,
    KeyCode::Enter,
    KeyCode::Esc,
    KeyCode::Tab,
    KeyCode::BackTab,
    KeyCode::Backspace,
    KeyCode::Delete,
    KeyCode::Up,
    KeyCode::Down,
    KeyCode::Left,
    KeyCode::Right,
    KeyCode::PageUp,
    KeyCode::PageDown,
    KeyCode::F(1),
];

const PASTES: [&str; 5] = [
    "xxxx q\nq",
    "\u{1b}[31m\u{7}",
    "radius 3e38",
    "日本語 ² √",
    ":open trio",
];

const COMMANDS: [&str; 24] = [
    "method textbook",
    "method exact",
    "view lost",
    "style half",
    "panel dial",
    "dial distance 12",
    "dial offset 20",
    "compare haines",
    "set radius 3.4e38",
    "set position.z 1e20",
    "set up.x 0",
    "set radius 0",
    "stride 1e30",
    "cursor 0 0",
    "sphere 2",
    "t -1e300",
    "step 3",
    "tour 5",
    "aspect 4",
    "save-as a.toml",
    "append rows.csv",
    "copy rust",
    "open a.toml",
    "color never",
];

const FILES: [(&str, &str); 4] = [
    ("a.toml", "name = \"another\"\n[camera]\n"),
    ("a.toml", "\u{feff}not toml ["),
    ("rows.csv", "x,y\n1,2"),
    ("rows.csv", ""),
];

fn pick<T: Copy>(random: &mut Random, from: &[T]) -> T {
    from[random.below(from.len() as u64) as usize]
}

fn number(name: &str) -> Option<u64> {
    let text = std::env::var(name).ok()?;
    Some(text.parse().expect("a whole number"))
}

/// The most memory that this process has had, where the system says it.
fn memory() -> String {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    line.map_or("memory not known".into(), |most| {
        format!("memory at most {}", most.trim())
    })
}
