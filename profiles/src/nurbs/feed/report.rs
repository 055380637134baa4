//! What a planned feed reaches of its limits, and where.

use super::{FeedError, FeedInterpolator, FeedSample};
use crate::quantities::{Interval, Limits};

/// A limit counts as reached from this part of it on.
const REACHED: f64 = 0.95;

/// A largest value and where it is.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Peak {
    /// The value, in the unit of the quantity.
    pub value: f64,
    /// When it is reached, s.
    pub time: f64,
    /// Where along the curve, m.
    pub way: f64,
}

/// What a feed reaches, tick by tick.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FeedReport<const D: usize> {
    /// Bound of the distance between the curve and the straight lines from tick to tick, m: the largest curvature of the
    /// step times its length squared over eight, the same everywhere on the step.
    pub chord_error: Peak,
    /// Largest difference between the arc length of a step and that of the feed over the period, as a part of the longest
    /// step.
    pub fluctuation: Peak,
    /// Largest feed, m/s.
    pub feed: Peak,
    /// Largest magnitudes of the velocity of every axis, m/s.
    pub velocity: [Peak; D],
    /// Of its acceleration, m/s^2.
    pub acceleration: [Peak; D],
    /// Of its jerk, m/s^3.
    pub jerk: [Peak; D],
    /// Part of the curve on which the feed is at least 95 % of the command, or the chord error or the velocity,
    /// acceleration or jerk of an axis is at least 95 % of its limit.
    pub at_limit: f64,
    /// Mean feed, m/s.
    pub mean_feed: f64,
}

impl Peak {
    fn take(&mut self, value: f64, time: f64, way: f64) {
        if value > self.value {
            *self = Self { value, time, way };
        }
    }
}

impl<const D: usize, L> FeedInterpolator<D, L> {
    /// What the motion reaches of its limits at its ticks.
    ///
    /// # Errors
    /// As for [`ticks`](Self::ticks).
    pub fn report(&self) -> Result<FeedReport<D>, FeedError> {
        let mut report = FeedReport {
            chord_error: Peak::default(),
            fluctuation: Peak::default(),
            feed: Peak::default(),
            velocity: [Peak::default(); D],
            acceleration: [Peak::default(); D],
            jerk: [Peak::default(); D],
            at_limit: 0.0,
            mean_feed: if self.duration() > 0.0 { self.length() / self.duration() } else { 0.0 },
        };
        for sample in self.ticks()? {
            report.feed.take(sample.along.velocity, sample.time, sample.along.position);
        }
        let longest = report.feed.value * self.limits.period();
        let mut reached = 0.0;
        let mut before: Option<FeedSample<D>> = None;
        for sample in self.ticks()? {
            let mut used = report.take(&sample, self.limits.axes());
            used = used.max(sample.along.velocity / self.limits.feed());
            if let Some(last) = before {
                let (time, way) = (last.time, last.along.position);
                let step = sample.along.position - way;
                let chord_error = 0.125 * self.path.curvature(way, sample.along.position) * (step * step);
                report.chord_error.take(chord_error, time, way);
                used = used.max(chord_error / self.limits.chord_error());
                let walked = self.arc.length_at(sample.parameter) - self.arc.length_at(last.parameter);
                report.fluctuation.take((walked - step).abs() / longest, time, way);
                if used >= REACHED {
                    reached += step;
                }
            }
            before = Some(sample);
        }
        report.at_limit = reached / self.length();
        Ok(report)
    }
}

impl<const D: usize> FeedReport<D> {
    /// Takes in a tick; the largest part of a limit of an axis that is used there.
    fn take(&mut self, sample: &FeedSample<D>, axes: &[Limits; D]) -> f64 {
        let (time, way) = (sample.time, sample.along.position);
        let part = |value: f64, bounds: Interval| (value / bounds.upper).max(value / bounds.lower);
        let mut used = 0.0_f64;
        let peaks = self.velocity.iter_mut().zip(&mut self.acceleration).zip(&mut self.jerk);
        let values = sample.velocity.iter().zip(&sample.acceleration).zip(&sample.jerk);
        for ((((velocity, acceleration), jerk), ((v, a), j)), axis) in peaks.zip(values).zip(axes) {
            velocity.take(v.abs(), time, way);
            acceleration.take(a.abs(), time, way);
            jerk.take(j.abs(), time, way);
            let most = part(*v, axis.velocity()).max(part(*a, axis.acceleration()));
            used = used.max(most).max(part(*j, axis.jerk()));
        }
        used
    }
}
