//! The command line: help, environment variables, completions, and the explorer in lines of text.

use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Output, Stdio};

use rayscope::lab::BenchQueue;

/// A start of the program with nothing in its environment but a home.
fn rayscope(home: &Path, arguments: &[&str]) -> Command {
    let queue = BenchQueue::private();
    let (variable, queue) = queue.variable();
    let mut command = Command::new(env!("CARGO_BIN_EXE_rayscope"));
    command
        .args(arguments)
        .env_clear()
        .env(variable, queue)
        .env("HOME", home)
        .env("LANG", "C.UTF-8")
        .current_dir(home)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    command
}

fn output(mut command: Command, input: &str) -> Output {
    let mut child = command.spawn().expect("the program");
    let mut stdin = child.stdin.take().expect("its input");
    // Where it ends before it has read all, nobody needs the rest.
    let _ = stdin.write_all(input.as_bytes());
    drop(stdin);
    child.wait_with_output().expect("its output")
}

/// What a script of commands is answered.
struct Script {
    home: tempfile::TempDir,
    said: String,
    complained: String,
    status: Option<i32>,
}

fn script(arguments: &[&str], lines: &str) -> Script {
    let home = tempfile::tempdir().expect("a home");
    let command = rayscope(home.path(), &[arguments, &["--plain"]].concat());
    let output = output(command, lines);
    Script {
        home,
        said: String::from_utf8(output.stdout).expect("text"),
        complained: String::from_utf8(output.stderr).expect("text"),
        status: output.status.code(),
    }
}

impl Script {
    fn says(&self, text: &str) {
        assert!(self.said.contains(text), "no “{text}” in\n{}", self.said);
    }
}

#[test]
fn help_names_every_command_flag_and_variable() {
    let home = tempfile::tempdir().unwrap();
    let help = output(rayscope(home.path(), &["--help"]), "");
    insta::assert_snapshot!("help", String::from_utf8(help.stdout).unwrap());
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_a_failure_and_a_closed_pipe_is_none() {
    let home = tempfile::tempdir().unwrap();
    let rows = "ox,oy,oz,dx,dy,dz,cx,cy,cz,r\n0,0,0,0,0,1,0,0,9,1\n";
    for line in [
        "--help",
        "--version",
        "solve --help",
        "completions bash",
        "print trio",
        "scenes",
        "tour --list",
        "plan trio",
        "worksheet tutorial",
        "solve --ray=0,0,0,0,0,1 --sphere=0,0,9,1",
        "solve --batch -",
    ] {
        let words: Vec<_> = line.split(' ').collect();
        let mut full = rayscope(home.path(), &words);
        full.stdout(fs::File::options().write(true).open("/dev/full").unwrap());
        let full = output(full, rows);
        let said = String::from_utf8(full.stderr).unwrap();
        assert_eq!(full.status.code(), Some(1), "{line}: {said}");
        assert!(
            said.starts_with("rayscope: standard output: "),
            "{line}: {said}"
        );
        assert_eq!(said.lines().count(), 1, "{line}: {said}");

        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let mut closed = rayscope(home.path(), &words);
        closed.stdout(writer);
        let closed = output(closed, rows);
        assert_eq!(closed.status.code(), Some(0), "{line}");
        assert_eq!(String::from_utf8(closed.stderr).unwrap(), "", "{line}");
    }
}

#[test]
fn a_variable_stands_for_its_flag_and_gives_way_to_it() {
    let home = tempfile::tempdir().unwrap();
    let said = |variable: (&str, &str), arguments: &[&str]| {
        let mut command = rayscope(home.path(), arguments);
        command.env(variable.0, variable.1);
        String::from_utf8(output(command, "").stdout).unwrap()
    };
    let method = ["print", "tutorial", "--pixel", "20,20", "--lens", "machine"];
    assert!(said(("RAYSCOPE_METHOD", "kahan"), &method).contains("method kahan"));
    assert!(said(("RAYSCOPE_METHOD", ""), &method).contains("method exact"));
    let both = [&method[..], &["--method", "haines"]].concat();
    assert!(said(("RAYSCOPE_METHOD", "kahan"), &both).contains("method haines"));
    let picture = ["print", "tutorial"];
    assert!(said(("RAYSCOPE_STYLE", "tutorial"), &picture).contains("--++"));
    let colored = said(
        ("RAYSCOPE_COLOR", "256"),
        &["print", "trio", "--style", "half"],
    );
    assert!(colored.contains("\x1b[38;5;"));
}

#[test]
fn a_bad_value_of_a_variable_gets_a_sentence_that_names_it() {
    let home = tempfile::tempdir().unwrap();
    for (name, value) in [
        ("RAYSCOPE_THEME", "pink"),
        ("RAYSCOPE_COLOR", "17"),
        ("RAYSCOPE_STYLE", "oil"),
        ("RAYSCOPE_METHOD", "guess"),
    ] {
        let mut command = rayscope(home.path(), &["--plain"]);
        command.env(name, value);
        let output = output(command, "");
        let said = String::from_utf8(output.stderr).unwrap();
        assert!(said.starts_with(&format!("rayscope: {name} is “{value}”: expected one of ")));
        assert_eq!(said.lines().count(), 1, "{said}");
        assert_eq!(output.status.code(), Some(2));
    }
    let mut command = rayscope(home.path(), &["--theme", "pink"]);
    command.env("RAYSCOPE_THEME", "pink");
    let said = String::from_utf8(output(command, "").stderr).unwrap();
    assert!(
        said.contains("--theme <THEME>"),
        "the flag is at fault: {said}"
    );
}

#[test]
fn every_shell_gets_its_completions() {
    let home = tempfile::tempdir().unwrap();
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let output = output(rayscope(home.path(), &["completions", shell]), "");
        let script = String::from_utf8(output.stdout).unwrap();
        // The last two do not complete values.
        let values: &[_] = match shell {
            "bash" | "zsh" | "fish" => &["high-contrast", "textbook"],
            _ => &[],
        };
        for word in ["theme", "batch"].iter().chain(values) {
            assert!(script.contains(word), "{shell}: no {word}");
        }
        assert!(output.status.success());
    }
}

#[test]
fn a_script_explores_and_is_told_what_changed() {
    let script = script(
        &["tutorial", "--method", "textbook"],
        "# the pixel three to the right\ncursor-right 3\n\nnext-method\nshow quadratic\nquit\nnever read\n",
    );
    script.says("A 1; B −40; C 300; Δ 400; near 10; far 30");
    script.says("\npixel (23, 20); C 309; Δ 364; near 10.4606; far 29.5394;");
    script.says("\nmethod contracted");
    script.says("C    |p0−c|² − r²   →  309");
    assert!(!script.said.contains("never"));
    assert!(!script.said.contains("\n> "), "a prompt in a pipe");
    assert_eq!((script.status, script.complained.as_str()), (Some(0), ""));
}

#[test]
fn every_panel_has_its_text_form() {
    let panels: Vec<_> = rayscope::explorer::Panel::ALL
        .map(rayscope::explorer::Panel::name)
        .into();
    for scene in ["tutorial", "trio"] {
        let others = ["view", "numbers"];
        let lines = panels
            .iter()
            .chain(&others)
            .map(|name| format!("show {name}\n"));
        let script = script(&[scene], &lines.collect::<String>());
        for text in [
            "ray of pixel (",
            "step 1 of",
            "slice through",
            "f(t) = At² + Bt + C",
            "bits of",
        ] {
            script.says(text);
        }
        script.says("view of 40×");
        script.says("\nradius 1");
        assert!(!script.said.contains('\x1b'));
        assert_eq!(script.status, Some(0));
    }
}

#[test]
fn lines_of_text_have_the_names_of_the_menu_and_an_empty_one_is_the_next_step() {
    let lines = "left 3\nright\ntangent\nnext\n\n\nback\nadd\ndelete\ngrow\nsmaller\nundo\n";
    let script = script(&["tutorial"], lines);
    for text in [
        "pixel (17, 20)",
        "pixel (18, 20)",
        "step 1 of",
        "step 3 of",
        "step 2 of",
        "undo brings it back",
        "Undone: sphere 1 was made smaller.",
    ] {
        script.says(text);
    }
    assert!(!script.said.contains(". u "), "{}", script.said);
    assert_eq!(script.status, Some(0));
}

#[test]
fn a_line_that_can_not_be_done_gets_a_sentence_and_the_rest_goes_on() {
    let bad = [
        "nonsense",
        "cursor 400 0",
        "cursor-right 0",
        "cursor-right many",
        "set radius -1",
        "show nothing",
        "open",
        "save",
        "suspend",
        "help nonsense",
        "\u{fffd}",
    ];
    for line in bad {
        let script = script(&["tutorial"], &format!("{line}\ncursor 1 2\n"));
        script.says("pixel (1, 2)");
        assert_eq!(script.status, Some(1), "{line}: {}", script.said);
    }
    let long = "x".repeat(100_000);
    let script = script(&["tutorial"], &format!("{long}\ncursor 1 2"));
    script.says("longer than 65536 bytes");
    script.says("pixel (1, 2)");
    assert_eq!(script.status, Some(1));
}

#[test]
fn unsaved_work_of_a_script_is_kept_and_saved_work_is_not() {
    let script_of = |lines: &str| script(&["tutorial"], lines);
    let kept = |script: &Script| {
        let folder = script.home.path().join(".local/state/rayscope");
        fs::read_dir(folder).map_or(0, Iterator::count)
    };
    for leave in ["", "quit\n"] {
        let left = script_of(&format!("move-x-plus\n{leave}"));
        assert_eq!((kept(&left), left.status), (1, Some(0)));
        assert!(left.complained.contains("unsaved work is kept in"));
        assert!(!left.said.contains("Unsaved changes"), "nobody is asked");
    }
    let saved = script_of("move-x-plus\nsave-as mine.toml\nquit\n");
    assert_eq!((kept(&saved), saved.status), (0, Some(0)));
    assert!(saved.home.path().join("mine.toml").exists());
    let given_up = script_of("move-x-plus\nquit!\n");
    assert_eq!((kept(&given_up), given_up.status), (0, Some(0)));
}

#[test]
fn a_question_is_answered_by_the_next_line_or_put_off() {
    let name = "mine.toml";
    let script = script(
        &["tutorial"],
        "save-as mine.toml\nmove-x-plus\nsave-as ./mine.toml\no\nmove-x-plus\nopen trio\ncursor 1 1\n",
    );
    script.says("exists already.  o overwrite");
    script.says("Unsaved changes.  o open trio");
    script.says("pixel (1, 1)");
    let text = fs::read_to_string(script.home.path().join(name)).unwrap();
    assert!(text.contains("center = [21, 20, 20]"), "{text}");
}

#[test]
fn the_tour_is_read_page_by_page() {
    let home = tempfile::tempdir().unwrap();
    let command = rayscope(home.path(), &["tour", "--plain"]);
    let output = output(command, "tour-forward\ntour-forward\n");
    let said = String::from_utf8(output.stdout).unwrap();
    for page in ["page 1/", "page 2/", "page 3/"] {
        assert!(said.contains(page), "{said}");
    }
}

#[test]
fn a_locale_without_utf_8_gets_ascii_and_no_control_characters() {
    let home = tempfile::tempdir().unwrap();
    let mut command = rayscope(home.path(), &["trio", "--plain"]);
    command.env("LANG", "C");
    let lines = "show view\nshow slice\nshow steps\nhelp\n";
    let output = output(command, lines);
    assert!(output.stdout.is_ascii());
    let odd = output
        .stdout
        .iter()
        .find(|b| b.is_ascii_control() && **b != b'\n');
    assert_eq!(odd, None);
    assert_eq!(output.status.code(), Some(0));
}

/// Flags with absurd values, and a part of the sentence that each gets.
const ABSURD: &[(&str, &str)] = &[
    (
        "tutorial --plain --t nan",
        "--t <T>': expected a finite number",
    ),
    (
        "tutorial --plain --t 0x1.8q",
        "--t <T>': expected a finite number",
    ),
    ("tutorial --plain --step 99", "--step: found “99”"),
    ("tutorial --plain --step none", "--step: found “none”"),
    (
        "tutorial --plain --cursor 40,0",
        "--cursor 40,0: expected a pixel",
    ),
    (
        "tutorial --plain --cursor -1,0",
        "--cursor <X,Y>': expected a column",
    ),
    (
        "tutorial --plain --sphere 0",
        "expected a whole number from 1",
    ),
    ("tutorial --plain --sphere -1", "--sphere"),
    ("tutorial --plain --shown 7", "--shown 7: expected a sphere"),
    (
        "tutorial --plain --set radius=nan",
        "radius is “nan”: expected a finite number",
    ),
    ("tutorial --plain --set radius=-1", "--set: radius is -1"),
    (
        "tutorial --plain --set size=1",
        "'--set <KEY=VALUE>': expected one of center.x",
    ),
    (
        "tutorial --plain --set extent.width=1e38",
        "extent is [1e38, 40]",
    ),
    (
        "tutorial --plain --aspect nan",
        "--aspect <ASPECT>': expected",
    ),
    ("tutorial --plain --size 9x9", "--cursor"),
    ("tutorial --plain --compare none", "'--compare <METHOD>'"),
    (
        "tour 1 --plain --page 0",
        "--page 0: expected a page from 1 to 4",
    ),
    (
        "tour 1 --plain --page x",
        "--page <N>': expected a whole number",
    ),
    (
        "tour --list --page 2",
        "'--list' cannot be used with '--page",
    ),
    ("tour 4 --plain --step 99", "--step: found “99”"),
    (
        "print tutorial --pixel 40,0",
        "--pixel 40,0: expected a pixel",
    ),
    (
        "print tutorial --pixel -1,0",
        "--pixel <X,Y>': expected a column",
    ),
    (
        "print tutorial --style tutorial --view depth",
        "--view depth: the style tutorial",
    ),
    ("print tutorial --steps", "--pixel"),
    (
        "print tutorial --size 0x9",
        "--size <WxH>': expected a width",
    ),
    (
        "print tutorial --aspect inf",
        "--aspect <ASPECT>': expected",
    ),
    ("plan tutorial --sphere 9", "--sphere 9: expected a sphere"),
    (
        "plan tutorial --sphere x",
        "--sphere <N>': expected a whole number",
    ),
    (
        "plan tutorial --style tutorial --view depth",
        "--view depth: the style tutorial",
    ),
    (
        "worksheet tutorial --seed 1e9",
        "--seed <N>': expected a whole number",
    ),
    (
        "worksheet tutorial --seed -1",
        "--seed <N>': expected a whole number",
    ),
    ("worksheet tutorial --count 0", "from 1 to 100"),
    ("bench --seed x", "--seed <N>': expected a whole number"),
    ("bench --rays 1e3", "from 1 to 10000000"),
    ("bench --frames --counts 0", "from 1 to 3000000"),
    ("bench --family none", "'--family <NAMES>'"),
    (
        "bench --brief --format json",
        "--brief: only the text report",
    ),
    (
        "tutorial --plain --compare exact",
        "--compare exact: expected another method",
    ),
    ("stress --rays -5", "from 1 to 1000000"),
    ("stress --dial none", "'--dial <NAMES>'"),
    (
        "solve --ray 0,0,0,0,0,1 --sphere 0,0,0,0x1",
        "--sphere, r: `0x1` is not a number",
    ),
    (
        "solve --ray 0,0,0,0,0,1 --sphere 0,0,0,-1",
        "--sphere: r is -1",
    ),
    (
        "solve --ray 0,0,0,0,0,1 --sphere 0,0,0,1 --batch x",
        "--batch",
    ),
    ("grade /nowhere", "/nowhere: "),
];

#[test]
fn no_flag_is_passed_over_in_silence() {
    let home = tempfile::tempdir().unwrap();
    for (line, words) in ABSURD {
        let words_of: Vec<_> = line.split(' ').collect();
        let Output {
            status,
            stdout,
            stderr,
        } = output(rayscope(home.path(), &words_of), "");
        let said = String::from_utf8(stderr).expect("text");
        assert!(matches!(status.code(), Some(1 | 2)), "{line}: {status}");
        assert!(said.contains(words), "{line}: {said}");
        assert!(!said.contains("panicked") && stdout.is_empty(), "{line}");
    }
}

#[test]
fn a_reader_that_stops_hears_no_complaint() {
    use std::fmt::Write as _;
    use std::io::Read;

    let home = tempfile::tempdir().unwrap();
    let mut csv = String::from("ox,oy,oz,dx,dy,dz,cx,cy,cz,r\n");
    let mut script = String::new();
    for i in 0..20_000 {
        // Writing to a string does not fail.
        let _ = writeln!(csv, "{i},0,-3,0,0,1,{i},0,0,1");
        script += "show\n";
    }
    fs::write(home.path().join("m.csv"), csv).unwrap();
    for line in [
        "solve --batch m.csv",
        "print crowd --size 2000x2000 --style ascii --color true",
        "worksheet trio --count 100",
        "scenes crowd",
        "completions bash",
        "bench --quick --rays 20 --format json",
        "stress --quick --rays 2 --format csv",
        "plan trio --format json",
        "tutorial --plain",
    ] {
        let words: Vec<_> = line.split(' ').collect();
        let mut child = rayscope(home.path(), &words).spawn().expect("the program");
        let mut stdin = child.stdin.take().expect("its input");
        let script = script.clone();
        let writer = std::thread::spawn(move || stdin.write_all(script.as_bytes()));
        let mut stdout = child.stdout.take().expect("its output");
        // As `head -1` does: what there is first, and then nothing more.
        let mut first = [0; 64];
        let read = stdout.read(&mut first).expect("a beginning");
        drop(stdout);
        let output = child.wait_with_output().expect("its end");
        // A script that nobody hears is not read to its end.
        let _ = writer.join().expect("the writer");
        let said = String::from_utf8(output.stderr).expect("text");
        assert!(read > 0, "{line}: {said}");
        assert!(
            !said.contains("rayscope: ") && !said.contains("panicked"),
            "{line}: {said}"
        );
        assert_eq!(output.status.code(), Some(0), "{line}: {said}");
    }
}

#[test]
fn the_former_name_of_the_tutorials_scene_and_style_is_understood_and_not_listed() {
    let under = |name: &str| {
        let lines = format!("open trio\nopen {name}\nstyle half\nstyle {name}\nquit\n");
        let script = script(&[name, "--style", name], &lines);
        assert_eq!((script.status, script.complained.as_str()), (Some(0), ""));
        script.said
    };
    let said = under("tutorial");
    assert_eq!(under("seed"), said);
    assert!(said.contains("style tutorial"), "{said}");

    let home = tempfile::tempdir().expect("a home");
    let out = |arguments: &[&str]| {
        let output = output(rayscope(home.path(), arguments), "");
        assert!(output.status.success(), "{arguments:?}");
        String::from_utf8(output.stdout).expect("text")
    };
    let picture = |name| out(&["print", name, "--style", name]);
    assert_eq!(picture("seed"), picture("tutorial"));
    assert_eq!(out(&["scenes", "seed"]), out(&["scenes", "tutorial"]));
    for listing in [
        &["scenes"][..],
        &["print", "--help"],
        &["completions", "bash"],
    ] {
        let listing = out(listing);
        assert!(
            !listing
                .split(|c: char| !c.is_alphanumeric() && c != '-')
                .any(|w| w == "seed")
        );
    }
}
