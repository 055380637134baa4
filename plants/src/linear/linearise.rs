//! Linear models of nonlinear plants.

use nalgebra::{SMatrix, SVector};

use crate::error::ModelError;
use crate::models::{Plant, StateSpace};

/// The plant near a point: `d x' = A dx + B du`, its output the state.
///
/// The matrices are central differences, of a width of `6e-6` times each component or of `6e-6` near zero: exact
/// to rounding for a linear plant, and to about ten digits for a smooth one in units of order one.
///
/// # Errors
/// A derivative that is not finite.
///
/// ```
/// use plants::{linearise, nalgebra::{self, SVector, vector}};
///
/// // A pendulum of 1 m hanging at rest swings with sqrt(g / l).
/// let pendulum = |x: &SVector<f64, 2>, u: &SVector<f64, 1>| vector![x[1], -9.81 * x[0].sin() + u[0]];
/// let hanging = linearise(&pendulum, &vector![0.0, 0.0], &vector![0.0])?;
/// assert!((hanging.poles()?[0].im.abs() - 9.81_f64.sqrt()).abs() < 1e-9);
/// # Ok::<(), plants::ModelError>(())
/// ```
pub fn linearise<const N: usize, const M: usize>(
    plant: &impl Plant<N, M>,
    state: &SVector<f64, N>,
    input: &SVector<f64, M>,
) -> Result<StateSpace<N, M, N>, ModelError> {
    let mut a = SMatrix::<f64, N, N>::zeros();
    for (j, mut column) in a.column_iter_mut().enumerate() {
        let (lower, upper, width) = neighbours(state, j);
        column.copy_from(&((plant.derivative(&upper, input) - plant.derivative(&lower, input)) / width));
    }
    let mut b = SMatrix::<f64, N, M>::zeros();
    for (j, mut column) in b.column_iter_mut().enumerate() {
        let (lower, upper, width) = neighbours(input, j);
        column.copy_from(&((plant.derivative(state, &upper) - plant.derivative(state, &lower)) / width));
    }
    StateSpace::new(a, b, SMatrix::identity(), SMatrix::zeros())
}

/// The points on both sides of `point` along component `j`, and their exact distance.
fn neighbours<const K: usize>(point: &SVector<f64, K>, j: usize) -> (SVector<f64, K>, SVector<f64, K>, f64) {
    // The cube root of the machine epsilon balances truncation and rounding.
    let half = 6e-6 * point[j].abs().max(1.0);
    let (mut lower, mut upper) = (*point, *point);
    lower[j] -= half;
    upper[j] += half;
    let width = upper[j] - lower[j];
    (lower, upper, width)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{matrix, vector};

    #[test]
    fn a_linear_plant_gives_its_matrices() {
        let system = StateSpace::new(
            matrix![0.0, 1.0; -25.0, -6.0],
            matrix![0.0; 2.0],
            matrix![1.0, 0.0],
            matrix![0.0],
        )
        .expect("finite");
        let found = linearise(&system, &vector![3.0, -200.0], &vector![0.5]).expect("finite");
        // Differences of numbers near 1e3 over a width of 1e-5.
        assert!((found.a() - system.a()).amax() < 1e-7);
        assert!((found.b() - system.b()).amax() < 1e-7);
    }

    #[test]
    fn a_product_gives_its_partial_derivatives() {
        let plant = |x: &SVector<f64, 1>, u: &SVector<f64, 2>| vector![x[0] * x[0] * u[1] - u[0].exp()];
        let found = linearise(&plant, &vector![3.0], &vector![0.5, 2.0]).expect("finite");
        assert!((found.a()[(0, 0)] - 12.0).abs() < 1e-8);
        assert!((found.b()[(0, 0)] + 0.5_f64.exp()).abs() < 1e-8);
        assert!((found.b()[(0, 1)] - 9.0).abs() < 1e-8);
        let pole = |x: &SVector<f64, 1>, _: &SVector<f64, 1>| vector![(x[0] - 1.0).sqrt()];
        assert!(linearise(&pole, &vector![0.0], &vector![0.0]).is_err());
    }
}
