//! The derivation of `exact`: the record of the run that gave the answer, stage by stage. Nothing
//! is computed here but the exact values that stand beside.

use super::{Measured, Quantity, Step};
use crate::geometry::{Ray, Sphere};
use crate::method::dyadic::Dyadic;
use crate::method::exact::{self, Bounded, Findings, Record, Roots, Stage};
use crate::method::format::{Shortest, Signs, binary32, binary64};
use crate::method::surd::Surd;
use crate::method::truth::Truth;
use crate::method::{Class, Precision};

/// Steps keep their numbers in print; whoever shows them spells them.
const SIGNS: Signs = Signs::Typographic;

/// The steps of stage 1, a step for each stage that was asked after it, and the answer.
pub(in crate::method) fn steps(ray: &Ray, sphere: &Sphere, truth: &Truth) -> Vec<Step> {
    let record = exact::record(ray, sphere);
    let mut steps = discriminant_steps(ray, sphere, truth, &record);
    let Some((first, later)) = record.findings.split_first() else {
        return steps;
    };
    steps.push(sign_step(first));
    if record.solution.class != Class::Miss {
        steps.extend(coefficient_steps(ray, sphere, truth, &record, first));
    }
    if let Some(roots) = &first.roots {
        steps.extend(root_steps(truth, first, roots));
    }
    steps.extend(later.iter().map(|found| stage_step(truth, found)));
    if record.solution.class.meets() {
        steps.extend(answer_steps(truth, &record));
    }
    steps
}

fn discriminant_steps(ray: &Ray, sphere: &Sphere, truth: &Truth, record: &Record) -> Vec<Step> {
    let exact::Discriminant {
        o, a, ar2, k2, d, ..
    } = record.discriminant;
    let [p0, center] = [ray.origin, sphere.center].map(|v| v.to_array());
    let [p0, center] = [p0, center].map(|v| v.map(Dyadic::from));
    let exact_o = [0, 1, 2].map(|i| &p0[i] - &center[i]);
    let exact_ar2 = &truth.a * &Dyadic::from(sphere.radius).squared();
    let exact_k2 = &exact_ar2 - &truth.quarter_discriminant;
    let [p0, d_text, c] = [ray.origin, ray.direction, sphere.center].map(vector);
    let [x, y, z] = ray.direction.to_array().map(|x| factor(binary32(x, SIGNS)));
    let r = binary32(sphere.radius, SIGNS);
    let o_text = format!("({}, {}, {})", text(o[0]), text(o[1]), text(o[2]));
    vec![
        Step {
            symbol: "o",
            formula: "p0 − c",
            numbers: format!("{p0} − {c}"),
            result: Quantity::Vector(Box::new([0, 1, 2].map(|i| {
                let exact = Surd::from(exact_o[i].clone());
                measured(o[i], Some(exact))
            }))),
            why: "Where the ray starts, seen from the centre.",
            code: "let o = [p0[0] - center[0], p0[1] - center[1], p0[2] - center[2]];",
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
            measured(ar2, Some(exact_ar2.into())),
            "let ar2 = a * (r * r);",
            "What ‖o×d‖² would be if the line touched the sphere.",
        ),
        scalar(
            ("‖o×d‖²", "(o×d)·(o×d)", format!("‖{o_text} × {d_text}‖²")),
            measured(k2, Some(exact_k2.into())),
            "let k2 = dot(k, k);",
            "The length of d times the distance at which the line passes the centre, squared.",
        ),
        scalar(
            (
                "D",
                "A·r² − ‖o×d‖²",
                format!("{} − {}", text(ar2), text(k2)),
            ),
            measured(d, Some(truth.quarter_discriminant.clone().into())),
            "d: ar2 - k2,",
            "The discriminant, Δ/4, by Lagrange's identity.",
        ),
    ]
}

/// Whether stage 1 knows the sign of D.
fn sign_step(first: &Findings) -> Step {
    let [d, bound] = [first.estimate.d.abs(), first.estimate.d_error];
    let (than, verdict) = match first.class {
        Some(_) => (">", "the sign of D is certain"),
        None => ("≤", "the sign of D is open"),
    };
    scalar(
        (
            "E",
            "how far D may be off",
            format!("|D| = {} {than} 4·{}: {verdict}", text(d), text(bound)),
        ),
        measured(bound, Surd::from_f64(bound)),
        "let threshold = 4.0 * discriminant.d_error;",
        "A bound on the rounding errors of D: farther from 0 than that, its sign is right.",
    )
}

fn coefficient_steps(
    ray: &Ray,
    sphere: &Sphere,
    truth: &Truth,
    record: &Record,
    first: &Findings,
) -> [Step; 2] {
    let d = ray.direction.to_array().map(|x| factor(binary32(x, SIGNS)));
    let [x, y, z] = record.discriminant.o.map(|x| factor(binary64(x, SIGNS)));
    let r = binary32(sphere.radius, SIGNS);
    [
        scalar(
            (
                "b",
                "d·o",
                format!("{}·{x} + {}·{y} + {}·{z}", d[0], d[1], d[2]),
            ),
            measured(first.estimate.half_b, Some(truth.half_b.clone().into())),
            "half_b: (terms[0] + terms[1]) + terms[2],",
            "Half of B: below 0 if the ray comes nearer to the centre as it starts.",
        ),
        scalar(
            ("C", "|o|² − r²", format!("{x}² + {y}² + {z}² − {r}²")),
            measured(first.estimate.c, Some(truth.c.clone().into())),
            "let c = o2 - r * r;",
            "What is left without t: below 0 if the ray starts inside, 0 if on the surface.",
        ),
    ]
}

/// What stage 1 makes of the roots: √D, Q, and two numbers with their bounds.
fn root_steps(truth: &Truth, first: &Findings, roots: &Roots<f64>) -> [Step; 4] {
    let estimate = &first.estimate;
    let root_d = Surd::from(truth.quarter_discriminant.clone()).checked_sqrt();
    let exact_q = root_d
        .as_ref()
        .and_then(|s| s.checked_add(&truth.half_b.clone().abs().into()));
    let over_a = (
        "Q/A",
        format!("{} / {}", text(roots.q), text(estimate.a)),
        "let great = q * inverse_a;",
    );
    let over_q = (
        "C/Q",
        format!("{} / {}", text(estimate.c), text(roots.q)),
        "let small = c * inverse_q;",
    );
    let (near, far) = if estimate.half_b < 0.0 {
        (over_q, over_a)
    } else {
        (
            ("−Q/A", format!("−({})", over_a.1), over_a.2),
            ("−C/Q", format!("−({})", over_q.1), over_q.2),
        )
    };
    let root = |symbol, (formula, numbers, code): (_, String, _), root: Bounded<f64>, exact| {
        scalar(
            (
                symbol,
                formula,
                format!("{numbers}, within {}", text(root.error)),
            ),
            measured(root.value, exact),
            code,
            "The root in binary64, and how far from the exact one it may be at most.",
        )
    };
    [
        scalar(
            ("√D", "√D", format!("√{}", text(estimate.d))),
            measured(roots.s, root_d),
            "let s = d.sqrt();",
            "Half the way between the two points, measured in t and times A.",
        ),
        scalar(
            (
                "Q",
                "|b| + √D",
                format!("|{}| + {}", text(estimate.half_b), text(roots.s)),
            ),
            measured(roots.q, exact_q),
            "let q = half_b.abs() + s;",
            "Of the two sums −b ± √D, the size of the one that does not cancel.",
        ),
        root("near₆₄", near, roots.near, truth.near()),
        root("far₆₄", far, roots.far, truth.far()),
    ]
}

/// A stage after the first: what it found and settled.
fn stage_step(truth: &Truth, found: &Findings) -> Step {
    let (symbol, why, code) = match found.stage {
        Stage::Binary64 | Stage::Compensated => (
            "C, compensated",
            "C cancels: the rounding errors of its differences, squares and sums are added back.",
            "Stage::Compensated => compensated(input, &first.findings),",
        ),
        Stage::Plain => (
            "D, in whole numbers",
            "The inputs are small whole numbers of some unit: so is everything else, exactly.",
            "Stage::Plain => Plain::of(input).map(|plain| consult(stage, &plain, answer)),",
        ),
        Stage::DoubleDouble => (
            "D, double-double",
            "The same formulas with twice the bits, and a bound that is so much smaller.",
            "Stage::DoubleDouble => Some(consult(stage, &Doubled::new(input), answer)),",
        ),
        Stage::Integer => (
            "D, integers",
            "Whole numbers of 1152 bits, which hold every possible D: nothing is rounded.",
            "Stage::Integer => Some(consult(stage, &Exact::new(input), answer)),",
        ),
    };
    let result = match found.stage {
        Stage::Compensated => measured(found.estimate.c, Some(truth.c.clone().into())),
        _ => measured(
            found.estimate.d,
            Some(truth.quarter_discriminant.clone().into()),
        ),
    };
    let known = |root: Option<f32>| match root {
        Some(t) => binary32(t, SIGNS).to_string(),
        None => "open".to_owned(),
    };
    let numbers = match found.class {
        None => "the sign of D is still open".to_owned(),
        Some(Class::Miss) => "a miss".to_owned(),
        Some(class) => format!(
            "{class}, near {}, far {}",
            known(found.near),
            known(found.far)
        ),
    };
    scalar((symbol, "by the next stage", numbers), result, code, why)
}

/// The roots in binary32, each with the stage that was sure of it.
fn answer_steps(truth: &Truth, record: &Record) -> [Step; 2] {
    let solution = record.solution;
    [
        ("near", solution.near, truth.near(), record.stages.near),
        ("far", solution.far, truth.far(), record.stages.far),
    ]
    .map(|(symbol, value, exact, stage)| {
        let root = Measured {
            value: value.into(),
            precision: Precision::Binary32,
            exact,
        };
        let by = stage.map_or("", Stage::name);
        scalar(
            (
                symbol,
                "the exact root rounded once to binary32",
                format!("settled by {by}"),
            ),
            root,
            "answer.learn(&found);",
            "All that the bound leaves rounds to this one number, or signs at the midpoints say so.",
        )
    })
}

fn scalar(
    (symbol, formula, numbers): (&'static str, &'static str, String),
    result: Measured,
    code: &'static str,
    why: &'static str,
) -> Step {
    Step {
        symbol,
        formula,
        numbers,
        result: Quantity::Scalar(result),
        why,
        code,
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
    binary64(value, SIGNS).to_string()
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
    let [x, y, z] = v.to_array().map(|x| binary32(x, SIGNS));
    format!("({x}, {y}, {z})")
}
