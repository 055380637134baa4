//! What a chain is made of.

use num_complex::Complex;

use crate::complex;
use crate::polynomial::response::phi_1;
use crate::quantities::{Mode, Real};

/// The most damped periods of an average: each takes two more steps.
const MOST_PERIODS: f64 = 4.0;
/// The most steps of an average.
pub(super) const MOST_STEPS: usize = 9;

/// One part of a chain: the motion behind it is the weighted mean of the motion before it over some time back.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Link {
    /// The plain average over `length` s, which limits a derivative.
    Average {
        /// Length, s.
        length: f64,
    },
    /// The average over whole damped periods, every half of one weighted by `decay` relative to the half after it: it leaves
    /// nothing of a mode, and limits a derivative as well.
    ///
    /// It is the average with the weight `e^(-z w t)` taken in steps of half a period, with the zero exactly where that has
    /// it. Its peak is lower, and what it makes of a polynomial are polynomials.
    Damped {
        /// Damped period of the mode, s.
        period: f64,
        /// How many of them it is long.
        periods: u32,
        /// Weight of a half period relative to the one after it, `K = e^(-pi z / sqrt(1 - z^2))`.
        decay: f64,
        /// Index of the mode of which nothing is left.
        mode: usize,
    },
    /// The mean of now and half a damped period ago, the past weighted by `decay`: it leaves nothing of a mode and limits
    /// nothing, in half the time.
    Pair {
        /// Half a damped period of the mode, s.
        delay: f64,
        /// Weight of the past, as above.
        decay: f64,
        /// Index of the mode of which nothing is left.
        mode: usize,
    },
}

impl Link {
    /// The shortest average that leaves nothing of `mode`, which has this index, and limits a derivative at least as much
    /// as a plain one of `length` s; `None` where damping weights the periods so unevenly that none does.
    pub(super) fn damped(mode: Mode, index: usize, length: f64) -> Option<Self> {
        let (period, decay) = (mode.damped_period(), half_turn(mode));
        let periods = if decay < 1.0 {
            let left = 1.0 - 2.0 * (1.0 - decay) * length / period;
            // Written so that a logarithm of nothing or less is none.
            Real::ln(left.max(0.0)) / (2.0 * Real::ln(decay))
        } else {
            length / period
        };
        let most = if decay < 1.0 { MOST_PERIODS } else { f64::from(u32::MAX) };
        // A whole number but for rounding is one.
        let periods = Real::ceil(periods * (1.0 - 4.0 * f64::EPSILON)).max(1.0);
        (periods <= most).then_some(Self::Damped { period, periods: periods as u32, decay, mode: index })
    }

    /// The pair that leaves nothing of `mode`, which has this index.
    pub(super) fn pair(mode: Mode, index: usize) -> Self {
        Self::Pair { delay: 0.5 * mode.damped_period(), decay: half_turn(mode), mode: index }
    }

    /// Time it adds to a motion, s.
    #[must_use]
    pub fn duration(&self) -> f64 {
        match *self {
            Self::Average { length } => length,
            Self::Damped { period, periods, .. } => f64::from(periods) * period,
            Self::Pair { delay, .. } => delay,
        }
    }

    /// Index of the mode of which it leaves nothing.
    #[must_use]
    pub fn mode(&self) -> Option<usize> {
        match *self {
            Self::Average { .. } => None,
            Self::Damped { mode, .. } | Self::Pair { mode, .. } => Some(mode),
        }
    }

    /// The response of a pole `p` in rad/s at its end, `integral from 0 to L of k(u) e^(p (L - u)) du` with `k` the weights,
    /// which are one in sum: bounded for `Re p <= 0`, and the factor by which it multiplies that of a motion.
    #[must_use]
    pub fn response(&self, p: Complex<f64>) -> Complex<f64> {
        match *self {
            Self::Average { length } => phi_1(p * length),
            Self::Damped { period, periods, decay, .. } if decay < 1.0 => {
                // Halves from the newest, which has the longest way to the end.
                let turn = complex::exp(p * (0.5 * period));
                let (mut sum, mut weights, mut weight) = (Complex::new(0.0, 0.0), 0.0, 1.0);
                for _ in 0..2 * periods {
                    sum = sum * turn + weight;
                    weights += weight;
                    weight *= decay;
                }
                phi_1(p * (0.5 * period)) * sum / weights
            }
            Self::Damped { .. } => phi_1(p * self.duration()),
            Self::Pair { delay, decay, .. } => (complex::exp(p * delay) + decay) / (1.0 + decay),
        }
    }

    /// Inverse of the largest weight of an average, s; zero for a pair, which has no largest.
    pub(super) fn effective(&self) -> f64 {
        match *self {
            Self::Damped { period, periods, decay, .. } if decay < 1.0 => {
                let halves = (0..2 * periods).fold(0.0, |sum, _| 1.0 + decay * sum);
                0.5 * period * halves
            }
            Self::Pair { .. } => 0.0,
            _ => self.duration(),
        }
    }

    /// Knots that it makes of one.
    pub(super) fn knots(&self) -> usize {
        match *self {
            // Without damping the halves are one.
            Self::Damped { periods, decay, .. } if decay < 1.0 => 2 * periods as usize + 1,
            _ => 2,
        }
    }
}

/// What is left of a mode after half a damped period, `e^(-pi z / sqrt(1 - z^2))`.
fn half_turn(mode: Mode) -> f64 {
    Real::exp(mode.pole().re * (0.5 * mode.damped_period()))
}
