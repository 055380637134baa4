//! Sliding mode control of one axis: surfaces, reaching laws and the controllers made of them.

mod actuator;
mod config;
mod logarithm;
mod model;
mod reaching;
mod sampling;
mod super_twisting;
mod surface;
#[cfg(feature = "serde")]
mod unchecked;
mod update;

pub use config::SlidingMode;
pub use model::AxisModel;
pub use reaching::{ReachingLaw, Switching};
pub use sampling::Sampling;
pub use super_twisting::{SuperTwisting, SuperTwistingState};
pub use surface::SlidingSurface;
pub use update::{SlidingModeInput, SlidingModeOutput, SlidingModeState};
