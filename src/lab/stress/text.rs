//! The stability sweeps for people: as text of 80 columns, and the same in Markdown.

use std::ops::Range;

use super::theory::{AGREEMENT, agree};
use super::{Check, DialSetting, MethodErrors, Stability, Sweep, bits_lost, invariance};
use crate::lab::bench::text::{code, wrong_in_words};
use crate::lab::numbers;
use crate::lab::second::Clearance;
use crate::method::Method;
use crate::report::{Column, Report, Table};
use crate::text::hexadecimal;

/// The sweeps as text: of each dial at most `ROWS` settings, the summary last.
pub fn text(stability: &Stability) -> Report {
    let start = Report::new().words(format!(
        "rayscope {} stress, seed {}, {} rays a setting, checksum of all answers {}",
        env!("CARGO_PKG_VERSION"),
        stability.seed,
        stability.rays,
        stability.checksum()
    ));
    let sweeps = stability.sweeps.iter();
    sweeps
        .fold(start, |report, sweep| {
            report.gap().then(section(stability, sweep))
        })
        .gap()
        .then(summary(stability))
        .then(checks(stability))
        .gap()
        .lines(promises(stability))
}

fn section(stability: &Stability, sweep: &Sweep) -> Report {
    Report::new()
        .heading(format!("{}: {}", sweep.dial.name, sweep.dial.about))
        .words("  wrong hit-or-miss/count(/no number) in per cent, bits lost: median/worst")
        .then(grids(stability, sweep, wrong_and_bits))
        .words("  blame err/(κu): median/worst")
        .then(grids(stability, sweep, blame))
        .words("  second ray, parts of r: point p99, clear of itself by t-min/along the normal")
        .then(grids(stability, sweep, second))
        .then(inputs(sweep))
}

/// The most methods that stand side by side in eighty columns.
const BESIDE: usize = 4;

/// As many tables as the methods need, with about as many methods each.
fn grids(stability: &Stability, sweep: &Sweep, show: fn(&MethodErrors, usize) -> String) -> Report {
    let methods = stability.methods.len();
    let each = methods.div_ceil(methods.div_ceil(BESIDE)).max(1);
    let tables = (0..methods)
        .step_by(each)
        .map(|first| grid(stability, sweep, first..methods.min(first + each), show));
    tables.fold(Report::new(), Report::table)
}

/// The most settings of a dial that a table shows.
const ROWS: usize = 16;

/// The settings that a table shows: the first, the last, and some between.
fn chosen(sweep: &Sweep) -> impl Iterator<Item = &DialSetting> {
    let stride = sweep.steps.len().div_ceil(ROWS).max(1);
    let last = sweep.steps.len().saturating_sub(1);
    sweep
        .steps
        .iter()
        .enumerate()
        .filter(move |&(i, _)| i % stride == 0 || i == last)
        .map(|(_, step)| step)
}

fn grid(
    stability: &Stability,
    sweep: &Sweep,
    which: Range<usize>,
    show: fn(&MethodErrors, usize) -> String,
) -> Table {
    let methods = stability.methods[which.clone()].iter();
    let methods = methods.map(|method| method.name());
    let names = std::iter::once(sweep.dial.quantity).chain(methods);
    let row = |step: &DialSetting| {
        let cells = step.cells[which.clone()].iter();
        let found = cells.map(|cell| show(cell, step.census.rays));
        std::iter::once(format!("2^{}", step.k))
            .chain(found)
            .collect()
    };
    Table::new(names.map(Column::right), chosen(sweep).map(row))
}

/// What rounding the inputs did, where the dial is about that.
fn inputs(sweep: &Sweep) -> Report {
    if !sweep.dial.rounds_inputs() {
        return Report::new();
    }
    let row = |step: &DialSetting| {
        let [changed, bits] = step.inputs.map_or([const { String::new() }; 2], |inputs| {
            let [median, worst] = [inputs.ulp.p50, inputs.ulp.max].map(bits_lost);
            [
                in_percent(inputs.changed, step.census.rays),
                format!("{median:.0}/{worst:.0}"),
            ]
        });
        vec![format!("2^{}", step.k), changed, bits]
    };
    Report::new()
        .lines([
            "  what rounding p0, d, c and r cost before any method was asked",
            "  hits or misses changed, bits lost: median/worst",
        ])
        .table(Table::new(
            [""; 3].map(Column::right),
            chosen(sweep).map(row),
        ))
}

fn wrong_and_bits(cell: &MethodErrors, rays: usize) -> String {
    let wrong = &cell.errors.wrong;
    let [hit_or_miss, count, none] =
        [wrong.hit_or_miss(), wrong.wrong_count, wrong.not_finite].map(|n| in_percent(n, rays));
    let wrong = match [wrong.total(), wrong.not_finite] {
        [0, _] => hit_or_miss,
        [_, 0] => format!("{hit_or_miss}/{count}"),
        _ => format!("{hit_or_miss}/{count}/{none}"),
    };
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

fn blame(cell: &MethodErrors, _: usize) -> String {
    if cell.errors.judged == 0 {
        return "-".into();
    }
    format!("{}/{}", tiny(cell.blame.p50), tiny(cell.blame.max))
}

/// How far the point is off, and what clears every self-hit of a ray that starts there.
fn second(cell: &MethodErrors, _: usize) -> String {
    let second = &cell.second;
    if second.hits == 0 {
        return "-".into();
    }
    let clear = |clearance: &Clearance| clearance.of_radius.map_or(">r".to_owned(), tiny);
    let point = tiny(second.point_of_radius.p99);
    format!(
        "{point} {}/{}",
        clear(&second.t_min),
        clear(&second.along_normal)
    )
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
fn summary(stability: &Stability) -> Report {
    let columns = ["dial", "quantity", "method"].map(Column::left);
    let of_event = || {
        [
            Column::right("found"),
            Column::right("theory"),
            Column::left("agree"),
        ]
    };
    let row = |place: Breakdowns| {
        let names = [place.dial, place.quantity, place.method].map(str::to_owned);
        let events = place.events.into_iter().flat_map(|event| {
            let agree = if event.agree { "yes" } else { "NO" };
            [event.found, event.theory, agree.to_owned()]
        });
        names.into_iter().chain(events).collect()
    };
    let table = Table::new(
        columns.into_iter().chain(of_event()).chain(of_event()),
        breakdowns(stability).map(row),
    );
    Report::new()
        .words(format!(
            "where each method breaks down; theory agrees within a factor of {AGREEMENT}"
        ))
        .table(
            table
                .grouped(&[
                    ("", 3),
                    ("first wrong answer", 3),
                    ("hit moved > ½ pixel", 3),
                ])
                .indented(2),
        )
}

/// A line of the summary.
struct Breakdowns {
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

fn breakdowns(stability: &Stability) -> impl Iterator<Item = Breakdowns> {
    stability.sweeps.iter().flat_map(move |sweep| {
        (0..stability.methods.len()).map(move |method| {
            let at = stability.breakdown(sweep, method);
            let event = |found: Option<i32>, theory: Option<f64>| Event {
                found: found.map_or("never".into(), |k| format!("2^{k}")),
                theory: theory.map_or("never".into(), |k| format!("2^{k:.1}")),
                agree: agree(found, theory, sweep.dial.step()),
            };
            Breakdowns {
                dial: sweep.dial.name,
                quantity: sweep.dial.quantity,
                method: stability.methods[method].name(),
                events: [
                    event(at.wrong, at.wrong_in_theory),
                    event(at.moved, at.moved_in_theory),
                ],
            }
        })
    })
}

fn checks(stability: &Stability) -> Report {
    if stability.checks.is_empty() {
        return Report::new();
    }
    // Eight methods beside the longest name leave five columns for each.
    let method = |method: &Method| Column::right(method.name().chars().take(4).collect::<String>());
    let verdict = |check: &Check| match check.failed {
        0 => "pass".into(),
        failed => failed.to_string(),
    };
    Report::new()
        .gap()
        .words("what must hold besides: pass, or on how many rays it fails")
        .table(
            Table::new(
                std::iter::once(Column::left("")).chain(stability.methods.iter().map(method)),
                invariance::NAMES.map(|name| checks_named(stability, name, verdict)),
            )
            .indented(2),
        )
}

/// The name of a check, and its verdict on each method.
fn checks_named(stability: &Stability, name: &str, verdict: fn(&Check) -> String) -> Vec<String> {
    let named = stability.checks.iter().filter(|check| check.name == name);
    std::iter::once(name.to_owned())
        .chain(named.map(verdict))
        .collect()
}

fn promises(stability: &Stability) -> Vec<String> {
    let mut out = Vec::new();
    for kept in &stability.kept {
        out.push(format!(
            "promise of {}: {} of {} answers broke it",
            kept.method, kept.broken, kept.asked
        ));
        out.extend(kept.first.as_ref().map(|problem| {
            let input = numbers(problem).map(hexadecimal).join(" ");
            format!("  the first: {input}")
        }));
    }
    if !stability.complete {
        out.push("Interrupted: what is above is complete, the rest was not measured.".into());
    }
    let said = if stability.promises_kept() {
        "kept"
    } else {
        "BROKEN"
    };
    out.push(format!("promises {said}"));
    out
}

/// The sweeps in Markdown: the summary, the checks, and a table for each dial.
pub fn markdown(stability: &Stability) -> Report {
    let start = Report::new()
        .words(format!(
            "seed {}, {} rays a setting",
            stability.seed, stability.rays
        ))
        .table(summary_table(stability))
        .table(check_table(stability));
    let sweeps = stability.sweeps.iter();
    sweeps
        .fold(start, |report, sweep| {
            report
                .heading(sweep.dial.name)
                .words(sweep.dial.about)
                .table(sweep_table(stability, sweep))
        })
        .fixed(promises(stability))
}

/// The summary for Markdown.
pub fn summary_table(stability: &Stability) -> Table {
    let of_event = |name| {
        [
            Column::right(name),
            Column::right("theory"),
            Column::left("agree"),
        ]
    };
    let row = |place: Breakdowns| {
        let names = [
            format!("{}, {}", place.dial, place.quantity),
            code(place.method),
        ];
        let events = place.events.into_iter().flat_map(|event| {
            let agree = if event.agree { "yes" } else { "**no**" };
            [event.found, event.theory, agree.to_owned()]
        });
        names.into_iter().chain(events).collect()
    };
    Table::new(
        ["dial", "method"]
            .map(Column::left)
            .into_iter()
            .chain(of_event("first wrong answer"))
            .chain(of_event("first hit moved > ½ pixel")),
        breakdowns(stability).map(row),
    )
}

/// The checks for Markdown.
pub fn check_table(stability: &Stability) -> Table {
    let verdict = |check: &Check| match check.failed {
        0 => "pass".to_owned(),
        failed => format!("fails {failed} of {}", check.rays),
    };
    Table::new(
        by_method(stability, Column::left("what must hold besides")),
        invariance::NAMES.map(|name| checks_named(stability, name, verdict)),
    )
}

/// The settings of one dial for Markdown: wrong answers in per cent, bits lost (median/worst), blame
/// (median/worst).
pub fn sweep_table(stability: &Stability, sweep: &Sweep) -> Table {
    let row = |step: &DialSetting| {
        let found = step
            .cells
            .iter()
            .map(|cell| in_words(cell, step.census.rays));
        std::iter::once(format!("2^{}", step.k))
            .chain(found)
            .collect()
    };
    Table::new(
        by_method(stability, Column::right(sweep.dial.quantity)),
        chosen(sweep).map(row),
    )
}

/// A first column, and one for each method.
fn by_method(stability: &Stability, first: Column) -> impl Iterator<Item = Column> {
    let methods = stability.methods.iter();
    std::iter::once(first).chain(methods.map(|method| Column::right(code(method.name()))))
}

fn in_words(cell: &MethodErrors, rays: usize) -> String {
    let bits = cell.bits_median().zip(cell.bits_worst());
    let bits = bits
        .map(|(median, worst)| format!("{median:.0}/{worst:.0} bits, blame {}", blame(cell, 0)));
    let parts = [wrong_in_words(&cell.errors.wrong, rays), bits];
    parts.into_iter().flatten().collect::<Vec<_>>().join(", ")
}
