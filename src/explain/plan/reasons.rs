//! What a frame needed and what it left out, each with its reason in words. docs/plan.md has the proofs.

use std::borrow::Cow;

use serde::Serialize;

use crate::method::Method;
use crate::method::exact::Stage;
use crate::render::{Counts, Image, Plan, Strategy, View};

/// One thing that a frame may need.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct PlanLine {
    /// The thing.
    pub what: &'static str,
    /// How many of it were done.
    pub kept: u64,
    /// How many were not.
    pub left_out: u64,
    /// Why that changes nothing, or why nothing could be left out.
    pub because: Cow<'static, str>,
}

impl PlanLine {
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

    /// A line of a thing of which `kept` were done out of `all`.
    fn of_all(
        what: &'static str,
        kept: u64,
        all: u64,
        because: impl Into<Cow<'static, str>>,
    ) -> Self {
        Self::new(what, kept, all.saturating_sub(kept), because)
    }

    /// A line of a thing of which `left_out` were not done out of `all`.
    fn without(
        what: &'static str,
        left_out: u64,
        all: u64,
        because: impl Into<Cow<'static, str>>,
    ) -> Self {
        let left_out = left_out.min(all);
        Self::new(what, all - left_out, left_out, because)
    }
}

/// How the spheres of a frame are asked about, in a sentence.
pub const fn plan_sentence(plan: &Plan) -> &'static str {
    match plan.way() {
        Strategy::Certified => {
            "exact is asked where a sphere can be seen, by a test in binary32 with a proven bound on its error"
        }
        Strategy::Widened => {
            "the method itself is asked, at the pixels of spheres that are widened by the error it can make"
        }
        Strategy::Everything => "the method itself is asked about every sphere at every pixel",
    }
}

/// What the frame of `plan` and the `image` of it needed, a line for each thing.
pub fn plan_lines(plan: &Plan, image: &Image) -> Vec<PlanLine> {
    let mut lines = vec![pixels(plan), rays(plan)];
    lines.extend(spheres(plan));
    lines.extend([rows(plan), spans(plan), runs(plan)]);
    lines.extend([questions(plan), moving_away(plan)]);
    lines.extend(coefficients(plan));
    lines.extend([square_roots(plan), rounded_roots(plan)]);
    lines.extend(equal_roots(plan));
    lines.extend(stages(plan));
    lines.extend(truth(plan));
    lines.extend(surface(plan));
    lines.extend(cells(image));
    lines
}

fn all_pixels(plan: &Plan) -> u64 {
    plan.size().area() as u64
}

fn is_certified(plan: &Plan) -> bool {
    plan.way() == Strategy::Certified
}

fn pixels(plan: &Plan) -> PlanLine {
    let all = all_pixels(plan);
    let kept = plan.counts().kept;
    let because = if kept == all && all > 0 {
        "nothing that the picture depends on has changed since the last frame"
    } else if kept > 0 {
        "only where a sphere that changed was or is can anything differ"
    } else {
        "the camera, the question or most of the picture is new"
    };
    PlanLine::without("pixels redrawn", kept, all, because)
}

fn rays(plan: &Plan) -> PlanLine {
    let made = plan.counts().rays;
    let because = if made > 0 {
        "the camera is new"
    } else {
        "the camera has not moved, and rays depend on nothing else"
    };
    PlanLine::of_all("rays made", made, all_pixels(plan), because)
}

fn spheres(plan: &Plan) -> [PlanLine; 5] {
    let Counts {
        behind,
        outside,
        hidden,
        asked,
        kept,
        ..
    } = *plan.counts();
    let elsewhere = if kept > 0 {
        "; the others are not where anything changed"
    } else {
        ""
    };
    let sum = format!(
        "{behind} behind the eye, {outside} outside the picture, {hidden} hidden{elsewhere}"
    );
    [
        PlanLine::of_all("spheres", asked, plan.spheres(), sum),
        before_the_eye(plan),
        in_the_picture(plan),
        not_hidden(plan),
        near_roots(plan),
    ]
}

fn before_the_eye(plan: &Plan) -> PlanLine {
    let because = if is_certified(plan) {
        "z + r, widened by the rounding of the rays, is not above 0"
    } else {
        "the method answers for whole lines, those behind the eye too"
    };
    let behind = plan.counts().behind;
    PlanLine::new("  before the eye", plan.spheres() - behind, behind, because)
}

fn in_the_picture(plan: &Plan) -> PlanLine {
    let widened = match plan.way() {
        Strategy::Certified => "widened by the rounding of the rays",
        Strategy::Widened => "widened by the error that the method can make",
        Strategy::Everything => "not looked at",
    };
    let outside = plan.counts().outside;
    let because = format!("the projection, {widened}, has no pixel");
    PlanLine::without("  in the picture", outside, plan.spheres(), because)
}

fn not_hidden(plan: &Plan) -> PlanLine {
    let because = if is_certified(plan) {
        "the least root they can have is above all that is seen there"
    } else if plan.counts().hidden > 0 {
        "the same sphere is listed before"
    } else if plan.view().shows_only_what_is_seen() {
        "a wrong root of the method may be the least: none may be left out"
    } else {
        "the view shows every sphere on the line"
    };
    let hidden = plan.counts().hidden;
    PlanLine::without("  not hidden", hidden, plan.spheres(), because)
}

fn near_roots(plan: &Plan) -> PlanLine {
    let Counts { asked, around, .. } = *plan.counts();
    let because = if is_certified(plan) {
        "where the eye is inside, C < 0: near < 0 < far, only far is seen"
    } else {
        "the method gives both roots at once"
    };
    PlanLine::without("near roots", around, asked, because)
}

fn rows(plan: &Plan) -> PlanLine {
    let all = u64::from(plan.size().height) * plan.spheres();
    let because = match plan.way() {
        Strategy::Everything => "nothing is left out",
        _ => "outside its rows no ray meets the sphere: the tangent planes through the eye",
    };
    PlanLine::of_all("rows", plan.counts().rows, all, because)
}

fn spans(plan: &Plan) -> PlanLine {
    let all = all_pixels(plan) * plan.spheres();
    let because = match plan.way() {
        Strategy::Certified => {
            "along a row the discriminant is a quadratic in the column; between its roots lie the hits (spheres under 17 columns: in their box)"
        }
        Strategy::Widened => {
            "between the roots of the row's quadratic, for a radius inflated by the method's proven error"
        }
        Strategy::Everything => "nothing is left out",
    };
    PlanLine::of_all("columns of rows", plan.counts().spanned, all, because)
}

fn runs(plan: &Plan) -> PlanLine {
    let counts = plan.counts();
    let (kept, because) = if is_certified(plan) {
        (
            counts.tested,
            "in runs of 8, to fill a vector; left out are runs where all that is seen is nearer than the sphere can be",
        )
    } else {
        (counts.solved, "pixel by pixel")
    };
    PlanLine::new("tests", kept, counts.hidden_tests(), because)
}

fn questions(plan: &Plan) -> PlanLine {
    let Counts { tested, solved, .. } = *plan.counts();
    if is_certified(plan) {
        let because = "the sign of D is certain where it exceeds the bound on its error";
        PlanLine::new("exact itself", solved, tested, because)
    } else {
        let because = "no test but the method's own: its failures are to be seen";
        PlanLine::new("method itself", solved, 0, because)
    }
}

fn moving_away(plan: &Plan) -> PlanLine {
    let because = if is_certified(plan) {
        "outside the sphere and b = o·d not below 0: no root is positive; no span holds such a ray, and a lane beyond one is a miss"
    } else {
        "the class is that of the whole line, so the way out may not be taken"
    };
    PlanLine::new("not moving away", plan.counts().spanned, 0, because)
}

fn coefficients(plan: &Plan) -> [PlanLine; 3] {
    let Counts {
        tested,
        solved,
        asked,
        rays,
        ..
    } = *plan.counts();
    if !is_certified(plan) {
        let because = "the method works from the ray and the sphere alone";
        return ["A", "B", "C"].map(|what| PlanLine::new(what, solved, 0, because));
    }
    let spared = |what, kept: u64, because| PlanLine::of_all(what, kept, tested, because);
    let always = |what, because| PlanLine::new(what, tested, 0, because);
    if plan.is_perspective() {
        return [
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
        ];
    }
    [
        spared(
            "A",
            rays.min(1),
            "d·d is the picture's: all rays have one direction",
        ),
        if plan.has_constant_b() {
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

fn square_roots(plan: &Plan) -> PlanLine {
    let Counts {
        roots,
        tested,
        solved,
        ..
    } = *plan.counts();
    if !is_certified(plan) {
        let because = "the method takes one for each meeting";
        return PlanLine::of_all("square roots", roots, solved, because);
    }
    let because = if !plan.roots_tell_depths() {
        "the view shows none, and no two spheres meet: the closest approach −b/A tells which is nearer"
    } else if plan.view().shows_only_contours() {
        "to tell which is nearer: spheres meet, or are too many to find out"
    } else {
        "to tell which is nearer, within 2⁻¹³"
    };
    PlanLine::of_all("square roots", roots, tested, because)
}

fn rounded_roots(plan: &Plan) -> PlanLine {
    let Counts {
        rounded,
        solved,
        tested,
        ..
    } = *plan.counts();
    if !is_certified(plan) {
        let because = "the method gives them with its class";
        return PlanLine::new("rounded roots", solved, 0, because);
    }
    let because = if plan.view().shows_roots() {
        "only roots that are seen are shown"
    } else {
        "nothing shows them; near ties are told apart by exact"
    };
    PlanLine::of_all("rounded roots", rounded + solved, tested, because)
}

/// How many times exact signs told which sphere is nearer, if that was ever in question.
fn equal_roots(plan: &Plan) -> Option<PlanLine> {
    let because =
        "rounding is monotone: only roots that round alike need exact signs to be told apart";
    let Counts { ties, solved, .. } = *plan.counts();
    (ties > 0).then(|| PlanLine::of_all("equal roots", ties, solved, because))
}

/// What finding the right picture takes, beside that of the method.
fn truth(plan: &Plan) -> Option<PlanLine> {
    let because =
        "what is right is found by exact, by its certified test where a sphere can be seen";
    let truth = plan.truth()?;
    let all = (all_pixels(plan) - plan.counts().kept) * plan.spheres();
    Some(PlanLine::of_all(
        "beside exact",
        truth.tested + truth.solved,
        all,
        because,
    ))
}

fn stages(plan: &Plan) -> Vec<PlanLine> {
    const NAMES: [&str; Stage::ALL.len()] = [
        "stage 1", "stage 2", "stage 3", "stage 4", "stage 5", "stage 6",
    ];
    if plan.method() != Method::Exact || plan.way() == Strategy::Everything {
        return Vec::new();
    }
    let counts = &plan.counts().stages;
    let asked: u64 = counts.iter().sum();
    let mut settled = 0;
    let mut lines = Vec::new();
    for ((what, n), stage) in NAMES.into_iter().zip(counts).zip(Stage::ALL) {
        let because = if asked == 0 {
            format!("{stage}: the certified test settled everything")
        } else if settled == asked {
            format!("{stage}: the stages before were sure")
        } else {
            format!("{stage}: settled {n}")
        };
        lines.push(PlanLine::new(what, asked - settled, settled, because));
        settled += n;
    }
    lines
}

fn surface(plan: &Plan) -> [PlanLine; 3] {
    let Counts { shaded, kept, .. } = *plan.counts();
    let anew = all_pixels(plan) - kept;
    let line = |what, n: u64, because| PlanLine::of_all(what, n, anew, because);
    let seen = "only what is seen, once for each pixel";
    let unseen = "the view shows none";
    match (plan.view(), plan.light()) {
        (View::Shade, Some(_)) => ["normals", "light", "shades"].map(|w| line(w, shaded, seen)),
        (View::Shade, None) => [
            line("normals", 0, "a headlight needs none: cos θ = √(Δ/4Ar²)"),
            line("light", 0, "it is where the eye is"),
            line("shades", shaded, seen),
        ],
        (View::Normal, _) => [
            line("normals", anew, "once for each pixel that is redrawn"),
            line("light", 0, unseen),
            line("shades", 0, unseen),
        ],
        _ => ["normals", "light", "shades"].map(|w| line(w, 0, unseen)),
    }
}

fn cells(image: &Image) -> [PlanLine; 2] {
    let all = image.cells.len() as u64;
    [
        PlanLine::of_all(
            "cells drawn",
            image.cells_drawn(),
            all,
            "a cell shows its own pixels and the edges to those beside them",
        ),
        PlanLine::of_all(
            "cells changed",
            image.cells_changed(),
            all,
            "what looks the same is not sent",
        ),
    ]
}
