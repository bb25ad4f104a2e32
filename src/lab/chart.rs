//! Charts as numbers: what lies where. `lab::plot` draws them as SVG, `explain::figure` in characters.

use super::bench::MeasuredSet;
use super::stress::Sweep;

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

/// A method where error lies along run time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WorkPoint {
    /// The name of the method.
    pub method: &'static str,
    /// log₂ of the 99th percentile of the error in ulp; none where no answer is right.
    pub error: Option<f64>,
    /// log₂ of the median time of one solve in nanoseconds.
    pub time: f64,
    /// How many answers are wrong.
    pub wrong: usize,
    /// Whether no other method beats it.
    pub is_best: bool,
}

/// The methods of a set, in the order of the report.
pub fn work_points(set: &MeasuredSet) -> Vec<WorkPoint> {
    // Errors below an eighth of an ulp look like none, and there are no times of a thousand seconds.
    let error = |ulps: f64| ulps.log2().clamp(-3.0, 120.0);
    let point = |row: &super::bench::MeasuredMethod| WorkPoint {
        method: row.method,
        error: (row.errors.judged > 0).then(|| error(row.errors.ulp.p99)),
        time: row.times.throughput.median.log2().clamp(-3.0, 40.0),
        wrong: row.errors.wrong.total(),
        is_best: row.pareto,
    };
    set.rows.iter().map(point).collect()
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
            wrong: 0,
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
