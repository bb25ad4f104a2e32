//! Opening and saving, and what is asked before something would be lost.

use std::path::Path;

use crate::explain::{always_true, has_numbers};
use crate::explorer::action::Action;
use crate::explorer::dialog::{Confirmation, Dialog, Purpose};
use crate::explorer::files::disk::{self, Over, Unsaved};
use crate::explorer::files::keep;
use crate::explorer::files::place::FilePlace;
use crate::explorer::state::{State, Work};
use crate::scene::{Builtin, Scene, Source};

/// Does an action on files; false if it is another's.
pub(crate) fn act(action: Action, state: &mut State) -> bool {
    match action {
        Action::Open => state.open(Dialog::Prompt(Purpose::Open, String::new())),
        Action::Save => save(state),
        Action::SaveAs => {
            let suggestion = suggested_file(state);
            state.open(Dialog::Prompt(Purpose::SaveAs, suggestion));
        }
        _ => return false,
    }
    true
}

fn suggested_file(state: &State) -> String {
    match &state.work.place {
        FilePlace::File(stamp) => stamp.path().display().to_string(),
        FilePlace::None | FilePlace::Builtin(_) => {
            let name: String = state
                .scene()
                .name
                .chars()
                .map(|c| if c.is_alphanumeric() { c } else { '-' })
                .collect();
            format!("{name}.toml")
        }
    }
}

/// The scene of that name, or why it can't be had.
pub(crate) fn read(state: &State, name: &str) -> Result<(Scene, Source), String> {
    if let Some(builtin) = Builtin::by_name(name) {
        return Ok((builtin.scene(), Source::Builtin(builtin)));
    }
    let path = state.workplace.reach(name)?;
    Scene::open(path).map_err(|e| e.to_string())
}

/// Begins with another scene, asked and drawn as the one before.
pub(crate) fn replace(state: &mut State, scene: Scene, source: &Source) {
    let work = Work::of(scene, FilePlace::of(source));
    let before = std::mem::replace(state, State::new(work, state.options));
    state.screen = before.screen;
    state.layout = before.layout;
    state.at.method = before.at.method;
    state.at.style = before.at.style;
    state.at.view = before.at.view;
    state.at.lens = before.at.lens;
    state.mouse = before.mouse;
    state.chosen = before.chosen;
    state.names_actions = before.names_actions;
    state.workplace = before.workplace;
    state.routines = before.routines;
    keep::keep_on(state, before.rescue, source);
    let about = state.scene().about.clone().unwrap_or_default();
    state.say(format!("{}. {about}", state.scene().name));
}

pub(crate) fn save(state: &mut State) {
    if state.work.document.turn().is_some() {
        return state.say(
            "A dial is turned: | takes it back; :save-as keeps this scene under a name of its own.",
        );
    }
    match &state.work.place {
        FilePlace::None | FilePlace::Builtin(_) => {
            let suggestion = suggested_file(state);
            state.open(Dialog::Prompt(Purpose::SaveAs, suggestion));
        }
        FilePlace::File(stamp) => {
            let stamp = stamp.clone();
            write(state, stamp.path(), Over::Known(&stamp));
        }
    }
}

/// Saves under a name that opens what was saved.
pub(crate) fn save_as_named(state: &mut State, name: &str) {
    if Builtin::by_name(name).is_some() {
        return state.warn(format!(
            "{name}: this name opens a built-in scene, expected another, such as ./{name}"
        ));
    }
    match state.workplace.reach(name) {
        Ok(path) => save_as(state, &path),
        Err(sentence) => state.warn(sentence),
    }
}

pub(crate) fn save_as(state: &mut State, path: &Path) {
    let own = matches!(&state.work.place, FilePlace::File(stamp) if stamp.path() == path);
    if own {
        save(state);
    } else {
        write(state, path, Over::Nothing);
    }
}

/// The scene as it is saved in that file: it takes the file's name unless it has one of its own, and
/// of a built-in scene that was changed it tells nothing that speaks of the numbers as they were.
fn as_saved(state: &State, path: &Path) -> Scene {
    let mut scene = state.scene().clone();
    let stem = |path: &Path| {
        path.file_stem()
            .map(|stem| stem.to_string_lossy().into_owned())
    };
    let is_builtin = matches!(state.work.place, FilePlace::Builtin(_));
    let given = match &state.work.place {
        FilePlace::Builtin(builtin) => Some(builtin.name().to_owned()),
        FilePlace::File(stamp) => stem(stamp.path()),
        FilePlace::None => None,
    };
    if let Some(own) = stem(path).filter(|_| given.as_ref() == Some(&scene.name)) {
        scene.name = own.replace(char::is_control, "");
    }
    if is_builtin && state.is_another_scene() {
        scene.about = scene.about.filter(|about| !has_numbers(about));
        for probe in &mut scene.probes {
            let lasting = always_true(&probe.text);
            if !lasting.is_empty() {
                probe.text = lasting;
            }
        }
        scene.probes.retain(|probe| !has_numbers(&probe.text));
    }
    scene
}

pub(crate) fn write(state: &mut State, path: &Path, over: Over<'_>) {
    let scene = as_saved(state, path);
    match disk::save(path, &scene.to_toml(), over) {
        Ok(stamp) => {
            state.work.document.retitle(scene);
            state.work.place = FilePlace::File(stamp);
            state.work.document.mark_saved();
            keep::saved_as(state, path);
            state.say(format!("Saved {}.", path.display()));
            if std::mem::take(&mut state.quits_once_saved) {
                state.ended = Some(0);
            }
        }
        Err(Unsaved::Occupied) => {
            let why = match over {
                Over::Known(_) => "has changed on disk since it was read",
                Over::Nothing | Over::Anything => "exists already",
            };
            let path = path.to_owned();
            state.ask(Confirmation::Overwrite { path, why });
        }
        Err(Unsaved::Failed(sentence)) => state.warn(sentence),
    }
}
