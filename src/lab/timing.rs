//! What a solve costs: one call after the other, all in arrays, and in a dependent chain, with checks
//! that tell whether the clock and the loop measure what they should.

use std::hint::black_box;
use std::time::Instant;

use serde::Serialize;

use super::Problem;
use super::errors::nearest_rank;
use super::numbers;
use crate::geometry::{Ray, Sphere};
use crate::method::batch::{Batch, Solutions};
use crate::method::{Class, Method, Solution, simd};
use crate::random::Random;

/// Where times come from; a test brings a clock of its own.
pub trait Clock {
    /// Nanoseconds since a moment that stays the same.
    fn now(&self) -> u64;
}

/// The monotonic clock of the operating system.
#[derive(Debug, Clone, Copy)]
pub struct SystemClock(Instant);

impl SystemClock {
    /// A clock that starts now.
    pub fn new() -> Self {
        Self(Instant::now())
    }
}

impl Default for SystemClock {
    fn default() -> Self {
        Self::new()
    }
}

impl Clock for SystemClock {
    fn now(&self) -> u64 {
        u64::try_from(self.0.elapsed().as_nanos()).unwrap_or(u64::MAX)
    }
}

/// What can be timed: a way to solve, run over many rays at a stretch.
///
/// The loops are compiled for each way to solve: what is timed is its body in a loop, not a call through a pointer.
pub trait Routine {
    /// Where the line of the ray meets the sphere.
    fn solve(&self, ray: &Ray, sphere: &Sphere) -> Solution;

    /// Answers each problem, independently of the others.
    fn solve_all(&self, problems: &[Problem], answers: &mut [Solution]) {
        for ((ray, sphere), answer) in problems.iter().zip(answers) {
            *answer = self.solve(ray, sphere);
        }
    }

    /// Answers all problems, which lie in arrays, at once.
    fn solve_arrays(&self, arrays: &Arrays, answers: &mut Solutions) {
        let batch = arrays.batch();
        answers.replace((0..batch.count()).map(|i| {
            let (ray, sphere) = batch.get(i);
            self.solve(&ray, &sphere)
        }));
    }

    /// Answers each problem once the answer before it is known; the bits of the last answer.
    fn solve_chain(&self, problems: &[Problem]) -> u32 {
        // A mask that the compiler cannot tell to be zero: each ray is the very ray of the list, but
        // its first coordinate is not there before the last answer.
        let none = black_box(0_u32);
        let mut last = 0;
        for (ray, sphere) in problems {
            let mut ray = *ray;
            ray.origin.x = f32::from_bits(ray.origin.x.to_bits() | (last & none));
            let answer = self.solve(&ray, sphere);
            last = answer.near.to_bits() ^ answer.far.to_bits() ^ answer.class as u32;
        }
        last
    }
}

impl<F: Fn(&Ray, &Sphere) -> Solution> Routine for F {
    fn solve(&self, ray: &Ray, sphere: &Sphere) -> Solution {
        self(ray, sphere)
    }
}

/// Whether a method runs here as it is meant to: what stands for fused operations where the processor has
/// none takes many times as long.
pub fn is_timed(method: Method) -> bool {
    method != Method::Contracted || simd::has_fma()
}

/// Somebody's own routine: a method that is known when the program runs.
struct Own(Method);

impl Routine for Own {
    fn solve(&self, ray: &Ray, sphere: &Sphere) -> Solution {
        self.0.solve(ray, sphere)
    }

    fn solve_arrays(&self, arrays: &Arrays, answers: &mut Solutions) {
        arrays.batch().solve(self.0, answers);
    }
}

/// The routine of a method. Left to the compiler, a formula that several loops call is a call in each, which waits for
/// what the last ray left in its registers.
pub fn routine(method: Method) -> Box<dyn Routine> {
    macro_rules! of {
        ($($variant:ident),*) => {
            match method {
                $(Method::$variant => {
                    struct $variant;
                    impl Routine for $variant {
                        #[inline(always)]
                        fn solve(&self, ray: &Ray, sphere: &Sphere) -> Solution {
                            Method::$variant.solve(ray, sphere)
                        }

                        fn solve_arrays(&self, arrays: &Arrays, answers: &mut Solutions) {
                            arrays.batch().solve(Method::$variant, answers);
                        }
                    }
                    Box::new($variant)
                })*
                Method::Routine(_) => Box::new(Own(method)),
            }
        };
    }
    of!(
        Textbook, Contracted, Unit, Citardauq, Haines, Kahan, Double, Exact
    )
}

/// The coordinates of vectors, lane by lane.
type Coordinates<'a> = [&'a [f32]; 3];

/// Problems in arrays, one for each of the ten numbers, in the order of the columns ox … r.
#[derive(Debug, Clone)]
pub struct Arrays([Vec<f32>; 10]);

impl Arrays {
    /// The arrays of these problems.
    pub fn of(problems: &[Problem]) -> Self {
        Self(std::array::from_fn(|i| {
            problems.iter().map(|problem| numbers(problem)[i]).collect()
        }))
    }

    /// The lanes of a batch.
    pub fn batch(&self) -> Batch<Coordinates<'_>, Coordinates<'_>, Coordinates<'_>, &[f32]> {
        let [ox, oy, oz, dx, dy, dz, cx, cy, cz, r] = self.0.each_ref().map(Vec::as_slice);
        Batch {
            origin: [ox, oy, oz],
            direction: [dx, dy, dz],
            center: [cx, cy, cz],
            radius: r,
        }
    }
}

/// A routine that does nothing but hand on what it was given: the price of the loops.
fn empty(ray: &Ray, sphere: &Sphere) -> Solution {
    Solution::with_roots(Class::Miss, ray.origin.x, sphere.radius)
}

/// Nanoseconds for one solve, over the repeats of a run.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Nanoseconds {
    /// Half of the repeats took no longer.
    pub median: f64,
    /// The quickest repeat.
    pub min: f64,
    /// From the first quartile to the third.
    pub iqr: f64,
}

/// The times of one routine in one way of asking.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Timing {
    /// All repeats in brief.
    pub ns: Nanoseconds,
    /// The first quartile and the third: the range that two routines are told apart by.
    pub range: [f64; 2],
    /// The median over the repeats of the time over that of the first routine in the same round.
    pub ratio: f64,
    /// Each repeat, in the order in which it was taken.
    pub samples: Vec<f64>,
}

impl Timing {
    /// The times of these repeats, beside those of the first routine.
    pub fn of(samples: Vec<f64>, first: &[f64]) -> Self {
        let ratio = median_ratio(&samples, first);
        let mut sorted = samples.clone();
        sorted.sort_by(f64::total_cmp);
        let [first, median, third] = [1, 2, 3].map(|n| nearest_rank(&sorted, n, 4));
        Self {
            ns: Nanoseconds {
                median,
                min: sorted.first().copied().unwrap_or(0.0),
                iqr: third - first,
            },
            range: [first, third],
            ratio,
            samples,
        }
    }

    /// Whether the ranges of two routines lie apart.
    pub fn is_told_apart_from(&self, other: &Self) -> bool {
        self.range[1] < other.range[0] || other.range[1] < self.range[0]
    }
}

/// The times of one routine, in each way of asking.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Times {
    /// Independent rays that were not seen before, one call after the other: time over number.
    pub unseen: Timing,
    /// The same for a few rays that are asked again and again, so that the processor learns what comes.
    pub learned: Timing,
    /// Independent rays in arrays, answered at once, again and again.
    pub batch: Timing,
    /// Each ray waits for the answer before it, again and again.
    pub latency: Timing,
}

/// How a run is timed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Schedule {
    /// How often each routine goes over the rays that are asked again and again.
    pub rounds: usize,
    /// How often it goes over the rays that it shall not know.
    pub passes: usize,
    /// How many these are, at least.
    pub unseen: usize,
    /// What the order of the routines in each round is drawn from.
    pub seed: u64,
}

impl Schedule {
    /// The usual run, or a quick one.
    pub const fn new(quick: bool, seed: u64) -> Self {
        Self {
            rounds: if quick { 15 } else { 101 },
            passes: if quick { 2 } else { 8 },
            unseen: UNSEEN,
            seed,
        }
    }
}

/// So many rays no branch predictor remembers; two thousand it does.
pub const UNSEEN: usize = 1 << 17;

/// What a routine is timed on.
#[derive(Debug, Clone, Copy)]
pub struct TimedRays<'a> {
    /// Different rays, of which none comes again before all others.
    pub unseen: &'a [Problem],
    /// Few, that are asked again and again.
    pub replayed: &'a [Problem],
}

/// What a run took.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TimedRun {
    /// For each routine, in their order.
    pub times: Vec<Times>,
    /// A second copy of the first routine, timed among the others on the same unseen rays.
    pub copy: Timing,
    /// Into how many parts the unseen rays were cut: one pass has as many samples.
    pub parts: usize,
}

/// Times each routine on the same rays: in every round all of them, in an order that is drawn for each
/// round. Two rounds are run before the first that counts.
///
/// `go_on` is asked before each round; none if it said no.
pub fn time(
    routines: &[&dyn Routine],
    rays: TimedRays<'_>,
    schedule: Schedule,
    clock: &dyn Clock,
    mut go_on: impl FnMut() -> bool,
) -> Option<TimedRun> {
    let mut random = Random::new(schedule.seed);
    let replayed = time_replayed(
        routines,
        rays.replayed,
        schedule.rounds,
        (&mut random, clock),
        &mut go_on,
    )?;
    let (unseen, parts) = time_unseen(
        routines,
        rays.unseen,
        schedule.passes,
        (&mut random, clock),
        &mut go_on,
    )?;
    let ways = |i: usize| {
        let [learned, batch, latency] =
            [0, 1, 2].map(|way: usize| Timing::of(replayed[i][way].clone(), &replayed[0][way]));
        Times {
            unseen: Timing::of(unseen[i].clone(), &unseen[0]),
            learned,
            batch,
            latency,
        }
    };
    Some(TimedRun {
        times: (0..routines.len()).map(ways).collect(),
        copy: Timing::of(unseen[routines.len()].clone(), &unseen[0]),
        parts,
    })
}

/// One call after the other, in arrays and in a chain, on rays that are asked again and again.
fn time_replayed(
    routines: &[&dyn Routine],
    problems: &[Problem],
    rounds: usize,
    (random, clock): (&mut Random, &dyn Clock),
    go_on: &mut dyn FnMut() -> bool,
) -> Option<Vec<[Vec<f64>; 3]>> {
    let mut stand = Stand::new(problems, clock);
    let mut order: Vec<usize> = (0..routines.len()).collect();
    let mut taken = vec![[const { Vec::new() }; 3]; routines.len()];
    for round in 0..WARM_UP + rounds {
        if !go_on() {
            return None;
        }
        shuffle(&mut order, random);
        for &i in &order {
            // What others left in the branch predictor must not count: these rays are to be known.
            for _ in 0..LESSONS {
                routines[i].solve_all(black_box(problems), &mut stand.answers);
            }
            let times = [
                stand.throughput(routines[i], 1),
                stand.batch(routines[i]),
                stand.latency(routines[i]),
            ];
            if round >= WARM_UP {
                for (taken, time) in taken[i].iter_mut().zip(times) {
                    taken.push(time);
                }
            }
        }
    }
    Some(taken)
}

/// One call after the other, on rays that come again only after all others: part by part, all routines on
/// one part before the next. Last comes a second copy of the first routine, which is half of all rays
/// ahead, so that neither teaches the processor what the other will meet.
fn time_unseen(
    routines: &[&dyn Routine],
    problems: &[Problem],
    passes: usize,
    (random, clock): (&mut Random, &dyn Clock),
    go_on: &mut dyn FnMut() -> bool,
) -> Option<(Vec<Vec<f64>>, usize)> {
    let parts = (problems.len() / LEAST_PART).clamp(1, PARTS);
    let size = problems.len().div_ceil(parts).max(1);
    let mut stands: Vec<Stand> = problems
        .chunks(size)
        .map(|p| Stand::new(p, clock))
        .collect();
    let copy = routines.len();
    let mut order: Vec<usize> = (0..=copy).collect();
    let mut taken = vec![Vec::new(); order.len()];
    for _ in 0..passes {
        for part in 0..stands.len() {
            if !go_on() {
                return None;
            }
            let ahead = (part + stands.len() / 2) % stands.len();
            // Rays that are not in the cache yet would be the first routine's loss.
            for at in [part, ahead] {
                stands[at].throughput(&empty, 1);
            }
            shuffle(&mut order, random);
            for &i in &order {
                let (routine, at) = match routines.get(i) {
                    Some(routine) => (*routine, part),
                    None => (routines[0], ahead),
                };
                taken[i].push(stands[at].throughput(routine, 1));
            }
        }
    }
    Some((taken, stands.len()))
}

/// How often the rays that are to be known are gone over before each time that counts.
const LESSONS: usize = 4;

/// Rounds before the first that counts.
const WARM_UP: usize = 2;

/// The number of parts in which the unseen rays are timed, and the least number of rays in each.
const PARTS: usize = 16;
const LEAST_PART: usize = 64;

/// Fisher and Yates.
fn shuffle(order: &mut [usize], random: &mut Random) {
    for i in (1..order.len()).rev() {
        order.swap(i, random.below(i as u64 + 1) as usize);
    }
}

fn median_ratio(times: &[f64], first: &[f64]) -> f64 {
    let mut ratios: Vec<f64> = times.iter().zip(first).map(|(t, f)| t / f).collect();
    ratios.sort_by(f64::total_cmp);
    nearest_rank(&ratios, 1, 2)
}

/// The rays, room for the answers, and the clock.
struct Stand<'a> {
    problems: &'a [Problem],
    arrays: Arrays,
    answers: Vec<Solution>,
    answers_in_arrays: Solutions,
    clock: &'a dyn Clock,
}

impl<'a> Stand<'a> {
    fn new(problems: &'a [Problem], clock: &'a dyn Clock) -> Self {
        Self {
            problems,
            arrays: Arrays::of(problems),
            answers: vec![Solution::MISS; problems.len()],
            answers_in_arrays: Solutions::default(),
            clock,
        }
    }

    /// Nanoseconds a ray for going over all rays `times` times.
    fn throughput(&mut self, routine: &dyn Routine, times: usize) -> f64 {
        let start = self.clock.now();
        for _ in 0..times {
            routine.solve_all(black_box(self.problems), &mut self.answers);
            black_box(&mut self.answers);
        }
        self.per_ray(start)
    }

    fn batch(&mut self, routine: &dyn Routine) -> f64 {
        let start = self.clock.now();
        routine.solve_arrays(black_box(&self.arrays), &mut self.answers_in_arrays);
        black_box(&mut self.answers_in_arrays);
        self.per_ray(start)
    }

    fn latency(&self, routine: &dyn Routine) -> f64 {
        let start = self.clock.now();
        black_box(routine.solve_chain(black_box(self.problems)));
        self.per_ray(start)
    }

    fn per_ray(&self, start: u64) -> f64 {
        let elapsed = self.clock.now().saturating_sub(start);
        elapsed as f64 / self.problems.len().max(1) as f64
    }
}

/// One question put to the clock and the loops themselves.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SelfCheck {
    /// What was tried.
    pub name: &'static str,
    /// A ratio of two times.
    pub ratio: f64,
    /// From where it is good.
    pub least: f64,
    /// To where.
    pub most: f64,
    /// Whether it is.
    pub passed: bool,
}

impl SelfCheck {
    fn new(name: &'static str, ratio: f64, [least, most]: [f64; 2]) -> Self {
        Self {
            name,
            ratio,
            least,
            most,
            // A ratio of NaN, 0/0 from a clock that stands still, is in no range.
            passed: (least..=most).contains(&ratio),
        }
    }

    /// What the samples of many runs say of themselves: how far repeats lie apart, whether the last are like
    /// the first, and whether two copies of one routine take the same time. Each is told by a value that nine
    /// of ten keep below.
    pub fn of_samples(runs: &[&TimedRun]) -> [Self; 3] {
        let all = || {
            runs.iter()
                .flat_map(|run| run.times.iter().map(move |t| (run, &t.unseen)))
        };
        let spread = all().map(|(_, timing)| timing.ns.iqr / timing.ns.median);
        let drift = all().map(|(run, timing)| {
            let part = run.parts.min(timing.samples.len() / 2);
            let (first, last) = (
                &timing.samples[..part],
                timing.samples.rchunks(part.max(1)).next(),
            );
            apart(median(first), median(last.unwrap_or_default()))
        });
        let copies = runs.iter().filter_map(|run| {
            let first = run.times.first()?;
            Some(apart(run.copy.ns.median, first.unseen.ns.median))
        });
        [
            Self::new("spread of repeats", most(spread), [0.0, 0.25]),
            Self::new("first pass / last pass", most(drift), [1.0, 1.15]),
            Self::new("two copies of one method", most(copies), [1.0, 1.06]),
        ]
    }

    /// How busy the host was before the run, where it says so: programs that want to run for each thread.
    pub fn load(load: f64) -> Self {
        Self::new("host load for each thread", load, [0.0, 0.5])
    }

    /// Why times are not to be trusted, as a sentence; none if the check passed.
    pub fn complaint(&self) -> Option<String> {
        let Self {
            name,
            ratio,
            least,
            most,
            passed,
        } = self;
        let expected = if *least == 0.0 {
            format!("up to {most}")
        } else {
            format!("{least} to {most}")
        };
        (!passed).then(|| format!("{name} {ratio:.2}, expected {expected}"))
    }

    /// Whether nobody else on this host was measuring.
    pub fn alone(alone: bool) -> Self {
        Self::new("alone on this host", f64::from(u8::from(alone)), [1.0, 1.0])
    }
}

/// How many times one is the other, whichever is more.
fn apart(one: f64, other: f64) -> f64 {
    (one / other).max(other / one)
}

fn median(values: &[f64]) -> f64 {
    let mut values = values.to_vec();
    values.sort_by(f64::total_cmp);
    nearest_rank(&values, 1, 2)
}

/// What nine of ten values do not exceed; NaN if one is no number.
fn most(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.collect();
    if values.iter().any(|x| x.is_nan()) {
        return f64::NAN;
    }
    values.sort_by(f64::total_cmp);
    nearest_rank(&values, 9, 10)
}

/// Checks the clock and the loops on a routine: an empty one must take next to no time, two runs
/// twice as long as one, half of the rays half as long as all.
///
/// The quickest of several repeats is compared, which other programs on the machine disturb least.
pub fn self_checks(
    routine: &dyn Routine,
    problems: &[Problem],
    rounds: usize,
    clock: &dyn Clock,
) -> Vec<SelfCheck> {
    let mut whole = Stand::new(problems, clock);
    let mut half = Stand::new(&problems[..problems.len() / 2], clock);
    let mut quickest = [f64::INFINITY; 6];
    for _ in 0..rounds.max(1) {
        let times = [
            whole.throughput(routine, 1),
            whole.throughput(routine, 2),
            half.throughput(routine, 1),
            whole.throughput(&empty, 1),
            whole.latency(routine),
            whole.latency(&empty),
        ];
        for (quickest, time) in quickest.iter_mut().zip(times) {
            *quickest = quickest.min(time);
        }
    }
    let [once, twice, of_half, nothing, chain, empty_chain] = quickest;
    vec![
        SelfCheck::new("empty loop / solve", nothing / once, [0.0, 0.25]),
        SelfCheck::new(
            "empty chain / chain of solves",
            empty_chain / chain,
            [0.0, 0.25],
        ),
        SelfCheck::new("two runs / one run", twice / once, [1.7, 2.3]),
        SelfCheck::new(
            "half of the rays / all rays",
            of_half / once / 2.0,
            [0.4, 0.6],
        ),
    ]
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;
    use std::rc::Rc;

    use super::*;
    use crate::lab::Family;

    /// A clock that moves only when a routine works.
    #[derive(Clone, Default)]
    struct Workshop(Rc<Cell<u64>>);

    impl Clock for Workshop {
        fn now(&self) -> u64 {
            self.0.get()
        }
    }

    /// Takes these nanoseconds a ray alone, in arrays, and in a chain.
    struct Worker(Workshop, [u64; 3]);

    impl Routine for Worker {
        fn solve(&self, _: &Ray, _: &Sphere) -> Solution {
            Solution::MISS
        }
        fn solve_all(&self, problems: &[Problem], _: &mut [Solution]) {
            let Self(Workshop(now), [each, ..]) = self;
            now.set(now.get() + each * problems.len() as u64);
        }
        fn solve_arrays(&self, arrays: &Arrays, _: &mut Solutions) {
            let Self(Workshop(now), [_, each, _]) = self;
            now.set(now.get() + each * arrays.batch().count() as u64);
        }
        fn solve_chain(&self, problems: &[Problem]) -> u32 {
            let Self(Workshop(now), [.., each]) = self;
            now.set(now.get() + each * problems.len() as u64);
            0
        }
    }

    /// A clock that says a hundred nanoseconds more each time it is asked, whatever was done.
    #[derive(Default)]
    struct Metronome(Cell<u64>);

    impl Clock for Metronome {
        fn now(&self) -> u64 {
            self.0.set(self.0.get() + 100);
            self.0.get()
        }
    }

    struct Frozen;

    impl Clock for Frozen {
        fn now(&self) -> u64 {
            42
        }
    }

    fn problems() -> Vec<Problem> {
        Family::ALL[0].sample(1, 1000)
    }

    fn rays(problems: &[Problem]) -> TimedRays<'_> {
        TimedRays {
            unseen: problems,
            replayed: &problems[..64],
        }
    }

    const SCHEDULE: Schedule = Schedule {
        rounds: 9,
        passes: 3,
        unseen: 1000,
        seed: 3,
    };

    fn passed(checks: &[SelfCheck]) -> Vec<bool> {
        checks.iter().map(|check| check.passed).collect()
    }

    #[test]
    fn times_are_those_of_the_clock_and_ratios_those_to_the_first() {
        let clock = Workshop::default();
        let slow = Worker(clock.clone(), [20, 8, 60]);
        let quick = Worker(clock.clone(), [5, 2, 30]);
        let problems = problems();
        let run = time(&[&slow, &quick], rays(&problems), SCHEDULE, &clock, || true).unwrap();
        let ways = |t: &Times| [&t.unseen, &t.learned, &t.batch, &t.latency].map(Timing::clone);
        let of = |t: &Times| ways(t).map(|t| [t.ns.median, t.ns.min]);
        assert_eq!(
            of(&run.times[0]),
            [[20.0; 2], [20.0; 2], [8.0; 2], [60.0; 2]]
        );
        assert_eq!(of(&run.times[1]), [[5.0; 2], [5.0; 2], [2.0; 2], [30.0; 2]]);
        assert_eq!(
            ways(&run.times[1]).map(|t| t.ratio),
            [0.25, 0.25, 0.25, 0.5]
        );
        assert_eq!(run.times[1].unseen.ns.iqr, 0.0);
        // 1000 rays in 15 parts, three times over; nine rounds.
        let samples = ways(&run.times[1]).map(|t| t.samples.len());
        assert_eq!((run.parts, samples), (15, [45, 9, 9, 9]));
        assert_eq!(run.copy.ns.median, 20.0);
        let checks = SelfCheck::of_samples(&[&run]);
        assert_eq!(passed(&checks), [true; 3]);
    }

    /// Takes longer each time, and nothing for the empty routine.
    struct Tiring(Workshop, Cell<u64>);

    impl Routine for Tiring {
        fn solve(&self, _: &Ray, _: &Sphere) -> Solution {
            Solution::MISS
        }
        fn solve_all(&self, problems: &[Problem], _: &mut [Solution]) {
            let Self(Workshop(now), each) = self;
            each.set(each.get() + 1);
            now.set(now.get() + each.get() * problems.len() as u64);
        }
        fn solve_arrays(&self, _: &Arrays, _: &mut Solutions) {}
        fn solve_chain(&self, _: &[Problem]) -> u32 {
            0
        }
    }

    #[test]
    fn trust_is_earned_by_the_samples() {
        let problems = problems();
        let clock = Workshop::default();
        let tiring = Tiring(clock.clone(), Cell::new(100));
        let run = time(&[&tiring], rays(&problems), SCHEDULE, &clock, || true).unwrap();
        let [spread, drift, copies] = SelfCheck::of_samples(&[&run]);
        assert!(!drift.passed, "{drift:?}");
        assert!(spread.ratio > 0.1 && copies.ratio < 1.06);
        assert!(drift.complaint().unwrap().contains("expected 1 to 1.15"));
        // One way of asking that takes much longer now and then; and a copy that is another method.
        let timing = |samples: &[f64]| Timing::of(samples.to_vec(), samples);
        let run = |unseen: &[f64], copy: &[f64]| TimedRun {
            times: vec![Times {
                unseen: timing(unseen),
                ..Times::default()
            }],
            copy: timing(copy),
            parts: 2,
        };
        let uneven = run(&[1.0, 2.0, 1.0, 2.0], &[1.0, 2.0, 1.0, 2.0]);
        assert_eq!(
            passed(&SelfCheck::of_samples(&[&uneven])),
            [false, true, true]
        );
        let unlike = run(&[1.0; 4], &[1.1; 4]);
        assert_eq!(
            passed(&SelfCheck::of_samples(&[&unlike])),
            [true, true, false]
        );
        let frozen = run(&[0.0; 4], &[0.0; 4]);
        assert_eq!(passed(&SelfCheck::of_samples(&[&frozen])), [false; 3]);
        assert!(!SelfCheck::load(4.0).passed && SelfCheck::load(0.2).passed);
    }

    #[test]
    fn ranges_that_overlap_are_not_told_apart() {
        let timing = |samples: [f64; 4]| Timing::of(samples.into(), &samples);
        let [low, high] = [timing([1.0, 2.0, 3.0, 4.0]), timing([5.0, 6.0, 7.0, 8.0])];
        let middle = timing([2.0, 3.0, 5.0, 7.0]);
        assert!(low.is_told_apart_from(&high) && high.is_told_apart_from(&low));
        assert!(!low.is_told_apart_from(&middle) && !middle.is_told_apart_from(&high));
    }

    #[test]
    fn spread_is_that_of_the_repeats() {
        let samples = [8.0, 1.0, 5.0, 2.0, 7.0, 3.0, 6.0, 4.0];
        let Timing { ns, range, .. } = Timing::of(samples.into(), &samples);
        assert_eq!([ns.median, ns.min, ns.iqr], [4.0, 1.0, 4.0]);
        assert_eq!(range, [2.0, 6.0]);
    }

    #[test]
    fn a_run_that_is_told_to_stop_has_no_times() {
        let mut rounds = 0;
        let problems = problems();
        let clock = SystemClock::new();
        let stopped = time(&[&empty], rays(&problems), SCHEDULE, &clock, || {
            rounds += 1;
            rounds < 4
        });
        assert_eq!((stopped, rounds), (None, 4));
    }

    #[test]
    fn a_good_clock_passes_the_checks() {
        // The empty loop costs this clock nothing.
        let clock = Workshop::default();
        let worker = Worker(clock.clone(), [20, 8, 60]);
        assert_eq!(
            passed(&self_checks(&worker, &problems(), 3, &clock)),
            [true; 4]
        );
    }

    #[test]
    fn a_broken_clock_fails_the_checks() {
        let textbook = routine(Method::Textbook);
        let frozen = self_checks(&*textbook, &problems(), 3, &Frozen);
        assert_eq!(passed(&frozen), [false; 4]);
        let metronome = self_checks(&*textbook, &problems(), 3, &Metronome::default());
        assert_eq!(passed(&metronome), [false; 4]);
    }

    #[test]
    fn the_arrays_hold_the_rays_of_the_list() {
        let problems = problems();
        let arrays = Arrays::of(&problems);
        for method in Method::ALL {
            let mut answers = Solutions::default();
            routine(method).solve_arrays(&arrays, &mut answers);
            let single = |r: &Ray, s: &Sphere| method.solve(r, s);
            let mut again = Solutions::default();
            single.solve_arrays(&arrays, &mut again);
            for (i, (ray, sphere)) in problems.iter().enumerate() {
                let answer = method.solve(ray, sphere);
                for found in [answers.get(i), again.get(i)] {
                    let bits = |s: Solution| (s.class, s.near.to_bits(), s.far.to_bits());
                    assert_eq!(bits(found), bits(answer), "{method}");
                }
            }
        }
    }

    #[test]
    fn the_chain_answers_the_rays_of_the_list() {
        let problems = problems();
        let textbook = routine(Method::Textbook);
        let last = problems.last().unwrap();
        let answer = Method::Textbook.solve(&last.0, &last.1);
        assert_eq!(
            textbook.solve_chain(&problems),
            answer.near.to_bits() ^ answer.far.to_bits() ^ answer.class as u32
        );
    }
}
