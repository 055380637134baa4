//! The current loop in rotor axes: configuration, memory and law.

mod config;
#[cfg(feature = "serde")]
mod unchecked;
mod update;

pub use config::{CurrentLoop, PiGains, Windings};
pub use update::{CurrentInput, CurrentLoopState, CurrentOutput, CurrentStatus};
