//! The derivation of one intersection as JSON; docs/methods.md describes the object.
//!
//! A number of the machine is a JSON number, the shortest that reads back as the same binary32 or
//! binary64, or one of the strings "inf", "-inf", "NaN"; an exact value is a string of decimals.

use serde::{Serialize, Serializer};

use crate::geometry::{Ray, Sphere};
use crate::method::format::{self};

use crate::method::trace::{Loss, LossKind, Measured, Trace, TraceStep};
use crate::method::{Class, Place, Precision, Solution, Surd};
use crate::report;
use crate::text::Glyphs;

/// Digits of exact values.
const DIGITS: usize = 60;

/// The derivation with a line end.
pub(super) fn text(ray: &Ray, sphere: &Sphere, trace: &Trace) -> String {
    report::json(&SolveJson::new(ray, sphere, trace))
}

#[derive(Serialize)]
struct SolveJson<'a> {
    ray: RayOut,
    sphere: SphereOut,
    method: &'static str,
    class: &'static str,
    near: Option<NumberJson>,
    far: Option<NumberJson>,
    place: Option<&'static str>,
    visible: Option<NumberJson>,
    precision: &'static str,
    a: Option<NumberJson>,
    b: Option<NumberJson>,
    c: Option<NumberJson>,
    discriminant: Option<NumberJson>,
    errors: ErrorsJson,
    truth: AnswerJson,
    verdict: Option<String>,
    steps: Vec<StepOut<'a>>,
}

impl<'a> SolveJson<'a> {
    fn new(ray: &Ray, sphere: &Sphere, trace: &'a Trace) -> Self {
        let solution = trace.solution;
        // A routine has no coefficients of these names.
        let named = |measured: &'a Measured| (!trace.method.is_routine()).then_some(measured);
        let AnswerJson { class, near, far } = AnswerJson::new(solution);
        Self {
            ray: RayOut::of(ray),
            sphere: SphereOut::of(sphere),
            method: trace.method.name(),
            class,
            near,
            far,
            place: solution.place().map(Place::name),
            visible: solution.visible().map(NumberJson::binary32),
            precision: precision(trace.a.precision),
            a: named(&trace.a).map(NumberJson::of),
            b: named(&trace.b).map(NumberJson::of),
            c: named(&trace.c).map(NumberJson::of),
            discriminant: named(&trace.discriminant).map(NumberJson::of),
            errors: ErrorsJson {
                a: named(&trace.a).map(ErrorJson::of),
                b: named(&trace.b).map(ErrorJson::of),
                c: named(&trace.c).map(ErrorJson::of),
                discriminant: named(&trace.discriminant).map(ErrorJson::of),
                near: trace.near.as_ref().map(ErrorJson::of),
                far: trace.far.as_ref().map(ErrorJson::of),
            },
            truth: AnswerJson::new(trace.truth),
            verdict: trace.verdict(Glyphs::Ascii),
            steps: trace.steps.iter().map(StepOut::new).collect(),
        }
    }
}

/// A ray as programs read it.
#[derive(Serialize)]
pub(in crate::cli) struct RayOut {
    origin: [f32; 3],
    direction: [f32; 3],
}

/// A sphere as programs read it.
#[derive(Serialize)]
pub(in crate::cli) struct SphereOut {
    center: [f32; 3],
    radius: f32,
}

impl RayOut {
    pub fn of(ray: &Ray) -> Self {
        Self {
            origin: ray.origin.to_array(),
            direction: ray.direction.to_array(),
        }
    }
}

impl SphereOut {
    pub fn of(sphere: &Sphere) -> Self {
        Self {
            center: sphere.center.to_array(),
            radius: sphere.radius,
        }
    }
}

#[derive(Serialize)]
struct ErrorsJson {
    a: Option<ErrorJson>,
    b: Option<ErrorJson>,
    c: Option<ErrorJson>,
    discriminant: Option<ErrorJson>,
    near: Option<ErrorJson>,
    far: Option<ErrorJson>,
}

#[derive(Serialize)]
struct AnswerJson {
    class: &'static str,
    near: Option<NumberJson>,
    far: Option<NumberJson>,
}

impl AnswerJson {
    fn new(solution: Solution) -> Self {
        let is_given = |t: f32| match solution.class {
            Class::Miss => false,
            Class::Hit => !t.is_nan(),
            _ => true,
        };
        let root = |t| is_given(t).then(|| NumberJson::binary32(t));
        Self {
            class: solution.class.name(),
            near: root(solution.near),
            far: root(solution.far),
        }
    }
}

#[derive(Serialize)]
struct StepOut<'a> {
    symbol: &'a str,
    formula: &'a str,
    numbers: &'a str,
    precision: &'static str,
    result: Vec<MeasuredOut>,
    why: &'a str,
    code: String,
    bits_lost: u32,
    losses: Vec<LossOut<'a>>,
}

impl<'a> StepOut<'a> {
    fn new(step: &'a TraceStep) -> Self {
        let parts = step.result.parts();
        Self {
            symbol: &step.symbol,
            formula: &step.formula,
            numbers: &step.numbers,
            precision: precision(step.result.precision()),
            result: parts.iter().map(MeasuredOut::new).collect(),
            why: &step.why,
            code: step.statement(),
            bits_lost: step.bits_lost(),
            losses: step.losses.iter().map(LossOut::new).collect(),
        }
    }
}

#[derive(Serialize)]
struct LossOut<'a> {
    kind: &'static str,
    bits: u32,
    operands: &'a [String; 2],
    text: String,
}

impl<'a> LossOut<'a> {
    fn new(loss: &'a Loss) -> Self {
        Self {
            kind: match loss.kind {
                LossKind::Cancelled { .. } => "cancelled",
                LossKind::Absorbed { .. } => "absorbed",
                LossKind::Underflowed => "underflowed",
                LossKind::Overflowed => "overflowed",
                LossKind::Invalid => "invalid",
            },
            bits: loss.bits(),
            operands: &loss.operands,
            text: loss.sentence(Glyphs::Unicode),
        }
    }
}

#[derive(Serialize)]
struct MeasuredOut {
    value: NumberJson,
    #[serde(flatten)]
    error: ErrorJson,
}

impl MeasuredOut {
    fn new(measured: &Measured) -> Self {
        Self {
            value: NumberJson::of(measured),
            error: ErrorJson::of(measured),
        }
    }
}

#[derive(Serialize)]
struct ErrorJson {
    exact: Option<String>,
    ulps: Option<NumberJson>,
}

impl ErrorJson {
    fn of(measured: &Measured) -> Self {
        let exact = |value: &Surd| format::exact(value, DIGITS, Glyphs::Ascii);
        Self {
            exact: measured.exact.as_ref().map(exact),
            ulps: measured.ulps().map(|value| NumberJson {
                value,
                precision: Precision::Binary64,
            }),
        }
    }
}

/// A number of the machine.
struct NumberJson {
    value: f64,
    precision: Precision,
}

impl NumberJson {
    fn of(measured: &Measured) -> Self {
        Self {
            value: measured.value,
            precision: measured.precision,
        }
    }

    fn binary32(value: f32) -> Self {
        Self {
            value: value.into(),
            precision: Precision::Binary32,
        }
    }
}

impl Serialize for NumberJson {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        if !self.value.is_finite() {
            return serializer.collect_str(&format::binary64(self.value, Glyphs::Ascii));
        }
        match self.precision {
            Precision::Binary32 => serializer.serialize_f32(self.value as f32),
            Precision::Binary64 => serializer.serialize_f64(self.value),
        }
    }
}

fn precision(precision: Precision) -> &'static str {
    match precision {
        Precision::Binary32 => "binary32",
        Precision::Binary64 => "binary64",
    }
}
