//! The derivation of one answer, step by step: what a method did, what it would have got without
//! rounding, and which operation lost how many bits.
//!
//! A trace runs the method's own code over a number that keeps record; it has no second
//! implementation of any formula.

mod build;
pub(super) mod exact;
mod loss;
#[cfg(not(feature = "routine"))]
#[path = "trace/no_routine.rs"]
pub(super) mod routine;
#[cfg(feature = "routine")]
pub(super) mod routine;

use std::borrow::Cow;
use std::fmt;

pub(super) use build::{A, BB, C, HALF_B, O, OO, RR, StepText, Steps};
pub use loss::{Loss, LossKind};

use super::format::{self, Shortest};
use super::statement::in_c;
use super::surd::Surd;
use super::truth::Truth;
use super::{Class, Method, Place, Precision, Solution};
use crate::geometry::{Ray, Sphere};
use crate::text::Glyphs;

/// A number beside what it should be.
#[derive(Debug, Clone)]
pub struct Measured {
    /// The number as the method has it.
    pub value: f64,
    /// Of which numbers it is one.
    pub precision: Precision,
    /// What it would be without any rounding; none where there is no such number, as for the root
    /// of a Δ that is exactly negative.
    pub exact: Option<Surd>,
}

impl Measured {
    /// The error in units of the spacing at the exact value; none without an exact value.
    pub fn ulps(&self) -> Option<f64> {
        self.ulps_in(self.precision)
    }

    /// The error in units of the spacing of another precision at the exact value.
    pub fn ulps_in(&self, precision: Precision) -> Option<f64> {
        let exact = self.exact.as_ref()?;
        Some(exact.ulps(self.value, precision))
    }

    /// Whether the number is what it should be, to the last bit there is.
    pub fn is_exact(&self) -> bool {
        self.ulps() == Some(0.0) && self.value.is_finite()
    }

    /// Whether the number is the exact value rounded once.
    pub fn is_correctly_rounded(&self) -> bool {
        let exact = self.exact.as_ref();
        exact.is_some_and(|exact| exact.round(self.precision) == self.value)
    }

    /// How far off the number is, in ulps; as a number where the exact value is 0, which has none, and in
    /// words where it is past the range or no number. None if it is right, or if there is nothing to hold
    /// it to.
    pub fn error_text(&self, glyphs: Glyphs) -> Option<String> {
        let ulps = self.ulps().filter(|&ulps| ulps != 0.0)?;
        Some(if self.value.is_nan() {
            "not a number".into()
        } else if self.value.is_infinite() {
            "past the range".into()
        } else if self.exact.as_ref().is_some_and(Surd::is_zero) {
            let off = format::binary64(self.value.abs(), glyphs).rounded(3);
            format!("{off} off 0")
        } else {
            error_text(ulps, self.precision, glyphs)
        })
    }

    /// The shortest decimal that reads back as the number.
    pub fn shortest(&self, glyphs: Glyphs) -> Shortest {
        Shortest {
            value: self.value,
            precision: self.precision,
            glyphs,
        }
    }

    /// The exact value to at most `digits` digits; none without one.
    pub fn exact_text(&self, digits: usize, glyphs: Glyphs) -> Option<String> {
        Some(format::exact(self.exact.as_ref()?, digits, glyphs))
    }
}

/// What a step gives.
#[derive(Debug, Clone)]
pub enum Quantity {
    /// A number.
    Scalar(Measured),
    /// A vector, component by component.
    Vector(Box<[Measured]>),
    /// Yes or no.
    Whether(bool),
    /// A whole number.
    Count(i64),
}

impl Quantity {
    /// The number, or the three components.
    pub fn parts(&self) -> &[Measured] {
        match self {
            Self::Scalar(one) => std::slice::from_ref(one),
            Self::Vector(components) => components,
            Self::Whether(_) | Self::Count(_) => &[],
        }
    }

    /// The greatest error of its parts in ulps; none if one has no exact value.
    pub fn ulps(&self) -> Option<f64> {
        self.parts()
            .iter()
            .map(Measured::ulps)
            .try_fold(0.0, |worst: f64, ulps| {
                let ulps = ulps?;
                Some(if ulps.is_nan() || ulps > worst {
                    ulps
                } else {
                    worst
                })
            })
    }

    /// In what its numbers are held.
    pub fn precision(&self) -> Precision {
        self.parts()
            .first()
            .map_or(Precision::Binary32, |part| part.precision)
    }

    /// The number, or the components in parentheses, as shortest decimals.
    pub fn text(&self, glyphs: Glyphs) -> String {
        self.join(|part| part.shortest(glyphs).to_string())
    }

    /// The exact value, or the components in parentheses, to at most `digits` digits each; none if
    /// one is missing.
    pub fn exact_text(&self, digits: usize, glyphs: Glyphs) -> Option<String> {
        let complete = self.parts().iter().all(|part| part.exact.is_some());
        complete.then(|| self.join(|part| part.exact_text(digits, glyphs).unwrap_or_default()))
    }

    /// What it would be without rounding, and how far off it is; nothing if it is right, or if there is no
    /// such thing.
    pub fn error_sentence(&self, digits: usize, glyphs: Glyphs) -> Option<String> {
        self.ulps().filter(|&ulps| ulps != 0.0)?;
        let exact = self.exact_text(digits, glyphs)?;
        let size = |part: &&Measured| part.ulps().unwrap_or(0.0);
        let worst = self
            .parts()
            .iter()
            .max_by(|x, y| size(x).total_cmp(&size(y)))?;
        let off = worst.error_text(glyphs)?;
        Some(if off.ends_with("ulp") || off.ends_with("ulp64") {
            format!("{exact}, {off} off")
        } else {
            format!("{exact}: {off}")
        })
    }

    fn join(&self, text: impl Fn(&Measured) -> String) -> String {
        match self {
            Self::Scalar(one) => text(one),
            Self::Vector(components) => {
                let components: Vec<_> = components.iter().map(text).collect();
                format!("({})", components.join(", "))
            }
            Self::Whether(yes) => if *yes { "true" } else { "false" }.to_owned(),
            Self::Count(count) => count.to_string(),
        }
    }
}

/// One step of a derivation.
#[derive(Debug, Clone)]
pub struct TraceStep {
    /// What the result is called: `A`, `Δ`, `near`.
    pub symbol: Cow<'static, str>,
    /// How it is computed: `B² − 4AC`.
    pub formula: Cow<'static, str>,
    /// The formula with the numbers of this ray and sphere: `(−40)² − 4·1·300`.
    pub numbers: String,
    /// What came out.
    pub result: Quantity,
    /// One sentence on what the step is for.
    pub why: Cow<'static, str>,
    /// The line of the program that does it.
    pub code: Cow<'static, str>,
    /// What the operations of this step lost, the worst first.
    pub losses: Vec<Loss>,
}

impl TraceStep {
    /// The line of the program as a whole statement in C; a routine's own line as it is.
    pub fn statement(&self) -> String {
        match &self.code {
            Cow::Borrowed(line) => in_c(line, self.result.precision()),
            Cow::Owned(line) => line.clone(),
        }
    }

    /// The greatest number of bits that one operation of this step lost.
    pub fn bits_lost(&self) -> u32 {
        self.losses.iter().map(Loss::bits).max().unwrap_or(0)
    }

    /// Whether an operation of this step lost so much that it shows in the answer: half of what a
    /// number holds, or all by leaving the range.
    pub fn loses_much(&self) -> bool {
        self.losses.iter().any(Loss::is_heavy)
    }
}

/// The derivation of one answer.
#[derive(Debug, Clone)]
pub struct Trace {
    /// The method that was run.
    pub method: Method,
    /// Its answer.
    pub solution: Solution,
    /// The right answer.
    pub truth: Solution,
    /// A = d·d.
    pub a: Measured,
    /// B = 2 d·(p0 − c).
    pub b: Measured,
    /// C = (p0 − c)·(p0 − c) − r².
    pub c: Measured,
    /// Δ = B² − 4AC.
    pub discriminant: Measured,
    /// The smaller root; none if the method sees none. It has no exact value if there is none.
    pub near: Option<Measured>,
    /// The larger root, likewise.
    pub far: Option<Measured>,
    /// The steps in the order in which they were done.
    pub steps: Vec<TraceStep>,
}

impl Trace {
    pub(super) fn new(method: Method, ray: &Ray, sphere: &Sphere) -> Self {
        let solution = method.solve(ray, sphere);
        let k = method.coefficients(ray, sphere);
        let truth = Truth::new(ray, sphere);
        let steps = method.steps(ray, sphere, &truth);
        let measured = |value, exact| Measured {
            value,
            precision: k.precision,
            exact: Some(Surd::from(exact)),
        };
        let root = |value: f32, exact| {
            // A routine need not give both.
            let given = solution.class.meets() && (solution.class != Class::Hit || !value.is_nan());
            given.then(|| Measured {
                value: value.into(),
                precision: Precision::Binary32,
                exact,
            })
        };
        let far = root(solution.far, truth.far());
        // The one root that a routine gives is the one that is seen.
        let inside = truth.solution().place() == Some(Place::Inside);
        let near = if solution.class == Class::Hit && inside {
            root(solution.near, truth.far())
        } else {
            root(solution.near, truth.near())
        };
        Self {
            method,
            solution,
            truth: truth.solution(),
            a: measured(k.a, truth.a.clone()),
            b: measured(k.b, truth.b()),
            c: measured(k.c, truth.c.clone()),
            discriminant: measured(k.discriminant, truth.discriminant()),
            near,
            far,
            steps,
        }
    }

    /// What the operations of a step lost, the worst first; the first step to lose much says that it is.
    pub fn loss_sentences(&self, step: usize, glyphs: Glyphs) -> Vec<String> {
        let losses = &self.steps[step].losses;
        let mut sentences: Vec<_> = losses.iter().map(|loss| loss.sentence(glyphs)).collect();
        if let (true, Some(worst)) = (self.first_heavy_loss() == Some(step), sentences.first_mut())
        {
            worst.push_str(": the first step to lose much");
        }
        sentences
    }

    /// The step of that symbol.
    pub fn step(&self, symbol: &str) -> Option<&TraceStep> {
        self.steps.iter().find(|step| step.symbol == symbol)
    }

    /// The first step that lost much; its place in the list.
    pub fn first_heavy_loss(&self) -> Option<usize> {
        self.steps.iter().position(TraceStep::loses_much)
    }

    fn is_behind_and_one(&self) -> bool {
        let behind = self.truth.place() == Some(Place::Behind);
        behind && self.method.gives_one_at_most()
    }

    /// What is wrong with the class, in a sentence; nothing if it is right.
    pub fn verdict(&self, glyphs: Glyphs) -> Option<String> {
        let (said, right) = (self.solution.class, self.truth.class);
        if said == right || said == Class::Hit && right.meets() {
            return None;
        }
        // One that is behind the eye may be no hit to a routine, which sees one t at most.
        if said == Class::Miss && self.is_behind_and_one() {
            return None;
        }
        if self.method.is_routine() {
            let name = self.method;
            let exact = self.discriminant.exact_text(8, glyphs).unwrap_or_default();
            let delta = glyphs.spell("Δ");
            return Some(format!(
                "{name} says {said}, but exactly it is a {right}: {delta} is {exact}."
            ));
        }
        let found = self.discriminant.shortest(glyphs);
        let exact = self.discriminant.exact_text(8, glyphs).unwrap_or_default();
        let delta = glyphs.spell("Δ");
        Some(format!(
            "{} says {said}, but {}: exactly, {delta} is {exact} and not {found}.",
            self.method,
            match right {
                Class::Miss => "the line misses the sphere",
                Class::Tangent => "the line touches the sphere",
                Class::Secant | Class::Hit | Class::Nan => "the line crosses the sphere",
            },
        ))
    }
}

/// Writes the derivation as text, a paragraph for each step.
///
/// `digits` is how many digits exact values are shown to.
pub fn write(
    trace: &Trace,
    out: &mut impl fmt::Write,
    glyphs: Glyphs,
    digits: usize,
) -> fmt::Result {
    for (i, step) in trace.steps.iter().enumerate() {
        let symbol = glyphs.spell(&step.symbol);
        let numbers = glyphs.spell(&step.numbers);
        writeln!(out, "{symbol} = {}", glyphs.spell(&step.formula))?;
        let result = step.result.text(glyphs);
        writeln!(out, "    {numbers} {} {result}", glyphs.spell("→"))?;
        writeln!(out, "    {}", glyphs.spell(&step.why))?;
        let statement = step.statement();
        if !statement.is_empty() {
            writeln!(out, "    {statement}")?;
        }
        if let Some(error) = step.result.error_sentence(digits, glyphs) {
            writeln!(out, "    exactly {error}")?;
        } else if step.result.ulps().is_none() {
            writeln!(out, "    exactly, there is none")?;
        }
        for loss in trace.loss_sentences(i, glyphs) {
            writeln!(out, "    {loss}")?;
        }
        writeln!(out)?;
    }
    Ok(())
}

/// An error to three digits, with its unit: that of the precision.
pub fn error_text(ulps: f64, precision: Precision, glyphs: Glyphs) -> String {
    let count = format::binary64(ulps, glyphs).rounded(3);
    format!("{count} {}", precision.unit())
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn any_bits() -> impl Strategy<Value = f32> {
        any::<u32>()
            .prop_map(f32::from_bits)
            .prop_filter("finite", |x| x.is_finite())
    }

    /// Few bits and near exponents: hits and tangents turn up often.
    fn small() -> impl Strategy<Value = f32> {
        (-20_i16..=20, -2_i32..=2).prop_map(|(m, e)| f32::from(m) * 2.0_f32.powi(e))
    }

    /// A ray and a sphere of any bits, of small numbers, in ordinary places, and far away.
    fn question() -> impl Strategy<Value = (Ray, Sphere)> {
        prop_oneof![
            prop::array::uniform10(any_bits()),
            prop::array::uniform10(small()),
            prop::array::uniform10(-3.0_f32..3.0),
            prop::array::uniform10(prop_oneof![small(), any_bits(), Just(0.0)]),
            prop::array::uniform10(-3.0_f32..3.0).prop_map(|mut x| {
                x[0] = 1e5 * x[3];
                x[1] = 1e5 * x[4];
                x[2] = 1e5 * x[5];
                x
            }),
        ]
        .prop_filter_map("d = 0", |x| {
            let at = |i: usize| glam::Vec3::from_slice(&x[i..]);
            let ray = Ray::new(at(0), at(3)).ok()?;
            Some((ray, Sphere::new(at(6), x[9].abs()).ok()?))
        })
    }

    fn same(x: f64, y: f64) -> bool {
        x.to_bits() == y.to_bits() || x.is_nan() && y.is_nan()
    }

    /// The step that holds a coefficient, and the factor by which it differs from it.
    fn steps_of(method: Method) -> [(&'static str, f64); 4] {
        match method {
            Method::Textbook | Method::Contracted => {
                [("A", 1.0), ("B", 1.0), ("C", 1.0), ("Δ", 1.0)]
            }
            _ => [("A", 1.0), ("b", 2.0), ("C", 1.0), ("D", 4.0)],
        }
    }

    proptest! {
        /// The steps are the operations that gave the answer.
        #[test]
        fn a_traced_run_is_the_plain_run_bit_for_bit((ray, sphere) in question()) {
            for method in Method::ALL {
                let trace = method.trace(&ray, &sphere);
                prop_assert_eq!(trace.solution.class, method.solve(&ray, &sphere).class);
                let k = method.coefficients(&ray, &sphere);
                let wanted = [k.a, k.b, k.c, k.discriminant];
                for ((symbol, factor), wanted) in steps_of(method).into_iter().zip(wanted) {
                    if method == Method::Exact {
                        // Its coefficients are rounded from the exact ones; its steps are stage 1.
                        break;
                    }
                    let part = &trace.step(symbol).unwrap().result.parts()[0];
                    let found = match part.precision {
                        Precision::Binary32 => f64::from(part.value as f32 * factor as f32),
                        Precision::Binary64 => part.value * factor,
                    };
                    prop_assert!(same(found, wanted), "{method} {symbol}: {found} {wanted}");
                }
                if trace.solution.class.meets() {
                    let roots = [("near", trace.solution.near), ("far", trace.solution.far)];
                    for (symbol, root) in roots {
                        let found = trace.step(symbol).unwrap().result.parts()[0].value + 0.0;
                        prop_assert!(same(found, root.into()), "{method} {symbol}");
                    }
                }
            }
        }

        /// What a step calls exact is what the truth has.
        #[test]
        fn exact_values_are_the_truths((ray, sphere) in question()) {
            has_the_truths(&ray, &sphere);
        }

        /// Nothing in a derivation or its text panics, and no number is missing from a formula.
        #[test]
        fn every_number_of_a_formula_is_there((ray, sphere) in question()) {
            for method in Method::ALL {
                let trace = method.trace(&ray, &sphere);
                for step in &trace.steps {
                    prop_assert!(!step.numbers.contains(['?', '{', '}']), "{}", step.numbers);
                }
                let mut text = String::new();
                write(&trace, &mut text, Glyphs::Ascii, 10).unwrap();
                prop_assert!(text.is_ascii(), "{text}");
            }
        }
    }

    fn has_the_truths(ray: &Ray, sphere: &Sphere) {
        let truth = Truth::new(ray, sphere);
        let wanted = [
            truth.a.clone(),
            truth.b(),
            truth.c.clone(),
            truth.discriminant(),
        ];
        for method in Method::ALL {
            let trace = method.trace(ray, sphere);
            for ((symbol, factor), wanted) in steps_of(method).into_iter().zip(&wanted) {
                let Some(step) = trace.step(symbol) else {
                    // `exact` asks no more than it needs.
                    assert!(method == Method::Exact);
                    continue;
                };
                let part = &step.result.parts()[0];
                let factor = Surd::from_f64(factor).unwrap();
                let found = part.exact.as_ref().unwrap().checked_mul(&factor).unwrap();
                let off = found.checked_sub(&Surd::from(wanted.clone())).unwrap();
                assert!(off.is_zero(), "{method} {symbol}");
            }
        }
    }

    /// However many bits that takes: 2^±149 squared, and divided by one another, is a long number.
    #[test]
    fn exact_values_of_the_greatest_beside_the_least_are_the_truths() {
        let far = Ray::new([0.0; 3].into(), [0.0, 4.275_554e34, 0.0].into()).unwrap();
        let sphere = Sphere::new([0.0, 0.0, 1e-45].into(), 2.922_076_4e37).unwrap();
        has_the_truths(&far, &sphere);
        let ray = Ray::new([3e38, 1e-45, 0.3].into(), [1e-45, 3e38, 0.7].into()).unwrap();
        has_the_truths(
            &ray,
            &Sphere::new([1e-45, 0.1, 3e38].into(), 1e-45).unwrap(),
        );
    }

    fn trace(method: Method, p0: [f32; 3], d: [f32; 3], center: [f32; 3], r: f32) -> Trace {
        let ray = Ray::new(p0.into(), d.into()).unwrap();
        method.trace(&ray, &Sphere::new(center.into(), r).unwrap())
    }

    /// Where the methods' source is.
    fn source(method: Method) -> String {
        [
            match method {
                Method::Textbook => include_str!("textbook.rs"),
                Method::Contracted => include_str!("contracted.rs"),
                Method::Unit => include_str!("unit.rs"),
                Method::Citardauq => include_str!("citardauq.rs"),
                Method::Haines => include_str!("haines.rs"),
                Method::Kahan => include_str!("kahan.rs"),
                Method::Double => include_str!("double.rs"),
                Method::Exact => include_str!("exact/binary64.rs"),
                Method::Routine(_) => unreachable!("not built in"),
            },
            match method {
                Method::Exact => include_str!("exact/mod.rs"),
                Method::Contracted => include_str!("textbook.rs"),
                _ => include_str!("q_form.rs"),
            },
        ]
        // What a file says of its steps does not count.
        .map(|file| {
            let lines = file.lines().filter(|line| !line.contains('"'));
            lines.collect::<Vec<_>>().join("\n")
        })
        .concat()
    }

    #[test]
    fn the_lines_of_code_are_those_that_run() {
        for method in Method::ALL {
            let source = source(method);
            let places = [
                [[-3.0, 0.5, 0.0], [1.0, 0.0, 0.0]],
                [[3.0, 0.5, 0.0], [1.0, 0.0, 0.0]],
                [[3.0, 1.0, 0.0], [1.0, 0.0, 0.0]],
                [[0.0, 1.0, 0.0], [1.0, 0.0, 0.0]],
                [[-3.0, 1.0, 0.0], [1.0, 1e-45, 0.0]],
                [[-16_777_218.0, 1e-30, 0.0], [1.0, 0.0, 0.0]],
                [[0.7, 0.714_142_8, 1e-30], [1.0, 0.1, 0.0]],
                [[1.000_000_1, 0.0, 0.0], [-1.0, 0.0, 0.0]],
            ];
            let mut asked = Vec::new();
            for [p0, d] in places {
                let steps = trace(method, p0, d, [0.0; 3], 1.0).steps;
                assert!(!steps.is_empty());
                for step in steps {
                    assert!(source.contains(&*step.code), "{method}: {}", step.code);
                    asked.push(step.symbol.clone().into_owned());
                }
            }
            let stages = ["D, unrounded", "C, compensated", "D, in whole numbers"];
            let slow = ["D, double-double", "D, integers"];
            if method == Method::Exact {
                for stage in stages.iter().chain(&slow) {
                    assert!(
                        asked.iter().any(|asked| asked == stage),
                        "no ray here asks for {stage}"
                    );
                }
            }
        }
    }

    #[test]
    fn substitutes_the_tutorials_numbers() {
        let trace = trace(
            Method::Textbook,
            [20.0, 20.0, 0.0],
            [0.0, 0.0, 1.0],
            [20.0; 3],
            10.0,
        );
        let shown: Vec<_> = trace
            .steps
            .iter()
            .map(|s| {
                (
                    &*s.symbol,
                    s.numbers.as_str(),
                    s.result.text(Glyphs::Unicode),
                )
            })
            .collect();
        let expected = [
            ("o", "(20, 20, 0) − (20, 20, 20)", "(0, 0, −20)"),
            ("A", "0² + 0² + 1²", "1"),
            ("B", "2·(0·0 + 0·0 + 1·(−20))", "−40"),
            ("|o|²", "0² + 0² + (−20)²", "400"),
            ("r²", "10²", "100"),
            ("C", "400 − 100", "300"),
            ("B²", "(−40)²", "1600"),
            ("4AC", "4·1·300", "1200"),
            ("Δ", "1600 − 1200", "400"),
            ("√Δ", "√400", "20"),
            ("near", "(−(−40) − 20) / (2·1)", "10"),
            ("far", "(−(−40) + 20) / (2·1)", "30"),
        ];
        assert_eq!(shown, expected.map(|(s, n, r)| (s, n, r.to_owned())));
        assert!(trace.steps.iter().all(|s| s.result.ulps() == Some(0.0)));
        assert!(trace.steps.iter().all(|s| s.losses.is_empty()));
        assert_eq!(trace.verdict(Glyphs::Ascii), None);
    }

    fn said(trace: &Trace, symbol: &str) -> Vec<String> {
        let losses = &trace.step(symbol).unwrap().losses;
        losses
            .iter()
            .map(|loss| loss.sentence(Glyphs::Ascii))
            .collect()
    }

    #[test]
    fn names_the_step_that_loses_the_far_sphere() {
        let lost = trace(
            Method::Textbook,
            [-4100.0, 0.5, 0.0],
            [1.0, 0.0, 0.0],
            [0.0; 3],
            1.0,
        );
        assert_eq!(said(&lost, "C"), ["r^2 vanishes beside |o|^2"]);
        assert_eq!(lost.steps[lost.first_heavy_loss().unwrap()].symbol, "C");
        assert_eq!(
            said(&lost, "Δ"),
            ["B^2 and 4AC: all 24 leading bits cancel, none is left"]
        );
        assert_eq!(
            lost.verdict(Glyphs::Ascii).unwrap(),
            "textbook says tangent, but the line crosses the sphere: exactly, disc is 3 and not 0."
        );
        let kept = trace(
            Method::Double,
            [-4100.0, 0.5, 0.0],
            [1.0, 0.0, 0.0],
            [0.0; 3],
            1.0,
        );
        assert_eq!(kept.verdict(Glyphs::Ascii), None);
        assert_eq!(kept.first_heavy_loss(), None);
    }

    #[test]
    fn names_the_step_that_loses_the_ground() {
        let ground = trace(
            Method::Citardauq,
            [0.0, 1.7, 0.3],
            [0.0, -1.0, 0.1],
            [0.0, -1000.0, 0.0],
            1000.0,
        );
        assert_eq!(
            said(&ground, "C"),
            ["|o|^2 and r^2: 8 leading bits cancel, 16 are left"]
        );
        // The exact root, not the one that the rounded branch would lead to.
        let near = ground.near.clone().unwrap();
        assert!(near.ulps().unwrap() > 1.0);
        assert_eq!(near.exact.unwrap().to_f32(), ground.truth.near);
    }

    #[test]
    fn exact_says_which_stage_settled_what() {
        let plain = trace(
            Method::Exact,
            [-3.0, 0.5, 0.25],
            [1.0, 0.0, 0.0],
            [0.0; 3],
            1.0,
        );
        assert!(
            plain
                .step("bound")
                .unwrap()
                .numbers
                .ends_with("the sign of D is certain")
        );
        assert_eq!(plain.step("near").unwrap().numbers, "settled by binary64");
        let tangent = trace(
            Method::Exact,
            [-3.0, 1.0, 0.0],
            [1.0, 0.0, 0.0],
            [0.0; 3],
            1.0,
        );
        assert!(
            tangent
                .step("bound")
                .unwrap()
                .numbers
                .ends_with("the sign of D is open")
        );
        let unrounded = tangent.step("D, unrounded").unwrap();
        // What a stage loses is said, though a later one makes it good.
        let ground = trace(
            Method::Exact,
            [0.0, 0.001, 0.1],
            [0.0, -1.0, 0.0],
            [0.0, -1e6, 0.0],
            1e6,
        );
        let lost = &ground.step("near₆₄").unwrap().losses[0];
        let said = lost.sentence(Glyphs::Unicode);
        assert!(said.starts_with("−b and √D: 2"), "{said}");
        assert_eq!(unrounded.numbers, "tangent, near 3, far 3");
        let tilted = trace(
            Method::Exact,
            [-3.0, 1.0, 0.0],
            [1.0, 1e-45, 0.0],
            [0.0; 3],
            1.0,
        );
        assert_eq!(tilted.step("D, integers").unwrap().numbers, "a miss");
        assert_eq!(tilted.truth.class, Class::Miss);
    }

    #[test]
    fn tells_overflow_underflow_and_nan_apart() {
        let over = trace(
            Method::Textbook,
            [-3e20, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [0.0; 3],
            1e20,
        );
        let kinds = |symbol| -> Vec<LossKind> {
            over.step(symbol)
                .unwrap()
                .losses
                .iter()
                .map(|l| l.kind)
                .collect()
        };
        assert_eq!(kinds("|o|²"), [LossKind::Overflowed]);
        assert_eq!(kinds("C"), [LossKind::Invalid]);
        assert_eq!(kinds("Δ"), []);
        let under = trace(
            Method::Textbook,
            [-3.0, 0.0, 0.0],
            [1e-23, 0.0, 0.0],
            [0.0; 3],
            1.0,
        );
        assert_eq!(
            under.step("A").unwrap().losses[0].kind,
            LossKind::Underflowed
        );
    }
}
