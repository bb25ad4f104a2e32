//! Error against run time: sets of rays × methods, each held against the truth and timed.

mod against;
mod answer;
mod data;
pub(crate) mod text;

use std::collections::BTreeSet;

pub use against::{Earlier, differences};
pub use answer::{Answer, Choice, answers};
pub use data::{Extras, json, records};
pub use text::{error_overview, error_table, markdown, second_table, text};

use crate::lab::Problem;
use crate::lab::errors::{Census, Checksum, Errors};
use crate::lab::families::Family;
use crate::lab::machine;
use crate::lab::reference::Reference;
use crate::lab::second::SecondRays;
use crate::lab::timing::{
    self, Clock, Routine, Schedule, SelfCheck, TimedRays, TimedRun, Times, Timing,
};
use crate::method::Method;
use crate::method::exact::{self, Stage};
use crate::random::Random;
use crate::scene::{Rays, Scene, Size};

/// A set of rays and spheres with a name.
#[derive(Debug, Clone, PartialEq)]
pub struct Sample {
    /// The name of the family, or the title of the scene.
    pub name: String,
    /// One sentence on what the rays are, and in which order.
    pub about: String,
    /// The rays that errors are found on, each with its sphere.
    pub problems: Vec<Problem>,
    /// Where there are as many rays more as are wanted.
    source: Source,
}

/// Where a sample has its rays from.
#[derive(Debug, Clone, PartialEq)]
enum Source {
    /// The first of a family's for a seed.
    Family(&'static str, u64),
    /// A picture's, which can be looked at in finer pixels; the seed of the lots.
    Picture(Box<(Scene, Rays)>, u64),
    /// No others: those there are, drawn by lot, in an order that no processor knows; the seed of the lots.
    Rows(u64),
}

/// Every ray of a picture with every sphere, row by row.
struct PictureProblems<'a> {
    scene: &'a Scene,
    rays: Rays,
}

impl PictureProblems<'_> {
    fn count(&self) -> usize {
        self.rays.size.area() * self.scene.bodies.len()
    }

    fn at(&self, i: usize) -> Problem {
        let (width, spheres) = (self.rays.size.width as usize, self.scene.bodies.len());
        let (pixel, body) = (i / spheres, i % spheres);
        let ray = self
            .rays
            .ray((pixel % width) as u32, (pixel / width) as u32);
        (ray, self.scene.bodies[body].sphere)
    }

    /// All of them, or as many drawn by lot as there shall be at most.
    fn sample(&self, most: usize, seed: u64) -> Vec<Problem> {
        match self.count() {
            all if all <= most => (0..all).map(|i| self.at(i)).collect(),
            all => draw_lots(all, most, &mut Random::new(seed))
                .into_iter()
                .map(|i| self.at(i))
                .collect(),
        }
    }

    /// The same picture in so many times as many pixels that there are `least` problems, if it has any.
    fn finer(&self, least: usize) -> Self {
        let factor = (least as f64 / self.count().max(1) as f64)
            .sqrt()
            .ceil()
            .max(1.0);
        let size = self.rays.size;
        let rays = Rays {
            size: Size::new(size.width * factor as u32, size.height * factor as u32),
            right: self.rays.right / factor,
            down: self.rays.down / factor,
            ..self.rays
        };
        Self { rays, ..*self }
    }
}

impl Sample {
    /// The first `rays` rays of a family for a seed.
    pub fn of_family(family: &'static Family, seed: u64, rays: usize) -> Self {
        Self {
            name: family.name.to_owned(),
            about: family.about.to_owned(),
            problems: family.sample(seed, rays),
            source: Source::Family(family.name, seed),
        }
    }

    /// What the picture of a scene asks: each pixel's ray with each sphere, row by row. Of more
    /// than `most` questions, so many are drawn by lot and kept in their order.
    pub fn of_scene(scene: &Scene, rays: &Rays, seed: u64, most: usize) -> Self {
        let all = PictureProblems { scene, rays: *rays };
        let problems = all.sample(most, seed);
        let spheres = scene.bodies.len();
        let plural = if spheres == 1 { "" } else { "s" };
        let share = match problems.len() {
            n if n == all.count() => "all".to_owned(),
            n => format!("{n} of {}, drawn at random", all.count()),
        };
        Self {
            name: scene.name.clone(),
            about: format!("{} pixels × {spheres} sphere{plural}, {share}.", rays.size),
            problems,
            source: Source::Picture(Box::new((scene.clone(), *rays)), seed),
        }
    }

    /// Rays from somebody's file.
    pub fn of_rows(name: &str, problems: Vec<Problem>, seed: u64) -> Self {
        Self {
            name: name.to_owned(),
            about: format!("{} rays from a file.", problems.len()),
            problems,
            source: Source::Rows(seed),
        }
    }

    /// So many rays of the same kind that no ray is known by the time it comes again; of a picture, in
    /// finer pixels.
    fn unseen(&self, count: usize) -> Vec<Problem> {
        match &self.source {
            Source::Family(name, seed) => {
                Family::by_name(name).map_or(Vec::new(), |family| family.sample(*seed, count))
            }
            Source::Picture(picture, seed) => {
                let (scene, rays) = picture.as_ref();
                let all = PictureProblems { scene, rays: *rays };
                all.finer(count).sample(count, *seed)
            }
            Source::Rows(seed) => {
                let mut random = Random::new(*seed);
                let all = self.problems.len();
                let count = if all == 0 { 0 } else { count };
                (0..count)
                    .map(|_| self.problems[random.below(all as u64) as usize])
                    .collect()
            }
        }
    }

    /// What kind of rays it has: the family's, or the name itself.
    fn kind(&self) -> String {
        let family = match &self.source {
            Source::Family(name, _) => Family::by_name(name),
            Source::Picture(..) | Source::Rows(_) => None,
        };
        family.map_or_else(|| self.name.clone(), |family| family.kind.name().to_owned())
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

/// The most rays of a set whose second rays are followed.
pub const MOST_FOLLOWED: usize = 1024;

/// One method on one set.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredMethod {
    /// The name of the method.
    pub method: &'static str,
    /// What it got wrong.
    pub errors: Errors,
    /// What it cost; ratios are to `textbook`. None where it can't be run as it is meant to.
    pub times: Option<Times>,
    /// What its hits are as points, and as starts of second rays.
    pub second: SecondRays,
    /// For `exact`, how many rays each stage was the last to be asked about.
    pub stages: Option<[usize; Stage::ALL.len()]>,
    /// Whether another method of the set is as good in wrong answers, p99 and time, and better in one.
    pub pareto: Pareto,
}

/// Whether a method is among the best of a set.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pareto {
    /// No other is as good in wrong answers and p99 but those that are slower.
    Best,
    /// Another with as few wrong answers and as small a p99 takes about the same time: which is quicker was
    /// not told apart.
    Open,
    /// Another is as good in all three, and better in one.
    Beaten,
}

impl Pareto {
    /// The mark in tables.
    pub const fn mark(self) -> char {
        match self {
            Self::Best => '*',
            Self::Open => '~',
            Self::Beaten => ' ',
        }
    }
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
    /// What kind of rays these are: the set's own name, if it is of none.
    pub kind: String,
    /// How many of its rays were timed again and again, the first ones.
    pub timed: usize,
    /// How many others were timed that were not known.
    pub unseen: usize,
    /// What the timing took; nothing where no method was timed.
    pub run: TimedRun,
    /// The methods, in the order of the plan.
    pub rows: Vec<MeasuredMethod>,
}

impl MeasuredSet {
    /// Adds answers that somebody else gave, and the nanoseconds that each took.
    pub fn add(&mut self, name: &'static str, errors: Errors, nanoseconds: &[f64]) {
        let first = self.run.times.first().map(|times| times.unseen.ns.median);
        let first = vec![first.unwrap_or_default(); nanoseconds.len()];
        self.rows.push(MeasuredMethod {
            method: name,
            errors,
            times: Some(Times {
                unseen: Timing::of(nanoseconds.to_vec(), &first),
                ..Times::default()
            }),
            second: SecondRays::default(),
            stages: None,
            pareto: Pareto::Beaten,
        });
        mark_pareto(&mut self.rows);
    }
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
    let replayed = &problems[..problems.len().min(MOST_TIMED)];
    let unseen = sample.unseen(plan.schedule.unseen);
    let rays = TimedRays {
        unseen: &unseen,
        replayed,
    };
    let run = time_methods(plan, rays, clock, go_on)?;
    let mut rows: Vec<MeasuredMethod> = plan
        .methods
        .iter()
        .zip(errors)
        .map(|(&method, errors)| MeasuredMethod {
            method: method.name(),
            errors,
            second: SecondRays::of(
                |r, s| method.solve(r, s),
                problems,
                &references,
                MOST_FOLLOWED,
            ),
            times: run.of(method),
            stages: (method == Method::Exact).then(|| count_stages(problems)),
            pareto: Pareto::Beaten,
        })
        .collect();
    mark_pareto(&mut rows);
    Some(MeasuredSet {
        name: sample.name.clone(),
        about: sample.about.clone(),
        kind: sample.kind(),
        census: Census::of(&references),
        timed: replayed.len(),
        unseen: unseen.len(),
        run: run.run,
        rows,
    })
}

/// The times of methods.
struct MethodTimes {
    methods: Vec<Method>,
    run: TimedRun,
}

impl MethodTimes {
    fn of(&self, method: Method) -> Option<Times> {
        let place = self.methods.iter().position(|&m| m == method)?;
        self.run.times.get(place).cloned()
    }
}

/// The times of the plan's methods; `textbook` is always run, since ratios are to it.
fn time_methods(
    plan: BenchPlan,
    rays: TimedRays,
    clock: &dyn Clock,
    go_on: impl FnMut() -> bool,
) -> Option<MethodTimes> {
    let others = plan.methods.iter().copied();
    let methods: Vec<Method> = std::iter::once(Method::Textbook)
        .chain(others.filter(|&m| m != Method::Textbook && timing::is_timed(m)))
        .collect();
    let routines: Vec<Box<dyn Routine>> = methods.iter().map(|&m| timing::routine(m)).collect();
    let borrowed: Vec<&dyn Routine> = routines.iter().map(AsRef::as_ref).collect();
    let run = timing::time(&borrowed, rays, plan.schedule, clock, go_on)?;
    Some(MethodTimes { methods, run })
}

fn count_stages(problems: &[Problem]) -> [usize; Stage::ALL.len()] {
    let mut counts = [0; Stage::ALL.len()];
    for (ray, sphere) in problems {
        let (_, stages) = exact::solve_staged(ray, sphere);
        counts[stages.last() as usize] += 1;
    }
    counts
}

/// Marks the rows that no other row beats.
fn mark_pareto(rows: &mut [MeasuredMethod]) {
    let places: Vec<Pareto> = rows.iter().map(|row| pareto(row, rows)).collect();
    for (row, place) in rows.iter_mut().zip(places) {
        row.pareto = place;
    }
}

/// Where a row lies among all. A time that is not told apart from its own decides nothing.
fn pareto(row: &MeasuredMethod, rows: &[MeasuredMethod]) -> Pareto {
    let errors = |row: &MeasuredMethod| [row.errors.wrong.total() as f64, row.errors.ulp.p99];
    let Some(mine) = row.times.as_ref().map(|times| &times.unseen) else {
        return Pareto::Beaten;
    };
    let mut place = Pareto::Best;
    for other in rows.iter().filter(|other| other.method != row.method) {
        let (own, others) = (errors(row), errors(other));
        let Some(theirs) = other.times.as_ref().map(|times| &times.unseen) else {
            continue;
        };
        if !others.iter().zip(&own).all(|(theirs, own)| theirs <= own) {
            continue;
        }
        if !mine.is_told_apart_from(theirs) {
            place = Pareto::Open;
        } else if theirs.ns.median < mine.ns.median {
            return Pareto::Beaten;
        }
    }
    place
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

    /// Why the times are not to be trusted.
    pub fn complaints(&self) -> Vec<String> {
        if self.self_checks.is_empty() {
            return vec!["nothing was checked".to_owned()];
        }
        self.self_checks
            .iter()
            .filter_map(SelfCheck::complaint)
            .collect()
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
    let load = machine::load();
    let mut self_checks = match samples.iter().find(|sample| sample.problems.len() > 1) {
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
    if !sets.is_empty() {
        let runs: Vec<&TimedRun> = sets.iter().map(|set| &set.run).collect();
        self_checks.extend(SelfCheck::of_samples(&runs));
        self_checks.extend(load.map(SelfCheck::load));
    }
    Benchmark {
        seed,
        complete: sets.len() == samples.len(),
        sets,
        self_checks,
    }
}
