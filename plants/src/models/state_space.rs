//! Linear systems in state-space form.

use nalgebra::{Complex, SMatrix, SVector};

use super::{DiscreteStateSpace, Plant};
use crate::error::ModelError;
use crate::linear::{Transition, eigenvalues, zero_order_hold};
use crate::steppers::HeldLinear;

/// A continuous linear system with `N` states, `M` inputs and `P` outputs:
///
/// `x' = A x + B u`, `y = C x + D u`
///
/// ```
/// use plants::{StateSpace, nalgebra::{self, matrix, vector}};
///
/// // A mass of 2 kg on a spring of 200 N/m, moved by a force.
/// let system = StateSpace::new(
///     matrix![0.0, 1.0; -100.0, 0.0],
///     matrix![0.0; 0.5],
///     matrix![1.0, 0.0],
///     matrix![0.0],
/// )?;
/// assert!((system.poles()?[0].im.abs() - 10.0).abs() < 1e-13);
///
/// // Held at its equilibrium u / k it stays there.
/// let discrete = system.discretise(1e-3)?;
/// let x = discrete.step(&vector![0.1, 0.0], &vector![20.0]);
/// assert!((x - vector![0.1, 0.0]).norm() < 1e-16);
/// # Ok::<(), plants::ModelError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StateSpace<const N: usize, const M: usize, const P: usize> {
    a: SMatrix<f64, N, N>,
    b: SMatrix<f64, N, M>,
    c: SMatrix<f64, P, N>,
    d: SMatrix<f64, P, M>,
}

impl<const N: usize, const M: usize, const P: usize> StateSpace<N, M, P> {
    /// A system from its matrices: `A` is `N x N`, `B` is `N x M`, `C` is `P x N`, `D` is `P x M`.
    ///
    /// # Errors
    /// An entry that is not finite.
    pub fn new(
        a: SMatrix<f64, N, N>,
        b: SMatrix<f64, N, M>,
        c: SMatrix<f64, P, N>,
        d: SMatrix<f64, P, M>,
    ) -> Result<Self, ModelError> {
        finite("A", &a)?;
        finite("B", &b)?;
        finite("C", &c)?;
        finite("D", &d)?;
        Ok(Self { a, b, c, d })
    }

    /// The matrix `A`.
    #[must_use]
    pub fn a(&self) -> &SMatrix<f64, N, N> {
        &self.a
    }

    /// The matrix `B`.
    #[must_use]
    pub fn b(&self) -> &SMatrix<f64, N, M> {
        &self.b
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

    /// The output `y = C x + D u`.
    #[must_use]
    pub fn output(&self, state: &SVector<f64, N>, input: &SVector<f64, M>) -> SVector<f64, P> {
        self.c * state + self.d * input
    }

    /// The eigenvalues of `A`, rad/s, in no particular order.
    ///
    /// # Errors
    /// The QR iteration did not converge.
    pub fn poles(&self) -> Result<[Complex<f64>; N], ModelError> {
        eigenvalues(&self.a)
    }

    /// The system seen through a sampler and a zero-order hold of `period` in s, exact at the samples:
    ///
    /// `x(t + T) = e^(A T) x(t) + (integral from 0 to T of e^(A s) ds) B u`
    ///
    /// # Errors
    /// A period that is not positive and finite, or as [`zero_order_hold`].
    ///
    /// # References
    /// C. F. Van Loan, "Computing integrals involving the matrix exponential", IEEE Transactions on Automatic
    /// Control 23 (1978), doi:10.1109/TAC.1978.1101743.
    pub fn discretise(&self, period: f64) -> Result<DiscreteStateSpace<N, M, P>, ModelError> {
        if !(period > 0.0 && period.is_finite()) {
            return Err(ModelError::Parameter {
                parameter: "the period in s",
                range: "positive and finite",
                value: period,
            });
        }
        let transition = zero_order_hold(&self.a, &self.b, period)?;
        Ok(DiscreteStateSpace::from_parts(transition, self.c, self.d, period))
    }
}

impl<const N: usize, const M: usize, const P: usize> Plant<N, M> for StateSpace<N, M, P> {
    fn derivative(&self, state: &SVector<f64, N>, input: &SVector<f64, M>) -> SVector<f64, N> {
        self.a * state + self.b * input
    }
}

impl<const N: usize, const M: usize, const P: usize> HeldLinear<N, M> for StateSpace<N, M, P> {
    fn transition(&self, interval: f64) -> Result<Transition<N, M>, ModelError> {
        zero_order_hold(&self.a, &self.b, interval)
    }
}

pub(crate) fn finite<const R: usize, const C: usize>(
    name: &'static str,
    matrix: &SMatrix<f64, R, C>,
) -> Result<(), ModelError> {
    for (column, entries) in matrix.column_iter().enumerate() {
        for (row, &value) in entries.iter().enumerate() {
            if !value.is_finite() {
                return Err(ModelError::Entry { matrix: name, row, column, value });
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{matrix, vector};

    fn oscillator() -> StateSpace<2, 1, 1> {
        StateSpace::new(matrix![0.0, 1.0; -25.0, -6.0], matrix![0.0; 2.0], matrix![3.0, 0.5], matrix![0.25])
            .expect("finite")
    }

    #[test]
    fn derivative_and_output_by_hand() {
        let (x, u) = (vector![2.0, -1.0], vector![4.0]);
        assert_eq!(oscillator().derivative(&x, &u), vector![-1.0, -50.0 + 6.0 + 8.0]);
        assert_eq!(oscillator().output(&x, &u), vector![6.0 - 0.5 + 1.0]);
    }

    #[test]
    fn poles_solve_the_characteristic_equation() {
        let mut poles = oscillator().poles().expect("converges");
        poles.sort_by(|p, q| p.im.total_cmp(&q.im));
        for (pole, im) in poles.into_iter().zip([-4.0, 4.0]) {
            assert!((pole - Complex::new(-3.0, im)).norm() < 1e-14);
        }
    }

    #[test]
    fn a_bad_entry_is_named() {
        let error = StateSpace::new(
            matrix![0.0, 1.0; f64::NEG_INFINITY, 0.0],
            matrix![0.0; 1.0],
            matrix![1.0, 0.0],
            matrix![0.0],
        );
        let entry = ModelError::Entry { matrix: "A", row: 1, column: 0, value: f64::NEG_INFINITY };
        assert_eq!(error, Err(entry));
        for period in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(matches!(oscillator().discretise(period), Err(ModelError::Parameter { .. })));
        }
    }
}
