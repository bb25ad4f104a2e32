//! What a class costs its host: many explorers at once, each in a terminal of its own, keys at the
//! pace of people. `cargo bench --bench class -- [STUDENTS [SECONDS [KEYS A SECOND]]]`
//!
//! The terminals answer status queries, as real ones do. Latency is from the key to the last byte of
//! the frame that answers it. Memory is what a process has for itself, and its part of what is shared.

use std::fs;
use std::io::{Read, Write};
use std::process::ExitCode;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use portable_pty::{Child, CommandBuilder, MasterPty, PtySize, native_pty_system};

/// Keys of a person who looks around: camera, cursor, sphere, step.
const KEYS: &[&str] = &[
    "d", "\x1b[C", "a", "\x1b[B", "x", "w", "\x1b[D", "X", "s", "\x1b[A",
];
const QUERY: &[u8] = b"\x1b[5n";

/// One student's explorer.
struct Seat {
    child: Box<dyn Child + Send + Sync>,
    writer: Arc<Mutex<Box<dyn Write + Send>>>,
    /// Keeps the terminal open.
    _master: Box<dyn MasterPty + Send>,
    reader: JoinHandle<()>,
    /// When the last byte came, in microseconds since the start.
    last: Arc<AtomicU64>,
    bytes: Arc<AtomicU64>,
}

impl Seat {
    fn take(start: Instant, home: &std::path::Path) -> Self {
        let size = PtySize {
            rows: 24,
            cols: 80,
            ..PtySize::default()
        };
        let pair = native_pty_system().openpty(size).expect("a pty");
        let mut command = CommandBuilder::new(env!("CARGO_BIN_EXE_rayscope"));
        command.arg("trio");
        command.env_clear();
        command.env("TERM", "xterm-256color");
        command.env("LANG", "C.UTF-8");
        command.env("HOME", home);
        let child = pair.slave.spawn_command(command).expect("the program");
        drop(pair.slave);
        let writer = Arc::new(Mutex::new(pair.master.take_writer().expect("a writer")));
        let mut from = pair.master.try_clone_reader().expect("a reader");
        let [last, bytes] = [0, 0].map(|n| Arc::new(AtomicU64::new(n)));
        let (answers, seen, count) = (Arc::clone(&writer), Arc::clone(&last), Arc::clone(&bytes));
        let reader = thread::spawn(move || {
            let mut chunk = [0; 1 << 14];
            while let Ok(n @ 1..) = from.read(&mut chunk) {
                seen.store(start.elapsed().as_micros() as u64, Ordering::SeqCst);
                count.fetch_add(n as u64, Ordering::SeqCst);
                if chunk[..n].windows(QUERY.len()).any(|w| w == QUERY) {
                    // Where the program has ended meanwhile there is nobody to answer.
                    let _ = answers.lock().expect("a writer").write_all(b"\x1b[0n");
                }
            }
        });
        Self {
            child,
            writer,
            _master: pair.master,
            reader,
            last,
            bytes,
        }
    }

    fn presses(&self, key: &str) {
        let mut writer = self.writer.lock().expect("a writer");
        writer.write_all(key.as_bytes()).expect("the key is taken");
    }

    /// Kilobytes from one of the files that tell of a process.
    fn kilobytes(&self, file: &str, name: &str) -> u64 {
        let pid = self.child.process_id().expect("a process");
        let text = fs::read_to_string(format!("/proc/{pid}/{file}")).unwrap_or_default();
        let line = text.lines().find_map(|l| l.strip_prefix(name));
        let number = line.and_then(|l| l.split_whitespace().next());
        number.and_then(|n| n.parse().ok()).unwrap_or(0)
    }

    /// Processor time so far, in clock ticks of 10 ms.
    fn ticks(&self) -> u64 {
        let pid = self.child.process_id().expect("a process");
        let text = fs::read_to_string(format!("/proc/{pid}/stat")).unwrap_or_default();
        let rest = text.rsplit(')').next().unwrap_or_default();
        let fields: Vec<&str> = rest.split_whitespace().collect();
        let number = |at: usize| fields.get(at).and_then(|f| f.parse::<u64>().ok());
        number(11).unwrap_or(0) + number(12).unwrap_or(0)
    }
}

fn main() -> ExitCode {
    // cargo adds flags of its own.
    let numbers: Result<Vec<u64>, _> = std::env::args()
        .skip(1)
        .filter(|a| !a.starts_with("--"))
        .map(|a| a.parse())
        .collect();
    let Ok(numbers) = numbers else {
        eprintln!("class: expected up to three numbers: students, seconds, keys a second");
        return ExitCode::from(2);
    };
    let number = |at: usize, usual: u64| numbers.get(at).copied().unwrap_or(usual).max(1);
    let (students, seconds, rate) = (number(0, 40), number(1, 10), number(2, 5));
    let home = tempfile::tempdir().expect("a home");
    let start = Instant::now();
    let mut seats: Vec<_> = (0..students)
        .map(|_| Seat::take(start, home.path()))
        .collect();
    // All have drawn their first screen once nothing has come for a while.
    let quiet = |seats: &[Seat]| {
        let now = start.elapsed().as_micros() as u64;
        let last = |s: &Seat| s.last.load(Ordering::SeqCst);
        seats.iter().all(|s| last(s) > 0 && now > last(s) + 500_000)
    };
    while !quiet(&seats) {
        thread::sleep(Duration::from_millis(20));
    }
    let sum = |f: &dyn Fn(&Seat) -> u64| -> u64 { seats.iter().map(f).sum() };
    let ticks = sum(&Seat::ticks);
    let bytes = sum(&|s| s.bytes.load(Ordering::SeqCst));
    let begin = Instant::now();
    // Everybody's keys, evenly spread over the time between two of one student.
    let gap = Duration::from_secs(1) / (rate * students) as u32;
    let mut pressed: Vec<Option<u64>> = vec![None; seats.len()];
    let mut latencies = Vec::new();
    for turn in 0..seconds * rate * students {
        let due = begin + gap * turn as u32;
        thread::sleep(due.saturating_duration_since(Instant::now()));
        let at = (turn % students) as usize;
        let seat = &seats[at];
        // By its next key a student's last one has been answered, or it counts as that late.
        if let Some(then) = pressed[at] {
            latencies.push(seat.last.load(Ordering::SeqCst).saturating_sub(then));
        }
        pressed[at] = Some(start.elapsed().as_micros() as u64);
        seat.presses(KEYS[(turn / students) as usize % KEYS.len()]);
    }
    let elapsed = begin.elapsed().as_secs_f64();
    let each = |total: u64| total as f64 / students as f64;
    let keys = (seconds * rate * students) as f64;
    latencies.sort_unstable();
    let part = |p: f64| {
        let at = (latencies.len() as f64 * p) as usize;
        latencies
            .get(at.min(latencies.len().saturating_sub(1)))
            .map_or(0.0, |us| *us as f64 / 1e3)
    };
    let cpu = (sum(&Seat::ticks) - ticks) as f64 / 100.0 / elapsed;
    let sent = (sum(&|s| s.bytes.load(Ordering::SeqCst)) - bytes) as f64;
    println!("students            {students}");
    println!("keys a second each  {rate}");
    println!(
        "latency, ms         p50 {:.1}   p99 {:.1}   max {:.1}",
        part(0.5),
        part(0.99),
        part(1.0)
    );
    println!(
        "processor           {:.1} % of one core in all, {:.2} % a student",
        cpu * 100.0,
        cpu * 100.0 / students as f64
    );
    println!(
        "memory a student    {:.1} MB resident, {:.1} MB of its own, {:.1} MB with its part of what is shared",
        each(sum(&|s| s.kilobytes("status", "VmRSS:"))) / 1e3,
        each(sum(&|s| s.kilobytes("smaps_rollup", "Private_Dirty:"))) / 1e3,
        each(sum(&|s| s.kilobytes("smaps_rollup", "Pss:"))) / 1e3,
    );
    println!(
        "sent                {:.0} bytes a key, {:.1} KB/s a student",
        sent / keys,
        sent / elapsed / students as f64 / 1e3
    );
    for seat in &mut seats {
        // It may have ended by itself.
        let _ = seat.child.kill();
        let _ = seat.child.wait();
    }
    for Seat {
        reader,
        writer,
        _master: master,
        ..
    } in seats
    {
        drop((writer, master));
        let _ = reader.join();
    }
    ExitCode::SUCCESS
}
