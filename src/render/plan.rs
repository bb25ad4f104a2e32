//! The plan: what one frame of one scene needs, what was left out, and why that changes no bit.
//!
//! The way to ask is chosen here, before the work: [`Plan::new`] decides, the rest of the module does
//! as it says. Each reason holds with proof, see docs/plan.md; the counts are of questions, not of time,
//! and the same on every machine.

use std::borrow::Cow;
use std::fmt;

use super::View;
use crate::method::Method;
use crate::method::exact::Stage;
use crate::scene::{Body, Light, Rays, Scene, Size};

/// How the spheres are asked about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum Way {
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
    way: Way,
    perspective: bool,
    /// Whether b = o·d is the same for all rays of a sphere.
    constant_b: bool,
    /// Whether no two spheres have a point in common, so that no root is needed to order them.
    apart: bool,
    light: Option<Light>,
    spheres: u64,
    pub(super) counts: Counts,
}

/// One thing that a frame may need.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Line {
    /// The thing.
    pub what: &'static str,
    /// How many of it were done.
    pub kept: u64,
    /// How many were not.
    pub left_out: u64,
    /// Why that changes nothing, or why nothing could be left out.
    pub because: Cow<'static, str>,
}

impl Line {
    /// A line of these words and numbers.
    pub fn new(
        what: &'static str,
        kept: u64,
        left_out: u64,
        because: impl Into<Cow<'static, str>>,
    ) -> Self {
        Self {
            what,
            kept,
            left_out,
            because: because.into(),
        }
    }
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
            (_, View::Delta | View::Stage) => Way::Widened,
            (Method::Exact, _) => Way::Certified,
            _ => Way::Widened,
        };
        let asks_no_depth = way == Way::Certified && view.shows_only_contours();
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
        }
    }

    /// The plan that leaves out nothing.
    pub(super) fn of_everything(scene: &Scene, rays: &Rays, method: Method, view: View) -> Self {
        Self {
            way: Way::Everything,
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

    pub(super) const fn way(&self) -> Way {
        self.way
    }

    /// Whether the certified way takes roots to tell which sphere is nearer.
    pub(super) const fn roots_tell_depths(&self) -> bool {
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
    pub(super) const fn light(&self) -> Option<Light> {
        self.light
    }

    /// The plan of a frame for which nothing of this picture had to be made anew.
    #[must_use]
    pub fn at_rest(&self) -> Self {
        let counts = Counts {
            kept: self.size.area() as u64,
            ..Counts::default()
        };
        Self {
            counts,
            ..self.clone()
        }
    }

    /// What the frame came to.
    pub const fn counts(&self) -> &Counts {
        &self.counts
    }

    /// How the spheres are asked about, in a sentence.
    pub const fn sentence(&self) -> &'static str {
        match self.way {
            Way::Certified => {
                "exact is asked where a sphere can be seen, by a test in binary32 with a proven bound on its error"
            }
            Way::Widened => {
                "the method itself is asked, at the pixels of spheres that are widened by the error it can make"
            }
            Way::Everything => "the method itself is asked about every sphere at every pixel",
        }
    }

    /// The plan, a line for each thing that a frame may need.
    pub fn lines(&self) -> Vec<Line> {
        let mut lines = vec![self.pixels(), self.rays()];
        lines.extend(self.spheres());
        lines.extend([self.rows(), self.spans(), self.runs()]);
        lines.extend([self.questions(), self.moving_away()]);
        lines.extend(self.coefficients());
        lines.extend([self.square_roots(), self.rounded_roots()]);
        lines.extend(self.stages());
        lines.extend(self.surface());
        lines
    }

    fn pixels(&self) -> Line {
        let all = self.size.area() as u64;
        let kept = self.counts.kept;
        let because = if kept == all && all > 0 {
            "nothing that the picture depends on has changed since the last frame"
        } else if kept > 0 {
            "only where a sphere that changed was or is can anything differ"
        } else {
            "the camera, the question or most of the picture is new"
        };
        Line::new("pixels anew", all - kept, kept, because)
    }

    fn rays(&self) -> Line {
        let all = self.size.area() as u64;
        let Counts { rays, .. } = self.counts;
        let because = if rays > 0 {
            "the camera is new"
        } else {
            "the camera has not moved, and rays depend on nothing else"
        };
        Line::new("rays made", rays, all.saturating_sub(rays), because)
    }

    fn spheres(&self) -> Vec<Line> {
        let all = self.spheres;
        let Counts {
            behind,
            outside,
            hidden,
            asked,
            around,
            kept,
            ..
        } = self.counts;
        let widened = match self.way {
            Way::Certified => "widened by the rounding of the rays",
            Way::Widened => "widened by the error that the method can make",
            Way::Everything => "not looked at",
        };
        let elsewhere = if kept > 0 {
            "; the others are not where anything changed"
        } else {
            ""
        };
        let certified = self.way == Way::Certified;
        let left = |n: u64, reason: Cow<'static, str>, what| Line::new(what, all - n, n, reason);
        vec![
            Line::new(
                "spheres",
                asked,
                all.saturating_sub(asked),
                format!(
                    "{behind} behind the eye, {outside} outside the picture, {hidden} hidden{elsewhere}"
                ),
            ),
            left(
                behind,
                if certified {
                    "z + r, widened by the rounding of the rays, is not above 0".into()
                } else {
                    "the method answers for whole lines, those behind the eye too".into()
                },
                "  before the eye",
            ),
            left(
                outside,
                format!("the projection, {widened}, has no pixel").into(),
                "  in the picture",
            ),
            left(
                hidden,
                if certified {
                    "the least root they can have is above all that is seen there".into()
                } else if self.view.shows_only_what_is_seen() {
                    "a wrong root of the method may be the least: none may be left out".into()
                } else {
                    "the view tells of every sphere on the line".into()
                },
                "  not hidden",
            ),
            Line::new(
                "near roots",
                asked - around.min(asked),
                around,
                if certified {
                    "where the eye is inside, C < 0: near < 0 < far, only far is seen"
                } else {
                    "the method gives both roots at once"
                },
            ),
        ]
    }

    fn rows(&self) -> Line {
        let all = u64::from(self.size.height) * self.spheres;
        let Counts { rows, .. } = self.counts;
        let because = match self.way {
            Way::Everything => "nothing is left out",
            _ => "outside its rows no ray meets the sphere: the tangent planes through the eye",
        };
        Line::new("rows", rows, all.saturating_sub(rows), because)
    }

    fn spans(&self) -> Line {
        let all = self.size.area() as u64 * self.spheres;
        let Counts { spanned, .. } = self.counts;
        let because = match self.way {
            Way::Certified => {
                "along a row the discriminant is a quadratic in the column; between its roots lie the hits (spheres under 17 columns: in their box)"
            }
            Way::Widened => {
                "between the roots of the row's quadratic, for a radius inflated by the method's proven error"
            }
            Way::Everything => "nothing is left out",
        };
        Line::new(
            "columns of rows",
            spanned,
            all.saturating_sub(spanned),
            because,
        )
    }

    fn runs(&self) -> Line {
        let Counts {
            hidden_runs,
            tested,
            solved,
            ..
        } = self.counts;
        let because = match self.way {
            Way::Certified => {
                "in runs of 8, to fill a vector; left out are runs where all that is seen is nearer than the sphere can be"
            }
            _ => "pixel by pixel",
        };
        let kept = if self.way == Way::Certified {
            tested
        } else {
            solved
        };
        Line::new("tests", kept, hidden_runs * RUN, because)
    }

    fn questions(&self) -> Line {
        let Counts { tested, solved, .. } = self.counts;
        match self.way {
            Way::Certified => Line::new(
                "exact itself",
                solved,
                tested,
                "the sign of D is certain where it exceeds the bound on its error",
            ),
            _ => Line::new(
                "method itself",
                solved,
                0,
                "no test but the method's own: its failures are to be seen",
            ),
        }
    }

    fn moving_away(&self) -> Line {
        let Counts { spanned, .. } = self.counts;
        let because = match self.way {
            Way::Certified => {
                "outside the sphere and b = o·d not below 0: no root is positive; no span holds such a ray, and a lane beyond one is a miss"
            }
            _ => "the class is that of the whole line, so the way out may not be taken",
        };
        Line::new("not moving away", spanned, 0, because)
    }

    fn coefficients(&self) -> [Line; 3] {
        let Counts {
            tested,
            solved,
            asked,
            rays,
            ..
        } = self.counts;
        if self.way != Way::Certified {
            let because = "the method works from the ray and the sphere alone";
            return ["A", "B", "C"].map(|what| Line::new(what, solved, 0, because));
        }
        let spared =
            |what, kept: u64, because| Line::new(what, kept, tested.saturating_sub(kept), because);
        let always = |what, because| Line::new(what, tested, 0, because);
        if self.perspective {
            [
                spared(
                    "A",
                    rays,
                    "d·d is the ray's: once a pixel, while the camera rests",
                ),
                always(
                    "B",
                    "2 o·d is of ray and sphere: it varies from pixel to pixel",
                ),
                spared(
                    "C",
                    asked,
                    "o² − r² is the sphere's: all rays start at one point",
                ),
            ]
        } else {
            [
                spared(
                    "A",
                    rays.min(1),
                    "d·d is the picture's: all rays have one direction",
                ),
                if self.constant_b {
                    spared(
                        "B",
                        asked,
                        "2 o·d: where o varies d is 0, so the bits are the sphere's",
                    )
                } else {
                    always("B", "2 o·d: o varies along d, by rounding if nothing else")
                },
                always("C", "o² − r²: the origin moves from pixel to pixel"),
            ]
        }
    }

    fn square_roots(&self) -> Line {
        let Counts {
            roots,
            tested,
            solved,
            ..
        } = self.counts;
        let because = match self.way {
            Way::Certified if self.apart => {
                "the view shows none, and no two spheres meet: the closest approach −b/A tells which is nearer"
            }
            Way::Certified if self.view.shows_only_contours() => {
                "to tell which is nearer: spheres meet, or are too many to find out"
            }
            Way::Certified => "to tell which is nearer, within 2⁻¹³",
            _ => "the method takes one for each meeting",
        };
        let all = if self.way == Way::Certified {
            tested
        } else {
            solved
        };
        Line::new("square roots", roots, all.saturating_sub(roots), because)
    }

    fn rounded_roots(&self) -> Line {
        let Counts {
            rounded,
            solved,
            tested,
            ..
        } = self.counts;
        if self.way != Way::Certified {
            let because = "the method gives them with its class";
            return Line::new("rounded roots", solved, 0, because);
        }
        let because = if self.view.shows_roots() {
            "only roots that are seen are shown"
        } else {
            "nothing shows them; near ties are told apart by exact"
        };
        let kept = rounded + solved;
        Line::new("rounded roots", kept, tested.saturating_sub(kept), because)
    }

    fn stages(&self) -> Vec<Line> {
        const NAMES: [&str; Stage::ALL.len()] = [
            "stage 1", "stage 2", "stage 3", "stage 4", "stage 5", "stage 6",
        ];
        let stages = &self.counts.stages;
        if self.method != Method::Exact || self.way == Way::Everything {
            return Vec::new();
        }
        let asked: u64 = stages.iter().sum();
        let mut settled = 0;
        let mut lines = Vec::new();
        for ((what, n), stage) in NAMES.into_iter().zip(stages).zip(Stage::ALL) {
            let because = if asked == 0 {
                Cow::from(format!("{stage}: the certified test settled everything"))
            } else if settled == asked {
                format!("{stage}: the stages before were sure").into()
            } else {
                format!("{stage}: settled {n}").into()
            };
            lines.push(Line::new(what, asked - settled, settled, because));
            settled += n;
        }
        lines
    }

    fn surface(&self) -> [Line; 3] {
        let Counts { shaded, kept, .. } = self.counts;
        let pixels = self.size.area() as u64 - kept;
        let line = |what, n: u64, because| Line::new(what, n, pixels.saturating_sub(n), because);
        let seen = "only what is seen, once for each pixel";
        match (self.view, self.light) {
            (View::Shade, Some(_)) => ["normals", "light", "shades"].map(|w| line(w, shaded, seen)),
            (View::Shade, None) => [
                line("normals", 0, "a headlight needs none: cos θ = √(Δ/4Ar²)"),
                line("light", 0, "it is where the eye is"),
                line("shades", shaded, seen),
            ],
            (View::Normal, _) => [
                line(
                    "normals",
                    self.seen(),
                    "once for each pixel that is drawn anew",
                ),
                line("light", 0, "the view shows none"),
                line("shades", 0, "the view shows none"),
            ],
            _ => ["normals", "light", "shades"].map(|w| line(w, 0, "the view shows none")),
        }
    }

    /// How many pixels may show a normal: those that are asked anew.
    const fn seen(&self) -> u64 {
        self.size.area() as u64 - self.counts.kept
    }
}

/// Pixels in a run of tests.
const RUN: u64 = super::lanes::SINGLES as u64;

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

impl fmt::Display for Plan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            size,
            method,
            view,
            spheres,
            ..
        } = self;
        let view = view.name();
        writeln!(f, "{size} pixels, {spheres} spheres, {method}, {view}")?;
        for line in self.lines() {
            let Line {
                what,
                kept,
                left_out,
                because,
            } = line;
            writeln!(f, "{what:24} {kept:>10} {left_out:>12}  {because}")?;
        }
        Ok(())
    }
}
