//! The steps after the quadratic: what its roots mean, the point that is seen, and how it is shown.

use glam::{DVec3, Vec3};

use super::{Drawn, Step, StepQuestion, bracketed, exact, n32, n64, v3};
use crate::explain::{Digits, Reading, Sight, Subject, number};
use crate::method::trace::{Measured, Quantity};
use crate::method::{Class, Method, Place, Precision, Surd};
use crate::render::{AMBIENT, RAMP, Style, View};
use crate::scene::{Light, Scene};
use crate::text::Glyphs;

pub(super) fn steps(
    reading: &Reading,
    subject: &Subject,
    scene: &Scene,
    drawn: &Drawn,
) -> Vec<Step> {
    let mut steps = vec![seen_step(subject)];
    if let Some(sight) = &subject.sight {
        steps.push(point_step(reading, subject, sight));
        steps.push(check_step(subject, sight.point));
        steps.push(normal_step(subject, sight));
        steps.push(match scene.light {
            Some(light) => lamp_step(subject, sight, light, drawn),
            None => headlight_step(reading, subject, drawn),
        });
    }
    steps.push(glyph_step(subject, drawn));
    steps
}

pub(super) fn count_step(subject: &Subject) -> Step {
    if subject.trace.method.is_routine() {
        return routine_step(subject);
    }
    let result = match subject.solution.class {
        Class::Miss => "Δ < 0: no point, the line misses",
        Class::Tangent => "Δ = 0: one point, the line touches",
        Class::Secant | Class::Hit => "Δ > 0: two points, the line crosses",
        Class::Nan => "Δ is not a number: the method has no answer",
    };
    let code = match subject.solution.class {
        Class::Miss => "if discriminant < 0.0 {",
        Class::Tangent => "} else if discriminant == 0.0 {",
        Class::Secant | Class::Hit => "} else if discriminant > 0.0 {",
        Class::Nan => "Self::Nan",
    };
    let discriminant = &subject.trace.discriminant;
    Step {
        numbers: format!("Δ = {}", discriminant.shortest(Glyphs::Unicode)),
        result: result.into(),
        losses: subject.trace.verdict(Glyphs::Unicode).into_iter().collect(),
        question: Some(StepQuestion::Count),
        code: code.into(),
        ..Step::plain(
            "verdict",
            "A square root of a negative number is no real number, so the sign of Δ decides.",
            "Δ < 0: none,  Δ = 0: one,  Δ > 0: two",
        )
    }
}

/// What a routine says, in words.
fn routine_step(subject: &Subject) -> Step {
    let solution = &subject.solution;
    let (class, near, far) = (solution.class, solution.near, solution.far);
    let result = match class {
        Class::Miss => "no hit".to_owned(),
        Class::Tangent => format!("one root: {}", n32(near)),
        Class::Secant => format!("two roots: {} and {}", n32(near), n32(far)),
        Class::Hit if near.is_nan() => "a hit".to_owned(),
        Class::Hit => format!("a hit at {}", n32(near)),
        Class::Nan => "no number: no answer".to_owned(),
    };
    Step {
        result,
        losses: subject.trace.verdict(Glyphs::Unicode).into_iter().collect(),
        question: Some(StepQuestion::Count),
        code: subject.trace.method.name().to_owned(),
        ..Step::plain(
            "verdict",
            "What came out of the routine.",
            "what it returned",
        )
    }
}

fn near_given(subject: &Subject) -> bool {
    !subject.solution.near.is_nan()
}

fn seen_step(subject: &Subject) -> Step {
    let [near, far] = [subject.solution.near, subject.solution.far].map(n32);
    let (result, code) = match subject.solution.place() {
        Some(Place::Hit) if subject.solution.near == 0.0 => (
            "0 < near, which rounds to 0, a hit: the near point is seen".into(),
            "Place::Hit => Some(self.near),",
        ),
        Some(Place::Hit) if !near_given(subject) => (
            "a hit, at no t that the routine gives".into(),
            "Place::Hit if self.near.is_nan() => Some(f32::INFINITY),",
        ),
        Some(Place::Behind) if subject.solution.class == Class::Hit => (
            format!("{near} ≤ 0, behind: the ray does not meet it there"),
            "Self::Behind => None,",
        ),
        Some(Place::Hit) => (
            format!("0 < {near}, a hit: the near point is seen, t = {near}"),
            "Self::Hit => Some(Which::Near),",
        ),
        Some(Place::Inside) if subject.solution.far == 0.0 => (
            "near ≤ 0 < far, which rounds to 0, inside: the far point is seen".into(),
            "Place::Inside => Some(self.far),",
        ),
        Some(Place::Inside) => (
            format!("{near} ≤ 0 < {far}, inside: the far point is seen, t = {far}"),
            "Self::Inside => Some(Which::Far),",
        ),
        Some(Place::Behind) => (
            format!("{far} ≤ 0, behind: the line meets the sphere, the ray does not"),
            "Self::Behind => None,",
        ),
        None => (
            "no root: nothing of this sphere is seen".into(),
            "place: class.meets().then_some(place),",
        ),
    };
    let numbers = match subject.solution.class {
        Class::Secant => format!("near = {near}, far = {far}"),
        Class::Tangent => format!("t = {near}"),
        Class::Hit if near_given(subject) => format!("t = {near}"),
        Class::Miss | Class::Nan | Class::Hit => String::new(),
    };
    Step {
        numbers,
        result,
        question: Some(StepQuestion::Seen),
        code: code.into(),
        ..Step::plain(
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

fn point_step(reading: &Reading, subject: &Subject, sight: &Sight) -> Step {
    let [p, d] = [reading.ray.origin, reading.ray.direction].map(v3);
    let point = measured(sight.point, exact_point(reading, subject));
    Step {
        numbers: format!("{p} + {}·{d}", bracketed(&n32(sight.t))),
        result: v3(sight.point),
        code: "let point = ray.origin.as_dvec3() + f64::from(t) * d;".into(),
        exact: exact(&point),
        number: point.parts().first().cloned(),
        ..Step::plain(
            "p",
            "The root t put back into the ray gives the point.",
            "p0 + t·d",
        )
    }
}

fn check_step(subject: &Subject, point: Vec3) -> Step {
    let out = point.as_dvec3() - subject.sphere.center.as_dvec3();
    let r = f64::from(subject.sphere.radius);
    let [left, right] = [out.length_squared(), r * r];
    let off = (left - right).abs() / right;
    let result = if left == right {
        format!("{} = {}: the point is on the sphere", n64(left), n64(right))
    } else {
        format!(
            "{} against {}: off by {} of r²",
            n64(left),
            n64(right),
            number(off, Precision::Binary64, Digits::Significant(2))
        )
    };
    Step {
        numbers: format!(
            "|{}|² against {}²",
            v3(out.as_vec3()),
            n32(subject.sphere.radius)
        ),
        result,
        code: "let [left, right] = [out.length_squared(), r * r];".into(),
        ..Step::plain(
            "check",
            "Is the point on the sphere? Put it into the sphere's equation.",
            "|p − c|² = r²",
        )
    }
}

fn normal_step(subject: &Subject, sight: &Sight) -> Step {
    let out = sight.point.as_dvec3() - subject.sphere.center.as_dvec3();
    Step {
        numbers: format!("{} / {}", v3(out.as_vec3()), n64(out.length())),
        result: v3(sight.normal),
        code: "let normal = out.try_normalize().unwrap_or(DVec3::ZERO);".into(),
        ..Step::plain(
            "n",
            "The normal points straight out of the surface; it tells how the surface is turned.",
            "(p − c) / |p − c|",
        )
    }
}

/// The brightness that the picture has, to be shown; in another view, that it would have.
fn brightness(drawn: &Drawn, cosine: f64) -> String {
    let value = match drawn.view {
        View::Shade if !drawn.is_pending => f64::from(drawn.brightness),
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

fn lamp_step(subject: &Subject, sight: &Sight, light: Light, drawn: &Drawn) -> Step {
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
    let code = match subject.trace.method {
        Method::Exact => "cosine(to_light, facing(outward, self.inside))",
        _ => "cosine(to_light, facing(outward, self.is_inside()))",
    };
    Step {
        numbers,
        result: format!("brightness {}", brightness(drawn, cosine)),
        code: code.into(),
        ..Step::plain(
            "shade",
            "The more squarely the light falls on the surface, the brighter it is; a little is seen \
             where none falls.",
            "0.12 + 0.88·cos of the angle between n and the light",
        )
    }
}

fn headlight_step(reading: &Reading, subject: &Subject, drawn: &Drawn) -> Step {
    let r = f64::from(subject.sphere.radius);
    let q = subject.coefficients;
    let cosine = (q.discriminant.max(0.0) / (4.0 * q.a * (r * r))).sqrt();
    let seen = reading
        .meetings
        .first()
        .is_some_and(|m| m.body == subject.body);
    let result = if seen {
        format!(
            "cos θ = {}, brightness {} = {}",
            n64(cosine),
            dimmed(cosine),
            brightness(drawn, cosine)
        )
    } else {
        format!("cos θ = {}; another sphere is in front", n64(cosine))
    };
    let code = match subject.trace.method {
        Method::Exact => "(reduced.at_least(0.0) / arr).sqrt()",
        _ => "(q.discriminant.at_least(0.0) / (4.0 * q.a * (r * r))).sqrt()",
    };
    Step {
        numbers: format!(
            "√({} / (4·{}·{}))",
            n64(q.discriminant),
            n64(q.a),
            n64(r * r)
        ),
        result,
        code: code.into(),
        ..Step::plain(
            "shade",
            "The same Δ says how squarely the ray meets the surface: 1 head-on, 0 at the edge.",
            "cos θ = √(Δ / (4Ar²))",
        )
    }
}

/// What comes out of a picture that is still being made.
const PENDING: &str = "the picture is still being drawn";

fn glyph_step(subject: &Subject, drawn: &Drawn) -> Step {
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
        return Step {
            result: PENDING.into(),
            ..Step::plain("glyph", &why, "")
        };
    }
    let shown = three_digits(drawn.brightness.into());
    let (formula, numbers, code) = match (view, style) {
        (_, Style::Tutorial) => (
            "++ for a point in common, -- for none".to_owned(),
            format!("a {}", subject.solution.class),
            "contact if contact.meets() => '+',",
        ),
        (View::Shade, Style::Ascii) if subject.sight.is_some() => (
            format!(
                "brightness → one of the {} characters “{}”",
                RAMP.len(),
                String::from_utf8_lossy(RAMP)
            ),
            format!("no. ⌊{shown}·{}⌋ + 1 of them", RAMP.len()),
            "RAMP[step(level, RAMP.len())].into()",
        ),
        (view, Style::Half) => (
            "the pixels of two rows, one above the other → one character".to_owned(),
            halves(drawn, view),
            "let glyph = quadrants(self.quarters(top), self.quarters(bottom));",
        ),
        (_, Style::Braille) => (
            "2 × 4 pixels → as many dots".to_owned(),
            String::new(),
            "ink.level > threshold || self.is_outline(x, y)",
        ),
        (view, Style::Ascii) => (
            format!("{} → character", view.name()),
            String::new(),
            "Some(ink) => Cell::of(ink.glyph, ink.color),",
        ),
    };
    let meaning = match style {
        Style::Half => block_in_words(drawn),
        _ => "",
    };
    Step {
        numbers,
        result: format!("“{}”{meaning}", drawn.glyph),
        code: code.into(),
        ..Step::plain("glyph", &why, &formula)
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
    use crate::explain::derivation::derivation;
    use crate::render::{ColorDepth, Frame, Image, Look, fit};
    use crate::scene::{Builtin, Rays};

    /// Where the code is that the steps around the quadratic quote.
    const SOURCE: [&str; 7] = [
        include_str!("../../scene/camera.rs"),
        include_str!("../../geometry.rs"),
        include_str!("../../method/mod.rs"),
        include_str!("../mod.rs"),
        include_str!("../../render/shade.rs"),
        include_str!("../../render/ink.rs"),
        include_str!("../../render/image.rs"),
    ];

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
            let steps = derivation(&reading, &scene, &rays, &drawn);
            let shade = steps.iter().find(|step| step.name == "shade");
            shade.expect("a shade").result.clone()
        });
        assert!(shades[0].ends_with("= 0.882"), "{}", shades[0]);
        assert_eq!([&shades[1], &shades[2]], [&shades[0]; 2]);
    }

    #[test]
    fn every_step_has_a_line_of_code_that_is_in_the_program() {
        for scene in Builtin::ALL.map(Builtin::scene) {
            for (style, view) in Style::ALL
                .into_iter()
                .zip([View::Shade, View::Class].repeat(2))
            {
                for method in [Method::Textbook, Method::Exact] {
                    let (size, shape) = fit(&scene, style, 20, 10, 2.0);
                    let rays = Rays::new(&scene.camera, size, shape);
                    let mut frame = Frame::new();
                    frame.render(&scene, &rays, method, view.shown_in(style));
                    let mut image = Image::new();
                    let look = Look {
                        style,
                        depth: ColorDepth::None,
                        ascii_only: false,
                        coarse: false,
                    };
                    image.draw(&frame, &scene, look);
                    for (x, y) in [(0, 0), (size.width / 2, size.height / 2)] {
                        let ray = rays.ray(x, y);
                        let reading = Reading::take(&scene, (x, y), ray, method, None, None);
                        let drawn = Drawn::at((x, y), &frame, &image, style);
                        for step in derivation(&reading, &scene, &rays, &drawn) {
                            // Those of the methods have a test of their own.
                            let own = reading
                                .subject
                                .as_ref()
                                .expect("a sphere")
                                .trace
                                .step(&step.name);
                            let here = include_str!("seen.rs").matches(&step.code).count();
                            let found = SOURCE.iter().any(|file| file.contains(&step.code))
                                || here > 1
                                || step.code.starts_with("(done on paper");
                            assert!(!step.code.is_empty(), "{}", step.name);
                            assert!(own.is_some() || found, "{}: {}", step.name, step.code);
                            assert!(!step.why.is_empty() && !step.formula.is_empty());
                            assert!(!step.result.is_empty(), "{}", step.name);
                        }
                    }
                }
            }
        }
    }
}
