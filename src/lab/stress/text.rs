//! A stress report for people: tables of at most 80 columns, and the same in Markdown.

use std::fmt::Write as _;

use super::theory::{AGREEMENT, agree};
use super::{Cell, Check, Inputs, Report, Step, Sweep, bits_lost, invariance};
use crate::lab::numbers;
use crate::text::{hexadecimal, paragraph};

/// The report as tables of 80 columns: of each dial at most `ROWS` settings, the summary last.
pub fn table(report: &Report) -> String {
    let mut out = paragraph(&format!(
        "rayscope {} stress, seed {}, {} rays a setting, checksum of all answers {}",
        env!("CARGO_PKG_VERSION"),
        report.seed,
        report.rays,
        report.checksum()
    ));
    for sweep in &report.sweeps {
        out.push('\n');
        out += &paragraph(&format!("{}: {}", sweep.dial.name, sweep.dial.about));
        out += &grid(
            report,
            sweep,
            "wrong answers in per cent, bits lost: median/worst",
            wrong_and_bits,
        );
        out += &grid(report, sweep, "blame err/(κu): median/worst", blame);
        out += &inputs(sweep);
    }
    out.push('\n');
    out += &summary(report);
    out += &checks(report);
    out += &promises(report);
    out
}

/// The most settings of a dial that a table shows.
const ROWS: usize = 16;

/// The settings that a table shows: the first, the last, and some between.
fn chosen(sweep: &Sweep) -> impl Iterator<Item = &Step> {
    let stride = sweep.steps.len().div_ceil(ROWS).max(1);
    let last = sweep.steps.len().saturating_sub(1);
    sweep
        .steps
        .iter()
        .enumerate()
        .filter(move |&(i, _)| i % stride == 0 || i == last)
        .map(|(_, step)| step)
}

fn grid(report: &Report, sweep: &Sweep, title: &str, cell: fn(&Cell, usize) -> String) -> String {
    let mut out = format!("  {title}\n{:>8}", sweep.dial.quantity);
    for method in &report.methods {
        let _ = write!(out, " {:>11}", method.name());
    }
    out.push('\n');
    for step in chosen(sweep) {
        let _ = write!(out, "{:>8}", format!("2^{}", step.k));
        for found in &step.cells {
            let _ = write!(out, " {:>11}", cell(found, step.census.rays));
        }
        out.push('\n');
    }
    out
}

/// What rounding the inputs did, where the dial is about that.
fn inputs(sweep: &Sweep) -> String {
    if !sweep.dial.rounds_inputs() {
        return String::new();
    }
    let mut out = String::from(
        "  what rounding p0, d, c and r cost before any method was asked\n         \
         hits or misses changed, bits lost: median/worst\n",
    );
    for step in chosen(sweep) {
        let _ = write!(out, "{:>8}", format!("2^{}", step.k));
        if let Some(Inputs { changed, ulp }) = step.inputs {
            let [median, worst] = [ulp.p50, ulp.max].map(bits_lost);
            let changed = in_percent(changed, step.census.rays);
            let _ = write!(out, " {changed:>6} {median:>5.0}/{worst:.0}");
        }
        out.push('\n');
    }
    out
}

fn wrong_and_bits(cell: &Cell, rays: usize) -> String {
    let wrong = in_percent(cell.errors.wrong.total(), rays);
    let bits = |bits: Option<f64>| bits.map_or("-".into(), |bits| format!("{bits:.0}"));
    let (median, worst) = (bits(cell.bits_median()), bits(cell.bits_worst()));
    format!("{wrong} {:>5}", format!("{median}/{worst}"))
}

fn in_percent(part: usize, all: usize) -> String {
    let percent = 100.0 * part as f64 / all as f64;
    if part == 0 {
        "0".into()
    } else if percent < 0.095 {
        format!("{percent:.2}").replacen('0', "", 1)
    } else if percent < 9.95 {
        format!("{percent:.1}")
    } else {
        format!("{percent:.0}")
    }
}

fn blame(cell: &Cell, _: usize) -> String {
    if cell.errors.judged == 0 {
        return "-".into();
    }
    format!("{}/{}", tiny(cell.blame.p50), tiny(cell.blame.max))
}

/// A number in at most five characters.
fn tiny(x: f64) -> String {
    if x == 0.0 {
        "0".into()
    } else if (0.0095..0.095).contains(&x) {
        format!("{x:.2}")
    } else if (0.095..9.95).contains(&x) {
        format!("{x:.1}")
    } else if (9.95..9999.5).contains(&x) {
        format!("{x:.0}")
    } else {
        format!("{x:.0e}")
    }
}

/// Where each method breaks down, where theory says it should, and whether the two agree.
fn summary(report: &Report) -> String {
    let mut out = format!(
        "where each method breaks down; theory agrees within a factor of {AGREEMENT}\n\
         {:35}{:24}{}\n  {:9} {:9} {:10}",
        "", "first wrong answer", "hit moved > ½ pixel", "dial", "quantity", "method"
    );
    for _ in 0..2 {
        let _ = write!(out, " {:>8} {:>8} {:5}", "found", "theory", "agree");
    }
    out = out.trim_end().to_owned() + "\n";
    for place in places(report) {
        let _ = write!(
            out,
            "  {:9} {:9} {:10}",
            place.dial, place.quantity, place.method
        );
        for event in &place.events {
            let verdict = if event.agree { "yes" } else { "NO" };
            let _ = write!(out, " {:>8} {:>8} {verdict:5}", event.found, event.theory);
        }
        out = out.trim_end().to_owned() + "\n";
    }
    out
}

/// A line of the summary.
struct Place {
    dial: &'static str,
    quantity: &'static str,
    method: &'static str,
    events: [Event; 2],
}

/// One kind of breakdown, in words.
struct Event {
    found: String,
    theory: String,
    agree: bool,
}

fn places(report: &Report) -> impl Iterator<Item = Place> {
    report.sweeps.iter().flat_map(move |sweep| {
        (0..report.methods.len()).map(move |method| {
            let at = report.breakdown(sweep, method);
            let event = |found: Option<i32>, theory: Option<f64>| Event {
                found: found.map_or("never".into(), |k| format!("2^{k}")),
                theory: theory.map_or("never".into(), |k| format!("2^{k:.1}")),
                agree: agree(found, theory, sweep.dial.step()),
            };
            Place {
                dial: sweep.dial.name,
                quantity: sweep.dial.quantity,
                method: report.methods[method].name(),
                events: [
                    event(at.wrong, at.wrong_in_theory),
                    event(at.moved, at.moved_in_theory),
                ],
            }
        })
    })
}

fn checks(report: &Report) -> String {
    if report.checks.is_empty() {
        return String::new();
    }
    let mut out = format!(
        "\nwhat must hold besides: pass, or on how many rays it fails\n{:37}",
        ""
    );
    for method in &report.methods {
        let _ = write!(out, " {:>6.6}", method.name());
    }
    out.push('\n');
    for name in invariance::NAMES {
        let _ = write!(out, "  {name:35}");
        for check in report.checks.iter().filter(|check| check.name == name) {
            let _ = write!(out, " {:>6}", verdict(check));
        }
        out.push('\n');
    }
    out
}

fn verdict(check: &Check) -> String {
    match check.failed {
        0 => "pass".into(),
        failed => format!("{failed}"),
    }
}

fn promises(report: &Report) -> String {
    let mut out = String::from("\n");
    for kept in &report.kept {
        let _ = writeln!(
            out,
            "promise of {}: {} of {} answers broke it",
            kept.method, kept.broken, kept.asked
        );
        if let Some(problem) = &kept.first {
            let input = numbers(problem).map(hexadecimal).join(" ");
            out += &paragraph(&format!("  the first: {input}"));
        }
    }
    if !report.complete {
        out += "Interrupted: what is above is complete, the rest was not measured.\n";
    }
    let said = if report.promises_kept() {
        "kept"
    } else {
        "BROKEN"
    };
    let _ = writeln!(out, "promises {said}");
    out
}

/// The report in Markdown: the summary, the checks, and a table for each dial.
pub fn markdown(report: &Report) -> String {
    let mut out = format!(
        "seed {}, {} rays a setting\n\n{}\n{}",
        report.seed,
        report.rays,
        summary_table(report),
        check_table(report)
    );
    for sweep in &report.sweeps {
        let _ = write!(out, "\n### {}\n\n{}\n\n", sweep.dial.name, sweep.dial.about);
        out += &sweep_table(report, sweep);
    }
    let _ = write!(out, "\n```text{}```\n", promises(report));
    out
}

/// The summary as a Markdown table.
pub fn summary_table(report: &Report) -> String {
    let mut out = String::from(
        "| dial | method | first wrong answer | theory | agree | first hit moved > ½ pixel | theory | agree |\n\
         |---|---|--:|--:|---|--:|--:|---|\n",
    );
    for place in places(report) {
        let _ = write!(
            out,
            "| {}, {} | `{}` |",
            place.dial, place.quantity, place.method
        );
        for event in place.events {
            let agree = if event.agree { "yes" } else { "**no**" };
            let _ = write!(out, " {} | {} | {agree} |", event.found, event.theory);
        }
        out.push('\n');
    }
    out
}

/// The checks as a Markdown table.
pub fn check_table(report: &Report) -> String {
    let mut out = String::from("| what must hold besides |");
    for method in &report.methods {
        let _ = write!(out, " `{method}` |");
    }
    let _ = writeln!(out, "\n|---|{}", "--:|".repeat(report.methods.len()));
    for name in invariance::NAMES {
        let _ = write!(out, "| {name} |");
        for check in report.checks.iter().filter(|check| check.name == name) {
            let said = match check.failed {
                0 => "pass".to_owned(),
                failed => format!("fails {failed} of {}", check.rays),
            };
            let _ = write!(out, " {said} |");
        }
        out.push('\n');
    }
    out
}

/// The settings of one dial as a Markdown table: wrong answers in per cent, bits lost (median/worst),
/// blame (median/worst).
pub fn sweep_table(report: &Report, sweep: &Sweep) -> String {
    let mut out = format!("| {} |", sweep.dial.quantity);
    for method in &report.methods {
        let _ = write!(out, " `{method}` |");
    }
    let _ = writeln!(out, "\n|--:|{}", "--:|".repeat(report.methods.len()));
    for step in chosen(sweep) {
        let _ = write!(out, "| 2^{} |", step.k);
        for cell in &step.cells {
            let _ = write!(out, " {} |", in_words(cell, step.census.rays));
        }
        out.push('\n');
    }
    out
}

fn in_words(cell: &Cell, rays: usize) -> String {
    let wrong = match cell.errors.wrong.total() {
        0 => String::new(),
        wrong => format!("**{} %**", in_percent(wrong, rays)),
    };
    let bits = cell
        .bits_median()
        .zip(cell.bits_worst())
        .map(|(median, worst)| format!("{median:.0}/{worst:.0} bits, blame {}", blame(cell, 0)));
    match (wrong.is_empty(), bits) {
        (true, bits) => bits.unwrap_or_default(),
        (false, Some(bits)) => format!("{wrong}, {bits}"),
        (false, None) => wrong,
    }
}
