//! The picture in its border, with the cursor's marks; or the numbers in one line.

use ratatui::layout::{Position, Rect};
use ratatui::style::{Color, Modifier, Style as CellStyle};
use unicode_width::UnicodeWidthStr;

use crate::explain::{self, Digits, number};
use crate::explorer::draw::layout;
use crate::explorer::draw::pen::Pen;
use crate::explorer::state::State;
use crate::explorer::walk;
use crate::method::{Place, Precision};
use crate::render::{Cell, Style};
use crate::scene::Rgb;
use crate::text::Glyphs;

/// What a cell shows while what it tells is to be predicted.
const VEILED: Cell = Cell {
    glyph: '.',
    fg: None,
    bg: None,
};

/// What marks a cell with a pixel that is wrong.
const WRONG: char = '!';

/// The picture in its border; the place of the cursor's cell.
pub(crate) fn draw(
    state: &State,
    wrong: &[(u32, u32)],
    pen: &mut Pen<'_>,
    area: Rect,
) -> Option<Position> {
    if let Some(line) = state.plane {
        pen.frame(area, "circle and line", "arrows raise and turn the line");
        let room = layout::inner(area);
        let (cols, rows) = (room.width.into(), room.height.into());
        pen.lines(room, &explain::plane(line, cols, rows, pen.glyphs));
        return None;
    }
    let size = state.size();
    let step = number(
        state.work.stride.into(),
        Precision::Binary32,
        Digits::Significant(6),
    );
    let step = format!("step {step}");
    let (x, y) = state.at.cursor;
    let acne = state.picture.frame.acne(state.scene(), x, y);
    let foot = match (acne, state.at.sphere) {
        (Some(acne), _) => explain::acne_words(&acne),
        (None, Some(at)) => format!("sphere {} selected  {step}", at + 1),
        (None, None) => step,
    };
    pen.frame(area, "", &foot);
    let image = &state.picture.image;
    let (left, top) = state.picture.offset;
    let veiled = walk::is_picture_veiled(state);
    let place = layout::centered(area, image, (left, top));
    let (x0, y0, shown) = (place.x, place.y, (place.width, place.height));
    for row in 0..shown.1 {
        for col in 0..shown.0 {
            let Some(cell) = image.cell(left + u32::from(col), top + u32::from(row)) else {
                continue;
            };
            let cell = if veiled { VEILED } else { cell };
            let (fg, bg) = (pen.theme.color(cell.fg), pen.theme.color(cell.bg));
            let (glyph, fg, bg) = match cell.glyph {
                // A blank looks the same and takes a third of the bytes.
                '█' if fg != Color::Reset => (' ', Color::Reset, fg),
                glyph => (glyph, fg, bg),
            };
            pen.buffer[(x0 + col, y0 + row)]
                .set_char(glyph)
                .set_style(CellStyle::new().fg(fg).bg(bg));
        }
    }
    if !veiled {
        mark_wrong(state, wrong, pen, (x0, y0), shown);
    }
    let end_of_foot = area.x + 4 + foot.width() as u16;
    mark_edges(state, pen, area, shown, end_of_foot);
    let (col, row) = state
        .at
        .style
        .cell_of_pixel(state.at.cursor.0, state.at.cursor.1);
    let at = (col.checked_sub(left), row.checked_sub(top));
    let at = match at {
        (Some(col), Some(row)) if col < shown.0.into() && row < shown.1.into() => {
            Some(Position::new(x0 + col as u16, y0 + row as u16))
        }
        _ => None,
    };
    let hidden = if veiled { ", hidden" } else { "" };
    let coarse = if state.coarse { ", coarse" } else { "" };
    let more = match state.picture.percent_done() {
        Some(percent) => format!(", {percent}% drawn"),
        None => String::new(),
    };
    let title = format!("view {size}{hidden}{coarse}{more}");
    pen.border_text(area, area.y, &title, at.map(|at| at.x));
    if let Some(at) = at {
        mark_cursor(state, pen, area, at);
        if !wrong.contains(&(col, row)) {
            mark_pixel(state, veiled, pen, at);
        }
    }
    at
}

/// A mark on each cell with a pixel that the method gets wrong, while a dial is looked at.
fn mark_wrong(
    state: &State,
    wrong: &[(u32, u32)],
    pen: &mut Pen<'_>,
    (x0, y0): (u16, u16),
    shown: (u16, u16),
) {
    let (left, top) = state.picture.offset;
    let style = pen.theme.wrong();
    for &(col, row) in wrong {
        let at = (col.checked_sub(left), row.checked_sub(top));
        let (Some(col), Some(row)) = at else { continue };
        if col < shown.0.into() && row < shown.1.into() {
            pen.buffer[(x0 + col as u16, y0 + row as u16)]
                .set_char(WRONG)
                .set_style(style);
        }
    }
}

/// Arrows in the border where the picture goes on.
fn mark_edges(state: &State, pen: &mut Pen<'_>, area: Rect, shown: (u16, u16), end_of_foot: u16) {
    let image = &state.picture.image;
    let (left, top) = state.picture.offset;
    let middle = Position::new(area.x + area.width / 2, area.y + area.height / 2);
    let (right, bottom) = (area.right().max(1) - 1, area.bottom().max(1) - 1);
    let below = if middle.x < end_of_foot {
        right.saturating_sub(1)
    } else {
        middle.x
    };
    let style = pen.theme.mark();
    for (more, x, y, arrow) in [
        (left > 0, area.x, middle.y, "←"),
        (left + u32::from(shown.0) < image.cols, right, middle.y, "→"),
        (top > 0, middle.x, area.y, "↑"),
        (top + u32::from(shown.1) < image.rows, below, bottom, "↓"),
    ] {
        if more {
            let arrow = match (pen.glyphs, arrow) {
                (Glyphs::Ascii, "→") => ">",
                _ => arrow,
            };
            pen.text(x, y, 1, arrow, style);
        }
    }
}

/// Marks in the border that say in which column and row the cursor is.
fn mark_cursor(state: &State, pen: &mut Pen<'_>, area: Rect, at: Position) {
    let style = pen.theme.mark();
    let side = match state.at.style {
        // Two pixels share the cell: the mark tells which of them is meant.
        Style::Half if state.at.cursor.1.is_multiple_of(2) => "▀",
        Style::Half => "▄",
        _ => "▸",
    };
    let side = match pen.glyphs {
        Glyphs::Unicode => side,
        Glyphs::Ascii if side == "▀" => "\"",
        Glyphs::Ascii if side == "▄" => "_",
        Glyphs::Ascii => ">",
    };
    pen.text(at.x, area.y, 1, "▾", style);
    pen.text(area.x, at.y, 1, side, style);
}

/// Marks the cursor's pixel in its cell: where two pixels share it, by a half disc on its half.
fn mark_pixel(state: &State, veiled: bool, pen: &mut Pen<'_>, at: Position) {
    let cell = &mut pen.buffer[at];
    if state.at.style != Style::Half || pen.glyphs == Glyphs::Ascii {
        if state.at.style != Style::Braille {
            cell.modifier.insert(Modifier::REVERSED);
        }
        return;
    }
    let is_upper = state.at.cursor.1.is_multiple_of(2);
    let (col, row) = state
        .at
        .style
        .cell_of_pixel(state.at.cursor.0, state.at.cursor.1);
    let shown = state.picture.image.cell(col, row).filter(|_| !veiled);
    // The colour of a half: the block's own, or what is behind it.
    let colors = shown.map_or([None; 2], |cell| match cell.glyph {
        '▀' => [cell.fg, cell.bg],
        '▄' => [cell.bg, cell.fg],
        '█' => [cell.fg; 2],
        _ => [cell.bg; 2],
    });
    let [upper, lower] = colors;
    let color = if is_upper { upper } else { lower };
    let style = match pen.theme.color(color) {
        Color::Reset => pen.theme.mark(),
        ground if is_dark(color) => CellStyle::new().fg(Color::White).bg(ground),
        ground => CellStyle::new().fg(Color::Black).bg(ground),
    };
    cell.reset();
    cell.set_char(if is_upper { '◓' } else { '◒' })
        .set_style(style);
}

/// Whether white stands out from a colour better than black does.
fn is_dark(color: Option<Rgb>) -> bool {
    color.is_none_or(|Rgb(r, g, b)| {
        let [r, g, b] = [r, g, b].map(u32::from);
        2 * r + 5 * g + b < 8 * 110
    })
}

/// A, B, C, Δ and what is seen, in one line.
pub(crate) fn draw_strip(state: &State, pen: &mut Pen<'_>, area: Rect) {
    if let Some(line) = state.plane {
        let equation = explain::plane_lines(line).swap_remove(5);
        return pen.lines(area, &[equation]);
    }
    let (Some(subject), false) = (state.subject(), area.is_empty()) else {
        return;
    };
    if state.is_predicting() {
        let words = "numbers hidden: P shows them";
        pen.text(area.x, area.y, area.width, words, CellStyle::new());
        return;
    }
    let c = subject.coefficients;
    let show = |x: f64| explain::number(x, c.precision, explain::Digits::Significant(4));
    let place = subject.solution.place().map_or("", Place::name);
    let text = format!(
        "{} {place} Δ {} A {} B {} C {}",
        subject.solution.class,
        show(c.discriminant),
        show(c.a),
        show(c.b),
        show(c.c),
    );
    pen.text(area.x, area.y, area.width, &text, CellStyle::new());
}
