//! rayscope: one quadratic, At² + Bt + C = 0, decides each character on the screen.
//!
//! Data flows one way, from the top of this list to its bottom; a module imports only from those
//! above it.
//!
//! * [`geometry`]: rays and spheres, plain data, checked where it comes in
//! * [`method`]: the quadratic, and the ways to evaluate it
//! * [`scene`]: spheres, camera, light; scene files; the built-in scenes
//! * [`render`]: rays → nearest hits → shade → glyphs: an image of cells

pub mod cli;
pub mod geometry;
pub mod method;
pub mod render;
pub mod scene;
