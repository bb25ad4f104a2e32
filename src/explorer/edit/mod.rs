//! Changing the scene: the document and its history, numbers by name, camera and spheres.

pub(crate) mod camera;
pub(crate) mod document;
pub(crate) mod field;
pub(crate) mod history;
pub(crate) mod motion;
pub(crate) mod spheres;
