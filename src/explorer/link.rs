//! A view to pass on: the command that reopens it, and opening there.

use crate::explain::Why;
use crate::explorer::arrival::Target;
use crate::explorer::command::Command;
use crate::explorer::edit::document::Document;
use crate::explorer::edit::field::{self, Field};
use crate::explorer::files::saving::FilePlace;
use crate::explorer::panel::Panel;
use crate::explorer::plain;
use crate::explorer::{Explorer, Options, Request};
use crate::geometry::Decimal;
use crate::method::Method;
use crate::render::{Style, View};
use crate::scene::{Scene, Size};

/// Where in a scene the explorer opens.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Opening {
    /// Numbers of the selected sphere and of the camera, as in `radius=2.5`.
    pub set: Vec<String>,
    /// The sphere that is selected, from 1.
    pub sphere: Option<usize>,
    /// The sphere on the line that the panel shows, from 1.
    pub shown: Option<usize>,
    /// The pixel under the cursor.
    pub cursor: Option<(u32, u32)>,
    /// The picture in which the cursor counts, where the scene leaves that open.
    pub size: Option<Size>,
    /// How the quadratic is evaluated.
    pub method: Option<Method>,
    /// How samples become characters.
    pub style: Option<Style>,
    /// What the picture shows.
    pub view: Option<View>,
    /// The panel beside the picture.
    pub panel: Option<Panel>,
    /// The step of the derivation, by name or number.
    pub step: Option<String>,
    /// Where the moving point of slice and curve is.
    pub t: Option<f64>,
    /// The method that the chosen one is compared with.
    pub compare: Option<Method>,
}

impl Explorer {
    /// Goes to a place in the scene that has been opened, or says in a sentence what is wrong.
    pub fn set_out(&mut self, opening: &Opening) -> Result<(), String> {
        let spheres = self.scene().bodies.len();
        let numbered = |flag: &str, n: Option<usize>| match n {
            Some(n) if n == 0 || n > spheres => Err(format!(
                "--{flag} {n}: expected a sphere from 1 to {spheres}"
            )),
            n => Ok(n.map(|n| n - 1)),
        };
        let selected = numbered("sphere", opening.sphere)?.or(self.selected);
        let chosen = numbered("shown", opening.shown)?;
        let scene = with_numbers(self.scene(), selected, &opening.set)?;
        let target = target(opening, scene.pixels)?;
        let method = opening.method.unwrap_or(self.options.method);
        if opening.compare == Some(method) {
            return Err(format!(
                "--compare {method}: expected another method than {method}, which is chosen"
            ));
        }
        if scene != *self.scene() {
            self.document = Document::new(scene);
            self.picture.forget();
        }
        self.selected = selected;
        self.chosen = chosen;
        let options = &mut self.options;
        options.method = opening.method.unwrap_or(options.method);
        options.style = opening.style.unwrap_or(options.style);
        options.view = opening.view.unwrap_or(options.view);
        self.panel = opening.panel.unwrap_or(self.panel);
        self.scrubbed = opening.t.or(self.scrubbed);
        self.other_method = opening.compare.or(self.other_method);
        self.arrival.target = target.or(self.arrival.target);
        if opening.step.is_some() {
            self.arrival.step.clone_from(&opening.step);
        }
        Ok(())
    }

    /// What is wrong with the place that [`Explorer::set_out`] was asked for, as far as only the
    /// picture of a usual screen tells.
    ///
    /// Meant for an explorer that is then thrown away: the cursor stays where that screen has it.
    pub fn rehearse(mut self) -> Result<(), String> {
        let (cols, rows) = plain::SCREEN;
        self.prepare(cols, rows);
        match self.message {
            Some(message) if message.warning => Err(message.text),
            _ => Ok(()),
        }
    }

    /// Shows the command that reopens this view, and asks for it to be copied.
    pub(crate) fn pass_on(&mut self) {
        match self.link() {
            Ok(words) => {
                let line = command_line(&words);
                self.say(format!("Copied, where the terminal allows it: {line}"));
                self.request = Some(Request::Copy(line));
            }
            Err(sentence) => self.warn(sentence),
        }
    }

    /// The words after `rayscope` that reopen this view, or why there are none.
    pub fn link(&self) -> Result<Vec<String>, String> {
        let (mut words, base) = self.way_back()?;
        let numbers = self.numbers_since(&base)?;
        let Options {
            method,
            style,
            view,
            aspect,
            ..
        } = self.options;
        let defaults = Options::default();
        let mut flag = |name: &str, value: String| words.extend([format!("--{name}"), value]);
        flag("method", method.name().into());
        flag("style", style.name().into());
        flag("view", view.name().into());
        let (x, y) = self.cursor;
        flag("cursor", format!("{x},{y}"));
        if base.pixels.is_none() {
            let Size { width, height } = self.size();
            flag("size", format!("{width}x{height}"));
            if aspect.to_bits() != defaults.aspect.to_bits() {
                flag("aspect", aspect.to_string());
            }
        }
        flag("panel", self.panel.name().into());
        if let (Panel::Steps, Some(step)) = (self.panel, self.current_step()) {
            // A name that needs no keys that a keyboard lacks, else the number.
            let plain = step.name.chars().all(|c| c.is_ascii_alphanumeric());
            let number = (self.step_at + 1).to_string();
            flag("step", if plain { step.name.clone() } else { number });
        }
        if matches!(self.panel, Panel::Slice | Panel::Curve) {
            flag("t", self.moving_t().to_string());
        }
        if self.panel == Panel::Compare {
            flag("compare", self.other_method().name().into());
        }
        if let Some(at) = self.selected.filter(|&at| at > 0) {
            flag("sphere", (at + 1).to_string());
        }
        let subject = self.reading().and_then(|r| r.subject.as_ref());
        if let Some(subject) = subject.filter(|s| s.why == Why::Chosen) {
            flag("shown", (subject.body + 1).to_string());
        }
        for number in numbers {
            flag("set", number);
        }
        Ok(words)
    }

    /// What opens the scene, and the scene that opens.
    fn way_back(&self) -> Result<(Vec<String>, Scene), String> {
        let page = self.tour.as_ref().and_then(|tour| tour.way_back());
        match (&self.place, page) {
            (FilePlace::File(stamp), None) => {
                let path = stamp.path();
                let scene = Scene::load(path).map_err(|e| e.to_string())?;
                let name = path.to_str().ok_or_else(|| {
                    format!("{}: this file's name is no text to pass on", path.display())
                })?;
                Ok((vec![as_file(name)], scene))
            }
            (FilePlace::Builtin(builtin), None) => {
                Ok((vec![builtin.name().to_owned()], builtin.scene()))
            }
            (_, Some((words, scene))) => Ok((words, scene.clone())),
            (FilePlace::None, None) => Err(SAVE_FIRST.to_owned()),
        }
    }

    /// The numbers of camera and selected sphere that are other ones than in `base`, as `KEY=VALUE`.
    fn numbers_since(&self, base: &Scene) -> Result<Vec<String>, String> {
        let now = self.scene();
        let values = Field::of(now, self.selected).into_iter().filter_map(|f| {
            let value = f.get(now, self.selected)?;
            let old = f.get(base, self.selected);
            let same = old.is_some_and(|old| old.to_bits() == value.to_bits());
            (!same).then(|| format!("{}={}", f.name(), Decimal(value)))
        });
        let values: Vec<String> = values.collect();
        match with_numbers(base, self.selected, &values) {
            Ok(scene) if scene == *now => Ok(values),
            _ => Err(SAVE_FIRST.to_owned()),
        }
    }
}

/// Why a view can't be passed on.
const SAVE_FIRST: &str =
    "This scene has changes that a command can't carry: save it (ctrl-s), then pass it on.";

/// The scene with other numbers in it.
fn with_numbers(scene: &Scene, selected: Option<usize>, set: &[String]) -> Result<Scene, String> {
    let mut numbers = Vec::new();
    for line in set {
        let key = line.split(['=', ' ']).next().unwrap_or_default();
        if Field::by_name(key).is_none() {
            let names = Field::all_names().join(", ");
            return Err(format!(
                "--set {line}: “{key}” is no key; expected one of {names}"
            ));
        }
        match Command::parse(&format!("set {line}")) {
            Ok(Command::Set(field, value)) => numbers.push((field, value)),
            Ok(_) => return Err(format!("--set {line}: expected a key and a value")),
            Err(sentence) => {
                let reason = sentence.strip_prefix("set: ").unwrap_or(&sentence);
                return Err(format!("--set {line}: {reason}"));
            }
        }
    }
    field::set_all(scene, selected, &numbers).map_err(|refused| format!("--set: {refused}"))
}

/// The cursor's place, held to the picture in which it counts.
fn target(opening: &Opening, own: Option<Size>) -> Result<Option<Target>, String> {
    let Some((x, y)) = opening.cursor else {
        return Ok(None);
    };
    match own.or(opening.size) {
        Some(size) if x >= size.width || y >= size.height => Err(format!(
            "--cursor {x},{y}: expected a pixel of {size}, counted from 0,0"
        )),
        Some(size) => Ok(Some(Target::PixelOf((x, y), size))),
        None => Ok(Some(Target::Pixel(x, y))),
    }
}

/// A file's name that is taken for nothing else.
pub(crate) fn as_file(name: &str) -> String {
    if name.contains('/') {
        name.to_owned()
    } else {
        format!("./{name}")
    }
}

/// The command of those words, for a shell.
pub fn command_line(words: &[String]) -> String {
    let mut line = String::from("rayscope");
    for word in words {
        line.push(' ');
        line += &quoted(word);
    }
    line
}

/// A word as a POSIX shell reads it back unchanged.
fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "_-+=.,/:@%".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', r"'\''"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_quoted_for_a_shell() {
        for (word, shown) in [
            ("trio", "trio"),
            ("--set", "--set"),
            ("position.x=-0.5", "position.x=-0.5"),
            ("./my scene.toml", "'./my scene.toml'"),
            ("./it's", r"'./it'\''s'"),
            ("./$HOME", "'./$HOME'"),
            ("", "''"),
        ] {
            assert_eq!(quoted(word), shown);
        }
    }
}
