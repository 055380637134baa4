//! Real powers of one magnitude that share its logarithm.

use profiles::Real;

/// `ln |x|`, with zero and subnormal numbers taken for the smallest normal one.
///
/// `x |x|^(a - 1)` is then `|x|^a` with the sign of `x` for every `a`, zero at zero and free of a division of zero by
/// zero. Its relative error is that of `(a - 1) ln |x|` times the magnitude of the same, some
/// `1 + |(a - 1) ln |x||` machine epsilons.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct LogMagnitude<F>(F);

impl<F: Real> LogMagnitude<F> {
    #[inline(always)]
    pub(super) fn of(x: F) -> Self {
        // Four over the largest number is the smallest normal one.
        let smallest = F::from_u32(4) / F::MAX;
        let magnitude = x.abs();
        Self(if magnitude > smallest { magnitude } else { smallest }.ln())
    }

    /// `|x|^a`.
    #[inline(always)]
    pub(super) fn to_power(self, a: F) -> F {
        (a * self.0).exp()
    }

    /// The larger magnitude of two.
    #[inline(always)]
    pub(super) fn at_least(self, other: Self) -> Self {
        if self.0 > other.0 { self } else { other }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_are_those_of_libm() {
        let mut x = 1e-300_f64;
        while x < 1e300 {
            for a in [-0.5, 0.25, 1.0 / 3.0, 0.9] {
                let (ours, theirs) = (LogMagnitude::of(-x).to_power(a), x.powf(a));
                let roundings = 2.0 + (a * x.ln()).abs();
                assert!((ours / theirs - 1.0).abs() < roundings * f64::EPSILON, "{x}^{a}: {ours} {theirs}");
            }
            x *= 7.3;
        }
    }

    #[test]
    fn zero_and_subnormal_numbers_have_finite_powers() {
        for x in [0.0_f32, -0.0, 1e-45, f32::MIN_POSITIVE] {
            let log = LogMagnitude::of(x);
            assert!(log.to_power(-0.9).is_finite() && log.to_power(0.9) > 0.0, "{x}");
        }
        assert!(LogMagnitude::of(0.0_f64).to_power(-0.9).is_finite());
    }
}
