//! A benchmark for people: as text of 80 columns, and the same in Markdown.

use super::{Benchmark, MeasuredMethod, MeasuredSet, Pareto, answer};
use crate::lab::errors::{Census, Errors, Fault, FaultCounts, Worst};
use crate::lab::machine::Machine;
use crate::lab::numbers;
use crate::lab::second::{Clearance, SecondRays};
use crate::lab::timing::{Times, Timing};
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

/// The report as text; `worst` adds the inputs of the largest errors. The answer comes last, where a terminal
/// shows it.
pub fn text(
    bench: &Benchmark,
    machine: &Machine,
    worst: bool,
    against: Option<&[String]>,
) -> Report {
    let start = Report::new().lines(header(bench, machine));
    let sets = bench.sets.iter();
    let report = sets
        .fold(start, |report, set| report.gap().then(section(set, worst)))
        .gap()
        .lines(footer(bench));
    let report = match against {
        None => report,
        Some(differences) => report
            .gap()
            .heading("against the earlier report")
            .lines(differences.iter().map(|line| format!("  {line}"))),
    };
    report.gap().then(answer(bench))
}

/// For each kind of rays which method is right and what it costs.
fn answer(bench: &Benchmark) -> Report {
    if bench.sets.is_empty() {
        return Report::new();
    }
    let heading = match bench.complaints() {
        none if none.is_empty() => {
            "which method, for which rays; ns for a ray not seen before".to_owned()
        }
        _ => "which method, for which rays; TIMES NOT TRUSTED (see above)".to_owned(),
    };
    Report::new()
        .heading(heading)
        .table(answer::table(bench).indented(2))
        .lines(answer::LEGEND.map(|line| format!("  {line}")))
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
        .table(second(set))
        .table(times(set))
        .lines(settled.map(|text| format!("  {text}")))
        .lines(largest)
}

fn errors(set: &MeasuredSet) -> Table {
    let rows: Vec<_> = set
        .rows
        .iter()
        .map(|row| (row.pareto.mark(), row.method, &row.errors))
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

/// What the hits of each method are as points, and as starts of second rays, in parts of the radius.
fn second(set: &MeasuredSet) -> Table {
    let names = [
        "p99", "largest", "p99", "hits", "t-min", "missed", "along n", "missed",
    ];
    let cells = |row: &MeasuredMethod| {
        std::iter::once(row.method.to_owned())
            .chain(second_cells(&row.second))
            .collect()
    };
    Table::new(
        std::iter::once(Column::left("parts of r")).chain(names.map(Column::right)),
        set.rows.iter().map(cells),
    )
    .grouped(&[
        ("errors in", 1),
        ("point p", 2),
        ("normal", 1),
        ("self-", 1),
        ("clear of them by, and", 4),
    ])
    .indented(2)
}

/// The errors of point and normal, self-hits of all hits, what clears them and what that misses; blank where the
/// method has no hit.
fn second_cells(second: &SecondRays) -> Vec<String> {
    if second.hits == 0 {
        return vec!["–".to_owned(); 8];
    }
    let clearance = |clearance: &Clearance| {
        let epsilon = clearance.of_radius.map_or("> r".to_owned(), brief);
        [
            epsilon,
            percent(clearance.missed, second.hits).replace(' ', ""),
        ]
    };
    let point = &second.point_of_radius;
    let start = [point.p99, point.max, second.normal_of_radius.p99].map(brief);
    start
        .into_iter()
        .chain([percent(second.self_hits, second.hits).replace(' ', "")])
        .chain(clearance(&second.t_min))
        .chain(clearance(&second.along_normal))
        .collect()
}

/// The ways in which a row was timed.
fn ways(times: &Times) -> [&Timing; 4] {
    let Times {
        unseen,
        learned,
        batch,
        latency,
    } = times;
    [unseen, learned, batch, latency]
}

/// A ratio to `textbook`, or that the two are not told apart.
fn ratio(timing: &Timing, first: &Timing, alike: &str, told: impl Fn(f64) -> String) -> String {
    if timing == first || timing.is_told_apart_from(first) {
        told(timing.ratio)
    } else {
        alike.to_owned()
    }
}

fn times(set: &MeasuredSet) -> Table {
    let full = ["med.", "min", "iqr", "×tb"];
    let names = full.into_iter().chain(["med.", "×tb"].repeat(3));
    let short = |ratio: f64| match brief(ratio) {
        long if long.len() > 4 => format!("{ratio:.0}"),
        ratio => ratio,
    };
    let first = set.run.times.first();
    let cells = |row: &MeasuredMethod| {
        let Some((times, first)) = row.times.as_ref().zip(first) else {
            return std::iter::once(row.method.to_owned())
                .chain(std::iter::repeat_n("–".to_owned(), 10))
                .collect();
        };
        let ways = ways(times).into_iter().zip(ways(first)).enumerate();
        let ways = ways.flat_map(|(i, (timing, first))| {
            let ns = timing.ns;
            let spread = if i == 0 {
                vec![brief(ns.min), brief(ns.iqr)]
            } else {
                Vec::new()
            };
            let ratio = ratio(timing, first, "≈1", short);
            std::iter::once(brief(ns.median))
                .chain(spread)
                .chain([ratio])
                .collect::<Vec<_>>()
        });
        std::iter::once(row.method.to_owned()).chain(ways).collect()
    };
    Table::new(
        std::iter::once(Column::left("a solve")).chain(names.map(Column::right)),
        set.rows.iter().map(cells),
    )
    .grouped(&[
        ("ns for", 1),
        ("one by one, unseen", 4),
        ("learned", 2),
        ("arrays", 2),
        ("in a chain", 2),
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
    out.push("~ one as good in wrong answers and p99 is not told apart in time".into());
    out.push(
        "×tb: times textbook in the same rounds, the median; ≈1: not told apart from it".into(),
    );
    out.push(
        "self-hits: second rays that start at the computed point, away from the sphere, and meet \
         it; clear: the least that passes over them all, and the share of rays into the sphere \
         whose other side it passes over as well"
            .into(),
    );
    out.push(
        "unseen: each ray comes again only after all others; learned, arrays, in a chain \
         (each solve waits for the last): a few rays again and again, which processors learn"
            .into(),
    );
    out.extend(bench.self_checks.iter().map(|check| {
        let said = if check.passed { "passed" } else { "FAILED" };
        format!(
            "self-check {said}: {}, {:.3} (from {} to {})",
            check.name, check.ratio, check.least, check.most
        )
    }));
    out.extend(verdict(bench));
    out
}

/// Whether the times are to be trusted, and why not.
fn verdict(bench: &Benchmark) -> impl Iterator<Item = String> {
    let verdict = format!("times_trusted: {}", bench.times_trusted());
    let complaints = bench.complaints().into_iter();
    std::iter::once(verdict).chain(complaints.map(|why| format!("  not trusted: {why}")))
}

/// The report in Markdown: what to use, and overviews of times and errors; for each set a table of errors, which are the
/// same everywhere, and one of times, which are not.
pub fn markdown(bench: &Benchmark, machine: &Machine, against: Option<&[String]>) -> Report {
    let start = Report::new()
        .fixed(header(bench, machine).into_iter().chain(verdict(bench)).collect())
        .table(answer::table(bench))
        .items(answer::LEGEND.map(str::to_owned).into())
        .words(
            "Median nanoseconds for one solve; in brackets how many times that of `textbook`, the median over the \
             rounds, ≈ where the two are not told apart. One by one, rays not seen before:",
        )
        .table(time_overview(bench, |times| ways(times)[0]))
        .words("One by one, a few rays again and again, which the processor learns:")
        .table(time_overview(bench, |times| ways(times)[1]))
        .words("In arrays, a few rays again and again:")
        .table(time_overview(bench, |times| ways(times)[2]))
        .words("Wrong answers, and the 99th percentile of the error in ulp:")
        .table(error_overview(bench));
    let sets = bench.sets.iter();
    sets.fold(start, |report, set| {
        report
            .heading(&set.name)
            .words(&set.about)
            .table(error_table(set))
            .table(second_table(set))
            .table(time_table(set))
            .items(set.rows.iter().filter_map(largest_input).collect())
    })
    .items(against.unwrap_or_default().to_vec())
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

/// Wrong answers by what is wrong and the 99th percentile of the error in ulp, set by set.
pub fn error_overview(bench: &Benchmark) -> Table {
    overview(bench, |set, row| {
        let errors = &row.errors;
        let p99 = match errors.judged {
            0 => "–".to_owned(),
            _ => brief(errors.ulp.p99),
        };
        match wrong_in_words(&errors.wrong, set.census.rays) {
            Some(wrong) => format!("{wrong}, {p99}"),
            None => p99,
        }
    })
}

/// The shares of wrong answers for Markdown, each with its kind, if there are any.
pub(crate) fn wrong_in_words(wrong: &FaultCounts, rays: usize) -> Option<String> {
    let kinds = wrong_by_kind(wrong).into_iter();
    let parts: Vec<String> = kinds
        .filter(|(count, _)| *count > 0)
        .map(|(count, what)| format!("{} {what}", percent(count, rays)))
        .collect();
    (!parts.is_empty()).then(|| format!("**{}**", parts.join(" + ")))
}

/// How many answers have a wrong hit or miss, a wrong count, or are no number, with a word for each.
pub(crate) fn wrong_by_kind(wrong: &FaultCounts) -> [(usize, &'static str); 3] {
    [
        (wrong.hit_or_miss(), "hit-or-miss"),
        (wrong.wrong_count, "count"),
        (wrong.not_finite, "no number"),
    ]
}

/// The median time of one solve in ns, and how many times that of `textbook` it is.
fn time_overview(bench: &Benchmark, way: fn(&Times) -> &Timing) -> Table {
    overview(bench, |set, row| {
        let Some((times, first)) = row.times.as_ref().zip(set.run.times.first()) else {
            return "not timed".to_owned();
        };
        let timing = way(times);
        let told = |ratio: f64| format!("{ratio:.2}");
        let ratio = ratio(timing, way(first), "≈", told);
        format!("{} ({ratio})", brief(timing.ns.median))
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

/// The second rays of one set for Markdown.
pub fn second_table(set: &MeasuredSet) -> Table {
    let names = [
        "point p99, of r",
        "largest",
        "normal p99",
        "self-hits",
        "cleared by t-min, of r",
        "missed",
        "along the normal, of r",
        "missed",
    ];
    let cells = |row: &MeasuredMethod| {
        std::iter::once(code(row.method))
            .chain(second_cells(&row.second))
            .collect()
    };
    Table::new(
        std::iter::once(Column::left("method")).chain(names.map(Column::right)),
        set.rows.iter().map(cells),
    )
}

fn time_table(set: &MeasuredSet) -> Table {
    let ways_in_words = [
        "ns one by one, unseen",
        "learned",
        "in arrays",
        "in a chain",
    ];
    let names = ways_in_words.map(|way| [way, "min", "iqr", "× textbook"].map(Column::right));
    let columns = std::iter::once(Column::left("method"))
        .chain(names.into_iter().flatten())
        .chain([Column::left("Pareto")]);
    let cells = |row: &MeasuredMethod| {
        let cells = match row.times.as_ref().zip(set.run.times.first()) {
            None => vec!["–".to_owned(); 16],
            Some((times, first)) => {
                let ways = ways(times).into_iter().zip(ways(first));
                let ways = ways.flat_map(|(timing, first)| {
                    let ns = [timing.ns.median, timing.ns.min, timing.ns.iqr];
                    let [median, min, iqr] = ns.map(|ns| format!("{ns:.1}"));
                    let told = |ratio: f64| format!("{ratio:.2}");
                    [
                        median,
                        min,
                        iqr,
                        ratio(timing, first, "not told apart", told),
                    ]
                });
                ways.collect()
            }
        };
        let pareto = match row.pareto {
            Pareto::Best => "yes",
            Pareto::Open => "not told apart",
            Pareto::Beaten => "",
        };
        std::iter::once(code(row.method))
            .chain(cells)
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
