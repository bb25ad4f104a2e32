//! What a report was made with: processor, system, compiler, flags.

use std::env::consts::{ARCH, OS};
use std::fs;

use serde::Serialize;

/// What a time depends on besides the program.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Machine {
    /// The processor's own name, where the system tells it.
    pub cpu: String,
    /// How many threads run at once.
    pub threads: usize,
    /// Architecture and operating system.
    pub target: String,
    /// The compiler that built this program.
    pub compiler: String,
    /// Optimised or not, and which vector instructions the compiler was allowed.
    pub flags: String,
}

impl Machine {
    /// The machine this program runs on and the way it was built.
    pub fn detect() -> Self {
        Self {
            cpu: cpu().unwrap_or_else(|| "unknown".into()),
            threads: std::thread::available_parallelism().map_or(1, usize::from),
            target: format!("{ARCH} {OS}"),
            compiler: compiler().unwrap_or_else(|| {
                let oldest = env!("CARGO_PKG_RUST_VERSION");
                format!("rustc, unknown, {oldest} or later")
            }),
            flags: flags(),
        }
    }

    /// What it is, and how the program was built.
    pub fn sentences(&self) -> [String; 2] {
        let Self {
            cpu,
            threads,
            target,
            compiler,
            flags,
        } = self;
        [
            format!("{cpu}, {threads} threads, {target}"),
            format!("{compiler}, {flags}"),
        ]
    }
}

/// How many programs want to run for each thread that can, over the last minute; none where the system
/// does not say.
pub(super) fn load() -> Option<f64> {
    let text = fs::read_to_string("/proc/loadavg").ok()?;
    let load: f64 = text.split(' ').next()?.parse().ok()?;
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    Some(load / threads as f64)
}

/// The first model name that Linux lists.
fn cpu() -> Option<String> {
    let list = fs::read_to_string("/proc/cpuinfo").ok()?;
    let line = list.lines().find(|line| line.starts_with("model name"))?;
    Some(line.split_once(':')?.1.trim().to_owned())
}

/// What rustc notes of itself in every executable for Linux, in its section `.comment`.
fn compiler() -> Option<String> {
    const NOTE: &[u8] = b"rustc version ";
    let program = fs::read(std::env::current_exe().ok()?).ok()?;
    let follows = |at: usize| program.get(at + NOTE.len()).is_some_and(u8::is_ascii_digit);
    let at = (0..program.len()).find(|&at| program[at..].starts_with(NOTE) && follows(at))?;
    let version = &program[at + NOTE.len()..];
    let end = version.iter().position(|&byte| byte == 0 || byte == b')')?;
    let version = String::from_utf8_lossy(&version[..end]).into_owned();
    let closing = if version.contains('(') { ")" } else { "" };
    Some(format!("rustc {version}{closing}"))
}

fn flags() -> String {
    let optimised = if cfg!(debug_assertions) {
        "dev build, not optimised"
    } else {
        "release build"
    };
    let features = [
        ("sse2", cfg!(target_feature = "sse2")),
        ("avx", cfg!(target_feature = "avx")),
        ("avx2", cfg!(target_feature = "avx2")),
        ("fma", cfg!(target_feature = "fma")),
        ("avx512f", cfg!(target_feature = "avx512f")),
        ("neon", cfg!(target_feature = "neon")),
    ];
    let features: Vec<&str> = features
        .into_iter()
        .filter_map(|(name, on)| on.then_some(name))
        .collect();
    match features.join(" ") {
        none if none.is_empty() => optimised.to_owned(),
        features => format!("{optimised}, {features}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn knows_the_compiler_of_this_very_program() {
        if OS != "linux" {
            return;
        }
        let compiler = compiler().expect("the note of rustc");
        let version: Vec<u32> = compiler
            .trim_start_matches("rustc ")
            .split([' ', '-'])
            .next()
            .unwrap()
            .split('.')
            .map(|number| number.parse().unwrap())
            .collect();
        assert!(version >= vec![1, 88, 0], "{compiler}");
    }
}
