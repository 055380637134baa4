//! The transfer function of a state space.

use nalgebra::{Complex, DMatrix, DVector, linalg::balancing::balance_parlett_reinsch};

use super::TransferFunction;
use crate::error::ModelError;
use crate::linear::eigenvalues_of;
use crate::models::StateSpace;

impl TransferFunction {
    /// The transfer function from an input to an output of a state space, both counted from zero.
    ///
    /// The poles are the eigenvalues of `A`, all of them: what the input does not reach or the output does not see is
    /// a pole and a zero at the same place. The zeros are those of
    ///
    /// `[[A - s I, B], [C, D]]`
    ///
    /// by orthogonal reductions, one for each pole in excess. Poles and zeros that are repeated `k` times are found to
    /// the `k`-th root of the machine precision, unless the matrix shows them in its diagonal as that of
    /// [`to_state_space`](Self::to_state_space) does.
    ///
    /// # Errors
    /// An input or output that the system does not have, or a QR iteration that does not converge.
    ///
    /// # References
    /// A. Emami-Naeini and P. Van Dooren, "Computation of zeros of linear multivariable systems", Automatica 18
    /// (1982), doi:10.1016/0005-1098(82)90070-X.
    pub fn from_state_space<const N: usize, const M: usize, const P: usize>(
        system: &StateSpace<N, M, P>,
        input: usize,
        output: usize,
    ) -> Result<Self, ModelError> {
        for (kind, index, count) in [("input", input, M), ("output", output, P)] {
            if index >= count {
                return Err(ModelError::Channel { kind, index, count });
            }
        }
        let a = DMatrix::from_fn(N, N, |i, j| system.a()[(i, j)]);
        let poles = if N > 0 { eigenvalues_of(&a)? } else { Vec::new() };
        let b = DVector::from_fn(N, |i, _| system.b()[(i, input)]);
        let c = DVector::from_fn(N, |j, _| system.c()[(output, j)]);
        let (zeros, gain) = zeros(a, b, c, system.d()[(output, input)])?;
        Self::new(&zeros, &poles, gain)
    }
}

/// The zeros and the gain of the highest powers.
fn zeros(
    mut a: DMatrix<f64>,
    mut b: DVector<f64>,
    mut c: DVector<f64>,
    d: f64,
) -> Result<(Vec<Complex<f64>>, f64), ModelError> {
    let size = a.nrows();
    let zero = Ok((Vec::new(), 0.0));
    if size == 0 {
        return Ok((Vec::new(), d));
    }
    // Balanced with input and output as one more state, so that what passes on from state to state is of one size,
    // and in units in which the matrices are of the size of one: rounding is told from what is not zero.
    let mut whole = DMatrix::zeros(size + 1, size + 1);
    whole.view_mut((0, 0), (size, size)).copy_from(&a);
    whole.view_mut((0, size), (size, 1)).copy_from(&b);
    whole.view_mut((size, 0), (1, size)).copy_from(&c.transpose());
    balance_parlett_reinsch(&mut whole);
    a.copy_from(&whole.view((0, 0), (size, size)));
    b.copy_from(&whole.view((0, size), (size, 1)));
    c.copy_from(&whole.view((size, 0), (1, size)).transpose());
    let or_one = |size: f64| if size > 0.0 { size } else { 1.0 };
    let (rate, drive, sight) = (or_one(a.amax()), or_one(b.amax()), or_one(c.amax()));
    a /= rate;
    b /= drive;
    c /= sight;
    let mut direct = d / sight / drive * rate;
    let mut gain = sight * (drive / rate);
    // The first D is as it was given; the later ones are sums of so many terms, in a direction that is known the less
    // the smaller the row is that it comes from.
    let (mut negligible, rounding) = (0.0, 16.0 * size as f64 * f64::EPSILON);
    while direct.abs() <= negligible {
        let n = a.nrows();
        let norm = c.norm();
        if n == 0 || norm <= negligible {
            return zero;
        }
        negligible = rounding + negligible / norm;
        // Reflected so that the output sees the last state alone: an output of zero holds that state, and what moves
        // it becomes the next output.
        let last = n - 1;
        let mut mirror = c.clone();
        let sign = 1.0_f64.copysign(c[last]);
        mirror[last] += sign * norm;
        let length = mirror.norm_squared();
        reflect(&mut a, &mut b, &mirror, 2.0 / length);
        gain *= -sign * norm * rate;
        direct = b[last];
        c = a.row(last).columns(0, last).transpose();
        a = a.view((0, 0), (last, last)).into_owned();
        b = b.rows(0, last).into_owned();
    }
    gain *= direct;
    if !gain.is_finite() {
        return Err(ModelError::Parameter { parameter: "the gain", range: "finite", value: gain });
    }
    if a.nrows() == 0 {
        return Ok((Vec::new(), gain));
    }
    let held = a - (b / direct) * c.transpose();
    if !held.iter().all(|entry| entry.is_finite()) {
        return Err(ModelError::Parameter {
            parameter: "the ratio of the poles' to the zeros' size",
            range: "finite",
            value: f64::INFINITY,
        });
    }
    let found = eigenvalues_of(&held)?.into_iter().map(|root| root * rate).collect();
    Ok((found, gain))
}

/// `H A H` and `H b` with `H = I - factor v v^T`.
fn reflect(a: &mut DMatrix<f64>, b: &mut DVector<f64>, v: &DVector<f64>, factor: f64) {
    let row = a.tr_mul(v);
    *a -= v * row.transpose() * factor;
    let column = &*a * v;
    *a -= column * v.transpose() * factor;
    let along = v.dot(b) * factor;
    *b -= v * along;
}
