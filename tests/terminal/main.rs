//! The whole program in a terminal: what a person sees, and what is left when it ends.

mod pty;
mod seen;
mod ssh;

use std::fs;
use std::time::Duration;

use pty::{Pty, Start};
use rayscope::lab::BenchQueue;
use rayscope::terminal::Session;
use rustix::process::Signal;

#[test]
fn a_person_opens_moves_reads_saves_and_quits() {
    let mut pty = Pty::explorer(Start::default().args(&["tutorial", "--method", "textbook"]));
    // A, B, C and the discriminant of pixel (20, 20), where the cursor starts.
    for line in ["(20, 20)", "d·d", "two points"] {
        pty.waits_to_show(line);
    }
    assert_eq!(pty.value("A"), "1");
    assert_eq!(pty.value("B"), "−40");
    assert_eq!(pty.value("C"), "300");
    assert_eq!(pty.value("Δ"), "400");

    pty.sends("\x1b[C\x1b[B");
    pty.waits_to_show("(21, 21)");
    assert_eq!(pty.value("C"), "302");

    pty.sends("x");
    pty.waits_to_show("unsaved");
    pty.sends(":save-as moved.toml\r");
    pty.waits_to_show("Saved");
    let saved = fs::read_to_string(pty.file("moved.toml")).expect("the file");
    assert!(saved.contains("center = [21, 20, 20]"), "{saved}");

    pty.sends("q");
    assert_eq!(pty.ends(), 0);
    pty.is_restored();
}

#[test]
fn a_student_has_a_first_lesson() {
    let mut pty = Pty::explorer(Start::default());
    pty.waits_to_show("opening");
    assert_eq!(pty.value("Δ"), "400");
    // The slide of the first camera key is seen, and taken back.
    pty.sends("d");
    pty.waits_for("another start", |p| p.text().contains("24,"));
    pty.sends("u");
    pty.waits_to_show("the camera was moved");
    pty.sends("\r");
    pty.waits_to_show("step 1 of");
    pty.sends(">");
    pty.waits_for("the last step", |p| {
        let text = p.text();
        let title = text.split("step ").nth(1).unwrap_or_default();
        let mut words = title.split([' ', ':']);
        let (at, of) = (words.next(), words.nth(1));
        at == of && at.is_some()
    });
    pty.sends(",");
    pty.waits_to_show("step 9 of 10");
    pty.sends(" ");
    pty.waits_to_show("n Numerics");
    pty.sends("et");
    pty.waits_to_show("leave the tour");
    pty.sends("\r");
    pty.waits_to_show(": a circle and a line, page 1/");
    pty.sends("f");
    pty.waits_to_show("220.84");
    pty.sends("q");
    assert_eq!(pty.ends(), 0);
    pty.is_restored();
}

#[test]
fn theme_style_and_lens_are_there_again_at_the_next_start() {
    let mut pty = Pty::explorer(Start::default().args(&["trio"]));
    pty.sends("L:style ascii\r:theme monochrome\r");
    pty.waits_to_show("Theme: monochrome");
    let home = pty.home();
    pty.sends("q");
    assert_eq!(pty.ends(), 0);
    let mut pty = Pty::explorer(Start::default().args(&["far"]).home(&home));
    for word in [" machine ", " ascii "] {
        pty.waits_to_show(word);
    }
    pty.sends("q");
    assert_eq!(pty.ends(), 0);
    assert!(!pty.sets_colors());
    let start = Start::default().args(&["far", "--style", "half", "--lens", "mathematics"]);
    let start = start.env("RAYSCOPE_THEME", "dark").home(&home);
    let mut pty = Pty::explorer(start);
    for word in [" mathematics ", " half "] {
        pty.waits_to_show(word);
    }
    pty.sends("q");
    assert_eq!(pty.ends(), 0);
    assert!(pty.sets_colors());
}

#[test]
fn a_person_walks_the_whole_tour() {
    let chapters = rayscope::explorer::tour::builtin();
    let mut pty = Pty::explorer(Start::default().args(&["tour"]));
    for (n, chapter) in (1..).zip(chapters.iter()) {
        let (count, title, pages) = (chapters.len(), &chapter.title, chapter.pages.len());
        for page in 1..=pages {
            pty.waits_to_show(&format!("{n}/{count}: {title}, page {page}/{pages} "));
            for number in numbers_of_the_tutorial(n, page) {
                pty.waits_to_show(number);
            }
            pty.sends("f");
        }
    }
    pty.waits_to_show("This was the last page.");
    // Off the path, and back on it.
    pty.sends("3\x1b[C\x1b[C");
    pty.waits_to_show("slice through ray and centre");
    pty.sends("r");
    let (count, last) = (chapters.len(), &chapters[chapters.len() - 1]);
    let pages = last.pages.len();
    pty.waits_to_show(&format!(
        "{count}/{count}: {}, page {pages}/{pages} ",
        last.title
    ));
    pty.sends("q");
    assert_eq!(pty.ends(), 0);
    pty.is_restored();
}

/// What the tutorial prints and a page of the tour shows.
const fn numbers_of_the_tutorial(chapter: u32, page: usize) -> &'static [&'static str] {
    match (chapter, page) {
        (1, 2) => &["2.21x² + 0.44x − 24.96 = 0", "220.84", "3.26", "−3.46"],
        (1, 4) => &["(−3.46, −3.606)", "(3.26, 3.786)"],
        (2, 1) => &["(2, 5, 7)", "(4, 10, 14)", "(6, 15, 21)", "(8, 20, 28)"],
        (4, 1) => &["−40", "300", "400"],
        (6, 1) => &["317"],
        (6, 2) => &["++", "--"],
        _ => &[],
    }
}

#[test]
fn a_terminal_that_can_not_draw_is_told_what_to_use() {
    for start in [
        Start::default().env("TERM", "dumb"),
        Start::default().env("TERM", ""),
        Start::default().through("exec \"$@\" | cat"),
    ] {
        let mut pty = start.open();
        pty.ends();
        assert!(pty.shows("rayscope print SCENE"), "{}", pty.text());
        assert!(!pty.bytes().contains(&0x1b), "an escape sequence");
        pty.is_restored();
    }
}

#[test]
fn any_sequence_of_sizes_is_survived() {
    let mut pty = Pty::explorer(Start::default());
    let first = seen::cells(pty.screen());
    for (cols, rows) in [
        (1, 1),
        (0, 0),
        (2, 200),
        (300, 1),
        (20, 6),
        (19, 5),
        (500, 200),
        (0, 24),
        (80, 0),
        (64, 18),
    ] {
        pty.resizes(cols, rows);
        pty.sends("\x1b[C\x1b[D");
    }
    pty.resizes(80, 24);
    pty.waits_for("the first screen again", |p| {
        seen::cells(p.screen()) == first
    });
    pty.sends("q");
    assert_eq!(pty.ends(), 0);
    pty.is_restored();
}

#[test]
fn the_smallest_terminals_are_told_and_can_grow() {
    for (cols, rows) in [(1, 1), (0, 0), (19, 6)] {
        let mut pty = Start::default().size(cols, rows).open();
        pty.waits_for("the alternate screen", |p| p.screen().alternate_screen());
        pty.resizes(80, 24);
        pty.waits_to_show("ray of pixel");
        pty.sends("q");
        assert_eq!(pty.ends(), 0);
        pty.is_restored();
    }
}

#[test]
fn what_a_thread_has_measured_is_shown_without_a_key() {
    let queue = BenchQueue::private();
    let lock = queue
        .wait(Duration::from_secs(2), |_| false)
        .expect("a queue");
    let mut pty = Pty::explorer(Start::default().args(&["trio"]).queue(&queue));
    pty.sends("%");
    pty.waits_to_show("measurement is before this one");
    drop(lock);
    pty.waits_to_show("wrong %");
    // Quitting does not wait for what is being measured.
    pty.sends("%q");
    assert_eq!(pty.ends(), 0);
    pty.is_restored();
}

#[test]
fn a_signal_ends_it_and_the_status_says_which() {
    for (signal, status) in [
        (Signal::HUP, 129),
        (Signal::INT, 130),
        (Signal::QUIT, 131),
        (Signal::TERM, 143),
        (Signal::USR1, 138),
        (Signal::USR2, 140),
        (Signal::ALARM, 142),
        (Signal::XCPU, 152),
    ] {
        let mut pty = Pty::explorer(Start::default());
        pty.is_sent(signal);
        assert_eq!(pty.ends(), status);
        pty.is_restored();
    }
    let mut pty = Pty::explorer(Start::default());
    pty.sends("\x03");
    assert_eq!(pty.ends(), 130);
    pty.is_restored();
}

#[test]
fn a_limit_to_the_size_of_files_fails_a_save_and_nothing_else() {
    let limited = Start::default().through("ulimit -f 0; exec \"$@\"");
    let mut pty = Pty::explorer(limited);
    pty.sends("x:save-as mine.toml\r");
    pty.waits_to_show("not saved");
    pty.sends(":quit!\r");
    assert_eq!(pty.ends(), 0);
    pty.is_restored();
    let home = fs::read_dir(pty.home().path()).expect("the folder");
    let names = home.flatten().map(|entry| entry.file_name());
    let litter: Vec<_> = names
        .filter(|name| name.to_string_lossy().starts_with(".rayscope-"))
        .collect();
    assert!(litter.is_empty(), "{litter:?}");
}

/// What a panic says, and the variable under which a test panics on purpose.
const PANIC: &str = "this is what the panic says";
const PANICS: &str = "RAYSCOPE_TEST_PANICS";

#[test]
fn a_panic_is_read_on_the_screen_that_was_there_before() {
    let this = std::env::current_exe().expect("this program");
    let line = format!(
        "echo precious; exec {} --exact panics --ignored --nocapture",
        this.display()
    );
    let mut pty = Start::default().through(&line).env(PANICS, "1").open();
    pty.ends();
    assert!(pty.shows("precious") && pty.shows(PANIC), "{}", pty.text());
    assert_eq!(pty.occurrences(b"\x1b[?1049l"), 1, "restored once");
    pty.is_restored();
}

/// Not a test, but what the one above starts.
#[test]
#[ignore = "it is started by another"]
fn panics() {
    if std::env::var_os(PANICS).is_some() {
        let _session = Session::enter().expect("the terminal");
        panic!("{PANIC}");
    }
}

#[test]
fn a_terminal_of_any_size_is_drawn_as_far_as_is_sane() {
    let mut pty = Pty::explorer(Start::default().args(&["tutorial"]));
    pty.claims(20_000, 20_000);
    pty.waits_for("the sentence", |p| p.occurrences(b"20000 columns") > 0);
    let status = fs::read_to_string(format!("/proc/{}/status", pty.pid()));
    if let Ok(status) = status {
        let peak = status.lines().find_map(|l| l.strip_prefix("VmHWM:"));
        let peak = peak.expect("a peak").trim().trim_end_matches(" kB");
        let peak: u64 = peak.parse().expect("a number");
        assert!(peak < 300_000, "{peak} kB");
    }
    pty.resizes(80, 24);
    pty.sends("q");
    assert_eq!(pty.ends(), 0);
    pty.is_restored();
}

#[test]
fn what_was_typed_before_the_first_frame_deletes_no_work() {
    let mut pty = Pty::explorer(Start::default());
    pty.sends("x");
    pty.waits_to_show("unsaved");
    let home = pty.home();
    assert_eq!(pty.hangs_up(), 129);
    let mut pty = Start::default().home(&home).open();
    pty.sends("D");
    pty.waits_to_show("Unsaved work of");
    pty.sends("nq");
    assert_eq!(pty.ends(), 0);
    let state = home.path().join(".local/state/rayscope");
    assert_eq!(fs::read_dir(&state).expect("the folder").count(), 1);
}

#[test]
fn the_colours_follow_the_ground_that_the_terminal_tells() {
    let mut pty = Pty::explorer(Start::default());
    assert_eq!(pty.occurrences(b"\x1b]11;?\x1b\\"), 1, "asked once");
    // The state of the terminal is at the end of the help page.
    pty.sends("?");
    pty.sends(&"\x1b[6~".repeat(20));
    pty.waits_to_show("either (the background is not known");
    for (answer, theme) in [
        ("\x1b]11;rgb:ffff/ffff/ffff\x1b\\", "light"),
        ("\x1b]11;rgb:0000/0000/0000\x07", "dark"),
        ("\x1b[?997;2n", "light"),
    ] {
        pty.sends(answer);
        pty.waits_to_show(&format!("{theme} (the terminal says so)"));
    }
    pty.sends("\x1bq");
    assert_eq!(pty.ends(), 0);
    let chosen = Start::default().args(&["--theme", "dark"]);
    let mut pty = Pty::explorer(chosen);
    pty.sends("q");
    assert_eq!(pty.ends(), 0);
    assert_eq!(pty.occurrences(b"\x1b]11;?"), 0);
}

#[test]
fn ctrl_z_gives_the_terminal_to_the_shell_and_fg_comes_back() {
    let shell = "set -m; \"$@\"; echo back in the shell; read line; fg >/dev/null; echo status $?";
    let mut pty = Pty::explorer(Start::default().through(shell));
    pty.sends("l\x1a");
    pty.waits_to_show("back in the shell");
    pty.is_restored();
    pty.sends("go on\r");
    pty.waits_to_show("(21, 20)");
    assert!(pty.screen().alternate_screen());
    pty.sends("q");
    pty.waits_to_show("status 0");
    assert_eq!(pty.ends(), 0);
    pty.is_restored();
}

#[test]
fn a_stopped_process_lets_others_measure() {
    let shell = "set -m; \"$@\"; echo back in the shell; read line; fg >/dev/null; echo status $?";
    let queue = BenchQueue::private();
    let mut pty = Pty::explorer(Start::default().through(shell).queue(&queue));
    pty.sends("%");
    pty.waits_to_show("error against run time");
    pty.sends("\x1a");
    pty.waits_to_show("back in the shell");
    // One that is stopped while it measures would do so for ever.
    let lock = queue.wait(Duration::from_secs(1), |_| false);
    assert!(lock.expect("a queue").is_some());
    pty.sends("go on\r");
    pty.waits_for("the panel again", |p| {
        p.shows("was stopped") || p.shows("wrong %")
    });
    pty.sends("q");
    pty.waits_to_show("status 0");
    assert_eq!(pty.ends(), 0);
}

#[test]
fn without_a_shell_ctrl_z_stops_nothing() {
    let mut pty = Pty::explorer(Start::default());
    pty.sends("\x1a");
    pty.waits_to_show("no shell to go back to");
    pty.is_sent(Signal::TSTP);
    pty.sends("l");
    pty.waits_to_show("(21, 20)");
    pty.sends("q");
    assert_eq!(pty.ends(), 0);
}

#[test]
fn a_terminal_that_closes_ends_it_even_where_its_signal_is_ignored() {
    assert_eq!(Pty::explorer(Start::default()).hangs_up(), 129);
    let deaf = Start::default().through("trap '' HUP; exec \"$@\"");
    assert_eq!(Pty::explorer(deaf).hangs_up(), 129);
}

#[test]
fn unsaved_work_outlives_the_terminal_and_is_offered_again() {
    let mut pty = Pty::explorer(Start::default());
    pty.sends("x");
    pty.waits_to_show("unsaved");
    let home = pty.home();
    assert_eq!(pty.hangs_up(), 129);

    let mut pty = Pty::explorer(Start::default().home(&home));
    pty.waits_to_show("Unsaved work of");
    pty.sends("o");
    pty.waits_to_show("c: (21, 20, 20)");
    pty.is_sent(Signal::TERM);
    assert_eq!(pty.ends(), 143);
    pty.is_restored();
    assert!(pty.shows("unsaved work is kept in"));

    let state = home.path().join(".local/state/rayscope");
    let kept = fs::read_dir(&state).expect("the folder").count();
    assert_eq!(kept, 1, "the new file stands for the old");
}

#[test]
fn who_is_killed_loses_next_to_nothing() {
    let mut pty = Pty::explorer(Start::default());
    pty.sends("x");
    pty.waits_to_show("unsaved");
    let home = pty.home();
    let state = home.path().join(".local/state/rayscope");
    let is_written = |entry: fs::DirEntry| entry.path().extension().is_some_and(|e| e == "toml");
    pty.waits_for("what is unsaved in a file", |_| {
        fs::read_dir(&state).is_ok_and(|mut files| files.any(|f| f.is_ok_and(is_written)))
    });
    // A session that lives is offered to no other.
    let mut other = Pty::explorer(Start::default().home(&home));
    assert!(!other.shows("Unsaved work of"), "{}", other.text());
    other.sends("q");
    assert_eq!(other.ends(), 0);
    pty.dies();

    let mut pty = Pty::explorer(Start::default().home(&home));
    pty.waits_to_show("Unsaved work of");
    pty.sends("o");
    pty.waits_to_show("c: (21, 20, 20)");
}

#[test]
fn every_usual_terminal_gets_colours_that_it_has() {
    for (term, colors, fewer) in [
        ("xterm-256color", true, false),
        ("screen-256color", true, false),
        ("tmux-256color", true, false),
        ("linux", true, true),
        ("vt100", false, true),
    ] {
        let mut pty = Pty::explorer(Start::default().args(&["trio"]).env("TERM", term));
        pty.sends("adv:quit!\r");
        assert_eq!(pty.ends(), 0);
        pty.is_restored();
        assert_eq!(pty.sets_colors(), colors, "{term}");
        assert_eq!(pty.occurrences(b";5;") == 0, fewer, "{term}");
        assert_eq!(pty.occurrences(b"8;2;"), 0, "true colour on {term}");
    }
}

#[test]
fn no_color_is_obeyed() {
    let mut pty = Pty::explorer(
        Start::default()
            .args(&["trio"])
            .env("NO_COLOR", "1")
            .env("COLORTERM", "truecolor"),
    );
    pty.sends("dbvvv?\x1b:quit!\r");
    assert_eq!(pty.ends(), 0);
    assert!(!pty.sets_colors());
}

#[test]
fn where_the_locale_has_only_ascii_nothing_else_is_written() {
    let mut pty = Pty::explorer(Start::default().args(&["trio"]).env("LANG", "C"));
    pty.sends("dbbbvvv?\x1b=\x1b:é\x15quit!\r");
    assert_eq!(pty.ends(), 0);
    let odd: Vec<_> = pty.bytes().iter().filter(|b| !b.is_ascii()).collect();
    assert!(odd.is_empty(), "{odd:?}");
}

#[test]
fn a_terminal_that_answers_no_query_works_all_the_same() {
    let mut pty = Start::default().args(&["trio"]).open();
    pty.answers_nothing();
    pty.waits_to_show("ray of pixel");
    pty.sends(&"d".repeat(30));
    pty.sends("x:cursor 5 5\r");
    pty.waits_to_show("(5, 5)");
    pty.sends("q");
    pty.waits_to_show("Unsaved");
    pty.sends("\x1b:quit!\r");
    assert_eq!(pty.ends(), 0);
    pty.is_restored();
}

#[test]
fn a_reader_that_stalls_sees_the_last_state_soon_and_after_little() {
    let mut pty = Pty::explorer(Start::default().args(&["trio"]));
    for _ in 0..90 {
        // Nothing is read meanwhile.
        pty.sends("d");
    }
    pty.sends(":cursor 5 5\r");
    let before = pty.bytes().len();
    pty.waits_to_show("pixel (5, 5)");
    let read = pty.bytes().len() - before;
    assert!(read <= 64 * 1024, "{read} bytes before the last state");
    pty.sends(":quit!\r");
    assert_eq!(pty.ends(), 0);
    pty.is_restored();
}

/// The query after a frame that is not small, and what ends every frame.
const QUERY: &[u8] = b"\x1b[5n";
const END: &[u8] = b"\x1b[?2026l";

/// Presses a key and waits for the end of its frame, of so many bytes.
fn turns(pty: &mut Pty, end: &[u8]) -> usize {
    let (before, length) = (pty.occurrences(end), pty.bytes().len());
    pty.sends("d");
    pty.waits_for("a frame", |p| p.occurrences(end) > before);
    pty.bytes().len() - length
}

/// Turns the camera until a frame has to wait, for answers that do not come: as many frames as may
/// be on their way go out first. How many turns that took.
fn turns_until_held(pty: &mut Pty) -> usize {
    for turn in 1..=32 {
        let queries = pty.occurrences(QUERY);
        pty.sends("d");
        // That frames wait for long is what is tested.
        pty.reads_for(std::time::Duration::from_millis(200));
        if pty.occurrences(QUERY) == queries {
            return turn;
        }
    }
    panic!("no frame has to wait");
}

#[test]
fn on_a_slow_link_the_picture_is_coarse_until_the_person_rests() {
    // With all colours one frame is as much as may be on its way at first; the next has to wait.
    let start = || {
        let start = Start::default().args(&["trio"]);
        start.env("COLORTERM", "truecolor")
    };
    let mut pty = Pty::explorer(start());
    let fine = turns(&mut pty, QUERY);
    assert!(fine > 4096 && !pty.shows("coarse"), "{fine}");
    pty.answers_nothing();
    turns(&mut pty, QUERY);
    // After the first wait the link may only have stalled.
    let mut count = 2 + turns_until_held(&mut pty);
    let queries = pty.occurrences(QUERY);
    pty.answers_late();
    pty.waits_for("a frame", |p| p.occurrences(QUERY) > queries);
    assert!(!pty.shows("coarse"));
    count += turns_until_held(&mut pty);
    pty.answers_again();
    let length = pty.bytes().len();
    pty.waits_to_show("coarse");
    let end = |p: &Pty| {
        p.bytes()[length..]
            .windows(END.len())
            .position(|w| w == END)
    };
    pty.waits_for("its end", |p| end(p).is_some());
    let coarse = end(&pty).expect("an end");
    assert!(2 * coarse < fine, "{coarse} bytes, and {fine} in full");
    pty.waits_for("the detail", |p| !p.shows("coarse"));

    let mut fast = Pty::explorer(start());
    for _ in 0..count {
        turns(&mut fast, QUERY);
        assert!(!fast.shows("coarse"));
    }
    let full = seen::cells(fast.screen());
    pty.waits_for("the picture in full", |p| seen::cells(p.screen()) == full);
    for mut pty in [pty, fast] {
        pty.sends(":quit!\r");
        assert_eq!(pty.ends(), 0);
        pty.is_restored();
    }
}

#[test]
fn a_paste_is_no_burst_of_commands() {
    let mut pty = Pty::explorer(Start::default());
    assert!(pty.screen().bracketed_paste());
    pty.sends("\x1b[200~xxq\x03q\r\x1b[201~");
    pty.waits_to_show("Pasted text does nothing here");
    pty.sends(":\x1b[200~cursor 1 2\x1b[201~\r");
    pty.waits_to_show("pixel (1, 2)");
    pty.sends("q");
    assert_eq!(pty.ends(), 0);
    pty.is_restored();
}

#[cfg(feature = "routine")]
#[test]
fn a_routine_is_pasted_and_saved_without_a_shell() {
    let mut pty = Pty::explorer(Start::default());
    pty.sends(":edit mine\r");
    pty.waits_to_show("no shell started rayscope");
    pty.sends(":routine mine\r");
    pty.waits_to_show("intersectRaySphere");
    pty.sends("\x1b[200~float f(vec3 ro, vec3 rd) { q; }\r\x1b[201~");
    pty.waits_to_show("line 1:");
    pty.sends("\x15");
    pty.waits_for("no error", |p| !p.shows("line 1:"));
    pty.sends("\x1b[200~// pasted\r\x1b[201~\x13");
    pty.waits_to_show("Saved");
    let saved = fs::read_to_string(pty.file("mine.glsl")).expect("the file");
    assert!(saved.starts_with("// pasted\n// The tutorial"), "{saved}");
    pty.sends("\x1bq");
    assert_eq!(pty.ends(), 0);
    pty.is_restored();
}

#[cfg(feature = "routine")]
#[test]
fn ones_own_editor_has_the_terminal_until_it_ends() {
    let shell = "set -m; \"$@\"; echo status $?";
    let start = Start::default().through(shell);
    let mut pty = Pty::explorer(start.env("EDITOR", "sed -i s/intersect/edited/"));
    pty.sends(":edit mine\r");
    pty.waits_to_show(" mine.glsl ");
    pty.sends(":routine\r");
    pty.waits_to_show("editedRaySphere");
    pty.sends("\x1bq");
    pty.waits_to_show("status 0");
    assert_eq!(pty.ends(), 0);
    pty.is_restored();
}

#[test]
fn the_mouse_is_asked_for_by_a_key_and_given_back() {
    let mut pty = Pty::explorer(Start::default());
    assert_eq!(pty.occurrences(b"\x1b[?1000h"), 0);
    pty.sends("$");
    pty.waits_for("the mouse", |p| {
        p.screen().mouse_protocol_mode() == vt100::MouseProtocolMode::PressRelease
    });
    // The cell at the top left of the picture.
    pty.sends("\x1b[<0;2;3M\x1b[<0;2;3m");
    pty.waits_to_show("pixel (0, 0)");
    pty.waits_to_show("p0: (0, 0, 0)");
    pty.sends("\x1b[<64;9;9M");
    pty.waits_for("the wheel", |p| !p.shows("p0: (0, 0, 0)"));
    pty.sends("$");
    pty.waits_for("the mouse given back", |p| {
        p.screen().mouse_protocol_mode() == vt100::MouseProtocolMode::None
    });
    pty.sends("$");
    pty.waits_to_show("a click moves");
    pty.is_sent(Signal::TERM);
    assert_eq!(pty.ends(), 143);
    pty.is_restored();
    for other in ["1002", "1003", "1015"] {
        assert_eq!(pty.occurrences(format!("\x1b[?{other}h").as_bytes()), 0);
    }
}

#[test]
fn the_screen_is_drawn_again_by_a_key() {
    let mut pty = Pty::explorer(Start::default());
    let first = seen::cells(pty.screen());
    pty.garbles("\x1b[2J\x1b[5;5Hsomebody wrote over it\x1b[1;31m");
    assert_ne!(seen::cells(pty.screen()), first);
    pty.sends("\x0c");
    pty.waits_for("the first screen again", |p| {
        seen::cells(p.screen()) == first
    });
    pty.sends("q");
    assert_eq!(pty.ends(), 0);
}

#[test]
fn colours_are_as_many_as_are_asked_for() {
    let start = Start::default;
    let flag = |value| start().args(&["--color", value]);
    for (start, keys, expected) in [
        (start().env("COLORTERM", "truecolor"), "", "direct"),
        (start(), "", "indexed"),
        (flag("never"), "", "none"),
        (flag("16"), "", "basic"),
        (flag("256").env("NO_COLOR", "1"), "", "indexed"),
        (start().env("RAYSCOPE_COLOR", "never"), "", "none"),
        (start().env("RAYSCOPE_THEME", "monochrome"), "##", "none"),
        (start().env("NO_COLOR", "1"), "#", "basic"),
    ] {
        let mut pty = Pty::explorer(start);
        pty.sends(keys);
        pty.sends("l");
        pty.waits_for("the next pixel", |p| p.text().contains("pixel (21, "));
        pty.sends("q");
        assert_eq!(pty.ends(), 0);
        let found = if pty.occurrences(b"8;2;") > 0 {
            "direct"
        } else if pty.occurrences(b"8;5;") > 0 {
            "indexed"
        } else if pty.sets_colors() {
            "basic"
        } else {
            "none"
        };
        assert_eq!(found, expected);
    }
}

#[test]
fn ascii_is_written_where_it_is_asked_for() {
    let mut pty = Pty::explorer(Start::default().args(&["trio", "--ascii"]));
    pty.sends("dbbbvvv?\x1b=\x1b:quit!\r");
    assert_eq!(pty.ends(), 0);
    assert!(pty.bytes().is_ascii());
}

#[test]
fn lines_of_text_work_on_every_terminal_and_move_no_cursor() {
    for term in ["dumb", "xterm-256color"] {
        let start = Start::default().args(&["tutorial", "--plain"]);
        let mut pty = start.env("TERM", term).open();
        pty.waits_to_show("> ");
        pty.sends("cursor-right 3\r");
        pty.waits_to_show("pixel (23, 20)");
        pty.sends("move-x-plus\r");
        pty.waits_to_show("unsaved yes");
        pty.sends("quit\r");
        pty.waits_to_show("Unsaved changes");
        pty.sends("esc\r");
        pty.waits_to_show("Nothing was changed.");
        pty.sends("undo\rquit\r");
        assert_eq!(pty.ends(), 0);
        assert!(!pty.bytes().contains(&0x1b), "an escape sequence");
        pty.is_restored();
    }
}

#[test]
fn lines_of_text_lose_nothing_with_their_terminal() {
    let start = || Start::default().args(&["--plain"]);
    let mut pty = start().open();
    pty.waits_to_show("> ");
    pty.sends("move-x-plus\r");
    pty.waits_to_show("unsaved yes");
    let home = pty.home();
    assert_eq!(pty.hangs_up(), 129);
    let mut pty = start().home(&home).open();
    pty.waits_to_show("Unsaved work of");
    pty.sends("o\r");
    pty.waits_to_show("center.x 21");
    pty.is_sent(Signal::TERM);
    assert_eq!(pty.ends(), 143);
    assert!(pty.shows("unsaved work is kept in"));
}

impl Pty {
    /// Whether a colour was asked for anywhere: 30 to 38, 40 to 48, 90 to 107.
    fn sets_colors(&self) -> bool {
        let text = String::from_utf8_lossy(self.bytes());
        let sequences = text.split("\x1b[").skip(1);
        sequences
            .filter_map(|s| s.split_once('m'))
            .map(|(parameters, _)| parameters)
            .filter(|p| p.bytes().all(|b| b.is_ascii_digit() || b == b';'))
            .flat_map(|p| p.split(';'))
            .filter_map(|n| n.parse().ok())
            .any(|n: u16| matches!(n, 30..=38 | 40..=48 | 90..=107))
    }

    /// What the panel says that a letter comes to: the last word of its line, or of the line that goes on with it.
    fn value(&self, name: &str) -> String {
        let text = self.text();
        let panel = |line: &str| {
            let (line, _) = line.rsplit_once('│')?;
            Some(line.rsplit_once('│')?.1.trim_end().to_owned())
        };
        let lines: Vec<_> = text.lines().filter_map(panel).collect();
        let first = lines
            .iter()
            .position(|line| line.split_whitespace().next() == Some(name))
            .unwrap_or_else(|| panic!("no {name} on\n{text}"));
        let more = lines[first + 1..]
            .iter()
            .take_while(|line| line.starts_with("   "));
        let last = more.last().unwrap_or(&lines[first]);
        last.split_whitespace()
            .last()
            .unwrap_or_default()
            .to_owned()
    }
}
