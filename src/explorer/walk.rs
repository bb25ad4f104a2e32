//! Walking through the derivation of a pixel: steps, predictions, the moving point.

use crate::explain::{
    Digits, Judgement, Landmark, Step, StepQuestion, landmarks, number, sign_of_shown,
};
use crate::explorer::action::{Action, Group};
use crate::explorer::key::Key;
use crate::explorer::mode::line::TypedLine;
use crate::explorer::panel::Panel;
use crate::explorer::progress;
use crate::explorer::state::{Prediction, State};
use crate::method::Precision;

/// A step of the moving point, in radii.
const SCRUB: f64 = 1.0 / 16.0;

/// Steps that methods with half-b do in the place of those with B, and what each lens has in the place of
/// the other's.
const HALVES: [[&str; 2]; 13] = [
    ["B", "b"],
    ["B²", "b²"],
    ["Δ", "D"],
    ["√Δ", "√D"],
    ["Δ", "verdict"],
    ["p0 − c", "o"],
    ["ray", "pixel"],
    ["ray", "sphere"],
    ["ray", "insert"],
    ["roots", "near"],
    ["roots", "far"],
    ["light", "shade"],
    ["p", "check"],
];

/// Whether the picture still tells what is to be predicted: whether something is seen.
pub(crate) fn is_picture_veiled(state: &State) -> bool {
    let seen = |step: &Step| step.questions.contains(&StepQuestion::Seen);
    let last = state.picture.steps.iter().position(seen);
    state.is_predicting()
        && last.is_some_and(|last| {
            state.at.step < last || (state.at.step == last && state.is_hidden())
        })
}

/// Opens the steps; with steps open, reveals the answer, else goes on.
pub(crate) fn next_step(state: &mut State) {
    let open = state.board || state.at.panel == Panel::Steps;
    if !open {
        state.at.panel = Panel::Steps;
    } else if !state.prediction.typed.text().is_empty() && state.open_question().is_some() {
        let answer = state.prediction.typed.text();
        take_answer(state, &answer);
    } else if state.is_hidden() {
        show_answer(state);
    } else {
        go_to_step(state, state.at.step + 1);
    }
}

pub(crate) fn go_to_step(state: &mut State, at: usize) {
    let last = state.picture.steps.len().saturating_sub(1);
    if !state.board && state.at.panel != Panel::Bits {
        state.at.panel = Panel::Steps;
    }
    if at > last && state.at.step == last && at != usize::MAX {
        state.say("That was the last step. < goes back to the first.");
    }
    if state.at.step != at.min(last) {
        state.prediction.begin_step();
    }
    state.at.step = at.min(last);
}

/// Keeps the step that the person chose when the derivation becomes another one: the step of
/// that name, or what another method has in its place, else one that stands as far down.
pub(crate) fn keep_step(state: &mut State) {
    let before = &state.picture.steps_before;
    let chosen = match state.kept_step.take() {
        Some((name, at)) if at == state.at.step && !before.is_empty() => Some(name),
        _ => before.get(state.at.step).map(|step| step.name.clone()),
    };
    let steps = &state.picture.steps;
    let place = |name: &str| steps.iter().position(|step| step.name == name);
    let same = chosen.as_deref();
    let same = same.and_then(|name| place(name).or_else(|| counterparts(name).find_map(place)));
    let last = steps.len().saturating_sub(1);
    state.at.step = same.unwrap_or(state.at.step.min(last));
    state.kept_step = chosen.map(|name| (name, state.at.step));
}

/// The steps that may be in the place of the one of that name.
fn counterparts(name: &str) -> impl Iterator<Item = &'static str> {
    HALVES.iter().filter_map(move |&[whole, half]| match name {
        _ if name == whole => Some(half),
        _ if name == half => Some(whole),
        _ => None,
    })
}

pub(crate) fn go_to_step_named(state: &mut State, name: &str) {
    match step_named(state, name) {
        Ok(at) => go_to_step(state, at),
        Err(sentence) => state.warn(sentence),
    }
}

/// The place of the step of that name or, from 1, of that number.
pub(crate) fn step_named(state: &State, name: &str) -> Result<usize, String> {
    let steps = &state.picture.steps;
    let place = |name: &str| steps.iter().position(|s| s.name == name);
    let by_name = place(name).or_else(|| counterparts(name).find_map(place));
    let by_number = || name.parse().ok().and_then(|n: usize| n.checked_sub(1));
    let count = steps.len();
    by_name
        .or_else(by_number)
        .filter(|&at| at < count)
        .ok_or_else(|| format!("step: found “{name}”, expected a step's name or 1 to {count}"))
}

pub(crate) fn toggle_prediction(state: &mut State) {
    let on = !state.prediction.on;
    state.prediction = Prediction {
        on,
        ..Prediction::default()
    };
    if on {
        state.at.panel = Panel::Steps;
        let so_far = progress::sentence(state);
        let told =
            "Type A, B, C, Δ and the roots before you see them; picture and panels are hidden.";
        state.say(format!("{told} {so_far}").trim_end());
    } else {
        state.say("Results are shown again.");
    }
}

/// Goes on from a question without an answer.
fn show_answer(state: &mut State) {
    let is_question = state.open_question().is_some();
    state.prediction.answered += 1;
    (state.prediction.missed, state.prediction.typed) = (false, TypedLine::default());
    if !is_question || state.open_question().is_none() {
        state.prediction.revealed = true;
    }
}

/// The question on the screen that waits for an answer.
pub(crate) fn pending_question(state: &State) -> Option<StepQuestion> {
    let shown = state.board || state.at.panel == Panel::Steps;
    state.open_question().filter(|_| shown)
}

/// Whether a key could be the answer to some question, if one is on the screen.
pub(crate) fn could_answer(state: &State, key: Key) -> bool {
    let types = key.is("backspace") || key.typed().is_some_and(|c| !c.is_whitespace());
    (state.prediction.on || state.board) && types
}

/// Takes a key as the answer to the question on the screen, or as a part of it; false if it is none.
pub(crate) fn answer_by_key(state: &mut State, key: Key) -> bool {
    let Some(question) = pending_question(state) else {
        return false;
    };
    if let Some(choices) = question.choices() {
        let chosen = choices.into_iter().find(|(c, _)| Some(*c) == key.typed());
        return chosen.is_some_and(|(_, word)| take_answer(state, word));
    }
    let line = &mut state.prediction.typed;
    let is_started = !line.text().is_empty();
    let is_digit = |c: char| c.is_ascii_digit() || matches!(c, '.' | '-' | '−');
    let is_part = match key.typed() {
        Some(c) => is_digit(c) || is_started && matches!(c, 'e' | '+'),
        None => is_started && key.is("backspace"),
    };
    is_part && line.edit(key)
}

/// Judges an answer to the question on the screen; false if there is none, or if it is no answer.
pub(crate) fn take_answer(state: &mut State, answer: &str) -> bool {
    let (Some(question), Some(subject)) = (pending_question(state), state.subject()) else {
        return false;
    };
    let judged = subject.judge(question, answer);
    let right = subject.right_answer(question);
    let judgement = match judged {
        Ok(judgement) => judgement,
        Err(sentence) => {
            state.warn(format!("{}: {sentence}", question.name()));
            return false;
        }
    };
    state.prediction.typed = TypedLine::default();
    if !state.prediction.missed {
        state.prediction.asked += 1;
        state.prediction.right += u32::from(judgement == Judgement::Right);
        progress::note(state, question, judgement);
    }
    match judgement {
        Judgement::Right => {
            let Prediction {
                right: all, asked, ..
            } = state.prediction;
            state.say(format!(
                "Yes, {right}. {all} of {asked} right at the first try."
            ));
            show_answer(state);
        }
        Judgement::Slip(slip) => {
            state.prediction.missed = true;
            let (name, sentence) = (slip.name(), slip.words());
            state.say(format!(
                "No: {sentence} ({name}). Try again, or {{next}} shows it."
            ));
        }
        Judgement::Wrong => {
            state.prediction.missed = true;
            state.say("No. Try again, or {next} shows it.");
        }
    }
    true
}

/// Whether an action has to wait since it would change the scene that is asked about: the person is told,
/// and may do it again.
pub(crate) fn holds_back(state: &mut State, action: Action) -> bool {
    let again = state.prediction.warned.take() == Some(action);
    let asks = state.is_predicting() && state.open_question().is_some();
    if again || !asks || !changes_scene(action) {
        return false;
    }
    state.prediction.warned = Some(action);
    let name = action.name();
    state.say(format!(
        "{name} would change the scene of this question. Do it again to go ahead."
    ));
    true
}

fn changes_scene(action: Action) -> bool {
    use Action::{
        Add, Delete, Duplicate, Grow, MakeTangent, MoveXMinus, MoveXPlus, MoveYMinus, MoveYPlus,
        MoveZMinus, MoveZPlus, Redo, Reset, Smaller, TurnBack, TurnOn, Undo,
    };
    let of_sphere = matches!(
        action,
        Add | Delete | Duplicate | Grow | Smaller | MakeTangent
    );
    let moves = matches!(
        action,
        MoveXMinus | MoveXPlus | MoveYMinus | MoveYPlus | MoveZMinus | MoveZPlus
    );
    let of_history = matches!(action, Undo | Redo | Reset | TurnBack | TurnOn);
    action.group() == Group::Camera || of_sphere || moves || of_history
}

/// t of the moving point: where the person put it, else where something is seen, else where
/// the ray comes nearest to the centre.
pub(crate) fn moving_t(state: &State) -> f64 {
    let subject = state.subject();
    state.at.t.unwrap_or_else(|| {
        subject.map_or(0.0, |s| match s.sight {
            Some(sight) => sight.t.into(),
            None => -s.coefficients.b / (2.0 * s.coefficients.a),
        })
    })
}

/// Puts the moving point on the next place of the line that has a name, or the one before.
pub(crate) fn go_to_landmark(state: &mut State, forward: bool) {
    let Some((ray, sphere)) = state.reading().and_then(|r| {
        let subject = r.subject.as_ref()?;
        Some((r.ray, subject.sphere))
    }) else {
        return state.say("The scene has no spheres: there is nothing to go to.");
    };
    let places = landmarks(&ray, &sphere);
    let Some(at) = neighbour(&places, moving_t(state), forward) else {
        return;
    };
    let Landmark { t, what } = &places[at];
    state.at.t = Some(*t);
    let shown = number(*t, Precision::Binary64, Digits::Significant(6));
    let sign = sign_of_shown(*t, &shown).text();
    let count = places.len();
    state.say(format!("{} of {count}: t {sign} {shown}, {what}.", at + 1));
    show_moving_point(state);
}

/// Where the moving point is seen.
fn show_moving_point(state: &mut State) {
    if state.at.panel != Panel::Curve {
        state.at.panel = Panel::Slice;
    }
}

pub(crate) fn scrub(state: &mut State, steps: f64) {
    let subject = state.subject();
    let Some(subject) = subject else {
        return state.say("The scene has no spheres: there is nothing to go to.");
    };
    let c = subject.coefficients;
    let closest = (-c.b / (2.0 * c.a)).abs();
    // Relative to the sphere where it is far away, so that its points can be told apart.
    let radius = f64::from(subject.sphere.radius) / c.a.sqrt();
    let length = if radius > 0.0 { radius } else { closest };
    let t = moving_t(state) + steps * SCRUB * length;
    if t.is_finite() {
        state.at.t = Some(t);
    }
    show_moving_point(state);
}

/// The place after t, or before it, in the ring of all.
///
/// A root as the method has it, rounded to binary32, counts as the root.
fn neighbour(places: &[Landmark], t: f64, forward: bool) -> Option<usize> {
    let last = places.len().checked_sub(1)?;
    let here = places.iter().position(|place| place.t == t).or_else(|| {
        let alike = |place: &Landmark| (place.t as f32).to_bits() == (t as f32).to_bits();
        places.iter().position(alike)
    });
    let next = match (here, forward) {
        (Some(here), true) => here + 1,
        (None, true) => places.iter().filter(|place| place.t < t).count(),
        (Some(here), false) => return Some(here.checked_sub(1).unwrap_or(last)),
        (None, false) => {
            let before = places.iter().filter(|place| place.t < t).count();
            return Some(before.checked_sub(1).unwrap_or(last));
        }
    };
    Some(if next > last { 0 } else { next })
}

/// Goes to the step that was wanted; the panel stays as it is.
pub(crate) fn arrive_at_step(state: &mut State) {
    let Some(name) = state.arrival.step.take() else {
        return;
    };
    match step_named(state, &name) {
        Ok(at) => state.at.step = at,
        Err(sentence) => state.warn(sentence),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn landmarks_are_a_ring_that_a_rounded_root_belongs_to() {
        let place = |t: f64| Landmark {
            t,
            what: String::new(),
        };
        let places = [0.0, 0.1, 0.5, 0.9].map(place);
        let go = |t, forward| neighbour(&places, t, forward);
        let rounded = f64::from(0.1_f32);
        for (t, next, before) in [
            (-1.0, 0, 3),
            (0.0, 1, 3),
            (0.05, 1, 0),
            (0.1, 2, 0),
            (rounded, 2, 0),
            (0.6, 3, 2),
            (0.9, 0, 2),
            (7.0, 0, 3),
        ] {
            assert_eq!(
                [go(t, true), go(t, false)],
                [Some(next), Some(before)],
                "{t}"
            );
        }
        assert_eq!(neighbour(&[], 0.0, true), None);
    }
}
