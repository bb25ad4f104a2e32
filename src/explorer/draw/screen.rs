//! The whole screen: title, picture, panels, tour, footer. Nothing is changed here.

use ratatui::layout::{Position, Rect};
use ratatui::style::Style as CellStyle;
use unicode_width::UnicodeWidthStr;

use crate::explorer::draw::layout::{LEAST, Layout};
use crate::explorer::draw::pen::Pen;
use crate::explorer::draw::theme::Theme;
use crate::explorer::draw::{footer, panels, view};
use crate::explorer::mode::overlay::{ModeArea, Overlay};
use crate::explorer::panel::all::Panels;
use crate::explorer::panel::board;
use crate::explorer::state::State;
use crate::explorer::tour::Tour;

/// What is drawn.
pub(crate) struct WholeScreen<'a> {
    pub(crate) state: &'a State,
    pub(crate) panels: &'a Panels,
    pub(crate) tour: &'a Tour,
    /// The mode that hears the keys.
    pub(crate) mode: Option<&'a dyn Overlay>,
}

impl WholeScreen<'_> {
    /// Draws everything; where the terminal's own cursor belongs comes back.
    pub(crate) fn draw(
        &self,
        pen: &mut Pen<'_>,
        area: Rect,
        layout: Option<Layout>,
    ) -> Option<Position> {
        let Some(layout) = layout else {
            too_small(pen, area);
            return None;
        };
        draw_title(self.state, pen, layout.title);
        self.tour.draw(pen, layout.tour);
        let inside = self.draw_body(pen, &layout);
        // Last, since a long message covers what is above it.
        let footer = self.draw_footer(pen, layout.footer);
        footer.or(inside)
    }

    /// Picture and panels, or what takes their place.
    fn draw_body(&self, pen: &mut Pen<'_>, layout: &Layout) -> Option<Position> {
        let Self { state, panels, .. } = self;
        let place = self.mode.map(|mode| (mode, mode.place(layout)));
        if let Some((mode, ModeArea::Body)) = place {
            return mode.draw(state, pen, layout.body());
        }
        if state.board {
            board::draw(state, pen, layout.body());
            return None;
        }
        let over_panels = place.filter(|(_, place)| *place == ModeArea::Panels);
        if state.is_picture_covered() && over_panels.is_none() {
            panels::draw_alone(state, panels, pen, layout.body());
            return None;
        }
        let wrong = panels.dial.wrong_cells(state.at.style, state.size());
        let cell = view::draw(state, &wrong, pen, layout.view);
        let Some((mode, _)) = over_panels else {
            panels::draw(state, panels, pen, layout.panel);
            view::draw_strip(state, pen, layout.strip);
            return cell;
        };
        let room = if layout.panel.is_empty() {
            layout.body()
        } else {
            layout.panel
        };
        mode.draw(state, pen, room).or(cell)
    }

    /// Keys, or a message, or a question; the place of the text cursor if something is typed here.
    fn draw_footer(&self, pen: &mut Pen<'_>, area: Rect) -> Option<Position> {
        if let Some(mode) = self.mode.filter(|mode| mode.has_footer()) {
            return mode.draw_footer(self.state, pen, area);
        }
        if let Some(message) = &self.state.message {
            let style = if message.warning {
                pen.theme.warning()
            } else {
                CellStyle::new()
            };
            pen.message(area, &message.text, style);
            return None;
        }
        let keys = self.mode.map(Overlay::foot).filter(|keys| !keys.is_empty());
        let mut x = area.x + 1;
        let keys = keys.map_or_else(|| footer::keys(self.state), <[_]>::to_vec);
        for (key, word) in keys {
            let width = (key.len() + word.len() + 1) as u16;
            if x + width >= area.right() {
                break;
            }
            x = pen.text(x, area.y, width, key, Theme::strong());
            x = pen.text(x + 1, area.y, width, word, Theme::faint()) + 2;
        }
        None
    }
}

fn draw_title(state: &State, pen: &mut Pen<'_>, area: Rect) {
    let strong = Theme::strong();
    let spheres = state.scene().bodies.len();
    let plural = if spheres == 1 { "" } else { "s" };
    let unsaved = if state.is_worth_saving() {
        "unsaved  "
    } else {
        ""
    };
    let right = format!("{unsaved}{spheres} sphere{plural}  ? help ");
    let width = right.width() as u16;
    let room = area.width.saturating_sub(width + 1);
    let name = format!(" {}", state.scene().name);
    let x = pen.text(area.x, area.y, room, &name, strong);
    let projection = state.scene().camera.projection.name();
    let turned = state.work.document.turn().map(|turn| turn.formula());
    let words = [
        state.at.lens.name(),
        state.at.method.name(),
        turned.as_deref().unwrap_or_default(),
        state.shown_view().name(),
        state.at.style.name(),
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

fn too_small(pen: &mut Pen<'_>, area: Rect) {
    let (cols, rows) = LEAST;
    let sentence = format!("rayscope needs {cols} columns and {rows} rows; q quits");
    pen.words(area, &sentence, CellStyle::new());
}
