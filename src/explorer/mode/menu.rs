//! The menu: all actions in four columns, chosen by arrows, letters or the mouse and done by enter.
//!
//! What belongs together is one row of a column. The letter of a column, or enter on a row of several
//! actions, lists all actions of the column, each with the letter that chooses it.

use ratatui::layout::{Position, Rect};
use ratatui::style::Style as CellStyle;
use ratatui::widgets::{Clear, Widget};
use unicode_width::UnicodeWidthStr;

use crate::explorer::action::{Action, Column};
use crate::explorer::command::Command;
use crate::explorer::draw::layout;
use crate::explorer::draw::pen::Pen;
use crate::explorer::draw::theme::Theme;
use crate::explorer::key::Key;
use crate::explorer::mode::overlay::{After, Overlay};
use crate::explorer::state::State;

/// The widest and the highest that the menu gets, its border included.
const MOST: (u16, u16) = (104, 22);
/// From this width on all columns are side by side.
const WIDE: u16 = 72;
/// The width of an action in the list of a column: its letter, its name, its keys.
const ENTRY: u16 = 38;

/// The menu, and what is chosen in it.
#[derive(Debug, PartialEq)]
pub(crate) struct Menu {
    column: usize,
    item: usize,
    /// All actions of the column are listed, each by itself.
    is_listing: bool,
}

impl Default for Menu {
    /// The first row of the second column, which is what a lesson goes on with: the next step.
    fn default() -> Self {
        Self {
            column: 1,
            item: 0,
            is_listing: false,
        }
    }
}

/// A part of the menu on the screen.
struct Part {
    column: usize,
    /// The cells within its border.
    room: Rect,
    /// How many items are beside one another, and the first that is shown.
    across: usize,
    first: usize,
}

impl Menu {
    fn column(&self) -> Column {
        Column::ALL[self.column]
    }

    /// What can be chosen in a column.
    fn items_of(&self, column: usize) -> Vec<Vec<Action>> {
        let column = Column::ALL[column];
        if self.is_listing {
            column.actions().map(|action| vec![action]).collect()
        } else {
            column.rows()
        }
    }

    fn items(&self) -> Vec<Vec<Action>> {
        self.items_of(self.column)
    }

    fn chosen(&self) -> Vec<Action> {
        self.items().swap_remove(self.item)
    }

    /// Goes by a number of columns, or of actions in a list.
    fn go(&mut self, right: isize, down: isize, state: &State) {
        let count = |menu: &Self| menu.items().len() as isize;
        if self.is_listing {
            let [part] = &self.parts(state)[..] else {
                return;
            };
            let by = down + right * part.room.height as isize;
            let to = self.item as isize + by;
            if right == 0 {
                self.item = to.rem_euclid(count(self)) as usize;
            } else if (0..count(self)).contains(&to) {
                self.item = to as usize;
            }
            return;
        }
        let columns = Column::ALL.len() as isize;
        self.column = (self.column as isize + right).rem_euclid(columns) as usize;
        self.item = if right == 0 {
            (self.item as isize + down).rem_euclid(count(self)) as usize
        } else {
            self.item.min(count(self) as usize - 1)
        };
    }

    /// Lists all actions of a column, the first of them or `chosen` chosen.
    fn list(&mut self, column: usize, chosen: Option<Action>) {
        (self.column, self.is_listing) = (column, true);
        self.item = self
            .column()
            .actions()
            .position(|action| Some(action) == chosen)
            .unwrap_or(0);
    }

    /// Goes back from a column's list to all columns; false if they are shown.
    fn shows_all_again(&mut self) -> bool {
        let chosen = self.chosen()[0];
        if !std::mem::take(&mut self.is_listing) {
            return false;
        }
        let rows = self.items();
        let row = rows.iter().position(|row| row.contains(&chosen));
        self.item = row.unwrap_or(0);
        true
    }

    /// Does what is chosen; what is several actions is listed first.
    fn take(&mut self) -> After {
        match self.chosen()[..] {
            [action] => After::Do(Command::Do(action)),
            ref row => {
                self.list(self.column, Some(row[0]));
                After::Stay
            }
        }
    }

    /// Chooses what a letter is for. Nothing is done by it: a word that is typed here does no harm.
    fn choose(&mut self, letter: char, key: Key, state: &State) {
        if self.is_listing {
            let by_letter = |action: Action| action.letter() == letter;
            if let Some(item) = self.column().actions().position(by_letter) {
                self.item = item;
            }
            return;
        }
        let is_it = |column: &Column| column.letter() == letter;
        if let Some(column) = Column::ALL.iter().position(is_it) {
            return self.list(column, None);
        }
        let Some(action) = action_of(key, state) else {
            return;
        };
        for column in 0..Column::ALL.len() {
            let rows = self.items_of(column);
            if let Some(item) = rows.iter().position(|row| row.contains(&action)) {
                (self.column, self.item) = (column, item);
            }
        }
    }

    /// Where the menu is: over the footer, as large as it needs and the screen allows.
    fn area(state: &State) -> Rect {
        let (cols, rows) = state.screen;
        let (width, height) = (cols.min(MOST.0), rows.saturating_sub(1).min(MOST.1));
        Rect::new(
            (cols - width) / 2,
            rows.saturating_sub(1) - height,
            width,
            height,
        )
    }

    /// The parts of the menu that are shown, from left to right.
    fn parts(&self, state: &State) -> Vec<Part> {
        let area = Self::area(state);
        if self.is_listing || area.width < WIDE {
            let room = layout::inner(area);
            let across = if self.is_listing {
                (room.width / ENTRY).max(1)
            } else {
                1
            };
            let shown = usize::from(across * room.height).max(1);
            return vec![Part {
                column: self.column,
                room,
                across: across.into(),
                first: self.item / shown * shown,
            }];
        }
        let count = Column::ALL.len() as u16;
        let edge = |n: u16| area.x + area.width * n / count;
        let part = |n: u16| Part {
            column: n.into(),
            room: layout::inner(Rect {
                x: edge(n),
                width: edge(n + 1) - edge(n),
                ..area
            }),
            across: 1,
            first: if usize::from(n) == self.column {
                (self.item + 1).saturating_sub(area.height.saturating_sub(2).into())
            } else {
                0
            },
        };
        (0..count).map(part).collect()
    }

    fn draw_part(&self, part: &Part, state: &State, pen: &mut Pen<'_>) {
        let Part { column, room, .. } = *part;
        let border = Rect {
            x: room.x - 1,
            y: room.y - 1,
            width: room.width + 2,
            height: room.height + 2,
        };
        let named = |column: &Column| format!("{} {}", column.letter(), column.title());
        let title = if Self::area(state).width < WIDE && !self.is_listing {
            let mut titles = Column::ALL.each_ref().map(named);
            titles[self.column] = titles[self.column].to_uppercase();
            titles.join(" ")
        } else {
            named(&Column::ALL[column])
        };
        let items = self.items_of(column);
        let places = items.len().saturating_sub(part.first);
        let hidden = places.saturating_sub(part.across * usize::from(room.height));
        let foot = if hidden > 0 {
            format!("{hidden} more")
        } else {
            String::new()
        };
        pen.frame(border, &title, &foot);
        for (n, item) in items.iter().enumerate().skip(part.first) {
            let Some(cells) = part.place(n) else { break };
            let style = if (column, n) == (self.column, self.item) {
                Theme::chosen()
            } else {
                CellStyle::new()
            };
            if self.is_listing {
                draw_action(item[0], state, pen, cells, style);
            } else {
                draw_row(item, state, pen, cells, style);
            }
        }
    }
}

impl Part {
    /// Where an item is, if it is shown.
    fn place(&self, item: usize) -> Option<Rect> {
        let Rect { height, width, .. } = self.room;
        let n = item.checked_sub(self.first)?;
        let (across, down) = (
            n / usize::from(height.max(1)),
            n % usize::from(height.max(1)),
        );
        if height == 0 || across >= self.across {
            return None;
        }
        let width = width / self.across as u16;
        Some(Rect::new(
            self.room.x + across as u16 * width,
            self.room.y + down as u16,
            width,
            1,
        ))
    }
}

impl Overlay for Menu {
    fn press(&mut self, key: Key, state: &mut State) -> After {
        let is = |name| key.is(name);
        if is("f1") || is("esc") && !self.shows_all_again() {
            return After::Close;
        } else if is("enter") {
            return self.take();
        } else if is(":") || is("?") {
            let action = if is("?") {
                Action::Help
            } else {
                Action::CommandLine
            };
            return After::Do(Command::Do(action));
        } else if is("left") {
            self.go(-1, 0, state);
        } else if is("right") || is("tab") {
            self.go(1, 0, state);
        } else if is("backtab") {
            self.go(-1, 0, state);
        } else if is("up") {
            self.go(0, -1, state);
        } else if is("down") {
            self.go(0, 1, state);
        } else if is("home") {
            self.item = 0;
        } else if is("end") {
            self.item = self.items().len() - 1;
        } else if is("backspace") {
            self.shows_all_again();
        } else if let Some(letter) = key.typed() {
            self.choose(letter, key, state);
        }
        After::Stay
    }

    fn click(&mut self, at: Position, state: &State) -> After {
        for part in self.parts(state) {
            let items = 0..self.items_of(part.column).len();
            let is_hit = |&n: &usize| part.place(n).is_some_and(|cells| cells.contains(at));
            if let Some(item) = items.into_iter().find(is_hit) {
                (self.column, self.item) = (part.column, item);
                return self.take();
            }
        }
        if Self::area(state).contains(at) {
            After::Stay
        } else {
            After::Close
        }
    }

    fn scroll(&mut self, lines: isize, state: &State) -> bool {
        self.go(0, lines.signum(), state);
        true
    }

    fn has_footer(&self) -> bool {
        true
    }

    /// The menu, over what is above the footer; in the footer, what is chosen does.
    fn draw_footer(&self, state: &State, pen: &mut Pen<'_>, footer: Rect) -> Option<Position> {
        Clear.render(Self::area(state), pen.buffer);
        for part in self.parts(state) {
            self.draw_part(&part, state, pen);
        }
        let (names, help) = match self.chosen()[..] {
            [action] => (action.name().to_owned(), action.help()),
            ref row => {
                let names: Vec<_> = row.iter().map(|action| action.name()).collect();
                (names.join(", "), "enter lists them")
            }
        };
        let room = footer.width.saturating_sub(1);
        let x = pen.text(footer.x + 1, footer.y, room, &names, Theme::strong());
        let room = footer.right().saturating_sub(x + 2);
        pen.text(x + 2, footer.y, room, help, CellStyle::new());
        None
    }
}

/// The action that a key is for, as the camera of the scene has it.
fn action_of(key: Key, state: &State) -> Option<Action> {
    Action::bound_to(key).map(|action| action.as_with(&state.scene().camera))
}

/// The keys of an action, as the camera of the scene has them.
fn keys_of(action: Action, state: &State) -> &'static [&'static str] {
    action.as_with(&state.scene().camera).keys()
}

/// A row of a column: what it is called, and as many of its keys as have room.
fn draw_row(row: &[Action], state: &State, pen: &mut Pen<'_>, cells: Rect, style: CellStyle) {
    let label = match row[0] {
        Action::Mouse if state.mouse => "mouse (on)",
        Action::Mouse => "mouse (off)",
        action => action.row(),
    };
    fill(pen, cells, style);
    let label = format!(" {label}");
    pen.text(cells.x, cells.y, cells.width, &label, style);
    let mut keys: Vec<_> = row
        .iter()
        .filter_map(|&action| keys_of(action, state).first().copied())
        .collect();
    match keys[..] {
        ["left", ..] => keys = vec!["arrows"],
        ["shift-left", ..] => keys = vec!["shift"],
        _ => {}
    }
    let room = usize::from(cells.width).saturating_sub(label.width() + 2);
    while keys.join(" ").width() > room && !keys.is_empty() {
        keys.pop();
    }
    let keys = keys.join(" ").replace("page", "pg");
    let x = cells.right().saturating_sub(keys.width() as u16 + 1);
    pen.text(x, cells.y, cells.width, &keys, style.patch(Theme::strong()));
}

/// An action in the list of its column: its letter, its name, its keys.
fn draw_action(action: Action, state: &State, pen: &mut Pen<'_>, cells: Rect, style: CellStyle) {
    fill(pen, cells, style);
    let letter = format!(" {} ", action.letter());
    let x = pen.text(
        cells.x,
        cells.y,
        cells.width,
        &letter,
        style.patch(Theme::strong()),
    );
    let room = cells.right().saturating_sub(x);
    let x = pen
        .text(x, cells.y, room, action.name(), style)
        .max(cells.x + 25);
    let keys = keys_of(action, state).join(" ");
    let room = cells.right().saturating_sub(x);
    pen.text(x, cells.y, room, &keys, style.patch(Theme::faint()));
}

/// Blanks in that style, so that a chosen line is marked in its whole width.
fn fill(pen: &mut Pen<'_>, cells: Rect, style: CellStyle) {
    let blanks = " ".repeat(cells.width.into());
    pen.text(cells.x, cells.y, cells.width, &blanks, style);
}
