//! Going back and forth in what was changed.

use crate::explorer::action::Action;
use crate::explorer::edit::document::{Change, Document};
use crate::explorer::edit::spheres;
use crate::explorer::files::keep;
use crate::explorer::state::State;

/// Does an action on the history; false if it is another's.
pub(crate) fn act(action: Action, state: &mut State) -> bool {
    match action {
        Action::Undo => {
            let nothing = state.work.document.is_as_opened();
            if !(nothing && keep::bring_back_discarded(state)) {
                let deed = state.work.document.undoes();
                let deed = deed.map(|deed| format!("Undone: {deed}."));
                travel(state, Document::undo, deed, "Nothing to undo.");
            }
        }
        Action::Redo => {
            let deed = state.work.document.redoes();
            let deed = deed.map(|deed| format!("Redone: {deed}."));
            travel(state, Document::redo, deed, "Nothing to redo.");
        }
        Action::Reset => reset(state),
        _ => return false,
    }
    true
}

/// Goes one way in the history, and says what that did.
fn travel(state: &mut State, go: fn(&mut Document) -> bool, deed: Option<String>, nothing: &str) {
    if go(&mut state.work.document) {
        spheres::mend_selection(state);
    }
    state.say(deed.unwrap_or_else(|| nothing.to_owned()));
}

fn reset(state: &mut State) {
    let opened = Box::new(state.work.opened.clone());
    if state.apply(Change::Scene(opened)) {
        state.say("The scene is as it was opened. {undo} takes this back.");
    }
    spheres::mend_selection(state);
}
