//! Runge-Kutta steps with an account of the energy.

use nalgebra::SVector;

use super::stepper::check;
use super::{Rk4, Stepper};
use crate::energy::{Energetic, EnergyLedger, Powers};
use crate::error::StepError;

/// The steps of an [`Rk4`], to the last bit, and a ledger of the energy.
///
/// The powers are integrated as states would be, from the stages of the step, so that the imbalance of the ledger falls
/// with the fourth power of the step. It measures the error of the method; an imbalance that does not fall means a
/// wrong equation.
///
/// ```
/// use plants::{Rk4, Stepper, TwoInertia, nalgebra::{self, vector}};
///
/// let axis = TwoInertia::new(0.003, 5e-4, 100.0)?.with_damping(0.008, 0.006, 0.0)?;
/// let mut stepper = Rk4::accurate(axis, axis.resonance())?.metered();
/// let mut state = vector![0.0, 0.0, 0.0, 0.0];
/// for k in 0..100 {
///     state = stepper.advance(&state, &vector![if k < 50 { 1.0 } else { -1.0 }, 0.1], 1e-3)?;
/// }
/// assert!(stepper.ledger().delivered > 0.01); // J
/// assert!(stepper.ledger().relative_imbalance() < 1e-6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct MeteredRk4<P> {
    stepper: Rk4<P>,
    ledger: EnergyLedger,
}

impl<P> MeteredRk4<P> {
    /// The steps of `stepper`, the ledger empty.
    #[must_use]
    pub fn new(stepper: Rk4<P>) -> Self {
        Self { stepper, ledger: EnergyLedger::default() }
    }

    /// The stepper without its ledger.
    #[must_use]
    pub fn stepper(&self) -> &Rk4<P> {
        &self.stepper
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

impl<const N: usize, const M: usize, P: Energetic<N, M>> Stepper<N, M> for MeteredRk4<P> {
    fn advance(
        &mut self,
        state: &SVector<f64, N>,
        input: &SVector<f64, M>,
        interval: f64,
    ) -> Result<SVector<f64, N>, StepError> {
        check(interval)?;
        let plant = self.stepper.plant();
        let substeps = self.stepper.count(interval)?;
        let step = if substeps == 1 { interval } else { interval / f64::from(substeps) };
        let mut flow = EnergyLedger::default();
        let next = (0..substeps).fold(*state, |x, _| {
            let mut stages = [Powers::default(); 4];
            let mut stage = stages.iter_mut();
            let next = super::rk4::rk4_step(
                &mut |_, x: &SVector<f64, N>| {
                    // One call for each of the four stages.
                    if let Some(powers) = stage.next() {
                        *powers = plant.powers(x, input);
                    }
                    plant.derivative(x, input)
                },
                0.0,
                &x,
                step,
            );
            let simpson = |power: fn(&Powers) -> f64| {
                let [first, second, third, last] = stages.each_ref().map(power);
                (first + (second + third) * 2.0 + last) * (step / 6.0)
            };
            flow.input += simpson(|powers| powers.input);
            flow.dissipated += simpson(|powers| powers.dissipated);
            flow.delivered += simpson(|powers| powers.delivered);
            next
        });
        flow.stored = plant.stored(&next) - plant.stored(state);
        self.ledger.add(&flow);
        Ok(next)
    }
}
