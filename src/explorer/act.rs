//! What each action and each command does to the state.

use crate::explain::{Digits, number};
use crate::explorer::action::{Action, Group};
use crate::explorer::command::Command;
use crate::explorer::draw::theme::Palette;
use crate::explorer::edit::document::{Change, Document};
use crate::explorer::edit::motion;
use crate::explorer::mode::{Form, Mode, Purpose, Question};
use crate::explorer::panel::Panel;
use crate::explorer::{Explorer, Request};
use crate::lab::CaseForm;
use crate::method::{Method, Precision};
use crate::render::{ColorDepth, Style, View};
use crate::scene::{Aim, Camera};

/// Why something on the screen is as it is, where the person has said so.
const CHOSEN_HERE: &str = "chosen here";

impl Explorer {
    #[expect(
        clippy::too_many_lines,
        reason = "one arm for each action, so that the compiler finds a missing one"
    )]
    pub(crate) fn act(&mut self, action: Action) {
        if acts_on_picture(action) {
            self.refresh();
        }
        match action {
            Action::CursorLeft => self.move_cursor(-1, 0),
            Action::CursorRight => self.move_cursor(1, 0),
            Action::CursorUp => self.move_cursor(0, -1),
            Action::CursorDown => self.move_cursor(0, 1),
            Action::CursorFarLeft => self.move_cursor(-8, 0),
            Action::CursorFarRight => self.move_cursor(8, 0),
            Action::CursorFarUp => self.move_cursor(0, -8),
            Action::CursorFarDown => self.move_cursor(0, 8),
            Action::CursorCenter => self.put_cursor(self.size().width / 2, self.size().height / 2),
            Action::SnapTangent => self.snap_tangent(),
            Action::NextProbe => self.go_to_probe(true),
            Action::PreviousProbe => self.go_to_probe(false),

            Action::OrbitLeft => self.move_camera(|c, s| motion::orbit(c, -s, 0.0)),
            Action::OrbitRight => self.move_camera(|c, s| motion::orbit(c, s, 0.0)),
            Action::OrbitUp => self.move_camera(|c, s| motion::orbit(c, 0.0, s)),
            Action::OrbitDown => self.move_camera(|c, s| motion::orbit(c, 0.0, -s)),
            Action::PanLeft => self.move_camera(|c, s| motion::pan(c, -s, 0.0)),
            Action::PanRight => self.move_camera(|c, s| motion::pan(c, s, 0.0)),
            Action::PanUp => self.move_camera(|c, s| motion::pan(c, 0.0, s)),
            Action::PanDown => self.move_camera(|c, s| motion::pan(c, 0.0, -s)),
            Action::DollyIn => self.move_camera(motion::dolly),
            Action::DollyOut => self.move_camera(|c, s| motion::dolly(c, -s)),
            Action::ZoomIn => self.move_camera(motion::zoom),
            Action::ZoomOut => self.move_camera(|c, s| motion::zoom(c, -s)),
            Action::LookAtSphere => self.look_at_sphere(),
            Action::Home => {
                let home = self.opened.camera;
                self.document.apply(Change::Camera(home));
            }

            Action::NextSphere => self.select_neighbour(1),
            Action::PreviousSphere => self.select_neighbour(-1),
            Action::NextOnLine => self.choose_next_on_line(),
            Action::SelectShown => self.select_shown(),
            Action::MoveXPlus => self.move_sphere(0, 1.0),
            Action::MoveXMinus => self.move_sphere(0, -1.0),
            Action::MoveYPlus => self.move_sphere(1, 1.0),
            Action::MoveYMinus => self.move_sphere(1, -1.0),
            Action::MoveZPlus => self.move_sphere(2, 1.0),
            Action::MoveZMinus => self.move_sphere(2, -1.0),
            Action::Grow => self.grow(1.0),
            Action::Shrink => self.grow(-1.0),
            Action::StepCoarser => self.set_step(self.step * 2.0),
            Action::StepFiner => self.set_step(self.step / 2.0),
            Action::MakeTangent => self.make_tangent(),
            Action::Add => self.add_sphere(),
            Action::Duplicate => self.duplicate_sphere(),
            Action::Delete => self.delete_sphere(),
            Action::Edit => {
                self.mode = Mode::Form(Form {
                    at: 0,
                    typing: None,
                });
            }

            Action::NextMethod => self.turn_method(1),
            Action::PreviousMethod => self.turn_method(Method::ALL.len() - 1),
            Action::NextView => self.turn_view(1),
            Action::PreviousView => self.turn_view(View::ALL.len() - 1),
            Action::NextStyle => self.turn_style(1),
            Action::PreviousStyle => self.turn_style(Style::ALL.len() - 1),
            Action::Precision => self.full_digits = !self.full_digits,
            Action::AspectTaller => self.set_aspect(self.options.aspect + 0.05),
            Action::AspectWider => self.set_aspect(self.options.aspect - 0.05),
            Action::NextTheme => self.set_palette(turn(&Palette::ALL, self.options.palette, 1)),
            Action::NextColor => self.set_depth(turn(&ColorDepth::ALL, self.options.depth, 1)),
            Action::ScrollDown => self.scroll += 5,
            Action::ScrollUp => self.scroll = self.scroll.saturating_sub(5),

            Action::PanelQuadratic => self.show_panel(Panel::Quadratic),
            Action::PanelSteps => self.show_panel(Panel::Steps),
            Action::PanelSlice => self.show_panel(Panel::Slice),
            Action::PanelCurve => self.show_panel(Panel::Curve),
            Action::PanelBits => self.show_panel(Panel::Bits),
            Action::PanelCompare => self.show_panel(Panel::Compare),
            Action::PanelError => self.show_panel(Panel::Error),
            Action::PanelPlan => self.show_panel(Panel::Plan),
            Action::NextStep => self.next_step(),
            Action::PreviousStep => self.go_to_step(self.step_at.saturating_sub(1)),
            Action::FirstStep => self.go_to_step(0),
            Action::LastStep => self.go_to_step(usize::MAX),
            Action::Predict => self.toggle_prediction(),
            Action::Board => self.board = !self.board,
            Action::ScrubForward => self.scrub(1.0),
            Action::ScrubBack => self.scrub(-1.0),
            Action::NextLandmark => self.go_to_landmark(true),
            Action::PreviousLandmark => self.go_to_landmark(false),
            Action::ScrubHome => self.scrubbed = None,
            Action::NextComparison => self.turn_comparison(),

            Action::Measure => self.measure(),
            Action::NextDial => self.next_dial(),
            Action::TurnOn => self.turn_on(),
            Action::TurnBack => self.turn_back(),
            Action::CopyCase => self.copy_case(CaseForm::Row),

            Action::TourForward => self.tour_forward(),
            Action::TourBack => self.tour_back(),
            Action::TourAgain => self.tour_again(),
            Action::TourNextChapter => self.tour_next_chapter(),
            Action::TourPreviousChapter => self.tour_previous_chapter(),
            Action::Tour => self.toggle_tour(),

            Action::Help => self.mode = Mode::Help { scroll: 0 },
            Action::CommandLine => self.prompt(Purpose::Command, ""),
            Action::Undo => self.travel(Document::undo, "Nothing to undo."),
            Action::Redo => self.travel(Document::redo, "Nothing to redo."),
            Action::Reset => {
                let opened = Box::new(self.opened.clone());
                if self.document.apply(Change::Scene(opened)) {
                    self.say("The scene is as it was opened. u takes this back.");
                }
                self.mend_selection();
            }
            Action::Mouse => self.toggle_mouse(),
            Action::Redraw => self.request = Some(Request::Redraw),
            Action::Open => self.prompt(Purpose::Open, ""),
            Action::Save => self.save(),
            Action::SaveAs => {
                let suggestion = self.suggested_file();
                self.prompt(Purpose::SaveAs, &suggestion);
            }
            Action::Link => self.pass_on(),
            Action::Suspend => {
                self.pause();
                self.request = Some(Request::Suspend);
            }
            Action::Quit => self.quit(),
        }
    }

    pub(crate) fn command(&mut self, command: Command) {
        self.refresh();
        match command {
            Command::Do(action) => self.act(action),
            Command::QuitNow => self.ended = Some(0),
            Command::Open(name) if self.is_worth_saving() => match self.read_scene(&name) {
                Ok(_) => self.mode = Mode::Ask(Question::Open(name)),
                Err(sentence) => self.warn(sentence),
            },
            Command::Open(name) => self.open(&name),
            Command::SaveAs(name) => self.save_as_named(&name),
            Command::Method(method) => self.options.method = method,
            Command::Style(style) => self.set_style(style),
            Command::View(view) => self.set_view(view),
            Command::Palette(palette) => self.set_palette(palette),
            Command::Color(depth) => self.set_depth(depth),
            Command::Panel(panel) => self.show_panel(panel),
            Command::Copy(form) => self.copy_case(form),
            Command::Append(name) => {
                if let Some(path) = self.reach(&name) {
                    self.append_case(&path);
                }
            }
            Command::Dial(dial, k) => self.dial_to(dial, k),
            Command::Step(name) => self.go_to_step_named(&name),
            Command::At(t) => self.scrubbed = Some(t),
            Command::Tour(chapter) => self.tour_to(&chapter),
            Command::Compare(method) if method == self.options.method => {
                self.warn(format!(
                    "compare: {method} is the chosen method, expected another one"
                ));
            }
            Command::Compare(method) => {
                self.other_method = Some(method);
                self.panel = Panel::Compare;
            }
            Command::Cursor(x, y) => {
                let size = self.size();
                if x < size.width && y < size.height {
                    self.put_cursor(x, y);
                } else {
                    self.warn(format!(
                        "cursor: found {x} {y}, expected a pixel of {size}, counted from 0"
                    ));
                }
            }
            Command::Sphere(n) => {
                let spheres = self.scene().bodies.len();
                if n <= spheres {
                    self.select(n - 1);
                } else {
                    self.warn(format!("sphere: found {n}, expected one of 1 to {spheres}"));
                }
            }
            Command::Set(field, value) => match field.set(self.scene(), self.selected, value) {
                Ok(change) => {
                    self.document.apply(change);
                }
                Err(refused) => self.warn(refused.to_string()),
            },
            Command::Stride(length) => self.set_step(length),
            Command::Aspect(ratio) => self.set_aspect(ratio),
        }
    }

    // The cursor.

    pub(crate) fn move_cursor(&mut self, right: i64, down: i64) {
        let size = self.size();
        let step = |at: u32, by: i64, count: u32| {
            (i64::from(at) + by).clamp(0, i64::from(count.max(1)) - 1) as u32
        };
        self.put_cursor(
            step(self.cursor.0, right, size.width),
            step(self.cursor.1, down, size.height),
        );
    }

    pub(crate) fn put_cursor(&mut self, x: u32, y: u32) {
        if (x, y) != self.cursor {
            self.chosen = None;
        }
        self.cursor = (x, y);
    }

    pub(crate) fn go_to_probe(&mut self, forward: bool) {
        let count = self.scene().probes.len();
        if count == 0 {
            return self.say("This scene names no places worth looking at.");
        }
        let at = match (self.probe, forward) {
            (None, true) => 0,
            (None, false) => count - 1,
            (Some(at), true) => (at + 1) % count,
            (Some(at), false) => (at + count - 1) % count,
        };
        self.probe = Some(at);
        let probe = self.scene().probes[at].clone();
        let size = self.size();
        let pixel = match probe.aim {
            Aim::Pixel(x, y) => Some((x, y)),
            Aim::Point(p) => self.pixel_of(p),
        };
        match pixel.filter(|&(x, y)| x < size.width && y < size.height) {
            Some((x, y)) => {
                self.put_cursor(x, y);
                self.say(format!(
                    "{}/{count}  {}: {}",
                    at + 1,
                    probe.title,
                    probe.text
                ));
            }
            None => self.warn(format!(
                "{}/{count}  {}: out of the picture. 0 takes the camera home.",
                at + 1,
                probe.title
            )),
        }
    }

    // The camera and the view.

    pub(crate) fn move_camera(&mut self, by: impl FnOnce(&Camera, f64) -> Camera) {
        let steps = f64::from(self.step / self.usual_step).clamp(1.0 / 1024.0, 4.0);
        let camera = by(&self.scene().camera, steps);
        if !self.document.apply(Change::Camera(camera)) {
            self.say("The camera can go no further that way.");
        }
    }

    pub(crate) fn look_at_sphere(&mut self) {
        match self.selected.and_then(|s| self.scene().bodies.get(s)) {
            Some(body) => {
                let center = body.sphere.center;
                let camera = motion::look_at(&self.scene().camera, center);
                if !self.document.apply(Change::Camera(camera)) {
                    self.say("The camera looks at it, or stands at its centre.");
                }
            }
            None => self.say("No sphere is selected."),
        }
    }

    pub(crate) fn turn_method(&mut self, by: usize) {
        self.options.method = turn(&Method::ALL, self.options.method, by);
    }

    pub(crate) fn turn_view(&mut self, by: usize) {
        self.set_view(turn(&View::ALL, self.options.view, by));
    }

    pub(crate) fn turn_style(&mut self, by: usize) {
        self.set_style(turn(&Style::ALL, self.options.style, by));
    }

    pub(crate) fn set_style(&mut self, style: Style) {
        self.options.style = style;
        self.say_legend();
    }

    fn set_view(&mut self, view: View) {
        self.options.view = view;
        self.say_legend();
    }

    fn set_palette(&mut self, palette: Palette) {
        self.options.palette = palette;
        self.options.reasons.palette = CHOSEN_HERE;
        self.say(format!("Theme: {}, {}.", palette.name(), palette.words()));
    }

    fn set_depth(&mut self, depth: ColorDepth) {
        self.options.depth = depth;
        self.options.reasons.depth = CHOSEN_HERE;
        let unused = match self.options.palette {
            Palette::Monochrome => "; the theme monochrome uses none, @ changes it",
            _ => "",
        };
        self.say(format!("Colours: {}{unused}.", depth.words()));
    }

    fn say_legend(&mut self) {
        let (view, style) = (self.options.view, self.options.style);
        let shown = view.shown_in(style).name();
        self.say(format!("{shown}, {}: {}", style.name(), view.legend(style)));
    }

    pub(crate) fn set_aspect(&mut self, aspect: f64) {
        self.options.aspect = aspect.clamp(0.5, 4.0);
        self.say(format!(
            "Cells are taken to be {:.2} times as high as wide.",
            self.options.aspect
        ));
    }

    pub(crate) fn set_step(&mut self, step: f32) {
        if step.is_finite() && step > 0.0 {
            self.step = step;
        }
        let ratio = self.step / self.usual_step;
        let [step, ratio] = [self.step, ratio]
            .map(|x| number(x.into(), Precision::Binary32, Digits::Significant(6)));
        self.say(format!("One step is {step} ({ratio}× the usual)."));
    }

    pub(crate) fn travel(&mut self, go: fn(&mut Document) -> bool, nothing: &str) {
        if go(&mut self.document) {
            self.follow_dial();
            self.mend_selection();
        } else {
            self.say(nothing);
        }
    }
}

/// Whether what it does depends on the picture and the reading, which a change makes stale.
fn acts_on_picture(action: Action) -> bool {
    use Action::{CopyCase, Link, MakeTangent, Measure, NextOnLine, SelectShown, TurnBack, TurnOn};
    let of_group = matches!(action.group(), Group::Cursor | Group::Steps);
    let of_picture = matches!(action, CopyCase | Link | MakeTangent | Measure | NextOnLine);
    of_group || of_picture || matches!(action, SelectShown | TurnBack | TurnOn)
}

/// The value `by` places after `now` in the ring of all.
pub(crate) fn turn<T: Copy + PartialEq>(all: &[T], now: T, by: usize) -> T {
    let at = all.iter().position(|&v| v == now).unwrap_or(0);
    all[(at + by) % all.len()]
}
