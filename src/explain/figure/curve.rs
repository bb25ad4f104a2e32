//! The curve f(t) = At² + Bt + C: where it is zero, the line meets the sphere.
//!
//! ```text
//!   f │⢇                    ⡜
//!     │⠈⢆                  ⡰⠁
//!   0 ■┄┄●┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄┄○┄┄┄ t
//!     │    ⠑⢄          ⡠⠊
//!     │       ⠉⠢⠤⠤×⠤⠤⠔⠉
//! ```

use super::axis::{Axis, AxisPosition, DrawingArea, Stretch};
use super::canvas::{Canvas, Dash, FigureInk};
use super::caption::{
    Caption, caption_of, caption_room, joined, rounded, show, times, times_joined,
};
use super::mark::{Mark, Sign};
use super::section::{Anchor, LinePoint, Section};
use crate::explain::{Line, Role, Subject};
use crate::geometry::Ray;
use crate::method::Class;
use crate::method::trace::error_text;
use crate::text::Glyphs;

/// The curve f(t) with its roots and its vertex, t = 0, and the value at `t`.
///
/// Exactly `rows` lines of at most `cols` columns. Each axis has a scale of its own, so that the
/// curve fills the figure; where t = 0 or a root is far off, the t axis has a break.
pub fn curve(
    subject: &Subject,
    ray: &Ray,
    t: f64,
    cols: usize,
    rows: usize,
    glyphs: Glyphs,
) -> Vec<Line> {
    let section = Section::new(ray, &subject.sphere);
    let caption = caption(&section, subject, t, glyphs);
    let caption = caption.lines(cols, caption_room(cols, rows));
    let canvas = Canvas::new(cols, rows.saturating_sub(caption.len()), glyphs);
    let view = CurveView::of(&section, &canvas);
    let plot = CurvePlot {
        canvas,
        view,
        section,
    };
    let mut lines = plot.draw(t).lines();
    lines.extend(caption);
    lines.resize(rows, Line::new(0));
    lines
}

/// What part of the curve is seen, and how large.
///
/// t is measured along the line, in lengths s = t·|d|; then f = s² + … has no factor A.
#[derive(Debug, Clone)]
struct CurveView {
    axis: Axis,
    /// Height of f = 0, in dots from the top.
    base: f64,
    /// Dots a unit of f.
    up: f64,
}

impl CurveView {
    fn of(section: &Section, canvas: &Canvas) -> Self {
        let frame = frame(canvas);
        let whole = Self::around_vertex(section, frame);
        if whole.tells_apart(section, frame) {
            return whole;
        }
        Self::around_start(section, frame).unwrap_or(whole)
    }

    /// Both roots and the vertex, and t = 0: beyond a break if it is far.
    fn around_vertex(section: &Section, frame: DrawingArea) -> Self {
        let start = -section.foot;
        let reach = [section.half, start.abs(), section.radius, section.speed]
            .into_iter()
            .find(|&length| length > 0.0)
            .unwrap_or(1.0);
        let wide = 1.6 * reach;
        let mut stretch = Stretch {
            anchor: Anchor::Foot,
            from: -wide,
            to: wide,
        };
        let mut breaks = [None, None];
        if start.abs() <= 4.0 * reach {
            stretch.from = stretch.from.min(start - 0.3 * reach);
            stretch.to = stretch.to.max(start + 0.3 * reach);
        } else if start < 0.0 {
            breaks[0] = Some(Anchor::Start);
        } else {
            breaks[1] = Some(Anchor::Start);
        }
        let axis = Axis::lay(frame, breaks[0], stretch, breaks[1], f64::INFINITY);
        let at_start = section.power(Anchor::Start, 0.0);
        let square = reach * reach;
        let mut top = wide * wide
            - if section.class == Class::Miss {
                -square
            } else {
                0.0
            };
        let mut bottom = -0.15 * top;
        if section.class == Class::Secant {
            top = 1.6 * square;
            bottom = -square;
        }
        // f(0) = C belongs to the picture unless it would squeeze all else.
        if at_start <= 4.0 * square {
            top = top.max(1.1 * at_start);
        }
        Self::upright(frame, axis, bottom, top)
    }

    /// t = 0 and the root nearest to it, the other root beyond a break.
    fn around_start(section: &Section, frame: DrawingArea) -> Option<Self> {
        let root = section.nearest_root()?;
        let start = section.offset(LinePoint::At(Anchor::Start), root);
        let around = start.abs();
        let stretch = Stretch {
            anchor: root,
            from: start.min(0.0) - around,
            to: start.max(0.0) + around,
        };
        let breaks = match root {
            _ if section.class == Class::Tangent => [None, None],
            Anchor::Near => [None, Some(Anchor::Far)],
            _ => [Some(Anchor::Near), None],
        };
        let axis = Axis::lay(frame, breaks[0], stretch, breaks[1], f64::INFINITY);
        let ends = [stretch.from, stretch.to].map(|offset| section.power(root, offset));
        let top = ends[0].max(ends[1]);
        let bottom = ends[0].min(ends[1]).min(-0.15 * top);
        Some(Self::upright(frame, axis, bottom, top))
    }

    fn upright(frame: DrawingArea, axis: Axis, bottom: f64, top: f64) -> Self {
        let up = frame.height() / (top - bottom);
        Self {
            axis,
            base: frame.top + top * up,
            up,
        }
    }

    /// Whether t = 0 and the roots are seen apart where they are.
    fn tells_apart(&self, section: &Section, frame: DrawingArea) -> bool {
        let apart = 5.0_f64.min(frame.width() / 8.0);
        let start = self.axis.place(section, LinePoint::At(Anchor::Start));
        let clear = |root| match (start, self.axis.place(section, LinePoint::At(root))) {
            (AxisPosition::On(start), AxisPosition::On(dot)) => (dot - start).abs() >= apart,
            _ => true,
        };
        !section.class.meets()
            || [Anchor::Near, Anchor::Far]
                .into_iter()
                .all(|root| section.position(LinePoint::At(root)) == 0.0 || clear(root))
    }

    fn height(&self, f: f64) -> f64 {
        self.base - f * self.up
    }
}

/// The room for shapes: margins are for labels.
fn frame(canvas: &Canvas) -> DrawingArea {
    let (width, height) = canvas.size();
    let side = (width / 16.0).min(4.0);
    let edge = (height / 8.0).min(5.0);
    DrawingArea {
        left: side,
        right: width - side,
        top: edge.min(3.0),
        bottom: height - edge,
    }
}

/// What the curve is drawn with.
struct CurvePlot {
    canvas: Canvas,
    view: CurveView,
    section: Section,
}

impl CurvePlot {
    fn draw(mut self, t: f64) -> Canvas {
        self.axes();
        self.curve();
        let marks = self.marks(t);
        self.canvas.write_marks(marks);
        self.numbers();
        self.canvas
    }

    fn place(&self, spot: LinePoint) -> Option<f64> {
        match self.view.axis.place(&self.section, spot) {
            AxisPosition::On(dot) => Some(dot),
            _ => None,
        }
    }

    fn axes(&mut self) {
        let (width, height) = self.canvas.size();
        let base = self.view.base;
        self.canvas
            .line((0.0, base), (width, base), FigureInk::Axis, Dash::DOTTED);
        if let Some(start) = self.place(LinePoint::At(Anchor::Start)) {
            self.canvas
                .line((start, 0.0), (start, height), FigureInk::Axis, Dash::DOTTED);
        }
        for (before, after) in self.view.axis.breaks() {
            let middle = f64::midpoint(before.right, after.left);
            let room = after.left - before.right;
            self.canvas.zigzag((middle, base), room, FigureInk::Axis);
        }
    }

    /// f, dotted for t < 0; steep parts are filled in between columns.
    fn curve(&mut self) {
        for (piece, left, right) in self.view.axis.drawn(self.canvas.size().0) {
            let origin = self.section.position(LinePoint::At(piece.anchor));
            let step = self.canvas.grain().0;
            let mut previous = None;
            let mut x = left + step / 2.0;
            let mut count = 0;
            while x < right {
                let offset = self.view.axis.offset(&piece, x);
                let y = self.view.height(self.section.power(piece.anchor, offset));
                let behind = origin + offset < 0.0;
                let ink = if behind {
                    FigureInk::Behind
                } else {
                    FigureInk::Curve
                };
                if !behind || Dash::DOTTED.draws(count) {
                    self.column(x, previous.unwrap_or(y), y, ink);
                }
                previous = Some(y);
                count += 1;
                x += step;
            }
        }
    }

    /// The curve between two columns: half of the rise on either side.
    fn column(&mut self, x: f64, from: f64, to: f64, ink: FigureInk) {
        let step = self.canvas.grain();
        if (to - from).abs() <= step.1 {
            self.canvas.plot((x, to), ink);
            return;
        }
        let middle = f64::midpoint(from, to);
        self.canvas
            .line((x - step.0, from), (x - step.0, middle), ink, Dash::SOLID);
        self.canvas.line((x, middle), (x, to), ink, Dash::SOLID);
    }

    /// The points that have names; an arrow for one that lies above or below the figure.
    fn marks(&self, t: f64) -> Vec<Mark> {
        let section = &self.section;
        let (width, height) = self.canvas.size();
        let [right, bottom] = [width, height].map(|edge| (edge - 1.0).max(0.0));
        let mark = |name, spot, sign, ink| {
            let on = self.view.axis.on(section, spot);
            let f = match on {
                Some((piece, _)) => section.power(piece.anchor, section.offset(spot, piece.anchor)),
                None => section.value(spot),
            };
            let y = self.view.height(f);
            let (x, sign) = match self.view.axis.place(section, spot) {
                AxisPosition::Before => (0.0, Sign::Before),
                AxisPosition::After => (right, Sign::After),
                AxisPosition::On(x) | AxisPosition::Break(x) if y < 0.0 => (x, Sign::Above),
                AxisPosition::On(x) | AxisPosition::Break(x) if y > bottom => (x, Sign::Below),
                AxisPosition::On(x) | AxisPosition::Break(x) => (x, sign),
            };
            Mark {
                name,
                dot: (x, y.clamp(0.0, bottom)),
                at: (section.position(spot), f),
                sign,
                ink,
            }
        };
        let root = |name, anchor| {
            let seen = section.visible() == Some(anchor);
            let sign = if seen { Sign::Seen } else { Sign::Unseen };
            mark(name, LinePoint::At(anchor), sign, FigureInk::Root)
        };
        let point = |name, anchor, sign| mark(name, LinePoint::At(anchor), sign, FigureInk::Point);
        let mut marks = vec![point("f(0)", Anchor::Start, Sign::Eye)];
        match section.class {
            Class::Secant | Class::Hit => marks.extend([
                root("P₁", Anchor::Near),
                root("P₂", Anchor::Far),
                point("V", Anchor::Foot, Sign::Cross),
            ]),
            Class::Tangent => marks.push(root("P₁ = P₂", Anchor::Near)),
            Class::Miss | Class::Nan => marks.push(point("V", Anchor::Foot, Sign::Cross)),
        }
        if t.is_finite() {
            let along = section.spot(t);
            marks.push(mark("p", along, Sign::Moved, FigureInk::Scrub));
        }
        marks
    }

    /// The names of the axes, and numbers at the points where they are read off.
    fn numbers(&mut self) {
        let base = self.view.base;
        let (width, _) = self.canvas.size();
        if let Some((col, row)) = self.canvas.cell_of((width - 1.0, base)) {
            self.canvas.write(col, row, "▸", FigureInk::Axis);
            self.canvas.label((col, row), "t", FigureInk::Note, true);
        }
        let start = self.place(LinePoint::At(Anchor::Start));
        if let Some((col, row)) = start.and_then(|x| self.canvas.cell_of((x, 0.0))) {
            self.canvas.label((col, row), "f", FigureInk::Note, true);
        }
        let [near, _, far] = times(&self.section);
        let mut ticks = match self.section.class {
            Class::Secant | Class::Hit => vec![(Anchor::Near, near), (Anchor::Far, far)],
            Class::Tangent => vec![(Anchor::Near, near)],
            Class::Miss | Class::Nan => Vec::new(),
        };
        if ticks.iter().all(|(_, text)| text != "0") {
            ticks.push((Anchor::Start, "0".into()));
        }
        for (anchor, text) in ticks {
            let x = self.place(LinePoint::At(anchor));
            let cell = x.and_then(|x| self.canvas.cell_of((x, base)));
            // A number that is longer would stand far from its point: the caption has it.
            if let (Some(cell), true) = (cell, text.chars().count() <= 10) {
                self.canvas.label(cell, &text, FigureInk::Note, false);
            }
        }
        if width < WIDE {
            return;
        }
        let [start, foot] = [Anchor::Start, Anchor::Foot].map(|a| self.place(LinePoint::At(a)));
        let beside = start.zip(foot).is_some_and(|(x, y)| (x - y).abs() < CLOSE);
        for (x, anchor) in [(start, Anchor::Start), (foot, Anchor::Foot)] {
            let f = self.section.power(anchor, 0.0);
            let cell = x.and_then(|x| self.canvas.cell_of((x, self.view.height(f))));
            if let (Some(cell), false, false) = (cell, f == 0.0, beside) {
                let text = rounded(f, 4);
                self.canvas.label(cell, &text, FigureInk::Note, false);
            }
        }
    }
}

/// Points closer than this, in dots, have their values in the caption alone: beside them it would
/// not be clear which is whose.
const CLOSE: f64 = 20.0;

/// From this width on, in dots, values of f stand beside their points.
const WIDE: f64 = 80.0;

fn caption(section: &Section, subject: &Subject, t: f64, glyphs: Glyphs) -> Caption {
    let mut caption = caption_of(section, subject, glyphs);
    let (sign, polynomial) = polynomial(section);
    caption.add("f(t)", sign, &polynomial);
    let [near, foot, far] = times_joined(section);
    let lowest = section.power(Anchor::Foot, 0.0);
    let lowest = joined("−Δ/4A", lowest, &show(lowest));
    match section.class {
        Class::Secant | Class::Hit => {
            caption.add("P₁", "at", &near);
            caption.add("P₂", "at", &far);
            caption.add("V", "lowest", &format!("at {foot}: {lowest}"));
        }
        Class::Tangent => {
            caption.add("P₁ = P₂", "touches 0 at", &near);
            caption.add("", "", "Δ = 0");
        }
        Class::Miss | Class::Nan => {
            caption.add("V", "lowest", &format!("at {foot}: {lowest}"));
            caption.say(Role::Plain, "above 0: no root");
        }
    }
    if t.is_finite() {
        let f = section.value(section.spot(t));
        let (at, f_text) = (joined("t", t, &show(t)), joined("f", f, &show(f)));
        caption.add("p", "at", &format!("{at}: {f_text}"));
        if f != 0.0
            && let Some(why) = not_zero(subject, t)
        {
            caption.say(Role::Faint, &why);
        }
    }
    if section.class.meets() && section.near < 0.0 {
        caption.say(Role::Faint, "dotted: t < 0, behind p0");
    }
    caption
}

/// Why f is not 0 at a root as the method has it; none if t is none of them.
fn not_zero(subject: &Subject, t: f64) -> Option<String> {
    let trace = &subject.trace;
    let roots = [&trace.near, &trace.far].into_iter().flatten();
    let root = roots.into_iter().find(|root| root.value == t)?;
    Some(if root.is_correctly_rounded() {
        "not 0: this t is the root rounded to the 24 bits of a binary32".into()
    } else {
        let off = root.ulps().map_or_else(
            || "none".to_owned(),
            |ulps| error_text(ulps, root.precision, Glyphs::Unicode) + " off",
        );
        format!("not 0: the root by {} is {off}", trace.method)
    })
}

/// At² + Bt + C in numbers, and whether it equals f or, with fewer digits, nearly so.
fn polynomial(section: &Section) -> (&'static str, String) {
    let c = section.power(Anchor::Start, 0.0);
    let speed = section.speed;
    let mut text = String::new();
    let mut sign = "=";
    for (x, power) in [
        (speed * speed, "t²"),
        (-2.0 * section.foot * speed, "t"),
        (c, ""),
    ] {
        let digits = rounded(x.abs(), 6);
        if x == 0.0 {
            continue;
        }
        // What is off in the last bits alone was rounded here, and is no news.
        let shown: f64 = digits.replace('−', "-").parse().unwrap_or(f64::NAN);
        let off = (shown / x.abs() - 1.0).abs();
        if off.is_nan() || off > 1e-14 {
            sign = "≈";
        }
        if !text.is_empty() {
            text += if x < 0.0 { " − " } else { " + " };
        } else if x < 0.0 {
            text += "−";
        }
        if digits != "1" || power.is_empty() {
            text += &digits;
        }
        if digits.contains('e') && !power.is_empty() {
            text += "·";
        }
        text += power;
    }
    (sign, text)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::explain::figure::cases;
    use proptest::prelude::*;

    fn plot((subject, ray): &(Subject, Ray), cols: usize, rows: usize) -> CurvePlot {
        let section = Section::new(ray, &subject.sphere);
        let canvas = Canvas::new(cols, rows, Glyphs::Unicode);
        let view = CurveView::of(&section, &canvas);
        CurvePlot {
            canvas,
            view,
            section,
        }
    }

    proptest! {
        #[test]
        fn roots_lie_on_the_axis_and_the_vertex_at_its_height(
            case in prop_oneof![cases::whole(), cases::aimed()],
            cols in 10_usize..160,
            rows in 4_usize..60,
        ) {
            let plot = plot(&case, cols, rows);
            for mark in plot.marks(f64::NAN) {
                let f = plot.section.power(Anchor::Foot, 0.0);
                if mark.ink == FigureInk::Root {
                    prop_assert!((mark.dot.1 - plot.view.base).abs() <= 1.0, "{:?}", mark);
                } else if mark.name == "V" && mark.sign == Sign::Cross {
                    prop_assert_eq!(mark.at.1, f);
                    prop_assert_eq!(mark.dot.1, plot.view.height(f));
                }
            }
        }

        #[test]
        fn the_curve_is_never_flat(case in prop_oneof![cases::whole(), cases::aimed()]) {
            let mut plot = plot(&case, 56, 16);
            plot.curve();
            let rows = plot.canvas.dots().into_iter().map(|(_, y)| y);
            let (top, bottom) = rows.fold((f64::INFINITY, 0.0_f64), |(t, b), y| (t.min(y), b.max(y)));
            prop_assert!(bottom - top >= 24.0, "from {} to {}", top, bottom);
        }
    }

    #[test]
    fn the_polynomial_is_that_of_the_tutorial() {
        let (subject, ray) = cases::named("tutorial centre");
        let section = Section::new(&ray, &subject.sphere);
        assert_eq!(polynomial(&section), ("=", "t² − 40t + 300".to_owned()));
        let (subject, ray) = cases::named("grazing miss");
        let section = Section::new(&ray, &subject.sphere);
        assert_eq!(polynomial(&section), ("≈", "t² − 6t + 9".to_owned()));
    }
}
