//! `rayscope print`, run as a program.

use std::process::{Command, Output, Stdio};

fn rayscope(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_rayscope"));
    command
        .args(arguments)
        .env_remove("NO_COLOR")
        .env("LC_ALL", "C");
    command
}

fn run(arguments: &[&str]) -> Output {
    rayscope(arguments).output().expect("the program runs")
}

fn text(arguments: &[&str]) -> String {
    let output = run(arguments);
    assert!(output.status.success(), "{output:?}");
    assert!(output.stderr.is_empty(), "{output:?}");
    String::from_utf8(output.stdout).expect("text")
}

#[test]
fn the_seed_is_the_tutorials_text() {
    let expected: String = (0..40_i32)
        .flat_map(|y| {
            let row = (0..40_i32).map(move |x| {
                if (x - 20).pow(2) + (y - 20).pow(2) <= 100 {
                    "++"
                } else {
                    "--"
                }
            });
            row.chain(["\n"])
        })
        .collect();
    for more in [&[][..], &["--color", "true"], &["--size", "40x40"]] {
        let arguments = [&["print", "tutorial", "--style", "tutorial"], more].concat();
        assert_eq!(text(&arguments), expected, "{more:?}");
    }
    assert_eq!(expected.matches("++").count(), 317);
}

#[test]
fn a_pipe_gets_plain_ascii_of_80_by_24() {
    let text = text(&["print", "trio"]);
    assert!(text.is_ascii() && !text.contains('\x1b'));
    assert_eq!(text.lines().count(), 24);
    assert!(text.lines().all(|line| line.len() == 80));
}

#[test]
fn a_size_is_in_pixels() {
    for (style, cells) in [
        ("ascii", (30, 20)),
        ("tutorial", (60, 20)),
        ("half", (30, 10)),
        ("braille", (15, 5)),
    ] {
        let text = text(&["print", "trio", "--style", style, "--size", "30x20"]);
        let widest = text.lines().map(|line| line.chars().count()).max();
        assert_eq!(
            (widest, text.lines().count()),
            (Some(cells.0), cells.1),
            "{style}"
        );
    }
}

#[test]
fn the_class_view_of_the_seed_has_its_twelve_tangents() {
    let text = text(&["print", "tutorial", "--style", "ascii", "--view", "class"]);
    assert_eq!(text.matches('o').count(), 12);
    assert_eq!(text.matches('#').count(), 305);
    assert_eq!(text.matches('.').count(), 1600 - 317);
}

#[test]
fn colours_are_as_asked_even_in_a_pipe() {
    let with = |color| text(&["print", "trio", "--color", color]);
    assert!(with("true").contains("\x1b[38;2;"));
    assert!(with("256").contains("\x1b[38;5;") && !with("256").contains("8;2;"));
    assert!(with("16").contains("\x1b[9") && !with("16").contains("8;"));
    assert!(!with("never").contains('\x1b'));
    for line in with("256").lines().filter(|line| line.contains('\x1b')) {
        assert!(line.ends_with("\x1b[0m"), "{line:?}");
    }
}

#[test]
fn a_pixel_is_told_in_the_words_of_the_panel() {
    let text = text(&["print", "tutorial", "--pixel", "20,20"]);
    for part in [
        "ray at (20, 20)",
        "20, 20, 0",
        "-40",
        "300",
        "400",
        "it meets in two points",
    ] {
        let plain = text.replace('−', "-");
        assert!(plain.contains(part), "{part} in {text}");
    }
}

#[test]
fn a_pixel_is_also_data_and_a_part_of_a_document() {
    let pixel = ["print", "tutorial", "--pixel", "20,20"];
    let with = |more: &[&str]| text(&[&pixel[..], more].concat());
    let json: serde_json::Value = serde_json::from_str(&with(&["--format", "json"])).unwrap();
    assert_eq!(json["pixel"], serde_json::json!([20, 20]));
    assert_eq!(
        json["sphere"]["center"],
        serde_json::json!([20.0, 20.0, 20.0])
    );
    assert_eq!(
        (&json["lens"], &json["class"]),
        (&"mathematics".into(), &"secant".into())
    );
    let steps = json["steps"].as_array().unwrap();
    let step = |name: &str| steps.iter().find(|step| step["name"] == name).unwrap();
    let delta = &step("Δ")["equations"][0];
    assert_eq!(delta["formula"], "Δ = B² − 4AC");
    let result = delta["links"].as_array().unwrap().last().unwrap();
    assert_eq!(
        (&result["sign"], &result["text"]),
        (&"=".into(), &"400".into())
    );
    // The machine's sheet, and every line of the text is in the document, but for its reasons and how they are broken.
    let machine = with(&["--format", "json", "--method", "textbook"]);
    assert!(machine.contains("\"lens\": \"machine\"") && machine.contains("\"→\""));
    let markdown = with(&["--format", "markdown"]);
    for part in [
        "### A\n",
        "0^2 + 0^2 + 1^2 = 1\n",
        "```text\nfloat A = ",
        "What multiplies t^2",
    ] {
        assert!(markdown.contains(part), "{part}: {markdown}");
    }
    let refused = run(&["print", "tutorial", "--format", "json"]);
    assert_eq!(refused.status.code(), Some(2));
}

#[test]
fn what_is_asked_wrongly_is_told_in_a_sentence() {
    for (arguments, status, sentence) in [
        (&["print"][..], 2, "<SCENE>"),
        (&["print", "tutorial", "--style", "hlaf"], 2, "half"),
        (&["print", "tutorial", "--size", "0x9"], 2, "from 1 to 4096"),
        (&["print", "tutorial", "--aspect", "NaN"], 2, "0.5 to 4"),
        (&["print", "tutorial", "--pixel", "1"], 2, "20,20"),
        (
            &["print", "tutorial", "--pixel", "40,0"],
            2,
            "from 0,0 to 39,39",
        ),
        (&["print", "no-such-scene"], 1, "no-such-scene"),
    ] {
        let output = run(arguments);
        assert_eq!(output.status.code(), Some(status), "{output:?}");
        assert!(output.stdout.is_empty());
        let told = String::from_utf8_lossy(&output.stderr);
        assert!(told.contains(sentence), "{told}");
    }
}

#[test]
fn a_reader_that_leaves_ends_it_quietly() {
    let mut child = rayscope(&[
        "print",
        "tutorial",
        "--size",
        "4000x2000",
        "--style",
        "ascii",
    ])
    .stdout(Stdio::piped())
    .stderr(Stdio::piped())
    .spawn()
    .expect("the program runs");
    drop(child.stdout.take());
    let output = child.wait_with_output().expect("the program ends");
    assert_eq!(output.status.code(), Some(0));
    assert!(output.stderr.is_empty(), "{output:?}");
}

#[test]
fn the_steps_of_a_pixel_are_the_whole_derivation() {
    let pixel = [
        "print", "tutorial", "--pixel", "20,20", "--method", "textbook",
    ];
    let text = text(&[&pixel[..], &["--steps"]].concat());
    let title = "ray at (20, 20) of 40 by 40 pixels, lens machine, method textbook\n";
    assert!(text.starts_with(title), "{text}");
    for paragraph in [
        "A = d*d\n  0^2 + 0^2 + 1^2 -> 1\n",
        "  float a = vectorDot(&d, &d);\n",
        "disc = B^2 - 4AC\n  1600 - 1200 -> 400\n",
        "  0 < 10, a hit: the near point is seen\n",
    ] {
        assert!(text.contains(paragraph), "no {paragraph:?} in\n{text}");
    }
    assert!(text.is_ascii(), "a pipe in the locale C");
}

#[test]
fn steps_and_solve_say_the_same_of_what_was_lost() {
    let steps = text(&[
        "print", "far", "--size", "40x40", "--style", "half", "--pixel", "20,20", "--method",
        "textbook", "--steps",
    ]);
    let panel = Command::new(env!("CARGO_BIN_EXE_rayscope"))
        .args(["solve", "--ray=-4100,0.5,0,1,0,0", "--sphere=0,0,0,1"])
        .args(["--method", "textbook"])
        .output()
        .expect("the program runs");
    let solved = String::from_utf8(panel.stdout).expect("text");
    for said in ["exactly ", " ulp off\n", ": the first step to lose much\n"] {
        assert!(steps.contains(said), "no {said:?} in\n{steps}");
        assert!(solved.contains(said), "no {said:?} in\n{solved}");
    }
}

#[test]
fn steps_without_a_pixel_are_misuse() {
    let output = run(&["print", "tutorial", "--steps"]);
    assert_eq!(output.status.code(), Some(2));
    let said = String::from_utf8(output.stderr).expect("text");
    assert!(said.contains("--pixel"), "{said}");
}

#[test]
fn a_pixel_says_which_sphere_is_seen_and_which_is_in_front() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("far.toml");
    let scene = "name = \"far\"\n[camera]\nprojection = \"orthographic\"\nextent = [4, 4]\npixels = [40, 40]\n\
        position = [0, 0, 1e7]\nlook_at = [0, 0, 0]\nup = [0, 1, 0]\n\
        [[sphere]]\ncenter = [0, 0, 0]\nradius = 1\n[[sphere]]\ncenter = [0, 0, 0]\nradius = 1.2\n";
    std::fs::write(&file, scene).expect("a file");
    let panel = |method| {
        let file = file.to_str().expect("a path");
        text(&["print", file, "--pixel", "20,20", "--method", method])
    };
    let line = |panel: &str| {
        let line = panel.lines().find(|line| line.contains("nearest hit"));
        line.expect("a nearest hit").to_owned()
    };
    let exact = panel("exact");
    assert!(line(&exact).contains("sphere 2 of 2"), "{exact}");
    assert!(!exact.contains("wrong sphere"), "{exact}");
    let double = panel("double");
    assert!(line(&double).contains("sphere 1 of 2"), "{double}");
    assert!(
        double.contains("wrong sphere seen: 1, but exactly 2"),
        "{double}"
    );
}
