//! The screen as cells: where its parts lie, how they look, and the picture in it.

mod footer;
pub(crate) mod large;
pub(crate) mod layout;
pub(crate) mod panels;
pub(crate) mod pen;
pub(crate) mod picture;
pub(crate) mod screen;
pub(crate) mod svg;
pub(crate) mod theme;
pub(crate) mod view;
