//! Exact motion of a linear system under a held input.

use nalgebra::{DMatrix, SMatrix, SVector, linalg::balancing::balance_parlett_reinsch};

use crate::error::ModelError;

/// The motion of a linear system over one interval under a held input: `x+ = Phi x + Gamma u`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Transition<const N: usize, const M: usize> {
    /// `Phi`, what becomes of the state.
    pub state: SMatrix<f64, N, N>,
    /// `Gamma`, what a held input of one adds.
    pub input: SMatrix<f64, N, M>,
}

impl<const N: usize, const M: usize> Transition<N, M> {
    /// The state after the interval: `Phi x + Gamma u`.
    #[inline]
    #[must_use]
    pub fn apply(&self, state: &SVector<f64, N>, input: &SVector<f64, M>) -> SVector<f64, N> {
        self.state * state + self.input * input
    }
}

// Beyond this the norm estimates inside the matrix exponential, up to the 27th power, overflow.
const LARGEST_NORM: f64 = 1e11;

/// The exact transition of `x' = A x + B u` over `interval` in s with `u` held.
///
/// Both matrices are blocks of one matrix exponential:
///
/// `exp([[A, B], [0, 0]] T) = [[Phi, Gamma], [0, I]]`
///
/// computed after scaling states and inputs by powers of two, so that units do not cost digits. For `N + M > 5`
/// the matrix products underneath pick their instructions by processor, so the last bits may depend on it.
///
/// # Errors
/// An interval that is negative or not finite, dynamics with `|A| T` beyond 1e11 in the 1-norm, or a result
/// beyond the range of double precision.
///
/// # References
/// C. F. Van Loan, "Computing integrals involving the matrix exponential", IEEE Transactions on Automatic Control
/// 23 (1978), doi:10.1109/TAC.1978.1101743. A. H. Al-Mohy and N. J. Higham, "A new scaling and squaring algorithm
/// for the matrix exponential", SIAM Journal on Matrix Analysis and Applications 31 (2009), doi:10.1137/09074721X.
pub fn zero_order_hold<const N: usize, const M: usize>(
    a: &SMatrix<f64, N, N>,
    b: &SMatrix<f64, N, M>,
    interval: f64,
) -> Result<Transition<N, M>, ModelError> {
    let (state, input) = held_transition(
        &DMatrix::from_fn(N, N, |i, j| a[(i, j)]),
        &DMatrix::from_fn(N, M, |i, j| b[(i, j)]),
        interval,
    )?;
    Ok(Transition {
        state: SMatrix::from_fn(|i, j| state[(i, j)]),
        input: SMatrix::from_fn(|i, j| input[(i, j)]),
    })
}

/// `Phi` and `Gamma` of matrices of any size, see [`zero_order_hold`].
pub(crate) fn held_transition(
    a: &DMatrix<f64>,
    b: &DMatrix<f64>,
    interval: f64,
) -> Result<(DMatrix<f64>, DMatrix<f64>), ModelError> {
    check_length(interval)?;
    let scaled = a * interval;
    let norm = if scaled.is_empty() { 0.0 } else { scaled.one_norm() };
    if !scaled.iter().all(|x| x.is_finite()) || norm > LARGEST_NORM {
        return Err(ModelError::TooStiff { interval, norm });
    }
    let (state, input) = if norm > 0.0 {
        exponential(&scaled, &(b * interval))
    } else {
        (DMatrix::identity(a.nrows(), a.nrows()), b * interval)
    };
    if state.iter().chain(input.iter()).all(|x| x.is_finite()) {
        Ok((state, input))
    } else {
        Err(ModelError::Range { interval })
    }
}

/// The transition of `A T`, not zero, and `B T`; not finite where it has no representation.
fn exponential(a: &DMatrix<f64>, b: &DMatrix<f64>) -> (DMatrix<f64>, DMatrix<f64>) {
    let (n, m) = b.shape();
    let mut balanced = a.clone();
    let scale = balance_parlett_reinsch(&mut balanced);
    let scaled_b = DMatrix::from_fn(n, m, |i, j| b[(i, j)] / scale[i]);
    // Gamma is linear in B, so B may be brought below A: powers of a large B would overflow inside the exponential,
    // which then does not return.
    let input_scale = power_of_two_above((scaled_b.one_norm() / balanced.one_norm()).min(1e300));

    let mut augmented = DMatrix::zeros(n + m, n + m);
    augmented.view_mut((0, 0), (n, n)).copy_from(&balanced);
    augmented.view_mut((0, n), (n, m)).copy_from(&(scaled_b / input_scale));
    if !augmented.iter().all(|x| x.is_finite()) {
        return (DMatrix::identity(n, n), DMatrix::repeat(n, m, f64::INFINITY));
    }
    let exponential = augmented.exp();
    (
        DMatrix::from_fn(n, n, |i, j| exponential[(i, j)] * (scale[i] / scale[j])),
        DMatrix::from_fn(n, m, |i, j| exponential[(i, n + j)] * scale[i] * input_scale),
    )
}

/// Refuses an interval that is negative or not finite.
fn check_length(interval: f64) -> Result<(), ModelError> {
    if interval >= 0.0 && interval.is_finite() {
        Ok(())
    } else {
        Err(ModelError::Parameter {
            parameter: "the interval in s",
            range: "finite and not negative",
            value: interval,
        })
    }
}

/// The 1-norm of `A T`, of an interval over which the exponential can be computed.
pub(super) fn check_interval<const N: usize>(
    a: &SMatrix<f64, N, N>,
    interval: f64,
) -> Result<f64, ModelError> {
    check_length(interval)?;
    let scaled_a = a * interval;
    let norm = scaled_a.one_norm();
    if !scaled_a.iter().all(|x| x.is_finite()) || norm > LARGEST_NORM {
        return Err(ModelError::TooStiff { interval, norm });
    }
    Ok(norm)
}

/// The smallest power of two above `ratio`, at least one.
pub(super) fn power_of_two_above(ratio: f64) -> f64 {
    const MANTISSA: u32 = f64::MANTISSA_DIGITS - 1;
    if ratio < 1.0 { 1.0 } else { f64::from_bits(((ratio.to_bits() >> MANTISSA) + 1) << MANTISSA) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Matrix2, Vector2, matrix, vector};

    fn close<const R: usize, const C: usize>(
        got: &SMatrix<f64, R, C>,
        expected: &SMatrix<f64, R, C>,
        tolerance: f64,
    ) {
        for (g, e) in got.iter().zip(expected.iter()) {
            assert!((g - e).abs() <= tolerance * e.abs(), "{got} instead of {expected}");
        }
    }

    // Entry by entry, not in the norm: a position must not borrow digits from an acceleration.
    const TOLERANCE: f64 = 4e-14;

    #[test]
    fn double_integrator() {
        for t in [1e-6, 1e-3, 0.7, 1e4] {
            let hold = zero_order_hold(&matrix![0.0, 1.0; 0.0, 0.0], &matrix![0.0; 0.5], t).expect("finite");
            close(&hold.state, &matrix![1.0, t; 0.0, 1.0], TOLERANCE);
            close(&hold.input, &vector![0.25 * t * t, 0.5 * t], TOLERANCE);
        }
    }

    #[test]
    fn damped_oscillator_of_any_frequency() {
        for (w, z) in [(1e-3_f64, 0.0_f64), (30.0, 0.0), (700.0, 0.02), (2e4, 0.7)] {
            for phase in [1e-3, 0.3, 1.1, 2.5] {
                let t: f64 = phase / w;
                let wd = w * (1.0 - z * z).sqrt();
                let (sin, cos) = (wd * t).sin_cos();
                let decay = (-z * w * t).exp();
                let phi = matrix![
                    decay * (cos + z * w / wd * sin), decay * sin / wd;
                    -decay * w * w / wd * sin, decay * (cos - z * w / wd * sin)
                ];
                // A step of the input moves the equilibrium to (1 / w^2, 0).
                let gamma = vector![1.0 - phi[(0, 0)], -phi[(1, 0)]] / (w * w);
                let hold = zero_order_hold(&matrix![0.0, 1.0; -w * w, -2.0 * z * w], &vector![0.0, 1.0], t)
                    .expect("finite");
                close(&hold.state, &phi, TOLERANCE);
                // 1 - phi loses digits in the expected value where the phase is small.
                close(&hold.input, &gamma, TOLERANCE.max(4e-16 / (phase * phase)));
            }
        }
    }

    #[test]
    fn stiff_lag_and_large_inputs() {
        for (a, b, t) in [(-1e5_f64, 1e5, 1e-3), (-1e5, 3.0, 1e-6), (-1e5, 1e300, 1e-3), (1.0, 1e-30, 1.0)] {
            let hold = zero_order_hold(&matrix![a], &matrix![b], t).expect("finite");
            close(&hold.state, &matrix![(a * t).exp()], 1e-12);
            close(&hold.input, &matrix![b * (a * t).exp_m1() / a], TOLERANCE);
        }
    }

    #[test]
    fn stiff_beside_slow() {
        let (fast, slow, t) = (-1e5_f64, -1.0_f64, 1e-2);
        let hold = zero_order_hold(&matrix![slow, 1.0; 0.0, fast], &matrix![0.0; 1e5], t).expect("finite");
        let (es, ef) = ((slow * t).exp(), (fast * t).exp());
        close(&hold.state, &matrix![es, (ef - es) / (fast - slow); 0.0, ef], 1e-10);
        let lag = |p: f64| (p * t).exp_m1() / p;
        close(&hold.input, &vector![1e5 * (lag(fast) - lag(slow)) / (fast - slow), 1e5 * lag(fast)], 1e-10);
    }

    #[test]
    fn nothing_moves_without_dynamics_or_time() {
        let hold = zero_order_hold(&Matrix2::zeros(), &Vector2::new(1e300, -2.0), 0.5).expect("finite");
        assert_eq!(hold.state, Matrix2::identity());
        assert_eq!(hold.input, Vector2::new(5e299, -1.0));
        let hold = zero_order_hold(&matrix![0.0, 1.0; -9.0, -1.0], &vector![0.0, 1.0], 0.0).expect("finite");
        assert_eq!(hold.apply(&vector![3.0, 4.0], &vector![1.0]), vector![3.0, 4.0]);
    }

    #[test]
    fn dynamics_below_any_resolution_leave_the_input() {
        let hold = zero_order_hold(&matrix![-1e-310], &matrix![3.0], 2.0).expect("finite");
        close(&hold.state, &matrix![1.0], TOLERANCE);
        close(&hold.input, &matrix![6.0], TOLERANCE);
    }

    #[test]
    fn what_cannot_be_computed_is_an_error() {
        let one = matrix![1.0];
        assert!(matches!(zero_order_hold(&one, &one, -1.0), Err(ModelError::Parameter { .. })));
        assert!(matches!(zero_order_hold(&one, &one, f64::NAN), Err(ModelError::Parameter { .. })));
        assert!(matches!(zero_order_hold(&(-one * 1e12), &one, 1.0), Err(ModelError::TooStiff { .. })));
        assert!(matches!(zero_order_hold(&(one * 1e300), &one, 1e300), Err(ModelError::TooStiff { .. })));
        assert!(matches!(zero_order_hold(&one, &one, 1000.0), Err(ModelError::Range { .. })));
        assert!(matches!(zero_order_hold(&one, &(one * 1e300), 1e9), Err(ModelError::Range { .. })));
        assert!(matches!(zero_order_hold(&one, &(one * f64::NAN), 1.0), Err(ModelError::Range { .. })));
    }
}
