//! A timing belt between a motor and a load.

use nalgebra::{Complex, SVector};
use profiles::Mode;

use super::check::positive;
use super::{Plant, StateSpace, TransferFunction, TwoInertia};
use crate::energy::{Energetic, HeldEnergetic, Powers, Work};
use crate::error::ModelError;
use crate::linear::{QuadraticIntegral, Transition, quadratic_roots};
use crate::steppers::HeldLinear;

/// A synchronous belt drive: a motor pulley of inertia `J_g` turns a load of inertia `J_l` through a belt of torsional
/// stiffness `K`.
///
/// - `J_g theta_g'' = T_e - T_l`
/// - `J_l theta_l'' = T_l = K (theta_g - theta_l)`
///
/// The belt as a [`TwoInertia`], undamped unless [`with_damping`](Self::with_damping) says otherwise: the state is
/// `[theta_g, w_g, theta_l, w_l]` in rad and rad/s, the input `[T_e, T]` in N m with a torque `T` that opposes the
/// load. Angles and inertias are those of the motor's shaft.
///
/// There are two frequencies, and it depends on the motor which one the load vibrates at. A motor whose torque is
/// given is free, and both pulleys vibrate against each other at the [`resonance`](Self::resonance); a motor whose
/// angle is given, by a stiff loop around its encoder, holds its end of the belt, and the load vibrates at the lower
/// [`anti_resonance`](Self::anti_resonance). A semi-closed loop is between the two.
///
/// ```
/// use plants::BeltDrive;
///
/// let belt = BeltDrive::new(0.004, 0.03, 2.0)?; // kg m^2, kg m^2, N m/rad
/// assert!((belt.anti_resonance() - (2.0_f64 / 0.03).sqrt()).abs() < 1e-14);
/// assert!((belt.resonance() - (2.0_f64 / 0.03 * (1.0 + 0.03 / 0.004)).sqrt()).abs() < 1e-14);
/// // Turned slowly, the load follows the motor.
/// assert_eq!(belt.load_from_motor()?.dc_gain()?, 1.0);
/// # Ok::<(), plants::ModelError>(())
/// ```
///
/// # References
/// Z. Liu, S. Zhang, L. Cai, J. Yang, B. Xu, P. Xu, "Five-phase S-curve control method based on particle swarm
/// optimization", Journal of Beijing University of Technology 41 (2015), eq. (1) to (5),
/// doi:10.11936/bjutxb2014060067.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(transparent))]
pub struct BeltDrive {
    axis: TwoInertia,
}

impl BeltDrive {
    /// An undamped drive from the inertias of its motor pulley and of its load in kg m^2 and its torsional stiffness
    /// in N m/rad.
    ///
    /// # Errors
    /// As [`TwoInertia::new`].
    pub fn new(pulley_inertia: f64, load_inertia: f64, stiffness: f64) -> Result<Self, ModelError> {
        Ok(Self { axis: TwoInertia::new(pulley_inertia, load_inertia, stiffness)? })
    }

    /// An undamped drive from the stiffness in N/m of one span of a tensioned belt and the radii in m of the pulleys of
    /// motor and load, `r_g` and `r_l`. Both spans pull, so that on the motor's shaft
    ///
    /// `K = 2 k r_g^2`, and the load, which turns `r_g / r_l` times as far, has `J_l (r_g / r_l)^2`.
    ///
    /// The angle of the load is then that of its pulley times `r_l / r_g`.
    ///
    /// # Errors
    /// A number that is not positive and finite, or as [`TwoInertia::new`].
    pub fn from_spans(
        pulley_inertia: f64,
        load_inertia: f64,
        span_stiffness: f64,
        motor_radius: f64,
        load_radius: f64,
    ) -> Result<Self, ModelError> {
        positive("the load inertia in kg m^2", load_inertia)?;
        positive("the stiffness of a span in N/m", span_stiffness)?;
        positive("the radius of the motor pulley in m", motor_radius)?;
        positive("the radius of the load pulley in m", load_radius)?;
        let ratio = motor_radius / load_radius;
        Self::new(
            pulley_inertia,
            load_inertia * ratio * ratio,
            2.0 * span_stiffness * motor_radius * motor_radius,
        )
    }

    /// The same drive with the viscous damping of motor, belt and load in N m s/rad.
    ///
    /// # Errors
    /// As [`TwoInertia::with_damping`].
    pub fn with_damping(self, motor: f64, belt: f64, load: f64) -> Result<Self, ModelError> {
        Ok(Self { axis: self.axis.with_damping(motor, belt, load)? })
    }

    /// The drive as two inertias on a spring.
    #[must_use]
    pub fn axis(&self) -> &TwoInertia {
        &self.axis
    }

    /// The undamped free resonance, rad/s, eq. (5): `sqrt(K / J_l (1 + J_l / J_g))`. The poles of
    /// [`motor_from_torque`](Self::motor_from_torque) are there.
    #[must_use]
    pub fn resonance(&self) -> f64 {
        self.axis.resonance()
    }

    /// The undamped anti-resonance, rad/s: `sqrt(K / J_l)`. The zeros of
    /// [`motor_from_torque`](Self::motor_from_torque) and the poles of [`load_from_motor`](Self::load_from_motor) are
    /// there.
    #[must_use]
    pub fn anti_resonance(&self) -> f64 {
        self.axis.anti_resonance()
    }

    /// The vibration of the load on a motor that is held, at the anti-resonance.
    ///
    /// # Errors
    /// As [`TwoInertia::held_mode`].
    pub fn held_mode(&self) -> Result<Mode, ModelError> {
        self.axis.held_mode()
    }

    /// The vibration of both ends against each other, at the resonance.
    ///
    /// # Errors
    /// As [`TwoInertia::free_mode`].
    pub fn free_mode(&self) -> Result<Mode, ModelError> {
        self.axis.free_mode()
    }

    /// From motor torque in N m to motor angle in rad, eq. (3): undamped
    ///
    /// `theta_g / T_e = (J_l s^2 + K) / (J_g s^2 (J_l s^2 + K) + K J_l s^2)`
    ///
    /// # Errors
    /// A ratio of the parameters beyond the range of double precision.
    pub fn motor_from_torque(&self) -> Result<TransferFunction, ModelError> {
        TransferFunction::new(&self.held_poles(), &self.axis.poles(), 1.0 / self.axis.motor_inertia())
    }

    /// From motor angle to load angle, both in rad, eq. (4): undamped
    ///
    /// `theta_l / theta_g = K / (J_l s^2 + K)`
    ///
    /// # Errors
    /// A ratio of the parameters beyond the range of double precision.
    pub fn load_from_motor(&self) -> Result<TransferFunction, ModelError> {
        self.through_the_belt(&self.held_poles(), self.axis.load_inertia())
    }

    /// From motor torque in N m to load angle in rad, (3) times (4) without what cancels: undamped
    ///
    /// `theta_l / T_e = K / (J_g s^2 (J_l s^2 + K) + K J_l s^2)`
    ///
    /// # Errors
    /// A ratio of the parameters beyond the range of double precision.
    pub fn load_from_torque(&self) -> Result<TransferFunction, ModelError> {
        self.through_the_belt(&self.axis.poles(), self.axis.motor_inertia() * self.axis.load_inertia())
    }

    /// From motor and load torque to all four states.
    ///
    /// # Errors
    /// As [`TwoInertia::state_space`].
    pub fn state_space(&self) -> Result<StateSpace<4, 2, 4>, ModelError> {
        self.axis.state_space()
    }

    /// `(c_s s + K)` over the polynomial with these roots and this highest coefficient.
    fn through_the_belt(&self, poles: &[Complex<f64>], highest: f64) -> Result<TransferFunction, ModelError> {
        let (stiffness, damping) = (self.axis.stiffness(), self.axis.spring_damping());
        if damping > 0.0 {
            TransferFunction::new(&[Complex::new(-stiffness / damping, 0.0)], poles, damping / highest)
        } else {
            TransferFunction::new(&[], poles, stiffness / highest)
        }
    }

    /// The roots of `J_l s^2 + (c_s + c_l) s + K`.
    fn held_poles(&self) -> [Complex<f64>; 2] {
        let w = self.anti_resonance();
        let rate = (self.axis.spring_damping() + self.axis.load_damping()) / self.axis.load_inertia();
        quadratic_roots(rate / w, 1.0).map(|root| root * w)
    }
}

impl Plant<4, 2> for BeltDrive {
    #[inline]
    fn derivative(&self, state: &SVector<f64, 4>, input: &SVector<f64, 2>) -> SVector<f64, 4> {
        self.axis.derivative(state, input)
    }
}

impl HeldLinear<4, 2> for BeltDrive {
    fn transition(&self, interval: f64) -> Result<Transition<4, 2>, ModelError> {
        self.axis.transition(interval)
    }
}

impl Energetic<4, 2> for BeltDrive {
    fn stored(&self, state: &SVector<f64, 4>) -> f64 {
        self.axis.stored(state)
    }

    fn powers(&self, state: &SVector<f64, 4>, input: &SVector<f64, 2>) -> Powers {
        self.axis.powers(state, input)
    }
}

impl HeldEnergetic<4, 2> for BeltDrive {
    fn heat(&self, interval: f64) -> Result<QuadraticIntegral<4, 2>, ModelError> {
        self.axis.heat(interval)
    }

    fn work(&self, realised: &SVector<f64, 2>, change: &SVector<f64, 4>) -> Work {
        self.axis.work(realised, change)
    }
}
