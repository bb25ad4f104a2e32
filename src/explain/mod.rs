//! What one pixel found, in numbers and words: the side panel without a terminal.
//!
//! A [`Reading`] is everything that the panel shows for the ray of one pixel. [`lines`] lays it
//! out as lines of text with roles; the explorer colours them, `print --pixel` writes them as
//! they are.

mod acne;
mod author;
mod compare;
mod equation;
mod figure;
mod lens;
mod number;
mod panel;
mod plan;
mod question;
mod sheet;
pub mod worksheet;

use std::cmp::Ordering;
use std::sync::{Arc, OnceLock};

use glam::{DVec3, Vec3};

use crate::geometry::{Ray, Sphere};
use crate::method::{Class, Coefficients, Method, Place, Solution, Trace};
use crate::scene::{Body, Scene};

pub use acne::acne_words;
pub use author::{always_true, has_numbers, told};
pub use compare::{comparison, measured_bits};
pub use equation::{Sign, sign_of_shown};
pub use figure::{
    FigureInk, Float, Landmark, PlaneLine, bits, curve, landmarks, plane, plane_lines, slice,
    turning, work,
};
pub use lens::Lens;
pub use number::{Digits, number, vector};
pub use panel::{Line, Role, Span, fit, lines, plain_text};
pub use plan::{
    FramePlan, PlanLine, Plans, plan_lines, plan_panel, plan_sentence, plans_report, plans_table,
};
pub use question::{Choice, Judgement, StepQuestion};
pub use sheet::{
    Drawn, Equation, LedgerEntry, Link, SheetLook, Step, StepData, question_lines, sheet,
    sheet_lines, sheet_report, sheet_text, step_lines,
};
pub use worksheet::Worksheet;

/// What the ray of one pixel finds in a scene.
#[derive(Debug, Clone)]
pub struct Reading {
    /// The pixel, from 0 at the top left.
    pub pixel: (u32, u32),
    /// Its ray.
    pub ray: Ray,
    /// The method that was asked.
    pub method: Method,
    /// How many spheres the scene has.
    pub spheres: usize,
    /// All spheres that the line meets: what is seen first, then what is behind.
    pub meetings: Vec<Meeting>,
    /// The sphere whose quadratic is shown; none in an empty scene.
    pub subject: Option<Subject>,
    /// The sphere that the method sees and the one that is in front, if these are two.
    pub other_sphere: Option<[usize; 2]>,
    /// The other spheres that the method gets wrong.
    pub wrong: Vec<Wrong>,
}

/// A sphere about which a method says another class than is right.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Wrong {
    /// Number of the sphere in the scene, from 0.
    pub body: usize,
    /// What the method says.
    pub said: Class,
    /// What is right.
    pub right: Class,
}

/// A sphere that the line of the ray meets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Meeting {
    /// Number of the sphere in the scene, from 0.
    pub body: usize,
    /// The class and the roots.
    pub solution: Solution,
}

/// The sphere whose quadratic is shown, with what came out of it.
#[derive(Debug, Clone)]
pub struct Subject {
    /// Number of the sphere in the scene, from 0.
    pub body: usize,
    /// Its shape and place.
    pub sphere: Sphere,
    /// What its author calls it.
    pub name: Option<Box<str>>,
    /// How it came to be the one shown.
    pub why: Why,
    /// A, B, C and Δ.
    pub coefficients: Coefficients,
    /// The class and the roots.
    pub solution: Solution,
    /// The method's own steps, each beside what it would have got without rounding.
    pub trace: Trace,
    /// What is seen of it.
    pub sight: Option<Sight>,
    /// Its quadratic, worked exactly; made when it is asked for.
    worked: OnceLock<Arc<sheet::WorkedQuadratic>>,
    ray: Ray,
}

impl Subject {
    /// Its quadratic, worked exactly.
    fn worked(&self) -> Arc<sheet::WorkedQuadratic> {
        let work = || Arc::new(sheet::WorkedQuadratic::new(&self.ray, &self.sphere, false));
        Arc::clone(self.worked.get_or_init(work))
    }

    /// Judges the answer to a question about it; says what was expected where it is none.
    pub fn judge(&self, question: StepQuestion, answer: &str) -> Result<Judgement, String> {
        let quadratic = &self.worked();
        let place = self.trace.truth.place();
        question.judge(answer, &question::Given { quadratic, place })
    }

    /// The right answer to a question about it.
    pub fn right_answer(&self, question: StepQuestion) -> String {
        let quadratic = &self.worked();
        let place = self.trace.truth.place();
        question.right(&question::Given { quadratic, place })
    }
}

/// The visible point of a sphere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sight {
    /// The visible root.
    pub t: f32,
    /// p = p0 + t·d.
    pub point: Vec3,
    /// The outward unit normal (p − c)/r; zero for a point sphere.
    pub normal: Vec3,
    /// cos θ between the ray and the normal, turned to the eye.
    pub cosine: f32,
}

/// Why a sphere is the one shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Why {
    /// It is the nearest one that the ray hits.
    NearestHit,
    /// The person chose it among those on the line.
    Chosen,
    /// The ray hits nothing, but its line meets this one behind the eye.
    Behind,
    /// The ray hits nothing, and this one is selected.
    Selected,
    /// The ray hits nothing, and this one is the nearest to being hit: it has the largest Δ/(4Ar²).
    NearestMiss,
}

impl Why {
    /// The reason in a few words.
    pub const fn words(self) -> &'static str {
        match self {
            Self::NearestHit => "nearest hit",
            Self::Chosen => "chosen",
            Self::Behind => "behind the eye",
            Self::Selected => "selected",
            Self::NearestMiss => "nearest to being hit",
        }
    }
}

impl Reading {
    /// Asks `method` about one ray and one sphere, without a scene.
    pub fn alone(ray: Ray, sphere: Sphere, method: Method) -> Self {
        let body = Body {
            sphere,
            name: None,
            color: None,
        };
        let subject = subject((0, &body), Why::Chosen, &ray, method);
        let solution = subject.solution;
        let met = solution.class.meets();
        Self {
            pixel: (0, 0),
            ray,
            method,
            spheres: 1,
            meetings: met
                .then_some(Meeting { body: 0, solution })
                .into_iter()
                .collect(),
            subject: Some(subject),
            other_sphere: None,
            wrong: Vec::new(),
        }
    }

    /// Asks `method` about every sphere of `scene` along `ray`.
    ///
    /// Shown is the `chosen` sphere if the line meets it, else the nearest hit, else one that the line
    /// meets behind the eye, the `selected` one before others, else the `selected` one, else the one
    /// nearest to being hit.
    pub fn take(
        scene: &Scene,
        pixel: (u32, u32),
        ray: Ray,
        method: Method,
        selected: Option<usize>,
        chosen: Option<usize>,
    ) -> Self {
        let meetings = meetings(scene, &ray, method);
        let pick = meetings
            .iter()
            .find(|m| Some(m.body) == chosen)
            .map(|m| (m.body, Why::Chosen))
            .or_else(|| {
                let first = meetings.first()?;
                first.solution.visible()?;
                Some((first.body, Why::NearestHit))
            })
            .or_else(|| {
                let met = |m: &&Meeting| Some(m.body) == selected;
                let behind = meetings.iter().find(met).or(meetings.first())?;
                Some((behind.body, Why::Behind))
            })
            .or_else(|| {
                let selected = selected.filter(|&s| s < scene.bodies.len())?;
                Some((selected, Why::Selected))
            })
            .or_else(|| Some((nearest_miss(&scene.bodies, &ray)?, Why::NearestMiss)));
        let shown = pick.map(|(body, _)| body);
        Self {
            pixel,
            ray,
            method,
            spheres: scene.bodies.len(),
            other_sphere: other_sphere(scene, &ray, method, &meetings),
            wrong: wrong(scene, &ray, method, shown),
            subject: pick
                .map(|(body, why)| subject((body, &scene.bodies[body]), why, &ray, method)),
            meetings,
        }
    }
}

impl Reading {
    /// Whether nothing is met before this sphere.
    fn is_first(&self, subject: &Subject) -> bool {
        let first = self.meetings.first();
        first.is_some_and(|meeting| meeting.body == subject.body)
    }

    /// Where this method is wrong about the pixel, held to the reading of `exact`: what is wrong.
    pub fn disagreement(&self, exact: &Self) -> Option<String> {
        let method = self.method;
        if let Some([seen, right]) = self.other_sphere {
            let [seen, right] = [seen + 1, right + 1];
            return Some(format!("{method} sees sphere {seen} here, not {right}"));
        }
        let first = |reading: &Self| {
            let first = reading.meetings.first()?;
            Some((first.body, first.solution.visible()?))
        };
        match (first(self), first(exact)) {
            (None, Some(_)) => return Some(format!("{method} sees nothing here")),
            (Some(_), None) => return Some(format!("{method} sees a sphere here")),
            (Some((_, t)), Some((_, right))) if (t - right).abs() > right / 1000.0 => {
                return Some(format!("{method} has t at {t} here"));
            }
            _ => {}
        }
        let [said, right] = [self, exact].map(|r| r.subject.as_ref());
        let (said, right) = said.zip(right).filter(|(s, r)| s.body == r.body)?;
        let wrong = said.solution.class != right.solution.class;
        wrong.then(|| format!("{method} says {} here", said.solution.class))
    }
}

fn meetings(scene: &Scene, ray: &Ray, method: Method) -> Vec<Meeting> {
    let mut meetings: Vec<_> = found(scene, ray, method).collect();
    let order = |m: &Meeting, n: &Meeting| order(scene, ray, method, m, n);
    if method == Method::Exact {
        // Of spheres whose roots round alike a question is dear: so first about in order.
        meetings.sort_by_cached_key(|m| {
            let sphere = &scene.bodies[m.body].sphere;
            // Numbers above 0 are in the order of their bits.
            about_where_seen(ray, sphere, m.solution).max(0.0).to_bits()
        });
        if put_in_order(&mut meetings, order) {
            return meetings;
        }
    }
    meetings.sort_by(order);
    meetings
}

/// Puts what is nearly in order in order, by little more than a question for each; false if it is not so
/// near.
fn put_in_order<T>(list: &mut [T], order: impl Fn(&T, &T) -> Ordering) -> bool {
    let mut moves = 0;
    for end in 1..list.len() {
        let mut i = end;
        while i > 0 && order(&list[i - 1], &list[i]).is_gt() {
            list.swap(i - 1, i);
            i -= 1;
            moves += 1;
            if moves > list.len() {
                return false;
            }
        }
    }
    true
}

/// All spheres that the line of a ray meets.
fn found(scene: &Scene, ray: &Ray, method: Method) -> impl Iterator<Item = Meeting> {
    let found = scene
        .bodies
        .iter()
        .enumerate()
        .map(move |(body, b)| Meeting {
            body,
            solution: method.solve(ray, &b.sphere),
        });
    found.filter(|m| m.solution.class.meets())
}

/// About which root is seen of a sphere, in binary64; ∞ if none is.
fn about_where_seen(ray: &Ray, sphere: &Sphere, solution: Solution) -> f64 {
    let d = ray.direction.as_dvec3();
    let o = ray.origin.as_dvec3() - sphere.center.as_dvec3();
    let r = f64::from(sphere.radius);
    let half = (r * r * d.length_squared() - o.cross(d).length_squared())
        .max(0.0)
        .sqrt();
    let side = match solution.place() {
        Some(Place::Hit) => -half,
        Some(Place::Inside) => half,
        _ => return f64::INFINITY,
    };
    (side - o.dot(d)) / d.length_squared()
}

/// Which comes first: of two spheres at equal t the first listed, as in the picture.
fn order(scene: &Scene, ray: &Ray, method: Method, m: &Meeting, n: &Meeting) -> Ordering {
    let met = |m: &Meeting| (&scene.bodies[m.body].sphere, m.solution);
    method.order(ray, met(m), met(n)).then(m.body.cmp(&n.body))
}

/// The sphere that the method sees and the one that is in front, if these are two.
fn other_sphere(scene: &Scene, ray: &Ray, method: Method, met: &[Meeting]) -> Option<[usize; 2]> {
    let visible = |first: &Meeting| first.solution.visible().map(|_| first.body);
    let seen = met.first().and_then(visible);
    let seen = seen.filter(|_| method != Method::Exact)?;
    let exact = Method::Exact;
    let right = found(scene, ray, exact).min_by(|m, n| order(scene, ray, exact, m, n));
    let right = right.as_ref().and_then(visible)?;
    (seen != right).then_some([seen, right])
}

/// The spheres but the one that is shown whose class the method gets wrong.
fn wrong(scene: &Scene, ray: &Ray, method: Method, shown: Option<usize>) -> Vec<Wrong> {
    if method == Method::Exact {
        return Vec::new();
    }
    let others = scene.bodies.iter().enumerate();
    let others = others.filter(|&(body, _)| Some(body) != shown);
    let judged = others.map(|(body, b)| {
        let [said, right] = [method, Method::Exact].map(|m| m.solve(ray, &b.sphere).class);
        Wrong { body, said, right }
    });
    judged.filter(|wrong| wrong.said != wrong.right).collect()
}

/// The sphere with the largest Δ/(4Ar²) = 1 − (p/r)², where p is the line's distance from its centre.
fn nearest_miss(bodies: &[Body], ray: &Ray) -> Option<usize> {
    let d = ray.direction.as_dvec3();
    let closeness = |body: &Body| {
        let o = ray.origin.as_dvec3() - body.sphere.center.as_dvec3();
        let r = f64::from(body.sphere.radius);
        let distance_squared = o.cross(d).length_squared() / d.length_squared();
        1.0 - distance_squared / (r * r)
    };
    (0..bodies.len()).max_by(|&i, &j| {
        let key = |i: usize| {
            let closeness = closeness(&bodies[i]);
            if closeness.is_nan() {
                f64::NEG_INFINITY
            } else {
                closeness
            }
        };
        key(i).total_cmp(&key(j)).then(j.cmp(&i))
    })
}

fn subject(
    (body, Body { sphere, name, .. }): (usize, &Body),
    why: Why,
    ray: &Ray,
    method: Method,
) -> Subject {
    let solution = method.solve(ray, sphere);
    Subject {
        body,
        sphere: *sphere,
        name: name.clone(),
        why,
        coefficients: method.coefficients(ray, sphere),
        solution,
        trace: method.trace(ray, sphere),
        sight: solution.visible().map(|t| sight(ray, sphere, &solution, t)),
        worked: OnceLock::new(),
        ray: *ray,
    }
}

/// The visible point, its normal, and the angle at which the ray meets the surface.
fn sight(ray: &Ray, sphere: &Sphere, solution: &Solution, t: f32) -> Sight {
    let d = ray.direction.as_dvec3();
    let point = ray.origin.as_dvec3() + f64::from(t) * d;
    let out = point - sphere.center.as_dvec3();
    let normal = out.try_normalize().unwrap_or(DVec3::ZERO);
    let towards_eye = if solution.place() == Some(Place::Inside) {
        -normal
    } else {
        normal
    };
    Sight {
        t,
        point: point.as_vec3(),
        normal: normal.as_vec3(),
        cosine: (-d.normalize_or_zero()).dot(towards_eye) as f32,
    }
}
