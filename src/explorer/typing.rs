//! A routine's text: opened to be typed, tried as it is typed, saved or dropped, kept when the terminal is lost.

use std::fs;
use std::path::{Path, PathBuf};

use crate::explorer::dialog::{Confirmation, Dialog};
use crate::explorer::files::disk::{self, Over, Stamp, Unsaved};
use crate::explorer::files::kept::write_private;
use crate::explorer::look;
use crate::explorer::options::Request;
use crate::explorer::own_routine::{OpenText, OwnRoutine, stamp};
use crate::explorer::routine_text::RoutineText;
use crate::explorer::routines;
use crate::explorer::state::State;
use crate::method::Method;

/// Opens the text of a routine, or of the chosen one where none is named.
pub(crate) fn open(state: &mut State, name: &str) {
    if state.names_actions {
        return state.warn("routine: there is no screen to type on; `method FILE` reads a file");
    }
    match opened(state, name) {
        Ok(open) => {
            state.typing = Some(open);
            state.open(Dialog::RoutineText);
            follow(state);
        }
        Err(sentence) => state.warn(sentence),
    }
}

fn opened(state: &mut State, name: &str) -> Result<OpenText, String> {
    let name = named(state, name)?;
    let path = state.workplace.reach(&name)?;
    let file = Stamp::of(&path);
    let known = RoutineText::of_file(&name, &path, state.at.method)?;
    let kept = state.workplace.kept_text(&path);
    let kept = kept.and_then(|kept| fs::read_to_string(kept).ok());
    if kept.is_some() {
        state.say("This was typed before and not saved.");
    }
    Ok(OpenText {
        text: RoutineText::new(&name, kept.as_ref().unwrap_or(&known))?,
        name,
        path,
        file,
        known,
        before: state.at.method,
    })
}

/// The name of the file that is meant: in GLSL where no ending says otherwise.
fn named(state: &State, name: &str) -> Result<String, String> {
    if !name.is_empty() {
        let has_ending = Path::new(name).extension().is_some();
        let ending = if has_ending { "" } else { ".glsl" };
        return Ok(format!("{name}{ending}"));
    }
    let chosen = state.at.method;
    let own = chosen.is_routine().then(|| chosen.name().to_owned());
    own.ok_or_else(|| "routine: expected a name after it, such as mine.glsl".to_owned())
}

/// Draws by the text as it is now; with an error in it, the last good one stays.
pub(crate) fn follow(state: &mut State) {
    let Some(open) = &mut state.typing else {
        return;
    };
    let Some(method) = open.text.compile(&open.name, &open.path) else {
        return;
    };
    let (name, path) = (open.name.clone(), open.path.clone());
    take_on(state, method, name, &path);
    look::set_method(state, method);
}

fn take_on(state: &mut State, method: Method, name: String, path: &Path) {
    let routine = OwnRoutine {
        method,
        name,
        path: path.to_owned(),
        stamp: stamp(path),
    };
    routines::keep(state, routine);
}

/// Saves the text, over whatever is there if that was agreed to; whether it is saved.
pub(crate) fn save(state: &mut State, over_anything: bool) -> bool {
    let Some(open) = &mut state.typing else {
        return false;
    };
    let text = open.text.text();
    let (over, why) = match &open.file {
        _ if over_anything => (Over::Anything, ""),
        Some(file) => (
            Over::Known(file),
            "was changed by somebody else since it was read",
        ),
        None => (Over::Nothing, "exists already"),
    };
    match disk::save(&open.path, &text, over) {
        Ok(file) => {
            (open.file, open.known) = (Some(file), text);
            let path = open.path.clone();
            let error = open.text.error().map(|(line, _)| line);
            let known = state.routines.iter_mut().find(|own| own.path == path);
            if let Some(own) = known {
                own.stamp = stamp(&path);
            }
            let error = error.map_or(String::new(), |line| {
                format!(" Line {line} has an error; the picture is that of the text before it.")
            });
            state.say(format!("Saved {}.{error}", path.display()));
            true
        }
        Err(Unsaved::Occupied) => {
            let path = open.path.clone();
            state.ask(Confirmation::Overwrite { path, why });
            false
        }
        Err(Unsaved::Failed(sentence)) => {
            state.warn(sentence);
            false
        }
    }
}

/// Closes the text, saved before or dropped: then the picture is that of the file again. Whether it is closed.
pub(crate) fn close(state: &mut State, save_first: bool) -> bool {
    if save_first && !save(state, false) {
        return false;
    }
    let Some(open) = state.typing.take() else {
        return true;
    };
    forget_kept(state, &open.path);
    if !open.is_changed() && open.file.is_some() {
        return true;
    }
    if open.file.is_some() {
        if let Err(sentence) = routines::open(state, &open.name) {
            state.warn(sentence);
        }
    } else {
        state.routines.retain(|own| own.path != open.path);
        state.at.method = open.before;
    }
    true
}

fn forget_kept(state: &State, path: &Path) {
    if let Some(kept) = state.workplace.kept_text(path) {
        // It need not be there.
        let _ = fs::remove_file(kept);
    }
}

/// When the explorer is over while a text is open: what was typed waits for the next time.
pub(crate) fn keep(state: &State) -> Result<(), String> {
    let Some(open) = state.typing.as_ref().filter(|open| open.is_changed()) else {
        return Ok(());
    };
    let Some(kept) = state.workplace.kept_text(&open.path) else {
        return Ok(());
    };
    write_private(&kept, &open.text.text())
        .map_err(|error| format!("{}: not kept: {error}", open.name))
}

/// Asks for the file of a routine to be opened in the person's own editor.
pub(crate) fn edit(state: &mut State, name: &str) {
    match to_edit(state, name) {
        Ok((name, path)) => state.request = Some(Request::Edit { name, path }),
        Err(sentence) => state.warn(sentence),
    }
}

fn to_edit(state: &State, name: &str) -> Result<(String, PathBuf), String> {
    let name = named(state, name)?;
    let path = state.workplace.reach(&name)?;
    if !state.workplace.starts_programs() {
        return Err("edit: no program is started here; `:routine` opens the text".to_owned());
    }
    let text = RoutineText::of_file(&name, &path, state.at.method)?;
    match disk::save(&path, &text, Over::Nothing) {
        Ok(_) | Err(Unsaved::Occupied) => Ok((name, path)),
        Err(Unsaved::Failed(sentence)) => Err(sentence),
    }
}
