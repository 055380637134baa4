//! Linear systems in sampled time.

use nalgebra::{SMatrix, SVector};

use super::state_space::finite;
use crate::error::ModelError;
use crate::linear::{Transition, spectral_radius};

/// A sampled linear system: `x[k+1] = A x[k] + B u[k]`, `y[k] = C x[k] + D u[k]`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DiscreteStateSpace<const N: usize, const M: usize, const P: usize> {
    transition: Transition<N, M>,
    c: SMatrix<f64, P, N>,
    d: SMatrix<f64, P, M>,
    period: f64,
}

impl<const N: usize, const M: usize, const P: usize> DiscreteStateSpace<N, M, P> {
    /// A system from its matrices and its period in s.
    ///
    /// # Errors
    /// An entry that is not finite, or a period that is not positive and finite.
    pub fn new(
        a: SMatrix<f64, N, N>,
        b: SMatrix<f64, N, M>,
        c: SMatrix<f64, P, N>,
        d: SMatrix<f64, P, M>,
        period: f64,
    ) -> Result<Self, ModelError> {
        finite("A", &a)?;
        finite("B", &b)?;
        finite("C", &c)?;
        finite("D", &d)?;
        if !(period > 0.0 && period.is_finite()) {
            return Err(ModelError::Parameter {
                parameter: "the period in s",
                range: "positive and finite",
                value: period,
            });
        }
        Ok(Self::from_parts(Transition { state: a, input: b }, c, d, period))
    }

    pub(crate) fn from_parts(
        transition: Transition<N, M>,
        c: SMatrix<f64, P, N>,
        d: SMatrix<f64, P, M>,
        period: f64,
    ) -> Self {
        Self { transition, c, d, period }
    }

    /// The matrices `A` and `B` of one step.
    #[must_use]
    pub fn transition(&self) -> &Transition<N, M> {
        &self.transition
    }

    /// The matrix `C`.
    #[must_use]
    pub fn c(&self) -> &SMatrix<f64, P, N> {
        &self.c
    }

    /// The matrix `D`.
    #[must_use]
    pub fn d(&self) -> &SMatrix<f64, P, M> {
        &self.d
    }

    /// The period, s.
    #[must_use]
    pub fn period(&self) -> f64 {
        self.period
    }

    /// The next state `A x + B u`.
    #[inline]
    #[must_use]
    pub fn step(&self, state: &SVector<f64, N>, input: &SVector<f64, M>) -> SVector<f64, N> {
        self.transition.apply(state, input)
    }

    /// The output `C x + D u`.
    #[inline]
    #[must_use]
    pub fn output(&self, state: &SVector<f64, N>, input: &SVector<f64, M>) -> SVector<f64, P> {
        self.c * state + self.d * input
    }

    /// The largest magnitude of an eigenvalue of `A`: below one the system is stable.
    ///
    /// # Errors
    /// The QR iteration did not converge.
    pub fn spectral_radius(&self) -> Result<f64, ModelError> {
        spectral_radius(&self.transition.state)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{matrix, vector};

    #[test]
    fn step_output_and_radius_by_hand() {
        let system = DiscreteStateSpace::new(
            matrix![0.5, 1.0; 0.0, -0.25],
            matrix![1.0; 2.0],
            matrix![1.0, 1.0],
            matrix![3.0],
            1e-3,
        )
        .expect("valid");
        assert_eq!(system.step(&vector![2.0, 4.0], &vector![1.0]), vector![6.0, 1.0]);
        assert_eq!(system.output(&vector![2.0, 4.0], &vector![1.0]), vector![9.0]);
        assert!((system.spectral_radius().expect("converges") - 0.5).abs() < 1e-15);
        assert!((system.period() - 1e-3).abs() <= 0.0);
    }

    #[test]
    fn bad_numbers_are_errors() {
        let one = matrix![1.0];
        assert!(matches!(
            DiscreteStateSpace::new(one, one, one, one, 0.0),
            Err(ModelError::Parameter { value: 0.0, .. })
        ));
        assert!(matches!(
            DiscreteStateSpace::new(one, one, one, matrix![f64::NAN], 1.0),
            Err(ModelError::Entry { matrix: "D", .. })
        ));
    }
}
