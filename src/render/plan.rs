//! The plan: what one frame of one scene needs, what was left out, and why that changes no bit.
//!
//! The way to ask is chosen here, before the work: [`Plan::new`] decides, the rest of the module does
//! as it says, and the counts are of questions, not of time, so that they are the same on every machine.
//! docs/plan.md has the proofs; `explain` has the reasons in words.

use super::View;
use super::projector::{Projector, Reach, Window};
use crate::geometry::Sphere;
use crate::method::Method;
use crate::method::batch::Solutions;
use crate::method::exact::Stage;
use crate::scene::{Body, Light, Rays, Scene, Size};

/// About how many certified tests a question to a method takes the time of, and one that the first stage of
/// `exact` leaves open.
const QUESTION: u64 = 4;
const HARD_QUESTION: u64 = 100;

/// How the spheres are asked about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Strategy {
    /// `exact`: where a sphere can be seen, by a test with a bound on its error, and the method
    /// itself where that leaves the answer open.
    Certified,
    /// The method itself, at the pixels of a window that is widened by the error that the method can
    /// make: a method that is wrong is shown to be wrong.
    Widened,
    /// The method itself, about every sphere at every pixel.
    #[default]
    Everything,
}

/// Which rays of a frame are of interest, of each sphere.
#[derive(Debug, Clone, Copy)]
pub(super) struct Interest {
    pub way: Strategy,
    pub view: View,
}

impl Interest {
    /// Those of a sphere that no ray meets before `least` at t > 0.
    #[inline(always)]
    pub(super) fn reach(self, least: f32) -> Reach {
        match (self.way, self.view) {
            (Strategy::Everything, _) => Reach::Everything,
            // This view shows what lies behind the eye, too.
            (Strategy::Certified, View::Class) if least == 0.0 => Reach::Lines(1.0),
            (Strategy::Certified, _) => Reach::Seen,
            // Lines that pass within two radii are shown.
            (Strategy::Widened, View::Delta) => Reach::Lines(2.0),
            (Strategy::Widened, _) => Reach::Lines(1.0),
        }
    }

    /// Where a sphere can be met so.
    pub(super) fn window(self, projector: &Projector, sphere: &Sphere) -> Window {
        let reach = self.reach(f32::INFINITY);
        let window = projector.window(sphere, reach);
        match self.reach(window.least) {
            Reach::Lines(times) if reach == Reach::Seen => {
                projector.window(sphere, Reach::Lines(times))
            }
            _ => window,
        }
    }
}

/// What a frame came to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Counts {
    /// Spheres behind the eye.
    pub behind: u64,
    /// Spheres of which no pixel's ray can find anything.
    pub outside: u64,
    /// Spheres behind what was already found wherever they could be seen.
    pub hidden: u64,
    /// Spheres about which at least one question was asked.
    pub asked: u64,
    /// Of these, spheres that hold the eye.
    pub around: u64,
    /// Rows of pixels that were looked at, for each sphere.
    pub rows: u64,
    /// Pixels of these rows' spans of columns, for each sphere.
    pub spanned: u64,
    /// Runs of pixels of a span that were left out since all that is seen there is nearer.
    pub hidden_runs: u64,
    /// Certified tests of one pixel and one sphere; tests go in runs, of which some lie beyond a span.
    pub tested: u64,
    /// Questions of one pixel and one sphere that the method itself was asked.
    pub solved: u64,
    /// Of these and the rounded ones, how many each stage of `exact` settled.
    pub stages: [u64; Stage::ALL.len()],
    /// Square roots for telling which sphere is nearer, and those of the method itself.
    pub roots: u64,
    /// Of the questions which of two spheres is seen those whose roots round alike: exact signs told.
    pub ties: u64,
    /// Visible roots that were rounded for the view, beside those of the questions.
    pub rounded: u64,
    /// Pixels that were shaded.
    pub shaded: u64,
    /// Rays that were made: none while the camera rests.
    pub rays: u64,
    /// Pixels of which the last frame's answer was kept.
    pub kept: u64,
}

impl Counts {
    /// About how much work it was, in certified tests of eight pixels.
    #[inline(always)]
    pub(super) fn work(&self) -> u64 {
        let [first, later @ ..] = self.stages;
        let _ = first;
        let spheres = self.asked + self.hidden;
        let tests = self.hidden_runs + self.tested / super::lanes::SINGLES as u64;
        let questions = self.solved + self.rounded;
        spheres
            + tests
            + QUESTION * questions
            + HARD_QUESTION * (self.ties + later.iter().sum::<u64>())
    }

    /// How many tests of one pixel and one sphere the hidden runs would have been.
    pub const fn hidden_tests(&self) -> u64 {
        self.hidden_runs * super::lanes::SINGLES as u64
    }

    /// Notes rows of a sphere whose pixels from the first to the last of these columns are looked at.
    #[inline(always)]
    pub(super) const fn note_rows(&mut self, rows: i16, [first, last]: [i16; 2]) {
        if first <= last {
            self.rows += rows as u64;
            self.spanned += rows as u64 * ((last - first) as u64 + 1);
        }
    }

    /// Notes a question to the method, and which stage settled it.
    pub(super) fn note_solved(&mut self, stage: Option<Stage>) {
        self.solved += 1;
        if let Some(stage) = stage {
            self.stages[stage as usize] += 1;
        }
    }

    /// Notes questions to the method that were asked together.
    pub(super) fn note_answers(&mut self, answers: &Solutions) {
        self.solved += answers.class.len() as u64;
        for (sum, n) in self.stages.iter_mut().zip(answers.stages) {
            *sum += n;
        }
    }

    /// Notes that a root was rounded, and which stage settled it.
    pub(super) fn note_rounded(&mut self, stage: Stage) {
        self.rounded += 1;
        self.stages[stage as usize] += 1;
    }
}

/// What one frame of one scene needed, and what was left out.
#[derive(Debug, Clone, Default)]
pub struct Plan {
    size: Size,
    method: Method,
    view: View,
    way: Strategy,
    perspective: bool,
    /// Whether b = o·d is the same for all rays of a sphere.
    constant_b: bool,
    /// Whether no two spheres have a point in common, so that no root is needed to order them.
    apart: bool,
    light: Option<Light>,
    spheres: u64,
    pub(super) counts: Counts,
    /// What the truth came to, which a method is held to.
    pub(super) truth: Counts,
}

impl Plan {
    /// The plan for a frame that leaves out what it can; `constant_b` says whether o·d is the same for
    /// all `rays`.
    pub(super) fn new(
        scene: &Scene,
        rays: &Rays,
        constant_b: bool,
        method: Method,
        view: View,
    ) -> Self {
        // The stages are those of `exact`, whatever the method.
        let method = match view {
            View::Stage => Method::Exact,
            _ => method,
        };
        let way = match (method, view) {
            // It takes A for 1. So it is for parallel rays, to a few roundings; else its error has no bound.
            (Method::Unit, _) if rays.perspective => Strategy::Everything,
            // Nor has that of a method that is somebody's own.
            (Method::Routine(_), _) => Strategy::Everything,
            (_, View::Delta | View::Stage) => Strategy::Widened,
            (Method::Exact, _) => Strategy::Certified,
            _ => Strategy::Widened,
        };
        let asks_no_depth = way == Strategy::Certified && view.shows_only_contours();
        Self {
            size: rays.size,
            method,
            view,
            way,
            perspective: rays.perspective,
            constant_b,
            apart: asks_no_depth && are_apart(&scene.bodies),
            light: scene.light,
            spheres: scene.bodies.len() as u64,
            counts: Counts::default(),
            truth: Counts::default(),
        }
    }

    /// The plan that leaves out nothing.
    pub(super) fn of_everything(scene: &Scene, rays: &Rays, method: Method, view: View) -> Self {
        Self {
            way: Strategy::Everything,
            ..Self::new(scene, rays, false, method, view)
        }
    }

    /// Whether another plan asks the same questions of the same spheres and rays.
    pub(super) fn asks_the_same(&self, other: &Self) -> bool {
        let key = |plan: &Self| {
            let light = plan.light.filter(|_| plan.view == View::Shade);
            let way = (plan.way, plan.apart);
            (plan.size, plan.method, plan.view, way, light)
        };
        key(self) == key(other)
    }

    /// How the spheres are asked about.
    pub const fn way(&self) -> Strategy {
        self.way
    }

    /// How many spheres the scene has.
    pub const fn spheres(&self) -> u64 {
        self.spheres
    }

    /// Whether all rays start at one point; else they have one direction.
    pub const fn is_perspective(&self) -> bool {
        self.perspective
    }

    /// Whether b = o·d is the same for all rays of a sphere.
    pub const fn has_constant_b(&self) -> bool {
        self.constant_b
    }

    /// Whether the certified way takes roots to tell which sphere is nearer.
    pub const fn roots_tell_depths(&self) -> bool {
        !self.apart
    }

    /// The view that the frame is for.
    pub const fn view(&self) -> View {
        self.view
    }

    /// The method that the frame is by.
    pub const fn method(&self) -> Method {
        self.method
    }

    /// The size of the picture.
    pub const fn size(&self) -> Size {
        self.size
    }

    /// Where the light of the shades comes from.
    pub const fn light(&self) -> Option<Light> {
        self.light
    }

    /// What the frame came to.
    pub const fn counts(&self) -> &Counts {
        &self.counts
    }

    /// What finding out what `exact` sees came to, if the view holds another method to it.
    pub const fn truth(&self) -> Option<&Counts> {
        if self.compares() {
            Some(&self.truth)
        } else {
            None
        }
    }

    /// Whether the method is held to what `exact` sees, which has to be found too.
    pub(super) const fn compares(&self) -> bool {
        let asks_exact = matches!(self.way, Strategy::Certified);
        matches!(self.view, View::Lost) && !asks_exact
    }

    /// Which rays are of interest.
    pub(super) const fn interest(&self) -> Interest {
        Interest {
            way: self.way,
            view: self.view,
        }
    }
}

/// More spheres than this are not held against each other: it would cost more than it spares.
const MOST_PAIRED: usize = 64;

/// Whether no two of the spheres have a point in common, beyond doubt. Then the stretches of a line
/// within them are apart, and any two points of them are in the order of their near roots.
fn are_apart(bodies: &[Body]) -> bool {
    let apart = |one: &Body, other: &Body| {
        let between = one.sphere.center.as_dvec3() - other.sphere.center.as_dvec3();
        let reach = f64::from(one.sphere.radius) + f64::from(other.sphere.radius);
        // The margin is far above the error of rays and of depths, see docs/plan.md.
        between.length_squared() > reach * reach * 1.001
    };
    bodies.len() <= MOST_PAIRED
        && bodies
            .iter()
            .enumerate()
            .all(|(i, one)| bodies[i + 1..].iter().all(|other| apart(one, other)))
}
