//! Keeping unsaved work, and offering it when the same scene is opened again.

use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;
use std::time::Duration;

use crate::explorer::dialog::{Confirmation, in_words};
use crate::explorer::edit::document::Change;
use crate::explorer::edit::spheres;
use crate::explorer::files::disk::remove_orphans;
use crate::explorer::files::kept::{KeptFile, KeptFolder};
use crate::explorer::files::place::FilePlace;
use crate::explorer::files::rescue::{NOWHERE, Rescue, identity};
use crate::explorer::link::command_line;
use crate::explorer::state::{State, Work};
use crate::scene::{Builtin, Scene, Source};
use crate::system::Waker;

/// Keeps unsaved work on the scene from `source` from now on, if this explorer keeps any, and offers
/// what is there already.
pub(crate) fn keep(state: &mut State, source: &Source) {
    if !state.workplace.keeps() {
        return;
    }
    let version = state.work.document.ground_version();
    let mut rescue = Rescue::new(state.workplace.kept_folder(), identity(source), version);
    if let Some(folder) = &rescue.folder {
        remove_orphans(&folder.folder);
        folder.prune(KeptFolder::MOST);
        if let Some((kept, age)) = folder.newest(|scene| scene == rescue.scene) {
            let path = kept.path.clone();
            state.ask(Confirmation::Recover { path, age });
            rescue.offered = Some(kept);
        } else if let Some((kept, age)) = folder.newest(|_| true) {
            state.say(elsewhere(&kept, age));
        }
    }
    state.rescue = Some(rescue);
}

/// The same for another scene in the place of one: what was not saved of that is given up.
pub(crate) fn keep_on(state: &mut State, before: Option<Rescue>, source: &Source) {
    let mut discarded = Vec::new();
    if let Some(mut before) = before {
        before.give_up();
        discarded = before.discarded;
    }
    keep(state, source);
    if let Some(rescue) = &mut state.rescue {
        rescue.discarded = discarded;
    }
}

/// The person's own work, which may wait behind the tour.
fn own_work(state: &State) -> &Work {
    state
        .aside
        .as_ref()
        .map_or(&state.work, |aside| &aside.work)
}

/// Whether there is work that somebody would miss: another look at a built-in scene is none.
fn is_worth_it(work: &Work) -> bool {
    let only_looked = matches!(work.place, FilePlace::Builtin(_))
        && work.document.ground().bodies == work.opened.bodies;
    work.document.is_changed() && !only_looked
}

/// What becomes of the person's own work; none if this explorer keeps none.
fn rescue(state: &mut State) -> Option<&mut Rescue> {
    if state.rescue.is_none() && state.workplace.keeps() {
        let work = own_work(state);
        let scene = match &work.place {
            FilePlace::None => work.opened.name.clone(),
            FilePlace::Builtin(builtin) => identity(&Source::Builtin(*builtin)),
            FilePlace::File(stamp) => identity(&Source::File(stamp.path().to_owned())),
        };
        state.rescue = Some(Rescue::new(state.workplace.kept_folder(), scene, 0));
    }
    state.rescue.as_mut()
}

/// Has unsaved work written down a little later, if there is any that is not.
pub(crate) fn note_changes(state: &mut State, waker: &Waker) {
    let version = own_work(state).document.ground_version();
    if let Some(rescue) = rescue(state)
        && rescue.noted != version
        && rescue.due.is_none()
    {
        rescue.wait(waker.clone());
    }
}

/// Writes unsaved work down if it is time; whether there is something to say about it.
pub(crate) fn write_down_if_due(state: &mut State, waker: &Waker) -> bool {
    let Some(rescue) = &mut state.rescue else {
        return false;
    };
    let due = rescue.due.as_ref();
    if !due.is_some_and(|due| due.load(Ordering::Acquire)) {
        return false;
    }
    if rescue.is_writing() {
        rescue.wait(waker.clone());
        return false;
    }
    rescue.due = None;
    write_down(state)
}

/// The same between two lines of text, where nobody is woken: at once, unless that took too large a
/// part of the time.
pub(crate) fn write_down_between_lines(state: &mut State) -> bool {
    let rescue = state.rescue.as_ref();
    !rescue.is_some_and(Rescue::is_too_soon) && write_down(state)
}

/// Has unsaved work written down by a thread; whether there is something to say about it.
fn write_down(state: &mut State) -> bool {
    let work = own_work(state);
    let (version, is_worth_it) = (work.document.ground_version(), is_worth_it(work));
    let Some(rescue) = rescue(state) else {
        return false;
    };
    let before = rescue.collect();
    if rescue.noted == version && before.is_ok() {
        return false;
    }
    rescue.noted = version;
    if !is_worth_it {
        rescue.forget_own();
        return false;
    }
    let is_nowhere = rescue.folder.is_none();
    if let Some(reason) = before.err().or_else(|| is_nowhere.then(|| NOWHERE.into())) {
        let is_news = !std::mem::replace(&mut rescue.has_warned, true);
        if is_news {
            state.warn(format!("Unsaved work cannot be kept, save it: {reason}."));
        }
        return is_news;
    }
    let scene = own_work(state).document.ground().clone();
    if let Some(rescue) = &mut state.rescue {
        rescue.write(scene);
    }
    false
}

/// When the explorer is over and the tour is put away: where unsaved work was kept, if there was any that
/// the person has not given up.
pub(crate) fn finish(state: &mut State) -> Result<Option<PathBuf>, String> {
    let is_changed = state.is_changed();
    let given_up = match state.ended {
        // Who interrupts has not been asked, or not answered.
        Some(130) => !state.is_worth_saving(),
        Some(_) => true,
        None => false,
    };
    let text = (is_changed && !given_up).then(|| state.work.document.ground().to_toml());
    let has_left = state.ended.is_some();
    let Some(rescue) = rescue(state) else {
        return Ok(None);
    };
    if has_left {
        rescue.remove_discarded();
    }
    // What went wrong before is tried again.
    let _ = rescue.collect();
    let kept = text.map(|text| rescue.keep(&text)).transpose();
    let kept = kept.map_err(|reason| format!("unsaved work not kept: {reason}"))?;
    if kept.is_none() {
        rescue.forget_own();
    }
    if is_changed {
        rescue.forget_taken();
    }
    rescue.offered = None;
    rescue.discarded.clear();
    if let Some(folder) = &rescue.folder {
        folder.prune(KeptFolder::MOST);
    }
    Ok(kept)
}

/// Takes up kept work, as a change that can be undone.
pub(crate) fn recover(state: &mut State, path: &Path) {
    match Scene::load(path) {
        Ok(scene) => {
            state.apply(Change::Scene(Box::new(scene)));
            spheres::mend_selection(state);
            if let Some(rescue) = &mut state.rescue {
                rescue.taken = rescue.offered.take();
            }
            state.say("Your unsaved work is back. {undo} goes back to the scene as it was opened.");
        }
        Err(e) => state.warn(e.to_string()),
    }
}

/// Deletes the kept work that is offered as soon as the person leaves.
pub(crate) fn discard(state: &mut State) {
    if let Some(rescue) = &mut state.rescue {
        rescue.discarded.extend(rescue.offered.take());
        state.say("It is deleted when you leave. Until then {undo} brings it back.");
    }
}

/// Offers again what was discarded last; false if there is none.
pub(crate) fn bring_back_discarded(state: &mut State) -> bool {
    let Some(rescue) = &mut state.rescue else {
        return false;
    };
    let Some(kept) = rescue.discarded.pop() else {
        return false;
    };
    let (path, age) = (kept.path.clone(), kept.age().unwrap_or_default());
    rescue.offered = Some(kept);
    state.ask(Confirmation::Recover { path, age });
    true
}

/// Does not offer the kept work again.
pub(crate) fn put_off(state: &mut State) {
    let offered = state.rescue.as_mut().and_then(|r| r.offered.take());
    if let Some(Ok(path)) = offered.map(KeptFile::put_off) {
        let line = command_line(&[path.to_string_lossy().into_owned()]);
        state.say(format!(
            "The unsaved work stays where it is: `{line}` opens it."
        ));
    }
}

/// What was kept is saved now; from here on unsaved work belongs to that file.
pub(crate) fn saved_as(state: &mut State, path: &Path) {
    let version = state.work.document.ground_version();
    // What is tried out in the tour is not kept when the terminal is lost.
    if let (Some(rescue), None) = (&mut state.rescue, &state.aside) {
        let _ = rescue.collect();
        rescue.forget_own();
        rescue.forget_taken();
        rescue.noted = version;
        rescue.scene = identity(&Source::File(path.to_owned()));
    }
}

/// That work on another scene was kept, and how to come by it.
fn elsewhere(kept: &KeptFile, age: Duration) -> String {
    let scene = kept.owner().map_or_else(String::new, |(scene, _)| scene);
    let is_there = Builtin::by_name(&scene).is_some() || Path::new(&scene).exists();
    let file = kept.path.to_string_lossy();
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
    use std::sync::mpsc;
    use std::time::UNIX_EPOCH;

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
            let code = match c {
                '\u{1b}' => KeyCode::Esc,
                c => KeyCode::Char(c),
            };
            let key = KeyEvent::new(code, KeyModifiers::NONE);
            explorer.prepare(80, 24);
            explorer.update(&Event::Key(key));
        }
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

        let mut other = opened(&folder, "tutorial");
        assert!(other.modes.is_empty());
        let said = other.state.message.take().expect("a message").text;
        assert!(
            said.contains("on trio was kept: `rayscope trio` opens it"),
            "{said}"
        );
        let mut again = opened(&folder, "trio");
        assert!(is_offered(&again));
        press(&mut again, "o");
        assert_eq!(again.scene().bodies, lost.scene().bodies);
        assert!(again.is_changed());
        press(&mut again, "u");
        assert!(!again.is_changed());
        assert_eq!(again.finish(), Ok(None));
        assert!(kept.exists(), "undone is not given up");
    }

    /// Leaves unsaved work behind.
    fn lose(folder: &Path, name: &str) -> Explorer {
        let mut lost = opened(folder, name);
        press(&mut lost, "x");
        lost.finish().unwrap().expect("a file");
        lost
    }

    fn is_offered(explorer: &Explorer) -> bool {
        let asked = explorer.modes.last().and_then(Mode::question);
        matches!(asked, Some(Confirmation::Recover { .. }))
    }

    #[test]
    fn kept_work_goes_when_it_is_saved_or_given_up_and_not_before() {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path();
        let mut lost = lose(folder, "trio");
        press(&mut lost, "x");
        lost.finish().unwrap();
        assert_eq!(files(folder), 2, "one never replaces another");

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
    fn a_key_that_is_no_answer_does_nothing_and_what_is_put_off_is_not_offered_again() {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path();
        lose(folder, "trio");
        let mut later = opened(folder, "trio");
        press(&mut later, "d");
        assert!(is_offered(&later));
        assert_eq!(later.scene().camera, later.state.work.opened.camera);
        press(&mut later, "\u{1b}d");
        assert_ne!(later.scene().camera, later.state.work.opened.camera);
        assert_eq!(files(folder), 1, "d orbits, and deletes nothing");
        let mut other = opened(folder, "trio");
        assert!(!is_offered(&other) && other.state.message.is_none());

        lose(folder, "trio");
        let mut later = opened(folder, "trio");
        press(&mut later, "\u{1b}");
        let said = later
            .state
            .message
            .take()
            .map(|m| m.text)
            .unwrap_or_default();
        let path = said
            .split('`')
            .nth(1)
            .and_then(|line| line.strip_prefix("rayscope "));
        let path = path.unwrap_or_else(|| panic!("no command in {said}"));
        press(&mut other, "q");
        let (scene, _) = Scene::open(path).unwrap();
        assert_ne!(scene.bodies, other.scene().bodies, "it is still there");
    }

    #[test]
    fn discarded_work_comes_back_until_the_person_leaves() {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path();
        lose(folder, "trio");
        let mut discarded = opened(folder, "trio");
        press(&mut discarded, "D");
        assert!(!is_offered(&discarded));
        press(&mut discarded, "u");
        assert!(is_offered(&discarded));
        press(&mut discarded, "D");
        assert_eq!(files(folder), 1);
        // The link drops: nobody has left.
        discarded.finish().unwrap();
        let mut discarded = opened(folder, "trio");
        assert!(is_offered(&discarded));
        press(&mut discarded, "Dq");
        discarded.finish().unwrap();
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
        assert!(is_offered(&hasty), "nothing was drawn yet");
        hasty.prepare(80, 24);
        hasty.update_typed_ahead(&key('D'));
        assert!(is_offered(&hasty), "the terminal had not shown it");
        hasty.prepare(80, 24);
        hasty.update(&key('D'));
        assert!(!is_offered(&hasty));

        let mut hasty = opened(folder, "trio");
        press(&mut hasty, "nx");
        hasty.update(&key('q'));
        hasty.update(&key('D'));
        assert_eq!(hasty.ended(), None);
        press(&mut hasty, "D");
        assert_eq!(hasty.ended(), Some(0));
    }

    /// Waits until it is time to write unsaved work down, and until it is written.
    fn rest(explorer: &mut Explorer, woken: &mpsc::Receiver<()>) -> bool {
        woken.recv().expect("a waker");
        let said = explorer.catch_up();
        if let Some(rescue) = &mut explorer.state.rescue {
            rescue.collect().unwrap();
        }
        said
    }

    fn alarm(explorer: &mut Explorer) -> mpsc::Receiver<()> {
        let (sender, woken) = mpsc::channel();
        explorer.wake_by(Waker::new(move || {
            let _ = sender.send(());
        }));
        woken
    }

    #[test]
    fn work_is_written_down_at_rest_and_offered_only_once_its_session_is_over() {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path();
        let mut working = opened(folder, "trio");
        let woken = alarm(&mut working);
        press(&mut working, "x");
        rest(&mut working, &woken);
        assert_eq!(files(folder), 1);
        let other = opened(folder, "trio");
        assert!(
            !is_offered(&other) && other.state.message.is_none(),
            "it is alive"
        );
        press(&mut working, "u");
        rest(&mut working, &woken);
        assert_eq!(files(folder), 0, "there is nothing to keep any more");
        press(&mut working, "xx");
        rest(&mut working, &woken);
        let bodies = working.scene().bodies.clone();
        // As it is with `kill -9`.
        drop(working);
        let mut next = opened(folder, "trio");
        assert!(is_offered(&next));
        let third = opened(folder, "trio");
        assert!(!is_offered(&third), "it is offered to one at a time");
        press(&mut next, "o");
        assert_eq!(next.scene().bodies, bodies);
    }

    #[test]
    fn neither_a_clock_that_went_back_nor_a_spoilt_file_hides_good_work() {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path();
        lose(folder, "trio");
        let mut newest = opened(folder, "trio");
        press(&mut newest, "oxx");
        let kept = newest.finish().unwrap().expect("a file");
        lose(folder, "far");
        let early = UNIX_EPOCH + Duration::from_secs(1);
        fs::File::options()
            .write(true)
            .open(kept)
            .and_then(|file| file.set_modified(early))
            .unwrap();
        let spoilt = folder.join("99999999999999999999-1.toml");
        fs::write(spoilt, "# scene: trio\n[camera").unwrap();
        let mut next = opened(folder, "trio");
        press(&mut next, "o");
        assert_eq!(next.scene().bodies, newest.scene().bodies);
    }

    #[test]
    fn who_shares_an_account_is_offered_their_own_work_alone() {
        let folder = tempfile::tempdir().unwrap();
        let open = |person: &str| {
            let (scene, source) = Scene::open("trio").expect("a scene");
            let mut explorer = Explorer::new(scene, &source, Options::default());
            let workplace = Workplace::keeping_in(folder.path());
            explorer.work_in(workplace.of_person(person.to_owned()), &source);
            explorer
        };
        let mut ada = open("publickey ssh-ed25519 ada");
        press(&mut ada, "x");
        ada.finish().unwrap().expect("a file");
        for other in ["publickey ssh-ed25519 bob", ""] {
            let other = open(other);
            assert!(!is_offered(&other) && other.state.message.is_none());
        }
        assert!(is_offered(&open("publickey ssh-ed25519 ada")));
        for _ in 0..10 {
            let mut bob = open("publickey ssh-ed25519 bob");
            bob.modes.clear();
            press(&mut bob, "x");
            bob.finish().unwrap().expect("a file");
        }
        assert_eq!(files(folder.path()), 1 + KeptFolder::MOST);
        assert!(
            is_offered(&open("publickey ssh-ed25519 ada")),
            "hers is not dropped"
        );
    }

    #[test]
    fn of_forty_dropped_sessions_the_newest_five_are_kept() {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path();
        // All are dropped at once.
        let mut all: Vec<_> = (0..40).map(|_| opened(folder, "trio")).collect();
        for explorer in &mut all {
            press(explorer, "x");
            explorer.finish().unwrap().expect("a file");
        }
        assert_eq!(files(folder), KeptFolder::MOST);
        for _ in 0..KeptFolder::MOST {
            let mut next = opened(folder, "trio");
            assert!(is_offered(&next));
            press(&mut next, "\u{1b}");
        }
        assert!(!is_offered(&opened(folder, "trio")), "each is offered once");
    }

    #[test]
    fn where_there_is_no_place_to_keep_work_the_person_is_told() {
        let (scene, source) = Scene::open("trio").expect("a scene");
        let mut explorer = Explorer::new(scene, &source, Options::default());
        explorer.work_in(Workplace::of_process(None), &source);
        let woken = alarm(&mut explorer);
        press(&mut explorer, "x");
        assert!(rest(&mut explorer, &woken), "there is something to say");
        let said = explorer
            .state
            .message
            .take()
            .map(|m| m.text)
            .unwrap_or_default();
        assert!(said.contains("save it: there is no home folder"), "{said}");
        let lost = explorer.finish().unwrap_err();
        assert!(lost.contains("there is no home folder"), "{lost}");
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
