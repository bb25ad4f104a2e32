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

use crate::explorer::arrival::{Arrival, Target};
use crate::explorer::draw::layout;
use crate::explorer::draw::pen::Pen;
use crate::explorer::draw::theme::Theme;
use crate::explorer::edit::document::{Change, Document};
use crate::explorer::files::rescue::Rescue;
use crate::explorer::files::saving::FilePlace;
use crate::explorer::link;
use crate::explorer::mode::{Mode, Question};
use crate::explorer::panel::Panel;
use crate::explorer::panel::steps::Prediction;
use crate::explorer::usual_step;
use crate::explorer::{Explorer, Options};
use crate::method::Method;
use crate::render::Style;
use crate::scene::{Scene, Size};
use crate::text::wrap;

pub use chapter::{Chapter, Page, builtin, find, load};

/// A page of some chapters.
#[derive(Debug, Clone)]
pub(crate) struct Bookmark {
    chapters: Arc<[Chapter]>,
    chapter: usize,
    page: usize,
}

/// The tour while it is open.
#[derive(Debug)]
pub(crate) struct Tour {
    at: Bookmark,
    /// First line of the page's text that is shown.
    scroll: usize,
    /// The style that the person has chosen for pages that ask for none.
    own_style: Style,
    /// What the person was at before.
    before: Before,
}

/// A person's own work, put aside whole.
#[derive(Debug)]
struct Before {
    document: Document,
    opened: Scene,
    place: FilePlace,
    options: Options,
    cursor: (u32, u32),
    /// The picture in which the cursor counts.
    size: Size,
    selected: Option<usize>,
    chosen: Option<usize>,
    probe: Option<usize>,
    step: f32,
    usual_step: f32,
    panel: Panel,
    step_at: usize,
    other_method: Option<Method>,
    scrubbed: Option<f64>,
    /// What is tried out in the tour is not kept when the terminal is lost.
    rescue: Option<Rescue>,
}

impl Bookmark {
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
    /// The command that opens this page, and the scene that it opens with.
    pub(crate) fn way_back(&self) -> Option<(Vec<String>, &Scene)> {
        let chapter = self.at.chapter()?;
        let name = match &chapter.file {
            Some(file) => link::as_file(file.to_str()?),
            None => chapter.name.clone(),
        };
        let number = (self.at.page + 1).to_string();
        let words = ["tour".to_owned(), name, "--page".to_owned(), number];
        Some((words.into(), &self.at.page()?.state.scene))
    }

    /// Whether the work that waits has changes that were not saved.
    pub(crate) fn hides_changes(&self) -> bool {
        self.before.document.is_changed()
    }
}

impl Explorer {
    /// Opens the tour of these chapters on a page, both counted from 0.
    pub fn start_tour(&mut self, chapters: Arc<[Chapter]>, chapter: usize, page: usize) {
        self.turn_to(Bookmark {
            chapters,
            chapter,
            page,
        });
    }

    /// Opens the tour where the person left it, or puts it away.
    pub(crate) fn toggle_tour(&mut self) {
        if self.tour.is_some() {
            self.leave_tour();
            self.say("Your own scene is back. ctrl-t returns to the tour.");
        } else {
            let at = self.bookmark();
            self.visit(at);
        }
    }

    pub(crate) fn tour_forward(&mut self) {
        if self.tour.is_none() {
            return self.toggle_tour();
        }
        let (shown, lines) = self.tour_window();
        let Some(tour) = &mut self.tour else { return };
        if tour.scroll + shown < lines {
            // The page does not fit: its rest comes before the next page.
            tour.scroll += shown.max(1);
            return;
        }
        match tour.at.next() {
            Some(at) => self.turn_to(at),
            None => self.say("This was the last page. ctrl-t brings your own scene back."),
        }
    }

    pub(crate) fn tour_back(&mut self) {
        let (shown, _) = self.tour_window();
        let Some(tour) = &mut self.tour else {
            return self.say_no_tour();
        };
        if tour.scroll > 0 {
            tour.scroll = tour.scroll.saturating_sub(shown.max(1));
            return;
        }
        match tour.at.previous() {
            Some(at) => self.turn_to(at),
            None => self.say("This is the first page."),
        }
    }

    /// Sets everything as the page has it again.
    pub(crate) fn tour_again(&mut self) {
        match &self.tour {
            Some(tour) => self.turn_to(tour.at.clone()),
            None => self.say_no_tour(),
        }
    }

    pub(crate) fn tour_next_chapter(&mut self) {
        let Some(tour) = &self.tour else {
            return self.say_no_tour();
        };
        match tour.at.in_chapter(tour.at.chapter + 1) {
            Some(at) => self.turn_to(at),
            None => self.say("This is the last chapter."),
        }
    }

    pub(crate) fn tour_previous_chapter(&mut self) {
        let Some(tour) = &self.tour else {
            return self.say_no_tour();
        };
        // From within a chapter, to its first page.
        let by = usize::from(tour.at.page == 0);
        let chapter = tour.at.chapter.checked_sub(by);
        match chapter.and_then(|chapter| tour.at.in_chapter(chapter)) {
            Some(at) => self.turn_to(at),
            None => self.say("This is the first page."),
        }
    }

    /// Opens the chapter of that name or number.
    pub(crate) fn tour_to(&mut self, word: &str) {
        let at = self.bookmark();
        let found = find(&at.chapters, word).and_then(|chapter| at.in_chapter(chapter));
        if let Some(at) = found {
            return self.visit(at);
        }
        let names: Vec<_> = at.chapters.iter().map(|c| c.name.as_str()).collect();
        self.warn(format!(
            "tour: found “{word}”, expected a chapter: 1 to {}, or {}",
            names.len(),
            names.join(", ")
        ));
    }

    fn say_no_tour(&mut self) {
        self.say("The tour is not open. f opens it.");
    }

    pub(crate) fn bookmark(&self) -> Bookmark {
        let open = self.tour.as_ref().map(|t| t.at.clone());
        open.or_else(|| self.put_away.clone())
            .unwrap_or_else(|| Bookmark {
                chapters: builtin(),
                chapter: 0,
                page: 0,
            })
    }

    /// Turns to a page; asks first if the person's own scene has unsaved changes.
    fn visit(&mut self, at: Bookmark) {
        self.put_away = Some(at.clone());
        if self.tour.is_none() && self.document.is_changed() {
            self.mode = Mode::Ask(Question::Tour);
        } else {
            self.turn_to(at);
        }
    }

    /// Opens the tour although there are unsaved changes: they wait.
    pub(crate) fn visit_unsaved(&mut self) {
        let at = self.bookmark();
        self.turn_to(at);
    }

    /// Shows a page and sets everything as it has it.
    fn turn_to(&mut self, at: Bookmark) {
        let Some(state) = at.page().map(|page| page.state.clone()) else {
            return;
        };
        if let Some(tour) = &mut self.tour {
            let asked = tour.at.page().and_then(|page| page.state.style);
            if asked.is_none() {
                tour.own_style = self.options.style;
            }
            (tour.at, tour.scroll) = (at, 0);
            if self.document.is_changed() {
                self.say("u brings back what you changed on the page before.");
            }
        } else {
            let before = self.put_work_aside(&state.scene);
            self.tour = Some(Tour {
                at,
                scroll: 0,
                own_style: self.options.style,
                before,
            });
        }
        // Numbers that differ from those of another page are no change that the person made.
        self.picture.forget();
        let scene = Scene::clone(&state.scene);
        self.document.apply(Change::Scene(Box::new(scene.clone())));
        self.document.mark_saved();
        self.place = state.source.as_ref().map_or(FilePlace::None, FilePlace::of);
        (self.step, self.usual_step) = (usual_step(&scene), usual_step(&scene));
        self.opened = scene;
        self.selected = state.selected();
        (self.chosen, self.probe) = (None, None);
        self.options.method = state.method;
        self.options.view = state.view;
        let own_style = self.tour.as_ref().map(|t| t.own_style);
        self.options.style = state.style.or(own_style).unwrap_or(self.options.style);
        (self.panel, self.numbers_alone) = (state.panel, false);
        self.other_method = state.compare;
        self.scrubbed = state.t;
        self.prediction = Prediction {
            on: state.predict,
            ..Prediction::default()
        };
        self.board = state.board;
        (self.scroll, self.step_at) = (0, 0);
        self.arrival = Arrival {
            target: Some(state.target),
            step: state.step,
        };
    }

    /// Takes the person's own work off the table, for `scene`.
    fn put_work_aside(&mut self, scene: &Scene) -> Before {
        let document = Document::new(scene.clone());
        Before {
            document: std::mem::replace(&mut self.document, document),
            opened: std::mem::replace(&mut self.opened, scene.clone()),
            place: std::mem::replace(&mut self.place, FilePlace::None),
            options: self.options,
            cursor: self.cursor,
            size: self.size(),
            selected: self.selected,
            chosen: self.chosen,
            probe: self.probe,
            step: self.step,
            usual_step: self.usual_step,
            panel: self.panel,
            step_at: self.step_at,
            other_method: self.other_method,
            scrubbed: self.scrubbed,
            rescue: self.rescue.take(),
        }
    }

    /// Puts the tour away and the person's own work back as it was.
    pub(crate) fn leave_tour(&mut self) {
        let Some(Tour { at, before, .. }) = self.tour.take() else {
            return;
        };
        self.put_away = Some(at);
        self.picture.forget();
        self.arrival = Arrival {
            target: Some(Target::PixelOf(before.cursor, before.size)),
            step: None,
        };
        self.document = before.document;
        self.opened = before.opened;
        self.place = before.place;
        self.options.method = before.options.method;
        self.options.view = before.options.view;
        self.options.style = before.options.style;
        (self.selected, self.chosen) = (before.selected, before.chosen);
        self.probe = before.probe;
        (self.step, self.usual_step) = (before.step, before.usual_step);
        (self.panel, self.step_at) = (before.panel, before.step_at);
        self.other_method = before.other_method;
        self.scrubbed = before.scrubbed;
        self.rescue = before.rescue;
        (self.board, self.prediction) = (false, Prediction::default());
        self.scroll = 0;
    }
}

impl Explorer {
    /// Which chapter and page of the tour are open, from 0.
    pub(crate) fn tour_place(&self) -> Option<(usize, usize)> {
        self.tour.as_ref().map(|t| (t.at.chapter, t.at.page))
    }

    /// The page of the tour as paragraphs, its title first.
    pub(crate) fn tour_text(&self) -> Option<Vec<String>> {
        let at = &self.tour.as_ref()?.at;
        let (chapter, page) = (at.chapter()?, at.page()?);
        let title = format!(
            "{}/{}: {}, page {}/{}",
            at.chapter + 1,
            at.chapters.len(),
            chapter.title,
            at.page + 1,
            chapter.pages.len()
        );
        let attempt = page.attempt.as_ref().map(|text| format!("Try: {text}"));
        let text = page.text.iter().cloned();
        Some([title].into_iter().chain(text).chain(attempt).collect())
    }
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
struct Columns {
    lines: Vec<Vec<(CellStyle, String)>>,
    width: u16,
}

impl Columns {
    fn of(page: &Page, width: u16) -> Self {
        let room = width.saturating_sub(2);
        let attempt = page.attempt.as_ref().map(|text| format!("Try: {text}"));
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

impl Explorer {
    /// Rows of the box at the bottom of a screen of `area`: as many as the longest page of the
    /// chapter needs, as long as picture and panel stay useful. None where there is no room.
    pub(crate) fn tour_rows(&self, area: Rect) -> u16 {
        let Some(chapter) = self.tour.as_ref().and_then(|t| t.at.chapter()) else {
            return 0;
        };
        let pages = chapter.pages.iter();
        let longest = pages
            .map(|page| Columns::of(page, area.width).height())
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
    fn tour_window(&self) -> (usize, usize) {
        let (cols, rows) = self.screen;
        let shown = self
            .tour_rows(Rect::new(0, 0, cols, rows))
            .saturating_sub(1);
        let page = self.tour.as_ref().and_then(|t| t.at.page());
        let lines = page.map_or(0, |page| Columns::of(page, cols).height());
        // Without a box there is nothing to scroll.
        if shown == 0 {
            (lines, lines)
        } else {
            (shown.into(), lines)
        }
    }

    /// The box under the picture.
    pub(crate) fn draw_tour(&self, pen: &mut Pen<'_>, area: Rect) {
        let Some((tour, chapter)) = self.tour.as_ref().and_then(|t| Some((t, t.at.chapter()?)))
        else {
            return;
        };
        let Some(page) = tour.at.page().filter(|_| !area.is_empty()) else {
            return;
        };
        let columns = Columns::of(page, area.width);
        let below = columns
            .height()
            .saturating_sub(tour.scroll + usize::from(area.height - 1));
        Self::draw_rule(pen, area, tour, chapter, below > 0);
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

    /// The line that says where in the tour this is, and which keys lead on.
    fn draw_rule(pen: &mut Pen<'_>, area: Rect, tour: &Tour, chapter: &Chapter, more: bool) {
        let rule = "─".repeat(area.width.into());
        pen.text(area.x, area.y, area.width, &rule, Theme::border());
        let Bookmark {
            chapters,
            chapter: number,
            page,
        } = &tour.at;
        let title = format!(
            " {}/{}: {}, page {}/{} ",
            number + 1,
            chapters.len(),
            chapter.title,
            page + 1,
            chapter.pages.len(),
        );
        let x = pen.text(
            area.x + 2,
            area.y,
            area.width.saturating_sub(4),
            &title,
            Theme::strong(),
        );
        let next = if more { "f more" } else { "f next" };
        let away = "r again  ctrl-t leave";
        for keys in [
            format!(" {next}  F back  ctrl-n next chapter  {away} "),
            format!(" {next}  F back  {away} "),
            format!(" {next}  F back "),
            format!(" {next} "),
        ] {
            let width = keys.width() as u16;
            if x + width + 2 <= area.right() {
                pen.text(
                    area.right() - width - 2,
                    area.y,
                    width,
                    &keys,
                    CellStyle::new(),
                );
                break;
            }
        }
    }
}
