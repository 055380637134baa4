//! A velocity from positions, counts of an encoder for one.

use profiles::Real;

use crate::error::DifferentiatorError;

/// The rate of a sampled signal: its difference quotient, smoothed by a lag of first order,
///
/// `v_k = (tau v_(k-1) + y_k - y_(k-1)) / (tau + h)`, `v = 0` at the first tick,
///
/// the backward Euler form of `s / (tau s + 1)` for a period `h` and a time constant `tau`. Of a position in counts of `c`
/// it shows steps of `c / (tau + h)`.
///
/// ```
/// use control::{Differentiator, DifferentiatorState};
///
/// let velocity = Differentiator::new(1e-3, 4e-3)?; // s
/// let mut axis = DifferentiatorState::new();
/// for tick in 0..100 {
///     velocity.update(&mut axis, 0.25 * f64::from(tick) * 1e-3);
/// }
/// assert!((axis.rate() - 0.25).abs() < 1e-9);
/// // A reading that is lost changes nothing.
/// assert_eq!(velocity.update(&mut axis, f64::NAN), axis.rate());
/// # Ok::<(), control::DifferentiatorError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Differentiator<F = f64> {
    /// `tau / (tau + h)` and `1 / (tau + h)`.
    memory: F,
    gain: F,
}

/// The memory of one differentiator; every number in it is finite.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct DifferentiatorState<F = f64> {
    before: Option<F>,
    rate: F,
}

impl<F: Real> DifferentiatorState<F> {
    /// No past.
    #[must_use]
    pub fn new() -> Self {
        Self { before: None, rate: F::ZERO }
    }

    /// The rate at the last valid tick, the unit of the signal per s.
    #[must_use]
    pub fn rate(&self) -> F {
        self.rate
    }
}

impl<F: Real> Differentiator<F> {
    /// From the sampling period and the time constant, which may be zero, s.
    ///
    /// # Errors
    /// A period that is not positive and finite, a time constant that is negative or not finite, or a sum of both whose
    /// inverse has no representation.
    pub fn new(period: F, time_constant: F) -> Result<Self, DifferentiatorError> {
        if !(period > F::ZERO && period.is_finite()) {
            return Err(DifferentiatorError::Period(period.to_f64()));
        }
        if !(time_constant >= F::ZERO && time_constant.is_finite()) {
            return Err(DifferentiatorError::TimeConstant(time_constant.to_f64()));
        }
        let sum = time_constant + period;
        let gain = F::ONE / sum;
        if !(gain > F::ZERO && gain.is_finite()) {
            return Err(DifferentiatorError::Period(sum.to_f64()));
        }
        Ok(Self { memory: time_constant / sum, gain })
    }

    /// One tick: the rate now. A signal that is not finite, or a difference that overflows, leaves `state` untouched and
    /// returns the last valid rate; the next valid tick takes the whole gap for one period.
    #[inline]
    pub fn update(&self, state: &mut DifferentiatorState<F>, signal: F) -> F {
        let rate = self.memory * state.rate + self.gain * (signal - state.before.unwrap_or(signal));
        if signal.is_finite() && rate.is_finite() {
            *state = DifferentiatorState { before: Some(signal), rate };
        }
        state.rate
    }
}

#[cfg(test)]
#[expect(clippy::float_cmp, reason = "numbers that are exact in binary")]
mod tests {
    use super::*;

    #[test]
    fn a_sequence_by_hand() {
        // tau = h = 0.5: v = 0.5 v_old + (y - y_old).
        let differentiator = Differentiator::new(0.5, 0.5).expect("valid");
        let mut state = DifferentiatorState::new();
        for (signal, rate) in [(3.0, 0.0), (4.0, 1.0), (4.0, 0.5), (2.0, -1.75)] {
            assert_eq!(differentiator.update(&mut state, signal), rate);
        }
    }

    #[test]
    fn without_a_lag_it_is_the_quotient() {
        let differentiator = Differentiator::new(0.25_f32, 0.0).expect("valid");
        let mut state = DifferentiatorState::new();
        let _ = differentiator.update(&mut state, 1.0);
        assert_eq!(differentiator.update(&mut state, 1.5), 2.0);
    }

    #[test]
    fn what_is_lost_changes_nothing() {
        let differentiator = Differentiator::new(1e-3, 0.0).expect("valid");
        let mut state = DifferentiatorState::new();
        let _ = differentiator.update(&mut state, 1.0);
        let before = state;
        for signal in [f64::NAN, f64::INFINITY, -1.7e308] {
            assert_eq!(differentiator.update(&mut state, signal), 0.0);
            assert_eq!(state, before);
        }
    }

    #[test]
    fn bad_numbers_are_errors() {
        for period in [0.0, -1.0, f64::NAN, f64::INFINITY, f64::MIN_POSITIVE / 8.0] {
            assert!(
                matches!(Differentiator::new(period, 0.0), Err(DifferentiatorError::Period(_))),
                "{period}"
            );
        }
        for lag in [-1.0, f64::NAN, f64::INFINITY] {
            assert!(matches!(Differentiator::new(1.0, lag), Err(DifferentiatorError::TimeConstant(_))));
        }
    }
}
