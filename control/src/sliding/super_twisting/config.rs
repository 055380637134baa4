//! What a super-twisting controller is set to, checked once.

use profiles::Real;

use super::super::actuator::OutputLimits;
use super::super::model::AxisModel;
use super::super::sampling::Sampling;
use super::super::surface::{Prepared, SlidingSurface};
use crate::error::SlidingModeError;
use crate::range::positive;

/// A checked super-twisting controller of an axis; any number of axes may share it, each with its own
/// [`SuperTwistingState`](crate::SuperTwistingState).
///
/// It drives `s' = -rate - d` to zero with
///
/// `rate = k1 |s|^(1/2) sgn s + v`, `v' = k2 sgn s`,
///
/// so that `v` comes to balance a load `d` of any size as long as its rate of change is bounded: the input is continuous,
/// and the switching is left to its derivative.
///
/// ```
/// use control::{AxisModel, Sampling, SlidingModeInput, SlidingSurface, SuperTwisting, SuperTwistingState};
/// use profiles::Sample;
///
/// let axis = AxisModel::new(10.0, 1.0, 1.0)?;
/// // Loads that change by up to 100 m/s^3
/// let controller = SuperTwisting::for_load_rate(SlidingSurface::linear(10.0)?, 100.0, axis, 1e-3)?
///     .with_sampling(Sampling::Matched)
///     .with_output_limits(-400.0, 400.0)?;
/// assert_eq!(controller.gains(), (15.0, 1.1 * 100.0));
///
/// let mut state = SuperTwistingState::new();
/// let reference = Sample { position: 0.2, velocity: 1.0, acceleration: 3.0, ..Sample::default() };
/// let output = controller.update(&mut state, SlidingModeInput::new(&reference, 0.2, 1.0));
/// assert_eq!(output.output, 13.2); // on the reference: 3 + 10 1 + 1 0.2
/// # Ok::<(), control::SlidingModeError>(())
/// ```
///
/// # References
/// A. Levant, *Sliding order and sliding accuracy in sliding mode control*, International Journal of Control 58(6), 1993,
/// doi:10.1080/00207179308923053.
///
/// J. A. Moreno, M. Osorio, *Strict Lyapunov functions for the super-twisting algorithm*, IEEE Transactions on Automatic
/// Control 57(4), 2012, doi:10.1109/TAC.2012.2186179.
///
/// R. Seeber, M. Horn, *Stability proof for a well-established super-twisting parameter setting*, Automatica 84, 2017,
/// doi:10.1016/j.automatica.2017.07.002.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        try_from = "super::super::unchecked::UncheckedSuperTwisting<F>",
        into = "super::super::unchecked::UncheckedSuperTwisting<F>",
        bound(serialize = "F: Real + serde::Serialize", deserialize = "F: Real + serde::Deserialize<'de>")
    )
)]
pub struct SuperTwisting<F = f64> {
    surface: SlidingSurface<F>,
    pub(super) k1: F,
    pub(super) k2: F,
    pub(super) model: AxisModel<F>,
    pub(super) period: F,
    pub(super) sampling: Sampling,
    pub(super) limits: OutputLimits<F>,
    // What the tick needs, computed once.
    pub(super) prepared: Prepared<F>,
    /// `1 / k`.
    pub(super) inverse_gain: F,
    /// `h k1` and `h^2 k2`: how far a tick of either term moves the surface.
    pub(super) first_reach: F,
    pub(super) second_reach: F,
    /// `1 / h`.
    pub(super) rate: F,
}

impl<F: Real> SuperTwisting<F> {
    /// A linear or terminal surface, the gains `k1` in (m/s)^(1/2)/s and `k2` in m/s^3, the model of the axis and the sampling
    /// period `h` in s; explicit sampling, output unlimited.
    ///
    /// # Errors
    /// A non-singular surface, a gain or a period that is not positive and finite, or numbers that leave the range of `F`.
    pub fn new(
        surface: SlidingSurface<F>,
        k1: F,
        k2: F,
        model: AxisModel<F>,
        period: F,
    ) -> Result<Self, SlidingModeError> {
        if !(period > F::ZERO && period.is_finite()) {
            return Err(SlidingModeError::Period(period.to_f64()));
        }
        positive("k1 of super-twisting", k1)?;
        positive("k2 of super-twisting", k2)?;
        let prepared = surface.prepared(period)?;
        if matches!(prepared, Prepared::Nonsingular { .. }) {
            return Err(SlidingModeError::NonsingularSurface);
        }
        let rate = F::ONE / period;
        let first_reach = period * k1;
        let second_reach = period * (period * k2);
        for (quantity, value) in [
            ("inverse of the period", rate),
            ("period times k1", first_reach),
            ("squared period times k2", second_reach),
        ] {
            // A reach of zero would leave nothing to divide by.
            if !(value > F::ZERO && value.is_finite()) {
                return Err(SlidingModeError::Range { quantity, value: value.to_f64() });
            }
        }
        Ok(Self {
            surface,
            k1,
            k2,
            model,
            period,
            sampling: Sampling::Explicit,
            limits: OutputLimits::none(),
            prepared,
            inverse_gain: F::ONE / model.gain(),
            first_reach,
            second_reach,
            rate,
        })
    }

    /// Gains for loads that change by up to `bound` in m/s^3: `k1 = 1.5 bound^(1/2)`, `k2 = 1.1 bound`.
    ///
    /// # Errors
    /// As [`SuperTwisting::new`], with a bound that is not positive and finite among them.
    pub fn for_load_rate(
        surface: SlidingSurface<F>,
        bound: F,
        model: AxisModel<F>,
        period: F,
    ) -> Result<Self, SlidingModeError> {
        positive("bound of the rate of the load", bound)?;
        Self::new(surface, F::from_f64(1.5) * bound.sqrt(), F::from_f64(1.1) * bound, model, period)
    }

    /// Replaces how the law is sampled, see [`SuperTwisting::update`].
    #[must_use]
    pub fn with_sampling(self, sampling: Sampling) -> Self {
        Self { sampling, ..self }
    }

    /// Replaces the output limits, in the unit of the output; infinity means unlimited. `v` stops where the output is limited,
    /// and follows what the actuator realised, as the integral of [`Pid`](crate::Pid) with clamping does.
    ///
    /// # Errors
    /// A lower limit that does not lie below the upper one.
    pub fn with_output_limits(self, lower: F, upper: F) -> Result<Self, SlidingModeError> {
        Ok(Self { limits: OutputLimits::new(lower, upper)?, ..self })
    }

    /// The fastest change of load, m/s^3, below which `s` is certain to reach zero in finite time: with `k2 > L` and
    /// `k1^2 > k2 + L` it does (Seeber and Horn), hence `min(k2, k1^2 - k2)`; zero where that is negative.
    #[must_use]
    pub fn tolerated_load_rate(&self) -> F {
        self.k2.min(self.k1 * self.k1 - self.k2).max(F::ZERO)
    }

    /// An upper bound of the time in s from `s = surface` with `v = 0` to `s = 0` for good, without load.
    ///
    /// With `z = (|s|^(1/2) sgn s, -v)` the function `V = z' P z`, `2 P = [4 k2 + k1^2, -k1; -k1, 2]`, falls as
    /// `V' <= -g V^(1/2)` with `g = l(P)^(1/2) l(Q) / L(P)`, the least and the largest eigenvalues `l` and `L`, and
    /// `Q = k1/2 [2 k2 + k1^2, -k1; -k1, 1]`: it is zero after `2 V^(1/2) / g` (Moreno and Osorio).
    #[must_use]
    pub fn reaching_time(&self, surface: F) -> Option<F> {
        let two = F::from_u32(2);
        let (k1, k2) = (self.k1, self.k2);
        let square = k1 * k1;
        let first = two * k2 + F::HALF * square;
        let (least_p, largest_p) = eigenvalues(first, -F::HALF * k1, F::ONE);
        let scale = F::HALF * k1;
        let (least_q, _) = eigenvalues(scale * (two * k2 + square), -scale * k1, scale);
        let decay = least_p.sqrt() * least_q / largest_p;
        let time = two * (first * surface.abs()).sqrt() / decay;
        time.is_finite().then_some(time)
    }

    /// The surface.
    #[must_use]
    pub fn surface(&self) -> SlidingSurface<F> {
        self.surface
    }

    /// The gains `k1` and `k2`.
    #[must_use]
    pub fn gains(&self) -> (F, F) {
        (self.k1, self.k2)
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

    /// How the law is sampled.
    #[must_use]
    pub fn sampling(&self) -> Sampling {
        self.sampling
    }

    /// The lower and the upper output limit.
    #[must_use]
    pub fn output_limits(&self) -> (F, F) {
        (self.limits.lower, self.limits.upper)
    }
}

/// The smaller and the larger eigenvalue of a positive definite `[a, b; b, c]`.
fn eigenvalues<F: Real>(a: F, b: F, c: F) -> (F, F) {
    let difference = a - c;
    let root = (difference * difference + F::from_u32(4) * b * b).sqrt();
    let larger = F::HALF * (a + c + root);
    // The product, which unlike the difference of sum and root loses no digits.
    ((a * c - b * b) / larger, larger)
}
