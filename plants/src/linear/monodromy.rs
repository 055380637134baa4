//! The matrix of a sampled loop, from the code of one tick.

use nalgebra::{SMatrix, SVector};

/// The matrix `M` of a sampled loop `x[k+1] = M x[k] + m`, found by running `tick`, the code of one period, from
/// zero and from every unit vector.
///
/// The state is everything that survives a tick: that of the plant, the memory of the controller, inputs computed
/// but not yet applied. For a loop with several rates a tick is the longest of its periods. Exact to rounding for
/// a loop that is linear or has a constant offset; a saturated or quantised one must be given unsaturated. The
/// loop is unstable when [`spectral_radius`](crate::spectral_radius) of the result exceeds one.
///
/// ```
/// use plants::{monodromy, spectral_radius, nalgebra::{self, vector}};
///
/// // A mass of 1 kg under a sampled P controller, x' = v, v' = -k x: no gain makes it stable.
/// let (k, t) = (100.0, 0.01);
/// let tick = |x: &plants::nalgebra::SVector<f64, 2>| {
///     let force = -k * x[0];
///     vector![x[0] + x[1] * t + force * t * t / 2.0, x[1] + force * t]
/// };
/// assert!(spectral_radius(&monodromy(tick))? > 1.0);
/// # Ok::<(), plants::ModelError>(())
/// ```
pub fn monodromy<const N: usize>(
    mut tick: impl FnMut(&SVector<f64, N>) -> SVector<f64, N>,
) -> SMatrix<f64, N, N> {
    let offset = tick(&SVector::zeros());
    let mut matrix = SMatrix::<f64, N, N>::zeros();
    for (j, mut column) in matrix.column_iter_mut().enumerate() {
        let mut unit = SVector::<f64, N>::zeros();
        unit[j] = 1.0;
        column.copy_from(&(tick(&unit) - offset));
    }
    matrix
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear::spectral_radius;
    use nalgebra::{matrix, vector};

    #[test]
    fn an_affine_map_gives_its_matrix() {
        let m = matrix![1.0, 2.0; -3.0, 0.5];
        assert_eq!(monodromy(|x| m * x + vector![8.0, -4.0]), m);
    }

    #[test]
    fn stability_limit_of_a_delayed_integrator() {
        // x+ = x - g u, u+ = x: z^2 - z + g = 0 leaves the unit circle at g = 1.
        let radius = |gain: f64| {
            spectral_radius(&monodromy(|x: &SVector<f64, 2>| vector![x[0] - gain * x[1], x[0]]))
                .expect("converges")
        };
        assert!(radius(0.999) < 1.0);
        assert!(radius(1.001) > 1.0);
        assert!((radius(1.0) - 1.0).abs() < 1e-15);
    }
}
