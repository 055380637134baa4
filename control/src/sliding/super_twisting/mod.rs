//! Super-twisting: a surface reached in finite time with a continuous input.

mod config;
mod update;

pub use config::SuperTwisting;
pub use update::SuperTwistingState;
