//! What a simulation does when.

use nalgebra::SVector;
use profiles::Real;

use super::{Clock, Saturation};
use crate::error::SimulationError;
use crate::signals::Disturbance;

/// The longest computation delay, control periods.
const LONGEST_DELAY: f64 = 1024.0;

/// The schedule of a continuous plant under a sampled controller, its actuator and its disturbances.
///
/// Time is a whole number of ticks of the clock. At a tick, in this order, an input whose computation delay ends
/// takes effect, the controller runs, and the signals are recorded: a recorded input is the one that acts from that
/// instant on. The controller runs at ticks 0, `n`, `2 n` ... before the end, and its output, held until the next,
/// takes effect the computation delay later. Between events the plant moves under a held input, by exactly one
/// step of its stepper.
#[derive(Debug, Clone, PartialEq)]
pub struct Simulation<const M: usize> {
    pub(super) clock: Clock,
    pub(super) ticks: u64,
    pub(super) control_every: u32,
    pub(super) record_every: u32,
    pub(super) delay: f64,
    pub(super) saturation: Saturation<M>,
    pub(super) initial_input: SVector<f64, M>,
    pub(super) disturbances: [Disturbance; M],
    pub(super) bound: f64,
}

impl<const M: usize> Simulation<M> {
    /// A simulation over a number of ticks: the controller runs and the signals are recorded at every tick, its
    /// output takes effect at once and without limits, nothing disturbs it, and a state beyond 1e9 is divergence.
    #[must_use]
    pub fn new(clock: Clock, ticks: u64) -> Self {
        Self {
            clock,
            ticks,
            control_every: 1,
            record_every: 1,
            delay: 0.0,
            saturation: Saturation::none(),
            initial_input: SVector::zeros(),
            disturbances: [Disturbance::none(); M],
            bound: 1e9,
        }
    }

    /// Runs the controller every so many ticks.
    ///
    /// # Errors
    /// Zero ticks.
    pub fn control_every(mut self, ticks: u32) -> Result<Self, SimulationError> {
        self.control_every = at_least_one("the control period", ticks)?;
        Ok(self)
    }

    /// Records every so many ticks, and once more at the end where that is not one of them.
    ///
    /// # Errors
    /// Zero ticks.
    pub fn record_every(mut self, ticks: u32) -> Result<Self, SimulationError> {
        self.record_every = at_least_one("the recording period", ticks)?;
        Ok(self)
    }

    /// Lets the output of the controller take effect `periods` control periods after it sampled: any fraction, up
    /// to 1024. A delay within 1e-9 of a whole number of ticks is taken as that.
    ///
    /// # Errors
    /// A delay outside `[0, 1024]`.
    pub fn delay(mut self, periods: f64) -> Result<Self, SimulationError> {
        if !(0.0..=LONGEST_DELAY).contains(&periods) {
            return Err(SimulationError::Delay { periods, longest: LONGEST_DELAY });
        }
        self.delay = periods;
        Ok(self)
    }

    /// Limits what the actuator realises.
    #[must_use]
    pub fn saturation(mut self, saturation: Saturation<M>) -> Self {
        self.saturation = saturation;
        self
    }

    /// The input before the first output of the controller takes effect; zero unless told.
    ///
    /// # Errors
    /// An input that is not finite.
    pub fn initial_input(mut self, input: SVector<f64, M>) -> Result<Self, SimulationError> {
        if let Some(&value) = input.iter().find(|x| !x.is_finite()) {
            return Err(SimulationError::Number { quantity: "an initial input", range: "finite", value });
        }
        self.initial_input = input;
        Ok(self)
    }

    /// Adds a disturbance to every input, after its saturation.
    #[must_use]
    pub fn disturbances(mut self, disturbances: [Disturbance; M]) -> Self {
        self.disturbances = disturbances;
        self
    }

    /// Takes a state of a magnitude beyond `bound` for divergence; infinity only stops where a number is lost.
    ///
    /// # Errors
    /// A bound that is not positive.
    pub fn divergence_bound(mut self, bound: f64) -> Result<Self, SimulationError> {
        if bound.is_nan() || bound <= 0.0 {
            return Err(SimulationError::Number {
                quantity: "a divergence bound",
                range: "positive",
                value: bound,
            });
        }
        self.bound = bound;
        Ok(self)
    }

    /// A task of the controller that runs every so many ticks, a multiple of the control period.
    ///
    /// # Errors
    /// Ticks that are zero or no multiple of the control period set before.
    pub fn task(&self, every: u32) -> Result<Task, SimulationError> {
        if every == 0 || !every.is_multiple_of(self.control_every) {
            return Err(SimulationError::Task { every, control_every: self.control_every });
        }
        Ok(Task { every: u64::from(every) })
    }

    /// The clock.
    #[must_use]
    pub fn clock(&self) -> Clock {
        self.clock
    }

    /// The control period, s.
    #[must_use]
    pub fn control_period(&self) -> f64 {
        self.clock.time(u64::from(self.control_every))
    }

    /// The recording period, s.
    #[must_use]
    pub fn record_period(&self) -> f64 {
        self.clock.time(u64::from(self.record_every))
    }

    /// The delay in ticks, whole and fractional.
    pub(super) fn delay_ticks(&self) -> (u64, f64) {
        const NEAR: f64 = 1e-9;
        let ticks = self.delay * f64::from(self.control_every);
        let nearest = Real::round(ticks);
        if (ticks - nearest).abs() <= NEAR {
            return (nearest as u64, 0.0);
        }
        let whole = Real::floor(ticks);
        (whole as u64, ticks - whole)
    }
}

/// One of several rates of a controller: see [`ControlTick::runs`](super::ControlTick::runs).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Task {
    every: u64,
}

impl Task {
    pub(super) fn runs_at(self, tick: u64) -> bool {
        tick.is_multiple_of(self.every)
    }
}

fn at_least_one(what: &'static str, ticks: u32) -> Result<u32, SimulationError> {
    if ticks == 0 { Err(SimulationError::Every(what)) } else { Ok(ticks) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::vector;

    fn simulation() -> Simulation<1> {
        Simulation::new(Clock::from_frequency(1000).expect("valid"), 10)
    }

    #[test]
    fn delays_split_into_ticks() {
        let ticks = |every, periods| {
            simulation().control_every(every).and_then(|s| s.delay(periods)).expect("valid").delay_ticks()
        };
        assert_eq!(ticks(40, 0.5), (20, 0.0));
        // 0.29 * 100 is not 29 in floating point.
        assert_eq!(ticks(100, 0.29), (29, 0.0));
        assert_eq!(ticks(1, 2.25), (2, 0.25));
        assert_eq!(ticks(3, 0.0), (0, 0.0));
    }

    #[test]
    fn bad_numbers_are_errors() {
        assert!(simulation().control_every(0).is_err());
        assert!(simulation().record_every(0).is_err());
        for delay in [-0.1, 1025.0, f64::NAN] {
            assert!(matches!(simulation().delay(delay), Err(SimulationError::Delay { .. })));
        }
        assert!(simulation().initial_input(vector![f64::NAN]).is_err());
        assert!(simulation().divergence_bound(f64::NAN).is_err());
        let four = simulation().control_every(4).expect("valid");
        assert!(four.task(8).is_ok());
        assert_eq!(four.task(6), Err(SimulationError::Task { every: 6, control_every: 4 }));
    }
}
