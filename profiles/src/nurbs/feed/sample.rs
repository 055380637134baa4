//! The motion of all axes at one instant, and tick by tick.

use super::FeedInterpolator;
use super::cell::norm;
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
    /// The sample at a place of the curve, given the derivatives of the curve by its parameter there:
    ///
    /// `x' = t v`, `x'' = t a + k v^2`, `x''' = t j + 3 k v a + b v^3`
    pub(super) fn new(time: f64, along: Sample, parameter: f64, derivatives: [[f64; D]; 4]) -> Self {
        let Sample { velocity: v, acceleration: a, jerk: j, .. } = along;
        let [position, first, second, third] = derivatives;
        let mut sample = Self {
            time,
            along,
            parameter,
            position,
            velocity: [0.0; D],
            acceleration: [0.0; D],
            jerk: [0.0; D],
        };
        let speed = norm(&first);
        // Where the curve has no direction the feed is at rest.
        let slowness = 1.0 / speed;
        if !slowness.is_finite() {
            return sample;
        }
        let dot = |x: &[f64; D], y: &[f64; D]| x.iter().zip(y).map(|(x, y)| x * y).sum::<f64>();
        let tangent = first.map(|x| x * slowness);
        let (along_second, along_third) = (dot(&second, &tangent), dot(&third, &tangent));
        let mut normal = second;
        normal.iter_mut().zip(&tangent).for_each(|(n, t)| *n -= along_second * t);
        let across = dot(&normal, &normal);
        let square = slowness * slowness;
        let rows = sample.velocity.iter_mut().zip(&mut sample.acceleration).zip(&mut sample.jerk);
        let curve = tangent.iter().zip(&normal).zip(&third);
        for (((velocity, acceleration), jerk), ((t, normal), third)) in rows.zip(curve) {
            // With u' = 1/|r'|: what of r'' is across the tangent times u'^2, and the derivative of that times u'.
            let bend = normal * square;
            let twist = (third - along_third * t - slowness * (3.0 * along_second * normal + across * t))
                * (square * slowness);
            *velocity = t * v;
            *acceleration = t * a + bend * (v * v);
            *jerk = t * j + 3.0 * bend * (v * a) + twist * (v * v * v);
        }
        sample
    }
}

/// The motion at every tick of the controller, from the start to the end, from [`FeedInterpolator::ticks`].
#[derive(Debug, Clone)]
pub struct Ticks<'a, const D: usize, L> {
    interpolator: &'a FeedInterpolator<D, L>,
    cursor: Cursor<&'a Sections, f64>,
    cell: usize,
    last: u64,
}

impl<'a, const D: usize, L> Ticks<'a, D, L> {
    pub(super) fn new(
        interpolator: &'a FeedInterpolator<D, L>,
        cursor: Cursor<&'a Sections, f64>,
        last: u64,
    ) -> Self {
        Self { interpolator, cursor, cell: 0, last }
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
        let cells = &self.interpolator.path.cells;
        while cells.get(self.cell).is_some_and(|cell| cell.end <= along.position)
            && self.cell + 1 < cells.len()
        {
            self.cell += 1;
        }
        Some(self.interpolator.at(time, along, self.cell))
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        let left = (self.last + 1).saturating_sub(self.cursor.next_tick());
        usize::try_from(left).map_or((usize::MAX, None), |left| (left, Some(left)))
    }
}
