//! `rayscope [SCENE]`: opens the explorer.

use std::env;
use std::ffi::OsString;
use std::io;
use std::panic::{self, AssertUnwindSafe};
use std::path::{Path, PathBuf};

use clap::Args;

use super::appearance::{Appearance, default_style, is_anybody_present};
use super::place::PlaceFlags;
use super::{Failure, Outcome, complain};
use crate::door::{self, Expected};
use crate::explorer::{self, Explorer, Options, Setting, Workplace};
use crate::render::Style;
use crate::scene::{Builtin, Scene, Source};
use crate::terminal::{self, Session};

/// How the explorer opens.
#[derive(Debug, Args)]
pub(super) struct Explore {
    /// A scene file, or the name of a built-in scene [default: the opening scene]
    #[arg(default_value = Builtin::default().name(), hide_default_value = true)]
    scene: OsString,

    #[command(flatten)]
    appearance: Appearance,

    #[command(flatten)]
    place: PlaceFlags<false>,
}

/// Opens the explorer and ends with the exit status that the person left it with.
pub(super) fn run(arguments: &Explore) -> Outcome {
    let appearance = &arguments.appearance;
    let workplace = workplace();
    let remembered = remembered(&workplace, appearance);
    let fit = |options| appearance.fitted(options, &remembered);
    let (mut explorer, source) = opened(arguments, &remembered, fit)?;
    explorer.work_in(workplace, &source);
    converse(&mut explorer, appearance)
}

/// What was chosen at an earlier start; lines of text are the same at every start.
pub(super) fn remembered(workplace: &Workplace, appearance: &Appearance) -> Vec<Setting> {
    if appearance.plain {
        return Vec::new();
    }
    explorer::remembered(workplace)
}

/// What of the remembered settings says how a scene is looked at: a style, where the terminal has what
/// it needs, and a lens.
pub(super) fn remembered_view(remembered: &[Setting], usual: Style) -> Vec<Setting> {
    let suits = |setting: &&Setting| match setting {
        Setting::Style(_) => usual == Style::Half,
        Setting::Lens(_) => true,
        _ => false,
    };
    remembered.iter().filter(suits).cloned().collect()
}

/// The explorer as it is asked for, its options made to `fit` the terminal.
pub(super) fn opened(
    arguments: &Explore,
    remembered: &[Setting],
    fit: impl FnOnce(Options) -> Result<Options, Failure>,
) -> Result<(Explorer, Source), Failure> {
    let (scene, source) = Scene::open(&arguments.scene).map_err(Failure::invalid)?;
    let options = fit(Options::default())?;
    // What is asked for comes after, and wins.
    let usual = default_style(options.colors(), options.glyphs);
    let mut settings = vec![Setting::Style(usual)];
    settings.extend(remembered_view(remembered, usual));
    settings.extend_from_slice(&arguments.place.settings);
    let explorer = set_out(&settings, || {
        Explorer::new(scene.clone(), &source, options).finding_files_in(workplace())
    })?;
    Ok((explorer, source))
}

/// An explorer at the place that is asked for, or what is wrong with that place.
pub(super) fn set_out(
    settings: &[Setting],
    new: impl Fn() -> Explorer,
) -> Result<Explorer, Failure> {
    let at_place = || {
        let mut explorer = new();
        explorer.set_out(settings).map_err(Failure::misused)?;
        Ok(explorer)
    };
    // Only the picture tells whether there is such a step. A link from a screen of another size may
    // come to a pixel that lacks it: then the explorer says so itself.
    let names = |is: fn(&Setting) -> bool| settings.iter().any(is);
    let of_other_screen = names(|setting| matches!(setting, Setting::Size(_)));
    if names(|setting| matches!(setting, Setting::Step(_))) && !of_other_screen {
        let rehearsed = at_place()?.rehearse();
        rehearsed.map_err(|e| Failure::misused(format_args!("--{e}")))?;
    }
    at_place()
}

/// Runs the explorer in the terminal; however that ends, unsaved work is kept.
pub(super) fn converse(explorer: &mut Explorer, appearance: &Appearance) -> Outcome {
    if appearance.plain {
        let ended = terminal::converse(explorer, is_anybody_present());
        keep(explorer.finish());
        return ended.map_err(|e| failed(&e));
    }
    let mut session = Session::enter().map_err(|e| failed(&e))?;
    // After a panic only the scene is looked at, which is whole between any two changes.
    let ended = panic::catch_unwind(AssertUnwindSafe(|| terminal::run(explorer, &mut session)));
    let kept = explorer.finish();
    drop(session);
    keep(kept);
    match ended {
        Ok(ended) => ended.map_err(|e| failed(&e)),
        Err(panicked) => panic::resume_unwind(panicked),
    }
}

/// Says where unsaved work was kept, or why it was not.
fn keep(kept: Result<Option<PathBuf>, String>) {
    match kept {
        Ok(Some(path)) => complain(format_args!(
            "unsaved work is kept in {}; opening the same scene offers it",
            path.display()
        )),
        Ok(None) => {}
        Err(sentence) => complain(sentence),
    }
}

fn failed(error: &io::Error) -> Failure {
    Failure::invalid(format_args!("the terminal failed: {error}"))
}

/// Where this process works.
pub(super) fn workplace() -> Workplace {
    Workplace::of_process(state_folder()).of_person(person())
}

/// Where programs of this person keep what should outlive them, as the XDG base directories have it.
fn state_folder() -> Option<PathBuf> {
    let folder = |name| {
        let path = PathBuf::from(env::var_os(name)?);
        path.is_absolute().then_some(path)
    };
    let state = folder("XDG_STATE_HOME").or_else(|| Some(door::home()?.join(".local/state")))?;
    Some(state.join("rayscope"))
}

/// Who of those that share an account this is, by the key that they came in with: sshd names the
/// file in which it says so if it is set up to (`ExposeAuthInfo yes`).
fn person() -> String {
    const KEYS: Expected = Expected {
        what: "a list of keys",
        most: 1 << 20,
    };
    let keys = env::var_os("SSH_USER_AUTH").and_then(|path| KEYS.text(Path::new(&path)).ok());
    keys.unwrap_or_default()
        .split_whitespace()
        .collect::<Vec<_>>()
        .join(" ")
}
