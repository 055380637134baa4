//! The energy of a ball-screw axis.

use nalgebra::{SVector, matrix};

use super::BallScrewAxis;
use crate::energy::{Energetic, HeldEnergetic, Powers, Work};
use crate::error::ModelError;
use crate::linear::{QuadraticIntegral, quadratic_integral};

/// Stored: `J w^2 / 2 + K theta^2 / 2`. Input: the torque `k J u`, that of the spring where the motor's angle drives it,
/// times speed. Delivered: load torque times speed. Heat: `f w^2`.
impl Energetic<2, 2> for BallScrewAxis {
    fn stored(&self, state: &SVector<f64, 2>) -> f64 {
        0.5 * (self.inertia * state[1] * state[1] + self.stiffness() * state[0] * state[0])
    }

    fn powers(&self, state: &SVector<f64, 2>, input: &SVector<f64, 2>) -> Powers {
        Powers {
            input: self.torque_gain() * input[0] * state[1],
            dissipated: self.damping() * state[1] * state[1],
            delivered: input[1] * state[1],
        }
    }
}

impl HeldEnergetic<2, 2> for BallScrewAxis {
    fn heat(&self, interval: f64) -> Result<QuadraticIntegral<2, 2>, ModelError> {
        let system = self.state_space()?;
        quadratic_integral(system.a(), system.b(), &matrix![0.0, 0.0; 0.0, self.damping()], interval)
    }

    fn work(&self, realised: &SVector<f64, 2>, change: &SVector<f64, 2>) -> Work {
        Work { input: self.torque_gain() * realised[0] * change[0], delivered: realised[1] * change[0] }
    }
}
