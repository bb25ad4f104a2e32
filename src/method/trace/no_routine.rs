//! Built without routines: there are none to be derived.

use super::TraceStep;
use crate::geometry::{Ray, Sphere};
use crate::method::{RoutineId, Truth};

pub(in crate::method) fn steps(id: RoutineId, _: &Ray, _: &Sphere, _: &Truth) -> Vec<TraceStep> {
    match id {}
}
