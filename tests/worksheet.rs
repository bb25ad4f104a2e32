//! `rayscope worksheet`: exercises that can be worked by hand, and answers that are right.

use std::collections::BTreeSet;
use std::process::Command;

use rayscope::scene::Builtin;

struct Run {
    status: i32,
    out: String,
    err: String,
}

fn rayscope(arguments: &str) -> Run {
    let run = Command::new(env!("CARGO_BIN_EXE_rayscope"))
        .args(arguments.split_whitespace())
        .env("LC_ALL", "C.UTF-8")
        .output()
        .expect("the program");
    let text = |bytes| String::from_utf8(bytes).expect("UTF-8");
    Run {
        status: run.status.code().expect("an exit status"),
        out: text(run.stdout),
        err: text(run.stderr),
    }
}

fn worksheet(arguments: &str) -> String {
    let run = rayscope(&format!("worksheet {arguments}"));
    assert_eq!(run.status, 0, "{}", run.err);
    run.out
}

#[test]
fn the_tutorials_screen_makes_a_sheet_in_whole_numbers() {
    insta::assert_snapshot!(worksheet("tutorial --seed 4 --count 5"));
}

#[test]
fn a_sheet_in_markdown() {
    insta::assert_snapshot!(worksheet("trio --seed 4 --count 3 --format markdown"));
}

#[test]
fn both_parts_are_those_that_come_alone_and_a_seed_is_a_sheet() {
    for scene in Builtin::ALL.map(Builtin::name) {
        let both = worksheet(&format!("{scene} --seed 9"));
        let pages: Vec<_> = both.split('\u{c}').collect();
        let [exercises, key] = pages[..] else {
            panic!("{} pages", pages.len());
        };
        assert_eq!(
            exercises,
            worksheet(&format!("{scene} --seed 9 --only exercises"))
        );
        assert_eq!(key, worksheet(&format!("{scene} --seed 9 --only key")));
        assert_ne!(
            exercises,
            worksheet(&format!("{scene} --seed 10 --only exercises"))
        );
        let number = |text: &str| {
            text.lines()
                .filter(|l| l.starts_with(|c: char| c.is_ascii_digit()))
                .count()
        };
        assert!(number(exercises) >= 3, "{scene}: {exercises}");
        assert_eq!(number(exercises), number(key));
        for line in both.lines() {
            assert!(line.chars().count() <= 80, "{scene}: {line}");
            assert_eq!(line, line.trim_end());
        }
        // The answers are on the second page only.
        assert!(
            !exercises.contains("≈ ") && !exercises.contains("crosses, in"),
            "{exercises}"
        );
    }
}

#[test]
fn what_a_scene_shows_is_what_its_sheet_asks() {
    let asked = |arguments: &str| -> BTreeSet<String> {
        let key = worksheet(&format!("{arguments} --only key"));
        let words = [
            "it misses",
            "it touches",
            "it crosses",
            "p0 is inside",
            "behind the eye",
            "the least above 0",
            "binary32",
        ];
        let text = worksheet(arguments)
            .split_whitespace()
            .collect::<Vec<_>>()
            .join(" ");
        assert!(!key.is_empty());
        words
            .into_iter()
            .filter(|w| text.contains(w))
            .map(str::to_owned)
            .collect()
    };
    let has = |arguments: &str, words: &[&str]| {
        let found = asked(arguments);
        for word in words {
            assert!(
                found.contains(*word),
                "{arguments} does not ask for {word}: {found:?}"
            );
        }
    };
    has("tutorial", &["it misses", "it touches", "it crosses"]);
    has("trio", &["it misses", "it crosses"]);
    has("inside", &["p0 is inside"]);
    has("behind", &["behind the eye"]);
    has("planet", &["the least above 0"]);
    has("far", &["binary32", "it crosses"]);
    has("grazing", &["binary32"]);
}

/// The command of the key, for a pixel of it, gives the ray of the sheet.
#[test]
fn the_key_names_the_command_that_shows_a_pixel() {
    for (scene, count) in [("tutorial", 8), ("three-lines", 8)] {
        let both = worksheet(&format!("{scene} --count {count}"));
        let words: Vec<_> = both.split_whitespace().collect();
        let at = words
            .iter()
            .position(|&w| w == "rayscope")
            .expect("a command");
        let end = words.iter().position(|&w| w == "--steps").expect("its end");
        let command = words[at + 1..=end].join(" ");
        let mut seen = 0;
        let lines: Vec<_> = both.lines().collect();
        for pair in lines.windows(2) {
            let Some(place) = pair[0].trim().strip_prefix("The ray of pixel (") else {
                continue;
            };
            let pixel = place.split(')').next().unwrap().replace(", ", ",");
            let shown = rayscope(&command.replace("X,Y", &pixel));
            assert_eq!(shown.status, 0, "{}", shown.err);
            let numbers = pair[1].split_whitespace().collect::<Vec<_>>().join(" ");
            let result = shown.out.split_whitespace().collect::<Vec<_>>().join(" ");
            for part in numbers.split(" d = ") {
                let vector = part.trim_start_matches("p0 = ");
                assert!(result.contains(vector), "{numbers} is not in {result}");
            }
            seen += 1;
        }
        assert!(seen >= 6, "{both}");
    }
}

#[test]
fn where_the_locale_is_not_utf8_the_sheet_is_ascii() {
    let run = Command::new(env!("CARGO_BIN_EXE_rayscope"))
        .args(["worksheet", "far"])
        .env("LC_ALL", "C")
        .output()
        .expect("the program");
    assert!(run.stdout.is_ascii());
    let text = String::from_utf8(run.stdout).expect("ASCII");
    assert!(text.contains("disc = B^2 - 4AC"), "{text}");
    // A character without a spelling would be a question mark among the formulas.
    assert!(!text.contains("? =") && !text.contains("??"), "{text}");
}

#[test]
fn what_makes_no_sheet_is_said_in_a_sentence() {
    let empty = tempfile::Builder::new()
        .suffix(".toml")
        .tempfile()
        .expect("a file");
    let file = empty.path().display().to_string();
    let text = rayscope("scenes tutorial").out;
    let end = text.find("[[sphere]]").expect("a sphere");
    let rest = text[end..]
        .find("[[probe]]")
        .map_or("", |at| &text[end + at..]);
    std::fs::write(&file, text[..end].to_owned() + rest).expect("to write");
    for (arguments, status, said) in [
        ("nowhere", 1, "nowhere"),
        (file.as_str(), 1, "the scene has no spheres"),
        ("tutorial --count 0", 2, "a whole number from 1 to 100"),
        ("tutorial --size 0x4", 2, "--size"),
        ("tutorial --format pdf", 2, "--format"),
    ] {
        let run = rayscope(&format!("worksheet {arguments}"));
        assert_eq!(run.status, status, "{arguments}: {}", run.err);
        assert!(run.err.contains(said), "{arguments}: {}", run.err);
        assert_eq!(run.out, "");
    }
}
