//! Output limits and an integral that heeds them.

use profiles::Real;

use crate::error::SlidingModeError;
use crate::pid::Status;

/// The output limits, in the unit of the output.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct OutputLimits<F> {
    pub(super) lower: F,
    pub(super) upper: F,
}

/// What a tick gives and remembers.
#[derive(Debug, Clone, Copy)]
pub(super) struct Step<F> {
    pub(super) output: F,
    pub(super) integral: F,
    pub(super) status: Status,
}

impl<F: Real> OutputLimits<F> {
    pub(super) fn none() -> Self {
        Self { lower: F::from_f64(f64::NEG_INFINITY), upper: F::from_f64(f64::INFINITY) }
    }

    pub(super) fn new(lower: F, upper: F) -> Result<Self, SlidingModeError> {
        if lower < upper {
            Ok(Self { lower, upper })
        } else {
            Err(SlidingModeError::OutputLimits { lower: lower.to_f64(), upper: upper.to_f64() })
        }
    }

    /// `known + integral`, where the integral takes of `increment` only what does not move the output beyond a limit, and
    /// nothing in a direction in which the actuator fell short, by `shortfall`, at the previous tick. The increment counts
    /// at this tick where `at_once`, from the next one on otherwise. `None` where a sum is not finite.
    #[inline(always)]
    pub(super) fn step(
        &self,
        known: F,
        integral: F,
        increment: F,
        shortfall: F,
        at_once: bool,
    ) -> Option<Step<F>> {
        let short_above = (increment > F::ZERO) & (shortfall > F::ZERO);
        let short_below = (increment < F::ZERO) & (shortfall < F::ZERO);
        let increment = if short_above | short_below { F::ZERO } else { increment };
        let before = known + integral;
        let kept = increment.clamped((self.lower - before).min(F::ZERO), (self.upper - before).max(F::ZERO));
        let integral = integral + kept;
        let with_increment = before + increment;
        let unlimited = if at_once { with_increment } else { before };
        // A term that is not finite makes a sum with it so.
        let finite = with_increment.is_finite() & (known + integral).is_finite() & integral.is_finite();
        let status = if unlimited < self.lower {
            Status::AtLower
        } else if unlimited > self.upper {
            Status::AtUpper
        } else {
            Status::Regular
        };
        finite.then_some(Step { output: self.limited(unlimited), integral, status })
    }

    /// A finite `output` brought into the limits.
    #[inline(always)]
    pub(super) fn limited(&self, output: F) -> F {
        let raised = if output < self.lower { self.lower } else { output };
        if raised > self.upper { self.upper } else { raised }
    }
}
