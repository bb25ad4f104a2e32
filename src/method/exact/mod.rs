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
mod double_double;
mod error_free;
mod integer;
mod plain;
mod real;
mod rounding;

use std::cmp::Ordering;
use std::fmt;

pub use binary64::{Bounded, Discriminant, Estimate, Roots};

use super::{Class, Coefficients, Precision, Solution};
use crate::geometry::{Ray, Sphere};
use binary64::{Input, U};
use double_double::Doubled;
use integer::Exact;
use plain::Plain;
use rounding::{Quadratic, Which};

/// The ways of `exact`, in the order in which they are tried.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Stage {
    /// Stage 1: binary64 with certified bounds.
    Binary64,
    /// Still stage 1, with the rounding errors of C added back.
    Compensated,
    /// The short way for small whole numbers: integers of 64 and 128 bits.
    Plain,
    /// Stage 2: numbers of about 106 bits, with certified bounds.
    DoubleDouble,
    /// Stage 3: integers of 576 and 1152 bits, exact for every input.
    Integer,
}

impl Stage {
    /// All stages, in the order in which they are tried.
    pub const ALL: [Self; 5] = [
        Self::Binary64,
        Self::Compensated,
        Self::Plain,
        Self::DoubleDouble,
        Self::Integer,
    ];

    /// The name on the screen and in files.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Binary64 => "binary64",
            Self::Compensated => "compensated",
            Self::Plain => "plain",
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
}

/// What one stage found: its quantities with their bounds, and what they settle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Findings {
    /// Which stage.
    pub stage: Stage,
    /// A, b, C and D with bounds on their errors.
    pub estimate: Estimate<f64>,
    /// The class, if the stage is sure of the sign of D.
    pub class: Option<Class>,
    /// Both roots with bounds on their errors, if there are any.
    pub roots: Option<Roots<f64>>,
    /// The smaller root in binary32, if the stage is sure of its rounding or was not asked for it.
    pub near: Option<f32>,
    /// The larger root in binary32, if the stage is sure of its rounding or was not asked for it.
    pub far: Option<f32>,
}

/// One run of `exact`, with the very quantities that decided it.
#[derive(Debug, Clone, PartialEq)]
pub struct Record {
    /// The answer.
    pub solution: Solution,
    /// Which stage settled what.
    pub stages: Stages,
    /// o, A, A r², |o × d|² and D of stage 1.
    pub discriminant: Discriminant<f64>,
    /// What each stage found that was asked, stage 1 first.
    pub findings: Vec<Findings>,
}

/// The exact class, and both roots rounded once to binary32 (nearest, ties to even, ±∞ past the
/// range, +0 for what rounds to zero), for finite numbers, d ≠ 0 and r ≥ 0.
pub fn solve(ray: &Ray, sphere: &Sphere) -> Solution {
    let input = Input::new(ray, sphere);
    first(&input).answer().unwrap_or_else(|| beyond(&input))
}

/// The answer of [`solve`], and which stage settled what.
pub fn solve_staged(ray: &Ray, sphere: &Sphere) -> (Solution, Stages) {
    let input = Input::new(ray, sphere);
    settle(&input, &first(&input), |_| ())
}

/// The answer of [`solve`], and all that led to it.
pub fn record(ray: &Ray, sphere: &Sphere) -> Record {
    let input = Input::new(ray, sphere);
    let first = first(&input);
    let mut findings = Vec::with_capacity(Stage::ALL.len());
    let (solution, stages) = settle(&input, &first, |found| findings.push(*found));
    Record {
        solution,
        stages,
        discriminant: first.discriminant,
        findings,
    }
}

/// A, B, C and Δ, each the exact value rounded once to binary64.
pub fn coefficients(ray: &Ray, sphere: &Sphere) -> Coefficients {
    let input = Input::new(ray, sphere);
    let Estimate {
        a, half_b, c, d, ..
    } = match Plain::of(&input) {
        Some(plain) => plain.estimate(),
        None => Exact::new(&input).estimate(),
    };
    Coefficients {
        precision: Precision::Binary64,
        a,
        b: 2.0 * half_b,
        c,
        discriminant: 4.0 * d,
    }
}

/// What stage 1 found, before any compensation.
#[derive(Debug, Clone, Copy)]
struct First {
    discriminant: Discriminant<f64>,
    findings: Findings,
}

impl First {
    #[inline(always)]
    fn answer(&self) -> Option<Solution> {
        let Findings {
            class, near, far, ..
        } = self.findings;
        match class? {
            Class::Miss => Some(Solution::MISS),
            class => Some(Solution {
                class,
                near: near?,
                far: far?,
            }),
        }
    }
}

#[inline(always)]
fn first(input: &Input<f64>) -> First {
    let discriminant = binary64::discriminant(input);
    let estimate = binary64::estimate(input, &discriminant);
    let threshold = 4.0 * discriminant.d_error;
    let class = if discriminant.d > threshold {
        Some(Class::Secant)
    } else if discriminant.d < -threshold {
        Some(Class::Miss)
    } else {
        None
    };
    let roots = (class == Some(Class::Secant)).then(|| binary64::roots(&estimate));
    First {
        discriminant,
        findings: Findings {
            stage: Stage::Binary64,
            estimate,
            class,
            roots,
            near: roots.and_then(|roots| rounding::by_bound(roots.near)),
            far: roots.and_then(|roots| rounding::by_bound(roots.far)),
        },
    }
}

/// The answer where stage 1 left something open.
#[cold]
#[inline(never)]
fn beyond(input: &Input<f64>) -> Solution {
    settle(input, &first(input), |_| ()).0
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
        self.near = self.near.or(found.near.map(|near| (near, by)));
        self.far = self.far.or(found.far.map(|far| (far, by)));
    }

    fn complete(&self) -> Option<(Solution, Stages)> {
        let (class, by) = self.class?;
        if class == Class::Miss {
            let stages = Stages {
                class: by,
                near: None,
                far: None,
            };
            return Some((Solution::MISS, stages));
        }
        let (near, near_by) = self.near?;
        let (far, far_by) = self.far?;
        let stages = Stages {
            class: by,
            near: Some(near_by),
            far: Some(far_by),
        };
        Some((Solution { class, near, far }, stages))
    }
}

/// Asks stage after stage until all is settled; `see` is shown what each one found.
fn settle(input: &Input<f64>, first: &First, mut see: impl FnMut(&Findings)) -> (Solution, Stages) {
    let mut answer = Answer::default();
    for stage in Stage::ALL {
        if let Some(found) = ask(stage, input, first, &answer) {
            see(&found);
            answer.learn(&found);
        }
        if let Some(complete) = answer.complete() {
            return complete;
        }
    }
    // Only what is no ray or sphere gets here: the last stage answers every question.
    let stages = Stages {
        class: Stage::Integer,
        near: None,
        far: None,
    };
    (Solution::without_roots(Class::Nan), stages)
}

/// What a stage finds for the parts still open; none if it has nothing to say of this input.
fn ask(stage: Stage, input: &Input<f64>, first: &First, answer: &Answer) -> Option<Findings> {
    if !first.discriminant.is_of_ray_and_sphere() {
        return None;
    }
    match stage {
        Stage::Binary64 => Some(first.findings),
        Stage::Compensated => compensated(input, &first.findings),
        Stage::Plain => Plain::of(input).map(|plain| consult(stage, &plain, answer)),
        Stage::DoubleDouble => Some(consult(stage, &Doubled::new(input), answer)),
        Stage::Integer => Some(consult(stage, &Exact::new(input), answer)),
    }
}

/// Stage 1 once more, with the better C, if roots are what it left open.
fn compensated(input: &Input<f64>, first: &Findings) -> Option<Findings> {
    first.roots?;
    let (c, c_error) = binary64::compensated_c(input);
    let estimate = Estimate {
        c,
        c_error,
        ..first.estimate
    };
    let roots = binary64::roots(&estimate);
    Some(Findings {
        stage: Stage::Compensated,
        estimate,
        class: first.class,
        roots: Some(roots),
        near: rounding::by_bound(roots.near),
        far: rounding::by_bound(roots.far),
    })
}

/// What a stage beyond the first knows of the parts still open.
fn consult(stage: Stage, quadratic: &impl Quadratic, answer: &Answer) -> Findings {
    let estimate = quadratic.estimate();
    let class = quadratic.discriminant().map(|sign| match sign {
        Ordering::Less => Class::Miss,
        Ordering::Equal => Class::Tangent,
        Ordering::Greater => Class::Secant,
    });
    let roots = match class {
        Some(Class::Tangent) => Some(double_root(&estimate)),
        Some(Class::Secant) => Some(binary64::roots(&estimate)),
        _ => None,
    };
    let rounded =
        |which, root: fn(&Roots<f64>) -> Bounded<f64>, known: Option<(f32, Stage)>| match known {
            Some((known, _)) => Some(known),
            None => rounding::by_signs(which, root(&roots?), quadratic),
        };
    Findings {
        stage,
        estimate,
        class,
        roots,
        near: rounded(Which::Near, |roots| roots.near, answer.near),
        far: rounded(Which::Far, |roots| roots.far, answer.far),
    }
}

/// The two equal roots −b/A of D = 0, b and A being rounded once.
fn double_root(estimate: &Estimate<f64>) -> Roots<f64> {
    let value = -estimate.half_b / estimate.a;
    let root = Bounded {
        value,
        error: 6.0 * U * value.abs(),
    };
    Roots {
        s: 0.0,
        q: estimate.half_b.abs(),
        near: root,
        far: root,
    }
}
