//! The explorer: its state, what each event does to it, and how it is drawn.
//!
//! State changes in [`Explorer::update`] and nowhere else. [`Explorer::prepare`] brings the picture
//! up to date for a screen size, [`Explorer::draw`] reads and writes cells. No terminal is in here:
//! a test, a terminal and a network connection drive the same code.

mod act;
pub mod action;
mod arrival;
mod command;
mod draw;
mod edit;
mod files;
mod key;
mod link;
mod mode;
mod options;
mod panel;
mod plain;
pub mod tour;

use ratatui::crossterm::event::{Event, KeyEventKind};

use crate::explain::{Digits, Reading};
use crate::method::Method;

use crate::scene::{Scene, Size, Source};

pub use draw::theme::Palette;
pub use edit::motion::usual_step;
pub use files::workplace::Workplace;
pub use link::{Opening, command_line};
pub use options::{Options, Reasons, Request};
pub use panel::Panel;
pub use plain::Reply;

use arrival::Arrival;
use draw::picture::Picture;
use edit::document::Document;
use files::rescue::Rescue;
use files::saving::FilePlace;
use key::Key;
use mode::line::Line;
use mode::{Message, Mode, Prompt, Purpose};
use panel::dial::Dialing;
use panel::error::Measuring;
use panel::steps::Prediction;
use tour::{Bookmark, Tour};

/// The whole state of one person's explorer.
#[derive(Debug)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "each is a choice of its own, which a key of its own turns"
)]
pub struct Explorer {
    document: Document,
    /// The scene as it was opened: what reset and home go back to.
    opened: Scene,
    place: FilePlace,
    options: Options,
    cursor: (u32, u32),
    selected: Option<usize>,
    /// The sphere on the line that the person wants to see.
    chosen: Option<usize>,
    probe: Option<usize>,
    step: f32,
    usual_step: f32,
    full_digits: bool,
    scroll: usize,
    /// The panel that the person asked for; others join it where there is room.
    panel: Panel,
    /// Where a panel has no room beside the picture: the numbers stand in the picture's place.
    numbers_alone: bool,
    /// The step of the derivation that is shown.
    step_at: usize,
    /// The name of the step that the person chose, and where it, or what stands in for it where there
    /// is no such step, was last shown.
    kept_step: Option<(String, usize)>,
    prediction: Prediction,
    /// One step is shown large, in the place of picture and panels.
    board: bool,
    /// t of the moving point; without it the point is where something is seen.
    scrubbed: Option<f64>,
    /// The method that the chosen one is compared with; without it, the next one.
    other_method: Option<Method>,
    mode: Mode,
    message: Option<Message>,
    screen: (u16, u16),
    picture: Picture,
    mouse: bool,
    request: Option<Request>,
    workplace: Workplace,
    rescue: Option<Rescue>,
    arrival: Arrival,
    tour: Option<Tour>,
    /// Where the person was when the tour was put away.
    put_away: Option<Bookmark>,
    measuring: Measuring,
    dialing: Dialing,
    ended: Option<u8>,
    /// Whether the person asked to save and quit: a question that this led to leads on to the end.
    quits_once_saved: bool,
    /// The bytes of the last frame, and of the largest one.
    sent: Option<[u64; 2]>,
    /// Whether the picture is drawn with few shades, since its bytes go out slowly.
    coarse: bool,
}

impl Explorer {
    /// An explorer of a scene that has just been opened.
    pub fn new(scene: Scene, source: &Source, options: Options) -> Self {
        let picture = Picture::of(&scene);
        let size = picture.rays.size;
        let usual_step = usual_step(&scene);
        Self {
            opened: scene.clone(),
            place: FilePlace::of(source),
            options,
            cursor: (size.width / 2, size.height / 2),
            selected: (!scene.bodies.is_empty()).then_some(0),
            document: Document::new(scene),
            chosen: None,
            probe: None,
            step: usual_step,
            usual_step,
            full_digits: false,
            scroll: 0,
            panel: Panel::default(),
            numbers_alone: false,
            step_at: 0,
            kept_step: None,
            prediction: Prediction::default(),
            board: false,
            scrubbed: None,
            other_method: None,
            mode: Mode::Normal,
            message: None,
            screen: (0, 0),
            picture,
            mouse: false,
            request: None,
            workplace: Workplace::default(),
            rescue: None,
            arrival: Arrival::default(),
            tour: None,
            put_away: None,
            measuring: Measuring::default(),
            dialing: Dialing::default(),
            ended: None,
            quits_once_saved: false,
            sent: None,
            coarse: false,
        }
    }

    /// The scene as it is now.
    pub const fn scene(&self) -> &Scene {
        self.document.scene()
    }

    /// The pixel under the cursor.
    pub const fn cursor(&self) -> (u32, u32) {
        self.cursor
    }

    /// What the ray under the cursor found, as of the last [`Explorer::prepare`].
    pub const fn reading(&self) -> Option<&Reading> {
        self.picture.reading.as_ref()
    }

    /// The exit status, once the person has left.
    pub const fn ended(&self) -> Option<u8> {
        self.ended
    }

    /// Whether there are changes that were not saved, be it behind the tour.
    pub fn is_changed(&self) -> bool {
        self.document.is_changed() || self.tour.as_ref().is_some_and(Tour::hides_changes)
    }

    /// Whether there are changes that somebody would miss: all but another look at a built-in scene,
    /// which is there for looking at.
    fn is_worth_saving(&self) -> bool {
        let built_in = matches!(self.place, FilePlace::Builtin(_)) && self.tour.is_none();
        let only_looked = built_in && self.document.ground().bodies == self.opened.bodies;
        self.is_changed() && !only_looked
    }

    /// Whether the person wants to use the mouse here rather than to select text.
    pub const fn wants_mouse(&self) -> bool {
        self.mouse
    }

    /// What the person has asked of whoever runs the explorer.
    pub fn take_request(&mut self) -> Option<Request> {
        self.request.take()
    }

    /// Shows a sentence until the next key.
    pub fn tell(&mut self, sentence: &str) {
        self.say(sentence);
    }

    /// Notes how many bytes a frame took, for the panel that tells.
    pub fn note_sent(&mut self, bytes: usize) {
        let bytes = bytes as u64;
        let most = self.sent.map_or(0, |[_, most]| most);
        self.sent = Some([bytes, most.max(bytes)]);
    }

    /// Draws the picture with two shades from now on, or with all there are again.
    pub const fn set_coarse(&mut self, coarse: bool) {
        self.coarse = coarse;
    }

    /// How the screen is drawn now.
    pub const fn options(&self) -> Options {
        self.options
    }

    /// Lets an event change the state; false if nothing on the screen can have changed.
    pub fn update(&mut self, event: &Event) -> bool {
        match event {
            Event::Key(event) if event.kind != KeyEventKind::Release => {
                self.message = None;
                self.press(Key::of(*event));
                true
            }
            Event::Paste(text) => self.paste(text),
            Event::Mouse(event) => self.point(*event),
            Event::Resize(..) => true,
            _ => false,
        }
    }

    fn say(&mut self, text: impl Into<String>) {
        self.message = Some(Message {
            text: text.into(),
            warning: false,
        });
    }

    fn warn(&mut self, text: impl Into<String>) {
        self.message = Some(Message {
            text: text.into(),
            warning: true,
        });
    }

    fn prompt(&mut self, purpose: Purpose, text: &str) {
        self.mode = Mode::Prompt(Prompt {
            purpose,
            line: Line::new(text),
            completions: None,
        });
    }

    /// The size of the picture, in pixels.
    const fn size(&self) -> Size {
        self.picture.rays.size
    }

    fn digits(&self) -> Digits {
        if self.full_digits {
            Digits::Full
        } else {
            Digits::Significant(6)
        }
    }
}
