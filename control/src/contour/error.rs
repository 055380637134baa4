//! What can be wrong with a coupling and with what it is given.

use thiserror::Error;

/// A coupling that cannot be.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum CouplingError {
    /// A gain that is negative, infinite or NaN.
    #[error("the coupling gain of axis {axis} must be finite and not negative, got {value}")]
    Gain {
        /// Index of the axis, from zero.
        axis: usize,
        /// The gain given.
        value: f64,
    },
}

/// Why there is no contour error.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum ContourFault {
    /// An input that is infinite or NaN.
    #[error("the {quantity} of axis {axis} must be finite, got {value}")]
    NotFinite {
        /// Which input.
        quantity: &'static str,
        /// Index of the axis, from zero.
        axis: usize,
        /// The value given.
        value: f64,
    },
    /// Finite inputs so large or so small that the answer has no representation.
    #[error("the {quantity} leaves the range of its number type: it would be {value}")]
    Range {
        /// Which answer.
        quantity: &'static str,
        /// What came out.
        value: f64,
    },
}
