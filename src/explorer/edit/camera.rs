//! What a person does to the camera.

use crate::explorer::action::Action;
use crate::explorer::edit::document::Change;
use crate::explorer::edit::motion;
use crate::explorer::state::State;
use crate::scene::Camera;

/// Does an action of the camera's; false if it is another's.
pub(crate) fn act(action: Action, state: &mut State) -> bool {
    match action {
        Action::OrbitLeft => move_camera(state, |c, s| motion::orbit(c, -s, 0.0)),
        Action::OrbitRight => move_camera(state, |c, s| motion::orbit(c, s, 0.0)),
        Action::OrbitUp => move_camera(state, |c, s| motion::orbit(c, 0.0, s)),
        Action::OrbitDown => move_camera(state, |c, s| motion::orbit(c, 0.0, -s)),
        Action::PanLeft => move_camera(state, |c, s| motion::pan(c, -s, 0.0)),
        Action::PanRight => move_camera(state, |c, s| motion::pan(c, s, 0.0)),
        Action::PanUp => move_camera(state, |c, s| motion::pan(c, 0.0, s)),
        Action::PanDown => move_camera(state, |c, s| motion::pan(c, 0.0, -s)),
        Action::DollyIn => move_camera(state, motion::dolly),
        Action::DollyOut => move_camera(state, |c, s| motion::dolly(c, -s)),
        Action::ZoomIn => move_camera(state, motion::zoom),
        Action::ZoomOut => move_camera(state, |c, s| motion::zoom(c, -s)),
        Action::LookAtSphere => look_at_sphere(state),
        Action::Home => {
            let home = state.work.opened.camera;
            state.apply(Change::Camera(home));
        }
        _ => return false,
    }
    true
}

fn move_camera(state: &mut State, by: impl FnOnce(&Camera, f64) -> Camera) {
    let steps = f64::from(state.work.stride / state.work.usual_stride).clamp(1.0 / 1024.0, 4.0);
    let camera = by(&state.scene().camera, steps);
    if !state.apply(Change::Camera(camera)) {
        state.say("The camera can go no further that way.");
    }
}

fn look_at_sphere(state: &mut State) {
    match state.at.sphere.and_then(|s| state.scene().bodies.get(s)) {
        Some(body) => {
            let center = body.sphere.center;
            let camera = motion::look_at(&state.scene().camera, center);
            if !state.apply(Change::Camera(camera)) {
                state.say("The camera looks at it already, or is at its centre.");
            }
        }
        None => state.say("No sphere is selected."),
    }
}
