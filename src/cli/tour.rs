//! `rayscope tour`: the explorer, with the tour open.

use std::fmt::Write as _;
use std::path::Path;
use std::process::ExitCode;
use std::sync::Arc;

use clap::Args;

use super::place::Place;
use super::{INVALID, MISUSED, aspect, choice, complain, explore, write_out};
use crate::explorer::tour::{self, Chapter};
use crate::explorer::{Explorer, Opening, Options};
use crate::method::Method;
use crate::render::{Style, View};
use crate::scene::{Builtin, Source};

/// Walk through the tutorial, page by page, on live scenes
#[derive(Debug, Args)]
pub(super) struct Tour {
    /// A chapter's name or number; or the file of a chapter, or a folder of them, of your own
    #[arg(default_value = "1")]
    chapter: String,

    /// The page to begin with, from 1
    #[arg(long, value_name = "N", default_value_t = 1)]
    page: usize,

    /// List the chapters instead
    #[arg(long)]
    list: bool,

    /// How the quadratic is evaluated [default: as the page has it]
    #[arg(long, value_parser = choice(&Method::ALL, Method::name))]
    method: Option<Method>,

    /// How samples become characters [default: as the page has it]
    #[arg(long, value_parser = choice(&Style::ALL, Style::name))]
    style: Option<Style>,

    /// What the picture shows [default: as the page has it]
    #[arg(long, value_parser = choice(&View::ALL, View::name))]
    view: Option<View>,

    /// Height of a character cell over its width
    #[arg(long, default_value_t = Options::default().aspect, value_parser = aspect)]
    aspect: f64,

    #[command(flatten)]
    place: Place,
}

/// Opens the tour, or lists its chapters.
pub(super) fn run(arguments: &Tour) -> ExitCode {
    let (chapters, first) = match chapters(&arguments.chapter) {
        Ok(found) => found,
        Err(sentence) => {
            complain(sentence);
            return INVALID.into();
        }
    };
    if arguments.list {
        return write_out(&list(&chapters));
    }
    let pages = chapters[first].pages.len();
    if !(1..=pages).contains(&arguments.page) {
        let page = arguments.page;
        complain(format_args!(
            "--page {page}: expected a page from 1 to {pages}"
        ));
        return MISUSED.into();
    }
    let defaults = Options {
        aspect: arguments.aspect,
        ..Options::default()
    };
    let options = match explore::fitted(defaults) {
        Ok(options) => options,
        Err(status) => return status,
    };
    let own = Builtin::default();
    let mut explorer = Explorer::new(own.scene(), &Source::Builtin(own), options);
    explorer.start_tour(chapters, first, arguments.page - 1);
    let opening = Opening {
        method: arguments.method,
        style: arguments.style,
        view: arguments.view,
        ..arguments.place.opening()
    };
    if let Err(sentence) = explorer.set_out(&opening) {
        complain(sentence);
        return MISUSED.into();
    }
    explore::converse(&mut explorer)
}

/// All chapters, and the place of the one that is asked for.
fn chapters(word: &str) -> Result<(Arc<[Chapter]>, usize), String> {
    let chapters = tour::builtin();
    if let Some(at) = tour::find(&chapters, word) {
        return Ok((chapters, at));
    }
    let path = Path::new(word);
    if path.exists() {
        return Ok((tour::load(path).map_err(|e| e.to_string())?, 0));
    }
    let names: Vec<_> = chapters.iter().map(|c| c.name.as_str()).collect();
    Err(format!(
        "{word}: found no such chapter and no such file, expected 1 to {}, or one of {}",
        names.len(),
        names.join(", ")
    ))
}

fn list(chapters: &[Chapter]) -> String {
    let widest = chapters.iter().map(|c| c.name.chars().count()).max();
    let widest = widest.unwrap_or(0);
    let mut text = String::new();
    for (
        n,
        Chapter {
            name, title, pages, ..
        },
    ) in (1..).zip(chapters)
    {
        let pages = pages.len();
        let plural = if pages == 1 { "" } else { "s" };
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "{n:>2}  {name:<widest$}  {title} ({pages} page{plural})"
        );
    }
    text
}
