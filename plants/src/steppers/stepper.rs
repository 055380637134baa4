//! Moving a plant over an interval.

use nalgebra::SVector;

use crate::error::StepError;

/// Moves the state of a plant over an interval under a held input.
pub trait Stepper<const N: usize, const M: usize> {
    /// The state `interval` in s later, with `input` held.
    ///
    /// # Errors
    /// An interval that is negative or not finite, and what the method says.
    fn advance(
        &mut self,
        state: &SVector<f64, N>,
        input: &SVector<f64, M>,
        interval: f64,
    ) -> Result<SVector<f64, N>, StepError>;
}

#[inline]
pub(crate) fn check(interval: f64) -> Result<(), StepError> {
    if interval >= 0.0 && interval.is_finite() { Ok(()) } else { Err(StepError::Interval(interval)) }
}
