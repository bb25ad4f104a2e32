//! The laboratory: rays to hold the methods against, what that shows, and what it costs.
//!
//! Nothing here knows a terminal; the command line and the explorer print what is found.

pub mod bench;
mod bench_lock;
mod case;
pub mod chart;
#[cfg(feature = "routine")]
pub mod check;
pub mod dials;
mod errors;
pub mod families;
pub mod frames;
pub mod grade;
mod machine;
pub mod picture;
pub mod plot;
pub mod promise;
mod reference;
mod second;
pub mod slip;
pub mod stress;
pub mod timing;
mod turn;

pub use bench_lock::{BenchLock, BenchQueue, BenchWait};
pub use case::{Case, CaseForm, HEADER};
pub use dials::Dial;
pub use errors::{
    Census, Checksum, Errors, Fault, FaultCounts, Judgement, Percentiles, RootError, Worst, judge,
};
pub use families::Family;
pub use machine::Machine;
pub use reference::{Reference, ReferenceRoot};
pub use second::{Clearance, SecondRays};
pub use turn::Turn;

use crate::geometry::{Ray, Sphere};

/// What a method is asked: where the line of this ray meets this sphere.
pub type Problem = (Ray, Sphere);

/// The ten numbers of a problem, in the order of the columns ox … r.
pub fn numbers((ray, sphere): &Problem) -> [f32; 10] {
    let [ox, oy, oz] = ray.origin.to_array();
    let [dx, dy, dz] = ray.direction.to_array();
    let [cx, cy, cz] = sphere.center.to_array();
    [ox, oy, oz, dx, dy, dz, cx, cy, cz, sphere.radius]
}
