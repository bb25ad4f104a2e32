//! rayscope: one quadratic, At² + Bt + C = 0, decides each character on the screen.
//!
//! Data flows one way, from the top of this list to its bottom; a module imports only from those
//! above it.
//!
//! * [`system`]: what differs from one operating system to the next
//! * [`text`]: text as people, programs and files write it: characters, numbers, lines, names
//! * [`number`]: what formulas ask of numbers, and powers of two
//! * [`random`]: numbers from a seed, the same on every machine
//! * [`report`]: what a run found, in sentences and tables, in each format
//! * [`door`]: files from outside, opened and read safely
//! * [`geometry`]: rays and spheres, plain data, checked where it comes in
//! * `routine`: one's own way to evaluate it, in GLSL or WGSL, checked and run
//! * [`method`]: the quadratic, and the ways to evaluate it
//! * [`scene`]: spheres, camera, light; scene files; the built-in scenes
//! * [`render`]: rays → nearest hits → shade → glyphs: an image of cells
//! * [`lab`]: families of rays; the error, cost and stability of the methods on them
//! * [`explain`]: what one pixel found, in numbers and words
//! * [`explorer`]: state, actions, update, and the screen as cells
//! * [`terminal`]: enter, leave, restore; the loop between events and the screen
//! * [`cli`]: parses the arguments, calls one of the above

pub mod cli;
pub mod door;
pub mod explain;
pub mod explorer;
pub mod geometry;
pub mod lab;
pub mod method;
pub mod number;
pub mod random;
pub mod render;
pub mod report;
#[cfg(feature = "routine")]
pub mod routine;
pub mod scene;
pub mod system;
pub mod terminal;
pub mod text;
