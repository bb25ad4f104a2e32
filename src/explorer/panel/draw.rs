//! Draws the panels beside the picture, and the board.

use ratatui::layout::Rect;

use crate::explain::{self, Line, PlanLine, Question, Reading, StepLook, Subject};
use crate::explorer::Explorer;
use crate::explorer::draw::large;
use crate::explorer::draw::layout::{self, Layout};
use crate::explorer::draw::pen::Pen;
use crate::explorer::draw::theme::Theme;
use crate::explorer::panel::Panel;
use crate::explorer::panel::steps::Prediction;
use crate::text;

impl Explorer {
    /// Shows a panel. Where it takes the picture's place, the same key brings the picture back.
    pub(crate) fn show_panel(&mut self, panel: Panel) {
        let (cols, rows) = self.screen;
        let layout = self.layout(Rect::new(0, 0, cols, rows));
        let covers = layout.is_some_and(|layout| layout.panel.is_empty());
        let again = covers && self.panel == panel;
        (self.panel, self.numbers_alone) = match panel {
            Panel::Quadratic => (panel, again && !self.numbers_alone),
            _ if again => (Panel::Quadratic, false),
            _ => (panel, false),
        };
    }

    /// Whether the panel that was asked for stands in the place of the picture: on a screen where it
    /// has no other.
    pub(crate) fn is_picture_covered(&self, layout: &Layout) -> bool {
        layout.panel.is_empty() && (self.panel != Panel::Quadratic || self.numbers_alone)
    }

    /// The panel in the place of the picture.
    pub(crate) fn draw_panel_alone(&self, pen: &mut Pen<'_>, area: Rect) {
        self.draw_panel(pen, self.panel, area);
        pen.corner(area, "1: picture");
    }

    /// All panels that have room.
    pub(crate) fn draw_panels(&self, pen: &mut Pen<'_>, side: Rect) {
        for (panel, area) in Panel::tiles(side, self.panel) {
            self.draw_panel(pen, panel, area);
        }
    }

    fn draw_panel(&self, pen: &mut Pen<'_>, panel: Panel, area: Rect) {
        let room = text_room(area);
        let Some((title, mut lines)) = self.panel_text(panel, room) else {
            return;
        };
        let mut left_out = 0;
        // Whoever scrolls wants to see what there was no room for.
        if is_fitted(panel) && (panel != self.panel || self.scroll == 0) {
            let written = |lines: &[Line]| lines.iter().filter(|l| l.width() > 0).count();
            let before = written(&lines);
            lines = explain::fit(lines, room.height.into());
            left_out = before - written(&lines);
        } else {
            lines.retain(|line| !line.keeps_place);
        }
        // Only the panel that the person asked for scrolls.
        let hidden = lines.len().saturating_sub(room.height.into());
        let scroll = if panel == self.panel {
            self.scroll.min(hidden)
        } else {
            0
        };
        let foot = match (scroll, hidden - scroll) {
            (0, below) if below + left_out > 0 && is_fitted(panel) => match below + left_out {
                1 => "1 more line: pagedown".to_owned(),
                more => format!("{more} more lines: pagedown"),
            },
            (0, 0) => self.panel_foot(panel),
            (_, 0) => format!("{scroll} lines above: pageup"),
            (_, below) => format!("{below} lines below: pagedown"),
        };
        pen.frame(area, &title, &foot);
        pen.lines(room, &lines[scroll..]);
    }

    /// The title of a panel and its lines, laid out for `room`.
    pub(crate) fn panel_text(&self, panel: Panel, room: Rect) -> Option<(String, Vec<Line>)> {
        let reading = self.picture.reading.as_ref()?;
        if let Some(veiled) = self.veil(panel, room.width.into()) {
            return Some(veiled);
        }
        Some(match panel {
            Panel::Quadratic => self.quadratic_panel(reading, room),
            Panel::Steps => self.steps_panel(room),
            Panel::Slice | Panel::Curve => self.figure_panel(panel, reading, room),
            Panel::Bits => self.bits_panel(room),
            Panel::Compare => self.compare_panel(reading, room),
            Panel::Error => self.error_panel(room),
            Panel::Plan => self.plan_panel(room),
            Panel::Dial => (
                format!("dial: {}", self.dialing.dial.name),
                self.dial_lines(room.width.into(), room.height.into()),
            ),
        })
    }

    fn panel_foot(&self, panel: Panel) -> String {
        let Prediction {
            on, right, asked, ..
        } = self.prediction;
        match panel {
            _ if self.is_predicting() && panel != Panel::Steps => String::new(),
            Panel::Steps if self.is_hidden() && self.pending_question().is_none() => {
                "enter: the answer".into()
            }
            Panel::Steps if on && asked > 0 => format!("{right} of {asked} foreseen"),
            Panel::Steps => ", . step  < > ends".into(),
            Panel::Slice | Panel::Curve => "( ) move p  _ * landmark  / back".into(),
            Panel::Bits => ", . another number".into(),
            Panel::Compare => "C another method".into(),
            Panel::Error if self.measuring.is_running() => "% stop".into(),
            Panel::Error => "% measure".into(),
            Panel::Dial => "\\ turn on  | back  9 next dial".into(),
            Panel::Quadratic | Panel::Plan => String::new(),
        }
    }

    fn quadratic_panel(&self, reading: &Reading, room: Rect) -> (String, Vec<Line>) {
        let (x, y) = reading.pixel;
        let glyphs = self.options.glyphs;
        let lines = explain::lines(reading, room.width.into(), self.digits(), glyphs);
        (format!("ray of pixel ({x}, {y})"), lines)
    }

    /// The step, and under it the list of all steps, which always stays.
    fn steps_panel(&self, room: Rect) -> (String, Vec<Line>) {
        let steps = &self.picture.steps;
        let Some(step) = self.current_step() else {
            return (
                "steps".into(),
                vec![Line::plain("The scene has no spheres.")],
            );
        };
        let glyphs = self.options.glyphs;
        let step = step.spelt(glyphs);
        let spelt: Vec<_> = steps.iter().map(|step| step.spelt(glyphs)).collect();
        let at = self.step_at.min(steps.len() - 1);
        let width = room.width.into();
        let foresight = !self.is_predicting();
        let list = explain::step_list(&spelt, at, &self.picture.changed, foresight, width);
        let look = StepLook {
            hidden: self.is_hidden(),
            changed: self.picture.changed.get(at).copied().unwrap_or(false),
        };
        let mut lines = explain::step_lines(&step, width, look);
        if let Some(question) = self.pending_question() {
            lines.extend(explain::question_lines(question, width, glyphs));
        }
        if !look.hidden {
            lines.extend(explain::step_words(std::slice::from_ref(&step), width));
        }
        let space = usize::from(room.height).saturating_sub(list.len() + 1);
        let mut lines = explain::fit(lines, space);
        if lines.len() < space {
            lines.resize(space, Line::default());
        }
        lines.push(Line::default());
        lines.extend(list);
        (self.step_title(), lines)
    }

    /// Which step of how many; how many follow would tell how it comes out.
    pub(crate) fn step_title(&self) -> String {
        let Some(step) = self.current_step() else {
            return "steps".into();
        };
        let count = self.picture.steps.len();
        let number = (self.step_at + 1).min(count);
        let hides = self.is_predicting() || self.is_hidden();
        let of = if hides {
            String::new()
        } else {
            format!(" of {count}")
        };
        format!("step {number}{of}: {}", step.name)
    }

    /// What stands in the place of a panel that tells what is to be predicted.
    fn veil(&self, panel: Panel, width: usize) -> Option<(String, Vec<Line>)> {
        let tells = match panel {
            Panel::Quadratic | Panel::Slice | Panel::Curve | Panel::Bits | Panel::Compare => true,
            Panel::Steps | Panel::Error | Panel::Plan | Panel::Dial => false,
        };
        let words = "Hidden while you predict: the answers are here. 2 goes on with the steps, \
                     P shows everything again.";
        (tells && self.is_predicting()).then(|| {
            let lines = text::wrap(words, width).into_iter();
            (panel.name().into(), lines.map(Line::plain).collect())
        })
    }

    fn figure_panel(&self, panel: Panel, reading: &Reading, room: Rect) -> (String, Vec<Line>) {
        let Some(subject) = &reading.subject else {
            return (
                panel.name().into(),
                vec![Line::plain("The scene has no spheres.")],
            );
        };
        let t = self.moving_t();
        let (cols, rows) = (room.width.into(), room.height.into());
        let glyphs = self.options.glyphs;
        match panel {
            Panel::Slice => (
                "slice through ray and centre".into(),
                explain::slice(subject, &reading.ray, t, cols, rows, glyphs),
            ),
            _ => (
                "f(t) = At² + Bt + C".into(),
                explain::curve(subject, &reading.ray, t, cols, rows, glyphs),
            ),
        }
    }

    /// The bits of the number that the step gives; for a step without one, of Δ.
    fn bits_panel(&self, room: Rect) -> (String, Vec<Line>) {
        let step = self.current_step().filter(|s| s.number.is_some());
        let of_step = step.and_then(|s| Some((s.name.as_str(), s.number.as_ref()?)));
        let subject = self.reading().and_then(|r| r.subject.as_ref());
        let of_subject = || Some(("Δ", &subject?.trace.discriminant));
        let Some((name, number)) = of_step.or_else(of_subject) else {
            return (
                "bits".into(),
                vec![Line::plain("The scene has no spheres.")],
            );
        };
        let lines = explain::measured_bits(name, number, room.width.into());
        (format!("bits of {name}"), lines)
    }

    fn compare_panel(&self, reading: &Reading, room: Rect) -> (String, Vec<Line>) {
        let title = format!("{} beside {}", reading.method, self.other_method());
        let Some(subject) = &reading.subject else {
            return (title, vec![Line::plain("The scene has no spheres.")]);
        };
        let Subject { trace, sphere, .. } = subject;
        let other = self.other_method().trace(&reading.ray, sphere);
        (title, explain::comparison(trace, &other, room.width.into()))
    }

    /// Error against run time, and whether it can be believed.
    fn error_panel(&self, room: Rect) -> (String, Vec<Line>) {
        let title = "error against run time".to_owned();
        let width = room.width.into();
        let mut lines = self.measuring.remarks(width);
        if let Some(chart) = &self.measuring.chart {
            let rows = usize::from(room.height).saturating_sub(lines.len());
            let sets = chart.report.sets.iter();
            let glyphs = self.options.glyphs;
            lines.extend(sets.flat_map(|c| explain::work(c, width, rows, glyphs)));
        }
        (title, lines)
    }

    /// What the picture on the screen needed when it was made or mended, and whether that was now.
    fn plan_panel(&self, room: Rect) -> (String, Vec<Line>) {
        let plan = self.picture.frame.plan();
        let frame = if self.picture.rests {
            "This frame: the picture rests."
        } else if plan.counts().kept > 0 {
            "This frame: the picture mended."
        } else {
            "This frame: a new picture."
        };
        let title = format!("plan: {} {}", plan.method(), plan.view().name());
        let mut lines = explain::plan_lines(plan, &self.picture.image);
        lines.push(PlanLine::new(
            "cursor's ray",
            self.scene().bodies.len() as u64,
            0,
            "asked about every sphere for the panel; while the cursor moves nothing else is asked",
        ));
        if let Some([sent, all]) = self.sent {
            lines.push(PlanLine::new(
                "bytes sent",
                sent,
                all.saturating_sub(sent),
                "by the frame before this one: cells that the terminal shows already are not sent; left out is what the largest frame so far took more",
            ));
        }
        (title, explain::plan_panel(frame, &lines, room.width.into()))
    }

    /// One step as large as the screen allows; its answer hidden until the key.
    pub(crate) fn draw_board(&self, pen: &mut Pen<'_>, area: Rect) {
        let Some(step) = self.current_step() else {
            return;
        };
        let title = self.step_title();
        let foot = if self.is_hidden() {
            "enter: the answer"
        } else {
            "enter: the next step   O: back to the picture"
        };
        pen.frame(area, &title, foot);
        let room = text_room(area);
        let result = if self.is_hidden() { "?" } else { &step.result };
        // The result is what the back row must read: it has the larger part.
        let y = large::draw(pen, room, room.y + 1, room.height / 4, &step.formula);
        let y = large::draw(pen, room, y + 1, room.height / 2, &format!("= {result}"));
        let question = self.pending_question();
        let answers = question.map_or_else(String::new, Question::keys);
        let small = [
            (question.map_or("", Question::text), Theme::strong()),
            (answers.as_str(), Theme::strong()),
            (step.numbers_beside(self.is_hidden()), Theme::faint()),
            (step.why.as_str(), Theme::plain()),
        ];
        let mut y = y + 1;
        for (text, style) in small.into_iter().filter(|(text, _)| !text.is_empty()) {
            for line in text::wrap(text, room.width.into()) {
                if y < room.bottom() {
                    pen.text(room.x, y, room.width, &line, style);
                    y += 1;
                }
            }
        }
    }
}

/// Whether a panel leaves out what it can spare before it is cut.
const fn is_fitted(panel: Panel) -> bool {
    matches!(panel, Panel::Quadratic | Panel::Compare)
}

/// What is inside a panel's border, a blank away from it.
fn text_room(area: Rect) -> Rect {
    let room = layout::inner(area);
    Rect {
        x: room.x + 1,
        width: room.width.saturating_sub(2),
        ..room
    }
}
