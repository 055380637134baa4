//! How restless a control signal is.

use profiles::Interval;

use super::Signal;
use crate::error::SignalError;

/// Figures of a control signal `u`, over a window or the whole record, of the length `T`:
///
/// ```text
/// total variation rate = sum |u_(k+1) - u_k| / T      reversal rate = sign changes of u_(k+1) - u_k / T
/// ```
///
/// The ends of a window that lie between samples are taken on the straight line. A smooth signal has the mean of
/// `|u'|`, whatever its samples; one that switches by `d` at each of `f` samples per second has `d f`, so that signals
/// are compared at equal sample rates.
impl Signal<'_> {
    /// Total variation per second, the signal's unit per s: the way that the actuator is sent up and down.
    ///
    /// ```
    /// use identify::Signal;
    ///
    /// // Switching between -3 and 3 V at 1 kHz, and 3 V sin(10 t).
    /// let switching: Vec<f64> = (0..=1000).map(|n| if n % 2 == 0 { 3.0 } else { -3.0 }).collect();
    /// assert!((Signal::sampled(&switching, 1e-3)?.total_variation_rate(None)? - 6000.0).abs() < 1e-9);
    /// let smooth: Vec<f64> = (0..=6283).map(|n| 3.0 * (1e-2 * n as f64).sin()).collect();
    /// // Four amplitudes in a period.
    /// let rate = Signal::sampled(&smooth, 1e-3)?.total_variation_rate(None)?;
    /// assert!((rate - 4.0 * 3.0 * 10.0 / std::f64::consts::TAU).abs() < 0.01);
    /// # Ok::<(), identify::SignalError>(())
    /// ```
    ///
    /// # Errors
    /// A window that is not finite, has no length or is not inside the record; a record of one sample; a rate out of
    /// range.
    pub fn total_variation_rate(&self, window: Option<Interval>) -> Result<f64, SignalError> {
        let length = self.window_length(window)?;
        let sum: f64 = self.increments(window).map(f64::abs).sum();
        let rate = sum / length;
        if rate.is_finite() {
            Ok(rate)
        } else {
            Err(SignalError::Number { quantity: "the total variation rate", range: "finite", value: rate })
        }
    }

    /// Reversals per second, 1/s: how often the signal turns from rising to falling or back. Where it rests it turns
    /// only if it goes on the other way.
    ///
    /// # Errors
    /// As for the total variation; a rate is never out of range.
    pub fn reversal_rate(&self, window: Option<Interval>) -> Result<f64, SignalError> {
        let length = self.window_length(window)?;
        let (mut reversals, mut rising) = (0.0, None);
        for increment in self.increments(window).filter(|increment| increment.abs() > 0.0) {
            let now = increment > 0.0;
            if rising.is_some_and(|before| before != now) {
                reversals += 1.0;
            }
            rising = Some(now);
        }
        Ok(reversals / length)
    }

    fn window_length(&self, window: Option<Interval>) -> Result<f64, SignalError> {
        let Interval { lower, upper } = self.window(window)?;
        let length = upper - lower;
        if length > 0.0 {
            Ok(length)
        } else {
            let quantity = "the length of the window in s";
            Err(SignalError::Number { quantity, range: "positive", value: length })
        }
    }

    /// The increments from sample to sample within a window, of those that its ends cut the part inside.
    fn increments(&self, window: Option<Interval>) -> impl Iterator<Item = f64> + '_ {
        let Interval { lower, upper } =
            window.unwrap_or(Interval { lower: f64::NEG_INFINITY, upper: f64::INFINITY });
        self.samples().zip(self.samples().skip(1)).map(move |((t0, y0), (t1, y1))| {
            let (from, to) = (lower.max(t0), upper.min(t1));
            if from < to { (y1 - y0) * ((to - from) / (t1 - t0)) } else { 0.0 }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn window(lower: f64, upper: f64) -> Option<Interval> {
        Some(Interval { lower, upper })
    }

    #[test]
    fn a_sine_and_a_switch() {
        // 2 sin(w t) over 5 whole periods: 4 amplitudes and 2 turns in each.
        let w = std::f64::consts::TAU;
        let values: Vec<f64> = (0..=5000).map(|n| 2.0 * (w * f64::from(n) * 1e-3).sin()).collect();
        let sine = Signal::sampled(&values, 1e-3).expect("valid");
        // A turn between two samples loses amplitude (w h)^2 / 8 at most, twice.
        let rate = sine.total_variation_rate(None).expect("finite");
        assert!((rate - 8.0).abs() < 8.0 * 5e-6, "{rate}");
        assert!((sine.reversal_rate(None).expect("finite") - 2.0).abs() < 1e-12);
        // A switch of d at every other sample on top of a ramp of r: (d - r h) and (d + r h) in turn.
        let (d, r, h) = (0.5, 20.0, 1e-3);
        let values: Vec<f64> =
            (0..=1000).map(|n| r * h * f64::from(n) + if n % 2 == 0 { 0.0 } else { d }).collect();
        let switch = Signal::sampled(&values, h).expect("valid");
        let rate = switch.total_variation_rate(None).expect("finite");
        assert!((rate - d / h).abs() < 1e-9 * d / h, "{rate}");
        // 999 turns between 1000 increments.
        assert!((switch.reversal_rate(None).expect("finite") - 999.0).abs() < 1e-9);
        // Slower than the ramp it turns nowhere, and only the ramp is left.
        let values: Vec<f64> = values.iter().enumerate().map(|(n, y)| y + 600.0 * h * n as f64).collect();
        let ramp = Signal::sampled(&values, h).expect("valid");
        assert!((ramp.total_variation_rate(None).expect("finite") - (r + 600.0)).abs() < 1e-9 * 620.0);
        assert!(ramp.reversal_rate(None).expect("finite").abs() <= 0.0);
    }

    #[test]
    fn rests_are_no_turns() {
        let rate = |values: &[f64]| {
            let signal = Signal::sampled(values, 1.0).expect("valid");
            (
                signal.total_variation_rate(None),
                signal.reversal_rate(None).map(|r| r * (values.len() - 1) as f64),
            )
        };
        assert_eq!(rate(&[3.0, 3.0, 3.0]), (Ok(0.0), Ok(0.0)));
        assert_eq!(rate(&[0.0, 1.0, 1.0, 2.0, 2.0]), (Ok(0.5), Ok(0.0)));
        assert_eq!(rate(&[0.0, 1.0, 1.0, 0.0, 0.0]), (Ok(0.5), Ok(1.0)));
    }

    #[test]
    fn windows_cut_between_samples() {
        let signal = Signal::new(&[0.0, 1.0, 3.0, 4.0], &[0.0, 2.0, -2.0, -2.0]).expect("valid");
        let variation = |lower, upper| signal.total_variation_rate(window(lower, upper));
        // Half of the first line, a quarter of the second, over one second.
        assert_eq!(variation(0.5, 1.5), Ok(2.0));
        assert_eq!(signal.reversal_rate(window(0.5, 1.5)), Ok(1.0));
        assert_eq!((variation(1.5, 2.5), signal.reversal_rate(window(1.5, 2.5))), (Ok(2.0), Ok(0.0)));
        assert_eq!(variation(3.25, 3.75), Ok(0.0));
        // Whole and parts: 2 + 4 over four seconds.
        assert_eq!(variation(0.0, 4.0), signal.total_variation_rate(None));
        assert_eq!(variation(0.0, 4.0), Ok(1.5));
    }

    #[test]
    fn what_has_no_rate_is_an_error() {
        let signal = Signal::sampled(&[0.0, 1.0, 0.0], 1.0).expect("valid");
        for (lower, upper) in [(-0.1, 1.0), (1.0, 2.1), (2.0, 1.0), (f64::NAN, 1.0)] {
            assert!(matches!(
                signal.total_variation_rate(window(lower, upper)),
                Err(SignalError::Window { .. })
            ));
            assert!(matches!(signal.reversal_rate(window(lower, upper)), Err(SignalError::Window { .. })));
        }
        let no_length = |result| {
            assert_eq!(
                result,
                Err(SignalError::Number {
                    quantity: "the length of the window in s",
                    range: "positive",
                    value: 0.0
                })
            );
        };
        no_length(signal.total_variation_rate(window(1.0, 1.0)));
        let one = Signal::sampled(&[5.0], 1.0).expect("valid");
        no_length(one.total_variation_rate(None));
        no_length(one.reversal_rate(None));
        let huge = Signal::sampled(&[1e308, -1e308, 1e308], 1.0).expect("valid");
        assert!(matches!(huge.total_variation_rate(None), Err(SignalError::Number { .. })));
        assert_eq!(huge.reversal_rate(None), Ok(0.5));
    }
}
