//! Charts as numbers: what lies where. `lab::plot` draws them as SVG, `explain::figure` in characters.

use super::bench::text::wrong_by_kind;
use super::bench::{MeasuredMethod, MeasuredSet, Pareto};
use super::stress::Sweep;
use super::timing::{Times, Timing};

/// The values at the two ends of an axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scale {
    /// At the left or at the bottom.
    pub first: f64,
    /// At the right or at the top.
    pub last: f64,
}

impl Scale {
    /// From one value to another.
    pub const fn new(first: f64, last: f64) -> Self {
        Self { first, last }
    }

    /// How much of the way a value lies from the first to the last, from 0 to 1.
    pub fn part(self, value: f64) -> f64 {
        ((value - self.first) / (self.last - self.first)).clamp(0.0, 1.0)
    }

    /// Whether a value lies within, up to rounding.
    pub fn contains(self, value: f64) -> bool {
        const MARGIN: f64 = 1e-9;
        (self.first - MARGIN..=self.last + MARGIN).contains(&value)
    }
}

/// The bits of a binary32: the most that can be lost.
pub const BITS: Scale = Scale::new(0.0, 24.0);

/// Which error a work–precision chart has along it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ErrorAxis {
    /// The median.
    P50,
    /// The 99th percentile.
    #[default]
    P99,
    /// The largest found.
    Largest,
    /// The share of wrong answers of any kind.
    Wrong,
}

impl ErrorAxis {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::P50, Self::P99, Self::Largest, Self::Wrong];

    /// The name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::P50 => "p50",
            Self::P99 => "p99",
            Self::Largest => "largest",
            Self::Wrong => "wrong",
        }
    }

    /// What is written at the axis.
    pub const fn title(self) -> &'static str {
        match self {
            Self::P50 => "half of the errors are below, ulp",
            Self::P99 => "99 % of the errors are below, ulp",
            Self::Largest => "largest error found, ulp",
            Self::Wrong => "wrong answers of any kind, %",
        }
    }
}

/// Which time it has up the other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum TimeAxis {
    /// One call after the other, rays not seen before.
    #[default]
    Single,
    /// In arrays.
    Array,
    /// In a chain: each waits for the last.
    Latency,
}

impl TimeAxis {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Single, Self::Array, Self::Latency];

    /// The name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Single => "single",
            Self::Array => "array",
            Self::Latency => "latency",
        }
    }

    /// What is written at the axis.
    pub const fn title(self) -> &'static str {
        match self {
            Self::Single => "ns a solve, unseen rays",
            Self::Array => "ns a solve, in arrays",
            Self::Latency => "ns a solve, in a chain",
        }
    }

    const fn of(self, times: &Times) -> &Timing {
        match self {
            Self::Single => &times.unseen,
            Self::Array => &times.batch,
            Self::Latency => &times.latency,
        }
    }
}

/// The two axes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct ChartAxes {
    /// Along.
    pub x: ErrorAxis,
    /// Up.
    pub y: TimeAxis,
}

/// A method where error lies along run time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WorkPoint {
    /// The name of the method.
    pub method: &'static str,
    /// log₂ of the error in ulp, or the wrong answers in per cent; none where no answer is right.
    pub error: Option<f64>,
    /// log₂ of the median time of one solve in nanoseconds.
    pub time: f64,
    /// log₂ of the first quartile and of the third.
    pub spread: [f64; 2],
    /// How many answers have a wrong hit or miss, a wrong count, or are no number.
    pub wrong: [usize; 3],
    /// Whether no other method beats it in what is charted first, p99 and unseen rays.
    pub is_best: bool,
}

/// The methods of a set that were timed, in the order of the report.
pub fn work_points(set: &MeasuredSet, axes: ChartAxes) -> Vec<WorkPoint> {
    // Errors below an eighth of an ulp look like none, and there are no times of a thousand seconds.
    let log_error = |ulps: f64| ulps.log2().clamp(-3.0, 120.0);
    let log_time = |ns: f64| ns.log2().clamp(-3.0, 40.0);
    let point = |row: &MeasuredMethod| {
        let timing = axes.y.of(row.times.as_ref()?);
        let wrong = wrong_by_kind(&row.errors.wrong).map(|(count, _)| count);
        let ulp = &row.errors.ulp;
        let ulps = match axes.x {
            ErrorAxis::P50 => ulp.p50,
            ErrorAxis::P99 => ulp.p99,
            ErrorAxis::Largest => ulp.max,
            ErrorAxis::Wrong => 0.0,
        };
        let error = match axes.x {
            ErrorAxis::Wrong => {
                let all = set.census.rays.max(1) as f64;
                Some(100.0 * wrong.iter().sum::<usize>() as f64 / all)
            }
            _ => (row.errors.judged > 0).then(|| log_error(ulps)),
        };
        Some(WorkPoint {
            method: row.method,
            error,
            time: log_time(timing.ns.median),
            spread: timing.range.map(log_time),
            wrong,
            is_best: row.pareto == Pareto::Best && axes == ChartAxes::default(),
        })
    };
    set.rows.iter().filter_map(point).collect()
}

/// The methods that no other beats, from the least error on: the Pareto line.
pub fn best(points: &[WorkPoint]) -> Vec<WorkPoint> {
    let best = points.iter().filter(|p| p.is_best && p.error.is_some());
    let mut best: Vec<WorkPoint> = best.copied().collect();
    let key = |p: &WorkPoint| (p.error.unwrap_or_default(), p.time);
    best.sort_by(|a, b| {
        let ((error, time), (other_error, other_time)) = (key(a), key(b));
        error
            .total_cmp(&other_error)
            .then(time.total_cmp(&other_time))
    });
    best
}

/// A method at one setting of a dial.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DialPoint {
    /// The dial is turned by 2^k.
    pub k: i32,
    /// The share of answers that are wrong, 0 to 1.
    pub wrong: f64,
    /// The bits lost, 0 to 24; none where no answer has an error to tell.
    pub bits: Option<f64>,
}

/// The method with that place in the report along a dial; its bits are the worst.
pub fn dial_points(sweep: &Sweep, method: usize) -> Vec<DialPoint> {
    let point = |step: &super::stress::DialSetting| {
        let cell = &step.cells[method];
        DialPoint {
            k: step.k,
            wrong: cell.errors.wrong.total() as f64 / step.census.rays.max(1) as f64,
            bits: cell.bits_worst(),
        }
    };
    sweep.steps.iter().map(point).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scale_holds_what_lies_beyond_its_ends() {
        let scale = Scale::new(-2.0, 6.0);
        assert_eq!(
            [-9.0, -2.0, 0.0, 6.0, 7.0].map(|x| scale.part(x)),
            [0.0, 0.0, 0.25, 1.0, 1.0]
        );
        assert!(scale.contains(6.0) && !scale.contains(6.1));
    }

    #[test]
    fn the_pareto_line_leads_through_the_best_from_the_least_error_on() {
        let point = |method, error, time, is_best| WorkPoint {
            method,
            error,
            time,
            spread: [time; 2],
            wrong: [0; 3],
            is_best,
        };
        let points = [
            point("quick", Some(9.0), 1.0, true),
            point("beaten", Some(9.0), 3.0, false),
            point("right", Some(-1.0), 4.0, true),
            point("quicker", Some(9.0), 0.5, true),
            point("never right", None, 0.1, true),
        ];
        let names: Vec<&str> = best(&points).iter().map(|p| p.method).collect();
        assert_eq!(names, ["right", "quicker", "quick"]);
    }
}
