//! Reading scene files: TOML in, a checked [`Scene`] out, or one sentence that says where the file
//! is wrong, what was found and what was expected.
//!
//! Every number is read from its decimal digits to binary32 in a single rounding. Writing is in
//! the file beside this one.

use std::fmt;
use std::ops::Range;
use std::path::Path;

use glam::Vec3;
use toml::Spanned;
use toml::de::{DeTable, DeValue};
use toml_parser::Source;
use toml_parser::lexer::TokenKind;

use super::value::{self, NumberKind, Refused};
use super::{Aim, Body, Camera, Light, Probe, Projection, Scene, Size};
use crate::door::{self, Expected, FileError, TextPosition};
use crate::geometry::Sphere;
use crate::text::nearest;

/// The largest scene file that is read, in bytes; a million spheres need about a third of it.
pub const LARGEST_FILE: u64 = 256 << 20;

/// What a scene is read from.
const SCENE_FILE: Expected = Expected {
    what: "a scene file",
    most: LARGEST_FILE,
};

impl Scene {
    /// Reads a scene from the text of a scene file; `source_name` is the file's name in errors and,
    /// without its extension, the name of a scene that gives none.
    pub fn parse(text: &str, source_name: &str) -> Result<Self, FileError> {
        let text = door::without_mark(text);
        let mut reader = SceneReader::default();
        pieces(text)
            .try_for_each(|piece| reader.read(&text[piece.clone()], piece.start))
            .and_then(|()| reader.finish(source_name))
            .map_err(|fault| fault.locate(text, source_name))
    }

    /// Reads the scene file at `path`.
    pub fn load(path: &Path) -> Result<Self, FileError> {
        Self::parse(&SCENE_FILE.text(path)?, &path.display().to_string())
    }
}

/// Something wrong at a byte of the file, not yet turned into line and column.
struct SceneFault {
    at: Option<usize>,
    problem: String,
}

impl SceneFault {
    fn locate(self, text: &str, file: &str) -> FileError {
        FileError {
            file: file.to_owned(),
            position: self.at.map(|at| TextPosition::of(at, text.as_bytes())),
            problem: self.problem,
        }
    }
}

/// Cuts a text before every so many lines that open a sphere, and so into texts that are TOML each
/// for itself. The tree of a million spheres, held at once, takes 3 GB; in pieces it fits a cache.
fn pieces(text: &str) -> impl Iterator<Item = Range<usize>> {
    const SPHERES: usize = 256;
    let mut depth = 0_i64;
    let mut spheres = 0;
    let cuts = Source::new(text).lex().filter_map(move |token| {
        match token.kind() {
            TokenKind::LeftSquareBracket | TokenKind::LeftCurlyBracket => depth += 1,
            TokenKind::RightSquareBracket | TokenKind::RightCurlyBracket => depth -= 1,
            TokenKind::Newline => {
                let next = token.span().end();
                if depth == 0 && text[next..].starts_with("[[sphere]]") {
                    spheres += 1;
                    return (spheres % SPHERES == 0).then_some(next);
                }
            }
            _ => {}
        }
        None
    });
    let mut start = 0;
    cuts.chain([text.len()])
        .map(move |end| std::mem::replace(&mut start, end)..end)
}

/// A table of a scene file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum SceneTable {
    Top,
    Camera,
    Light,
    /// Counted from 1.
    Sphere(usize),
    /// Counted from 1.
    Probe(usize),
}

impl SceneTable {
    const fn keys(self) -> &'static [&'static str] {
        match self {
            Self::Top => &["name", "about", "camera", "light", "probe", "sphere"],
            Self::Camera => &[
                "projection",
                "position",
                "look_at",
                "up",
                "field_of_view",
                "extent",
                "step",
                "pixels",
            ],
            Self::Light => &["position"],
            Self::Sphere(_) => &["name", "center", "radius", "color"],
            Self::Probe(_) => &["pixel", "point", "title", "text"],
        }
    }

    /// How a message names a key of this table.
    fn key(self, key: &str) -> String {
        match self {
            Self::Top => key.to_owned(),
            place => format!("{place}, {key}"),
        }
    }
}

impl fmt::Display for SceneTable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Top => write!(f, "top level"),
            Self::Camera => write!(f, "camera"),
            Self::Light => write!(f, "light"),
            Self::Sphere(n) => write!(f, "sphere {n}"),
            Self::Probe(n) => write!(f, "probe {n}"),
        }
    }
}

type TomlValue<'t> = Spanned<DeValue<'t>>;

/// One table of the file, whose keys are all known.
struct TableReader<'a, 't> {
    place: SceneTable,
    /// Where the table begins in the file.
    at: usize,
    /// Where the piece of the file begins that spans count from.
    base: usize,
    entries: &'a DeTable<'t>,
}

impl<'a, 't> TableReader<'a, 't> {
    /// The table that `value` holds; refuses another kind of value and keys that are not known.
    fn open(place: SceneTable, base: usize, value: &'a TomlValue<'t>) -> Result<Self, SceneFault> {
        let at = base + value.span().start;
        let Some(entries) = value.get_ref().as_table() else {
            let refused = Refused::new(kind_of(value), "a table");
            return Err(SceneFault {
                at: Some(at),
                problem: format!("{place}: {refused}"),
            });
        };
        let section = Self {
            place,
            at,
            base,
            entries,
        };
        section.refuse_unknown_keys()?;
        Ok(section)
    }

    fn refuse_unknown_keys(&self) -> Result<(), SceneFault> {
        let known = self.place.keys();
        let unknown = self
            .entries
            .keys()
            .filter(|key| !known.contains(&key.get_ref().as_ref()))
            .min_by_key(|key| key.span().start);
        let Some(key) = unknown else { return Ok(()) };
        let word = key.get_ref().as_ref();
        let expected = match nearest(word, known.iter().copied()) {
            Some(meant) => format!("perhaps {meant}"),
            None => format!("one of the keys {}", known.join(", ")),
        };
        let refused = Refused::new(format!("the unknown key {}", value::quoted(word)), expected);
        let problem = match self.place {
            SceneTable::Top => refused.to_string(),
            place => format!("{place}: {refused}"),
        };
        Err(SceneFault {
            at: Some(self.base + key.span().start),
            problem,
        })
    }

    fn get(&self, key: &str) -> Option<&'a TomlValue<'t>> {
        debug_assert!(self.place.keys().contains(&key), "{key} is not listed");
        self.entries.get(key)
    }

    fn fault(&self, at: Option<&TomlValue>, key: &str, problem: impl fmt::Display) -> SceneFault {
        SceneFault {
            at: Some(at.map_or(self.at, |value| self.base + value.span().start)),
            problem: format!("{}: {problem}", self.place.key(key)),
        }
    }

    /// The value of `key` as `read` understands it; none if the key is not there.
    fn optional<T>(
        &self,
        key: &str,
        read: impl FnOnce(&'a TomlValue<'t>) -> Result<T, Refused>,
    ) -> Result<Option<T>, SceneFault> {
        self.get(key)
            .map(|value| read(value).map_err(|refused| self.fault(Some(value), key, refused)))
            .transpose()
    }

    fn required<T>(&self, key: &str, expected: &str, found: Option<T>) -> Result<T, SceneFault> {
        found.ok_or_else(|| self.fault(None, key, format_args!("missing, expected {expected}")))
    }

    fn line(&self, key: &str) -> Result<Option<&'a str>, SceneFault> {
        self.optional(key, |value| match value.get_ref().as_str() {
            Some(text) => value::line(text),
            None => Err(Refused::new(kind_of(value), "text in quotation marks")),
        })
    }

    fn number(&self, key: &str, kind: NumberKind) -> Result<Option<f32>, SceneFault> {
        self.optional(key, |value| number(value, kind))
    }

    fn vector(&self, key: &str) -> Result<Option<Vec3>, SceneFault> {
        const EXPECTED: &str = "a list of three numbers, [x, y, z]";
        self.list(key, ["x", "y", "z"], EXPECTED, |value| {
            number(value, NumberKind::Coordinate)
        })
        .map(|found| found.map(Vec3::from))
    }

    /// A list of exactly the components named, each as `read` understands it.
    fn list<T: Copy, const N: usize>(
        &self,
        key: &str,
        names: [&str; N],
        expected: &'static str,
        read: impl Fn(&'a TomlValue<'t>) -> Result<T, Refused>,
    ) -> Result<Option<[T; N]>, SceneFault> {
        let Some(list) = self.get(key) else {
            return Ok(None);
        };
        let components = list
            .get_ref()
            .as_array()
            .and_then(|list| <&[TomlValue; N]>::try_from(&list[..]).ok())
            .ok_or_else(|| self.fault(Some(list), key, Refused::new(kind_of(list), expected)))?;
        let mut read_ones = Vec::with_capacity(N);
        for (value, name) in components.iter().zip(names) {
            let component = format_args!("{key}.{name}");
            read_ones.push(
                read(value)
                    .map_err(|refused| self.fault(Some(value), &component.to_string(), refused))?,
            );
        }
        let found = <[T; N]>::try_from(read_ones).ok();
        Ok(found)
    }
}

fn number(value: &TomlValue, kind: NumberKind) -> Result<f32, Refused> {
    match value.get_ref() {
        DeValue::Float(digits) => kind.read(digits.as_str()),
        DeValue::Integer(digits) if digits.radix() == 10 => kind.read(digits.as_str()),
        DeValue::Integer(digits) => {
            // A conversion from integers, too, rounds once.
            let found = u128::from_str_radix(digits.as_str(), digits.radix())
                .map_or(f32::INFINITY, |whole| whole as f32);
            if found.is_infinite() {
                return Err(Refused::new(kind_of(value), value::WITHIN_RANGE));
            }
            kind.check(found)
        }
        _ => Err(Refused::new(kind_of(value), kind.expected())),
    }
}

fn whole(value: &TomlValue, least: u32, most: u32) -> Result<u32, Refused> {
    let found = match value.get_ref() {
        DeValue::Integer(digits) => u32::from_str_radix(digits.as_str(), digits.radix()).ok(),
        _ => None,
    };
    found.filter(|n| (least..=most).contains(n)).ok_or_else(|| {
        Refused::new(
            kind_of(value),
            format!("a whole number from {least} to {most}"),
        )
    })
}

/// What a value is, in words that fit a line.
fn kind_of(value: &TomlValue) -> String {
    match value.get_ref() {
        DeValue::String(text) => format!("the text {}", value::quoted(text)),
        DeValue::Integer(digits) => value::shortened(&digits.to_string()),
        DeValue::Float(digits) => value::shortened(&digits.to_string()),
        DeValue::Boolean(truth) => truth.to_string(),
        DeValue::Datetime(date) => format!("the date {date}"),
        DeValue::Array(list) if list.len() == 1 => "a list of one value".to_owned(),
        DeValue::Array(list) => format!("a list of {} values", list.len()),
        DeValue::Table(_) => "a table".to_owned(),
    }
}

/// What has been read so far of a file that comes in pieces.
#[derive(Default)]
struct SceneReader {
    name: Option<String>,
    about: Option<String>,
    camera: Option<(Camera, Option<Size>)>,
    light: Option<Light>,
    /// Each with the place of its `pixel` or `point`.
    probes: Vec<(Probe, usize)>,
    bodies: Vec<Body>,
}

impl SceneReader {
    /// Reads one piece, which begins at byte `base` of the file.
    fn read(&mut self, piece: &str, base: usize) -> Result<(), SceneFault> {
        let root = DeTable::parse(piece).map_err(|error| no_toml(&error, piece, base))?;
        let root = TableReader {
            place: SceneTable::Top,
            at: base,
            base,
            entries: root.get_ref(),
        };
        root.refuse_unknown_keys()?;
        self.name = self.name.take().or(root.line("name")?.map(str::to_owned));
        self.about = self.about.take().or(root.line("about")?.map(str::to_owned));
        if let Some(value) = root.get("camera") {
            let section = TableReader::open(SceneTable::Camera, base, value)?;
            refuse_second(&section, self.camera.is_some())?;
            self.camera = Some(camera(&section)?);
        }
        if let Some(value) = root.get("light") {
            let section = TableReader::open(SceneTable::Light, base, value)?;
            refuse_second(&section, self.light.is_some())?;
            self.light = Some(light(&section)?);
        }
        for value in tables(&root, "probe")? {
            let place = SceneTable::Probe(self.probes.len() + 1);
            self.probes
                .push(probe(&TableReader::open(place, base, value)?)?);
        }
        for value in tables(&root, "sphere")? {
            let place = SceneTable::Sphere(self.bodies.len() + 1);
            self.bodies
                .push(body(&TableReader::open(place, base, value)?)?);
        }
        Ok(())
    }

    /// The scene, once all is read.
    fn finish(self, source_name: &str) -> Result<Scene, SceneFault> {
        let Some((camera, pixels)) = self.camera else {
            return Err(SceneFault {
                at: None,
                problem: "camera: missing, expected a table [camera] with position and look_at"
                    .to_owned(),
            });
        };
        for (n, (probe, at)) in self.probes.iter().enumerate() {
            check_pixel(probe.aim, pixels).map_err(|refused| SceneFault {
                at: Some(*at),
                problem: format!("{}: {refused}", SceneTable::Probe(n + 1).key("pixel")),
            })?;
        }
        Ok(Scene {
            name: self.name.unwrap_or_else(|| stem(source_name)),
            about: self.about,
            camera,
            pixels,
            bodies: self.bodies,
            light: self.light,
            probes: self.probes.into_iter().map(|(probe, _)| probe).collect(),
        })
    }
}

fn no_toml(error: &toml::de::Error, piece: &str, base: usize) -> SceneFault {
    let span = error.span().unwrap_or_default();
    let near = match piece.get(span.clone()).map(str::trim) {
        None | Some("") => String::new(),
        Some(text) => format!(" at {}", value::quoted(text)),
    };
    SceneFault {
        at: Some(base + span.start),
        problem: format!("this is not TOML{near}: {}", error.message()),
    }
}

fn refuse_second(section: &TableReader, seen: bool) -> Result<(), SceneFault> {
    if seen {
        let problem = format!("{}: found a second table, expected only one", section.place);
        return Err(SceneFault {
            at: Some(section.at),
            problem,
        });
    }
    Ok(())
}

/// The file's name without folders and extension.
fn stem(source_name: &str) -> String {
    Path::new(source_name)
        .file_stem()
        .map_or_else(String::new, |stem| stem.to_string_lossy().into_owned())
        .replace(char::is_control, "")
}

fn tables<'a, 't>(
    root: &TableReader<'a, 't>,
    key: &str,
) -> Result<&'a [TomlValue<'t>], SceneFault> {
    match root.get(key) {
        None => Ok(&[]),
        Some(value) => value
            .get_ref()
            .as_array()
            .map(|list| &list[..])
            .ok_or_else(|| {
                let refused = Refused::new(
                    kind_of(value),
                    format!("a list of tables, each headed [[{key}]]"),
                );
                root.fault(Some(value), key, refused)
            }),
    }
}

fn camera(section: &TableReader) -> Result<(Camera, Option<Size>), SceneFault> {
    const POINT: &str = "a list of three numbers, [x, y, z]";
    let position = section.required("position", POINT, section.vector("position")?)?;
    let look_at = section.required("look_at", POINT, section.vector("look_at")?)?;
    let camera = Camera {
        projection: projection(section)?,
        position,
        look_at,
        up: section.vector("up")?.unwrap_or(Vec3::Y),
    };
    camera.check().map_err(|invalid| {
        let refused = Refused::new(invalid.found, invalid.expected);
        section.fault(section.get(&invalid.field), &invalid.field, refused)
    })?;
    let pixels = section.list(
        "pixels",
        ["width", "height"],
        "a list of two whole numbers, [width, height]",
        |value| whole(value, 1, Size::LARGEST),
    )?;
    Ok((
        camera,
        pixels.map(|[width, height]| Size::new(width, height)),
    ))
}

fn projection(section: &TableReader) -> Result<Projection, SceneFault> {
    const NAMES: [&str; 2] = ["perspective", "orthographic"];
    let orthographic = section.optional("projection", |value| {
        let found = value.get_ref().as_str();
        NAMES
            .iter()
            .position(|name| found == Some(name))
            .map(|which| which == 1)
            .ok_or_else(|| Refused::new(kind_of(value), "\"perspective\" or \"orthographic\""))
    })?;
    if orthographic == Some(true) {
        let extent = section.list(
            "extent",
            ["width", "height"],
            "a list of two numbers above 0, [width, height]",
            |value| number(value, NumberKind::Extent),
        )?;
        let step = section.number("step", NumberKind::Step)?;
        refuse_other(section, "field_of_view", "perspective")?;
        let expected = "the width and height that an orthographic camera sees";
        let of_step = step.map(|step| [STEPS_SEEN * step; 2]);
        Ok(Projection::Orthographic {
            extent: section.required("extent", expected, extent.or(of_step))?,
            step,
        })
    } else {
        let field_of_view = section.number("field_of_view", NumberKind::FieldOfView)?;
        refuse_other(section, "extent", "orthographic")?;
        refuse_other(section, "step", "orthographic")?;
        Ok(Projection::Perspective {
            field_of_view: field_of_view.unwrap_or(FIELD_OF_VIEW),
        })
    }
}

/// The vertical angle, in degrees, of a perspective camera that gives none.
const FIELD_OF_VIEW: f32 = 45.0;

/// How many steps an orthographic camera that gives a step and no extent sees, across and down.
const STEPS_SEEN: f32 = 40.0;

/// Refuses a key that only the other projection has.
fn refuse_other(section: &TableReader, key: &str, other: &str) -> Result<(), SceneFault> {
    match section.get(key) {
        None => Ok(()),
        Some(value) => {
            let expected = format!("this key only where projection is \"{other}\"");
            let refused = Refused::new(kind_of(value), expected);
            Err(section.fault(Some(value), key, refused))
        }
    }
}

fn light(section: &TableReader) -> Result<Light, SceneFault> {
    let expected = "a list of three numbers, [x, y, z]";
    let position = section.required("position", expected, section.vector("position")?)?;
    Ok(Light { position })
}

fn body(section: &TableReader) -> Result<Body, SceneFault> {
    let expected = "a list of three numbers, [x, y, z]";
    let center = section.required("center", expected, section.vector("center")?)?;
    let radius = section.number("radius", NumberKind::Radius)?;
    let radius = section.required("radius", NumberKind::Radius.expected(), radius)?;
    Ok(Body {
        sphere: Sphere::new(center, radius)
            .map_err(|invalid| section.fault(None, &invalid.field.clone(), invalid))?,
        name: section.line("name")?.map(Box::from),
        color: section.optional("color", |value| {
            value::color(value.get_ref().as_str().unwrap_or_default())
                .map_err(|refused| Refused::new(kind_of(value), refused.expected))
        })?,
    })
}

/// A probe, and where in the file its aim stands.
fn probe(section: &TableReader) -> Result<(Probe, usize), SceneFault> {
    let pixel = section.list(
        "pixel",
        ["x", "y"],
        "a list of two whole numbers, [x, y]",
        |value| whole(value, 0, Size::LARGEST - 1),
    )?;
    let point = section.vector("point")?;
    let aim = match (pixel, point) {
        (Some([x, y]), None) => Aim::Pixel(x, y),
        (None, Some(point)) => Aim::Point(point),
        (Some(_), Some(_)) => {
            let problem = "found beside pixel, expected only one of the two";
            return Err(section.fault(section.get("point"), "point", problem));
        }
        (None, None) => {
            let problem = "missing, expected a pixel, [x, y], or a point, [x, y, z]";
            return Err(section.fault(None, "pixel", problem));
        }
    };
    let aimed = section.get("pixel").or(section.get("point"));
    let at = aimed.map_or(section.at, |value| section.base + value.span().start);
    let title = section.required("title", "a few words", section.line("title")?)?;
    let text = section.required("text", "a sentence", section.line("text")?)?;
    let probe = Probe {
        aim,
        title: title.to_owned(),
        text: text.to_owned(),
    };
    Ok((probe, at))
}

/// Refuses a pixel that is not in the scene's own picture.
fn check_pixel(aim: Aim, pixels: Option<Size>) -> Result<(), Refused> {
    let Aim::Pixel(x, y) = aim else { return Ok(()) };
    let found = format!("[{x}, {y}]");
    match pixels {
        None => Err(Refused::new(
            found,
            "a point, [x, y, z], since the camera has no pixels of its own",
        )),
        Some(Size { width, height }) if x >= width || y >= height => Err(Refused::new(
            found,
            format!("x below {width} and y below {height}, the pixels of the camera"),
        )),
        Some(_) => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DOCS: &str = include_str!("../../docs/scenes.md");

    #[test]
    fn the_docs_name_every_key_and_limit() {
        use SceneTable::{Camera, Light, Probe, Sphere, Top};
        for place in [Top, Camera, Light, Sphere(1), Probe(1)] {
            for key in place.keys() {
                let spellings = [
                    format!("`{key}`"),
                    format!("`[{key}]`"),
                    format!("`[[{key}]]`"),
                ];
                assert!(spellings.iter().any(|s| DOCS.contains(s)), "{key}");
            }
        }
        for limit in [
            format!("{} MiB", LARGEST_FILE >> 20),
            format!("1 to {}", Size::LARGEST),
            format!("| {FIELD_OF_VIEW} |"),
            format!("{STEPS_SEEN} steps"),
        ] {
            assert!(DOCS.contains(&limit), "{limit}");
        }
    }

    #[test]
    fn the_examples_of_the_docs_are_scenes() {
        let mut examples = 0;
        for block in DOCS.split("```toml\n").skip(1) {
            let text = block.split("```").next().unwrap();
            Scene::parse(text, "docs/scenes.md").unwrap();
            examples += 1;
        }
        assert!(examples >= 2);
    }

    #[test]
    fn a_long_file_is_cut_between_spheres_and_nowhere_else() {
        let sphere = "\n[[sphere]]\nname = \"\"\"\n[[sphere]]\n\"\"\"\n";
        let text = format!("[x]{}", sphere.repeat(1000));
        let cut: Vec<_> = pieces(&text).collect();
        assert_eq!(cut.len(), 4);
        for piece in &cut[1..] {
            assert!(text[piece.clone()].starts_with("[[sphere]]\nname"));
        }
        let joined: String = cut.iter().map(|piece| &text[piece.clone()]).collect();
        assert_eq!(joined, text);

        // A list left open holds all that follows.
        let text = format!("x = [\n{text}");
        assert_eq!(pieces(&text).count(), 1);
    }
}
