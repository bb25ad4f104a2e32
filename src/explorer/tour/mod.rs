//! Walking through the tour: its pages, the person's own work that waits meanwhile, and the box
//! under the picture that shows the text.
//!
//! ```text
//! ── 3/13: the substitution, page 2/2 ──────────── f next  F back  r again ──
//!  What there is to know, in a few lines.
//!  Try: what there is to do.
//! ```

pub(crate) mod chapter;

use std::sync::Arc;

use ratatui::layout::Rect;
use ratatui::style::Style as CellStyle;
use unicode_width::UnicodeWidthStr;

use crate::explorer::action::Action;
use crate::explorer::arrival::{Arrival, Target};
use crate::explorer::dialog::Confirmation;
use crate::explorer::draw::layout;
use crate::explorer::draw::pen::Pen;
use crate::explorer::draw::theme::Theme;
use crate::explorer::edit::document::Change;
use crate::explorer::edit::motion::usual_step;
use crate::explorer::files::place::FilePlace;
use crate::explorer::link;
use crate::explorer::state::{Aside, Prediction, State, Work};
use crate::explorer::viewpoint::Viewpoint;
use crate::render::Style;
use crate::scene::Scene;
use crate::text::wrap;

pub use chapter::{Chapter, Page, Promise, builtin, find, load};

/// A page of some chapters.
#[derive(Debug, Clone)]
pub(crate) struct Bookmark {
    chapters: Arc<[Chapter]>,
    chapter: usize,
    page: usize,
}

/// The tour: the page that is open, and the one to come back to.
#[derive(Debug, Default)]
pub(crate) struct Tour {
    open: Option<OpenPage>,
    /// Where the person was when the tour was put away.
    put_away: Option<Bookmark>,
}

/// The page that is open.
#[derive(Debug)]
struct OpenPage {
    at: Bookmark,
    /// First line of the page's text that is shown.
    scroll: usize,
    /// The style that the person has chosen for pages that ask for none.
    own_style: Style,
}

impl Bookmark {
    /// Chapter and page by number and name.
    fn title(&self) -> Option<String> {
        let chapter = self.chapter()?;
        Some(format!(
            "{}/{}: {}, page {}/{}",
            self.chapter + 1,
            self.chapters.len(),
            chapter.title,
            self.page + 1,
            chapter.pages.len()
        ))
    }

    fn chapter(&self) -> Option<&Chapter> {
        self.chapters.get(self.chapter)
    }

    fn page(&self) -> Option<&Page> {
        self.chapter()?.pages.get(self.page)
    }

    /// The page after this one, which may begin the next chapter.
    fn next(&self) -> Option<Self> {
        let pages = self.chapter()?.pages.len();
        if self.page + 1 < pages {
            return Some(self.on_page(self.page + 1));
        }
        self.in_chapter(self.chapter + 1)
    }

    /// The page before this one, which may end the chapter before.
    fn previous(&self) -> Option<Self> {
        if self.page > 0 {
            return Some(self.on_page(self.page - 1));
        }
        let before = self.in_chapter(self.chapter.checked_sub(1)?)?;
        let last = before.chapter()?.pages.len().checked_sub(1)?;
        Some(before.on_page(last))
    }

    fn on_page(&self, page: usize) -> Self {
        Self {
            page,
            ..self.clone()
        }
    }

    fn in_chapter(&self, chapter: usize) -> Option<Self> {
        (chapter < self.chapters.len()).then(|| Self {
            chapter,
            page: 0,
            ..self.clone()
        })
    }
}

impl Tour {
    /// Does an action that is the tour's; false if it is not.
    pub(crate) fn act(&mut self, action: Action, state: &mut State) -> bool {
        match action {
            Action::TourForward => self.forward(state),
            Action::TourBack => self.back(state),
            Action::TourAgain => self.again(state),
            Action::TourNextChapter => self.next_chapter(state),
            Action::TourPreviousChapter => self.previous_chapter(state),
            Action::Tour => self.toggle(state),
            _ => return false,
        }
        true
    }

    /// Opens the tour of these chapters on a page, both counted from 0.
    pub(crate) fn start(
        &mut self,
        state: &mut State,
        chapters: Arc<[Chapter]>,
        chapter: usize,
        page: usize,
    ) {
        let at = Bookmark {
            chapters,
            chapter,
            page,
        };
        self.turn_to(state, at);
    }

    /// The command that opens this page, and the scene that it opens with.
    pub(crate) fn way_back(&self) -> Option<(Vec<String>, &Scene)> {
        let at = &self.open.as_ref()?.at;
        let chapter = at.chapter()?;
        let name = match &chapter.file {
            Some(file) => link::as_file(file.to_str()?),
            None => chapter.name.clone(),
        };
        let number = (at.page + 1).to_string();
        let words = ["tour".to_owned(), name, "--page".to_owned(), number];
        Some((words.into(), &at.page()?.setup.scene))
    }

    /// Opens the tour where the person left it, or puts it away.
    fn toggle(&mut self, state: &mut State) {
        if self.open.is_some() {
            self.leave(state);
            state.say("Your own scene is back. {tour} returns to the tour.");
        } else {
            self.visit(state, self.bookmark());
        }
    }

    fn forward(&mut self, state: &mut State) {
        let (shown, lines) = self.window(state);
        let Some(tour) = &mut self.open else {
            return self.toggle(state);
        };
        if tour.scroll + shown < lines {
            // The page does not fit: its rest comes before the next page.
            tour.scroll += shown.max(1);
            return;
        }
        match tour.at.next() {
            Some(at) => self.turn_to(state, at),
            None => state.say("This was the last page. {tour} brings your own scene back."),
        }
    }

    fn back(&mut self, state: &mut State) {
        let (shown, _) = self.window(state);
        let Some(tour) = &mut self.open else {
            return say_not_open(state);
        };
        if tour.scroll > 0 {
            tour.scroll = tour.scroll.saturating_sub(shown.max(1));
            return;
        }
        match tour.at.previous() {
            Some(at) => self.turn_to(state, at),
            None => state.say("This is the first page."),
        }
    }

    /// Sets everything as the page has it again.
    fn again(&mut self, state: &mut State) {
        match &self.open {
            Some(tour) => self.turn_to(state, tour.at.clone()),
            None => say_not_open(state),
        }
    }

    fn next_chapter(&mut self, state: &mut State) {
        let Some(tour) = &self.open else {
            return say_not_open(state);
        };
        match tour.at.in_chapter(tour.at.chapter + 1) {
            Some(at) => self.turn_to(state, at),
            None => state.say("This is the last chapter."),
        }
    }

    fn previous_chapter(&mut self, state: &mut State) {
        let Some(tour) = &self.open else {
            return say_not_open(state);
        };
        // From within a chapter, to its first page.
        let by = usize::from(tour.at.page == 0);
        let chapter = tour.at.chapter.checked_sub(by);
        match chapter.and_then(|chapter| tour.at.in_chapter(chapter)) {
            Some(at) => self.turn_to(state, at),
            None => state.say("This is the first page."),
        }
    }

    /// Opens the chapter of that name or number.
    pub(crate) fn open_chapter(&mut self, state: &mut State, word: &str) {
        let at = self.bookmark();
        let found = find(&at.chapters, word).and_then(|chapter| at.in_chapter(chapter));
        if let Some(at) = found {
            return self.visit(state, at);
        }
        let names: Vec<_> = at.chapters.iter().map(|c| c.name.as_str()).collect();
        state.warn(format!(
            "tour: found “{word}”, expected a chapter: 1 to {}, or {}",
            names.len(),
            names.join(", ")
        ));
    }

    /// Opens a page, counted from 1, of the chapter of that name or number, or says what is wrong.
    pub(crate) fn open_page(&mut self, state: &mut State, chapter: &str, page: usize) {
        let at = self.bookmark();
        let found = find(&at.chapters, chapter).and_then(|chapter| at.in_chapter(chapter));
        let pages = found
            .as_ref()
            .and_then(Bookmark::chapter)
            .map_or(0, |chapter| chapter.pages.len());
        match found {
            Some(at) if (1..=pages).contains(&page) => self.turn_to(state, at.on_page(page - 1)),
            Some(_) => state.warn(format!("--page {page}: expected a page from 1 to {pages}")),
            None => self.open_chapter(state, chapter),
        }
    }

    fn bookmark(&self) -> Bookmark {
        let open = self.open.as_ref().map(|tour| tour.at.clone());
        open.or_else(|| self.put_away.clone())
            .unwrap_or_else(|| Bookmark {
                chapters: builtin(),
                chapter: 0,
                page: 0,
            })
    }

    /// Turns to a page; asks first if the person's own scene has unsaved changes.
    fn visit(&mut self, state: &mut State, at: Bookmark) {
        self.put_away = Some(at.clone());
        if self.open.is_none() && state.work.document.is_changed() {
            state.ask(Confirmation::Tour);
        } else {
            self.turn_to(state, at);
        }
    }

    /// Opens the tour although there are unsaved changes: they wait.
    pub(crate) fn visit_unsaved(&mut self, state: &mut State) {
        self.turn_to(state, self.bookmark());
    }

    /// Shows a page and sets everything as it has it.
    fn turn_to(&mut self, state: &mut State, at: Bookmark) {
        let Some(setup) = at.page().map(|page| page.setup.clone()) else {
            return;
        };
        let scene = Scene::clone(&setup.scene);
        if let Some(tour) = &mut self.open {
            if tour.at.page().is_some_and(|page| !page.setup.has_style) {
                tour.own_style = state.at.style;
            }
            (tour.at, tour.scroll) = (at, 0);
            if state.work.document.is_changed() {
                state.say("{undo} brings back what you changed on the page before.");
            }
        } else {
            put_work_aside(state, &scene);
            self.open = Some(OpenPage {
                at,
                scroll: 0,
                own_style: state.at.style,
            });
        }
        // Numbers that differ from those of another page are no change that the person made.
        state.picture.forget();
        let work = &mut state.work;
        work.document.apply(Change::Scene(Box::new(scene.clone())));
        work.document.mark_saved();
        work.place = setup.source.as_ref().map_or(FilePlace::None, FilePlace::of);
        (work.stride, work.usual_stride) = (usual_step(&scene), usual_step(&scene));
        work.opened = scene;
        let own_style = self.open.as_ref().map(|tour| tour.own_style);
        let style = own_style.filter(|_| !setup.has_style);
        state.at = Viewpoint {
            style: style.unwrap_or(setup.at.style),
            cursor: state.at.cursor,
            size: state.at.size,
            shown: None,
            step: 0,
            ..setup.at
        };
        (state.probe, state.numbers_alone, state.scroll) = (None, false, 0);
        state.prediction = Prediction {
            on: setup.predict,
            ..Prediction::default()
        };
        state.board = setup.board;
        state.plane = setup.plane;
        state.arrival = Arrival {
            target: Some(setup.target),
            step: setup.step,
        };
    }

    /// Puts the tour away and the person's own work back as it was.
    pub(crate) fn leave(&mut self, state: &mut State) {
        state.plane = None;
        let (Some(tour), Some(aside)) = (self.open.take(), state.aside.take()) else {
            return;
        };
        self.put_away = Some(tour.at);
        state.picture.forget();
        let Aside { work, at, probe } = *aside;
        state.arrival = Arrival {
            target: Some(Target::PixelOf(at.cursor, at.size)),
            step: None,
        };
        (state.work, state.probe) = (work, probe);
        let cursor = state.at.cursor;
        state.at = Viewpoint { cursor, ..at };
        (state.board, state.prediction) = (false, Prediction::default());
        state.scroll = 0;
    }

    /// Which chapter and page are open, from 0.
    pub(crate) fn place(&self) -> Option<(usize, usize)> {
        let open = self.open.as_ref();
        open.map(|tour| (tour.at.chapter, tour.at.page))
    }

    /// The page as paragraphs, its title first; actions by name, or by key.
    pub(crate) fn text(&self, by_name: bool) -> Option<Vec<String>> {
        let at = &self.open.as_ref()?.at;
        let page = at.page()?;
        let attempt = page.says_to_try(by_name);
        let text = page.text.iter().cloned();
        Some(
            [at.title()?]
                .into_iter()
                .chain(text)
                .chain(attempt)
                .collect(),
        )
    }
}

fn say_not_open(state: &mut State) {
    state.say("The tour is not open. {tour-forward} opens it.");
}

/// Puts the person's own work aside, and begins to work on `scene`.
fn put_work_aside(state: &mut State, scene: &Scene) {
    let work = Work::of(scene.clone(), FilePlace::None);
    let at = Viewpoint {
        size: state.size(),
        ..state.at
    };
    state.aside = Some(Box::new(Aside {
        work: std::mem::replace(&mut state.work, work),
        at,
        probe: state.probe,
    }));
}

/// The most columns that a line of prose is pleasant to read in.
const LEGIBLE: usize = 96;
/// From this width on, what there is to do stands beside the text.
const TWO_COLUMNS: u16 = 130;
/// The rows of the box on a screen that has few.
const USUAL_ROWS: u16 = 6;
/// From this width on, lines are long enough for the usual rows.
const WIDE: u16 = 66;

/// A page's text in lines, in one column or two.
struct PageColumns {
    lines: Vec<Vec<(CellStyle, String)>>,
    width: u16,
}

impl PageColumns {
    fn of(page: &Page, width: u16) -> Self {
        let room = width.saturating_sub(2);
        let attempt = page.says_to_try(false);
        let plain = |text: &String, columns: usize| {
            let lines = wrap(text, columns).into_iter();
            lines
                .map(|line| (CellStyle::new(), line))
                .collect::<Vec<_>>()
        };
        let strong = |text: &String, columns: usize| {
            let lines = wrap(text, columns).into_iter();
            lines
                .map(|line| (Theme::strong(), line))
                .collect::<Vec<_>>()
        };
        if width >= TWO_COLUMNS && attempt.is_some() {
            let width = (room - GAP) / 2;
            let columns = LEGIBLE.min(width.into());
            let text = page.text.iter().flat_map(|p| plain(p, columns)).collect();
            let attempt = attempt.iter().flat_map(|p| strong(p, columns)).collect();
            return Self {
                lines: vec![text, attempt],
                width: width + GAP,
            };
        }
        let columns = LEGIBLE.min(room.into());
        let text = page.text.iter().flat_map(|p| plain(p, columns));
        let attempt = attempt.iter().flat_map(|p| strong(p, columns));
        Self {
            lines: vec![text.chain(attempt).collect()],
            width: room,
        }
    }

    fn height(&self) -> usize {
        self.lines.iter().map(Vec::len).max().unwrap_or(0)
    }
}

/// Between two columns.
const GAP: u16 = 4;

impl Tour {
    /// Rows of the box at the bottom of a screen of `area`: as many as the longest page of the
    /// chapter needs, as long as picture and panel stay useful. None where there is no room.
    pub(crate) fn rows(&self, area: Rect) -> u16 {
        let Some(chapter) = self.open.as_ref().and_then(|tour| tour.at.chapter()) else {
            return 0;
        };
        let pages = chapter.pages.iter();
        let longest = pages
            .map(|page| PageColumns::of(page, area.width).height())
            .max();
        let wanted = 1 + longest.unwrap_or(0) as u16;
        let most = if area.width >= WIDE {
            USUAL_ROWS.max(area.height / 4)
        } else {
            area.height / 3
        };
        let free = area.height.saturating_sub(layout::LEAST.1);
        let rows = wanted.min(most).min(free);
        if rows < 2 { 0 } else { rows }
    }

    /// How many lines of the page's text are shown at once, and how many it has.
    fn window(&self, state: &State) -> (usize, usize) {
        let (cols, rows) = state.screen;
        let shown = self.rows(Rect::new(0, 0, cols, rows)).saturating_sub(1);
        let page = self.open.as_ref().and_then(|tour| tour.at.page());
        let lines = page.map_or(0, |page| PageColumns::of(page, cols).height());
        // Without a box there is nothing to scroll.
        if shown == 0 {
            (lines, lines)
        } else {
            (shown.into(), lines)
        }
    }

    /// Draws the box under the picture.
    pub(crate) fn draw(&self, pen: &mut Pen<'_>, area: Rect) {
        let Some(tour) = self.open.as_ref().filter(|_| !area.is_empty()) else {
            return;
        };
        let Some(page) = tour.at.page() else {
            return;
        };
        let columns = PageColumns::of(page, area.width);
        let below = columns
            .height()
            .saturating_sub(tour.scroll + usize::from(area.height - 1));
        draw_rule(pen, area, &tour.at, below > 0);
        for (n, lines) in columns.lines.iter().enumerate() {
            let x = area.x + 1 + n as u16 * columns.width;
            let room = area.right().saturating_sub(x);
            for (y, (style, line)) in
                (area.y + 1..area.bottom()).zip(lines.iter().skip(tour.scroll))
            {
                pen.text(x, y, room, line, *style);
            }
        }
    }
}

/// The line that says where in the tour this is, and which keys lead on.
fn draw_rule(pen: &mut Pen<'_>, area: Rect, at: &Bookmark, more: bool) {
    let rule = "─".repeat(area.width.into());
    pen.text(area.x, area.y, area.width, &rule, Theme::border());
    let title = format!(" {} ", at.title().unwrap_or_default());
    let room = area.width.saturating_sub(4);
    let x = pen.text(area.x + 2, area.y, room, &title, Theme::strong());
    let next = if more { "f more" } else { "f next" };
    let away = "r again  ctrl-t leave";
    let keys = [
        format!(" {next}  F back  ctrl-n next chapter  {away} "),
        format!(" {next}  F back  {away} "),
        format!(" {next}  F back "),
        format!(" {next} "),
    ];
    let fits = |keys: &&String| x + keys.width() as u16 + 2 <= area.right();
    if let Some(keys) = keys.iter().find(fits) {
        let width = keys.width() as u16;
        let x = area.right() - width - 2;
        pen.text(x, area.y, width, keys, CellStyle::new());
    }
}
