//! A control point with its weight.

/// A point of weight `w`, stored as `(w x, w y, ..., w)`, in which rational curves are polynomial.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Homogeneous<const D: usize> {
    /// Coordinates times the weight.
    pub weighted: [f64; D],
    /// The weight.
    pub weight: f64,
}

impl<const D: usize> Homogeneous<D> {
    pub(super) const ZERO: Self = Self { weighted: [0.0; D], weight: 0.0 };

    /// `point` with the weight `weight`.
    #[must_use]
    pub fn new(point: [f64; D], weight: f64) -> Self {
        Self { weighted: point.map(|x| x * weight), weight }
    }

    /// The point: coordinates over weight.
    #[inline]
    #[must_use]
    pub fn point(&self) -> [f64; D] {
        self.weighted.map(|x| x / self.weight)
    }

    /// `a self + b other`.
    #[inline(always)]
    pub(super) fn combined(&self, a: f64, other: &Self, b: f64) -> Self {
        let mut weighted = [0.0; D];
        for ((sum, x), y) in weighted.iter_mut().zip(&self.weighted).zip(&other.weighted) {
            *sum = a * x + b * y;
        }
        Self { weighted, weight: a * self.weight + b * other.weight }
    }

    /// `(1 - t) self + t other`: both ends to the bit.
    #[inline(always)]
    pub(super) fn blended(&self, other: &Self, t: f64) -> Self {
        self.combined(1.0 - t, other, t)
    }

    /// `factor (other - self)`.
    #[inline(always)]
    pub(super) fn difference(&self, other: &Self, factor: f64) -> Self {
        let mut weighted = [0.0; D];
        for ((d, x), y) in weighted.iter_mut().zip(&self.weighted).zip(&other.weighted) {
            *d = factor * (y - x);
        }
        Self { weighted, weight: factor * (other.weight - self.weight) }
    }

    /// `self / divisor`.
    pub(super) fn divided(&self, divisor: f64) -> Self {
        Self { weighted: self.weighted.map(|x| x / divisor), weight: self.weight / divisor }
    }
}
