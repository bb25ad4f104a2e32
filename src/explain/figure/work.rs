//! Error against run time in characters: a chart of the methods, and a table under it.
//!
//! ```text
//! ns                p99 of the error in ulp →
//!   8┤   e 0 %                     k 12 %
//!   4┤   d 0 %        h 0 %     c 12 %
//!   2┤                          t 12 %
//!    └┬─────────┬─────────┬─────────┬────────
//!     0.5       2^4       2^9       2^14
//!    method    wrong %  p99 ulp     ns
//! *t textbook     12     5224      2.4
//! ```

use super::canvas::{Canvas, Dash, Dot, FigureInk};
use crate::explain::{Line, Role};
use crate::lab::bench::text::{brief, settled_by, wrong_by_kind};
use crate::lab::bench::{MeasuredMethod, MeasuredSet};
use crate::lab::chart::{ChartAxes, Scale, WorkPoint, best, work_points};
use crate::lab::timing::Times;
use crate::text::Glyphs;

/// The lowest chart that says more than its table.
const LEAST_ROWS: usize = 7;

/// A chart of so many rows can spare some for what else is worth knowing.
const AMPLE_ROWS: usize = 16;

/// The chart and the table of one picture, in `cols` × `rows` characters; the table may be longer.
pub fn work(set: &MeasuredSet, cols: usize, rows: usize, glyphs: Glyphs) -> Vec<Line> {
    let mut table = table(set, cols);
    if rows > table.len() + AMPLE_ROWS {
        table.extend(stages(set, cols));
        let legend = "wrong %: hit-or-miss/count, + some that are no number";
        if legend.len() <= cols {
            table.push(Line::of(Role::Faint, legend));
        }
    }
    let room = rows.saturating_sub(table.len());
    if room < LEAST_ROWS || cols < 24 {
        return table;
    }
    let mut lines = chart(set, cols, room, glyphs);
    lines.extend(table);
    lines
}

/// The letter that stands for a method in the chart: its first, or the first that no other has.
fn letter(method: &str) -> char {
    match method {
        "contracted" => 'o',
        _ => method.chars().next().unwrap_or('?'),
    }
}

/// The rates of wrong hits or misses and of wrong counts, with a + where there are answers that are no number;
/// one where all are right. In seven characters at most.
fn wrong_rates(wrong: [usize; 3], rays: usize) -> String {
    let [hit_or_miss, count, none] = wrong;
    if wrong == [0; 3] {
        return "0".into();
    }
    let more = if none > 0 { "+" } else { "" };
    let [h, c] = [hit_or_miss, count].map(|wrong| wrong_rate(wrong, rays));
    let text = format!("{h}/{c}{more}");
    if text.len() <= 7 {
        return text;
    }
    let [h, c] = [hit_or_miss, count].map(|wrong| 100 * wrong / rays.max(1));
    format!("{h}/{c}{more}")
}

/// Wrong answers in per cent, in few characters, none of them a rounded 0 or 100.
fn wrong_rate(wrong: usize, rays: usize) -> String {
    let percent = 100.0 * wrong as f64 / rays.max(1) as f64;
    if wrong == 0 {
        "0".into()
    } else if percent < 0.095 {
        "<.1".into()
    } else if wrong < rays && percent > 99.45 {
        ">99".into()
    } else if percent < 9.95 {
        format!("{percent:.1}")
    } else {
        format!("{percent:.0}")
    }
}

/// The 99th percentile; a dash where no answer was right.
fn p99(row: &MeasuredMethod) -> String {
    if row.errors.judged == 0 {
        "–".into()
    } else {
        brief(row.errors.ulp.p99)
    }
}

/// A time of a method; a dash where it was not timed.
fn of_times(row: &MeasuredMethod, time: fn(&Times) -> f64) -> String {
    row.times
        .as_ref()
        .map_or_else(|| "–".into(), |times| brief(time(times)))
}

/// A column of the table: its heading, its width with the blank before it, what it says.
struct PanelColumn {
    heading: &'static str,
    width: usize,
    cell: fn(&MeasuredMethod) -> String,
}

/// The most useful first.
const COLUMNS: [PanelColumn; 7] = [
    PanelColumn {
        heading: "p99 ulp",
        width: 8,
        cell: p99,
    },
    PanelColumn {
        heading: "ns",
        width: 6,
        cell: |row| of_times(row, |times| times.unseen.ns.median),
    },
    PanelColumn {
        heading: "ratio",
        width: 6,
        cell: |row| of_times(row, |times| times.unseen.ratio),
    },
    PanelColumn {
        heading: "arrays",
        width: 7,
        cell: |row| of_times(row, |times| times.batch.ns.median),
    },
    PanelColumn {
        heading: "latency",
        width: 8,
        cell: |row| of_times(row, |times| times.latency.ns.median),
    },
    PanelColumn {
        heading: "p50",
        width: 7,
        cell: |row| brief(row.errors.ulp.p50),
    },
    PanelColumn {
        heading: "largest",
        width: 8,
        cell: |row| brief(row.errors.ulp.max),
    },
];

/// Mark, letter, name and the rate of wrong answers, then as many columns as there is room for.
fn table(set: &MeasuredSet, cols: usize) -> Vec<Line> {
    const FIRST: usize = 20;
    let mut left = cols.saturating_sub(FIRST);
    let columns: Vec<&PanelColumn> = COLUMNS
        .iter()
        .take_while(|column| {
            let fits = column.width <= left;
            left = left.saturating_sub(column.width);
            fits
        })
        .collect();
    let all = |cell: &dyn Fn(&PanelColumn) -> String| {
        let cells = columns.iter().map(|c| (cell(c), c.width));
        cells.fold(String::new(), |line, (cell, width)| {
            format!("{line}{cell:>width$}")
        })
    };
    let headings = all(&|column| column.heading.into());
    let heading = format!("   {:10}{:>7}{headings}", "method", "wrong %");
    let mut lines = vec![Line::of(Role::Faint, heading)];
    for row in &set.rows {
        let mark = row.pareto.mark();
        let wrong = wrong_by_kind(&row.errors.wrong).map(|(count, _)| count);
        let rate = wrong_rates(wrong, set.census.rays);
        let role = if rate == "0" {
            Role::Value
        } else {
            Role::Warning
        };
        let numbers = all(&|column| (column.cell)(row));
        let line = Line::new(0)
            .with(Role::Plain, mark)
            .with(Role::Label, letter(row.method))
            .with(Role::Plain, format!(" {:10}", row.method))
            .with(role, format!("{rate:>7}"))
            .with(Role::Value, numbers);
        lines.push(line);
    }
    lines
}

/// Which stages of `exact` settled how many of the questions.
fn stages(set: &MeasuredSet, cols: usize) -> Vec<Line> {
    let settled = set.rows.iter().filter_map(settled_by);
    let lines = settled.flat_map(|text| Line::wrapped(&text, cols, Role::Faint, 0));
    lines.collect()
}

/// The scales of the chart: log₂ of the error in ulp, log₂ of nanoseconds.
fn scales(points: &[WorkPoint]) -> [Scale; 2] {
    let reach = |values: &mut dyn Iterator<Item = f64>| {
        values.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], v| {
            [least.min(v), most.max(v)]
        })
    };
    let [left, right] = reach(&mut points.iter().filter_map(|p| p.error));
    let [bottom, top] = reach(&mut points.iter().map(|p| p.time));
    // One picture looks much like the next if the scale changes in steps.
    let [left, right] = [left.min(-1.0), right].map(f64::ceil);
    [
        Scale::new(left - 1.0, right.max(9.0)),
        Scale::new(bottom.floor(), top.ceil().max(bottom.floor() + 2.0)),
    ]
}

/// The columns that the rightmost point leaves for its label.
const LABEL_ROOM: usize = 9;

/// The sheet of the chart, and where its axes cross.
struct CharacterChart {
    canvas: Canvas,
    x: Scale,
    y: Scale,
    /// First column and number of columns, last row of the points: row 0 has the title.
    left: usize,
    cols: usize,
    bottom: usize,
}

impl CharacterChart {
    /// The dot of a method; where there is no error to tell, at the right edge.
    fn place(&self, point: &WorkPoint) -> Dot {
        let across = point.error.map_or(1.0, |error| self.x.part(error));
        self.at(across, self.y.part(point.time))
    }

    /// The dot at these parts of the way to the right and up.
    fn at(&self, across: f64, up: f64) -> Dot {
        let columns = self.cols - LABEL_ROOM;
        let (width, height) = ((columns * 2 - 1) as f64, (self.bottom * 4 - 1) as f64);
        (
            (self.left * 2) as f64 + 0.5 + across * width,
            4.0 + (1.0 - up) * height,
        )
    }
}

fn chart(set: &MeasuredSet, cols: usize, rows: usize, glyphs: Glyphs) -> Vec<Line> {
    let left = 5;
    let points = work_points(set, ChartAxes::default());
    let [x, y] = scales(&points);
    let mut chart = CharacterChart {
        canvas: Canvas::new(cols, rows, glyphs),
        x,
        y,
        left,
        cols: cols - left,
        bottom: rows - 3,
    };
    chart.axes(rows);
    chart.pareto_line(&points);
    chart.points(&points, set.census.rays);
    chart.canvas.lines()
}

impl CharacterChart {
    fn axes(&mut self, rows: usize) {
        self.frame(rows - 2);
        self.times();
        self.errors(rows - 2);
    }

    /// The title, and the lines of the axes.
    fn frame(&mut self, foot: usize) {
        let (left, canvas) = (self.left, &mut self.canvas);
        let title = "99 % of the errors, in ulp →";
        let start = left + self.cols - title.chars().count().min(self.cols);
        canvas.write(left - 3, 0, "ns", FigureInk::Note);
        canvas.write(start, 0, title, FigureInk::Note);
        let [line, up, corner] = match canvas.glyphs() {
            Glyphs::Unicode => ['─', '│', '└'],
            Glyphs::Ascii => ['-', '|', '+'],
        };
        for row in 1..foot {
            canvas.put(left - 1, row, up, FigureInk::Axis);
        }
        for col in left..left + self.cols {
            canvas.put(col, foot, line, FigureInk::Axis);
        }
        canvas.put(left - 1, foot, corner, FigureInk::Axis);
    }

    /// The powers of two at the left, a line apart at least.
    fn times(&mut self) {
        let tick = self.tick('┤');
        let mut last = usize::MAX;
        for log in self.y.first as i32..=self.y.last as i32 {
            let dot = self.at(0.0, self.y.part(f64::from(log)));
            let Some((_, row)) = self.canvas.cell_of(dot) else {
                continue;
            };
            if last.abs_diff(row) < 2 {
                continue;
            }
            last = row;
            let label = brief_power(log);
            let at = (self.left - 1).saturating_sub(label.chars().count());
            self.canvas.write(at, row, &label, FigureInk::Note);
            self.canvas.put(self.left - 1, row, tick, FigureInk::Axis);
        }
    }

    /// The powers of two below.
    fn errors(&mut self, foot: usize) {
        let tick = self.tick('┬');
        let [first, end] = [self.x.first, self.x.last].map(|x| x as i32);
        // So many columns at least from one number to the next.
        let fits = |step: &i32| (end - first) * 8 <= step * self.cols as i32;
        let step = [2, 5, 10].into_iter().find(fits).unwrap_or(20);
        for log in (-1..=end).step_by(step as usize) {
            let dot = self.at(self.x.part(f64::from(log)), 0.0);
            let Some((col, _)) = self.canvas.cell_of(dot) else {
                continue;
            };
            let label = if log == -1 {
                "0.5".into()
            } else {
                format!("2^{log}")
            };
            let label = self.canvas.glyphs().spell(&label);
            let width = label.chars().count();
            if col + width <= self.left + self.cols {
                self.canvas.put(col, foot, tick, FigureInk::Axis);
                self.canvas.write(col, foot + 1, &label, FigureInk::Note);
            }
        }
    }

    fn tick(&self, unicode: char) -> char {
        match self.canvas.glyphs() {
            Glyphs::Unicode => unicode,
            Glyphs::Ascii => '+',
        }
    }

    fn pareto_line(&mut self, points: &[WorkPoint]) {
        let line: Vec<Dot> = best(points).iter().map(|p| self.place(p)).collect();
        for pair in line.windows(2) {
            self.canvas
                .line(pair[0], pair[1], FigureInk::Pareto, Dash::DOTTED);
        }
    }

    /// Letters first, so that no label hides one; methods in one cell share a label.
    fn points(&mut self, points: &[WorkPoint], rays: usize) {
        let mut groups: Vec<((usize, usize), Vec<&WorkPoint>)> = Vec::new();
        for point in points {
            let Some(cell) = self.canvas.cell_of(self.place(point)) else {
                continue;
            };
            match groups.iter_mut().find(|(at, _)| *at == cell) {
                Some((_, group)) => group.push(point),
                None => groups.push((cell, vec![point])),
            }
        }
        for ((col, line), group) in &groups {
            let letter = letter(group[0].method);
            self.canvas.put(*col, *line, letter, FigureInk::Root);
        }
        for (cell, group) in &groups {
            let label = label(group, rays);
            if !self.canvas.label_beside(*cell, &label, FigureInk::Note) {
                self.canvas.label(*cell, &label, FigureInk::Note, true);
            }
        }
    }
}

/// The letters beside the first, and the rates of wrong answers.
fn label(group: &[&WorkPoint], rays: usize) -> String {
    let mut rates: Vec<String> = group.iter().map(|p| wrong_rates(p.wrong, rays)).collect();
    rates.dedup();
    let others: String = group[1..].iter().map(|p| letter(p.method)).collect();
    let rates = rates.join(", ") + " %";
    if others.is_empty() {
        rates
    } else {
        format!("{others} {rates}")
    }
}

/// 2^k as a number while that is short.
fn brief_power(k: i32) -> String {
    match k {
        0..=12 => (1 << k).to_string(),
        -1 => ".5".into(),
        -2 => ".25".into(),
        _ => format!("2^{k}"),
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::lab::bench::Pareto;
    use crate::lab::timing::{TimedRun, Timing};
    use crate::lab::{Census, Errors, FaultCounts, Percentiles};
    use crate::method::Method;

    /// A row with this p99, time in ns and number of wrong answers of 1000.
    fn row(method: Method, p99: f64, ns: f64, wrong: usize) -> MeasuredMethod {
        let mut row = MeasuredMethod {
            method: method.name(),
            errors: Errors {
                wrong: FaultCounts {
                    false_miss: wrong,
                    ..FaultCounts::default()
                },
                ulp: Percentiles {
                    p99,
                    ..Percentiles::default()
                },
                judged: 1000 - wrong,
                ..Errors::default()
            },
            second: crate::lab::SecondRays::default(),
            times: None,
            stages: None,
            pareto: if wrong == 0 {
                Pareto::Best
            } else {
                Pareto::Beaten
            },
        };
        let unseen = Timing::of(vec![ns; 4], &[ns; 4]);
        row.times = Some(Times {
            unseen,
            ..Times::default()
        });
        row
    }

    fn set(rows: Vec<MeasuredMethod>) -> MeasuredSet {
        MeasuredSet {
            name: "test".into(),
            about: String::new(),
            census: Census {
                rays: 1000,
                ..Census::default()
            },
            kind: "test".into(),
            timed: 1000,
            unseen: 1000,
            run: TimedRun::default(),
            rows,
        }
    }

    fn text(lines: &[Line]) -> Vec<String> {
        lines.iter().map(Line::text).collect()
    }

    /// Where the letter of a method stands in the chart.
    fn place(lines: &[String], letter: char) -> (usize, usize) {
        let chart = lines.iter().take_while(|line| !line.contains("method"));
        let found = chart.skip(1).enumerate().find_map(|(y, line)| {
            let x = line.chars().skip(6).position(|c| c == letter)?;
            Some((x, y))
        });
        found.unwrap_or_else(|| panic!("no {letter} in {lines:#?}"))
    }

    #[test]
    fn worse_is_to_the_right_and_slower_is_higher() {
        let rows = vec![
            row(Method::Textbook, 1000.0, 2.0, 120),
            row(Method::Haines, 2.0, 8.0, 3),
            row(Method::Exact, 0.5, 16.0, 0),
        ];
        let mut rows_in_order = rows.clone();
        rows_in_order.push(row(Method::Double, 0.5, 4.0, 1000));
        let lines = text(&work(&set(rows_in_order), 60, 24, Glyphs::Unicode));
        let [t, h, e, d] = ['t', 'h', 'e', 'd'].map(|letter| place(&lines, letter));
        assert!(e.0 < h.0 && h.0 < t.0, "{lines:#?}");
        assert!(e.1 < h.1 && h.1 < t.1, "{lines:#?}");
        // A method without a right answer comes last.
        assert!(t.0 <= d.0, "{lines:#?}");
        let whole = lines.join("\n");
        for words in ["t 12/0 %", "h 0.3/0 %", "e 0 %", "d 100/0 %", "*e exact"] {
            assert!(whole.contains(words), "no {words} in {lines:#?}");
        }
    }

    #[test]
    fn methods_in_one_place_share_it() {
        let rows = vec![
            row(Method::Textbook, 40.0, 4.0, 120),
            row(Method::Citardauq, 40.0, 4.01, 120),
            row(Method::Exact, 0.5, 4.0, 0),
        ];
        let whole = text(&work(&set(rows), 60, 24, Glyphs::Unicode)).join("\n");
        assert!(whole.contains("t c 12/0 %"), "{whole}");
    }

    fn any_value() -> impl Strategy<Value = f64> {
        prop_oneof![
            0.0..1e9,
            any::<f64>().prop_map(f64::abs),
            Just(0.0),
            Just(f64::INFINITY)
        ]
    }

    proptest! {
        #[test]
        fn any_chart_keeps_to_its_room(
            values in prop::collection::vec((any_value(), any_value(), 0_usize..=1000), 0..9),
            cols in 0_usize..140,
            rows in 0_usize..50,
            ascii in any::<bool>(),
        ) {
            let methods = Method::ALL.into_iter().zip(values);
            let made = methods.map(|(m, (p99, ns, wrong))| row(m, p99, ns, wrong)).collect();
            let glyphs = if ascii { Glyphs::Ascii } else { Glyphs::Unicode };
            let lines = work(&set(made), cols, rows, glyphs);
            for line in &lines[..lines.len().saturating_sub(10)] {
                prop_assert!(line.width() <= cols);
                prop_assert!(!ascii || line.text().is_ascii());
            }
        }
    }
}
