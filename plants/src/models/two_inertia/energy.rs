//! The energy of a two-inertia axis.

use nalgebra::{SVector, matrix};

use super::TwoInertia;
use crate::energy::{Energetic, HeldEnergetic, Powers, Work};
use crate::error::ModelError;
use crate::linear::{QuadraticIntegral, quadratic_integral};

impl TwoInertia {
    /// Kinetic energy of both inertias, J: `J_m w_m^2 / 2 + J_l w_l^2 / 2`.
    #[must_use]
    pub fn kinetic_energy(&self, state: &SVector<f64, 4>) -> f64 {
        0.5 * (self.motor_inertia * state[1] * state[1] + self.load_inertia * state[3] * state[3])
    }

    /// Potential energy of the spring, J: `K (theta_m - theta_l)^2 / 2`.
    #[must_use]
    pub fn potential_energy(&self, state: &SVector<f64, 4>) -> f64 {
        let twist = state[0] - state[2];
        0.5 * self.stiffness * twist * twist
    }

    /// Power turned into heat, W: `c_m w_m^2 + c_s (w_m - w_l)^2 + c_l w_l^2`.
    #[must_use]
    pub fn dissipated_power(&self, state: &SVector<f64, 4>) -> f64 {
        let slip = state[1] - state[3];
        self.motor_damping * state[1] * state[1]
            + self.spring_damping * slip * slip
            + self.load_damping * state[3] * state[3]
    }
}

/// Input: motor torque times motor speed. Delivered: load torque times load speed.
impl Energetic<4, 2> for TwoInertia {
    fn stored(&self, state: &SVector<f64, 4>) -> f64 {
        self.kinetic_energy(state) + self.potential_energy(state)
    }

    fn powers(&self, state: &SVector<f64, 4>, input: &SVector<f64, 2>) -> Powers {
        Powers {
            input: input[0] * state[1],
            dissipated: self.dissipated_power(state),
            delivered: input[1] * state[3],
        }
    }
}

impl HeldEnergetic<4, 2> for TwoInertia {
    fn heat(&self, interval: f64) -> Result<QuadraticIntegral<4, 2>, ModelError> {
        let system = self.state_space()?;
        let (motor, spring, load) = (self.motor_damping, self.spring_damping, self.load_damping);
        let power = matrix![
            0.0, 0.0, 0.0, 0.0;
            0.0, motor + spring, 0.0, -spring;
            0.0, 0.0, 0.0, 0.0;
            0.0, -spring, 0.0, load + spring
        ];
        quadratic_integral(system.a(), system.b(), &power, interval)
    }

    fn work(&self, realised: &SVector<f64, 2>, change: &SVector<f64, 4>) -> Work {
        Work { input: realised[0] * change[0], delivered: realised[1] * change[2] }
    }
}
