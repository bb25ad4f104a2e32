//! The steps after the quadratic: what its roots mean, the point that is seen, and how it is shown.

use glam::{DVec3, Vec3};

use super::Drawn;
use super::machine::{MachineStep, bracketed, exact, n32, n64, v3};
use crate::explain::question::StepQuestion;
use crate::explain::{Digits, Reading, Sight, Subject, number};
use crate::method::trace::{Measured, Quantity};
use crate::method::{Class, Place, Precision, Surd};
use crate::render::{AMBIENT, RAMP, Style, View};
use crate::scene::Light;
use crate::text::Glyphs;

pub(super) fn steps(
    reading: &Reading,
    subject: &Subject,
    light: Option<Light>,
    drawn: Option<&Drawn>,
) -> Vec<MachineStep> {
    let mut steps = vec![seen_step(subject, reading.is_first(subject))];
    if let Some(sight) = &subject.sight {
        steps.push(point_step(reading, subject, sight));
        steps.push(check_step(subject, sight.point));
        steps.push(normal_step(subject, sight));
        steps.push(match light {
            Some(light) => lamp_step(subject, sight, light, drawn),
            None => headlight_step(reading, subject, drawn),
        });
    }
    steps.extend(drawn.map(|drawn| glyph_step(subject, drawn)));
    steps
}

pub(super) fn count_step(subject: &Subject) -> MachineStep {
    if subject.trace.method.is_routine() {
        return routine_step(subject);
    }
    let outcome = match subject.solution.class {
        Class::Miss => "Δ < 0: no point, the line misses",
        Class::Tangent => "Δ is 0: one point, the line touches",
        Class::Secant | Class::Hit => "Δ > 0: two points, the line crosses",
        Class::Nan => "Δ is not a number: the method has no answer",
    };
    let discriminant = &subject.trace.discriminant;
    MachineStep {
        numbers: format!("Δ: {}", discriminant.shortest(Glyphs::Unicode)),
        outcome: vec![outcome.into()],
        losses: subject.trace.verdict(Glyphs::Unicode).into_iter().collect(),
        questions: vec![StepQuestion::Count],
        code: "if (discr < 0) return false; else return true;".into(),
        ..MachineStep::plain(
            "verdict",
            "A square root of a negative number is no real number, so the sign of Δ decides.",
            "Δ below 0: none, 0: one, above 0: two",
        )
    }
}

/// What a routine says, in words.
fn routine_step(subject: &Subject) -> MachineStep {
    let solution = &subject.solution;
    let (class, near, far) = (solution.class, solution.near, solution.far);
    let outcome = match class {
        Class::Miss => "no hit".to_owned(),
        Class::Tangent => format!("one root: {}", n32(near)),
        Class::Secant => format!("two roots: {} and {}", n32(near), n32(far)),
        Class::Hit if near.is_nan() => "a hit".to_owned(),
        Class::Hit => format!("a hit at {}", n32(near)),
        Class::Nan => "no number: no answer".to_owned(),
    };
    MachineStep {
        outcome: vec![outcome],
        losses: subject.trace.verdict(Glyphs::Unicode).into_iter().collect(),
        questions: vec![StepQuestion::Count],
        ..MachineStep::plain(
            "verdict",
            "What came out of the routine.",
            "what it returned",
        )
    }
}

fn near_given(subject: &Subject) -> bool {
    !subject.solution.near.is_nan()
}

fn seen_step(subject: &Subject, is_first: bool) -> MachineStep {
    let seen = if is_first {
        "is seen"
    } else {
        "would be seen, but the ray meets another sphere first"
    };
    let [near, far] = [subject.solution.near, subject.solution.far].map(n32);
    let outcome = match subject.solution.place() {
        Some(Place::Hit) if subject.solution.near == 0.0 => {
            format!("0 < near, which rounds to 0, a hit: the near point {seen}")
        }
        Some(Place::Hit) if !near_given(subject) => "a hit, at no t that the routine gives".into(),
        Some(Place::Behind) if subject.solution.class == Class::Hit => {
            format!("{near} ≤ 0, behind: the ray does not meet it there")
        }
        Some(Place::Hit) => format!("0 < {near}, a hit: the near point {seen}"),
        Some(Place::Inside) if subject.solution.far == 0.0 => {
            format!("near ≤ 0 < far, which rounds to 0, inside: the far point {seen}")
        }
        Some(Place::Inside) => format!("{near} ≤ 0 < {far}, inside: the far point {seen}"),
        Some(Place::Behind) => {
            format!("{far} ≤ 0, behind: the line meets the sphere, the ray does not")
        }
        None => "no root: nothing of this sphere is seen".into(),
    };
    let numbers = match subject.solution.class {
        Class::Secant => format!("near: {near}  far: {far}"),
        Class::Tangent => format!("t: {near}"),
        Class::Hit if near_given(subject) => format!("t: {near}"),
        Class::Miss | Class::Nan | Class::Hit => String::new(),
    };
    MachineStep {
        numbers,
        outcome: vec![outcome],
        questions: vec![StepQuestion::Seen],
        code: "float t = near > 0 ? near : far;".into(),
        ..MachineStep::plain(
            "seen",
            "What is seen is the first point in front of the eye: the least t above 0.",
            "least t with t > 0",
        )
    }
}

/// Three binary32 beside what they should be, if that is known.
fn measured(v: Vec3, exact: Option<[Surd; 3]>) -> Quantity {
    let exact = exact.map_or_else(|| [const { None }; 3], |exact| exact.map(Some));
    let values = v.to_array().into_iter().zip(exact);
    let parts = values.map(|(value, exact)| Measured {
        value: value.into(),
        precision: Precision::Binary32,
        exact,
    });
    let parts: Vec<_> = parts.collect();
    Quantity::Vector(parts.into())
}

/// The exact point: p0 + t·d with the exact root; none where the method sees a root that is none.
fn exact_point(reading: &Reading, subject: &Subject) -> Option<[Surd; 3]> {
    let root = match subject.solution.place()? {
        Place::Hit => &subject.trace.near,
        Place::Inside => &subject.trace.far,
        Place::Behind => return None,
    };
    let t = root.as_ref()?.exact.as_ref()?;
    let [p0, d] = [reading.ray.origin, reading.ray.direction].map(|v| v.to_array());
    let along = |i: usize| {
        let [p0, d] = [p0[i], d[i]].map(|x| Surd::from_f64(x.into()));
        p0?.checked_add(&t.checked_mul(&d?)?)
    };
    Some([along(0)?, along(1)?, along(2)?])
}

fn point_step(reading: &Reading, subject: &Subject, sight: &Sight) -> MachineStep {
    let [p, d] = [reading.ray.origin, reading.ray.direction].map(v3);
    let point = measured(sight.point, exact_point(reading, subject));
    MachineStep {
        numbers: format!("{p} + {}·{d}", bracketed(&n32(sight.t))),
        result: v3(sight.point),
        code: "vector p = vectorAdd(&r->start, vectorScale(t, &r->dir));".into(),
        exact: exact(&point),
        number: point.parts().first().cloned(),
        ..MachineStep::plain(
            "p",
            "The root t put back into the ray gives the point.",
            "p0 + t·d",
        )
    }
}

fn check_step(subject: &Subject, point: Vec3) -> MachineStep {
    let out = point.as_dvec3() - subject.sphere.center.as_dvec3();
    let r = f64::from(subject.sphere.radius);
    let [left, right] = [out.length_squared(), r * r];
    let off = (left - right).abs() / right;
    let outcome = if left == right {
        "the point is on the sphere".to_owned()
    } else {
        let off = number(off, Precision::Binary64, Digits::Significant(2));
        format!("r² is {}: off by {off} of it", n64(right))
    };
    MachineStep {
        numbers: format!("|{}|²", v3(out.as_vec3())),
        result: n64(left),
        outcome: vec![outcome],
        code: "float left = vectorDot(&out, &out);".into(),
        ..MachineStep::plain(
            "check",
            "Is the point on the sphere? Put it into the sphere's equation.",
            "|p − c|² = r²",
        )
    }
}

fn normal_step(subject: &Subject, sight: &Sight) -> MachineStep {
    let out = sight.point.as_dvec3() - subject.sphere.center.as_dvec3();
    MachineStep {
        numbers: format!("{} / {}", v3(out.as_vec3()), n64(out.length())),
        result: v3(sight.normal),
        code: "vector n = vectorScale(1 / s->radius, &out);".into(),
        ..MachineStep::plain(
            "n",
            "The normal points straight out of the surface; it tells how the surface is turned.",
            "(p − c) / |p − c|",
        )
    }
}

/// The brightness that the picture has, to be shown; in another view, that it would have.
fn brightness(drawn: Option<&Drawn>, cosine: f64) -> String {
    let value = match drawn {
        Some(drawn) if drawn.view == View::Shade && !drawn.is_pending => {
            f64::from(drawn.brightness)
        }
        _ => AMBIENT + (1.0 - AMBIENT) * cosine.max(0.0),
    };
    three_digits(value)
}

fn three_digits(value: f64) -> String {
    number(value, Precision::Binary32, Digits::Significant(3))
}

/// `0.12 + 0.88·cosine`, the light that a surface gives back.
fn dimmed(cosine: f64) -> String {
    let lit = (1.0 - AMBIENT) * 100.0;
    format!(
        "{AMBIENT} + {}·{}",
        lit.round() / 100.0,
        bracketed(&n64(cosine))
    )
}

fn lamp_step(subject: &Subject, sight: &Sight, light: Light, drawn: Option<&Drawn>) -> MachineStep {
    let to_light = light.position.as_dvec3() - sight.point.as_dvec3();
    let outward = sight.normal.as_dvec3();
    let facing = match subject.solution.place() {
        Some(Place::Inside) => -outward,
        _ => outward,
    };
    let cosine = to_light.normalize_or(DVec3::ZERO).dot(facing);
    let numbers = if cosine < 0.0 {
        format!(
            "cos = {}: the surface is turned away, which counts as 0",
            n64(cosine)
        )
    } else {
        dimmed(cosine)
    };
    MachineStep {
        numbers,
        result: format!("brightness {}", brightness(drawn, cosine)),
        code: "float light = 0.12f + 0.88f * fmaxf(0, vectorDot(&n, &to_light));".into(),
        ..MachineStep::plain(
            "shade",
            "The more squarely the light falls on the surface, the brighter it is; a little is seen \
             where none falls.",
            "0.12 + 0.88·cos of the angle between n and the light",
        )
    }
}

fn headlight_step(reading: &Reading, subject: &Subject, drawn: Option<&Drawn>) -> MachineStep {
    let r = f64::from(subject.sphere.radius);
    let q = subject.coefficients;
    let cosine = (q.discriminant.max(0.0) / (4.0 * q.a * (r * r))).sqrt();
    let seen = reading
        .meetings
        .first()
        .is_some_and(|m| m.body == subject.body);
    let outcome = if seen {
        let bright = brightness(drawn, cosine);
        format!("brightness {} → {bright}", dimmed(cosine))
    } else {
        "another sphere is in front".into()
    };
    MachineStep {
        numbers: format!(
            "√({} / (4·{}·{}))",
            n64(q.discriminant),
            n64(q.a),
            n64(r * r)
        ),
        result: n64(cosine),
        outcome: vec![outcome],
        code: "float cosine = sqrtf(discr / (4 * A * s->radius * s->radius));".into(),
        ..MachineStep::plain(
            "shade",
            "The same Δ says how squarely the ray meets the surface: 1 head-on, 0 at the edge.",
            "cos θ = √(Δ / (4Ar²))",
        )
    }
}

/// What comes out of a picture that is still being made.
const PENDING: &str = "the picture is still being drawn";

fn glyph_step(subject: &Subject, drawn: &Drawn) -> MachineStep {
    let name = subject.name.as_deref().unwrap_or("the sphere");
    let (view, style) = (drawn.view, drawn.style);
    let why = match view {
        View::Shade => format!(
            "The picture shows how bright {name} is here, in the style {}.",
            style.name()
        ),
        view => format!(
            "The picture shows the {}, in the style {}.",
            view.name(),
            style.name()
        ),
    };
    if drawn.is_pending {
        return MachineStep {
            outcome: vec![PENDING.into()],
            ..MachineStep::plain("glyph", &why, "the character of this pixel")
        };
    }
    let shown = three_digits(drawn.brightness.into());
    let (formula, numbers) = match (view, style) {
        (_, Style::Tutorial) => (
            "++ for a point in common, -- for none".to_owned(),
            format!("a {}", subject.solution.class),
        ),
        (View::Shade, Style::Ascii) if subject.sight.is_some() => (
            format!(
                "brightness → one of the {} characters “{}”",
                RAMP.len(),
                String::from_utf8_lossy(RAMP)
            ),
            format!("no. ⌊{shown}·{}⌋ + 1 of them", RAMP.len()),
        ),
        (view, Style::Half) => (
            "the pixels of two rows, one above the other → one character".to_owned(),
            halves(drawn, view),
        ),
        (_, Style::Braille) => ("2 × 4 pixels → as many dots".to_owned(), String::new()),
        (view, Style::Ascii) => (format!("{} → character", view.name()), String::new()),
    };
    let meaning = match style {
        Style::Half => block_in_words(drawn),
        _ => "",
    };
    MachineStep {
        numbers,
        result: format!("“{}”{meaning}", drawn.glyph),
        ..MachineStep::plain("glyph", &why, &formula)
    }
}

/// The two pixels that share a cell in half blocks, each with its row.
fn halves(drawn: &Drawn, view: View) -> String {
    let shown = |brightness: f32| match view {
        View::Shade => format!(", brightness {}", three_digits(brightness.into())),
        _ => String::new(),
    };
    let this = format!("row {} (this pixel){}", drawn.row, shown(drawn.brightness));
    let other = format!("row {}{}", drawn.row ^ 1, shown(drawn.partner));
    if drawn.row.is_multiple_of(2) {
        format!("above: {this}; below: {other}")
    } else {
        format!("above: {other}; below: {this}")
    }
}

/// What a half block says of its two pixels.
fn block_in_words(drawn: &Drawn) -> &'static str {
    match (drawn.glyph, drawn.has_ground) {
        (' ', _) => ": nothing to draw in either",
        ('█', _) => ": both in one colour",
        ('▀', true) => ": the block in the upper one's colour, its ground in the lower one's",
        ('▄', true) => ": the block in the lower one's colour, its ground in the upper one's",
        ('▀' | '"', false) => ": only the upper one is drawn",
        ('▄' | ',', false) => ": only the lower one is drawn",
        ('#', _) => ": both are drawn",
        _ if drawn.view == View::Class => {
            ": a half for a line that crosses, a quarter for one that touches"
        }
        _ => "",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::explain::{Lens, sheet};
    use crate::method::Method;
    use crate::render::{ColorDepth, Frame, Image, Look, fit};
    use crate::scene::{Builtin, Rays};

    #[test]
    fn the_shade_is_the_same_number_in_every_view() {
        let scene = Builtin::Tutorial.scene();
        let shades = [View::Shade, View::Class, View::Depth].map(|view| {
            let (size, shape) = fit(&scene, Style::Half, 40, 20, 2.0);
            let rays = Rays::new(&scene.camera, size, shape);
            let mut frame = Frame::new();
            frame.render(&scene, &rays, Method::Exact, view);
            let mut image = Image::new();
            let look = Look {
                style: Style::Half,
                depth: ColorDepth::None,
                ascii_only: false,
                coarse: false,
            };
            image.draw(&frame, &scene, look);
            let reading = Reading::take(
                &scene,
                (15, 20),
                rays.ray(15, 20),
                Method::Exact,
                None,
                None,
            );
            let drawn = Drawn::at((15, 20), &frame, &image, Style::Half);
            let steps = sheet(
                Lens::Machine,
                &reading,
                Some(&scene),
                Some(&rays),
                Some(&drawn),
            );
            let shade = steps.iter().find(|step| step.name == "shade");
            shade.expect("a shade").outcome[0].clone()
        });
        assert!(shades[0].ends_with("→ 0.882"), "{}", shades[0]);
        assert_eq!([&shades[1], &shades[2]], [&shades[0]; 2]);
    }
}
