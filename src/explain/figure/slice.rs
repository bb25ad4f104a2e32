//! The slice: the plane through ray and centre, to scale, with the line lying flat.
//!
//! ```text
//!                ⢀⠤⠒⠒⠒⠤⡀
//!              ⡠⠊       ⠑⢄
//!   p0       B⡎           ⢱ B′
//!    ■────────●─────×─────○──────▸ d
//!             ⢇     ┊c    ⡸
//!              ⠑⢄   +   ⡠⠊
//! ```

use super::axis::{AxisPosition, Piece};
use super::canvas::{Canvas, Dash, Dot, FigureInk};
use super::caption::{Caption, caption_of, caption_room, joined, rounded, show, times_joined};
use super::mark::{Mark, Sign};
use super::section::{Anchor, LinePoint, Section};
use super::view::SliceView;
use crate::explain::{Digits, Line, Role, Subject, vector};
use crate::geometry::Ray;
use crate::method::Class;
use crate::text::Glyphs;

/// The plane through `ray` and the centre of the subject's sphere, with the point p = t·d + p0.
///
/// Exactly `rows` lines of at most `cols` columns. Where p0 is far off, the line has a break;
/// where the circle is all but flat, heights are stretched: the caption then says so.
pub fn slice(
    subject: &Subject,
    ray: &Ray,
    t: f64,
    cols: usize,
    rows: usize,
    glyphs: Glyphs,
) -> Vec<Line> {
    let section = Section::new(ray, &subject.sphere);
    let figure = |caption_rows: usize| {
        let canvas = Canvas::new(cols, rows.saturating_sub(caption_rows), glyphs);
        let view = SliceView::of(&section, &canvas);
        let caption = caption(&section, &view, subject, ray, t, glyphs);
        (canvas, view, caption.lines(cols, caption_rows))
    };
    let (_, _, longest) = figure(caption_room(cols, rows));
    let (canvas, view, caption) = figure(longest.len());
    let drawing = Drawing {
        canvas,
        view,
        section,
    };
    let mut lines = drawing.draw(t).lines();
    lines.extend(caption);
    lines.resize(rows, Line::new(0));
    lines
}

/// What the slice is drawn with.
struct Drawing {
    canvas: Canvas,
    view: SliceView,
    section: Section,
}

impl Drawing {
    fn draw(mut self, t: f64) -> Canvas {
        self.circle();
        self.line();
        self.height_and_tangent();
        self.radius();
        let normal = self.normal();
        let marks = self.marks(t);
        self.canvas.write_marks(marks);
        self.center_below();
        if let Some(tip) = normal {
            self.canvas.label(tip, "n", FigureInk::Normal, true);
        }
        self.break_lengths();
        self.overview();
        self.canvas
    }

    /// The circle: by columns where it is flat and by rows where it is steep, so that it has no
    /// gaps and is nowhere thicker than a dot.
    fn circle(&mut self) {
        for (piece, left, right) in self.view.axis.drawn(self.canvas.size().0) {
            self.flat_parts(&piece, left, right);
            self.steep_parts(&piece, left, right);
        }
    }

    fn flat_parts(&mut self, piece: &Piece, left: f64, right: f64) {
        let section = self.section;
        let grain = self.canvas.grain().0;
        for i in 0..((right - left) / grain).ceil() as u32 {
            let x = left + (f64::from(i) + 0.5) * grain;
            let offset = self.view.axis.offset(piece, x);
            let halves = [
                section.upper(piece.anchor, offset),
                section.lower(piece.anchor, offset),
            ];
            for height in halves.into_iter().flatten() {
                if self.slope(piece, offset, height) <= STEEP {
                    let y = self.view.base - height * self.view.up;
                    self.canvas.plot((x, y), FigureInk::Circle);
                }
            }
        }
    }

    fn steep_parts(&mut self, piece: &Piece, left: f64, right: f64) {
        let grain = self.canvas.grain().1;
        for i in 0..(self.canvas.size().1 / grain).ceil() as u32 {
            let y = (f64::from(i) + 0.5) * grain;
            let height = (self.view.base - y) / self.view.up;
            let sides = self.section.sides(piece.anchor, height);
            for offset in sides.into_iter().flatten() {
                let x = self.view.axis.dot_at(piece, offset);
                let inside = (left..right).contains(&x);
                if inside && self.slope(piece, offset, height) >= 1.0 / STEEP {
                    self.canvas.plot((x, y), FigureInk::Circle);
                }
            }
        }
    }

    /// How steep the circle is where it is drawn, in rows of marks to a column.
    fn slope(&self, piece: &Piece, offset: f64, height: f64) -> f64 {
        let (gx, gy) = self.canvas.grain();
        let along = self.section.beyond_foot(piece.anchor, offset);
        let above = height + self.section.distance;
        (self.view.stretch() * along / above * gx / gy).abs()
    }

    /// The line: dotted behind p0, broken where a part is left out, an arrow at its end.
    fn line(&mut self) {
        let base = self.view.base;
        let width = self.canvas.size().0;
        let start = match self
            .view
            .axis
            .place(&self.section, LinePoint::At(Anchor::Start))
        {
            AxisPosition::On(dot) | AxisPosition::Break(dot) => dot,
            AxisPosition::Before => 0.0,
            AxisPosition::After => width,
        };
        self.canvas
            .line((0.0, base), (start, base), FigureInk::Behind, Dash::DOTTED);
        self.canvas
            .line((start, base), (width, base), FigureInk::Ray, Dash::SOLID);
        for (before, after) in self.view.axis.breaks() {
            let ink = if before.right < start {
                FigureInk::Behind
            } else {
                FigureInk::Ray
            };
            let middle = f64::midpoint(before.right, after.left);
            let room = after.left - before.right;
            self.canvas.zigzag((middle, base), room, ink);
        }
        if let Some((col, row)) = self.canvas.cell_of((width - 1.0, base)) {
            self.canvas.write(col, row, "▸", FigureInk::Ray);
            self.canvas.label((col, row), "d", FigureInk::Ray, true);
        }
    }

    /// How much each break leaves out, beside its zigzag.
    fn break_lengths(&mut self) {
        for (before, after) in self.view.axis.breaks() {
            let middle = f64::midpoint(before.right, after.left);
            let length = self.view.axis.left_out(&before, &after, &self.section);
            let text = rounded(length, 3);
            if let Some(cell) = self.canvas.cell_of((middle, self.view.base)) {
                self.canvas.label(cell, &text, FigureInk::Note, true);
            }
        }
    }

    /// Where c is, in dots, seen from a piece.
    fn center(&self, piece: &Piece) -> Dot {
        let x = self
            .view
            .axis
            .dot(piece, &self.section, LinePoint::At(Anchor::Foot));
        (x, self.view.base + self.section.distance * self.view.up)
    }

    /// From c to the line, and for a miss the tangent.
    fn height_and_tangent(&mut self) {
        let base = self.view.base;
        let depth = self.section.distance * self.view.up;
        let foot = self
            .view
            .axis
            .place(&self.section, LinePoint::At(Anchor::Foot));
        if let (AxisPosition::On(x) | AxisPosition::Break(x), true) = (foot, depth >= THIN) {
            let center = (x, base + depth);
            self.canvas
                .line((x, base), center, FigureInk::Axis, Dash::DOTTED);
        }
        if let (AxisPosition::On(x), Class::Miss, Some(touch)) =
            (foot, self.section.class, self.touching_dot())
        {
            self.canvas
                .line((x, base), touch, FigureInk::Tangent, Dash::SOLID);
        }
    }

    /// From c to a point of the surface, unless that is along a line that is there already.
    fn radius(&mut self) {
        let base = self.view.base;
        let depth = self.section.distance * self.view.up;
        let on = |anchor| Some(self.view.axis.on(&self.section, LinePoint::At(anchor))?.1);
        let end = match self.section.class {
            Class::Miss => self.touching_dot(),
            Class::Secant | Class::Hit => {
                let root = self.section.visible().unwrap_or(Anchor::Near);
                on(root).map(|x| (x, base))
            }
            Class::Tangent | Class::Nan => None,
        };
        let (Some(foot), Some(end)) = (on(Anchor::Foot), end) else {
            return;
        };
        let center = (foot, base + depth);
        if depth < THIN || self.canvas.cell_of(center).is_none() {
            return;
        }
        self.canvas
            .line(center, end, FigureInk::Radius, Dash::SPARSE);
        let middle = (
            f64::midpoint(center.0, end.0),
            f64::midpoint(center.1, end.1),
        );
        if let Some(cell) = self.canvas.cell_of(middle) {
            self.canvas.label(cell, "r", FigureInk::Note, true);
        }
    }

    /// The outward normal at the visible point; its tip, for the label.
    fn normal(&mut self) -> Option<(usize, usize)> {
        let seen = LinePoint::At(self.section.visible()?);
        let (piece, x) = self.view.axis.on(&self.section, seen)?;
        let from = (x, self.view.base);
        let center = self.center(&piece);
        let (dx, dy) = (from.0 - center.0, from.1 - center.1);
        let length = dx.hypot(dy);
        let (width, height) = self.canvas.size();
        let reach = (width.min(height) / 5.0).clamp(4.0, 14.0);
        if length < 6.0 {
            return None;
        }
        let tip = (from.0 + dx / length * reach, from.1 + dy / length * reach);
        let cell = self.canvas.cell_of(tip)?;
        self.canvas.line(from, tip, FigureInk::Normal, Dash::SOLID);
        let (col, row) = cell;
        self.canvas
            .write(col, row, arrow(dx, dy), FigureInk::Normal);
        Some(cell)
    }

    /// The points that have names.
    fn marks(&self, t: f64) -> Vec<Mark> {
        let section = &self.section;
        let (width, _) = self.canvas.size();
        let mark = |name, spot, height: f64, sign, ink| {
            let (x, sign) = match self.view.axis.place(section, spot) {
                AxisPosition::On(x) | AxisPosition::Break(x) => (x, sign),
                AxisPosition::Before => (0.0, Sign::Before),
                AxisPosition::After => ((width - 1.0).max(0.0), Sign::After),
            };
            Mark {
                name,
                dot: (x, self.view.base - height * self.view.up),
                at: (section.position(spot), height),
                sign,
                ink,
            }
        };
        let root = |name, anchor| {
            let seen = section.visible() == Some(anchor);
            let sign = if seen { Sign::Seen } else { Sign::Unseen };
            mark(name, LinePoint::At(anchor), 0.0, sign, FigureInk::Root)
        };
        let point = |name, spot, height, sign| mark(name, spot, height, sign, FigureInk::Point);
        let foot = LinePoint::At(Anchor::Foot);
        let mut marks = vec![point("p0", LinePoint::At(Anchor::Start), 0.0, Sign::Eye)];
        match section.class {
            Class::Tangent => marks.push(root("P₁ = P₂", Anchor::Near)),
            Class::Secant | Class::Hit => {
                marks.extend([root("P₁", Anchor::Near), root("P₂", Anchor::Far)]);
            }
            Class::Miss | Class::Nan => marks.extend(self.touching_mark()),
        }
        if section.class != Class::Tangent {
            marks.push(point("q", foot, 0.0, Sign::Cross));
        }
        marks.push(point("c", foot, -section.distance, Sign::Center));
        if t.is_finite() {
            let along = section.spot(t);
            marks.push(mark("p", along, 0.0, Sign::Moved, FigureInk::Scrub));
        }
        marks
    }

    /// Where the tangent from the foot touches.
    fn touching_mark(&self) -> Option<Mark> {
        let (x, height) = self.section.touching_point();
        Some(Mark {
            name: "T",
            dot: self.touching_dot()?,
            at: (self.section.foot + x, height),
            sign: Sign::Cross,
            ink: FigureInk::Point,
        })
    }

    fn touching_dot(&self) -> Option<Dot> {
        let foot = LinePoint::At(Anchor::Foot);
        let (_, dot) = self.view.axis.on(&self.section, foot)?;
        let (x, height) = self.section.touching_point();
        Some((
            dot + x * self.view.axis.scale,
            self.view.base - height * self.view.up,
        ))
    }

    /// An arrow at the lower edge, towards a centre further down.
    fn center_below(&mut self) {
        let foot = LinePoint::At(Anchor::Foot);
        let (AxisPosition::On(x) | AxisPosition::Break(x)) =
            self.view.axis.place(&self.section, foot)
        else {
            return;
        };
        let bottom = (self.canvas.size().1 - 1.0).max(0.0);
        if self.view.base + self.section.distance * self.view.up <= bottom {
            return;
        }
        if let Some((col, row)) = self.canvas.cell_of((x, bottom)) {
            self.canvas.write(col, row, "↓", FigureInk::Point);
            self.canvas.label((col, row), "c", FigureInk::Point, true);
        }
    }

    /// The root that the widest piece shows.
    fn zoomed_root(&self) -> Option<Anchor> {
        let main = self.view.axis.main()?;
        [Anchor::Near, Anchor::Far].into_iter().find(|&root| {
            let on = self.view.axis.on(&self.section, LinePoint::At(root));
            self.section.class.meets() && on.is_some_and(|(piece, _)| piece.left == main.left)
        })
    }

    /// The whole circle and the line in true proportion, where the figure shows a part of it.
    fn overview(&mut self) {
        let across = 2.0 * self.section.radius * self.view.up;
        let (width, height) = self.canvas.size();
        if across <= width.max(height) && self.view.stretch() < 2.0 {
            return;
        }
        let title = if self.view.stretch() < 2.0 {
            "the whole"
        } else {
            "true shape"
        };
        let (cols, rows) = (title.len(), 5);
        let Some((col, row)) = self.canvas.blank_room(cols + 2, rows + 2) else {
            return;
        };
        let small = self.miniature(cols, rows);
        self.canvas.write(col + 1, row + 1, title, FigureInk::Note);
        self.canvas.paste((col + 1, row + 2), &small);
    }

    /// Circle, line, and the root that the figure is about, on a sheet of their own.
    fn miniature(&self, cols: usize, rows: usize) -> Canvas {
        let mut sheet = Canvas::new(cols, rows, self.canvas.glyphs());
        let (width, height) = sheet.size();
        let center = (width / 2.0, height / 2.0 + 0.5);
        let radius = height / 2.0 - 2.5;
        for degrees in (2..360).step_by(4) {
            let (sin, cos) = f64::from(degrees).to_radians().sin_cos();
            let dot = (center.0 + radius * cos, center.1 + radius * sin);
            sheet.plot(dot, FigureInk::Circle);
        }
        let scale = radius / self.section.radius;
        let line = center.1 - self.section.distance * scale;
        sheet.line((0.0, line), (width, line), FigureInk::Ray, Dash::SOLID);
        if let Some(root) = self.zoomed_root() {
            let along = self.section.beyond_foot(root, 0.0) * scale;
            if let Some((col, row)) = sheet.cell_of((center.0 + along, line)) {
                let sign = Sign::Unseen.glyph(sheet.glyphs());
                sheet.put(col, row, sign, FigureInk::Root);
            }
        }
        sheet
    }
}

/// Up to this slope the circle is drawn by columns, and down to its inverse by rows: a little of
/// both where it is diagonal, or coarse marks would leave a gap there.
const STEEP: f64 = 1.2;

/// The least length, in dots, at which a line from c to the ray is seen beside the ray.
const THIN: f64 = 3.0;

/// The arrow that points most nearly along (dx, dy), y down.
fn arrow(dx: f64, dy: f64) -> &'static str {
    if dx.abs() > 2.0 * dy.abs() {
        if dx > 0.0 { "→" } else { "←" }
    } else if dy.abs() > 2.0 * dx.abs() {
        if dy > 0.0 { "↓" } else { "↑" }
    } else {
        match (dx > 0.0, dy > 0.0) {
            (true, true) => "↘",
            (true, false) => "↗",
            (false, true) => "↙",
            (false, false) => "↖",
        }
    }
}

fn caption(
    section: &Section,
    view: &SliceView,
    subject: &Subject,
    ray: &Ray,
    t: f64,
    glyphs: Glyphs,
) -> Caption {
    let mut caption = caption_of(section, subject, glyphs);
    let [near, foot, far] = times_joined(section);
    match section.class {
        Class::Secant | Class::Hit => {
            caption.add("P₁", "in at", &near);
            caption.add("P₂", "out at", &far);
            caption.add("q", "closest to c:", &foot);
            caption.add("", "", &distance(section));
        }
        Class::Tangent => {
            caption.add("P₁ = P₂", "touches at", &near);
            caption.add(
                "",
                "",
                &joined("|P₁−c| = r", section.radius, &show(section.radius)),
            );
        }
        Class::Miss | Class::Nan => {
            caption.add("q", "closest to c:", &foot);
            caption.add("", "", &distance(section));
            caption.add("qT", "tangent: √(−Δ)/2A:", &tangent(section));
        }
    }
    if let Some(words) = place(section) {
        caption.say(Role::Plain, words);
    }
    if t.is_finite() {
        let p = ray.origin.as_dvec3() + t * ray.direction.as_dvec3();
        let p = vector(p.as_vec3(), Digits::Significant(5));
        let t = joined("t", t, &show(t));
        caption.add("p", "at", &format!("{t}: ({p})"));
    }
    let altitude = section.altitude();
    if altitude.abs() < 0.02 * section.radius && altitude != 0.0 {
        let side = if altitude > 0.0 { "above" } else { "below" };
        let altitude = rounded(altitude.abs(), 3);
        caption.add("p0", &altitude, &format!("{side} the surface"));
    }
    if section.radius > 0.0 && section.radius * view.axis.scale < 1.0 {
        caption.say(Role::Faint, "the circle is smaller than a dot");
    }
    if view.stretch() > 1.5 {
        let times = rounded(view.stretch(), 2);
        caption.say(
            Role::Faint,
            &format!("heights drawn {times} times too tall"),
        );
    }
    if view.axis.pieces.len() > 1 {
        caption.say(Role::Faint, "~/~/~ a gap, its length beside it");
    }
    caption
}

/// Where p0 is, where that decides what is seen.
fn place(section: &Section) -> Option<&'static str> {
    let Section {
        class, near, far, ..
    } = *section;
    if !class.meets() {
        None
    } else if far < 0.0 {
        Some("behind p0: the line meets the sphere, the ray does not")
    } else if far == 0.0 {
        Some("p0 is on the surface; the ray leaves it")
    } else if near == 0.0 {
        Some("p0 is on the surface; only P₂ lies ahead")
    } else if near < 0.0 {
        Some("p0 is inside; only P₂ lies ahead")
    } else {
        None
    }
}

/// How the distance of line and centre compares with r.
fn distance(section: &Section) -> String {
    let [q, r] = [section.distance, section.radius].map(show);
    let sign = if section.class == Class::Secant {
        "<"
    } else {
        ">"
    };
    if q == r {
        let depth = section.depth();
        let side = if depth > 0.0 { "−" } else { "+" };
        let depth = rounded(depth.abs(), 3);
        return format!(
            "|q−c| ≈ r {side} {depth}, {}",
            joined("r", section.radius, &r)
        );
    }
    format!(
        "{} {sign} {}",
        joined("|q−c|", section.distance, &q),
        joined("r", section.radius, &r)
    )
}

/// The length of the tangent, in t and, where that differs, in lengths.
fn tangent(section: &Section) -> String {
    let length = show(section.half);
    if section.speed == 1.0 {
        return length;
    }
    format!("{} · |d|, {length}", show(section.half / section.speed))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::explain::figure::cases;
    use proptest::prelude::*;

    fn drawing((subject, ray): &(Subject, Ray), cols: usize, rows: usize) -> Drawing {
        let section = Section::new(ray, &subject.sphere);
        let canvas = Canvas::new(cols, rows, Glyphs::Unicode);
        let view = SliceView::of(&section, &canvas);
        Drawing {
            canvas,
            view,
            section,
        }
    }

    fn from_center(dot: Dot, center: Dot) -> f64 {
        (dot.0 - center.0).hypot(dot.1 - center.1)
    }

    #[test]
    fn the_circle_is_round_and_closed() {
        for name in [
            "tutorial centre",
            "tutorial off centre",
            "inside",
            "behind",
            "far",
        ] {
            for (cols, rows) in [(36, 20), (56, 18), (100, 40), (14, 6)] {
                let mut drawing = drawing(&cases::named(name), cols, rows);
                drawing.circle();
                let main = *drawing.view.axis.main().unwrap();
                let center = drawing.center(&main);
                let radius = drawing.section.radius * drawing.view.up;
                let dots = drawing.canvas.dots();
                for &dot in &dots {
                    let off = from_center(dot, center) - radius;
                    assert!(
                        off.abs() <= 1.0,
                        "{name} {cols}x{rows}: {dot:?} is {off} off"
                    );
                }
                // A dot in every direction, within 1.5 dots of where the circle is.
                for degrees in 0..360 {
                    let (sin, cos) = f64::from(degrees).to_radians().sin_cos();
                    let point = (center.0 + radius * cos, center.1 + radius * sin);
                    let nearest = dots
                        .iter()
                        .map(|&dot| from_center(dot, point))
                        .fold(f64::INFINITY, f64::min);
                    assert!(nearest <= 1.5, "{name} {cols}x{rows}: a gap at {degrees}°");
                }
            }
        }
    }

    proptest! {
        #[test]
        fn the_roots_lie_on_line_and_circle(
            case in prop_oneof![cases::whole(), cases::aimed()],
            cols in 10_usize..160,
            rows in 4_usize..60,
        ) {
            let mut drawing = drawing(&case, cols, rows);
            drawing.circle();
            let dots = drawing.canvas.dots();
            let radius = drawing.section.radius * drawing.view.up;
            let (width, height) = drawing.canvas.size();
            for mark in drawing.marks(f64::NAN) {
                if mark.ink != FigureInk::Root || radius < 2.0 {
                    continue;
                }
                prop_assert_eq!(mark.dot.1, drawing.view.base);
                prop_assert!((0.0..width).contains(&mark.dot.0), "{:?}", mark);
                prop_assert!((0.0..height).contains(&mark.dot.1), "{:?}", mark);
                let nearest = dots
                    .iter()
                    .map(|&dot| from_center(dot, mark.dot))
                    .fold(f64::INFINITY, f64::min);
                prop_assert!(nearest <= 1.5, "{:?}: {}", mark, nearest);
            }
        }

        #[test]
        fn what_is_apart_is_seen_apart(case in cases::aimed()) {
            let drawing = drawing(&case, 56, 14);
            let marks = drawing.marks(f64::NAN);
            let roots: Vec<_> = marks.iter().filter(|m| m.ink == FigureInk::Root).collect();
            prop_assert_eq!(roots.len(), match drawing.section.class {
                Class::Secant | Class::Hit => 2,
                Class::Tangent => 1,
                Class::Miss | Class::Nan => 0,
            });
            let start = marks.iter().find(|m| m.name == "p0").unwrap();
            for root in &roots {
                let apart = (root.dot.0 - start.dot.0).abs();
                prop_assert!(root.at.0 == 0.0 || apart >= 4.0, "{:?} {:?}", start, root);
            }
        }
    }
}
