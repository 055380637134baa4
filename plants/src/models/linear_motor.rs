//! A linear motor and its carriage.

use nalgebra::{SVector, matrix, vector};
use profiles::Real;

use super::check::{not_negative, positive};
use super::decay::decay_functions;
use super::{Plant, StateSpace};
use crate::energy::{Energetic, HeldEnergetic, Powers, Work};
use crate::error::ModelError;
use crate::linear::{QuadraticIntegral, Transition, quadratic_integral};
use crate::simulation::Saturation;
use crate::steppers::HeldLinear;

/// A carriage of mass `m` with viscous damping `c`, driven by a force `F`: `m x'' + c x' = F`.
///
/// From force to position it is `G(s) = 1 / (m s^2 + c s)`. The state is `[x, x']`, position in m and velocity in
/// m/s. The input is the force in N, or the current in A with `F = k i` after
/// [`driven_by_current`](Self::driven_by_current). The force may have a limit.
///
/// ```
/// use plants::{HeldLinear, LinearMotor, nalgebra::{self, vector}};
///
/// let motor = LinearMotor::new(2.0, 0.0)?.driven_by_current(50.0)?.with_force_limit(100.0)?;
/// // 1 A on an air bearing: 25 m/s^2 for 0.1 s.
/// let state = motor.transition(0.1)?.apply(&vector![0.0, 0.0], &vector![1.0]);
/// assert!((state - vector![0.125, 2.5]).norm() < 1e-15);
/// assert_eq!(motor.force(3.0), 100.0);
/// # Ok::<(), plants::ModelError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedMotor", into = "UncheckedMotor"))]
pub struct LinearMotor {
    mass: f64,
    damping: f64,
    force_constant: Option<f64>,
    force_limit: f64,
}

// No limit is written as none: formats like JSON have no infinity.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
struct UncheckedMotor {
    mass: f64,
    damping: f64,
    force_constant: Option<f64>,
    force_limit: Option<f64>,
}

#[cfg(feature = "serde")]
impl TryFrom<UncheckedMotor> for LinearMotor {
    type Error = ModelError;
    fn try_from(motor: UncheckedMotor) -> Result<Self, ModelError> {
        let mut checked = Self::new(motor.mass, motor.damping)?;
        if let Some(force_constant) = motor.force_constant {
            checked = checked.driven_by_current(force_constant)?;
        }
        if let Some(limit) = motor.force_limit {
            checked = checked.with_force_limit(limit)?;
        }
        Ok(checked)
    }
}

#[cfg(feature = "serde")]
impl From<LinearMotor> for UncheckedMotor {
    fn from(motor: LinearMotor) -> Self {
        Self {
            mass: motor.mass,
            damping: motor.damping,
            force_constant: motor.force_constant,
            force_limit: Some(motor.force_limit).filter(|limit| limit.is_finite()),
        }
    }
}

impl LinearMotor {
    /// A motor driven by a force, without a limit, from its moving mass in kg and its damping in N s/m.
    ///
    /// # Errors
    /// A mass that is not positive and finite, or a damping that is negative or not finite.
    pub fn new(mass: f64, damping: f64) -> Result<Self, ModelError> {
        positive("the mass in kg", mass)?;
        not_negative("the damping in N s/m", damping)?;
        Ok(Self { mass, damping, force_constant: None, force_limit: f64::INFINITY })
    }

    /// The same motor with the current in A as its input, from its force constant in N/A.
    ///
    /// # Errors
    /// A force constant that is not positive and finite.
    pub fn driven_by_current(self, force_constant: f64) -> Result<Self, ModelError> {
        positive("the force constant in N/A", force_constant)?;
        Ok(Self { force_constant: Some(force_constant), ..self })
    }

    /// The same motor with a force of at most `limit` in N either way.
    ///
    /// # Errors
    /// A limit that is not positive and finite.
    pub fn with_force_limit(self, limit: f64) -> Result<Self, ModelError> {
        positive("the force limit in N", limit)?;
        Ok(Self { force_limit: limit, ..self })
    }

    /// Moving mass `m`, kg.
    #[must_use]
    pub fn mass(&self) -> f64 {
        self.mass
    }

    /// Viscous damping `c`, N s/m.
    #[must_use]
    pub fn damping(&self) -> f64 {
        self.damping
    }

    /// Force per unit of the input: the force constant in N/A, or one.
    #[must_use]
    pub fn gain(&self) -> f64 {
        self.force_constant.unwrap_or(1.0)
    }

    /// Largest force, N; infinite without a limit.
    #[must_use]
    pub fn force_limit(&self) -> f64 {
        self.force_limit
    }

    /// The force in N that an input gives, within the limit.
    #[must_use]
    pub fn force(&self, input: f64) -> f64 {
        Real::clamped(self.gain() * input, -self.force_limit, self.force_limit)
    }

    /// The force limit as limits of the input, for the simulation to hand back to the controller.
    #[must_use]
    pub fn saturation(&self) -> Saturation<1> {
        Saturation::symmetric_unchecked(self.force_limit / self.gain())
    }

    /// Kinetic energy `m v^2 / 2` of a state, J.
    #[must_use]
    pub fn kinetic_energy(&self, state: &SVector<f64, 2>) -> f64 {
        0.5 * self.mass * state[1] * state[1]
    }

    /// The motor without its limit, from input to position.
    ///
    /// # Errors
    /// A ratio of the parameters beyond the range of double precision.
    pub fn state_space(&self) -> Result<StateSpace<2, 1, 1>, ModelError> {
        StateSpace::new(
            matrix![0.0, 1.0; 0.0, -self.damping / self.mass],
            matrix![0.0; self.gain() / self.mass],
            matrix![1.0, 0.0],
            matrix![0.0],
        )
    }
}

impl Plant<2, 1> for LinearMotor {
    fn derivative(&self, state: &SVector<f64, 2>, input: &SVector<f64, 1>) -> SVector<f64, 2> {
        vector![state[1], (self.force(input[0]) - self.damping * state[1]) / self.mass]
    }
}

/// In closed form: with `z = c T / m`, `p1 = (1 - e^-z) / z` and `p2 = (z - 1 + e^-z) / z^2`,
///
/// `Phi = [[1, T p1], [0, e^-z]]`, `Gamma = (k / m) [T^2 p2, T p1]`
///
/// The force limit is not in the transition but in the realised input.
impl HeldLinear<2, 1> for LinearMotor {
    fn transition(&self, interval: f64) -> Result<Transition<2, 1>, ModelError> {
        not_negative("the interval in s", interval)?;
        let (decay, p1, p2) = decay_functions(self.damping / self.mass * interval);
        let acceleration = self.gain() / self.mass;
        let transition = Transition {
            state: matrix![1.0, interval * p1; 0.0, decay],
            input: vector![acceleration * (interval * interval * p2), acceleration * (interval * p1)],
        };
        if transition.input.iter().all(|x| x.is_finite()) {
            Ok(transition)
        } else {
            Err(ModelError::Range { interval })
        }
    }

    fn realised(&self, input: &SVector<f64, 1>) -> SVector<f64, 1> {
        vector![self.force(input[0]) / self.gain()]
    }
}

/// Input: force times speed. Heat: `c v^2`. The way to the load is the carriage itself.
impl Energetic<2, 1> for LinearMotor {
    fn stored(&self, state: &SVector<f64, 2>) -> f64 {
        self.kinetic_energy(state)
    }

    fn powers(&self, state: &SVector<f64, 2>, input: &SVector<f64, 1>) -> Powers {
        Powers {
            input: self.force(input[0]) * state[1],
            dissipated: self.damping * state[1] * state[1],
            delivered: 0.0,
        }
    }
}

impl HeldEnergetic<2, 1> for LinearMotor {
    fn heat(&self, interval: f64) -> Result<QuadraticIntegral<2, 1>, ModelError> {
        let system = self.state_space()?;
        quadratic_integral(system.a(), system.b(), &matrix![0.0, 0.0; 0.0, self.damping], interval)
    }

    fn work(&self, realised: &SVector<f64, 1>, change: &SVector<f64, 2>) -> Work {
        Work { input: self.gain() * realised[0] * change[0], delivered: 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_closed_form_is_the_matrix_exponential() {
        for damping in [0.0, 1e-12, 1e-3, 0.9, 1.1, 40.0, 1e5] {
            let motor =
                LinearMotor::new(0.8, damping).expect("valid").driven_by_current(30.0).expect("valid");
            for interval in [1e-6, 1e-3, 0.3, 2.0] {
                let exact = motor.transition(interval).expect("finite");
                let general = motor.state_space().expect("finite").transition(interval).expect("finite");
                for (x, y) in
                    exact.state.iter().chain(&exact.input).zip(general.state.iter().chain(&general.input))
                {
                    // The exponential squares its way up to |A T|: rounding grows with it, down to a decay of 1e-300.
                    assert!((x - y).abs() <= 1e-13 * x.abs().max(1e-20), "{x} {y} {damping} {interval}");
                }
            }
        }
    }

    #[test]
    fn the_derivative_is_the_transition_of_no_time() {
        let motor = LinearMotor::new(0.8, 3.0).expect("valid").with_force_limit(2.0).expect("valid");
        let (state, input) = (vector![0.1, -0.4], vector![5.0]);
        let step = motor.transition(1e-7).expect("finite").apply(&state, &motor.realised(&input)) - state;
        assert!((step / 1e-7 - motor.derivative(&state, &input)).norm() < 1e-5);
        assert_eq!(motor.derivative(&state, &input), vector![-0.4, (2.0 + 1.2) / 0.8]);
    }

    #[test]
    fn bad_numbers_are_errors() {
        assert!(LinearMotor::new(0.0, 1.0).is_err());
        assert!(LinearMotor::new(1.0, -1.0).is_err());
        let motor = LinearMotor::new(1.0, 0.0).expect("valid");
        assert!(motor.driven_by_current(f64::NAN).is_err());
        assert!(motor.with_force_limit(f64::INFINITY).is_err());
        assert!(motor.transition(-1.0).is_err());
        assert!(matches!(motor.transition(1e200), Err(ModelError::Range { .. })));
    }
}
