//! One tick of the observer.

use profiles::Real;

use super::config::DisturbanceObserver;
use crate::finite::all_finite;

/// The memory of one observer; every number in it is finite.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct DisturbanceObserverState<F = f64> {
    position: F,
    velocity: F,
    load: F,
    primed: bool,
}

impl<F: Real> DisturbanceObserverState<F> {
    /// No past: the first tick takes the axis for standing still, without load, where it is.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// An axis known to be at `position` with `velocity`, without load, one period before the first tick; what is not finite
    /// counts as no past.
    #[must_use]
    pub fn at(position: F, velocity: F) -> Self {
        if all_finite([position, velocity]) {
            Self { position, velocity, load: F::ZERO, primed: true }
        } else {
            Self::default()
        }
    }

    /// Forgets everything.
    pub fn reset(&mut self) {
        *self = Self::default();
    }

    /// The estimate of the last valid tick; zero before the first one.
    #[must_use]
    pub fn estimate(&self) -> DisturbanceEstimate<F> {
        DisturbanceEstimate {
            position: self.position,
            velocity: self.velocity,
            load: self.load,
            is_held: false,
        }
    }
}

/// What an observer is told at a tick.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct DisturbanceInput<F = f64> {
    /// Measured position, m or rad.
    pub position: F,
    /// The input that acted on the axis over the past period, after every limit.
    pub realised: F,
}

/// What an observer answers at a tick, always finite.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DisturbanceEstimate<F = f64> {
    /// Position, m or rad.
    pub position: F,
    /// Velocity, m/s or rad/s.
    pub velocity: F,
    /// Load `d`, m/s^2 or rad/s^2; over the gain of the axis it is in the unit of the input.
    pub load: F,
    /// Whether an input was not finite, or the arithmetic overflowed: then this is the last valid estimate.
    pub is_held: bool,
}

impl<F: Real> DisturbanceObserver<F> {
    /// One tick: the model goes on by a period with the input given, then takes up what the position differs.
    ///
    /// An input that is not finite, or finite ones that overflow, leaves `state` untouched to the bit and returns the last
    /// valid estimate; the next valid tick takes the whole gap for one period.
    #[inline]
    #[must_use]
    pub fn update(
        &self,
        state: &mut DisturbanceObserverState<F>,
        input: DisturbanceInput<F>,
    ) -> DisturbanceEstimate<F> {
        let DisturbanceInput { position: measured, realised } = input;
        let before = *state;
        let acceleration = self.model.gain() * realised + before.load;
        let predicted =
            self.persistence * before.position + self.value * before.velocity + self.integral * acceleration;
        let coasted =
            self.restoring * before.position + self.rate * before.velocity + self.value * acceleration;
        let beyond = measured - predicted;
        let next = if before.primed {
            [
                predicted + self.position_gain * beyond,
                coasted + self.velocity_gain * beyond,
                before.load + self.load_gain * beyond,
            ]
        } else {
            [measured, F::ZERO, F::ZERO]
        };
        if !all_finite(next) | !all_finite([measured, realised]) {
            return DisturbanceEstimate { is_held: true, ..state.estimate() };
        }
        let [position, velocity, load] = next;
        *state = DisturbanceObserverState { position, velocity, load, primed: true };
        state.estimate()
    }
}
