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
use crate::method::{Class, Method, Solution};
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
pub trait Routine {
    /// Answers each problem, independently of the others.
    fn solve_all(&self, problems: &[Problem], answers: &mut [Solution]);

    /// Answers all problems, which lie in arrays, at once.
    fn solve_arrays(&self, arrays: &Arrays, answers: &mut Solutions);

    /// Answers each problem once the answer before it is known; the bits of the last answer.
    fn solve_chain(&self, problems: &[Problem]) -> u32;
}

/// A function is compiled into the loops: what is timed is its body, not a call through a pointer.
impl<F: Fn(&Ray, &Sphere) -> Solution> Routine for F {
    fn solve_all(&self, problems: &[Problem], answers: &mut [Solution]) {
        for ((ray, sphere), answer) in problems.iter().zip(answers) {
            *answer = self(ray, sphere);
        }
    }

    fn solve_arrays(&self, arrays: &Arrays, answers: &mut Solutions) {
        let batch = arrays.batch();
        answers.replace((0..batch.count()).map(|i| {
            let (ray, sphere) = batch.get(i);
            self(&ray, &sphere)
        }));
    }

    fn solve_chain(&self, problems: &[Problem]) -> u32 {
        // A mask that the compiler cannot tell to be zero: each ray is the very ray of the list, but
        // its first coordinate is not there before the last answer.
        let none = black_box(0_u32);
        let mut last = 0;
        for (ray, sphere) in problems {
            let mut ray = *ray;
            ray.origin.x = f32::from_bits(ray.origin.x.to_bits() | (last & none));
            let answer = self(&ray, sphere);
            last = answer.near.to_bits() ^ answer.far.to_bits() ^ answer.class as u32;
        }
        last
    }
}

/// A method: its single call, and what it makes of arrays.
struct Of<F> {
    method: Method,
    single: F,
}

impl<F: Fn(&Ray, &Sphere) -> Solution> Routine for Of<F> {
    fn solve_all(&self, problems: &[Problem], answers: &mut [Solution]) {
        self.single.solve_all(problems, answers);
    }

    fn solve_arrays(&self, arrays: &Arrays, answers: &mut Solutions) {
        arrays.batch().solve(self.method, answers);
    }

    fn solve_chain(&self, problems: &[Problem]) -> u32 {
        self.single.solve_chain(problems)
    }
}

/// The routine of a method.
pub fn routine(method: Method) -> Box<dyn Routine> {
    macro_rules! of {
        ($($variant:ident),*) => {
            match method {
                $(Method::$variant => Box::new(Of {
                    method,
                    single: |r: &Ray, s: &Sphere| Method::$variant.solve(r, s),
                }),)*
                Method::Routine(_) => unreachable!("returned above"),
            }
        };
    }
    if method.is_routine() {
        let single = move |r: &Ray, s: &Sphere| method.solve(r, s);
        return Box::new(Of { method, single });
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

impl Nanoseconds {
    fn of(mut repeats: Vec<f64>) -> Self {
        repeats.sort_by(f64::total_cmp);
        let quartile = |n| nearest_rank(&repeats, n, 4);
        Self {
            median: quartile(2),
            min: repeats.first().copied().unwrap_or(0.0),
            iqr: quartile(3) - quartile(1),
        }
    }
}

/// The times of one routine, and how they compare with the first routine's in the same rounds.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Times {
    /// Independent rays, one call after the other: time over number.
    pub throughput: Nanoseconds,
    /// Independent rays in arrays, answered at once: time over number.
    pub batch: Nanoseconds,
    /// Each ray waits for the answer before it.
    pub latency: Nanoseconds,
    /// The median over the rounds of throughput time over that of the first routine.
    pub throughput_ratio: f64,
    /// The same in arrays.
    pub batch_ratio: f64,
    /// The same of latency.
    pub latency_ratio: f64,
}

/// How a run is timed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Schedule {
    /// How often each routine goes over all rays in each of the three ways.
    pub rounds: usize,
    /// What the order of the routines in each round is drawn from.
    pub seed: u64,
}

/// Times each routine on the same rays: in every round all of them, in an order drawn anew. Two
/// rounds are run before the first that counts.
///
/// `go_on` is asked before each round; none if it said no.
pub fn time(
    routines: &[&dyn Routine],
    problems: &[Problem],
    schedule: Schedule,
    clock: &dyn Clock,
    mut go_on: impl FnMut() -> bool,
) -> Option<Vec<Times>> {
    let mut stand = Stand::new(problems, clock);
    let mut order: Vec<usize> = (0..routines.len()).collect();
    let mut random = Random::new(schedule.seed);
    let mut taken = vec![[const { Vec::new() }; 3]; routines.len()];
    for round in 0..WARM_UP + schedule.rounds {
        if !go_on() {
            return None;
        }
        shuffle(&mut order, &mut random);
        for &i in &order {
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
    Some(summarise(&taken))
}

/// Rounds before the first that counts.
const WARM_UP: usize = 2;

/// Fisher and Yates.
fn shuffle(order: &mut [usize], random: &mut Random) {
    for i in (1..order.len()).rev() {
        order.swap(i, random.below(i as u64 + 1) as usize);
    }
}

fn summarise(taken: &[[Vec<f64>; 3]]) -> Vec<Times> {
    let first = &taken[0];
    let times = taken.iter().map(|taken| {
        let [throughput, batch, latency] = taken.clone().map(Nanoseconds::of);
        let ratio = |way: usize| median_ratio(&taken[way], &first[way]);
        Times {
            throughput,
            batch,
            latency,
            throughput_ratio: ratio(0),
            batch_ratio: ratio(1),
            latency_ratio: ratio(2),
        }
    });
    times.collect()
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

    /// Whether nobody else on this host was measuring.
    pub fn alone(alone: bool) -> Self {
        Self::new("alone on this host", f64::from(u8::from(alone)), [1.0, 1.0])
    }
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

    /// Takes so many nanoseconds a ray alone, in arrays, and in a chain.
    struct Worker(Workshop, [u64; 3]);

    impl Routine for Worker {
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
        Family::ALL[0].sample(1, 64)
    }

    fn passed(checks: &[SelfCheck]) -> Vec<bool> {
        checks.iter().map(|check| check.passed).collect()
    }

    #[test]
    fn times_are_those_of_the_clock_and_ratios_those_to_the_first() {
        let clock = Workshop::default();
        let slow = Worker(clock.clone(), [20, 8, 60]);
        let quick = Worker(clock.clone(), [5, 2, 30]);
        let schedule = Schedule { rounds: 9, seed: 3 };
        let times = time(&[&slow, &quick], &problems(), schedule, &clock, || true).unwrap();
        let of = |t: &Times| [t.throughput, t.batch, t.latency].map(|ns| [ns.median, ns.min]);
        assert_eq!(of(&times[0]), [[20.0; 2], [8.0; 2], [60.0; 2]]);
        assert_eq!(of(&times[1]), [[5.0; 2], [2.0; 2], [30.0; 2]]);
        let t = &times[1];
        let ratios = [t.throughput_ratio, t.batch_ratio, t.latency_ratio];
        assert_eq!(ratios, [0.25, 0.25, 0.5]);
        assert_eq!(times[1].throughput.iqr, 0.0);
    }

    #[test]
    fn spread_is_that_of_the_repeats() {
        let ns = Nanoseconds::of([8.0, 1.0, 5.0, 2.0, 7.0, 3.0, 6.0, 4.0].into());
        assert_eq!([ns.median, ns.min, ns.iqr], [4.0, 1.0, 4.0]);
    }

    #[test]
    fn a_run_that_is_told_to_stop_has_no_times() {
        let mut rounds = 0;
        let schedule = Schedule { rounds: 9, seed: 3 };
        let stopped = time(
            &[&empty],
            &problems(),
            schedule,
            &SystemClock::new(),
            || {
                rounds += 1;
                rounds < 4
            },
        );
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
