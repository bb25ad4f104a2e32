//! The parabola f(t) = At² + Bt + C along the ray.

use ratatui::layout::Rect;

use crate::explain::{self, Line};
use crate::explorer::action::Action;
use crate::explorer::panel::component::{AS_FIGURE, Component, no_spheres, show};
use crate::explorer::panel::{Panel, slice};
use crate::explorer::state::State;
use crate::explorer::walk;

#[derive(Debug, Default)]
pub(crate) struct CurvePanel;

impl Component for CurvePanel {
    fn text(&self, state: &State, room: Rect) -> (String, Vec<Line>) {
        let (Some(reading), Some(subject)) = (state.reading(), state.subject()) else {
            return (Panel::Curve.name().into(), no_spheres());
        };
        let (cols, rows) = (room.width.into(), room.height.into());
        let (t, glyphs) = (walk::moving_t(state), state.options.glyphs);
        let lines = explain::curve(subject, &reading.ray, t, cols, rows, glyphs);
        ("f(t) = At² + Bt + C".into(), lines)
    }

    fn foot(&self, _: &State) -> String {
        slice::FOOT.into()
    }

    fn act(&mut self, action: Action, state: &mut State) -> bool {
        let mine = action == Action::PanelCurve;
        if mine {
            show(state, Panel::Curve);
        }
        mine
    }

    fn is_answer(&self) -> bool {
        true
    }

    fn size_as_text(&self) -> (u16, u16) {
        AS_FIGURE
    }
}
