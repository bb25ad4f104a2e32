//! Files of scenes: opening, saving, and keeping unsaved work.

pub(crate) mod disk;
pub(crate) mod keep;
pub(crate) mod kept;
pub(crate) mod place;
pub(crate) mod remembered;
pub(crate) mod rescue;
pub(crate) mod saving;
pub(crate) mod workplace;
