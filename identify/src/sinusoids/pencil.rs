//! Starting poles by a matrix pencil.

use faer::{Mat, Side, linalg::solvers::Solve};
use profiles::{Complex, Real};

use super::basis::Pole;

/// The poles of every order up to `most` that the dominant subspace of the data suggests.
///
/// Rows of the data matrix are shifted by one sample, so its left singular vectors `U` obey
/// `U(1..) = U(..M) P` with the eigenvalues of `P` as poles. Columns are shifted by lags that need not be even: a
/// lag drawn from each of at most 64 equal parts of a third of the record keeps the resolution of the full matrix
/// without its size and, unlike decimation, tells all frequencies apart.
///
/// # References
/// Y. Hua and T. K. Sarkar, "Matrix pencil method for estimating parameters of exponentially damped/undamped
/// sinusoids in noise", IEEE Trans. ASSP 38 (1990), doi:10.1109/29.56027.
pub(super) fn starts(y: &[f64], most: usize) -> Vec<Vec<Pole>> {
    subspace(y, most).map_or_else(Vec::new, |u| {
        let (rows, most) = (u.nrows() - 1, u.ncols());
        let (now, next) = (u.subrows(0, rows), u.subrows(1, rows));
        let (gram, shifted) = (now.transpose() * now, now.transpose() * next);
        (1..=most)
            .filter_map(|order| {
                let block = |m: &Mat<f64>| m.submatrix(0, 0, order, order).to_owned();
                let pencil = block(&gram).partial_piv_lu().solve(block(&shifted));
                let finite = (0..order).all(|j| (0..order).all(|i| pencil[(i, j)].is_finite()));
                let values = if finite { pencil.eigenvalues().ok()? } else { return None };
                Some(
                    values
                        .iter()
                        .filter_map(|z| pole(Complex::new(z.re, z.im)))
                        .map(|p| p.bounded(y.len()))
                        .collect(),
                )
            })
            .collect()
    })
}

/// The pole of an eigenvalue; none for the lower half of a pair and for what alternates from sample to sample or is
/// gone after one.
fn pole(z: Complex<f64>) -> Option<Pole> {
    let size = Real::sqrt(z.re * z.re + z.im * z.im);
    if size.is_nan() || size <= 0.05 || z.im < 0.0 {
        return None;
    }
    let decay = -Real::ln(size);
    if z.im > 0.0 {
        Some(Pole::Pair { decay, turn: Real::atan2(z.im, z.re) })
    } else {
        (z.re > 0.0).then_some(Pole::Real { decay })
    }
}

/// Dominant left singular vectors of the data matrix, the strongest first; none for data of zeros.
fn subspace(y: &[f64], most: usize) -> Option<Mat<f64>> {
    const LAGS: usize = 64;
    // The golden ratio's fractions are spread evenly and have no period.
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let span = y.len() / 3;
    let count = LAGS.min(span);
    let rows = y.len() - span;
    let width = span as f64 / count as f64;
    let lag = |j: usize| {
        let jitter = Real::max(width - 1.0, 0.0) * (GOLDEN * j as f64).fract();
        (j as f64 * width + jitter) as usize
    };
    let lags: Vec<usize> = (0..count).map(lag).collect();
    let data = Mat::from_fn(rows, count, |i, j| y[i + lags[j]]);
    let gram = data.transpose() * &data;
    let eigen = gram.self_adjoint_eigen(Side::Lower).ok()?;
    let (values, vectors) = (eigen.S().column_vector(), eigen.U());
    let largest = values[count - 1];
    if largest.is_nan() || largest <= 0.0 {
        return None;
    }
    // The square of the data has half their digits: below, directions are rounding.
    let order = (0..most.min(count)).take_while(|k| values[count - 1 - k] > 1e-14 * largest).count();
    let chosen = Mat::from_fn(count, order, |i, k| {
        let at = count - 1 - k;
        vectors[(i, at)] / values[at].sqrt()
    });
    Some(&data * &chosen)
}
