//! What becomes of unsaved work: this session's file of it, written by a thread that nobody waits for,
//! and the files of earlier sessions that it has to do with.

use std::fs;
use std::io;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use crate::explorer::files::kept::{KeptFile, KeptFolder};
use crate::scene::{Scene, Source};
use crate::system::Waker;

/// Why unsaved work is not kept where there is no folder for it.
pub(super) const NOWHERE: &str = "there is no home folder to keep it in";

/// How long after a change unsaved work is written down.
const DELAY: Duration = Duration::from_secs(1);
/// Writing takes at most one part of so many of the time.
const PARTS: u32 = 10;

/// What becomes of unsaved work.
#[derive(Debug)]
pub(crate) struct Rescue {
    /// Where it is kept; none if there is no place.
    pub(super) folder: Option<KeptFolder>,
    /// What the scene was opened as: a built-in's name, or the path of a file.
    pub(super) scene: String,
    /// The file of this session.
    pub(super) own: Option<KeptFile>,
    /// The file that is being offered.
    pub(super) offered: Option<KeptFile>,
    /// The file that the work at hand was taken from.
    pub(super) taken: Option<KeptFile>,
    /// Files that go when the person leaves.
    pub(super) discarded: Vec<KeptFile>,
    /// The version of the scene that was last written down, or need not be.
    pub(super) noted: u64,
    /// Whether it is time to write.
    pub(super) due: Option<Arc<AtomicBool>>,
    writing: Option<JoinHandle<io::Result<(KeptFile, Duration)>>>,
    /// When that was begun the last time.
    begun: Option<Instant>,
    /// How long it took.
    cost: Duration,
    /// Whether the person knows that nothing can be kept.
    pub(super) has_warned: bool,
}

impl Rescue {
    pub(super) fn new(folder: Option<KeptFolder>, scene: String, version: u64) -> Self {
        Self {
            folder,
            scene,
            own: None,
            offered: None,
            taken: None,
            discarded: Vec::new(),
            noted: version,
            due: None,
            writing: None,
            begun: None,
            cost: Duration::ZERO,
            has_warned: false,
        }
    }

    /// Wakes the explorer when it is time to write.
    pub(super) fn wait(&mut self, waker: Waker) {
        let due = Arc::new(AtomicBool::new(false));
        self.due = Some(Arc::clone(&due));
        let delay = DELAY.max(self.cost * PARTS);
        thread::spawn(move || {
            thread::sleep(delay);
            due.store(true, Ordering::Release);
            waker.wake();
        });
    }

    pub(super) fn is_writing(&self) -> bool {
        self.writing.as_ref().is_some_and(|w| !w.is_finished())
    }

    /// Whether to write now would take too large a part of the time.
    pub(super) fn is_too_soon(&self) -> bool {
        let rest = self.cost * PARTS;
        self.is_writing() || self.begun.is_some_and(|begun| begun.elapsed() < rest)
    }

    /// Writes this session's file on a thread that nobody waits for.
    pub(super) fn write(&mut self, scene: Scene) {
        let Some(folder) = self.folder.clone() else {
            return;
        };
        let own = self.own.as_ref().map(|own| own.path.clone());
        let identity = self.scene.clone();
        self.begun = Some(Instant::now());
        self.writing = Some(thread::spawn(move || {
            let begun = Instant::now();
            let kept = folder.write(own.as_deref(), &identity, &scene.to_toml())?;
            Ok((kept, begun.elapsed()))
        }));
    }

    /// Waits for what is being written; why it was not.
    pub(super) fn collect(&mut self) -> Result<(), String> {
        let Some(writing) = self.writing.take() else {
            return Ok(());
        };
        match writing.join() {
            Ok(Ok((kept, cost))) => {
                self.own = Some(kept);
                self.cost = cost;
                Ok(())
            }
            Ok(Err(error)) => Err(self.refusal(&error)),
            Err(_) => Err("the writer broke off".into()),
        }
    }

    fn refusal(&self, error: &io::Error) -> String {
        let folder = self.folder.as_ref().map(|f| f.folder.display());
        folder.map_or_else(|| NOWHERE.into(), |folder| format!("{folder}: {error}"))
    }

    /// Keeps the work for the next session.
    pub(super) fn keep(&mut self, text: &str) -> Result<PathBuf, String> {
        let folder = self.folder.as_ref().ok_or(NOWHERE)?;
        let own = self.own.as_ref().map(|own| own.path.as_path());
        let kept = folder.write(own, &self.scene, text);
        let kept = kept.and_then(|kept| kept.sync().map(|()| kept));
        match kept {
            Ok(kept) => {
                // It is not locked any more: others may offer it.
                self.own = None;
                Ok(kept.path)
            }
            Err(error) => Err(self.refusal(&error)),
        }
    }

    /// What was not saved is given up.
    pub(super) fn give_up(&mut self) {
        let _ = self.collect();
        self.forget_own();
    }

    // One that can't be deleted is offered once more, which loses nothing.

    pub(super) fn forget_own(&mut self) {
        if let Some(kept) = self.own.take() {
            let _ = kept.delete();
        }
    }

    pub(super) fn remove_discarded(&mut self) {
        for kept in self.discarded.drain(..) {
            let _ = kept.delete();
        }
    }

    pub(super) fn forget_taken(&mut self) {
        if let Some(kept) = self.taken.take() {
            let _ = kept.delete();
        }
    }
}

/// What a scene was opened as, in one line.
pub(super) fn identity(source: &Source) -> String {
    match source {
        Source::Builtin(builtin) => builtin.name().to_owned(),
        Source::File(path) => {
            let path = fs::canonicalize(path).unwrap_or_else(|_| path.clone());
            match path.to_str() {
                Some(path) => path.replace(['\n', '\r'], "?"),
                // Another name than any that is text.
                None => path
                    .as_os_str()
                    .as_encoded_bytes()
                    .escape_ascii()
                    .to_string(),
            }
        }
    }
}
