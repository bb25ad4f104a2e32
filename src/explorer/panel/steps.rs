//! The derivation of the reading, a step at a time.

use ratatui::layout::Rect;

use crate::explain::{self, Line, StepLook};
use crate::explorer::action::Action;
use crate::explorer::panel::Panel;
use crate::explorer::panel::component::{Component, no_spheres, show};
use crate::explorer::state::{Prediction, State};
use crate::explorer::walk;

#[derive(Debug, Default)]
pub(crate) struct StepsPanel;

impl Component for StepsPanel {
    /// The step, and under it the list of all steps, which always stays.
    fn text(&self, state: &State, room: Rect) -> (String, Vec<Line>) {
        let steps = &state.picture.steps;
        let Some(step) = state.current_step() else {
            return (Panel::Steps.name().into(), no_spheres());
        };
        let glyphs = state.options.glyphs;
        let step = step.spelt(glyphs);
        let spelt: Vec<_> = steps.iter().map(|step| step.spelt(glyphs)).collect();
        let at = state.at.step.min(steps.len() - 1);
        let width = room.width.into();
        let foresight = !state.is_predicting();
        let list = explain::step_list(&spelt, at, &state.picture.changed, foresight, width);
        let look = StepLook {
            hidden: state.is_hidden(),
            changed: state.picture.changed.get(at).copied().unwrap_or(false),
        };
        let mut lines = explain::step_lines(&step, width, look);
        if let Some(question) = walk::pending_question(state) {
            lines.extend(explain::question_lines(question, width, glyphs));
        }
        if !look.hidden {
            lines.extend(explain::step_words(std::slice::from_ref(&step), width));
        }
        let space = usize::from(room.height).saturating_sub(list.len() + 1);
        let mut lines = explain::fit(lines, space);
        if lines.len() < space {
            lines.resize(space, Line::default());
        }
        lines.push(Line::default());
        lines.extend(list);
        (title(state), lines)
    }

    fn foot(&self, state: &State) -> String {
        let Prediction {
            on, right, asked, ..
        } = state.prediction;
        if state.is_hidden() && walk::pending_question(state).is_none() {
            "enter: the answer".into()
        } else if on && asked > 0 {
            format!("{right} of {asked} foreseen")
        } else {
            ", . step  < > ends".into()
        }
    }

    fn act(&mut self, action: Action, state: &mut State) -> bool {
        match action {
            Action::PanelSteps => show(state, Panel::Steps),
            Action::NextStep => walk::next_step(state),
            Action::PreviousStep => walk::go_to_step(state, state.at.step.saturating_sub(1)),
            Action::FirstStep => walk::go_to_step(state, 0),
            Action::LastStep => walk::go_to_step(state, usize::MAX),
            Action::Predict => walk::toggle_prediction(state),
            Action::Board => state.board = !state.board,
            _ => return false,
        }
        true
    }
}

/// Which step of how many; while results are hidden, the number of those that follow would give
/// away how it comes out.
pub(crate) fn title(state: &State) -> String {
    let Some(step) = state.current_step() else {
        return "steps".into();
    };
    let count = state.picture.steps.len();
    let number = (state.at.step + 1).min(count);
    let hides = state.is_predicting() || state.is_hidden();
    let of = if hides {
        String::new()
    } else {
        format!(" of {count}")
    };
    format!("step {number}{of}: {}", step.name)
}
