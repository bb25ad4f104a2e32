//! A worksheet: exercises about pixels of a scene for pencil and paper, and their answers apart.
//!
//! The pixels are drawn by a seed. Of those that show the same thing the ones with the shortest
//! numbers are taken, and where the camera makes long ones they are rounded first, so that the answers
//! are those of the numbers on the sheet.

mod decimal;
mod exercise;
mod question;
mod text;

use super::nearest_miss;
use crate::geometry::Ray;
use crate::method::{Class, Method, Place};
use crate::random::Random;
use crate::scene::{Rays, Scene, Size};
use exercise::Exercise;
pub use text::Part;

/// Exercises about pixels of one scene.
#[derive(Debug, Clone)]
pub struct Worksheet {
    scene: String,
    see: String,
    about: Option<String>,
    seed: u64,
    size: Size,
    exercises: Vec<Exercise>,
}

/// What an exercise is about, the easier ones first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Kind {
    /// Points of a ray.
    Along,
    /// Two points in front of the eye.
    Secant,
    /// No point.
    Miss,
    /// One point.
    Tangent,
    /// The eye is inside.
    Inside,
    /// The sphere is behind the eye.
    Behind,
    /// Two spheres on a line.
    Two,
    /// A discriminant that binary32 gets wrong.
    Rounding,
}

impl Kind {
    /// How many exercises of it a sheet has at most.
    const fn most(self) -> usize {
        match self {
            Self::Along => 1,
            Self::Rounding => 3,
            _ => usize::MAX,
        }
    }

    const ALL: [Self; 8] = [
        Self::Along,
        Self::Secant,
        Self::Miss,
        Self::Tangent,
        Self::Inside,
        Self::Behind,
        Self::Two,
        Self::Rounding,
    ];
}

/// A pixel that shows something to ask about.
#[derive(Debug, Clone, Copy)]
struct ProblemPixel {
    pixel: (u32, u32),
    ray: Ray,
    kind: Kind,
    /// The spheres it is about.
    bodies: [usize; 2],
}

/// How many solves the search for pixels may cost.
const SOLVES: usize = 4_000_000;
/// How many pixels of a kind are compared for each exercise.
const COMPARED: usize = 40;

impl Worksheet {
    /// `count` exercises about pixels of the scene, the same for the same seed on every machine.
    ///
    /// There may be fewer where the scene does not show that many things; none without a sphere. `see` is
    /// the command that shows a pixel X,Y.
    pub fn new(scene: &Scene, rays: &Rays, seed: u64, count: usize, see: String) -> Self {
        let mut random = Random::new(seed);
        let candidates = candidates(scene, rays, &mut random);
        let mut kinds = Kind::ALL.map(|kind| {
            let of_kind: Vec<_> = candidates.iter().filter(|c| c.kind == kind).collect();
            of_kind.into_iter()
        });
        let mut chosen: Vec<(Kind, u32, Exercise)> = Vec::new();
        while chosen.len() < count {
            let before = chosen.len();
            for (kind, pixels) in Kind::ALL.into_iter().zip(&mut kinds) {
                let so_far = chosen.iter().filter(|(k, ..)| *k == kind).count();
                if chosen.len() == count || so_far >= kind.most() {
                    continue;
                }
                let easiest = pixels
                    .by_ref()
                    .filter_map(|c| exercise::of(scene, c))
                    .filter(|(_, new)| chosen.iter().all(|(.., old)| !new.has_the_numbers_of(old)))
                    .take(COMPARED)
                    .min_by_key(|(effort, _)| *effort);
                chosen.extend(easiest.map(|(effort, exercise)| (kind, effort, exercise)));
            }
            if chosen.len() == before {
                break;
            }
        }
        chosen.sort_by_key(|&(kind, effort, _)| (kind, effort));
        Self {
            scene: scene.name.clone(),
            see,
            about: scene.about.clone(),
            seed,
            size: rays.size,
            exercises: chosen.into_iter().map(|(.., exercise)| exercise).collect(),
        }
    }

    /// Number of exercises.
    pub fn count(&self) -> usize {
        self.exercises.len()
    }
}

/// What the pixels of the picture show, in an order drawn by the seed.
fn candidates(scene: &Scene, rays: &Rays, random: &mut Random) -> Vec<ProblemPixel> {
    let mut pixels: Vec<u32> = (0..rays.size.area() as u32).collect();
    let spheres = scene.bodies.len();
    if spheres == 0 {
        return Vec::new();
    }
    let asked = pixels.len().min(SOLVES / spheres);
    let mut found = Vec::new();
    for i in 0..asked {
        let other = i + random.below((pixels.len() - i) as u64) as usize;
        pixels.swap(i, other);
        let (x, y) = (pixels[i] % rays.size.width, pixels[i] / rays.size.width);
        found.extend(shown(scene, (x, y), rays.ray(x, y)));
    }
    found
}

/// What one pixel shows, as far as it makes an exercise.
fn shown(scene: &Scene, pixel: (u32, u32), ray: Ray) -> Vec<ProblemPixel> {
    let meetings = super::meetings(scene, &ray, Method::Exact);
    let seen = meetings.iter().filter(|m| m.solution.visible().is_some());
    let seen: Vec<_> = seen.map(|m| m.body).collect();
    let of = |kind, bodies| ProblemPixel {
        pixel,
        ray,
        kind,
        bodies,
    };
    let mut found = Vec::new();
    for meeting in &meetings {
        let kind = match (meeting.solution.class, meeting.solution.place()) {
            (Class::Tangent, Some(Place::Hit)) => Kind::Tangent,
            (_, Some(Place::Inside)) => Kind::Inside,
            (_, Some(Place::Behind)) => Kind::Behind,
            _ => Kind::Secant,
        };
        found.push(of(kind, [meeting.body; 2]));
        if meeting.solution.visible().is_some() {
            found.push(of(Kind::Along, [meeting.body; 2]));
        }
    }
    if let [first, second, ..] = seen[..] {
        found.push(of(Kind::Two, [first.min(second), first.max(second)]));
    }
    let nearest = nearest_miss(&scene.bodies, &ray);
    if let Some(body) = nearest.filter(|_| meetings.is_empty()) {
        found.push(of(Kind::Miss, [body; 2]));
    }
    let asked = meetings.iter().map(|m| m.body).chain(nearest);
    let wrong = |&body: &usize| {
        let sphere = &scene.bodies[body].sphere;
        let [said, right] = [Method::Textbook, Method::Exact].map(|m| m.solve(&ray, sphere).class);
        said != right && said != Class::Nan
    };
    found.extend(
        asked
            .take(1)
            .filter(wrong)
            .map(|body| of(Kind::Rounding, [body; 2])),
    );
    found
}
