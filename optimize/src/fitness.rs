//! Fitness of a step response: error, effort and overshoot over the horizon, and the rise time.

use identify::{Signal, SignalError};

use crate::error::FitnessError;

/// Weights of the fitness of a step response from `from` to `target`,
///
/// `integral of (error |e| + effort |u| + overshoot M_p) dt + rise`,
///
/// over the record, with `e = target - y`, `M_p = max(0, (y - target) / (target - from))`, and `rise` the time from
/// 10 % to 90 % of the move or, where 90 % is never reached, `penalty`. Between samples all signals are straight
/// lines, whose integrals are exact.
///
/// ```
/// use identify::Signal;
/// use optimize::FitnessWeights;
///
/// let weights = FitnessWeights::new(1.0, 0.0, 10.0, 100.0)?;
/// let output: Vec<f64> = (0..6001).map(|n| 1.0 - (-1e-3 * f64::from(n) / 0.2).exp()).collect();
/// let fitness = weights.of(&Signal::sampled(&output, 1e-3)?, &vec![0.0; 6001], 0.0, 1.0)?;
/// // A lag of 0.2 s: the error integrates to 0.2, the rise takes 0.2 ln 9.
/// assert!((fitness.total() - 0.2 * (1.0 + 9_f64.ln())).abs() < 1e-5);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # References
/// Z. Liu, S. Zhang, L. Cai, J. Yang, B. Xu, P. Xu, "Five-phase S-curve control method based on particle swarm
/// optimization", Journal of Beijing University of Technology 41 (2015), <https://doi.org/10.11936/bjutxb2014060067>:
/// eq. (14) and (15), with `eta_1`, `eta_2`, `eta_3` and `k` in the order of [`FitnessWeights::new`].
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedWeights"))]
pub struct FitnessWeights {
    error: f64,
    effort: f64,
    overshoot: f64,
    penalty: f64,
}

#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
struct UncheckedWeights {
    error: f64,
    effort: f64,
    overshoot: f64,
    penalty: f64,
}

#[cfg(feature = "serde")]
impl TryFrom<UncheckedWeights> for FitnessWeights {
    type Error = FitnessError;
    fn try_from(weights: UncheckedWeights) -> Result<Self, FitnessError> {
        Self::new(weights.error, weights.effort, weights.overshoot, weights.penalty)
    }
}

/// The terms of a fitness, each with its weight in it.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Fitness {
    /// Weighted integral of the magnitude of the error.
    pub error: f64,
    /// Weighted integral of the magnitude of the effort.
    pub effort: f64,
    /// Weighted integral of the overshoot.
    pub overshoot: f64,
    /// Rise time, s, or the penalty if there was no rise.
    pub rise: f64,
    /// Whether 90 % of the move was reached.
    pub risen: bool,
}

impl Fitness {
    /// The sum of the terms, finite.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.error + self.effort + self.overshoot + self.rise
    }
}

impl FitnessWeights {
    /// Weights of error in 1/(unit of the output s), of effort in 1/(unit of the effort s) and of overshoot in 1/s,
    /// and what stands for the rise time of a response that does not rise.
    ///
    /// # Errors
    /// A weight that is negative or not finite.
    pub fn new(error: f64, effort: f64, overshoot: f64, penalty: f64) -> Result<Self, FitnessError> {
        let checked = |quantity, value: f64| {
            if value >= 0.0 && value.is_finite() {
                Ok(value)
            } else {
                Err(FitnessError::Weight { quantity, value })
            }
        };
        Ok(Self {
            error: checked("the weight of the error", error)?,
            effort: checked("the weight of the effort", effort)?,
            overshoot: checked("the weight of the overshoot", overshoot)?,
            penalty: checked("the penalty", penalty)?,
        })
    }

    /// The fitness of a response that was to move from `from` to `target`, with the effort at the same instants.
    ///
    /// # Errors
    /// Efforts of another number or not finite, ends that are not finite or equal, a sum beyond the range of numbers.
    pub fn of(
        &self,
        output: &Signal<'_>,
        effort: &[f64],
        from: f64,
        target: f64,
    ) -> Result<Fitness, FitnessError> {
        let outputs = output.values().len();
        if effort.len() != outputs {
            return Err(FitnessError::Lengths { efforts: effort.len(), outputs });
        }
        if let Some((index, &value)) = effort.iter().enumerate().find(|(_, value)| !value.is_finite()) {
            return Err(FitnessError::Effort { index, value });
        }
        let (rise, risen) = match output.rise_time(from, target) {
            Ok(time) => (time, true),
            Err(SignalError::NotReached { .. }) => (self.penalty, false),
            Err(error) => return Err(error.into()),
        };
        let length = target - from;
        let (mut error, mut used, mut beyond) = (0.0, 0.0, 0.0);
        let samples = || output.samples().zip(effort);
        for (((t0, y0), u0), ((t1, y1), u1)) in samples().zip(samples().skip(1)) {
            let span = t1 - t0;
            error += span * magnitude(target - y0, target - y1);
            used += span * magnitude(*u0, *u1);
            beyond += span * above_zero((y0 - target) / length, (y1 - target) / length);
        }
        let fitness = Fitness {
            error: self.error * error,
            effort: self.effort * used,
            overshoot: self.overshoot * beyond,
            rise,
            risen,
        };
        if fitness.total().is_finite() { Ok(fitness) } else { Err(FitnessError::Overflow(fitness.total())) }
    }
}

/// Mean of the magnitude of a straight line.
fn magnitude(start: f64, end: f64) -> f64 {
    above_zero(start, end) + above_zero(-start, -end)
}

/// Mean of the part of a straight line that is above zero.
fn above_zero(start: f64, end: f64) -> f64 {
    let (low, high) = (start.min(end), start.max(end));
    if low >= 0.0 {
        0.5 * low + 0.5 * high
    } else if high > 0.0 {
        // A triangle of this height over the part high / (high - low) of the base.
        0.5 * high * (high / (high - low))
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_integrated_exactly() {
        for (start, end) in [(1.0, 3.0), (-1.0, 3.0), (3.0, -1.0), (-2.0, -0.5), (0.0, 1.0), (0.0, 0.0)] {
            // Midpoint rule with cells that meet the kink at a quarter or nowhere: exact but for roundings.
            let cells = 4000;
            let line = |n: i32| start + (end - start) * (f64::from(n) + 0.5) / f64::from(cells);
            let above = (0..cells).map(|n| line(n).max(0.0)).sum::<f64>() / f64::from(cells);
            let size = (0..cells).map(|n| line(n).abs()).sum::<f64>() / f64::from(cells);
            assert!((above_zero(start, end) - above).abs() < 1e-12, "{start} {end}");
            assert!((magnitude(start, end) - size).abs() < 1e-12, "{start} {end}");
        }
    }

    #[test]
    fn terms_add_up() {
        let weights = FitnessWeights::new(2.0, 3.0, 5.0, 1e3).expect("valid");
        // Down from 4 to 2, over it by half of the move, in triangles: all areas by hand.
        let output = [4.0, 2.0, 1.0, 2.0, 2.0];
        let output = Signal::sampled(&output, 0.5).expect("valid");
        let fitness = weights.of(&output, &[1.0, -1.0, -1.0, 0.0, 0.0], 4.0, 2.0).expect("valid");
        let sides =
            [(fitness.error, 2.0 * 1.0), (fitness.effort, 3.0 * 1.0), (fitness.overshoot, 5.0 * 0.25)];
        for (ours, by_hand) in sides {
            assert!((ours - by_hand).abs() < 1e-15, "{ours} {by_hand}");
        }
        // From 10 % to 90 % on the first line.
        assert!(fitness.risen && (fitness.rise - 0.4).abs() < 1e-15);
        assert!((fitness.total() - (2.0 + 3.0 + 1.25 + 0.4)).abs() < 1e-14);
    }

    #[test]
    fn no_rise_is_penalised() {
        let weights = FitnessWeights::new(0.0, 0.0, 0.0, 1e3).expect("valid");
        let low = Signal::sampled(&[0.0, 0.5, 0.89], 1.0).expect("valid");
        let fitness = weights.of(&low, &[0.0; 3], 0.0, 1.0).expect("valid");
        assert!(!fitness.risen && (fitness.total() - 1e3).abs() <= 0.0);
    }

    #[test]
    fn what_has_no_fitness_is_named() {
        assert!(
            matches!(FitnessWeights::new(0.0, -1.0, 0.0, 0.0), Err(FitnessError::Weight { value, .. }) if value < 0.0)
        );
        assert!(FitnessWeights::new(0.0, 0.0, f64::NAN, 0.0).is_err());
        let weights = FitnessWeights::new(1e300, 0.0, 0.0, 1.0).expect("valid");
        let output = Signal::sampled(&[0.0, 1.0], 1.0).expect("valid");
        assert_eq!(
            weights.of(&output, &[0.0], 0.0, 1.0),
            Err(FitnessError::Lengths { efforts: 1, outputs: 2 })
        );
        assert!(matches!(
            weights.of(&output, &[0.0, f64::INFINITY], 0.0, 1.0),
            Err(FitnessError::Effort { index: 1, .. })
        ));
        assert_eq!(
            weights.of(&output, &[0.0; 2], 1.0, 1.0),
            Err(FitnessError::Signal(SignalError::NoMove(1.0)))
        );
        let far = Signal::sampled(&[-1e300, 1e300], 1.0).expect("valid");
        assert!(matches!(weights.of(&far, &[0.0; 2], -1e300, 1e300), Err(FitnessError::Overflow(_))));
    }
}
