//! The truth of one ray and one sphere, condensed for many questions: what any number of answers
//! are held against. The truth itself is [`crate::method::Truth`].

use super::Problem;
use crate::method::{Class, Precision, Solution, Surd, Truth, Which};
use crate::number::power_of_two;

/// The exact class and, unless it is a miss, both exact roots.
#[derive(Debug, Clone, PartialEq)]
pub struct Reference {
    /// Miss, tangent or secant.
    pub class: Class,
    /// D = Δ/4, rounded once to binary64.
    pub quarter_discriminant: f64,
    /// The near and the far root.
    pub roots: Option<[ReferenceRoot; 2]>,
    /// The class, where the sphere lies, and both roots rounded once to binary32.
    pub solution: Solution,
}

/// An exact root, to more than a hundred bits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReferenceRoot {
    /// The root rounded to binary64.
    high: f64,
    /// What that leaves of it, rounded to binary64.
    low: f64,
    /// The spacing of binary32 at the root, a power of two.
    ulp: f64,
    /// The root rounded once to binary32.
    pub rounded: f32,
    /// κ, the condition: ∞ for a tangent, none for t = 0.
    pub condition: Option<f64>,
}

impl Reference {
    /// The truth about one problem.
    pub fn new((ray, sphere): &Problem) -> Self {
        let truth = Truth::new(ray, sphere);
        let root = |root: Option<Surd>| root.map(|root| ReferenceRoot::new(&truth, &root));
        Self {
            class: truth.class(),
            solution: truth.solution(),
            quarter_discriminant: Surd::from(truth.quarter_discriminant.clone()).to_f64(),
            roots: root(truth.near())
                .zip(root(truth.far()))
                .map(<[_; 2]>::from),
        }
    }

    /// The truth about each problem, in order, on as many threads as the machine has cores.
    pub fn all(problems: &[Problem]) -> Vec<Self> {
        let threads = std::thread::available_parallelism().map_or(1, usize::from);
        let share = problems.len().div_ceil(threads).max(1);
        let mut references = vec![Self::MISS; problems.len()];
        std::thread::scope(|scope| {
            for (problems, references) in problems.chunks(share).zip(references.chunks_mut(share)) {
                scope.spawn(move || {
                    for (problem, reference) in problems.iter().zip(references) {
                        *reference = Self::new(problem);
                    }
                });
            }
        });
        references
    }

    const MISS: Self = Self {
        class: Class::Miss,
        quarter_discriminant: f64::NEG_INFINITY,
        roots: None,
        solution: Solution::MISS,
    };

    /// The root that is seen: the least t > 0.
    pub fn visible(&self) -> Option<&ReferenceRoot> {
        let [near, far] = self.roots.as_ref()?;
        Some(match self.solution.place()?.visible_root()? {
            Which::Near => near,
            Which::Far => far,
        })
    }
}

impl ReferenceRoot {
    fn new(truth: &Truth, root: &Surd) -> Self {
        let high = root.to_f64();
        // A root of binary32 inputs is far from both ends of binary64: `high` is finite.
        let rest = Surd::from_f64(high).and_then(|high| root.checked_sub(&high));
        Self {
            high,
            low: rest.map_or(0.0, |rest| rest.to_f64()),
            ulp: power_of_two(root.ulp_exponent(Precision::Binary32) as i32),
            rounded: root.to_f32(),
            condition: truth.condition(root),
        }
    }

    /// The root to the nearest binary64.
    pub const fn value(&self) -> f64 {
        self.high
    }

    /// |value − root|, correct to a few units in the last place of binary64.
    pub fn distance(&self, value: impl Into<f64>) -> f64 {
        ((value.into() - self.high) - self.low).abs()
    }

    /// The error of an answer in units of the spacing of binary32 at the exact root.
    pub fn ulps(&self, value: impl Into<f64>) -> f64 {
        self.distance(value) / self.ulp
    }

    /// The blame of an answer: relative error over κu; 0 where the answer is correctly rounded,
    /// none for t = 0.
    pub fn blame(&self, answer: f32) -> Option<f64> {
        let condition = self.condition?;
        if answer == self.rounded {
            return Some(0.0);
        }
        Some(self.distance(answer) / self.high.abs() / (condition * UNIT_ROUNDOFF))
    }
}

/// u = 2⁻²⁴, the unit roundoff of binary32.
const UNIT_ROUNDOFF: f64 = f32::EPSILON as f64 / 2.0;
