//! The adaptive method of Dormand and Prince.

use nalgebra::SVector;
use profiles::Real;

use super::Stepper;
use super::stepper::check;
use crate::error::StepError;
use crate::models::Plant;

/// The local error an adaptive method may make in every component: `absolute + relative |x|`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tolerance {
    relative: f64,
    absolute: f64,
    steps: u32,
}

impl Tolerance {
    /// A tolerance; the absolute one has the unit of the state.
    ///
    /// # Errors
    /// A tolerance that is not positive and finite.
    pub fn new(relative: f64, absolute: f64) -> Result<Self, StepError> {
        for tolerance in [relative, absolute] {
            if !(tolerance > 0.0 && tolerance.is_finite()) {
                return Err(StepError::Tolerance(tolerance));
            }
        }
        Ok(Self { relative, absolute, steps: 100_000 })
    }

    /// The same tolerance with at most `steps` steps over one interval, 100 000 unless told.
    #[must_use]
    pub fn with_steps(self, steps: u32) -> Self {
        Self { steps, ..self }
    }
}

/// Adaptive steps of the Runge-Kutta method of Dormand and Prince, order 5 with an error estimate of order 4: to
/// check the others against, and for plants whose speed changes on the way.
///
/// # References
/// J. R. Dormand and P. J. Prince, "A family of embedded Runge-Kutta formulae", Journal of Computational and
/// Applied Mathematics 6 (1980), doi:10.1016/0771-050X(80)90013-3.
#[derive(Debug, Clone)]
pub struct DormandPrince<P> {
    plant: P,
    tolerance: Tolerance,
    // The last length that was not cut short by the end of an interval; zero before the first.
    step: f64,
}

impl<P> DormandPrince<P> {
    /// Adaptive steps of `plant`.
    #[must_use]
    pub fn new(plant: P, tolerance: Tolerance) -> Self {
        Self { plant, tolerance, step: 0.0 }
    }

    /// The plant.
    #[must_use]
    pub fn plant(&self) -> &P {
        &self.plant
    }
}

impl<const N: usize, const M: usize, P: Plant<N, M>> Stepper<N, M> for DormandPrince<P> {
    fn advance(
        &mut self,
        state: &SVector<f64, N>,
        input: &SVector<f64, M>,
        interval: f64,
    ) -> Result<SVector<f64, N>, StepError> {
        check(interval)?;
        let mut derivative = |_: f64, x: &SVector<f64, N>| self.plant.derivative(x, input);
        adapt(&mut derivative, state, 0.0, interval, &self.tolerance, &mut self.step)
    }
}

const NODES: [f64; 7] = [0.0, 1.0 / 5.0, 3.0 / 10.0, 4.0 / 5.0, 8.0 / 9.0, 1.0, 1.0];
// Row i holds the weights of the earlier slopes for slope i + 1; the last row is the solution of order 5.
const WEIGHTS: [[f64; 6]; 6] = [
    [1.0 / 5.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [3.0 / 40.0, 9.0 / 40.0, 0.0, 0.0, 0.0, 0.0],
    [44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0, 0.0, 0.0, 0.0],
    [19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0, 0.0, 0.0],
    [9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0, 0.0],
    [35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0],
];
// The solution of order 5 less that of order 4.
const ERROR: [f64; 7] =
    [71.0 / 57600.0, 0.0, -71.0 / 16695.0, 71.0 / 1920.0, -17253.0 / 339200.0, 22.0 / 525.0, -1.0 / 40.0];

/// The state at `start + interval`; `step` is the first length tried, where positive, and the next one after.
pub(super) fn adapt<const N: usize>(
    f: &mut impl FnMut(f64, &SVector<f64, N>) -> SVector<f64, N>,
    state: &SVector<f64, N>,
    start: f64,
    interval: f64,
    tolerance: &Tolerance,
    step: &mut f64,
) -> Result<SVector<f64, N>, StepError> {
    let (mut x, mut done) = (*state, 0.0);
    let mut slope = f(start, &x);
    let mut h = if *step > 0.0 { *step } else { first_step(&x, &slope, tolerance, interval) };
    let smallest = 4.0 * f64::EPSILON * interval;
    let mut tried = 0;
    while done < interval {
        let left = interval - done;
        // A last step that leaves less than rounding behind takes the rest.
        let last = h * (1.0 + 1e-9) >= left;
        let length = if last { left } else { h };
        if tried == tolerance.steps {
            return Err(StepError::TooManySteps { steps: tried, time: start + done });
        }
        tried += 1;
        let (next, end_slope, error) = trial(f, start + done, &x, &slope, length, tolerance);
        // The controller of the method's order, between a fifth and five times the step.
        let factor = Real::clamped(0.9 * Real::powf(error, -0.2), 0.2, 5.0);
        if error <= 1.0 {
            done = if last { interval } else { done + length };
            (x, slope) = (next, end_slope);
            // The end of an interval cuts a step short; that says nothing against the longer one.
            h = if last { Real::max(h, length * factor) } else { h * factor };
        } else {
            h = length * factor;
            if h <= smallest {
                return Err(StepError::Underflow { time: start + done, step: h });
            }
        }
    }
    *step = h;
    Ok(x)
}

/// A step, the slope at its end, and its error over the tolerance; infinite where it is not a number.
fn trial<const N: usize>(
    f: &mut impl FnMut(f64, &SVector<f64, N>) -> SVector<f64, N>,
    t: f64,
    x: &SVector<f64, N>,
    slope: &SVector<f64, N>,
    h: f64,
    tolerance: &Tolerance,
) -> (SVector<f64, N>, SVector<f64, N>, f64) {
    let mut k = [*slope; 7];
    let mut next = *x;
    for (i, weights) in WEIGHTS.iter().enumerate() {
        let sum = weights.iter().zip(&k).take(i + 1).fold(SVector::zeros(), |sum, (w, k)| sum + k * *w);
        next = x + sum * h;
        k[i + 1] = f(t + NODES[i + 1] * h, &next);
    }
    let difference = ERROR.iter().zip(&k).fold(SVector::<f64, N>::zeros(), |sum, (e, k)| sum + k * *e) * h;
    let mut worst = 0.0_f64;
    for ((d, a), b) in difference.iter().zip(x.iter()).zip(next.iter()) {
        let scale = tolerance.absolute + tolerance.relative * Real::max(a.abs(), b.abs());
        let error = d.abs() / scale;
        // An infinite state has an infinite scale; its difference is NaN.
        worst = if error.is_finite() && b.is_finite() { worst.max(error) } else { f64::INFINITY };
    }
    (next, k[6], worst)
}

/// A step over which the state changes by a hundredth of itself, within the interval.
fn first_step<const N: usize>(
    x: &SVector<f64, N>,
    slope: &SVector<f64, N>,
    tolerance: &Tolerance,
    interval: f64,
) -> f64 {
    let mut step = interval;
    for (x, slope) in x.iter().zip(slope.iter()) {
        let scale = 0.01 * x.abs() + tolerance.absolute;
        if slope.abs() * step > scale {
            step = scale / slope.abs();
        }
    }
    Real::max(step, 1e-12 * interval)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::vector;

    #[test]
    fn the_tableau_is_consistent() {
        for (weights, node) in WEIGHTS.iter().zip(&NODES[1..]) {
            assert!((weights.iter().sum::<f64>() - node).abs() < 1e-14);
        }
        // Quadrature of t^q is exact up to order 5, and its difference to order 4 vanishes up to t^3.
        for q in 0..5 {
            let b = WEIGHTS[5].iter().zip(&NODES).map(|(w, c)| w * c.powi(q)).sum::<f64>();
            assert!((b - 1.0 / f64::from(q + 1)).abs() < 1e-14, "{q}");
        }
        for q in 0..4 {
            let e = ERROR.iter().zip(&NODES).map(|(w, c)| w * c.powi(q)).sum::<f64>();
            assert!(e.abs() < 1e-14, "{q}");
        }
    }

    #[test]
    fn a_singularity_is_an_error() {
        // x' = x^2 from 1 ends at t = 1.
        let blow_up = |x: &SVector<f64, 1>, _: &SVector<f64, 1>| vector![x[0] * x[0]];
        let mut stepper = DormandPrince::new(blow_up, Tolerance::new(1e-8, 1e-8).expect("valid"));
        let error = stepper.advance(&vector![1.0], &vector![0.0], 2.0);
        assert!(
            matches!(error, Err(StepError::Underflow { time, .. }) if (time - 1.0).abs() < 1e-3),
            "{error:?}"
        );
        assert!((stepper.advance(&vector![1.0], &vector![0.0], 0.5).expect("regular")[0] - 2.0).abs() < 1e-7);
    }

    #[test]
    fn the_number_of_steps_is_bounded() {
        let stiff = |x: &SVector<f64, 1>, u: &SVector<f64, 1>| (u - x) * 1e6;
        let tolerance = Tolerance::new(1e-6, 1e-6).expect("valid").with_steps(1000);
        let error = DormandPrince::new(stiff, tolerance).advance(&vector![1.0], &vector![0.0], 1.0);
        assert!(matches!(error, Err(StepError::TooManySteps { steps: 1000, .. })), "{error:?}");
    }

    #[test]
    fn bad_tolerances_and_slopes_are_errors() {
        assert!(matches!(Tolerance::new(0.0, 1.0), Err(StepError::Tolerance(0.0))));
        assert!(Tolerance::new(1e-6, f64::NAN).is_err());
        let bad = |_: &SVector<f64, 1>, _: &SVector<f64, 1>| vector![f64::NAN];
        let mut stepper = DormandPrince::new(bad, Tolerance::new(1e-6, 1e-6).expect("valid"));
        assert!(matches!(
            stepper.advance(&vector![1.0], &vector![0.0], 1.0),
            Err(StepError::Underflow { .. })
        ));
        let rest = |_: &SVector<f64, 1>, _: &SVector<f64, 1>| vector![0.0];
        let mut stepper = DormandPrince::new(rest, Tolerance::new(1e-6, 1e-6).expect("valid"));
        assert_eq!(stepper.advance(&vector![3.0], &vector![0.0], 0.0), Ok(vector![3.0]));
        assert_eq!(stepper.advance(&vector![3.0], &vector![0.0], 1e3), Ok(vector![3.0]));
    }
}
