//! The tour as a student walks it: keys in, screens out; and chapters as a teacher writes them.

use std::fs;
use std::path::Path;

use ratatui::buffer::Buffer;
use ratatui::crossterm::event::{Event, KeyCode, KeyEvent, KeyModifiers};
use ratatui::layout::Rect;
use rayscope::explorer::tour::{self, Chapter};
use rayscope::explorer::{Explorer, Options, Workplace};
use rayscope::render::ColorDepth;
use rayscope::scene::Scene;
use rayscope::text::Glyphs;

/// Somebody with the explorer before them.
struct Student {
    explorer: Explorer,
    size: (u16, u16),
}

impl Student {
    fn opens(name: &str, size: (u16, u16), options: Options) -> Self {
        let (scene, source) = Scene::open(name).expect("a scene");
        let explorer = Explorer::new(scene, &source, options);
        let mut student = Self { explorer, size };
        student.screen();
        student
    }

    /// On a page of the tour, both counted from 1.
    fn on_page(chapter: usize, page: usize, size: (u16, u16)) -> Self {
        let mut student = Self::opens("tutorial", size, Options::default());
        student
            .explorer
            .start_tour(tour::builtin(), chapter - 1, page - 1);
        student
    }

    fn presses(&mut self, keys: &str) -> &mut Self {
        for key in keys.split_whitespace() {
            let (modifiers, key) = match key.split_once('-') {
                Some(("ctrl", rest)) => (KeyModifiers::CONTROL, rest),
                Some(("shift", rest)) => (KeyModifiers::SHIFT, rest),
                _ => (KeyModifiers::NONE, key),
            };
            let code = match key {
                "enter" => KeyCode::Enter,
                "esc" => KeyCode::Esc,
                "up" => KeyCode::Up,
                "down" => KeyCode::Down,
                "end" => KeyCode::End,
                "tab" => KeyCode::Tab,
                "left" => KeyCode::Left,
                "right" => KeyCode::Right,
                "space" => KeyCode::Char(' '),
                key => KeyCode::Char(key.chars().next().expect("a key")),
            };
            let event = Event::Key(KeyEvent::new(code, modifiers));
            self.explorer.update(&event);
            self.screen();
        }
        self
    }

    fn types(&mut self, line: &str) -> &mut Self {
        self.presses(":");
        self.explorer.update(&Event::Paste(line.into()));
        self.presses("enter")
    }

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

    fn has(&mut self, text: &str) -> bool {
        let screen = self.screen();
        // A text that is wrapped is shown all the same.
        let joined = screen.split_whitespace().collect::<Vec<_>>().join(" ");
        screen.contains(text) || joined.contains(text)
    }

    fn shows(&mut self, text: &str) -> &mut Self {
        assert!(self.has(text), "no “{text}” on\n{}", self.screen());
        self
    }
}

const SMALL: (u16, u16) = (80, 24);
const LARGE: (u16, u16) = (160, 50);

#[test]
fn a_walk_of_the_whole_tour_shows_every_page_whole() {
    let chapters = tour::builtin();
    for size in [SMALL, LARGE] {
        let mut student = Student::opens("trio", size, Options::default());
        student.presses("ctrl-t");
        for (n, chapter) in (1..).zip(chapters.iter()) {
            for (p, page) in (1..).zip(&chapter.pages) {
                let (count, pages) = (chapters.len(), chapter.pages.len());
                let title = &chapter.title;
                let place = format!("{n}/{count}: {title}, page {p}/{pages} ");
                student.shows(&place).shows("f next");
                let screen = student.screen();
                let lines: Vec<&str> = screen.lines().collect();
                // Beside each other on a large screen, under each other on a small one.
                for text in page.text.iter().chain(&page.says_to_try(false)) {
                    for word in text.split_whitespace() {
                        assert!(screen.contains(word), "no “{word}” on\n{screen}");
                    }
                }
                // A message would say that the page asks for something that is not there.
                assert!(
                    lines[size.1 as usize - 1].contains("space menu  arrows"),
                    "{screen}"
                );
                assert!(student.explorer.reading().is_some());
                assert!(!student.explorer.is_changed());
                student.presses("f");
            }
        }
        student.shows("This was the last page.");
    }
}

#[test]
fn the_tour_has_the_tutorials_numbers() {
    let on_screen: [((usize, usize), &[&str]); 17] = [
        (
            (1, 1),
            &["y = 1.1x + 0.2", "(8, 9) and (−2, −2)", "x² + y² = 25"],
        ),
        (
            (1, 2),
            &[
                "2.21x² + 0.44x − 24.96 = 0",
                "0.44² − 4·2.21·(−24.96) = 220.84",
                "x = 3.26 and x = −3.46",
                "(3.26, 3.786)",
            ],
        ),
        (
            (1, 3),
            &[
                "p0: (0, 0.2, 0)",
                "d: (1, 1.1, 0)",
                "2.21",
                "= 0.44",
                "= −24.96",
                "220.84",
                "near = (−B − √Δ) / 2A ≈ −3.46",
                "far = (−B + √Δ) / 2A ≈ 3.26",
            ],
        ),
        (
            (1, 4),
            &[
                "(−3.46, −3.606) and (3.26, 3.786)",
                "P₁ in at t ≈ −3.46",
                "P₂ out at t ≈ 3.26",
            ],
        ),
        (
            (2, 1),
            &[
                "(2, 5, 7), (4, 10, 14), (6, 15, 21), (8, 20, 28)",
                "c: (2, 5, 7)",
            ],
        ),
        ((3, 1), &["(p − c)·(p − c) = r²", "step 1 of"]),
        ((3, 2), &["At² + Bt + C = 0", "step 2 of"]),
        (
            (4, 1),
            &[
                "= 0² + 0² + 1² = 1",
                "= 2·(−20) = −40",
                "= 400 − 100 = 300",
                "= 1600 − 1200 = 400",
                "2A = 10",
                "2A = 30",
            ],
        ),
        ((4, 2), &["1600 − 1200 = 400"]),
        ((5, 1), &["1600 − 1644 = −44", "misses"]),
        ((5, 2), &["1600 − 1600 = 0", "touches"]),
        ((5, 3), &["1600 − 1536 = 64", "A = 16", "A = 24"]),
        ((6, 1), &["317"]),
        ((6, 2), &["++", "--"]),
        ((6, 3), &["12 rays touch", "1600 − 1600 = 0"]),
        ((8, 1), &["Δ ≈", "2A ≈ −6.93907", "2A ≈ −5.0423"]),
        ((8, 2), &["= −39", "inside"]),
    ];
    for ((chapter, page), texts) in on_screen {
        let mut student = Student::on_page(chapter, page, SMALL);
        for text in texts {
            student.shows(text);
        }
    }
    // The other steps of the parametric ray, one after the other.
    let mut student = Student::on_page(2, 1, SMALL);
    student.presses("N");
    for (n, bead) in ["2, 5, 7", "4, 10, 14", "6, 15, 21", "8, 20, 28"]
        .into_iter()
        .enumerate()
    {
        student
            .shows(&format!("c: ({bead})"))
            .shows(&format!("{}/4", n + 1));
        student.presses("N");
    }
}

#[test]
fn the_tour_shows_how_binary32_loses_and_what_helps() {
    let right = |chapter, page| {
        let mut student = Student::on_page(chapter, page, SMALL);
        student.screen();
        let reading = student.explorer.reading().expect("a reading");
        let trace = &reading.subject.as_ref().expect("a sphere").trace;
        trace.solution.class == trace.truth.class
            && (trace.solution.near / trace.truth.near - 1.0).abs() < 1e-3
    };
    assert!(!right(11, 1) && !right(11, 2), "the lost sphere");
    assert!(right(11, 3), "its cure");
    assert!(!right(12, 1) && !right(12, 2), "the ground");
    assert!(right(12, 3), "its cure");
    assert!(right(14, 1) && right(14, 2), "exact");
}

#[test]
fn some_pages_as_they_are() {
    let page = |chapter, page, size| Student::on_page(chapter, page, size).screen();
    insta::assert_snapshot!("circle_and_line_80x24", page(1, 3, SMALL));
    insta::assert_snapshot!("a_b_c_80x24", page(4, 2, SMALL));
    insta::assert_snapshot!("lost_sphere_160x50", page(11, 1, LARGE));
    insta::assert_snapshot!("three_rays_40x24", page(5, 1, (40, 24)));
    insta::assert_snapshot!("three_rays_30x10", page(5, 1, (30, 10)));
}

#[test]
fn in_plain_characters_the_tour_is_plain() {
    let options = Options {
        glyphs: Glyphs::Ascii,
        depth: ColorDepth::None,
        ..Options::default()
    };
    let pages: usize = tour::builtin().iter().map(|c| c.pages.len()).sum();
    let mut student = Student::opens("tutorial", SMALL, options);
    student.presses("f");
    for _ in 0..pages {
        let screen = student.screen();
        assert!(screen.is_ascii(), "{screen}");
        assert!(!screen.contains('?') || screen.contains("? help"));
        student.presses("f");
    }
}

#[test]
fn a_page_that_does_not_fit_is_read_on_before_the_next() {
    let mut student = Student::on_page(5, 1, (40, 20));
    student.shows("f more");
    let mut presses = 0;
    while !student.screen().contains("page 2/4") {
        student.presses("f");
        presses += 1;
        assert!(presses < 20, "{}", student.screen());
    }
    assert!(presses > 1);
    student.presses("F").shows("page 1/4");
    for size in [(20, 6), (20, 8), (66, 9), (300, 100), (1, 1), (0, 0)] {
        student.size = size;
        student.presses("f f F r");
    }
}

#[test]
fn somebody_who_left_the_path_finds_back() {
    let mut student = Student::on_page(4, 2, SMALL);
    let page = student.screen();
    student.presses("right right up enter m v x g : esc 1");
    assert_ne!(student.screen(), page);
    student.presses("r");
    let with_message = student.screen();
    student.presses("esc");
    assert_eq!(student.screen(), page, "was\n{with_message}");
    // What was tried is not lost: it can be taken back up.
    student.presses("x r").shows("u brings back");
    let center = student.explorer.scene().bodies[0].sphere.center.x;
    student.presses("u");
    assert_ne!(student.explorer.scene().bodies[0].sphere.center.x, center);
}

#[test]
fn own_work_waits_behind_the_tour() {
    let mut student = Student::opens("trio", SMALL, Options::default());
    student.presses("right x m 1 a");
    let own = student.explorer.scene().clone();
    let screen = student.screen();
    student.presses("f").shows("Unsaved changes.");
    student.presses("esc esc");
    assert_eq!(student.screen(), screen);
    student.presses("f t").shows("1/14");
    assert!(student.explorer.is_changed(), "it is still unsaved");
    student.presses("x f f u x ctrl-t esc");
    assert_eq!(student.screen(), screen);
    student.presses("u u");
    assert_ne!(
        *student.explorer.scene(),
        own,
        "with all that can be undone"
    );
    student.presses("U U ctrl-t t").shows("page 3/4");
    // Leaving the program asks in front of what would be lost.
    student.presses("q").shows("Unsaved changes.");
    assert_eq!(*student.explorer.scene(), own);
    student.presses("q q q");
    assert_eq!(student.explorer.ended(), None);
    student.presses("D");
    assert_eq!(student.explorer.ended(), Some(0));
}

#[test]
fn chapters_are_reached_by_name_number_and_key() {
    let mut student = Student::opens("tutorial", SMALL, Options::default());
    student.types("tour perspective").shows("10/14");
    student.types("tour 2").shows("2/14");
    student.presses("ctrl-n").shows("3/14");
    student.presses("f ctrl-p").shows("3/14").shows("page 1/2");
    student.presses("ctrl-p").shows("2/14");
    student.presses("F").shows("1/14").shows("page 4/4");
    student
        .types("tour 15")
        .shows("expected a chapter: 1 to 14");
    student.presses("esc").types("open trio").shows("3 spheres");
    student
        .presses("r")
        .shows("The tour is not open. f opens it.");
    student.presses("f").shows("1/14").shows("page 4/4");
}

#[test]
fn the_style_that_a_person_likes_stays() {
    let mut student = Student::on_page(5, 1, SMALL);
    student
        .types("next-style")
        .types("next-style")
        .presses("f")
        .shows("   ascii   ");
    student.types("tour 6").presses("f").shows("   tutorial   ");
}

/// The sentence for a chapter's text.
fn refused(text: &str) -> String {
    let error = Chapter::parse(text, "mine.toml", None).expect_err("not a chapter");
    error.to_string()
}

#[test]
fn a_chapter_that_is_none_is_refused_with_its_place() {
    let said = [
        "title = 3",
        "title = \"a\"",
        "title = \"a\"\n[[page]]\ntext = \"b\"",
        "title = \"a\"\n[[page]]\nscene = \"tutorial\"\ntext = \" \"",
        "title = \"a\"\n[[page]]\nscene = \"tutoral\"\ntext = \"b\"",
        "title = \"a\"\n[[page]]\nscene = \"tutorial\"\ntext = \"b\"\nmethod = \"fast\"",
        "title = \"a\"\n[[page]]\nscene = \"tutorial\"\ntext = \"b\"\npixel = [40, 0]",
        "title = \"a\"\n[[page]]\nscene = \"trio\"\ntext = \"b\"\npixel = [4, 0]",
        "title = \"a\"\n[[page]]\nscene = \"trio\"\ntext = \"b\"\nset = [\"radius −1\"]",
        "title = \"a\"\n[[page]]\nscene = \"trio\"\ntext = \"b\"\nsphere = 0",
        "title = \"a\"\n[[page]]\nscene = '''\n[camera]\nposition = 1\n'''\ntext = \"b\"",
        "title = \"a\"\n[[page]]\nscene = \"trio\"\ntext = \"b\"\ncolour = 1",
    ]
    .map(refused)
    .join("\n");
    insta::assert_snapshot!(said);
}

#[test]
fn the_chapter_in_the_docs_is_one() {
    let page = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/tour.md");
    let docs = fs::read_to_string(page).expect("the page");
    let example = docs.split("```").nth(1).expect("an example");
    let text = example.trim_start_matches("toml");
    let chapter = Chapter::parse(text, "rim.toml", None).expect("a chapter");
    let mut student = Student::opens("tutorial", SMALL, Options::default());
    student.explorer.start_tour([chapter].into(), 0, 0);
    student
        .shows("1/1: grazing the rim, page 1/2")
        .shows("r: 8")
        .shows("1600 − 1600 = 0");
    student.presses("f").shows("What is Δ?");
    // Every key that a page may have is in the table.
    let said = refused("title = \"a\"\n[[page]]\ntext = \"b\"\nnone = 1");
    let keys = said.split('`').skip(3).step_by(2);
    for key in keys {
        assert!(
            docs.contains(&format!("`{key}`")),
            "{key} is not in the docs"
        );
    }
}

#[test]
fn a_teachers_folder_is_a_tour() {
    let folder = tempfile::tempdir().expect("a folder");
    let write =
        |name: &str, text: &str| fs::write(folder.path().join(name), text).expect("written");
    write(
        "ball.toml",
        &Scene::open("tutorial").expect("a scene").0.to_toml(),
    );
    fs::create_dir(folder.path().join("lessons")).expect("a folder");
    write(
        "lessons/2-second.toml",
        "title = \"the second\"\n[[page]]\nscene = \"../ball.toml\"\nset = [\"radius 5\"]\n\
         text = \"One.\\n\\nTwo.\"\ntry = \"Three.\"",
    );
    write(
        "lessons/1-first.toml",
        "title = \"the first\"\n[[page]]\nscene = \"trio\"\ntext = \"Zero.\"",
    );
    let chapters = tour::load(&folder.path().join("lessons")).expect("chapters");
    let names: Vec<_> = chapters.iter().map(|c| c.name.as_str()).collect();
    assert_eq!(names, ["first", "second"]);
    let mut student = Student::opens("tutorial", SMALL, Options::default());
    student.explorer.start_tour(chapters, 1, 0);
    student.shows("2/2: the second, page 1/1").shows("r: 5");
    student.shows("One. Two. Try: Three.");
    let said = tour::load(folder.path())
        .expect_err("no chapter")
        .to_string();
    assert!(said.contains("ball.toml:2:1: unknown field"), "{said}");
    assert!(tour::load(Path::new("/no/such/chapter.toml")).is_err());
}

#[test]
fn on_a_small_screen_a_page_shows_what_it_speaks_of() {
    let mut student = Student::opens("tutorial", (40, 20), Options::default());
    student.types("tour 3").shows("step 1").shows("3/14");
    student.presses("enter").shows("step 2");
    student.presses("1").shows("view 40×40").shows("3/14");
}

#[test]
fn what_a_page_says_to_try_shows_what_it_promises() {
    let chapters = tour::builtin();
    for (n, chapter) in (1..).zip(chapters.iter()) {
        for (p, page) in (1..).zip(&chapter.pages) {
            let place = format!("{n}/{p}, {}", chapter.title);
            let attempt = &page.says_to_try(false).unwrap_or_default();
            assert!(!page.promises.is_empty(), "{place} promises nothing");
            let mut student = Student::on_page(n, p, SMALL);
            let folder = tempfile::tempdir().unwrap();
            let workplace = Workplace::within(folder.path());
            student.explorer = student.explorer.finding_files_in(workplace);
            for promise in &page.promises {
                let (keys, shows) = (&promise.keys, &promise.shows);
                assert_says_how(attempt, keys, &place);
                assert!(!student.has(shows), "{place}: “{shows}” before {keys}");
                match keys.strip_prefix(':') {
                    Some(command) => student.types(command),
                    None => student.presses(keys),
                };
                assert!(
                    student.has(shows),
                    "{place}: no “{shows}” after {keys} on\n{}",
                    student.screen()
                );
            }
        }
    }
}

/// That a text names the keys or the command that it is carried out with. Figures are answers.
fn assert_says_how(attempt: &str, keys: &str, place: &str) {
    let names = |key: &str| {
        let mut words = attempt.split_whitespace();
        words.any(|word| word == key || word.trim_matches(|c| "(),.:;".contains(c)) == key)
    };
    let is_command = keys.starts_with(':');
    assert!(
        !is_command || attempt.contains(keys),
        "{place}: no “{keys}”"
    );
    for key in keys.split_whitespace().filter(|_| !is_command) {
        let (held, key) = key.split_once('-').unwrap_or(("", key));
        let key = if key.is_empty() { "-" } else { key };
        let is_arrow = ["up", "down", "left", "right"].contains(&key);
        let is_named = names(key)
            || (is_arrow && (names("arrow") || names("arrows")))
            || (held == "ctrl" && names(&format!("ctrl-{key}")))
            || key.starts_with(|c: char| c.is_ascii_digit());
        assert!(is_named, "{place} does not name the key {key}");
        assert!(held != "shift" || names("shift"), "{place}: no shift");
    }
}

#[test]
fn the_picture_of_chapter_six_is_on_the_usual_screen_whole() {
    let mut student = Student::on_page(6, 1, SMALL);
    let (cols, rows) = SMALL;
    let mut buffer = Buffer::empty(Rect::new(0, 0, cols, rows));
    student.explorer.prepare(cols, rows);
    student.explorer.draw(&mut buffer);
    let ground = buffer[(1, 2)].bg;
    let painted = |(x, y)| {
        let cell = &buffer[(x, y)];
        match cell.symbol() {
            " " => [cell.bg; 2],
            "▄" => [cell.bg, cell.fg],
            _ => [cell.fg, cell.bg],
        }
        .into_iter()
        .filter(|color| *color != ground)
        .count()
    };
    let cells = (2..16).flat_map(|y| (1..39).map(move |x| (x, y)));
    assert_eq!(cells.map(painted).sum::<usize>(), 317);
}

#[test]
fn a_line_that_is_raised_far_enough_misses_the_circle() {
    let mut student = Student::on_page(1, 2, SMALL);
    student.shows("220.84").shows("P₁").shows("3.786");
    for _ in 0..80 {
        student.presses("up");
    }
    student.shows("below 0: no point in common");
}

#[test]
fn the_sphere_that_the_last_page_has_a_person_add_is_in_the_picture() {
    let mut student = Student::on_page(13, 3, SMALL);
    student.presses("ctrl-t");
    let before = student.screen();
    student.presses("i esc");
    assert_ne!(student.screen(), before);
    assert_eq!(
        student.explorer.reading().map(|r| r.meetings[0].body),
        Some(1)
    );
}
