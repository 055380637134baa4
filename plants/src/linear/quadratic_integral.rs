//! Integrals of quadratic forms along the motion of a linear system.

use nalgebra::{DMatrix, SMatrix, SVector, linalg::balancing::balance_parlett_reinsch};

use super::transition::{check_interval, power_of_two_above};
use crate::error::ModelError;
use crate::models::finite;

/// A quadratic form in the state at the start of an interval and the input held over it,
/// `x^T state x + 2 x^T cross u + u^T input u`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct QuadraticIntegral<const N: usize, const M: usize> {
    /// Of the state alone.
    pub state: SMatrix<f64, N, N>,
    /// Of state and input.
    pub cross: SMatrix<f64, N, M>,
    /// Of the input alone.
    pub input: SMatrix<f64, M, M>,
}

impl<const N: usize, const M: usize> QuadraticIntegral<N, M> {
    /// The value of the form.
    #[inline]
    #[must_use]
    pub fn value(&self, state: &SVector<f64, N>, input: &SVector<f64, M>) -> f64 {
        (self.state * state + self.cross * input * 2.0).dot(state) + (self.input * input).dot(input)
    }
}

// The exponential of a matrix and its inverse side by side keep their digits where neither is large.
const SHORT: f64 = 0.5;

/// The integral of `x^T Q x` over `interval` in s of `x' = A x + B u` with `u` held.
///
/// With `z = [x, u]`, `z' = F z` and `Q` in the corner of the state, `W(t)`, the integral of `e^(F^T s) Q e^(F s)` over
/// `[0, t]`, is for a short `t` a block of one matrix exponential,
///
/// `exp([[-F^T, Q], [0, F]] t) = [[., e^(-F^T t) W(t)], [0, e^(F t)]]`
///
/// and doubles by `W(2 t) = W(t) + e^(F^T t) W(t) e^(F t)`, a sum of nonnegative forms where `Q` is one.
///
/// # Errors
/// As [`zero_order_hold`](crate::zero_order_hold), and an entry of `Q` that is not finite.
///
/// ```
/// use plants::{quadratic_integral, nalgebra::{self, matrix, vector}};
///
/// // x' = u from 2 with u = 3: the integral of (2 + 3 t)^2 over 1 s is 4 + 6 + 3.
/// let square = quadratic_integral(&matrix![0.0], &matrix![1.0], &matrix![1.0], 1.0)?;
/// assert!((square.value(&vector![2.0], &vector![3.0]) - 13.0).abs() < 1e-14);
/// # Ok::<(), plants::ModelError>(())
/// ```
///
/// # References
/// C. F. Van Loan, "Computing integrals involving the matrix exponential", IEEE Transactions on Automatic Control
/// 23 (1978), doi:10.1109/TAC.1978.1101743.
pub fn quadratic_integral<const N: usize, const M: usize>(
    a: &SMatrix<f64, N, N>,
    b: &SMatrix<f64, N, M>,
    q: &SMatrix<f64, N, N>,
    interval: f64,
) -> Result<QuadraticIntegral<N, M>, ModelError> {
    check_interval(a, interval)?;
    finite("Q", q)?;
    let largest = q.amax();
    if largest <= 0.0 || interval <= 0.0 {
        let (state, cross, input) = (SMatrix::zeros(), SMatrix::zeros(), SMatrix::zeros());
        return Ok(QuadraticIntegral { state, cross, input });
    }
    // States and inputs in units in which the dynamics are even, as for the transition.
    let mut balanced = DMatrix::from_fn(N, N, |i, j| a[(i, j)] * interval);
    let scale = balance_parlett_reinsch(&mut balanced);
    let scaled_b = SMatrix::<f64, N, M>::from_fn(|i, j| b[(i, j)] * interval / scale[i]);
    let norm = balanced.one_norm();
    let ratio = scaled_b.one_norm() / if norm > 0.0 { norm } else { 1.0 };
    let input_scale = power_of_two_above(ratio.min(1e300));
    let mut f = DMatrix::zeros(N + M, N + M);
    f.view_mut((0, 0), (N, N)).copy_from(&balanced);
    f.view_mut((0, N), (N, M)).copy_from(&(scaled_b / input_scale));
    let mut weight = DMatrix::zeros(N + M, N + M);
    for (i, j) in (0..N).flat_map(|i| (0..N).map(move |j| (i, j))) {
        weight[(i, j)] = 0.5 * (q[(i, j)] + q[(j, i)]) * scale[i] * scale[j];
    }
    let weight_scale = weight.amax();
    if !(f.iter().all(|x| x.is_finite()) && weight_scale.is_finite()) {
        return Err(ModelError::Range { interval });
    }
    let integral = doubled(&f, &(weight / weight_scale)) * weight_scale * interval;

    let result = QuadraticIntegral::<N, M> {
        state: SMatrix::from_fn(|i, j| integral[(i, j)] / (scale[i] * scale[j])),
        cross: SMatrix::from_fn(|i, j| integral[(i, N + j)] * (input_scale / scale[i])),
        input: SMatrix::from_fn(|i, j| integral[(N + i, N + j)] * input_scale * input_scale),
    };
    if result.state.iter().chain(&result.cross).chain(&result.input).all(|x| x.is_finite()) {
        Ok(result)
    } else {
        Err(ModelError::Range { interval })
    }
}

/// The integral of `e^(F^T s) Q e^(F s)` over `[0, 1]`.
fn doubled(f: &DMatrix<f64>, q: &DMatrix<f64>) -> DMatrix<f64> {
    let size = f.nrows();
    let mut norm = f.one_norm().max(f.transpose().one_norm());
    let (mut step, mut doublings) = (1.0, 0);
    while norm > SHORT {
        norm *= 0.5;
        step *= 0.5;
        doublings += 1;
    }
    let mut block = DMatrix::zeros(2 * size, 2 * size);
    block.view_mut((0, 0), (size, size)).copy_from(&(f.transpose() * -step));
    block.view_mut((0, size), (size, size)).copy_from(q);
    block.view_mut((size, size), (size, size)).copy_from(&(f * step));
    let exponential = block.exp();
    let mut motion = exponential.view((size, size), (size, size)).into_owned();
    let mut integral = motion.transpose() * exponential.view((0, size), (size, size)) * step;
    for _ in 0..doublings {
        integral += motion.transpose() * &integral * &motion;
        motion = &motion * &motion;
    }
    (&integral + integral.transpose()) * 0.5
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear::zero_order_hold;
    use nalgebra::{matrix, vector};

    /// Gauss-Legendre on five points, in `pieces` pieces.
    fn quadrature<const N: usize, const M: usize>(
        (a, b, q): (&SMatrix<f64, N, N>, &SMatrix<f64, N, M>, &SMatrix<f64, N, N>),
        (x, u): (&SVector<f64, N>, &SVector<f64, M>),
        interval: f64,
        pieces: u32,
    ) -> f64 {
        let nodes: [f64; 3] = [0.0, 0.538_469_310_105_683_1, 0.906_179_845_938_664];
        let weights = [0.568_888_888_888_888_9, 0.478_628_670_499_366_47, 0.236_926_885_056_189_08];
        let mut sum = 0.0;
        for piece in 0..pieces {
            for (node, weight) in nodes.iter().zip(weights) {
                for sign in if *node > 0.0 { &[-1.0, 1.0][..] } else { &[0.0][..] } {
                    let t = interval / f64::from(pieces) * (f64::from(piece) + 0.5 * (1.0 + sign * node));
                    let y = zero_order_hold(a, b, t).expect("finite").apply(x, u);
                    sum += 0.5 * weight * interval / f64::from(pieces) * (q * y).dot(&y);
                }
            }
        }
        sum
    }

    #[test]
    fn quadrature_of_an_oscillator() {
        for w in [1.0, 300.0, 2e4] {
            let (a, b) = (matrix![0.0, 1.0; -w * w, -0.2 * w], matrix![0.0, 0.0; 7.0, -0.01 * w * w]);
            let q = matrix![3.0 * w * w, 0.5 * w; 0.5 * w, 2.0];
            let (x, u) = (vector![1.0 / w, -0.7], vector![0.1 * w, 0.3 / w]);
            for phase in [1e-3, 0.4, 6.0] {
                let exact = quadratic_integral(&a, &b, &q, phase / w).expect("finite").value(&x, &u);
                // Ten points on at most a radian and a half: exact to rounding.
                let sum = quadrature((&a, &b, &q), (&x, &u), phase / w, 24);
                assert!((exact - sum).abs() <= 1e-13 * sum, "{exact} {sum}");
            }
        }
    }

    #[test]
    fn a_decay_over_thousands_of_time_constants() {
        // x' = -k x from one: the integral of x^2 is 1 / (2 k), however long.
        for (rate, interval) in [(1e5, 1.0), (3.0, 1e3), (1e3, 1e6)] {
            let form =
                quadratic_integral(&matrix![-rate], &matrix![0.0], &matrix![2.0], interval).expect("finite");
            let value = form.value(&vector![1.0], &vector![0.0]);
            assert!((value * rate - 1.0).abs() < 1e-12, "{value}");
        }
    }

    #[test]
    fn a_double_integrator_in_closed_form() {
        // v = v0 + a t: the integral of v^2 is v0^2 T + v0 a T^2 + a^2 T^3 / 3.
        let (a, b, q) = (matrix![0.0, 1.0; 0.0, 0.0], matrix![0.0; 1.0], matrix![0.0, 0.0; 0.0, 1.0]);
        for (t, v, u) in [(1e-4, 0.3, -2e4), (2.0, -1.0, 0.25)] {
            let form = quadratic_integral(&a, &b, &q, t).expect("finite");
            let exact = v * v * t + v * u * t * t + u * u * t * t * t / 3.0;
            assert!((form.value(&vector![9.0, v], &vector![u]) - exact).abs() <= 1e-14 * exact.abs());
        }
    }

    #[test]
    fn nothing_and_too_much() {
        let one = matrix![1.0];
        let nothing = quadratic_integral(&one, &one, &matrix![0.0], 2.0).expect("finite");
        assert!(nothing.value(&vector![1.0], &vector![1.0]).abs() <= 0.0);
        assert!(matches!(quadratic_integral(&one, &one, &one, -1.0), Err(ModelError::Parameter { .. })));
        assert!(matches!(quadratic_integral(&one, &one, &one, 1e3), Err(ModelError::Range { .. })));
        assert!(matches!(
            quadratic_integral(&(one * 1e12), &one, &one, 1.0),
            Err(ModelError::TooStiff { .. })
        ));
        let error = quadratic_integral(&one, &one, &(one * f64::NAN), 1.0);
        assert!(matches!(error, Err(ModelError::Entry { matrix: "Q", .. })));
    }
}
