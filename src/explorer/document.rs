//! The scene being edited, its history, and whether it differs from what was saved.

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
}

/// A scene with its past and its undone future.
#[derive(Debug, Clone)]
pub struct Document {
    scene: Scene,
    past: Vec<Change>,
    future: Vec<Change>,
    /// How long the past was when the scene was saved; none when that state can't be reached.
    saved_at: Option<usize>,
    version: u64,
}

impl Document {
    /// A document that has just been read.
    pub fn new(scene: Scene) -> Self {
        Self {
            scene,
            past: Vec::new(),
            future: Vec::new(),
            saved_at: Some(0),
            version: 0,
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

    /// Whether there is something that saving would keep.
    pub fn is_changed(&self) -> bool {
        self.saved_at != Some(self.past.len())
    }

    /// Tells the document that its present state has been saved.
    pub fn mark_saved(&mut self) {
        self.saved_at = Some(self.past.len());
    }

    /// Applies a change that [`Document::undo`] takes back; false if it changes nothing.
    pub fn apply(&mut self, change: Change) -> bool {
        let Some(inverse) = self.perform(change) else {
            return false;
        };
        if self.saved_at.is_some_and(|at| at > self.past.len()) {
            self.saved_at = None;
        }
        self.past.push(inverse);
        self.future.clear();
        true
    }

    /// Takes the last change back; false if there is none.
    pub fn undo(&mut self) -> bool {
        let Some(change) = self.past.pop() else {
            return false;
        };
        let inverse = self.perform(change);
        self.future.extend(inverse);
        true
    }

    /// Does again what was undone last; false if there is nothing.
    pub fn redo(&mut self) -> bool {
        let Some(change) = self.future.pop() else {
            return false;
        };
        let inverse = self.perform(change);
        self.past.extend(inverse);
        true
    }

    /// Performs a change and returns the one that takes it back; none if nothing changes.
    fn perform(&mut self, change: Change) -> Option<Change> {
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
                Change::Scene(Box::new(std::mem::replace(&mut self.scene, *scene)))
            }
        };
        self.version += 1;
        Some(inverse)
    }
}
