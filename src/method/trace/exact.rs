//! The derivation of `exact`: the record of the run that gave the answer, stage by stage. Nothing
//! is computed here but the exact values that stand beside.

use super::loss::{self, Loss, LossOperand};
use super::{Measured, Quantity, TraceStep};
use crate::geometry::{Ray, Sphere};
use crate::method::Precision;
use crate::method::dyadic::Dyadic;
use crate::method::exact::{self, Bounded, Direct, Discriminant, Findings, Record, Stage};
use crate::method::format::{Shortest, binary32, binary64};
use crate::method::surd::Surd;
use crate::method::tape::Operation;
use crate::method::truth::Truth;
use crate::text::Glyphs;

/// Steps keep their numbers in print; the caller that shows them spells them.
const GLYPHS: Glyphs = Glyphs::Unicode;

/// The steps of stage 1, a step for each stage that was asked after it, and the answer.
pub(in crate::method) fn steps(ray: &Ray, sphere: &Sphere, truth: &Truth) -> Vec<TraceStep> {
    let record = exact::record(ray, sphere);
    let mut steps = discriminant_steps(ray, sphere, truth, &record);
    steps.push(sign_step(&record.discriminant));
    if let Some(direct) = &record.direct {
        steps.extend(root_steps(ray, truth, &record.discriminant, direct));
    }
    let later = record.findings.iter().skip(1);
    steps.extend(later.map(|found| stage_step(truth, &record, found)));
    if record.solution.class.meets() {
        steps.extend(answer_steps(truth, &record));
    }
    steps
}

fn discriminant_steps(
    ray: &Ray,
    sphere: &Sphere,
    truth: &Truth,
    record: &Record,
) -> Vec<TraceStep> {
    let Discriminant {
        o, a, ar2, k2, d, ..
    } = record.discriminant;
    let [p0, center] = [ray.origin, sphere.center].map(|v| v.to_array());
    let [p0, center] = [p0, center].map(|v| v.map(Dyadic::from));
    let exact_o = [0, 1, 2].map(|i| &p0[i] - &center[i]);
    let exact_ar2 = &truth.a * &Dyadic::from(sphere.radius).squared();
    let exact_k2 = &exact_ar2 - &truth.quarter_discriminant;
    let [p0, d_text, c] = [ray.origin, ray.direction, sphere.center].map(vector);
    let [x, y, z] = ray
        .direction
        .to_array()
        .map(|x| factor(binary32(x, GLYPHS)));
    let r = binary32(sphere.radius, GLYPHS);
    let o_text = format!("({}, {}, {})", text(o[0]), text(o[1]), text(o[2]));
    vec![
        TraceStep {
            symbol: "o".into(),
            formula: "p0 − c".into(),
            numbers: format!("{p0} − {c}"),
            result: Quantity::Vector(Box::new([0, 1, 2].map(|i| {
                let exact = Surd::from(exact_o[i].clone());
                measured(o[i], Some(exact))
            }))),
            why: "Where the ray starts, seen from the centre.".into(),
            code: "let o = [p0[0] - center[0], p0[1] - center[1], p0[2] - center[2]];".into(),
            losses: Vec::new(),
        },
        scalar(
            ("A", "d·d", format!("{x}² + {y}² + {z}²")),
            measured(a, Some(truth.a.clone().into())),
            "let a = dot(d, d);",
            "What multiplies t²: the length of d, squared.",
        ),
        scalar(
            ("A·r²", "A·r²", format!("{}·{r}²", text(a))),
            measured(ar2, Some(exact_ar2.clone().into())),
            "let ar2 = a * (r * r);",
            "What ‖o×d‖² would be if the line touched the sphere.",
        ),
        scalar(
            ("‖o×d‖²", "(o×d)·(o×d)", format!("‖{o_text} × {d_text}‖²")),
            measured(k2, Some(exact_k2.clone().into())),
            "let k2 = dot(k, k);",
            "The length of d times the distance at which the line passes the centre, squared.",
        ),
        TraceStep {
            losses: difference_loss(
                d,
                ("A·r²", &measured(ar2, Some(exact_ar2.into()))),
                ("‖o×d‖²", &measured(k2, Some(exact_k2.into()))),
            ),
            ..scalar(
                (
                    "D",
                    "A·r² − ‖o×d‖²",
                    format!("{} − {}", text(ar2), text(k2)),
                ),
                measured(d, Some(truth.quarter_discriminant.clone().into())),
                "d: ar2 - k2,",
                "The discriminant, Δ/4, by Lagrange's identity.",
            )
        },
    ]
}

/// What the difference of two numbers in binary64 lost.
fn difference_loss(value: f64, first: (&str, &Measured), second: (&str, &Measured)) -> Vec<Loss> {
    let operands = [first, second].map(|(label, number)| LossOperand {
        label: label.to_owned(),
        named: true,
        value: number.value,
        exact: number.is_exact(),
    });
    let loss = loss::of_operation(Operation::Sub, value, &operands, Precision::Binary64);
    loss.into_iter().collect()
}

/// Whether stage 1 knows the sign of D.
fn sign_step(discriminant: &Discriminant<f64>) -> TraceStep {
    let [d, bound] = [discriminant.d.abs(), discriminant.d_error];
    let (than, verdict) = match discriminant.class() {
        Some(_) => (">", "the sign of D is certain"),
        None => ("≤", "the sign of D is open"),
    };
    scalar(
        (
            "bound",
            "how far D may be off at most",
            format!("|D| = {} {than} 4·{}: {verdict}", text(d), text(bound)),
        ),
        measured(bound, Surd::from_f64(bound)),
        "let threshold = self.threshold();",
        "How far rounding may have moved D. If D is farther from 0 than that, its sign is right.",
    )
}

/// What stage 1 makes of the roots: b, √D, and two numbers with their bounds.
fn root_steps(
    ray: &Ray,
    truth: &Truth,
    discriminant: &Discriminant<f64>,
    direct: &Direct<f64>,
) -> [TraceStep; 4] {
    let d = ray
        .direction
        .to_array()
        .map(|x| factor(binary32(x, GLYPHS)));
    let [x, y, z] = discriminant.o.map(|x| factor(binary64(x, GLYPHS)));
    let root_d = Surd::from(truth.quarter_discriminant.clone()).checked_sqrt();
    let b = factor(binary64(direct.half_b, GLYPHS));
    let [s, a] = [direct.s, discriminant.a].map(text);
    let minus_b = measured(-direct.half_b, Some((-truth.half_b.clone()).into()));
    let root_of_d = measured(direct.s, root_d.clone());
    // Of the two sums the one whose terms have opposite signs is a difference.
    let losses = |sign| match (sign, minus_b.value > 0.0) {
        ('−', true) => {
            let difference = minus_b.value - direct.s;
            difference_loss(difference, ("−b", &minus_b), ("√D", &root_of_d))
        }
        ('+', false) => {
            let b = measured(direct.half_b, Some(truth.half_b.clone().into()));
            difference_loss(direct.s - b.value, ("√D", &root_of_d), ("b", &b))
        }
        _ => Vec::new(),
    };
    let root = |symbol, formula, sign, code, root: Bounded<f64>, exact| {
        let certainty = if root.error.is_finite() {
            format!("within {}", text(root.error))
        } else {
            "but how near that is is open".to_owned()
        };
        TraceStep {
            losses: losses(sign),
            ..scalar(
                (
                    symbol,
                    formula,
                    format!("(−{b} {sign} {s}) / {a}, {certainty}"),
                ),
                measured(root.value, exact),
                code,
                "The root in binary64, and how far from the exact one it may be at most.",
            )
        }
    };
    let [near, far] = direct.roots(discriminant);
    [
        scalar(
            (
                "b",
                "d·o",
                format!("{}·{x} + {}·{y} + {}·{z}", d[0], d[1], d[2]),
            ),
            measured(direct.half_b, Some(truth.half_b.clone().into())),
            "let half_b = dot(o, input.d);",
            "Half of B: below 0 if the ray comes nearer to the centre as it starts.",
        ),
        scalar(
            ("√D", "√D", format!("√{}", text(discriminant.d))),
            measured(direct.s, root_d),
            "let s = d.sqrt();",
            "Half the distance between the two roots, times A.",
        ),
        root(
            "near₆₄",
            "(−b − √D) / A",
            '−',
            "let near = -half_b - s;",
            near,
            truth.near(),
        ),
        root(
            "far₆₄",
            "(−b + √D) / A",
            '+',
            "let far = s - half_b;",
            far,
            truth.far(),
        ),
    ]
}

/// A stage after the first: what it found and settled.
fn stage_step(truth: &Truth, record: &Record, found: &Findings) -> TraceStep {
    let (symbol, why, code) = match found.stage {
        Stage::Binary64 | Stage::Unrounded => (
            "D, unrounded",
            "The inputs are small whole numbers: of all of stage 1, only √ and ÷ were rounded.",
            "Stage::Unrounded => unrounded(input, discriminant),",
        ),
        Stage::Compensated => (
            "C, compensated",
            "C cancels: the rounding errors of its differences, squares and sums are added back.",
            "Stage::Compensated => compensated(input, discriminant),",
        ),
        Stage::Whole => (
            "D, in whole numbers",
            "The inputs are whole numbers of 30 bits of some unit: so is everything else, exactly.",
            "Stage::Whole => whole(input, open),",
        ),
        Stage::DoubleDouble => (
            "D, double-double",
            "The same formulas with twice the bits, and a much smaller bound.",
            "Stage::DoubleDouble => Some(double_double(input, open)),",
        ),
        Stage::Integer => (
            "D, integers",
            "Whole numbers of 1152 bits, which hold every possible D: nothing is rounded.",
            "Stage::Integer => Some(integer(input, open)),",
        ),
    };
    let (value, exact) = match (found.stage, &found.estimate) {
        (Stage::Compensated, Some(estimate)) => (estimate.c, &truth.c),
        (_, Some(estimate)) => (estimate.d, &truth.quarter_discriminant),
        (_, None) => (record.discriminant.d, &truth.quarter_discriminant),
    };
    let known = |root: Option<f32>, by: Option<Stage>| match root {
        Some(t) => binary32(t, GLYPHS).to_string(),
        None if by.is_some_and(|by| by < found.stage) => "known".to_owned(),
        None => "open".to_owned(),
    };
    let numbers = match (found.class, found.roots) {
        (None, _) => "the sign of D is still open".to_owned(),
        (Some(class), None) => format!("a {class}"),
        (Some(class), Some([near, far])) => {
            let near = known(near.settled, record.stages.near);
            let far = known(far.settled, record.stages.far);
            format!("{class}, near {near}, far {far}")
        }
    };
    let result = measured(value, Some(exact.clone().into()));
    scalar((symbol, "by the next stage", numbers), result, code, why)
}

/// The roots in binary32, each with the stage that was sure of it.
fn answer_steps(truth: &Truth, record: &Record) -> [TraceStep; 2] {
    let solution = record.solution;
    [
        ("near", solution.near, truth.near(), record.stages.near),
        ("far", solution.far, truth.far(), record.stages.far),
    ]
    .map(|(symbol, value, exact, stage)| {
        let stage = stage.unwrap_or(record.stages.class);
        let (code, why) = match stage {
            Stage::Binary64 => (
                "let [t, too] = bounds.map(rounding::round);",
                "Both ends of the interval that the bound leaves round to this one number.",
            ),
            Stage::Unrounded => (
                "let settle = |_, bounded| rounding::by_bound(bounded);",
                "Both ends of the interval that the bound leaves round to this one number.",
            ),
            Stage::Compensated => (
                "settled: rounding::by_bound(bounded),",
                "Both ends of the interval that the bound leaves round to this one number.",
            ),
            Stage::Whole | Stage::DoubleDouble | Stage::Integer => (
                "None => rounding::by_signs(which, bounded, quadratic),",
                "Of the two numbers left, the signs of f(m) and f′(m) half way between choose this.",
            ),
        };
        let root = Measured {
            value: value.into(),
            precision: Precision::Binary32,
            exact,
        };
        let formula = "the exact root rounded once to binary32";
        scalar((symbol, formula, format!("settled by {stage}")), root, code, why)
    })
}

fn scalar(
    (symbol, formula, numbers): (&'static str, &'static str, String),
    result: Measured,
    code: &'static str,
    why: &'static str,
) -> TraceStep {
    TraceStep {
        symbol: symbol.into(),
        formula: formula.into(),
        numbers,
        result: Quantity::Scalar(result),
        why: why.into(),
        code: code.into(),
        losses: Vec::new(),
    }
}

fn measured(value: f64, exact: Option<Surd>) -> Measured {
    Measured {
        value,
        precision: Precision::Binary64,
        exact,
    }
}

fn text(value: f64) -> String {
    binary64(value, GLYPHS).to_string()
}

/// A number in a product or under a square: in parentheses if it has a sign.
fn factor(number: Shortest) -> String {
    let text = number.to_string();
    if text.starts_with('−') {
        format!("({text})")
    } else {
        text
    }
}

fn vector(v: glam::Vec3) -> String {
    let [x, y, z] = v.to_array().map(|x| binary32(x, GLYPHS));
    format!("({x}, {y}, {z})")
}
