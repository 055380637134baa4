//! The kind of a step response: without overshoot, with one, or ringing.

use crate::error::SignalError;
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
