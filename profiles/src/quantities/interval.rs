//! A closed interval of the real line.

/// A closed interval `[lower, upper]`, in the unit of the quantity it bounds.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Interval {
    /// Lower end.
    pub lower: f64,
    /// Upper end.
    pub upper: f64,
}

impl Interval {
    /// The whole line.
    pub const UNBOUNDED: Self = Self { lower: f64::NEG_INFINITY, upper: f64::INFINITY };

    /// `[lower, upper]`; the caller orders the ends.
    #[must_use]
    pub const fn new(lower: f64, upper: f64) -> Self {
        Self { lower, upper }
    }

    /// `[-magnitude, magnitude]`.
    #[must_use]
    pub const fn symmetric(magnitude: f64) -> Self {
        Self { lower: -magnitude, upper: magnitude }
    }

    /// The interval seen from the other direction: `[-upper, -lower]`.
    #[must_use]
    pub fn mirrored(self) -> Self {
        Self { lower: -self.upper, upper: -self.lower }
    }

    /// Both ends equally far from zero.
    #[must_use]
    #[expect(clippy::float_cmp, reason = "symmetric intervals are built from one number")]
    pub fn is_symmetric(self) -> bool {
        self.lower == -self.upper
    }

    /// Whether `value` lies in the interval; false for NaN.
    #[must_use]
    pub fn contains(self, value: f64) -> bool {
        self.lower <= value && value <= self.upper
    }

    /// The largest magnitude in the interval.
    #[must_use]
    pub fn magnitude(self) -> f64 {
        self.lower.abs().max(self.upper.abs())
    }

    /// The smallest interval that holds this one and `value`.
    #[must_use]
    pub(crate) fn including(self, value: f64) -> Self {
        Self { lower: self.lower.min(value), upper: self.upper.max(value) }
    }
}
