//! Why there is nothing to recommend, with the number that is in the way.

use profiles::PlanError;
use shaping::TrainError;
use thiserror::Error;

/// Why there is nothing to recommend.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum RecommendError {
    /// A number out of range.
    #[error("{quantity} must be {range}, got {value}")]
    Number {
        /// Which number.
        quantity: &'static str,
        /// The range it must lie in.
        range: &'static str,
        /// The value given.
        value: f64,
    },
    /// A mode whose frequency may be next to nothing.
    #[error(
        "the mode at {angular_frequency} rad/s is known to {margin} rad/s only: nothing can be planned for all of that"
    )]
    Vague {
        /// Undamped angular frequency, rad/s.
        angular_frequency: f64,
        /// Half the width of the band to reckon with, rad/s.
        margin: f64,
    },
    /// No mode to shape a command for.
    #[error("a shaper needs a mode to be made for")]
    NoModes,
    /// No shaper exists for a mode.
    #[error("no shaper can be made for the mode at {angular_frequency} rad/s")]
    NoShaper {
        /// Undamped angular frequency, rad/s.
        angular_frequency: f64,
    },
    /// The limits allow no move.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// No train of impulses for the modes.
    #[error(transparent)]
    Train(#[from] TrainError),
}

/// A number that must be positive and finite.
pub(super) fn positive(quantity: &'static str, value: f64) -> Result<f64, RecommendError> {
    if value > 0.0 && value.is_finite() {
        Ok(value)
    } else {
        Err(RecommendError::Number { quantity, range: "positive and finite", value })
    }
}

/// A number that must be finite and not negative.
pub(super) fn not_negative(quantity: &'static str, value: f64) -> Result<f64, RecommendError> {
    if value >= 0.0 && value.is_finite() {
        Ok(value)
    } else {
        Err(RecommendError::Number { quantity, range: "finite and not negative", value })
    }
}
