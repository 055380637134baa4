//! Exact steps of linear plants.

use nalgebra::SVector;

use super::kept::Kept;
use super::stepper::check;
use super::{MeteredHold, Stepper};
use crate::energy::HeldEnergetic;
use crate::error::{ModelError, StepError};
use crate::linear::Transition;

/// A plant that is linear in its state and in what it realises of a held input.
pub trait HeldLinear<const N: usize, const M: usize> {
    /// The exact motion over `interval` in s under a held input.
    ///
    /// # Errors
    /// An interval that is negative or not finite, and what has no representation.
    fn transition(&self, interval: f64) -> Result<Transition<N, M>, ModelError>;

    /// What the plant makes of an input, for one with a limit of its own.
    #[inline]
    fn realised(&self, input: &SVector<f64, M>) -> SVector<f64, M> {
        *input
    }
}

/// Exact steps of a linear plant under a held input, whatever the interval.
///
/// The transitions of the last eight distinct intervals are kept, so that a step split by a computation delay or a
/// fast recording costs a matrix product and allocates nothing after the first of each length. What is kept never
/// changes a result.
///
/// ```
/// use plants::{LinearMotor, Stepper, ZeroOrderHold, nalgebra::{self, vector}};
///
/// let mut carriage = ZeroOrderHold::new(LinearMotor::new(2.0, 0.0)?);
/// let state = carriage.advance(&vector![0.0, 1.0], &vector![4.0], 0.5)?;
/// assert_eq!(state, vector![0.75, 2.0]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct ZeroOrderHold<const N: usize, const M: usize, L> {
    model: L,
    kept: Kept<Transition<N, M>>,
}

impl<const N: usize, const M: usize, L: HeldLinear<N, M>> ZeroOrderHold<N, M, L> {
    /// Exact steps of `model`.
    #[must_use]
    pub fn new(model: L) -> Self {
        Self { model, kept: Kept::new() }
    }

    /// The plant.
    #[must_use]
    pub fn model(&self) -> &L {
        &self.model
    }

    /// The same steps with an account of the energy.
    #[must_use]
    pub fn metered(self) -> MeteredHold<N, M, L>
    where
        L: HeldEnergetic<N, M>,
    {
        MeteredHold::new(self.model)
    }
}

impl<const N: usize, const M: usize, L: HeldLinear<N, M>> Stepper<N, M> for ZeroOrderHold<N, M, L> {
    #[inline(always)]
    fn advance(
        &mut self,
        state: &SVector<f64, N>,
        input: &SVector<f64, M>,
        interval: f64,
    ) -> Result<SVector<f64, N>, StepError> {
        check(interval)?;
        let realised = self.model.realised(input);
        let Self { model, kept } = self;
        Ok(kept.get(interval, || model.transition(interval))?.apply(state, &realised))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::models::{LinearMotor, StateSpace};
    use nalgebra::{matrix, vector};

    #[test]
    fn what_is_kept_never_changes_a_result() {
        let system = StateSpace::new(
            matrix![0.0, 1.0; -40.0, -0.3],
            matrix![0.0; 2.0],
            matrix![1.0, 0.0],
            matrix![0.0],
        )
        .expect("finite");
        let mut stepper = ZeroOrderHold::new(system);
        let (mut state, mut direct) = (vector![1.0, 0.0], vector![1.0, 0.0]);
        for k in 0..200_u32 {
            // Twelve lengths in turn, more than are kept, then three that are.
            let interval = 1e-3 * f64::from(1 + if k < 100 { k % 12 } else { k % 3 });
            let input = vector![f64::from(k % 5)];
            state = stepper.advance(&state, &input, interval).expect("finite");
            direct = system.transition(interval).expect("finite").apply(&direct, &input);
            assert_eq!(state, direct);
        }
    }

    #[test]
    fn a_motor_at_its_limit() {
        let motor = LinearMotor::new(2.0, 0.0).and_then(|m| m.with_force_limit(4.0)).expect("valid");
        let mut stepper = ZeroOrderHold::new(motor);
        let state = stepper.advance(&vector![0.0, 0.0], &vector![-100.0], 1.0).expect("finite");
        assert_eq!(state, vector![-1.0, -2.0]);
    }

    #[test]
    fn bad_intervals_are_errors() {
        let mut stepper = ZeroOrderHold::new(LinearMotor::new(2.0, 0.0).expect("valid"));
        for interval in [-1.0, f64::NAN, f64::INFINITY] {
            let result = stepper.advance(&vector![0.0, 0.0], &vector![0.0], interval);
            assert!(matches!(result, Err(StepError::Interval(_))));
        }
    }
}
