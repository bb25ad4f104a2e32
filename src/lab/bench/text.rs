//! A bench report for people: a table of at most 80 columns, and the same in Markdown.

use std::fmt::Write as _;

use super::{Chapter, Report, Row};
use crate::lab::errors::{Census, Errors, Fault, Worst};
use crate::lab::machine::Machine;
use crate::lab::numbers;
use crate::lab::timing::{Nanoseconds, Times};
use crate::method::exact::Stage;
use crate::text::{hexadecimal, paragraph};

/// A number with about three digits: enough to compare, short enough for a column.
pub(crate) fn brief(x: f64) -> String {
    let magnitude = x.abs();
    if magnitude == 0.0 {
        "0".into()
    } else if !(0.001..99_999.5).contains(&magnitude) {
        format!("{x:.1e}")
    } else if magnitude < 9.995 {
        format!("{x:.2}")
    } else if magnitude < 999.95 {
        format!("{x:.1}")
    } else {
        format!("{x:.0}")
    }
}

/// The report as a table of 80 columns; `worst` adds the inputs of the largest errors.
pub fn table(report: &Report, machine: &Machine, worst: bool) -> String {
    let mut out = header(report, machine);
    for chapter in &report.chapters {
        out.push('\n');
        out += &section(chapter, worst);
    }
    out.push('\n');
    out += &footer(report);
    out
}

fn header(report: &Report, machine: &Machine) -> String {
    let Machine {
        cpu,
        threads,
        target,
        compiler,
        flags,
    } = machine;
    [
        format!(
            "rayscope {} bench, seed {}, checksum of all answers {}",
            env!("CARGO_PKG_VERSION"),
            report.seed,
            report.checksum(),
        ),
        format!("{cpu}, {threads} threads, {target}"),
        format!("{compiler}, {flags}"),
    ]
    .map(|line| paragraph(&line))
    .concat()
}

fn section(chapter: &Chapter, worst: bool) -> String {
    let mut out = paragraph(&format!("{}: {}", chapter.name, chapter.about));
    out += &errors(chapter);
    out += &times(chapter);
    for row in &chapter.rows {
        out += &settled_by(row).map_or(String::new(), |text| paragraph(&format!("  {text}")));
    }
    for row in chapter.rows.iter().filter(|_| worst) {
        out += &row
            .errors
            .worst
            .map_or(String::new(), |w| largest(row.method, &w));
    }
    out
}

fn errors(chapter: &Chapter) -> String {
    let rows: Vec<_> = chapter
        .rows
        .iter()
        .map(|row| (if row.pareto { '*' } else { ' ' }, row.method, &row.errors))
        .collect();
    error_lines(&chapter.census, &rows)
}

/// A line of errors for each entrant: a mark, a name, what it got wrong.
pub(crate) fn error_lines(census: &Census, rows: &[(char, &str, &Errors)]) -> String {
    let mut out = String::from(
        "             false  false  wrong    not  error of the worse root in ulp\n  \
         method       hit   miss  count finite      p50      p99    p99.9  largest\n  of      ",
    );
    for fault in Fault::ALL {
        // Writing to a string does not fail.
        let _ = write!(out, " {:>6}", census.denominator(fault));
    }
    out.push('\n');
    for (mark, name, errors) in rows {
        let _ = write!(out, "{mark} {name:9}");
        for (i, fault) in Fault::ALL.into_iter().enumerate() {
            let width = if i == 0 { 6 } else { 7 };
            let _ = write!(out, "{:>width$}", errors.wrong.of(fault));
        }
        for value in percentiles(errors) {
            let _ = write!(out, "{:>9}", brief(value));
        }
        out.push('\n');
    }
    out
}

fn percentiles(errors: &Errors) -> [f64; 4] {
    let ulp = errors.ulp;
    [ulp.p50, ulp.p99, ulp.p999, ulp.max]
}

/// The three ways in which a row was timed, with the ratio to `textbook`.
fn ways(times: &Times) -> [(Nanoseconds, f64); 3] {
    [
        (times.throughput, times.throughput_ratio),
        (times.batch, times.batch_ratio),
        (times.latency, times.latency_ratio),
    ]
}

fn times(chapter: &Chapter) -> String {
    let titles = ["one by one", "in arrays", "waiting for the last"];
    let mut out = format!("  {:9}", "ns for");
    for title in titles {
        let _ = write!(out, "{title:>23}");
    }
    let _ = write!(out, "\n  {:9}", "a solve");
    for _ in titles {
        let _ = write!(out, "{:>6}{:>6}{:>6}{:>5}", "med.", "min", "iqr", "×tb");
    }
    out.push('\n');
    for row in &chapter.rows {
        let _ = write!(out, "  {:9}", row.method);
        for (Nanoseconds { median, min, iqr }, ratio) in ways(&row.times) {
            let [median, min, iqr] = [median, min, iqr].map(brief);
            let ratio = match brief(ratio) {
                long if long.len() > 4 => format!("{ratio:.0}"),
                ratio => ratio,
            };
            let _ = write!(out, "{median:>6}{min:>6}{iqr:>6}{ratio:>5}");
        }
        out.push('\n');
    }
    out
}

/// The stages that settled the rays of `exact`, in words; none for the other methods.
pub(crate) fn settled_by(row: &Row) -> Option<String> {
    let counts = row.stages?;
    let all: usize = counts.iter().sum();
    let shares: Vec<String> = Stage::ALL
        .into_iter()
        .zip(counts)
        .filter(|&(_, count)| count > 0)
        .map(|(stage, count)| format!("{stage} {}", percent(count, all)))
        .collect();
    Some(format!("{} settled by {}", row.method, shares.join(", ")))
}

pub(crate) fn percent(part: usize, all: usize) -> String {
    let percent = 100.0 * part as f64 / all.max(1) as f64;
    if percent > 99.95 && part < all {
        format!("{percent:.3} %")
    } else if part == 0 || percent >= 0.095 {
        format!("{percent:.1} %")
    } else {
        format!("{percent:.3} %")
    }
}

fn largest(method: &str, worst: &Worst) -> String {
    let error = worst.error;
    let [ox, oy, oz, dx, dy, dz, cx, cy, cz, r] = numbers(&worst.problem).map(hexadecimal);
    paragraph(&format!(
        "  {method}: largest {} ulp, {} for {} at p0 {ox} {oy} {oz} d {dx} {dy} {dz} \
         c {cx} {cy} {cz} r {r}",
        brief(error.ulps),
        hexadecimal(error.answer),
        hexadecimal(error.exact),
    ))
}

fn footer(report: &Report) -> String {
    let mut out = String::new();
    if !report.complete {
        out += "Interrupted: what is above is complete, the rest was not measured.\n";
    }
    out += "* Pareto: none is as good in wrong answers, p99 and time, and better in one\n";
    out += "×tb: times textbook in the same rounds, the median over the rounds\n";
    for check in &report.self_checks {
        let said = if check.passed { "passed" } else { "FAILED" };
        let _ = writeln!(
            out,
            "self-check {said}: {}, {:.3} (from {} to {})",
            check.name, check.ratio, check.least, check.most
        );
    }
    let trusted = report.times_trusted();
    let _ = writeln!(out, "times_trusted: {trusted}");
    out
}

/// The report in Markdown: overviews of errors and times; for each set a table of errors, which are the same
/// everywhere, and one of times, which are not.
pub fn markdown(report: &Report, machine: &Machine) -> String {
    let mut out = format!("```text\n{}```\n\n", header(report, machine));
    out += &error_overview(report);
    out.push('\n');
    out += "One by one:\n\n";
    out += &time_overview(report, |times| ways(times)[0]);
    out += "\nIn arrays:\n\n";
    out += &time_overview(report, |times| ways(times)[1]);
    for chapter in &report.chapters {
        let _ = write!(out, "\n### {}\n\n{}\n\n", chapter.name, chapter.about);
        out += &error_table(chapter);
        out.push('\n');
        out += &time_table(chapter);
        out.push('\n');
        for row in &chapter.rows {
            if let Some(worst) = &row.errors.worst {
                let input = numbers(&worst.problem).map(hexadecimal).join(" ");
                let _ = writeln!(out, "* `{}`, largest at `{input}`", row.method);
            }
        }
    }
    let _ = write!(out, "\n```text\n{}```\n", footer(report));
    out
}

/// A Markdown table with a line for each set and a column for each method.
fn overview(report: &Report, cell: impl Fn(&Chapter, &Row) -> String) -> String {
    let Some(first) = report.chapters.first() else {
        return String::new();
    };
    let mut out = String::from("| rays |");
    for row in &first.rows {
        let _ = write!(out, " `{}` |", row.method);
    }
    let _ = writeln!(out, "\n|---|{}", "--:|".repeat(first.rows.len()));
    for chapter in &report.chapters {
        let _ = write!(out, "| {} |", chapter.name);
        for row in &chapter.rows {
            let _ = write!(out, " {} |", cell(chapter, row));
        }
        out.push('\n');
    }
    out
}

/// Wrong answers and the 99th percentile of the error in ulp, set by set.
pub fn error_overview(report: &Report) -> String {
    overview(report, |chapter, row| {
        let errors = &row.errors;
        let p99 = match errors.judged {
            0 => "–".to_owned(),
            _ => brief(errors.ulp.p99),
        };
        match errors.wrong.total() {
            0 => p99,
            wrong => format!("**{}**, {p99}", percent(wrong, chapter.census.rays)),
        }
    })
}

/// The median time of one solve in ns, and how many times that of `textbook` it is.
fn time_overview(report: &Report, way: fn(&Times) -> (Nanoseconds, f64)) -> String {
    overview(report, |_, row| {
        let (ns, ratio) = way(&row.times);
        format!("{} ({ratio:.2})", brief(ns.median))
    })
}

/// The error columns of one set as a Markdown table.
pub fn error_table(chapter: &Chapter) -> String {
    let mut out = String::from("| method |");
    for fault in Fault::ALL {
        let of = chapter.census.denominator(fault);
        let _ = write!(out, " {} of {of} |", fault.name());
    }
    out += " p50 ulp | p99 | p99.9 | largest |\n|---|";
    out += &"--:|".repeat(8);
    out.push('\n');
    for row in &chapter.rows {
        let _ = write!(out, "| `{}` |", row.method);
        for fault in Fault::ALL {
            let _ = write!(out, " {} |", row.errors.wrong.of(fault));
        }
        for value in percentiles(&row.errors) {
            let _ = write!(out, " {} |", brief(value));
        }
        out.push('\n');
    }
    out
}

fn time_table(chapter: &Chapter) -> String {
    let mut out = String::from(
        "| method | ns one by one | min | iqr | × textbook | ns in arrays | min | iqr | × textbook | \
         latency ns | min | iqr | × textbook | Pareto |\n|---|",
    );
    out += &"--:|".repeat(12);
    out += "---|\n";
    for row in &chapter.rows {
        let _ = write!(out, "| `{}` |", row.method);
        for (Nanoseconds { median, min, iqr }, ratio) in ways(&row.times) {
            let _ = write!(out, " {median:.1} | {min:.1} | {iqr:.1} | {ratio:.2} |");
        }
        let _ = writeln!(out, " {} |", if row.pareto { "yes" } else { "" });
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_brief() {
        let cases = [
            (0.0, "0"),
            (0.2512, "0.25"),
            (9.996, "10.0"),
            (1788.4, "1788"),
            (99_999.6, "1.0e5"),
            (2.5e-5, "2.5e-5"),
        ];
        for (x, text) in cases {
            assert_eq!(brief(x), text);
        }
    }

    #[test]
    fn a_share_that_is_not_all_does_not_look_like_all() {
        assert_eq!(percent(2048, 2048), "100.0 %");
        assert_eq!(percent(16_383, 16_384), "99.994 %");
        assert_eq!(percent(1, 16_384), "0.006 %");
        assert_eq!(percent(0, 0), "0.0 %");
    }
}
