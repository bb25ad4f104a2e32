//! One's own routines: the corpus, the methods as text, slips and weaknesses, the program that uses them.

#![cfg(feature = "routine")]

use std::fs;
use std::path::Path;
use std::process::Command;
use std::sync::mpsc::{self, Receiver};
use std::time::Duration;

use ratatui::buffer::{Buffer, Cell};
use ratatui::crossterm::event::{Event, KeyCode, KeyEvent, KeyModifiers};
use ratatui::layout::Rect;
use rayscope::explorer::{Explorer, Options, Workplace};
use rayscope::lab::check::check;
use rayscope::lab::{families::Family, numbers};
use rayscope::method::source::{SourceLanguage, source};
use rayscope::method::{Class, Method, RoutineId};
use rayscope::routine::Language;
use rayscope::scene::{Builtin, Source};
use rayscope::system::Waker;

/// The routine in a text.
fn learn(name: &str, text: &str) -> RoutineId {
    let language = Language::of(name).unwrap();
    RoutineId::learn(name, name, text, language).unwrap_or_else(|e| panic!("{name}: {e}\n{text}"))
}

fn corpus() -> Vec<(String, RoutineId)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/routines");
    let mut names: Vec<_> = std::fs::read_dir(folder)
        .unwrap()
        .map(|e| e.unwrap().path())
        .collect();
    names.retain(|path| path.extension().is_some_and(|ending| ending != "c"));
    names.sort();
    names
        .into_iter()
        .map(|path| {
            let name = path.file_name().unwrap().to_string_lossy().into_owned();
            let text = std::fs::read_to_string(&path).unwrap();
            let id = learn(&name, &text);
            (name, id)
        })
        .collect()
}

fn bits(x: f32) -> u32 {
    if x.is_nan() {
        u32::MAX
    } else {
        (x + 0.0).to_bits()
    }
}

/// How many rays of each family are asked; `.ci/run` asks for more.
fn rays() -> usize {
    std::env::var("RAYSCOPE_ROUTINE_RAYS")
        .ok()
        .and_then(|n| n.parse().ok())
        .unwrap_or(400)
}

#[test]
fn a_method_as_text_is_that_method_bit_for_bit() {
    for method in Method::ALL {
        for (language, name) in [
            (SourceLanguage::Glsl, "copy.glsl"),
            (SourceLanguage::Wgsl, "copy.wgsl"),
        ] {
            let Ok(text) = source(method, language) else {
                let none = method == Method::Exact
                    || language == SourceLanguage::Wgsl && method == Method::Double;
                assert!(none, "{method} in {name}");
                continue;
            };
            let copy = Method::Routine(learn(&format!("{method}-{name}"), &text));
            for family in Family::ALL {
                for (ray, sphere) in family.sample(3, rays()) {
                    let [own, copied] = [method, copy].map(|m| m.solve(&ray, &sphere));
                    let what = format!(
                        "{method} {name} {}: {ray:?} {sphere:?} {own:?} {copied:?}",
                        family.name
                    );
                    if own.class == Class::Nan || own.near.is_nan() || own.far.is_nan() {
                        assert!(!own.class.meets() || copied.class == Class::Nan, "{what}");
                        assert_eq!(
                            copied.class == Class::Miss,
                            own.class == Class::Miss,
                            "{what}"
                        );
                        continue;
                    }
                    assert_eq!(own.class.meets(), copied.class.meets(), "{what}");
                    assert_eq!(
                        [own.near, own.far].map(bits),
                        [copied.near, copied.far].map(bits),
                        "{what}"
                    );
                }
            }
        }
    }
}

#[test]
fn in_arrays_each_ray_gets_the_answer_that_it_gets_alone() {
    use rayscope::method::batch::Solutions;
    let problems: Vec<_> = ["typical", "inside", "tangent", "far-4e3"]
        .into_iter()
        .flat_map(|name| {
            Family::ALL
                .iter()
                .find(|f| f.name == name)
                .unwrap()
                .sample(5, 77)
        })
        .collect();
    for (name, id) in corpus() {
        let method = Method::Routine(id);
        let arrays = rayscope::lab::timing::Arrays::of(&problems);
        let mut answers = Solutions::default();
        rayscope::lab::timing::routine(method).solve_arrays(&arrays, &mut answers);
        for (i, (ray, sphere)) in problems.iter().enumerate() {
            let (alone, among) = (method.solve(ray, sphere), answers.get(i));
            assert_eq!(alone.class, among.class, "{name} {i}");
            assert_eq!(
                [alone.near, alone.far].map(bits),
                [among.near, among.far].map(bits),
                "{name} {i}"
            );
        }
    }
}

#[test]
fn the_steps_of_a_routine_are_the_operations_that_gave_the_answer() {
    for (name, id) in corpus() {
        let method = Method::Routine(id);
        for family in ["typical", "tangent", "far-1e6"] {
            let family = Family::ALL.iter().find(|f| f.name == family).unwrap();
            for (ray, sphere) in family.sample(7, 20) {
                let trace = method.trace(&ray, &sphere);
                assert!(!trace.steps.is_empty(), "{name}");
                let last = trace.steps.last().unwrap();
                let meets = trace.solution.class.meets() && trace.truth.class.meets();
                if name.starts_with("textbook") && meets {
                    let given = last.result.parts();
                    assert_eq!(
                        bits(given[0].value as f32),
                        bits(trace.solution.near),
                        "{name}"
                    );
                    assert!(given[0].exact.is_some(), "{name}");
                }
            }
        }
    }
}

/// What each routine of the corpus is known for.
#[test]
fn the_corpus_is_judged_as_documented() {
    // Name, slips, and a family on which it is weak.
    let documented: [(&str, &[&str], &str); 16] = [
        ("fused.glsl", &[], "far-1e6"),
        ("geometric.glsl", &[], "far-4e3"),
        ("half_b.glsl", &[], "far-4e3"),
        ("hit_record.glsl", &["negative-t"], ""),
        ("in_double.glsl", &[], ""),
        ("iterated.glsl", &[], ""),
        ("nearest_float.glsl", &[], "far-4e3"),
        ("out_parameters.glsl", &[], "far-4e3"),
        ("perpendicular.glsl", &[], "surface"),
        ("projection.glsl", &["negative-t"], ""),
        ("q_form.glsl", &[], "far-4e3"),
        ("textbook.glsl", &[], "far-4e3"),
        ("textbook.wgsl", &[], "far-4e3"),
        ("unit_direction.glsl", &[], "end-minus-start"),
        ("whether.glsl", &[], "far-4e3"),
        ("with_t_min.glsl", &[], "far-4e3"),
    ];
    for ((name, id), (wanted, slips, weak)) in corpus().into_iter().zip(documented) {
        assert_eq!(name, wanted);
        if ["hit_record.glsl", "iterated.glsl"].contains(&wanted) {
            // From inside neither sees the way out: no slip of the formula, and no rounding.
            assert!(!check(id).right, "{name}");
            continue;
        }
        let found = check(id);
        let names: Vec<_> = found.slips.iter().map(|slip| slip.name()).collect();
        assert_eq!(names, slips, "{name}: {found:?}");
        let weak_on = |family: &str| found.weaknesses.iter().any(|(name, _)| *name == family);
        assert!(
            weak.is_empty() || weak_on(weak),
            "{name}: {:?}",
            found.weaknesses
        );
    }
}

#[test]
fn each_slip_is_recognised_and_its_line_found() {
    let right = "vec2 f(vec3 p0, vec3 d, vec3 c, float r) {\n  vec3 o = p0 - c;\n  float A = dot(d, d);\n  float B = 2.0 * dot(d, o);\n  float C = dot(o, o) - r * r;\n  float D = B * B - 4.0 * A * C;\n  if (D < 0.0) return vec2(-1.0);\n  float s = sqrt(D);\n  return vec2((-B - s) / (2.0 * A), (-B + s) / (2.0 * A));\n}";
    let slips = [
        ("", "", "", None),
        ("missing-4", "4.0 * A * C", "A * C", Some(6)),
        ("half-b", "2.0 * dot(d, o)", "dot(d, o)", Some(6)),
        ("sign-of-o", "p0 - c", "c - p0", Some(9)),
        ("r-for-r2", "r * r", "r", Some(5)),
        ("tangent-is-a-miss", "D < 0.0", "D <= 0.0", None),
        ("minus-b-over-a", "(2.0 * A)", "A", Some(9)),
        (
            "far-for-near",
            "vec2((-B - s) / (2.0 * A), (-B + s) / (2.0 * A))",
            "vec2((-B + s) / (2.0 * A), (-B - s) / (2.0 * A))",
            None,
        ),
    ];
    for (slip, from, to, line) in slips {
        let text = if from.is_empty() {
            right.to_owned()
        } else {
            right.replace(from, to)
        };
        let found = check(learn(&format!("slip-{slip}.glsl"), &text));
        let names: Vec<_> = found.slips.iter().map(|s| s.name()).collect();
        let wanted: Vec<_> = Some(slip).filter(|s| !s.is_empty()).into_iter().collect();
        assert_eq!(names, wanted, "{found:?}");
        assert_eq!(found.right, slip.is_empty());
        assert_eq!(found.line, line, "{slip}");
    }
}

#[test]
fn contraction_can_be_asked_for_and_ruled_out() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).display().to_string();
    let [rays, own, off] = ["rays.csv", "own.glsl", "off.glsl"].map(path);
    let mut rows = String::from("ox,oy,oz,dx,dy,dz,cx,cy,cz,r\n");
    for problem in Family::by_name("tangent").unwrap().sample(1, 300) {
        rows += &(numbers(&problem).map(|x| x.to_string()).join(",") + "\n");
    }
    let text = fs::read_to_string("tests/routines/textbook.glsl").unwrap();
    fs::write(&rays, rows).unwrap();
    fs::write(&own, &text).unwrap();
    fs::write(&off, format!("// contraction: off\n{text}")).unwrap();
    let answers = |method: &str, flags: &[&str]| {
        let batch = ["solve", "--batch", &rays, "--method", method];
        let (rows, error, status) = rayscope(&[&batch, flags].concat());
        assert_eq!(status, 0, "{error}");
        let answer = |row: &str| row.split(',').skip(10).take(3).map(str::to_owned).collect();
        rows.lines().map(answer).collect::<Vec<Vec<String>>>()
    };
    let contracted = answers("contracted", &[]);
    assert_eq!(answers(&own, &["--contract"]), contracted);
    assert_ne!(answers(&own, &[]), contracted);
    assert_eq!(answers(&off, &["--contract"]), answers("textbook", &[]));
}

fn rayscope(arguments: &[&str]) -> (String, String, i32) {
    let output = Command::new(env!("CARGO_BIN_EXE_rayscope"))
        .args(arguments)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap();
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (
        text(&output.stdout),
        text(&output.stderr),
        output.status.code().unwrap(),
    )
}

#[test]
fn the_program_takes_a_routine_where_it_takes_a_method() {
    let own = "tests/routines/textbook.glsl";
    let (screen, _, status) =
        rayscope(&["print", "tutorial", "--style", "tutorial", "--method", own]);
    assert_eq!((screen.matches("++").count(), status), (317, 0));
    let numbers = ["--ray", "20,20,0,0,0,1", "--sphere", "20,20,20,10"];
    let (steps, _, status) = rayscope(&[&["solve", "--method", own], &numbers[..]].concat());
    assert!(
        steps.contains("b = 2.0 * dot(direction, o)\n    2.0 * dot((0, 0, 1), (0, 0, −20)) → −40"),
        "{steps}"
    );
    assert!(
        steps.contains("line 3: from the centre to where the ray starts"),
        "{steps}"
    );
    assert_eq!(status, 0);
    let (_, error, status) = rayscope(&["print", "trio", "--method", "none.glsl"]);
    assert!(error.contains("none.glsl: found no such file"), "{error}");
    assert_eq!(status, 1);
    let (report, _, status) = rayscope(&["check", own, "--format", "json"]);
    assert!(
        report.contains("\"verdict\": \"right\"") && status == 0,
        "{report}"
    );
}

#[test]
fn a_replaced_text_frees_the_ones_before_it_and_old_handles_still_answer() {
    let text =
        |n: i32| format!("float f(vec3 ro, vec3 rd, vec3 ce, float ra) {{ return ra * {n}.0; }}");
    let first = learn("typed.glsl", &text(1));
    let held = std::sync::Arc::downgrade(&first.get());
    for n in 2..30 {
        learn("typed.glsl", &text(n));
    }
    assert!(held.upgrade().is_none(), "the first version is still held");
    let ray = rayscope::geometry::Ray::new([0.0; 3].into(), [1.0, 0.0, 0.0].into()).unwrap();
    let sphere = rayscope::geometry::Sphere::new([0.0; 3].into(), 1.0).unwrap();
    assert_eq!(Method::Routine(first).solve(&ray, &sphere).near, 29.0);
}

/// An explorer of the tutorial's scene in that folder, and what it rings when a file has changed.
fn explorer_in(folder: &Path) -> (Explorer, Receiver<()>) {
    let source = Source::Builtin(Builtin::Tutorial);
    let mut explorer = Explorer::new(Builtin::Tutorial.scene(), &source, Options::default());
    let mut workplace = Workplace::within(folder);
    workplace.state = Some(folder.join("state"));
    explorer.work_in(workplace, &source);
    let (ring, rung) = mpsc::channel();
    explorer.wake_by(Waker::new(move || {
        // Nobody listens any more once the test has ended.
        let _ = ring.send(());
    }));
    (explorer, rung)
}

fn press(explorer: &mut Explorer, code: KeyCode, modifiers: KeyModifiers) -> String {
    explorer.update(&Event::Key(KeyEvent::new(code, modifiers)));
    screen(explorer)
}

/// Types a text, with enter at the end of its lines.
fn types(explorer: &mut Explorer, text: &str) -> String {
    for c in text.chars() {
        let code = if c == '\n' {
            KeyCode::Enter
        } else {
            KeyCode::Char(c)
        };
        press(explorer, code, KeyModifiers::NONE);
    }
    screen(explorer)
}

/// An explorer with a routine in a folder of its own, and what it rings when the file has changed.
fn explorer_with(name: &str, text: &str) -> (tempfile::TempDir, Explorer, Receiver<()>) {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join(name), text).unwrap();
    let (mut explorer, rung) = explorer_in(folder.path());
    types(&mut explorer, &format!(":method {name}\n"));
    (folder, explorer, rung)
}

fn screen(explorer: &mut Explorer) -> String {
    explorer.prepare(80, 24);
    let mut buffer = Buffer::empty(Rect::new(0, 0, 80, 24));
    explorer.draw(&mut buffer);
    buffer.content().iter().map(Cell::symbol).collect()
}

#[test]
fn a_routine_that_is_saved_is_read_again_and_one_with_an_error_is_not_taken() {
    let text = fs::read_to_string("tests/routines/textbook.glsl").unwrap();
    let (folder, mut explorer, rung) = explorer_with("mine.glsl", &text);
    let file = folder.path().join("mine.glsl");
    let mut is_saved = |text: &str| {
        fs::write(&file, text).unwrap();
        rung.recv_timeout(Duration::from_secs(20)).expect("woken");
        assert!(explorer.catch_up());
        screen(&mut explorer)
    };
    let found = is_saved(&text.replace("< 0.0", "< 1e9"));
    assert!(found.contains("mine.glsl: read again"), "{found}");
    let missed = is_saved(&text.replace("< 0.0", "< 0.0 0.0"));
    assert!(missed.contains("the one before stays"), "{missed}");
    assert!(missed.contains(" mine.glsl "), "{missed}");
}

#[test]
fn a_routine_is_typed_and_the_picture_follows_the_last_text_without_an_error() {
    let folder = tempfile::tempdir().unwrap();
    let (mut explorer, _rung) = explorer_in(folder.path());
    let found = types(&mut explorer, ":routine mine\n");
    assert!(found.contains("bool intersectRaySphere("), "{found}");
    let meets = |explorer: &Explorer| {
        let subject = explorer.reading().unwrap().subject.as_ref();
        subject.is_some_and(|subject| subject.solution.class.meets())
    };
    assert!(meets(&explorer));
    let paste = |explorer: &mut Explorer, text: &str| {
        explorer.update(&Event::Paste(text.to_owned()));
        screen(explorer)
    };
    let miss = "bool f(vec3 ro, vec3 rd, vec3 ce, float ra) {\r  return ra < 0.0;\r}\rq";
    let found = paste(&mut explorer, miss);
    assert!(found.contains("│! 4 q//"), "{found}");
    assert!(found.contains("line 4:"), "{found}");
    assert!(meets(&explorer), "the text before the error is drawn");
    press(&mut explorer, KeyCode::Backspace, KeyModifiers::NONE);
    let found = types(&mut explorer, "// routine: f\n");
    assert!(!found.contains("line 4:"), "{found}");
    assert!(!meets(&explorer), "{found}");
    let asked = press(&mut explorer, KeyCode::Esc, KeyModifiers::NONE);
    assert!(asked.contains("The text is not saved."), "{asked}");
    types(&mut explorer, "s");
    let saved = fs::read_to_string(folder.path().join("mine.glsl")).unwrap();
    assert!(saved.starts_with("bool f(vec3 ro"), "{saved}");
    assert_eq!(explorer.viewpoint().method.name(), "mine.glsl");
}

#[test]
fn what_is_typed_is_dropped_only_by_an_answer_and_replaces_no_change_of_the_file() {
    let text = fs::read_to_string("tests/routines/textbook.glsl").unwrap();
    let (folder, mut explorer, _rung) = explorer_with("mine.glsl", &text);
    let file = folder.path().join("mine.glsl");
    types(&mut explorer, ":routine\n// typed\n");
    fs::write(&file, text.replace("origin", "start")).unwrap();
    let asked = press(&mut explorer, KeyCode::Char('s'), KeyModifiers::CONTROL);
    assert!(asked.contains("was changed by somebody else"), "{asked}");
    types(&mut explorer, "o");
    assert!(fs::read_to_string(&file).unwrap().starts_with("// typed\n"));
    types(&mut explorer, "// more\n");
    let asked = press(&mut explorer, KeyCode::Char('c'), KeyModifiers::CONTROL);
    assert!(asked.contains("The text is not saved."), "{asked}");
    types(&mut explorer, "D");
    assert!(!fs::read_to_string(&file).unwrap().contains("// more"));
    let found = types(&mut explorer, ":routine\n");
    assert!(
        found.contains("// typed") && !found.contains("// more"),
        "{found}"
    );
    assert_eq!(explorer.ended(), None);
}

#[test]
fn what_was_typed_outlives_the_terminal() {
    let folder = tempfile::tempdir().unwrap();
    let (mut explorer, _rung) = explorer_in(folder.path());
    types(&mut explorer, ":routine mine.wgsl\n// typed\n");
    explorer.finish().unwrap();
    let (mut again, _rung) = explorer_in(folder.path());
    let found = types(&mut again, ":routine mine.wgsl\n");
    assert!(found.contains("// typed"), "{found}");
    assert!(found.contains("typed before and not saved"), "{found}");
    press(&mut again, KeyCode::Esc, KeyModifiers::NONE);
    types(&mut again, "D");
    let found = types(&mut again, ":routine mine.wgsl\n");
    assert!(!found.contains("// typed"), "{found}");
}

#[test]
fn what_can_not_be_typed_is_refused_in_a_sentence() {
    let folder = tempfile::tempdir().unwrap();
    let (mut explorer, _rung) = explorer_in(folder.path());
    for (line, sentence) in [
        (":routine\n", "expected a name after it"),
        (":routine mine.toml\n", "ends in .glsl or .wgsl"),
        (":routine ../mine.glsl\n", "outside of the folder"),
        (":edit mine.glsl\n", "no program is started here"),
    ] {
        let found = types(&mut explorer, line);
        assert!(found.contains(sentence), "{line}: {found}");
    }
    types(&mut explorer, ":routine mine\n");
    explorer.update(&Event::Paste("/".repeat(rayscope::routine::LONGEST)));
    let found = screen(&mut explorer);
    assert!(found.contains("at most 64 KiB"), "{found}");
}

#[test]
fn a_routine_is_asked_everywhere_that_a_method_is_named() {
    let own = "tests/routines/textbook.glsl";
    let problem = ["--ray", "20,20,0,0,0,1", "--sphere", "20,20,20,10"];
    for (line, flags) in [
        ("print tutorial --pixel 20,20", &[][..]),
        ("print tutorial --style tutorial", &[]),
        ("solve", &problem),
        ("stress --quick --dial distance", &[]),
        ("bench --quick --family typical", &[]),
        ("plan tutorial", &[]),
    ] {
        let words: Vec<_> = line.split(' ').chain(flags.iter().copied()).collect();
        let asked = [&words[..], &["--method", own]].concat();
        let (found, error, status) = rayscope(&asked);
        assert_eq!(status, 0, "{line}: {error}");
        let pictures = found.matches("++").count() == 317;
        assert!(
            pictures || found.contains("textbook.glsl"),
            "{line}: {found}"
        );
    }
    let folder = tempfile::tempdir().unwrap();
    let text = fs::read_to_string(own).unwrap();
    fs::write(folder.path().join("mine.glsl"), &text).unwrap();
    let (mut explorer, _rung) = explorer_in(folder.path());
    for (keys, shown) in [
        (":method mine.glsl\n", "machine   mine.glsl"),
        (":method exact\nm", "machine   mine.glsl"),
        (":method kahan\n:compare mine.glsl\n", "mine.glsl"),
        (":method mine.glsl\n:dial distance 4\n", "mine.glsl"),
        (":dial distance 0\n%", "mine.glsl"),
    ] {
        let found = types(&mut explorer, keys);
        assert!(found.contains(shown), "{keys}: {found}");
    }
    let page = "title = \"own\"\n[[page]]\nscene = \"tutorial\"\nmethod = \"mine.glsl\"\nlens = \"machine\"\ntext = \"One.\"";
    let chapter = folder.path().join("own.toml");
    fs::write(&chapter, page).unwrap();
    let chapters = rayscope::explorer::tour::load(&chapter).unwrap();
    explorer.start_tour(chapters, 0, 0);
    let found = screen(&mut explorer);
    assert!(found.contains("machine   mine.glsl"), "{found}");
    fs::write(&chapter, page.replace("mine", "none")).unwrap();
    let refused = rayscope::explorer::tour::load(&chapter)
        .unwrap_err()
        .to_string();
    assert!(
        refused.contains("method: ") && refused.contains("no such file"),
        "{refused}"
    );
}

#[test]
fn whether_a_bool_counts_what_lies_behind_the_eye_is_found_out_and_said() {
    let head = "bool f(vec3 ro, vec3 rd, vec3 ce, float ra) {\n  vec3 o = ro - ce;\n  float b = dot(o, rd);\n  float D = b * b - dot(rd, rd) * (dot(o, o) - ra * ra);";
    let line = learn("line.glsl", &format!("{head}\n  return D >= 0.0;\n}}"));
    let before = learn(
        "before.glsl",
        &format!("{head}\n  return D >= 0.0 && b < 0.0;\n}}"),
    );
    assert!(
        line.words().ends_with("behind the eye is a hit, too"),
        "{}",
        line.words()
    );
    assert!(
        before.words().ends_with("behind the eye is no hit"),
        "{}",
        before.words()
    );
    let text = fs::read_to_string("tests/routines/whether.glsl").unwrap();
    let (_folder, mut explorer, _rung) = explorer_with("mine.glsl", &text);
    let found = screen(&mut explorer);
    assert!(found.contains("A to Δ are those of double"), "{found}");
    assert!(!found.contains("NaN"), "a bool gives no root: {found}");
    let (report, _, _) = rayscope(&["check", "tests/routines/whether.glsl"]);
    assert!(report.contains("behind the eye"), "{report}");
}
