//! A synchronous motor and the vibrating load it drives.

use nalgebra::{SVector, vector};

use super::windings::PmsmWindings;
use crate::energy::{Energetic, Powers};
use crate::models::{Plant, TwoInertia};
use crate::simulation::Saturation;

/// A permanent-magnet synchronous motor on a load behind a spring: [`PmsmWindings`] whose torque is the motor torque
/// of a [`TwoInertia`]. The rotor is its motor side.
///
/// The state is `[i_d, i_q, theta_m, w_m, theta_l, w_l]` in A, rad and rad/s. The input is `[v_d, v_q, T_l]` in V and
/// N m; the load torque opposes the load. Voltages are held in rotor coordinates.
///
/// ```
/// use plants::{Plant, Pmsm, PmsmWindings, TwoInertia, nalgebra::{self, vector}};
///
/// let motor = Pmsm::new(PmsmWindings::surface(2.875, 8.5e-3, 0.175, 3)?, 0.003)?.with_friction(0.008)?;
/// let drive = motor.coupled(5.066e-4, 100.0)?;
/// assert_eq!(drive.mechanics(), &TwoInertia::new(0.003, 5.066e-4, 100.0)?.with_damping(0.008, 0.0, 0.0)?);
/// let derivative = drive.derivative(&vector![0.0, 4.0, 0.0, 0.0, 0.0, 0.0], &vector![0.0, 11.5, 0.0]);
/// assert!((derivative - vector![0.0, 0.0, 0.0, 3.15 / 0.003, 0.0, 0.0]).norm() < 1e-10);
/// # Ok::<(), plants::ModelError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PmsmDrive {
    windings: PmsmWindings,
    mechanics: TwoInertia,
}

impl PmsmDrive {
    /// A drive from its windings and its mechanics, whose motor inertia and motor damping are those of the rotor.
    #[must_use]
    pub fn new(windings: PmsmWindings, mechanics: TwoInertia) -> Self {
        Self { windings, mechanics }
    }

    /// The windings.
    #[must_use]
    pub fn windings(&self) -> &PmsmWindings {
        &self.windings
    }

    /// Rotor, spring and load.
    #[must_use]
    pub fn mechanics(&self) -> &TwoInertia {
        &self.mechanics
    }

    /// The mechanical part of a state: `[theta_m, w_m, theta_l, w_l]`.
    #[inline]
    #[must_use]
    pub fn mechanical_state(&self, state: &SVector<f64, 6>) -> SVector<f64, 4> {
        vector![state[2], state[3], state[4], state[5]]
    }

    /// What the inverter makes of an input; the load torque passes.
    #[inline]
    #[must_use]
    pub fn realised(&self, input: &SVector<f64, 3>) -> SVector<f64, 3> {
        self.windings.realised(input)
    }

    /// The voltage limit as limits of the input, for the simulation to hand back to the controller.
    #[must_use]
    pub fn saturation(&self) -> Saturation<3> {
        self.windings.saturation()
    }
}

impl Plant<6, 3> for PmsmDrive {
    #[inline]
    fn derivative(&self, state: &SVector<f64, 6>, input: &SVector<f64, 3>) -> SVector<f64, 6> {
        let (along, across) = self.windings.currents(state[0], state[1], state[3], input[0], input[1]);
        let friction = self.mechanics.motor_damping() * state[3];
        let driving = self.windings.torque_less(state[0], state[1], friction);
        let motion = self.mechanics.motion(&self.mechanical_state(state), driving, input[2]);
        vector![along, across, motion[0], motion[1], motion[2], motion[3]]
    }
}

/// Input: electric power. Heat: in the windings and by the three dampings. Delivered: load torque times load speed.
impl Energetic<6, 3> for PmsmDrive {
    fn stored(&self, state: &SVector<f64, 6>) -> f64 {
        self.windings.magnetic_energy(state[0], state[1])
            + self.mechanics.stored(&self.mechanical_state(state))
    }

    fn powers(&self, state: &SVector<f64, 6>, input: &SVector<f64, 3>) -> Powers {
        Powers {
            input: self.windings.electric_power(input[0], input[1], state[0], state[1]),
            dissipated: self.windings.copper_loss(state[0], state[1])
                + self.mechanics.dissipated_power(&self.mechanical_state(state)),
            delivered: input[2] * state[5],
        }
    }
}
