//! Particle swarms.

mod config;
mod core;
mod motion;
mod progress;
mod solver;
mod stream;
#[cfg(feature = "serde")]
mod written;

pub use config::{Boundary, InitialVelocity, Schedule, Stall, Stop, SwarmOptions, Topology};
pub use core::Swarm;
pub use progress::Progress;
pub use solver::ParticleSwarm;
pub use stream::Stream;

pub(crate) use motion::scatter;
pub(crate) use solver::{Population, Reported, evaluate, terminate};
