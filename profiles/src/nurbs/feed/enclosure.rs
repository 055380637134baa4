//! Arithmetic with intervals: what a quantity is at least and at most over a piece of a curve.

use core::ops::{Add, Mul, Sub};

use crate::quantities::{Interval, Real};

/// What the derivatives of a curve are computed in: numbers, or intervals that hold every number there is.
pub(super) trait Scalar: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> {
    /// Zero.
    const ZERO: Self;
    /// A number.
    fn from_f64(value: f64) -> Self;
    /// The square, which is nowhere negative.
    fn square(self) -> Self;
    /// One over it; `None` where zero is in it.
    fn inverse(self) -> Option<Self>;
    /// One over the root; `None` where zero is in it.
    fn inverse_root(self) -> Option<Self>;
}

impl Scalar for f64 {
    const ZERO: Self = 0.0;

    fn from_f64(value: f64) -> Self {
        value
    }
    fn square(self) -> Self {
        self * self
    }
    fn inverse(self) -> Option<Self> {
        let inverse = 1.0 / self;
        inverse.is_finite().then_some(inverse)
    }
    fn inverse_root(self) -> Option<Self> {
        let inverse = 1.0 / Real::sqrt(self);
        inverse.is_finite().then_some(inverse)
    }
}

/// An interval in arithmetic. Rounding is not directed: whoever uses a result widens it by a few roundings.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Enclosure {
    pub(super) lower: f64,
    pub(super) upper: f64,
}

impl Enclosure {
    #[inline]
    pub(super) fn new(lower: f64, upper: f64) -> Self {
        Self { lower, upper }
    }

    /// `[-radius, radius]`.
    pub(super) fn around_zero(radius: f64) -> Self {
        Self::new(-radius, radius)
    }

    /// The smallest interval that holds all of `values`; empty, with its ends the wrong way round, for none.
    pub(super) fn hull(values: impl Iterator<Item = f64>) -> Self {
        let empty = Self::new(f64::INFINITY, f64::NEG_INFINITY);
        values.fold(empty, |hull, x| Self::new(hull.lower.min(x), hull.upper.max(x)))
    }

    /// The largest magnitude.
    pub(super) fn magnitude(self) -> f64 {
        self.lower.abs().max(self.upper.abs())
    }

    /// Whether every number in it lies within `bounds`, up to a few roundings of them; false for NaN.
    #[inline]
    pub(super) fn is_within(self, bounds: Interval) -> bool {
        const SLACK: f64 = 1.0 + 1e-12;
        self.lower >= bounds.lower * SLACK && self.upper <= bounds.upper * SLACK
    }
}

// Each one instruction, which a minimum that minds NaN is not.
#[inline]
fn least(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

#[inline]
fn most(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

impl Add for Enclosure {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        Self::new(self.lower + other.lower, self.upper + other.upper)
    }
}

impl Sub for Enclosure {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        Self::new(self.lower - other.upper, self.upper - other.lower)
    }
}

impl Mul for Enclosure {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        let (a, b) = (self.lower * other.lower, self.lower * other.upper);
        let (c, d) = (self.upper * other.lower, self.upper * other.upper);
        Self::new(least(least(a, b), least(c, d)), most(most(a, b), most(c, d)))
    }
}

impl Mul<f64> for Enclosure {
    type Output = Self;
    #[inline]
    fn mul(self, factor: f64) -> Self {
        let (a, b) = (self.lower * factor, self.upper * factor);
        Self::new(least(a, b), most(a, b))
    }
}

impl Scalar for Enclosure {
    const ZERO: Self = Self { lower: 0.0, upper: 0.0 };

    fn from_f64(value: f64) -> Self {
        Self::new(value, value)
    }
    #[inline]
    fn square(self) -> Self {
        let (a, b) = (self.lower * self.lower, self.upper * self.upper);
        let least = if self.lower <= 0.0 && self.upper >= 0.0 { 0.0 } else { a.min(b) };
        Self::new(least, a.max(b))
    }
    fn inverse(self) -> Option<Self> {
        let away = self.lower > 0.0 || self.upper < 0.0;
        away.then(|| Self::new(1.0 / self.upper, 1.0 / self.lower)).filter(|i| i.magnitude().is_finite())
    }
    fn inverse_root(self) -> Option<Self> {
        let inverse = self.inverse().filter(|i| i.lower > 0.0)?;
        Some(Self::new(Real::sqrt(inverse.lower), Real::sqrt(inverse.upper)))
    }
}
