//! One's own routines: opened by name, read again when their file is saved.

use std::path::PathBuf;
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender};
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
        let typing = state.typing.as_ref();
        let is_open = typing.is_some_and(|open| open.path == path);
        // A file that is gone for a moment is being replaced; what is typed is newer than any file.
        if now == was || now.is_none() || is_open {
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

/// Files, each with what it was like when it was last read, and who is woken when one has changed.
struct WatchList {
    files: Vec<(PathBuf, FileStamp)>,
    waker: Waker,
}

/// Looks at files on a thread of its own, and wakes who waits when one has changed.
#[derive(Debug, Default)]
pub(crate) struct Watch {
    /// The way to the thread, which ends when this goes.
    thread: Option<Sender<WatchList>>,
}

impl Watch {
    /// Watches the files of these routines, and no others.
    pub(crate) fn over(&mut self, routines: &[OwnRoutine], waker: &Waker) {
        let files = routines.iter();
        let list = WatchList {
            files: files.map(|own| (own.path.clone(), own.stamp)).collect(),
            waker: waker.clone(),
        };
        if let Some(thread) = &self.thread {
            // Without a thread, files are read again by `:method` alone.
            let _ = thread.send(list);
        } else if !routines.is_empty() {
            let (sender, lists) = mpsc::channel();
            let _ = thread::Builder::new()
                .name("files".to_owned())
                .spawn(move || watch(list, &lists));
            self.thread = Some(sender);
        }
    }
}

/// Looks at the files of the newest list until no list can come any more.
fn watch(mut list: WatchList, lists: &Receiver<WatchList>) {
    loop {
        match lists.recv_timeout(EVERY) {
            Ok(newer) => list = newer,
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => return,
        }
        let mut changed = false;
        for (path, was) in &mut list.files {
            let now = stamp(path);
            if now.is_some() && now != *was {
                *was = now;
                changed = true;
            }
        }
        if changed {
            list.waker.wake();
        }
    }
}
