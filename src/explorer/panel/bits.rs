//! The bits of one number, and which of them are right.

use ratatui::layout::Rect;

use crate::explain::{self, Line};
use crate::explorer::action::Action;
use crate::explorer::panel::Panel;
use crate::explorer::panel::component::{Component, machine_title, no_spheres, show};
use crate::explorer::state::State;

#[derive(Debug, Default)]
pub(crate) struct BitsPanel;

impl Component for BitsPanel {
    /// The bits of the number that the step gives; for a step without one, of Δ.
    fn text(&self, state: &State, room: Rect) -> (String, Vec<Line>) {
        let subject = || state.machine_reading()?.subject.as_ref();
        let of_step = state.current_step().and_then(|step| {
            let name = step.name.as_str();
            let traced = || subject()?.trace.step(name)?.result.parts().first();
            Some((name, step.number.as_ref().or_else(traced)?))
        });
        let of_subject = || Some(("Δ", &subject()?.trace.discriminant));
        let Some((name, number)) = of_step.or_else(of_subject) else {
            return (Panel::Bits.name().into(), no_spheres());
        };
        let lines = explain::measured_bits(name, number, room.width.into());
        (machine_title(state, &format!("bits of {name}")), lines)
    }

    fn foot(&self, _: &State) -> String {
        ", . another number".into()
    }

    fn act(&mut self, action: Action, state: &mut State) -> bool {
        let mine = action == Action::PanelBits;
        if mine {
            show(state, Panel::Bits);
        }
        mine
    }

    fn is_answer(&self) -> bool {
        true
    }
}
