//! One's own routines: opened by name, read again when their file is saved.

use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError, Weak};
use std::thread;
use std::time::Duration;

use crate::explorer::own_routine::{FileStamp, OwnRoutine, stamp};
use crate::explorer::state::State;
use crate::method::Method;
use crate::system::Waker;

/// How often files are looked at.
const EVERY: Duration = Duration::from_millis(200);

/// The method in a file, found where scenes are.
pub(crate) fn open(state: &mut State, name: &str) -> Result<Method, String> {
    let path = state.workplace.reach(name)?;
    let stamp = stamp(&path);
    let method = Method::load(name, &path).map_err(|error| error.to_string())?;
    keep(
        state,
        OwnRoutine {
            method,
            name: name.to_owned(),
            path,
            stamp,
        },
    );
    Ok(method)
}

/// Takes a routine on, in the place of what was known of its file.
pub(crate) fn keep(state: &mut State, routine: OwnRoutine) {
    let known = state
        .routines
        .iter()
        .position(|known| known.path == routine.path);
    match known {
        Some(at) => {
            let before = state.routines[at].method;
            replace(state, before, routine.method);
            state.routines[at] = routine;
        }
        None => state.routines.push(routine),
    }
}

/// Wherever a method is chosen, its next version is.
fn replace(state: &mut State, before: Method, now: Method) {
    if state.at.method == before {
        state.at.method = now;
    }
    if state.at.compare == Some(before) {
        state.at.compare = Some(now);
    }
}

/// Reads again what was saved since; whether anything is to be shown for it.
pub(crate) fn catch_up(state: &mut State) -> bool {
    let mut changed = false;
    for at in 0..state.routines.len() {
        let OwnRoutine {
            name,
            path,
            stamp: was,
            ..
        } = state.routines[at].clone();
        let now = stamp(&path);
        // A file that is gone for a moment is being replaced.
        if now == was || now.is_none() {
            continue;
        }
        state.routines[at].stamp = now;
        changed = true;
        match open(state, &name) {
            Ok(_) => state.say(format!("{name}: read again.")),
            Err(sentence) => state.warn(format!("{sentence}; the one before stays")),
        }
    }
    changed
}

/// Looks at files on a thread of its own, and wakes who waits when one has changed.
#[derive(Debug, Default)]
pub(crate) struct Watch {
    files: Arc<Mutex<Vec<(PathBuf, FileStamp)>>>,
    is_running: bool,
}

impl Watch {
    /// Watches the files of these routines, and no others.
    pub(crate) fn over(&mut self, routines: &[OwnRoutine], waker: &Waker) {
        let files = routines
            .iter()
            .map(|routine| (routine.path.clone(), routine.stamp))
            .collect();
        let mut watched = self.files.lock().unwrap_or_else(PoisonError::into_inner);
        *watched = files;
        if self.is_running || watched.is_empty() {
            return;
        }
        drop(watched);
        self.is_running = true;
        let (files, waker) = (Arc::downgrade(&self.files), waker.clone());
        // Where no thread can be had, files are read again by `:method` alone.
        let _ = thread::Builder::new()
            .name("files".to_owned())
            .spawn(move || watch(&files, &waker));
    }
}

/// Until nobody holds the list any more.
fn watch(files: &Weak<Mutex<Vec<(PathBuf, FileStamp)>>>, waker: &Waker) {
    while let Some(files) = files.upgrade() {
        let mut watched = files.lock().unwrap_or_else(PoisonError::into_inner);
        let mut changed = false;
        for (path, was) in watched.iter_mut() {
            let now = stamp(path);
            if now.is_some() && now != *was {
                *was = now;
                changed = true;
            }
        }
        drop(watched);
        drop(files);
        if changed {
            waker.wake();
        }
        thread::sleep(EVERY);
    }
}
