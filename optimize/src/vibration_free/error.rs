//! Why a motion cannot be planned.

use profiles::PlanError;
use thiserror::Error;

/// A vibration-free motion that cannot be planned.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum VibrationFreeError {
    /// More modes than are dealt with at a time.
    #[error("a motion can leave {most} modes at rest, not {modes}")]
    Modes {
        /// Modes given.
        modes: usize,
        /// The most there may be.
        most: usize,
    },
    /// A mode so slow that it takes the motion for a jump.
    #[error("a mode of {0} rad/s is too slow for such a motion")]
    Slow(f64),
    /// A half width of a band that is no part of the frequency.
    #[error("the half width of a band must lie between 0 and 1 of its frequency, got {0}")]
    HalfWidth(f64),
    /// A tolerated residual that is nothing or all.
    #[error("the tolerated residual must lie between 1e-9 and 1 of the motion, got {0}")]
    Residual(f64),
    /// A distance for a change of velocity, m.
    #[error("a change of velocity has no distance to plan anew, got {0} m")]
    NoDistance(f64),
    /// A period of a clock on which there is no such motion, s.
    #[error("no motion changes its jerk on the ticks of a clock with a period of {0} s only")]
    Period(f64),
    /// The search did not get to a motion that meets all conditions.
    #[error("the search ended with a violation of {violation:e} of the motion")]
    NotConverged {
        /// What is left, as a part of the motion.
        violation: f64,
    },
    /// Limits or a distance within which nothing can be planned.
    #[error(transparent)]
    Plan(#[from] PlanError),
}
