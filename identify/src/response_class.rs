//! The kind of a step response: without overshoot, with one, or ringing.

use crate::decrement::LogarithmicDecrement;
use crate::error::{DecrementError, SignalError};
use crate::peaks::{Peak, Peaks};
use crate::signal::{Signal, length, not_negative};

/// The kind of a step response.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum ResponseClass {
    /// No overshoot.
    A,
    /// Overshoot, then no steady decay.
    B,
    /// A decaying oscillation: successive peaks shrink by a steady ratio.
    C,
}

/// The rule that tells responses apart.
///
/// Peaks `p0, p1, ...` of the response beyond the target, in the direction of the move, decay by
/// `damp(i) = (p(i+1) - target) / (p(i) - target)`, and these change by `damp(i) / damp(i+1)`. No peak: class A. Any
/// change within the band: C. Else, and with fewer than three peaks: B.
///
/// ```
/// use identify::{ResponseClass, ResponseClassifier, Signal};
///
/// let values: Vec<f64> = (0..500).map(|n| n as f64 * 1e-3).map(|t| 1.0 - (-9.0 * t).exp() * (80.0 * t).cos()).collect();
/// let response = ResponseClassifier::default().classify(&Signal::sampled(&values, 1e-3)?, 0.0, 1.0)?;
/// assert_eq!(response.class, ResponseClass::C);
/// assert!((response.decay_changes[0] - 1.0).abs() < 0.01);
/// # Ok::<(), identify::SignalError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ResponseClassifier {
    /// Peaks nearer to the target are dropped; a part of the move.
    pub threshold: f64,
    /// Peaks that stand out by no more are none, see [`Peaks::find`]; a part of the move. Above the peak-to-peak noise.
    pub prominence: f64,
    /// Smallest change of the decay that counts as steady.
    pub steady_from: f64,
    /// Largest change of the decay that counts as steady.
    pub steady_to: f64,
}

impl Default for ResponseClassifier {
    /// Threshold and prominence of 0.01 % of the move, changes of 0.8 to 1.2.
    fn default() -> Self {
        Self { threshold: 1e-4, prominence: 1e-4, steady_from: 0.8, steady_to: 1.2 }
    }
}

/// A class with the numbers it follows from.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ClassifiedResponse {
    /// The class.
    pub class: ResponseClass,
    /// The peaks beyond the target: maxima of a move upwards, minima of one downwards.
    pub peaks: Vec<Peak>,
    /// `damp(i) = (p(i+1) - target) / (p(i) - target)`, one less than peaks.
    pub decays: Vec<f64>,
    /// `damp(i) / damp(i+1)`, one less than decays.
    pub decay_changes: Vec<f64>,
}

impl ClassifiedResponse {
    /// The decrement of a response to `target`, as its class tells where to read it: from the first two peaks of class C,
    /// from the first peak and the trough after it of class B, none of class A. `None` too where the trough is missing.
    ///
    /// # Errors
    /// A target that is not finite, and peaks that do not decay.
    ///
    /// # References
    /// J. Wu, H. Zhang, "Residual vibration suppression of servo system based on time delay filter", Journal of Mechanical
    /// and Electrical Engineering 36 (2019) 919-924, section 3.3, doi:10.3969/j.issn.1001-4551.2019.09.007 (in Chinese).
    pub fn decrement(
        &self,
        response: &Signal<'_>,
        target: f64,
    ) -> Result<Option<LogarithmicDecrement>, DecrementError> {
        match self.class {
            ResponseClass::A => Ok(None),
            ResponseClass::B => self.half_cycle(response, target),
            ResponseClass::C => LogarithmicDecrement::over_cycles(&self.upright(target), target, 1).map(Some),
        }
    }

    /// The decrement from the first peak and the trough after it, whatever the class; `None` where there is no such pair.
    ///
    /// # Errors
    /// A target that is not finite, and peaks that do not decay.
    pub fn half_cycle(
        &self,
        response: &Signal<'_>,
        target: f64,
    ) -> Result<Option<LogarithmicDecrement>, DecrementError> {
        let (Some(&peak), Ok(found)) = (self.peaks.first(), Peaks::find(response, 0.0)) else {
            return Ok(None);
        };
        let down = peak.value < target;
        let troughs = if down { found.maxima } else { found.minima };
        let Some(trough) = troughs.into_iter().find(|trough| trough.time > peak.time) else {
            return Ok(None);
        };
        let turned = |peak: Peak| if down { mirrored(peak, target) } else { peak };
        LogarithmicDecrement::half_cycle(turned(peak), turned(trough), target).map(Some)
    }

    /// The peaks as maxima, also those of a move downwards.
    fn upright(&self, target: f64) -> Vec<Peak> {
        let turned = |peak: &Peak| if peak.value < target { mirrored(*peak, target) } else { *peak };
        self.peaks.iter().map(turned).collect()
    }
}

/// The peak on the other side of the target.
fn mirrored(peak: Peak, target: f64) -> Peak {
    Peak { value: 2.0 * target - peak.value, ..peak }
}

impl ResponseClassifier {
    /// The class of a response of a move from `from` to `target`.
    ///
    /// # Errors
    /// Ends that are not finite or equal; a threshold, prominence or bound that is negative or not finite.
    pub fn classify(
        &self,
        response: &Signal<'_>,
        from: f64,
        target: f64,
    ) -> Result<ClassifiedResponse, SignalError> {
        let length = length(from, target)?;
        let threshold = not_negative("the threshold", self.threshold)?;
        let steady = not_negative("a bound of the decay", self.steady_from)?
            ..=not_negative("a bound of the decay", self.steady_to)?;
        let prominence = not_negative("the prominence", self.prominence)? * length.abs();
        let found = Peaks::find(response, prominence)?;
        let mut peaks = if length > 0.0 { found.maxima } else { found.minima };
        let height = |peak: &Peak| (peak.value - target) / length;
        // A height of zero has no decay, whatever the threshold.
        peaks.retain(|peak| height(peak) >= threshold && height(peak) > 0.0);
        let ratios = |numbers: &[f64]| -> Vec<f64> {
            numbers.iter().zip(numbers.iter().skip(1)).map(|(before, after)| after / before).collect()
        };
        let heights: Vec<f64> = peaks.iter().map(height).collect();
        let decays = ratios(&heights);
        let decay_changes: Vec<f64> = ratios(&decays).iter().map(|change| change.recip()).collect();
        let class = if peaks.is_empty() {
            ResponseClass::A
        } else if decay_changes.iter().any(|change| steady.contains(change)) {
            ResponseClass::C
        } else {
            ResponseClass::B
        };
        Ok(ClassifiedResponse { class, peaks, decays, decay_changes })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use profiles::Mode;

    const PERIOD: f64 = 1e-4;

    /// A step of a second-order system with a zero, up or down: it overshoots and swings about the target.
    fn response(mode: Mode, from: f64, target: f64) -> Vec<f64> {
        let pole = mode.pole();
        let swing = |t: f64| (pole.re * t).exp() * (pole.im * t).cos();
        (0..4000).map(|n| target + (from - target) * swing(f64::from(n) * PERIOD)).collect()
    }

    #[test]
    fn the_decrement_is_read_where_the_class_says_whichever_way_the_move_goes() {
        for (damping, class) in [(0.05, ResponseClass::C), (0.75, ResponseClass::B)] {
            let mode = Mode::new(300.0, damping).expect("valid");
            for (from, target) in [(0.0, 2.0), (1.0, -4.0)] {
                let values = response(mode, from, target);
                let signal = Signal::sampled(&values, PERIOD).expect("valid");
                // At a damping of 3/4 a peak is 8e-4 of the one before: two are left, and no change of a ratio.
                let found = ResponseClassifier::default().classify(&signal, from, target).expect("valid");
                assert_eq!(found.class, class);
                let decrement = found.decrement(&signal, target).expect("decays").expect("a reading");
                // The parabola through three samples, 209 or more to a period.
                assert!((decrement.damping_ratio() - damping).abs() < 1e-4, "{decrement:?}");
                assert!((decrement.angular_frequency() / 300.0 - 1.0).abs() < 1e-3, "{decrement:?}");
                let half = found.half_cycle(&signal, target).expect("decays").expect("a trough");
                assert!((half.damping_ratio() - damping).abs() < 1e-4, "{half:?}");
            }
        }
    }

    #[test]
    fn class_a_has_no_decrement() {
        let values: Vec<f64> = (0..500).map(|n| 1.0 - (-f64::from(n) * 0.05).exp()).collect();
        let signal = Signal::sampled(&values, PERIOD).expect("valid");
        let found = ResponseClassifier::default().classify(&signal, 0.0, 1.0).expect("valid");
        assert_eq!((found.class, found.decrement(&signal, 1.0)), (ResponseClass::A, Ok(None)));
        assert_eq!(found.half_cycle(&signal, 1.0), Ok(None));
    }
}
