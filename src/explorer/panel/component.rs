//! What every panel can do.

use std::fmt::Debug;

use ratatui::layout::Rect;

use crate::explain::{Lens, Line};
use crate::explorer::action::Action;
use crate::explorer::panel::Panel;
use crate::explorer::state::State;
use crate::render::Allowance;

/// One panel: its state, its actions, its lines and its foot.
pub(crate) trait Component: Debug {
    /// Its title, and its lines laid out for `room`.
    fn text(&self, state: &State, room: Rect) -> (String, Vec<Line>);

    /// What its lower edge says: the keys that matter here.
    fn foot(&self, _state: &State) -> String {
        String::new()
    }

    /// Does an action that is this panel's; false if it is another's.
    fn act(&mut self, _action: Action, _state: &mut State) -> bool {
        false
    }

    /// Brings what it shows up to date with the picture, while the allowance lasts; whether it is.
    fn go_on(&mut self, _state: &State, _allowance: &mut Allowance) -> bool {
        true
    }

    /// Whether its lines say how much they may be spared, so that it is fitted before it is cut.
    fn is_fitted(&self) -> bool {
        false
    }

    /// Whether it shows what is to be predicted.
    fn is_answer(&self) -> bool {
        false
    }

    /// Columns and rows that it takes as text; a figure takes a screen, what is words no end.
    fn size_as_text(&self) -> (u16, u16) {
        AS_WORDS
    }
}

/// Room for words: as many rows as there are.
const AS_WORDS: (u16, u16) = (76, 200);
/// Room for a figure.
pub(crate) const AS_FIGURE: (u16, u16) = (76, 20);

/// The title of a panel that is of the machine whatever the lens: it says so through the other one.
pub(crate) fn machine_title(state: &State, title: &str) -> String {
    match state.at.lens {
        Lens::Mathematics => format!("machine: {title}"),
        Lens::Machine => title.to_owned(),
    }
}

/// What a panel says where there is nothing to say anything about.
pub(crate) fn no_spheres() -> Vec<Line> {
    vec![Line::plain("The scene has no spheres.")]
}

/// Shows a panel. Where it takes the picture's place, the same key brings the picture back.
pub(crate) fn show(state: &mut State, panel: Panel) {
    let covers = state.layout.is_some_and(|layout| layout.panel.is_empty());
    let again = covers && state.at.panel == panel;
    (state.at.panel, state.numbers_alone) = match panel {
        Panel::Quadratic => (panel, again && !state.numbers_alone),
        _ if again => (Panel::Quadratic, false),
        _ => (panel, false),
    };
}
