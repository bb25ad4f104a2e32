//! `rayscope [SCENE]`: opens the explorer.

use std::process::ExitCode;

use clap::Args;

use super::{INVALID, aspect, choice, complain};
use crate::explorer::{Explorer, Options};
use crate::method::Method;
use crate::render::{Style, View};
use crate::scene::Scene;
use crate::terminal::{self, Capability, Session};

/// How the explorer opens.
#[derive(Debug, Args)]
pub(super) struct Explore {
    /// A scene file, or the name of a built-in scene
    #[arg(default_value = "seed")]
    scene: String,

    /// How the quadratic is evaluated
    #[arg(long, value_parser = choice(&Method::ALL, Method::name), default_value_t = Method::default())]
    method: Method,

    /// How samples become characters
    #[arg(long, value_parser = choice(&Style::ALL, Style::name))]
    style: Option<Style>,

    /// What the picture shows
    #[arg(long, value_parser = choice(&View::ALL, View::name))]
    view: Option<View>,

    /// Height of a character cell over its width
    #[arg(long, default_value_t = Options::default().aspect, value_parser = aspect)]
    aspect: f64,
}

/// Opens the explorer and ends with the exit status that the person left it with.
pub(super) fn run(arguments: &Explore) -> ExitCode {
    let (scene, source) = match Scene::open(&arguments.scene) {
        Ok(opened) => opened,
        Err(e) => {
            complain(e);
            return ExitCode::from(INVALID);
        }
    };
    let capability = match Capability::detect() {
        Ok(capability) => capability,
        Err(unfit) => {
            complain(unfit.0);
            return ExitCode::from(INVALID);
        }
    };
    let defaults = Options::default();
    let options = Options {
        method: arguments.method,
        style: arguments.style.unwrap_or(defaults.style),
        view: arguments.view.unwrap_or(defaults.view),
        aspect: arguments.aspect,
        depth: capability.depth,
        glyphs: capability.glyphs,
    };
    let mut explorer = Explorer::new(scene, &source, options);
    let ended = Session::enter().and_then(|mut session| terminal::run(&mut explorer, &mut session));
    match ended {
        Ok(status) => ExitCode::from(status),
        Err(e) => {
            complain(format!("the terminal failed: {e}"));
            ExitCode::from(INVALID)
        }
    }
}
