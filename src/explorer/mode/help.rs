//! The help page: all keys, all commands, and how the screen is drawn. Its lines can be found by a
//! word and done.

use ratatui::layout::{Position, Rect};
use ratatui::style::Style as CellStyle;
use unicode_width::UnicodeWidthStr;

use crate::explorer::action::{Action, Group};
use crate::explorer::command::{Command, with_argument};
use crate::explorer::dialog::{Dialog, Purpose};
use crate::explorer::draw::layout::{self, Layout};
use crate::explorer::draw::pen::Pen;
use crate::explorer::draw::theme::Theme;
use crate::explorer::key::Key;
use crate::explorer::mode::line::TypedLine;
use crate::explorer::mode::overlay::{After, ModeArea, Overlay};
use crate::explorer::options::Options;
use crate::explorer::state::State;

/// How many lines page up and page down go.
const PAGE: isize = 10;

/// The help page: the chosen line, and what lines are looked for.
#[derive(Debug, Default, PartialEq)]
pub(crate) struct Help {
    at: usize,
    /// What is typed to find lines, once `/` was pressed.
    filter: Option<TypedLine>,
}

/// A line of the page.
struct HelpLine {
    /// A heading, or keys.
    left: String,
    /// What they do.
    right: String,
    does: Does,
}

/// What enter on a line does.
#[derive(Clone, Copy)]
enum Does {
    Nothing,
    Act(Action),
    /// Opens the command line with this name on it.
    Type(&'static str),
}

impl HelpLine {
    fn heading(title: &str) -> Self {
        Self {
            left: title.into(),
            right: String::new(),
            does: Does::Nothing,
        }
    }

    /// Whether it has all these words in what it shows or in its name.
    fn has(&self, words: &str) -> bool {
        let name = match self.does {
            Does::Act(action) => action.name(),
            Does::Type(name) => name,
            Does::Nothing => return false,
        };
        let text = format!("{} {} {name}", self.left, self.right).to_lowercase();
        words
            .to_lowercase()
            .split_whitespace()
            .all(|word| text.contains(word))
    }
}

impl Help {
    /// The lines that are shown: all, or those that were looked for.
    fn lines(&self, options: Options) -> Vec<HelpLine> {
        let mut lines = page(options);
        let words = self.filter.as_ref().map(TypedLine::text);
        if let Some(words) = words.filter(|words| !words.trim().is_empty()) {
            lines.retain(|line| line.has(&words));
        }
        lines
    }

    fn go(&mut self, by: isize, state: &State) {
        let last = self.lines(state.options).len().saturating_sub(1);
        self.at = self.at.saturating_add_signed(by).min(last);
    }

    /// Does what the chosen line says.
    fn take(&self, state: &mut State) -> After {
        let lines = self.lines(state.options);
        match lines.get(self.at).map(|line| line.does) {
            Some(Does::Act(action)) => After::Do(Command::Do(action)),
            Some(Does::Type(name)) => {
                state.open(Dialog::Prompt(Purpose::Command, format!("{name} ")));
                After::Close
            }
            Some(Does::Nothing) | None => After::Stay,
        }
    }
}

impl Overlay for Help {
    fn press(&mut self, key: Key, state: &mut State) -> After {
        let is = |name| key.is(name);
        if is("enter") {
            return self.take(state);
        } else if is("esc") {
            if self.filter.take().is_none() {
                return After::Close;
            }
            self.at = 0;
        } else if is("f1") {
            return After::Close;
        } else if is("down") {
            self.go(1, state);
        } else if is("up") {
            self.go(-1, state);
        } else if is("pagedown") {
            self.go(PAGE, state);
        } else if is("pageup") {
            self.go(-PAGE, state);
        } else if let Some(filter) = &mut self.filter {
            if filter.edit(key) {
                self.at = 0;
            }
        } else if is("/") {
            (self.filter, self.at) = (Some(TypedLine::default()), 0);
        } else if is("j") {
            self.go(1, state);
        } else if is("k") {
            self.go(-1, state);
        } else if is("space") {
            self.go(PAGE, state);
        }
        After::Stay
    }

    fn paste(&mut self, text: &str, _: &mut State) -> bool {
        let filter = self.filter.as_mut();
        filter.map(|filter| filter.insert(text)).is_some()
    }

    fn scroll(&mut self, lines: isize, state: &State) -> bool {
        self.go(lines, state);
        true
    }

    fn place(&self, _: &Layout) -> ModeArea {
        ModeArea::Body
    }

    fn draw(&self, state: &State, pen: &mut Pen<'_>, area: Rect) -> Option<Position> {
        let lines = self.lines(state.options);
        let room = layout::inner(area);
        let height = usize::from(room.height);
        // The chosen line is in the middle, as far as there are lines around it.
        let last = lines.len().saturating_sub(height);
        let first = self.at.saturating_sub(height / 2).min(last);
        let below = lines.len().saturating_sub(first + height);
        let foot = if below > 0 {
            format!("{below} lines below")
        } else {
            String::new()
        };
        pen.frame(area, "keys", &foot);
        for (y, (n, line)) in (room.top()..room.bottom()).zip(lines.iter().enumerate().skip(first))
        {
            let does_something = !matches!(line.does, Does::Nothing);
            let style = if n == self.at && does_something {
                Theme::chosen()
            } else {
                CellStyle::new()
            };
            pen.text(room.x, y, room.width, &" ".repeat(room.width.into()), style);
            let width = room.width.saturating_sub(1);
            let x = pen.text(
                room.x + 1,
                y,
                width,
                &line.left,
                style.patch(Theme::strong()),
            );
            let column = (room.x + 24).max(x + 1);
            let space = room.right().saturating_sub(column);
            pen.text(column, y, space, &line.right, style);
        }
        None
    }

    fn foot(&self) -> &[(&'static str, &'static str)] {
        &[
            ("/", "find"),
            ("arrows", "choose"),
            ("enter", "do it"),
            ("esc", "back"),
        ]
    }

    fn has_footer(&self) -> bool {
        self.filter.is_some()
    }

    fn draw_footer(&self, state: &State, pen: &mut Pen<'_>, area: Rect) -> Option<Position> {
        let filter = self.filter.as_ref()?;
        let x = pen.text(area.x, area.y, area.width, "/", Theme::strong());
        let room = area.right().saturating_sub(x);
        let text = filter.text();
        let end = pen.text(x, area.y, room, &text, CellStyle::new());
        let count = self.lines(state.options).len();
        let aside = match count {
            0 => "nothing found   esc clears".to_owned(),
            _ => format!("{count} lines   enter does the chosen one   esc clears"),
        };
        let room = area.right().saturating_sub(end + 3);
        pen.text(end + 3, area.y, room, &aside, Theme::faint());
        let before: String = text.chars().take(filter.cursor()).collect();
        let at = x + before.width() as u16;
        Some(Position::new(at.min(area.right().max(1) - 1), area.y))
    }
}

/// The lines of the page: a heading, or keys and what they do.
fn page(options: Options) -> Vec<HelpLine> {
    let mut out = Vec::new();
    for group in Group::ALL {
        out.push(HelpLine::heading(group.title()));
        for &action in Action::ALL.iter().filter(|a| a.group() == group) {
            let keys = match action.keys() {
                [] => action.prefix(),
                keys => keys.join(" "),
            };
            out.push(HelpLine {
                left: format!("  {keys}"),
                right: action.help().into(),
                does: Does::Act(action),
            });
        }
        out.push(HelpLine::heading(""));
    }
    out.push(HelpLine::heading("Commands after :"));
    for (name, argument, help) in with_argument() {
        out.push(HelpLine {
            left: format!("  {name} {argument}"),
            right: help.into(),
            does: Does::Type(name),
        });
    }
    out.extend(of_terminal(options));
    out
}

/// How the screen is drawn, and why so.
fn of_terminal(options: Options) -> Vec<HelpLine> {
    let Options {
        depth,
        palette,
        glyphs,
        reasons,
        ..
    } = options;
    let line = |name: &str, what: &str, why: &str, does: Does| HelpLine {
        left: format!("  {name}"),
        right: format!("{what} ({why})"),
        does,
    };
    vec![
        HelpLine::heading(""),
        HelpLine::heading("This terminal"),
        line(
            "# colours",
            depth.words(),
            reasons.depth,
            Does::Act(Action::NextColor),
        ),
        line(
            "@ theme",
            palette.name(),
            reasons.palette,
            Does::Act(Action::NextTheme),
        ),
        line("characters", glyphs.name(), reasons.glyphs, Does::Nothing),
    ]
}
