//! The lines of the mathematics: in the tutorial's order, with its letters, worked exactly.

use super::quadratic::WorkedRoot;
use super::{Drawn, Equation, LedgerEntry, Link, Step, WorkedQuadratic};
use crate::explain::equation::{Expression, Sign, Written, sum_of};
use crate::explain::question::StepQuestion;
use crate::explain::{Reading, Subject};
use crate::method::{Class, Dyadic, Place, Surd};
use crate::render::{AMBIENT, View};
use crate::scene::Light;

/// Digits of numbers that nothing else comes out of.
const DIGITS: usize = 6;

pub(super) fn steps(
    reading: &Reading,
    subject: &Subject,
    light: Option<Light>,
    drawn: Option<&Drawn>,
) -> Vec<Step> {
    let q = subject.worked();
    let mut steps = vec![
        ray_step(&q),
        offset_step(&q),
        a_step(&q),
        b_step(&q),
        c_step(&q),
        delta_step(&q),
    ];
    let is_first = reading.is_first(subject);
    let Some(roots) = &q.roots else {
        steps.extend(closest_step(&q));
        steps.push(seen_step(&q, subject, is_first));
        return steps;
    };
    steps.push(roots_step(&q, roots));
    steps.push(seen_step(&q, subject, is_first));
    let seen = match subject.solution.place() {
        Some(Place::Hit) => &roots[0],
        Some(Place::Inside) => &roots[1],
        Some(Place::Behind) | None => return steps,
    };
    let point = point_of(&q, seen);
    steps.push(point_step(&q, seen, &point));
    let drawn = drawn.filter(|_| is_first);
    steps.push(light_step(&q, subject, light, &point, (drawn, is_first)));
    steps
}

/// Three numbers in parentheses.
pub(in crate::explain) fn vector(v: &[Written; 3]) -> String {
    let [x, y, z] = v.each_ref().map(|x| x.text.as_str());
    format!("({x}, {y}, {z})")
}

fn are_whole(numbers: &[Written]) -> bool {
    numbers.iter().all(|number| number.is_whole)
}

fn ray_step(q: &WorkedQuadratic) -> Step {
    let [p0, d, c] = q.given.each_ref().map(vector);
    Step {
        code: "vector p = vectorAdd(&r->start, vectorScale(t, &r->dir));".into(),
        ..Step::new(
            "ray",
            "The points of the line are p = p0 + t·d. Those on the sphere have |p − c|² = r²: put the \
             first into the second, and At² + Bt + C = 0 is left.",
            vec![
                Equation::letters(format!("p0: {p0}")),
                Equation::letters(format!("d: {d}")),
                Equation::letters(format!("c: {c}   r: {}", q.r.text)),
            ],
        )
    }
}

fn offset_step(q: &WorkedQuadratic) -> Step {
    let sign = Sign::of_letters(are_whole(&q.written_o));
    Step {
        code: "vector dist = vectorSub(&r->start, &s->pos);".into(),
        ..Step::new(
            "p0 − c",
            "Where the ray starts, seen from the centre of the sphere.",
            vec![Equation::new(
                "p0 − c",
                vec![Link::new(sign, vector(&q.written_o))],
            )],
        )
    }
}

/// A sum of numbers as it is printed, and how it is joined to its result; none if there is no room for
/// the digits that it takes.
fn sum_link(terms: &[Surd], result: &Written, times: Option<i32>) -> Option<Vec<Link>> {
    let places = result.places().max(0);
    let sum = |written: &[Written]| {
        let mut terms = written.iter().map(Expression::number);
        let first = terms.next()?;
        let sum = terms.fold(first, |sum, term| sum.plus(&term));
        Some(match times {
            Some(times) => Expression::whole(times).times(&sum),
            None => sum,
        })
    };
    let whole: Option<Vec<_>> = terms.iter().map(|t| Written::in_full(t, 8)).collect();
    let rounded = (places..places + 3).map(|places| {
        terms
            .iter()
            .map(|t| Written::term(t, places))
            .collect::<Vec<_>>()
    });
    whole.into_iter().chain(rounded).find_map(|written| {
        let sum = sum(&written)?;
        let sign = sum.relation(result)?;
        let of_letters = Sign::of_letters(are_whole(&written));
        Some(vec![
            Link::new(of_letters, sum.text()),
            Link::new(sign, &result.text),
        ])
    })
}

/// What a letter comes to, with nothing between.
fn result_alone(result: &Written) -> Vec<Link> {
    vec![Link::new(Sign::of_letters(result.is_whole), &result.text)]
}

fn product(x: &Surd, y: &Surd) -> Surd {
    x.checked_mul(y).unwrap_or_else(|| x.clone())
}

/// The products of the components of two vectors, where all of them are written in full.
fn products(u: &[Written; 3], v: &[Written; 3]) -> Option<Expression> {
    if !are_whole(u) || !are_whole(v) {
        return None;
    }
    let term = |i: usize| Expression::number(&u[i]).times(&Expression::number(&v[i]));
    Some(term(0).plus(&term(1)).plus(&term(2)))
}

fn a_step(q: &WorkedQuadratic) -> Step {
    let [_, d, _] = &q.given;
    let mut ways = Vec::new();
    if are_whole(d) {
        let square = |i: usize| Expression::number(&d[i]).squared();
        let sum = square(0).plus(&square(1)).plus(&square(2));
        if let Some(sign) = sum.relation(&q.a) {
            ways.push(vec![
                Link::new(Sign::Equal, sum.text()),
                Link::new(sign, &q.a.text),
            ]);
        }
    }
    if ways.is_empty() {
        let squares = q.direction().map(|x| product(&x, &x));
        ways.extend(sum_link(&squares, &q.a, None));
    }
    ways.push(result_alone(&q.a));
    Step {
        code: "float A = vectorDot(&r->dir, &r->dir);".into(),
        questions: vec![StepQuestion::A],
        ..Step::new(
            "A",
            "What multiplies t²: the length of d, squared.",
            vec![Equation {
                ways,
                ..Equation::letters("A = d·d")
            }],
        )
    }
}

fn b_step(q: &WorkedQuadratic) -> Step {
    let [_, d, _] = &q.given;
    let half: Surd = q.truth.half_b.clone().into();
    let short = sum_link(std::slice::from_ref(&half), &q.b, Some(2));
    let mut ways = Vec::new();
    if let (Some(sum), Some(short)) = (products(d, &q.written_o), &short) {
        let twice = Expression::whole(2).times(&sum);
        if twice.relation(&q.b) == Some(Sign::Equal) {
            let mut way = vec![Link::new(Sign::Equal, twice.text())];
            way.extend(short.clone());
            ways.push(way);
        }
    } else {
        let d = q.direction();
        let terms = [0, 1, 2].map(|i| product(&d[i], &q.o[i]));
        ways.extend(sum_link(&terms, &q.b, Some(2)));
    }
    ways.extend(short);
    ways.push(result_alone(&q.b));
    Step {
        code: "float B = 2 * vectorDot(&r->dir, &dist);".into(),
        questions: vec![StepQuestion::B],
        ..Step::new(
            "B",
            "What multiplies t: below 0 if the ray sets out towards the centre.",
            vec![Equation {
                ways,
                ..Equation::letters("B = 2 d·(p0 − c)")
            }],
        )
    }
}

fn c_step(q: &WorkedQuadratic) -> Step {
    let squares = q.o.each_ref().map(|x| product(x, x));
    let r = q.radius();
    let rr = product(&r, &r);
    let all = squares.iter().skip(1).fold(squares[0].clone(), |sum, x| {
        sum.checked_add(x).unwrap_or_else(|| sum.clone())
    });
    let mut equation = Equation::letters("C = |p0 − c|² − r²");
    let short = sum_link(&[all.clone(), -rr.clone()], &q.c, None);
    if are_whole(&q.written_o) && q.r.is_whole {
        let square = |x: &Written| Expression::number(x).squared();
        let [x, y, z] = q.written_o.each_ref().map(square);
        let long = x.plus(&y).plus(&z).minus(&square(&q.r));
        if let (Some(Sign::Equal), Some(short)) = (long.relation(&q.c), &short)
            && short[0].sign == Sign::Equal
        {
            let mut way = vec![Link::new(Sign::Equal, long.text())];
            way.extend(short.clone());
            equation.ways.push(way);
        }
    }
    equation.ways.extend(short);
    equation.ledger = ledger(["|p0 − c|²", "r²"], [all, rr], &q.c, "C");
    equation.ways.push(result_alone(&q.c));
    Step {
        code: "float C = vectorDot(&dist, &dist) - (s->radius * s->radius);".into(),
        questions: vec![StepQuestion::C],
        ..Step::new(
            "C",
            "What is left without t: below 0 if the ray starts inside the sphere.",
            vec![equation],
        )
    }
}

/// A difference term by term, its numbers with equally many decimals; nothing where these don't give the
/// result as it is written.
fn ledger(
    [first, second]: [&str; 2],
    [x, y]: [Surd; 2],
    result: &Written,
    letter: &str,
) -> Vec<LedgerEntry> {
    let Some(terms) = sum_of(&[x, -y], result, result.places()) else {
        return Vec::new();
    };
    ledger_of(
        [first, second],
        [&terms[0], &terms[1].negated()],
        result,
        letter,
    )
}

fn ledger_of(
    [first, second]: [&str; 2],
    [x, y]: [&Written; 2],
    result: &Written,
    letter: &str,
) -> Vec<LedgerEntry> {
    let entry = |label: String, number: &Written| LedgerEntry {
        label,
        number: number.text.clone(),
    };
    let sign = Sign::of_letters(result.is_whole).text();
    vec![
        entry(format!("  {first}"), x),
        entry(format!("− {second}"), y),
        entry(format!("{letter} {sign}"), result),
    ]
}

fn delta_step(q: &WorkedQuadratic) -> Step {
    let mut equation = Equation::letters("Δ = B² − 4AC");
    if let Some(terms) = &q.ledger {
        if are_whole(terms) && q.delta.is_whole {
            let [bb, four_ac] = [&terms[0], &terms[1]].map(Expression::number);
            let difference = bb.minus(&four_ac);
            let whole = q.delta_of_letters();
            let result = Link::new(Sign::Equal, &q.delta.text);
            let short = vec![Link::new(Sign::Equal, difference.text()), result];
            if whole.relation(&q.delta) == Some(Sign::Equal) {
                let mut way = vec![Link::new(Sign::Equal, whole.text())];
                way.extend(short.clone());
                equation.ways.push(way);
            }
            equation.ways.push(short);
        }
        equation.ledger = ledger_of(["B²", "4AC"], [&terms[0], &terms[1]], &q.delta, "Δ");
    }
    equation.ways.push(result_alone(&q.delta));
    let outcome = match q.truth.class() {
        Class::Miss => "below 0: the line misses the sphere",
        Class::Tangent => "exactly 0: the line touches the sphere in one point",
        Class::Secant | Class::Hit | Class::Nan => {
            "above 0: the line meets the sphere in two points"
        }
    };
    Step {
        outcome: vec![outcome.into()],
        code: "float discr = B*B - 4*A*C;".into(),
        questions: vec![StepQuestion::Delta, StepQuestion::Count],
        ..Step::new(
            "Δ",
            "The roots have a √Δ in them, and no number squared is below 0: the sign of Δ decides.",
            vec![equation],
        )
    }
}

/// For a line that misses: where it comes closest.
fn closest_step(q: &WorkedQuadratic) -> Option<Step> {
    let a: Surd = q.truth.a.clone().into();
    let half: Surd = q.truth.half_b.clone().into();
    let t = (-half.clone()).checked_div(&a)?;
    let [written_a, minus_b] = [q.a.clone(), q.b.negated()];
    let below = Expression::whole(2).times(&Expression::number(&written_a));
    let expression = Expression::number(&minus_b).over(&below);
    let (sign, written) = expression.result(&t, DIGITS, 3)?;
    let of_letters = Sign::of_letters(q.b.is_whole && q.a.is_whole);
    let links = vec![
        Link::new(of_letters, expression.text()),
        Link::new(sign, &written.text),
    ];
    // |p0 − c|² − (d·(p0 − c))²/A, of which C is all but r².
    let r = q.radius();
    let squared = Surd::from(q.truth.c.clone())
        .checked_add(&product(&r, &r))?
        .checked_sub(&product(&half, &half).checked_div(&a)?)?;
    let distance = Written::of(&squared.checked_sqrt()?, 5);
    Some(Step {
        outcome: vec![format!(
            "there it is {} from the centre, farther than r",
            distance.text
        )],
        code: "float closest = -B / (2 * A);".into(),
        ..Step::new(
            "closest",
            "No t solves the equation. The line comes closest to the centre where both roots would be.",
            vec![Equation::new("t = −B / 2A", links)],
        )
    })
}

fn roots_step(q: &WorkedQuadratic, roots: &[WorkedRoot; 2]) -> Step {
    let is_tangent = q.truth.class() == Class::Tangent;
    let is_whole = q.a.is_whole && q.b.is_whole && q.delta.is_whole;
    let equation = |formula: &str, root: &WorkedRoot| {
        let mut ways = Vec::new();
        if let Some((expression, sign)) = &root.expression {
            ways.push(vec![
                Link::new(Sign::of_letters(is_whole), expression.text()),
                Link::new(*sign, &root.written.text),
            ]);
        }
        ways.push(result_alone(&root.written));
        Equation {
            ways,
            ..Equation::letters(formula)
        }
    };
    let (why, equations, questions, code) = if is_tangent {
        (
            "With Δ = 0 both roots are the same t.",
            vec![equation("near = far = −B / 2A", &roots[0])],
            vec![StepQuestion::Near],
            "float t = -B / (2 * A);",
        )
    } else {
        (
            "The quadratic formula gives both t, the smaller one first; t counts lengths of d.",
            vec![
                equation("near = (−B − √Δ) / 2A", &roots[0]),
                equation("far = (−B + √Δ) / 2A", &roots[1]),
            ],
            vec![StepQuestion::Near, StepQuestion::Far],
            "float near = (-B - sqrtf(discr)) / (2 * A);",
        )
    };
    Step {
        questions,
        code: code.into(),
        ..Step::new("roots", why, equations)
    }
}

fn seen_step(q: &WorkedQuadratic, subject: &Subject, is_first: bool) -> Step {
    let t = |i: usize| {
        q.roots
            .as_ref()
            .map_or("", |roots| roots[i].written.text.as_str())
    };
    let [near, far] = [t(0), t(1)];
    let (compared, outcome) = match subject.solution.place() {
        Some(Place::Hit) => (
            format!("0 < {near}"),
            if is_first {
                "near is in front of the eye: this point is seen"
            } else {
                "near is in front of the eye, but the ray meets another sphere first"
            },
        ),
        Some(Place::Inside) if near == "0" => (
            format!("0 < {far}"),
            "near is the eye itself, on the surface: the far point is seen",
        ),
        Some(Place::Inside) => (
            format!("{near} < 0 < {far}"),
            if is_first {
                "the eye is inside the sphere: the far point is seen"
            } else {
                "the eye is inside the sphere, but the ray meets another one first"
            },
        ),
        Some(Place::Behind) if far == "0" => (
            String::new(),
            "no t above 0: the sphere is behind the eye, which touches it",
        ),
        Some(Place::Behind) => (
            format!("{far} < 0"),
            "both points are behind the eye: the line meets the sphere, the ray does not",
        ),
        None => (
            String::new(),
            "no t, no point: nothing of this sphere is seen",
        ),
    };
    let equations = if compared.is_empty() {
        Vec::new()
    } else {
        vec![Equation::letters(compared)]
    };
    Step {
        outcome: vec![outcome.into()],
        questions: vec![StepQuestion::Seen],
        code: "float t = near > 0 ? near : far;".into(),
        ..Step::new(
            "seen",
            "The eye sees what the ray meets first: the least t above 0.",
            equations,
        )
    }
}

/// The exact point of a root.
fn point_of(q: &WorkedQuadratic, root: &WorkedRoot) -> [Surd; 3] {
    let (p0, d) = (q.origin(), q.direction());
    [0, 1, 2].map(|i| {
        let along = product(&root.exact, &d[i]);
        p0[i].checked_add(&along).unwrap_or(along)
    })
}

fn point_step(q: &WorkedQuadratic, root: &WorkedRoot, point: &[Surd; 3]) -> Step {
    let [p0, d, _] = &q.given;
    let t = &root.written;
    // Each component comes out of what is written; all of them have as many decimals.
    let along = |i: usize| {
        let [p0, d, t] = [&p0[i], &d[i], t].map(Expression::number);
        p0.plus(&t.times(&d))
    };
    let joined = |places: i64| {
        let written = [0, 1, 2].map(|i| {
            let whole = Written::in_full(&point[i], 8);
            let fits = |w: &Written| along(i).relation(w).is_some();
            whole
                .filter(fits)
                .unwrap_or_else(|| Written::at(&point[i], places))
        });
        let signs = [0, 1, 2].map(|i| along(i).relation(&written[i]));
        let all = signs.iter().copied().collect::<Option<Vec<_>>>()?;
        let equal = all.iter().all(|&sign| sign == Sign::Equal);
        Some((written, if equal { Sign::Equal } else { Sign::Near }))
    };
    // Four digits of the greatest coordinate, or as many decimals as t has.
    let greatest = point
        .iter()
        .filter(|x| !x.is_zero())
        .map(|x| x.digits(1).exponent)
        .max();
    let places = (4 - greatest.unwrap_or(0)).max(t.places());
    let mut equations = Vec::new();
    let found = (places - 8..=places).rev().find_map(joined);
    let inputs_whole = are_whole(p0) && are_whole(d) && t.is_whole;
    if let Some((written, sign)) = found {
        let put_in = format!("{} + {}·{}", vector(p0), t.bracketed(), vector(d));
        let result = Link::new(sign, vector(&written));
        let of_letters = Sign::of_letters(are_whole(&written));
        equations.push(Equation {
            ways: vec![
                vec![Link::new(Sign::of_letters(inputs_whole), put_in), result],
                vec![Link::new(of_letters, vector(&written))],
            ],
            ..Equation::letters("p = p0 + t·d")
        });
    }
    equations.extend(check_equation(q, point));
    Step {
        outcome: vec!["the point is on the sphere".into()],
        code: "vector p = vectorAdd(&r->start, vectorScale(t, &r->dir));".into(),
        ..Step::new(
            "p",
            "The t that is seen, put into the ray, gives the point; put into the sphere's equation, the \
             point must give r².",
            equations,
        )
    }
}

/// |p − c|² = r² with the squares of this point.
fn check_equation(q: &WorkedQuadratic, point: &[Surd; 3]) -> Option<Equation> {
    let center = q.center();
    let squares: Option<Vec<_>> = (0..3)
        .map(|i| {
            let out = point[i].checked_sub(&center[i])?;
            out.checked_mul(&out)
        })
        .collect();
    let squares = squares?;
    let r = q.radius();
    let rr = Written::of(&product(&r, &r), DIGITS);
    let places = rr.places().max(0);
    let size = 4 - product(&r, &r).digits(1).exponent;
    let terms = (places.max(size)..places.max(size) + 12)
        .find_map(|places| sum_of(&squares, &rr.padded(places), places))?;
    let mut sum = terms.iter().map(Expression::number);
    let first = sum.next()?;
    let sum = sum.fold(first, |sum, term| sum.plus(&term));
    let sign = sum.relation(&rr)?;
    let whole = are_whole(&terms);
    Some(Equation::new(
        "|p − c|²",
        vec![
            Link::new(Sign::of_letters(whole), sum.text()),
            Link::new(sign, &rr.text),
            Link::new(Sign::of_letters(rr.is_whole), "r²"),
        ],
    ))
}

fn light_step(
    q: &WorkedQuadratic,
    subject: &Subject,
    light: Option<Light>,
    point: &[Surd; 3],
    (drawn, is_first): (Option<&Drawn>, bool),
) -> Step {
    let (why, mut equations, cosine) = match light {
        Some(light) => lamp(q, subject, light, point),
        None => headlight(q),
    };
    let code = match light {
        Some(_) => "float cosine = vectorDot(&n, &to_light);",
        None => "float cosine = sqrtf(discr / (4 * A * s->radius * s->radius));",
    };
    let mut outcome = Vec::new();
    let lit = cosine.as_ref().map(brightness);
    equations.extend(lit.flatten());
    if !is_first {
        outcome.push("another sphere is in front: the picture shows that one".into());
    } else if let Some(drawn) = drawn.filter(|d| d.view == View::Shade && !d.glyph.is_whitespace())
    {
        outcome.push(format!("the picture shows it as “{}”", drawn.glyph));
    }
    Step {
        outcome,
        code: code.into(),
        ..Step::new("light", why, equations)
    }
}

/// The light that the surface gives back.
fn brightness(cosine: &Written) -> Option<Equation> {
    let decimal =
        |x: f64, places| Surd::from_f64(x).map(|x| Expression::number(&Written::at(&x, places)));
    let [base, rest] = [decimal(AMBIENT, 2)?, decimal(1.0 - AMBIENT, 2)?];
    let expression = base.plus(&rest.times(&Expression::number(cosine)));
    let written = Written::of_few(expression.value()?, 3);
    let sign = expression.relation(&written)?;
    let formula = format!("brightness = {} + {}·cos", base.text(), rest.text());
    Some(Equation {
        ways: vec![
            vec![
                Link::new(Sign::of_letters(cosine.is_whole), expression.text()),
                Link::new(sign, &written.text),
            ],
            vec![Link::new(
                Sign::of_letters(cosine.is_whole && written.is_whole),
                &written.text,
            )],
        ],
        ..Equation::letters(formula)
    })
}

/// The cosine of a light at the eye: the same Δ once more.
fn headlight(q: &WorkedQuadratic) -> (&'static str, Vec<Equation>, Option<Written>) {
    let why =
        "How squarely the light of the eye falls there: Δ says that, too. 1 is head-on, 0 the rim.";
    let r = q.radius();
    let below = product(&q.truth.a.clone().into(), &product(&r, &r));
    let exact = Surd::from(q.truth.quarter_discriminant.clone())
        .checked_div(&below)
        .and_then(|squared| squared.checked_sqrt());
    let [delta, a, r] = [&q.delta, &q.a, &q.r].map(Expression::number);
    let below = Expression::whole(4).times(&a).times(&r.squared());
    let expression = delta.over(&below).root();
    let Some((sign, written)) = exact.and_then(|exact| expression.result(&exact, 4, 2)) else {
        return (why, Vec::new(), None);
    };
    let whole = q.delta.is_whole && q.a.is_whole && q.r.is_whole;
    let equation = Equation {
        ways: vec![
            vec![
                Link::new(Sign::of_letters(whole), expression.text()),
                Link::new(sign, &written.text),
            ],
            result_alone(&written),
        ],
        ..Equation::letters("cos θ = √(Δ / 4Ar²)")
    };
    (why, vec![equation], Some(written))
}

/// The cosine between the normal and the way to a lamp, in binary64: only its first digits are shown.
fn lamp(
    q: &WorkedQuadratic,
    subject: &Subject,
    light: Light,
    point: &[Surd; 3],
) -> (&'static str, Vec<Equation>, Option<Written>) {
    let why = "How squarely the lamp's light falls there: the cosine of the angle between the normal n and \
        the way to the lamp; below 0 the surface is turned away.";
    let at = glam::DVec3::from_array(point.each_ref().map(Surd::to_f64));
    let center = glam::DVec3::from_array(q.center().map(|x| x.to_f64()));
    let out = (at - center).normalize_or_zero();
    let facing = match subject.solution.place() {
        Some(Place::Inside) => -out,
        _ => out,
    };
    let to_light = (light.position.as_dvec3() - at).normalize_or_zero();
    let Some(cosine) = Surd::from_f64(to_light.dot(facing)) else {
        return (why, Vec::new(), None);
    };
    let written = Written::rounded(&cosine, 4);
    let lit = if written.is_negative() {
        Written::at(&Surd::from(Dyadic::ZERO), 0)
    } else {
        written.clone()
    };
    let link = Link::new(Sign::Near, &written.text);
    (why, vec![Equation::new("cos", vec![link])], Some(lit))
}
