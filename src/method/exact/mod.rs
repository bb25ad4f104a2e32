//! The exact method: the right class and both roots rounded once, for every finite binary32 input.
//!
//! Stage 1 computes in binary64 with certified bounds and settles almost every ray. What it leaves
//! open goes to a short way for plain cases, to double-double, and to exact integers, in this
//! order. docs/exactness.md derives the bounds.

#![expect(
    clippy::inline_always,
    reason = "stage 1 is one formula in many functions: it runs, and in lanes vectorises, only whole"
)]

mod binary64;
#[cfg(test)]
mod bounds;
mod double_double;
mod error_free;
mod integer;
pub(super) mod lanes;
mod real;
mod rounding;
#[cfg(test)]
mod small_format;
mod whole;

use std::cmp::Ordering;
use std::fmt;

pub use binary64::{Bounded, Direct, Discriminant, Estimate, U};

use super::{Class, Coefficients, Place, Precision, Solution, Which};
use crate::geometry::{Ray, Sphere};
pub(super) use binary64::Input;
use double_double::Doubled;
use integer::IntegerQuadratic;
use rounding::Quadratic;
use whole::Whole;

/// The ways of `exact`, in the order in which they are tried.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Stage {
    /// Stage 1: binary64, with the class certified and the roots by (−b ± s)/A.
    Binary64,
    /// Stage 1 for small whole numbers, for which it rounds nothing but √ and ÷.
    Unrounded,
    /// Still binary64: C with its rounding errors added back, the roots by q and certified bounds.
    Compensated,
    /// A short way for whole numbers of up to 30 bits: integers of 64 and 128 bits.
    Whole,
    /// Stage 2: numbers of about 106 bits, with certified bounds.
    DoubleDouble,
    /// Stage 3: integers of 576 and 1152 bits, exact for every input.
    Integer,
}

impl Stage {
    /// All stages, in the order in which they are tried.
    pub const ALL: [Self; 6] = [
        Self::Binary64,
        Self::Unrounded,
        Self::Compensated,
        Self::Whole,
        Self::DoubleDouble,
        Self::Integer,
    ];

    /// The name on the screen and in files.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Binary64 => "binary64",
            Self::Unrounded => "unrounded",
            Self::Compensated => "compensated",
            Self::Whole => "whole",
            Self::DoubleDouble => "double-double",
            Self::Integer => "integer",
        }
    }
}

impl fmt::Display for Stage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// Which stage settled each part of an answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Stages {
    /// The stage that was sure of the sign of Δ.
    pub class: Stage,
    /// The stage that was sure of the smaller root's rounding; none without roots.
    pub near: Option<Stage>,
    /// The stage that was sure of the larger root's rounding; none without roots.
    pub far: Option<Stage>,
}

impl Stages {
    /// The slowest stage that was needed.
    pub fn last(&self) -> Stage {
        self.class
            .max(self.near.unwrap_or(self.class))
            .max(self.far.unwrap_or(self.class))
    }

    const fn without_roots(class: Stage) -> Self {
        Self {
            class,
            near: None,
            far: None,
        }
    }
}

/// A root as one stage has it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Root {
    /// The root in binary64, with a bound on its error.
    pub bounded: Bounded<f64>,
    /// The root rounded once to binary32; none if this stage cannot tell, or an earlier one had.
    pub settled: Option<f32>,
}

/// What one stage found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Findings {
    /// Which stage.
    pub stage: Stage,
    /// The class, if the stage is sure of the sign of D.
    pub class: Option<Class>,
    /// A, b, C and D with bounds on their errors; none in stage 1, which needs no C, and where a
    /// stage cannot even tell the class.
    pub estimate: Option<Estimate<f64>>,
    /// The smaller and the larger root, if there are any.
    pub roots: Option<[Root; 2]>,
}

/// One run of `exact`, with the very quantities that decided it.
#[derive(Debug, Clone, PartialEq)]
pub struct Record {
    /// The answer.
    pub solution: Solution,
    /// Which stage settled what.
    pub stages: Stages,
    /// o, A, A r², |o × d|² and D of stage 1, with the bound on the error of D.
    pub discriminant: Discriminant<f64>,
    /// b, s and both roots of stage 1, if it is sure that there are two.
    pub direct: Option<Direct<f64>>,
    /// What each stage found that was asked, stage 1 first.
    pub findings: Vec<Findings>,
}

/// The exact class, and both roots rounded once to binary32 (nearest, ties to even, ±∞ past the
/// range, +0 for what rounds to zero), for finite numbers, d ≠ 0 and r ≥ 0.
#[inline(always)]
pub fn solve(ray: &Ray, sphere: &Sphere) -> Solution {
    let input = Input::new(ray, sphere, f64::from);
    let discriminant = binary64::discriminant(&input);
    match discriminant.class() {
        Some(Class::Miss) => return Solution::MISS,
        Some(class) => {
            let direct = binary64::direct(&input, &discriminant);
            if let [Some(near), Some(far)] = settled(&direct, &discriminant) {
                return placed(&input, class, near, far);
            }
        }
        None => {}
    }
    beyond(&input, &discriminant)
}

/// The answer of [`solve`], and which stage settled what.
pub fn solve_staged(ray: &Ray, sphere: &Sphere) -> (Solution, Stages) {
    let input = Input::new(ray, sphere, f64::from);
    let discriminant = binary64::discriminant(&input);
    settle(&Stage::ALL, &input, &discriminant, |_| ())
}

/// The answer of [`solve`], and all that led to it.
pub fn record(ray: &Ray, sphere: &Sphere) -> Record {
    let input = Input::new(ray, sphere, f64::from);
    let discriminant = binary64::discriminant(&input);
    let mut findings = Vec::with_capacity(Stage::ALL.len());
    let (solution, stages) = settle(&Stage::ALL, &input, &discriminant, |found| {
        findings.push(*found);
    });
    Record {
        solution,
        stages,
        discriminant,
        direct: (discriminant.class() == Some(Class::Secant))
            .then(|| binary64::direct(&input, &discriminant)),
        findings,
    }
}

/// The answer with these roots. Rounding is monotone, so they say where the sphere lies, unless one of
/// them rounds to 0.
#[inline(always)]
fn placed(input: &Input<f64>, class: Class, near: f32, far: f32) -> Solution {
    let place = if near == 0.0 || far == 0.0 {
        place(input)
    } else {
        Place::by_roots(near, far)
    };
    Solution::placed(class, near, far, place)
}

/// Where a sphere lies that the line meets, by exact signs: the roots have the product C/A and the sum
/// −2b/A.
#[cold]
#[inline(never)]
fn place(input: &Input<f64>) -> Place {
    let Estimate { half_b, c, .. } = exact_estimate(input);
    if c < 0.0 || (c == 0.0 && half_b < 0.0) {
        Place::Inside
    } else if half_b < 0.0 {
        Place::Hit
    } else {
        Place::Behind
    }
}

/// A, b, C and D, each the exact value rounded once to binary64, whose sign it has.
fn exact_estimate(input: &Input<f64>) -> Estimate<f64> {
    match Whole::of(input) {
        Some(whole) => whole.estimate(),
        None => IntegerQuadratic::new(input).estimate(),
    }
}

/// A, B, C and Δ, each the exact value rounded once to binary64.
pub fn coefficients(ray: &Ray, sphere: &Sphere) -> Coefficients {
    let Estimate {
        a, half_b, c, d, ..
    } = exact_estimate(&Input::new(ray, sphere, f64::from));
    Coefficients {
        precision: Precision::Binary64,
        a,
        b: 2.0 * half_b,
        c,
        discriminant: 4.0 * d,
    }
}

/// The answer where stage 1 left something open.
#[cold]
#[inline(never)]
fn beyond(input: &Input<f64>, discriminant: &Discriminant<f64>) -> Solution {
    let stages = &Stage::ALL[1..];
    settle(stages, input, discriminant, |_| ()).0
}

/// What is settled so far, each part with the stage that settled it.
#[derive(Debug, Clone, Copy, Default)]
struct Answer {
    class: Option<(Class, Stage)>,
    near: Option<(f32, Stage)>,
    far: Option<(f32, Stage)>,
}

impl Answer {
    fn learn(&mut self, found: &Findings) {
        let by = found.stage;
        self.class = self.class.or(found.class.map(|class| (class, by)));
        if let Some([near, far]) = found.roots {
            self.near = self.near.or(near.settled.map(|t| (t, by)));
            self.far = self.far.or(far.settled.map(|t| (t, by)));
        }
    }

    fn complete(&self, input: &Input<f64>) -> Option<(Solution, Stages)> {
        match (self.class?, self.near, self.far) {
            ((Class::Miss, by), ..) => Some((Solution::MISS, Stages::without_roots(by))),
            ((class, by), Some((near, near_by)), Some((far, far_by))) => {
                let stages = Stages {
                    class: by,
                    near: Some(near_by),
                    far: Some(far_by),
                };
                Some((placed(input, class, near, far), stages))
            }
            _ => None,
        }
    }
}

/// Asks stage after stage until all is settled; `see` is shown what each one found.
#[inline(always)]
fn settle(
    stages: &[Stage],
    input: &Input<f64>,
    discriminant: &Discriminant<f64>,
    mut see: impl FnMut(&Findings),
) -> (Solution, Stages) {
    let mut answer = Answer::default();
    if discriminant.is_of_ray_and_sphere() {
        for &stage in stages {
            if let Some(found) = ask(stage, input, discriminant, &answer) {
                see(&found);
                answer.learn(&found);
            }
            if let Some(complete) = answer.complete(input) {
                return complete;
            }
        }
    }
    // Only what is no ray or sphere gets here: the last stage answers every question.
    let stages = Stages::without_roots(Stage::Binary64);
    (Solution::without_roots(Class::Nan), stages)
}

/// What a stage finds for the parts still open; none if it has nothing to say of this input.
///
/// Each stage is a function of its own, never inlined: the compiler would find its first steps
/// independent of the loop over stages, and take all of them for every ray.
fn ask(
    stage: Stage,
    input: &Input<f64>,
    discriminant: &Discriminant<f64>,
    open: &Answer,
) -> Option<Findings> {
    match stage {
        Stage::Binary64 => Some(in_binary64(input, discriminant)),
        Stage::Unrounded => unrounded(input, discriminant),
        Stage::Compensated => compensated(input, discriminant),
        Stage::Whole => whole(input, open),
        Stage::DoubleDouble => Some(double_double(input, open)),
        Stage::Integer => Some(integer(input, open)),
    }
}

/// Stage 1, as [`solve`] runs it.
#[inline(never)]
fn in_binary64(input: &Input<f64>, discriminant: &Discriminant<f64>) -> Findings {
    let class = discriminant.class();
    Findings {
        stage: Stage::Binary64,
        class,
        estimate: None,
        roots: (class == Some(Class::Secant)).then(|| {
            let direct = binary64::direct(input, discriminant);
            let bounded = direct.roots(discriminant);
            let settled = settled(&direct, discriminant);
            [0, 1].map(|i| Root {
                bounded: bounded[i],
                settled: settled[i],
            })
        }),
    }
}

/// The smaller and the larger root, each if all within its bound rounds alike.
#[inline(always)]
fn settled(direct: &Direct<f64>, discriminant: &Discriminant<f64>) -> [Option<f32>; 2] {
    let certain = discriminant.d_error < direct.d_error_limit;
    [direct.near, direct.far].map(|bounds| {
        let [t, too] = bounds.map(rounding::round);
        (certain && t == too).then_some(t)
    })
}

#[inline(never)]
fn unrounded(input: &Input<f64>, discriminant: &Discriminant<f64>) -> Option<Findings> {
    let estimate = whole::unrounded(input, discriminant)?;
    let sign = estimate.d.partial_cmp(&0.0);
    let settle = |_, bounded| rounding::by_bound(bounded);
    Some(consult(Stage::Unrounded, sign, estimate, settle))
}

/// Binary64 once more, with the better C, if roots are what was left open.
#[inline(never)]
fn compensated(input: &Input<f64>, discriminant: &Discriminant<f64>) -> Option<Findings> {
    let class = discriminant.class()?;
    let estimate = binary64::compensated(input, discriminant);
    let roots = binary64::roots(&estimate);
    Some(Findings {
        stage: Stage::Compensated,
        class: Some(class),
        estimate: Some(estimate),
        roots: Some([roots.near(), roots.far()].map(settled_by_bound)),
    })
}

fn settled_by_bound(bounded: Bounded<f64>) -> Root {
    Root {
        bounded,
        settled: rounding::by_bound(bounded),
    }
}

#[inline(never)]
fn whole(input: &Input<f64>, open: &Answer) -> Option<Findings> {
    Whole::of(input).map(|whole| ask_for_signs(Stage::Whole, &whole, open))
}

#[inline(never)]
fn double_double(input: &Input<f64>, open: &Answer) -> Findings {
    match Doubled::new(input) {
        Some(doubled) => ask_for_signs(Stage::DoubleDouble, &doubled, open),
        None => Findings {
            stage: Stage::DoubleDouble,
            class: None,
            estimate: None,
            roots: None,
        },
    }
}

#[inline(never)]
fn integer(input: &Input<f64>, open: &Answer) -> Findings {
    ask_for_signs(Stage::Integer, &IntegerQuadratic::new(input), open)
}

/// What a stage that can answer questions of sign knows of the parts still open.
fn ask_for_signs(stage: Stage, quadratic: &impl Quadratic, open: &Answer) -> Findings {
    let (sign, estimate) = (quadratic.discriminant(), quadratic.estimate());
    consult(stage, sign, estimate, |which, bounded| {
        let known = match which {
            Which::Near => open.near,
            Which::Far => open.far,
        };
        match known {
            Some(_) => None,
            None => rounding::by_signs(which, bounded, quadratic),
        }
    })
}

/// What follows from the sign of D, the estimates, and a way to round.
#[inline(always)]
fn consult(
    stage: Stage,
    sign: Option<Ordering>,
    estimate: Estimate<f64>,
    settle: impl Fn(Which, Bounded<f64>) -> Option<f32>,
) -> Findings {
    let class = sign.map(|sign| match sign {
        Ordering::Less => Class::Miss,
        Ordering::Equal => Class::Tangent,
        Ordering::Greater => Class::Secant,
    });
    let roots = match class {
        Some(Class::Secant) => Some(binary64::roots(&estimate)),
        Some(Class::Tangent) => Some(binary64::double_root(&estimate)),
        _ => None,
    };
    let root = |which, bounded| Root {
        bounded,
        settled: settle(which, bounded),
    };
    Findings {
        stage,
        class,
        estimate: Some(estimate),
        roots: roots.map(|roots| {
            [
                root(Which::Near, roots.near()),
                root(Which::Far, roots.far()),
            ]
        }),
    }
}
