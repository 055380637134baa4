//! A lag of first order.

use nalgebra::{SVector, matrix, vector};

use super::check::{not_negative, positive};
use super::decay::decay_functions;
use super::{Plant, StateSpace};
use crate::error::ModelError;
use crate::linear::Transition;
use crate::steppers::HeldLinear;

/// A low-pass filter of first order with unit gain: `tau y' + y = u`, `G(s) = 1 / (tau s + 1)`.
///
/// The state is the output. It is within 0.7 % of a step after `5 tau`.
///
/// ```
/// use plants::{HeldLinear, LowPass, nalgebra::{self, vector}};
///
/// let filter = LowPass::new(0.0044)?;
/// let step = filter.transition(1e-4)?;
/// let output = (0..220).fold(vector![0.0], |output, _| step.apply(&output, &vector![1.0]));
/// assert!((output[0] - (1.0 - (-5.0_f64).exp())).abs() < 1e-14);
/// # Ok::<(), plants::ModelError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedLowPass"))]
pub struct LowPass {
    time_constant: f64,
}

#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
struct UncheckedLowPass {
    time_constant: f64,
}

#[cfg(feature = "serde")]
impl TryFrom<UncheckedLowPass> for LowPass {
    type Error = ModelError;
    fn try_from(filter: UncheckedLowPass) -> Result<Self, ModelError> {
        Self::new(filter.time_constant)
    }
}

impl LowPass {
    /// A filter from its time constant in s.
    ///
    /// # Errors
    /// A time constant that is not positive and finite.
    pub fn new(time_constant: f64) -> Result<Self, ModelError> {
        positive("the time constant in s", time_constant)?;
        Ok(Self { time_constant })
    }

    /// The time constant `tau`, s.
    #[must_use]
    pub fn time_constant(&self) -> f64 {
        self.time_constant
    }

    /// From input to output.
    ///
    /// # Errors
    /// None that a filter made by [`new`](Self::new) can give.
    pub fn state_space(&self) -> Result<StateSpace<1, 1, 1>, ModelError> {
        let rate = 1.0 / self.time_constant;
        StateSpace::new(matrix![-rate], matrix![rate], matrix![1.0], matrix![0.0])
    }
}

impl Plant<1, 1> for LowPass {
    #[inline]
    fn derivative(&self, state: &SVector<f64, 1>, input: &SVector<f64, 1>) -> SVector<f64, 1> {
        vector![(input[0] - state[0]) / self.time_constant]
    }
}

/// In closed form: `y+ = e^(-T / tau) y + (1 - e^(-T / tau)) u`.
impl HeldLinear<1, 1> for LowPass {
    fn transition(&self, interval: f64) -> Result<Transition<1, 1>, ModelError> {
        not_negative("the interval in s", interval)?;
        let z = interval / self.time_constant;
        if !z.is_finite() {
            return Ok(Transition { state: matrix![0.0], input: matrix![1.0] });
        }
        let (decay, p1, _) = decay_functions(z);
        Ok(Transition { state: matrix![decay], input: matrix![z * p1] })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_closed_form_is_the_matrix_exponential() {
        for (tau, interval) in [(0.0044, 1e-4), (0.0044, 0.022), (1e3, 1e-9), (2.0, 0.0), (0.5, 30.0)] {
            let filter = LowPass::new(tau).expect("positive");
            let exact = filter.transition(interval).expect("finite");
            let general = filter.state_space().and_then(|s| s.transition(interval)).expect("finite");
            // The exponential squares its way to the decay: rounding grows with T / tau.
            assert!((exact.state - general.state).norm() <= 1e-14 * general.state.norm().max(1e-20));
            assert!((exact.input - general.input).norm() <= 1e-14 * general.input.norm());
        }
    }

    #[test]
    fn a_constant_passes() {
        for interval in [1e-9, 0.3, 1e5, f64::MAX] {
            let step = LowPass::new(0.01).expect("positive").transition(interval).expect("finite");
            // Two roundings of numbers up to one.
            assert!((step.apply(&vector![3.0], &vector![3.0])[0] - 3.0).abs() <= 3.0 * f64::EPSILON);
        }
    }

    #[test]
    fn the_derivative_by_hand() {
        let filter = LowPass::new(0.5).expect("positive");
        assert_eq!(filter.derivative(&vector![1.0], &vector![4.0]), vector![6.0]);
    }

    #[test]
    fn bad_numbers_are_named() {
        for value in [0.0, -0.1, f64::INFINITY] {
            assert_eq!(
                LowPass::new(value),
                Err(ModelError::Parameter {
                    parameter: "the time constant in s",
                    range: "positive and finite",
                    value
                })
            );
        }
        assert!(LowPass::new(f64::NAN).is_err());
        assert!(LowPass::new(1.0).and_then(|f| f.transition(-1.0)).is_err());
    }
}
