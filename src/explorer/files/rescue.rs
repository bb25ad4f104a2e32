//! Unsaved work that outlives its terminal: kept in a file when nobody can be asked, and offered
//! when the same scene is opened again.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process;
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use crate::door::Expected;
use crate::explorer::Explorer;
use crate::explorer::edit::document::Change;
use crate::explorer::link::command_line;
use crate::explorer::mode::{Mode, Question};
use crate::scene::{Builtin, LARGEST_FILE, Scene, Source};
use crate::system;

/// A file that was kept: a scene, and a few lines before it.
const KEPT: Expected = Expected {
    what: "a scene file",
    most: LARGEST_FILE,
};

/// What the line starts with that says which scene a file belongs to.
const BELONGS: &str = "# scene: ";

/// Where unsaved work is kept.
#[derive(Debug)]
pub(crate) struct Rescue {
    pub(crate) folder: PathBuf,
    /// What the scene was opened as: a built-in's name, or the path of a file.
    scene: String,
    /// The file that the work at hand was taken from.
    taken: Option<PathBuf>,
}

impl Explorer {
    /// Keeps unsaved work in `folder` if the terminal is lost, and offers what is there already for
    /// the scene from `source`.
    pub(super) fn keep_in(&mut self, folder: &Path, source: &Source) {
        let rescue = Rescue {
            folder: folder.to_owned(),
            scene: identity(source),
            taken: None,
        };
        if let Some((path, age)) = rescue.newest(|scene| scene == rescue.scene) {
            self.mode = Mode::Ask(Question::Recover { path, age });
        } else if let Some((path, age)) = rescue.newest(|_| true) {
            self.say(elsewhere(&path, age));
        }
        self.rescue = Some(rescue);
    }

    /// To be called when the explorer is over: where unsaved work was kept, if there was any that
    /// the person has not given up.
    pub fn finish(&mut self) -> Result<Option<PathBuf>, String> {
        self.leave_tour();
        if !self.is_changed() {
            return Ok(None);
        }
        let given_up = match self.ended {
            // Who interrupts has not been asked, or not answered.
            Some(130) => !self.is_worth_saving(),
            Some(_) => true,
            None => false,
        };
        let text = self.document.ground().to_toml();
        let Some(rescue) = &mut self.rescue else {
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
    pub(crate) fn recover(&mut self, path: &Path) {
        match Scene::load(path) {
            Ok(scene) => {
                self.document.apply(Change::Scene(Box::new(scene)));
                self.mend_selection();
                if let Some(rescue) = &mut self.rescue {
                    rescue.taken = Some(path.to_owned());
                }
                self.say("This is what was not saved. u goes back to the scene as it was opened.");
            }
            Err(e) => self.warn(e.to_string()),
        }
    }

    /// Deletes kept work.
    pub(crate) fn discard(&mut self, path: &Path) {
        match fs::remove_file(path) {
            Ok(()) => self.say("It is deleted."),
            Err(e) => self.warn(format!("{}: not deleted: {e}", path.display())),
        }
    }

    /// What was kept is saved now; from here on unsaved work belongs to that file.
    pub(crate) fn saved_as(&mut self, path: &Path) {
        if let Some(rescue) = &mut self.rescue {
            rescue.forget_taken();
            rescue.scene = identity(&Source::File(path.to_owned()));
        }
    }
}

impl Rescue {
    /// Writes a file that nobody else may read, whole or not at all, and over no other.
    fn keep(&self, text: &str) -> io::Result<PathBuf> {
        system::create_private_folder(&self.folder)?;
        // A temporary file is its owner's alone from the start.
        let mut file = tempfile::Builder::new()
            .prefix(".rayscope-")
            .tempfile_in(&self.folder)?;
        write!(
            file,
            "# Unsaved work that rayscope kept when its terminal was gone.\n{BELONGS}{}\n\n{text}",
            self.scene
        )?;
        file.as_file().sync_all()?;
        let since = SystemTime::now().duration_since(UNIX_EPOCH);
        let since = since.unwrap_or_default().as_nanos();
        let path = self.folder.join(format!("{since}-{}.toml", process::id()));
        file.persist_noclobber(&path)?;
        Ok(path)
    }

    /// The newest file kept for a scene that is wanted, and how old it is.
    fn newest(&self, is_wanted: impl Fn(&str) -> bool) -> Option<(PathBuf, Duration)> {
        fs::read_dir(&self.folder)
            .ok()?
            .flatten()
            .map(|entry| entry.path())
            .filter(|path| path.extension().is_some_and(|e| e == "toml"))
            .filter(|path| owner(path).is_some_and(|scene| is_wanted(&scene)))
            .filter_map(|path| {
                let written = fs::metadata(&path).ok()?.modified().ok()?;
                Some((path, written.elapsed().unwrap_or_default()))
            })
            .min_by_key(|(_, age)| *age)
    }

    fn forget_taken(&mut self) {
        if let Some(path) = self.taken.take() {
            // One that can't be deleted is offered once more, which loses nothing.
            let _ = fs::remove_file(path);
        }
    }
}

/// The scene that a kept file belongs to.
fn owner(path: &Path) -> Option<String> {
    let text = KEPT.text(path).ok()?;
    let mut lines = text.lines().filter_map(|l| l.strip_prefix(BELONGS));
    lines.next().map(str::to_owned)
}

/// That work on another scene was kept, and how to come by it.
fn elsewhere(path: &Path, age: Duration) -> String {
    let scene = owner(path).unwrap_or_default();
    let is_there = Builtin::by_name(&scene).is_some() || Path::new(&scene).exists();
    let file = path.to_string_lossy();
    let opens = if is_there { scene.clone() } else { file.into() };
    format!(
        "Unsaved work of {} ago on {scene} was kept: `{}` opens it.",
        words(age),
        command_line(&[opens])
    )
}

/// What a scene was opened as, in one line.
fn identity(source: &Source) -> String {
    match source {
        Source::Builtin(builtin) => builtin.name().to_owned(),
        Source::File(path) => {
            let path = fs::canonicalize(path).unwrap_or_else(|_| path.clone());
            path.to_string_lossy().replace(['\n', '\r'], "?")
        }
    }
}

/// An age in the largest unit of which there is one: `3 hours`.
pub(crate) fn words(age: Duration) -> String {
    let seconds = age.as_secs();
    let (count, unit) = match seconds {
        0..60 => (seconds, "second"),
        60..3600 => (seconds / 60, "minute"),
        3600..86400 => (seconds / 3600, "hour"),
        _ => (seconds / 86400, "day"),
    };
    let plural = if count == 1 { "" } else { "s" };
    format!("{count} {unit}{plural}")
}

#[cfg(test)]
mod tests {
    use ratatui::crossterm::event::{Event, KeyCode, KeyEvent, KeyModifiers};

    use super::*;
    use crate::explorer::{Options, Workplace};

    fn opened(folder: &Path, name: &str) -> Explorer {
        let (scene, source) = Scene::open(name).expect("a scene");
        let mut explorer = Explorer::new(scene, &source, Options::default());
        explorer.work_in(Workplace::keeping_in(folder), &source);
        explorer
    }

    fn press(explorer: &mut Explorer, keys: &str) {
        for c in keys.chars() {
            let key = KeyEvent::new(KeyCode::Char(c), KeyModifiers::NONE);
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
        assert_eq!(other.mode, Mode::Normal);
        let said = other.message.take().expect("a message").text;
        assert!(
            said.contains("on trio was kept: `rayscope trio` opens it"),
            "{said}"
        );
        let mut again = opened(&folder, "trio");
        assert!(matches!(again.mode, Mode::Ask(Question::Recover { .. })));
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
        saved.save_as(&folder.join("saved.txt"));
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
        assert_eq!(later.mode, Mode::Normal);
        assert_ne!(later.scene().camera, later.opened.camera);
        assert_eq!(files(folder), 1, "d orbits, and deletes nothing");
        let mut deleted = opened(folder, "trio");
        press(&mut deleted, "D");
        assert_eq!(files(folder), 0);
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

    #[test]
    fn ages_are_in_words() {
        let age = |seconds| words(Duration::from_secs(seconds));
        assert_eq!(age(1), "1 second");
        assert_eq!(age(7300), "2 hours");
        assert_eq!(age(90_000), "1 day");
    }
}
