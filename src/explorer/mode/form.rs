//! The numbers of the selected sphere and of the camera, to be typed.

use ratatui::layout::{Position, Rect};
use ratatui::style::Style as CellStyle;

use crate::explorer::action::Action;
use crate::explorer::command::Command;
use crate::explorer::draw::layout::{self, Layout};
use crate::explorer::draw::pen::Pen;
use crate::explorer::draw::theme::Theme;
use crate::explorer::edit::field::{NumberField, parse_number};
use crate::explorer::key::Key;
use crate::explorer::mode::line::TypedLine;
use crate::explorer::mode::overlay::{After, ModeArea, Overlay};
use crate::explorer::state::State;
use crate::geometry::Decimal;

/// The list of numbers: the chosen one, and what is typed in its place.
#[derive(Debug, Default, PartialEq)]
pub(crate) struct NumbersForm {
    at: usize,
    typing: Option<TypedLine>,
}

impl Overlay for NumbersForm {
    fn press(&mut self, key: Key, state: &mut State) -> After {
        let fields = NumberField::of(state.scene(), state.at.sphere);
        let last = fields.len() - 1;
        self.at = self.at.min(last);
        if let Some(line) = &mut self.typing {
            if key.is("esc") {
                self.typing = None;
            } else if key.is("enter") {
                if set_typed(state, fields[self.at], &line.text()) {
                    self.typing = None;
                    self.at = (self.at + 1).min(last);
                }
            } else {
                line.edit(key);
            }
        } else if key.is("esc") || key.is("=") || key.is("q") {
            return After::Close;
        } else if key.is("down") || key.is("tab") || key.is("j") {
            self.at = (self.at + 1) % (last + 1);
        } else if key.is("up") || key.is("backtab") || key.is("k") {
            self.at = (self.at + last) % (last + 1);
        } else if key.is("enter") {
            let value = fields[self.at].get(state.scene(), state.at.sphere);
            self.typing = Some(TypedLine::chosen(
                &value.map_or(String::new(), |v| Decimal(v).to_string()),
            ));
        } else if key
            .typed()
            .is_some_and(|c| c.is_ascii_digit() || "+-.−".contains(c))
        {
            let mut line = TypedLine::default();
            line.edit(key);
            self.typing = Some(line);
        } else if key.is("u") {
            return After::Run(Command::Do(Action::Undo));
        }
        After::Stay
    }

    fn paste(&mut self, text: &str, _: &mut State) -> bool {
        let line = self.typing.as_mut();
        line.map(|line| line.insert(text)).is_some()
    }

    fn place(&self, _: &Layout) -> ModeArea {
        ModeArea::Panels
    }

    fn draw(&self, state: &State, pen: &mut Pen<'_>, area: Rect) -> Option<Position> {
        let title = match state.at.sphere {
            Some(at) => format!("numbers of sphere {} and camera", at + 1),
            None => "numbers of the camera".into(),
        };
        pen.frame(area, &title, "");
        let room = layout::inner(area);
        let fields = NumberField::of(state.scene(), state.at.sphere);
        // The list scrolls where it is longer than its room.
        let first = (self.at + 1).saturating_sub(room.height.into());
        let mut cursor = None;
        for (y, (i, field)) in
            (room.top()..room.bottom()).zip(fields.iter().enumerate().skip(first))
        {
            let style = chosen_if(i == self.at);
            let name = format!(" {:<15}", field.name());
            let x = pen.text(room.x, y, room.width, &name, style);
            let space = room.right().saturating_sub(x);
            if let (true, Some(line)) = (i == self.at, &self.typing) {
                pen.text(x, y, space, &line.text(), chosen_if(line.is_chosen()));
                cursor = Some(Position::new(
                    (x + line.cursor() as u16).min(room.right().max(1) - 1),
                    y,
                ));
            } else {
                let value = field.get(state.scene(), state.at.sphere);
                let value = value.map_or(String::new(), |v| Decimal(v).to_string());
                pen.text(x, y, space, &value, CellStyle::new());
            }
        }
        cursor
    }

    fn foot(&self) -> &[(&'static str, &'static str)] {
        match &self.typing {
            None => &[
                ("arrows", "choose"),
                ("enter", "type a value"),
                ("u", "undo"),
                ("esc", "done"),
            ],
            Some(line) if line.is_chosen() => &[
                ("digits", "type over it"),
                ("arrows", "edit it"),
                ("esc", "leave it as it was"),
            ],
            Some(_) => &[("enter", "take it"), ("esc", "leave it as it was")],
        }
    }
}

fn chosen_if(is_chosen: bool) -> CellStyle {
    if is_chosen {
        Theme::chosen()
    } else {
        CellStyle::new()
    }
}

/// Gives a field the number that was typed; false, with a sentence, if it can't have it.
fn set_typed(state: &mut State, field: NumberField, text: &str) -> bool {
    let change = parse_number(&field.name(), text)
        .and_then(|value| field.set(state.scene(), state.at.sphere, value));
    match change {
        Ok(change) => {
            state.apply(change);
            true
        }
        Err(refused) => {
            state.warn(refused.to_string());
            false
        }
    }
}

/// The numbers as text, a name and a value a line.
pub(crate) fn numbers(state: &State) -> String {
    let (scene, sphere) = (state.scene(), state.at.sphere);
    let fields = NumberField::of(scene, sphere).into_iter();
    let values = fields.filter_map(|f| Some((f.name(), f.get(scene, sphere)?)));
    let lines: Vec<_> = values
        .map(|(name, value)| format!("{name} {}\n", Decimal(value)))
        .collect();
    lines.concat()
}
