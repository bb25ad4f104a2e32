//! The help page: all keys, all commands, and how the screen is drawn.

use ratatui::layout::{Position, Rect};
use ratatui::style::Style as CellStyle;

use crate::explorer::action::{Action, Group};
use crate::explorer::command::with_argument;
use crate::explorer::draw::layout::{self, Layout};
use crate::explorer::draw::pen::Pen;
use crate::explorer::draw::theme::Theme;
use crate::explorer::key::Key;
use crate::explorer::mode::overlay::{After, ModeArea, Overlay};
use crate::explorer::options::Options;
use crate::explorer::state::State;

/// The help page, scrolled by lines.
#[derive(Debug, Default, PartialEq)]
pub(crate) struct Help {
    scroll: usize,
}

impl Overlay for Help {
    fn press(&mut self, key: Key, state: &mut State) -> After {
        let by = if key.is("down") || key.is("j") {
            1
        } else if key.is("up") || key.is("k") {
            -1
        } else if key.is("pagedown") || key.is("space") {
            10
        } else if key.is("pageup") {
            -10
        } else {
            return After::Close;
        };
        self.scroll(by, state);
        After::Stay
    }

    fn scroll(&mut self, lines: isize, state: &State) -> bool {
        let last = page(state.options).len() - 1;
        self.scroll = self.scroll.saturating_add_signed(lines).min(last);
        true
    }

    fn place(&self, _: &Layout) -> ModeArea {
        ModeArea::Body
    }

    fn draw(&self, state: &State, pen: &mut Pen<'_>, area: Rect) -> Option<Position> {
        let lines = page(state.options);
        let room = layout::inner(area);
        let scroll = self
            .scroll
            .min(lines.len().saturating_sub(room.height.into()));
        let below = lines
            .len()
            .saturating_sub(scroll + usize::from(room.height));
        let foot = if below > 0 {
            format!("{below} lines below: down, space")
        } else {
            String::new()
        };
        pen.frame(area, "keys", &foot);
        for (y, (key, words)) in (room.top()..room.bottom()).zip(&lines[scroll..]) {
            let width = room.width.saturating_sub(1);
            let x = pen.text(room.x + 1, y, width, key, Theme::strong());
            let column = (room.x + 24).max(x + 1);
            let space = room.right().saturating_sub(column);
            pen.text(column, y, space, words, CellStyle::new());
        }
        None
    }

    fn foot(&self) -> &[(&'static str, &'static str)] {
        &[("arrows", "scroll"), ("esc", "back")]
    }
}

/// The lines of the page: a heading, or keys and what they do.
fn page(options: Options) -> Vec<(String, String)> {
    let mut out = of_terminal(options);
    for group in Group::ALL {
        out.push((group.title().to_owned(), String::new()));
        for action in Action::ALL.iter().filter(|a| a.group() == group) {
            out.push((
                format!("  {}", action.keys().join(" ")),
                action.help().into(),
            ));
        }
        out.push(Default::default());
    }
    out.push(("Commands after :".into(), String::new()));
    for (name, argument, help) in with_argument() {
        out.push((format!("  {name} {argument}"), help.into()));
    }
    out
}

/// How the screen is drawn, and why so.
fn of_terminal(options: Options) -> Vec<(String, String)> {
    let Options {
        depth,
        palette,
        glyphs,
        reasons,
        ..
    } = options;
    let line = |name: &str, what: &str, why: &str| {
        let words = format!("{what} ({why})");
        (format!("  {name}"), words)
    };
    vec![
        ("This terminal".into(), String::new()),
        line("# colours", depth.words(), reasons.depth),
        line("@ theme", palette.name(), reasons.palette),
        line("characters", glyphs.name(), reasons.glyphs),
        Default::default(),
    ]
}
