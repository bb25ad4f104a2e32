//! Dials on the live scene: turned from tame to broken and back, with what the chosen method gets
//! wrong on the way.
//!
//! A dial is one change of the document, however far it is turned, so that the person's own scene
//! lies under it untouched.

use std::collections::BTreeMap;

use crate::explain::{self, Line, Role};
use ratatui::layout::Rect;

use crate::explorer::action::Action;
use crate::explorer::panel::Panel;
use crate::explorer::panel::component::{AS_FIGURE, Component};
use crate::explorer::state::State;
use crate::lab::chart::DialPoint;
use crate::lab::picture::{PictureComparison, PictureErrors, PixelError};
use crate::lab::{Dial, Turn};
use crate::method::Method;
use crate::render::{Allowance, Style};
use crate::scene::{PixelShape, Rays, Scene, Size};
use crate::text;

/// The dial that was chosen, and what it has shown so far.
#[derive(Debug)]
pub(crate) struct DialPanel {
    pub(crate) dial: &'static Dial,
    /// What the picture on the screen gets wrong, row by row; empty where that is not asked.
    errors: Vec<PixelError>,
    errors_of: Option<ErrorsOf>,
    /// What is being found out about it.
    comparison: Option<(ErrorsOf, PictureComparison)>,
    /// What each setting that was tried gets wrong.
    found: BTreeMap<u32, PictureErrors>,
    found_of: Option<FoundOf>,
    /// The setting that is being tried.
    trial: Option<Trial>,
}

/// What the errors of the picture on the screen depend on.
type ErrorsOf = (u64, Rays, Method);

/// A setting that is being tried.
#[derive(Debug)]
struct Trial {
    k: u32,
    scene: Scene,
    rays: Rays,
    comparison: PictureComparison,
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

impl Default for DialPanel {
    fn default() -> Self {
        Self {
            dial: &Dial::ALL[0],
            errors: Vec::new(),
            errors_of: None,
            comparison: None,
            found: BTreeMap::new(),
            found_of: None,
            trial: None,
        }
    }
}

/// So many times may all settings of a dial ask a method about a sphere: in larger scenes only those
/// settings are tried that tell where it broke.
const MOST_ASKED: usize = 2_000_000;

impl DialPanel {
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

impl Component for DialPanel {
    fn text(&self, state: &State, room: Rect) -> (String, Vec<Line>) {
        let lines = self.lines(state, room.width.into(), room.height.into());
        (format!("dial: {}", self.dial.name), lines)
    }

    fn foot(&self, _: &State) -> String {
        "\\ turn up  | back  9 next dial".into()
    }

    fn act(&mut self, action: Action, state: &mut State) -> bool {
        self.follow(state);
        match action {
            Action::NextDial => self.next_dial(state),
            Action::TurnOn => self.turn_on(state),
            Action::TurnBack => self.turn_back(state),
            _ => return false,
        }
        true
    }

    /// Finds out what the picture on the screen gets wrong, if it is marked.
    fn go_on(&mut self, state: &State, allowance: &mut Allowance) -> bool {
        self.follow(state);
        if !marks_wrong(state) {
            self.errors.clear();
            (self.errors_of, self.comparison, self.trial) = (None, None, None);
            return true;
        }
        self.compare_picture(state, allowance) && self.try_settings(state, allowance)
    }

    fn size_as_text(&self) -> (u16, u16) {
        AS_FIGURE
    }
}

impl DialPanel {
    /// After undoing and redoing, the dial that is turned is the one that is chosen.
    fn follow(&mut self, state: &State) {
        if let Some(turn) = state.work.document.turn() {
            self.dial = turn.dial;
        }
    }

    /// Shows the dial; when it is shown already, chooses the next one.
    fn next_dial(&mut self, state: &mut State) {
        if state.at.panel != Panel::Dial {
            state.at.panel = Panel::Dial;
            return;
        }
        let dials: Vec<_> = Dial::of_scenes().collect();
        let now = dials.iter().position(|&d| d == self.dial);
        self.choose_dial(state, dials[now.map_or(0, |at| at + 1) % dials.len()]);
    }

    /// Chooses a dial; the one before is taken back.
    fn choose_dial(&mut self, state: &mut State, dial: &'static Dial) {
        let other = |turn: Turn| turn.dial != dial;
        if state.work.document.turn().is_some_and(other) {
            state.work.document.turn_back();
        }
        self.dial = dial;
    }

    /// Turns the dial one setting on, towards where it breaks.
    fn turn_on(&mut self, state: &mut State) {
        let dial = self.dial;
        let now = setting(state);
        match dial.turns().find(|&k| k > now) {
            Some(k) => self.set_dial(state, k),
            None => state.say(format!("{} goes no further.", dial.name)),
        }
    }

    /// Turns the dial one setting back, towards the scene as it was.
    fn turn_back(&mut self, state: &mut State) {
        let dial = self.dial;
        match setting(state) {
            0 => state.say("No dial is turned: the scene is as it was."),
            now => self.set_dial(
                state,
                dial.turns().take_while(|&k| k < now).last().unwrap_or(0),
            ),
        }
    }

    /// Turns the chosen dial to 2^k; 0 takes it back.
    fn set_dial(&self, state: &mut State, k: u32) {
        let dial = self.dial;
        if k == 0 {
            state.work.document.turn_back();
            state.say("The scene is as it was.");
            return;
        }
        let turn = Turn { dial, k };
        let Some(scene) = dial.turn(state.work.document.ground(), k) else {
            let reason = match dial.name {
                "altitude" => "binary32 cannot tell that place from the surface",
                _ => "a number would leave the range of binary32",
            };
            return state.say(format!("{}: {reason}.", turn.formula()));
        };
        if !state.work.document.turn_to(turn, scene) {
            state.say(format!("{}: that changes nothing here.", turn.formula()));
        }
    }

    /// Turns the dial of that name to 2^k, or shows it where it stands.
    pub(crate) fn dial_to(&mut self, state: &mut State, dial: &'static Dial, k: Option<u32>) {
        self.choose_dial(state, dial);
        if state.screen.0 > 0 {
            state.at.panel = Panel::Dial;
        }
        if let Some(k) = k {
            self.set_dial(state, k);
        }
    }

    /// Holds the picture on the screen against that of `exact`; whether that is done.
    fn compare_picture(&mut self, state: &State, allowance: &mut Allowance) -> bool {
        let (scene, rays, method) = (state.scene(), &state.picture.rays, state.at.method);
        let key = (state.work.document.version(), *rays, method);
        if self.errors_of == Some(key) {
            return true;
        }
        self.errors.clear();
        self.errors_of = None;
        let begun = self.comparison.take().filter(|(of, _)| *of == key);
        let (_, mut comparison) =
            begun.unwrap_or_else(|| (key, PictureComparison::begin(scene, rays, method)));
        if !comparison.go_on(scene, rays, allowance) {
            self.comparison = Some((key, comparison));
            return false;
        }
        self.errors = comparison.into_errors();
        self.errors_of = Some(key);
        true
    }

    /// Notes what the present setting gets wrong, and tries others to tell where the dial broke; whether
    /// that is done.
    fn try_settings(&mut self, state: &State, allowance: &mut Allowance) -> bool {
        let Some(shape) = state.picture.key.map(|key| key.shape) else {
            return true;
        };
        let key = FoundOf {
            ground: state.work.document.ground_version(),
            dial: self.dial,
            method: state.at.method,
            size: state.size(),
            shape,
        };
        if self.found_of != Some(key) {
            self.found.clear();
            self.trial = None;
            self.found_of = Some(key);
        }
        let now = PictureErrors::of(&self.errors);
        self.found.insert(setting(state), now);
        while let Some(k) = self.next_to_try(state) {
            if !self.try_setting(state, (k, key), allowance) {
                return false;
            }
        }
        true
    }

    /// The next setting to try: each of them or, if that would be much, the one half way between the last
    /// good and the first bad one, until these are neighbours.
    fn next_to_try(&self, state: &State) -> Option<u32> {
        let all = || std::iter::once(0).chain(self.dial.turns());
        let spheres = state.scene().bodies.len();
        let asked = state
            .size()
            .area()
            .saturating_mul(spheres)
            .saturating_mul(all().count());
        if asked <= MOST_ASKED || !self.found.contains_key(&0) {
            return all().find(|k| !self.found.contains_key(k));
        }
        let bad = self.broke()?;
        let (&good, _) = self.found.range(..bad).next_back()?;
        let between: Vec<u32> = all().filter(|k| (good + 1..bad).contains(k)).collect();
        between.get(between.len() / 2).copied()
    }

    /// Tries a setting while the allowance lasts; whether that is done.
    fn try_setting(
        &mut self,
        state: &State,
        (k, of): (u32, FoundOf),
        allowance: &mut Allowance,
    ) -> bool {
        let begun = self.trial.take().filter(|trial| trial.k == k);
        let Some(mut trial) = begun.or_else(|| self.begin_trial(state, (k, of))) else {
            self.found.insert(k, PictureErrors::default());
            return true;
        };
        let Trial {
            scene,
            rays,
            comparison,
            ..
        } = &mut trial;
        if !comparison.go_on(scene, rays, allowance) {
            self.trial = Some(trial);
            return false;
        }
        let errors = trial.comparison.into_errors();
        self.found.insert(k, PictureErrors::of(&errors));
        true
    }

    /// The scene at a setting; none if it can't be turned so far.
    fn begin_trial(&self, state: &State, (k, of): (u32, FoundOf)) -> Option<Trial> {
        let ground = state.work.document.ground();
        let scene = match k {
            0 => ground.clone(),
            k => self.dial.turn(ground, k)?,
        };
        let rays = Rays::new(&scene.camera, of.size, of.shape);
        Some(Trial {
            k,
            comparison: PictureComparison::begin(&scene, &rays, of.method),
            scene,
            rays,
        })
    }

    /// How far the dial is turned, what is wrong there, where it broke, and the way there.
    fn lines(&self, state: &State, cols: usize, rows: usize) -> Vec<Line> {
        let Self { dial, found, .. } = self;
        let (now, method) = (setting(state), state.at.method);
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
        if !marks_wrong(state) {
            say(
                Role::Plain,
                "\\ turns it up, towards where methods break; | turns it back.",
            );
            return lines;
        }
        if self.errors_of.is_none() {
            say(Role::Faint, "The picture is still being compared.");
            return lines;
        }
        let errors = found.get(&now).copied().unwrap_or_default();
        let role = if errors.total_wrong() > 0 {
            Role::Warning
        } else {
            Role::Plain
        };
        say(role, &format!("{method}: {}", in_words(&errors)));
        match (self.broke(), dial.turns().last()) {
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
        let settings: Vec<DialPoint> = found
            .iter()
            .filter(|(_, errors)| errors.pixels > 0)
            .map(|(&k, errors)| DialPoint {
                k: k as i32,
                wrong: errors.total_wrong() as f64 / errors.pixels as f64,
                bits: errors.bits.map(|[median, _]| median),
            })
            .collect();
        let most = dial.turns().last().unwrap_or(1);
        let room = rows.saturating_sub(lines.len());
        let glyphs = state.options.glyphs;
        lines.extend(explain::turning(&settings, now, most, cols, room, glyphs));
        lines
    }
}

/// How far the chosen dial is turned; 0 if it is not.
fn setting(state: &State) -> u32 {
    state.work.document.turn().map_or(0, |turn| turn.k)
}

/// Whether wrong pixels are marked: while a dial is turned or shown.
fn marks_wrong(state: &State) -> bool {
    state.work.document.turn().is_some() || state.at.panel == Panel::Dial
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

#[cfg(test)]
mod tests {
    use ratatui::crossterm::event::{Event, KeyCode, KeyEvent, KeyModifiers};

    use crate::explorer::{Explorer, Options};
    use crate::scene::Scene;

    #[test]
    fn keys_in_a_burst_leave_what_is_wrong_to_the_drawing() {
        let (scene, source) = Scene::open("far").unwrap();
        let mut explorer = Explorer::new(scene, &source, Options::default());
        let press = |keys: &str, explorer: &mut Explorer| {
            for c in keys.chars() {
                let key = KeyEvent::new(KeyCode::Char(c), KeyModifiers::NONE);
                explorer.update(&Event::Key(key));
            }
        };
        explorer.prepare(80, 24);
        press("9P9\\", &mut explorer);
        explorer.prepare(80, 24);
        let found = explorer.panels.dial.errors_of;
        assert!(found.is_some());
        press(&"dl.,".repeat(13), &mut explorer);
        assert_eq!(explorer.panels.dial.errors_of, found);
        explorer.prepare(80, 24);
        assert_ne!(explorer.panels.dial.errors_of, found);
    }
}
