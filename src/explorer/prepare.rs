//! Brings picture, reading and derivation up to date: each is made again only when what it depends on
//! changed.

use crate::explain::{Drawn, Reading, Step, derivation};
use crate::explorer::arrival::scaled;
use crate::explorer::draw::layout;
use crate::explorer::draw::picture::{Picture, PictureKey, ReadingKey};
use crate::explorer::options::Options;
use crate::explorer::state::State;
use crate::explorer::viewpoint::Viewpoint;
use crate::explorer::{cursor, walk};
use crate::render::{Look, fit};
use crate::scene::{Rays, Size};
use crate::text::Glyphs;

/// Brings all up to date for the room that the layout leaves the picture.
pub(crate) fn prepare(state: &mut State) {
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
    state.picture.rests = state.picture.key == Some(key);
    if !state.picture.rests {
        scale_cursor(state, size);
        let scene = state.work.document.scene();
        let picture = &mut state.picture;
        picture.rays = Rays::new(&scene.camera, size, shape);
        picture.frame.render(scene, &picture.rays, method, key.view);
        picture.image.draw(&picture.frame, scene, key.look);
        picture.key = Some(key);
    }
    cursor::arrive(state);
    let (x, y) = state.at.cursor;
    state.picture.scroll_to(style.cell_of_pixel(x, y), room);
    read(state, key);
    walk::arrive_at_step(state);
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
    };
    if state.picture.reading_key == Some(key) {
        return;
    }
    let ray = state.picture.rays.ray(state.at.cursor.0, state.at.cursor.1);
    state.picture.reading = Some(Reading::take(
        state.scene(),
        state.at.cursor,
        ray,
        state.at.method,
        state.at.sphere,
        state.at.shown,
    ));
    state.picture.reading_key = Some(key);
    derive(state);
}

/// Derives the reading again and notes which results are other ones than before.
fn derive(state: &mut State) {
    let Some(reading) = &state.picture.reading else {
        return;
    };
    let Picture { frame, image, .. } = &state.picture;
    let drawn = Drawn::at(state.at.cursor, frame, image, state.at.style);
    let steps = derivation(reading, state.scene(), &state.picture.rays, &drawn);
    let before = std::mem::take(&mut state.picture.steps);
    let is_new = |step: &Step| {
        let old = before.iter().find(|old| old.name == step.name);
        !before.is_empty() && old.is_none_or(|old| old.result != step.result)
    };
    state.picture.changed = steps.iter().map(is_new).collect();
    state.picture.steps = steps;
    walk::keep_step(state, &before);
    state.prediction.revealed = false;
}
