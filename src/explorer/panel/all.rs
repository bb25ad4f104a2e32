//! All panels together.

use ratatui::layout::Rect;

use crate::explain::{self, Line};
use crate::explorer::action::Action;
use crate::explorer::panel::component::Component;
use crate::explorer::panel::{
    Panel, bits, compare, curve, dial, error, plan, quadratic, slice, steps, with_panels,
};
use crate::explorer::state::State;
use crate::render::Allowance;
use crate::text;

macro_rules! components {
    ($($panel:ident $name:ident $component:ident $about:literal;)*) => {
        /// All panels.
        #[derive(Debug, Default)]
        pub(crate) struct Panels {
            $(pub(crate) $name: $name::$component,)*
        }

        impl Panels {
            /// The panel of that name.
            pub(crate) fn get(&self, panel: Panel) -> &dyn Component {
                match panel {
                    $(Panel::$panel => &self.$name,)*
                }
            }

            fn all(&mut self) -> impl Iterator<Item = &mut dyn Component> {
                let all: [&mut dyn Component; _] = [$(&mut self.$name),*];
                all.into_iter()
            }
        }
    };
}
with_panels!(components);

impl Panels {
    /// Has the panel that an action belongs to do it; false if it belongs to none.
    pub(crate) fn act(&mut self, action: Action, state: &mut State) -> bool {
        self.all().any(|panel| panel.act(action, state))
    }

    /// Brings all panels up to date with the picture, while the allowance lasts; whether they are.
    pub(crate) fn go_on(&mut self, state: &State, allowance: &mut Allowance) -> bool {
        self.all().all(|panel| panel.go_on(state, allowance))
    }
}

impl Panels {
    /// The title of a panel and its lines, laid out for `room`; none before there is a picture.
    pub(crate) fn text(
        &self,
        state: &State,
        panel: Panel,
        room: Rect,
    ) -> Option<(String, Vec<Line>)> {
        state.reading()?;
        if let (Some(line), Panel::Quadratic) = (state.plane, panel) {
            return Some(("the line in the circle".into(), explain::plane_lines(line)));
        }
        let component = self.get(panel);
        if component.is_answer() && state.is_predicting() {
            let lines = text::wrap(VEILED, room.width.into()).into_iter();
            return Some((panel.name().into(), lines.map(Line::plain).collect()));
        }
        Some(component.text(state, room))
    }

    /// What the lower edge of a panel says.
    pub(crate) fn foot(&self, state: &State, panel: Panel) -> String {
        if state.is_predicting() && panel != Panel::Steps {
            return String::new();
        }
        self.get(panel).foot(state)
    }
}

/// What a panel says while it would give away what is to be predicted.
const VEILED: &str = "Hidden while you predict: the answers are here. 2 goes on with the steps, \
    P shows everything again.";
