//! The program at the other end of a real `ssh`, through a real `sshd` on the loopback.
//!
//! `RAYSCOPE_SSHD=/usr/sbin/sshd cargo test --test terminal ssh -- --ignored` runs these. The server has its
//! own configuration, keys and port, and ends with its test.

use std::fmt::Write as _;
use std::fs;
use std::net::{TcpListener, TcpStream};
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use rustix::process::{Pid, Signal, kill_process, test_kill_process};
use tempfile::TempDir;

use crate::pty::{Pty, Start};

/// How long anything may take before it counts as not happening.
const PATIENCE: Duration = Duration::from_secs(20);
const PROGRAM: &str = env!("CARGO_BIN_EXE_rayscope");

/// An sshd, for this test alone.
struct Server {
    folder: TempDir,
    port: u16,
    child: Child,
}

impl Server {
    /// Starts one with these lines added to its configuration.
    fn start(lines: &str) -> Self {
        let sshd = std::env::var("RAYSCOPE_SSHD").expect("RAYSCOPE_SSHD names the sshd");
        let folder = tempfile::tempdir().expect("a folder");
        for key in ["host", "user"] {
            let path = folder.path().join(key);
            let made = Command::new("ssh-keygen")
                .args(["-q", "-t", "ed25519", "-N", "", "-f"])
                .arg(path)
                .status();
            assert!(made.expect("ssh-keygen").success());
        }
        let free = TcpListener::bind("127.0.0.1:0").expect("a port");
        let port = free.local_addr().expect("an address").port();
        drop(free);
        let config = folder.path().join("config");
        let place = folder.path().display();
        let text = format!(
            "ListenAddress 127.0.0.1\nPort {port}\nHostKey {place}/host\nPidFile none\n\
             AuthorizedKeysFile {place}/user.pub\nStrictModes no\nUsePAM no\n\
             PasswordAuthentication no\nKbdInteractiveAuthentication no\n\
             PermitRootLogin prohibit-password\n{lines}"
        );
        fs::write(&config, text).expect("a configuration");
        let child = Command::new(sshd)
            .args(["-D", "-e", "-f"])
            .arg(config)
            .stderr(Stdio::null())
            .spawn()
            .expect("the server");
        let mut server = Self {
            folder,
            port,
            child,
        };
        server.waits_until("it listens", |s| {
            TcpStream::connect(("127.0.0.1", s.port)).is_ok()
        });
        server
    }

    /// A start of the explorer at the other end, its work and its state in the server's folder.
    fn explorer(&self, arguments: &str) -> Start {
        self.explorer_after("", arguments)
    }

    /// The same, with a command of the shell before it.
    fn explorer_after(&self, before: &str, arguments: &str) -> Start {
        let place = self.folder.path().display();
        let mut line = format!(
            "exec ssh -tt -F none -p {} -i {place}/user -o IdentitiesOnly=yes \
             -o StrictHostKeyChecking=no -o UserKnownHostsFile=/dev/null -o LogLevel=ERROR \
             127.0.0.1 ",
            self.port
        );
        // Writing to a string does not fail.
        let _ = write!(
            line,
            "'{before}cd {place} && echo $$ >pid && export XDG_STATE_HOME={place}/state && \
             exec {PROGRAM} {arguments}'"
        );
        Start::default().through(&line)
    }

    fn file(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// The explorer's process, at this end of the line as it happens.
    fn pid(&self) -> Pid {
        let text = fs::read_to_string(self.file("pid")).expect("the file");
        let pid = text.trim().parse().ok().and_then(Pid::from_raw);
        pid.expect("a process")
    }

    /// Waits for the explorer to end.
    fn waits_for_its_end(&mut self) {
        let pid = self.pid();
        self.waits_until("it ended", |_| test_kill_process(pid).is_err());
    }

    fn waits_until(&mut self, what: &str, condition: impl Fn(&Self) -> bool) {
        let deadline = Instant::now() + PATIENCE;
        while !condition(self) {
            assert!(Instant::now() < deadline, "not true in time: {what}");
            thread::yield_now();
        }
    }

    /// The files of unsaved work.
    fn kept(&self) -> Vec<PathBuf> {
        let entries = fs::read_dir(self.file("state/rayscope"))
            .into_iter()
            .flatten();
        entries.flatten().map(|entry| entry.path()).collect()
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        // It may have ended by itself; its connections end with their clients.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

#[test]
#[ignore = "RAYSCOPE_SSHD names no sshd"]
fn a_person_opens_moves_saves_and_quits() {
    let server = Server::start("");
    let mut pty = Pty::explorer(server.explorer("tutorial"));
    pty.waits_to_show("pixel (20, 20)");
    pty.sends("\x1b[C\x1b[B");
    pty.waits_to_show("pixel (21, 21)");
    pty.resizes(120, 40);
    pty.waits_for("the new width", |p| p.text().lines().any(|l| l.len() > 100));
    pty.sends("x:save-as moved.toml\r");
    pty.waits_to_show("Saved");
    pty.sends("q");
    assert_eq!(pty.ends(), 0);
    pty.is_restored();
    let saved = fs::read_to_string(server.file("moved.toml")).expect("the file");
    assert!(saved.contains("center = [21, 20, 20]"));
    assert!(server.kept().is_empty());
}

#[test]
#[ignore = "RAYSCOPE_SSHD names no sshd"]
fn signals_and_ctrl_c_end_it_and_the_status_comes_back() {
    let server = Server::start("");
    for (signal, status) in [
        (Signal::HUP, 129),
        (Signal::INT, 130),
        (Signal::QUIT, 131),
        (Signal::TERM, 143),
    ] {
        let mut pty = Pty::explorer(server.explorer("tutorial"));
        kill_process(server.pid(), signal).expect("the signal is sent");
        assert_eq!(pty.ends(), status);
        pty.is_restored();
    }
    let mut pty = Pty::explorer(server.explorer("tutorial"));
    pty.sends("\x03");
    assert_eq!(pty.ends(), 130);
    pty.is_restored();
}

#[test]
#[ignore = "RAYSCOPE_SSHD names no sshd"]
fn a_killed_connection_ends_it_and_loses_nothing() {
    let mut server = Server::start("");
    let mut pty = Pty::explorer(server.explorer("tutorial"));
    pty.sends("x");
    pty.waits_to_show("unsaved");
    // The client goes without a word, as when its machine does.
    pty.is_sent(Signal::KILL);
    server.waits_for_its_end();
    server.waits_until("its work is kept", |s| s.kept().len() == 1);
    let mode = fs::metadata(&server.kept()[0])
        .expect("the file")
        .permissions()
        .mode();
    assert_eq!(mode & 0o777, 0o600);

    let mut pty = Pty::explorer(server.explorer("tutorial"));
    pty.waits_to_show("Unsaved work of");
    pty.sends("o");
    pty.waits_to_show("c: (21, 20, 20)");
    pty.sends("q");
    // An answer that loses work counts once the question has been shown.
    pty.waits_to_show("D quit without saving");
    pty.sends("D");
    assert_eq!(pty.ends(), 0);
    pty.is_restored();
}

#[test]
#[ignore = "RAYSCOPE_SSHD names no sshd"]
fn a_hangup_that_is_ignored_leaves_nothing_running() {
    let mut server = Server::start("");
    // As under nohup: the signal says nothing, the closed terminal has to.
    let pty = Pty::explorer(server.explorer_after("trap \"\" HUP && ", "tutorial"));
    pty.is_sent(Signal::KILL);
    server.waits_for_its_end();
}

#[test]
#[ignore = "RAYSCOPE_SSHD names no sshd"]
fn only_term_crosses_by_itself() {
    let local = |start: Start| {
        start
            .env("COLORTERM", "truecolor")
            .env("TERM_PROGRAM", "iTerm.app")
            .env("NO_COLOR", "1")
    };
    let ends = |pty: &mut Pty| {
        pty.sends("l");
        pty.waits_to_show("pixel (21, 20)");
        pty.sends("q");
        assert_eq!(pty.ends(), 0);
    };
    let server = Server::start("");
    let mut pty = Pty::explorer(local(server.explorer("tutorial")));
    ends(&mut pty);
    assert!(pty.bytes().is_ascii(), "LANG does not cross");
    assert!(pty.occurrences(b"8;5;") > 0, "TERM names 256 colours");
    assert_eq!(pty.occurrences(b"8;2;"), 0, "COLORTERM does not cross");

    let server = Server::start("SetEnv LANG=C.UTF-8 COLORTERM=truecolor\n");
    let mut pty = Pty::explorer(local(server.explorer("tutorial")));
    ends(&mut pty);
    assert!(!pty.bytes().is_ascii());
    assert!(pty.occurrences(b"8;2;") > 0);
}

#[test]
#[ignore = "RAYSCOPE_SSHD names no sshd"]
fn a_locked_down_account_has_the_explorer_and_nothing_else() {
    let folder = tempfile::tempdir().expect("a folder");
    let home = folder.path().display();
    let forced = format!("cd {home} && exec {PROGRAM} --plain");
    let server = Server::start(&format!(
        "ForceCommand {forced}\nAllowTcpForwarding no\nX11Forwarding no\n"
    ));
    // What the client asks for is not run.
    let mut pty = server.explorer("trio; echo escaped").open();
    pty.waits_to_show("quit ends");
    pty.sends("cursor 1 2\r");
    pty.waits_to_show("pixel (1, 2)");
    pty.sends("quit\r");
    assert_eq!(pty.ends(), 0);
    assert!(!pty.shows("escaped"));
    assert!(!Path::new(&server.file("pid")).exists());
}
