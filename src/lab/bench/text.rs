//! A benchmark for people: as text of 80 columns, and the same in Markdown.

use super::{Benchmark, MeasuredMethod, MeasuredSet};
use crate::lab::errors::{Census, Errors, Fault, Worst};
use crate::lab::machine::Machine;
use crate::lab::numbers;
use crate::lab::timing::{Nanoseconds, Times};
use crate::method::exact::Stage;
use crate::report::{Column, Report, Table};
use crate::text::hexadecimal;

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

/// The report as text; `worst` adds the inputs of the largest errors.
pub fn text(bench: &Benchmark, machine: &Machine, worst: bool) -> Report {
    let start = Report::new().lines(header(bench, machine));
    let sets = bench.sets.iter();
    sets.fold(start, |report, set| report.gap().then(section(set, worst)))
        .gap()
        .lines(footer(bench))
}

fn header(bench: &Benchmark, machine: &Machine) -> Vec<String> {
    let [hardware, build] = machine.sentences();
    let version = env!("CARGO_PKG_VERSION");
    let (seed, checksum) = (bench.seed, bench.checksum());
    vec![
        format!("rayscope {version} bench, seed {seed}, checksum of all answers {checksum}"),
        hardware,
        build,
    ]
}

fn section(set: &MeasuredSet, worst: bool) -> Report {
    let rows = &set.rows;
    let settled = rows.iter().filter_map(settled_by);
    let largest = rows.iter().filter(|_| worst).filter_map(largest);
    Report::new()
        .heading(format!("{}: {}", set.name, set.about))
        .table(errors(set))
        .table(times(set))
        .lines(settled.map(|text| format!("  {text}")))
        .lines(largest)
}

fn errors(set: &MeasuredSet) -> Table {
    let rows: Vec<_> = set
        .rows
        .iter()
        .map(|row| (if row.pareto { '*' } else { ' ' }, row.method, &row.errors))
        .collect();
    error_lines(&set.census, &rows)
}

/// A line of errors for each entrant: a mark, a name, what it got wrong.
pub(crate) fn error_lines(census: &Census, rows: &[(char, &str, &Errors)]) -> Table {
    let names = [
        "hit", "miss", "count", "finite", "p50", "p99", "p99.9", "largest",
    ];
    let of = Fault::ALL.map(|fault| census.denominator(fault).to_string());
    let of = std::iter::once("  of".to_owned()).chain(of).collect();
    let cells = |&(mark, name, errors): &(char, &str, &Errors)| {
        let name = format!("{mark} {name}");
        std::iter::once(name).chain(error_cells(errors)).collect()
    };
    Table::new(
        std::iter::once(Column::left("  method")).chain(names.map(Column::right)),
        std::iter::once(of).chain(rows.iter().map(cells)),
    )
    .grouped(&[
        ("", 1),
        ("false", 1),
        ("false", 1),
        ("wrong", 1),
        ("not", 1),
        ("error of the worse root in ulp", 4),
    ])
}

/// Wrong answers by kind, and the error of the worse root.
fn error_cells(errors: &Errors) -> impl Iterator<Item = String> {
    let wrong = Fault::ALL.map(|fault| errors.wrong.of(fault).to_string());
    let ulp = errors.ulp;
    let ulp = [ulp.p50, ulp.p99, ulp.p999, ulp.max].map(brief);
    wrong.into_iter().chain(ulp)
}

/// The three ways in which a row was timed, with the ratio to `textbook`.
fn ways(times: &Times) -> [(Nanoseconds, f64); 3] {
    [
        (times.throughput, times.throughput_ratio),
        (times.batch, times.batch_ratio),
        (times.latency, times.latency_ratio),
    ]
}

fn times(set: &MeasuredSet) -> Table {
    let names = ["med.", "min", "iqr", "×tb"].repeat(3);
    let cells = |row: &MeasuredMethod| {
        let ways = ways(&row.times).into_iter().flat_map(|(ns, ratio)| {
            let ratio = match brief(ratio) {
                long if long.len() > 4 => format!("{ratio:.0}"),
                ratio => ratio,
            };
            [brief(ns.median), brief(ns.min), brief(ns.iqr), ratio]
        });
        std::iter::once(row.method.to_owned()).chain(ways).collect()
    };
    Table::new(
        std::iter::once(Column::left("a solve")).chain(names.into_iter().map(Column::right)),
        set.rows.iter().map(cells),
    )
    .grouped(&[
        ("ns for", 1),
        ("one by one", 4),
        ("in arrays", 4),
        ("waiting for the last", 4),
    ])
    .indented(2)
}

/// The stages that settled the rays of `exact`, in words; none for the other methods.
pub(crate) fn settled_by(row: &MeasuredMethod) -> Option<String> {
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

/// The input of a method's largest error; none if no answer has one.
fn largest(row: &MeasuredMethod) -> Option<String> {
    let Worst { error, problem } = row.errors.worst.as_ref()?;
    let [ox, oy, oz, dx, dy, dz, cx, cy, cz, r] = numbers(problem).map(hexadecimal);
    Some(format!(
        "  {}: largest {} ulp, {} for {} at p0 {ox} {oy} {oz} d {dx} {dy} {dz} \
         c {cx} {cy} {cz} r {r}",
        row.method,
        brief(error.ulps),
        hexadecimal(error.answer),
        hexadecimal(error.exact),
    ))
}

fn footer(bench: &Benchmark) -> Vec<String> {
    let mut out = Vec::new();
    if !bench.complete {
        out.push("Interrupted: what is above is complete, the rest was not measured.".into());
    }
    out.push("* Pareto: none is as good in wrong answers, p99 and time, and better in one".into());
    out.push("×tb: times textbook in the same rounds, the median over the rounds".into());
    out.extend(bench.self_checks.iter().map(|check| {
        let said = if check.passed { "passed" } else { "FAILED" };
        format!(
            "self-check {said}: {}, {:.3} (from {} to {})",
            check.name, check.ratio, check.least, check.most
        )
    }));
    out.push(format!("times_trusted: {}", bench.times_trusted()));
    out
}

/// The report in Markdown: overviews of errors and times; for each set a table of errors, which are the same
/// everywhere, and one of times, which are not.
pub fn markdown(bench: &Benchmark, machine: &Machine) -> Report {
    let start = Report::new()
        .fixed(header(bench, machine))
        .table(error_overview(bench))
        .words("One by one:")
        .table(time_overview(bench, |times| ways(times)[0]))
        .words("In arrays:")
        .table(time_overview(bench, |times| ways(times)[1]));
    let sets = bench.sets.iter();
    sets.fold(start, |report, set| {
        report
            .heading(&set.name)
            .words(&set.about)
            .table(error_table(set))
            .table(time_table(set))
            .items(set.rows.iter().filter_map(largest_input).collect())
    })
    .fixed(footer(bench))
}

fn largest_input(row: &MeasuredMethod) -> Option<String> {
    let worst = row.errors.worst.as_ref()?;
    let input = numbers(&worst.problem).map(hexadecimal).join(" ");
    Some(format!("`{}`, largest at `{input}`", row.method))
}

/// A name as Markdown shows code.
pub(crate) fn code(name: &str) -> String {
    format!("`{name}`")
}

/// A table with a line for each set and a column for each method.
fn overview(bench: &Benchmark, cell: impl Fn(&MeasuredSet, &MeasuredMethod) -> String) -> Table {
    let methods = bench.sets.first().into_iter().flat_map(|c| &c.rows);
    let cells = |set: &MeasuredSet| {
        let cells = set.rows.iter().map(|row| cell(set, row));
        std::iter::once(set.name.clone()).chain(cells).collect()
    };
    Table::new(
        std::iter::once(Column::left("rays"))
            .chain(methods.map(|row| Column::right(code(row.method)))),
        bench.sets.iter().map(cells),
    )
}

/// Wrong answers and the 99th percentile of the error in ulp, set by set.
pub fn error_overview(bench: &Benchmark) -> Table {
    overview(bench, |set, row| {
        let errors = &row.errors;
        let p99 = match errors.judged {
            0 => "–".to_owned(),
            _ => brief(errors.ulp.p99),
        };
        match errors.wrong.total() {
            0 => p99,
            wrong => format!("**{}**, {p99}", percent(wrong, set.census.rays)),
        }
    })
}

/// The median time of one solve in ns, and how many times that of `textbook` it is.
fn time_overview(bench: &Benchmark, way: fn(&Times) -> (Nanoseconds, f64)) -> Table {
    overview(bench, |_, row| {
        let (ns, ratio) = way(&row.times);
        format!("{} ({ratio:.2})", brief(ns.median))
    })
}

/// The errors of one set for Markdown.
pub fn error_table(set: &MeasuredSet) -> Table {
    let faults = Fault::ALL.map(|fault| {
        let of = set.census.denominator(fault);
        Column::right(format!("{} of {of}", fault.name()))
    });
    let ulp = ["p50 ulp", "p99", "p99.9", "largest"].map(Column::right);
    let columns = std::iter::once(Column::left("method"));
    let cells = |row: &MeasuredMethod| {
        let method = std::iter::once(code(row.method));
        method.chain(error_cells(&row.errors)).collect()
    };
    Table::new(columns.chain(faults).chain(ulp), set.rows.iter().map(cells))
}

fn time_table(set: &MeasuredSet) -> Table {
    let ways_in_words = ["ns one by one", "ns in arrays", "latency ns"];
    let names = ways_in_words.map(|way| [way, "min", "iqr", "× textbook"].map(Column::right));
    let columns = std::iter::once(Column::left("method"))
        .chain(names.into_iter().flatten())
        .chain([Column::left("Pareto")]);
    let cells = |row: &MeasuredMethod| {
        let ways = ways(&row.times).into_iter().flat_map(|(ns, ratio)| {
            let [median, min, iqr] = [ns.median, ns.min, ns.iqr].map(|ns| format!("{ns:.1}"));
            [median, min, iqr, format!("{ratio:.2}")]
        });
        let pareto = if row.pareto { "yes" } else { "" };
        std::iter::once(code(row.method))
            .chain(ways)
            .chain([pareto.to_owned()])
            .collect()
    };
    Table::new(columns, set.rows.iter().map(cells))
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
