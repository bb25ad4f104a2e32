//! Files from outside: what is no regular file is refused at once, wherever it is opened, and what
//! is read has a bound, a place for each fault, and any name.
#![cfg(unix)]

use std::ffi::{OsStr, OsString};
use std::fs;
use std::io::{Read, Write};
use std::os::unix::ffi::OsStringExt;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::mpsc;
use std::thread;
use std::time::Duration;

use tempfile::TempDir;

/// A folder of one's own, which is home and working directory.
struct Home(TempDir);

/// What a run of the program left behind.
struct Run {
    status: Option<i32>,
    out: String,
    err: String,
}

impl Home {
    fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    fn file(&self, name: impl AsRef<Path>, contents: impl AsRef<[u8]>) -> PathBuf {
        let path = self.0.path().join(name);
        fs::write(&path, contents).unwrap();
        path
    }

    /// Something that nobody writes to, so that who opens it to read waits for ever.
    fn pipe(&self, name: &str) {
        let path = self.0.path().join(name);
        rustix::fs::mkfifoat(rustix::fs::CWD, path, rustix::fs::Mode::RWXU).unwrap();
    }

    fn run(&self, arguments: &[impl AsRef<OsStr>], input: &[u8]) -> Run {
        let mut child = Command::new(env!("CARGO_BIN_EXE_rayscope"))
            .args(arguments)
            .env_clear()
            .env("HOME", self.0.path())
            .env("LANG", "C.UTF-8")
            .current_dir(self.0.path())
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        // Where it ends before it has read all, nobody needs the rest.
        let _ = child.stdin.take().unwrap().write_all(input);
        let out = collected(child.stdout.take().unwrap());
        let err = collected(child.stderr.take().unwrap());
        let Ok(out) = out.recv_timeout(PATIENCE) else {
            child.kill().unwrap();
            panic!("it hangs");
        };
        Run {
            status: child.wait().unwrap().code(),
            out,
            err: err.recv().unwrap(),
        }
    }
}

/// What no command here takes, on the busiest machine.
const PATIENCE: Duration = Duration::from_secs(60);

/// What comes out of a stream, once it ends.
fn collected(mut stream: impl Read + Send + 'static) -> mpsc::Receiver<String> {
    let (sender, receiver) = mpsc::channel();
    thread::spawn(move || {
        let mut bytes = Vec::new();
        stream.read_to_end(&mut bytes).unwrap();
        sender.send(String::from_utf8(bytes).unwrap())
    });
    receiver
}

const CAMERA: &str = "[camera]\nposition = [0, 0, 9]\nlook_at = [0, 0, 0]\n";
const ROWS: &str = "ox,oy,oz,dx,dy,dz,cx,cy,cz,r\n0,0,0,0,0,1,0,0,9,1\n";
const CLAIMS: &str = "ox,oy,oz,dx,dy,dz,cx,cy,cz,r,class,near,far\n0,0,0,0,0,1,0,0,9,1,hit,8,10\n";

#[test]
fn what_is_no_regular_file_is_refused_by_every_command() {
    let home = Home::new();
    home.pipe("pipe");
    fs::create_dir(home.0.path().join("folder")).unwrap();
    home.pipe("folder/pipe.toml");
    for command in [
        "print",
        "plan",
        "worksheet",
        "tour",
        "solve --batch",
        "grade",
        "bench --quick --scene",
        "--plain",
    ] {
        for (file, kind) in [
            ("pipe", "a pipe"),
            ("/dev/zero", "a device"),
            ("/dev/tty", "a device"),
        ] {
            let words: Vec<_> = command.split(' ').chain([file]).collect();
            let run = home.run(&words, b"");
            assert_eq!(run.status, Some(1), "{words:?}: {}", run.err);
            let said = format!("{file}: found {kind}, expected a ");
            assert!(run.err.contains(&said), "{words:?}: {}", run.err);
            assert_eq!(run.err.lines().count(), 1, "{words:?}: {}", run.err);
        }
    }
    for command in ["solve --batch", "grade", "print"] {
        let words: Vec<_> = command.split(' ').chain(["folder"]).collect();
        let run = home.run(&words, b"");
        assert_eq!(run.status, Some(1));
        assert!(
            run.err.contains("folder: found a directory, expected a "),
            "{}",
            run.err
        );
    }
    let run = home.run(&["tour", "folder"], b"");
    assert!(
        run.err.contains("folder/pipe.toml: found a pipe"),
        "{}",
        run.err
    );
    home.file(
        "page.toml",
        "title = \"t\"\n[[page]]\nscene = \"pipe\"\ntext = \"t\"\n",
    );
    let run = home.run(&["tour", "page.toml"], b"");
    assert!(
        run.err
            .contains("page.toml:3:9: page 1, scene: found a pipe"),
        "{}",
        run.err
    );
}

#[test]
fn with_unsaved_work_too_a_pipe_is_refused_at_once() {
    let home = Home::new();
    home.pipe("pipe");
    for name in ["pipe", "/dev/tty", "/dev/stdin", "/dev/zero"] {
        let lines = format!("delete\nopen {name}\nsphere 1\n");
        let run = home.run(&["trio", "--plain"], lines.as_bytes());
        assert_eq!(run.status, Some(1), "{}", run.err);
        let refused = run
            .out
            .contains(&format!("{name}: found a pipe, expected a scene file"))
            || run
                .out
                .contains(&format!("{name}: found a device, expected a scene file"));
        assert!(refused, "{name}: {}", run.out);
    }
}

#[test]
fn a_byte_that_is_no_text_has_its_place_and_a_mark_before_the_text_is_none() {
    let home = Home::new();
    home.file(
        "bad.toml",
        b"title = \"x\"\n[[page]]\nscene = \"tutorial\"\ntext = \"caf\xe9\"\n",
    );
    let run = home.run(&["tour", "bad.toml"], b"");
    assert_eq!(run.status, Some(1));
    assert_eq!(
        run.err,
        "rayscope: bad.toml:4:12: found the byte 0xe9, expected text in UTF-8\n"
    );
    let page = "title = \"x\"\n[[page]]\nscene = \"tutorial\"\ntext = \"t\"\n";
    home.file("page.toml", format!("\u{feff}{page}"));
    assert_eq!(
        home.run(&["tour", "page.toml", "--list"], b"").status,
        Some(0)
    );
    home.file("scene.toml", format!("\u{feff}{CAMERA}"));
    assert_eq!(home.run(&["print", "scene.toml"], b"").status, Some(0));
    for (command, text) in [("solve --batch -", ROWS), ("grade -", CLAIMS)] {
        let words: Vec<_> = command.split(' ').collect();
        let run = home.run(&words, format!("\u{feff}{text}").as_bytes());
        assert_eq!((run.status, run.err.as_str()), (Some(0), ""), "{command}");
    }
    let run = home.run(
        &["trio", "--plain"],
        "\u{feff}method kahan\n\u{feff}method kahan\n".as_bytes(),
    );
    assert!(run.out.contains("method kahan"), "{}", run.out);
    assert_eq!(
        run.status,
        Some(1),
        "a mark is only before the first line: {}",
        run.out
    );
}

#[test]
fn a_file_of_any_name_is_opened() {
    let home = Home::new();
    let name = |end: &[u8]| OsString::from_vec([b"caf\xe9", end].concat());
    home.file(name(b".toml"), CAMERA);
    home.file(
        name(b"-page.toml"),
        "title = \"x\"\n[[page]]\nscene = \"tutorial\"\ntext = \"t\"\n",
    );
    home.file(name(b".csv"), ROWS);
    home.file(name(b"-claims.csv"), CLAIMS);
    for (command, end) in [
        ("print", &b".toml"[..]),
        ("plan", b".toml"),
        ("--plain", b".toml"),
        ("tour --list", b"-page.toml"),
        ("tour --plain", b"-page.toml"),
        ("solve --batch", b".csv"),
        ("grade", b"-claims.csv"),
    ] {
        let words = command.split(' ').map(OsString::from);
        let words: Vec<_> = words.chain([name(end)]).collect();
        let run = home.run(&words, b"");
        assert_eq!((run.status, run.err.as_str()), (Some(0), ""), "{command}");
    }
}

#[test]
fn the_home_folder_is_a_tilde_and_a_missing_folder_a_sentence() {
    let home = Home::new();
    home.file("mine.toml", format!("name = \"my own\"\n{CAMERA}"));
    let script =
        "open ~/mine.toml\nsave-as ~/other.toml\nappend ~/none/x.csv\nsave-as none/x.toml\n";
    let run = home.run(&["--plain"], script.as_bytes());
    assert!(run.out.contains("my own"), "{}", run.out);
    assert!(home.0.path().join("other.toml").exists(), "{}", run.out);
    assert!(
        run.out
            .contains("none/x.toml: not saved: its folder does not exist"),
        "{}",
        run.out
    );
}

/// What a terminal could be steered with.
fn steers(text: &str) -> Option<char> {
    text.chars().find(|c| c.is_control() && *c != '\n')
}

#[test]
fn nothing_from_a_file_or_a_flag_steers_the_terminal() {
    let home = Home::new();
    let hostile = "\u{1b}]0;x\u{7}\u{9b}31m";
    let page = "[[page]]\nscene = \"seed\"\ntext = \"t\"\n";
    let escaped = "\\u001b]0;pwned\\u0007";
    home.file("title.toml", format!("title = \"{escaped}\"\n{page}"));
    home.file(
        "text.toml",
        format!(
            "title = \"t\"\n{}",
            page.replace("\"t\"", &format!("\"{escaped}\""))
        ),
    );
    home.file(
        "try.toml",
        format!("title = \"t\"\n{page}try = \"{escaped}\"\n"),
    );
    home.file(
        "method.toml",
        format!("title = \"t\"\n{page}method = \"{escaped}\"\n"),
    );
    home.file(
        "key.toml",
        format!("title = \"t\"\n{page}\"{escaped}\" = 1\n"),
    );
    fs::create_dir(home.0.path().join("tour")).unwrap();
    home.file(
        format!("tour/{hostile}.toml"),
        format!("title = \"t\"\n{page}"),
    );
    home.file(
        "rows.csv",
        format!("{ROWS}\"{hostile}\",2,3,4,5,6,7,8,9,10\n"),
    );
    home.file("head.csv", format!("{hostile},{ROWS}"));
    home.file(
        "claims.csv",
        format!(
            "{CLAIMS}0,0,0,0,0,1,0,0,9,1,\"{hostile}\",,\n0,0,0,0,0,1,0,0,9,1,hit,\"{hostile}\",\n"
        ),
    );
    home.file("name.toml", format!("name = \"{escaped}\"\n{CAMERA}"));
    home.file(format!("{hostile}.toml"), "nothing");
    for line in [
        "tour title.toml --list",
        "tour text.toml --list",
        "tour try.toml --list",
        "tour method.toml --list",
        "tour key.toml --list",
        "tour tour --list",
        "solve --batch rows.csv",
        "solve --batch HOSTILE",
        "solve --ray=HOSTILE --sphere=0,0,0,1",
        "grade rows.csv",
        "grade claims.csv",
        "print name.toml",
        "print HOSTILE.toml",
        "print HOSTILE",
        "print seed --method HOSTILE",
        "worksheet HOSTILE.toml",
        "tour HOSTILE",
        "HOSTILE.toml --plain",
        "--HOSTILE",
    ] {
        let words: Vec<_> = line
            .split(' ')
            .map(|w| w.replace("HOSTILE", hostile))
            .collect();
        let run = home.run(&words, b"");
        // What solve passes through untouched is for other programs.
        let shown = if line.starts_with("solve --batch rows") {
            ""
        } else {
            &run.out
        };
        assert_eq!(steers(shown), None, "{line}: {shown:?}");
        assert_eq!(steers(&run.err), None, "{line}: {:?}", run.err);
    }
    let run = home.run(&["tour", "title.toml", "--list"], b"");
    assert_eq!(
        run.err,
        "rayscope: title.toml:1:9: title: found the control character U+001B, expected text without control characters\n"
    );
    let lines = format!("save-as {hostile}2.toml\nopen {hostile}\n{hostile}\nset {hostile} 1\n");
    let run = home.run(&["trio", "--plain"], lines.as_bytes());
    assert_eq!(steers(&run.out), None, "{:?}", run.out);
}

#[test]
fn of_a_thousand_bad_rows_a_hundred_are_explained_and_the_rest_counted() {
    let home = Home::new();
    for (command, head) in [("solve --batch -", ROWS), ("grade -", CLAIMS)] {
        let words: Vec<_> = command.split(' ').collect();
        let run = home.run(&words, format!("{head}{}", "x\n".repeat(1000)).as_bytes());
        assert_eq!(run.status, Some(1));
        let lines: Vec<_> = run.err.lines().collect();
        assert_eq!(lines.len(), 101, "{command}");
        assert!(
            lines[99].contains(": line 102, column oy: nothing there")
                || lines[99].contains(": line 102, column ox: `x`"),
            "{}",
            lines[99]
        );
        assert_eq!(
            lines[100],
            "rayscope: standard input: 900 more rows are invalid"
        );
    }
    let one = format!("{ROWS}{}", "x\n".repeat(101));
    let run = home.run(&["solve", "--batch", "-"], one.as_bytes());
    assert!(
        run.err.ends_with(": 1 more row is invalid\n"),
        "{}",
        run.err
    );
}
