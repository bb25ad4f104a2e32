//! Walking through the derivation of a pixel: steps, predictions, the moving point.

use crate::explain::{Digits, Landmark, Question, Step, landmarks, number};
use crate::explorer::Explorer;
use crate::explorer::act::turn;
use crate::explorer::key::Key;
use crate::explorer::panel::Panel;
use crate::method::{Method, Precision};

/// A step of the moving point, in radii.
const SCRUB: f64 = 1.0 / 16.0;

/// Steps that methods with half-b do in the place of those with B.
const HALVES: [[&str; 2]; 4] = [["B", "b"], ["B²", "b²"], ["Δ", "D"], ["√Δ", "√D"]];

/// Predict, then reveal: whether results are kept back, and how the guesses went. Nothing of it is
/// stored anywhere.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) struct Prediction {
    pub(crate) on: bool,
    /// The result of the step shown has been revealed.
    pub(crate) revealed: bool,
    pub(crate) right: u32,
    pub(crate) asked: u32,
}

impl Explorer {
    /// The step that is shown.
    pub(crate) fn current_step(&self) -> Option<&Step> {
        let last = self.picture.steps.len().checked_sub(1)?;
        self.picture.steps.get(self.step_at.min(last))
    }

    /// Whether the result of the step shown is kept back.
    pub(crate) const fn is_hidden(&self) -> bool {
        (self.prediction.on || self.board) && !self.prediction.revealed
    }

    /// Whether results are to be predicted, so that nothing else may tell them.
    pub(crate) fn is_predicting(&self) -> bool {
        self.prediction.on && !self.picture.steps.is_empty()
    }

    /// Whether the picture still tells what is to be predicted: whether something is seen.
    pub(crate) fn is_picture_veiled(&self) -> bool {
        let seen = |step: &Step| step.question == Some(Question::Seen);
        let last = self.picture.steps.iter().position(seen);
        self.is_predicting()
            && last.is_some_and(|last| {
                self.step_at < last || (self.step_at == last && self.is_hidden())
            })
    }

    /// Opens the steps; with steps open, reveals the answer, else goes on.
    pub(crate) fn next_step(&mut self) {
        let open = self.board || self.panel == Panel::Steps;
        if !open {
            self.panel = Panel::Steps;
        } else if self.is_hidden() {
            self.prediction.revealed = true;
        } else {
            self.go_to_step(self.step_at + 1);
        }
    }

    pub(crate) fn go_to_step(&mut self, at: usize) {
        let last = self.picture.steps.len().saturating_sub(1);
        if !self.board && self.panel != Panel::Bits {
            self.panel = Panel::Steps;
        }
        if at > last && self.step_at == last && at != usize::MAX {
            self.say("That was the last step. < goes back to the first.");
        }
        if self.step_at != at.min(last) {
            self.prediction.revealed = false;
        }
        self.step_at = at.min(last);
    }

    /// Keeps the step that the person chose when the derivation becomes another one: the step of
    /// that name, or what another method has in its place, else one that stands as far down.
    pub(crate) fn keep_step(&mut self, before: &[Step]) {
        let chosen = match self.kept_step.take() {
            Some((name, at)) if at == self.step_at && !before.is_empty() => Some(name),
            _ => before.get(self.step_at).map(|step| step.name.clone()),
        };
        let steps = &self.picture.steps;
        let place = |name: &str| steps.iter().position(|step| step.name == name);
        let same = chosen.as_deref().and_then(|name| {
            let other = HALVES.iter().find_map(|&[whole, half]| match name {
                _ if name == whole => Some(half),
                _ if name == half => Some(whole),
                _ => None,
            });
            place(name).or_else(|| place(other?))
        });
        let last = steps.len().saturating_sub(1);
        self.step_at = same.unwrap_or(self.step_at.min(last));
        self.kept_step = chosen.map(|name| (name, self.step_at));
    }

    pub(crate) fn go_to_step_named(&mut self, name: &str) {
        match self.step_named(name) {
            Ok(at) => self.go_to_step(at),
            Err(sentence) => self.warn(sentence),
        }
    }

    /// The place of the step of that name or, from 1, of that number.
    pub(crate) fn step_named(&self, name: &str) -> Result<usize, String> {
        let steps = &self.picture.steps;
        let by_name = steps.iter().position(|s| s.name == name);
        let by_number = || name.parse().ok().and_then(|n: usize| n.checked_sub(1));
        let count = steps.len();
        by_name
            .or_else(by_number)
            .filter(|&at| at < count)
            .ok_or_else(|| format!("step: found “{name}”, expected a step's name or 1 to {count}"))
    }

    pub(crate) fn toggle_prediction(&mut self) {
        let on = !self.prediction.on;
        self.prediction = Prediction {
            on,
            ..Prediction::default()
        };
        if on {
            self.panel = Panel::Steps;
            self.say("Predict first: each result, the other panels and the picture wait for you.");
        } else {
            self.say("Results are shown again.");
        }
    }

    /// The question that waits for an answer.
    pub(crate) fn pending_question(&self) -> Option<Question> {
        let shown = self.board || (self.prediction.on && self.panel == Panel::Steps);
        self.current_step()
            .filter(|_| shown && self.is_hidden())?
            .question
    }

    /// Takes a key as the answer to the question on the screen; false if it is none.
    pub(crate) fn answer_prediction(&mut self, key: Key) -> bool {
        let Some(question) = self.pending_question() else {
            return false;
        };
        let answers = question.answers();
        let given = key.typed();
        let Some(at) = answers.iter().position(|(c, _)| Some(*c) == given) else {
            return false;
        };
        let subject = self.reading().and_then(|r| r.subject.as_ref());
        let right = subject.and_then(|s| question.right(s));
        self.prediction.revealed = true;
        self.prediction.asked += 1;
        if right == Some(at) {
            self.prediction.right += 1;
            let Prediction { right, asked, .. } = self.prediction;
            self.say(format!(
                "Yes, {}. {right} of {asked} foreseen.",
                answers[at].1
            ));
        } else {
            let said = right.map_or("there is no answer", |at| answers[at].1);
            self.say(format!(
                "It is {said}. Look at the numbers of this step: why?"
            ));
        }
        true
    }

    /// t of the moving point: where the person put it, else where something is seen, else where
    /// the ray comes nearest to the centre.
    pub(crate) fn moving_t(&self) -> f64 {
        let subject = self.reading().and_then(|r| r.subject.as_ref());
        self.scrubbed.unwrap_or_else(|| {
            subject.map_or(0.0, |s| match s.sight {
                Some(sight) => sight.t.into(),
                None => -s.coefficients.b / (2.0 * s.coefficients.a),
            })
        })
    }

    /// Puts the moving point on the next place of the line that has a name, or the one before.
    pub(crate) fn go_to_landmark(&mut self, forward: bool) {
        let Some((ray, sphere)) = self.reading().and_then(|r| {
            let subject = r.subject.as_ref()?;
            Some((r.ray, subject.sphere))
        }) else {
            return self.say("There is no sphere to go along a ray to.");
        };
        let places = landmarks(&ray, &sphere);
        let Some(at) = neighbour(&places, self.moving_t(), forward) else {
            return;
        };
        let Landmark { t, what } = &places[at];
        self.scrubbed = Some(*t);
        let shown = number(*t, Precision::Binary64, Digits::Significant(6));
        let count = places.len();
        self.say(format!("{} of {count}: t = {shown}, {what}.", at + 1));
        self.show_moving_point();
    }

    /// Where the moving point is seen.
    fn show_moving_point(&mut self) {
        if self.panel != Panel::Curve {
            self.panel = Panel::Slice;
        }
    }

    pub(crate) fn scrub(&mut self, steps: f64) {
        let subject = self.reading().and_then(|r| r.subject.as_ref());
        let Some(subject) = subject else {
            return self.say("There is no sphere to go along a ray to.");
        };
        let c = subject.coefficients;
        let closest = (-c.b / (2.0 * c.a)).abs();
        // Relative to the sphere where it is far away, so that its points can be told apart.
        let radius = f64::from(subject.sphere.radius) / c.a.sqrt();
        let length = if radius > 0.0 { radius } else { closest };
        let t = self.moving_t() + steps * SCRUB * length;
        if t.is_finite() {
            self.scrubbed = Some(t);
        }
        self.show_moving_point();
    }

    /// The method that the chosen one is compared with.
    pub(crate) fn other_method(&self) -> Method {
        let method = self.options.method;
        let next = || turn(&Method::ALL, method, 1);
        self.other_method
            .filter(|&m| m != method)
            .unwrap_or_else(next)
    }

    pub(crate) fn turn_comparison(&mut self) {
        let next = turn(&Method::ALL, self.other_method(), 1);
        let next = if next == self.options.method {
            turn(&Method::ALL, next, 1)
        } else {
            next
        };
        self.other_method = Some(next);
        self.panel = Panel::Compare;
    }
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
