//! The laboratory: rays to hold the methods against.
//!
//! What is measured with them, error and time, joins here later; nothing here draws.

pub mod families;
pub mod frames;
mod random;

pub use families::Family;
pub use random::Random;
