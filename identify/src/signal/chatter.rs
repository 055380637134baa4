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
