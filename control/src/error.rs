//! What can be wrong with a configuration, with the number that is wrong.

use thiserror::Error;

/// A PID controller that cannot be.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum PidError {
    /// A gain that is infinite or NaN.
    #[error("the gain {which} must be finite, got {value}")]
    Gain {
        /// Which gain.
        which: &'static str,
        /// The gain given.
        value: f64,
    },
    /// A sampling period that is not positive and finite, s.
    #[error("the sampling period must be positive and finite, got {0} s")]
    Period(f64),
    /// A time constant of the derivative filter that is negative, infinite or NaN, s.
    #[error("the time constant of the derivative filter must be finite and not negative, got {0} s")]
    DerivativeFilter(f64),
    /// Output limits that leave no room between them.
    #[error("the lower output limit must lie below the upper one, got [{lower}, {upper}]")]
    OutputLimits {
        /// The lower limit given.
        lower: f64,
        /// The upper limit given.
        upper: f64,
    },
    /// A tracking time that is not positive and finite, s.
    #[error("the tracking time must be positive and finite, got {0} s")]
    TrackingTime(f64),
    /// Numbers so large or so small that a coefficient has no representation.
    #[error("the configuration leaves the range of its number type: {quantity} would be {value}")]
    Range {
        /// The coefficient.
        quantity: &'static str,
        /// What came out.
        value: f64,
    },
}

/// A feedforward that cannot be.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum FeedforwardError {
    /// A gain that is infinite or NaN.
    #[error("the {which} gain must be finite, got {value}")]
    Gain {
        /// Which gain.
        which: &'static str,
        /// The gain given.
        value: f64,
    },
    /// A physical parameter outside its range.
    #[error("the {which} must be finite and {range}, got {value}")]
    Parameter {
        /// Which parameter.
        which: &'static str,
        /// What it must be besides finite.
        range: &'static str,
        /// The value given.
        value: f64,
    },
}
