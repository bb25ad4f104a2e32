//! Built without routines: there are none to be asked.

use std::path::Path;

use super::Solution;
use super::batch::{Batch, Scalars, Vectors};
use crate::door::FileError;
use crate::geometry::{Ray, Sphere};

/// A routine: none can be had in this build.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum RoutineId {}

impl RoutineId {
    /// Why a file can't be read.
    pub(super) fn load(_: &str, path: &Path) -> Result<Self, FileError> {
        Err(FileError::whole(
            path,
            "this program was built without routines",
        ))
    }

    /// Why a text can't be read.
    pub(super) fn with_text(name: &str, _: &str) -> Result<Self, FileError> {
        Self::load(name, Path::new(name))
    }

    /// The name that it was learnt under.
    pub fn name(self) -> &'static str {
        match self {}
    }

    /// What tells its name apart from the same of another folder.
    pub fn key(self) -> String {
        match self {}
    }

    /// What it answers, in words.
    pub fn words(self) -> String {
        match self {}
    }

    pub(super) fn gives_one_at_most(self) -> bool {
        match self {}
    }

    pub(super) fn solve(self, _: &Ray, _: &Sphere) -> Solution {
        match self {}
    }

    pub(super) fn solve_all<O: Vectors, D: Vectors, C: Vectors, R: Scalars>(
        self,
        _: &Batch<O, D, C, R>,
        _: impl FnMut(usize, Solution),
    ) {
        match self {}
    }
}
