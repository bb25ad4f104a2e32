//! The tutorial's first drawing: a circle around the origin and a line across it, in two dimensions.
//!
//! The line's numbers are tenths, so that every number of its quadratic is an exact decimal.

use super::canvas::{Canvas, Dash, FigureInk};
use crate::explain::Line;
use crate::text::Glyphs;

/// The circle's radius.
const RADIUS: i64 = 5;
/// How many units are seen on either side of the origin, at least.
const SEEN: f64 = 7.0;
/// The steepest and the highest line, in tenths.
const MOST: i64 = 99;

/// The line y = slope·x + height, both in tenths.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PlaneLine {
    slope: i64,
    height: i64,
}

impl PlaneLine {
    /// The tutorial's line, y = 1.1x + 0.2.
    pub const TUTORIAL: Self = Self {
        slope: 11,
        height: 2,
    };

    /// The line with these tenths added to its slope and its height.
    #[must_use]
    pub fn moved(self, slope: i64, height: i64) -> Self {
        Self {
            slope: (self.slope + slope).clamp(-MOST, MOST),
            height: (self.height + height).clamp(-MOST, MOST),
        }
    }

    /// a, b and c of the quadratic ax² + bx + c = 0, in hundredths.
    const fn coefficients(self) -> [i64; 3] {
        let Self { slope, height } = self;
        [
            100 + slope * slope,
            2 * slope * height,
            height * height - 100 * RADIUS * RADIUS,
        ]
    }

    /// The discriminant, in ten thousandths.
    const fn discriminant(self) -> i64 {
        let [a, b, c] = self.coefficients();
        b * b - 4 * a * c
    }

    /// The x of each point in common, the least first, rounded to hundredths.
    fn roots(self) -> Vec<i64> {
        let [a, b, _] = self.coefficients().map(|n| n as f64);
        let root = (self.discriminant() as f64).sqrt();
        let x = |sign: f64| (100.0 * (-b + sign * root) / (2.0 * a)).round() as i64;
        match self.discriminant() {
            ..0 => Vec::new(),
            0 => vec![x(0.0)],
            _ => vec![x(-1.0), x(1.0)],
        }
    }

    /// y at an x in hundredths, in thousandths.
    const fn y(self, x: i64) -> i64 {
        self.slope * x + 100 * self.height
    }

    /// What y is: slope·x + height.
    fn equation(self) -> String {
        terms(&[(self.slope, 1, "x"), (self.height, 1, "")])
    }
}

/// `n` in units of the last of `places` decimals, without zeros at its end.
fn decimal(n: i64, places: u32) -> String {
    let unit = 10_i64.pow(places);
    let (whole, rest) = (n.abs() / unit, n.abs() % unit);
    let digits = format!("{rest:0width$}", width = places as usize);
    let digits = digits.trim_end_matches('0');
    let sign = if n < 0 { "−" } else { "" };
    if digits.is_empty() {
        format!("{sign}{whole}")
    } else {
        format!("{sign}{whole}.{digits}")
    }
}

/// A sum of terms, each a number with its decimals and the letters behind it: without those that are 0,
/// and x for 1x.
fn terms(all: &[(i64, u32, &str)]) -> String {
    let mut sum = String::new();
    for &(n, places, letters) in all.iter().filter(|(n, ..)| *n != 0) {
        sum += match (n < 0, sum.is_empty()) {
            (false, true) => "",
            (true, true) => "−",
            (false, false) => " + ",
            (true, false) => " − ",
        };
        let number = decimal(n.abs(), places);
        if number != "1" || letters.is_empty() {
            sum += &number;
        }
        sum += letters;
    }
    if sum.is_empty() { "0".into() } else { sum }
}

/// The same as a factor, in brackets where it has a sign.
fn factor(n: i64, places: u32) -> String {
    let text = decimal(n, places);
    if n < 0 { format!("({text})") } else { text }
}

/// What the line's quadratic says, in lines of words and numbers.
pub fn plane_lines(line: PlaneLine) -> Vec<Line> {
    let [a, b, c] = line.coefficients();
    let discriminant = line.discriminant();
    let mut out = vec![
        "circle  x² + y² = 25".to_owned(),
        format!("line    y = {}", line.equation()),
        "the line put into the circle:".into(),
        format!("  x² + ({})² = 25", line.equation()),
        "multiplied out and sorted:".into(),
        format!("  {} = 0", terms(&[(a, 2, "x²"), (b, 2, "x"), (c, 2, "")])),
        "discriminant".into(),
        format!("  {}² − 4·{}·{}", factor(b, 2), decimal(a, 2), factor(c, 2)),
        format!("  = {}", decimal(discriminant, 4)),
    ];
    let two_a = decimal(2 * a, 2);
    match line.roots()[..] {
        [] => out.push("below 0: no point in common".into()),
        [_] => out.push("0: the line touches the circle".into()),
        _ => {
            out.push("above 0: two points in common".into());
            let minus_b = decimal(-b, 2);
            let root = decimal(discriminant, 4);
            out.push(format!("  x = ({minus_b} ± √{root}) / {two_a}"));
        }
    }
    for (n, x) in (1..).zip(line.roots()) {
        let place = format!("({}, {})", decimal(x, 2), decimal(line.y(x), 3));
        out.push(format!(
            "  x ≈ {}: P{} at {place}",
            decimal(x, 2),
            subscript(n)
        ));
    }
    out.into_iter().map(Line::plain).collect()
}

const fn subscript(n: usize) -> char {
    if n == 1 { '₁' } else { '₂' }
}

/// Circle, axes, line and the points in common, on exactly `rows` lines of at most `cols` columns.
pub fn plane(line: PlaneLine, cols: usize, rows: usize, glyphs: Glyphs) -> Vec<Line> {
    let mut canvas = Canvas::new(cols, rows, glyphs);
    let (width, height) = canvas.size();
    let unit = width.min(height) / (2.0 * SEEN);
    if unit == 0.0 {
        return canvas.lines();
    }
    let dot = |x: f64, y: f64| (width / 2.0 + unit * x, height / 2.0 - unit * y);
    let reach = width.max(height) / unit;
    canvas.line(
        dot(-reach, 0.0),
        dot(reach, 0.0),
        FigureInk::Axis,
        Dash::DOTTED,
    );
    canvas.line(
        dot(0.0, -reach),
        dot(0.0, reach),
        FigureInk::Axis,
        Dash::DOTTED,
    );
    let radius = RADIUS as f64;
    let pieces = 90;
    let around = |n: i32| {
        let (sin, cos) = (f64::from(n) * std::f64::consts::TAU / f64::from(pieces)).sin_cos();
        dot(radius * cos, radius * sin)
    };
    for n in 0..pieces {
        canvas.line(around(n), around(n + 1), FigureInk::Circle, Dash::SOLID);
    }
    let y = |x: f64| line.slope as f64 / 10.0 * x + line.height as f64 / 10.0;
    canvas.line(
        dot(-reach, y(-reach)),
        dot(reach, y(reach)),
        FigureInk::Ray,
        Dash::SOLID,
    );
    for (n, x) in (1..).zip(line.roots()) {
        let x = x as f64 / 100.0;
        if let Some(cell) = canvas.cell_of(dot(x, y(x))) {
            canvas.put(
                cell.0,
                cell.1,
                glyphs.spell("●").chars().next().unwrap_or('*'),
                FigureInk::Root,
            );
            canvas.label(
                cell,
                &format!("P{}", subscript(n)),
                FigureInk::Root,
                x > 0.0,
            );
        }
    }
    for (x, y, text) in [
        (radius, 0.0, "5"),
        (-radius, 0.0, "−5"),
        (0.0, radius, "5"),
        (0.0, -radius, "−5"),
    ] {
        if let Some(cell) = canvas.cell_of(dot(x, y)) {
            canvas.label(cell, text, FigureInk::Note, false);
        }
    }
    if let Some(cell) = canvas.cell_of(dot(SEEN - 0.4, 0.0)) {
        canvas.label(cell, "x", FigureInk::Note, true);
    }
    if let Some(cell) = canvas.cell_of(dot(0.0, SEEN - 0.4)) {
        canvas.label_beside(cell, "y", FigureInk::Note);
    }
    canvas.lines()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(lines: &[Line]) -> String {
        lines.iter().map(|line| line.text() + "\n").collect()
    }

    #[test]
    fn the_tutorials_line_has_the_tutorials_numbers() {
        let text = text(&plane_lines(PlaneLine::TUTORIAL));
        for number in [
            "y = 1.1x + 0.2",
            "2.21x² + 0.44x − 24.96 = 0",
            "0.44² − 4·2.21·(−24.96)",
            "= 220.84",
            "(−0.44 ± √220.84) / 4.42",
            "(3.26, 3.786)",
            "(−3.46, −3.606)",
        ] {
            assert!(text.contains(number), "no {number} in\n{text}");
        }
    }

    #[test]
    fn a_line_that_is_moved_away_touches_and_then_misses() {
        let flat = PlaneLine::TUTORIAL.moved(-11, 48);
        assert!(text(&plane_lines(flat)).contains("the line touches"));
        let past = flat.moved(0, 1);
        assert!(text(&plane_lines(past)).contains("no point in common"));
        assert_eq!(flat.moved(1000, 0).slope, MOST);
    }

    #[test]
    fn a_sum_has_no_term_that_is_0_and_no_1_before_a_letter() {
        let text = text(&plane_lines(PlaneLine::TUTORIAL.moved(-1, -2)));
        assert!(text.contains("y = x\n"), "{text}");
        assert!(text.contains("  2x² − 25 = 0"), "{text}");
        assert_eq!(terms(&[(-10, 1, "x"), (5, 1, "")]), "−x + 0.5");
        assert_eq!(terms(&[(0, 1, "x"), (0, 1, "")]), "0");
    }

    #[test]
    fn circle_axes_line_and_points_are_drawn() {
        for glyphs in [Glyphs::Unicode, Glyphs::Ascii] {
            let lines = plane(PlaneLine::TUTORIAL, 40, 18, glyphs);
            assert_eq!(lines.len(), 18);
            assert!(lines.iter().all(|line| line.width() <= 40));
        }
        let drawn = text(&plane(PlaneLine::TUTORIAL, 40, 18, Glyphs::Unicode));
        for mark in ["P₁", "P₂", "x", "y", "−5"] {
            assert!(drawn.contains(mark), "no {mark} in\n{drawn}");
        }
        assert_eq!(drawn.matches('●').count(), 2);
    }
}
