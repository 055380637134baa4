//! Averages over a window that moves along a record.

use crate::error::SignalError;
use crate::signal::check;

/// A moving average over a number of samples.
///
/// Filter input and output of a linear system alike and its transfer function stays.
///
/// ```
/// use identify::MovingAverage;
///
/// let average = MovingAverage::new(3)?;
/// assert_eq!(average.causal(&[0.0, 3.0, 6.0, 9.0])?, [0.0, 1.0, 3.0, 6.0]);
/// assert_eq!(average.zero_phase(&[0.0, 3.0, 6.0, 0.0])?, [0.0, 3.0, 3.0, 0.0]);
/// # Ok::<(), identify::SignalError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedMovingAverage"))]
pub struct MovingAverage {
    length: usize,
}

#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
struct UncheckedMovingAverage {
    length: usize,
}

#[cfg(feature = "serde")]
impl TryFrom<UncheckedMovingAverage> for MovingAverage {
    type Error = SignalError;
    fn try_from(average: UncheckedMovingAverage) -> Result<Self, SignalError> {
        Self::new(average.length)
    }
}

impl MovingAverage {
    /// An average over `length` samples.
    ///
    /// # Errors
    /// A length of zero.
    pub fn new(length: usize) -> Result<Self, SignalError> {
        if length > 0 {
            Ok(Self { length })
        } else {
            Err(SignalError::Length { quantity: "the window of an average", range: "positive", length })
        }
    }

    /// The number of samples in the window.
    #[must_use]
    pub fn length(&self) -> usize {
        self.length
    }

    /// The mean of every sample and the `length - 1` before it: late by `(length - 1) / 2` samples. Before the record
    /// the signal is taken to rest at its first value, so that filtered signals of a system that was at rest still
    /// obey its equations.
    ///
    /// # Errors
    /// A record without samples or with values that are not finite.
    pub fn causal(&self, values: &[f64]) -> Result<Vec<f64>, SignalError> {
        check(values)?;
        let first = values.first().copied().unwrap_or(0.0);
        // A window longer than the record sees all of it and as many first values as are missing.
        let before = self.length.min(values.len()) - 1;
        let missing = (self.length - 1 - before) as f64;
        let extended: Vec<f64> = std::iter::repeat_n(first, before).chain(values.iter().copied()).collect();
        let length = self.length as f64;
        let (known, rest) = ((before + 1) as f64 / length, missing * (first / length));
        Ok(means(&extended, before + 1).map(|mean| known * mean + rest).collect())
    }

    /// The mean over a window centred on every sample, without delay at any frequency. At the ends of the record the
    /// window shrinks on both sides alike, down to the sample itself: straight lines pass unchanged throughout.
    ///
    /// # Errors
    /// A length that is even, so that no sample is in the middle; a record without samples or with values that are
    /// not finite.
    pub fn zero_phase(&self, values: &[f64]) -> Result<Vec<f64>, SignalError> {
        check(values)?;
        if self.length.is_multiple_of(2) {
            return Err(SignalError::Length {
                quantity: "a window with a middle",
                range: "odd",
                length: self.length,
            });
        }
        let half = (self.length / 2).min((values.len() - 1) / 2);
        let middle = means(values, 2 * half + 1);
        let mut result = growing(values.iter(), half);
        let tail = growing(values.iter().rev(), half);
        result.extend(middle);
        result.extend(tail.iter().rev());
        Ok(result)
    }
}

/// The means of the first 1, 3, 5, ... values, `count` of them.
fn growing<'a>(mut values: impl Iterator<Item = &'a f64>, count: usize) -> Vec<f64> {
    let (mut mean, mut seen) = (0.0, 0.0);
    (0..count)
        .map(|k| {
            for value in values.by_ref().take(if k > 0 { 2 } else { 1 }) {
                seen += 1.0;
                mean += value / seen - mean / seen;
            }
            mean
        })
        .collect()
}

/// The means of all runs of `length` values, at most as many as there are.
///
/// Every run is the end of one block and the start of the next, both of which are summed from their common border: a
/// running sum whose roundings do not add up along the record.
///
/// # References
/// M. van Herk, "A fast algorithm for local minimum and maximum filters on rectangular and octagonal kernels",
/// Pattern Recognition Letters 13 (1992), doi:10.1016/0167-8655(92)90069-C, with sums for extremes.
fn means(values: &[f64], length: usize) -> impl Iterator<Item = f64> {
    let part = 1.0 / length as f64;
    // Parts, so that a sum of large values does not overflow.
    let mut to_border: Vec<f64> = values.iter().map(|value| value * part).collect();
    let mut from_border = to_border.clone();
    for block in to_border.chunks_mut(length) {
        let mut sum = 0.0;
        block.iter_mut().rev().for_each(|value| {
            sum += *value;
            *value = sum;
        });
    }
    for block in from_border.chunks_mut(length) {
        let mut sum = 0.0;
        block.iter_mut().for_each(|value| {
            sum += *value;
            *value = sum;
        });
    }
    let whole = move |start: usize| start.is_multiple_of(length);
    to_border.into_iter().zip(from_border.into_iter().skip(length - 1)).enumerate().map(
        move |(start, (end_of_block, start_of_next))| {
            if whole(start) { start_of_next } else { end_of_block + start_of_next }
        },
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn brute(values: &[f64], k: isize, before: isize, after: isize) -> f64 {
        let at = |i: isize| values[i.clamp(0, values.len() as isize - 1) as usize];
        (k - before..=k + after).map(at).sum::<f64>() / (before + after + 1) as f64
    }

    #[test]
    fn both_against_brute_force() {
        for samples in 1..24_usize {
            let values: Vec<f64> = (0..samples).map(|n| ((n * n) as f64 * 0.7).sin()).collect();
            for length in 1..30_usize {
                let average = MovingAverage::new(length).expect("positive");
                for (k, mean) in average.causal(&values).expect("finite").into_iter().enumerate() {
                    // Roundings of values of one.
                    assert!((mean - brute(&values, k as isize, length as isize - 1, 0)).abs() < 1e-14);
                }
                if length % 2 == 1 {
                    let found = average.zero_phase(&values).expect("finite");
                    assert_eq!(found.len(), samples);
                    for (k, mean) in found.into_iter().enumerate() {
                        let half = (length / 2).min(k).min(samples - 1 - k) as isize;
                        assert!((mean - brute(&values, k as isize, half, half)).abs() < 1e-14);
                    }
                }
            }
        }
    }

    #[test]
    fn a_long_record_does_not_drift() {
        // A burst of 1e9 leaves 1e-7 in a sum that subtracts what it added; here nothing is left.
        let mut values: Vec<f64> = (0..100_000).map(|n| f64::from(n % 7) * 0.1).collect();
        for value in values.iter_mut().take(50_000) {
            *value += 1e9;
        }
        let found = MovingAverage::new(49).expect("positive").causal(&values).expect("finite");
        assert!(found[50_100..].iter().all(|mean| (mean - 0.3).abs() < 1e-15 * 49.0));
    }

    #[test]
    fn a_sinusoid_keeps_its_phase_and_loses_by_the_kernel_of_dirichlet() {
        let w = 0.23;
        let values: Vec<f64> = (0..400).map(|n| (w * f64::from(n) + 0.4).cos()).collect();
        let average = MovingAverage::new(9).expect("positive");
        let gain = (4.5 * w).sin() / (9.0 * (0.5 * w).sin());
        let (causal, centred) =
            (average.causal(&values).expect("finite"), average.zero_phase(&values).expect("finite"));
        for n in 10..390_usize {
            assert!((centred[n] - gain * values[n]).abs() < 1e-14);
            assert!((causal[n] - centred[n - 4]).abs() < 1e-14);
        }
    }

    #[test]
    fn bad_requests_are_named() {
        assert!(matches!(MovingAverage::new(0), Err(SignalError::Length { length: 0, .. })));
        let even = MovingAverage::new(4).expect("positive");
        assert!(matches!(even.zero_phase(&[1.0]), Err(SignalError::Length { length: 4, .. })));
        assert_eq!(even.causal(&[]), Err(SignalError::Empty));
        assert!(matches!(even.causal(&[f64::NAN]), Err(SignalError::Value { .. })));
        let huge = MovingAverage::new(usize::MAX).expect("positive");
        assert!(huge.causal(&[1.0, 2.0]).expect("finite").iter().all(|mean| (mean - 1.0).abs() < 1e-15));
        assert!(huge.zero_phase(&[f64::MAX; 5]).expect("finite").iter().all(|mean| mean.is_finite()));
    }
}
