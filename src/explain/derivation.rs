//! The derivation of one pixel, step by step: from the pixel to its ray, through the quadratic as the
//! method works it, to the point that is seen and the character that shows it.
//!
//! The steps of the quadratic are the method's own trace. The steps before and after it are those
//! of the camera and of the picture.

use glam::Vec3;

use super::{Digits, Reading, Subject, number, vector};
use crate::method::format::Signs;
use crate::method::trace::{self, Measured, Trace};
use crate::method::{Class, Method, Place, Precision};
use crate::render::{Frame, Image, Style};
use crate::scene::{Projection, Rays, Scene};

/// What the picture made of a pixel.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawn {
    /// From 0 to 1, of the nearest hit.
    pub brightness: f32,
    /// The character of the cell that shows the pixel.
    pub glyph: char,
    /// The style in words: `half`, `ascii`.
    pub style: &'static str,
    /// What the picture shows: `shade`, `class`.
    pub view: &'static str,
}

impl Drawn {
    /// What a frame and its image made of pixel (x, y).
    pub fn at((x, y): (u32, u32), frame: &Frame, image: &Image, style: Style) -> Self {
        let (col, row) = style.cell_of_pixel(x, y);
        Self {
            brightness: frame.brightness(x, y),
            glyph: image.cell(col, row).map_or(' ', |cell| cell.glyph),
            style: style.name(),
            view: frame.view().name(),
        }
    }
}

/// One step of the derivation of a pixel.
#[derive(Debug, Clone)]
pub struct Step {
    /// A word or a letter for the list of steps.
    pub name: String,
    /// Why the step is done, in a sentence.
    pub why: String,
    /// The formula in letters.
    pub formula: String,
    /// The formula with this pixel's numbers.
    pub numbers: String,
    /// What comes out.
    pub result: String,
    /// The line of the program that does it.
    pub code: String,
    /// What would come out without rounding, and how far off the result is; nothing if it is right.
    pub exact: Option<String>,
    /// What the operations of the step lost, in sentences.
    pub losses: Vec<String>,
    /// Whether this is the first step that loses much.
    pub first_heavy: bool,
    /// What a student may be asked before the result is shown.
    pub question: Option<Question>,
    /// The number whose bits are worth a look.
    pub number: Option<Measured>,
}

/// A question that a step answers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Question {
    /// Is Δ below, equal to or above zero?
    Sign,
    /// How many points have line and sphere in common?
    Count,
    /// Which root is seen?
    Seen,
}

impl Question {
    /// The question as it is asked.
    pub const fn text(self) -> &'static str {
        match self {
            Self::Sign => "Is Δ negative, zero or positive?",
            Self::Count => "How many points do line and sphere share?",
            Self::Seen => "Which root is seen?",
        }
    }

    /// The keys that answer, each with what it says; the right one is at place [`Question::right`].
    pub const fn answers(self) -> [(char, &'static str); 3] {
        match self {
            Self::Sign => [('-', "negative"), ('0', "zero"), ('+', "positive")],
            Self::Count => [('0', "none"), ('1', "one"), ('2', "two")],
            Self::Seen => [('0', "neither"), ('n', "near"), ('f', "far")],
        }
    }

    /// The place of the right answer; none where the method has no answer.
    pub fn right(self, subject: &Subject) -> Option<usize> {
        let class = match subject.solution.class {
            Class::Miss => 0,
            Class::Tangent => 1,
            Class::Secant => 2,
            Class::Nan => return None,
        };
        Some(match self {
            Self::Sign | Self::Count => class,
            Self::Seen => match subject.solution.place() {
                Some(Place::Hit) => 1,
                Some(Place::Inside) => 2,
                Some(Place::Behind) | None => 0,
            },
        })
    }
}

/// All steps for the pixel of a reading; empty in a scene without spheres.
pub fn derivation(reading: &Reading, scene: &Scene, rays: &Rays, drawn: &Drawn) -> Vec<Step> {
    let Some(subject) = &reading.subject else {
        return Vec::new();
    };
    let mut steps = vec![
        pixel_step(reading, scene, rays),
        ray_step(reading),
        sphere_step(subject),
        substitution_step(),
    ];
    steps.extend(quadratic_steps(&subject.trace));
    steps.push(count_step(subject));
    steps.push(seen_step(subject));
    if let Some(sight) = subject.sight {
        steps.push(point_step(reading, sight.t, sight.point));
        steps.push(check_step(subject, sight.point));
        steps.push(normal_step(subject, sight.point, sight.normal));
        steps.push(shade_step(reading, subject, scene, drawn));
    }
    steps.push(glyph_step(subject, drawn));
    steps
}

const DIGITS: Digits = Digits::Significant(7);

fn n32(x: f32) -> String {
    number(x.into(), Precision::Binary32, DIGITS)
}

fn n64(x: f64) -> String {
    number(x, Precision::Binary64, DIGITS)
}

fn v3(v: Vec3) -> String {
    format!("({})", vector(v, DIGITS))
}

impl Step {
    fn plain(name: &str, why: &str, formula: &str) -> Self {
        Self {
            name: name.into(),
            why: why.into(),
            formula: formula.into(),
            numbers: String::new(),
            result: String::new(),
            code: String::new(),
            exact: None,
            losses: Vec::new(),
            first_heavy: false,
            question: None,
            number: None,
        }
    }
}

fn pixel_step(reading: &Reading, scene: &Scene, rays: &Rays) -> Step {
    let (x, y) = reading.pixel;
    let from_center = |at: u32, count: u32| f64::from(at) - (f64::from(count) - 1.0) / 2.0;
    let [u, v] = [
        from_center(x, rays.size.width),
        from_center(y, rays.size.height),
    ];
    let (why, formula) = match scene.camera.projection {
        Projection::Orthographic { .. } => (
            "Every pixel looks the same way, each from its own place on the screen.",
            "p0 = eye + u·right + v·down,  d = forward",
        ),
        Projection::Perspective { .. } => (
            "Every pixel looks from the same eye, each in its own direction.",
            "p0 = eye,  d = forward + u·right + v·down",
        ),
    };
    Step {
        numbers: format!(
            "pixel ({x}, {y}) of {}: u = {}, v = {}",
            rays.size,
            n64(u),
            n64(v)
        ),
        result: format!(
            "p0 = {}  d = {}",
            v3(reading.ray.origin),
            v3(reading.ray.direction)
        ),
        code: "let ray = rays.ray(x, y);".into(),
        ..Step::plain("pixel", why, formula)
    }
}

fn ray_step(reading: &Reading) -> Step {
    let [p, d] = [reading.ray.origin, reading.ray.direction].map(|v| v.to_array());
    let along = |i: usize| format!("{} + {}t", n32(p[i]), bracketed(&n32(d[i])));
    Step {
        numbers: format!("p(t) = ({}, {}, {})", along(0), along(1), along(2)),
        code: "self.origin + t * self.direction".into(),
        ..Step::plain(
            "ray",
            "One number t names every point of the line; t > 0 is in front of the eye.",
            "p(t) = p0 + t·d",
        )
    }
}

fn sphere_step(subject: &Subject) -> Step {
    let [cx, cy, cz] = subject.sphere.center.to_array().map(|x| bracketed(&n32(x)));
    let r = n32(subject.sphere.radius);
    Step {
        numbers: format!("(x − {cx})² + (y − {cy})² + (z − {cz})² = {r}²"),
        ..Step::plain(
            "sphere",
            "A point is on the sphere if its distance from the centre is the radius.",
            "(p − c)·(p − c) = r²",
        )
    }
}

fn substitution_step() -> Step {
    Step {
        numbers: "(d·d) t² + 2 d·(p0−c) t + |p0−c|² − r² = 0".into(),
        result: "At² + Bt + C = 0".into(),
        ..Step::plain(
            "insert",
            "Put the point of the ray into the sphere's equation: what is left is a quadratic in t.",
            "(p0 + t·d − c)·(p0 + t·d − c) = r²",
        )
    }
}

/// The steps of the method itself, as it traced them.
fn quadratic_steps(trace: &Trace) -> Vec<Step> {
    let heavy = trace.first_heavy_loss();
    let signs = Signs::Typographic;
    let step = |(at, step): (usize, &trace::Step)| {
        let off = step.result.ulps().filter(|&ulps| ulps != 0.0);
        let exact = off.and_then(|ulps| {
            let exact = step.result.exact_text(12, signs)?;
            Some(format!(
                "{exact}, {} ulp off",
                trace::ulps_text(ulps, signs)
            ))
        });
        Step {
            numbers: step.numbers.clone(),
            result: step.result.text(signs),
            code: step.code.into(),
            exact,
            losses: step.losses.iter().map(|l| l.sentence(signs)).collect(),
            first_heavy: heavy == Some(at),
            question: is_discriminant(step.symbol, trace.method).then_some(Question::Sign),
            number: step.result.parts().first().cloned(),
            ..Step::plain(step.symbol, step.why, step.formula)
        }
    };
    trace.steps.iter().enumerate().map(step).collect()
}

/// Whether the sign of the step of that symbol decides the class.
fn is_discriminant(symbol: &str, method: Method) -> bool {
    match method {
        Method::Textbook => symbol == "Δ",
        _ => symbol == "D" || symbol == "Δ",
    }
}

fn count_step(subject: &Subject) -> Step {
    let result = match subject.solution.class {
        Class::Miss => "Δ < 0: no point, the line misses",
        Class::Tangent => "Δ = 0: one point, the line touches",
        Class::Secant => "Δ > 0: two points, the line crosses",
        Class::Nan => "Δ is not a number: the method has no answer",
    };
    Step {
        result: result.into(),
        losses: subject
            .trace
            .verdict(Signs::Typographic)
            .into_iter()
            .collect(),
        question: Some(Question::Count),
        code: "Class::of_discriminant(discriminant)".into(),
        ..Step::plain(
            "verdict",
            "A square root of a negative number is no real number, so the sign of Δ decides.",
            "Δ < 0: none,  Δ = 0: one,  Δ > 0: two",
        )
    }
}

fn seen_step(subject: &Subject) -> Step {
    let [near, far] = [subject.solution.near, subject.solution.far].map(n32);
    let (numbers, result) = match subject.solution.place() {
        Some(Place::Hit) => (
            format!("0 < {near}"),
            format!("hit: the near point is seen, t = {near}"),
        ),
        Some(Place::Inside) => (
            format!("{near} ≤ 0 < {far}"),
            format!("inside: the far point is seen, t = {far}"),
        ),
        Some(Place::Behind) => (
            format!("{far} ≤ 0"),
            "behind: the line meets the sphere, the ray does not".into(),
        ),
        None => ("no root".into(), "nothing of this sphere is seen".into()),
    };
    Step {
        numbers,
        result,
        question: Some(Question::Seen),
        code: "solution.visible()".into(),
        ..Step::plain(
            "seen",
            "What is seen is the first point in front of the eye: the least t above 0.",
            "least t with t > 0",
        )
    }
}

fn point_step(reading: &Reading, t: f32, point: Vec3) -> Step {
    let [p, d] = [reading.ray.origin, reading.ray.direction].map(v3);
    Step {
        numbers: format!("{p} + {}·{d}", n32(t)),
        result: v3(point),
        code: "let point = origin + t * direction;".into(),
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
        ..Step::plain(
            "check",
            "Is the point on the sphere? Put it into the sphere's equation.",
            "|p − c|² = r²",
        )
    }
}

fn normal_step(subject: &Subject, point: Vec3, normal: Vec3) -> Step {
    let out = point - subject.sphere.center;
    Step {
        numbers: format!("{} / {}", v3(out), n32(subject.sphere.radius)),
        result: v3(normal),
        code: "let normal = (point - center) / radius;".into(),
        ..Step::plain(
            "n",
            "The normal points straight out of the surface; it tells how the surface is turned.",
            "(p − c) / r",
        )
    }
}

fn shade_step(reading: &Reading, subject: &Subject, scene: &Scene, drawn: &Drawn) -> Step {
    let brightness = number(
        drawn.brightness.into(),
        Precision::Binary32,
        Digits::Significant(3),
    );
    if scene.light.is_some() {
        return Step {
            result: format!("brightness {brightness}"),
            code: "lambert(ray, sphere, t, light)".into(),
            ..Step::plain(
                "shade",
                "The more squarely the light falls on the surface, the brighter it is.",
                "0.12 + 0.88 · cos(angle of light and normal)",
            )
        };
    }
    let r = f64::from(subject.sphere.radius);
    let q = subject.coefficients;
    let cosine = (q.discriminant.max(0.0) / (4.0 * q.a * (r * r))).sqrt();
    let seen = reading
        .meetings
        .first()
        .is_some_and(|m| m.body == subject.body);
    let result = if seen {
        format!("cos θ = {}, brightness {brightness}", n64(cosine))
    } else {
        format!("cos θ = {}; another sphere is in front", n64(cosine))
    };
    Step {
        numbers: format!("√({} / (4·A·r²))", n64(subject.coefficients.discriminant)),
        result,
        code: "(q.discriminant / (4.0 * q.a * (r * r))).sqrt()".into(),
        ..Step::plain(
            "shade",
            "The same Δ says how squarely the ray meets the surface: 1 head-on, 0 at the edge.",
            "cos θ = √(Δ / (4Ar²))",
        )
    }
}

fn glyph_step(subject: &Subject, drawn: &Drawn) -> Step {
    let name = subject.name.as_deref().unwrap_or("the sphere");
    let why = match drawn.view {
        "shade" => format!(
            "The picture shows how bright {name} is here, in the style {}.",
            drawn.style
        ),
        view => format!(
            "The picture shows the {view}, in the style {}.",
            drawn.style
        ),
    };
    Step {
        result: format!("“{}”", drawn.glyph),
        ..Step::plain("glyph", &why, "brightness → character")
    }
}

fn bracketed(value: &str) -> String {
    if value.starts_with('−') {
        format!("({value})")
    } else {
        value.to_owned()
    }
}
