//! A view to pass on: the command that reopens it.

use crate::explain::Why;
use crate::explorer::edit::field::{self, NumberField};
use crate::explorer::files::place::FilePlace;
use crate::explorer::options::{Options, Request};
use crate::explorer::panel::Panel;
use crate::explorer::setting::{self, SETTINGS, Setting, SettingRow};
use crate::explorer::state::State;
use crate::explorer::viewpoint::Viewpoint;
use crate::explorer::walk;
use crate::geometry::Decimal;
use crate::scene::{Builtin, Scene};

/// Shows the command that reopens this view, and asks for it to be copied; on a page of the tour,
/// `page` opens it.
pub(crate) fn pass_on(state: &mut State, page: Option<(Vec<String>, &Scene)>) {
    match link(state, page) {
        Ok(words) => {
            let line = command_line(&words);
            state.say(format!("Copied, where the terminal allows it: {line}"));
            state.request = Some(Request::Copy(line));
        }
        Err(sentence) => state.warn(sentence),
    }
}

/// The words after `rayscope` that reopen this view, or why there are none.
pub(crate) fn link(
    state: &State,
    page: Option<(Vec<String>, &Scene)>,
) -> Result<Vec<String>, String> {
    let (mut words, base) = way_back(state, page)?;
    let numbers = numbers_since(state, &base)?;
    let at = as_passed_on(state);
    let fills_its_room = base.pixels.is_none();
    for row in SETTINGS {
        let value = row.write(&at).filter(|_| match row.name {
            "size" => fills_its_room,
            "step" => at.panel == Panel::Steps && state.current_step().is_some(),
            "compare" => at.panel == Panel::Compare,
            "sphere" => at.sphere != Some(0),
            _ => true,
        });
        // A name that needs no keys that a keyboard lacks, else the number.
        let value = value.map(|value| match state.current_step() {
            Some(step) if row.name == "step" && is_plain(&step.name) => step.name.clone(),
            _ => value,
        });
        words.extend(
            value
                .into_iter()
                .flat_map(|value| [format!("--{}", row.name), value]),
        );
    }
    let aspect = state.options.aspect;
    if fills_its_room && aspect.to_bits() != Options::default().aspect.to_bits() {
        words.extend(["--aspect".to_owned(), aspect.to_string()]);
    }
    words.extend(
        numbers
            .into_iter()
            .flat_map(|number| ["--set".to_owned(), number]),
    );
    Ok(words)
}

/// The viewpoint with what the screen shows where the person has left it open.
fn as_passed_on(state: &State) -> Viewpoint {
    let shows_point = matches!(state.at.panel, Panel::Slice | Panel::Curve);
    let chosen = state.subject().filter(|subject| subject.why == Why::Chosen);
    Viewpoint {
        t: shows_point.then(|| walk::moving_t(state)),
        compare: Some(state.other_method()),
        shown: chosen.map(|subject| subject.body),
        size: state.size(),
        ..state.at
    }
}

fn is_plain(name: &str) -> bool {
    name.chars().all(|c| c.is_ascii_alphanumeric())
}

/// What opens the scene, and the scene that opens.
fn way_back(
    state: &State,
    page: Option<(Vec<String>, &Scene)>,
) -> Result<(Vec<String>, Scene), String> {
    match (&state.work.place, page) {
        (FilePlace::File(stamp), None) => {
            let path = stamp.path();
            let scene = Scene::load(path).map_err(|e| e.to_string())?;
            let name = path.to_str().ok_or_else(|| {
                format!(
                    "{}: this file's name is not UTF-8, so no command can carry it",
                    path.display()
                )
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
fn numbers_since(state: &State, base: &Scene) -> Result<Vec<String>, String> {
    let (now, sphere) = (state.scene(), state.at.sphere);
    let values = NumberField::of(now, sphere)
        .into_iter()
        .filter_map(|field| {
            let value = field.get(now, sphere)?;
            let old = field.get(base, sphere);
            let same = old.is_some_and(|old| old.to_bits() == value.to_bits());
            (!same).then_some((field, value))
        });
    let values: Vec<_> = values.collect();
    match field::set_all(base, sphere, &values) {
        Ok(scene) if scene == *now => Ok(values
            .into_iter()
            .map(|(field, value)| format!("{}={}", field.name(), Decimal(value)))
            .collect()),
        _ => Err(SAVE_FIRST.to_owned()),
    }
}

/// Why a view can't be passed on.
const SAVE_FIRST: &str =
    "This scene has changes that a command can't carry: save it ({save}), then pass it on.";

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

/// Where a command that was passed on leads.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Link {
    pub(crate) place: LinkPlace,
    pub(crate) settings: Vec<Setting>,
}

/// What a link opens.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum LinkPlace {
    /// A file or a built-in scene.
    Scene(String),
    /// A page of a chapter that comes with the program, counted from 1.
    Page(String, usize),
}

impl Link {
    /// The page that it opens, if it opens one.
    pub(crate) fn page(&self) -> Option<usize> {
        match self.place {
            LinkPlace::Scene(_) => None,
            LinkPlace::Page(_, page) => Some(page),
        }
    }

    /// Understands `rayscope …`, as [`command_line`] writes it, or says in a sentence why not.
    pub(crate) fn parse(line: &str) -> Result<Self, String> {
        let words = shell_words::split(line)
            .map_err(|_| "rayscope: found a quote without its end, expected a whole command")?;
        let mut words = words.into_iter().skip(1).peekable();
        let is_tour = words.next_if(|word| word == "tour").is_some();
        let (mut names, mut settings, mut page) = (Vec::new(), Vec::new(), 1);
        while let Some(word) = words.next() {
            let Some(flag) = word.strip_prefix("--") else {
                names.push(word);
                continue;
            };
            let (flag, value) = match flag.split_once('=') {
                Some((flag, value)) => (flag.to_owned(), Some(value.to_owned())),
                None => (flag.to_owned(), words.next()),
            };
            let value =
                value.ok_or_else(|| format!("rayscope: expected a value after --{flag}"))?;
            if is_tour && flag == "page" {
                page = value
                    .parse()
                    .map_err(|_| format!("--page {value}: expected a page's number"))?;
                continue;
            }
            let row = SettingRow::by_name(&flag).filter(|row| row.flag.is_some());
            let row = row.ok_or_else(|| {
                format!("rayscope: found --{flag}, expected a scene and flags of a view")
            })?;
            settings.push(setting::parse(row, &value)?);
        }
        let name = match &names[..] {
            [] => Builtin::default().name().to_owned(),
            [name] => name.clone(),
            [_, second, ..] => {
                return Err(format!(
                    "rayscope: found “{second}”, expected one scene and flags of a view"
                ));
            }
        };
        let place = match (is_tour, names.is_empty()) {
            (false, _) => LinkPlace::Scene(name),
            (true, true) => LinkPlace::Page("1".into(), page),
            (true, false) => LinkPlace::Page(name, page),
        };
        Ok(Self { place, settings })
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
