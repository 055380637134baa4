//! How a law of continuous time is taken to a sampled controller.

use profiles::Real;

/// What a controller that acts once per period `h` makes of a law written for continuous time.
///
/// A law that switches, sampled as it stands, overshoots its surface at every tick and chatters. Both other forms come to
/// rest on it. Towards `s = 0` their gain tends to that of a deadbeat controller, `1/h` on the surface (`2/h` for
/// [`SuperTwisting`](crate::SuperTwisting)): they want an actuator that acts within the period, and a velocity whose noise
/// this gain does not make worse than the chatter was.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Sampling {
    /// The law as it stands, at the sampled surface: `s_(k+1) = s_k - h rate(s_k)`.
    #[default]
    Explicit,
    /// Backward Euler, in which a sign takes any value between -1 and 1 at zero: `s_(k+1) = s_k - h rate(s_(k+1))`. For the
    /// constant and the exponential law, and for super-twisting.
    Implicit,
    /// The ratio of a backward Euler step at the gain of this tick, `s_(k+1) = s_k / (1 + h rate(s_k) / s_k)`, which has the
    /// sign of `s_k` for any law and any period. For super-twisting both eigenvalues are taken over so.
    Matched,
}

/// `rate / (1 + h rate / s)`, which takes `s` a step nearer to zero and never beyond it.
#[inline(always)]
pub(super) fn matched<F: Real>(surface: F, rate: F, step: F) -> F {
    let distance = surface.abs();
    let sum = distance + step * rate.abs();
    // Without a distance there is no rate.
    let share = if sum > F::ZERO { distance / sum } else { F::ZERO };
    rate * share
}

/// The sign of `next` in `next + layer sign = value`, any number of `[-1, 1]` where `next` is zero.
#[inline(always)]
pub(super) fn set_valued_sign<F: Real>(value: F, layer: F) -> F {
    if value.abs() < layer { value / layer } else { sign(value) }
}

/// The sign, zero at zero.
#[inline(always)]
pub(super) fn sign<F: Real>(value: F) -> F {
    let sign = F::ONE.copysign(value);
    if value == F::ZERO { F::ZERO } else { sign }
}

#[cfg(test)]
#[expect(clippy::float_cmp, reason = "numbers that are exact in binary")]
mod tests {
    use super::*;

    #[test]
    fn a_matched_step_keeps_the_side() {
        // 1 / (1 + 0.5 * 6 / 1): a quarter is left, 0.75 / 0.5 is the rate.
        assert_eq!(matched(1.0, 6.0, 0.5), 1.5);
        assert_eq!(matched(-1.0, -6.0, 0.5), -1.5);
        assert_eq!(matched(0.0, 0.0, 0.5), 0.0);
        // However steep the law, h rate < s.
        assert!(0.5 * matched(1.0, 1e15, 0.5) < 1.0);
    }

    #[test]
    fn the_sign_at_zero_is_what_balances() {
        assert_eq!(set_valued_sign(0.25, 0.5), 0.5);
        assert_eq!(set_valued_sign(-2.0, 0.5), -1.0);
        assert_eq!([set_valued_sign(0.0, 0.0), sign(-0.0)], [0.0; 2]);
    }
}
