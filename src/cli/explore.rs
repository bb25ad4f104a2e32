//! `rayscope [SCENE]`: opens the explorer.

use std::env;
use std::ffi::OsString;
use std::io;
use std::panic::{self, AssertUnwindSafe};
use std::path::PathBuf;

use clap::Args;

use super::appearance::{Appearance, default_style, is_anybody_present};
use super::place::Place;
use super::{Failure, Outcome, aspect, choice, complain};
use crate::explorer::{Explorer, Opening, Options, Workplace};
use crate::method::Method;
use crate::render::{Style, View};
use crate::scene::{Scene, Source};
use crate::terminal::{self, Session};

/// How the explorer opens.
#[derive(Debug, Args)]
pub(super) struct Explore {
    /// A scene file, or the name of a built-in scene
    #[arg(default_value = "tutorial")]
    scene: OsString,

    /// How the quadratic is evaluated
    #[arg(long, env = "RAYSCOPE_METHOD", hide_env_values = true, value_parser = choice(&Method::ALL, Method::name), default_value_t = Method::default())]
    method: Method,

    /// How samples become characters [default: half where there are colours, else ascii]
    #[arg(long, env = "RAYSCOPE_STYLE", hide_env_values = true, value_parser = choice(&Style::ALL, Style::name))]
    style: Option<Style>,

    /// What the picture shows
    #[arg(long, value_parser = choice(&View::ALL, View::name))]
    view: Option<View>,

    /// Height of a character cell over its width
    #[arg(long, default_value_t = Options::default().aspect, value_parser = aspect)]
    aspect: f64,

    #[command(flatten)]
    appearance: Appearance,

    #[command(flatten)]
    place: Place,
}

/// Opens the explorer and ends with the exit status that the person left it with.
pub(super) fn run(arguments: &Explore) -> Outcome {
    let appearance = &arguments.appearance;
    let (mut explorer, source) = opened(arguments, |options| appearance.fitted(options))?;
    explorer.work_in(Workplace::of_process(state_folder()), &source);
    converse(&mut explorer, appearance)
}

/// The explorer as it is asked for, its options made to `fit` the terminal.
pub(super) fn opened(
    arguments: &Explore,
    fit: impl FnOnce(Options) -> Result<Options, Failure>,
) -> Result<(Explorer, Source), Failure> {
    let (scene, source) = Scene::open(&arguments.scene).map_err(Failure::invalid)?;
    let defaults = Options::default();
    let options = fit(Options {
        method: arguments.method,
        view: arguments.view.unwrap_or(defaults.view),
        aspect: arguments.aspect,
        ..defaults
    })?;
    let by_default = || default_style(options.colors(), options.glyphs);
    let options = Options {
        style: arguments.style.unwrap_or_else(by_default),
        ..options
    };
    let opening = arguments.place.opening();
    let explorer = set_out(&opening, || Explorer::new(scene.clone(), &source, options))?;
    Ok((explorer, source))
}

/// An explorer at the place that is asked for, or what is wrong with that place.
pub(super) fn set_out(opening: &Opening, new: impl Fn() -> Explorer) -> Result<Explorer, Failure> {
    let at_place = || {
        let mut explorer = new();
        explorer.set_out(opening).map_err(Failure::misused)?;
        Ok(explorer)
    };
    // Only the picture tells whether there is such a step. A link from a screen of another size may
    // come to a pixel that lacks it: then the explorer says so itself.
    if opening.step.is_some() && opening.size.is_none() {
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

/// Where programs of this person keep what should outlive them, as the XDG base directories have it.
fn state_folder() -> Option<PathBuf> {
    let folder = |name| {
        let path = PathBuf::from(env::var_os(name)?);
        path.is_absolute().then_some(path)
    };
    let state = folder("XDG_STATE_HOME").or_else(|| Some(folder("HOME")?.join(".local/state")))?;
    Some(state.join("rayscope"))
}
