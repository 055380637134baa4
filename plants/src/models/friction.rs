//! Friction of a bearing or a guide.

use profiles::Real;

use super::check::{not_negative, positive};
use crate::error::ModelError;

/// Friction at a speed `w`, against the motion: viscous, Coulomb, and Stribeck's rise towards standstill.
///
/// `T_f = c w + sign(w) [T_c + (T_s - T_c) e^(-|w / w_s|^d)]`
///
/// with the viscous coefficient `c`, the Coulomb torque `T_c`, the breakaway torque `T_s`, the Stribeck speed `w_s` and
/// the exponent `d`. At standstill friction is whatever keeps it, up to `T_s` either way. Torques are in N m and speeds
/// in rad/s, or forces in N and speeds in m/s.
///
/// ```
/// use plants::Friction;
///
/// let friction = Friction::coulomb(2.0)?.with_stribeck(3.0, 0.01, 2.0)?.with_viscous(0.5)?;
/// assert_eq!(friction.torque(-4.0), -4.0); // 2 N m and 0.5 N m s/rad
/// assert!((friction.torque(1e-6) - 3.0).abs() < 1e-6);
/// assert_eq!(friction.breakaway(), 3.0);
/// # Ok::<(), plants::ModelError>(())
/// ```
///
/// # References
/// B. Armstrong-Hélouvry, P. Dupont, C. Canudas de Wit, "A survey of models, analysis tools and compensation methods
/// for the control of machines with friction", Automatica 30 (1994), doi:10.1016/0005-1098(94)90209-7.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedFriction", into = "UncheckedFriction"))]
pub struct Friction {
    viscous: f64,
    coulomb: f64,
    breakaway: f64,
    stribeck_speed: f64,
    exponent: f64,
}

#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
struct UncheckedFriction {
    viscous: f64,
    coulomb: f64,
    breakaway: f64,
    stribeck_speed: f64,
    exponent: f64,
}

#[cfg(feature = "serde")]
impl TryFrom<UncheckedFriction> for Friction {
    type Error = ModelError;
    fn try_from(friction: UncheckedFriction) -> Result<Self, ModelError> {
        Self::coulomb(friction.coulomb)?.with_viscous(friction.viscous)?.with_stribeck(
            friction.breakaway,
            friction.stribeck_speed,
            friction.exponent,
        )
    }
}

#[cfg(feature = "serde")]
impl From<Friction> for UncheckedFriction {
    fn from(friction: Friction) -> Self {
        let Friction { viscous, coulomb, breakaway, stribeck_speed, exponent } = friction;
        Self { viscous, coulomb, breakaway, stribeck_speed, exponent }
    }
}

impl Friction {
    /// No friction.
    #[must_use]
    pub fn none() -> Self {
        Self { viscous: 0.0, coulomb: 0.0, breakaway: 0.0, stribeck_speed: 1.0, exponent: 2.0 }
    }

    /// Coulomb friction from its torque in N m: the same at every speed, and as much at standstill.
    ///
    /// # Errors
    /// A torque that is negative or not finite.
    pub fn coulomb(torque: f64) -> Result<Self, ModelError> {
        not_negative("the Coulomb torque in N m", torque)?;
        Ok(Self { coulomb: torque, breakaway: torque, ..Self::none() })
    }

    /// The same friction with a viscous coefficient in N m s/rad besides.
    ///
    /// # Errors
    /// A coefficient that is negative or not finite.
    pub fn with_viscous(self, coefficient: f64) -> Result<Self, ModelError> {
        not_negative("the viscous friction in N m s/rad", coefficient)?;
        Ok(Self { viscous: coefficient, ..self })
    }

    /// The same friction with a breakaway torque in N m, from which it falls to the Coulomb torque over the Stribeck
    /// speed in rad/s, by an exponent. Usual exponents are 1 and 2; below one the slope at standstill is infinite.
    ///
    /// # Errors
    /// A breakaway torque that is not finite or below the Coulomb torque, a speed that is not positive and finite, or
    /// an exponent outside `[1, 16]`.
    pub fn with_stribeck(self, breakaway: f64, speed: f64, exponent: f64) -> Result<Self, ModelError> {
        if !(breakaway >= self.coulomb && breakaway.is_finite()) {
            let parameter = "the breakaway torque in N m";
            let range = "finite and not below the Coulomb torque";
            return Err(ModelError::Parameter { parameter, range, value: breakaway });
        }
        positive("the Stribeck speed in rad/s", speed)?;
        if !(1.0..=16.0).contains(&exponent) {
            let parameter = "the Stribeck exponent";
            return Err(ModelError::Parameter { parameter, range: "from 1 to 16", value: exponent });
        }
        Ok(Self { breakaway, stribeck_speed: speed, exponent, ..self })
    }

    /// Viscous coefficient `c`, N m s/rad.
    #[must_use]
    pub fn viscous(&self) -> f64 {
        self.viscous
    }

    /// Coulomb torque `T_c`, N m.
    #[must_use]
    pub fn coulomb_torque(&self) -> f64 {
        self.coulomb
    }

    /// Breakaway torque `T_s`, N m: the most that friction holds at standstill.
    #[must_use]
    pub fn breakaway(&self) -> f64 {
        self.breakaway
    }

    /// Stribeck speed `w_s`, rad/s.
    #[must_use]
    pub fn stribeck_speed(&self) -> f64 {
        self.stribeck_speed
    }

    /// Exponent `d` of the fall from breakaway to Coulomb torque.
    #[must_use]
    pub fn exponent(&self) -> f64 {
        self.exponent
    }

    /// The torque `T_f` at a speed in rad/s, N m, with the sign of the speed; zero at standstill, where it is not given
    /// by the speed.
    #[must_use]
    pub fn torque(&self, speed: f64) -> f64 {
        let dry = if speed.abs() > 0.0 { self.dry(speed.abs()).copysign(speed) } else { 0.0 };
        self.viscous * speed + dry
    }

    /// Whether friction is viscous at most, so that the axis is linear.
    #[must_use]
    pub fn is_linear(&self) -> bool {
        self.breakaway <= 0.0
    }

    /// What is not viscous, N m, at a speed that is not negative.
    pub(super) fn dry(&self, speed: f64) -> f64 {
        let excess = self.breakaway - self.coulomb;
        if excess <= 0.0 {
            return self.coulomb;
        }
        let ratio = speed / self.stribeck_speed;
        // The usual exponents without a power.
        let power = if self.exponent.to_bits() == 2.0_f64.to_bits() {
            ratio * ratio
        } else if self.exponent.to_bits() == 1.0_f64.to_bits() {
            ratio
        } else {
            Real::powf(ratio, self.exponent)
        };
        self.coulomb + excess * Real::exp(-power)
    }

    /// The steepest fall of the torque with the speed, N m s/rad: at `x^d = 1 - 1/d` of `d x^(d-1) e^(-x^d)`.
    pub(super) fn steepest_fall(&self) -> f64 {
        let inner = 1.0 - 1.0 / self.exponent;
        let slope =
            if inner > 0.0 { self.exponent * Real::powf(inner, inner) * Real::exp(-inner) } else { 1.0 };
        slope * (self.breakaway - self.coulomb) / self.stribeck_speed
    }
}

impl Default for Friction {
    fn default() -> Self {
        Self::none()
    }
}
