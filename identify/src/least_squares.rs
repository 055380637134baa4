//! Linear least squares by the triangle of an orthogonal decomposition, and a step of a nonlinear one.

use faer::{Mat, MatRef};

/// The triangle of the orthogonal decomposition of some columns of `samples` entries each.
pub(crate) fn triangle(entries: &[f64], samples: usize) -> Mat<f64> {
    let columns = entries.len() / samples;
    MatRef::from_column_major_slice(entries, samples, columns).qr().thin_R().to_owned()
}

/// Solves the triangle of `size` rows from `start` on against a column of the same matrix; none if it is singular.
pub(crate) fn back_substitute(r: &Mat<f64>, start: usize, size: usize, column: usize) -> Option<Vec<f64>> {
    let mut x = vec![0.0; size];
    for i in (0..size).rev() {
        let row = start + i;
        let known: f64 = x.iter().enumerate().skip(i + 1).map(|(j, x)| r[(row, start + j)] * x).sum();
        let norm = (0..=row).map(|k| r[(k, row)].abs()).fold(0.0, f64::max);
        // Columns that agree to fourteen digits are one.
        if r[(row, row)].abs() <= 1e-14 * norm {
            return None;
        }
        x[i] = (r[(row, column)] - known) / r[(row, row)];
    }
    x.iter().all(|x| x.is_finite()).then_some(x)
}

/// What a combination of columns leaves of the data.
pub(crate) fn left(entries: &[f64], amplitudes: &[f64], y: &[f64]) -> Vec<f64> {
    let mut left = y.to_vec();
    for (column, amplitude) in entries.chunks_exact(y.len()).zip(amplitudes) {
        left.iter_mut().zip(column).for_each(|(left, entry)| *left -= amplitude * entry);
    }
    left
}

/// The step that lowers the linearised sum of squares, damped in the scale of each column: `r` is the triangle of the
/// derivatives with the residual as its last column.
pub(crate) fn damped_step(r: &Mat<f64>, damping: f64) -> Option<Vec<f64>> {
    let size = r.ncols() - 1;
    let root = damping.sqrt();
    let scale = |j: usize| root * (0..=j).map(|i| r[(i, j)] * r[(i, j)]).sum::<f64>().sqrt();
    let augmented = Mat::from_fn(2 * size, size + 1, |i, j| {
        if i < size {
            r[(i, j)]
        } else if i - size == j {
            scale(j)
        } else {
            0.0
        }
    });
    back_substitute(&augmented.qr().thin_R().to_owned(), 0, size, size)
}

/// The inverse of `R^T R` for the first `size` columns of a triangle; none if it is singular.
pub(crate) fn inverse_square(r: &Mat<f64>, size: usize) -> Option<Mat<f64>> {
    let mut columns = Vec::with_capacity(size);
    for unit in 0..size {
        let wide =
            Mat::from_fn(
                size,
                size + 1,
                |i, j| {
                    if j < size { r[(i, j)] } else { f64::from(u8::from(i == unit)) }
                },
            );
        columns.push(back_substitute(&wide, 0, size, size)?);
    }
    Some(Mat::from_fn(size, size, |i, j| columns.iter().map(|column| column[i] * column[j]).sum()))
}
