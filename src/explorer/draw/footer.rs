//! The keys that matter now, for the footer: those of the panel and the lens first.

use crate::explain::Lens;
use crate::explorer::panel::Panel;
use crate::explorer::state::State;

/// A key and a word.
pub(crate) type KeyWord = (&'static str, &'static str);

/// Keys that matter everywhere, the most useful first.
const ALWAYS: &[KeyWord] = &[
    ("t", "tangent"),
    ("wasd", "camera"),
    ("tab", "sphere"),
    ("xyz", "move"),
    ("n", "next on line"),
    ("f", "tour"),
    (":", "command"),
    ("?", "help"),
    ("q", "quit"),
    ("g", "grow"),
    ("=", "numbers"),
    ("v", "view"),
    ("m", "method"),
    ("u", "undo"),
    ("1-9", "panels"),
    ("*", "landmark"),
];

/// Keys that matter where a line is drawn in the picture's place.
const PLANE: &[KeyWord] = &[
    ("space", "menu"),
    ("arrows", "move the line"),
    ("r", "as it was"),
    ("f", "next page"),
    ("?", "help"),
    ("q", "quit"),
];

/// All keys that matter, the most useful first; as many are shown as have room.
pub(crate) fn keys(state: &State) -> Vec<KeyWord> {
    if state.plane.is_some() {
        return PLANE.to_vec();
    }
    let mut keys = vec![("space", "menu"), ("arrows", "cursor")];
    let several = state.reading().is_some_and(|r| r.meetings.len() > 1);
    let also: &[KeyWord] = if several {
        &[("n", "next on line")]
    } else {
        &[]
    };
    let wanted = [
        of_panel(state.at.panel),
        of_lens(state.at.lens),
        also,
        ALWAYS,
    ];
    for (key, word) in wanted.concat() {
        if keys.iter().all(|(other, _)| *other != key) {
            keys.push((key, word));
        }
    }
    keys
}

const fn of_panel(panel: Panel) -> &'static [KeyWord] {
    match panel {
        Panel::Quadratic => &[("enter", "steps"), ("t", "tangent")],
        Panel::Steps => &[
            ("enter", "next"),
            (",", "back"),
            ("t", "tangent"),
            ("P", "predict"),
        ],
        Panel::Slice | Panel::Curve => &[("( )", "move p"), ("*", "landmark"), ("t", "tangent")],
        Panel::Bits | Panel::Compare => &[("m", "method"), ("enter", "steps"), ("t", "tangent")],
        Panel::Error => &[("%", "measure"), ("m", "method"), ("t", "tangent")],
        Panel::Plan => &[("v", "view"), ("m", "method"), ("t", "tangent")],
        Panel::Dial => &[
            ("\\", "on"),
            ("|", "back"),
            ("9", "next dial"),
            ("m", "method"),
        ],
    }
}

const fn of_lens(lens: Lens) -> &'static [KeyWord] {
    match lens {
        Lens::Mathematics => &[("L", "machine")],
        Lens::Machine => &[("m", "method"), ("L", "mathematics")],
    }
}
