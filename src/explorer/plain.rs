//! The explorer in lines of text: a line in, what changed out. For screen readers, pipes and scripts.
//!
//! The lines are the names of actions and the commands after `:`; they go the way that keys go. The
//! answer is what a look at the screen would tell: what is another number or word than before.

use ratatui::layout::Rect;

use crate::explain::{self, Digits, Line, Reading, StepQuestion, Subject};
use crate::explorer::action::{Action, Group};
use crate::explorer::command::{self, Command, with_argument};
use crate::explorer::dialog::{Confirmation, Purpose};
use crate::explorer::draw::layout::USUAL;
use crate::explorer::files::keep;
use crate::explorer::key::Key;
use crate::explorer::mode::form::numbers;
use crate::explorer::mode::{ExportCase, Mode, export_case};
use crate::explorer::options::Request;
use crate::explorer::panel::{Panel, steps};
use crate::explorer::setting::SETTINGS;
use crate::explorer::viewpoint::Viewpoint;
use crate::explorer::walk;
use crate::explorer::whole::Explorer;
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

/// Columns of a step as text.
const WIDTH: usize = 76;
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
        let mut text = match self.tour.text(true) {
            Some(page) => page.join("\n") + "\n",
            None => self.scene().name.clone() + "\n",
        };
        text += &(self.facts().sentence(None) + "\n");
        let message = self.state.message.take();
        let refused = message.as_ref().is_some_and(|m| m.warning);
        if let Some(message) = message {
            text += &(message.text + "\n");
        }
        text += "An empty line takes the next step, help lists the commands, quit ends.\n";
        self.said(&text, refused)
    }

    fn question(&self) -> Option<&Confirmation> {
        self.modes.last().and_then(Mode::question)
    }

    /// Whether the next line may be the answer to a question.
    pub fn is_asking(&self) -> bool {
        self.question().is_some()
    }

    /// Whether the question is what to do about unsaved work.
    pub fn is_asking_to_quit(&self) -> bool {
        self.question() == Some(&Confirmation::Quit)
    }

    /// Puts a question off, since nobody is there to answer it, and with it what is said to a person
    /// who has just come.
    pub fn put_off(&mut self) {
        self.state.message = None;
        if self.is_asking() {
            self.modes.clear();
        }
    }

    /// Does what a line says, and tells what that changed.
    pub fn run_line(&mut self, line: &str) -> Reply {
        self.state.names_actions = true;
        let line = match line.trim() {
            "" if !self.is_asking() => Action::NextStep.name(),
            line => line.strip_prefix(':').unwrap_or(line),
        };
        if line.is_empty() || line.starts_with('#') {
            return Reply::default();
        }
        if self.state.picture.key.is_none() {
            self.look();
        }
        self.state.message = None;
        let before = self.facts();
        let told = match self.do_line(line) {
            Ok(told) => told,
            Err(sentence) => return self.said(&(sentence + "\n"), true),
        };
        // An answer in itself changes nothing: the plan of the last frame stays to be shown.
        if told.is_none() {
            self.look();
        }
        let refused = self.state.message.as_ref().is_some_and(|m| m.warning);
        // No waker runs while the next line is waited for.
        let said = self.state.message.take();
        keep::write_down_between_lines(&mut self.state);
        let warning = std::mem::replace(&mut self.state.message, said);
        let mut news = self.news(&before, told.is_some());
        news += &warning.map_or(String::new(), |warning| warning.text + "\n");
        self.said(&(told.unwrap_or_default() + &news), refused)
    }

    /// What a command has left to say: its message, what changed, a question.
    fn news(&mut self, before: &Facts, is_answered: bool) -> String {
        let mut text = String::new();
        if let Some(message) = self.state.message.take() {
            text += &(message.text + "\n");
        }
        let after = self.facts();
        let changed = after.sentence(Some(before));
        if !changed.is_empty() {
            text += &(changed + "\n");
        }
        if after.page != before.page {
            text += &self
                .tour
                .text(true)
                .map_or(String::new(), |t| t.join("\n") + "\n");
        }
        if after.panel != before.panel {
            text += &self.panel_in_text(self.state.at.panel);
        } else if after.step != before.step {
            text += &self.step_in_text();
        }
        if text.is_empty() && !is_answered && self.modes.is_empty() && self.state.ended.is_none() {
            text += "Nothing changed.\n";
        }
        text
    }

    /// What is said, in the characters there are, and none that moves a cursor.
    fn said(&self, text: &str, refused: bool) -> Reply {
        let written = |text: &str| printable(&self.state.options.glyphs.spell(text)).into_owned();
        let question = self.question();
        let question = question.map(|question| written(&(question.text() + "\n")));
        Reply {
            text: written(text),
            question,
            refused,
        }
    }

    fn look(&mut self) {
        let (cols, rows) = USUAL;
        self.prepare(cols, rows);
    }

    /// Has a line done. What comes back is an answer in itself, or why the line is not done.
    fn do_line(&mut self, line: &str) -> Result<Option<String>, String> {
        self.state.quits_once_saved &= !self.modes.is_empty();
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
            self.run(command);
        }
        self.answer_without_screen()
    }

    /// Takes a line as the answer to the question that is open, if it can be one.
    fn is_answer(&mut self, line: &str) -> bool {
        if walk::pending_question(&self.state).is_some() && !self.is_asking() {
            let is_number = line.starts_with(|c: char| c.is_ascii_digit() || "-−.+".contains(c));
            let is_word = Action::by_name(line).is_none() && is_number;
            let choices = walk::pending_question(&self.state).and_then(StepQuestion::choices);
            let is_choice = choices.is_some_and(|choices| {
                choices
                    .iter()
                    .any(|(c, word)| line == *word || line.chars().eq([*c]))
            });
            return (is_word || is_choice) && walk::take_answer(&mut self.state, line);
        }
        let Some(key) = Key::parse(line) else {
            if matches!(self.question(), Some(Confirmation::Recover { .. })) {
                keep::put_off(&mut self.state);
            }
            self.put_off();
            return false;
        };
        if self.is_asking() {
            self.press(key);
            return true;
        }
        false
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
            self.answer_without_screen()?;
            if self.state.ended.is_some() {
                break;
            }
            self.look();
        }
        Ok(())
    }

    /// The next page of the tour, all of the one before having been read.
    fn turn_page(&mut self) {
        let place = self.tour.place();
        // On a screen a long page is scrolled first, by a few lines a key.
        for _ in 0..MOST_TIMES {
            self.act(Action::TourForward);
            if self.tour.place() != place || self.state.message.is_some() || self.is_asking() {
                break;
            }
        }
    }

    /// Brings what needs a screen to an end without one.
    fn answer_without_screen(&mut self) -> Result<Option<String>, String> {
        self.state.board = false;
        match self.state.request.take() {
            Some(Request::Suspend) => {
                return Err("suspend: there is no screen to leave; ctrl-z stops rayscope".into());
            }
            Some(Request::Edit { .. }) => {
                return Err("edit: there is no screen to leave; `method FILE` reads a file".into());
            }
            Some(Request::Copy(_) | Request::Redraw) | None => {}
        }
        if self.is_asking() {
            return Ok(None);
        }
        match self.modes.pop() {
            None | Some(Mode::Asking(_) | Mode::Routine(_)) => Ok(None),
            Some(Mode::Help(_) | Mode::Menu(_)) => help("").map(Some),
            Some(Mode::Case(ExportCase { form })) => {
                let lines = export_case::lines(&self.state, form);
                Ok(Some(lines.join("\n") + "\n"))
            }
            Some(Mode::Form(_)) => Ok(Some(numbers(&self.state))),
            Some(Mode::Prompt(prompt)) => {
                let sentence = match prompt.purpose {
                    Purpose::Command => "Every line is a command.",
                    Purpose::Open => "open: expected a file or a built-in scene after it",
                    Purpose::SaveAs => "save-as: expected a file name after it",
                };
                Err(sentence.into())
            }
        }
    }

    /// The text form of a panel, or of something else that a screen shows.
    fn show(&self, what: &str) -> Result<String, String> {
        match what {
            "" => Ok(self.panel_in_text(self.state.at.panel)),
            "view" => Ok(self.picture_in_text()),
            "numbers" => Ok(numbers(&self.state)),
            "tour" => match self.tour.text(true) {
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
        let (width, height) = self.panels.get(panel).size_as_text();
        let room = Rect::new(0, 0, width, height);
        let (title, lines) = self
            .panels
            .text(&self.state, panel, room)
            .unwrap_or_default();
        format!("{title}\n{}", without_gaps(&lines))
    }

    /// The step of the derivation that is shown.
    fn step_in_text(&self) -> String {
        if self.state.current_step().is_none() {
            return "The scene has no spheres.\n".into();
        }
        let lines = explain::step_lines(&self.state.picture.steps, steps::look(&self.state), WIDTH);
        format!("{}\n{}", steps::title(&self.state), without_gaps(&lines))
    }

    /// The picture in characters, marks beside it for the cursor.
    fn picture_in_text(&self) -> String {
        if walk::is_picture_veiled(&self.state) {
            return "The picture is hidden while you predict.\n".into();
        }
        let (size, (x, y)) = (self.state.size(), self.state.at.cursor);
        let (col, row) = self.state.at.style.cell_of_pixel(x, y);
        let mut text = format!("view of {size} pixels, the cursor on ({x}, {y})\n");
        text += &(" ".repeat(col as usize + 2) + "▾\n");
        for (n, cells) in (0..).zip(self.state.picture.image.lines()) {
            let line: String = cells.iter().map(|c| c.glyph).collect();
            let mark = if n == row { "▸ " } else { "  " };
            text += (mark.to_owned() + &line).trim_end();
            text.push('\n');
        }
        text
    }

    /// What a person would see that looks at the screen.
    fn facts(&self) -> Facts {
        let mut facts = Facts {
            panel: self.state.at.panel,
            step: self
                .state
                .current_step()
                .map(|s| (self.state.at.step, s.name.clone(), self.state.is_hidden())),
            page: self.tour.place(),
            is_veiled: self.state.is_predicting(),
            pairs: Vec::new(),
        };
        let bodies = self.scene().bodies.len();
        facts.add("scene", &self.scene().name);
        facts.add("spheres", &bodies.to_string());
        let at = Viewpoint {
            compare: Some(self.state.other_method()),
            ..self.state.at
        };
        for row in SETTINGS {
            if let (Some(name), Some(value)) = (row.spoken, row.write(&at)) {
                facts.add(name, &value);
            }
        }
        facts.add("step length", &self.state.work.stride.to_string());
        facts.add("unsaved", if self.is_changed() { "yes" } else { "no" });
        for line in numbers(&self.state).lines() {
            if let Some((name, value)) = line.split_once(' ') {
                facts.add(name, value);
            }
        }
        if let Some(reading) = &self.state.picture.reading {
            facts.read(reading, self.state.digits());
        }
        facts
    }
}

/// Names and values, as far as the person may want to know them.
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
    let of_command = |(name, argument, help): (&str, &str, &str)| {
        format!("  {}: {help}\n", format!("{name} {argument}").trim_end())
    };
    if !name.is_empty() {
        let action = Action::by_name(name).map(|a| of_action(&a));
        let commands = with_argument().filter(|(n, ..)| *n == name);
        let lines: String = action.into_iter().chain(commands.map(of_command)).collect();
        return if lines.is_empty() {
            Err(command::unknown(name).replace("; tab lists them", "; help lists them"))
        } else {
            Ok(lines)
        };
    }
    let mut text = String::from(
        "A line is the name of an action or a command. An action is repeated by a number after \
         it: right 5. An empty line takes the next step.\n",
    );
    for group in Group::ALL {
        let actions = Action::ALL.iter().filter(|a| a.group() == group);
        text += &(group.title().to_owned() + "\n");
        text.extend(actions.map(of_action));
    }
    text += "Commands\n";
    text.extend(with_argument().map(of_command));
    text += "  show: the panel in text\n";
    let panels = Panel::ALL.map(Panel::name).join(", ");
    text += &["  show NAME: that panel, one of ", &panels, "\n"].concat();
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
