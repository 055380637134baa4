//! Figures of merit of a recorded response.

use super::{Signal, finite, length, not_negative};
use crate::error::SignalError;

impl Signal<'_> {
    /// Largest excursion beyond `target` in the direction of the move, as a part of the move; zero if there is none.
    ///
    /// # Errors
    /// Ends that are not finite or equal.
    pub fn overshoot(&self, from: f64, target: f64) -> Result<f64, SignalError> {
        let length = length(from, target)?;
        Ok(self.values().iter().map(|value| (value - target) / length).fold(0.0, f64::max))
    }

    /// The instant, s, from which the signal stays within `band` of `target`: the crossing after the last sample
    /// outside, on the straight line to the next; the first sample if all are inside.
    ///
    /// # Errors
    /// A signal whose last sample is outside; a target that is not finite, a band that is negative or not finite.
    pub fn settling_time(&self, target: f64, band: f64) -> Result<f64, SignalError> {
        let target = finite("the target", target)?;
        let band = not_negative("the band", band)?;
        let mut inside: Option<(f64, f64)> = None;
        for (time, value) in self.samples().rev() {
            let error = value - target;
            if error.abs() > band {
                let Some((next, later)) = inside else {
                    return Err(SignalError::NotSettled { error, band });
                };
                return Ok(crossing((time, error), (next, later), band.copysign(error)));
            }
            inside = Some((time, error));
        }
        Ok(self.time(0))
    }

    /// Time, s, from the first crossing of 10 % of the move to the first crossing of 90 %, both on the straight line
    /// between samples.
    ///
    /// # Errors
    /// Ends that are not finite or equal; a signal that does not reach 90 %.
    pub fn rise_time(&self, from: f64, target: f64) -> Result<f64, SignalError> {
        let length = length(from, target)?;
        Ok(self.first_reach(from, length, 0.9)? - self.first_reach(from, length, 0.1)?)
    }

    /// Largest less smallest value from `instant` in s on.
    ///
    /// # Errors
    /// No sample from the instant on; an instant that is not finite.
    pub fn ripple(&self, instant: f64) -> Result<f64, SignalError> {
        let (lower, upper) = self
            .from(instant)?
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(lower, upper), y| (y.min(lower), y.max(upper)));
        Ok(upper - lower)
    }

    /// Mean of the samples from `instant` in s on.
    ///
    /// # Errors
    /// No sample from the instant on; an instant that is not finite.
    pub fn steady_value(&self, instant: f64) -> Result<f64, SignalError> {
        // About the last value an offset costs no digits; halves cannot overflow.
        let last = self.values().last().copied().ok_or(SignalError::Empty)?;
        let count = self.from(instant)?.count() as f64;
        let half: f64 = self.from(instant)?.map(|y| (0.5 * y - 0.5 * last) / count).sum();
        Ok(2.0 * (0.5 * last + half))
    }

    /// The values from an instant on, at least one.
    fn from(&self, instant: f64) -> Result<impl Iterator<Item = f64> + '_, SignalError> {
        let instant = finite("the instant", instant)?;
        if self.end() < instant {
            return Err(SignalError::NothingAfter { instant, last: self.end() });
        }
        Ok(self.samples().filter(move |(time, _)| *time >= instant).map(|(_, value)| value))
    }

    /// First time at which a part of the move is reached, s.
    fn first_reach(&self, from: f64, length: f64, part: f64) -> Result<f64, SignalError> {
        let mut before: Option<(f64, f64)> = None;
        let mut extreme = f64::NEG_INFINITY;
        for (time, value) in self.samples() {
            let reached = (value - from) / length;
            extreme = extreme.max(reached);
            if reached >= part {
                return Ok(before.map_or(time, |before| crossing(before, (time, reached), part)));
            }
            before = Some((time, reached));
        }
        Err(SignalError::NotReached { level: from + part * length, extreme: from + extreme * length })
    }
}

/// The time at which the line from one sample to the next, on the other side, crosses a level.
fn crossing((t0, y0): (f64, f64), (t1, y1): (f64, f64), level: f64) -> f64 {
    t0 + (t1 - t0) * ((level - y0) / (y1 - y0)).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A lag of one second sampled every millisecond for ten.
    fn lag() -> Vec<f64> {
        (0..=10_000).map(|n| 1.0 - (-f64::from(n) * 1e-3).exp()).collect()
    }

    #[test]
    fn a_lag() {
        let values = lag();
        let signal = Signal::sampled(&values, 1e-3).expect("valid");
        // Straight lines over a period of h leave a time error of h^2 / 8 for a lag of one second.
        let tolerance = 1e-6 / 8.0;
        assert!((signal.rise_time(0.0, 1.0).expect("rises") - 9_f64.ln()).abs() < 2.0 * tolerance);
        assert!((signal.settling_time(1.0, 0.02).expect("settles") - 50_f64.ln()).abs() < tolerance);
        assert!(signal.overshoot(0.0, 1.0).expect("a move") <= 0.0);
        // What is left of the exponential after five seconds, less what is left at the end.
        assert!((signal.ripple(5.0).expect("samples") - ((-5_f64).exp() - (-10_f64).exp())).abs() < 1e-15);
    }

    #[test]
    fn a_response_downwards_is_a_response_upwards() {
        let up: Vec<f64> =
            (0..4000).map(|n| f64::from(n) * 1e-3).map(|t| 1.0 - (-t).exp() * (7.0 * t).cos()).collect();
        let down: Vec<f64> = up.iter().map(|y| 5.0 - 2.0 * y).collect();
        let (up, down) =
            (Signal::sampled(&up, 1e-3).expect("valid"), Signal::sampled(&down, 1e-3).expect("valid"));
        let same = |a: Result<f64, SignalError>, b: Result<f64, SignalError>| {
            assert!((a.expect("valid") - b.expect("valid")).abs() < 1e-12);
        };
        same(up.overshoot(0.0, 1.0), down.overshoot(5.0, 3.0));
        same(up.rise_time(0.0, 1.0), down.rise_time(5.0, 3.0));
        same(up.settling_time(1.0, 0.1), down.settling_time(3.0, 0.2));
        same(up.ripple(1.0).map(|r| 2.0 * r), down.ripple(1.0));
        same(up.steady_value(1.0).map(|y| 5.0 - 2.0 * y), down.steady_value(1.0));
    }

    #[test]
    fn settling_is_interpolated_and_never_guessed() {
        let signal = Signal::new(&[0.0, 1.0, 3.0, 4.0], &[0.0, 2.0, 1.0, 1.1]).expect("valid");
        // From 2 at 1 s to 1 at 3 s the line crosses 1.5 at 2 s.
        assert!((signal.settling_time(1.0, 0.5).expect("settles") - 2.0).abs() < 1e-15);
        assert!(signal.settling_time(1.0, 2.0).expect("inside") <= 0.0);
        assert!(matches!(signal.settling_time(1.0, 0.05), Err(SignalError::NotSettled { .. })));
        assert!(matches!(signal.settling_time(1.0, -0.1), Err(SignalError::Number { .. })));
        assert!(matches!(signal.rise_time(0.0, 3.0), Err(SignalError::NotReached { .. })));
        assert_eq!(signal.overshoot(1.0, 1.0), Err(SignalError::NoMove(1.0)));
        assert_eq!(signal.ripple(5.0), Err(SignalError::NothingAfter { instant: 5.0, last: 4.0 }));
        assert!((signal.steady_value(3.0).expect("samples") - 1.05).abs() < 1e-15);
    }
}
