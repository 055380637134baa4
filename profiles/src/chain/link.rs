//! What a chain is made of.

use num_complex::Complex;

use crate::complex;
use crate::polynomial::response::phi_1;
use crate::quantities::{Mode, Real};

/// One part of a chain: the motion behind it is the weighted mean of the motion before it over some time back.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Link {
    /// The plain average over `length` s, which limits a derivative.
    Average {
        /// Length, s.
        length: f64,
    },
    /// The average over one damped period, the older half weighted by `decay`: it leaves nothing of a mode, and limits a
    /// derivative as well.
    ///
    /// It is the average with the weight `e^(-z w t)` taken in two steps, with the zero exactly where that has it. Its
    /// peak is lower, `2 / (1 + K)` over the period, and what it makes of a polynomial are polynomials.
    Damped {
        /// Length, one damped period of the mode, s.
        length: f64,
        /// Weight of the older half relative to the newer, `K = e^(-pi z / sqrt(1 - z^2))`.
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
    /// The average that leaves nothing of `mode`, which has this index.
    pub(super) fn damped(mode: Mode, index: usize) -> Self {
        Self::Damped { length: mode.damped_period(), decay: half_turn(mode), mode: index }
    }

    /// The pair that leaves nothing of `mode`, which has this index.
    pub(super) fn pair(mode: Mode, index: usize) -> Self {
        Self::Pair { delay: 0.5 * mode.damped_period(), decay: half_turn(mode), mode: index }
    }

    /// Time it adds to a motion, s.
    #[must_use]
    pub fn duration(&self) -> f64 {
        match *self {
            Self::Average { length } | Self::Damped { length, .. } => length,
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
        let pair = |delay: f64, decay: f64| (complex::exp(p * delay) + decay) / (1.0 + decay);
        match *self {
            Self::Average { length } => phi_1(p * length),
            Self::Damped { length, decay, .. } => phi_1(p * (0.5 * length)) * pair(0.5 * length, decay),
            Self::Pair { delay, decay, .. } => pair(delay, decay),
        }
    }

    /// Knots that it makes of one.
    pub(super) fn knots(&self) -> usize {
        match *self {
            // Without damping the halves are one.
            Self::Damped { decay, .. } if decay < 1.0 => 3,
            _ => 2,
        }
    }
}

/// What is left of a mode after half a damped period, `e^(-pi z / sqrt(1 - z^2))`.
fn half_turn(mode: Mode) -> f64 {
    Real::exp(mode.pole().re * (0.5 * mode.damped_period()))
}
