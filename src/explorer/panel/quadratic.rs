//! A, B, C, Δ, the roots and the point of the ray under the cursor.

use ratatui::layout::Rect;

use crate::explain::{self, Line};
use crate::explorer::action::Action;
use crate::explorer::panel::Panel;
use crate::explorer::panel::component::{Component, show};
use crate::explorer::panel::steps::disagreement_lines;
use crate::explorer::state::State;

#[derive(Debug, Default)]
pub(crate) struct QuadraticPanel;

impl Component for QuadraticPanel {
    fn text(&self, state: &State, room: Rect) -> (String, Vec<Line>) {
        let Some(reading) = state.reading() else {
            return Default::default();
        };
        let (x, y) = reading.pixel;
        let mut lines = explain::lines(
            state.at.lens,
            reading,
            room.width.into(),
            state.digits(),
            state.options.glyphs,
        );
        lines.extend(disagreement_lines(state, room.width.into()));
        (format!("ray of pixel ({x}, {y})"), lines)
    }

    fn act(&mut self, action: Action, state: &mut State) -> bool {
        let mine = action == Action::PanelQuadratic;
        if mine {
            show(state, Panel::Quadratic);
        }
        mine
    }

    fn is_fitted(&self) -> bool {
        true
    }

    fn is_answer(&self) -> bool {
        true
    }
}
