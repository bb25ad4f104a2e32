//! The scene being edited, its history, and whether it differs from what was saved.

use std::sync::atomic::{AtomicU64, Ordering};

use crate::lab::Turn;
use crate::scene::{Body, Camera, Scene};

/// One change of the scene, which knows how to be undone.
#[derive(Debug, Clone, PartialEq)]
pub enum Change {
    /// The camera becomes this one.
    Camera(Camera),
    /// The sphere of that number becomes this one.
    Replace(usize, Body),
    /// A sphere comes in at that number.
    Insert(usize, Body),
    /// The sphere of that number goes.
    Remove(usize),
    /// The whole scene becomes this one.
    Scene(Box<Scene>),
    /// The scene becomes one that shares spheres with it.
    Difference(Box<Difference>),
}

/// Whether a change does a deed or takes it back.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Way {
    Forth,
    Back,
}

impl Change {
    /// What the change does to `scene`, or what was done that it takes back.
    fn deed(&self, scene: &Scene, way: Way) -> String {
        let sphere = |at: &usize, deed: &str| format!("sphere {} was {deed}", at + 1);
        match (self, way) {
            (Self::Camera(camera), _) if camera.projection == scene.camera.projection => {
                "the camera was moved".into()
            }
            (Self::Camera(_), _) => "the view was made wider or narrower".into(),
            (Self::Replace(at, body), _) => {
                let now = scene.bodies.get(*at).unwrap_or(body);
                let (before, after) = match way {
                    Way::Forth => (now, body),
                    Way::Back => (body, now),
                };
                let [old, new] = [before, after].map(|body| body.sphere);
                let deed = if old.center != new.center {
                    "moved"
                } else if old.radius < new.radius {
                    "made larger"
                } else if old.radius > new.radius {
                    "made smaller"
                } else {
                    "changed"
                };
                sphere(at, deed)
            }
            (Self::Insert(at, _), Way::Forth) | (Self::Remove(at), Way::Back) => {
                sphere(at, "added")
            }
            (Self::Insert(at, _), Way::Back) | (Self::Remove(at), Way::Forth) => {
                sphere(at, "deleted")
            }
            (Self::Scene(_) | Self::Difference(_), _) => "the scene was another one".into(),
        }
    }
}

/// What makes another scene of a scene, without the spheres that they share.
#[derive(Debug, Clone, PartialEq)]
pub struct Difference {
    /// All of the scene but its spheres.
    rest: Scene,
    /// The spheres that are others, by number.
    others: Vec<(usize, Body)>,
    /// How many spheres stay in front, and those that come after.
    kept: usize,
    tail: Vec<Body>,
}

impl Difference {
    /// What makes `scene` of the scene that it becomes `by` then.
    fn between(mut scene: Scene, by: &Scene) -> Self {
        let kept = scene.bodies.len().min(by.bodies.len());
        let tail = scene.bodies.split_off(kept);
        let bodies = std::mem::take(&mut scene.bodies).into_iter().enumerate();
        let others = bodies
            .filter(|(at, body)| by.bodies[*at] != *body)
            .collect();
        Self {
            rest: scene,
            others,
            kept,
            tail,
        }
    }

    /// The scene that it makes of this one.
    fn apply(self, mut bodies: Vec<Body>) -> Scene {
        bodies.truncate(self.kept);
        for (at, body) in self.others {
            bodies[at] = body;
        }
        bodies.extend(self.tail);
        Scene {
            bodies,
            ..self.rest
        }
    }
}

/// How a scene that goes is kept.
#[derive(Debug, Clone, Copy)]
enum Inverse {
    /// As what differs from the scene that comes.
    Small,
    /// Whole: a dial is turned on it.
    Whole,
}

impl Inverse {
    fn of(self, before: Scene, after: &Scene) -> Change {
        match self {
            Self::Small => Change::Difference(Box::new(Difference::between(before, after))),
            Self::Whole => Change::Scene(Box::new(before)),
        }
    }
}

/// A scene with its past and its undone future.
///
/// A dial that is turned is the last change of the past, and one change however far it is turned:
/// taking it back brings the scene back that it was turned on.
#[derive(Debug, Clone)]
pub struct Document {
    scene: Scene,
    state: DialState,
    past: Vec<HistoryEntry>,
    future: Vec<HistoryEntry>,
    /// How long the past was when the scene was saved; none when that state can't be reached.
    saved_at: Option<usize>,
    version: u64,
}

/// What belongs to a scene beside the scene.
#[derive(Debug, Clone, Copy, PartialEq)]
struct DialState {
    /// The dial that makes it what it is.
    turn: Option<Turn>,
    /// A number that is another one for another scene, the dial apart.
    ground: u64,
}

/// A change that leads to another scene, and what belongs to that.
#[derive(Debug, Clone)]
struct HistoryEntry {
    change: Change,
    state: DialState,
}

/// A number that no document has had before, so that one also tells documents apart.
fn next_version() -> u64 {
    static LAST: AtomicU64 = AtomicU64::new(0);
    LAST.fetch_add(1, Ordering::Relaxed)
}

impl Document {
    /// A document that has just been read.
    pub fn new(scene: Scene) -> Self {
        let version = next_version();
        let state = DialState {
            turn: None,
            ground: version,
        };
        Self {
            scene,
            state,
            past: Vec::new(),
            future: Vec::new(),
            saved_at: Some(0),
            version,
        }
    }

    /// The scene as it is now.
    pub const fn scene(&self) -> &Scene {
        &self.scene
    }

    /// A number that is another one whenever the scene may be another one.
    pub const fn version(&self) -> u64 {
        self.version
    }

    /// The dial that is turned, if one is.
    pub const fn turn(&self) -> Option<Turn> {
        self.state.turn
    }

    /// The scene that the dial is turned on; the scene itself if none is.
    pub fn ground(&self) -> &Scene {
        match (self.state.turn, self.past.last()) {
            (Some(_), Some(entry)) => match &entry.change {
                Change::Scene(scene) => scene,
                _ => &self.scene,
            },
            _ => &self.scene,
        }
    }

    /// A number that is another one whenever [`Document::ground`] may be another scene.
    pub const fn ground_version(&self) -> u64 {
        self.state.ground
    }

    /// Whether there is something that saving would keep. A dial is no change of that kind: it is
    /// taken back first.
    pub fn is_changed(&self) -> bool {
        let turned = usize::from(self.state.turn.is_some());
        self.saved_at != Some(self.past.len() - turned)
    }

    /// Tells the document that its present state has been saved; with a dial turned, it is the
    /// turned scene that is the person's own from now on.
    pub fn mark_saved(&mut self) {
        if self.state.turn.take().is_some() {
            self.state.ground = self.version;
        }
        self.saved_at = Some(self.past.len());
    }

    /// Takes over what is said of the scene, its name and its places: no change that can be undone.
    pub fn retitle(&mut self, said: Scene) {
        (self.scene.name, self.scene.about, self.scene.probes) =
            (said.name, said.about, said.probes);
    }

    /// Applies a change that [`Document::undo`] takes back; false if it changes nothing.
    pub fn apply(&mut self, change: Change) -> bool {
        self.apply_keeping(change, Inverse::Small)
    }

    fn apply_keeping(&mut self, change: Change, inverse: Inverse) -> bool {
        let before = self.state;
        let Some(inverse) = self.perform(change, inverse) else {
            return false;
        };
        if self.saved_at.is_some_and(|at| at > self.past.len()) {
            self.saved_at = None;
        }
        self.past.push(HistoryEntry {
            change: inverse,
            state: before,
        });
        self.future.clear();
        self.state = DialState {
            turn: None,
            ground: self.version,
        };
        true
    }

    /// Makes [`Document::ground`] the scene that a dial turns it into; false if it is that already.
    pub fn turn_to(&mut self, turn: Turn, scene: Scene) -> bool {
        self.turn_back();
        let ground = self.state.ground;
        if !self.apply_keeping(Change::Scene(Box::new(scene)), Inverse::Whole) {
            return false;
        }
        self.state = DialState {
            turn: Some(turn),
            ground,
        };
        true
    }

    /// Takes the dial back; false if none is turned.
    pub fn turn_back(&mut self) -> bool {
        self.state.turn.is_some() && self.undo()
    }

    /// Takes the last change back; false if there is none.
    pub fn undo(&mut self) -> bool {
        let Some(entry) = self.past.pop() else {
            return false;
        };
        let inverse = self.go(entry);
        self.future.extend(inverse);
        true
    }

    /// What [`Document::undo`] takes back, in a few words.
    pub fn undoes(&self) -> Option<String> {
        let entry = self.past.last()?;
        Some(match self.state.turn {
            Some(_) => "the dial was turned".into(),
            None => entry.change.deed(&self.scene, Way::Back),
        })
    }

    /// What [`Document::redo`] does again, in a few words.
    pub fn redoes(&self) -> Option<String> {
        let entry = self.future.last()?;
        Some(match entry.state.turn {
            Some(_) => "the dial was turned".into(),
            None => entry.change.deed(&self.scene, Way::Forth),
        })
    }

    /// Whether there is nothing to undo.
    pub const fn is_as_opened(&self) -> bool {
        self.past.is_empty()
    }

    /// Does again what was undone last; false if there is nothing.
    pub fn redo(&mut self) -> bool {
        let Some(entry) = self.future.pop() else {
            return false;
        };
        let inverse = self.go(entry);
        self.past.extend(inverse);
        true
    }

    /// Goes where an entry leads; the entry that leads back.
    fn go(&mut self, HistoryEntry { change, state }: HistoryEntry) -> Option<HistoryEntry> {
        let before = std::mem::replace(&mut self.state, state);
        let inverse = match self.state.turn {
            Some(_) => Inverse::Whole,
            None => Inverse::Small,
        };
        let change = self.perform(change, inverse)?;
        Some(HistoryEntry {
            change,
            state: before,
        })
    }

    /// Performs a change and returns the one that takes it back; none if nothing changes.
    fn perform(&mut self, change: Change, inverse: Inverse) -> Option<Change> {
        let bodies = &mut self.scene.bodies;
        let inverse = match change {
            Change::Camera(camera) => {
                if camera == self.scene.camera {
                    return None;
                }
                Change::Camera(std::mem::replace(&mut self.scene.camera, camera))
            }
            Change::Replace(at, body) => {
                let place = bodies.get_mut(at)?;
                if *place == body {
                    return None;
                }
                Change::Replace(at, std::mem::replace(place, body))
            }
            Change::Insert(at, body) => {
                let at = at.min(bodies.len());
                bodies.insert(at, body);
                Change::Remove(at)
            }
            Change::Remove(at) => {
                if at >= bodies.len() {
                    return None;
                }
                Change::Insert(at, bodies.remove(at))
            }
            Change::Scene(scene) => {
                if *scene == self.scene {
                    return None;
                }
                inverse.of(std::mem::replace(&mut self.scene, *scene), &self.scene)
            }
            Change::Difference(difference) => {
                let scene = difference.apply(self.scene.bodies.clone());
                inverse.of(std::mem::replace(&mut self.scene, scene), &self.scene)
            }
        };
        self.version = next_version();
        Some(inverse)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::Dial;
    use crate::scene::Builtin;

    fn turned(document: &mut Document, k: u32) -> bool {
        let dial = Dial::by_name("distance").unwrap();
        let scene = dial.turn(document.ground(), k).unwrap();
        document.turn_to(Turn { dial, k }, scene)
    }

    fn moved(document: &mut Document) -> bool {
        let mut body = document.scene().bodies[0].clone();
        body.sphere.center.x += 1.0;
        document.apply(Change::Replace(0, body))
    }

    #[test]
    fn a_dial_lies_over_the_scene_and_leaves_it_as_it_was() {
        let scene = Builtin::by_name("trio").unwrap().scene();
        let mut document = Document::new(scene.clone());
        for k in [1, 2, 12, 3] {
            assert!(turned(&mut document, k));
            assert_eq!(document.turn().map(|turn| turn.k), Some(k));
            assert_eq!(*document.ground(), scene);
            assert_ne!(*document.scene(), scene);
            assert!(!document.is_changed());
        }
        let far = document.scene().clone();
        assert!(document.undo(), "one step, however far it was turned");
        assert_eq!((document.scene(), document.turn()), (&scene, None));
        assert!(!document.undo() && document.redo());
        assert_eq!(document.turn().map(|turn| turn.k), Some(3));
        assert_eq!(*document.scene(), far);
        assert!(document.turn_back() && !document.turn_back());
        assert_eq!(*document.scene(), scene);
    }

    #[test]
    fn a_change_of_a_turned_scene_is_a_change() {
        let scene = Builtin::by_name("trio").unwrap().scene();
        let mut document = Document::new(scene.clone());
        assert!(turned(&mut document, 5) && moved(&mut document));
        assert!(document.is_changed() && document.turn().is_none());
        let own = document.scene().clone();
        assert!(turned(&mut document, 1));
        assert_eq!(*document.ground(), own, "the dial starts from here");
        assert!(document.is_changed());
        assert!(document.undo() && document.undo());
        assert_eq!(document.turn().map(|turn| turn.k), Some(5));
        assert!(!document.is_changed());
        assert_eq!(*document.ground(), scene);
        document.mark_saved();
        assert!(!document.is_changed() && document.turn().is_none());
        assert_eq!(document.ground(), document.scene());
    }

    #[test]
    fn the_ground_has_a_number_of_its_own() {
        let mut document = Document::new(Builtin::by_name("trio").unwrap().scene());
        let first = document.ground_version();
        turned(&mut document, 4);
        assert_eq!(document.ground_version(), first);
        moved(&mut document);
        let second = document.ground_version();
        assert_ne!(second, first);
        turned(&mut document, 2);
        assert_eq!(document.ground_version(), second);
        document.undo();
        document.undo();
        assert_eq!(document.ground_version(), first);
        moved(&mut document);
        assert!(![first, second].contains(&document.ground_version()));
    }

    #[test]
    fn a_scene_that_comes_back_costs_what_differs() {
        let whole = Builtin::by_name("crowd").unwrap().scene();
        let mut document = Document::new(whole.clone());
        for _ in 0..3 {
            assert!(moved(&mut document));
            assert!(document.apply(Change::Scene(Box::new(whole.clone()))));
        }
        let mut fewer = whole.clone();
        fewer.bodies.truncate(7);
        assert!(document.apply(Change::Scene(Box::new(fewer.clone()))));
        let spheres = |entry: &HistoryEntry| match &entry.change {
            Change::Difference(difference) => difference.others.len() + difference.tail.len(),
            Change::Scene(scene) => scene.bodies.len(),
            _ => 1,
        };
        let kept: Vec<usize> = document.past.iter().map(spheres).collect();
        let all = whole.bodies.len();
        assert_eq!(kept, [1, 1, 1, 1, 1, 1, all - 7]);
        for _ in 0..2 {
            assert!(document.undo() && *document.scene() == whole);
            assert!(document.redo() && *document.scene() == fewer);
        }
        while document.undo() {}
        assert_eq!(*document.scene(), whole);
        while document.redo() {}
        assert_eq!(*document.scene(), fewer);
    }
}
