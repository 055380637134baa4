//! Whether numbers are ordinary, without a branch for each.

use profiles::Real;

/// Whether none of `values` is infinite or NaN: zero times such a one is NaN, and so is the sum.
#[inline(always)]
pub(crate) fn all_finite<F: Real, const N: usize>(values: [F; N]) -> bool {
    values.iter().fold(F::ZERO, |sum, value| sum + F::ZERO * *value).is_finite()
}
