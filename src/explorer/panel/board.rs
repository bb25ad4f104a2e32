//! One step as large as the screen allows, for the back row of a classroom.

use ratatui::layout::Rect;

use crate::explain::StepQuestion;
use crate::explorer::draw::large;
use crate::explorer::draw::layout::text_room;
use crate::explorer::draw::pen::Pen;
use crate::explorer::draw::theme::Theme;
use crate::explorer::panel::steps;
use crate::explorer::state::State;
use crate::explorer::walk;

/// One step as large as the screen allows; its answer hidden until the key.
pub(crate) fn draw(state: &State, pen: &mut Pen<'_>, area: Rect) {
    let Some(step) = state.current_step() else {
        return;
    };
    let title = steps::title(state);
    let foot = if state.is_hidden() {
        "enter: the answer"
    } else {
        "enter: the next step   O: back to the picture"
    };
    pen.frame(area, &title, foot);
    let room = text_room(area);
    let result = if state.is_hidden() { "?" } else { &step.result };
    // The result is what the back row must read: it has the larger part.
    let y = large::draw(pen, room, room.y + 1, room.height / 4, &step.formula);
    let y = large::draw(pen, room, y + 1, room.height / 2, &format!("= {result}"));
    let question = walk::pending_question(state);
    let answers = question.map_or_else(String::new, StepQuestion::keys);
    let small = [
        (question.map_or("", StepQuestion::text), Theme::strong()),
        (answers.as_str(), Theme::strong()),
        (step.numbers_beside(state.is_hidden()), Theme::faint()),
        (step.why.as_str(), Theme::plain()),
    ];
    let mut y = y + 1;
    for (text, style) in small.into_iter().filter(|(text, _)| !text.is_empty()) {
        let below = Rect {
            y,
            height: room.bottom().saturating_sub(y),
            ..room
        };
        y = pen.words(below, text, style);
    }
}
