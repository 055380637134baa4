//! What an axis does that its model does not say.

mod config;
mod transition;
mod update;

pub use config::DisturbanceObserver;
pub use update::{DisturbanceEstimate, DisturbanceInput, DisturbanceObserverState};
