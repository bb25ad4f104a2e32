//! The panels in their borders: each cut, fitted or scrolled to its room.

use ratatui::layout::Rect;

use crate::explain::{self, Line};
use crate::explorer::draw::layout::text_room;
use crate::explorer::draw::pen::Pen;
use crate::explorer::panel::Panel;
use crate::explorer::panel::all::Panels;
use crate::explorer::state::State;

/// The panel in the place of the picture.
pub(crate) fn draw_alone(state: &State, panels: &Panels, pen: &mut Pen<'_>, area: Rect) {
    draw_panel(state, panels, pen, state.at.panel, area);
    pen.corner(area, "1: picture");
}

/// All panels that have room.
pub(crate) fn draw(state: &State, panels: &Panels, pen: &mut Pen<'_>, side: Rect) {
    if side.is_empty() {
        return;
    }
    if state.plane.is_some() {
        return draw_panel(state, panels, pen, state.at.panel, side);
    }
    for (panel, area) in Panel::tiles(side, state.at.panel) {
        draw_panel(state, panels, pen, panel, area);
    }
}

fn draw_panel(state: &State, panels: &Panels, pen: &mut Pen<'_>, panel: Panel, area: Rect) {
    let room = text_room(area);
    let Some((title, mut lines)) = panels.text(state, panel, room) else {
        return;
    };
    let is_fitted = panels.get(panel).is_fitted();
    let mut left_out = 0;
    // A person who scrolls wants to see what there was no room for.
    if is_fitted && (panel != state.at.panel || state.scroll == 0) {
        let written = |lines: &[Line]| lines.iter().filter(|l| l.width() > 0).count();
        let before = written(&lines);
        lines = explain::fit(lines, room.height.into());
        left_out = before - written(&lines);
    } else {
        lines.retain(|line| !line.keeps_place);
    }
    // Only the panel that the person asked for scrolls.
    let hidden = lines.len().saturating_sub(room.height.into());
    let scroll = if panel == state.at.panel {
        state.scroll.min(hidden)
    } else {
        0
    };
    let foot = match (scroll, hidden - scroll) {
        (0, below) if below + left_out > 0 && is_fitted => match below + left_out {
            1 => "1 more line: pagedown".to_owned(),
            more => format!("{more} more lines: pagedown"),
        },
        (0, 0) => panels.foot(state, panel),
        (_, 0) => format!("{scroll} lines above: pageup"),
        (_, below) => format!("{below} lines below: pagedown"),
    };
    pen.frame(area, &title, &foot);
    pen.lines(room, &lines[scroll..]);
}
