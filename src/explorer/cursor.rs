//! The cursor: on a pixel of the picture, moved by steps, by probes, or to a place that was asked for.

use glam::Vec3;
use ratatui::layout::Position;

use crate::explain::{self, Lens, Reading};
use crate::explorer::action::Action;
use crate::explorer::arrival::{Target, scaled};
use crate::explorer::draw::layout;
use crate::explorer::state::State;
use crate::explorer::walk;
use crate::method::Method;
use crate::scene::{Aim, Probe};

/// How many pixels a long step is.
const FAR: i64 = 8;

/// Does an action of the cursor's; false if it is another's.
pub(crate) fn act(action: Action, state: &mut State) -> bool {
    if let (Some(line), Some((turn, raise))) = (state.plane, moves_line(action)) {
        state.plane = Some(line.moved(turn, raise));
        return true;
    }
    match action {
        Action::CursorLeft => move_cursor(state, -1, 0),
        Action::CursorRight => move_cursor(state, 1, 0),
        Action::CursorUp => move_cursor(state, 0, -1),
        Action::CursorDown => move_cursor(state, 0, 1),
        Action::CursorFarLeft => move_cursor(state, -FAR, 0),
        Action::CursorFarRight => move_cursor(state, FAR, 0),
        Action::CursorFarUp => move_cursor(state, 0, -FAR),
        Action::CursorFarDown => move_cursor(state, 0, FAR),
        Action::CursorCenter => {
            let size = state.size();
            put_cursor(state, size.width / 2, size.height / 2);
        }
        Action::NextProbe => go_to_probe(state, true),
        Action::PreviousProbe => go_to_probe(state, false),
        _ => return false,
    }
    true
}

/// By how much an action turns and raises the line that is drawn in the picture's place, in tenths.
const fn moves_line(action: Action) -> Option<(i64, i64)> {
    Some(match action {
        Action::CursorLeft => (-1, 0),
        Action::CursorRight => (1, 0),
        Action::CursorUp => (0, 1),
        Action::CursorDown => (0, -1),
        Action::CursorFarLeft => (-10, 0),
        Action::CursorFarRight => (10, 0),
        Action::CursorFarUp => (0, 10),
        Action::CursorFarDown => (0, -10),
        _ => return None,
    })
}

fn move_cursor(state: &mut State, right: i64, down: i64) {
    let size = state.size();
    let step = |at: u32, by: i64, count: u32| {
        (i64::from(at) + by).clamp(0, i64::from(count.max(1)) - 1) as u32
    };
    put_cursor(
        state,
        step(state.at.cursor.0, right, size.width),
        step(state.at.cursor.1, down, size.height),
    );
}

/// Puts the cursor on a pixel that was named, if the picture has it.
pub(crate) fn go_to(state: &mut State, x: u32, y: u32) {
    let size = state.size();
    if x < size.width && y < size.height {
        put_cursor(state, x, y);
    } else {
        state.warn(format!(
            "cursor: found {x} {y}, expected a pixel of {size}, counted from 0"
        ));
    }
}

pub(crate) fn put_cursor(state: &mut State, x: u32, y: u32) {
    if (x, y) != state.at.cursor {
        state.at.shown = None;
    }
    state.at.cursor = (x, y);
}

fn go_to_probe(state: &mut State, forward: bool) {
    let count = state.scene().probes.len();
    if count == 0 {
        return state.say("This scene names no places worth looking at.");
    }
    let at = match (state.probe, forward) {
        (None, true) => 0,
        (None, false) => count - 1,
        (Some(at), true) => (at + 1) % count,
        (Some(at), false) => (at + count - 1) % count,
    };
    state.probe = Some(at);
    let probe = state.scene().probes[at].clone();
    let size = state.size();
    let pixel = match probe.aim {
        Aim::Pixel(x, y) => Some((x, y)),
        Aim::Point(p) => pixel_of(state, p),
    };
    match pixel.filter(|&(x, y)| x < size.width && y < size.height) {
        Some((x, y)) => {
            put_cursor(state, x, y);
            let words = words_of_probe(state, &probe);
            state.say(format!("{}/{count}  {words}", at + 1));
        }
        None => state.warn(format!(
            "{}/{count}  {}: out of the picture. {{home}} takes the camera home.",
            at + 1,
            probe.title
        )),
    }
}

/// What a probe says of the pixel under the cursor. Once the scene is changed, only sentences that have
/// their numbers from it still hold; while the person predicts, its numbers are kept back.
fn words_of_probe(state: &State, probe: &Probe) -> String {
    let title = &probe.title;
    if walk::is_picture_veiled(state) {
        return title.clone();
    }
    let is_as_opened = !state.is_another_scene();
    let lasting = explain::always_true(&probe.text);
    let text = if is_as_opened { &probe.text } else { &lasting };
    let (pixel, at) = (state.at.cursor, &state.at);
    let method = match at.lens {
        Lens::Mathematics => Method::Exact,
        Lens::Machine => at.method,
    };
    let ray = state.picture.rays.ray(pixel.0, pixel.1);
    let reading = Reading::take(state.scene(), pixel, ray, method, at.sphere, None);
    let told = explain::told(text, &reading);
    match (is_as_opened, told.is_empty()) {
        (true, true) => title.clone(),
        (true, false) => format!("{title}: {told}"),
        (false, true) => format!("“{title}”, before the scene was changed"),
        (false, false) => format!("“{title}”, before the scene was changed; now: {told}"),
    }
}

/// Puts the cursor where it was wanted.
pub(crate) fn arrive(state: &mut State) {
    let Some(target) = state.arrival.target.take() else {
        return;
    };
    let size = state.size();
    let pixel = match target {
        Target::Center => Some((size.width / 2, size.height / 2)),
        Target::Pixel(x, y) => Some((x, y)),
        Target::PixelOf(pixel, old) => Some(scaled(pixel, old, size)),
        Target::Point(p) => pixel_of(state, p),
    };
    match pixel.filter(|&(x, y)| x < size.width && y < size.height) {
        Some((x, y)) => state.at.cursor = (x, y),
        None => state.warn(match target {
            Target::Pixel(x, y) => {
                format!("cursor: found {x} {y}, expected a pixel of {size}, counted from 0")
            }
            _ => "The place of the cursor is out of the picture.".into(),
        }),
    }
}

/// The pixel that shows the point `p`, if the picture shows it.
pub(crate) fn pixel_of(state: &State, p: Vec3) -> Option<(u32, u32)> {
    let [x, y] = state.picture.rays.project(p.as_dvec3())?.map(f64::round);
    (x >= 0.0 && y >= 0.0).then_some((x as u32, y as u32))
}

/// Puts the cursor on the pixel in that cell of the screen; false if there is none.
pub(crate) fn click(state: &mut State, col: u16, row: u16) -> bool {
    if state.board || state.is_picture_covered() {
        return false;
    }
    let Some(layout) = state.layout else {
        return false;
    };
    let (left, top) = state.picture.offset;
    let area = layout::centered(layout.view, &state.picture.image, (left, top));
    if !area.contains(Position::new(col, row)) {
        return false;
    }
    let cell = (
        left + u32::from(col - area.x),
        top + u32::from(row - area.y),
    );
    let (x, y) = state.at.style.pixel_of_cell(cell.0, cell.1);
    let size = state.size();
    if x < size.width && y < size.height {
        state.message = None;
        put_cursor(state, x, y);
    }
    true
}
