//! A screen as SVG: its cells as shapes, its text in whatever font of equal widths there is.
//!
//! Blocks and borders are drawn as shapes, so that they meet in every font; each stretch of text is
//! given its width, so that columns stay columns.

use std::fmt::Write as _;

use ratatui::buffer::{Buffer, Cell};
use ratatui::style::{Color, Modifier};
use unicode_width::UnicodeWidthStr;

use crate::explorer::draw::theme::Palette;
use crate::render::xterm;
use crate::scene::Rgb;

/// Width and height of a cell, and the height of its text, in units of the drawing.
const CELL: [f64; 2] = [9.0, 18.0];
const FONT: f64 = 15.0;
/// What is left free around the screen.
const MARGIN: f64 = 9.0;
/// How high above the lower edge of its cell a text stands.
const BASE: f64 = 4.5;

/// Colours of text and ground where a cell has none of its own.
const fn own_colors(palette: Palette) -> [Rgb; 2] {
    match palette {
        Palette::Dark | Palette::Either => [Rgb(212, 212, 212), Rgb(24, 24, 27)],
        Palette::HighContrast => [Rgb(255, 255, 255), Rgb(0, 0, 0)],
        Palette::Light | Palette::Monochrome => [Rgb(36, 36, 36), Rgb(255, 255, 255)],
    }
}

/// How a cell looks.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Ink {
    fg: Rgb,
    bg: Rgb,
    bold: bool,
    faint: bool,
    underlined: bool,
}

impl Ink {
    fn of(cell: &Cell, [text, ground]: [Rgb; 2]) -> Self {
        let has = |modifier| cell.modifier.contains(modifier);
        let (mut fg, mut bg) = (rgb(cell.fg, text), rgb(cell.bg, ground));
        if has(Modifier::REVERSED) {
            std::mem::swap(&mut fg, &mut bg);
        }
        Self {
            fg,
            bg,
            bold: has(Modifier::BOLD),
            faint: has(Modifier::DIM),
            underlined: has(Modifier::UNDERLINED),
        }
    }
}

fn rgb(color: Color, own: Rgb) -> Rgb {
    let basic = |n| xterm(n);
    match color {
        Color::Reset => own,
        Color::Rgb(r, g, b) => Rgb(r, g, b),
        Color::Indexed(n) => xterm(n),
        Color::Black => basic(0),
        Color::Red => basic(1),
        Color::Green => basic(2),
        Color::Yellow => basic(3),
        Color::Blue => basic(4),
        Color::Magenta => basic(5),
        Color::Cyan => basic(6),
        Color::Gray => basic(7),
        Color::DarkGray => basic(8),
        Color::LightRed => basic(9),
        Color::LightGreen => basic(10),
        Color::LightYellow => basic(11),
        Color::LightBlue => basic(12),
        Color::LightMagenta => basic(13),
        Color::LightCyan => basic(14),
        Color::White => basic(15),
    }
}

/// The screen in `buffer` as an SVG document.
pub fn svg(buffer: &Buffer, palette: Palette, title: &str) -> String {
    let colors = own_colors(palette);
    let area = buffer.area;
    let [width, height] = [
        f64::from(area.width) * CELL[0] + 2.0 * MARGIN,
        f64::from(area.height) * CELL[1] + 2.0 * MARGIN,
    ];
    let ground = colors[1];
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" \
         width=\"{width}\" height=\"{height}\" font-family=\"ui-monospace, monospace\" \
         font-size=\"{FONT}\">\n<title>{}</title>\n\
         <rect width=\"{width}\" height=\"{height}\" rx=\"6\" fill=\"{ground}\"/>\n",
        escaped(title)
    );
    for y in area.top()..area.bottom() {
        let row = Row {
            top: MARGIN + f64::from(y - area.y) * CELL[1],
            cells: (area.left()..area.right())
                .map(|x| (&buffer[(x, y)], Ink::of(&buffer[(x, y)], colors)))
                .collect(),
            ground,
        };
        row.draw(&mut out);
    }
    out += "</svg>\n";
    out
}

/// A row of cells.
struct Row<'a> {
    top: f64,
    cells: Vec<(&'a Cell, Ink)>,
    ground: Rgb,
}

impl Row<'_> {
    fn draw(&self, out: &mut String) {
        self.draw_halves(out);
        self.draw_text(out);
    }

    /// What is behind the text, and blocks: two halves of each cell, in as few rectangles as do.
    fn draw_halves(&self, out: &mut String) {
        let halves = |&(cell, ink): &(&Cell, Ink)| match cell.symbol() {
            "▀" => [ink.fg, ink.bg],
            "▄" => [ink.bg, ink.fg],
            "█" => [ink.fg; 2],
            _ => [ink.bg; 2],
        };
        let halves: Vec<_> = self.cells.iter().map(halves).collect();
        let mut from = 0;
        for run in halves.chunk_by(|one, other| one == other) {
            let to = from + run.len();
            let [upper, lower] = run[0];
            if upper == lower {
                self.rect(out, (from, to), [0.0, CELL[1]], upper);
            } else {
                self.rect(out, (from, to), [0.0, CELL[1] / 2.0], upper);
                self.rect(out, (from, to), [CELL[1] / 2.0, CELL[1]], lower);
            }
            from = to;
        }
    }

    fn rect(&self, out: &mut String, cells: (usize, usize), [top, bottom]: [f64; 2], color: Rgb) {
        if color == self.ground {
            return;
        }
        let [x, end] = [left(cells.0), left(cells.1)];
        // Writing to a string does not fail.
        let _ = writeln!(
            out,
            "<rect x=\"{x}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{color}\" \
             shape-rendering=\"crispEdges\"/>",
            self.top + top,
            end - x,
            bottom - top
        );
    }

    /// Borders as lines, and stretches of text of one look.
    fn draw_text(&self, out: &mut String) {
        let mut at = 0;
        while at < self.cells.len() {
            let (cell, ink) = self.cells[at];
            let symbol = cell.symbol();
            if symbol.trim().is_empty() || "▀▄█".contains(symbol) {
                at += 1;
                continue;
            }
            if let Some(arms) = arms(symbol) {
                let run = self.cells[at..].iter();
                let same = run.take_while(|(other, _)| symbol == "─" && other.symbol() == symbol);
                let length = same.count().max(1);
                self.draw_border(out, (at, at + length), arms, ink);
                at += length;
                continue;
            }
            at = self.draw_stretch(out, at);
        }
    }

    /// Draws the text from cell `from` on, as far as it looks the same; the cell after it.
    fn draw_stretch(&self, out: &mut String, from: usize) -> usize {
        let ink = self.cells[from].1;
        let (mut text, mut at) = (String::new(), from);
        while let Some(&(cell, other)) = self.cells.get(at) {
            let symbol = cell.symbol();
            let is_text = arms(symbol).is_none() && !"▀▄█".contains(symbol);
            let is_gap = symbol == " "
                && self
                    .cells
                    .get(at + 1)
                    .is_none_or(|(next, _)| next.symbol() == " ");
            if other != ink || !is_text || is_gap {
                break;
            }
            text += symbol;
            at += symbol.width().max(1);
        }
        let text = text.trim_end();
        let look = [
            (ink.bold, " font-weight=\"bold\""),
            (ink.faint, " fill-opacity=\"0.65\""),
            (ink.underlined, " text-decoration=\"underline\""),
        ];
        let look: String = look
            .into_iter()
            .filter_map(|(is_so, text)| is_so.then_some(text))
            .collect();
        let _ = writeln!(
            out,
            "<text x=\"{}\" y=\"{}\" textLength=\"{}\" lengthAdjust=\"spacingAndGlyphs\" \
             fill=\"{}\"{look} xml:space=\"preserve\">{}</text>",
            left(from),
            self.top + CELL[1] - BASE,
            text.width() as f64 * CELL[0],
            ink.fg,
            escaped(text)
        );
        at.max(from + 1)
    }

    /// The lines of a border through the middles of cells, to the sides that it has arms to.
    fn draw_border(&self, out: &mut String, cells: (usize, usize), arms: [bool; 4], ink: Ink) {
        let [left_arm, right_arm, up, down] = arms;
        let [x0, x1] = [left(cells.0), left(cells.1)];
        let [x, y] = [f64::midpoint(x0, x1), self.top + CELL[1] / 2.0];
        let mut path = String::new();
        if left_arm || right_arm {
            let [from, to] = [
                if left_arm { x0 } else { x },
                if right_arm { x1 } else { x },
            ];
            let _ = write!(path, "M{from} {y}H{to}");
        }
        if up || down {
            let from = if up { self.top } else { y };
            let to = if down { self.top + CELL[1] } else { y };
            let _ = write!(path, "M{x} {from}V{to}");
        }
        let _ = writeln!(
            out,
            "<path d=\"{path}\" stroke=\"{}\" stroke-opacity=\"{}\" fill=\"none\"/>",
            ink.fg,
            if ink.faint { 0.5 } else { 1.0 }
        );
    }
}

/// To which sides a border's character goes: left, right, up, down.
fn arms(symbol: &str) -> Option<[bool; 4]> {
    Some(match symbol {
        "─" => [true, true, false, false],
        "│" => [false, false, true, true],
        "┌" => [false, true, false, true],
        "┐" => [true, false, false, true],
        "└" => [false, true, true, false],
        "┘" => [true, false, true, false],
        _ => return None,
    })
}

fn left(cell: usize) -> f64 {
    MARGIN + cell as f64 * CELL[0]
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use ratatui::layout::Rect;
    use ratatui::style::Style;

    use super::*;

    #[test]
    fn cells_become_shapes_and_text_of_their_colours() {
        let mut buffer = Buffer::empty(Rect::new(0, 0, 6, 1));
        let red = Style::new()
            .fg(Color::Rgb(255, 0, 0))
            .bg(Color::Indexed(21));
        buffer.set_string(0, 0, "▀▀", red);
        buffer.set_string(2, 0, "─a<b", Style::new().add_modifier(Modifier::BOLD));
        let svg = svg(&buffer, Palette::Light, "A & B");
        assert!(svg.contains("<title>A &amp; B</title>"), "{svg}");
        for shape in [
            "<rect x=\"9\" y=\"9\" width=\"18\" height=\"9\" fill=\"#ff0000\"",
            "<rect x=\"9\" y=\"18\" width=\"18\" height=\"9\" fill=\"#0000ff\"",
            "<path d=\"M27 18H36\"",
            "textLength=\"27\" lengthAdjust=\"spacingAndGlyphs\" fill=\"#242424\" \
             font-weight=\"bold\" xml:space=\"preserve\">a&lt;b</text>",
        ] {
            assert!(svg.contains(shape), "no {shape} in {svg}");
        }
    }
}
