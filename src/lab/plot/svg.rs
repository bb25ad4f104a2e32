//! The few shapes of SVG that charts are made of. Numbers are written to a tenth of a unit.

use std::fmt::Write as _;

/// A drawing of a fixed size, its origin at the top left.
#[derive(Debug, Clone)]
pub(super) struct Svg {
    size: [f64; 2],
    title: String,
    body: String,
}

/// Where a text stands with regard to its point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum TextAnchor {
    Start,
    Middle,
    End,
}

/// How a line is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Stroke {
    pub color: &'static str,
    pub width: f64,
    pub dashed: bool,
}

impl Stroke {
    pub const fn solid(color: &'static str, width: f64) -> Self {
        Self {
            color,
            width,
            dashed: false,
        }
    }
}

/// The shape of a point: methods differ in more than their colour.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Marker {
    Square,
    Diamond,
    Triangle,
    Circle,
    Plus,
    Cross,
    Nabla,
    Ring,
    Star,
}

impl Svg {
    pub fn new(width: f64, height: f64, title: &str) -> Self {
        Self {
            size: [width, height],
            title: title.to_owned(),
            body: String::new(),
        }
    }

    /// The document.
    pub fn finish(self) -> String {
        let [w, h] = self.size;
        let title = escaped(&self.title);
        let body = self.body;
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {w} {h}\" width=\"{w}\" \
             height=\"{h}\" font-family=\"Helvetica, Arial, sans-serif\">\n<title>{title}</title>\n\
             <rect width=\"{w}\" height=\"{h}\" fill=\"#ffffff\"/>\n{body}</svg>\n"
        )
    }

    pub fn line(&mut self, from: [f64; 2], to: [f64; 2], stroke: Stroke) {
        self.polyline(&[from, to], stroke);
    }

    pub fn polyline(&mut self, points: &[[f64; 2]], stroke: Stroke) {
        let list: Vec<String> = points
            .iter()
            .map(|[x, y]| format!("{x:.1},{y:.1}"))
            .collect();
        let Stroke {
            color,
            width,
            dashed,
        } = stroke;
        let dashes = if dashed {
            " stroke-dasharray=\"4 3\""
        } else {
            ""
        };
        // Writing to a string does not fail.
        let _ = writeln!(
            self.body,
            "<polyline points=\"{}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"{width}\" \
             stroke-linejoin=\"round\"{dashes}/>",
            list.join(" ")
        );
    }

    fn rect(&mut self, [x, y]: [f64; 2], [w, h]: [f64; 2], fill: &str) {
        let _ = writeln!(
            self.body,
            "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{w:.1}\" height=\"{h:.1}\" fill=\"{fill}\"/>"
        );
    }

    pub fn text(
        &mut self,
        [x, y]: [f64; 2],
        text: &str,
        size: f64,
        color: &str,
        anchor: TextAnchor,
    ) {
        let anchor = match anchor {
            TextAnchor::Start => "start",
            TextAnchor::Middle => "middle",
            TextAnchor::End => "end",
        };
        let _ = writeln!(
            self.body,
            "<text x=\"{x:.1}\" y=\"{y:.1}\" font-size=\"{size}\" fill=\"{color}\" \
             text-anchor=\"{anchor}\">{}</text>",
            escaped(text)
        );
    }

    /// Text on a white ground, readable across lines. (Twice, since not every program that shows SVG
    /// knows `paint-order`.)
    pub fn label(&mut self, at: [f64; 2], text: &str, color: &str, anchor: TextAnchor) {
        self.body += "<g stroke=\"#ffffff\" stroke-width=\"3\">";
        self.text(at, text, 10.0, "#ffffff", anchor);
        self.body += "</g>\n";
        self.text(at, text, 10.0, color, anchor);
    }

    /// Text that reads upwards, centred on its point.
    /// A line of characters of one width, blanks kept.
    pub fn fixed(&mut self, [x, y]: [f64; 2], text: &str, size: f64, color: &str) {
        let _ = writeln!(
            self.body,
            "<text x=\"{x:.1}\" y=\"{y:.1}\" font-size=\"{size}\" fill=\"{color}\" \
             font-family=\"monospace\" xml:space=\"preserve\">{}</text>",
            escaped(text)
        );
    }

    pub fn text_upwards(&mut self, [x, y]: [f64; 2], text: &str, size: f64, color: &str) {
        let _ = writeln!(
            self.body,
            "<text transform=\"translate({x:.1} {y:.1}) rotate(-90)\" font-size=\"{size}\" \
             fill=\"{color}\" text-anchor=\"middle\">{}</text>",
            escaped(text)
        );
    }

    pub fn marker(&mut self, at: [f64; 2], marker: Marker, color: &'static str) {
        const R: f64 = 4.0;
        let [x, y] = at;
        match marker {
            Marker::Square => {
                self.rect([x - R + 0.5, y - R + 0.5], [2.0 * R - 1.0; 2], color);
            }
            Marker::Diamond => self.polygon(
                &[
                    [x, y - R - 1.0],
                    [x + R + 1.0, y],
                    [x, y + R + 1.0],
                    [x - R - 1.0, y],
                ],
                color,
            ),
            Marker::Triangle => self.polygon(
                &[[x, y - R - 0.5], [x + R + 0.5, y + R], [x - R - 0.5, y + R]],
                color,
            ),
            Marker::Nabla => self.polygon(
                &[[x, y + R + 0.5], [x + R + 0.5, y - R], [x - R - 0.5, y - R]],
                color,
            ),
            Marker::Circle => self.circle(at, R, color, "none"),
            Marker::Ring => self.circle(at, R, "#ffffff", color),
            Marker::Star => {
                // Ten corners, by turns far and near, the first on top.
                let corners: [[f64; 2]; 10] = std::array::from_fn(|i| {
                    let radius = if i % 2 == 0 { 1.6 * R } else { 0.65 * R };
                    let (sine, cosine) = (std::f64::consts::PI * i as f64 / 5.0).sin_cos();
                    [x + radius * sine, y - radius * cosine]
                });
                self.polygon(&corners, color);
            }
            Marker::Cross => {
                let stroke = Stroke::solid(color, 2.5);
                self.line([x - R, y - R], [x + R, y + R], stroke);
                self.line([x - R, y + R], [x + R, y - R], stroke);
            }
            Marker::Plus => {
                let stroke = Stroke::solid(color, 2.5);
                self.line([x - R - 0.5, y], [x + R + 0.5, y], stroke);
                self.line([x, y - R - 0.5], [x, y + R + 0.5], stroke);
            }
        }
    }

    fn polygon(&mut self, points: &[[f64; 2]], fill: &str) {
        let list: Vec<String> = points
            .iter()
            .map(|[x, y]| format!("{x:.1},{y:.1}"))
            .collect();
        let _ = writeln!(
            self.body,
            "<polygon points=\"{}\" fill=\"{fill}\"/>",
            list.join(" ")
        );
    }

    fn circle(&mut self, [x, y]: [f64; 2], radius: f64, fill: &str, stroke: &str) {
        let _ = writeln!(
            self.body,
            "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius}\" fill=\"{fill}\" stroke=\"{stroke}\" \
             stroke-width=\"2\"/>"
        );
    }
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
}
