//! The tour as data: chapters of pages, each a short text and the setup that it speaks of.
//!
//! A chapter is a TOML file; those of the tour that comes with the program lie in the folder beside
//! this one; `docs/tour.md` says how to write one. How the explorer walks through them is in
//! `tour`.

use std::fs;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::Vec3;
use serde::Deserialize;
use toml::Spanned;

use crate::door::{Expected, FileError, TextPosition};
use crate::explain::PlaneLine;
use crate::explorer::action::Action;
use crate::explorer::arrival::Target;
use crate::explorer::edit::field;
use crate::explorer::key::Key;
use crate::explorer::setting::{self, Setting, SettingRow};
use crate::explorer::viewpoint::Viewpoint;
use crate::method::Method;
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
    /// What there is to do; an action is named in braces, as in `{tangent}`.
    pub attempt: Option<String>,
    /// What that shows, one after the other; tests hold the page to it.
    pub promises: Vec<Promise>,
    pub(crate) setup: Setup,
}

/// What somebody who tries what a page says does, and then sees.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Promise {
    /// Keys, parted by spaces; or a command, from its colon on.
    pub keys: String,
    /// A text that is on a screen of 80 × 24 afterwards.
    pub shows: String,
}

/// The state of the explorer that a page speaks of.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Setup {
    /// The scene, with the page's own numbers in it.
    pub(crate) scene: Arc<Scene>,
    /// Where the scene came from; none if it is written in the chapter.
    pub(crate) source: Option<Source>,
    pub(crate) target: Target,
    /// How it is looked at; the cursor is put on the target.
    pub(crate) at: Viewpoint,
    /// Whether the style is the page's own, or as the person has it.
    pub(crate) has_style: bool,
    /// The step of the derivation, by name or number.
    pub(crate) step: Option<String>,
    pub(crate) predict: bool,
    pub(crate) board: bool,
    /// The line that is drawn with a circle in the picture's place.
    pub(crate) plane: Option<PlaneLine>,
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
    #[cfg(feature = "routine")]
    (
        "13-your-turn.toml",
        include_str!("chapters/13-your-turn.toml"),
    ),
    (
        "14-what-exact-costs.toml",
        include_str!("chapters/14-what-exact-costs.toml"),
    ),
];

/// The routines that their pages name.
const ROUTINES: &[(&str, &str)] = &[("mine.glsl", include_str!("chapters/mine.glsl"))];

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
            let before = pages.last().map(|p| &p.setup);
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
/// `predict`, `board` and `plane`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PageFile {
    text: Spanned<String>,
    r#try: Option<Spanned<String>>,
    /// Keys, and what they show.
    #[serde(default)]
    promise: Vec<Spanned<(String, String)>>,
    scene: Option<Spanned<String>>,
    /// Numbers of the scene, as after `:set`.
    #[serde(default)]
    set: Vec<Spanned<String>>,
    /// The sphere that is selected, from 1.
    sphere: Option<Spanned<usize>>,
    pixel: Option<Spanned<[u32; 2]>>,
    point: Option<Spanned<[f32; 3]>>,
    method: Option<Spanned<String>>,
    lens: Option<Spanned<String>>,
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
    #[serde(default)]
    plane: bool,
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
    fn into_page(self, before: Option<&Setup>, folder: Option<&Path>) -> Result<Page, PageFault> {
        let setup = self.setup(before, folder)?;
        let text = prose(&self.text, "text")?;
        if text.is_empty() {
            return Err(PageFault::at(
                &self.text,
                "text: found nothing, expected a sentence",
            ));
        }
        let attempt = self.r#try.as_ref().map(|t| prose(t, "try")).transpose()?;
        let promises = self.promise.into_iter().map(promise);
        Ok(Page {
            text,
            attempt: attempt.map(|paragraphs| paragraphs.join(" ")),
            promises: promises.collect::<Result<_, _>>()?,
            setup,
        })
    }

    fn setup(&self, before: Option<&Setup>, folder: Option<&Path>) -> Result<Setup, PageFault> {
        let mut setup = match (&self.scene, before) {
            (Some(scene), _) => {
                let (scene, source) = open_scene(scene, folder)?;
                match before {
                    Some(before) => before.in_scene(scene, source),
                    None => Setup::first(scene, source),
                }
            }
            (None, Some(before)) => before.clone(),
            (None, None) => {
                let problem = "scene: missing, expected one on the first page";
                return Err(PageFault::at(&self.text, problem));
            }
        };
        (setup.predict, setup.board) = (self.predict, self.board);
        setup.plane = self.plane.then_some(PlaneLine::TUTORIAL);
        if let Some(number) = &self.sphere {
            let count = setup.scene.bodies.len();
            let at = number.get_ref().wrapping_sub(1);
            if at >= count {
                let problem = format!(
                    "sphere: found {}, expected 1 to {count}",
                    at.wrapping_add(1)
                );
                return Err(PageFault::at(number, problem));
            }
            setup.at.sphere = Some(at);
        }
        self.set_numbers(&mut setup)?;
        if let Some(target) = self.target(&setup.scene)? {
            setup.target = target;
        }
        let named = [
            ("method", &self.method),
            ("lens", &self.lens),
            ("view", &self.view),
            ("style", &self.style),
            ("panel", &self.panel),
            ("compare", &self.compare),
        ];
        for (name, word) in named {
            if let Some(word) = word {
                let setting = read_setting(name, word, word.get_ref())?;
                setup.at.put(&with_routine(setting, word, folder)?);
            }
        }
        setup.has_style |= self.style.is_some();
        setup.step.clone_from(&self.step);
        setup.at.t = self.t;
        Ok(setup)
    }

    fn set_numbers(&self, setup: &mut Setup) -> Result<(), PageFault> {
        let Some(first) = self.set.first() else {
            return Ok(());
        };
        let mut numbers = Vec::new();
        for line in &self.set {
            if let Setting::Set(field, value) = read_setting("set", line, line.get_ref())? {
                numbers.push((field, value));
            }
        }
        let scene = field::set_all(&setup.scene, setup.at.sphere, &numbers);
        let refused = |e| PageFault::at(first, format!("set: {e}"));
        setup.scene = Arc::new(scene.map_err(refused)?);
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

impl Page {
    /// What there is to do, if there is something: with keys, or with the names of actions.
    pub fn says_to_try(&self, by_name: bool) -> Option<String> {
        let attempt = self.attempt.as_ref()?;
        Some(format!("Try: {}", Action::spell(attempt, by_name)))
    }
}

impl Setup {
    /// How a chapter begins where its first page says nothing else.
    fn first(scene: Scene, source: Option<Source>) -> Self {
        let size = scene.pixels.unwrap_or(Size::new(1, 1));
        Self {
            at: Viewpoint::of(&scene, size),
            scene: Arc::new(scene),
            source,
            target: Target::Center,
            has_style: false,
            step: None,
            predict: false,
            board: false,
            plane: None,
        }
    }

    /// The same look at another scene, from its centre.
    fn in_scene(&self, scene: Scene, source: Option<Source>) -> Self {
        let first = Self::first(scene, source);
        Self {
            at: Viewpoint {
                sphere: first.at.sphere,
                ..self.at
            },
            has_style: self.has_style,
            ..first
        }
    }
}

/// A setting that a page names.
fn read_setting<T>(name: &str, place: &Spanned<T>, text: &str) -> Result<Setting, PageFault> {
    let row = SettingRow::by_name(name);
    let setting = row.map(|row| setting::parse(row, text));
    let setting = setting.unwrap_or_else(|| Err(format!("{name}: expected a setting")));
    setting.map_err(|problem| PageFault::at(place, problem))
}

/// A method that is a routine's file, which lies in `folder` or came with the program, as the routine itself.
fn with_routine(
    setting: Setting,
    place: &Spanned<String>,
    folder: Option<&Path>,
) -> Result<Setting, PageFault> {
    let Setting::Routine { name, beside } = setting else {
        return Ok(setting);
    };
    let text = ROUTINES.iter().find(|(known, _)| *known == name);
    let method = match (folder, text) {
        (None, Some((_, text))) => Method::with_text(&name, text),
        (folder, _) => Method::load(&name, &folder.unwrap_or(Path::new("")).join(&name)),
    };
    match method {
        Ok(method) if beside => Ok(Setting::Compare(method)),
        Ok(method) => Ok(Setting::Method(method)),
        Err(error) => Err(PageFault::at(place, format!("method: {error}"))),
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

/// The paragraphs of what a page says, in which nothing may steer a terminal.
fn prose(text: &Spanned<String>, key: &str) -> Result<Vec<String>, PageFault> {
    match value::prose(text.get_ref()) {
        Ok(prose) => Ok(paragraphs(prose)),
        Err(refused) => Err(PageFault::at(text, format!("{key}: {refused}"))),
    }
}

/// Keys that there are, and what they show.
fn promise(written: Spanned<(String, String)>) -> Result<Promise, PageFault> {
    let (keys, _) = written.get_ref();
    let mut unknown = keys.split_whitespace().filter(|k| Key::parse(k).is_none());
    match unknown.next() {
        Some(word) if !keys.starts_with(':') => Err(PageFault::at(
            &written,
            format!(
                "promise: found “{word}”, expected keys such as “right shift-up enter”, or a command such as “:method exact”"
            ),
        )),
        _ => {
            let (keys, shows) = written.into_inner();
            Ok(Promise { keys, shows })
        }
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
