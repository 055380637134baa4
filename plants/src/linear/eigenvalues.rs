//! Eigenvalues of small matrices.

use nalgebra::{
    Complex, DMatrix, DVector, SMatrix, linalg::Schur, linalg::balancing::balance_parlett_reinsch,
};
use profiles::Real;

use crate::error::ModelError;

const ITERATIONS: usize = 2_000;

/// The eigenvalues of a matrix, in no particular order.
///
/// The matrix is balanced first, so that the units of its states do not cost digits. An eigenvalue that is repeated
/// `k` times is found to the `k`-th root of the machine precision: a delay line of two periods has its zeros to 1e-8.
///
/// # Errors
/// An entry that is not finite, or a QR iteration that does not converge.
///
/// ```
/// use plants::{eigenvalues, nalgebra::{self, matrix}};
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
    let mut values = [Complex::new(0.0, 0.0); N];
    let found = eigenvalues_of(&DMatrix::from_fn(N, N, |i, j| matrix[(i, j)]))?;
    for (value, found) in values.iter_mut().zip(found) {
        *value = found;
    }
    Ok(values)
}

/// The eigenvalues of a square matrix of any size with finite entries; conjugate ones stand side by side.
pub(crate) fn eigenvalues_of(matrix: &DMatrix<f64>) -> Result<Vec<Complex<f64>>, ModelError> {
    let (size, largest) = (matrix.nrows(), matrix.amax());
    if largest <= 0.0 {
        return Ok(vec![Complex::new(0.0, 0.0); size]);
    }
    // With the largest entry at one, no square inside over- or underflows that matters.
    let mut unit = matrix.map(|entry| entry / largest);
    balance_parlett_reinsch(&mut unit);
    let schur = Schur::try_new(unit.clone(), f64::EPSILON, ITERATIONS)
        .or_else(|| Schur::try_new(reflected(&unit), f64::EPSILON, ITERATIONS))
        .ok_or(ModelError::Eigenvalues { size })?;
    // A block that was split by no rotation may hold a double real root, whose discriminant rounds to above zero.
    let finite =
        |value: &Complex<f64>| Complex::new(value.re, if value.im.is_nan() { 0.0 } else { value.im });
    Ok(schur.complex_eigenvalues().iter().map(|value| finite(value) * largest).collect())
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
    use nalgebra::{Matrix3, matrix};

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
        // Eigenvalues 2 and 2 +- sqrt(2), in states sixteen decades apart.
        let (three, unit) = (matrix![2.0, 1.0, 0.0; 1.0, 2.0, 1.0; 0.0, 1.0, 2.0], [1.0, 1e8, 1e-8]);
        let scaled = Matrix3::from_fn(|i, j| three[(i, j)] * unit[j] / unit[i]);
        let mut found = eigenvalues(&scaled).expect("converges").map(|value| value.re);
        found.sort_by(f64::total_cmp);
        for (value, expected) in found.into_iter().zip([2.0 - 2.0_f64.sqrt(), 2.0, 2.0 + 2.0_f64.sqrt()]) {
            assert!((value - expected).abs() < 1e-13);
        }
    }

    /// Every state takes the place of the one before, the first that of the last times `feedback`.
    fn shift<const N: usize>(feedback: f64) -> SMatrix<f64, N, N> {
        SMatrix::from_fn(|i, j| {
            if i == j + 1 {
                -1.0
            } else if i == 0 && j == N - 1 {
                feedback
            } else {
                0.0
            }
        })
    }

    #[test]
    fn cyclic_shifts() {
        // The plain iteration stands still on the even ones.
        let radii = [
            spectral_radius(&shift::<3>(1.0)),
            spectral_radius(&shift::<4>(-1.0)),
            spectral_radius(&shift::<6>(1.0)),
            spectral_radius(&shift::<8>(-1.0)),
        ];
        for radius in radii {
            assert!((radius.expect("converges") - 1.0).abs() < 1e-14);
        }
    }

    #[test]
    fn delay_lines() {
        // The cube root of the machine precision is 6e-6.
        for radius in [spectral_radius(&shift::<3>(0.0)), spectral_radius(&shift::<4>(0.0))] {
            assert!(radius.expect("converges") < 2e-5);
        }
    }

    #[test]
    fn a_bad_entry_is_named() {
        let error = eigenvalues(&matrix![1.0, f64::NAN; 0.0, 1.0]);
        assert!(matches!(error, Err(ModelError::Entry { row: 0, column: 1, .. })));
    }
}
