//! Eigenvalues of small matrices.

use nalgebra::{
    Complex, DMatrix, DVector, SMatrix, linalg::Schur, linalg::balancing::balance_parlett_reinsch,
};
use profiles::Real;

use crate::error::ModelError;

const ITERATIONS: usize = 2_000;

/// The eigenvalues of a matrix, in no particular order.
///
/// # Errors
/// An entry that is not finite, or a QR iteration that does not converge.
///
/// ```
/// use plants::{eigenvalues, nalgebra::matrix};
///
/// let [p, q] = eigenvalues(&matrix![0.0, 1.0; -25.0, -6.0])?;
/// assert!(((p + q).re + 6.0).abs() < 1e-13 && ((p * q).re - 25.0).abs() < 1e-13);
/// # Ok::<(), plants::ModelError>(())
/// ```
pub fn eigenvalues<const N: usize>(matrix: &SMatrix<f64, N, N>) -> Result<[Complex<f64>; N], ModelError> {
    for (column, entries) in matrix.column_iter().enumerate() {
        for (row, &value) in entries.iter().enumerate() {
            if !value.is_finite() {
                return Err(ModelError::Entry { matrix: "of eigenvalues", row, column, value });
            }
        }
    }
    let largest = matrix.amax();
    let mut values = [Complex::new(0.0, 0.0); N];
    if largest > 0.0 {
        // With the largest entry at one, no square inside over- or underflows that matters.
        let mut unit = DMatrix::from_fn(N, N, |i, j| matrix[(i, j)] / largest);
        balance_parlett_reinsch(&mut unit);
        let schur = Schur::try_new(unit.clone(), f64::EPSILON, ITERATIONS)
            .or_else(|| Schur::try_new(reflected(&unit), f64::EPSILON, ITERATIONS))
            .ok_or(ModelError::Eigenvalues { size: N })?;
        for (value, found) in values.iter_mut().zip(schur.complex_eigenvalues().iter()) {
            *value = found * largest;
        }
    }
    Ok(values)
}

/// A similar matrix, `H M H` with a reflection `H`: the QR iteration stands still on some orthogonal matrices.
fn reflected(matrix: &DMatrix<f64>) -> DMatrix<f64> {
    let size = matrix.nrows();
    let direction = DVector::from_fn(size, |i, _| 1.0 + i as f64).normalize();
    let reflection = DMatrix::identity(size, size) - &direction * direction.transpose() * 2.0;
    &reflection * matrix * &reflection
}

/// The largest magnitude of an eigenvalue; for a sampled loop, below one is stable and above one unstable.
///
/// # Errors
/// As [`eigenvalues`].
pub fn spectral_radius<const N: usize>(matrix: &SMatrix<f64, N, N>) -> Result<f64, ModelError> {
    let values = eigenvalues(matrix)?;
    Ok(values.iter().fold(0.0, |largest, value| Real::max(largest, magnitude(*value))))
}

fn magnitude(value: Complex<f64>) -> f64 {
    let (large, small) = (value.re.abs().max(value.im.abs()), value.re.abs().min(value.im.abs()));
    if large > 0.0 { large * Real::sqrt(1.0 + (small / large) * (small / large)) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Matrix3, Matrix4, matrix};

    #[test]
    fn known_spectra() {
        let triangular = matrix![3.0, 1e6, -2.0; 0.0, -5.0, 1e-6; 0.0, 0.0, 0.5];
        assert!((spectral_radius(&triangular).expect("converges") - 5.0).abs() < 1e-14);
        assert!(spectral_radius(&Matrix3::zeros()).expect("zero") <= 0.0);
        assert!((spectral_radius(&matrix![-7.5]).expect("one entry") - 7.5).abs() < 1e-14);
        let turn = matrix![0.6, -0.8; 0.8, 0.6] * 1.25;
        assert!((spectral_radius(&turn).expect("converges") - 1.25).abs() < 1e-14);
    }

    #[test]
    fn scale_does_not_matter() {
        for scale in [1e-200, 1e-12, 1e12, 1e200] {
            let radius = spectral_radius(&(matrix![0.0, 1.0; -25.0, -6.0] * scale)).expect("converges");
            assert!((radius / scale - 5.0).abs() < 1e-13);
        }
    }

    #[test]
    fn badly_scaled_units() {
        // A mode of 1e4 rad/s in metres and micrometres per second.
        let mode = matrix![0.0, 1e-6; -1e14, -200.0];
        assert!((spectral_radius(&mode).expect("converges") / 1e4 - 1.0).abs() < 1e-13);
    }

    #[test]
    fn cyclic_shifts_and_delay_lines() {
        let cycle: Matrix4<f64> = matrix![0., 0., 0., 1.; 1., 0., 0., 0.; 0., 1., 0., 0.; 0., 0., 1., 0.];
        assert!((spectral_radius(&cycle).expect("converges") - 1.0).abs() < 1e-14);
        let cycle3 = matrix![0., 0., 1.; 1., 0., 0.; 0., 1., 0.];
        assert!((spectral_radius(&cycle3).expect("converges") - 1.0).abs() < 1e-14);
        let line: Matrix4<f64> = matrix![0., 0., 0., 0.; 1., 0., 0., 0.; 0., 1., 0., 0.; 0., 0., 1., 0.];
        assert!(spectral_radius(&line).expect("converges") < 1e-3);
    }

    #[test]
    fn a_bad_entry_is_named() {
        let error = eigenvalues(&matrix![1.0, f64::NAN; 0.0, 1.0]);
        assert!(matches!(error, Err(ModelError::Entry { row: 0, column: 1, .. })));
    }
}
