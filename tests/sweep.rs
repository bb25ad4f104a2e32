//! `exact` against the truth on every family, and which stage settled how many.
//!
//! `RAYSCOPE_SWEEP` sets the number of rays in all (5000 without it), `RAYSCOPE_SEED` the seed.

use std::collections::BTreeMap;
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

    fn add(&mut self, other: &Self) {
        self.rays += other.rays;
        self.misses += other.misses;
        self.tangents += other.tangents;
        for (&stage, count) in &other.last {
            *self.last.entry(stage).or_default() += count;
        }
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

/// The families swept on all processors, each in parts of a seed of its own.
fn sweep(rays: usize, seed: u64) -> Vec<(&'static Family, Tally)> {
    let threads = thread::available_parallelism().map_or(1, usize::from);
    let each = rays.div_ceil(Family::ALL.len() * threads);
    let part = |thread: usize| {
        Family::ALL
            .iter()
            .map(|family| Tally::of(family, seed.wrapping_add(thread as u64), each))
            .collect::<Vec<_>>()
    };
    let parts: Vec<Vec<Tally>> = thread::scope(|scope| {
        let running: Vec<_> = (0..threads)
            .map(|thread| scope.spawn(move || part(thread)))
            .collect();
        running
            .into_iter()
            .map(|running| running.join().expect("a disagreement, shown above"))
            .collect()
    });
    Family::ALL
        .iter()
        .enumerate()
        .map(|(i, family)| {
            let mut total = Tally::default();
            for part in &parts {
                total.add(&part[i]);
            }
            (family, total)
        })
        .collect()
}

#[test]
fn agrees_with_the_truth_on_every_family() {
    let rays = from_environment("RAYSCOPE_SWEEP", 5000) as usize;
    let seed = from_environment("RAYSCOPE_SEED", 1);
    let tallies = sweep(rays, seed);

    println!(
        "{:18} {:>9} {:>9} {:>9}  settled by",
        "family", "rays", "misses", "tangents"
    );
    for (family, tally) in &tallies {
        print!(
            "{:18} {:9} {:9} {:9} ",
            family.name, tally.rays, tally.misses, tally.tangents
        );
        for stage in Stage::ALL {
            print!(" {stage} {}", tally.of_stage(stage));
        }
        println!();
    }
}
