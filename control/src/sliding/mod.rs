//! Sliding mode control of one axis: surfaces, reaching laws and the controllers made of them.

mod config;
mod logarithm;
mod model;
mod reaching;
mod surface;
#[cfg(feature = "serde")]
mod unchecked;
mod update;

pub use config::SlidingMode;
pub use model::AxisModel;
pub use reaching::{ReachingLaw, Switching};
pub use surface::SlidingSurface;
pub use update::{SlidingModeInput, SlidingModeOutput, SlidingModeState};
