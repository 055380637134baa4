//! Time as a number of ticks.

use profiles::Real;

use crate::error::SimulationError;

/// A base period of `numerator / denominator` s. Every time in a simulation is a whole number of them.
///
/// ```
/// use plants::Clock;
///
/// let clock = Clock::from_frequency(100_000)?;
/// assert_eq!(clock.time(30_000), 0.3);
/// assert_eq!(clock.ticks(0.3)?, 30_000);
/// # Ok::<(), plants::SimulationError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "UncheckedClock"))]
pub struct Clock {
    numerator: u64,
    denominator: u64,
}

#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
struct UncheckedClock {
    numerator: u64,
    denominator: u64,
}

#[cfg(feature = "serde")]
impl TryFrom<UncheckedClock> for Clock {
    type Error = SimulationError;
    fn try_from(clock: UncheckedClock) -> Result<Self, SimulationError> {
        Self::from_period(clock.numerator, clock.denominator)
    }
}

const EXACT: u128 = 1 << f64::MANTISSA_DIGITS;

impl Clock {
    /// A base period of `numerator / denominator` s.
    ///
    /// # Errors
    /// A zero.
    pub fn from_period(numerator: u64, denominator: u64) -> Result<Self, SimulationError> {
        if numerator == 0 || denominator == 0 {
            return Err(SimulationError::Period { numerator, denominator });
        }
        let divisor = greatest_common_divisor(numerator, denominator);
        Ok(Self { numerator: numerator / divisor, denominator: denominator / divisor })
    }

    /// A base period of one over a frequency in Hz.
    ///
    /// # Errors
    /// A frequency of zero.
    pub fn from_frequency(hz: u64) -> Result<Self, SimulationError> {
        Self::from_period(1, hz)
    }

    /// The base period, s, rounded once.
    #[must_use]
    pub fn period(&self) -> f64 {
        self.time(1)
    }

    /// The time of a tick, s: `tick * numerator / denominator`, rounded once.
    #[inline]
    #[must_use]
    pub fn time(&self, tick: u64) -> f64 {
        quotient(u128::from(tick) * u128::from(self.numerator), self.denominator)
    }

    /// The time in the middle between a tick and the next, s.
    pub(super) fn middle(&self, tick: u64) -> f64 {
        0.5 * quotient(
            (2 * u128::from(tick) + 1).saturating_mul(u128::from(self.numerator)),
            self.denominator,
        )
    }

    /// The number of ticks nearest to a duration in s.
    ///
    /// # Errors
    /// A duration that is negative or not finite, or of 2^53 ticks or more.
    pub fn ticks(&self, duration: f64) -> Result<u64, SimulationError> {
        let ticks = Real::round(duration / self.numerator as f64 * self.denominator as f64);
        if ticks >= 0.0 && ticks < EXACT as f64 {
            Ok(ticks as u64)
        } else {
            Err(SimulationError::Duration(duration))
        }
    }
}

/// `p / q` rounded once; `q` is not zero.
fn quotient(p: u128, q: u64) -> f64 {
    if p <= EXACT && u128::from(q) <= EXACT {
        return p as f64 / q as f64;
    }
    // Shifted to the full width the integer quotient has at least 64 digits; what is left over only matters as a
    // sign of not being halfway. The power of two is exact.
    let shift = p.leading_zeros();
    let (p, q) = (p << shift, u128::from(q));
    let digits = (p / q) | u128::from(p % q != 0);
    digits as f64 * f64::from_bits(u64::from(1023 - shift) << 52)
}

fn greatest_common_divisor(mut a: u64, mut b: u64) -> u64 {
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a
}

#[cfg(test)]
#[expect(clippy::float_cmp, reason = "one rounding has one answer")]
mod tests {
    use super::*;

    #[test]
    fn time_is_rounded_once() {
        let clock = Clock::from_frequency(10).expect("valid");
        assert_eq!(clock.time(3), 0.3);
        assert_eq!(clock.middle(3), 0.35);
        let clock = Clock::from_period(3, 1_000).expect("valid");
        assert_eq!(clock.period(), 0.003);
        assert_eq!(clock.time(7), 0.021);
    }

    #[test]
    fn large_numbers_are_rounded_once() {
        // Powers of two scale a quotient that fits without rounding: both ways must agree.
        for (p, q) in [(1_u64, 3_u64), (10_000_019, 7), (123_456_789, 1_000_003), (5, 1_000_000_007)] {
            let small = quotient(u128::from(p), q);
            assert_eq!(quotient(u128::from(p) << 64, q) / 2.0_f64.powi(64), small);
            assert_eq!(quotient(u128::from(p) << 90, q) / 2.0_f64.powi(90), small);
        }
        // 2^53 + 1 lies halfway and goes to the even neighbour; anything more goes up.
        assert_eq!(quotient((1 << 53) + 1, 1), 9_007_199_254_740_992.0);
        assert_eq!(quotient(((1 << 53) + 1) * 3 + 1, 3), 9_007_199_254_740_994.0);
        // The same where what is left over lies below the last digit of the shifted quotient.
        let (halfway, q) = (((1_u128 << 53) + 1) << 11, (1_u64 << 62) + 1);
        assert_eq!(quotient(halfway * u128::from(q), q), 9_007_199_254_740_992.0 * 2048.0);
        assert_eq!(quotient(halfway * u128::from(q) + 1, q), 9_007_199_254_740_994.0 * 2048.0);
        assert_eq!(quotient(u128::MAX, u64::MAX), 2.0_f64.powi(64));
    }

    #[test]
    fn ticks_are_the_nearest() {
        let clock = Clock::from_frequency(1000).expect("valid");
        assert_eq!(clock.ticks(0.0294), Ok(29));
        assert_eq!(clock.ticks(0.0296), Ok(30));
        for duration in [-1.0, f64::NAN, f64::INFINITY, 1e14] {
            assert!(clock.ticks(duration).is_err());
        }
        assert_eq!(Clock::from_period(6, 4), Clock::from_period(3, 2));
        assert!(Clock::from_frequency(0).is_err());
        assert!(Clock::from_period(0, 5).is_err());
    }
}
