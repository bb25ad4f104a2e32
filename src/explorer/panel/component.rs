//! What every panel can do, and all panels together.

use std::fmt::Debug;

use ratatui::layout::Rect;

use crate::explain::Line;
use crate::explorer::action::Action;
use crate::explorer::panel::{
    Panel, bits, compare, curve, dial, error, plan, quadratic, slice, steps, with_panels,
};
use crate::explorer::state::State;
use crate::text;

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

    /// Brings what it shows up to date with the picture.
    fn refresh(&mut self, _state: &State) {}

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

/// What a panel says where there is nothing to say anything about.
pub(crate) fn no_spheres() -> Vec<Line> {
    vec![Line::plain("The scene has no spheres.")]
}

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

    /// Brings all panels up to date with the picture.
    pub(crate) fn refresh(&mut self, state: &State) {
        self.all().for_each(|panel| panel.refresh(state));
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
