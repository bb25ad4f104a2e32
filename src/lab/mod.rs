//! The laboratory: rays to hold the methods against.
//!
//! What is measured with them, error and time, joins here later; nothing here draws.

pub mod families;
mod random;

pub use families::Family;
pub use random::Random;
