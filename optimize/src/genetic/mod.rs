//! A particle swarm with a genetic pool.

mod breeding;
mod config;
mod core;
mod solver;
#[cfg(feature = "serde")]
mod written;

pub use config::{Crossover, GeneticOptions, Mates, Mutation};
pub use core::Breeding;
pub use solver::GeneticSwarm;
