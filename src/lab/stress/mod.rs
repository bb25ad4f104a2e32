//! Stability: each dial swept from tame to broken, where each method breaks down, where theory says
//! it should, and what must hold besides.

mod data;
mod invariance;
mod text;
mod theory;

pub use data::{json, records};
pub use invariance::Check;
pub use text::{check_table, markdown, summary_table, sweep_table, text};
pub use theory::AGREEMENT;

use super::dials::Dial;
use super::errors::{Census, Errors, Percentiles};
use super::promise;
use super::reference::{Reference, ReferenceRoot};
use super::second::SecondRays;
use super::{Checksum, Problem};
use crate::geometry::{Ray, Sphere};
pub use crate::method::bits_lost;
use crate::method::{Method, Solution};

/// The most rays of a setting whose second rays are followed.
const MOST_FOLLOWED: usize = 64;

/// One method at one setting of a dial.
#[derive(Debug, Clone, PartialEq)]
pub struct MethodErrors {
    /// What it got wrong.
    pub errors: Errors,
    /// The blame err/(κu) of the worse root, over the rays that are judged.
    pub blame: Percentiles,
    /// What its hits are as points, and as starts of second rays.
    pub second: SecondRays,
    /// Hits that the error moved by more than half a pixel, among the answers that are not wrong.
    pub moved: usize,
}

impl MethodErrors {
    /// Bits that the answers lost: the median.
    pub fn bits_median(&self) -> Option<f64> {
        (self.errors.judged > 0).then(|| bits_lost(self.errors.ulp.p50))
    }

    /// Bits that the answers lost: the worst.
    pub fn bits_worst(&self) -> Option<f64> {
        (self.errors.judged > 0).then(|| bits_lost(self.errors.ulp.max))
    }
}

/// All methods at one setting of a dial.
#[derive(Debug, Clone, PartialEq)]
pub struct DialSetting {
    /// The dial stands at 2^k.
    pub k: i32,
    /// The classes of the rays.
    pub census: Census,
    /// The methods, in the order of the report.
    pub cells: Vec<MethodErrors>,
    /// What rounding the inputs did before any method was asked, where a dial is about that.
    pub inputs: Option<InputRounding>,
}

/// What rounding p0, d, c and r to binary32 did to the exact roots.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InputRounding {
    /// Rays that hit before and miss now, or the reverse.
    pub changed: usize,
    /// How far the worse root moved, in ulp.
    pub ulp: Percentiles,
}

/// One dial, all its settings.
#[derive(Debug, Clone)]
pub struct Sweep {
    /// What was swept.
    pub dial: &'static Dial,
    /// From tame to broken.
    pub steps: Vec<DialSetting>,
}

/// Where a method breaks down on a dial, as exponents k of the dial's value.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Breakdown {
    /// The first setting with a wrong answer that the tame end does not have.
    pub wrong: Option<i32>,
    /// Where theory puts it.
    pub wrong_in_theory: Option<f64>,
    /// The first setting at which a hit moves by more than half a pixel.
    pub moved: Option<i32>,
    /// Where theory puts it.
    pub moved_in_theory: Option<f64>,
}

/// What was promised and how often it was broken.
#[derive(Debug, Clone, PartialEq)]
pub struct Kept {
    /// Whose promise it is.
    pub method: Method,
    /// How many answers were looked at.
    pub asked: usize,
    /// How many broke it.
    pub broken: usize,
    /// The first that did.
    pub first: Option<Problem>,
}

/// A whole run.
#[derive(Debug, Clone)]
pub struct Stability {
    /// The seed of the rays.
    pub seed: u64,
    /// How many rays a setting has.
    pub rays: usize,
    /// The methods, in the order of the report.
    pub methods: Vec<Method>,
    /// The dials that were swept to the end.
    pub sweeps: Vec<Sweep>,
    /// What must hold besides.
    pub checks: Vec<Check>,
    /// The promises of `exact` and `double`, over all rays of all settings.
    pub kept: Vec<Kept>,
    /// Whether all that was asked for is there.
    pub complete: bool,
}

impl Stability {
    /// Whether every promise was kept wherever it was put to the test.
    pub fn promises_kept(&self) -> bool {
        self.kept.iter().all(|kept| kept.broken == 0)
    }

    /// Where the method with that place in the report breaks down on a dial.
    pub fn breakdown(&self, sweep: &Sweep, method: usize) -> Breakdown {
        let first = |count: fn(&MethodErrors) -> usize| {
            let of = |step: &DialSetting| count(&step.cells[method]);
            let tame = sweep.steps.first().map_or(0, of);
            let found = sweep.steps.iter().find(|step| of(step) > tame);
            found.map(|step| step.k)
        };
        let [wrong, moved] = theory::of(sweep.dial.name, self.methods[method], self.rays);
        let in_range = |k: &f64| sweep.dial.reaches(*k);
        Breakdown {
            wrong: first(|cell| cell.errors.wrong.total()),
            wrong_in_theory: wrong.filter(in_range),
            moved: first(|cell| cell.moved),
            moved_in_theory: moved.filter(in_range),
        }
    }

    /// A hash of all answers of all methods.
    pub fn checksum(&self) -> Checksum {
        let mut checksum = Checksum::default();
        let steps = self.sweeps.iter().flat_map(|sweep| &sweep.steps);
        for cell in steps.flat_map(|step| &step.cells) {
            checksum.combine(cell.errors.checksum);
        }
        checksum
    }
}

/// What a run is to do.
#[derive(Debug, Clone)]
pub struct StressPlan {
    /// The methods, in the order of the report.
    pub methods: Vec<Method>,
    /// What to sweep, in the order of the report.
    pub dials: Vec<&'static Dial>,
    /// The seed of the rays.
    pub seed: u64,
    /// How many rays a setting has.
    pub rays: usize,
}

/// Sweeps the dials of a plan and makes the checks.
///
/// `go_on` is asked before each setting, with the number and the name of the dial; once it says
/// no, the report holds what was complete by then.
pub fn run(plan: &StressPlan, mut go_on: impl FnMut(usize, &str) -> bool) -> Stability {
    let mut report = Stability {
        seed: plan.seed,
        rays: plan.rays,
        methods: plan.methods.clone(),
        sweeps: Vec::new(),
        checks: Vec::new(),
        kept: promising(&plan.methods),
        complete: false,
    };
    for (number, &dial) in plan.dials.iter().enumerate() {
        match sweep(plan, dial, &mut report.kept, |name| go_on(number, name)) {
            Some(sweep) => report.sweeps.push(sweep),
            None => return report,
        }
    }
    if go_on(plan.dials.len(), "invariances") {
        report.checks = invariance::checks(&plan.methods, plan.seed);
        report.complete = true;
    }
    report
}

fn promising(methods: &[Method]) -> Vec<Kept> {
    [Method::Exact, Method::Double]
        .into_iter()
        .filter(|method| methods.contains(method))
        .map(|method| Kept {
            method,
            asked: 0,
            broken: 0,
            first: None,
        })
        .collect()
}

fn sweep(
    plan: &StressPlan,
    dial: &'static Dial,
    kept: &mut [Kept],
    mut go_on: impl FnMut(&str) -> bool,
) -> Option<Sweep> {
    let step = |k| {
        if !go_on(dial.name) {
            return None;
        }
        let problems = dial.sample(plan.seed, k, plan.rays);
        let references = Reference::all(&problems);
        for kept in &mut *kept {
            hold_to_promise(kept, &problems, &references);
        }
        let cell =
            |method: &Method| measure(dial, k, &problems, &references, |r, s| method.solve(r, s));
        Some(DialSetting {
            k,
            census: Census::of(&references),
            cells: plan.methods.iter().map(cell).collect(),
            inputs: dial
                .rounds_inputs()
                .then(|| inputs(plan, dial, k, &references)),
        })
    };
    let steps = dial.settings().map(step).collect::<Option<_>>()?;
    Some(Sweep { dial, steps })
}

fn inputs(plan: &StressPlan, dial: &Dial, k: i32, references: &[Reference]) -> InputRounding {
    let intents = dial.sample_with_intent(plan.seed, k, plan.rays);
    let mut changed = 0;
    let mut moved = Vec::new();
    for ((_, intent), truth) in intents.iter().zip(references) {
        match (intent, &truth.roots) {
            (None, None) => {}
            (Some(before), Some(now)) => {
                let ulps = before
                    .iter()
                    .zip(now)
                    .map(|(&before, now)| now.ulps(before));
                moved.extend(ulps.reduce(f64::max));
            }
            _ => changed += 1,
        }
    }
    InputRounding {
        changed,
        ulp: Percentiles::of(&mut moved),
    }
}

fn hold_to_promise(kept: &mut Kept, problems: &[Problem], references: &[Reference]) {
    for (problem, truth) in problems.iter().zip(references) {
        let answer = kept.method.solve(&problem.0, &problem.1);
        kept.asked += 1;
        if promise::kept(kept.method, problem, truth, &answer) == Some(false) {
            kept.broken += 1;
            kept.first.get_or_insert(*problem);
        }
    }
}

/// Holds a way to solve, a method or what a test puts in its place, against the truth at one
/// setting of a dial.
pub fn measure(
    dial: &Dial,
    k: i32,
    problems: &[Problem],
    references: &[Reference],
    solve: impl Fn(&Ray, &Sphere) -> Solution,
) -> MethodErrors {
    let mut blames = Vec::new();
    let mut moved = 0;
    for (problem, truth) in problems.iter().zip(references) {
        let answer = solve(&problem.0, &problem.1);
        if !agrees(truth, &answer) {
            continue;
        }
        blames.extend(blame(truth, &answer));
        let half_pixel = dial.pixel(k) / 2.0 * f64::from(problem.1.radius);
        moved += usize::from(shift(problem, truth, &answer) > half_pixel);
    }
    MethodErrors {
        second: SecondRays::of(&solve, problems, references, MOST_FOLLOWED),
        errors: Errors::of(problems, references, solve),
        blame: Percentiles::of(&mut blames),
        moved,
    }
}

fn agrees(truth: &Reference, answer: &Solution) -> bool {
    use super::errors::{Judgement, judge};
    matches!(judge(truth, answer), Judgement::Agreed(_))
}

/// The blame of the worse root; none for a miss, and where neither root has one.
fn blame(truth: &Reference, answer: &Solution) -> Option<f64> {
    let roots = truth.roots.iter().flatten();
    roots
        .zip([answer.near, answer.far])
        .filter(|(_, answer)| answer.is_finite())
        .filter_map(|(root, answer)| root.blame(answer))
        .reduce(f64::max)
}

/// How far the hit that is seen lies from where it should, in units of the world: ∞ if one of the
/// two is not seen at all.
fn shift((ray, _): &Problem, truth: &Reference, answer: &Solution) -> f64 {
    let length = ray.direction.as_dvec3().length();
    match (truth.visible(), answer.visible()) {
        (None, None) => 0.0,
        (Some(root), Some(found)) if rightly_infinite(root, found) => 0.0,
        (Some(root), Some(found)) => root.distance(found) * length,
        _ => f64::INFINITY,
    }
}

fn rightly_infinite(root: &ReferenceRoot, answer: f32) -> bool {
    answer.is_infinite() && answer == root.rounded
}
