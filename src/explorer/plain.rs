//! The explorer in lines of text: a line in, what changed out. For screen readers, pipes and scripts.
//!
//! The lines are the names of actions and the commands after `:`; they go the way that keys go. The
//! answer is what a look at the screen would tell: what is another number or word than before.

use ratatui::layout::Rect;

use crate::explain::{self, Digits, Line, Reading, StepLook, Subject};
use crate::explorer::action::{Action, Group};
use crate::explorer::command::{self, Command, WITH_ARGUMENT};
use crate::explorer::edit::field::Field;
use crate::explorer::key::Key;
use crate::explorer::mode::{Mode, Purpose, Question};
use crate::explorer::panel::Panel;
use crate::explorer::{Explorer, Request};
use crate::geometry::Decimal;
use crate::method::{Class, Precision};
use crate::text::printable;

/// What is said to a line.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Reply {
    /// Lines of text, each ended by a newline; nothing if there is nothing to say.
    pub text: String,
    /// What has to be answered before anything is done, if somebody is there to answer.
    pub question: Option<String>,
    /// Whether the line was not understood or could not be done.
    pub refused: bool,
}

/// The screen that the picture is made for, in columns and rows.
pub(crate) const SCREEN: (u16, u16) = (80, 24);
/// Columns and rows of a panel as text: panels are longer than a screen, figures are not.
const ROOM: (u16, u16) = (76, 200);
const FIGURE: (u16, u16) = (76, 20);
/// How often a line may have an action done.
const MOST_TIMES: usize = 1000;

/// What `show` knows beside the panels.
const OTHERS: &[(&str, &str)] = &[
    ("view", "the picture, in characters"),
    ("numbers", "the numbers that `set` changes"),
    ("tour", "the page of the tour"),
];

impl Explorer {
    /// What is said first: where we are, and how to go on.
    pub fn greeting(&mut self) -> Reply {
        self.look();
        let mut text = match self.tour_text() {
            Some(page) => page.join("\n") + "\n",
            None => self.scene().name.clone() + "\n",
        };
        text += &(self.facts().sentence(None) + "\n");
        let message = self.message.take();
        let refused = message.as_ref().is_some_and(|m| m.warning);
        if let Some(message) = message {
            text += &(message.text + "\n");
        }
        text += "help lists the commands, quit ends.\n";
        self.said(&text, refused)
    }

    /// Whether the next line may be the answer to a question.
    pub const fn is_asking(&self) -> bool {
        matches!(self.mode, Mode::Ask(_))
    }

    /// Whether the question is what to do about unsaved work.
    pub const fn is_asking_to_quit(&self) -> bool {
        matches!(self.mode, Mode::Ask(Question::Quit))
    }

    /// Puts a question off, since nobody is there to answer it, and with it what is said to a person
    /// who has just come.
    pub fn put_off(&mut self) {
        self.message = None;
        if self.is_asking() {
            self.mode = Mode::Normal;
        }
    }

    /// Does what a line says, and tells what that changed.
    pub fn run_line(&mut self, line: &str) -> Reply {
        let line = line.trim();
        if line.is_empty() || line.starts_with('#') {
            return Reply::default();
        }
        if self.picture.key.is_none() {
            self.look();
        }
        self.message = None;
        let before = self.facts();
        let told = match self.hear(line) {
            Ok(told) => told,
            Err(sentence) => return self.said(&(sentence + "\n"), true),
        };
        // An answer in itself changes nothing: the plan of the last frame stays to be shown.
        if told.is_none() {
            self.look();
        }
        let refused = self.message.as_ref().is_some_and(|m| m.warning);
        let news = self.news(&before, told.is_some());
        self.said(&(told.unwrap_or_default() + &news), refused)
    }

    /// What a command has left to say: its message, what changed, a question.
    fn news(&mut self, before: &Facts, is_answered: bool) -> String {
        let mut text = String::new();
        if let Some(message) = self.message.take() {
            text += &(message.text + "\n");
        }
        let after = self.facts();
        let changed = after.sentence(Some(before));
        if !changed.is_empty() {
            text += &(changed + "\n");
        }
        if after.page != before.page {
            text += &self
                .tour_text()
                .map_or(String::new(), |t| t.join("\n") + "\n");
        }
        if after.panel != before.panel {
            text += &self.panel_in_text(self.panel);
        } else if after.step != before.step {
            text += &self.step_in_text();
        }
        if text.is_empty() && !is_answered && self.mode == Mode::Normal && self.ended.is_none() {
            text += "Nothing changed.\n";
        }
        text
    }

    /// What is said, in the characters there are, and none that moves a cursor.
    fn said(&self, text: &str, refused: bool) -> Reply {
        let written = |text: &str| printable(&self.options.glyphs.spell(text)).into_owned();
        let question = match &self.mode {
            Mode::Ask(question) => Some(written(&(question.text() + "\n"))),
            _ => None,
        };
        Reply {
            text: written(text),
            question,
            refused,
        }
    }

    fn look(&mut self) {
        self.prepare(SCREEN.0, SCREEN.1);
    }

    /// Has a line done. What comes back is an answer in itself, or why the line is not done.
    fn hear(&mut self, line: &str) -> Result<Option<String>, String> {
        self.quits_once_saved &= self.mode != Mode::Normal;
        if self.is_answer(line) {
            return Ok(None);
        }
        let (name, rest) = line
            .split_once(char::is_whitespace)
            .map_or((line, ""), |(name, rest)| (name, rest.trim()));
        match name {
            "help" | "?" => return help(rest).map(Some),
            "show" => return self.show(rest).map(Some),
            _ => {}
        }
        let command = match (Command::parse(line), Action::by_name(name)) {
            (Ok(command), _) => command,
            (Err(_), Some(action)) if !rest.is_empty() => {
                return self.repeat(action, rest).map(|()| None);
            }
            (Err(sentence), _) => {
                return Err(sentence.replace("; tab lists them", "; help lists them"));
            }
        };
        if command == Command::Do(Action::TourForward) {
            self.turn_page();
        } else {
            self.command(command);
        }
        self.settle()
    }

    /// Takes a line as the answer to the question that is open, if it can be one.
    fn is_answer(&mut self, line: &str) -> bool {
        let Some(key) = Key::parse(line) else {
            self.put_off();
            return false;
        };
        if self.is_asking() {
            self.press(key);
            return true;
        }
        self.answer_prediction(key)
    }

    /// Does an action several times.
    fn repeat(&mut self, action: Action, times: &str) -> Result<(), String> {
        let Ok(times @ 1..=MOST_TIMES) = times.parse() else {
            let name = action.name();
            return Err(format!(
                "{name}: found “{times}”, expected how often, from 1 to {MOST_TIMES}"
            ));
        };
        for _ in 0..times {
            self.act(action);
            self.settle()?;
            if self.ended.is_some() {
                break;
            }
            self.look();
        }
        Ok(())
    }

    /// The next page of the tour, all of the one before having been read.
    fn turn_page(&mut self) {
        let place = self.tour_place();
        // On a screen a long page is scrolled first, by a few lines a key.
        for _ in 0..MOST_TIMES {
            self.act(Action::TourForward);
            if self.tour_place() != place || self.message.is_some() || self.is_asking() {
                break;
            }
        }
    }

    /// Brings what needs a screen to an end without one.
    fn settle(&mut self) -> Result<Option<String>, String> {
        self.board = false;
        match self.request.take() {
            Some(Request::Suspend) => {
                return Err("suspend: there is no screen to leave; ctrl-z stops rayscope".into());
            }
            Some(Request::Copy(_) | Request::Redraw) | None => {}
        }
        match &self.mode {
            Mode::Normal | Mode::Ask(_) => Ok(None),
            Mode::Help { .. } => {
                self.mode = Mode::Normal;
                help("").map(Some)
            }
            &Mode::Case(form) => {
                self.mode = Mode::Normal;
                let lines = self.case_lines(form);
                Ok(Some(lines.join("\n") + "\n"))
            }
            Mode::Form(_) => {
                self.mode = Mode::Normal;
                Ok(Some(self.numbers()))
            }
            Mode::Prompt(prompt) => {
                let sentence = match prompt.purpose {
                    Purpose::Command => "Every line is a command.",
                    Purpose::Open => "open: expected a file or a built-in scene after it",
                    Purpose::SaveAs => "save-as: expected a file name after it",
                };
                self.mode = Mode::Normal;
                Err(sentence.into())
            }
        }
    }

    /// The text form of a panel, or of something else that a screen shows.
    fn show(&self, what: &str) -> Result<String, String> {
        match what {
            "" => Ok(self.panel_in_text(self.panel)),
            "view" => Ok(self.picture_in_text()),
            "numbers" => Ok(self.numbers()),
            "tour" => match self.tour_text() {
                Some(page) => Ok(page.join("\n") + "\n"),
                None => Err("show tour: no page is open; tour opens it".into()),
            },
            _ => {
                let all = || OTHERS.iter().map(|(name, _)| *name);
                let panel = Panel::ALL.into_iter().find(|p| p.name() == what);
                let panel = panel.ok_or_else(|| {
                    let names: Vec<_> = Panel::ALL
                        .map(Panel::name)
                        .into_iter()
                        .chain(all())
                        .collect();
                    format!("show: found “{what}”, expected one of {}", names.join(", "))
                })?;
                Ok(self.panel_in_text(panel))
            }
        }
    }

    fn panel_in_text(&self, panel: Panel) -> String {
        let (width, height) = match panel {
            Panel::Slice | Panel::Curve | Panel::Error | Panel::Dial => FIGURE,
            _ => ROOM,
        };
        let room = Rect::new(0, 0, width, height);
        let (title, lines) = self.panel_text(panel, room).unwrap_or_default();
        format!("{title}\n{}", without_gaps(&lines))
    }

    /// The step of the derivation that is shown.
    fn step_in_text(&self) -> String {
        let Some(step) = self.current_step() else {
            return "The scene has no spheres.\n".into();
        };
        let look = StepLook {
            hidden: self.is_hidden(),
            changed: false,
        };
        let mut lines = explain::step_lines(step, ROOM.0.into(), look);
        if let Some(question) = self.pending_question() {
            lines.extend(explain::question_lines(
                question,
                ROOM.0.into(),
                self.options.glyphs,
            ));
        }
        format!("{}\n{}", self.step_title(), without_gaps(&lines))
    }

    /// The picture in characters, marks beside it for the cursor.
    fn picture_in_text(&self) -> String {
        if self.is_picture_veiled() {
            return "The picture is hidden while you predict.\n".into();
        }
        let (size, (x, y)) = (self.size(), self.cursor);
        let (col, row) = self.options.style.cell_of_pixel(x, y);
        let mut text = format!("view of {size} pixels, the cursor on ({x}, {y})\n");
        text += &(" ".repeat(col as usize + 2) + "▾\n");
        for (n, cells) in (0..).zip(self.picture.image.lines()) {
            let line: String = cells.iter().map(|c| c.glyph).collect();
            let mark = if n == row { "▸ " } else { "  " };
            text += (mark.to_owned() + &line).trim_end();
            text.push('\n');
        }
        text
    }

    /// The numbers that can be set.
    fn numbers(&self) -> String {
        let fields = Field::of(self.scene(), self.selected).into_iter();
        let values = fields.filter_map(|f| Some((f.name(), f.get(self.scene(), self.selected)?)));
        let lines: Vec<_> = values
            .map(|(name, value)| format!("{name} {}\n", Decimal(value)))
            .collect();
        lines.concat()
    }

    /// What a person would see that looks at the screen.
    fn facts(&self) -> Facts {
        let mut facts = Facts {
            panel: self.panel,
            step: self
                .current_step()
                .map(|s| (self.step_at, s.name.clone(), self.is_hidden())),
            page: self.tour_place(),
            is_veiled: self.is_predicting(),
            pairs: Vec::new(),
        };
        let options = self.options;
        let bodies = self.scene().bodies.len();
        facts.add("scene", &self.scene().name);
        facts.add("spheres", &bodies.to_string());
        facts.add("method", options.method.name());
        facts.add("view", options.view.name());
        facts.add("style", options.style.name());
        facts.add("compared with", self.other_method().name());
        facts.add("step length", &self.step.to_string());
        facts.add("unsaved", if self.is_changed() { "yes" } else { "no" });
        if let Some(at) = self.selected {
            facts.add("selected sphere", &(at + 1).to_string());
        }
        for line in self.numbers().lines() {
            if let Some((name, value)) = line.split_once(' ') {
                facts.add(name, value);
            }
        }
        if let Some(t) = self.scrubbed {
            facts.add("moving point at t", &t.to_string());
        }
        if let Some(reading) = &self.picture.reading {
            facts.read(reading, self.digits());
        }
        facts
    }
}

/// Names and values, as far as the person may want to hear of them.
#[derive(Debug, Clone, PartialEq)]
struct Facts {
    panel: Panel,
    step: Option<(usize, String, bool)>,
    page: Option<(usize, usize)>,
    /// What the ray found is to be predicted.
    is_veiled: bool,
    pairs: Vec<(String, String)>,
}

/// What is said of a view that has just been opened.
const FIRST: [&str; 11] = [
    "method", "pixel", "sphere", "class", "A", "B", "C", "Δ", "near", "far", "p",
];

impl Facts {
    fn add(&mut self, name: &str, value: &str) {
        self.pairs.push((name.to_owned(), value.to_owned()));
    }

    /// What the ray of the pixel found.
    fn read(&mut self, reading: &Reading, digits: Digits) {
        let (x, y) = reading.pixel;
        self.add("pixel", &format!("({x}, {y})"));
        let Some(subject) = &reading.subject else {
            return;
        };
        let Subject {
            coefficients: c,
            solution,
            sight,
            ..
        } = subject;
        let name = subject
            .name
            .as_ref()
            .map_or(String::new(), |n| format!(", {n}"));
        let (number, of) = (subject.body + 1, reading.spheres);
        if self.is_veiled {
            self.add("sphere", &format!("{number} of {of}{name}"));
            return;
        }
        let why = subject.why.words();
        self.add("sphere", &format!("{number} of {of}{name}, {why}"));
        let place = solution
            .place()
            .map_or(String::new(), |p| format!(", {}", p.name()));
        self.add("class", &format!("{}{place}", solution.class));
        let number = |x: f64| explain::number(x, c.precision, digits);
        for (name, value) in [("A", c.a), ("B", c.b), ("C", c.c), ("Δ", c.discriminant)] {
            self.add(name, &number(value));
        }
        if matches!(solution.class, Class::Tangent | Class::Secant) {
            for (name, root) in [("near", solution.near), ("far", solution.far)] {
                let root = explain::number(root.into(), Precision::Binary32, digits);
                self.add(name, &root);
            }
        }
        if let Some(sight) = sight {
            self.add("p", &format!("({})", explain::vector(sight.point, digits)));
        }
    }

    /// What is other than before, or the most important if there was nothing before.
    fn sentence(&self, before: Option<&Self>) -> String {
        let is_news = |(name, value): &&(String, String)| match before {
            None => FIRST.contains(&name.as_str()),
            Some(before) => {
                let old = before.pairs.iter().find(|(n, _)| n == name);
                old.is_none_or(|(_, old)| old != value)
            }
        };
        let gone = before
            .iter()
            .flat_map(|before| &before.pairs)
            .filter(|(name, _)| {
                let is_of_ray = ["near", "far", "p"].contains(&name.as_str());
                is_of_ray && !self.is_veiled && !self.pairs.iter().any(|(n, _)| n == name)
            });
        let news = self.pairs.iter().filter(is_news);
        let news = news.map(|(name, value)| format!("{name} {value}"));
        let gone = gone.map(|(name, _)| format!("no {name}"));
        news.chain(gone).collect::<Vec<_>>().join("; ")
    }
}

/// The commands, or what one of them does.
fn help(name: &str) -> Result<String, String> {
    let of_action = |a: &Action| format!("  {}: {}\n", a.name(), a.help());
    let of_command = |(name, argument, help): &(&str, &str, &str)| {
        format!("  {}: {help}\n", format!("{name} {argument}").trim_end())
    };
    if !name.is_empty() {
        let action = Action::by_name(name).map(|a| of_action(&a));
        let commands = WITH_ARGUMENT.iter().filter(|(n, ..)| *n == name);
        let lines: String = action.into_iter().chain(commands.map(of_command)).collect();
        return if lines.is_empty() {
            Err(command::unknown(name).replace("; tab lists them", "; help lists them"))
        } else {
            Ok(lines)
        };
    }
    let mut text = String::from(
        "A line is an action, which a number after it repeats, or a command with what it needs.\n",
    );
    for group in Group::ALL {
        let actions = Action::ALL.iter().filter(|a| a.group() == group);
        text += &(group.title().to_owned() + "\n");
        text.extend(actions.map(of_action));
    }
    text += "Commands\n";
    text.extend(WITH_ARGUMENT.iter().map(of_command));
    text += "  show: the panel in text\n";
    text.extend(Panel::ALL.map(|panel| format!("  show {}: that panel\n", panel.name())));
    text.extend(
        OTHERS
            .iter()
            .map(|(name, words)| format!("  show {name}: {words}\n")),
    );
    Ok(text + "  help NAME: what an action or a command does\n")
}

/// Lines as text, never two blank ones in a row.
fn without_gaps(lines: &[Line]) -> String {
    let mut text = String::new();
    let mut blank = true;
    for line in lines.iter().map(Line::text) {
        if !(line.is_empty() && blank) {
            text += &line;
            text.push('\n');
        }
        blank = line.is_empty();
    }
    text
}
