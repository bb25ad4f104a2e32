//! What `exact` costs beside `textbook`, in the same run: `cargo bench --bench cost -- [FAMILY…]`.
//!
//! All entrants solve the same rays in the same order, in rounds whose own order is shuffled; a
//! time is the median of the rounds, a ratio the median of the rounds' ratios. Inputs are made
//! before the clock starts.

use std::hint::black_box;
use std::time::Instant;

use rayscope::geometry::{Ray, Sphere};
use rayscope::lab::Family;
use rayscope::method::batch::{Batch, Scalars, Solutions, Vectors};
use rayscope::method::{Class, Method, Solution, exact};
use rayscope::random::Random;

const RAYS: usize = 4096;
const ROUNDS: usize = 61;

fn main() {
    // Cargo passes --bench; any other argument is the name of a family to keep to.
    let names: Vec<_> = std::env::args()
        .skip(1)
        .filter(|name| !name.starts_with('-'))
        .collect();
    let wanted =
        |family: &&Family| names.is_empty() || names.iter().any(|name| name == family.name);
    let families: Vec<_> = Family::ALL.iter().filter(wanted).collect();
    let mut random = Random::new(1);

    println!("{RAYS} rays a family, {ROUNDS} rounds; ns a ray, and ratios to textbook\n");
    println!("one call a ray; worst: the slowest ray by itself");
    heading(&["textbook", "double", "exact", "ratio", "worst", "hits %"]);
    for family in &families {
        single_calls(family, &mut random);
    }
    println!("\narrays; sse2: exact without AVX2; visible and class: exact, that part alone;");
    println!("eye: exact, one eye and one sphere");
    heading(&[
        "textbook", "exact", "ratio", "sse2", "visible", "class", "eye",
    ]);
    for family in &families {
        batches(family, &mut random);
    }
}

fn heading(columns: &[&str]) {
    print!("{:18}", "family");
    for column in columns {
        print!("{column:>10}");
    }
    println!();
}

fn single_calls(family: &Family, random: &mut Random) {
    let rays = family.sample(1, RAYS);
    let methods = [Method::Textbook, Method::Double, Method::Exact];
    let entrants = methods.map(|method| {
        let rays = &rays;
        move || {
            let solve = |(ray, sphere)| checksum(method.solve(black_box(ray), black_box(sphere)));
            let pairs = rays.iter().map(|(ray, sphere)| (ray, sphere));
            black_box(pairs.map(solve).sum::<u64>());
        }
    });
    let [mut textbook, mut exact] = [Vec::new(), Vec::new()];
    let mut double = Vec::new();
    in_shuffled_rounds(random, 3, |i| {
        let ns = nanoseconds(entrants[i]);
        [&mut textbook, &mut double, &mut exact][i].push(ns);
    });
    let hits = rays
        .iter()
        .filter(|(ray, sphere)| exact::solve(ray, sphere).class.meets())
        .count();
    let ratio = ratio(&exact, &textbook);
    print!("{:18}", family.name);
    print!("{:10.1}{:10.1}", median(textbook), median(double));
    print!("{:10.1}{ratio:10.2}{:10.0}", median(exact), worst(&rays));
    println!("{:10.0}", 100.0 * hits as f64 / rays.len() as f64);
}

fn batches(family: &Family, random: &mut Random) {
    let rays = family.sample(1, RAYS);
    let columns = Columns::of(&rays);
    let batch = columns.batch();
    let eye = Batch {
        origin: rays[0].0.origin,
        direction: columns.vectors(3),
        center: rays[0].1.center,
        radius: rays[0].1.radius,
    };
    let mut out = Solutions::default();
    let mut seen = vec![0.0; RAYS];
    let mut classes = vec![Class::Miss; RAYS];
    let mut times = [const { Vec::new() }; 6];
    in_shuffled_rounds(random, times.len(), |i| {
        let ns = nanoseconds(|| match i {
            0 => black_box(&batch).solve(Method::Textbook, &mut out),
            1 => black_box(&batch).solve(Method::Exact, &mut out),
            2 => black_box(&batch).solve_portably(&mut out),
            3 => black_box(&batch).visible(Method::Exact, &mut seen),
            4 => black_box(&batch).classes(Method::Exact, &mut classes),
            _ => black_box(&eye).solve(Method::Exact, &mut out),
        });
        black_box((&mut out, &mut seen, &mut classes));
        times[i].push(ns);
    });
    let ratio = ratio(&times[1], &times[0]);
    let [textbook, exact, portable, visible, class, eye] = times.map(median);
    print!("{:18}{textbook:10.2}{exact:10.2}", family.name);
    println!("{ratio:10.2}{portable:10.2}{visible:10.2}{class:10.2}{eye:10.2}");
}

/// Runs entrants 0 to n − 1 once each in every round.
fn in_shuffled_rounds(random: &mut Random, n: usize, mut run: impl FnMut(usize)) {
    let mut order: Vec<_> = (0..n).collect();
    for _ in 0..ROUNDS {
        for i in (1..n).rev() {
            order.swap(i, random.below(i as u64 + 1) as usize);
        }
        order.iter().copied().for_each(&mut run);
    }
}

/// The time of one round, for each of its rays.
fn nanoseconds(run: impl FnOnce()) -> f64 {
    let start = Instant::now();
    run();
    start.elapsed().as_secs_f64() * 1e9 / RAYS as f64
}

/// The longest median time of any single ray, in nanoseconds.
fn worst(rays: &[(Ray, Sphere)]) -> f64 {
    const REPEATS: usize = 16;
    let time = |(ray, sphere): &(Ray, Sphere)| {
        let times = (0..9).map(|_| {
            let start = Instant::now();
            for _ in 0..REPEATS {
                black_box(checksum(exact::solve(black_box(ray), black_box(sphere))));
            }
            start.elapsed().as_secs_f64() * 1e9 / REPEATS as f64
        });
        median(times.collect())
    };
    rays.iter().map(time).fold(0.0, f64::max)
}

/// Something of every part of an answer. (To hand the whole to `black_box` would time how a
/// structure travels through memory.)
fn checksum(solution: Solution) -> u64 {
    let roots = u64::from(solution.near.to_bits()) + u64::from(solution.far.to_bits());
    roots + solution.class as u64
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

fn ratio(times: &[f64], base: &[f64]) -> f64 {
    median(times.iter().zip(base).map(|(t, base)| t / base).collect())
}

/// Rays and spheres in arrays.
struct Columns([Vec<f32>; 10]);

impl Columns {
    fn of(rays: &[(Ray, Sphere)]) -> Self {
        Self(std::array::from_fn(|i| {
            let number = |(ray, sphere): &(Ray, Sphere)| match i {
                0..3 => ray.origin[i],
                3..6 => ray.direction[i - 3],
                6..9 => sphere.center[i - 6],
                _ => sphere.radius,
            };
            rays.iter().map(number).collect()
        }))
    }

    fn vectors(&self, i: usize) -> [&[f32]; 3] {
        [&self.0[i], &self.0[i + 1], &self.0[i + 2]]
    }

    fn batch(&self) -> Batch<impl Vectors, impl Vectors, impl Vectors, impl Scalars> {
        Batch {
            origin: self.vectors(0),
            direction: self.vectors(3),
            center: self.vectors(6),
            radius: self.0[9].as_slice(),
        }
    }
}
