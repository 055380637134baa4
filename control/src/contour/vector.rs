//! Vectors of a few axes, without an index that could be out of range.

use profiles::Real;

use super::error::ContourFault;
use crate::finite::all_finite;

/// Both vectors, axis by axis.
#[inline(always)]
pub(super) fn zip<F: Real, const N: usize>(mut a: [F; N], b: [F; N], f: impl Fn(F, F) -> F) -> [F; N] {
    for (a, b) in a.iter_mut().zip(b) {
        *a = f(*a, b);
    }
    a
}

#[inline(always)]
pub(super) fn subtract<F: Real, const N: usize>(a: [F; N], b: [F; N]) -> [F; N] {
    zip(a, b, |a, b| a - b)
}

/// `a + factor b`.
#[inline(always)]
pub(super) fn add_scaled<F: Real, const N: usize>(a: [F; N], factor: F, b: [F; N]) -> [F; N] {
    zip(a, b, |a, b| a + factor * b)
}

#[inline(always)]
pub(super) fn dot<F: Real, const N: usize>(a: [F; N], b: [F; N]) -> F {
    a.iter().zip(b).fold(F::ZERO, |sum, (a, b)| sum + *a * b)
}

/// The largest magnitude of an axis.
#[inline(always)]
pub(super) fn largest<F: Real, const N: usize>(a: [F; N]) -> F {
    a.iter().fold(F::ZERO, |largest, a| {
        let size = a.abs();
        if size > largest { size } else { largest }
    })
}

/// A direction and a length in two factors, whose product may have no representation.
#[derive(Debug, Clone, Copy)]
pub(super) struct Scaled<const N: usize, F> {
    /// Of length one, to rounding.
    pub(super) unit: [F; N],
    /// The largest magnitude of an axis.
    pub(super) scale: F,
    /// The length over it, from one to the root of `N`.
    pub(super) length: F,
}

/// The direction of a finite vector whatever its size; none of zero.
#[inline(always)]
pub(super) fn scaled<F: Real, const N: usize>(a: [F; N]) -> Option<Scaled<N, F>> {
    let scale = largest(a);
    if scale > F::ZERO {
        // Divided, not multiplied by a reciprocal, which a subnormal scale does not have.
        let a = a.map(|a| a / scale);
        let length = dot(a, a).sqrt();
        Some(Scaled { unit: a.map(|a| a / length), scale, length })
    } else {
        None
    }
}

/// The Euclidean length of a finite vector, at most the largest finite number.
pub(super) fn norm<F: Real, const N: usize>(a: [F; N]) -> F {
    scaled(a).map_or(F::ZERO, |a| (a.scale * a.length).min(F::MAX))
}

/// Names the first axis whose input is not finite.
#[inline(always)]
pub(super) fn check<F: Real, const N: usize>(
    quantity: &'static str,
    values: [F; N],
) -> Result<(), ContourFault> {
    if all_finite(values) { Ok(()) } else { Err(not_finite(quantity, values)) }
}

#[cold]
fn not_finite<F: Real, const N: usize>(quantity: &'static str, values: [F; N]) -> ContourFault {
    let bad = values.iter().enumerate().find(|(_, value)| !value.is_finite());
    let (axis, value) = bad.map_or((0, f64::NAN), |(axis, value)| (axis, value.to_f64()));
    ContourFault::NotFinite { quantity, axis, value }
}

/// An answer, if it is finite.
#[inline(always)]
pub(super) fn in_range<F: Real, const N: usize>(
    quantity: &'static str,
    values: [F; N],
) -> Result<[F; N], ContourFault> {
    if all_finite(values) { Ok(values) } else { Err(out_of_range(quantity, values)) }
}

#[cold]
fn out_of_range<F: Real, const N: usize>(quantity: &'static str, values: [F; N]) -> ContourFault {
    let bad = values.iter().find(|value| !value.is_finite());
    ContourFault::Range { quantity, value: bad.map_or(f64::NAN, |value| value.to_f64()) }
}
