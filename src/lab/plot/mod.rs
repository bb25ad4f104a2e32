//! Charts of the reports as SVG: error against run time, and bits lost against each dial.
//!
//! They are ours since the same chart by `plotters` (0.3, only its SVG backend), looked at beside this one, reads
//! worse where it matters: its labels lie on points, on lines and on each other (most methods are
//! within a label's height), and a point has one shape for all methods, which colour alone then tells
//! apart. To place labels and draw markers is most of the code here, and would be ours in any case.

mod dials;
mod svg;
mod work;

pub use dials::stability;
pub use work::{graded, work_precision};

use super::chart::Scale;
use svg::{Marker, Stroke, Svg, TextAnchor};

const INK: &str = "#333333";
const FAINT: &str = "#dddddd";

/// How a method looks in every chart (colours by Okabe and Ito).
fn look(method: &str) -> (&'static str, Marker) {
    match method {
        "textbook" => ("#d55e00", Marker::Square),
        "contracted" => ("#56b4e9", Marker::Cross),
        "unit" => ("#999999", Marker::Nabla),
        "citardauq" => ("#e69f00", Marker::Diamond),
        "haines" => ("#009e73", Marker::Triangle),
        "kahan" => ("#cc79a7", Marker::Circle),
        "double" => ("#0072b2", Marker::Plus),
        "exact" => ("#000000", Marker::Ring),
        // Somebody's own.
        _ => ("#5d3a9b", Marker::Star),
    }
}

/// The methods in a row, each with its marker.
fn legend(svg: &mut Svg, [mut x, y]: [f64; 2], methods: &[&str]) {
    for method in methods {
        let (color, marker) = look(method);
        svg.line([x, y - 4.0], [x + 22.0, y - 4.0], Stroke::solid(color, 2.0));
        svg.marker([x + 11.0, y - 4.0], marker, color);
        svg.text([x + 28.0, y], method, 12.0, INK, TextAnchor::Start);
        x += 46.0 + 7.0 * method.len() as f64;
    }
}

/// A rectangle on the drawing, and the scales of its edges.
#[derive(Debug, Clone, Copy)]
struct Plot {
    /// Top left.
    at: [f64; 2],
    /// Width and height.
    size: [f64; 2],
    x: Scale,
    y: Scale,
}

impl Plot {
    fn place(&self, x: f64, y: f64) -> [f64; 2] {
        [
            self.at[0] + self.x.part(x) * self.size[0],
            self.at[1] + (1.0 - self.y.part(y)) * self.size[1],
        ]
    }

    /// A line across at each value of y, with its label at the left.
    fn rules(&self, svg: &mut Svg, ticks: &[(f64, String)]) {
        for (y, label) in ticks {
            let left = self.place(self.x.first, *y);
            svg.line(left, self.place(self.x.last, *y), Stroke::solid(FAINT, 1.0));
            let beside = [left[0] - 5.0, left[1] + 3.5];
            svg.text(beside, label, 10.0, INK, TextAnchor::End);
        }
    }

    /// A line up at each value of x, with its label below.
    fn columns(&self, svg: &mut Svg, ticks: &[(f64, String)]) {
        for (x, label) in ticks {
            let foot = self.place(*x, self.y.first);
            svg.line(foot, self.place(*x, self.y.last), Stroke::solid(FAINT, 1.0));
            let below = [foot[0], foot[1] + 13.0];
            svg.text(below, label, 10.0, INK, TextAnchor::Middle);
        }
    }

    fn title(&self, svg: &mut Svg, title: &str) {
        svg.text(
            [self.at[0], self.at[1] - 7.0],
            title,
            13.0,
            "#000000",
            TextAnchor::Start,
        );
    }
}

/// 2^k with k as a superscript.
fn power_label(k: i32) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let exponent = k.to_string();
    let raised = exponent.chars().map(|c| match c.to_digit(10) {
        Some(digit) => DIGITS[digit as usize],
        None => '⁻',
    });
    std::iter::once('2').chain(raised).collect()
}
