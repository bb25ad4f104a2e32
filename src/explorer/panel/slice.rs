//! The plane through ray and centre, and the point that moves along the ray.

use ratatui::layout::Rect;

use crate::explain::{self, Line};
use crate::explorer::action::Action;
use crate::explorer::panel::Panel;
use crate::explorer::panel::component::{AS_FIGURE, Component, no_spheres, show};
use crate::explorer::state::State;
use crate::explorer::walk;

/// The foot of the panels that show the moving point.
pub(crate) const FOOT: &str = "( ) move p  _ * landmark  / back";

#[derive(Debug, Default)]
pub(crate) struct SlicePanel;

impl Component for SlicePanel {
    fn text(&self, state: &State, room: Rect) -> (String, Vec<Line>) {
        let (Some(reading), Some(subject)) = (state.reading(), state.subject()) else {
            return (Panel::Slice.name().into(), no_spheres());
        };
        let (cols, rows) = (room.width.into(), room.height.into());
        let (t, glyphs) = (walk::moving_t(state), state.options.glyphs);
        let lines = explain::slice(subject, &reading.ray, t, cols, rows, glyphs);
        ("slice through ray and centre".into(), lines)
    }

    fn foot(&self, _: &State) -> String {
        FOOT.into()
    }

    fn act(&mut self, action: Action, state: &mut State) -> bool {
        match action {
            Action::PanelSlice => show(state, Panel::Slice),
            Action::ScrubForward => walk::scrub(state, 1.0),
            Action::ScrubBack => walk::scrub(state, -1.0),
            Action::NextLandmark => walk::go_to_landmark(state, true),
            Action::PreviousLandmark => walk::go_to_landmark(state, false),
            Action::ScrubHome => state.at.t = None,
            _ => return false,
        }
        true
    }

    fn is_answer(&self) -> bool {
        true
    }

    fn size_as_text(&self) -> (u16, u16) {
        AS_FIGURE
    }
}
