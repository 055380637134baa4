//! The classical Runge-Kutta method.

use nalgebra::SVector;
use profiles::Real;

use super::stepper::check;
use super::{MeteredRk4, Stepper};
use crate::error::StepError;
use crate::models::Plant;

// The stability region ends at 2.785 on the negative real axis and at 2.828 on the imaginary axis.
const STABLE: f64 = 2.78;
const ACCURATE: f64 = 0.12;
const MOST_SUBSTEPS: u32 = 1_000_000;

#[derive(Debug, Clone, Copy, PartialEq)]
enum Substeps {
    Fixed(u32),
    // Of about 0.12 over the spectral radius.
    Accurate,
}

/// Steps of the classical fourth-order Runge-Kutta method, for smooth plants.
///
/// The spectral radius, in rad/s, is the largest magnitude of a pole of the plant anywhere on its way:
/// [`linearise`](crate::linearise) and [`spectral_radius`](crate::spectral_radius) give it at a point.
#[derive(Debug, Clone)]
pub struct Rk4<P> {
    plant: P,
    substeps: Substeps,
    spectral_radius: f64,
}

impl<P> Rk4<P> {
    /// As many substeps `h` as bring `spectral_radius * h` below 0.12.
    ///
    /// # Errors
    /// A spectral radius that is negative or not finite.
    pub fn accurate(plant: P, spectral_radius: f64) -> Result<Self, StepError> {
        Self::checked(plant, Substeps::Accurate, spectral_radius)
    }

    /// A fixed number of substeps for every interval, refused where `spectral_radius * h` exceeds 2.78. A spectral
    /// radius of zero checks nothing.
    ///
    /// # Errors
    /// No substeps, or a spectral radius that is negative or not finite.
    pub fn fixed(plant: P, substeps: u32, spectral_radius: f64) -> Result<Self, StepError> {
        Self::checked(plant, Substeps::Fixed(substeps), spectral_radius)
    }

    fn checked(plant: P, substeps: Substeps, spectral_radius: f64) -> Result<Self, StepError> {
        if !(spectral_radius >= 0.0 && spectral_radius.is_finite()) {
            return Err(StepError::SpectralRadius(spectral_radius));
        }
        if let Substeps::Fixed(0) = substeps {
            return Err(StepError::Substeps { interval: 0.0, needed: 0.0, limit: MOST_SUBSTEPS });
        }
        Ok(Self { plant, substeps, spectral_radius })
    }

    /// The plant.
    #[must_use]
    pub fn plant(&self) -> &P {
        &self.plant
    }

    /// The same steps with an account of the energy.
    #[must_use]
    pub fn metered(self) -> MeteredRk4<P> {
        MeteredRk4::new(self)
    }

    /// As [`substeps`](Self::substeps), the usual case first and inline.
    #[inline]
    pub(super) fn count(&self, interval: f64) -> Result<u32, StepError> {
        match self.substeps {
            Substeps::Fixed(substeps) if self.spectral_radius * interval <= STABLE * f64::from(substeps) => {
                Ok(substeps)
            }
            _ => self.substeps(interval),
        }
    }

    /// The number of substeps of an interval in s.
    ///
    /// # Errors
    /// More than a million, or a fixed number with which the method is unstable.
    #[inline(never)]
    pub fn substeps(&self, interval: f64) -> Result<u32, StepError> {
        let product = self.spectral_radius * interval;
        match self.substeps {
            Substeps::Fixed(substeps) => {
                if product > STABLE * f64::from(substeps) {
                    let step = interval / f64::from(substeps);
                    let product = product / f64::from(substeps);
                    return Err(StepError::Unstable { step, product, limit: STABLE });
                }
                Ok(substeps)
            }
            Substeps::Accurate => {
                let needed = Real::max(Real::ceil(product / ACCURATE), 1.0);
                if needed > f64::from(MOST_SUBSTEPS) {
                    return Err(StepError::Substeps { interval, needed, limit: MOST_SUBSTEPS });
                }
                Ok(needed as u32)
            }
        }
    }
}

impl<const N: usize, const M: usize, P: Plant<N, M>> Stepper<N, M> for Rk4<P> {
    #[inline(always)]
    fn advance(
        &mut self,
        state: &SVector<f64, N>,
        input: &SVector<f64, M>,
        interval: f64,
    ) -> Result<SVector<f64, N>, StepError> {
        check(interval)?;
        let substeps = self.count(interval)?;
        // A single step needs neither a division nor a loop around it, which would keep the state in memory.
        if substeps == 1 {
            return Ok(rk4_step(&mut |_, x| self.plant.derivative(x, input), 0.0, state, interval));
        }
        Ok(several(&self.plant, state, input, interval, substeps))
    }
}

/// An interval in equal substeps.
#[inline(never)]
fn several<const N: usize, const M: usize>(
    plant: &impl Plant<N, M>,
    state: &SVector<f64, N>,
    input: &SVector<f64, M>,
    interval: f64,
    substeps: u32,
) -> SVector<f64, N> {
    let step = interval / f64::from(substeps);
    (0..substeps).fold(*state, |x, _| rk4_step(&mut |_, x| plant.derivative(x, input), 0.0, &x, step))
}

/// One step of the classical method for `x' = f(t, x)`.
#[inline(always)]
pub(super) fn rk4_step<const N: usize>(
    f: &mut impl FnMut(f64, &SVector<f64, N>) -> SVector<f64, N>,
    t: f64,
    x: &SVector<f64, N>,
    h: f64,
) -> SVector<f64, N> {
    let half = 0.5 * h;
    let k1 = f(t, x);
    let k2 = f(t + half, &(x + k1 * half));
    let k3 = f(t + half, &(x + k2 * half));
    let k4 = f(t + h, &(x + k3 * h));
    x + (k1 + (k2 + k3) * 2.0 + k4) * (h / 6.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::vector;

    fn lag(x: &SVector<f64, 1>, u: &SVector<f64, 1>) -> SVector<f64, 1> {
        (u - x) * 100.0
    }

    #[test]
    fn one_step_is_the_fourth_taylor_polynomial() {
        let mut stepper = Rk4::fixed(lag, 1, 100.0).expect("valid");
        let x = stepper.advance(&vector![1.0], &vector![0.0], 0.005).expect("stable");
        let z = -0.5_f64;
        let taylor = 1.0 + z + z * z / 2.0 + z * z * z / 6.0 + z * z * z * z / 24.0;
        assert!((x[0] - taylor).abs() < 1e-15);
    }

    #[test]
    fn substeps_follow_the_spectral_radius() {
        let stepper = Rk4::accurate(lag, 100.0).expect("valid");
        assert_eq!(stepper.substeps(0.001), Ok(1));
        assert_eq!(stepper.substeps(0.01), Ok(9));
        assert!(matches!(stepper.substeps(1e9), Err(StepError::Substeps { .. })));
        let stepper = Rk4::fixed(lag, 2, 100.0).expect("valid");
        assert_eq!(stepper.substeps(0.0556), Ok(2));
        assert!(matches!(stepper.substeps(0.0557), Err(StepError::Unstable { .. })));
    }

    #[test]
    fn the_limit_is_where_the_method_turns_unstable() {
        // At the limit the factor of one step is still within one, a little beyond it is not.
        let factor = |z: f64| 1.0 + z + z * z / 2.0 + z * z * z / 6.0 + z * z * z * z / 24.0;
        assert!(factor(-STABLE).abs() < 1.0);
        assert!(factor(-STABLE - 0.01).abs() > 1.0);
    }

    #[test]
    fn bad_numbers_are_errors() {
        assert!(Rk4::fixed(lag, 0, 0.0).is_err());
        assert!(Rk4::accurate(lag, f64::NAN).is_err());
        let mut stepper = Rk4::accurate(lag, 1.0).expect("valid");
        assert!(stepper.advance(&vector![1.0], &vector![0.0], f64::NAN).is_err());
    }
}
