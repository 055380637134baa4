//! What an axis can do.

use super::Interval;
use crate::error::LimitsError;

/// Bounds on the derivatives of position along an axis; infinity means unlimited.
///
/// The bounds are those of the axis, not of the move: a move in the positive direction accelerates with the upper
/// bound of the acceleration and decelerates with the lower one, a move in the negative direction the other way
/// round. For a deceleration that goes with the direction of motion, plan a negative move with [`Limits::mirrored`].
///
/// ```
/// use profiles::Limits;
///
/// // 0.2 m/s, 4 m/s^2, 200 m/s^3, 12 500 m/s^4, and a brake that only holds 3 m/s^2
/// let limits = Limits::new(0.2, 4.0, 200.0)?.with_snap(12_500.0)?.with_deceleration(3.0)?;
/// assert_eq!(limits.acceleration().lower, -3.0);
/// assert!(Limits::new(0.2, -4.0, 200.0).is_err());
/// # Ok::<(), profiles::LimitsError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "written::WrittenLimits", into = "written::WrittenLimits"))]
pub struct Limits {
    velocity: Interval,
    acceleration: Interval,
    jerk: Interval,
    snap: f64,
}

impl Limits {
    /// No limit at all.
    pub const UNLIMITED: Self = Self {
        velocity: Interval::UNBOUNDED,
        acceleration: Interval::UNBOUNDED,
        jerk: Interval::UNBOUNDED,
        snap: f64::INFINITY,
    };

    /// Symmetric limits: velocity in m/s, acceleration in m/s^2, jerk in m/s^3 (or rad); snap unlimited.
    ///
    /// # Errors
    /// A limit that is not positive (infinity is fine).
    pub fn new(velocity: f64, acceleration: f64, jerk: f64) -> Result<Self, LimitsError> {
        Self::UNLIMITED
            .with_velocity(Interval::symmetric(velocity))?
            .with_acceleration(Interval::symmetric(acceleration))?
            .with_jerk(Interval::symmetric(jerk))
    }

    /// Replaces the bounds of the velocity, m/s.
    ///
    /// # Errors
    /// Bounds that do not lie on both sides of zero.
    pub fn with_velocity(self, velocity: Interval) -> Result<Self, LimitsError> {
        Ok(Self { velocity: around_zero("velocity", velocity)?, ..self })
    }

    /// Replaces the bounds of the acceleration, m/s^2.
    ///
    /// # Errors
    /// Bounds that do not lie on both sides of zero.
    pub fn with_acceleration(self, acceleration: Interval) -> Result<Self, LimitsError> {
        Ok(Self { acceleration: around_zero("acceleration", acceleration)?, ..self })
    }

    /// Replaces the lower bound of the acceleration by `-deceleration`, m/s^2.
    ///
    /// # Errors
    /// A deceleration that is not positive.
    pub fn with_deceleration(self, deceleration: f64) -> Result<Self, LimitsError> {
        self.with_acceleration(Interval::new(-deceleration, self.acceleration.upper))
    }

    /// Replaces the bounds of the jerk, m/s^3.
    ///
    /// # Errors
    /// Bounds that do not lie on both sides of zero.
    pub fn with_jerk(self, jerk: Interval) -> Result<Self, LimitsError> {
        Ok(Self { jerk: around_zero("jerk", jerk)?, ..self })
    }

    /// Replaces the symmetric limit of the derivative of jerk, m/s^4.
    ///
    /// # Errors
    /// A limit that is not positive.
    pub fn with_snap(self, snap: f64) -> Result<Self, LimitsError> {
        around_zero("snap", Interval::symmetric(snap))?;
        Ok(Self { snap, ..self })
    }

    /// Bounds of the velocity, m/s.
    #[must_use]
    pub fn velocity(&self) -> Interval {
        self.velocity
    }

    /// Bounds of the acceleration, m/s^2.
    #[must_use]
    pub fn acceleration(&self) -> Interval {
        self.acceleration
    }

    /// Bounds of the jerk, m/s^3.
    #[must_use]
    pub fn jerk(&self) -> Interval {
        self.jerk
    }

    /// Limit of the magnitude of the derivative of jerk, m/s^4.
    #[must_use]
    pub fn snap(&self) -> f64 {
        self.snap
    }

    /// The limits of the same axis looked at from its other end.
    #[must_use]
    pub fn mirrored(&self) -> Self {
        Self {
            velocity: self.velocity.mirrored(),
            acceleration: self.acceleration.mirrored(),
            jerk: self.jerk.mirrored(),
            snap: self.snap,
        }
    }

    /// The limits as a move with the sign of `direction` meets them: upper bounds speed it up, lower ones slow it down.
    pub(crate) fn along(&self, direction: f64) -> Self {
        if direction < 0.0 { self.mirrored() } else { *self }
    }
}

fn around_zero(quantity: &'static str, bounds: Interval) -> Result<Interval, LimitsError> {
    if bounds.lower < 0.0 && bounds.upper > 0.0 {
        Ok(bounds)
    } else {
        Err(LimitsError { quantity, lower: bounds.lower, upper: bounds.upper })
    }
}

#[cfg(feature = "serde")]
mod written {
    //! Limits as they are written down; an absent bound is infinite, which JSON could not say.

    use super::{Interval, Limits, LimitsError};

    #[derive(Default, serde::Serialize, serde::Deserialize)]
    #[serde(deny_unknown_fields, default)]
    pub(super) struct WrittenLimits {
        velocity: WrittenInterval,
        acceleration: WrittenInterval,
        jerk: WrittenInterval,
        #[serde(skip_serializing_if = "Option::is_none")]
        snap: Option<f64>,
    }

    #[derive(Default, serde::Serialize, serde::Deserialize)]
    #[serde(deny_unknown_fields, default)]
    struct WrittenInterval {
        #[serde(skip_serializing_if = "Option::is_none")]
        lower: Option<f64>,
        #[serde(skip_serializing_if = "Option::is_none")]
        upper: Option<f64>,
    }

    impl From<Interval> for WrittenInterval {
        fn from(Interval { lower, upper }: Interval) -> Self {
            let finite = |bound: f64| Some(bound).filter(|b| b.is_finite());
            Self { lower: finite(lower), upper: finite(upper) }
        }
    }

    impl From<WrittenInterval> for Interval {
        fn from(written: WrittenInterval) -> Self {
            Self {
                lower: written.lower.unwrap_or(f64::NEG_INFINITY),
                upper: written.upper.unwrap_or(f64::INFINITY),
            }
        }
    }

    impl From<Limits> for WrittenLimits {
        fn from(limits: Limits) -> Self {
            Self {
                velocity: limits.velocity.into(),
                acceleration: limits.acceleration.into(),
                jerk: limits.jerk.into(),
                snap: Some(limits.snap).filter(|s| s.is_finite()),
            }
        }
    }

    impl TryFrom<WrittenLimits> for Limits {
        type Error = LimitsError;
        fn try_from(written: WrittenLimits) -> Result<Self, LimitsError> {
            Self::UNLIMITED
                .with_velocity(written.velocity.into())?
                .with_acceleration(written.acceleration.into())?
                .with_jerk(written.jerk.into())?
                .with_snap(written.snap.unwrap_or(f64::INFINITY))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bad_limits_are_named_with_their_number() {
        let error = Limits::new(1.0, 0.0, 1.0).expect_err("zero acceleration");
        assert_eq!((error.quantity, error.upper), ("acceleration", 0.0));
        assert!(Limits::new(f64::NAN, 1.0, 1.0).is_err());
        assert!(Limits::UNLIMITED.with_snap(-1.0).is_err());
        assert!(Limits::UNLIMITED.with_velocity(Interval::new(1.0, 2.0)).is_err());
    }

    #[test]
    fn infinity_is_unlimited() {
        assert_eq!(Limits::new(f64::INFINITY, f64::INFINITY, f64::INFINITY), Ok(Limits::UNLIMITED));
    }

    #[test]
    fn mirroring_swaps_the_bounds() {
        let limits = Limits::new(1.0, 2.0, 3.0).and_then(|l| l.with_deceleration(5.0)).expect("valid");
        assert_eq!(limits.mirrored().acceleration(), Interval::new(-2.0, 5.0));
        assert_eq!(limits.mirrored().mirrored(), limits);
    }
}
