//! Dials on the live scene: turned from tame to broken and back, with what the chosen method gets
//! wrong on the way.
//!
//! A dial is one change of the document, however far it is turned, so that the person's own scene
//! lies under it untouched.

use std::collections::BTreeMap;

use crate::explain::{self, Line, Role, Setting};
use crate::explorer::Explorer;
use crate::explorer::panel::Panel;
use crate::lab::picture::{PictureErrors, PixelError, pixel_errors};
use crate::lab::{Dial, Turn};
use crate::method::Method;
use crate::render::Style;
use crate::scene::{PixelShape, Rays, Size};
use crate::text;

/// The dial that was chosen, and what it has shown so far.
#[derive(Debug)]
pub(crate) struct Dialing {
    pub(crate) dial: &'static Dial,
    /// What the picture on the screen gets wrong, row by row; empty where nobody asked.
    errors: Vec<PixelError>,
    errors_of: Option<(u64, Rays, Method)>,
    /// What each setting that was tried gets wrong.
    found: BTreeMap<u32, PictureErrors>,
    found_of: Option<FoundOf>,
}

/// What the errors at all settings depend on.
#[derive(Debug, Clone, Copy, PartialEq)]
struct FoundOf {
    ground: u64,
    dial: &'static Dial,
    method: Method,
    size: Size,
    shape: PixelShape,
}

impl Default for Dialing {
    fn default() -> Self {
        Self {
            dial: &Dial::ALL[0],
            errors: Vec::new(),
            errors_of: None,
            found: BTreeMap::new(),
            found_of: None,
        }
    }
}

/// So many times may all settings of a dial ask a method about a sphere while a key waits: some
/// hundredths of a second. In larger scenes only those are tried that tell where it broke.
const MOST_ASKED: usize = 2_000_000;

impl Dialing {
    /// Whether a cell shows a pixel that is wrong.
    pub(crate) fn wrong_cells(&self, style: Style, size: Size) -> Vec<(u32, u32)> {
        let width = size.width.max(1) as usize;
        let wrong = self.errors.iter().enumerate().filter(|(_, e)| e.is_wrong());
        let mut cells: Vec<_> = wrong
            .map(|(i, _)| style.cell_of_pixel((i % width) as u32, (i / width) as u32))
            .collect();
        cells.sort_unstable();
        cells.dedup();
        cells
    }

    /// The first setting that gets more wrong than the scene itself, if any does so far.
    fn broke(&self) -> Option<u32> {
        let tame = self.found.get(&0)?.total_wrong();
        let broken = self.found.iter().find(|(_, e)| e.total_wrong() > tame);
        broken.map(|(&k, _)| k)
    }
}

impl Explorer {
    /// Shows the dial; when it is shown already, chooses the next one.
    pub(crate) fn next_dial(&mut self) {
        if self.panel != Panel::Dial {
            self.panel = Panel::Dial;
            return;
        }
        let dials: Vec<_> = Dial::of_scenes().collect();
        let now = dials.iter().position(|&d| d == self.dialing.dial);
        self.choose_dial(dials[now.map_or(0, |at| at + 1) % dials.len()]);
    }

    /// Chooses a dial; the one before is taken back.
    fn choose_dial(&mut self, dial: &'static Dial) {
        let other = |turn: Turn| turn.dial != dial;
        if self.document.turn().is_some_and(other) {
            self.document.turn_back();
        }
        self.dialing.dial = dial;
    }

    /// Turns the dial one setting on, towards where it breaks.
    pub(crate) fn turn_on(&mut self) {
        let dial = self.dialing.dial;
        let now = self.setting();
        match dial.turns().find(|&k| k > now) {
            Some(k) => self.set_dial(k),
            None => self.say(format!("{} goes no further.", dial.name)),
        }
    }

    /// Turns the dial one setting back, towards the scene as it was.
    pub(crate) fn turn_back(&mut self) {
        let dial = self.dialing.dial;
        match self.setting() {
            0 => self.say("No dial is turned: the scene is as it was."),
            now => self.set_dial(dial.turns().take_while(|&k| k < now).last().unwrap_or(0)),
        }
    }

    /// How far the chosen dial is turned; 0 if it is not.
    fn setting(&self) -> u32 {
        self.document.turn().map_or(0, |turn| turn.k)
    }

    /// Turns the chosen dial to 2^k; 0 takes it back.
    fn set_dial(&mut self, k: u32) {
        let dial = self.dialing.dial;
        if k == 0 {
            self.document.turn_back();
            self.say("The scene is as it was.");
            return;
        }
        let turn = Turn { dial, k };
        let Some(scene) = dial.turn(self.document.ground(), k) else {
            let reason = match dial.name {
                "altitude" => "binary32 cannot tell that place from the surface",
                _ => "a number would leave the range of binary32",
            };
            return self.say(format!("{}: {reason}.", turn.formula()));
        };
        if !self.document.turn_to(turn, scene) {
            self.say(format!("{}: that changes nothing here.", turn.formula()));
        }
    }

    /// Turns the dial of that name to 2^k, or shows it where it stands.
    pub(crate) fn dial_to(&mut self, dial: &'static Dial, k: Option<u32>) {
        self.choose_dial(dial);
        if self.screen.0 > 0 {
            self.panel = Panel::Dial;
        }
        if let Some(k) = k {
            self.set_dial(k);
        }
    }

    /// After undoing and redoing: the dial that is turned is the one that is chosen.
    pub(crate) fn follow_dial(&mut self) {
        if let Some(turn) = self.document.turn() {
            self.dialing.dial = turn.dial;
        }
    }

    /// Whether wrong pixels are marked: while a dial is turned or shown.
    pub(crate) fn marks_wrong(&self) -> bool {
        self.document.turn().is_some() || self.panel == Panel::Dial
    }

    /// Finds out what the picture on the screen gets wrong, if anybody wants to know.
    pub(crate) fn find_errors(&mut self) {
        let (rays, method) = (self.picture.rays, self.options.method);
        let key = (self.document.version(), rays, method);
        if !self.marks_wrong() {
            self.dialing.errors.clear();
            self.dialing.errors_of = None;
            return;
        }
        if self.dialing.errors_of != Some(key) {
            self.dialing.errors = pixel_errors(self.document.scene(), &rays, method);
            self.dialing.errors_of = Some(key);
        }
        self.try_settings();
    }

    /// Notes what the present setting gets wrong, and tries others to tell where the dial broke.
    fn try_settings(&mut self) {
        let Some(shape) = self.picture.key.map(|key| key.shape) else {
            return;
        };
        let key = FoundOf {
            ground: self.document.ground_version(),
            dial: self.dialing.dial,
            method: self.options.method,
            size: self.size(),
            shape,
        };
        if self.dialing.found_of != Some(key) {
            self.dialing.found.clear();
            self.dialing.found_of = Some(key);
        }
        let now = PictureErrors::of(&self.dialing.errors);
        let setting = self.setting();
        self.dialing.found.insert(setting, now);
        let all: Vec<u32> = std::iter::once(0)
            .chain(self.dialing.dial.turns())
            .collect();
        let spheres = self.scene().bodies.len();
        let asked = self
            .size()
            .area()
            .saturating_mul(spheres)
            .saturating_mul(all.len());
        if asked <= MOST_ASKED {
            for k in all {
                self.try_setting(k, shape);
            }
        } else {
            self.try_setting(0, shape);
            self.halve(&all, shape);
        }
    }

    /// Tries the setting half way between the last good and the first bad one, until they are
    /// neighbours.
    fn halve(&mut self, all: &[u32], shape: PixelShape) {
        while let Some(bad) = self.dialing.broke() {
            let good = self.dialing.found.range(..bad).next_back();
            let Some((&good, _)) = good else { return };
            let between: Vec<u32> = all
                .iter()
                .copied()
                .filter(|k| (good + 1..bad).contains(k))
                .collect();
            if between.is_empty() {
                return;
            }
            self.try_setting(between[between.len() / 2], shape);
        }
    }

    fn try_setting(&mut self, k: u32, shape: PixelShape) {
        if self.dialing.found.contains_key(&k) {
            return;
        }
        let ground = self.document.ground();
        let turned = match k {
            0 => Some(ground.clone()),
            k => self.dialing.dial.turn(ground, k),
        };
        let errors = turned.map_or(PictureErrors::default(), |scene| {
            let rays = Rays::new(&scene.camera, self.size(), shape);
            PictureErrors::of(&pixel_errors(&scene, &rays, self.options.method))
        });
        self.dialing.found.insert(k, errors);
    }

    /// The dial, where it stands, what is wrong there, where it broke, and the way there.
    pub(crate) fn dial_lines(&self, cols: usize, rows: usize) -> Vec<Line> {
        let Dialing { dial, found, .. } = &self.dialing;
        let (now, method) = (self.setting(), self.options.method);
        let mut lines = Vec::new();
        let mut say = |role: Role, text: &str| {
            let wrapped = text::wrap(text, cols).into_iter();
            lines.extend(wrapped.map(|line| Line::of(role, line)));
        };
        match now {
            0 => say(Role::Label, &format!("{}: not turned", dial.quantity)),
            k => say(Role::Label, &Turn { dial, k }.formula()),
        }
        say(Role::Faint, dial.on_scenes().unwrap_or(dial.about));
        if !self.marks_wrong() {
            say(
                Role::Plain,
                "\\ turns it on, from tame to broken; | turns it back.",
            );
            return lines;
        }
        let errors = found.get(&now).copied().unwrap_or_default();
        let role = if errors.total_wrong() > 0 {
            Role::Warning
        } else {
            Role::Plain
        };
        say(role, &format!("{method}: {}", in_words(&errors)));
        match (self.dialing.broke(), dial.turns().last()) {
            (Some(k), _) => {
                let wrong = found[&k].total_wrong();
                let formula = Turn { dial, k }.formula();
                let broke = format!(
                    "{method} broke at {formula}: {wrong} of {} pixels wrong",
                    errors.pixels
                );
                say(Role::Warning, &broke);
            }
            (None, Some(last)) if found.contains_key(&last) => {
                say(
                    Role::Plain,
                    &format!("{method} does not break on this dial."),
                );
            }
            (None, _) => say(Role::Plain, &format!("{method} has not broken so far.")),
        }
        let settings: Vec<Setting> = found
            .iter()
            .filter(|(_, errors)| errors.pixels > 0)
            .map(|(&k, errors)| Setting {
                k,
                wrong: errors.total_wrong() as f64 / errors.pixels as f64,
                bits: errors.bits.map(|[median, _]| median),
            })
            .collect();
        let most = dial.turns().last().unwrap_or(1);
        let room = rows.saturating_sub(lines.len());
        let glyphs = self.options.glyphs;
        lines.extend(explain::turning(&settings, now, most, cols, room, glyphs));
        lines
    }
}

/// What is wrong with a picture, by kind.
fn in_words(errors: &PictureErrors) -> String {
    let wrong = errors.total_wrong();
    let bits = errors.bits.map_or(String::new(), |[median, worst]| {
        format!("; bits lost: {median:.0} (median), {worst:.0} (worst)")
    });
    if wrong == 0 {
        return format!("no pixel wrong{bits}");
    }
    let by_kind = [
        (errors.wrong.false_hit, "false hit"),
        (errors.wrong.false_miss, "false miss"),
        (errors.wrong.wrong_count, "wrong count"),
        (errors.wrong.not_finite, "not finite"),
        (errors.other_sphere, "another sphere"),
        (errors.no_bit, "no right bit"),
    ];
    let kinds: Vec<String> = by_kind
        .into_iter()
        .filter(|(count, _)| *count > 0)
        .map(|(count, kind)| format!("{count} {kind}"))
        .collect();
    format!(
        "{wrong} of {} pixels wrong, marked !: {}{bits}",
        errors.pixels,
        kinds.join(", ")
    )
}
