//! Exact steps with an account of the energy.

use nalgebra::SVector;

use super::Stepper;
use super::kept::Kept;
use super::stepper::check;
use crate::energy::{EnergyLedger, HeldEnergetic};
use crate::error::StepError;
use crate::linear::{QuadraticIntegral, Transition};

/// The steps of a [`ZeroOrderHold`](crate::ZeroOrderHold), and a ledger of the energy that closes to rounding.
///
/// Every entry comes by a way of its own: the input as a held force times the way it went, the stored energy from the
/// states, the heat from a quadratic form in the state at the start of the step. A wrong equation shows.
///
/// ```
/// use plants::{LinearMotor, Stepper, ZeroOrderHold, nalgebra::{self, vector}};
///
/// let mut motor = ZeroOrderHold::new(LinearMotor::new(2.0, 5.0)?).metered();
/// let mut state = vector![0.0, 0.0];
/// for k in 0..100 {
///     state = motor.advance(&state, &vector![if k < 50 { 40.0 } else { -30.0 }], 1e-3)?;
/// }
/// assert!(motor.ledger().dissipated > 0.1); // J
/// assert!(motor.ledger().relative_imbalance() < 1e-13);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct MeteredHold<const N: usize, const M: usize, L> {
    model: L,
    kept: Kept<(Transition<N, M>, QuadraticIntegral<N, M>)>,
    ledger: EnergyLedger,
}

impl<const N: usize, const M: usize, L: HeldEnergetic<N, M>> MeteredHold<N, M, L> {
    /// Exact steps of `model`, its ledger empty.
    #[must_use]
    pub fn new(model: L) -> Self {
        Self { model, kept: Kept::new(), ledger: EnergyLedger::default() }
    }

    /// The plant.
    #[must_use]
    pub fn model(&self) -> &L {
        &self.model
    }

    /// The account of all steps so far.
    #[must_use]
    pub fn ledger(&self) -> &EnergyLedger {
        &self.ledger
    }

    /// The account so far; it begins anew.
    pub fn take_ledger(&mut self) -> EnergyLedger {
        std::mem::take(&mut self.ledger)
    }
}

impl<const N: usize, const M: usize, L: HeldEnergetic<N, M>> Stepper<N, M> for MeteredHold<N, M, L> {
    fn advance(
        &mut self,
        state: &SVector<f64, N>,
        input: &SVector<f64, M>,
        interval: f64,
    ) -> Result<SVector<f64, N>, StepError> {
        check(interval)?;
        let Self { model, kept, ledger } = self;
        let realised = model.realised(input);
        let (transition, heat) =
            kept.get(interval, || Ok((model.transition(interval)?, model.heat(interval)?)))?;
        let next = transition.apply(state, &realised);
        let work = model.work(&realised, &(next - state));
        ledger.add(&EnergyLedger {
            input: work.input,
            stored: model.stored(&next) - model.stored(state),
            dissipated: heat.value(state, &realised),
            delivered: work.delivered,
        });
        Ok(next)
    }
}
