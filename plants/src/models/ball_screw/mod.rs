//! A table on a ball screw.

mod energy;
mod metered;
mod motion;
mod slide;
mod stick_slip;

use nalgebra::{SMatrix, SVector, matrix, vector};

use super::check::{not_negative, positive};
use super::{Friction, Plant, StateSpace};
use crate::error::ModelError;
use crate::linear::{Transition, zero_order_hold};
use crate::steppers::HeldLinear;

pub use metered::MeteredStickSlip;
pub use stick_slip::StickSlip;

/// A ball-screw axis: a screw of inertia `J`, damping `f` and torsional stiffness `K`, all of the drive train referred
/// to it, turned by a motor at the angle `theta_M` against a load torque `M`:
///
/// `J theta'' + f theta' + K theta = K theta_M - M`
///
/// or, from the input `u` of a drive known by its coefficients,
///
/// `theta'' = -a theta' - b theta + k u - M / J`
///
/// from input to angle `G(s) = k / (s^2 + a s + b)`. The state is `[theta, theta']` in rad and rad/s. The input is
/// `[u, M]`: the motor's angle in rad, or the drive's own unit, and the load torque in N m, which opposes the motion as
/// that of a [`TwoInertia`](crate::TwoInertia) does. A lead of `l` per turn moves the table by `l / (2 pi)` per rad.
///
/// Dry friction makes it another plant, see [`StickSlip`].
///
/// ```
/// use plants::{BallScrewAxis, Plant, nalgebra::{self, vector}};
///
/// let axis = BallScrewAxis::from_coefficients(10.0, 1.0, 1.0)?; // 1/s, 1/s^2, rad/s^2 per unit of u
/// // At rest: 1 rad/s^2 from the input, 1 rad/s^2 back from 1 rad, and 3 N m on 1 kg m^2.
/// assert_eq!(axis.derivative(&vector![1.0, 0.0], &vector![1.0, 3.0]), vector![0.0, -3.0]);
/// // The same motion of 0.5 kg m^2 takes a load twice as hard.
/// let lighter = axis.with_inertia(0.5)?;
/// assert_eq!(lighter.derivative(&vector![1.0, 0.0], &vector![1.0, 3.0]), vector![0.0, -6.0]);
/// assert_eq!(lighter.damping(), 5.0); // N m s/rad
/// # Ok::<(), plants::ModelError>(())
/// ```
///
/// # References
/// W. Wang, Z. Chen, Z. Wang, "Compensation sliding cross coupling control research of Cartesian coordinate robot",
/// Journal of System Simulation 33 (2021), eq. (1) to (5), doi:10.16182/j.issn1004731x.joss.19-0646.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedBallScrew", into = "UncheckedBallScrew"))]
pub struct BallScrewAxis {
    a: f64,
    b: f64,
    k: f64,
    inertia: f64,
    per_inertia: f64,
}

#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
struct UncheckedBallScrew {
    a: f64,
    b: f64,
    k: f64,
    inertia: f64,
}

#[cfg(feature = "serde")]
impl TryFrom<UncheckedBallScrew> for BallScrewAxis {
    type Error = ModelError;
    fn try_from(axis: UncheckedBallScrew) -> Result<Self, ModelError> {
        Self::from_coefficients(axis.a, axis.b, axis.k)?.with_inertia(axis.inertia)
    }
}

#[cfg(feature = "serde")]
impl From<BallScrewAxis> for UncheckedBallScrew {
    fn from(axis: BallScrewAxis) -> Self {
        Self { a: axis.a, b: axis.b, k: axis.k, inertia: axis.inertia }
    }
}

impl BallScrewAxis {
    /// An axis driven by the angle of its motor, from its inertia in kg m^2, damping in N m s/rad and stiffness in
    /// N m/rad: `a = f / J`, `b = k = K / J`.
    ///
    /// # Errors
    /// An inertia or stiffness that is not positive and finite, a damping that is negative or not finite, or a ratio
    /// of them beyond the range of double precision.
    pub fn new(inertia: f64, damping: f64, stiffness: f64) -> Result<Self, ModelError> {
        positive("the inertia in kg m^2", inertia)?;
        not_negative("the damping in N m s/rad", damping)?;
        positive("the stiffness in N m/rad", stiffness)?;
        let square = stiffness / inertia;
        Self::from_coefficients(damping / inertia, square, square)?.with_inertia(inertia)
    }

    /// An axis from the coefficients `a` in 1/s, `b` in 1/s^2 and `k` in rad/s^2 per unit of the input, eq. (5). They
    /// do not tell its inertia, on which only loads and energies depend; it is 1 kg m^2 until
    /// [`with_inertia`](Self::with_inertia) says otherwise.
    ///
    /// # Errors
    /// An `a` or `b` that is negative or not finite, or a `k` that is not positive and finite.
    pub fn from_coefficients(a: f64, b: f64, k: f64) -> Result<Self, ModelError> {
        not_negative("the coefficient a in 1/s", a)?;
        not_negative("the coefficient b in 1/s^2", b)?;
        positive("the coefficient k in rad/s^2 per unit", k)?;
        Ok(Self { a, b, k, inertia: 1.0, per_inertia: 1.0 })
    }

    /// The same coefficients on another inertia in kg m^2: damping, stiffness and torque per input grow with it.
    ///
    /// # Errors
    /// An inertia that is not positive and finite, or a product beyond the range of double precision.
    pub fn with_inertia(self, inertia: f64) -> Result<Self, ModelError> {
        positive("the inertia in kg m^2", inertia)?;
        let axis = Self { inertia, per_inertia: 1.0 / inertia, ..self };
        not_negative("the damping in N m s/rad", axis.damping())?;
        not_negative("the stiffness in N m/rad", axis.stiffness())?;
        not_negative("the torque per input in N m", axis.torque_gain())?;
        Ok(axis)
    }

    /// Coefficient `a = f / J`, 1/s.
    #[must_use]
    pub fn a(&self) -> f64 {
        self.a
    }

    /// Coefficient `b = K / J`, 1/s^2.
    #[must_use]
    pub fn b(&self) -> f64 {
        self.b
    }

    /// Coefficient `k`, rad/s^2 per unit of the input.
    #[must_use]
    pub fn k(&self) -> f64 {
        self.k
    }

    /// Inertia `J`, kg m^2.
    #[must_use]
    pub fn inertia(&self) -> f64 {
        self.inertia
    }

    /// Damping `f = a J`, N m s/rad.
    #[must_use]
    pub fn damping(&self) -> f64 {
        self.a * self.inertia
    }

    /// Stiffness `K = b J`, N m/rad.
    #[must_use]
    pub fn stiffness(&self) -> f64 {
        self.b * self.inertia
    }

    /// Torque on the screw per unit of the input, `k J`, N m.
    #[must_use]
    pub fn torque_gain(&self) -> f64 {
        self.k * self.inertia
    }

    /// From input and load torque to angle and speed.
    ///
    /// # Errors
    /// Coefficients that are not finite.
    pub fn state_space(&self) -> Result<StateSpace<2, 2, 2>, ModelError> {
        StateSpace::new(
            matrix![0.0, 1.0; -self.b, -self.a],
            matrix![0.0, 0.0; self.k, -self.per_inertia],
            SMatrix::identity(),
            SMatrix::zeros(),
        )
    }

    /// The same axis with more damping, N m s/rad, that [`check_damping`](Self::check_damping) has checked.
    fn with_more_damping(self, damping: f64) -> Self {
        Self { a: self.a + damping * self.per_inertia, ..self }
    }

    /// Refuses friction whose viscous part is out of range in the units of the axis.
    pub(super) fn check_damping(&self, friction: &Friction) -> Result<(), ModelError> {
        let axis = self.with_more_damping(friction.viscous());
        not_negative("the damping over the inertia in 1/s", axis.a)?;
        not_negative("the damping in N m s/rad", axis.damping())
    }

    /// What input and load accelerate the screw by, rad/s^2.
    fn driving_acceleration(&self, input: &SVector<f64, 2>) -> f64 {
        self.k * input[0] - input[1] * self.per_inertia
    }
}

impl Plant<2, 2> for BallScrewAxis {
    #[inline]
    fn derivative(&self, state: &SVector<f64, 2>, input: &SVector<f64, 2>) -> SVector<f64, 2> {
        vector![state[1], self.driving_acceleration(input) - self.a * state[1] - self.b * state[0]]
    }
}

impl HeldLinear<2, 2> for BallScrewAxis {
    fn transition(&self, interval: f64) -> Result<Transition<2, 2>, ModelError> {
        let system = self.state_space()?;
        zero_order_hold(system.a(), system.b(), interval)
    }
}
