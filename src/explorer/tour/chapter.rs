//! The tour as data: chapters of pages, each a short text and the state that it speaks of.
//!
//! A chapter is a TOML file; those of the tour that comes with the program lie in the folder beside
//! this one. `docs/tour.md` tells how to write one. How the explorer walks through them is in
//! `touring`.

use std::fs;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::Vec3;
use serde::Deserialize;
use toml::Spanned;

use crate::door::{Expected, FileError, TextPosition};
use crate::explorer::arrival::Target;
use crate::explorer::command::{Command, choice};
use crate::explorer::edit::field;
use crate::explorer::panel::Panel;
use crate::method::Method;
use crate::render::{Style, View};
use crate::scene::{Builtin, Scene, Size, Source, value};

/// A walk through some pages, in their order.
#[derive(Debug, Clone, PartialEq)]
pub struct Chapter {
    /// The word by which it is asked for: its file's name without number and extension.
    pub name: String,
    /// The file it was read from; none if it came with the program.
    pub file: Option<PathBuf>,
    /// What it is about, in a few words.
    pub title: String,
    /// Its pages, one at least.
    pub pages: Vec<Page>,
}

/// A short text and what the explorer shows beside it.
#[derive(Debug, Clone, PartialEq)]
pub struct Page {
    /// What there is to know, in paragraphs.
    pub text: Vec<String>,
    /// What there is to do.
    pub attempt: Option<String>,
    pub(crate) state: State,
}

/// The state of the explorer that a page speaks of.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct State {
    /// The scene, with the page's own numbers in it.
    pub(crate) scene: Arc<Scene>,
    /// Where the scene came from; none if it is written in the chapter.
    pub(crate) source: Option<Source>,
    pub(crate) sphere: Option<usize>,
    pub(crate) target: Target,
    pub(crate) method: Method,
    pub(crate) view: View,
    /// None: as the person has it.
    pub(crate) style: Option<Style>,
    pub(crate) panel: Panel,
    pub(crate) compare: Option<Method>,
    pub(crate) step: Option<String>,
    /// Where the moving point of slice and curve is; none: at what is seen.
    pub(crate) t: Option<f64>,
    pub(crate) predict: bool,
    pub(crate) board: bool,
}

/// The chapters that come with the program, in their order.
const BUILTIN: &[(&str, &str)] = &[
    (
        "01-circle-and-line.toml",
        include_str!("chapters/01-circle-and-line.toml"),
    ),
    ("02-the-ray.toml", include_str!("chapters/02-the-ray.toml")),
    (
        "03-substitution.toml",
        include_str!("chapters/03-substitution.toml"),
    ),
    ("04-a-b-c.toml", include_str!("chapters/04-a-b-c.toml")),
    (
        "05-three-rays.toml",
        include_str!("chapters/05-three-rays.toml"),
    ),
    (
        "06-the-screen.toml",
        include_str!("chapters/06-the-screen.toml"),
    ),
    (
        "07-what-is-seen.toml",
        include_str!("chapters/07-what-is-seen.toml"),
    ),
    (
        "08-behind-and-inside.toml",
        include_str!("chapters/08-behind-and-inside.toml"),
    ),
    ("09-half-b.toml", include_str!("chapters/09-half-b.toml")),
    (
        "10-perspective.toml",
        include_str!("chapters/10-perspective.toml"),
    ),
    (
        "11-the-lost-sphere.toml",
        include_str!("chapters/11-the-lost-sphere.toml"),
    ),
    (
        "12-above-the-ground.toml",
        include_str!("chapters/12-above-the-ground.toml"),
    ),
    (
        "13-what-exact-costs.toml",
        include_str!("chapters/13-what-exact-costs.toml"),
    ),
];

/// The tour that comes with the program.
pub fn builtin() -> Arc<[Chapter]> {
    BUILTIN
        .iter()
        .map(|(name, text)| {
            Chapter::parse(text, name, None)
                .unwrap_or_else(|error| unreachable!("a chapter is refused: {error}"))
        })
        .collect()
}

/// What a chapter is read from. Its tree takes some thirty times as much memory.
const CHAPTER: Expected = Expected {
    what: "a chapter of a tour",
    most: 16 << 20,
};

/// The tour in a chapter's file, or in a folder of them, in the order of their names.
pub fn load(path: &Path) -> Result<Arc<[Chapter]>, FileError> {
    if !path.is_dir() {
        return Ok([Chapter::load(path)?].into());
    }
    let entries = fs::read_dir(path).map_err(|e| CHAPTER.refusal(path, &e))?;
    let mut files: Vec<_> = entries
        .flatten()
        .map(|entry| entry.path())
        .filter(|file| file.extension().is_some_and(|e| e == "toml"))
        .collect();
    files.sort();
    if files.is_empty() {
        let problem = "found no file that ends in .toml, expected a folder of chapters";
        return Err(FileError::whole(path, problem));
    }
    files.iter().map(|file| Chapter::load(file)).collect()
}

/// The place in `chapters` of the chapter of that name or, from 1, of that number.
pub fn find(chapters: &[Chapter], word: &str) -> Option<usize> {
    let by_name = chapters.iter().position(|c| c.name == word);
    let by_number = || word.parse().ok().and_then(|n: usize| n.checked_sub(1));
    by_name.or_else(by_number).filter(|&at| at < chapters.len())
}

impl Chapter {
    fn load(path: &Path) -> Result<Self, FileError> {
        let text = CHAPTER.text(path)?;
        let chapter = Self::parse(&text, &path.display().to_string(), path.parent())?;
        Ok(Self {
            file: Some(path.to_owned()),
            ..chapter
        })
    }

    /// Reads a chapter from the text of its file; scenes that are files lie in `folder`.
    pub fn parse(text: &str, file: &str, folder: Option<&Path>) -> Result<Self, FileError> {
        let located = |span: Option<Range<usize>>, problem: String| FileError {
            file: file.to_owned(),
            position: span.map(|span| TextPosition::of(span.start, text.as_bytes())),
            problem,
        };
        let written: ChapterFile = toml::from_str(text)
            .map_err(|e| located(e.span(), e.message().trim_end().to_owned()))?;
        let title = value::line(written.title.get_ref())
            .map_err(|refused| located(Some(written.title.span()), format!("title: {refused}")))?;
        let mut pages: Vec<Page> = Vec::new();
        for page in written.page {
            let before = pages.last().map(|p| &p.state);
            let made = page.into_page(before, folder);
            pages.push(made.map_err(|PageFault { at, problem }| {
                let number = pages.len() + 1;
                located(Some(at..at), format!("page {number}, {problem}"))
            })?);
        }
        if pages.is_empty() {
            let problem = "found no page, expected one at least, headed [[page]]";
            return Err(located(None, problem.into()));
        }
        Ok(Self {
            name: name_of(file),
            file: None,
            title: title.to_owned(),
            pages,
        })
    }
}

/// A file's name without folder and extension, and without the number that puts it in its place.
fn name_of(file: &str) -> String {
    let stem = Path::new(file).file_stem().unwrap_or_default();
    let stem = stem.to_string_lossy();
    let rest = stem.trim_start_matches(|c: char| c.is_ascii_digit());
    match rest.strip_prefix('-') {
        Some(name) if !name.is_empty() => name.to_owned(),
        _ => stem.into_owned(),
    }
}

/// What a chapter's file may say.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ChapterFile {
    title: Spanned<String>,
    #[serde(default)]
    page: Vec<PageFile>,
}

/// What a page may say. What it leaves out stays as on the page before, but for `step`, `t`,
/// `predict` and `board`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PageFile {
    text: Spanned<String>,
    r#try: Option<Spanned<String>>,
    scene: Option<Spanned<String>>,
    /// Numbers of the scene, as after `:set`.
    #[serde(default)]
    set: Vec<Spanned<String>>,
    /// The sphere that is selected, from 1.
    sphere: Option<Spanned<usize>>,
    pixel: Option<Spanned<[u32; 2]>>,
    point: Option<Spanned<[f32; 3]>>,
    method: Option<Spanned<String>>,
    view: Option<Spanned<String>>,
    style: Option<Spanned<String>>,
    panel: Option<Spanned<String>>,
    compare: Option<Spanned<String>>,
    step: Option<String>,
    t: Option<f64>,
    #[serde(default)]
    predict: bool,
    #[serde(default)]
    board: bool,
}

/// What is wrong with a page, and at which byte of the file.
struct PageFault {
    at: usize,
    problem: String,
}

impl PageFault {
    fn at<T>(place: &Spanned<T>, problem: impl Into<String>) -> Self {
        Self {
            at: place.span().start,
            problem: problem.into(),
        }
    }
}

impl PageFile {
    fn into_page(self, before: Option<&State>, folder: Option<&Path>) -> Result<Page, PageFault> {
        let state = self.state(before, folder)?;
        let text = prose(&self.text, "text")?;
        if text.is_empty() {
            return Err(PageFault::at(
                &self.text,
                "text: found nothing, expected a sentence",
            ));
        }
        let attempt = self.r#try.as_ref().map(|t| prose(t, "try")).transpose()?;
        Ok(Page {
            text,
            attempt: attempt.map(|paragraphs| paragraphs.join(" ")),
            state,
        })
    }

    fn state(&self, before: Option<&State>, folder: Option<&Path>) -> Result<State, PageFault> {
        let mut state = match (&self.scene, before) {
            (Some(scene), _) => {
                let (scene, source) = open_scene(scene, folder)?;
                match before {
                    Some(before) => before.in_scene(scene, source),
                    None => State::first(scene, source),
                }
            }
            (None, Some(before)) => before.clone(),
            (None, None) => {
                let problem = "scene: missing, expected one on the first page";
                return Err(PageFault::at(&self.text, problem));
            }
        };
        (state.predict, state.board) = (self.predict, self.board);
        if let Some(number) = &self.sphere {
            let count = state.scene.bodies.len();
            let at = number.get_ref().wrapping_sub(1);
            if at >= count {
                let problem = format!(
                    "sphere: found {}, expected 1 to {count}",
                    at.wrapping_add(1)
                );
                return Err(PageFault::at(number, problem));
            }
            state.sphere = Some(at);
        }
        self.set_numbers(&mut state)?;
        if let Some(target) = self.target(&state.scene)? {
            state.target = target;
        }
        if let Some(method) = named(self.method.as_ref(), "method", Method::ALL, Method::name)? {
            state.method = method;
        }
        if let Some(view) = named(self.view.as_ref(), "view", View::ALL, View::name)? {
            state.view = view;
        }
        if let Some(style) = named(self.style.as_ref(), "style", Style::ALL, Style::name)? {
            state.style = Some(style);
        }
        if let Some(panel) = named(self.panel.as_ref(), "panel", Panel::ALL, Panel::name)? {
            state.panel = panel;
        }
        let compare = named(self.compare.as_ref(), "compare", Method::ALL, Method::name)?;
        state.compare = compare.or(state.compare);
        state.step.clone_from(&self.step);
        state.t = self.t;
        Ok(state)
    }

    fn set_numbers(&self, state: &mut State) -> Result<(), PageFault> {
        if self.set.is_empty() {
            return Ok(());
        }
        let mut numbers = Vec::new();
        for line in &self.set {
            let command = Command::parse(&format!("set {}", line.get_ref()));
            if let Command::Set(field, value) = command.map_err(|e| PageFault::at(line, e))? {
                numbers.push((field, value));
            }
        }
        let scene = field::set_all(&state.scene, state.selected(), &numbers);
        let refused = |e| PageFault::at(&self.set[0], format!("set: {e}"));
        state.scene = Arc::new(scene.map_err(refused)?);
        Ok(())
    }

    fn target(&self, scene: &Scene) -> Result<Option<Target>, PageFault> {
        match (&self.pixel, &self.point) {
            (None, None) => Ok(None),
            (None, Some(point)) => Ok(Some(Target::Point(Vec3::from(*point.get_ref())))),
            (Some(_), Some(point)) => {
                let problem = "point: found beside pixel, expected only one of the two";
                Err(PageFault::at(point, problem))
            }
            (Some(pixel), None) => {
                let [x, y] = *pixel.get_ref();
                match scene.pixels {
                    Some(Size { width, height }) if x < width && y < height => {
                        Ok(Some(Target::Pixel(x, y)))
                    }
                    Some(size) => Err(PageFault::at(
                        pixel,
                        format!("pixel: found [{x}, {y}], expected one of {size}, from [0, 0]"),
                    )),
                    None => Err(PageFault::at(
                        pixel,
                        "pixel: the picture of this scene fills its room, expected a point, [x, y, z]",
                    )),
                }
            }
        }
    }
}

impl State {
    /// How a chapter begins where its first page says nothing else.
    fn first(scene: Scene, source: Option<Source>) -> Self {
        Self {
            scene: Arc::new(scene),
            source,
            sphere: None,
            target: Target::Center,
            method: Method::default(),
            view: View::default(),
            style: None,
            panel: Panel::default(),
            compare: None,
            step: None,
            t: None,
            predict: false,
            board: false,
        }
    }

    /// The same look at another scene, from its centre.
    fn in_scene(&self, scene: Scene, source: Option<Source>) -> Self {
        Self {
            scene: Arc::new(scene),
            source,
            sphere: None,
            target: Target::Center,
            ..self.clone()
        }
    }

    /// The sphere that is selected: the one named, else the first.
    pub(crate) fn selected(&self) -> Option<usize> {
        self.sphere.or((!self.scene.bodies.is_empty()).then_some(0))
    }
}

/// A scene by what a page says of it: the text of a scene file, a built-in name, or a file.
fn open_scene(
    word: &Spanned<String>,
    folder: Option<&Path>,
) -> Result<(Scene, Option<Source>), PageFault> {
    let text = word.get_ref();
    let refused = |e: FileError| {
        let place = e
            .position
            .map_or(String::new(), |p| format!(", line {} of it", p.line));
        PageFault::at(word, format!("scene{place}: {}", e.problem))
    };
    if text.contains('\n') {
        return Ok((Scene::parse(text, "the tour").map_err(refused)?, None));
    }
    if let Some(builtin) = Builtin::by_name(text) {
        return Ok((builtin.scene(), Some(Source::Builtin(builtin))));
    }
    let file = folder.map_or_else(|| text.into(), |folder| folder.join(text));
    let (scene, source) = Scene::open(&file).map_err(refused)?;
    Ok((scene, Some(source)))
}

fn named<T: Copy>(
    word: Option<&Spanned<String>>,
    what: &str,
    all: impl IntoIterator<Item = T>,
    name: impl Fn(T) -> &'static str,
) -> Result<Option<T>, PageFault> {
    word.map(|word| {
        choice(word.get_ref(), what, all, name).map_err(|problem| PageFault::at(word, problem))
    })
    .transpose()
}

/// The paragraphs of what a page says, in which nothing may steer a terminal.
fn prose(text: &Spanned<String>, key: &str) -> Result<Vec<String>, PageFault> {
    match value::prose(text.get_ref()) {
        Ok(prose) => Ok(paragraphs(prose)),
        Err(refused) => Err(PageFault::at(text, format!("{key}: {refused}"))),
    }
}

/// The paragraphs of a text, each in one line; blank lines part them.
fn paragraphs(text: &str) -> Vec<String> {
    let mut out = Vec::new();
    let mut words: Vec<&str> = Vec::new();
    for line in text.lines().chain([""]) {
        if line.trim().is_empty() && !words.is_empty() {
            out.push(words.join(" "));
            words.clear();
        }
        words.extend(line.split_whitespace());
    }
    out
}
