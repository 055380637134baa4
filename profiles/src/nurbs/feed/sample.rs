//! The motion of all axes at one instant, and tick by tick.

use super::FeedInterpolator;
use super::profile::Sections;
use crate::cursor::Cursor;
use crate::quantities::Sample;

/// The motion along the curve and of every axis at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FeedSample<const D: usize> {
    /// Time from the start, s.
    pub time: f64,
    /// Way along the curve in m, feed in m/s and its derivatives.
    pub along: Sample,
    /// Parameter of the curve.
    pub parameter: f64,
    /// The point, m.
    pub position: [f64; D],
    /// Velocity of every axis, m/s.
    pub velocity: [f64; D],
    /// Acceleration of every axis, m/s^2.
    pub acceleration: [f64; D],
    /// Jerk of every axis, m/s^3.
    pub jerk: [f64; D],
}

impl<const D: usize> FeedSample<D> {
    /// The sample at a place of the curve, with the curve and its derivatives by arc length there, if it has any:
    ///
    /// `x' = t v`, `x'' = t a + k v^2`, `x''' = t j + 3 k v a + b v^3`
    pub(super) fn new(
        time: f64,
        along: Sample,
        parameter: f64,
        curve: Option<[[f64; D]; 4]>,
        point: impl FnOnce() -> [f64; D],
    ) -> Self {
        let zero = [0.0; D];
        // Where the curve has no direction the feed is at rest.
        let [position, tangent, bend, twist] = curve.unwrap_or_else(|| [point(), zero, zero, zero]);
        let mut sample =
            Self { time, along, parameter, position, velocity: zero, acceleration: zero, jerk: zero };
        let Sample { velocity: v, acceleration: a, jerk: j, .. } = along;
        let rows = sample.velocity.iter_mut().zip(&mut sample.acceleration).zip(&mut sample.jerk);
        for (((velocity, acceleration), jerk), ((t, k), b)) in rows.zip(tangent.iter().zip(&bend).zip(&twist))
        {
            *velocity = t * v;
            *acceleration = t * a + k * (v * v);
            *jerk = t * j + 3.0 * k * (v * a) + b * (v * v * v);
        }
        sample
    }
}

/// The motion at every tick of the controller, from the start to the end, from [`FeedInterpolator::ticks`].
#[derive(Debug, Clone)]
pub struct Ticks<'a, const D: usize, L> {
    interpolator: &'a FeedInterpolator<D, L>,
    cursor: Cursor<&'a Sections, f64>,
    last: u64,
}

impl<'a, const D: usize, L> Ticks<'a, D, L> {
    pub(super) fn new(
        interpolator: &'a FeedInterpolator<D, L>,
        cursor: Cursor<&'a Sections, f64>,
        last: u64,
    ) -> Self {
        Self { interpolator, cursor, last }
    }
}

impl<const D: usize, L> Iterator for Ticks<'_, D, L> {
    type Item = FeedSample<D>;

    fn next(&mut self) -> Option<FeedSample<D>> {
        let tick = self.cursor.next_tick();
        if tick > self.last {
            return None;
        }
        let along = self.cursor.tick();
        let time = tick as f64 * self.interpolator.limits.period();
        Some(self.interpolator.at(time, along))
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        let left = (self.last + 1).saturating_sub(self.cursor.next_tick());
        usize::try_from(left).map_or((usize::MAX, None), |left| (left, Some(left)))
    }
}
