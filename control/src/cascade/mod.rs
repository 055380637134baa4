//! Position and velocity loop, one inside the other: configuration, memory and law.

mod config;
#[cfg(feature = "serde")]
mod unchecked;
mod update;

pub use config::Cascade;
pub use update::{CascadeInput, CascadeOutput, CascadeState};
