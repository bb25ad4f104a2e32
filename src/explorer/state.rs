//! What all parts of the explorer share: the scene, the viewpoint, the picture made from them, and
//! what is to be said.
//!
//! A part changes it by what it does to a `&mut State`; what only one part needs is that part's own.

use crate::explain::{Digits, Lens, PlaneLine, Reading, Step, StepQuestion, Subject};
use crate::explorer::action::Action;
use crate::explorer::arrival::Arrival;
use crate::explorer::dialog::{Confirmation, Dialog, Message};
use crate::explorer::draw::layout::Layout;
use crate::explorer::draw::picture::Picture;
use crate::explorer::edit::document::{Change, Document};
use crate::explorer::edit::motion::usual_step;
use crate::explorer::files::place::FilePlace;
use crate::explorer::files::rescue::Rescue;
use crate::explorer::files::workplace::Workplace;
use crate::explorer::mode::line::TypedLine;
use crate::explorer::options::{Options, Request};
use crate::explorer::own_routine::{OpenText, OwnRoutine};
use crate::explorer::panel::Panel;
use crate::explorer::setting::Setting;
use crate::explorer::viewpoint::Viewpoint;
use crate::method::Method;
use crate::render::View;
use crate::scene::{Scene, Size};

/// What all parts of the explorer share.
#[derive(Debug)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "each is a choice of its own, which a key of its own turns"
)]
pub(crate) struct State {
    pub(crate) work: Work,
    pub(crate) at: Viewpoint,
    /// The person's own work, while the tour is open.
    pub(crate) aside: Option<Box<Aside>>,
    pub(crate) options: Options,
    /// The probe of the scene that was visited last.
    pub(crate) probe: Option<usize>,
    pub(crate) full_digits: bool,
    /// Lines of the panel that are scrolled away.
    pub(crate) scroll: usize,
    /// Where a panel has no room beside the picture: the numbers take the picture's place.
    pub(crate) numbers_alone: bool,
    /// The name of the step that the person chose, and where it, or what replaces it where there is
    /// no such step, was last shown.
    pub(crate) kept_step: Option<(String, usize)>,
    pub(crate) prediction: Prediction,
    /// One step is shown large, in the place of picture and panels.
    pub(crate) board: bool,
    /// The line across a circle that is drawn in the picture's place, on a page of the tour.
    pub(crate) plane: Option<PlaneLine>,
    pub(crate) message: Option<Message>,
    /// What was chosen for the next start, too.
    pub(crate) chosen: Vec<Setting>,
    /// Whether sentences name actions, not keys: there is no screen.
    pub(crate) names_actions: bool,
    /// What is to open over the screen.
    pub(crate) dialog: Option<Dialog>,
    /// Columns and rows of the screen.
    pub(crate) screen: (u16, u16),
    /// Where its parts are; none where it is too small, or before the first preparation.
    pub(crate) layout: Option<Layout>,
    pub(crate) picture: Picture,
    pub(crate) mouse: bool,
    pub(crate) request: Option<Request>,
    pub(crate) arrival: Arrival,
    /// The files that can be reached, and where unsaved work is kept.
    pub(crate) workplace: Workplace,
    /// The work that is kept in case the terminal is lost.
    pub(crate) rescue: Option<Rescue>,
    /// The exit status, once the person has left.
    pub(crate) ended: Option<u8>,
    /// Whether the person asked to save and quit: a question that this led to leads on to the end.
    pub(crate) quits_once_saved: bool,
    /// The bytes of the last frame, and of the largest one.
    pub(crate) sent: Option<[u64; 2]>,
    /// One's own methods that were opened.
    pub(crate) routines: Vec<OwnRoutine>,
    /// The routine whose text is open.
    pub(crate) typing: Option<OpenText>,
    /// Whether the picture is drawn with few shades, since its bytes go out slowly.
    pub(crate) coarse: bool,
}

/// A scene that is worked on: with its history, its file, and the length of a step in it.
#[derive(Debug)]
pub(crate) struct Work {
    pub(crate) document: Document,
    /// The scene as it was opened: what reset and home go back to.
    pub(crate) opened: Scene,
    pub(crate) place: FilePlace,
    /// By how much a key moves a sphere.
    pub(crate) stride: f32,
    pub(crate) usual_stride: f32,
}

impl Work {
    pub(crate) fn of(scene: Scene, place: FilePlace) -> Self {
        let stride = usual_step(&scene);
        Self {
            opened: scene.clone(),
            document: Document::new(scene),
            place,
            stride,
            usual_stride: stride,
        }
    }
}

/// A person's own work and where they were in it, put aside whole.
#[derive(Debug)]
pub(crate) struct Aside {
    pub(crate) work: Work,
    pub(crate) at: Viewpoint,
    pub(crate) probe: Option<usize>,
}

/// Predict, then reveal: whether results are kept back, and how the answers went.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Prediction {
    pub(crate) on: bool,
    /// The result of the step shown has been revealed.
    pub(crate) revealed: bool,
    /// How many of the questions of the step shown are done with.
    pub(crate) answered: usize,
    /// The question has been answered wrongly before.
    pub(crate) missed: bool,
    /// The number that is being typed.
    pub(crate) typed: TypedLine,
    /// What the person has been asked about: it would change the scene.
    pub(crate) warned: Option<Action>,
    pub(crate) right: u32,
    pub(crate) asked: u32,
}

impl Prediction {
    /// Begins with a step again.
    pub(crate) fn begin_step(&mut self) {
        (self.revealed, self.answered, self.missed) = (false, 0, false);
        self.typed = TypedLine::default();
    }
}

impl State {
    pub(crate) fn new(work: Work, options: Options) -> Self {
        let scene = work.document.scene();
        let picture = Picture::of(scene);
        let at = Viewpoint::of(scene, picture.rays.size);
        Self {
            work,
            at,
            aside: None,
            options,
            probe: None,
            full_digits: false,
            scroll: 0,
            numbers_alone: false,
            kept_step: None,
            prediction: Prediction::default(),
            board: false,
            plane: None,
            message: None,
            chosen: Vec::new(),
            names_actions: false,
            dialog: None,
            screen: (0, 0),
            layout: None,
            picture,
            mouse: false,
            request: None,
            arrival: Arrival::default(),
            workplace: Workplace::default(),
            rescue: None,
            ended: None,
            quits_once_saved: false,
            sent: None,
            routines: Vec::new(),
            typing: None,
            coarse: false,
        }
    }

    /// The scene as it is now.
    pub(crate) const fn scene(&self) -> &Scene {
        self.work.document.scene()
    }

    /// What the ray under the cursor finds: through the lens `mathematics` what there is to find, else
    /// what the chosen method does.
    pub(crate) const fn reading(&self) -> Option<&Reading> {
        match (self.at.lens, &self.picture.exact_reading) {
            (Lens::Mathematics, Some(exact)) => Some(exact),
            _ => self.machine_reading(),
        }
    }

    /// What the chosen method finds, through whatever lens.
    pub(crate) const fn machine_reading(&self) -> Option<&Reading> {
        self.picture.reading.as_ref()
    }

    /// Where the chosen method is wrong at this pixel: what is wrong, in a sentence.
    pub(crate) fn disagreement(&self) -> Option<String> {
        let exact = self.picture.exact_reading.as_ref()?;
        self.machine_reading()?.disagreement(exact)
    }

    /// The sphere that the reading is of.
    pub(crate) fn subject(&self) -> Option<&Subject> {
        self.reading()?.subject.as_ref()
    }

    /// The size of the picture, in pixels.
    pub(crate) const fn size(&self) -> Size {
        self.picture.rays.size
    }

    pub(crate) fn digits(&self) -> Digits {
        if self.full_digits {
            Digits::Full
        } else {
            Digits::Significant(6)
        }
    }

    /// Applies a change that can be undone; false if it changes nothing.
    pub(crate) fn apply(&mut self, change: Change) -> bool {
        self.work.document.apply(change)
    }

    pub(crate) fn say(&mut self, text: impl Into<String>) {
        self.message = Some(Message {
            text: Action::spell(&text.into(), self.names_actions),
            warning: false,
        });
    }

    pub(crate) fn warn(&mut self, text: impl Into<String>) {
        self.message = Some(Message {
            text: Action::spell(&text.into(), self.names_actions),
            warning: true,
        });
    }

    pub(crate) fn open(&mut self, dialog: Dialog) {
        self.dialog = Some(dialog);
    }

    pub(crate) fn ask(&mut self, question: Confirmation) {
        self.open(Dialog::Ask(question));
    }

    /// Whether there are changes that were not saved, also behind the tour.
    pub(crate) fn is_changed(&self) -> bool {
        self.work.document.is_changed() || self.hides_changes()
    }

    /// Whether the work that waits behind the tour has changes that were not saved.
    pub(crate) fn hides_changes(&self) -> bool {
        let aside = self.aside.as_ref();
        aside.is_some_and(|aside| aside.work.document.is_changed())
    }

    /// Whether there are changes that somebody would miss: all but another look at a built-in scene,
    /// which is there for looking at.
    pub(crate) fn is_worth_saving(&self) -> bool {
        let Work {
            document,
            opened,
            place,
            ..
        } = &self.work;
        let built_in = matches!(place, FilePlace::Builtin(_)) && self.aside.is_none();
        let only_looked = built_in && document.ground().bodies == opened.bodies;
        self.is_changed() && !only_looked
    }

    /// Whether the scene has other spheres or another camera than when it was opened.
    pub(crate) fn is_another_scene(&self) -> bool {
        let (now, opened) = (self.scene(), &self.work.opened);
        now.bodies != opened.bodies || now.camera != opened.camera
    }

    // The derivation.

    /// The step that is shown.
    pub(crate) fn current_step(&self) -> Option<&Step> {
        let last = self.picture.steps.len().checked_sub(1)?;
        self.picture.steps.get(self.at.step.min(last))
    }

    /// The question of the step shown that waits for an answer, if results are kept back at all.
    pub(crate) fn open_question(&self) -> Option<StepQuestion> {
        let keeps = (self.prediction.on || self.board) && !self.prediction.revealed;
        let questions = &self.current_step().filter(|_| keeps)?.questions;
        questions.get(self.prediction.answered).copied()
    }

    /// Whether the result of the step shown is kept back: on the board, of any step.
    pub(crate) fn is_hidden(&self) -> bool {
        self.board && !self.prediction.revealed || self.open_question().is_some()
    }

    /// Whether results are to be predicted, so that nothing else may show them.
    pub(crate) fn is_predicting(&self) -> bool {
        self.prediction.on && !self.picture.steps.is_empty()
    }

    /// All methods that keys turn through: those that are built in, and one's own.
    pub(crate) fn methods(&self) -> Vec<Method> {
        let own = self.routines.iter().map(|routine| routine.method);
        Method::ALL.into_iter().chain(own).collect()
    }

    /// The method that the chosen one is compared with.
    pub(crate) fn other_method(&self) -> Method {
        let method = self.at.method;
        let next = || turn(&self.methods(), method, 1);
        self.at
            .compare
            .filter(|&m| m != method)
            .unwrap_or_else(next)
    }

    /// The view as the style can show it.
    pub(crate) const fn shown_view(&self) -> View {
        self.at.view.shown_in(self.at.style)
    }

    /// Whether the panel that was asked for takes the place of the picture: on a screen where it has
    /// no other.
    pub(crate) fn is_picture_covered(&self) -> bool {
        let no_room = self.layout.is_some_and(|layout| layout.panel.is_empty());
        no_room && (self.at.panel != Panel::Quadratic || self.numbers_alone)
    }
}

/// The value `by` places after `now` in the ring of all.
pub(crate) fn turn<T: Copy + PartialEq>(all: &[T], now: T, by: usize) -> T {
    let at = all.iter().position(|&v| v == now).unwrap_or(0);
    all[(at + by) % all.len()]
}
