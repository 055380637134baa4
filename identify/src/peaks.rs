//! Peaks and troughs between the samples.

use crate::error::SignalError;
use crate::signal::{Signal, not_negative};

/// A maximum or a minimum of a signal.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Peak {
    /// Time, s.
    pub time: f64,
    /// Value, in the unit of the signal.
    pub value: f64,
}

/// The maxima and minima of a signal, each in the order of time.
#[derive(Debug, Clone, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Peaks {
    /// Local maxima.
    pub maxima: Vec<Peak>,
    /// Local minima.
    pub minima: Vec<Peak>,
}

impl Peaks {
    /// The peaks of a signal that stand out by more than `prominence`: from each the signal falls (from a minimum:
    /// rises) by more than that before it comes to a higher (lower) one. With a prominence above the peak-to-peak
    /// noise every swing has one peak; with zero every local extremum is one. Ends of the record are none.
    ///
    /// A peak is the vertex of the parabola through its highest sample and the two beside it. Where several samples
    /// share the highest value, as counts of an encoder do, it is at the middle of the first and the last; two
    /// neighbours keep the parabola's value, more have their own. For `m` samples to a period the value is low by
    /// less than `(2 pi / m)^4 / 42` of the amplitude of a sinusoid.
    ///
    /// ```
    /// use identify::{Peaks, Signal};
    ///
    /// let values: Vec<f64> = (0..100).map(|n| (0.2 * f64::from(n)).sin()).collect();
    /// let peaks = Peaks::find(&Signal::sampled(&values, 0.2)?, 0.0)?;
    /// assert_eq!((peaks.maxima.len(), peaks.minima.len()), (3, 3));
    /// assert!((peaks.maxima[1].time - 2.5 * std::f64::consts::PI).abs() < 1e-3);
    /// assert!((peaks.maxima[1].value - 1.0).abs() < 4e-5);
    /// # Ok::<(), identify::SignalError>(())
    /// ```
    ///
    /// # Errors
    /// A prominence that is negative or not finite.
    pub fn find(signal: &Signal<'_>, prominence: f64) -> Result<Self, SignalError> {
        let prominence = not_negative("the prominence", prominence)?;
        let mut peaks = Self::default();
        let values = signal.values().iter().copied().enumerate();
        let (mut top, mut bottom) = (Run::default(), Run::default());
        let mut rising: Option<bool> = None;
        for (index, value) in values {
            top.extend(index, value, value >= top.value);
            bottom.extend(index, value, value <= bottom.value);
            if rising != Some(false) && value < top.value - prominence {
                if rising.is_some() {
                    peaks.maxima.push(top.peak(signal));
                }
                (rising, bottom) = (Some(false), Run::at(index, value));
            } else if rising != Some(true) && value > bottom.value + prominence {
                if rising.is_some() {
                    peaks.minima.push(bottom.peak(signal));
                }
                (rising, top) = (Some(true), Run::at(index, value));
            }
        }
        Ok(peaks)
    }

    /// Without the peaks nearer than `threshold` to `target`.
    ///
    /// # Errors
    /// A threshold that is negative or not finite; a target that is not finite.
    pub fn about(mut self, target: f64, threshold: f64) -> Result<Self, SignalError> {
        let target = crate::signal::finite("the target", target)?;
        let threshold = not_negative("the threshold", threshold)?;
        self.maxima.retain(|peak| (peak.value - target).abs() >= threshold);
        self.minima.retain(|peak| (peak.value - target).abs() >= threshold);
        Ok(self)
    }
}

/// The samples that share the extreme value of a swing: the first, the last and how many.
#[derive(Debug, Clone, Copy)]
struct Run {
    first: usize,
    last: usize,
    value: f64,
}

impl Default for Run {
    /// Compares false with everything, so that the first sample replaces it.
    fn default() -> Self {
        Self { first: 0, last: 0, value: f64::NAN }
    }
}

impl Run {
    fn at(index: usize, value: f64) -> Self {
        Self { first: index, last: index, value }
    }

    fn extend(&mut self, index: usize, value: f64, beyond: bool) {
        if self.value.is_nan() || (beyond && (value - self.value).abs() > 0.0) {
            *self = Self::at(index, value);
        } else if beyond {
            self.last = index;
        }
    }

    fn peak(&self, signal: &Signal<'_>) -> Peak {
        let middle =
            Peak { time: 0.5 * (signal.time(self.first) + signal.time(self.last)), value: self.value };
        let index = self.first;
        let neighbours = index.checked_sub(1).and_then(|before| {
            Some((before, *signal.values().get(before)?, *signal.values().get(self.last + 1)?))
        });
        let Some((before, left, right)) = neighbours else { return middle };
        if self.last == index + 1 {
            // y = y0 - c x^2 through the pair at x = +-1/2 and the mean of their neighbours at x = +-3/2.
            let drop = self.value - (0.5 * left + 0.5 * right);
            return Peak { value: self.value + drop / 8.0, ..middle };
        }
        if self.last != index {
            return middle;
        }
        // Newton's form about the middle: y = y0 + x (slope + x curvature).
        let (h0, h1) = (middle.time - signal.time(before), signal.time(index + 1) - middle.time);
        let (s0, s1) = ((middle.value - left) / h0, (right - middle.value) / h1);
        let curvature = (s1 - s0) / (h0 + h1);
        let slope = (s0 * h1 + s1 * h0) / (h0 + h1);
        let shift = -0.5 * slope / curvature;
        let vertex = Peak { time: middle.time + shift, value: middle.value + 0.5 * slope * shift };
        if vertex.time.is_finite() && vertex.value.is_finite() { vertex } else { middle }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn find(values: &[f64], prominence: f64) -> Peaks {
        Peaks::find(&Signal::sampled(values, 1.0).expect("valid"), prominence).expect("valid")
    }

    fn times(peaks: &[Peak]) -> Vec<f64> {
        peaks.iter().map(|peak| peak.time).collect()
    }

    #[test]
    fn a_parabola_is_found_exactly() {
        // On uneven times too: the vertex is at 1.3, 0.7.
        let time = [0.0, 0.4, 1.1, 1.9, 2.0];
        let values = time.map(|t: f64| 0.7 - 3.0 * (t - 1.3) * (t - 1.3));
        let peaks = Peaks::find(&Signal::new(&time, &values).expect("valid"), 0.0).expect("valid");
        assert_eq!((peaks.maxima.len(), peaks.minima.len()), (1, 0));
        assert!((peaks.maxima[0].time - 1.3).abs() < 1e-15);
        assert!((peaks.maxima[0].value - 0.7).abs() < 1e-15);
    }

    #[test]
    fn plateaus_have_a_middle_and_ends_are_no_peaks() {
        let peaks = find(&[3.0, 1.0, 1.0, 2.0, 2.0, 2.0, 0.0, 0.0, 5.0], 0.0);
        assert_eq!(times(&peaks.minima), [1.5, 6.5]);
        assert_eq!(times(&peaks.maxima), [4.0]);
        // A step of a staircase is no plateau of a peak.
        assert_eq!(find(&[0.0, 1.0, 1.0, 2.0, 2.0, 3.0], 0.0), Peaks::default());
        assert_eq!(find(&[1.0, 1.0, 1.0], 0.0), Peaks::default());
    }

    #[test]
    fn noise_below_the_prominence_makes_no_peaks() {
        let wave = |n: i32| (f64::from(n) * TAU / 50.0).sin() + 0.04 * f64::from((n * 7) % 3 - 1);
        let values: Vec<f64> = (0..500).map(wave).collect();
        let all = find(&values, 0.0);
        assert!(all.maxima.len() > 20);
        let real = find(&values, 0.2);
        assert_eq!((real.maxima.len(), real.minima.len()), (10, 10));
        for (peak, k) in real.maxima.iter().zip(0..) {
            assert!((peak.time - (12.5 + 50.0 * f64::from(k))).abs() < 4.0);
        }
    }

    #[test]
    fn the_bound_on_the_value_holds() {
        for samples in [6.0, 10.0, 20.0, 50.0] {
            let mut worst: f64 = 0.0;
            for phase in 0..40 {
                let shift = f64::from(phase) / 40.0;
                let values: Vec<f64> =
                    (0..200).map(|n| ((f64::from(n) + shift) * TAU / samples).cos()).collect();
                for peak in find(&values, 0.0).maxima {
                    worst = worst.max((peak.value - 1.0).abs());
                }
            }
            let bound = (TAU / samples).powi(4) / 42.0;
            assert!(worst < bound, "{samples}: {worst} > {bound}");
        }
    }

    #[test]
    fn peaks_near_the_target_are_dropped() {
        let values = [0.0, 2.0, 0.5, 1.1, 0.95, 1.05, 0.0];
        let peaks = find(&values, 0.0).about(1.0, 0.2).expect("valid");
        assert_eq!((peaks.maxima.len(), peaks.minima.len()), (1, 1));
        assert!(find(&values, 0.0).about(f64::NAN, 0.2).is_err());
    }
}
