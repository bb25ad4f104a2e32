//! The explorer put together: events go to the mode on top or become actions, actions and commands
//! go to the part that they belong to, and all parts are drawn.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use ratatui::buffer::Buffer;
use ratatui::crossterm::event::{Event, KeyEventKind, MouseButton, MouseEvent, MouseEventKind};
use ratatui::layout::{Position, Rect};

use crate::explain::Reading;
use crate::explorer::action::{Action, Group};
use crate::explorer::command::Command;
use crate::explorer::dialog::{Confirmation, Dialog, Purpose};
use crate::explorer::draw::layout::{Layout, USUAL};
use crate::explorer::draw::pen::Pen;
use crate::explorer::draw::screen::WholeScreen;
use crate::explorer::draw::theme::Theme;
use crate::explorer::edit::{camera, history, spheres};
use crate::explorer::files::disk::Over;
use crate::explorer::files::place::FilePlace;
use crate::explorer::files::workplace::Workplace;
use crate::explorer::files::{keep, remembered, saving};
use crate::explorer::key::Key;
use crate::explorer::link::{self, Link, LinkPlace};
use crate::explorer::mode::overlay::After;
use crate::explorer::mode::{Mode, export_case};
use crate::explorer::options::{Options, Request};
use crate::explorer::own_routine::OpenText;
use crate::explorer::panel::all::Panels;
use crate::explorer::panel::dial::DialPanel;
use crate::explorer::routines::{self, Watch};
use crate::explorer::set;
use crate::explorer::setting::Setting;
use crate::explorer::state::{State, Work};
use crate::explorer::tour::{Chapter, Tour};
use crate::explorer::viewpoint::Viewpoint;
use crate::explorer::{cursor, look, prepare, typing, walk};
use crate::render::Allowance;
use crate::scene::{Scene, Source};
use crate::system::Waker;

/// The explorer of one person.
#[derive(Debug)]
pub struct Explorer {
    pub(crate) state: State,
    pub(crate) panels: Panels,
    pub(crate) tour: Tour,
    /// What is open over the screen; the last hears the keys first.
    pub(crate) modes: Vec<Mode>,
    /// Who looks at the files of one's own routines.
    pub(crate) watch: Watch,
}

/// The parts that do actions on the state alone.
const PARTS: [fn(Action, &mut State) -> bool; 6] = [
    cursor::act,
    camera::act,
    spheres::act,
    look::act,
    history::act,
    saving::act,
];

/// How many lines a turn of the mouse's wheel scrolls.
const WHEEL: isize = 3;

// What there is to know of it from outside.
impl Explorer {
    /// An explorer of a scene that has just been opened.
    pub fn new(scene: Scene, source: &Source, options: Options) -> Self {
        let work = Work::of(scene, FilePlace::of(source));
        Self {
            state: State::new(work, options),
            panels: Panels::default(),
            tour: Tour::default(),
            modes: Vec::new(),
            watch: Watch::default(),
        }
    }

    /// The scene as it is now.
    pub const fn scene(&self) -> &Scene {
        self.state.scene()
    }

    /// Where the person looks.
    pub const fn viewpoint(&self) -> &Viewpoint {
        &self.state.at
    }

    /// The pixel under the cursor.
    pub const fn cursor(&self) -> (u32, u32) {
        self.state.at.cursor
    }

    /// What the ray under the cursor found, as of the last [`Explorer::prepare`].
    pub const fn reading(&self) -> Option<&Reading> {
        self.state.reading()
    }

    /// The exit status, once the person has left.
    pub const fn ended(&self) -> Option<u8> {
        self.state.ended
    }

    /// Whether there are changes that were not saved, also behind the tour.
    pub fn is_changed(&self) -> bool {
        self.state.is_changed()
    }

    /// Whether the person wants to use the mouse here rather than to select text.
    pub const fn wants_mouse(&self) -> bool {
        self.state.mouse
    }

    /// How the screen is drawn now.
    pub const fn options(&self) -> Options {
        self.state.options
    }

    /// Whether a thread is at work whose result is to come.
    pub fn is_measuring(&self) -> bool {
        self.panels.error.is_running()
    }

    /// The words after `rayscope` that reopen this view, or why there are none.
    pub fn link(&self) -> Result<Vec<String>, String> {
        link::link(&self.state, self.tour.way_back())
    }
}

// What the loop that runs it does with it.
impl Explorer {
    /// Lets an event change the state; false if nothing on the screen can have changed.
    pub fn update(&mut self, event: &Event) -> bool {
        let is_seen = self.take(event);
        keep::note_changes(&mut self.state, &self.panels.error.waker);
        self.watch
            .over(&self.state.routines, &self.panels.error.waker);
        is_seen
    }

    fn take(&mut self, event: &Event) -> bool {
        match event {
            Event::Key(event) if event.kind != KeyEventKind::Release => {
                self.state.message = None;
                self.press(Key::of(*event));
                true
            }
            Event::Paste(text) => {
                self.paste(text);
                true
            }
            Event::Mouse(event) => self.point(*event),
            Event::Resize(..) => true,
            _ => false,
        }
    }

    /// Lets an event change the state that came before the terminal had shown what was drawn last: it
    /// is no answer by which something would be lost.
    pub fn update_typed_ahead(&mut self, event: &Event) -> bool {
        self.note_question_shown(false);
        self.update(event)
    }

    /// Brings picture and panels up to date for a screen of this many columns and rows, which is
    /// drawn next.
    pub fn prepare(&mut self, cols: u16, rows: u16) {
        self.arrange(cols, rows);
        self.work(&mut Allowance::endless());
        self.note_question_shown(true);
    }

    /// As [`Explorer::prepare`], but only for so long with the picture and what depends on all of it, a
    /// while for each: what takes longer comes in coarse, and is gone on with by the next call. Whether
    /// all is done.
    pub fn prepare_within(&mut self, cols: u16, rows: u16, slice: Duration) -> bool {
        self.arrange(cols, rows);
        let is_new = self.state.picture.is_begun_anew();
        let mut is_done = self.work(&mut Allowance::until(Instant::now() + slice));
        // There is a sketch to show, at least, of what does not come at once.
        if is_new && !is_done {
            is_done = self.work(&mut Allowance::until(Instant::now() + slice));
        }
        self.note_question_shown(true);
        is_done
    }

    /// Goes on with what was begun while the allowance lasts; whether it is done.
    fn work(&mut self, allowance: &mut Allowance) -> bool {
        while !prepare::go_on(&mut self.state, allowance) {
            if allowance.is_used_up() {
                return false;
            }
        }
        self.panels.go_on(&self.state, allowance)
    }

    fn note_question_shown(&mut self, is_shown: bool) {
        if let Some(Mode::Asking(asking)) = self.modes.last_mut() {
            asking.is_shown = is_shown;
        }
    }

    /// Lays the screen out, begins the picture and takes the reading.
    fn arrange(&mut self, cols: u16, rows: u16) {
        self.state.screen = (cols, rows);
        self.state.layout = self.layout(Rect::new(0, 0, cols, rows));
        prepare::arrange(&mut self.state);
    }

    /// Draws everything; where the terminal's own cursor belongs comes back.
    ///
    /// [`Explorer::prepare`] must have been called for the size of the buffer.
    pub fn draw(&self, buffer: &mut Buffer) -> Option<Position> {
        let area = buffer.area;
        let Options {
            glyphs,
            palette,
            depth,
            ..
        } = self.state.options;
        let mut pen = Pen {
            buffer,
            glyphs,
            theme: Theme::new(palette, depth),
        };
        let screen = WholeScreen {
            state: &self.state,
            panels: &self.panels,
            tour: &self.tour,
            mode: self.modes.last().map(Mode::layer),
        };
        let cursor = screen.draw(&mut pen, area, self.layout(area));
        pen.theme.finish(pen.buffer);
        cursor
    }

    /// What the person has asked of the loop that runs the explorer.
    pub fn take_request(&mut self) -> Option<Request> {
        self.state.request.take()
    }

    /// Shows a sentence until the next key.
    pub fn tell(&mut self, sentence: &str) {
        self.state.say(sentence);
    }

    /// Takes the colours for the ground that the terminal says it has; false if others were chosen.
    pub fn set_ground(&mut self, is_light: bool) -> bool {
        look::set_ground(&mut self.state, is_light)
    }

    /// Notes how many bytes a frame took, for the plan.
    pub fn note_sent(&mut self, bytes: usize) {
        let bytes = bytes as u64;
        let most = self.state.sent.map_or(0, |[_, most]| most);
        self.state.sent = Some([bytes, most.max(bytes)]);
    }

    /// Draws the picture with two shades from now on, or with all there are again.
    pub const fn set_coarse(&mut self, coarse: bool) {
        self.state.coarse = coarse;
    }

    /// Has the explorer ring `waker` when something comes in that [`Explorer::catch_up`] takes.
    pub fn wake_by(&mut self, waker: Waker) {
        self.panels.error.waker = waker;
        self.watch
            .over(&self.state.routines, &self.panels.error.waker);
    }

    /// Takes what threads have finished; false if nothing on the screen can have changed.
    pub fn catch_up(&mut self) -> bool {
        let is_said = keep::write_down_if_due(&mut self.state, &self.panels.error.waker);
        let is_read = routines::catch_up(&mut self.state);
        self.panels.error.catch_up(&mut self.state) || is_said || is_read
    }

    /// Draws by the routine in this file, which the person has edited.
    pub fn take_edited(&mut self, name: String) {
        let routine = Setting::Routine {
            name,
            beside: false,
        };
        set::set(&mut self.state, routine);
    }

    /// Calls a measurement off before this process stops.
    pub fn pause(&mut self) {
        self.panels.error.pause();
    }

    /// Works in that place: unsaved work is kept there if the terminal is lost, and what is there
    /// already for the scene from `source` is offered.
    pub fn work_in(&mut self, workplace: Workplace, source: &Source) {
        self.state.workplace = workplace;
        keep::keep(&mut self.state, source);
        self.open_dialog();
    }

    /// Finds files in that place from now on.
    #[must_use]
    pub fn finding_files_in(mut self, workplace: Workplace) -> Self {
        self.state.workplace = workplace;
        self
    }

    /// Works in that place on a tour, on top of a scene of which nothing is offered.
    pub fn tour_in(&mut self, workplace: Workplace) {
        self.state.workplace = workplace;
    }

    /// To be called when the explorer is over: where unsaved work was kept, if there was any that
    /// the person has not given up.
    pub fn finish(&mut self) -> Result<Option<PathBuf>, String> {
        self.tour.leave(&mut self.state);
        let kept_text = typing::keep(&self.state);
        remembered::remember(&self.state.workplace, &self.state.chosen);
        kept_text.and(keep::finish(&mut self.state))
    }
}

// Where it opens.
impl Explorer {
    /// Goes to a place in the scene that has been opened, or says in a sentence what is wrong.
    pub fn set_out(&mut self, settings: &[Setting]) -> Result<(), String> {
        set::set_out(&mut self.state, settings)
    }

    /// What is wrong with the place that [`Explorer::set_out`] was asked for, as far as only the
    /// picture of a usual screen can say.
    ///
    /// Meant for an explorer that is then thrown away: the cursor stays where that screen has it.
    pub fn rehearse(mut self) -> Result<(), String> {
        let (cols, rows) = USUAL;
        self.arrange(cols, rows);
        match self.state.message {
            Some(message) if message.warning => Err(message.text),
            _ => Ok(()),
        }
    }

    /// Opens the tour of these chapters on a page, both counted from 0.
    pub fn start_tour(&mut self, chapters: Arc<[Chapter]>, chapter: usize, page: usize) {
        self.tour.start(&mut self.state, chapters, chapter, page);
    }
}

// Events.
impl Explorer {
    pub(crate) fn press(&mut self, key: Key) {
        if key.is("ctrl-c") {
            return self.interrupt();
        }
        let Some(mut mode) = self.modes.pop() else {
            return self.press_plainly(key);
        };
        let after = mode.layer_mut().press(key, &mut self.state);
        self.go_on(mode, after);
    }

    /// Does what a mode wants done, and keeps it open if it is to stay.
    fn go_on(&mut self, mode: Mode, after: After) {
        match after {
            After::Stay => self.modes.push(mode),
            After::Close => {}
            After::Run(command) => {
                self.modes.push(mode);
                self.run(command);
            }
            After::Do(command) => self.run(command),
        }
        self.open_dialog();
    }

    /// A key while nothing is open: an answer to a prediction, or an action.
    fn press_plainly(&mut self, key: Key) {
        self.state.quits_once_saved = false;
        if walk::could_answer(&self.state, key) {
            self.refresh();
            if walk::answer_by_key(&mut self.state, key) {
                return;
            }
        }
        if let Some(action) = Action::bound_to(key) {
            self.act(action.as_with(&self.scene().camera));
        } else if key.is("esc") {
            self.state.picture.changed.fill(false);
        } else {
            self.state.say("This key does nothing. ? shows the keys.");
        }
    }

    /// Text that was pasted goes into a line being typed; it is never a burst of commands.
    fn paste(&mut self, text: &str) {
        let mode = self.modes.last_mut();
        let state = &mut self.state;
        if !mode.is_some_and(|mode| mode.layer_mut().paste(text, state)) {
            self.state
                .say("Pasted text does nothing here. Type : first to paste a command.");
        }
    }

    /// The mouse, where the person has asked for it: a click moves the cursor, the wheel zooms or
    /// scrolls. False if that changes nothing.
    fn point(&mut self, event: MouseEvent) -> bool {
        if !self.state.mouse {
            return false;
        }
        let wheel = match event.kind {
            MouseEventKind::ScrollUp => -1,
            MouseEventKind::ScrollDown => 1,
            MouseEventKind::Down(MouseButton::Left) => {
                self.refresh();
                return self.click(event.column, event.row);
            }
            _ => return false,
        };
        if let Some(mode) = self.modes.last_mut() {
            return mode.layer_mut().scroll(wheel * WHEEL, &self.state);
        }
        self.state.message = None;
        self.act(if wheel < 0 {
            Action::ZoomIn
        } else {
            Action::ZoomOut
        });
        true
    }

    fn click(&mut self, col: u16, row: u16) -> bool {
        let Some(mut mode) = self.modes.pop() else {
            return cursor::click(&mut self.state, col, row);
        };
        let at = Position::new(col, row);
        let after = mode.layer_mut().click(at, &self.state);
        self.go_on(mode, after);
        true
    }

    /// Opens what an action or a command has asked for.
    fn open_dialog(&mut self) {
        if let Some(dialog) = self.state.dialog.take() {
            self.modes.push(Mode::of(dialog));
        }
    }
}

// Actions and commands.
impl Explorer {
    /// Has the part that an action belongs to do it.
    pub(crate) fn act(&mut self, action: Action) {
        if acts_on_picture(action) {
            self.refresh();
        }
        if walk::holds_back(&mut self.state, action) {
            return;
        }
        let state = &mut self.state;
        let done = PARTS.iter().any(|act| act(action, state))
            || self.panels.act(action, state)
            || self.tour.act(action, state)
            || self.act_on_program(action);
        debug_assert!(done, "{action:?} belongs to no part");
        self.open_dialog();
    }

    fn act_on_program(&mut self, action: Action) -> bool {
        match action {
            Action::Menu => self.state.open(Dialog::Menu),
            Action::Help => self.state.open(Dialog::Help),
            Action::CommandLine => {
                let dialog = Dialog::Prompt(Purpose::Command, String::new());
                self.state.open(dialog);
            }
            Action::CopyCase => export_case::copy(&mut self.state, crate::lab::CaseForm::Row),
            Action::Link => link::pass_on(&mut self.state, self.tour.way_back()),
            Action::Suspend => {
                self.pause();
                self.state.request = Some(Request::Suspend);
            }
            Action::Quit => self.quit(),
            _ => return false,
        }
        true
    }

    pub(crate) fn run(&mut self, command: Command) {
        self.refresh();
        let state = &mut self.state;
        match command {
            Command::Do(action) => self.act(action),
            Command::QuitNow => state.ended = Some(0),
            Command::SaveAndQuit => {
                state.quits_once_saved = true;
                saving::save(state);
            }
            Command::Open(name) if state.is_worth_saving() => match saving::read(state, &name) {
                Ok(_) => state.ask(Confirmation::Open(name)),
                Err(sentence) => state.warn(sentence),
            },
            Command::Open(name) | Command::OpenNow(name) => self.open(&name),
            Command::Go(link) if state.is_worth_saving() && link.page().is_none() => {
                state.ask(Confirmation::Go(link));
            }
            Command::Go(link) | Command::GoNow(link) => self.follow(&link),
            Command::SaveAs(name) => saving::save_as_named(state, &name),
            Command::Overwrite(path) if is_of_text(state, &path) => {
                typing::save(state, true);
            }
            Command::Overwrite(path) => saving::write(state, &path, Over::Anything),
            Command::Recover(path) => keep::recover(state, &path),
            Command::Discard => keep::discard(state),
            Command::Set(setting) => set::set(state, setting),
            Command::Copy(form) => export_case::copy(state, form),
            Command::Append(name) => match state.workplace.reach(&name) {
                Ok(path) => export_case::append(state, &path),
                Err(sentence) => state.warn(sentence),
            },
            Command::Dial(dial, k) => self.panels.dial.dial_to(state, dial, k),
            Command::Tour(chapter) => self.tour.open_chapter(state, &chapter),
            Command::Routine(name) => typing::open(state, &name),
            Command::Edit(name) => typing::edit(state, &name),
            Command::CloseText { save } => {
                if typing::close(state, save) {
                    self.modes.retain(|mode| !matches!(mode, Mode::Routine(_)));
                }
            }
            Command::TourNow => self.tour.visit_unsaved(state),
        }
        self.open_dialog();
    }

    /// Opens a scene in the place of this one; the tour is put away.
    fn open(&mut self, name: &str) {
        match saving::read(&self.state, name) {
            Ok((scene, source)) => {
                self.tour.leave(&mut self.state);
                saving::replace(&mut self.state, scene, &source);
                self.panels.dial = DialPanel::default();
                self.modes.clear();
            }
            Err(sentence) => self.state.warn(sentence),
        }
    }

    /// Goes where a pasted command leads; the person's own scene waits behind a page of the tour.
    fn follow(&mut self, link: &Link) {
        match &link.place {
            LinkPlace::Scene(name) => self.open(name),
            LinkPlace::Page(chapter, page) => self.tour.open_page(&mut self.state, chapter, *page),
        }
        let is_there = !self.state.message.as_ref().is_some_and(|said| said.warning);
        if is_there && let Err(sentence) = set::set_out(&mut self.state, &link.settings) {
            self.state.warn(sentence);
        }
    }

    /// Ends the program, or asks first if that would lose something.
    fn quit(&mut self) {
        if self.state.is_worth_saving() {
            self.ask_before_quitting();
        } else {
            self.state.ended = Some(0);
        }
    }

    /// Ctrl-C ends the program as SIGINT would; with unsaved changes it asks first, once, and if it ends
    /// all the same they are kept as when the terminal is lost.
    fn interrupt(&mut self) {
        let question = self.modes.last().and_then(Mode::question);
        let asked = matches!(question, Some(Confirmation::Quit | Confirmation::CloseText));
        let open = self.state.typing.as_ref();
        if open.is_some_and(OpenText::is_changed) && !asked {
            self.state.ask(Confirmation::CloseText);
            self.open_dialog();
        } else if self.state.is_worth_saving() && !asked {
            self.modes.clear();
            self.ask_before_quitting();
            self.open_dialog();
        } else {
            self.state.ended = Some(130);
        }
    }

    /// Asks about what is unsaved, in front of it: work that waits behind the tour comes back first.
    pub(crate) fn ask_before_quitting(&mut self) {
        if self.state.hides_changes() {
            self.tour.leave(&mut self.state);
        }
        // What would be saved is the person's own scene.
        self.state.work.document.turn_back();
        self.state.ask(Confirmation::Quit);
    }
}

// Keeping picture and layout up to date.
impl Explorer {
    /// Brings the reading up to date between two drawings, for what acts on it: several events may come
    /// before the next drawing, and the outcome must not depend on how many. The picture itself, and what
    /// panels show, wait for the drawing.
    fn refresh(&mut self) {
        let (cols, rows) = self.state.screen;
        if (cols, rows) != (0, 0) {
            self.arrange(cols, rows);
        }
    }

    /// The layout of a screen of `area` as things are now.
    fn layout(&self, area: Rect) -> Option<Layout> {
        let style = self.state.at.style;
        let picture = self.scene().pixels.map(|size| style.cells_of(size));
        Layout::with_box(area, picture, self.tour.rows(area))
    }
}

/// Whether what it does depends on the picture and the reading, which a change makes stale.
fn acts_on_picture(action: Action) -> bool {
    use Action::{Add, Link, MakeTangent, SelectShown};
    let of_group = matches!(
        action.group(),
        Group::Cursor | Group::Steps | Group::Laboratory
    );
    of_group || matches!(action, Add | Link | MakeTangent | SelectShown)
}

/// Whether a routine's text is open that belongs in this file.
fn is_of_text(state: &State, path: &Path) -> bool {
    let open = state.typing.as_ref();
    open.is_some_and(|open| open.path == path)
}
