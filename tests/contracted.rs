//! `contracted` is what a compiler makes of the tutorial's C where it may fuse: held to GCC, bit for bit.

use std::fmt::Write as _;
use std::io::Write as _;
use std::process::{Command, Stdio};

use rayscope::lab::{Family, numbers};
use rayscope::method::Method;

/// The tutorial's code compiled with contraction; none where no GCC for this processor is at hand, or
/// the processor has no fused multiply-add.
fn compiled(folder: &std::path::Path) -> Option<std::path::PathBuf> {
    #[cfg(target_arch = "x86_64")]
    if !std::arch::is_x86_feature_detected!("fma") {
        return None;
    }
    let version = Command::new("gcc").arg("-dumpmachine").output().ok()?;
    let fused: &[&str] = match String::from_utf8(version.stdout).ok()? {
        machine if machine.starts_with("x86_64") => &["-mfma"],
        _ => return None,
    };
    let program = folder.join("contracted");
    let done = Command::new("gcc")
        .args(["-O2", "-o"])
        .arg(&program)
        .args(fused)
        .args(["tests/bench/contracted.c", "-lm"])
        .status()
        .ok()?;
    done.success().then_some(program)
}

#[test]
fn contracted_is_what_gcc_makes_of_the_tutorials_code() {
    let folder = tempfile::tempdir().unwrap();
    let Some(program) = compiled(folder.path()) else {
        println!("skipped: no GCC with -mfma here");
        return;
    };
    let families = Family::ALL.iter().flat_map(|family| family.sample(7, 500));
    let problems: Vec<_> = families.collect();
    let mut rows = String::new();
    let mut expected = String::new();
    for problem in &problems {
        let bits = numbers(problem).map(|x| format!("{:x}", x.to_bits()));
        let _ = writeln!(rows, "{}", bits.join(" "));
        let found = Method::Contracted.solve(&problem.0, &problem.1);
        let [near, far] = [found.near, found.far]
            .map(|t| if t.is_nan() { f32::NAN } else { t })
            .map(f32::to_bits);
        let _ = writeln!(expected, "{} {near:08x} {far:08x}", found.class);
    }
    let mut child = Command::new(program)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut input = child.stdin.take().unwrap();
    let writer = std::thread::spawn(move || input.write_all(rows.as_bytes()));
    let output = child.wait_with_output().unwrap();
    writer.join().unwrap().unwrap();
    let found = String::from_utf8(output.stdout).unwrap();
    assert_eq!(found.lines().count(), problems.len());
    for ((found, expected), (ray, sphere)) in found.lines().zip(expected.lines()).zip(&problems) {
        assert_eq!(found, expected, "{ray:?} {sphere:?}");
    }
}
