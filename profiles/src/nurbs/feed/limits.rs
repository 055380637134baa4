//! What a feed must keep.

use super::FeedError;
use crate::quantities::{Limits, Real};

/// What the motion along a curve in `D` dimensions must keep.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FeedLimits<const D: usize> {
    feed: f64,
    axes: [Limits; D],
    chord_error: f64,
    period: f64,
}

impl<const D: usize> FeedLimits<D> {
    /// A commanded `feed` in m/s, limits of every axis, and the period of the controller in s.
    ///
    /// The axes' snap is that of the feed along the curve; laws that have none need none.
    ///
    /// # Errors
    /// A feed or a period that is not positive and finite.
    pub fn new(feed: f64, axes: [Limits; D], period: f64) -> Result<Self, FeedError> {
        if !(feed > 0.0 && feed.is_finite()) {
            return Err(FeedError::Feed(feed));
        }
        if !(period > 0.0 && period.is_finite()) {
            return Err(FeedError::Period(period));
        }
        Ok(Self { feed, axes, chord_error: f64::INFINITY, period })
    }

    /// Bounds how far the curve may be from the straight line between the points of two ticks, m.
    ///
    /// # Errors
    /// A chord error that is not positive; infinity is no limit.
    pub fn with_chord_error(self, chord_error: f64) -> Result<Self, FeedError> {
        if chord_error > 0.0 {
            Ok(Self { chord_error, ..self })
        } else {
            Err(FeedError::ChordError(chord_error))
        }
    }

    /// The commanded feed, m/s.
    #[must_use]
    pub fn feed(&self) -> f64 {
        self.feed
    }

    /// The limits of every axis.
    #[must_use]
    pub fn axes(&self) -> &[Limits; D] {
        &self.axes
    }

    /// The largest chord error, m.
    #[must_use]
    pub fn chord_error(&self) -> f64 {
        self.chord_error
    }

    /// The period of the controller, s.
    #[must_use]
    pub fn period(&self) -> f64 {
        self.period
    }

    /// The longest step along a piece of this curvature in 1/m that keeps the chord error, m.
    ///
    /// A component of the curve across the chord is zero at both ends of a step of length `l` and has a second
    /// derivative of at most the curvature, so that it is at most `curvature l^2 / 8`.
    pub(super) fn longest_step(&self, curvature: f64) -> f64 {
        if self.chord_error < f64::INFINITY && curvature > 0.0 {
            Real::sqrt(8.0 * self.chord_error / curvature)
        } else {
            f64::INFINITY
        }
    }
}
