//! Nonlinear least squares of the poles: variable projection with Levenberg and Marquardt's damping.

use faer::Mat;

use super::basis::{Amplitudes, Pole, amplitudes, order, projected};
use crate::least_squares::{damped_step, inverse_square};

/// Poles with their amplitudes, and what they leave of the data.
#[derive(Debug, Clone)]
pub(super) struct Fit {
    pub(super) poles: Vec<Pole>,
    pub(super) amplitudes: Vec<f64>,
    /// Sum of squares of the residual.
    pub(super) square: f64,
}

impl Fit {
    /// The best amplitudes for given poles.
    pub(super) fn linear(poles: Vec<Pole>, offset: bool, y: &[f64]) -> Option<Self> {
        let Amplitudes { values, square } = amplitudes(&poles, offset, y)?;
        Some(Self { poles, amplitudes: values, square })
    }

    /// The nearest minimum of the sum of squares, or the way there after some `iterations`; `floor` is a sum of squares that rounding alone may leave.
    ///
    /// # References
    /// G. H. Golub and V. Pereyra, "Separable nonlinear least squares: the variable projection method and its
    /// applications", Inverse Problems 19 (2003), doi:10.1088/0266-5611/19/2/201. The Jacobian is Kaufman's.
    pub(super) fn refined(mut self, offset: bool, y: &[f64], floor: f64, iterations: usize) -> Self {
        const REFUSALS: usize = 6;
        if self.poles.is_empty() {
            return self;
        }
        let mut damping = 1e-4;
        for _ in 0..iterations {
            let r = projected(&self.poles, &self.amplitudes, offset, y);
            let mut gain = None;
            for _ in 0..REFUSALS {
                let trial = damped_step(&r, damping)
                    .map(|step| {
                        let mut step = step.into_iter();
                        self.poles.iter().map(|pole| pole.moved(&mut step).bounded(y.len())).collect()
                    })
                    .and_then(|poles| Self::linear(poles, offset, y));
                match trial {
                    Some(trial) if trial.square < self.square => {
                        gain = Some(self.square - trial.square);
                        self = trial;
                        damping *= 0.01;
                        break;
                    }
                    _ => damping = (damping * 10.0).max(1e-6),
                }
            }
            // A sum of squares that falls by less than this moves no pole by a thousandth of its deviation.
            let enough = 1e-9 * self.square / y.len() as f64;
            if gain.is_none_or(|gain| gain <= enough) || self.square <= 1e-6 * floor {
                break;
            }
        }
        self
    }

    /// Columns of the inverse of the curvature for the decays and turns: times the noise variance, their covariance.
    pub(super) fn inverse_curvature(&self, offset: bool, y: &[f64]) -> Option<Mat<f64>> {
        inverse_square(&projected(&self.poles, &self.amplitudes, offset, y), order(&self.poles))
    }
}
