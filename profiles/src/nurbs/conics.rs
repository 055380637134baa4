//! Lines and arcs, exactly.

use core::f64::consts::{FRAC_PI_2, TAU};

use alloc::vec::Vec;

use super::curve::{MOST_COORDINATE, check_point};
use super::geometry::{distance, dot, norm};
use super::{Knots, NurbsCurve, NurbsError};
use crate::quantities::Real;

/// The most turns of an arc.
const MOST_TURNS: f64 = 1000.0;

impl<const D: usize> NurbsCurve<D> {
    /// The straight line from one point to another, with constant speed over `[0, 1]`.
    ///
    /// # Errors
    /// A coordinate that is not finite or beyond 1e75.
    pub fn line(from: [f64; D], to: [f64; D]) -> Result<Self, NurbsError> {
        Self::bezier(&[from, to])
    }

    /// Straight lines through `points`, with constant speed over `[0, 1]`. A point equal to the one before is left out.
    ///
    /// # Errors
    /// A coordinate that is not finite or beyond 1e75, less than two different points, or a line so short beside the
    /// whole that no parameter lies on it.
    pub fn polyline(points: &[[f64; D]]) -> Result<Self, NurbsError> {
        for (index, point) in points.iter().enumerate() {
            check_point(index, point)?;
        }
        let mut corners: Vec<[f64; D]> = Vec::with_capacity(points.len());
        let mut lengths = alloc::vec![0.0];
        let mut length = 0.0;
        for point in points {
            let step = corners.last().map_or(f64::INFINITY, |last| distance(last, point));
            if step > 0.0 {
                if step.is_finite() {
                    length += step;
                    lengths.push(length);
                }
                corners.push(*point);
            }
        }
        if corners.len() < 2 {
            return Err(NurbsError::PointCount { points: corners.len(), least: 2 });
        }
        let inner = lengths.get(1..lengths.len() - 1).unwrap_or_default();
        let inner: Vec<f64> = inner.iter().map(|s| s / length).collect();
        let weights = alloc::vec![1.0; corners.len()];
        Self::with_knots(Knots::clamped(1, 0.0, &inner, 1.0)?, &corners, &weights)
    }

    /// The arc of an ellipse, `center + x cos a + y sin a` for `a` from 0 to `sweep` in rad, over `[0, 1]`: rational
    /// parabolas of a quarter turn at most. With `x` and `y` perpendicular and of one length it is a circle's.
    ///
    /// The angle is not proportional to the parameter; at the knots it is.
    ///
    /// # Errors
    /// A coordinate that is not finite or beyond 1e75, or an angle that is zero, NaN or beyond 1000 turns.
    pub fn ellipse_arc(center: [f64; D], x: [f64; D], y: [f64; D], sweep: f64) -> Result<Self, NurbsError> {
        for (index, point) in [center, x, y].iter().enumerate() {
            check_point(index, point)?;
        }
        if sweep.is_nan() || sweep.abs() > MOST_TURNS * TAU || sweep.abs() < f64::MIN_POSITIVE {
            return Err(NurbsError::Sweep(sweep));
        }
        // A rounding above whole quarters is no quarter more.
        let pieces = Real::ceil(sweep.abs() / FRAC_PI_2 * (1.0 - 4.0 * f64::EPSILON)).max(1.0);
        let half = 0.5 * sweep / pieces;
        let middle = Real::cos(half);
        let at = |angle: f64, reach: f64| {
            let (sin, cos) = Real::sin_cos(angle);
            let mut point = center;
            for (p, (x, y)) in point.iter_mut().zip(x.iter().zip(&y)) {
                *p += (x * cos + y * sin) / reach;
            }
            point
        };
        let count = 2 * pieces as usize + 1;
        let mut points: Vec<[f64; D]> = Vec::with_capacity(count);
        let mut weights = Vec::with_capacity(count);
        for k in 0..count {
            let between = k % 2 == 1;
            let angle = if k + 1 == count { sweep } else { k as f64 * half };
            points.push(at(angle, if between { middle } else { 1.0 }));
            weights.push(if between { middle } else { 1.0 });
        }
        // A whole turn ends where it starts, which the sine of a rounded angle misses.
        let closed = (sweep.abs() - TAU).abs() <= 2.0 * f64::EPSILON * TAU;
        if let (true, Some(start), Some(end)) = (closed, points.first().copied(), points.last_mut()) {
            *end = start;
        }
        let inner: Vec<f64> = (2..count - 1).map(|k| (k / 2) as f64 / pieces).collect();
        Self::with_knots(Knots::clamped(2, 0.0, &inner, 1.0)?, &points, &weights)
    }
}

impl NurbsCurve<2> {
    /// The circular arc about `center` from the angle `start` on by `sweep`, both in rad, positive to the left.
    ///
    /// # Errors
    /// As for [`ellipse_arc`](Self::ellipse_arc), and a radius that is not positive or beyond 1e75.
    pub fn arc(center: [f64; 2], radius: f64, start: f64, sweep: f64) -> Result<Self, NurbsError> {
        check_radius(radius)?;
        if !start.is_finite() {
            return Err(NurbsError::Sweep(start));
        }
        let (sin, cos) = Real::sin_cos(start);
        Self::ellipse_arc(center, [radius * cos, radius * sin], [-radius * sin, radius * cos], sweep)
    }

    /// The full circle about `center`, from the angle zero to the left.
    ///
    /// # Errors
    /// As for [`arc`](Self::arc).
    pub fn circle(center: [f64; 2], radius: f64) -> Result<Self, NurbsError> {
        Self::arc(center, radius, 0.0, TAU)
    }
}

impl NurbsCurve<3> {
    /// The circular arc about the axis through `center` along `axis`, from `start` on by `sweep` in rad, right-handed
    /// about the axis, in the plane of `start` across it.
    ///
    /// # Errors
    /// As for [`ellipse_arc`](Self::ellipse_arc); a radius that is not positive or beyond 1e75; an axis without length,
    /// or one along the direction to `start`.
    pub fn arc(center: [f64; 3], start: [f64; 3], axis: [f64; 3], sweep: f64) -> Result<Self, NurbsError> {
        for (index, point) in [center, start, axis].iter().enumerate() {
            check_point(index, point)?;
        }
        let mut x = start;
        x.iter_mut().zip(center).for_each(|(x, c)| *x -= c);
        let (reach, length) = (norm(&x), norm(&axis));
        check_radius(reach)?;
        if length <= 0.0 {
            return Err(NurbsError::Plane(0.0));
        }
        let axis = axis.map(|a| a / length);
        let along = dot(&x, &axis);
        let mut center = center;
        for ((x, c), a) in x.iter_mut().zip(&mut center).zip(axis) {
            *x -= along * a;
            *c += along * a;
        }
        let radius = norm(&x);
        // Below this the direction of the rest is rounding.
        if radius <= 1e-8 * reach {
            return Err(NurbsError::Plane(radius / reach));
        }
        let ([ax, ay, az], [bx, by, bz]) = (axis, x);
        let y = [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx];
        Self::ellipse_arc(center, x, y, sweep)
    }

    /// The full circle about the axis through `center` along `axis` that starts and ends in `start`.
    ///
    /// # Errors
    /// As for [`arc`](Self::arc).
    pub fn circle(center: [f64; 3], start: [f64; 3], axis: [f64; 3]) -> Result<Self, NurbsError> {
        Self::arc(center, start, axis, TAU)
    }
}

fn check_radius(radius: f64) -> Result<(), NurbsError> {
    if radius > 0.0 && radius <= MOST_COORDINATE { Ok(()) } else { Err(NurbsError::Radius(radius)) }
}
