//! One tick of sliding mode control.

use profiles::{Real, Sample};

use super::actuator::{OutputLimits, Step};
use super::config::SlidingMode;
use super::logarithm::LogMagnitude;
use super::model::AxisModel;
use super::sampling::{Sampling, matched, set_valued_sign};
use super::surface::Point;
use crate::pid::Status;

/// The memory of one sliding mode controller; every number in it is finite.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SlidingModeState<F = f64> {
    /// The integral as a contribution to the output.
    integral: F,
    /// Output and surface of the last valid tick.
    output: F,
    surface: F,
}

impl<F: Real> SlidingModeState<F> {
    /// No integral and no past.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Forgets everything.
    pub fn reset(&mut self) {
        *self = Self::default();
    }

    /// The last valid output; zero before the first tick.
    #[must_use]
    pub fn output(&self) -> F {
        self.output
    }

    /// The contribution of the integral to the output, in the unit of the output.
    #[must_use]
    pub fn integral(&self) -> F {
        self.integral
    }

    #[cold]
    fn held(&self, limits: &OutputLimits<F>) -> SlidingModeOutput<F> {
        SlidingModeOutput { output: limits.limited(self.output), surface: self.surface, status: Status::Held }
    }
}

/// What a sliding mode controller is told at a tick.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SlidingModeInput<F = f64> {
    /// The error `e = r - x`, m or rad.
    pub error: F,
    /// Its rate `e' = r' - v`, m/s.
    pub error_rate: F,
    /// Acceleration `r''` of the reference, m/s^2.
    pub reference_acceleration: F,
    /// Measured position `x`, m.
    pub position: F,
    /// Measured or estimated velocity `v`, m/s.
    pub velocity: F,
    /// The load `d` as far as it is known, m/s^2; zero without an observer.
    pub load: F,
    /// The output that the actuator was left with at the previous tick, see
    /// [`PidInput::realised`](crate::PidInput::realised); `None`: what this controller gave.
    pub realised: Option<F>,
}

impl<F: Real> SlidingModeInput<F> {
    /// The errors of `position` and `velocity` against `reference`, no known load, the previous output realised as given.
    #[inline]
    #[must_use]
    pub fn new(reference: &Sample<F>, position: F, velocity: F) -> Self {
        Self {
            error: reference.position - position,
            error_rate: reference.velocity - velocity,
            reference_acceleration: reference.acceleration,
            position,
            velocity,
            load: F::ZERO,
            realised: None,
        }
    }

    /// The same with another error and rate, those of a cross-coupling for one.
    #[inline]
    #[must_use]
    pub fn with_error(self, error: F, error_rate: F) -> Self {
        Self { error, error_rate, ..self }
    }

    /// The `k u` for which the error accelerates with `-demand`, m/s^2.
    #[inline(always)]
    pub(super) fn effort(&self, model: &AxisModel<F>, demand: F) -> F {
        model.effort(self.reference_acceleration + demand, self.position, self.velocity) - self.load
    }
}

/// What a sliding mode controller answers at a tick.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SlidingModeOutput<F = f64> {
    /// The output `u`: always finite and within the limits.
    pub output: F,
    /// The surface `s` at the error given, or at the last valid one where the output is held.
    pub surface: F,
    /// How the output came about.
    pub status: Status,
}

impl<F: Real> SlidingMode<F> {
    /// One tick. With the model `x'' = -a v - b x + k u + d`, the surface `s(e, e')` and its law `s' = -rate(s, e)`:
    ///
    /// ```text
    /// I_k = I_(k-1) + k4 h e_k / k
    /// u_k = (r'' + a v + b x + w(e, e') + rate(s, e) - d) / k + I_k  within the limits
    /// ```
    ///
    /// where `e'' = -w` keeps `s` as it is: `w = (ds/de) e'` for the linear and the terminal surface, and
    /// `w = beta (q/p) |e'|^(2 - p/q) sgn e' (1 + g |e|^(g - 1) / alpha)` for the non-singular ones, the last factor with
    /// the fast term only. On those the axis obeys `s' = -(ds/de') rate` with `ds/de' >= 0`, which is zero where the error
    /// stands still: `s^2` does not grow, but [`ReachingLaw::reaching_time`](crate::ReachingLaw::reaching_time) does not
    /// hold.
    ///
    /// `I_k` takes of `k4 h e_k / k` only what does not move the output beyond a limit, and nothing in a direction in
    /// which the actuator fell short of `u_(k-1)`.
    ///
    /// An input that is not finite, or finite ones whose sum overflows, leaves `state` untouched to the bit and returns the
    /// last valid output (zero before the first tick) within the limits, with [`Status::Held`]. Nothing branches on the
    /// data but that; the logarithm and the exponential of `libm` choose among a few ranges.
    #[inline(always)]
    #[must_use]
    pub fn update(
        &self,
        state: &mut SlidingModeState<F>,
        input: SlidingModeInput<F>,
    ) -> SlidingModeOutput<F> {
        let (surface, known) = self.known(&input);
        let realised = input.realised.unwrap_or(state.output);
        let increment = self.integral_step * input.error;
        let step = self.limits.step(known, state.integral, increment, state.output - realised, true);
        match step.filter(|_| surface.is_finite() & realised.is_finite()) {
            Some(Step { output, integral, status }) => {
                *state = SlidingModeState { integral, output, surface };
                SlidingModeOutput { output, surface, status }
            }
            None => state.held(&self.limits),
        }
    }

    /// The surface, and the output without its integral.
    #[inline(always)]
    fn known(&self, input: &SlidingModeInput<F>) -> (F, F) {
        let log_error = LogMagnitude::of(input.error);
        let point = self.prepared.at(input.error, input.error_rate, log_error);
        let rate = self.rate(&point, log_error);
        let effort = input.effort(&self.model, point.demand + rate);
        (point.value, self.inverse_gain * effort)
    }

    #[inline(always)]
    fn rate(&self, point: &Point<F>, log_error: LogMagnitude<F>) -> F {
        let surface = point.value;
        let step = self.period() * point.leverage;
        match self.sampling {
            Sampling::Explicit => self.law.rate_at(surface, log_error),
            Sampling::Implicit => {
                // Only laws with these two gains are let in.
                let (k, eps) = self.law.signed_linear().unwrap_or_default();
                let sign = set_valued_sign(surface, step * eps);
                let next = (surface - step * eps * sign) / (F::ONE + step * k);
                k * next + eps * sign
            }
            Sampling::Matched => matched(surface, self.law.rate_at(surface, log_error), step),
        }
    }

    /// Prepares `state`, so far driven by `old`, for this configuration, between two ticks: the integral takes up what the
    /// two laws differ by at `input`, so that the output there is the same before and after to rounding, as far as the new
    /// limits allow. Where the new `k4` is zero the integral stays as a constant bias until
    /// [`SlidingModeState::reset`]. A shift that overflows is not made.
    pub fn take_over(&self, old: &Self, state: &mut SlidingModeState<F>, input: &SlidingModeInput<F>) {
        let integral = state.integral + (old.known(input).1 - self.known(input).1);
        if integral.is_finite() {
            state.integral = integral;
        }
    }
}
