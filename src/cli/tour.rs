//! `rayscope tour`: the explorer, with the tour open.

use std::ffi::{OsStr, OsString};
use std::fmt::Write as _;
use std::path::Path;
use std::sync::Arc;

use clap::Args;

use super::appearance::Appearance;
use super::place::PlaceFlags;
use super::{Failure, Outcome, explore, from_one, write_out};
use crate::explorer::tour::{self, Chapter};
use crate::explorer::{Explorer, Options};
use crate::scene::{Builtin, Source};

/// Walk through the tutorial, page by page, on live scenes
#[derive(Debug, Args)]
pub(super) struct TourArgs {
    /// A chapter's name or number; or the file of a chapter, or a folder of them, of your own
    #[arg(default_value = "1")]
    chapter: OsString,

    /// The page to begin with, from 1
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = from_one, allow_negative_numbers = true)]
    page: usize,

    /// List the chapters instead
    #[arg(long, conflicts_with = "page")]
    list: bool,

    #[command(flatten)]
    appearance: Appearance,

    #[command(flatten)]
    place: PlaceFlags<true>,
}

/// Opens the tour, or lists its chapters.
pub(super) fn run(arguments: &TourArgs) -> Outcome {
    if arguments.list {
        return write_out(&list(&chapters(&arguments.chapter)?.0));
    }
    let appearance = &arguments.appearance;
    let remembered = explore::remembered(&explore::workplace(), appearance);
    let mut explorer = opened(arguments, |options| appearance.fitted(options, &remembered))?;
    explore::converse(&mut explorer, appearance)
}

/// The explorer on the page that is asked for.
pub(super) fn opened(
    arguments: &TourArgs,
    fit: impl FnOnce(Options) -> Result<Options, Failure>,
) -> Result<Explorer, Failure> {
    let (chapters, at) = chapters(&arguments.chapter)?;
    let (page, pages) = (arguments.page, chapters[at].pages.len());
    if !(1..=pages).contains(&page) {
        let sentence = format!("--page {page}: expected a page from 1 to {pages}");
        return Err(Failure::misused(sentence));
    }
    let options = fit(Options::default())?;
    let own = Builtin::default();
    explore::set_out(&arguments.place.settings, || {
        let mut explorer = Explorer::new(own.scene(), &Source::Builtin(own), options);
        explorer.tour_in(explore::workplace());
        explorer.start_tour(Arc::clone(&chapters), at, page - 1);
        explorer
    })
}

/// All chapters, and the place of the one that is asked for.
fn chapters(word: &OsStr) -> Result<(Arc<[Chapter]>, usize), Failure> {
    let chapters = tour::builtin();
    if let Some(at) = word.to_str().and_then(|word| tour::find(&chapters, word)) {
        return Ok((chapters, at));
    }
    let path = Path::new(word);
    if path.exists() {
        return Ok((tour::load(path).map_err(Failure::invalid)?, 0));
    }
    let names: Vec<_> = chapters.iter().map(|c| c.name.as_str()).collect();
    Err(Failure::invalid(format_args!(
        "{}: found no such chapter and no such file, expected 1 to {}, or one of {}",
        path.display(),
        names.len(),
        names.join(", ")
    )))
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
