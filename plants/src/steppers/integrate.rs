//! Differential equations that depend on time: loops closed in continuous time.

use nalgebra::SVector;

use super::Tolerance;
use super::dormand_prince::adapt;
use super::rk4::rk4_step;
use super::stepper::check;
use crate::error::StepError;

/// Integrates `x' = f(t, x)` from `x0` at `t0` by `steps` steps of the classical Runge-Kutta method of `step` in s,
/// and returns the state at `t0 + steps * step`.
///
/// `observe` sees the time and the state at the start and after every step.
///
/// # Errors
/// A step that is negative or not finite.
///
/// ```
/// use plants::{integrate, nalgebra::{self, vector}};
///
/// // A mass of 1 kg on a continuous PD controller, following x = t.
/// let loop_ = |t: f64, x: &plants::nalgebra::SVector<f64, 2>| {
///     vector![x[1], 100.0 * (t - x[0]) + 20.0 * (1.0 - x[1])]
/// };
/// let mut largest_error = 0.0_f64;
/// let end = integrate(loop_, vector![0.0, 0.0], 0.0, 1e-3, 2000, |t, x| {
///     largest_error = largest_error.max((t - x[0]).abs());
/// })?;
/// assert!((end - vector![2.0, 1.0]).norm() < 1e-7);
/// // The error of this loop is t e^(-10 t).
/// assert!((largest_error - 0.1 / 1.0_f64.exp()).abs() < 1e-6);
/// # Ok::<(), plants::StepError>(())
/// ```
pub fn integrate<const N: usize>(
    mut f: impl FnMut(f64, &SVector<f64, N>) -> SVector<f64, N>,
    x0: SVector<f64, N>,
    t0: f64,
    step: f64,
    steps: u64,
    mut observe: impl FnMut(f64, &SVector<f64, N>),
) -> Result<SVector<f64, N>, StepError> {
    check(step)?;
    let mut x = x0;
    observe(t0, &x);
    for k in 0..steps {
        x = rk4_step(&mut f, t0 + k as f64 * step, &x, step);
        observe(t0 + (k + 1) as f64 * step, &x);
    }
    Ok(x)
}

/// As [`integrate`], with as many adaptive steps of Dormand and Prince between two observations as the tolerance
/// asks for.
///
/// # Errors
/// A step that is negative or not finite, or a tolerance that cannot be met.
pub fn integrate_adaptive<const N: usize>(
    mut f: impl FnMut(f64, &SVector<f64, N>) -> SVector<f64, N>,
    x0: SVector<f64, N>,
    t0: f64,
    step: f64,
    steps: u64,
    tolerance: &Tolerance,
    mut observe: impl FnMut(f64, &SVector<f64, N>),
) -> Result<SVector<f64, N>, StepError> {
    check(step)?;
    let (mut x, mut length) = (x0, 0.0);
    observe(t0, &x);
    for k in 0..steps {
        x = adapt(&mut f, &x, t0 + k as f64 * step, step, tolerance, &mut length)?;
        observe(t0 + (k + 1) as f64 * step, &x);
    }
    Ok(x)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::vector;

    #[test]
    fn time_reaches_the_right_hand_side() {
        // x' = 4 t^3 is a quadrature that the classical method has exact: Simpson's rule is, up to cubics.
        let end =
            integrate(|t, _| vector![4.0 * t * t * t], vector![1.0], -1.0, 0.5, 8, |_, _| ()).expect("valid");
        assert!((end[0] - 81.0).abs() < 1e-13);
        let tolerance = Tolerance::new(1e-10, 1e-10).expect("valid");
        let f = |t: f64, _: &SVector<f64, 1>| vector![5.0 * t * t * t * t];
        let end = integrate_adaptive(f, vector![1.0], -1.0, 0.5, 8, &tolerance, |_, _| ()).expect("valid");
        assert!((end[0] - 245.0).abs() < 1e-11);
    }

    #[test]
    fn every_grid_point_is_observed() {
        let mut times = Vec::new();
        integrate(|_, _| vector![0.0], vector![0.0], 1.0, 0.25, 4, |t, _| times.push(t)).expect("valid");
        assert_eq!(times, [1.0, 1.25, 1.5, 1.75, 2.0]);
        assert!(integrate(|_, _| vector![0.0], vector![0.0], 1.0, f64::NAN, 4, |_, _| ()).is_err());
    }
}
