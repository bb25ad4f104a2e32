//! Brings picture, reading and derivation up to date: each is made again only when what it depends on
//! changed. The picture may take long, so it is only begun here, and gone on with in slices.

use crate::explain::{Drawn, Lens, Reading, Step, sheet};
use crate::explorer::arrival::scaled;
use crate::explorer::draw::layout;
use crate::explorer::draw::picture::{Picture, PictureKey, ReadingKey};
use crate::explorer::options::Options;
use crate::explorer::state::State;
use crate::explorer::viewpoint::Viewpoint;
use crate::explorer::{cursor, walk};
use crate::method::Method;
use crate::render::{Allowance, Look, fit};
use crate::scene::Size;
use crate::text::Glyphs;

/// Brings all up to date for the room that the layout leaves the picture, which itself is begun.
pub(crate) fn arrange(state: &mut State) {
    let room = layout::inner(state.layout.unwrap_or_default().view);
    let room = (room.width, room.height);
    let Options { aspect, glyphs, .. } = state.options;
    let Viewpoint { method, style, .. } = state.at;
    let (size, shape) = fit(state.scene(), style, room.0.into(), room.1.into(), aspect);
    let key = PictureKey {
        version: state.work.document.version(),
        size,
        shape,
        method,
        view: state.shown_view(),
        look: Look {
            style,
            depth: state.options.colors(),
            ascii_only: glyphs == Glyphs::Ascii,
            coarse: state.coarse,
        },
    };
    let is_same = state.picture.key == Some(key);
    state.picture.rests = is_same && state.picture.percent_done().is_none();
    if !is_same {
        scale_cursor(state, size);
        let scene = state.work.document.scene();
        state.picture.begin(scene, key);
    }
    cursor::arrive(state);
    let (x, y) = state.at.cursor;
    state.picture.scroll_to(style.cell_of_pixel(x, y), room);
    read(state, key);
    walk::arrive_at_step(state);
}

/// Goes on with the picture while the allowance lasts; whether it is done.
pub(crate) fn go_on(state: &mut State, allowance: &mut Allowance) -> bool {
    let is_done = state.picture.go_on(state.work.document.scene(), allowance);
    if is_done && state.picture.is_derivation_pending {
        derive_steps(state);
    }
    is_done
}

/// Keeps the cursor on the same place of the picture when the number of pixels changes.
fn scale_cursor(state: &mut State, size: Size) {
    let Some(old) = state.picture.key.map(|k| k.size) else {
        if state.scene().pixels.is_none() {
            state.at.cursor = (size.width / 2, size.height / 2);
        }
        return;
    };
    state.at.cursor = scaled(state.at.cursor, old, size);
}

fn read(state: &mut State, picture: PictureKey) {
    let key = ReadingKey {
        // How finely the picture is drawn makes no other reading.
        picture: PictureKey {
            look: Look {
                coarse: false,
                ..picture.look
            },
            ..picture
        },
        cursor: state.at.cursor,
        selected: state.at.sphere,
        chosen: state.at.shown,
        lens: state.at.lens,
    };
    if state.picture.reading_key == Some(key) {
        return;
    }
    let ray = state.picture.rays.ray(state.at.cursor.0, state.at.cursor.1);
    let take = |method| {
        let (selected, chosen) = (state.at.sphere, state.at.shown);
        Reading::take(
            state.scene(),
            state.at.cursor,
            ray,
            method,
            selected,
            chosen,
        )
    };
    let method = state.at.method;
    let is_needed = method != Method::Exact && state.at.lens == Lens::Mathematics;
    let exact_reading = is_needed.then(|| take(Method::Exact));
    (state.picture.reading, state.picture.exact_reading) = (Some(take(method)), exact_reading);
    state.picture.reading_key = Some(key);
    derive(state);
}

/// Derives the reading again.
fn derive(state: &mut State) {
    state.picture.steps_before = std::mem::take(&mut state.picture.steps);
    state.picture.changed.clear();
    derive_steps(state);
    walk::keep_step(state);
    state.prediction.begin_step();
}

/// Makes the steps, as far as the picture allows, and notes which results are other ones than before.
fn derive_steps(state: &mut State) {
    let Some(reading) = state.reading() else {
        return;
    };
    let Picture { frame, image, .. } = &state.picture;
    let (cursor, style) = (state.at.cursor, state.at.style);
    let is_pending = state.picture.percent_done().is_some();
    let drawn = if is_pending {
        Drawn::pending(cursor, state.shown_view(), style)
    } else {
        Drawn::at(cursor, frame, image, style)
    };
    let (scene, rays) = (Some(state.scene()), Some(&state.picture.rays));
    let steps = sheet(state.at.lens, reading, scene, rays, Some(&drawn));
    let before = &state.picture.steps_before;
    let pending = &state.picture.steps;
    let is_new = |(i, step): (usize, &Step)| {
        // A person may have taken the marks away since.
        if pending
            .get(i)
            .is_some_and(|old| old.result() == step.result())
        {
            return state.picture.changed[i];
        }
        let old = before.iter().find(|old| old.name == step.name);
        !before.is_empty() && old.is_none_or(|old| old.result() != step.result())
    };
    state.picture.changed = steps.iter().enumerate().map(is_new).collect();
    state.picture.steps = steps;
    state.picture.is_derivation_pending = is_pending;
}
