//! A synchronous motor on its own.

use nalgebra::{SVector, vector};

use super::PmsmDrive;
use super::windings::PmsmWindings;
use crate::energy::{Energetic, Powers};
use crate::error::ModelError;
use crate::models::check::{not_negative, positive};
use crate::models::{Plant, TwoInertia};
use crate::simulation::Saturation;

/// A permanent-magnet synchronous motor: [`PmsmWindings`] and a rotor of inertia `J` with viscous friction `b`,
///
/// `J w' = T - b w - T_l`
///
/// The state is `[i_d, i_q, theta, w]` in A, rad and rad/s, with the mechanical angle. The input is `[v_d, v_q, T_l]`
/// in V and N m; the load torque opposes the rotor. Voltages are held in rotor coordinates.
///
/// ```
/// use plants::{Plant, Pmsm, PmsmWindings, nalgebra::{self, vector}};
///
/// let motor = Pmsm::new(PmsmWindings::surface(2.875, 8.5e-3, 0.175, 3)?, 0.003)?.with_friction(0.008)?;
/// // At rest a voltage only raises the current.
/// let derivative = motor.derivative(&vector![0.0, 0.0, 0.0, 0.0], &vector![0.0, 17.0, 0.0]);
/// assert!((derivative - vector![0.0, 2000.0, 0.0, 0.0]).norm() < 1e-12);
/// # Ok::<(), plants::ModelError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedPmsm", into = "UncheckedPmsm"))]
pub struct Pmsm {
    windings: PmsmWindings,
    inertia: f64,
    friction: f64,
    per_inertia: f64,
}

#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
struct UncheckedPmsm {
    windings: PmsmWindings,
    inertia: f64,
    friction: f64,
}

#[cfg(feature = "serde")]
impl TryFrom<UncheckedPmsm> for Pmsm {
    type Error = ModelError;
    fn try_from(motor: UncheckedPmsm) -> Result<Self, ModelError> {
        Self::new(motor.windings, motor.inertia)?.with_friction(motor.friction)
    }
}

#[cfg(feature = "serde")]
impl From<Pmsm> for UncheckedPmsm {
    fn from(motor: Pmsm) -> Self {
        Self { windings: motor.windings, inertia: motor.inertia, friction: motor.friction }
    }
}

impl Pmsm {
    /// A motor without friction from its windings and the inertia of its rotor in kg m^2.
    ///
    /// # Errors
    /// An inertia that is not positive and finite.
    pub fn new(windings: PmsmWindings, inertia: f64) -> Result<Self, ModelError> {
        positive("the rotor inertia in kg m^2", inertia)?;
        Ok(Self { windings, inertia, friction: 0.0, per_inertia: 1.0 / inertia })
    }

    /// The same motor with viscous friction in N m s/rad.
    ///
    /// # Errors
    /// A friction that is negative or not finite, or so over the inertia.
    pub fn with_friction(self, friction: f64) -> Result<Self, ModelError> {
        not_negative("the friction in N m s/rad", friction)?;
        not_negative("the friction over the inertia in 1/s", friction * self.per_inertia)?;
        Ok(Self { friction, ..self })
    }

    /// The motor on a load of its own inertia in kg m^2 behind a spring in N m/rad, both undamped; the rotor keeps
    /// its inertia and its friction.
    ///
    /// # Errors
    /// As [`TwoInertia::new`].
    pub fn coupled(&self, load_inertia: f64, stiffness: f64) -> Result<PmsmDrive, ModelError> {
        self.coupled_with_damping(load_inertia, stiffness, 0.0, 0.0)
    }

    /// As [`coupled`](Self::coupled), with the viscous damping of the spring and of the load in N m s/rad.
    ///
    /// # Errors
    /// As [`TwoInertia::new`] and [`TwoInertia::with_damping`].
    pub fn coupled_with_damping(
        &self,
        load_inertia: f64,
        stiffness: f64,
        spring_damping: f64,
        load_damping: f64,
    ) -> Result<PmsmDrive, ModelError> {
        let mechanics = TwoInertia::new(self.inertia, load_inertia, stiffness)?.with_damping(
            self.friction,
            spring_damping,
            load_damping,
        )?;
        Ok(PmsmDrive::new(self.windings, mechanics))
    }

    /// The windings.
    #[must_use]
    pub fn windings(&self) -> &PmsmWindings {
        &self.windings
    }

    /// Inertia of the rotor `J`, kg m^2.
    #[must_use]
    pub fn inertia(&self) -> f64 {
        self.inertia
    }

    /// Viscous friction `b`, N m s/rad.
    #[must_use]
    pub fn friction(&self) -> f64 {
        self.friction
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

impl Plant<4, 3> for Pmsm {
    #[inline]
    fn derivative(&self, state: &SVector<f64, 4>, input: &SVector<f64, 3>) -> SVector<f64, 4> {
        let (along, across) = self.windings.currents(state[0], state[1], state[3], input[0], input[1]);
        let driving = self.windings.torque_less(state[0], state[1], self.friction * state[3]);
        vector![along, across, state[3], (driving - input[2]) * self.per_inertia]
    }
}

/// Input: electric power. Heat: in the windings and by friction. Delivered: load torque times speed.
impl Energetic<4, 3> for Pmsm {
    fn stored(&self, state: &SVector<f64, 4>) -> f64 {
        self.windings.magnetic_energy(state[0], state[1]) + 0.5 * self.inertia * state[3] * state[3]
    }

    fn powers(&self, state: &SVector<f64, 4>, input: &SVector<f64, 3>) -> Powers {
        Powers {
            input: self.windings.electric_power(input[0], input[1], state[0], state[1]),
            dissipated: self.windings.copper_loss(state[0], state[1]) + self.friction * state[3] * state[3],
            delivered: input[2] * state[3],
        }
    }
}
