#![doc = include_str!("../README.md")]

mod cost;
mod error;
mod fitness;
mod swarm;

pub use cost::Cost;
pub use error::{FitnessError, SwarmError};
pub use fitness::{Fitness, FitnessWeights};
pub use swarm::{
    Boundary, InitialVelocity, ParticleSwarm, Progress, Schedule, Stall, Stop, Stream, Swarm, SwarmOptions,
    Topology,
};
