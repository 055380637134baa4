#![doc = include_str!("../README.md")]

mod cost;
mod error;
mod fitness;
mod genetic;
mod programme;
mod recommend;
pub mod reduction;
pub mod shapers;
mod simplex;
mod swarm;
mod trust;
pub mod vibration_free;

pub use cost::Cost;
pub use error::{FitnessError, SimplexError, SwarmError};
pub use fitness::{Fitness, FitnessWeights};
pub use genetic::{Breeding, Crossover, GeneticOptions, GeneticSwarm, Mates, Mutation};
pub use recommend::{
    JudgedMove, JudgedShaper, Motion, MoveKind, MoveRecommendation, MoveTask, RecommendError,
    SHAPER_CAPACITY, ShaperRecommendation, UncertainMode, recommend_move, recommend_shaper, shaper_name,
};
pub use reduction::{ReductionError, reduce_degree};
pub use simplex::{SimplexResult, simplex};
pub use swarm::{
    Boundary, InitialVelocity, ParticleSwarm, Progress, Schedule, Stall, Stop, Stream, Swarm, SwarmOptions,
    Topology,
};
