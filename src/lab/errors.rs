//! How wrong the answers of a method are on a set of rays: wrong answers by kind first, then ulps
//! over the rays where method and truth agree. Nothing here is averaged, nothing is timed.

use std::ops::AddAssign;

use serde::ser::{Serialize, SerializeStruct as _, Serializer};

use super::Problem;
use super::reference::{Reference, ReferenceRoot};
use crate::geometry::{Ray, Sphere};
use crate::method::{Class, Solution};

/// What is wrong with an answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Fault {
    /// The line misses; the method says that it meets the sphere.
    FalseHit,
    /// The line meets the sphere; the method says that it misses.
    FalseMiss,
    /// A tangent taken for a secant, or a secant for a tangent.
    WrongCount,
    /// No answer: the discriminant is not a number, or a root is NaN or an infinity that the exact
    /// root does not round to.
    NotFinite,
}

impl Fault {
    /// All faults, in the order of reports.
    pub const ALL: [Self; 4] = [
        Self::FalseHit,
        Self::FalseMiss,
        Self::WrongCount,
        Self::NotFinite,
    ];

    /// The words for it on the screen.
    pub const fn name(self) -> &'static str {
        match self {
            Self::FalseHit => "false hit",
            Self::FalseMiss => "false miss",
            Self::WrongCount => "wrong count",
            Self::NotFinite => "not finite",
        }
    }
}

/// One answer held against the truth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Judgement {
    /// The class is wrong or a root is no number; each answer has one fault at most, the class
    /// being looked at first.
    Wrong(Fault),
    /// Class and finiteness are right; the error of the worse root, none for a miss and for roots
    /// that are rightly infinite.
    Agreed(Option<RootError>),
}

/// The error of the worse root of one answer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RootError {
    /// |answer − root| in units of the spacing of binary32 at the exact root.
    pub ulps: f64,
    /// What the method gave.
    pub answer: f32,
    /// The exact root rounded to binary32.
    pub exact: f32,
}

/// Holds one answer against the truth.
pub fn judge(truth: &Reference, answer: &Solution) -> Judgement {
    use Class::{Hit, Miss, Nan, Secant, Tangent};
    match (truth.class, answer.class) {
        (_, Nan) => Judgement::Wrong(Fault::NotFinite),
        (Miss, Hit) if answer.near <= 0.0 => Judgement::Agreed(None),
        (Miss, Tangent | Secant | Hit) => Judgement::Wrong(Fault::FalseHit),
        // Behind the eye, what looks at the ray alone may well see nothing.
        (Tangent | Secant, Miss) if answer.tells_of_ray_alone() && truth.visible().is_none() => {
            Judgement::Agreed(None)
        }
        (Tangent | Secant, Hit) => judge_hit(truth, answer),
        (Tangent | Secant, Miss) => Judgement::Wrong(Fault::FalseMiss),
        (Tangent, Secant) | (Secant, Tangent) => Judgement::Wrong(Fault::WrongCount),
        _ => judge_roots(truth, answer),
    }
}

/// Of a routine that says that it hits, and gives one t at most: it is the one that is seen.
fn judge_hit(truth: &Reference, answer: &Solution) -> Judgement {
    let t = answer.near;
    match truth.visible() {
        _ if t.is_nan() => Judgement::Agreed(None),
        Some(_) if t <= 0.0 => Judgement::Wrong(Fault::FalseMiss),
        None if t > 0.0 => Judgement::Wrong(Fault::FalseHit),
        Some(root) => judge_root(root, t).map_or_else(Judgement::Wrong, Judgement::Agreed),
        None => Judgement::Agreed(None),
    }
}

fn judge_roots(truth: &Reference, answer: &Solution) -> Judgement {
    let mut worse: Option<RootError> = None;
    for (root, answer) in truth.roots.iter().flatten().zip([answer.near, answer.far]) {
        match judge_root(root, answer) {
            Err(fault) => return Judgement::Wrong(fault),
            Ok(Some(error)) if worse.is_none_or(|worse| error.ulps > worse.ulps) => {
                worse = Some(error);
            }
            Ok(_) => {}
        }
    }
    Judgement::Agreed(worse)
}

fn judge_root(root: &ReferenceRoot, answer: f32) -> Result<Option<RootError>, Fault> {
    if answer.is_infinite() && answer == root.rounded {
        Ok(None)
    } else if answer.is_finite() {
        Ok(Some(RootError {
            ulps: root.ulps(answer),
            answer,
            exact: root.rounded,
        }))
    } else {
        Err(Fault::NotFinite)
    }
}

/// Numbers of rays, by what is wrong with the answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct FaultCounts {
    /// Of the rays that miss: those said to meet the sphere.
    pub false_hit: usize,
    /// Of the rays that meet the sphere: those said to miss.
    pub false_miss: usize,
    /// Of the rays that meet the sphere: tangents taken for secants and the reverse.
    pub wrong_count: usize,
    /// Of all rays: those without an answer, or with a root that is wrongly NaN or infinite.
    pub not_finite: usize,
}

impl FaultCounts {
    /// The number of rays with this fault.
    pub const fn of(&self, fault: Fault) -> usize {
        match fault {
            Fault::FalseHit => self.false_hit,
            Fault::FalseMiss => self.false_miss,
            Fault::WrongCount => self.wrong_count,
            Fault::NotFinite => self.not_finite,
        }
    }

    /// The number of rays whose hit or miss is wrong: what the tutorial's rule would draw wrongly.
    pub const fn hit_or_miss(&self) -> usize {
        self.false_hit + self.false_miss
    }

    /// The number of rays with any fault.
    pub const fn total(&self) -> usize {
        self.false_hit + self.false_miss + self.wrong_count + self.not_finite
    }
}

impl Serialize for FaultCounts {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut fields = serializer.serialize_struct("FaultCounts", 5)?;
        fields.serialize_field("false_hit", &self.false_hit)?;
        fields.serialize_field("false_miss", &self.false_miss)?;
        fields.serialize_field("wrong_count", &self.wrong_count)?;
        fields.serialize_field("not_finite", &self.not_finite)?;
        fields.serialize_field("hit_or_miss", &self.hit_or_miss())?;
        fields.end()
    }
}

impl AddAssign<Fault> for FaultCounts {
    fn add_assign(&mut self, fault: Fault) {
        *match fault {
            Fault::FalseHit => &mut self.false_hit,
            Fault::FalseMiss => &mut self.false_miss,
            Fault::WrongCount => &mut self.wrong_count,
            Fault::NotFinite => &mut self.not_finite,
        } += 1;
    }
}

/// Percentiles of the error in ulps, by nearest rank; all 0 for an empty set.
#[derive(Debug, Clone, Copy, PartialEq, Default, serde::Serialize)]
pub struct Percentiles {
    /// Half of the errors are at most this.
    pub p50: f64,
    /// 99 % are at most this.
    pub p99: f64,
    /// 99.9 % are at most this.
    pub p999: f64,
    /// The largest found.
    pub max: f64,
}

impl Percentiles {
    /// The percentiles of a set, which is sorted on the way.
    pub fn of(values: &mut [f64]) -> Self {
        values.sort_by(f64::total_cmp);
        Self {
            p50: nearest_rank(values, 1, 2),
            p99: nearest_rank(values, 99, 100),
            p999: nearest_rank(values, 999, 1000),
            max: nearest_rank(values, 1, 1),
        }
    }
}

/// The least value of a sorted list that `part` of `whole` of the list do not exceed; 0 for none.
pub(super) fn nearest_rank(sorted: &[f64], part: usize, whole: usize) -> f64 {
    let rank = (sorted.len() * part).div_ceil(whole);
    sorted.get(rank.saturating_sub(1)).copied().unwrap_or(0.0)
}

/// How many rays of a set do what, by the truth.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize)]
pub struct Census {
    /// All rays.
    pub rays: usize,
    /// Those whose line misses the sphere.
    pub miss: usize,
    /// Those whose line touches it.
    pub tangent: usize,
    /// Those whose line crosses it.
    pub secant: usize,
}

impl Census {
    /// Counts the classes of a set.
    pub fn of(references: &[Reference]) -> Self {
        let count = |class| references.iter().filter(|r| r.class == class).count();
        Self {
            rays: references.len(),
            miss: count(Class::Miss),
            tangent: count(Class::Tangent),
            secant: count(Class::Secant),
        }
    }

    /// The rays whose line meets the sphere.
    pub const fn meet(&self) -> usize {
        self.tangent + self.secant
    }

    /// Of how many rays a fault is a fault: its denominator.
    pub const fn denominator(&self, fault: Fault) -> usize {
        match fault {
            Fault::FalseHit => self.miss,
            Fault::FalseMiss | Fault::WrongCount => self.meet(),
            Fault::NotFinite => self.rays,
        }
    }
}

/// The answer with the largest error found, and what was asked.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Worst {
    /// The ray and the sphere.
    pub problem: Problem,
    /// The error of the worse root.
    pub error: RootError,
}

/// The errors of one method on one set of rays.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Errors {
    /// Wrong answers by kind.
    pub wrong: FaultCounts,
    /// The first wrong answer of the set: what was asked, and what is wrong.
    pub first_wrong: Option<(Problem, Fault)>,
    /// The error of the worse root, over the rays where method and truth agree that there are
    /// roots within the range.
    pub ulp: Percentiles,
    /// How many rays these percentiles are of.
    pub judged: usize,
    /// The largest error found; none if no ray was judged.
    pub worst: Option<Worst>,
    /// A hash of all answers, bit for bit (every NaN counting as the same).
    pub checksum: Checksum,
}

impl Errors {
    /// Asks `solve` about each problem and holds its answers against the truth, problem by problem.
    pub fn of(
        problems: &[Problem],
        references: &[Reference],
        solve: impl Fn(&Ray, &Sphere) -> Solution,
    ) -> Self {
        let answers = problems.iter().map(|(ray, sphere)| solve(ray, sphere));
        Self::of_answers(problems, references, answers)
    }

    /// Holds answers, one for each problem, against the truth.
    pub fn of_answers(
        problems: &[Problem],
        references: &[Reference],
        answers: impl IntoIterator<Item = Solution>,
    ) -> Self {
        let mut errors = Self::default();
        let mut ulps = Vec::with_capacity(problems.len());
        for ((problem, truth), answer) in problems.iter().zip(references).zip(answers) {
            errors.checksum.add(&answer);
            match judge(truth, &answer) {
                Judgement::Wrong(fault) => {
                    errors.wrong += fault;
                    errors.first_wrong.get_or_insert((*problem, fault));
                }
                Judgement::Agreed(Some(error)) => {
                    ulps.push(error.ulps);
                    if errors.worst.is_none_or(|w| error.ulps > w.error.ulps) {
                        let problem = *problem;
                        errors.worst = Some(Worst { problem, error });
                    }
                }
                Judgement::Agreed(None) => {}
            }
        }
        errors.judged = ulps.len();
        errors.ulp = Percentiles::of(&mut ulps);
        errors
    }
}

/// A hash of answers (FNV-1a over 32-bit words): the same answers in the same order, the same hash.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Checksum(u64);

impl Default for Checksum {
    fn default() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }
}

impl Checksum {
    /// Takes in one answer. Which NaN it is does not count: processors differ in that.
    pub fn add(&mut self, answer: &Solution) {
        self.mix(answer.class as u32);
        for root in [answer.near, answer.far] {
            let canonical = if root.is_nan() { f32::NAN } else { root };
            self.mix(canonical.to_bits());
        }
    }

    /// Takes in another checksum.
    pub fn combine(&mut self, other: Self) {
        self.mix(other.0 as u32);
        self.mix((other.0 >> 32) as u32);
    }

    const fn mix(&mut self, word: u32) {
        self.0 = (self.0 ^ word as u64).wrapping_mul(0x0000_0100_0000_01b3);
    }
}

impl std::fmt::Display for Checksum {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{:016x}", self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentiles_are_values_that_occur() {
        let mut thousand: Vec<f64> = (1..=1000).rev().map(f64::from).collect();
        let Percentiles {
            p50,
            p99,
            p999,
            max,
        } = Percentiles::of(&mut thousand);
        assert_eq!([p50, p99, p999, max], [500.0, 990.0, 999.0, 1000.0]);
        assert_eq!(Percentiles::of(&mut []), Percentiles::default());
        assert_eq!(Percentiles::of(&mut [3.0, 1.0, 2.0]).p50, 2.0);
    }
}
