//! The settings of a view, in one table: what each is called, what it may be, and how it is written.
//!
//! The flags of the command line, the commands after `:`, the links that reopen a view, the pages of
//! the tour and the viewpoint as data all read it.

use std::collections::BTreeMap;

use serde::{Deserialize, Deserializer, Serialize, Serializer, de};

use crate::explain::Lens;
use crate::explorer::draw::theme::Palette;
use crate::explorer::edit::field::{NumberField, parse_number};
use crate::explorer::panel::Panel;
use crate::explorer::viewpoint::Viewpoint;
use crate::method::Method;
use crate::render::{ColorDepth, Style, View};
use crate::scene::Size;
use crate::text::{by_name, read};

/// A setting with a value.
#[derive(Debug, Clone, PartialEq)]
pub enum Setting {
    /// How the quadratic is evaluated.
    Method(Method),
    /// The same by the routine in a file, or the method beside the chosen one.
    Routine {
        /// The file, as it was named.
        name: String,
        /// Whether it is the one beside.
        beside: bool,
    },
    /// Which story of a pixel is told.
    Lens(Lens),
    /// How samples become characters.
    Style(Style),
    /// What the picture shows.
    View(View),
    /// The colours for a kind of screen.
    Theme(Palette),
    /// How many colours.
    Color(ColorDepth),
    /// Height of a cell over its width.
    Aspect(f64),
    /// The pixel under the cursor.
    Cursor(u32, u32),
    /// The picture in which the cursor counts.
    Size(Size),
    /// The panel beside the picture.
    Panel(Panel),
    /// The step of the derivation, by name or number.
    Step(String),
    /// t of the moving point.
    T(f64),
    /// The method beside the chosen one.
    Compare(Method),
    /// The selected sphere, from 1.
    Sphere(usize),
    /// The sphere that the panel shows, from 1.
    Shown(usize),
    /// A number of the selected sphere or the camera.
    Set(NumberField, f32),
    /// By how much a key moves a sphere.
    Stride(f32),
}

/// A row of the table.
#[derive(Debug)]
pub struct SettingRow {
    /// The name of the command, of the flag and of the key in a page.
    pub name: &'static str,
    /// As a command: what follows the name, and what it does. Without: no command.
    pub command: Option<(&'static str, &'static str)>,
    /// As a flag: what follows it, and what it is. Without: no flag of this table.
    pub flag: Option<(&'static str, &'static str)>,
    /// What it is called in lines of text, where its changes are said.
    pub(crate) spoken: Option<&'static str>,
    /// All values, where there are few.
    pub choices: fn() -> Vec<String>,
    /// Reads a value, or says what was expected, or what is wrong.
    parse: fn(&str) -> Result<Setting, String>,
    /// How the value of a viewpoint is written, if it has one.
    write: fn(&Viewpoint) -> Option<String>,
}

/// The table, in the order of the help page.
pub const SETTINGS: &[SettingRow] = &[
    SettingRow {
        name: "method",
        command: Some(("NAME", "evaluate the quadratic with this method")),
        flag: Some(("METHOD", "How the quadratic is evaluated")),
        spoken: Some("method"),
        choices: || names(&Method::ALL, Method::name),
        parse: |text| method(text, false),
        write: |at| Some(at.method.name().into()),
    },
    SettingRow {
        name: "lens",
        command: Some((
            "NAME",
            "show the mathematics of a pixel, or the machine's arithmetic",
        )),
        flag: Some((
            "LENS",
            "The mathematics of a pixel, or the machine's arithmetic",
        )),
        spoken: Some("lens"),
        choices: || names(&Lens::ALL, Lens::name),
        parse: |text| one_of(text, &Lens::ALL, Lens::name).map(Setting::Lens),
        write: |at| Some(at.lens.name().into()),
    },
    SettingRow {
        name: "style",
        command: Some(("NAME", "draw the picture in this style")),
        flag: Some(("STYLE", "How samples become characters")),
        spoken: Some("style"),
        choices: || names(&Style::ALL, Style::name),
        parse: |text| one_of(text, &Style::ALL, Style::name).map(Setting::Style),
        write: |at| Some(at.style.name().into()),
    },
    SettingRow {
        name: "view",
        command: Some(("NAME", "show this view")),
        flag: Some(("VIEW", "What the picture shows")),
        spoken: Some("view"),
        choices: || names(&View::ALL, View::name),
        parse: |text| one_of(text, &View::ALL, View::name).map(Setting::View),
        write: |at| Some(at.view.name().into()),
    },
    SettingRow {
        name: "theme",
        command: Some(("NAME", "draw in the colours of this theme")),
        flag: None,
        spoken: None,
        choices: || names(&Palette::ALL, Palette::name),
        parse: |text| one_of(text, &Palette::ALL, Palette::name).map(Setting::Theme),
        write: |_| None,
    },
    SettingRow {
        name: "color",
        command: Some(("DEPTH", "use this many colours: never, 16, 256, true")),
        flag: None,
        spoken: None,
        choices: || names(&ColorDepth::ALL, ColorDepth::name),
        parse: |text| one_of(text, &ColorDepth::ALL, ColorDepth::name).map(Setting::Color),
        write: |_| None,
    },
    SettingRow {
        name: "aspect",
        command: Some(("RATIO", "take a cell to be this many times as high as wide")),
        flag: Some(("ASPECT", "Height of a character cell over its width")),
        spoken: None,
        choices: Vec::new,
        parse: |text| match read::binary64(text) {
            Some(ratio) if (0.5..=4.0).contains(&ratio) => Ok(Setting::Aspect(ratio)),
            _ => Err("expected a number from 0.5 to 4".into()),
        },
        write: |_| None,
    },
    SettingRow {
        name: "cursor",
        command: Some(("X Y", "put the cursor on a pixel")),
        flag: Some(("X,Y", "The pixel under the cursor")),
        spoken: None,
        choices: Vec::new,
        parse: cursor,
        write: |at| Some(format!("{},{}", at.cursor.0, at.cursor.1)),
    },
    SettingRow {
        name: "size",
        command: None,
        flag: Some((
            "WxH",
            "The size of the picture that the cursor is counted in, if the scene does not fix one; on another screen the cursor goes to the same place",
        )),
        spoken: None,
        choices: Vec::new,
        parse: |text| read_size(text).map(Setting::Size),
        write: |at| Some(format!("{}x{}", at.size.width, at.size.height)),
    },
    SettingRow {
        name: "panel",
        command: Some(("NAME", "show this panel")),
        flag: Some(("PANEL", "The panel beside the picture")),
        spoken: None,
        choices: || names(&Panel::ALL, Panel::name),
        parse: |text| one_of(text, &Panel::ALL, Panel::name).map(Setting::Panel),
        write: |at| Some(at.panel.name().into()),
    },
    SettingRow {
        name: "step",
        command: Some(("NAME", "go to the step of that name or number")),
        flag: Some(("STEP", "The step of the derivation, by name or number")),
        spoken: None,
        choices: Vec::new,
        parse: |text| match text {
            "" => Err("expected a step's name or number".into()),
            _ => Ok(Setting::Step(text.to_owned())),
        },
        write: |at| Some((at.step + 1).to_string()),
    },
    SettingRow {
        name: "t",
        command: Some(("VALUE", "put the moving point of slice and curve at this t")),
        flag: Some(("T", "Where the moving point of slice and curve is")),
        spoken: Some("moving point at t"),
        choices: Vec::new,
        parse: |text| {
            let t = read::binary64(text).filter(|t| t.is_finite());
            let t = t.ok_or("expected a finite number, such as 7.5");
            Ok(Setting::T(t?))
        },
        write: |at| at.t.map(|t| t.to_string()),
    },
    SettingRow {
        name: "compare",
        command: Some(("NAME", "compare with this method")),
        flag: Some(("METHOD", "The method beside the chosen one")),
        spoken: Some("compared with"),
        choices: || names(&Method::ALL, Method::name),
        parse: |text| method(text, true),
        write: |at| at.compare.map(|method| method.name().into()),
    },
    SettingRow {
        name: "sphere",
        command: Some(("N", "select the sphere of that number")),
        flag: Some(("N", "The sphere that is selected, from 1")),
        spoken: Some("selected sphere"),
        choices: Vec::new,
        parse: |text| from_one(text).map(Setting::Sphere),
        write: |at| at.sphere.map(|sphere| (sphere + 1).to_string()),
    },
    SettingRow {
        name: "shown",
        command: None,
        flag: Some((
            "N",
            "The sphere in the panel, one of those on the line under the cursor",
        )),
        spoken: None,
        choices: Vec::new,
        parse: |text| from_one(text).map(Setting::Shown),
        write: |at| at.shown.map(|sphere| (sphere + 1).to_string()),
    },
    SettingRow {
        name: "set",
        command: Some((
            "KEY VALUE",
            "give a number of the sphere or the camera a value",
        )),
        flag: Some((
            "KEY=VALUE",
            "A number of the selected sphere or the camera, as after `:set`; may be repeated",
        )),
        spoken: None,
        choices: NumberField::all_names,
        parse: number_of_scene,
        write: |_| None,
    },
    SettingRow {
        name: "stride",
        command: Some(("LENGTH", "move and grow spheres by this much")),
        flag: None,
        spoken: None,
        choices: Vec::new,
        parse: |text| match read::binary32(text) {
            Some(length) if length > 0.0 && length.is_finite() => Ok(Setting::Stride(length)),
            _ => Err("expected a number above zero".into()),
        },
        write: |_| None,
    },
];

impl SettingRow {
    /// The row of that name.
    pub fn by_name(name: &str) -> Option<&'static Self> {
        SETTINGS.iter().find(|row| row.name == name)
    }

    /// Reads a value, or says what was expected.
    pub fn parse(&self, text: &str) -> Result<Setting, String> {
        (self.parse)(text)
    }

    /// How the value of a viewpoint is written, if it has one.
    pub(crate) fn write(&self, at: &Viewpoint) -> Option<String> {
        (self.write)(at)
    }
}

/// Reads a setting by name, or says in a sentence what was found and expected.
pub(crate) fn parse(row: &SettingRow, text: &str) -> Result<Setting, String> {
    let name = row.name;
    row.parse(text).map_err(|problem| {
        if problem.starts_with("expected") {
            format!("{name}: found “{text}”, {problem}")
        } else {
            problem
        }
    })
}

impl Viewpoint {
    /// Takes a setting on, as far as it is one of a viewpoint.
    pub(crate) fn put(&mut self, setting: &Setting) {
        match *setting {
            Setting::Method(method) => self.method = method,
            Setting::Lens(lens) => self.lens = lens,
            Setting::Style(style) => self.style = style,
            Setting::View(view) => self.view = view,
            Setting::Panel(panel) => self.panel = panel,
            Setting::Compare(method) => self.compare = Some(method),
            Setting::T(t) => self.t = Some(t),
            Setting::Sphere(n) => self.sphere = n.checked_sub(1),
            Setting::Shown(n) => self.shown = n.checked_sub(1),
            Setting::Cursor(x, y) => self.cursor = (x, y),
            Setting::Size(size) => self.size = size,
            Setting::Step(ref step) => {
                self.step = step
                    .parse()
                    .map_or(self.step, |n: usize| n.saturating_sub(1));
            }
            Setting::Theme(_)
            | Setting::Routine { .. }
            | Setting::Color(_)
            | Setting::Aspect(_)
            | Setting::Set(..)
            | Setting::Stride(_) => {}
        }
    }
}

impl Serialize for Viewpoint {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let values = SETTINGS
            .iter()
            .filter_map(|row| Some((row.name, row.write(self)?)));
        serializer.collect_map(values)
    }
}

impl<'de> Deserialize<'de> for Viewpoint {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let values = BTreeMap::<String, String>::deserialize(deserializer)?;
        let mut at = Self::default();
        for (name, text) in values {
            let row = SettingRow::by_name(&name).ok_or_else(|| {
                de::Error::custom(format!("found “{name}”, expected a setting of a view"))
            })?;
            at.put(&parse(row, &text).map_err(de::Error::custom)?);
        }
        Ok(at)
    }
}

fn names<T: Copy>(all: &[T], name: fn(T) -> &'static str) -> Vec<String> {
    all.iter().map(|&value| name(value).to_owned()).collect()
}

/// The value of that name.
pub(crate) fn one_of<T: Copy>(
    text: &str,
    all: &[T],
    name: fn(T) -> &'static str,
) -> Result<T, String> {
    let found = by_name(all.iter().copied(), name, text);
    found.ok_or_else(|| format!("expected one of {}", names(all, name).join(", ")))
}

/// Reads a method: built in, or the file of a routine.
fn method(text: &str, beside: bool) -> Result<Setting, String> {
    if Method::is_file(text) {
        let name = text.to_owned();
        return Ok(Setting::Routine { name, beside });
    }
    let expected = |problem| format!("{problem}, or a file such as mine.glsl");
    let method = one_of(text, &Method::ALL, Method::name).map_err(expected)?;
    Ok(if beside {
        Setting::Compare(method)
    } else {
        Setting::Method(method)
    })
}

fn cursor(text: &str) -> Result<Setting, String> {
    let numbers = text.split([' ', ',']).filter(|part| !part.is_empty());
    let numbers: Result<Vec<u32>, _> = numbers.map(str::parse).collect();
    match numbers.as_deref() {
        Ok(&[x, y]) => Ok(Setting::Cursor(x, y)),
        _ => Err("expected a column and a row, counted from 0, such as 20,20".into()),
    }
}

/// Reads the size of a picture, in pixels.
pub fn read_size(text: &str) -> Result<Size, String> {
    let side = |digits: &str| {
        let number = digits.parse().ok()?;
        (1..=Size::LARGEST).contains(&number).then_some(number)
    };
    text.split_once(['x', 'X', '×'])
        .and_then(|(width, height)| Some(Size::new(side(width)?, side(height)?)))
        .ok_or_else(|| {
            let most = Size::LARGEST;
            format!("expected a width and a height, each from 1 to {most}, such as 80x48")
        })
}

fn from_one(text: &str) -> Result<usize, String> {
    let number = text.parse().ok().filter(|&n| n > 0);
    number.ok_or_else(|| "expected a whole number from 1".into())
}

fn number_of_scene(text: &str) -> Result<Setting, String> {
    let (key, value) = text
        .split_once(|c: char| c.is_whitespace() || c == '=')
        .ok_or("expected a key and a value")?;
    let field = NumberField::by_name(key).ok_or_else(|| {
        let names = NumberField::all_names().join(", ");
        format!("expected one of {names}")
    })?;
    let value = parse_number(key, value.trim_start_matches(['=', ' ']));
    value
        .map(|value| Setting::Set(field, value))
        .map_err(|refused| refused.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_viewpoint_is_written_and_read_back() {
        let at = Viewpoint {
            method: Method::Haines,
            lens: Lens::Machine,
            style: Style::Braille,
            view: View::Lost,
            panel: Panel::Curve,
            step: 4,
            t: Some(0.1),
            compare: Some(Method::Kahan),
            sphere: Some(2),
            shown: Some(1),
            cursor: (7, 9),
            size: Size::new(40, 20),
        };
        for at in [at, Viewpoint::default()] {
            let text = serde_json::to_string(&at).unwrap();
            assert_eq!(
                serde_json::from_str::<Viewpoint>(&text).unwrap(),
                at,
                "{text}"
            );
        }
        let refused = serde_json::from_str::<Viewpoint>(r#"{"method": "magic"}"#).unwrap_err();
        assert!(
            refused
                .to_string()
                .contains("method: found “magic”, expected one of textbook")
        );
        assert!(serde_json::from_str::<Viewpoint>(r#"{"magic": "1"}"#).is_err());
    }

    #[test]
    fn all_choices_can_be_chosen_and_no_name_is_there_twice() {
        for (at, row) in SETTINGS.iter().enumerate() {
            assert!(SETTINGS[..at].iter().all(|other| other.name != row.name));
            for choice in (row.choices)() {
                let text = if row.name == "set" {
                    format!("{choice}=1")
                } else {
                    choice
                };
                assert!(row.parse(&text).is_ok(), "{} {text}", row.name);
            }
        }
    }

    #[test]
    fn sizes_are_two_numbers_in_range() {
        assert_eq!(read_size("80x48"), Ok(Size::new(80, 48)));
        assert_eq!(read_size("1X4096"), Ok(Size::new(1, 4096)));
        for bad in [
            "", "80", "80x", "x48", "0x1", "80x-1", "80x48x2", "4097x1", "8e1x1",
        ] {
            assert!(read_size(bad).is_err(), "{bad}");
        }
    }
}
