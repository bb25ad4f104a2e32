//! What `exact` costs, as ratios to `textbook` in the same run: `cargo bench --bench cost`.
//!
//! Every entrant solves the same rays in the same order, in rounds whose order is shuffled; a ratio
//! is the median of the rounds' ratios. Inputs are made before the clock starts.

use std::hint::black_box;
use std::time::Instant;

use rayscope::geometry::{Ray, Sphere};
use rayscope::lab::{Family, Random};
use rayscope::method::{Method, Solution, exact};

const RAYS: usize = 4096;
const ROUNDS: usize = 61;

/// Nanoseconds a ray.
fn time(rays: &[(Ray, Sphere)], run: impl Fn(&[(Ray, Sphere)])) -> f64 {
    let start = Instant::now();
    run(rays);
    start.elapsed().as_secs_f64() * 1e9 / rays.len() as f64
}

fn singly(method: Method) -> impl Fn(&[(Ray, Sphere)]) {
    move |rays| {
        let mut sum = 0;
        for (ray, sphere) in rays {
            sum += checksum(method.solve(black_box(ray), black_box(sphere)));
        }
        black_box(sum);
    }
}

/// Something of every part of an answer. (To hand the whole to `black_box` would time how a
/// structure travels through memory.)
fn checksum(solution: Solution) -> u64 {
    let roots = u64::from(solution.near.to_bits()) + u64::from(solution.far.to_bits());
    roots + solution.class as u64
}

fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

fn shuffle<T>(items: &mut [T], random: &mut Random) {
    for i in (1..items.len()).rev() {
        items.swap(i, random.below(i as u64 + 1) as usize);
    }
}

/// The longest median time of any single ray, in nanoseconds.
fn worst(rays: &[(Ray, Sphere)]) -> f64 {
    let mut worst = 0.0_f64;
    for (ray, sphere) in rays {
        let mut times = [0.0; 9];
        for time in &mut times {
            let start = Instant::now();
            for _ in 0..16 {
                black_box(checksum(exact::solve(black_box(ray), black_box(sphere))));
            }
            *time = start.elapsed().as_secs_f64() * 1e9 / 16.0;
        }
        worst = worst.max(median(&mut times));
    }
    worst
}

fn main() {
    let mut random = Random::new(1);
    let entrants = [Method::Textbook, Method::Double, Method::Exact];
    println!("ns a call, median of {ROUNDS} rounds of {RAYS} rays; ratio to textbook, median");
    println!(
        "{:18}{:>10}{:>10}{:>10}{:>16}{:>10}",
        "family", "textbook", "double", "exact", "exact/textbook", "worst"
    );
    // Cargo passes --bench; any other argument is the name of a family to keep to.
    let names: Vec<_> = std::env::args()
        .skip(1)
        .filter(|name| !name.starts_with('-'))
        .collect();
    let wanted =
        |family: &&Family| names.is_empty() || names.iter().any(|name| name == family.name);
    for family in Family::ALL.iter().filter(wanted) {
        let rays = family.sample(1, RAYS);
        let mut times = [const { Vec::new() }; 3];
        for _ in 0..ROUNDS {
            let mut order = [0, 1, 2];
            shuffle(&mut order, &mut random);
            for i in order {
                times[i].push(time(&rays, singly(entrants[i])));
            }
        }
        let mut ratios: Vec<f64> = times[2].iter().zip(&times[0]).map(|(x, t)| x / t).collect();
        let worst = worst(&rays);
        print!("{:18}", family.name);
        for times in &mut times {
            print!("{:10.1}", median(times));
        }
        println!("{:16.2}{worst:10.0}", median(&mut ratios));
    }
}
