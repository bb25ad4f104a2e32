//! The derivation of the reading, a step at a time.

use ratatui::layout::Rect;

use crate::explain::{self, Line, Role, SheetLook};
use crate::explorer::action::Action;
use crate::explorer::panel::Panel;
use crate::explorer::panel::component::{Component, no_spheres, show};
use crate::explorer::state::{Prediction, State};
use crate::explorer::walk;
use crate::text::wrap;

#[derive(Debug, Default)]
pub(crate) struct StepsPanel;

impl Component for StepsPanel {
    /// The sheet as far as it has grown.
    fn text(&self, state: &State, room: Rect) -> (String, Vec<Line>) {
        if state.current_step().is_none() {
            return (Panel::Steps.name().into(), no_spheres());
        }
        let glyphs = state.options.glyphs;
        let steps: Vec<_> = state
            .picture
            .steps
            .iter()
            .map(|step| step.spelt(glyphs))
            .collect();
        let (width, height) = (usize::from(room.width), usize::from(room.height));
        let wrong = disagreement_lines(state, width);
        let typed = typed_line(state);
        let below = wrong.len() + usize::from(typed.is_some());
        let mut lines =
            explain::sheet_lines(&steps, look(state), width, height.saturating_sub(below));
        lines.extend(typed);
        lines.extend(wrong);
        (title(state), lines)
    }

    fn foot(&self, state: &State) -> String {
        let Prediction {
            on, right, asked, ..
        } = &state.prediction;
        if state.open_question().is_some() {
            "enter: answer, or show it".into()
        } else if state.is_hidden() {
            "enter: the answer".into()
        } else if *on && *asked > 0 {
            format!("{right} of {asked} right at the first try")
        } else {
            "enter next  , back".into()
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

/// How the sheet is shown now.
pub(crate) fn look(state: &State) -> SheetLook<'_> {
    SheetLook {
        current: state.at.step,
        hidden: state.is_hidden(),
        question: state.open_question(),
        changed: &state.picture.changed,
        glyphs: state.options.glyphs,
    }
}

/// The answer that is being typed.
fn typed_line(state: &State) -> Option<Line> {
    let question = state.open_question()?;
    let text = state.prediction.typed.text();
    let is_typed = question.choices().is_none();
    is_typed.then(|| Line::of(Role::Current, format!("   {} = {text}_", question.name())))
}

/// Where the chosen method is wrong at this pixel: what is wrong, and the key that shows why.
pub(crate) fn disagreement_lines(state: &State, width: usize) -> Vec<Line> {
    let wrong = state.disagreement().filter(|_| !state.is_predicting());
    wrong.map_or_else(Vec::new, |wrong| {
        let lines = wrap(&format!("{wrong}: L shows why"), width).into_iter();
        lines.map(|line| Line::of(Role::Warning, line)).collect()
    })
}

/// Through which lens, which pixel, and how far the sheet has grown; while results are hidden, the
/// number of those that follow would give away how it comes out.
pub(crate) fn title(state: &State) -> String {
    let (Some(step), Some(reading)) = (state.current_step(), state.reading()) else {
        return "steps".into();
    };
    let count = state.picture.steps.len();
    let number = (state.at.step + 1).min(count);
    let of = if state.is_predicting() || state.is_hidden() {
        String::new()
    } else {
        format!(" of {count}")
    };
    let (x, y) = reading.pixel;
    format!("step {number}{of}: {} at ({x}, {y})", step.name)
}
