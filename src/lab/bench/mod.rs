//! Error against run time: sets of rays × methods, each held against the truth and timed.

mod data;
pub(crate) mod text;

use std::collections::BTreeSet;

pub use data::{json, records};
pub use text::{error_overview, error_table, markdown, text};

use crate::lab::Problem;
use crate::lab::errors::{Census, Checksum, Errors};
use crate::lab::families::Family;
use crate::lab::reference::Reference;
use crate::lab::timing::{self, Clock, Routine, Schedule, SelfCheck, Times};
use crate::method::Method;
use crate::method::exact::{self, Stage};
use crate::random::Random;
use crate::scene::{Rays, Scene};

/// A set of rays and spheres with a name.
#[derive(Debug, Clone, PartialEq)]
pub struct Sample {
    /// The name of the family, or the title of the scene.
    pub name: String,
    /// One sentence on what the rays are, and in which order.
    pub about: String,
    /// The rays, each with its sphere.
    pub problems: Vec<Problem>,
}

impl Sample {
    /// The first `rays` rays of a family for a seed.
    pub fn of_family(family: &Family, seed: u64, rays: usize) -> Self {
        Self {
            name: family.name.to_owned(),
            about: family.about.to_owned(),
            problems: family.sample(seed, rays),
        }
    }

    /// What the picture of a scene asks: each pixel's ray with each sphere, row by row. Of more
    /// than `most` questions, so many are drawn by lot and kept in their order.
    pub fn of_scene(scene: &Scene, rays: &Rays, seed: u64, most: usize) -> Self {
        let (width, spheres) = (rays.size.width as usize, scene.bodies.len());
        let all = rays.size.area() * spheres;
        let asked = if all <= most {
            (0..all).collect()
        } else {
            draw_lots(all, most, &mut Random::new(seed))
        };
        let problem = |i: usize| {
            let (pixel, body) = (i / spheres, i % spheres);
            let ray = rays.ray((pixel % width) as u32, (pixel / width) as u32);
            (ray, scene.bodies[body].sphere)
        };
        let plural = if spheres == 1 { "" } else { "s" };
        let share = match asked.len() {
            n if n == all => "all".to_owned(),
            n => format!("{n} of {all}, drawn by lot"),
        };
        Self {
            name: scene.name.clone(),
            about: format!("{} pixels × {spheres} sphere{plural}, {share}.", rays.size),
            problems: asked.into_iter().map(problem).collect(),
        }
    }
}

/// `count` different numbers below `all`, ascending, each set of them as likely as any other (Floyd's
/// algorithm: as much work as there are numbers drawn).
fn draw_lots(all: usize, count: usize, random: &mut Random) -> BTreeSet<usize> {
    let mut drawn = BTreeSet::new();
    for last in all - count..all {
        let lot = random.below(last as u64 + 1) as usize;
        if !drawn.insert(lot) {
            drawn.insert(last);
        }
    }
    drawn
}

/// What a run is to measure.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct BenchPlan<'a> {
    /// The methods, in the order of the report.
    pub methods: &'a [Method],
    /// How often each is timed.
    pub schedule: Schedule,
}

/// The most rays of a set that are timed: what fits into the second level of common caches.
pub const MOST_TIMED: usize = 4096;

/// One method on one set.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredMethod {
    /// The name of the method.
    pub method: &'static str,
    /// What it got wrong.
    pub errors: Errors,
    /// What it cost; ratios are to `textbook`.
    pub times: Times,
    /// For `exact`, how many rays each stage was the last to be asked about.
    pub stages: Option<[usize; Stage::ALL.len()]>,
    /// Whether no other method of the set is at least as good in wrong answers, p99 and median
    /// throughput, and better in one of them.
    pub pareto: bool,
}

/// All methods on one set.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredSet {
    /// The set's name.
    pub name: String,
    /// The set's sentence.
    pub about: String,
    /// The classes of its rays.
    pub census: Census,
    /// How many of its rays were timed, the first ones.
    pub timed: usize,
    /// The methods, in the order of the plan.
    pub rows: Vec<MeasuredMethod>,
}

/// Measures all methods of a plan on one set; none if `go_on` said no.
pub fn measure(
    plan: BenchPlan,
    sample: &Sample,
    clock: &dyn Clock,
    mut go_on: impl FnMut() -> bool,
) -> Option<MeasuredSet> {
    if !go_on() {
        return None;
    }
    let problems = &sample.problems;
    let references = Reference::all(problems);
    let errors: Vec<Errors> = plan
        .methods
        .iter()
        .map(|method| Errors::of(problems, &references, |r, s| method.solve(r, s)))
        .collect();
    let timed = &problems[..problems.len().min(MOST_TIMED)];
    let times = time_methods(plan, timed, clock, go_on)?;
    let mut rows: Vec<MeasuredMethod> = plan
        .methods
        .iter()
        .zip(errors.into_iter().zip(times))
        .map(|(&method, (errors, times))| MeasuredMethod {
            method: method.name(),
            errors,
            times,
            stages: (method == Method::Exact).then(|| count_stages(problems)),
            pareto: false,
        })
        .collect();
    mark_pareto(&mut rows);
    Some(MeasuredSet {
        name: sample.name.clone(),
        about: sample.about.clone(),
        census: Census::of(&references),
        timed: timed.len(),
        rows,
    })
}

/// The times of the plan's methods; `textbook` is always run, since ratios are to it.
fn time_methods(
    plan: BenchPlan,
    problems: &[Problem],
    clock: &dyn Clock,
    go_on: impl FnMut() -> bool,
) -> Option<Vec<Times>> {
    let routines: Vec<Box<dyn Routine>> = std::iter::once(Method::Textbook)
        .chain(
            plan.methods
                .iter()
                .copied()
                .filter(|&m| m != Method::Textbook),
        )
        .map(timing::routine)
        .collect();
    let borrowed: Vec<&dyn Routine> = routines.iter().map(AsRef::as_ref).collect();
    let times = timing::time(&borrowed, problems, plan.schedule, clock, go_on)?;
    let mut others = times[1..].iter();
    let in_order = plan.methods.iter().map(|&method| match method {
        Method::Textbook => Some(times[0]),
        _ => others.next().copied(),
    });
    in_order.collect()
}

fn count_stages(problems: &[Problem]) -> [usize; Stage::ALL.len()] {
    let mut counts = [0; Stage::ALL.len()];
    for (ray, sphere) in problems {
        let (_, stages) = exact::solve_staged(ray, sphere);
        counts[stages.last() as usize] += 1;
    }
    counts
}

/// Marks the rows that no other row dominates.
fn mark_pareto(rows: &mut [MeasuredMethod]) {
    let cost = |row: &MeasuredMethod| {
        let Errors { wrong, ulp, .. } = &row.errors;
        [wrong.total() as f64, ulp.p99, row.times.throughput.median]
    };
    let costs: Vec<[f64; 3]> = rows.iter().map(cost).collect();
    for (row, mine) in rows.iter_mut().zip(&costs) {
        row.pareto = !costs.iter().any(|other| dominates(other, mine));
    }
}

fn dominates(one: &[f64; 3], other: &[f64; 3]) -> bool {
    one.iter().zip(other).all(|(a, b)| a <= b) && one != other
}

/// A whole run.
#[derive(Debug, Clone, PartialEq)]
pub struct Benchmark {
    /// The seed of the rays.
    pub seed: u64,
    /// The sets that were measured to the end.
    pub sets: Vec<MeasuredSet>,
    /// What the timing said of itself.
    pub self_checks: Vec<SelfCheck>,
    /// Whether all sets of the plan are there.
    pub complete: bool,
}

impl Benchmark {
    /// Whether all self-checks passed.
    pub fn times_trusted(&self) -> bool {
        !self.self_checks.is_empty() && self.self_checks.iter().all(|check| check.passed)
    }

    /// A hash of all answers of all methods.
    pub fn checksum(&self) -> Checksum {
        let mut checksum = Checksum::default();
        for row in self.sets.iter().flat_map(|set| &set.rows) {
            checksum.combine(row.errors.checksum);
        }
        checksum
    }
}

/// How often the self-checks repeat each of their runs.
const CHECK_ROUNDS: usize = 25;

/// Measures set after set, the timing's own checks first.
///
/// `go_on` is asked often, with the number and the name of the set at hand; once it says no, the
/// report holds what was complete by then.
pub fn run(
    plan: BenchPlan,
    samples: &[Sample],
    seed: u64,
    clock: &dyn Clock,
    mut go_on: impl FnMut(usize, &str) -> bool,
) -> Benchmark {
    let textbook = timing::routine(Method::Textbook);
    let self_checks = match samples.iter().find(|sample| sample.problems.len() > 1) {
        Some(sample) => {
            let timed = &sample.problems[..sample.problems.len().min(MOST_TIMED)];
            timing::self_checks(&*textbook, timed, CHECK_ROUNDS, clock)
        }
        None => Vec::new(),
    };
    let sets: Vec<MeasuredSet> = samples
        .iter()
        .enumerate()
        .map_while(|(i, sample)| measure(plan, sample, clock, || go_on(i, &sample.name)))
        .collect();
    Benchmark {
        seed,
        complete: sets.len() == samples.len(),
        sets,
        self_checks,
    }
}
