//! Draws the explorer's state into a buffer of cells. Nothing is changed here.

use ratatui::buffer::Buffer;
use ratatui::layout::{Position, Rect};
use ratatui::style::{Color, Style as CellStyle};
use unicode_width::UnicodeWidthStr;

use crate::explain::{self, Digits, number};
use crate::explorer::action::{Action, FOOTER, Group};
use crate::explorer::command::WITH_ARGUMENT;
use crate::explorer::draw::layout::{self, LEAST};
use crate::explorer::draw::pen::Pen;
use crate::explorer::draw::theme::Theme;
use crate::explorer::edit::field::Field;
use crate::explorer::mode::{Form, Mode, Prompt};
use crate::explorer::{Explorer, Options};
use crate::geometry::Decimal;
use crate::lab::CaseForm;
use crate::method::{Place, Precision};
use crate::render::{Cell, Style};
use crate::text::{self, Glyphs};

/// What a cell shows while what it tells is to be predicted.
const VEILED: Cell = Cell {
    glyph: '.',
    fg: None,
    bg: None,
};

/// What marks a cell with a pixel that is wrong.
const WRONG: char = '!';

impl Explorer {
    /// Draws everything; where the terminal's own cursor belongs comes back.
    ///
    /// [`Explorer::prepare`] must have been called for the size of the buffer.
    pub fn draw(&self, buffer: &mut Buffer) -> Option<Position> {
        let area = buffer.area;
        let mut pen = Pen {
            buffer,
            glyphs: self.options.glyphs,
            theme: Theme::new(self.options.palette, self.options.depth),
        };
        let cursor = self.draw_parts(&mut pen, area);
        pen.theme.finish(pen.buffer);
        cursor
    }

    fn draw_parts(&self, pen: &mut Pen<'_>, area: Rect) -> Option<Position> {
        let Some(layout) = self.layout(area) else {
            too_small(pen, area);
            return None;
        };
        self.draw_title(pen, layout.title);
        self.draw_tour(pen, layout.tour);
        if let Mode::Help { scroll } = self.mode {
            let body = layout.body();
            self.draw_help(pen, body, scroll);
            return self.draw_footer(pen, layout.footer);
        }
        if let Mode::Case(form) = self.mode {
            let body = layout.body();
            draw_case(pen, body, form, &self.case_lines(form));
            return self.draw_footer(pen, layout.footer);
        }
        if self.board {
            let body = layout.body();
            self.draw_board(pen, body);
            return self.draw_footer(pen, layout.footer);
        }
        let covered = self.is_picture_covered(&layout) && !matches!(self.mode, Mode::Form(_));
        if covered {
            self.draw_panel_alone(pen, layout.body());
            return self.draw_footer(pen, layout.footer);
        }
        let cell = self.draw_view(pen, layout.view);
        let field = match &self.mode {
            Mode::Form(_) if layout.panel.is_empty() => {
                let body = layout.body();
                self.draw_form(pen, body)
            }
            Mode::Form(_) => self.draw_form(pen, layout.panel),
            _ => {
                self.draw_panels(pen, layout.panel);
                self.draw_strip(pen, layout.strip);
                None
            }
        };
        // Last, since a long message covers what is above it.
        let footer = self.draw_footer(pen, layout.footer);
        footer.or(field).or(cell)
    }

    fn draw_title(&self, pen: &mut Pen<'_>, area: Rect) {
        let strong = Theme::strong();
        let spheres = self.scene().bodies.len();
        let plural = if spheres == 1 { "" } else { "s" };
        let unsaved = if self.is_worth_saving() {
            "unsaved  "
        } else {
            ""
        };
        let right = format!("{unsaved}{spheres} sphere{plural}  ? help ");
        let width = right.width() as u16;
        let room = area.width.saturating_sub(width + 1);
        let name = format!(" {}", self.scene().name);
        let x = pen.text(area.x, area.y, room, &name, strong);
        let projection = self.scene().camera.projection.name();
        let options = self.options;
        let turned = self.document.turn().map(|turn| turn.formula());
        let words = [
            options.method.name(),
            turned.as_deref().unwrap_or_default(),
            options.view.shown_in(options.style).name(),
            options.style.name(),
            projection,
        ];
        let mut x = x;
        for word in words.into_iter().filter(|word| !word.is_empty()) {
            // A word that has no room is left out whole: the panel and the help page say it too.
            if usize::from(x) + word.width() + 3 <= usize::from(room) {
                x = pen.text(x + 3, area.y, room, word, CellStyle::new());
            }
        }
        if area.width > width {
            pen.text(
                area.right() - width,
                area.y,
                width,
                &right,
                CellStyle::new(),
            );
        }
    }

    /// Keys, or a message, or a question; the place of the text cursor if something is typed here.
    fn draw_footer(&self, pen: &mut Pen<'_>, area: Rect) -> Option<Position> {
        let (x, y) = (area.x + 1, area.y);
        if let Mode::Prompt(prompt) = &self.mode {
            return Some(self.draw_prompt(pen, area, prompt));
        }
        if let Mode::Ask(question) = &self.mode {
            draw_message(pen, area, &question.text(), Theme::strong());
            return None;
        }
        if let Some(message) = &self.message {
            let style = if message.warning {
                pen.theme.warning()
            } else {
                CellStyle::new()
            };
            draw_message(pen, area, &message.text, style);
            return None;
        }
        let keys: &[(&str, &str)] = match &self.mode {
            Mode::Help { .. } => &[("arrows", "scroll"), ("esc", "back")],
            Mode::Case(_) => &[("&", "copy the next form"), ("esc", "back")],
            Mode::Form(Form { typing: None, .. }) => &[
                ("arrows", "choose"),
                ("enter", "type a value"),
                ("u", "undo"),
                ("esc", "done"),
            ],
            Mode::Form(Form {
                typing: Some(line), ..
            }) if line.is_chosen() => &[
                ("digits", "type over it"),
                ("arrows", "edit it"),
                ("esc", "leave it as it was"),
            ],
            Mode::Form(_) => &[("enter", "take it"), ("esc", "leave it as it was")],
            _ => FOOTER,
        };
        let mut x = x;
        for (key, word) in keys {
            let width = (key.len() + word.len() + 1) as u16;
            if x + width >= area.right() {
                break;
            }
            x = pen.text(x, y, width, key, Theme::strong());
            x = pen.text(x + 1, y, width, word, Theme::faint()) + 2;
        }
        None
    }

    fn draw_prompt(&self, pen: &mut Pen<'_>, area: Rect, prompt: &Prompt) -> Position {
        let question = prompt.purpose.question();
        let x = pen.text(area.x, area.y, area.width, question, Theme::strong());
        let room = area.right().saturating_sub(x);
        let text: Vec<char> = prompt.line.text().chars().collect();
        let width = |from: usize| -> usize {
            let shown: String = text[from..prompt.line.cursor()].iter().collect();
            shown.width()
        };
        // A line that is longer than its room scrolls, so that the cursor is always seen.
        let first = (0..=prompt.line.cursor())
            .find(|&from| width(from) < usize::from(room.max(1)))
            .unwrap_or(prompt.line.cursor());
        let shown: String = text[first..].iter().collect();
        let end = pen.text(x, area.y, room, &shown, CellStyle::new());
        let aside = match (&self.message, &prompt.completions) {
            (Some(message), _) => Some((message.text.clone(), pen.theme.warning())),
            (None, Some((lines, at))) if lines.len() > 1 => {
                Some((format!("{} of {}", at + 1, lines.len()), Theme::faint()))
            }
            _ => None,
        };
        if let Some((text, style)) = aside {
            let room = area.right().saturating_sub(end + 2);
            pen.text(end + 2, area.y, room, &text, style);
        }
        Position::new(x + width(first) as u16, area.y)
    }

    /// The picture in its border; the place of the cursor's cell.
    fn draw_view(&self, pen: &mut Pen<'_>, area: Rect) -> Option<Position> {
        let size = self.size();
        let step = number(
            self.step.into(),
            Precision::Binary32,
            Digits::Significant(6),
        );
        let step = format!("step {step}");
        let foot = match self.selected {
            Some(at) => format!("sphere {} selected  {step}", at + 1),
            None => step,
        };
        pen.frame(area, "", &foot);
        let image = &self.picture.image;
        let (left, top) = self.picture.offset;
        let veiled = self.is_picture_veiled();
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
            self.mark_wrong(pen, (x0, y0), shown);
        }
        let end_of_foot = area.x + 4 + foot.width() as u16;
        self.mark_edges(pen, area, shown, end_of_foot);
        let (col, row) = self
            .options
            .style
            .cell_of_pixel(self.cursor.0, self.cursor.1);
        let at = (col.checked_sub(left), row.checked_sub(top));
        let at = match at {
            (Some(col), Some(row)) if col < shown.0.into() && row < shown.1.into() => {
                Some(Position::new(x0 + col as u16, y0 + row as u16))
            }
            _ => None,
        };
        let hidden = if veiled { ", hidden" } else { "" };
        let coarse = if self.coarse { ", coarse" } else { "" };
        let title = format!("view {size}{hidden}{coarse}");
        pen.border_text(area, area.y, &title, at.map(|at| at.x));
        if let Some(at) = at {
            self.mark_cursor(pen, area, at);
        }
        at
    }

    /// A mark on each cell with a pixel that the method gets wrong, while a dial is looked at.
    fn mark_wrong(&self, pen: &mut Pen<'_>, (x0, y0): (u16, u16), shown: (u16, u16)) {
        let (left, top) = self.picture.offset;
        let style = pen.theme.wrong();
        for (col, row) in self.dialing.wrong_cells(self.options.style, self.size()) {
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
    fn mark_edges(&self, pen: &mut Pen<'_>, area: Rect, shown: (u16, u16), end_of_foot: u16) {
        let image = &self.picture.image;
        let (left, top) = self.picture.offset;
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
                pen.text(x, y, 1, arrow, style);
            }
        }
    }

    /// Marks in the border that say in which column and row the cursor is.
    fn mark_cursor(&self, pen: &mut Pen<'_>, area: Rect, at: Position) {
        let style = pen.theme.mark();
        let side = match self.options.style {
            // Two pixels share the cell: the mark tells which of them is meant.
            Style::Half if self.cursor.1.is_multiple_of(2) => "▀",
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

    /// A, B, C, Δ and what is seen, in one line.
    fn draw_strip(&self, pen: &mut Pen<'_>, area: Rect) {
        let subject = self
            .picture
            .reading
            .as_ref()
            .and_then(|r| r.subject.as_ref());
        let (Some(subject), false) = (subject, area.is_empty()) else {
            return;
        };
        if self.is_predicting() {
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

    /// The numbers that can be typed; the place of the text cursor while one is.
    fn draw_form(&self, pen: &mut Pen<'_>, area: Rect) -> Option<Position> {
        let Mode::Form(form) = &self.mode else {
            return None;
        };
        let title = match self.selected {
            Some(at) => format!("numbers of sphere {} and camera", at + 1),
            None => "numbers of the camera".into(),
        };
        pen.frame(area, &title, "");
        let room = layout::inner(area);
        let fields = Field::of(self.scene(), self.selected);
        // The list scrolls where it is longer than its room.
        let first = (form.at + 1).saturating_sub(room.height.into());
        let mut cursor = None;
        for (y, (i, field)) in
            (room.top()..room.bottom()).zip(fields.iter().enumerate().skip(first))
        {
            let style = if i == form.at {
                Theme::chosen()
            } else {
                CellStyle::new()
            };
            let name = format!(" {:<15}", field.name());
            let x = pen.text(room.x, y, room.width, &name, style);
            let space = room.right().saturating_sub(x);
            if let (true, Some(line)) = (i == form.at, &form.typing) {
                let style = if line.is_chosen() {
                    Theme::chosen()
                } else {
                    CellStyle::new()
                };
                pen.text(x, y, space, &line.text(), style);
                cursor = Some(Position::new(
                    (x + line.cursor() as u16).min(room.right().max(1) - 1),
                    y,
                ));
            } else {
                let value = field.get(self.scene(), self.selected);
                let value = value.map_or(String::new(), |v| Decimal(v).to_string());
                pen.text(x, y, space, &value, CellStyle::new());
            }
        }
        cursor
    }
}

fn too_small(pen: &mut Pen<'_>, area: Rect) {
    let (cols, rows) = LEAST;
    let sentence = format!("rayscope needs {cols} columns and {rows} rows; q quits");
    for (y, line) in (area.top()..area.bottom()).zip(text::wrap(&sentence, area.width.into())) {
        pen.text(area.x, y, area.width, &line, CellStyle::new());
    }
}

/// A message over the footer; one that is too long for a line covers the lines above.
fn draw_message(pen: &mut Pen<'_>, footer: Rect, text: &str, style: CellStyle) {
    let room = footer.width.saturating_sub(2);
    let lines = text::wrap(&pen.glyphs.spell(text), room.into());
    let count = (lines.len() as u16).min(footer.y);
    let top = footer.bottom() - count;
    for (y, line) in (top..footer.bottom()).zip(&lines) {
        let blank = " ".repeat(footer.width.into());
        pen.buffer.set_string(footer.x, y, blank, Theme::plain());
        pen.text(footer.x + 1, y, room, line, style);
    }
}

impl Explorer {
    /// A line of the help page: a heading, or keys and what they do.
    fn help(&self) -> Vec<(String, String)> {
        let mut out = self.of_terminal();
        for group in Group::ALL {
            out.push((group.title().to_owned(), String::new()));
            for action in Action::ALL.iter().filter(|a| a.group() == group) {
                out.push((
                    format!("  {}", action.keys().join(" ")),
                    action.help().into(),
                ));
            }
            out.push(Default::default());
        }
        out.push(("Commands after :".into(), String::new()));
        for (name, argument, help) in WITH_ARGUMENT {
            out.push((format!("  {name} {argument}"), (*help).into()));
        }
        out
    }

    /// How the screen is drawn, and why so.
    fn of_terminal(&self) -> Vec<(String, String)> {
        let Options {
            depth,
            palette,
            glyphs,
            reasons,
            ..
        } = self.options;
        let line = |name: &str, what: &str, why: &str| {
            let words = format!("{what} ({why})");
            (format!("  {name}"), words)
        };
        vec![
            ("This terminal".into(), String::new()),
            line("# colours", depth.words(), reasons.depth),
            line("@ theme", palette.name(), reasons.palette),
            line("characters", glyphs.name(), reasons.glyphs),
            Default::default(),
        ]
    }

    /// How many lines the help page has.
    pub(crate) fn help_lines(&self) -> usize {
        self.help().len()
    }

    fn draw_help(&self, pen: &mut Pen<'_>, area: Rect, scroll: usize) {
        let lines = self.help();
        let room = layout::inner(area);
        let scroll = scroll.min(lines.len().saturating_sub(room.height.into()));
        let below = lines
            .len()
            .saturating_sub(scroll + usize::from(room.height));
        let foot = if below > 0 {
            format!("{below} lines below: down, space")
        } else {
            String::new()
        };
        pen.frame(area, "keys", &foot);
        for (y, (key, words)) in (room.top()..room.bottom()).zip(&lines[scroll..]) {
            let x = pen.text(
                room.x + 1,
                y,
                room.width.saturating_sub(1),
                key,
                Theme::strong(),
            );
            let column = (room.x + 24).max(x + 1);
            let space = room.right().saturating_sub(column);
            pen.text(column, y, space, words, CellStyle::new());
        }
    }
}

/// What was copied, without a border: where the terminal does not let programs copy, it can be
/// selected. A line that is too long goes on in the next.
fn draw_case(pen: &mut Pen<'_>, area: Rect, form: CaseForm, lines: &[String]) {
    let title = format!("Copied, where the terminal allows it: {}", form.title());
    let mut y = area.y;
    for line in text::wrap(&title, area.width.into()) {
        pen.text(area.x, y, area.width, &line, Theme::strong());
        y += 1;
    }
    y += 1;
    for line in lines {
        let chars: Vec<char> = line.chars().collect();
        for part in chars.chunks(usize::from(area.width).max(1)) {
            if y < area.bottom() {
                let part: String = part.iter().collect();
                pen.text(area.x, y, area.width, &part, CellStyle::new());
                y += 1;
            }
        }
    }
    let hint = ":append FILE adds the row to a file.";
    if y + 1 < area.bottom() {
        pen.text(area.x, y + 1, area.width, hint, Theme::faint());
    }
}
