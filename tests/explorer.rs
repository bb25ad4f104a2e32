//! The explorer as a person drives it: keys in, screens out, no terminal.

use std::fs;
use std::os::unix::fs::symlink;
use std::path::PathBuf;
use std::sync::mpsc::{Receiver, channel};
use std::time::Duration;

use proptest::prelude::*;
use ratatui::buffer::Buffer;
use ratatui::crossterm::event::{
    Event, KeyCode, KeyEvent, KeyModifiers, MouseButton, MouseEvent, MouseEventKind,
};
use ratatui::layout::Rect;
use ratatui::style::Color;
use rayscope::explain::{Digits, number};
use rayscope::explorer::action::{Action, Column, markdown};
use rayscope::explorer::{Explorer, Options, Request, Setting, Workplace};
use rayscope::geometry::Ray;
use rayscope::lab::{BenchQueue, HEADER};
use rayscope::method::{Class, Method, Precision};
use rayscope::render::{ColorDepth, Style};
use rayscope::scene::{Builtin, PixelShape, Rays, Scene, Size};
use rayscope::system::Waker;
use rayscope::text::Glyphs;
use tempfile::TempDir;

/// An explorer with a screen, and with a folder out of which nothing that is typed leads.
struct Person {
    explorer: Explorer,
    size: (u16, u16),
    folder: TempDir,
    queue: BenchQueue,
}

impl Person {
    fn opens(name: &str, cols: u16, rows: u16) -> Self {
        Self::with(name, cols, rows, textbook())
    }

    fn with(name: &str, cols: u16, rows: u16, start: Start) -> Self {
        let (scene, source) = Scene::open(name).expect("a scene");
        let folder = tempfile::tempdir().expect("a folder");
        let workplace = Workplace::within(folder.path());
        let queue = workplace.queue.clone();
        let mut explorer = Explorer::new(scene, &source, start.options);
        explorer.work_in(workplace, &source);
        let mut person = Self {
            explorer,
            size: (cols, rows),
            folder,
            queue,
        };
        person.explorer.set_out(&start.settings()).expect("a place");
        person.screen();
        person
    }

    /// A file of their folder.
    fn file(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// Presses keys by name, as in `right tab X ctrl-s`, and looks at the screen after each.
    fn presses(&mut self, keys: &str) -> &mut Self {
        for key in keys.split_whitespace() {
            self.explorer.update(&key_event(key));
            self.screen();
        }
        self
    }

    fn types(&mut self, text: &str) -> &mut Self {
        for c in text.chars() {
            let key = KeyEvent::new(KeyCode::Char(c), KeyModifiers::NONE);
            self.explorer.update(&Event::Key(key));
        }
        self
    }

    /// Types a command after `:`.
    fn commands(&mut self, line: &str) -> &mut Self {
        self.presses("esc :").types(line).presses("enter")
    }

    /// The characters on the screen.
    fn screen(&mut self) -> String {
        let (cols, rows) = self.size;
        let mut buffer = Buffer::empty(Rect::new(0, 0, cols, rows));
        self.explorer.prepare(cols, rows);
        self.explorer.draw(&mut buffer);
        let line = |y| -> String { (0..cols).map(|x| buffer[(x, y)].symbol()).collect() };
        (0..rows)
            .map(|y| line(y).trim_end().to_owned() + "\n")
            .collect()
    }

    fn shows(&mut self, text: &str) {
        let screen = self.screen();
        assert!(screen.contains(text), "no “{text}” on\n{screen}");
    }
}

/// How a person's explorer opens.
#[derive(Clone, Copy, Default)]
struct Start {
    method: Method,
    style: Option<Style>,
    options: Options,
}

impl Start {
    fn settings(self) -> Vec<Setting> {
        let style = self.style.map(Setting::Style);
        [Setting::Method(self.method)]
            .into_iter()
            .chain(style)
            .collect()
    }
}

fn textbook() -> Start {
    Start {
        method: Method::Textbook,
        ..Start::default()
    }
}

fn key_event(name: &str) -> Event {
    let mut modifiers = KeyModifiers::NONE;
    let mut rest = name;
    if let Some(after) = rest.strip_prefix("ctrl-") {
        (modifiers, rest) = (KeyModifiers::CONTROL, after);
    } else if let Some(after) = rest.strip_prefix("shift-") {
        (modifiers, rest) = (KeyModifiers::SHIFT, after);
    }
    let code = match rest {
        "left" => KeyCode::Left,
        "right" => KeyCode::Right,
        "up" => KeyCode::Up,
        "down" => KeyCode::Down,
        "home" => KeyCode::Home,
        "pageup" => KeyCode::PageUp,
        "pagedown" => KeyCode::PageDown,
        "tab" => KeyCode::Tab,
        "backtab" => KeyCode::BackTab,
        "enter" => KeyCode::Enter,
        "esc" => KeyCode::Esc,
        "space" => KeyCode::Char(' '),
        "backspace" => KeyCode::Backspace,
        "delete" => KeyCode::Delete,
        "f1" => KeyCode::F(1),
        one => KeyCode::Char(one.chars().next().expect("a key")),
    };
    Event::Key(KeyEvent::new(code, modifiers))
}

#[test]
fn the_tutorials_pixel_shows_its_numbers() {
    let mut person = Person::opens("tutorial", 80, 24);
    for text in [
        "pixel (20, 20)",
        "A = d·d = 0² + 0² + 1² = 1",
        "= 2·(−20) = −40",
        "= 400 − 100 = 300",
        "= 1600 − 1200 = 400",
        "Δ > 0: it meets in two points",
        "near = (−B − √Δ) / 2A = 10",
        "far = (−B + √Δ) / 2A = 30",
    ] {
        person.shows(text);
    }
    person.presses("L");
    for text in [
        "A    d·d            →  1",
        "B    2 d·(p0−c)     → −40",
        "C    |p0−c|² − r²   →  300",
        "Δ    B² − 4AC       →  400",
        "secant",
        "near (−B−√Δ)/2A     →  10",
    ] {
        person.shows(text);
    }
}

#[test]
fn screens_at_80_by_24_100_by_30_and_160_by_50() {
    for (cols, rows) in [(80, 24), (100, 30), (160, 50)] {
        for scene in ["tutorial", "trio"] {
            let screen = Person::opens(scene, cols, rows).screen();
            insta::assert_snapshot!(format!("{scene}_{cols}x{rows}"), screen);
            let steps = Person::opens(scene, cols, rows)
                .presses("enter . . . . . . . .")
                .screen();
            insta::assert_snapshot!(format!("{scene}_steps_{cols}x{rows}"), steps);
        }
    }
    insta::assert_snapshot!(
        "help_80x24",
        Person::opens("tutorial", 80, 24).presses("?").screen()
    );
    insta::assert_snapshot!(
        "form_80x24",
        Person::opens("trio", 80, 24).presses("=").screen()
    );
    insta::assert_snapshot!("narrow_40x24", Person::opens("tutorial", 40, 24).screen());
    insta::assert_snapshot!("strip_30x10", Person::opens("tutorial", 30, 10).screen());
    insta::assert_snapshot!("small_19x5", Person::opens("tutorial", 19, 5).screen());
}

#[test]
fn a_screen_in_ascii_has_no_byte_above_127() {
    let options = Options {
        glyphs: rayscope::text::Glyphs::Ascii,
        depth: ColorDepth::None,
        ..Options::default()
    };
    for scene in ["tutorial", "trio"] {
        let start = Start {
            options,
            ..textbook()
        };
        let mut person = Person::with(scene, 80, 24, start);
        for keys in ["", "?", "esc =", "esc :", "esc b", "b", "b v", "v"] {
            let screen = person.presses(keys).screen();
            assert!(screen.is_ascii(), "after {keys}:\n{screen}");
        }
    }
}

#[test]
fn in_ascii_no_step_is_cut_off_and_columns_stay_columns() {
    let start = Start {
        method: Method::Double,
        style: Some(Style::Ascii),
        options: Options {
            glyphs: Glyphs::Ascii,
            ..Options::default()
        },
    };
    let mut person = Person::with("far", 80, 24, start);
    person.commands("lens machine");
    let column = |person: &mut Person, row: &str| {
        let screen = person.screen();
        let line = screen
            .lines()
            .find(|line| line.contains(row))
            .expect(row)
            .to_owned();
        line.find(row).expect(row) + row.len()
    };
    assert_eq!(
        column(&mut person, "| C    |p0-c|^2 - r^2 -> "),
        column(&mut person, "| disc B^2 - 4AC      -> ")
    );
    person.presses("2 P");
    for _ in 0..27 {
        let screen = person.screen();
        let panel = screen
            .lines()
            .skip(1)
            .filter_map(|line| line.split("||").nth(1));
        for line in panel {
            assert!(
                !line.trim_end_matches([' ', '|']).ends_with(".."),
                "{screen}"
            );
        }
        person.presses("enter enter");
    }
}

#[test]
fn the_cursor_moves_and_stops_at_the_edge() {
    let mut person = Person::opens("tutorial", 80, 24);
    person.presses("left k shift-down shift-right");
    assert_eq!(person.explorer.cursor(), (27, 27));
    person.presses("shift-left shift-left shift-left shift-left shift-left");
    assert_eq!(person.explorer.cursor(), (0, 27));
    person.commands("cursor 26 28").shows("Δ = 0");
    assert_eq!(person.explorer.cursor(), (26, 28));
    person
        .commands("cursor 40 0")
        .shows("expected a pixel of 40×40");
}

#[test]
fn the_opening_scene_slides_by_its_first_camera_keys_and_keeps_its_numbers_whole() {
    for size in [(80, 24), (100, 30), (160, 50)] {
        let mut person = Person::opens("opening", size.0, size.1);
        for key in ["a", "d", "w", "s", "+"] {
            let before = person.screen();
            person.presses(key);
            assert_ne!(person.screen(), before, "{key}");
            let reading = person.explorer.reading().expect("a reading");
            assert_eq!(reading.ray.direction.to_array(), [0.0, 0.0, 1.0], "{key}");
            let start = reading.ray.origin.to_array();
            assert!(
                start.map(|x| x.fract() == 0.0) == [true; 3],
                "{key}: {start:?}"
            );
        }
        person.presses("A");
        let turned = person.explorer.reading().expect("a reading").ray.direction;
        assert_ne!(turned.to_array(), [0.0, 0.0, 1.0], "shift orbits");
    }
}

#[test]
fn snapping_finds_the_nearest_tangent_pixel() {
    let mut person = Person::opens("tutorial", 80, 24);
    person.commands("cursor 33 20").presses("t");
    assert_eq!(person.explorer.cursor(), (30, 20));
    person.shows("Δ = 0: it touches in one point");
}

#[test]
fn making_a_pixel_tangent_sets_the_radius_for_which_the_discriminant_is_zero() {
    let mut person = Person::opens("tutorial", 80, 24);
    person.commands("cursor 23 24").presses("T");
    assert_eq!(person.explorer.scene().bodies[0].sphere.radius, 5.0);
    person.shows("Δ = 0");
}

#[test]
fn every_change_can_be_undone_and_done_again() {
    let mut person = Person::opens("trio", 80, 24);
    let before = person.explorer.scene().clone();
    person
        .presses("x Y z g G w a s d W A e E + -")
        .commands("look-at");
    person
        .presses("tab x i")
        .commands("duplicate")
        .presses("delete ] T");
    person.commands("set radius 0.75");
    let after = person.explorer.scene().clone();
    assert_ne!(before, after);
    for _ in 0..40 {
        person.presses("u");
    }
    assert_eq!(*person.explorer.scene(), before);
    assert!(!person.explorer.is_changed());
    for _ in 0..40 {
        person.presses("U");
    }
    assert_eq!(*person.explorer.scene(), after);
    person.commands("reset");
    assert_eq!(*person.explorer.scene(), before);
    person.presses("u");
    assert_eq!(*person.explorer.scene(), after);
}

#[test]
fn a_number_is_typed_over_or_edited() {
    let radius = |person: &Person| person.explorer.scene().bodies[0].sphere.radius;
    let mut person = Person::opens("tutorial", 80, 24);
    person
        .presses("= down down down enter")
        .shows("type over it");
    person.types("7").shows("take it");
    person.presses("enter");
    assert_eq!(radius(&person), 7.0);
    person.presses("up enter left").types("2").presses("enter");
    assert_eq!(radius(&person), 27.0);
    person.presses("up enter backspace enter");
    assert_eq!(radius(&person), 2.0);
    person.presses("up enter esc");
    assert_eq!(radius(&person), 2.0, "left as it was");
    person.presses("enter").types("0x1.8p1").presses("enter");
    assert_eq!(radius(&person), 3.0);
    person.presses("up").types("0x18").presses("enter");
    person.shows("expected a finite number");
}

#[test]
fn the_moving_point_goes_from_landmark_to_landmark() {
    let mut person = Person::opens("tutorial", 80, 24);
    person.presses("3").shows("p at t = 10");
    for (key, said) in [
        ("*", "3 of 4: t = 20, closest to the centre."),
        ("*", "4 of 4: t = 30, out of the sphere."),
        ("*", "1 of 4: t = 0, p0, the start of the ray."),
        ("_", "4 of 4: t = 30, out of the sphere."),
        (") _", "4 of 4: t = 30, out of the sphere."),
        ("( *", "4 of 4: t = 30, out of the sphere."),
    ] {
        person.presses(key).shows(said);
    }
    person.presses("4 _ _").shows("p at t = 10: f = 0");
    // What is seen there is where f is 0 but for the last bit, and the caption says why.
    let mut person = Person::opens("trio", 80, 24);
    person.commands("lens machine");
    person.presses("4").shows("not 0: the root by textbook is");
    person.presses("*").shows("p at t ≈ 7.67807: f = 0");
    person.presses("/").commands("lens mathematics");
    person.shows("not 0: this t is the root");
    person.presses("_ *").shows("p at t ≈ 7.67807: f = 0");
}

#[test]
fn errors_side_by_side_have_one_unit() {
    let mut person = Person::opens("trio", 120, 40);
    person
        .commands("method textbook")
        .commands("compare double");
    person.shows("ulp: gap to the next binary32");
    person.shows("ulp64: gap to the next binary64");
    let screen = person.screen();
    let line = screen.lines().find(|l| l.contains("ulp64")).unwrap();
    assert!(line.contains("= "), "{line}");
    for line in screen.lines().filter(|l| l.contains(" ulp ")) {
        // Of two methods in different precisions both errors are in the same unit.
        let errors = line.matches(" ulp ").count() + line.matches("exact ").count();
        assert!(errors >= 2, "{line}");
    }
    // Where there is no room the bits go, and never a part of them.
    let mut person = Person::opens("far", 80, 24);
    person
        .commands("method textbook")
        .commands("compare double");
    person.shows("ulp: gap to the next binary32");
    let bits = |l: &&str| l.contains(" 0 01") || l.contains(" 1 10");
    let screen = person.screen();
    assert_eq!(screen.lines().filter(bits).count() % 2, 0, "{screen}");
}

#[test]
fn a_typed_number_is_held_to_what_a_scene_file_may_say() {
    let mut person = Person::opens("tutorial", 80, 24);
    person
        .presses("= down down down")
        .types("-3")
        .presses("enter");
    person.shows("radius is -3: expected a radius of zero or more");
    assert_eq!(person.explorer.scene().bodies[0].sphere.radius, 10.0);
    person.presses("ctrl-u").types("0.1").presses("enter esc");
    assert_eq!(person.explorer.scene().bodies[0].sphere.radius, 0.1);
    person
        .commands("set up.z 1e39")
        .shows("expected a number within");
    person.commands("set look_at.z 0").shows("look_at");
    person
        .commands("set nonsense 1")
        .shows("expected one of center.x");
}

#[test]
fn it_does_not_matter_how_many_keys_come_before_a_drawing() {
    for keys in [
        "c T",
        "tab delete T space ;",
        "right down T",
        "b right shift-down",
        "d d t right t",
        "tab i T ; space",
        "enter . . d . > ,",
        "P enter . + . = esc",
    ] {
        let mut slow = Person::opens("trio", 80, 24);
        let mut fast = Person::opens("trio", 80, 24);
        slow.presses(keys);
        for key in keys.split_whitespace() {
            fast.explorer.update(&key_event(key));
        }
        fast.screen();
        assert_eq!(slow.explorer.scene(), fast.explorer.scene(), "{keys}");
        assert_eq!(slow.explorer.cursor(), fast.explorer.cursor(), "{keys}");
        assert_eq!(slow.screen(), fast.screen(), "{keys}");
    }
}

#[test]
fn colours_and_theme_change_by_a_key_and_help_says_why_they_are_so() {
    let mut person = Person::opens("trio", 80, 24);
    person
        .presses("? / c o l o u r s")
        .shows("# colours            256 (the usual)");
    person.presses("esc esc # ? / c o l o u r s");
    person.shows("24 bits (chosen here)");
    person.presses("esc esc @ ? / t h e m e");
    person.shows("light (chosen here)");
    person.presses("esc esc").commands("theme monochrome");
    person
        .commands("color 16")
        .shows("the theme monochrome uses none");
    let mut buffer = Buffer::empty(Rect::new(0, 0, 80, 24));
    person.explorer.prepare(80, 24);
    person.explorer.draw(&mut buffer);
    for cell in &buffer.content {
        assert_eq!((cell.fg, cell.bg), (Color::Reset, Color::Reset));
    }
    person
        .commands("theme pink")
        .shows("expected one of dark, light, high-contrast");
}

#[test]
fn the_mouse_is_heeded_once_it_is_asked_for() {
    let mouse = |kind, column, row| {
        let modifiers = KeyModifiers::NONE;
        Event::Mouse(MouseEvent {
            kind,
            column,
            row,
            modifiers,
        })
    };
    let click = |column, row| mouse(MouseEventKind::Down(MouseButton::Left), column, row);
    let mut person = Person::opens("tutorial", 80, 24);
    let before = person.explorer.cursor();
    assert!(!person.explorer.update(&click(1, 2)));
    assert_eq!(person.explorer.cursor(), before);

    person.presses("$");
    assert!(person.explorer.wants_mouse());
    assert!(
        person.explorer.update(&click(1, 2)),
        "the cell at the top left"
    );
    assert_eq!(person.explorer.cursor(), (0, 0));
    person.explorer.update(&click(31, 13));
    assert_eq!(person.explorer.cursor(), (30, 22));
    for outside in [(0, 0), (41, 5), (60, 10), (5, 23), (79, 23)] {
        person.explorer.update(&click(outside.0, outside.1));
        assert_eq!(
            person.explorer.cursor(),
            (30, 22),
            "{outside:?} is no pixel"
        );
    }
    let window = |person: &Person| person.explorer.scene().camera.projection;
    let seen = window(&person);
    person
        .explorer
        .update(&mouse(MouseEventKind::ScrollUp, 5, 5));
    assert_ne!(window(&person), seen);
    person.presses("u ?");
    person
        .explorer
        .update(&mouse(MouseEventKind::ScrollDown, 5, 5));
    assert_eq!(window(&person), seen, "the wheel scrolls the help page");
    person.presses("esc $");
    assert!(!person.explorer.wants_mouse());
}

#[test]
fn quitting_asks_only_if_something_would_be_lost() {
    let mut person = Person::opens("tutorial", 80, 24);
    person.presses("right q");
    assert_eq!(person.explorer.ended(), Some(0));

    let mut person = Person::opens("tutorial", 80, 24);
    person.presses("x q").shows("Unsaved changes");
    assert_eq!(person.explorer.ended(), None);
    person.presses("esc u q");
    assert_eq!(person.explorer.ended(), Some(0));

    let mut person = Person::opens("tutorial", 80, 24);
    person.presses("x q D");
    assert_eq!(person.explorer.ended(), Some(0));
    let mut person = Person::opens("tutorial", 80, 24);
    person.presses("ctrl-c");
    assert_eq!(person.explorer.ended(), Some(130));
}

#[test]
fn saving_never_overwrites_what_was_not_read() {
    let mut person = Person::opens("tutorial", 160, 24);
    let path = person.file("mine.toml");
    let name = path.to_str().unwrap();
    person.presses("x").commands("save-as mine.toml");
    person.shows("Saved");
    assert!(!person.explorer.is_changed());
    let (saved, _) = Scene::open(name).unwrap();
    assert_eq!(saved, *person.explorer.scene());

    fs::write(&path, "somebody else's").unwrap();
    person.presses("x ctrl-s").shows("has changed on disk");
    person.presses("esc");
    assert_eq!(fs::read_to_string(&path).unwrap(), "somebody else's");
    person.presses("ctrl-s o").shows("Saved");
    assert_eq!(Scene::open(name).unwrap().0, *person.explorer.scene());

    let mut other = Person::opens("trio", 160, 24);
    fs::copy(&path, other.file("mine.toml")).unwrap();
    other.commands("save-as mine.toml").shows("exists already");
    other.presses("esc");
    let kept = Scene::load(&other.file("mine.toml")).unwrap();
    assert_eq!(kept, *person.explorer.scene());
}

#[test]
fn who_saves_and_quits_has_quit_once_it_is_saved() {
    let mut person = Person::opens("trio", 160, 24);
    let path = person.file("mine.toml");
    person.presses("x").commands("save-as mine.toml");
    fs::write(&path, "somebody else's").unwrap();
    person.presses("u q s").shows("has changed on disk");
    person.presses("esc ctrl-s o").shows("Saved");
    assert_eq!(person.explorer.ended(), None, "esc gave up quitting");
    fs::write(&path, "somebody else's").unwrap();
    person.presses("x q s o");
    assert_eq!(person.explorer.ended(), Some(0));
    assert_eq!(Scene::load(&path).unwrap(), *person.explorer.scene());

    // A scene that has no file yet is given a name on the way.
    let mut person = Person::opens("trio", 160, 24);
    person.presses("x q s enter");
    assert_eq!(person.explorer.ended(), Some(0));
}

#[test]
fn what_an_author_says_of_a_pixel_has_the_numbers_of_the_scene_as_it_is() {
    let mut student = Person::opens("tutorial", 120, 40);
    student.presses("N").shows("A = 1, B = −40 and C = 300");
    student.presses("N").shows("just touches");
    student.presses("g N");
    student.shows("“a miss”, before the scene was changed; now: The discriminant is Δ = 0.");
    assert!(!student.screen().contains("has no real root"));
    let file = student.file("mine.toml");
    student.commands(&format!("save-as {}", file.display()));
    let saved = fs::read_to_string(file).expect("a file");
    assert!(
        saved.contains("name = \"mine\"") && saved.contains("{Δ}"),
        "{saved}"
    );
    assert!(
        !saved.contains("317") && !saved.contains("8 across"),
        "{saved}"
    );
    // While a person predicts, no number is shown.
    student.commands("open tutorial").presses("P N");
    assert!(!student.screen().contains("300"), "{}", student.screen());
}

#[test]
fn a_name_that_would_not_open_what_is_saved_is_refused() {
    let mut person = Person::opens("trio", 160, 24);
    person.presses("x").commands("save-as far");
    person.shows("this name opens a built-in scene, expected another, such as ./far");
    assert!(!person.file("far").exists());
    person.commands("save-as ./far").shows("Saved");
    let saved = person.explorer.scene().clone();
    person.commands("open ./far");
    assert_eq!(*person.explorer.scene(), saved);
}

#[test]
fn opening_asks_before_changes_are_lost_and_says_what_is_wrong() {
    let mut person = Person::opens("tutorial", 80, 24);
    person
        .presses("x")
        .commands("open trio")
        .shows("Unsaved changes");
    person.presses("esc");
    assert_eq!(person.explorer.scene().bodies.len(), 1);
    person.commands("open trio").presses("o");
    assert_eq!(person.explorer.scene().bodies.len(), 3);
    person
        .commands("open no-such-scene.toml")
        .shows("no-such-scene.toml");
    assert_eq!(person.explorer.scene().bodies.len(), 3);
}

#[test]
fn commands_complete_and_say_what_they_expected() {
    let mut person = Person::opens("tutorial", 80, 24);
    person.presses(":").types("cursor-l").presses("tab enter");
    assert_eq!(person.explorer.cursor(), (19, 20));
    person.presses(":").types("open tr").presses("tab enter");
    assert_eq!(person.explorer.scene().bodies.len(), 3);
    person.commands("method nonsense").shows("expected one of");
    person
        .presses("esc")
        .commands("frobnicate")
        .shows("no command");
}

#[test]
fn the_command_line_lists_what_a_word_could_mean() {
    let mut person = Person::opens("tutorial", 80, 24);
    person.presses(":").types("tangent");
    person.shows("cursor to the nearest pixel whose ray touches");
    person.shows("change the radius so that this ray touches");
    person.presses("down down enter").shows("r = 0");
    person
        .presses("esc :")
        .types("mthd")
        .shows("evaluate the quadratic with this method");
    person
        .presses("esc :")
        .types("method te")
        .presses("tab enter");
    assert_eq!(person.explorer.viewpoint().method, Method::Textbook);
    person.presses(":").types("cursor-l").presses("tab enter");
    assert_eq!(person.explorer.cursor(), (19, 20), "a name of former days");
    person
        .presses(":")
        .types("zzz")
        .presses("tab enter")
        .shows("no command");
}

#[test]
fn the_menu_has_every_action_and_does_what_is_chosen() {
    let mut person = Person::opens("tutorial", 80, 24);
    insta::assert_snapshot!("menu_80x24", person.presses("space").screen());
    for column in Column::ALL {
        person.shows(column.title());
        for row in column.rows() {
            person.shows(row[0].row());
        }
        let list = person.presses(&column.letter().to_string()).screen();
        for action in column.actions() {
            let line = format!(" {} {}", action.letter(), action.name());
            assert!(list.contains(&line), "no {line} in\n{list}");
            if !":?".contains(action.letter()) {
                let help: String = action.help().chars().take(40).collect();
                person.presses(&action.letter().to_string()).shows(&help);
            }
        }
        person.presses("esc");
    }
    person.presses("esc").shows("─ view 40×40");

    person.presses("space enter").shows("step ");
    person.presses("space n l enter").shows(" machine ");
    person.presses("f1 t enter").shows("touches the sphere");
    let before = person.explorer.scene().clone();
    person.presses("space b a");
    assert_eq!(*person.explorer.scene(), before, "a letter only chooses");
    person.presses("enter");
    assert_eq!(person.explorer.scene().bodies.len(), 2);

    let mut small = Person::opens("opening", 40, 12);
    insta::assert_snapshot!("menu_40x12", small.presses("space").screen());
    small.presses("b g enter");
    assert_eq!(small.explorer.scene().bodies[0].sphere.radius, 11.0);
}

#[test]
fn the_menu_takes_the_mouse_once_it_is_on_and_says_which() {
    let mut person = Person::opens("tutorial", 80, 24);
    person.presses("space").shows("mouse (off)    $");
    person.presses("esc $ space").shows("mouse (on)     $");
    let screen = person.screen();
    let (row, line) = screen
        .lines()
        .enumerate()
        .find(|(_, line)| line.contains("tangent        t"))
        .expect("a row");
    let column = line.chars().position(|c| c == 't').expect("a word");
    person.explorer.update(&Event::Mouse(MouseEvent {
        kind: MouseEventKind::Down(MouseButton::Left),
        column: column as u16,
        row: row as u16,
        modifiers: KeyModifiers::NONE,
    }));
    person.shows("touches the sphere");
}

#[test]
fn nothing_typed_into_help_menu_or_a_question_changes_the_scene() {
    let printable: String = (' '..='~').collect();
    let texts = [
        "grow the sphere",
        "tangent",
        "who is nearer? gg xyz",
        &printable,
    ];
    let places = [
        ("?", "esc"),
        ("? /", "esc esc"),
        ("space", "esc esc"),
        ("f1 b", "esc esc"),
        ("x q", "esc"),
    ];
    for (opens, closes) in places {
        for text in texts {
            let mut person = Person::opens("trio", 80, 24);
            person.presses(opens);
            let before = person.explorer.scene().clone();
            // What answers the question is no text that is typed into it.
            let answers: &[char] = if opens == "x q" { &['s', 'D'] } else { &[] };
            let text = text.replace(answers, "");
            for c in text.chars() {
                person.types(&c.to_string()).screen();
            }
            assert_eq!(*person.explorer.scene(), before, "{opens}: {text}");
            assert_eq!(person.explorer.ended(), None);
            person.presses(closes).presses("esc");
            assert_eq!(*person.explorer.scene(), before, "{opens}: {text}");
        }
    }
}

#[test]
fn a_line_of_the_help_is_found_and_done() {
    let mut person = Person::opens("tutorial", 80, 24);
    let whole = person.presses("?").screen();
    person.presses("/").types("tangent");
    let found = person.screen();
    assert!(!found.contains("orbit"), "{found}");
    person.shows("change the radius so that this ray touches");
    person.shows("2 lines");
    assert_eq!(person.presses("esc").screen(), whole, "esc clears first");
    person
        .presses("/")
        .types("nearest tangent")
        .presses("enter");
    person.shows("touches the sphere");
    assert_ne!(person.explorer.cursor(), (20, 20));
    person
        .presses("? /")
        .types("this many colours")
        .presses("enter")
        .shows(":color");
    person.presses("esc ? esc").shows("─ view 40×40");
}

#[test]
fn the_footer_names_the_keys_of_the_panel_and_the_lens_and_the_tangent() {
    let mut person = Person::opens("opening", 80, 24);
    let mut footers = Vec::new();
    for (keys, word) in [
        ("1", "L machine"),
        ("L", "m method"),
        ("2", "P predict"),
        ("3", "( ) move p"),
        ("6", "enter steps"),
    ] {
        let screen = person.presses(keys).screen();
        let footer = screen.lines().last().expect("a footer").to_owned();
        for word in ["space menu", word, "t tangent"] {
            assert!(footer.contains(word), "{keys}: no {word} in {footer}");
        }
        footers.push(footer);
    }
    footers.dedup();
    assert_eq!(footers.len(), 5);
}

#[test]
fn the_half_of_the_cell_that_the_cursor_is_on_is_seen() {
    for options in [
        Options::default(),
        Options {
            depth: ColorDepth::None,
            ..Options::default()
        },
    ] {
        let start = Start {
            options,
            ..Start::default()
        };
        let mut person = Person::with("opening", 80, 24, start);
        for mark in ["◓", "◒"] {
            let screen = person.screen();
            assert_eq!(screen.matches(mark).count(), 1, "{screen}");
            let row = screen.lines().position(|line| line.contains(mark));
            assert_eq!(row, Some(12));
            person.presses("down");
        }
    }
}

#[test]
fn a_new_sphere_is_seen_where_the_cursor_points_and_is_selected() {
    for scene in Builtin::ALL.map(Builtin::name) {
        let mut person = Person::with(scene, 80, 24, Start::default());
        for keys in [
            "",
            "shift-left shift-up",
            "shift-left shift-left shift-down",
        ] {
            let count = person.presses(keys).explorer.scene().bodies.len();
            person.presses("i").shows("is added under the cursor");
            let reading = person.explorer.reading().expect("a reading");
            let subject = reading.subject.as_ref().expect("a sphere");
            assert_eq!(subject.body, count, "{scene} {keys}");
            assert_eq!(
                reading.meetings[0].body, count,
                "{scene} {keys}: it is seen"
            );
            assert_eq!(person.explorer.viewpoint().sphere, Some(count));
        }
    }
    let mut person = Person::opens("opening", 80, 24);
    let new = person.presses("i").explorer.scene().bodies[3].sphere;
    assert_eq!(
        (new.center.to_array(), new.radius),
        ([20.0, 20.0, 5.0], 2.0)
    );
}

#[test]
fn undo_and_redo_say_what_they_did() {
    let mut person = Person::opens("trio", 80, 24);
    for (keys, deed) in [
        ("x", "sphere 1 was moved"),
        ("g", "sphere 1 was made larger"),
        ("G", "sphere 1 was made smaller"),
        ("i", "sphere 4 was added"),
        ("delete", "sphere 3 was deleted"),
        ("d", "the camera was moved"),
        ("+", "the view was made wider or narrower"),
        ("9 \\", "the dial was turned"),
    ] {
        person
            .presses(keys)
            .presses("u")
            .shows(&format!("Undone: {deed}."));
        person.presses("U").shows(&format!("Redone: {deed}."));
    }
}

#[test]
fn a_pasted_command_opens_the_view_that_it_was_made_from() {
    let mut teacher = Person::opens("far", 80, 24);
    teacher.presses("N right L 3").commands("method haines");
    let line = rayscope::explorer::command_line(&teacher.explorer.link().expect("a link"));
    let paste = |person: &mut Person, line: &str| {
        person
            .presses("esc :")
            .explorer
            .update(&Event::Paste(line.into()));
        person.presses("enter");
    };
    let mut student = Person::opens("trio", 80, 24);
    paste(&mut student, &line);
    assert_eq!(student.explorer.link(), teacher.explorer.link());
    assert_eq!(
        student.presses("esc").screen(),
        teacher.presses("esc").screen()
    );

    let mut busy = Person::opens("tutorial", 80, 24);
    busy.presses("x");
    paste(&mut busy, &line);
    busy.shows("Unsaved changes");
    busy.presses("o");
    assert_eq!(busy.explorer.link(), teacher.explorer.link());
    paste(&mut busy, "rayscope tour three-rays --page 2 --panel slice");
    busy.shows("page 2/4");
    busy.shows("slice");

    for (line, sentence) in [
        ("rayscope trio --colour never", "rayscope: found --colour"),
        ("rayscope trio --cursor 'x", "a quote without its end"),
        ("rayscope trio --cursor x", "cursor: found “x”"),
        ("rayscope trio far", "found “far”, expected one scene"),
        ("rayscope tour 5 --page 9", "expected a page from 1 to 4"),
        ("rayscope tour none", "expected a chapter"),
        ("rayscope trio --sphere 9", "expected a sphere from 1 to 3"),
        ("rayscope nowhere", "nowhere"),
    ] {
        let mut person = Person::opens("tutorial", 80, 24);
        paste(&mut person, line);
        person.shows(sentence);
    }
}

#[test]
fn a_paste_is_no_burst_of_commands() {
    let mut person = Person::opens("tutorial", 80, 24);
    let before = person.explorer.scene().clone();
    person.explorer.update(&Event::Paste("xxxx q\nq".into()));
    assert_eq!(*person.explorer.scene(), before);
    assert_eq!(person.explorer.ended(), None);
    person.presses(":");
    person.explorer.update(&Event::Paste("cursor 1 2".into()));
    person.presses("enter");
    assert_eq!(person.explorer.cursor(), (1, 2));
}

#[test]
fn all_spheres_of_a_line_are_listed_and_one_can_be_chosen() {
    let mut person = Person::opens("trio", 80, 24);
    person
        .presses("N pagedown pagedown")
        .shows("spheres on this line");
    person.presses("pageup pageup");
    let shown = |p: &Person| p.explorer.reading().unwrap().subject.as_ref().unwrap().body;
    let first = shown(&person);
    person.presses("n");
    let second = shown(&person);
    assert_ne!(first, second);
    person.presses("left right");
    assert_eq!(
        shown(&person),
        first,
        "moving on shows the nearest hit again"
    );
}

#[test]
fn what_a_method_gets_wrong_is_never_what_there_is_no_room_for() {
    let mut wrong = 0;
    for scene in ["far", "grazing"] {
        for method in Method::ALL {
            let start = Start {
                method,
                ..Start::default()
            };
            let mut person = Person::with(scene, 80, 24, start);
            person.commands("lens machine");
            for (x, y) in (0..40).step_by(7).flat_map(|x| [(x, 4), (x, 19), (x, 30)]) {
                person.commands(&format!("cursor {x} {y}"));
                let screen = person.screen();
                let panel: String = screen
                    .lines()
                    .filter_map(|line| line.split("││").nth(1))
                    .flat_map(|line| [line.trim_end_matches('│').trim(), " "])
                    .collect();
                let reading = person.explorer.reading().expect("a reading");
                let trace = &reading.subject.as_ref().expect("a sphere").trace;
                if trace.solution.class != trace.truth.class {
                    let said = format!("{method} says {}, but the line", trace.solution.class);
                    assert!(panel.contains(&said), "no “{said}” on\n{screen}");
                    wrong += 1;
                }
                for other in &reading.wrong {
                    let said = format!("sphere {}: {}, but", other.body + 1, other.said);
                    assert!(panel.contains(&said), "no “{said}” on\n{screen}");
                    wrong += 1;
                }
                // Of a number that has lost a third of its bits the exact value stays.
                let roots = [&trace.near, &trace.far].into_iter().flatten();
                let lost = [&trace.a, &trace.b, &trace.c, &trace.discriminant].into_iter();
                let lost = lost
                    .chain(roots)
                    .filter(|m| m.ulps().is_some_and(|u| u.abs() > 256.0));
                assert!(panel.matches(" ulp").count() >= lost.count(), "{screen}");
            }
        }
    }
    assert!(wrong > 50, "{wrong}");
}

#[test]
fn a_panel_takes_the_pictures_place_where_it_has_no_other() {
    for (cols, rows) in [(40, 14), (30, 10), (60, 16)] {
        let mut person = Person::opens("tutorial", cols, rows);
        person.shows("view 40×40");
        let picture = person.screen();
        for (key, title) in [
            ("1", "ray of pixel"),
            ("2", "step 1"),
            ("4", "f(t)"),
            ("8", "plan"),
        ] {
            person.presses(key).shows(title);
            assert!(
                !person.screen().contains("view 40×40"),
                "{}",
                person.screen()
            );
            person.presses(key);
            assert_eq!(person.screen(), picture, "{key} again");
        }
        person.presses("enter").shows("step 1");
        person.presses("1");
        assert_eq!(person.screen(), picture);
    }
    let mut person = Person::opens("tutorial", 80, 24);
    let wide = person.screen();
    person.presses("1 1");
    assert_eq!(person.screen(), wide, "beside the picture nothing changes");
}

#[test]
fn a_picture_that_is_cut_shows_its_middle() {
    let mut person = Person::opens("tutorial", 80, 17);
    let screen = person.screen();
    // The disc is 20 of the 40 pixels high, in 11 of the 13 rows.
    assert!(screen.contains("▄▄▄▄▀▄▄▄▄"), "{screen}");
    assert!(screen.contains("▀▀▀▀▀▀ ▀▀▀▀▀▀"), "{screen}");
    person.presses("K K K").shows("↓");
    assert!(!person.screen().contains('↑'), "the cursor leads");
}

#[test]
fn no_sentence_of_a_step_ends_in_its_middle() {
    for rows in 18..30 {
        let mut person = Person::opens("trio", 80, rows);
        person.commands("method citardauq").commands("step D");
        let screen = person.screen();
        let first = "The discriminant, Δ/4: its sign";
        if screen.contains(first) {
            assert!(screen.contains("│    sphere."), "{screen}");
        }
    }
}

#[test]
fn lines_that_have_no_room_are_counted_and_come_by_scrolling() {
    let mut person = Person::opens("trio", 80, 24);
    person.shows("5 more lines: pagedown");
    assert!(!person.screen().contains("cos θ"));
    person.presses("pagedown pagedown pagedown").shows("cos θ");
    person
        .presses("pageup pageup pageup pageup")
        .shows("5 more lines: pagedown");
}

#[test]
fn a_person_walks_through_the_derivation_and_back() {
    let mut person = Person::opens("tutorial", 80, 24);
    let before = person.screen();
    person.presses("enter").shows("step 1 of");
    let first = person.screen();
    for (step, result) in [("A", "= 1"), ("B", "= −40"), ("C", "= 300"), ("Δ", "= 400")] {
        person.commands(&format!("step {step}")).shows(result);
    }
    person.presses("> ,").shows("shade");
    person.presses("<");
    assert_eq!(person.screen(), first, "stepping back restores the screen");
    person.presses("1");
    assert_eq!(person.screen(), before);
}

#[test]
fn moving_on_keeps_the_step_and_marks_what_changed() {
    let mut person = Person::opens("tutorial", 80, 24);
    person.commands("step C").presses("right");
    person.shows(": C");
    person.shows("401 − 100 = 301");
    person.presses("L").shows(": C");
    person.shows("→ 301");
    // A miss has no roots, and other methods have other steps before the same one.
    person.commands("step near").shows("step 16 of 23: near");
    person.commands("cursor 20 35").commands("method citardauq");
    person.commands("cursor 20 20").shows(": near");
    person
        .commands("step verdict")
        .commands("cursor 20 35")
        .shows(": verdict");
    person
        .commands("step D")
        .commands("method textbook")
        .shows(": Δ");
}

#[test]
fn predicting_hides_the_answer_until_it_is_given() {
    let mut person = Person::opens("tutorial", 80, 24);
    person.commands("step Δ").presses("P");
    person.shows("What is Δ?");
    assert!(!person.screen().contains("1200 = 400"));
    // B² − AC: the slip has a name, and another try.
    person.presses("1 3 0 0 enter").shows("missing-4");
    assert!(!person.screen().contains("1200 = 400"));
    person.presses("4 9 backspace 0 1 enter").shows("Yes, 400");
    person.shows("How many points");
    person.presses("0").shows("Try again");
    person
        .presses("2")
        .shows("Yes, two. 0 of 2 right at the first try.");
    person.shows("1600 − 1200 = 400");
    person.presses("enter").shows("What is near");
    person.presses("2 0 enter").shows("minus-b-over-a");
    person
        .presses("1 0 enter 3 0 enter enter")
        .shows("Which root is seen?");
    person.presses("f").shows("far-for-near");
    person.presses("n").shows("0 < 10");
}

#[test]
fn nothing_tells_what_is_to_be_predicted() {
    for (scene, method) in [
        ("tutorial", "textbook"),
        ("trio", "haines"),
        ("behind", "exact"),
        ("grazing", "exact"),
    ] {
        for (cols, rows) in [(80, 24), (160, 50), (300, 120), (40, 12)] {
            let mut titles = Vec::new();
            for far in [false, true] {
                let mut person = Person::opens(scene, cols, rows);
                person.commands(&format!("method {method}"));
                // In the corner of the picture nothing is seen.
                person.presses(&"H K ".repeat(if far { 30 } else { 0 }));
                let discriminant = if method == "textbook" { "Δ" } else { "D" };
                person
                    .presses("P")
                    .commands(&format!("step {discriminant}"));
                let screen = person.screen();
                for word in [
                    "two points, the line",
                    "secant",
                    "hit:",
                    "nearest hit",
                    "▀▀",
                ] {
                    assert!(!screen.contains(word), "{word}\n{screen}");
                }
                for number in person.answers() {
                    assert!(!screen.contains(&number), "{number}\n{screen}");
                }
                titles.extend(screen.lines().find(|l| l.contains("─ step ")).map(|l| {
                    let at = l.find("─ step ").unwrap();
                    l[at..].to_owned()
                }));
                person.presses("P");
                let screen = person.screen();
                for word in [", hidden", "Hidden while"] {
                    assert!(!screen.contains(word), "{screen}");
                }
            }
            titles.dedup();
            assert!(titles.len() <= 1, "how many steps follow tells: {titles:?}");
        }
    }
}

#[test]
fn the_picture_comes_back_with_the_last_answer() {
    let mut person = Person::opens("tutorial", 80, 24);
    person.presses("P").shows("view 40×40, hidden");
    person.commands("step seen").shows("Which root is seen?");
    person.shows("view 40×40, hidden");
    person.presses("n").shows("Yes, near");
    assert!(!person.screen().contains("hidden"));
    person.presses("1").shows("Hidden while you predict");
}

#[test]
fn the_board_shows_one_step_and_hides_its_answer() {
    let mut person = Person::opens("tutorial", 80, 24);
    person.commands("step C").presses("O");
    let hidden = person.screen();
    let revealed = person.presses("enter").screen();
    assert_ne!(hidden, revealed);
    person.commands("step Δ").shows("What is Δ?");
    person.presses("4 0 0 enter").shows("Yes, 400");
    assert!(!person.explorer.is_changed(), "the camera has not zoomed");
    person.commands("step C").presses("enter");
    insta::assert_snapshot!("board_hidden_80x24", hidden);
    insta::assert_snapshot!("board_revealed_80x24", revealed);
    person.presses("O").shows("view 40×40");
}

impl Person {
    /// Δ and the roots of the pixel, as a panel writes them.
    fn answers(&self) -> Vec<String> {
        let subject = self.explorer.reading().unwrap().subject.as_ref().unwrap();
        let coefficients = subject.coefficients;
        let shown = |x, precision| number(x, precision, Digits::Significant(6));
        let roots = [subject.solution.near, subject.solution.far]
            .map(|t| shown(t.into(), Precision::Binary32));
        let delta = shown(coefficients.discriminant, coefficients.precision);
        let telling = |text: &String| text.len() > 3 && text != "NaN";
        [delta].into_iter().chain(roots).filter(telling).collect()
    }

    /// Has the picture measured.
    fn measures(&mut self) -> &mut Self {
        let woken = self.hears_the_waker();
        self.presses("%");
        self.waits_for_the_end(&woken)
    }

    fn waits_for_the_end(&mut self, woken: &Receiver<()>) -> &mut Self {
        while self.explorer.is_measuring() {
            woken.recv_timeout(PATIENCE).expect("a wake-up");
            self.explorer.catch_up();
        }
        self
    }

    fn hears_the_waker(&mut self) -> Receiver<()> {
        let (ring, woken) = channel();
        self.explorer.wake_by(Waker::new(move || {
            let _ = ring.send(());
        }));
        woken
    }
}

/// How long anything may take before it counts as not happening.
const PATIENCE: Duration = Duration::from_secs(60);

#[test]
fn error_against_run_time_is_charted_when_asked() {
    // High enough for the chart below whatever there is to say about the times.
    let mut person = Person::opens("far", 80, 48);
    person.presses("7").shows("Press % to time all");
    person.measures().shows("ns  99 % of the errors");
    // Most of the lines that textbook and citardauq answer wrongly, and none that exact does.
    let screen = person.screen();
    let rate = |name: &str| {
        let line = screen.lines().find(|line| line.contains(name));
        let words = line.and_then(|line| line.split_once(name));
        let (_, words) = words.unwrap_or_else(|| panic!("no {name} on\n{screen}"));
        words.split_whitespace().next().map(str::to_owned)
    };
    assert_eq!(rate("e exact"), Some("0".into()));
    // Wrong hits or misses, and after the stroke wrong counts.
    let textbook = rate("t textbook").unwrap();
    let [hit_or_miss, count] =
        [0, 1].map(|i| textbook.split('/').nth(i).unwrap().parse::<f64>().unwrap());
    assert!(hit_or_miss > 10.0 && count > 10.0, "{screen}");
    assert_eq!(rate("c citardauq"), rate("t textbook"));
}

#[test]
fn a_chart_of_another_picture_says_that_it_is_stale() {
    let mut person = Person::opens("trio", 80, 24);
    person.measures();
    assert!(!person.screen().contains("STALE"));
    person.presses("m v");
    assert!(!person.screen().contains("STALE"), "the same questions");
    person.presses("x").shows("STALE");
    person.presses("u");
    assert!(!person.screen().contains("STALE"), "the same picture again");
    person.size = (100, 30);
    person.shows("STALE");
    person.commands("open far").presses("7").shows("STALE");
}

#[test]
fn two_do_not_measure_at_once_and_one_can_be_stopped() {
    let mut person = Person::opens("trio", 80, 24);
    let woken = person.hears_the_waker();
    let other = person.queue.wait(Duration::from_secs(3), |_| false);
    let other = other.expect("a queue").expect("the lock");
    person.presses("%");
    woken.recv_timeout(PATIENCE).expect("a wake-up");
    assert!(person.explorer.catch_up());
    person.shows("measurement is before this one");
    person.shows("about ");
    drop(other);
    person
        .waits_for_the_end(&woken)
        .shows("wrong % p99 ulp    ns");
    person.presses("% %").shows("The measurement was stopped");
    assert!(
        !person.explorer.catch_up(),
        "what was stopped comes to nothing"
    );
    person.presses("1").shows("ray of pixel");
}

fn ascii_textbook() -> Start {
    Start {
        style: Some(Style::Ascii),
        ..textbook()
    }
}

/// The nearest visible hit of all spheres: which, where, and whether it touches.
fn seen(scene: &Scene, ray: &Ray, method: Method) -> Option<(usize, f32, bool)> {
    let hits = scene.bodies.iter().enumerate().filter_map(|(i, body)| {
        let answer = method.solve(ray, &body.sphere);
        Some((i, answer.visible()?, answer.class == Class::Tangent))
    });
    hits.reduce(|first, hit| if hit.1 < first.1 { hit } else { first })
}

#[test]
fn a_dial_marks_exactly_what_the_method_gets_wrong() {
    let mut person = Person::with("trio", 80, 24, ascii_textbook());
    assert!(!person.screen().contains('!'));
    for (k, least) in [(1, 0), (6, 1), (9, 300)] {
        let screen = person.commands(&format!("dial distance {k}")).screen();
        let scene = person.explorer.scene().clone();
        let rays = Rays::new(&scene.camera, Size::new(40, 20), PixelShape::Aspect(2.0));
        let mut wrong = 0;
        for (y, line) in (0..20).zip(screen.lines().skip(2)) {
            for (x, shown) in (0..40).zip(line.chars().skip(1)) {
                let ray = rays.ray(x, y);
                let [found, truth] =
                    [Method::Textbook, Method::Exact].map(|m| seen(&scene, &ray, m));
                // No hit is so far off here that all of its bits are lost.
                let right = found.map(|f| (f.0, f.2)) == truth.map(|t| (t.0, t.2));
                assert_eq!(shown == '!', !right, "({x}, {y}) at 2^{k}\n{screen}");
                wrong += usize::from(!right);
            }
        }
        assert!(wrong >= least, "{wrong} at 2^{k}");
        let said = match wrong {
            0 => "no pixel wrong".into(),
            _ => format!("textbook: {wrong} of 800"),
        };
        person.shows(&said);
    }
    person.shows("textbook broke at ‖o‖/r × 2^");
    // exact is right at every setting.
    person
        .commands("method exact")
        .shows("exact does not break");
    assert!(!person.screen().contains('!'));
}

#[test]
fn a_dial_is_turned_back_to_the_scene_as_it_was() {
    let mut person = Person::with("trio", 80, 24, ascii_textbook());
    let (before, screen) = (person.explorer.scene().clone(), person.screen());
    person.presses("9 \\ \\ \\").shows("‖o‖/r × 2^3");
    person.presses("| |").shows("‖o‖/r × 2^1");
    person.presses("|").shows("The scene is as it was.");
    assert_eq!(*person.explorer.scene(), before);
    person.presses("|").shows("No dial is turned");
    // The next dial takes the one before back.
    person.presses("\\ 9").shows("dial: altitude");
    assert_eq!(*person.explorer.scene(), before);
    person.commands("dial large 90").shows("scale 2^90");
    person.presses("u");
    assert_eq!(*person.explorer.scene(), before);
    person.presses("U").shows("scale 2^90");
    person.presses("u 1 right left");
    assert_eq!(person.screen(), screen);
    assert!(!person.explorer.is_changed());
}

#[test]
fn a_turned_dial_is_nothing_to_save_and_nothing_to_lose() {
    let mut person = Person::opens("trio", 160, 24);
    let path = person.file("mine.toml");
    let name = path.to_str().unwrap();
    person
        .commands("save-as mine.toml")
        .commands("dial offset 4");
    person.presses("ctrl-s").shows("A dial is turned");
    assert_eq!(
        Scene::open(name).unwrap().0.bodies[0].sphere.center.x,
        -0.75
    );
    person.presses("q");
    assert_eq!(person.explorer.ended(), Some(0));

    let mut person = Person::opens("trio", 160, 24);
    person.presses("x").commands("dial offset 4").presses("q");
    person.shows("Unsaved changes");
    let own = person.explorer.scene().clone();
    person.presses("esc u");
    assert!(!person.explorer.is_changed());
    assert_ne!(*person.explorer.scene(), own);
}

#[test]
fn quitting_asks_about_work_and_not_about_a_look_at_a_built_in_scene() {
    let mut looked = Person::opens("trio", 80, 24);
    looked.presses("a w + q");
    assert_eq!(looked.explorer.ended(), Some(0));
    let mut worked = Person::opens("trio", 80, 24);
    worked.presses("x q q q").shows("D quit without saving");
    worked.presses("D");
    assert_eq!(worked.explorer.ended(), Some(0));
}

#[test]
fn the_mark_of_the_column_covers_no_word() {
    let mut person = Person::opens("tutorial", 80, 24);
    for _ in 0..40 {
        person.presses("left");
        let top = person
            .screen()
            .lines()
            .nth(1)
            .unwrap_or_default()
            .to_owned();
        assert!(top.contains(" view 40×40 "), "{top}");
    }
}

#[test]
fn what_is_no_plain_file_is_not_replaced() {
    let mut person = Person::opens("trio", 200, 24);
    person
        .commands("save-as .")
        .shows("not a file that can be replaced");
    assert_eq!(fs::read_dir(person.folder.path()).unwrap().count(), 0);
}

#[test]
fn a_line_through_very_many_spheres_lists_the_first_of_them() {
    let mut person = Person::opens("trio", 80, 24);
    let mut scene = person.explorer.scene().clone();
    let one = scene.bodies[0].clone();
    scene.bodies = vec![one; 100_000];
    let source = rayscope::scene::Source::Builtin(rayscope::scene::Builtin::Trio);
    person.explorer = Explorer::new(scene, &source, Options::default());
    person
        .presses("right left pagedown pagedown pagedown pagedown")
        .shows("100000 spheres on this line");
}

#[test]
fn a_dial_that_scenes_do_not_have_is_named_and_so_is_one_that_goes_no_further() {
    let mut person = Person::opens("trio", 120, 30);
    person
        .commands("dial tangency")
        .shows("rayscope stress --dial tangency");
    person
        .presses("esc")
        .commands("dial nonsense")
        .shows("expected one of distance");
    person
        .presses("esc")
        .commands("dial large 3")
        .shows("expected 0 to 120");
    person.presses("esc").commands("dial distance 24");
    person.presses("\\").shows("distance goes no further");
    person
        .commands("dial altitude 60")
        .shows("cannot tell that place");
}

#[test]
fn a_pixel_is_copied_as_a_row_and_as_test_cases_and_shown() {
    let mut person = Person::opens("tutorial", 80, 24);
    let copied = |person: &mut Person| match person.explorer.take_request() {
        Some(Request::Copy(text)) => text,
        other => panic!("{other:?}"),
    };
    person.presses("&").shows("a row for rayscope grade");
    let row = "20,20,0,0,0,1,20,20,20,10,secant,10,30";
    person.shows(row);
    assert_eq!(copied(&mut person), format!("{HEADER}\n{row}\n"));
    person.presses("&").shows("a test case in C");
    person.shows("const float expected_roots[2] = {0x1.4p+3f, 0x1.ep+4f};");
    assert!(copied(&mut person).contains("const float r = 0x1.4p+3f;"));
    person
        .presses("&")
        .shows("let [r] = [0x41200000].map(f32::from_bits);");
    copied(&mut person);
    person.presses("esc").shows("ray of pixel");
    person
        .commands("cursor 0 0")
        .commands("copy c")
        .shows("\"miss\"");
    assert!(!copied(&mut person).contains("roots"));
    person
        .presses("esc")
        .commands("copy nonsense")
        .shows("row, c, rust");
}

#[test]
fn pixels_are_collected_in_a_file_that_is_one_of_rows() {
    let mut person = Person::opens("tutorial", 160, 24);
    let path = person.file("hard.csv");
    let append = "append hard.csv";
    person.commands(append).shows("has 1 row now");
    person
        .commands("cursor 0 0")
        .commands(append)
        .shows("has 2 rows now");
    let text = fs::read_to_string(&path).unwrap();
    let rows = [
        HEADER,
        "20,20,0,0,0,1,20,20,20,10,secant,10,30",
        "0,0,0,0,0,1,20,20,20,10,miss,,",
    ];
    assert_eq!(text.lines().collect::<Vec<_>>(), rows);
    fs::write(&path, "x,y\n1,2").unwrap();
    person.commands(append).shows("its first line is not");
    assert_eq!(fs::read_to_string(&path).unwrap(), "x,y\n1,2");
    // To open a pipe would wait for somebody at its other end.
    let pipe = person.file("pipe");
    rustix::fs::mkfifoat(rustix::fs::CWD, &pipe, rustix::fs::Mode::RWXU).unwrap();
    symlink("/dev/null", person.file("null")).unwrap();
    for name in ["pipe", "null"] {
        person
            .commands(&format!("append {name}"))
            .shows("it is not a regular file");
    }
}

#[test]
fn the_guide_lists_the_keys_that_there_are() {
    hold_to_docs("docs/guide.md", "keys", &markdown());
}

#[test]
fn the_pictures_of_the_readme_are_the_real_screens() {
    let readme = include_str!("../README.md");
    for (name, arguments) in [
        ("opening", &["opening"] as &[&str]),
        ("steps", &["opening", "--pixel", "20,20", "--steps"]),
    ] {
        let output = std::process::Command::new(env!("CARGO_BIN_EXE_rayscope"))
            .args(["print", "--svg"])
            .args(arguments)
            .env_clear()
            .output()
            .expect("the program");
        let svg = String::from_utf8(output.stdout).expect("text");
        assert!(
            svg.starts_with("<svg ") && svg.ends_with("</svg>\n"),
            "{svg}"
        );
        assert!(readme.contains(&format!("(docs/{name}.svg)")));
        let path = format!("{}/docs/{name}.svg", env!("CARGO_MANIFEST_DIR"));
        if std::env::var_os("RAYSCOPE_UPDATE_DOCS").is_some() {
            fs::write(path, svg).expect("the picture written");
        } else {
            let is_current = fs::read_to_string(&path).is_ok_and(|old| old == svg);
            assert!(
                is_current,
                "RAYSCOPE_UPDATE_DOCS=1 cargo test rewrites {path}"
            );
        }
    }
}

/// What stands between the marks `NAME` and `end of NAME` of a page is `text`.
fn hold_to_docs(page: &str, name: &str, text: &str) {
    let path = format!("{}/{page}", env!("CARGO_MANIFEST_DIR"));
    let whole = fs::read_to_string(&path).expect("a page");
    let marks = [
        format!("<!-- {name} -->\n"),
        format!("<!-- end of {name} -->"),
    ];
    let (before, rest) = whole.split_once(&marks[0]).expect("the first mark");
    let (found, after) = rest.split_once(&marks[1]).expect("the second mark");
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

/// What a person may do to an explorer.
#[derive(Debug, Clone)]
enum Deed {
    Press(usize),
    /// Several keys before the next look at the screen.
    Rush(Vec<usize>),
    Type(char),
    Special(&'static str),
    Resize(u16, u16),
    Paste(String),
}

fn deed() -> impl Strategy<Value = Deed> {
    // Keys that write files or end the program are left out: the one would litter, the other end
    // the walk early. They have tests of their own.
    let keys = 0..Action::ALL.len();
    prop_oneof![
        8 => keys.clone().prop_map(Deed::Press),
        4 => prop::collection::vec(keys, 2..8).prop_map(Deed::Rush),
        2 => any::<char>().prop_map(Deed::Type),
        2 => prop::sample::select(vec!["enter", "esc", "tab", "backspace", "up", "down"])
            .prop_map(Deed::Special),
        1 => (0..220_u16, 0..80_u16).prop_map(|(w, h)| Deed::Resize(w, h)),
        1 => ".{0,12}".prop_map(Deed::Paste),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn any_keys_at_any_size_never_panic(
        scene in prop::sample::select(vec!["tutorial", "trio"]),
        deeds in prop::collection::vec(deed(), 1..120),
    ) {
        let mut person = Person::opens(scene, 80, 24);
        for deed in deeds {
            match deed {
                Deed::Press(at) => {
                    let action = Action::ALL[at];
                    if let (false, Some(key)) = (writes(action), action.keys().first()) {
                        person.presses(key);
                    }
                }
                Deed::Rush(all) => {
                    let all = all.into_iter().map(|at| Action::ALL[at]);
                    for action in all.filter(|&a| !writes(a)) {
                        if let Some(key) = action.keys().first() {
                            person.explorer.update(&key_event(key));
                        }
                    }
                }
                Deed::Type(c) => {
                    person.types(&c.to_string());
                }
                Deed::Special(key) => {
                    person.presses(key);
                }
                Deed::Resize(w, h) => person.size = (w, h),
                Deed::Paste(text) => {
                    person.explorer.update(&Event::Paste(text));
                }
            }
            person.screen();
            let scene = person.explorer.scene();
            prop_assert!(scene.camera.check().is_ok());
            prop_assert!(scene.bodies.iter().all(|b| b.sphere.radius >= 0.0));
        }
    }
}

#[test]
fn keys_after_another_scene_act_on_that_scene() {
    // All in one go, before anything is drawn: the page's scene has one sphere, not three.
    let mut person = Person::opens("trio", 80, 24);
    person.presses("n").shows("sphere 2 of 3");
    person.presses(":");
    person.explorer.update(&Event::Paste("tour 4".into()));
    for key in ["enter", "T"] {
        person.explorer.update(&key_event(key));
    }
    person.shows("r = 0:");
}

/// A move that can be taken back.
#[derive(Debug, Clone, Copy)]
enum Move {
    /// To another step; with `.`, `,`, `<` or `>`.
    Step(&'static str),
    /// To the panel of that key.
    Panel(&'static str),
    /// The cursor by a key, and the key that moves it back.
    Cursor(&'static str, &'static str),
    /// The camera.
    Camera(&'static str),
    /// Another method or view, and the key that turns back.
    Turn(&'static str, &'static str),
}

fn any_move() -> impl Strategy<Value = Move> {
    prop::sample::select(vec![
        Move::Step("."),
        Move::Step("enter"),
        Move::Step(","),
        Move::Step("<"),
        Move::Step(">"),
        Move::Panel("1"),
        Move::Panel("2"),
        Move::Panel("3"),
        Move::Panel("4"),
        Move::Panel("5"),
        Move::Panel("6"),
        Move::Cursor("left", "right"),
        Move::Cursor("right", "left"),
        Move::Cursor("up", "down"),
        Move::Cursor("shift-down", "shift-up"),
        Move::Cursor("shift-right", "shift-left"),
        Move::Camera("a"),
        Move::Camera("w"),
        Move::Camera("D"),
        Move::Camera("e"),
        Move::Camera("-"),
        Move::Turn("m", "M"),
        Move::Turn("V", "v"),
    ])
}

impl Person {
    /// The number and the name of the step in the title of its panel.
    fn step(&mut self) -> (usize, String) {
        let screen = self.screen();
        let title = screen.split("─ step ").nth(1).expect("the steps");
        let mut words = title.split(' ');
        let number = words.next().and_then(|n| n.parse().ok());
        let name = words.nth(2).expect("a name");
        (number.expect("a number"), name.to_owned())
    }

    /// Makes a move, and tells which keys take it back.
    fn makes(
        &mut self,
        a_move: Move,
        panel: &mut &'static str,
        chosen: &mut Option<String>,
    ) -> String {
        let place = |person: &Self| person.explorer.reading().expect("a reading").pixel;
        match a_move {
            Move::Step(key) => {
                let was = *panel;
                self.presses("2");
                *panel = "2";
                let (before, name) = self.step();
                if chosen.as_ref().is_some_and(|chosen| *chosen != name) {
                    // This one stands in for the chosen step, which this pixel has not: to go on from
                    // it is a choice that no step back undoes.
                    return format!("{before} {was}");
                }
                self.presses(key);
                let (after, name) = self.step();
                *chosen = Some(name);
                match (before, after) {
                    (before, after) if after == before + 1 => format!("- 2 , {was}"),
                    (before, after) if after + 1 == before => format!("- 2 . {was}"),
                    (before, _) => format!("{before} {was}"),
                }
            }
            Move::Panel(key) => {
                let back = format!("- {panel}");
                *panel = key;
                self.presses(key);
                back
            }
            Move::Cursor(key, back) => {
                let before = place(self);
                self.presses(key);
                let after = place(self);
                let moved = before.0.abs_diff(after.0) + before.1.abs_diff(after.1);
                // At the edge of the picture a move is a shorter one, or none.
                let back = back.trim_start_matches("shift-");
                format!("- {panel} {}", vec![back; moved as usize].join(" "))
            }
            Move::Camera(key) => {
                let before = self.explorer.scene().clone();
                self.presses(key);
                let undo = if *self.explorer.scene() == before {
                    ""
                } else {
                    "u"
                };
                format!("- {panel} {undo}")
            }
            Move::Turn(key, back) => {
                self.presses(key);
                format!("- {panel} {back}")
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn stepping_back_restores_the_screen(
        scene in prop::sample::select(vec!["tutorial", "trio", "inside", "far"]),
        // Where the picture has to scroll, it stays where it was scrolled to.
        size in prop::sample::select(vec![(80, 24), (130, 46), (160, 50)]),
        moves in prop::collection::vec(any_move(), 1..24),
    ) {
        let mut person = Person::opens(scene, size.0, size.1);
        // A turn of the method goes to this lens.
        person.commands("lens machine");
        let (mut panel, mut chosen) = ("1", None);
        let mut ways_back = Vec::new();
        for a_move in moves {
            let screen = person.presses("esc").screen();
            let was = panel;
            let back = person.makes(a_move, &mut panel, &mut chosen);
            ways_back.push((screen, back, was, a_move));
        }
        for (screen, back, was, a_move) in ways_back.into_iter().rev() {
            let mut keys = back.split(' ');
            match keys.next() {
                Some("-") => {
                    let keys: Vec<_> = keys.collect();
                    person.presses(&keys.join(" "));
                }
                number => {
                    person.presses("2").commands(&format!("step {}", number.expect("a number")));
                    person.presses(was);
                }
            }
            let found = person.presses("esc").screen();
            prop_assert_eq!(&found, &screen, "after {:?} and back\n{}\nwas\n{}", a_move, found, screen);
        }
    }
}

fn writes(action: Action) -> bool {
    matches!(action, Action::Save | Action::SaveAs | Action::Quit)
}

#[test]
fn the_lens_stays_until_a_method_is_chosen() {
    let mut person = Person::opens("trio", 80, 24);
    person.shows(" mathematics ");
    person.presses("L").shows(" machine ");
    person.presses("L right 5").shows(" mathematics ");
    person.presses("m").shows(" machine ");
    person.commands("lens mathematics").shows(" mathematics ");
    person.commands("method haines").shows(" machine ");
    person
        .commands("lens glass")
        .shows("expected one of mathematics, machine");
}
