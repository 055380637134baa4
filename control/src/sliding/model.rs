//! What a sliding mode controller knows of its axis.

use profiles::Real;

use crate::error::SlidingModeError;
use crate::range::{in_range, not_negative};

/// An axis of second order, `x'' = -a x' - b x + k u + d`, with position `x` in m or rad, input `u` in `U`, and a load
/// `d` in m/s^2 or rad/s^2 that nobody knows.
///
/// ```
/// use control::AxisModel;
///
/// let axis = AxisModel::new(10.0, 1.0, 1.0)?;
/// assert_eq!((axis.damping(), axis.stiffness(), axis.gain()), (10.0, 1.0, 1.0));
/// assert!(AxisModel::new(10.0, 1.0, 0.0).is_err());
/// # Ok::<(), control::SlidingModeError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        try_from = "UncheckedAxisModel<F>",
        bound(serialize = "F: serde::Serialize", deserialize = "F: Real + serde::Deserialize<'de>")
    )
)]
pub struct AxisModel<F = f64> {
    damping: F,
    stiffness: F,
    gain: F,
}

#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct UncheckedAxisModel<F> {
    damping: F,
    stiffness: F,
    gain: F,
}

#[cfg(feature = "serde")]
impl<F: Real> TryFrom<UncheckedAxisModel<F>> for AxisModel<F> {
    type Error = SlidingModeError;
    fn try_from(unchecked: UncheckedAxisModel<F>) -> Result<Self, SlidingModeError> {
        Self::new(unchecked.damping, unchecked.stiffness, unchecked.gain)
    }
}

impl<F: Real> AxisModel<F> {
    /// Damping `a` in 1/s, stiffness `b` in 1/s^2 and gain `k` in m/s^2 per `U`: those of an inertia `J` with viscous
    /// friction `f` and a spring `c` are `f / J`, `c / J` and `1 / J`.
    ///
    /// # Errors
    /// Damping or stiffness that is negative, infinite or NaN, or a gain that is zero, infinite or NaN or whose inverse is.
    pub fn new(damping: F, stiffness: F, gain: F) -> Result<Self, SlidingModeError> {
        not_negative("damping of the axis", damping)?;
        not_negative("stiffness of the axis", stiffness)?;
        in_range("gain of the axis", "not zero", gain, (F::ONE / gain).is_finite())?;
        Ok(Self { damping, stiffness, gain })
    }

    /// The damping `a`, 1/s.
    #[must_use]
    pub fn damping(&self) -> F {
        self.damping
    }

    /// The stiffness `b`, 1/s^2.
    #[must_use]
    pub fn stiffness(&self) -> F {
        self.stiffness
    }

    /// The gain `k`, m/s^2 per `U`.
    #[must_use]
    pub fn gain(&self) -> F {
        self.gain
    }

    /// The acceleration `k u` that the input must give for the axis to accelerate with `acceleration` at `position` and
    /// `velocity`, m/s^2.
    #[inline]
    #[must_use]
    pub fn effort(&self, acceleration: F, position: F, velocity: F) -> F {
        acceleration + self.damping * velocity + self.stiffness * position
    }
}
