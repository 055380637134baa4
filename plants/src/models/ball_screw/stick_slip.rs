//! Steps of an axis with dry friction.

use nalgebra::SVector;

use super::slide::Slide;
use super::{BallScrewAxis, MeteredStickSlip};
use crate::error::{ModelError, StepError};
use crate::models::Friction;
use crate::steppers::{Stepper, ZeroOrderHold};

/// Steps of a [`BallScrewAxis`] with [`Friction`] under a held input.
///
/// With Coulomb friction alone the axis is linear while it slides one way, and the steps are exact: its motion in
/// closed form up to the instant at which it stops, to rounding; there it sticks, if what pulls at it is no more than
/// the breakaway torque, and stays to the last bit while that is so; else it goes the other way. Stribeck's excess over the
/// Coulomb torque is held over substeps at its value in their middle, which errs with the square of a substep. Without dry
/// friction the steps are those of a [`ZeroOrderHold`], bit for bit.
///
/// ```
/// use plants::{BallScrewAxis, Friction, StickSlip, Stepper, nalgebra::{self, vector}};
///
/// let axis = BallScrewAxis::from_coefficients(0.0, 0.0, 1.0)?; // 1 kg m^2, free, 1 N m per unit
/// let mut axis = StickSlip::new(axis, Friction::coulomb(2.0)?.with_stribeck(3.0, 0.01, 2.0)?)?;
/// // 3 N m are held, more are not.
/// assert_eq!(axis.advance(&vector![0.5, 0.0], &vector![3.0, 0.0], 0.1)?, vector![0.5, 0.0]);
/// assert!(axis.advance(&vector![0.5, 0.0], &vector![3.0 + 1e-9, 0.0], 0.1)?[0] > 0.5);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct StickSlip {
    linear: ZeroOrderHold<2, 2, BallScrewAxis>,
    slide: Slide,
}

impl StickSlip {
    /// Steps of `axis` with `friction`.
    ///
    /// # Errors
    /// Viscous friction that is out of range in the units of the axis.
    pub fn new(axis: BallScrewAxis, friction: Friction) -> Result<Self, ModelError> {
        axis.check_damping(&friction)?;
        Ok(Self::of(axis, friction))
    }

    /// Steps of an axis with friction that was checked.
    pub(in crate::models) fn of(axis: BallScrewAxis, friction: Friction) -> Self {
        let axis = axis.with_more_damping(friction.viscous());
        Self { linear: ZeroOrderHold::new(axis), slide: Slide::new(axis, friction) }
    }

    /// The axis, the viscous friction in its damping.
    #[must_use]
    pub fn axis(&self) -> &BallScrewAxis {
        self.slide.axis()
    }

    /// The friction.
    #[must_use]
    pub fn friction(&self) -> &Friction {
        self.slide.friction()
    }

    /// The same steps with an account of the energy.
    #[must_use]
    pub fn metered(self) -> MeteredStickSlip {
        MeteredStickSlip::of(self.linear.metered(), self.slide)
    }
}

impl Stepper<2, 2> for StickSlip {
    #[inline(always)]
    fn advance(
        &mut self,
        state: &SVector<f64, 2>,
        input: &SVector<f64, 2>,
        interval: f64,
    ) -> Result<SVector<f64, 2>, StepError> {
        if self.slide.friction().is_linear() {
            self.linear.advance(state, input, interval)
        } else {
            self.slide.advance(state, input, interval, |_, _| ())
        }
    }
}
