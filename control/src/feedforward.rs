//! The force that a motion needs, from the motion itself.

use profiles::{Real, Sample};

use crate::error::FeedforwardError;
use crate::range::{not_negative, positive};

/// Feedforward of the derivatives of a reference `r`:
///
/// `F = k_v r' + k_a r'' + k_j r''' + k_s r''''`
///
/// in N for a reference in m, in N m for a reference in rad. Gains are finite and may have any sign.
///
/// ```
/// use control::Feedforward;
/// use profiles::Sample;
///
/// // 3 kg with 8 N s/m of viscous friction
/// let feedforward = Feedforward::rigid(3.0, 8.0)?;
/// let sample = Sample { velocity: 0.5, acceleration: 2.0, ..Sample::default() };
/// assert_eq!(feedforward.force(&sample), 10.0);
/// # Ok::<(), control::FeedforwardError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        try_from = "UncheckedFeedforward<F>",
        bound(serialize = "F: serde::Serialize", deserialize = "F: Real + serde::Deserialize<'de>")
    )
)]
pub struct Feedforward<F = f64> {
    velocity: F,
    acceleration: F,
    jerk: F,
    snap: F,
}

#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
#[serde(default, deny_unknown_fields, bound(deserialize = "F: Real + serde::Deserialize<'de>"))]
#[derive(Default)]
struct UncheckedFeedforward<F> {
    velocity: F,
    acceleration: F,
    jerk: F,
    snap: F,
}

#[cfg(feature = "serde")]
impl<F: Real> TryFrom<UncheckedFeedforward<F>> for Feedforward<F> {
    type Error = FeedforwardError;
    fn try_from(unchecked: UncheckedFeedforward<F>) -> Result<Self, FeedforwardError> {
        Self::NONE
            .with_velocity(unchecked.velocity)?
            .with_acceleration(unchecked.acceleration)?
            .with_jerk(unchecked.jerk)?
            .with_snap(unchecked.snap)
    }
}

impl<F: Real> Feedforward<F> {
    /// No feedforward: every gain zero.
    pub const NONE: Self = Self { velocity: F::ZERO, acceleration: F::ZERO, jerk: F::ZERO, snap: F::ZERO };

    /// A rigid `mass` in kg against viscous friction `damping` in N s/m (or kg m^2 and N m s/rad).
    ///
    /// From `m x'' + c x' = F` with `x = r`: `k_v = c`, `k_a = m`.
    ///
    /// # Errors
    /// A mass that is not positive and finite, or damping that is negative, infinite or NaN.
    pub fn rigid(mass: F, damping: F) -> Result<Self, FeedforwardError> {
        positive("mass", mass)?;
        not_negative("damping", damping)?;
        Ok(Self { velocity: damping, acceleration: mass, ..Self::NONE })
    }

    /// A motor of `motor_mass` in kg with viscous friction `damping` in N s/m that moves `load_mass` in kg through an
    /// undamped spring of `stiffness` in N/m (or kg m^2, N m s/rad and N m/rad); the load follows the reference.
    ///
    /// From `m_1 x_1'' + c x_1' + k (x_1 - x_2) = F` and `m_2 x_2'' = k (x_1 - x_2)` with the load at `x_2 = r`, the
    /// motor must be at `x_1 = r + (m_2/k) r''`. Inserted in the sum of both equations:
    ///
    /// `k_v = c`, `k_a = m_1 + m_2`, `k_j = c m_2 / k`, `k_s = m_1 m_2 / k`.
    ///
    /// `k_s` is `(m_1 + m_2) / w^2` with the angular frequency `w^2 = k (m_1 + m_2) / (m_1 m_2)` at which motor and
    /// load vibrate against each other when `c = 0`. The reference must have a continuous jerk.
    ///
    /// # Errors
    /// A mass or stiffness that is not positive and finite, damping that is negative, infinite or NaN, or a gain
    /// that leaves the range of `F`.
    pub fn two_mass(motor_mass: F, load_mass: F, stiffness: F, damping: F) -> Result<Self, FeedforwardError> {
        positive("motor mass", motor_mass)?;
        positive("load mass", load_mass)?;
        positive("stiffness", stiffness)?;
        not_negative("damping", damping)?;
        let compliance = load_mass / stiffness;
        Self::rigid(motor_mass + load_mass, damping)?
            .with_jerk(damping * compliance)?
            .with_snap(motor_mass * compliance)
    }

    /// Replaces the velocity gain `k_v`, N s/m.
    ///
    /// # Errors
    /// A gain that is infinite or NaN.
    pub fn with_velocity(self, gain: F) -> Result<Self, FeedforwardError> {
        Ok(Self { velocity: finite("velocity", gain)?, ..self })
    }

    /// Replaces the acceleration gain `k_a`, N s^2/m = kg.
    ///
    /// # Errors
    /// A gain that is infinite or NaN.
    pub fn with_acceleration(self, gain: F) -> Result<Self, FeedforwardError> {
        Ok(Self { acceleration: finite("acceleration", gain)?, ..self })
    }

    /// Replaces the jerk gain `k_j`, N s^3/m.
    ///
    /// # Errors
    /// A gain that is infinite or NaN.
    pub fn with_jerk(self, gain: F) -> Result<Self, FeedforwardError> {
        Ok(Self { jerk: finite("jerk", gain)?, ..self })
    }

    /// Replaces the snap gain `k_s`, N s^4/m.
    ///
    /// # Errors
    /// A gain that is infinite or NaN.
    pub fn with_snap(self, gain: F) -> Result<Self, FeedforwardError> {
        Ok(Self { snap: finite("snap", gain)?, ..self })
    }

    /// Velocity gain `k_v`, N s/m.
    #[must_use]
    pub fn velocity(&self) -> F {
        self.velocity
    }

    /// Acceleration gain `k_a`, kg.
    #[must_use]
    pub fn acceleration(&self) -> F {
        self.acceleration
    }

    /// Jerk gain `k_j`, N s^3/m.
    #[must_use]
    pub fn jerk(&self) -> F {
        self.jerk
    }

    /// Snap gain `k_s`, N s^4/m.
    #[must_use]
    pub fn snap(&self) -> F {
        self.snap
    }

    /// The force for `reference`, N (N m for an angle); not finite where the reference is not, which
    /// [`Pid::update`](crate::Pid::update) answers by holding its output.
    #[inline]
    #[must_use]
    pub fn force(&self, reference: &Sample<F>) -> F {
        self.velocity * reference.velocity
            + self.acceleration * reference.acceleration
            + self.jerk * reference.jerk
            + self.snap * reference.snap
    }
}

fn finite<F: Real>(which: &'static str, value: F) -> Result<F, FeedforwardError> {
    if value.is_finite() { Ok(value) } else { Err(FeedforwardError::Gain { which, value: value.to_f64() }) }
}

#[cfg(test)]
#[expect(clippy::float_cmp, reason = "numbers that are exact in binary")]
mod tests {
    use super::*;

    #[test]
    fn every_derivative_meets_its_own_gain() {
        let feedforward = Feedforward::<f32>::NONE
            .with_velocity(2.0)
            .and_then(|f| f.with_acceleration(3.0))
            .and_then(|f| f.with_jerk(5.0))
            .and_then(|f| f.with_snap(7.0))
            .expect("valid");
        let sample = Sample { position: 9.0, velocity: 1.0, acceleration: 10.0, jerk: 100.0, snap: 1000.0 };
        // 2 * 1 + 3 * 10 + 5 * 100 + 7 * 1000, exact in f32; the position has no share.
        assert_eq!(feedforward.force(&sample), 7532.0);
    }

    #[test]
    fn the_snap_gain_is_the_total_mass_over_the_squared_mode() {
        let (motor, load, stiffness) = (2.0, 3.0, 6e3);
        let feedforward = Feedforward::two_mass(motor, load, stiffness, 4.0).expect("valid");
        let mode_squared = stiffness * (1.0 / motor + 1.0 / load);
        assert!((feedforward.snap() * mode_squared / (motor + load) - 1.0).abs() < 4.0 * f64::EPSILON);
    }

    #[test]
    fn bad_parameters_are_named() {
        assert!(matches!(Feedforward::<f64>::NONE.with_jerk(f64::NAN),
            Err(FeedforwardError::Gain { which: "jerk", value }) if value.is_nan()));
        assert_eq!(
            Feedforward::rigid(0.0, 1.0),
            Err(FeedforwardError::Parameter { which: "mass", range: "positive", value: 0.0 })
        );
        assert_eq!(
            Feedforward::rigid(1.0, -1.0),
            Err(FeedforwardError::Parameter { which: "damping", range: "not negative", value: -1.0 })
        );
        assert!(Feedforward::two_mass(1.0, 1.0, f64::INFINITY, 0.0).is_err());
        assert!(Feedforward::two_mass(1e30_f32, 1e30, 1.0, 0.0).is_err(), "snap gain beyond f32");
    }
}
