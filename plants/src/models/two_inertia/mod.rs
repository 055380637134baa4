//! A motor that drives a load through a spring.

mod energy;
mod poles;
mod response;

use nalgebra::{SMatrix, SVector, matrix, vector};

use super::check::{not_negative, positive};
use super::{Plant, StateSpace};
use crate::error::ModelError;
use crate::linear::{Transition, zero_order_hold};
use crate::steppers::HeldLinear;

/// A motor of inertia `J_m` and a load of inertia `J_l` on the two ends of a spring of stiffness `K`:
///
/// - `J_m w_m' = T_m - T_s - c_m w_m`
/// - `J_l w_l' = T_s - T_l - c_l w_l`
/// - `T_s = K (theta_m - theta_l) + c_s (w_m - w_l)`
///
/// with viscous damping `c_m` of the motor, `c_s` of the spring and `c_l` of the load. The state is
/// `[theta_m, w_m, theta_l, w_l]` in rad and rad/s. The input is `[T_m, T_l]` in N m; the load torque `T_l` opposes
/// the load.
///
/// ```
/// use plants::{Plant, TwoInertia, nalgebra::{self, vector}};
///
/// let axis = TwoInertia::new(0.003, 5e-4, 100.0)?.with_damping(0.008, 0.006, 0.0)?;
/// assert!((axis.anti_resonance() - 447.2).abs() < 0.1); // rad/s
/// assert!((axis.resonance() - 483.0).abs() < 0.1);
/// // 0.1 rad of twist pull at the motor and at the load with 10 N m.
/// let derivative = axis.derivative(&vector![0.1, 0.0, 0.0, 0.0], &vector![0.0, 0.0]);
/// assert!((derivative - vector![0.0, -10.0 / 0.003, 0.0, 10.0 / 5e-4]).norm() < 1e-10);
/// # Ok::<(), plants::ModelError>(())
/// ```
///
/// # References
/// J. Wu and H. Zhang, "Residual vibration suppression of servo system based on time delay filter", Journal of
/// Mechanical & Electrical Engineering 36 (2019), eq. (1), doi:10.3969/j.issn.1001-4551.2019.09.007.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedTwoInertia", into = "UncheckedTwoInertia"))]
pub struct TwoInertia {
    motor_inertia: f64,
    load_inertia: f64,
    stiffness: f64,
    motor_damping: f64,
    spring_damping: f64,
    load_damping: f64,
    // A division takes as long as ten products.
    per_motor_inertia: f64,
    per_load_inertia: f64,
}

#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
struct UncheckedTwoInertia {
    motor_inertia: f64,
    load_inertia: f64,
    stiffness: f64,
    motor_damping: f64,
    spring_damping: f64,
    load_damping: f64,
}

#[cfg(feature = "serde")]
impl TryFrom<UncheckedTwoInertia> for TwoInertia {
    type Error = ModelError;
    fn try_from(axis: UncheckedTwoInertia) -> Result<Self, ModelError> {
        Self::new(axis.motor_inertia, axis.load_inertia, axis.stiffness)?.with_damping(
            axis.motor_damping,
            axis.spring_damping,
            axis.load_damping,
        )
    }
}

#[cfg(feature = "serde")]
impl From<TwoInertia> for UncheckedTwoInertia {
    fn from(axis: TwoInertia) -> Self {
        Self {
            motor_inertia: axis.motor_inertia,
            load_inertia: axis.load_inertia,
            stiffness: axis.stiffness,
            motor_damping: axis.motor_damping,
            spring_damping: axis.spring_damping,
            load_damping: axis.load_damping,
        }
    }
}

impl TwoInertia {
    /// An undamped axis from the inertias of its motor and of its load in kg m^2 and the stiffness between them in
    /// N m/rad.
    ///
    /// # Errors
    /// A number that is not positive and finite, or a ratio of stiffness to inertia beyond the range of double
    /// precision.
    pub fn new(motor_inertia: f64, load_inertia: f64, stiffness: f64) -> Result<Self, ModelError> {
        positive("the motor inertia in kg m^2", motor_inertia)?;
        positive("the load inertia in kg m^2", load_inertia)?;
        positive("the stiffness in N m/rad", stiffness)?;
        let axis = Self {
            motor_inertia,
            load_inertia,
            stiffness,
            motor_damping: 0.0,
            spring_damping: 0.0,
            load_damping: 0.0,
            per_motor_inertia: 1.0 / motor_inertia,
            per_load_inertia: 1.0 / load_inertia,
        };
        positive("the stiffness over the inertias in 1/s^2", axis.squared_resonance())?;
        Ok(axis)
    }

    /// The same axis with the viscous damping of motor, spring and load in N m s/rad.
    ///
    /// # Errors
    /// A damping that is negative or not finite, or a ratio of damping to inertia beyond the range of double
    /// precision.
    pub fn with_damping(self, motor: f64, spring: f64, load: f64) -> Result<Self, ModelError> {
        not_negative("the motor damping in N m s/rad", motor)?;
        not_negative("the spring damping in N m s/rad", spring)?;
        not_negative("the load damping in N m s/rad", load)?;
        let axis = Self { motor_damping: motor, spring_damping: spring, load_damping: load, ..self };
        not_negative("the damping over the inertias in 1/s", axis.trace())?;
        Ok(axis)
    }

    /// Inertia of the motor `J_m`, kg m^2.
    #[must_use]
    pub fn motor_inertia(&self) -> f64 {
        self.motor_inertia
    }

    /// Inertia of the load `J_l`, kg m^2.
    #[must_use]
    pub fn load_inertia(&self) -> f64 {
        self.load_inertia
    }

    /// Stiffness of the spring `K`, N m/rad.
    #[must_use]
    pub fn stiffness(&self) -> f64 {
        self.stiffness
    }

    /// Viscous damping of the motor `c_m`, N m s/rad.
    #[must_use]
    pub fn motor_damping(&self) -> f64 {
        self.motor_damping
    }

    /// Viscous damping of the spring `c_s`, N m s/rad.
    #[must_use]
    pub fn spring_damping(&self) -> f64 {
        self.spring_damping
    }

    /// Viscous damping of the load `c_l`, N m s/rad.
    #[must_use]
    pub fn load_damping(&self) -> f64 {
        self.load_damping
    }

    /// The torque of the spring and its damping on the load, N m: `K (theta_m - theta_l) + c_s (w_m - w_l)`.
    #[inline]
    #[must_use]
    pub fn spring_torque(&self, state: &SVector<f64, 4>) -> f64 {
        self.stiffness * (state[0] - state[2]) + self.spring_damping * (state[1] - state[3])
    }

    /// From motor and load torque to all four states.
    ///
    /// # Errors
    /// A ratio of the parameters beyond the range of double precision.
    pub fn state_space(&self) -> Result<StateSpace<4, 2, 4>, ModelError> {
        let (m, l) = (self.per_motor_inertia, self.per_load_inertia);
        let (k, c) = (self.stiffness, self.spring_damping);
        StateSpace::new(
            matrix![
                0.0, 1.0, 0.0, 0.0;
                -k * m, -(c + self.motor_damping) * m, k * m, c * m;
                0.0, 0.0, 0.0, 1.0;
                k * l, c * l, -k * l, -(c + self.load_damping) * l
            ],
            matrix![0.0, 0.0; m, 0.0; 0.0, 0.0; 0.0, -l],
            SMatrix::identity(),
            SMatrix::zeros(),
        )
    }

    /// The derivative of a state under the torque on the motor less that of its damping, and the load torque, N m.
    #[inline]
    pub(in crate::models) fn motion(
        &self,
        state: &SVector<f64, 4>,
        driving: f64,
        load: f64,
    ) -> SVector<f64, 4> {
        let spring = self.spring_torque(state);
        vector![
            state[1],
            (driving - spring) * self.per_motor_inertia,
            state[3],
            (spring - (load + self.load_damping * state[3])) * self.per_load_inertia
        ]
    }

    /// The square of the resonance, 1/s^2.
    fn squared_resonance(&self) -> f64 {
        self.stiffness * self.per_motor_inertia + self.stiffness * self.per_load_inertia
    }

    /// The sum of the poles, 1/s, with its sign turned.
    fn trace(&self) -> f64 {
        (self.motor_damping + self.spring_damping) * self.per_motor_inertia
            + (self.load_damping + self.spring_damping) * self.per_load_inertia
    }
}

impl Plant<4, 2> for TwoInertia {
    #[inline]
    fn derivative(&self, state: &SVector<f64, 4>, input: &SVector<f64, 2>) -> SVector<f64, 4> {
        self.motion(state, input[0] - self.motor_damping * state[1], input[1])
    }
}

impl HeldLinear<4, 2> for TwoInertia {
    fn transition(&self, interval: f64) -> Result<Transition<4, 2>, ModelError> {
        let system = self.state_space()?;
        zero_order_hold(system.a(), system.b(), interval)
    }
}
