//! What the picture on the screen needed, and what was left out.

use ratatui::layout::Rect;

use crate::explain::{self, Line, PlanLine};
use crate::explorer::action::Action;
use crate::explorer::panel::Panel;
use crate::explorer::panel::component::{Component, show};
use crate::explorer::state::State;

#[derive(Debug, Default)]
pub(crate) struct PlanPanel;

impl Component for PlanPanel {
    /// What the picture needed when it was made or mended, and whether that was now.
    fn text(&self, state: &State, room: Rect) -> (String, Vec<Line>) {
        let plan = state.picture.frame.plan();
        let frame = if state.picture.percent_done().is_some() {
            "This frame: a picture that is not finished; done so far:"
        } else if state.picture.rests {
            "This frame: the picture rests."
        } else if plan.counts().kept > 0 {
            "This frame: the picture mended."
        } else {
            "This frame: a new picture."
        };
        let title = format!("plan: {} {}", plan.method(), plan.view().name());
        let mut lines = explain::plan_lines(plan, &state.picture.image);
        lines.push(PlanLine::new(
            "cursor's ray",
            state.scene().bodies.len() as u64,
            0,
            "the panel asks about every sphere; while the cursor moves, nothing else is asked",
        ));
        if let Some([sent, all]) = state.sent {
            lines.push(PlanLine::new(
                "bytes sent",
                sent,
                all.saturating_sub(sent),
                "in the frame before: cells that the terminal already shows are not sent; left out is what the largest frame so far took beyond that",
            ));
        }
        (title, explain::plan_panel(frame, &lines, room.width.into()))
    }

    fn act(&mut self, action: Action, state: &mut State) -> bool {
        let mine = action == Action::PanelPlan;
        if mine {
            show(state, Panel::Plan);
        }
        mine
    }
}
