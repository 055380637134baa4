//! Curves of a lower degree that run close to a given one.

mod band;
mod bound;
mod deviation;
mod error;
mod exchange;
mod mean_square;
mod minimax;
mod options;
mod pieces;
mod problem;
mod reduce;
mod sampled;
mod search;
mod system;
mod tolerance;

pub use deviation::{Deviation, deviation};
pub use error::ReductionError;
pub use options::{Criterion, Ends, Reduction, Target, Weights};
pub use reduce::{Reduced, reduce_degree};
pub use search::{Freed, ReductionSearch};
