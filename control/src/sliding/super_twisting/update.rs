//! One tick of super-twisting control.

use profiles::Real;

use super::super::actuator::{OutputLimits, Step};
use super::super::logarithm::LogMagnitude;
use super::super::sampling::{Sampling, set_valued_sign, sign};
use super::super::update::{SlidingModeInput, SlidingModeOutput};
use super::config::SuperTwisting;
use crate::pid::Status;

/// The memory of one super-twisting controller; every number in it is finite.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SuperTwistingState<F = f64> {
    /// `v / k`: a contribution to the output.
    integral: F,
    /// Output and surface of the last valid tick.
    output: F,
    surface: F,
    /// What the output would have been without the reaching law, times `k`.
    equivalent: F,
    /// The surface that backward Euler with the load of the past period arrives at.
    target: F,
    /// Whether there was a tick.
    primed: bool,
}

impl<F: Real> SuperTwistingState<F> {
    /// No past.
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

    /// The contribution `v / k` to the output, in the unit of the output: once `s = 0`, minus the load over the gain of the
    /// axis.
    #[must_use]
    pub fn integral(&self) -> F {
        self.integral
    }

    #[cold]
    fn held(&self, limits: &OutputLimits<F>) -> SlidingModeOutput<F> {
        SlidingModeOutput { output: limits.limited(self.output), surface: self.surface, status: Status::Held }
    }
}

/// The two terms of the law at a tick.
struct Twist<F> {
    /// What is added to the acceleration at this tick besides `v`, m/s^2.
    direct: F,
    /// What is added to `v`, m/s^2.
    increment: F,
    /// Whether `v` counts with it.
    at_once: bool,
    target: F,
}

impl<F: Real> SuperTwisting<F> {
    /// One tick. With the model and the surface of [`SlidingMode::update`](crate::SlidingMode::update), its `w`, and a load
    /// `d` that changes by up to `L` m/s^3:
    ///
    /// ```text
    /// u_k = (r'' + a v + b x + w + rate_k) / k  within the limits
    ///
    /// explicit:  rate_k = k1 |s_k|^(1/2) sgn s_k + v_k                     v_(k+1) = v_k + h k2 sgn s_k
    /// matched:   rate_k = s_k (k1 |s_k|^(1/2) + 2 h k2) / D + v_k          v_(k+1) = v_k + h k2 s_k / D
    ///            D = |s_k| + h k1 |s_k|^(1/2) + h^2 k2
    /// implicit:  z_k = z_(k-1) - h (k1 |z_k|^(1/2) sgn z_k + v_k + d_(k-1))  v_k = v_(k-1) + h k2 sgn z_k
    ///            rate_k = k1 |z_k|^(1/2) sgn z_k + v_k + (s_k - z_k) / h
    /// ```
    ///
    /// Explicit chatters: with `s` within a multiple of `h^2`, with the rate within a multiple of `h`.
    ///
    /// Matched gives the sampled loop the eigenvalues `1 / (1 + h l)` where the continuous one, written as a linear system of
    /// gain `|s|^(-1/2)`, has `-l`. Under a load whose rate of change stays `L < k2` it comes to rest at
    /// `|s| (k2 - L) = L (h k1 |s|^(1/2) + h^2 k2)`, at zero if the load is constant.
    ///
    /// Implicit solves a backward Euler step for `z` and for the set-valued sign, with the load `d_(k-1)` that the surface has
    /// shown over the past period, and leads `s` to `z` in one step. Once `z = 0`, `v` is minus that load, and
    /// `|s| <= h^2 L`, less than which no sampled controller can promise.
    ///
    /// `v` stops where the output is limited. An input that is not finite, or finite ones that overflow, leaves `state`
    /// untouched to the bit and returns the last valid output (zero before the first tick) within the limits, with
    /// [`Status::Held`].
    ///
    /// # References
    /// S. Koch, M. Reichhartinger, *Discrete-time equivalents of the super-twisting algorithm*, Automatica 107, 2019,
    /// doi:10.1016/j.automatica.2019.05.040 (matched).
    ///
    /// B. Brogliato, A. Polyakov, D. Efimov, *The implicit discretization of the supertwisting sliding-mode control
    /// algorithm*, IEEE Transactions on Automatic Control 65(8), 2020, doi:10.1109/TAC.2019.2953091; R. Seeber,
    /// B. Andritsch, *Proper implicit discretization of the super-twisting controller*, Automatica 173, 2025,
    /// doi:10.1016/j.automatica.2024.112027 (the bound).
    #[inline(always)]
    #[must_use]
    pub fn update(
        &self,
        state: &mut SuperTwistingState<F>,
        input: SlidingModeInput<F>,
    ) -> SlidingModeOutput<F> {
        let log_error = LogMagnitude::of(input.error);
        let point = self.prepared.at(input.error, input.error_rate, log_error);
        let surface = point.value;
        let equivalent = input.effort(&self.model, point.demand);
        let realised = input.realised.unwrap_or(state.output);

        let twist = match self.sampling {
            Sampling::Explicit => self.explicit(surface),
            Sampling::Matched => self.matched(surface),
            Sampling::Implicit => self.implicit(state, surface, realised),
        };
        let known = self.inverse_gain * (equivalent + twist.direct);
        let increment = self.inverse_gain * twist.increment;
        let shortfall = state.output - realised;
        let step = self.limits.step(known, state.integral, increment, shortfall, twist.at_once);
        let finite = surface.is_finite() & equivalent.is_finite() & realised.is_finite();
        match step.filter(|_| finite & twist.target.is_finite()) {
            Some(Step { output, integral, status }) => {
                let target = twist.target;
                *state = SuperTwistingState { integral, output, surface, equivalent, target, primed: true };
                SlidingModeOutput { output, surface, status }
            }
            None => state.held(&self.limits),
        }
    }

    #[inline(always)]
    fn explicit(&self, surface: F) -> Twist<F> {
        let sign = sign(surface);
        Twist {
            direct: self.k1 * surface.abs().sqrt() * sign,
            increment: self.period * self.k2 * sign,
            at_once: false,
            target: surface,
        }
    }

    #[inline(always)]
    fn matched(&self, surface: F) -> Twist<F> {
        let distance = surface.abs();
        let root = distance.sqrt();
        let share = surface / (distance + self.first_reach * root + self.second_reach);
        let second = self.period * self.k2;
        Twist {
            direct: share * (self.k1 * root + second + second),
            increment: second * share,
            at_once: false,
            target: surface,
        }
    }

    #[inline(always)]
    fn implicit(&self, state: &SuperTwistingState<F>, surface: F, realised: F) -> Twist<F> {
        let gain = self.model.gain();
        // What the surface did beyond what it was told to is the load, over one period.
        let told = self.period * (gain * realised - state.equivalent);
        let drift = surface - state.surface + told;
        let integral = gain * state.integral;
        let value = if state.primed { state.target + drift - self.period * integral } else { surface };
        // z + h k1 |z|^(1/2) sgn z + h^2 k2 sgn z = value; without a past z is the surface.
        let sign = set_valued_sign(value, self.second_reach);
        let rest = (value - self.second_reach * sign).abs();
        let half = F::HALF * self.first_reach;
        // The root of r^2 + h k1 r = rest that loses no digits.
        let root = rest / (half + (half * half + rest).sqrt());
        let (target, root, increment) = if state.primed {
            (root * root * sign, root, self.period * self.k2 * sign)
        } else {
            (surface, surface.abs().sqrt(), F::ZERO)
        };
        Twist {
            direct: self.k1 * root * sign + self.rate * (surface - target),
            increment,
            at_once: true,
            target,
        }
    }
}
