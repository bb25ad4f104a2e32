//! Opening and saving, and what is asked before something would be lost.

use std::path::Path;

use crate::explorer::Explorer;
use crate::explorer::files::disk::{self, Over, Stamp, Unsaved};
use crate::explorer::mode::{Mode, Purpose, Question};
use crate::scene::{Builtin, Scene, Source};

/// Where the scene came from and goes to.
#[derive(Debug, Clone)]
pub(crate) enum FilePlace {
    /// It has no file yet.
    None,
    Builtin(Builtin),
    File(Stamp),
}

impl FilePlace {
    pub(crate) fn of(source: &Source) -> Self {
        match source {
            Source::File(path) => Stamp::of(path).map_or(Self::None, Self::File),
            Source::Builtin(builtin) => Self::Builtin(*builtin),
        }
    }
}

impl Explorer {
    pub(crate) fn suggested_file(&self) -> String {
        match &self.place {
            FilePlace::File(stamp) => stamp.path().display().to_string(),
            FilePlace::None | FilePlace::Builtin(_) => {
                let name: String = self
                    .scene()
                    .name
                    .chars()
                    .map(|c| if c.is_alphanumeric() { c } else { '-' })
                    .collect();
                format!("{name}.toml")
            }
        }
    }

    pub(crate) fn open(&mut self, name: &str) {
        match self.read_scene(name) {
            Ok((scene, source)) => {
                self.leave_tour();
                let (screen, options) = (self.screen, self.options);
                let (rescue, put_away) = (self.rescue.take(), self.put_away.take());
                let measuring = std::mem::take(&mut self.measuring);
                let workplace = std::mem::take(&mut self.workplace);
                *self = Self::new(scene, &source, options);
                (self.screen, self.put_away) = (screen, put_away);
                self.measuring = measuring;
                self.workplace = workplace;
                if let Some(rescue) = rescue {
                    self.keep_in(&rescue.folder, &source);
                }
                let about = self.scene().about.clone().unwrap_or_default();
                self.say(format!("{}. {about}", self.scene().name));
            }
            Err(sentence) => self.warn(sentence),
        }
    }

    /// The scene of that name, or why it can't be had.
    pub(crate) fn read_scene(&self, name: &str) -> Result<(Scene, Source), String> {
        if let Some(builtin) = Builtin::by_name(name) {
            return Ok((builtin.scene(), Source::Builtin(builtin)));
        }
        let path = self.workplace.reach(name)?;
        Scene::open(path).map_err(|e| e.to_string())
    }

    pub(crate) fn save(&mut self) {
        if self.document.turn().is_some() {
            return self.say(
                "A dial is turned: | takes it back; :save-as keeps this scene under a name of its own.",
            );
        }
        match &self.place {
            FilePlace::None | FilePlace::Builtin(_) => {
                let suggestion = self.suggested_file();
                self.prompt(Purpose::SaveAs, &suggestion);
            }
            FilePlace::File(stamp) => {
                let stamp = stamp.clone();
                self.write(stamp.path(), Over::Known(&stamp));
            }
        }
    }

    /// Saves under a name that opens what was saved.
    pub(crate) fn save_as_named(&mut self, name: &str) {
        if Builtin::by_name(name).is_some() {
            self.warn(format!(
                "{name}: this name opens a built-in scene, expected another, such as ./{name}"
            ));
        } else if let Some(path) = self.reach(name) {
            self.save_as(&path);
        }
    }

    pub(crate) fn save_as(&mut self, path: &Path) {
        let own = matches!(&self.place, FilePlace::File(stamp) if stamp.path() == path);
        if own {
            self.save();
        } else {
            self.write(path, Over::Nothing);
        }
    }

    pub(crate) fn write(&mut self, path: &Path, over: Over<'_>) {
        match disk::save(path, &self.scene().to_toml(), over) {
            Ok(stamp) => {
                self.place = FilePlace::File(stamp);
                self.document.mark_saved();
                self.saved_as(path);
                self.say(format!("Saved {}.", path.display()));
                if std::mem::take(&mut self.quits_once_saved) {
                    self.ended = Some(0);
                }
            }
            Err(Unsaved::Occupied) => {
                let why = match over {
                    Over::Known(_) => "was changed by somebody else since it was read",
                    Over::Nothing | Over::Anything => "exists already",
                };
                let path = path.to_owned();
                self.mode = Mode::Ask(Question::Overwrite { path, why });
            }
            Err(Unsaved::Failed(sentence)) => self.warn(sentence),
        }
    }
}
