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
use crate::text;

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
    let hidden = state.is_hidden();
    let mut large_lines: Vec<String> = Vec::new();
    for equation in &step.equations {
        large_lines.push(equation.formula.clone());
        let is_given = equation.ways.is_empty();
        if !is_given && !hidden {
            let way = equation.ways.last().and_then(|way| way.last());
            large_lines.extend(way.map(|link| format!("{} {}", link.sign.text(), link.text)));
        } else if !is_given {
            large_lines.push("= ?".into());
        }
    }
    let question = walk::pending_question(state);
    let asked = question.map_or_else(String::new, |question| question.text().to_owned());
    let hint = question.map_or_else(String::new, StepQuestion::hint);
    let outcome = if hidden {
        String::new()
    } else {
        step.outcome.join("; ")
    };
    let small = [
        (outcome.as_str(), Theme::strong()),
        (asked.as_str(), Theme::strong()),
        (hint.as_str(), Theme::strong()),
        (step.why.as_str(), Theme::plain()),
    ];
    let words = small.iter().filter(|(text, _)| !text.is_empty());
    let words: Vec<_> = words.collect();
    let below: usize = words
        .iter()
        .map(|(text, _)| text::wrap(text, room.width.into()).len())
        .sum();
    let rows = room.height.saturating_sub(below as u16 + 1);
    let mut y = large::draw(pen, room, rows, &large_lines) + 1;
    for (text, style) in words {
        let below = Rect {
            y,
            height: room.bottom().saturating_sub(y),
            ..room
        };
        y = pen.words(below, text, *style);
    }
}
