//! The command line that `:` opens: actions by name, and what takes an argument.

use std::path::PathBuf;

use crate::explorer::action::Action;
use crate::explorer::files::workplace::Workplace;
use crate::explorer::link::Link;
use crate::explorer::panel::Panel;
use crate::explorer::setting::{self, SETTINGS, Setting, SettingRow, one_of};
use crate::explorer::tour::chapter as tour;
use crate::lab::{CaseForm, Dial};
use crate::scene::Builtin;
use crate::text::{former_names, nearest};

/// A line that was understood.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Command {
    /// An action, as by its key.
    Do(Action),
    /// Quit without asking.
    QuitNow,
    /// Save, and quit if that left nothing unsaved: an answer, as are the five below.
    SaveAndQuit,
    /// Open a scene without asking.
    OpenNow(String),
    /// Take up work that was kept.
    Recover(PathBuf),
    /// Delete the kept work that is offered.
    Discard,
    /// Write the scene over what this file holds.
    Overwrite(PathBuf),
    /// Open the tour although there are unsaved changes.
    TourNow,
    /// Open a file or a built-in scene.
    Open(String),
    /// Go where a pasted command leads.
    Go(Link),
    /// The same, although there are unsaved changes.
    GoNow(Link),
    /// Save under this name.
    SaveAs(String),
    /// Give a setting a value.
    Set(Setting),
    /// Copy the pixel in this form.
    Copy(CaseForm),
    /// Append the pixel to this file of rows.
    Append(String),
    /// Choose a dial, and turn it to 2^k.
    Dial(&'static Dial, Option<u32>),
    /// Open the tour at this chapter.
    Tour(String),
    /// Open the text of this routine, or of the chosen one.
    Routine(String),
    /// Open its file in the person's own editor.
    Edit(String),
    /// Close the text of a routine: an answer.
    CloseText { save: bool },
}

/// A command with an argument that is no setting: its name, what follows, what it does.
const WITH_ARGUMENT: &[(&str, &str, &str)] = &[
    (
        "open",
        "FILE or NAME",
        "open a scene file or a built-in scene",
    ),
    ("save-as", "FILE", "save the scene under another name"),
    (
        "dial",
        "NAME K",
        "turn this dial on the scene to 2^K; 0 takes it back",
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
    (
        "routine",
        "FILE",
        "type a routine of your own; without FILE, the chosen one",
    ),
    (
        "edit",
        "FILE",
        "the same in $VISUAL or $EDITOR, where a shell started rayscope",
    ),
    ("tour", "CHAPTER", "open the tour at a chapter"),
    ("quit!", "", "quit without asking"),
];

/// All commands with an argument: name, what follows, what it does.
pub fn with_argument() -> impl Iterator<Item = (&'static str, &'static str, &'static str)> {
    let settings = SETTINGS.iter().filter_map(|row| {
        let (argument, help) = row.command?;
        Some((row.name, argument, help))
    });
    WITH_ARGUMENT.iter().copied().chain(settings)
}

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
            return Ok(Self::Set(Setting::Panel(panel)));
        }
        match name {
            "q" | "quit" if rest.is_empty() => Ok(Self::Do(Action::Quit)),
            "q!" | "quit!" if rest.is_empty() => Ok(Self::QuitNow),
            "w" if rest.is_empty() => Ok(Self::Do(Action::Save)),
            "rayscope" => Link::parse(line.trim()).map(Self::Go),
            "open" => argument(rest, "open", "a file or a built-in scene").map(Self::Open),
            "save-as" | "save" | "w" => argument(rest, name, "a file name").map(Self::SaveAs),
            "copy" => choice(rest, "copy", &CaseForm::ALL, CaseForm::name).map(Self::Copy),
            "append" => argument(rest, "append", "a file name").map(Self::Append),
            "dial" => dial(rest),
            "tour" => argument(rest, "tour", "a chapter's name or number").map(Self::Tour),
            "routine" => Ok(Self::Routine(rest.to_owned())),
            "edit" => Ok(Self::Edit(rest.to_owned())),
            "" => Err("Type a command; tab completes, esc leaves.".into()),
            _ => match SettingRow::by_name(name).filter(|row| row.command.is_some()) {
                Some(row) => setting::parse(row, rest).map(Self::Set),
                None if Action::by_name(name).is_some() => {
                    Err(format!("{name}: takes no argument, found “{rest}”"))
                }
                None => Err(unknown(name)),
            },
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

fn choice<T: Copy>(
    rest: &str,
    what: &str,
    all: &[T],
    name: fn(T) -> &'static str,
) -> Result<T, String> {
    one_of(rest, all, name).map_err(|expected| format!("{what}: found “{rest}”, {expected}"))
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
    let dials: Vec<_> = Dial::of_scenes().collect();
    let dial = choice(name, "dial", &dials, |dial| dial.name)?;
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

fn names() -> Vec<&'static str> {
    let mut names: Vec<_> = Action::ALL.iter().map(|a| a.name()).collect();
    names.extend(with_argument().map(|(name, ..)| name));
    names.sort_unstable();
    names.dedup();
    names
}

/// A line that what was typed could become.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Candidate {
    /// The line.
    pub line: String,
    /// The keys that do the same, or what has to follow.
    pub keys: String,
    /// What it does.
    pub help: &'static str,
}

/// How the names of scene files end, and those of routines.
const SCENES: [&str; 1] = ["toml"];
const ROUTINES: [&str; 2] = ["glsl", "wgsl"];

/// All lines that the line typed so far could become: of names, the likeliest first.
pub fn candidates(line: &str, workplace: &Workplace) -> Vec<Candidate> {
    let Some((name, typed)) = line.split_once(' ') else {
        return named_like(line);
    };
    let words = match name {
        "copy" => CaseForm::ALL.iter().map(|f| f.name().to_owned()).collect(),
        "dial" => Dial::of_scenes().map(|d| d.name.to_owned()).collect(),
        "tour" => tour::builtin().iter().map(|c| c.name.clone()).collect(),
        "open" => {
            let mut words: Vec<_> = Builtin::ALL.iter().map(|b| b.name().to_owned()).collect();
            words.extend(workplace.names_starting_with(typed, &SCENES));
            words
        }
        "save-as" | "append" => workplace.names_starting_with(typed, &SCENES),
        "routine" | "edit" => workplace.names_starting_with(typed, &ROUTINES),
        "method" | "compare" => {
            let mut words = SettingRow::by_name(name).map_or_else(Vec::new, |row| (row.choices)());
            words.extend(workplace.names_starting_with(typed, &ROUTINES));
            words
        }
        _ => SettingRow::by_name(name).map_or_else(Vec::new, |row| (row.choices)()),
    };
    let words = words.into_iter().filter(|word| word.starts_with(typed));
    words
        .map(|word| Candidate {
            line: format!("{name} {word}"),
            keys: String::new(),
            help: "",
        })
        .collect()
}

/// Actions and commands whose names or sentences have something of what was typed.
fn named_like(typed: &str) -> Vec<Candidate> {
    let of_action = |action: &Action| Candidate {
        line: action.name().to_owned(),
        keys: match action.keys() {
            [] => action.prefix(),
            keys => keys.join(" "),
        },
        help: action.help(),
    };
    let commands = with_argument().map(|(name, argument, help)| Candidate {
        line: name.to_owned(),
        keys: argument.to_owned(),
        help,
    });
    let all = Action::ALL.iter().map(of_action).chain(commands);
    let mut found: Vec<_> = all
        .filter_map(|candidate| Some((unlikeness(&candidate, typed)?, candidate)))
        .collect();
    found.sort_by_key(|(unlikeness, _)| *unlikeness);
    found.into_iter().map(|(_, candidate)| candidate).collect()
}

/// How far what was typed is from a candidate; none if it has nothing of it.
fn unlikeness(candidate: &Candidate, typed: &str) -> Option<u8> {
    let name = candidate.line.as_str();
    let typed = typed.to_lowercase();
    if name.starts_with(&typed) {
        Some(0)
    } else if former_names(name).any(|former| former.starts_with(&typed)) {
        Some(1)
    } else if name.split('-').any(|word| word.starts_with(&typed)) {
        Some(2)
    } else if name.contains(&typed) {
        Some(3)
    } else if candidate.help.to_lowercase().contains(&typed) {
        Some(4)
    } else {
        let mut rest = name.chars();
        let is_within = typed.chars().all(|c| rest.any(|other| other == c));
        is_within.then_some(5)
    }
}
