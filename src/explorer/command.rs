//! The command line that `:` opens: actions by name, and what takes an argument.

use crate::lab::{CaseForm, Dial};
use crate::method::Method;
use crate::render::{ColorDepth, Style, View};
use crate::scene::Builtin;
use crate::text::nearest;

use crate::explorer::action::Action;
use crate::explorer::draw::theme::Palette;
use crate::explorer::edit::field::{Field, parse_number};
use crate::explorer::files::workplace::Workplace;
use crate::explorer::panel::Panel;
use crate::explorer::tour::chapter as tour;
use crate::text::by_name;

/// A line that was understood.
#[derive(Debug, Clone, PartialEq)]
pub enum Command {
    /// An action, as by its key.
    Do(Action),
    /// Quit without asking.
    QuitNow,
    /// Open a file or a built-in scene.
    Open(String),
    /// Save under this name.
    SaveAs(String),
    /// Use this method.
    Method(Method),
    /// Draw in this style.
    Style(Style),
    /// Show this view.
    View(View),
    /// Use the colours of this theme.
    Palette(Palette),
    /// Use so many colours.
    Color(ColorDepth),
    /// Put the cursor on a pixel.
    Cursor(u32, u32),
    /// Select the sphere of that number, from 1.
    Sphere(usize),
    /// Give a number a value.
    Set(Field, f32),
    /// Make steps of sphere and camera this long.
    Stride(f32),
    /// Show this panel.
    Panel(Panel),
    /// Copy the pixel in this form.
    Copy(CaseForm),
    /// Append the pixel to this file of rows.
    Append(String),
    /// Choose a dial, and turn it to 2^k.
    Dial(&'static Dial, Option<u32>),
    /// Go to the step of the derivation of that name or number.
    Step(String),
    /// Put the moving point of slice and curve at this t.
    At(f64),
    /// Open the tour at this chapter.
    Tour(String),
    /// Compare with this method.
    Compare(Method),
    /// Take cells to be this many times as high as wide.
    Aspect(f64),
}

/// A command with an argument: its name, what follows, what it does.
pub const WITH_ARGUMENT: &[(&str, &str, &str)] = &[
    (
        "open",
        "FILE or NAME",
        "open a scene file or a built-in scene",
    ),
    ("save-as", "FILE", "save the scene under another name"),
    ("method", "NAME", "evaluate the quadratic by this method"),
    ("style", "NAME", "draw the picture in this style"),
    ("view", "NAME", "show this view"),
    ("theme", "NAME", "draw in the colours of this theme"),
    (
        "color",
        "DEPTH",
        "use so many colours: never, 16, 256, true",
    ),
    ("cursor", "X Y", "put the cursor on a pixel"),
    ("sphere", "N", "select the sphere of that number"),
    (
        "set",
        "KEY VALUE",
        "give a number of the sphere or the camera a value",
    ),
    ("panel", "NAME", "show this panel"),
    (
        "dial",
        "NAME K",
        "turn the scene along this dial by 2^K; 0 takes it back",
    ),
    (
        "copy",
        "FORM",
        "copy this pixel as a row, or as a test case: row, c, rust",
    ),
    (
        "append",
        "FILE",
        "append this pixel to a CSV file for `rayscope grade`",
    ),
    ("step", "NAME", "go to the step of that name or number"),
    (
        "t",
        "VALUE",
        "put the moving point of slice and curve at this t",
    ),
    ("compare", "NAME", "compare with this method"),
    ("tour", "CHAPTER", "open the tour at a chapter"),
    ("stride", "LENGTH", "move and grow spheres by this much"),
    (
        "aspect",
        "RATIO",
        "take cells to be this many times as high as wide",
    ),
    ("quit!", "", "quit without asking"),
];

impl Command {
    /// Understands a line, or says in a sentence why not.
    pub fn parse(line: &str) -> Result<Self, String> {
        let (name, rest) = match line.trim().split_once(char::is_whitespace) {
            Some((name, rest)) => (name, rest.trim()),
            None => (line.trim(), ""),
        };
        if let (true, Some(action)) = (rest.is_empty(), Action::by_name(name)) {
            return Ok(Self::Do(action));
        }
        // A panel opens by its bare name, too.
        let panel = Panel::ALL.into_iter().find(|panel| panel.name() == name);
        if let (true, Some(panel)) = (rest.is_empty(), panel) {
            return Ok(Self::Panel(panel));
        }
        match name {
            "q" | "quit" if rest.is_empty() => Ok(Self::Do(Action::Quit)),
            "q!" | "quit!" if rest.is_empty() => Ok(Self::QuitNow),
            "w" if rest.is_empty() => Ok(Self::Do(Action::Save)),
            "open" => argument(rest, "open", "a file or a built-in scene").map(Self::Open),
            "save-as" | "save" | "w" => argument(rest, name, "a file name").map(Self::SaveAs),
            "method" => choice(rest, "method", Method::ALL, Method::name).map(Self::Method),
            "style" => choice(rest, "style", Style::ALL, Style::name).map(Self::Style),
            "view" => choice(rest, "view", View::ALL, View::name).map(Self::View),
            "theme" => choice(rest, "theme", Palette::ALL, Palette::name).map(Self::Palette),
            "color" => choice(rest, "color", ColorDepth::ALL, ColorDepth::name).map(Self::Color),
            "cursor" => cursor(rest),
            "sphere" => match rest.parse() {
                Ok(n) if n > 0 => Ok(Self::Sphere(n)),
                _ => Err(format!("sphere: found “{rest}”, expected a number from 1")),
            },
            "set" => set(rest),
            "stride" => positive(rest, "stride").map(Self::Stride),
            "panel" => choice(rest, "panel", Panel::ALL, Panel::name).map(Self::Panel),
            "copy" => choice(rest, "copy", CaseForm::ALL, CaseForm::name).map(Self::Copy),
            "append" => argument(rest, "append", "a file name").map(Self::Append),
            "dial" => dial(rest),
            "tour" => argument(rest, "tour", "a chapter's name or number").map(Self::Tour),
            "step" => argument(rest, "step", "a step's name or number").map(Self::Step),
            "t" => match parse_number("t", rest) {
                Ok(t) => Ok(Self::At(t.into())),
                Err(e) => Err(e.to_string()),
            },
            "compare" => choice(rest, "compare", Method::ALL, Method::name).map(Self::Compare),
            "aspect" => positive(rest, "aspect").map(|a| Self::Aspect(a.into())),
            "" => Err("Type a command; tab completes, esc leaves.".into()),
            _ if Action::by_name(name).is_some() => {
                Err(format!("{name}: takes no argument, found “{rest}”"))
            }
            _ => Err(unknown(name)),
        }
    }
}

/// Why a line that starts with that word is no command.
pub fn unknown(name: &str) -> String {
    let meant = nearest(name, names()).map_or(String::new(), |n| format!(", {n} is"));
    format!("“{name}” is no command{meant}; tab lists them")
}

fn argument(rest: &str, name: &str, expected: &str) -> Result<String, String> {
    if rest.is_empty() {
        Err(format!("{name}: expected {expected} after it"))
    } else {
        Ok(rest.to_owned())
    }
}

pub(crate) fn choice<T: Copy>(
    rest: &str,
    what: &str,
    all: impl IntoIterator<Item = T>,
    name: impl Fn(T) -> &'static str,
) -> Result<T, String> {
    let all: Vec<T> = all.into_iter().collect();
    by_name(all.iter().copied(), &name, rest).ok_or_else(|| {
        let names: Vec<_> = all.into_iter().map(name).collect();
        format!(
            "{what}: found “{rest}”, expected one of {}",
            names.join(", ")
        )
    })
}

fn dial(rest: &str) -> Result<Command, String> {
    let (name, k) = match rest.split_once(char::is_whitespace) {
        Some((name, k)) => (name, Some(k.trim())),
        None => (rest, None),
    };
    if let Some(dial) = Dial::by_name(name).filter(|dial| dial.on_scenes().is_none()) {
        let name = dial.name;
        return Err(format!(
            "dial: scenes have no {name}; `rayscope stress --dial {name}` turns it on rays"
        ));
    }
    let dial = choice(name, "dial", Dial::of_scenes(), |dial| dial.name)?;
    let Some(k) = k else {
        return Ok(Command::Dial(dial, None));
    };
    let settings = || std::iter::once(0).chain(dial.turns());
    match k.trim_start_matches("2^").parse().ok() {
        Some(k) if settings().any(|setting| setting == k) => Ok(Command::Dial(dial, Some(k))),
        _ => Err(format!(
            "dial: found “{k}”, expected 0 to {} in steps of {}",
            settings().last().unwrap_or(0),
            dial.step()
        )),
    }
}

fn cursor(rest: &str) -> Result<Command, String> {
    let mut numbers = rest
        .split([' ', ','])
        .filter(|s| !s.is_empty())
        .map(str::parse);
    match (numbers.next(), numbers.next(), numbers.next()) {
        (Some(Ok(x)), Some(Ok(y)), None) => Ok(Command::Cursor(x, y)),
        _ => Err(format!(
            "cursor: found “{rest}”, expected a pixel, as in “cursor 20 20”"
        )),
    }
}

fn set(rest: &str) -> Result<Command, String> {
    let (key, value) = rest
        .split_once(|c: char| c.is_whitespace() || c == '=')
        .ok_or_else(|| format!("set: found “{rest}”, expected a key and a value"))?;
    let field =
        Field::by_name(key).ok_or_else(|| format!("set: “{key}” is no key; tab lists them"))?;
    let value = parse_number(key, value.trim_start_matches(['=', ' ']));
    value
        .map(|v| Command::Set(field, v))
        .map_err(|e| e.to_string())
}

fn positive(rest: &str, what: &str) -> Result<f32, String> {
    match parse_number(what, rest) {
        Ok(value) if value > 0.0 => Ok(value),
        Ok(_) => Err(format!("{what} is {rest}: expected a number above zero")),
        Err(e) => Err(e.to_string()),
    }
}

fn names() -> Vec<&'static str> {
    let mut names: Vec<_> = Action::ALL.iter().map(|a| a.name()).collect();
    names.extend(WITH_ARGUMENT.iter().map(|(name, ..)| *name));
    names.sort_unstable();
    names.dedup();
    names
}

/// All lines that the line typed so far could become, in order.
pub fn complete(line: &str, workplace: &Workplace) -> Vec<String> {
    let starting = |words: Vec<String>, head: &str, typed: &str| {
        words
            .into_iter()
            .filter(|w| w.starts_with(typed))
            .map(|w| format!("{head}{w}"))
            .collect()
    };
    let Some((name, typed)) = line.split_once(' ') else {
        let words = names().into_iter().map(str::to_owned).collect();
        return starting(words, "", line);
    };
    let head = format!("{name} ");
    let words = match name {
        "panel" => Panel::ALL.iter().map(|p| p.name().to_owned()).collect(),
        "method" | "compare" => Method::ALL.iter().map(|m| m.name().to_owned()).collect(),
        "style" => Style::ALL.iter().map(|s| s.name().to_owned()).collect(),
        "theme" => Palette::ALL.iter().map(|p| p.name().to_owned()).collect(),
        "color" => ColorDepth::ALL
            .iter()
            .map(|d| d.name().to_owned())
            .collect(),
        "view" => View::ALL.iter().map(|v| v.name().to_owned()).collect(),
        "set" => Field::all_names(),
        "copy" => CaseForm::ALL.iter().map(|f| f.name().to_owned()).collect(),
        "dial" => Dial::of_scenes().map(|d| d.name.to_owned()).collect(),
        "tour" => tour::builtin().iter().map(|c| c.name.clone()).collect(),
        "open" => {
            let mut words: Vec<_> = Builtin::ALL.iter().map(|b| b.name().to_owned()).collect();
            words.extend(workplace.names_starting_with(typed));
            words
        }
        "save-as" | "append" => workplace.names_starting_with(typed),
        _ => Vec::new(),
    };
    starting(words, &head, typed)
}
