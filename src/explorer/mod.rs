//! The explorer: its state, what each event does to it, and how it is drawn.
//!
//! State changes in [`Explorer::update`] and nowhere else. [`Explorer::prepare`] brings the picture
//! up to date for a screen size, [`Explorer::draw`] reads and writes cells. No terminal is in here:
//! a test, a terminal and a reader of lines drive the same code.
//!
//! `whole` puts the parts together: `state` is what they share, `panel` has a file for each panel,
//! `mode` one for each thing that opens over the screen, `tour` the pages of the tour, `edit` what
//! changes a scene, `files` what opens, saves and keeps it, `draw` the cells.

pub mod action;
mod arrival;
mod command;
mod cursor;
mod dialog;
mod draw;
mod edit;
mod files;
mod key;
mod link;
mod look;
mod mode;
mod options;
mod own_routine;
mod panel;
mod plain;
mod prepare;
mod progress;
#[cfg(not(feature = "routine"))]
#[path = "no_routine_text.rs"]
mod routine_text;
#[cfg(feature = "routine")]
mod routine_text;
mod routines;
mod set;
mod setting;
mod state;
pub mod tour;
mod typing;
mod viewpoint;
mod walk;
mod whole;

pub use draw::layout::screen_for;
pub use draw::svg::svg;
pub use draw::theme::Palette;
pub use edit::motion::usual_step;
pub use files::remembered::remembered;
pub use files::workplace::Workplace;
pub use link::command_line;
pub use options::{Options, Reasons, Request};
pub use panel::Panel;
pub use plain::Reply;
pub use setting::{SETTINGS, Setting, SettingRow, read_size};
pub use viewpoint::Viewpoint;
pub use whole::Explorer;
