//! The chosen method beside another one.

use ratatui::layout::Rect;

use crate::explain::{self, Line, Subject};
use crate::explorer::action::Action;
use crate::explorer::panel::Panel;
use crate::explorer::panel::component::{Component, machine_title, no_spheres, show};
use crate::explorer::state::{State, turn};

#[derive(Debug, Default)]
pub(crate) struct ComparePanel;

impl Component for ComparePanel {
    fn text(&self, state: &State, room: Rect) -> (String, Vec<Line>) {
        let Some(reading) = state.machine_reading() else {
            return Default::default();
        };
        let title = format!("{} beside {}", reading.method, state.other_method());
        let title = machine_title(state, &title);
        let Some(Subject { trace, sphere, .. }) = &reading.subject else {
            return (title, no_spheres());
        };
        let other = state.other_method().trace(&reading.ray, sphere);
        (title, explain::comparison(trace, &other, room.width.into()))
    }

    fn foot(&self, _: &State) -> String {
        "C another method".into()
    }

    fn act(&mut self, action: Action, state: &mut State) -> bool {
        match action {
            Action::PanelCompare => show(state, Panel::Compare),
            Action::NextComparison => turn_comparison(state),
            _ => return false,
        }
        true
    }

    fn is_fitted(&self) -> bool {
        true
    }

    fn is_answer(&self) -> bool {
        true
    }
}

fn turn_comparison(state: &mut State) {
    let methods = state.methods();
    let next = turn(&methods, state.other_method(), 1);
    let next = if next == state.at.method {
        turn(&methods, next, 1)
    } else {
        next
    };
    state.at.compare = Some(next);
    state.at.panel = Panel::Compare;
}
