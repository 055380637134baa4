//! What a sliding mode controller is set to, checked once.

use profiles::Real;

use super::actuator::OutputLimits;
use super::model::AxisModel;
use super::reaching::ReachingLaw;
use super::sampling::Sampling;
use super::surface::{Prepared, SlidingSurface};
use crate::error::SlidingModeError;
use crate::range::not_negative;

/// A checked sliding mode controller: a surface, the law by which it is reached, and the axis; any number of axes may
/// share it, each with its own [`SlidingModeState`](crate::SlidingModeState).
///
/// ```
/// use control::{
///     AxisModel, ReachingLaw, SlidingMode, SlidingModeInput, SlidingModeState, SlidingSurface,
/// };
/// use profiles::Sample;
///
/// let surface = SlidingSurface::terminal(10.0, 1.0, 9, 5)?;
/// let law = ReachingLaw::improved_double_power(20.0, 20.0, 200.0, 1.0 / 3.0, 1.0 / 3.0)?;
/// let controller = SlidingMode::new(surface, law, AxisModel::new(10.0, 1.0, 1.0)?, 1e-3)?
///     .with_integral_compensation(20.0)?
///     .with_output_limits(-400.0, 400.0)?;
///
/// let mut axis = SlidingModeState::new();
/// let reference = Sample { position: 0.2, velocity: 1.0, acceleration: 3.0, ..Sample::default() };
/// let output = controller.update(&mut axis, SlidingModeInput::new(&reference, 0.2, 1.0));
/// assert_eq!((output.output, output.surface), (13.2, 0.0)); // on the reference: 3 + 10 1 + 1 0.2
/// # Ok::<(), control::SlidingModeError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        try_from = "super::unchecked::UncheckedSlidingMode<F>",
        into = "super::unchecked::UncheckedSlidingMode<F>",
        bound(serialize = "F: Real + serde::Serialize", deserialize = "F: Real + serde::Deserialize<'de>")
    )
)]
pub struct SlidingMode<F = f64> {
    surface: SlidingSurface<F>,
    pub(super) law: ReachingLaw<F>,
    pub(super) model: AxisModel<F>,
    period: F,
    integral_gain: F,
    pub(super) sampling: Sampling,
    pub(super) limits: OutputLimits<F>,
    // What the tick needs, computed once.
    pub(super) prepared: Prepared<F>,
    /// `1 / k`.
    pub(super) inverse_gain: F,
    /// `k4 h / k`.
    pub(super) integral_step: F,
}

impl<F: Real> SlidingMode<F> {
    /// Surface, reaching law, model of the axis and sampling period `h` in s; explicit sampling, no integral, output
    /// unlimited.
    ///
    /// # Errors
    /// A period that is not positive and finite, or a surface whose slope or gains leave the range of `F`.
    pub fn new(
        surface: SlidingSurface<F>,
        law: ReachingLaw<F>,
        model: AxisModel<F>,
        period: F,
    ) -> Result<Self, SlidingModeError> {
        if !(period > F::ZERO && period.is_finite()) {
            return Err(SlidingModeError::Period(period.to_f64()));
        }
        Ok(Self {
            surface,
            law,
            model,
            period,
            integral_gain: F::ZERO,
            sampling: Sampling::Explicit,
            limits: OutputLimits::none(),
            prepared: surface.prepared(period)?,
            inverse_gain: F::ONE / model.gain(),
            integral_step: F::ZERO,
        })
    }

    /// Replaces the gain `k4` of the integral of the error, 1/s^3; zero leaves it out. The integral stops where the output
    /// is limited, and follows what the actuator realised, as that of [`Pid`](crate::Pid) with clamping does.
    ///
    /// # Errors
    /// A gain that is negative, infinite or NaN, or one that leaves the range of `F` when multiplied by the period and
    /// divided by the gain of the axis.
    pub fn with_integral_compensation(self, k4: F) -> Result<Self, SlidingModeError> {
        not_negative("integral gain", k4)?;
        let integral_step = k4 * self.period * self.inverse_gain;
        if !integral_step.is_finite() {
            let quantity = "integral gain times the period over the gain of the axis";
            return Err(SlidingModeError::Range { quantity, value: integral_step.to_f64() });
        }
        Ok(Self { integral_gain: k4, integral_step, ..self })
    }

    /// Replaces how the reaching law is sampled.
    ///
    /// # Errors
    /// [`Sampling::Implicit`] with a law other than the constant and the exponential one, or with another switching than
    /// the sign.
    pub fn with_sampling(self, sampling: Sampling) -> Result<Self, SlidingModeError> {
        if sampling == Sampling::Implicit && self.law.signed_linear().is_none() {
            return Err(SlidingModeError::NoImplicitForm);
        }
        Ok(Self { sampling, ..self })
    }

    /// Replaces the output limits, in the unit of the output; infinity means unlimited.
    ///
    /// # Errors
    /// A lower limit that does not lie below the upper one.
    pub fn with_output_limits(self, lower: F, upper: F) -> Result<Self, SlidingModeError> {
        Ok(Self { limits: OutputLimits::new(lower, upper)?, ..self })
    }

    /// The surface.
    #[must_use]
    pub fn surface(&self) -> SlidingSurface<F> {
        self.surface
    }

    /// The reaching law.
    #[must_use]
    pub fn law(&self) -> ReachingLaw<F> {
        self.law
    }

    /// The model of the axis.
    #[must_use]
    pub fn model(&self) -> AxisModel<F> {
        self.model
    }

    /// The sampling period `h`, s.
    #[must_use]
    pub fn period(&self) -> F {
        self.period
    }

    /// The gain `k4` of the integral of the error, 1/s^3.
    #[must_use]
    pub fn integral_gain(&self) -> F {
        self.integral_gain
    }

    /// How the reaching law is sampled.
    #[must_use]
    pub fn sampling(&self) -> Sampling {
        self.sampling
    }

    /// The lower and the upper output limit.
    #[must_use]
    pub fn output_limits(&self) -> (F, F) {
        (self.limits.lower, self.limits.upper)
    }

    /// Within this distance of zero a terminal surface is a straight line, m, see [`SlidingSurface::terminal`]; `None` for
    /// the other surfaces.
    #[must_use]
    pub fn guard(&self) -> Option<F> {
        match self.prepared {
            Prepared::Terminal { guard, .. } => Some(guard),
            _ => None,
        }
    }
}
