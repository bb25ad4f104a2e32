//! Keeping unsaved work when it can't be asked about, and offering it when the same scene is opened
//! again.

use std::path::{Path, PathBuf};
use std::time::Duration;

use crate::explorer::dialog::{Confirmation, in_words};
use crate::explorer::edit::document::Change;
use crate::explorer::edit::spheres;
use crate::explorer::files::disk::remove_orphans;
use crate::explorer::files::rescue::{Rescue, age, identity, owner};
use crate::explorer::link::command_line;
use crate::explorer::state::State;
use crate::scene::{Builtin, Scene, Source};

/// Keeps unsaved work in `folder` if the terminal is lost, and offers what is there already for
/// the scene from `source`.
pub(crate) fn keep_in(state: &mut State, folder: &Path, source: &Source) {
    let rescue = Rescue {
        folder: folder.to_owned(),
        scene: identity(source),
        taken: None,
        discarded: state.rescue.take().map_or_else(Vec::new, |r| r.discarded),
    };
    remove_orphans(folder);
    if let Some((path, age)) = rescue.newest(|scene| scene == rescue.scene) {
        state.ask(Confirmation::Recover { path, age });
    } else if let Some((path, age)) = rescue.newest(|_| true) {
        state.say(elsewhere(&path, age));
    }
    state.rescue = Some(rescue);
}

/// When the explorer is over and the tour is put away: where unsaved work was kept, if there was any that
/// the person has not given up.
pub(crate) fn finish(state: &mut State) -> Result<Option<PathBuf>, String> {
    if let (Some(_), Some(rescue)) = (state.ended, &mut state.rescue) {
        rescue.remove_discarded();
    }
    if !state.is_changed() {
        return Ok(None);
    }
    let given_up = match state.ended {
        // Who interrupts has not been asked, or not answered.
        Some(130) => !state.is_worth_saving(),
        Some(_) => true,
        None => false,
    };
    let text = state.work.document.ground().to_toml();
    let Some(rescue) = &mut state.rescue else {
        return Ok(None);
    };
    let kept = if given_up {
        None
    } else {
        let kept = rescue.keep(&text);
        let folder = rescue.folder.display();
        Some(kept.map_err(|e| format!("{folder}: unsaved work not kept: {e}"))?)
    };
    rescue.forget_taken();
    Ok(kept)
}

/// Takes up kept work, as a change that can be undone.
pub(crate) fn recover(state: &mut State, path: &Path) {
    match Scene::load(path) {
        Ok(scene) => {
            state.apply(Change::Scene(Box::new(scene)));
            spheres::mend_selection(state);
            if let Some(rescue) = &mut state.rescue {
                rescue.taken = Some(path.to_owned());
            }
            state.say("This is what was not saved. u goes back to the scene as it was opened.");
        }
        Err(e) => state.warn(e.to_string()),
    }
}

/// Deletes kept work as soon as the person leaves.
pub(crate) fn discard(state: &mut State, path: PathBuf) {
    if let Some(rescue) = &mut state.rescue {
        rescue.discarded.push(path);
        state.say("It is deleted when you leave. Until then u brings it back.");
    }
}

/// Offers again what was discarded last; false if there is none.
pub(crate) fn bring_back_discarded(state: &mut State) -> bool {
    let discarded = state.rescue.as_mut().and_then(|r| r.discarded.pop());
    let Some(path) = discarded else {
        return false;
    };
    let age = age(&path).unwrap_or_default();
    state.ask(Confirmation::Recover { path, age });
    true
}

/// What was kept is saved now; from here on unsaved work belongs to that file.
pub(crate) fn saved_as(state: &mut State, path: &Path) {
    // What is tried out in the tour is not kept when the terminal is lost.
    if let (Some(rescue), None) = (&mut state.rescue, &state.aside) {
        rescue.forget_taken();
        rescue.scene = identity(&Source::File(path.to_owned()));
    }
}

/// That work on another scene was kept, and how to come by it.
fn elsewhere(path: &Path, age: Duration) -> String {
    let scene = owner(path).unwrap_or_default();
    let is_there = Builtin::by_name(&scene).is_some() || Path::new(&scene).exists();
    let file = path.to_string_lossy();
    let opens = if is_there { scene.clone() } else { file.into() };
    format!(
        "Unsaved work of {} ago on {scene} was kept: `{}` opens it.",
        in_words(age),
        command_line(&[opens])
    )
}

#[cfg(test)]
mod tests {
    use std::fs;

    use ratatui::crossterm::event::{Event, KeyCode, KeyEvent, KeyModifiers};

    use super::*;
    use crate::explorer::files::saving;
    use crate::explorer::mode::Mode;
    use crate::explorer::{Explorer, Options, Workplace};
    use crate::system;

    fn opened(folder: &Path, name: &str) -> Explorer {
        let (scene, source) = Scene::open(name).expect("a scene");
        let mut explorer = Explorer::new(scene, &source, Options::default());
        explorer.work_in(Workplace::keeping_in(folder), &source);
        explorer
    }

    fn press(explorer: &mut Explorer, keys: &str) {
        for c in keys.chars() {
            let key = KeyEvent::new(KeyCode::Char(c), KeyModifiers::NONE);
            explorer.prepare(80, 24);
            explorer.update(&Event::Key(key));
        }
    }

    fn asks(explorer: &Explorer) -> bool {
        let asked = explorer.modes.last().and_then(Mode::question);
        matches!(asked, Some(Confirmation::Recover { .. }))
    }

    fn files(folder: &Path) -> usize {
        fs::read_dir(folder).map_or(0, Iterator::count)
    }

    #[test]
    fn what_was_not_saved_is_kept_for_its_owner_and_offered_for_its_scene_alone() {
        let state = tempfile::tempdir().unwrap();
        let folder = state.path().join("rayscope");
        let mut lost = opened(&folder, "trio");
        press(&mut lost, "xg");
        let kept = lost.finish().unwrap().expect("a file");
        assert!(system::is_private(&kept) && system::is_private(&folder));

        let mut other = opened(&folder, "seed");
        assert!(other.modes.is_empty());
        let said = other.state.message.take().expect("a message").text;
        assert!(
            said.contains("on trio was kept: `rayscope trio` opens it"),
            "{said}"
        );
        let mut again = opened(&folder, "trio");
        let asked = again.modes.last().and_then(Mode::question);
        assert!(matches!(asked, Some(Confirmation::Recover { .. })));
        press(&mut again, "o");
        assert_eq!(again.scene().bodies, lost.scene().bodies);
        assert!(again.is_changed());
        press(&mut again, "u");
        assert!(!again.is_changed());
        assert_eq!(again.finish(), Ok(None));
        assert!(kept.exists(), "undone is not given up");
    }

    #[test]
    fn kept_work_goes_when_it_is_saved_or_given_up_and_not_before() {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path();
        let mut lost = opened(folder, "trio");
        press(&mut lost, "x");
        lost.finish().unwrap();
        press(&mut lost, "x");
        lost.finish().unwrap();
        assert_eq!(files(folder), 2, "one never replaces another");

        let mut later = opened(folder, "trio");
        press(&mut later, "nq");
        assert_eq!(later.ended(), Some(0));
        assert_eq!(files(folder), 2);

        let mut given_up = opened(folder, "trio");
        press(&mut given_up, "oqqD");
        assert_eq!(given_up.ended(), Some(0));
        assert_eq!(given_up.finish(), Ok(None));
        assert_eq!(files(folder), 1);

        let mut lost_again = opened(folder, "trio");
        press(&mut lost_again, "ox");
        lost_again.finish().unwrap();
        assert_eq!(files(folder), 1, "the new file stands for the old");

        let mut saved = opened(folder, "trio");
        press(&mut saved, "o");
        saving::save_as(&mut saved.state, &folder.join("saved.txt"));
        assert!(!saved.is_changed());
        assert_eq!(files(folder), 1, "the saved file alone");
    }

    #[test]
    fn a_key_that_is_no_answer_means_later_and_does_what_it_does() {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path();
        let mut lost = opened(folder, "trio");
        press(&mut lost, "x");
        lost.finish().unwrap();
        let mut later = opened(folder, "trio");
        press(&mut later, "d");
        assert!(later.modes.is_empty());
        assert_ne!(later.scene().camera, later.state.work.opened.camera);
        assert_eq!(files(folder), 1, "d orbits, and deletes nothing");
        let mut deleted = opened(folder, "trio");
        press(&mut deleted, "D");
        assert!(!asks(&deleted));
        press(&mut deleted, "u");
        assert!(asks(&deleted));
        press(&mut deleted, "D");
        assert_eq!(files(folder), 1, "until the person leaves");
        press(&mut deleted, "q");
        deleted.finish().unwrap();
        assert_eq!(files(folder), 0);
    }

    #[test]
    fn what_was_typed_before_the_question_was_shown_deletes_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path();
        let mut lost = opened(folder, "trio");
        press(&mut lost, "x");
        lost.finish().unwrap();
        let key = |c| Event::Key(KeyEvent::new(KeyCode::Char(c), KeyModifiers::NONE));
        let mut hasty = opened(folder, "trio");
        hasty.update(&key('D'));
        assert!(asks(&hasty), "nothing was drawn yet");
        hasty.prepare(80, 24);
        hasty.update_typed_ahead(&key('D'));
        assert!(asks(&hasty), "the terminal had not shown it");
        hasty.prepare(80, 24);
        hasty.update(&key('D'));
        assert!(!asks(&hasty));

        let mut hasty = opened(folder, "trio");
        press(&mut hasty, "nx");
        hasty.update(&key('q'));
        hasty.update(&key('D'));
        assert_eq!(hasty.ended(), None);
        press(&mut hasty, "D");
        assert_eq!(hasty.ended(), Some(0));
    }

    #[test]
    fn an_interrupt_keeps_what_q_would_have_asked_about() {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path();
        let interrupt = KeyEvent::new(KeyCode::Char('c'), KeyModifiers::CONTROL);
        for (keys, kept) in [("x", 1), ("d", 0)] {
            let mut explorer = opened(folder, "trio");
            press(&mut explorer, keys);
            explorer.update(&Event::Key(interrupt));
            explorer.update(&Event::Key(interrupt));
            assert_eq!(explorer.ended(), Some(130));
            assert_eq!(explorer.finish().unwrap().iter().count(), kept, "{keys}");
            for file in fs::read_dir(folder).unwrap() {
                fs::remove_file(file.unwrap().path()).unwrap();
            }
        }
    }

    #[test]
    fn a_folder_that_can_not_be_made_is_said() {
        let file = tempfile::NamedTempFile::new().unwrap();
        let mut lost = opened(&file.path().join("rayscope"), "trio");
        press(&mut lost, "x");
        assert!(lost.finish().unwrap_err().contains("not kept"));
    }
}
