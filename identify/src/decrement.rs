//! Frequency and damping from the decay of successive peaks.

use core::f64::consts::{PI, TAU};

use profiles::{Mode, ModeError, Real};

use crate::error::DecrementError;
use crate::peaks::Peak;

/// What two peaks of a free decay say of its mode.
///
/// Heights `p0` and `pk` over the target, `k` cycles apart, give `d = ln(p0 / pk) / (2 pi k)` and
///
/// ```text
/// damping ratio  z = d / sqrt(1 + d^2)       damped frequency  w_d = 2 pi k / (tk - t0)
/// ```
///
/// exactly, for a single mode. A peak and the trough after it are half a cycle apart. Published short forms take `d`
/// itself for the damping ratio: that is [`small_damping_ratio`](Self::small_damping_ratio), too high by `d^3 / 2` to
/// first order.
///
/// ```
/// use identify::{LogarithmicDecrement, Peaks, Signal};
///
/// let (sigma, omega) = (8.0_f64, 60.0_f64);
/// let values: Vec<f64> = (0..1000).map(|n| n as f64 * 1e-3).map(|t| (-sigma * t).exp() * (omega * t).cos()).collect();
/// let peaks = Peaks::find(&Signal::sampled(&values, 1e-3)?, 0.0)?;
/// let decrement = LogarithmicDecrement::over_cycles(&peaks.maxima, 0.0, 3)?;
/// assert!((decrement.damping_ratio() - sigma / omega.hypot(sigma)).abs() < 1e-5);
/// assert!((decrement.damped_angular_frequency() - omega).abs() < 0.01);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # References
/// D. J. Inman, "Engineering Vibration", 4th ed., Pearson, 2014, section 1.6.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct LogarithmicDecrement {
    decrement_per_radian: f64,
    damped_angular_frequency: f64,
}

impl LogarithmicDecrement {
    /// From the first of some maxima and the one `cycles` later, about `target`. The maxima of a signal that decays
    /// from below are as good when their values are negated.
    ///
    /// # Errors
    /// No cycles, too few peaks, peaks not above the target, not in the order of time, or not decaying.
    pub fn over_cycles(maxima: &[Peak], target: f64, cycles: usize) -> Result<Self, DecrementError> {
        if cycles == 0 {
            return Err(DecrementError::Cycles);
        }
        let (Some(first), Some(last)) = (maxima.first(), maxima.get(cycles)) else {
            return Err(DecrementError::TooFewPeaks {
                needed: cycles.saturating_add(1),
                found: maxima.len(),
            });
        };
        let height = |peak: &Peak| peak.value - target;
        Self::of(*first, height(first), *last, height(last), TAU * cycles as f64)
    }

    /// From a maximum and the minimum after it, half a cycle later, about `target`.
    ///
    /// The first peaks of a response to a command hold more than one mode and the command itself: this form is then
    /// off, and may even find that the peaks grow.
    ///
    /// # Errors
    /// A maximum not above or a minimum not below the target, not in the order of time, or not decaying.
    pub fn half_cycle(peak: Peak, trough: Peak, target: f64) -> Result<Self, DecrementError> {
        Self::of(peak, peak.value - target, trough, target - trough.value, PI)
    }

    fn of(first: Peak, start: f64, last: Peak, end: f64, angle: f64) -> Result<Self, DecrementError> {
        for (peak, height) in [(first, start), (last, end)] {
            if !(height > 0.0 && height.is_finite()) {
                return Err(DecrementError::Height { time: peak.time, height });
            }
        }
        let interval = last.time - first.time;
        let damped_angular_frequency = angle / interval;
        if !(interval > 0.0 && damped_angular_frequency > 0.0 && damped_angular_frequency.is_finite()) {
            return Err(DecrementError::Interval(interval));
        }
        // The difference of logarithms cannot overflow as the ratio can.
        let decrement_per_radian = (Real::ln(start) - Real::ln(end)) / angle;
        let result = Self { decrement_per_radian, damped_angular_frequency };
        if decrement_per_radian > 0.0 {
            Ok(result)
        } else {
            Err(DecrementError::Growing { ratio: start / end, damping_ratio: result.damping_ratio() })
        }
    }

    /// Damping ratio `z = d / sqrt(1 + d^2)`, exact for a single mode.
    #[must_use]
    pub fn damping_ratio(&self) -> f64 {
        self.decrement_per_radian / self.stretch()
    }

    /// `d` itself: the damping ratio where it is small.
    #[must_use]
    pub fn small_damping_ratio(&self) -> f64 {
        self.decrement_per_radian
    }

    /// Damped angular frequency `w_d`, rad/s.
    #[must_use]
    pub fn damped_angular_frequency(&self) -> f64 {
        self.damped_angular_frequency
    }

    /// Undamped angular frequency `w_d / sqrt(1 - z^2) = w_d sqrt(1 + d^2)`, rad/s.
    #[must_use]
    pub fn angular_frequency(&self) -> f64 {
        self.damped_angular_frequency * self.stretch()
    }

    /// The mode, by the exact form.
    ///
    /// # Errors
    /// A damping ratio that rounds to one.
    pub fn mode(&self) -> Result<Mode, ModeError> {
        Mode::new(self.angular_frequency(), self.damping_ratio())
    }

    fn stretch(&self) -> f64 {
        Real::sqrt(1.0 + self.decrement_per_radian * self.decrement_per_radian)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The exact extremes of `target + e^(-z w t) cos(w_d t)`: where the derivative vanishes.
    fn extremes(mode: &Mode, target: f64) -> impl Fn(u32) -> Peak {
        let pole = mode.pole();
        let start = Real::atan2(pole.re, pole.im);
        move |half| {
            let time = (start + PI * f64::from(half)) / pole.im;
            Peak { time, value: target + Real::exp(pole.re * time) * Real::cos(pole.im * time) }
        }
    }

    #[test]
    fn the_exact_form_is_exact_and_the_short_one_off_by_theory() {
        for z in [0.001, 0.05, 0.2, 0.4166, 0.4583, 0.7, 0.9] {
            let mode = Mode::new(274.0, z).expect("valid");
            let at = extremes(&mode, 3.0);
            let maxima: Vec<Peak> = (0..4).map(|k| at(2 * k)).collect();
            let decay = |k: f64| (-TAU * k * z / (1.0 - z * z).sqrt()).exp();
            for (decrement, cycles) in [
                (LogarithmicDecrement::over_cycles(&maxima, 3.0, 1), 1.0),
                (LogarithmicDecrement::over_cycles(&maxima, 3.0, 3), 3.0),
                (LogarithmicDecrement::half_cycle(at(0), at(1), 3.0), 0.5),
            ] {
                // What the rounding of the target, some 4e-16 of a height of e^-..., does to its logarithm.
                let tolerance = 1e-15 + 4e-15 / (decay(cycles) * maxima[0].value.min(1.0) * cycles);
                if tolerance > 1e-6 {
                    continue;
                }
                let decrement = decrement.expect("decays");
                assert!((decrement.damping_ratio() - z).abs() < tolerance, "{z} {cycles}");
                assert!(
                    (decrement.angular_frequency() / 274.0 - 1.0).abs() < tolerance + 1e-13,
                    "{z} {cycles}"
                );
                let short = z / (1.0 - z * z).sqrt();
                // d d/dz of the short form is (1 - z^2)^(-3/2).
                assert!(
                    (decrement.small_damping_ratio() - short).abs() < tolerance / (1.0 - z * z).powf(1.5)
                );
            }
        }
    }

    #[test]
    fn a_printed_number_of_the_short_form() {
        // A true 0.4583 reads 0.5156, and a printed 0.4583 means 0.4166.
        let of = |d: f64| LogarithmicDecrement { decrement_per_radian: d, damped_angular_frequency: 1.0 };
        assert!((of(0.4583).damping_ratio() - 0.4166).abs() < 5e-5);
        assert!((of(0.5156).damping_ratio() - 0.4583).abs() < 5e-5);
    }

    #[test]
    fn no_estimate_is_made_up() {
        let peak = |time, value| Peak { time, value };
        let maxima = [peak(0.0, 1.0), peak(1.0, 2.0)];
        assert!(matches!(
            LogarithmicDecrement::over_cycles(&maxima, 0.0, 1),
            Err(DecrementError::Growing { ratio, damping_ratio }) if (ratio - 0.5).abs() < 1e-15 && damping_ratio < 0.0
        ));
        assert_eq!(
            LogarithmicDecrement::over_cycles(&maxima, 0.0, 2),
            Err(DecrementError::TooFewPeaks { needed: 3, found: 2 })
        );
        assert_eq!(LogarithmicDecrement::over_cycles(&maxima, 0.0, 0), Err(DecrementError::Cycles));
        assert!(matches!(
            LogarithmicDecrement::over_cycles(&maxima, 1.5, 1),
            Err(DecrementError::Height { height, .. }) if height < 0.0
        ));
        assert!(matches!(
            LogarithmicDecrement::half_cycle(peak(1.0, 2.0), peak(1.0, -1.0), 0.0),
            Err(DecrementError::Interval(_))
        ));
        assert!(LogarithmicDecrement::over_cycles(&maxima, f64::NAN, 1).is_err());
    }
}
