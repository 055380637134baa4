//! What can be wrong with requirements on a train, with the number that is wrong.

use shaping::TrainError;
use thiserror::Error;

/// A train that cannot be found.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum ShortestTrainError {
    /// Nothing is asked of the train.
    #[error("a train needs something to do")]
    NoRequirement,
    /// More zeros and ranges than are dealt with at a time.
    #[error("a train can be asked for {most} things at a time, not {requirements}")]
    Requirements {
        /// Requirements given.
        requirements: usize,
        /// The most there may be.
        most: usize,
    },
    /// An order of a zero that is zero or too high.
    #[error("the order of a zero must be 1 to {most}, got {order}")]
    Order {
        /// The order given.
        order: usize,
        /// The highest order.
        most: usize,
    },
    /// A tolerated vibration that is not between nothing and all.
    #[error("the tolerated vibration must lie between 1e-6 and 1, got {0}")]
    Tolerance(f64),
    /// A sum of magnitudes below one, or no number.
    #[error("the magnitudes of the impulses add up to at least 1, not {0}")]
    Demand(f64),
    /// Frequencies so far apart that no common scale serves.
    #[error("the frequencies span a factor of {ratio}, the most is {most}")]
    Spread {
        /// Highest over lowest frequency.
        ratio: f64,
        /// The largest ratio.
        most: f64,
    },
    /// No train up to this length does what is asked.
    #[error("no train of up to {longest} s does that")]
    Infeasible {
        /// The longest train tried, s.
        longest: f64,
    },
    /// The solver came to rest where the requirements are not met.
    #[error("the search ended {violation:e} short of what is asked")]
    NotConverged {
        /// The vibration that is left beyond what is tolerated, as a part of that of a step.
        violation: f64,
    },
    /// A train that cannot be, or does not fit.
    #[error(transparent)]
    Train(#[from] TrainError),
}
