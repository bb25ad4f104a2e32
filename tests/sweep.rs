//! `exact` against the truth on every family, and which stage settled how many.
//!
//! `RAYSCOPE_SWEEP` sets the number of rays in all (13 500 without it, ten million in `.ci/run`),
//! `RAYSCOPE_SEED` the seed.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

use rayscope::geometry::{Ray, Sphere};
use rayscope::lab::Family;
use rayscope::method::exact::{self, Stage};
use rayscope::method::{Class, Solution, Truth};

fn from_environment(name: &str, otherwise: u64) -> u64 {
    match std::env::var(name) {
        Ok(text) => text
            .parse()
            .unwrap_or_else(|_| panic!("{name} is {text}: expected a whole number")),
        Err(_) => otherwise,
    }
}

/// How many rays of a family each stage had to be asked for, and how many of them missed.
#[derive(Debug, Default)]
struct Tally {
    rays: usize,
    misses: usize,
    tangents: usize,
    last: BTreeMap<Stage, usize>,
}

impl Tally {
    fn of(family: &Family, seed: u64, rays: usize) -> Self {
        let mut tally = Self::default();
        for (ray, sphere) in family.rays(seed).take(rays) {
            let (found, stages) = exact::solve_staged(&ray, &sphere);
            assert_right(family, &ray, &sphere, found);
            tally.rays += 1;
            tally.misses += usize::from(found.class == Class::Miss);
            tally.tangents += usize::from(found.class == Class::Tangent);
            *tally.last.entry(stages.last()).or_default() += 1;
        }
        tally
    }

    fn of_stage(&self, stage: Stage) -> usize {
        self.last.get(&stage).copied().unwrap_or_default()
    }
}

fn bits(solution: Solution) -> (Class, Option<[u32; 2]>) {
    let roots = [solution.near, solution.far].map(f32::to_bits);
    (solution.class, solution.class.meets().then_some(roots))
}

fn assert_right(family: &Family, ray: &Ray, sphere: &Sphere, found: Solution) {
    let expected = Truth::new(ray, sphere).solution();
    assert_eq!(
        bits(found),
        bits(expected),
        "{}: {ray:?} {sphere:?}: found {found:?}, expected {expected:?}",
        family.name
    );
}

/// The families swept on all processors.
fn sweep(rays: usize, seed: u64) -> Vec<(&'static Family, Tally)> {
    let each = rays.div_ceil(Family::ALL.len());
    let next = AtomicUsize::new(0);
    let take = || Family::ALL.get(next.fetch_add(1, Ordering::Relaxed));
    let work = || {
        std::iter::from_fn(take)
            .map(|family| (family, Tally::of(family, seed, each)))
            .collect::<Vec<_>>()
    };
    let threads = thread::available_parallelism().map_or(1, usize::from);
    thread::scope(|scope| {
        let running: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        running
            .into_iter()
            .flat_map(|running| running.join().expect("a disagreement, shown above"))
            .collect()
    })
}

/// Of each family the least share that stage 1 alone settles, and the greatest that needs more than
/// binary64: by what the family is, with room for chance.
const SHARES: [(&str, f64, f64); 27] = [
    ("typical", 0.998, 0.0),
    ("inside", 0.995, 0.0),
    ("end-minus-start", 0.998, 0.0),
    ("near-unit", 0.998, 0.0),
    ("far-4e3", 0.998, 0.0),
    ("far-1e6", 0.998, 0.0),
    ("grazing", 0.9, 0.001),
    ("tangent", 0.0, 0.0),
    ("tangent-ulp", 0.6, 0.25),
    ("tangent-wide", 0.0, 1.0),
    ("surface", 0.0, 0.001),
    ("surface-exact", 0.0, 0.0),
    ("own-hit", 0.0, 0.002),
    ("ground", 0.0, 0.002),
    ("huge-radius", 0.0, 0.002),
    ("tiny-radius", 0.6, 0.4),
    ("point", 0.2, 0.8),
    ("offset", 0.998, 0.0),
    ("integers", 0.98, 0.0),
    ("ties", 0.2, 0.8),
    ("scaled-direction", 0.998, 0.0),
    ("scaled", 0.998, 0.0),
    ("overflow", 0.998, 0.0),
    ("subnormal", 0.99, 0.001),
    ("log-uniform", 0.998, 0.0),
    ("bits", 0.92, 0.08),
    ("sparse-bits", 0.998, 0.0),
];

#[test]
fn agrees_with_the_truth_on_every_family() {
    let rays = from_environment("RAYSCOPE_SWEEP", 13_500) as usize;
    let seed = from_environment("RAYSCOPE_SEED", 1);
    let tallies = sweep(rays, seed);
    assert_eq!(tallies.len(), Family::ALL.len());

    print!(
        "{:18}{:>9}{:>9}{:>9}",
        "family", "rays", "misses", "tangents"
    );
    for stage in Stage::ALL {
        print!("{stage:>14}");
    }
    println!();
    for (family, tally) in &tallies {
        let Tally {
            rays,
            misses,
            tangents,
            ..
        } = tally;
        print!("{:18}{rays:9}{misses:9}{tangents:9}", family.name);
        for stage in Stage::ALL {
            print!("{:14}", tally.of_stage(stage));
        }
        println!();
    }
    for (family, tally) in &tallies {
        let (name, least_direct, most_beyond) = SHARES
            .into_iter()
            .find(|(name, ..)| *name == family.name)
            .expect("a row for each family");
        let rays = tally.rays as f64;
        let direct = tally.of_stage(Stage::Binary64) as f64;
        let beyond = [Stage::Whole, Stage::DoubleDouble, Stage::Integer].map(|s| tally.of_stage(s));
        let beyond = beyond.iter().sum::<usize>() as f64;
        assert!(direct >= least_direct * rays, "{name}: {tally:?}");
        assert!(beyond <= most_beyond * rays + 2.0, "{name}: {tally:?}");
    }
}
