//! The plan: what one frame of one scene needs, what was left out, and why that changes no bit.
//!
//! The way to ask is chosen here, before the work. Each reason holds with proof, see docs/plan.md;
//! the counts are of questions, not of time, and the same on every machine.

use std::fmt;

use super::View;
use super::cover::Bounds;
use crate::method::Method;
use crate::method::exact::Stage;
use crate::scene::{Light, Rays, Scene, Size};

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
    /// Rows of pixels within the boxes of the spheres that were asked about, a row for each sphere.
    pub rows: u64,
    /// Pixels within these boxes, for each sphere.
    pub boxed: u64,
    /// Runs of pixels of a box that were left out since all that is seen there is nearer.
    pub hidden_runs: u64,
    /// Certified tests of one pixel and one sphere.
    pub tested: u64,
    /// Questions of one pixel and one sphere that the method itself was asked.
    pub solved: u64,
    /// Of these, how many each stage of `exact` settled.
    pub stages: [u64; Stage::ALL.len()],
    /// Visible roots that were rounded.
    pub rounded: u64,
    /// Pixels that were shaded.
    pub shaded: u64,
    /// Pixels of which the last frame's answer was kept.
    pub kept: u64,
}

/// What one frame of one scene needed, and what was left out.
#[derive(Debug, Clone, Default)]
pub struct Plan {
    size: Size,
    method: Method,
    view: View,
    way: Way,
    perspective: bool,
    light: Option<Light>,
    spheres: u64,
    pub(super) counts: Counts,
}

/// One thing that a frame may need.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Line {
    /// The thing.
    pub what: &'static str,
    /// How much of it was done.
    pub kept: String,
    /// How much of it was not.
    pub left_out: String,
    /// Why that changes nothing.
    pub because: &'static str,
}

impl Plan {
    /// The plan for a frame that leaves out what it can.
    pub(super) fn new(scene: &Scene, rays: &Rays, method: Method, view: View) -> Self {
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
        Self {
            size: rays.size,
            method,
            view,
            way,
            perspective: rays.perspective,
            light: scene.light,
            spheres: scene.bodies.len() as u64,
            counts: Counts::default(),
        }
    }

    /// The plan that leaves out nothing.
    pub(super) fn of_everything(scene: &Scene, rays: &Rays, method: Method, view: View) -> Self {
        Self {
            way: Way::Everything,
            ..Self::new(scene, rays, method, view)
        }
    }

    /// Whether another plan asks the same questions of the same spheres and rays.
    pub(super) fn asks_the_same(&self, other: &Self) -> bool {
        let key = |plan: &Self| {
            let light = plan.light.filter(|_| plan.view == View::Shade);
            (plan.size, plan.method, plan.view, plan.way, light)
        };
        key(self) == key(other)
    }

    pub(super) const fn way(&self) -> Way {
        self.way
    }

    /// The view that the frame is for.
    pub const fn view(&self) -> View {
        self.view
    }

    /// The method that the frame is by.
    pub const fn method(&self) -> Method {
        self.method
    }

    /// Where the light of the shades comes from.
    pub(super) const fn light(&self) -> Option<Light> {
        self.light
    }

    /// What the frame came to.
    pub const fn counts(&self) -> &Counts {
        &self.counts
    }

    pub(super) fn note_box(&mut self, bounds: Bounds) {
        self.counts.asked += 1;
        self.counts.rows += bounds.rows();
        self.counts.boxed += bounds.area();
    }

    pub(super) fn note_solved(&mut self, stage: Option<Stage>) {
        self.counts.solved += 1;
        if let Some(stage) = stage {
            self.counts.stages[stage as usize] += 1;
        }
    }

    /// The plan, a line for each thing that a frame may need.
    pub fn lines(&self) -> Vec<Line> {
        let mut lines = vec![self.cells(), self.spheres(), self.hidden()];
        lines.extend([self.pixels(), self.tests()]);
        lines.extend(self.stages());
        lines.extend([self.coefficients(), self.roots(), self.shades()]);
        lines
    }

    fn cells(&self) -> Line {
        let all = self.size.area() as u64;
        let kept = self.counts.kept;
        Line {
            what: "pixels asked anew",
            kept: (all - kept).to_string(),
            left_out: kept.to_string(),
            because: if kept == all && all > 0 {
                "nothing that this picture depends on has changed since the last frame"
            } else if kept > 0 {
                "only where a sphere that changed was or is can anything differ"
            } else {
                "the camera, the question or most spheres are new"
            },
        }
    }

    fn spheres(&self) -> Line {
        let Counts {
            behind,
            outside,
            asked,
            ..
        } = self.counts;
        Line {
            what: "spheres asked about",
            kept: format!("{asked} of {}", self.spheres),
            left_out: format!("{behind} behind the eye, {outside} outside the picture"),
            because: match self.way {
                Way::Everything => "nothing is left out: the picture that all others must equal",
                Way::Certified => {
                    "its projection, widened by the rounding of the rays, has no pixel"
                }
                Way::Widened => {
                    "its projection, widened by the error that the method can make, has no pixel"
                }
            },
        }
    }

    fn hidden(&self) -> Line {
        let Counts {
            hidden,
            hidden_runs,
            ..
        } = self.counts;
        Line {
            what: "hidden spheres",
            kept: match self.way {
                Way::Certified => "0".into(),
                _ => "all".into(),
            },
            left_out: format!("{hidden} whole, {hidden_runs} runs of others"),
            because: match self.way {
                Way::Certified => "the least root they can have is above all that is seen there",
                Way::Widened if self.view.shows_only_what_is_seen() => {
                    "the method's roots have no bound: a wrong one may be the least"
                }
                Way::Widened => "the view tells of every sphere on the line",
                Way::Everything => "nothing is left out",
            },
        }
    }

    fn pixels(&self) -> Line {
        let all = self.size.area() as u64 * self.spheres;
        let Counts {
            rows, boxed, kept, ..
        } = self.counts;
        let of_rows = u64::from(self.size.height) * self.spheres;
        Line {
            what: "pixels of spheres",
            kept: format!("{boxed} in {rows} rows"),
            left_out: format!(
                "{} in {} rows",
                all.saturating_sub(boxed),
                of_rows.saturating_sub(rows)
            ),
            because: if kept > 0 {
                "boxes are clipped to what has changed"
            } else {
                "outside its box no ray meets the sphere"
            },
        }
    }

    fn tests(&self) -> Line {
        let Counts { tested, solved, .. } = self.counts;
        match self.way {
            Way::Certified => Line {
                what: "questions to the method",
                kept: solved.to_string(),
                left_out: format!("{tested} settled by a certified test"),
                because: "the sign of b² − AC is certain where it exceeds the bound on its error",
            },
            _ => Line {
                what: "questions to the method",
                kept: solved.to_string(),
                left_out: "0".into(),
                because: "no test but the method's own: its failures are to be seen",
            },
        }
    }

    fn stages(&self) -> Option<Line> {
        let stages = &self.counts.stages;
        (self.method == Method::Exact && self.way != Way::Everything).then(|| Line {
            what: "stages of exact",
            kept: Stage::ALL
                .iter()
                .zip(&self.counts.stages)
                .filter(|(_, n)| **n > 0)
                .map(|(stage, n)| format!("{n} {stage}"))
                .collect::<Vec<_>>()
                .join(", "),
            left_out: format!(
                "{} later stages",
                // Each answer is settled by one stage, and those after it are spared.
                (0..)
                    .zip(stages)
                    .map(|(i, n)| (Stage::ALL.len() as u64 - 1 - i) * n)
                    .sum::<u64>()
            ),
            because: "an earlier stage was sure",
        })
    }

    fn coefficients(&self) -> Line {
        let (kept, left_out, because) = match (self.way, self.perspective) {
            (Way::Certified, true) => (
                "B for each test",
                "A but once a pixel, C but once a sphere",
                "rays from one point: p0 − c is the sphere's, d the pixel's",
            ),
            (Way::Certified, false) => (
                "B and C for each test",
                "A but once a picture",
                "parallel rays: d is the same for all",
            ),
            _ => (
                "A, B and C for each question",
                "none",
                "the method works from the ray and the sphere alone",
            ),
        };
        Line {
            what: "coefficients",
            kept: kept.into(),
            left_out: left_out.into(),
            because,
        }
    }

    fn roots(&self) -> Line {
        let Counts {
            rounded,
            solved,
            tested,
            ..
        } = self.counts;
        match self.way {
            Way::Certified => Line {
                what: "rounded roots",
                kept: (rounded + solved).to_string(),
                left_out: tested.saturating_sub(rounded).to_string(),
                because: if self.view.shows_roots() {
                    "only roots that are seen are shown"
                } else {
                    "nothing shows them; depths are told apart by rough ones, ties by the method"
                },
            },
            _ => Line {
                what: "rounded roots",
                kept: solved.to_string(),
                left_out: "0".into(),
                because: "the method gives them with its class",
            },
        }
    }

    fn shades(&self) -> Line {
        let Counts { shaded, kept, .. } = self.counts;
        let all = self.size.area() as u64;
        Line {
            what: "normals, light, shades",
            kept: shaded.to_string(),
            left_out: (all - kept).saturating_sub(shaded).to_string(),
            because: if self.view == View::Shade {
                "only what is seen is shaded, once for each pixel"
            } else {
                "the view shows no shades"
            },
        }
    }
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
        writeln!(
            f,
            "{size} pixels, {spheres} spheres, method {method}, view {view}"
        )?;
        for Line {
            what,
            kept,
            left_out,
            because,
        } in self.lines()
        {
            writeln!(f, "\n{what}")?;
            writeln!(f, "  kept      {kept}")?;
            writeln!(f, "  left out  {left_out}")?;
            writeln!(f, "  because   {because}")?;
        }
        Ok(())
    }
}
