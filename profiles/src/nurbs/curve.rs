//! The curve: knots and homogeneous control points, checked.

use alloc::vec::Vec;

use super::knots::check_degree;
use super::{Homogeneous, Knots, NurbsError};
use crate::quantities::Interval;

/// Largest coordinate: its square and fourth power stay in range.
pub(super) const MOST_COORDINATE: f64 = 1e75;

/// Largest weight, and one over the smallest.
const MOST_WEIGHT: f64 = 1e30;

/// The smallest weight beside the largest one.
const LEAST_RATIO: f64 = 1e-15;

/// A non-uniform rational B-spline in `D` dimensions, clamped at both ends, with positive weights:
///
/// `C(u) = sum w_i P_i N_i(u) / sum w_i N_i(u)`, for `u` from the first to the last knot.
///
/// Coordinates are in m or rad or any other unit; the parameter has none.
///
/// ```
/// use profiles::nurbs::NurbsCurve;
///
/// // a quarter of the unit circle as a rational parabola
/// let weights = [1.0, 0.5_f64.sqrt(), 1.0];
/// let curve = NurbsCurve::rational_bezier(&[[1.0, 0.0], [1.0, 1.0], [0.0, 1.0]], &weights)?;
/// let [x, y] = curve.point(0.3);
/// assert!((x.hypot(y) - 1.0).abs() < 1e-15);
/// // one degree higher, cut at three places: still that circle
/// let same = curve.raised(1)?.refined(&[0.2, 0.2, 0.7])?;
/// assert_eq!((same.degree(), same.homogeneous_points().len()), (3, 7));
/// let [x, y] = same.point(0.3);
/// assert!((x.hypot(y) - 1.0).abs() < 1e-15);
/// # Ok::<(), profiles::nurbs::NurbsError>(())
/// ```
///
/// # References
/// L. Piegl and W. Tiller, The NURBS Book, 2nd ed., Springer, 1997, <https://doi.org/10.1007/978-3-642-59223-2>
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(try_from = "super::unchecked::UncheckedCurve", into = "super::unchecked::UncheckedCurve")
)]
pub struct NurbsCurve<const D: usize> {
    knots: Knots,
    points: Vec<Homogeneous<D>>,
}

impl<const D: usize> NurbsCurve<D> {
    /// A curve of this degree with these control points, weights and knots (points plus degree plus one of them).
    ///
    /// # Errors
    /// Knots that [`Knots::new`] refuses; other counts than knots and degree ask for; a coordinate that is not finite
    /// or beyond 1e75; a weight that is not positive, outside `[1e-30, 1e30]` or below 1e-15 of the largest.
    pub fn new(
        degree: usize,
        points: &[[f64; D]],
        weights: &[f64],
        knots: Vec<f64>,
    ) -> Result<Self, NurbsError> {
        check_counts(degree, points.len(), knots.len())?;
        Self::with_knots(Knots::new(degree, knots)?, points, weights)
    }

    /// A curve with these control points and weights over checked knots.
    ///
    /// # Errors
    /// As for [`new`](Self::new).
    pub fn with_knots(knots: Knots, points: &[[f64; D]], weights: &[f64]) -> Result<Self, NurbsError> {
        if weights.len() != points.len() {
            return Err(NurbsError::WeightCount { weights: weights.len(), points: points.len() });
        }
        check_coordinates(points.iter())?;
        check_weights(weights.iter().copied())?;
        let points = points.iter().zip(weights).map(|(point, weight)| Homogeneous::new(*point, *weight));
        Self::from_homogeneous(knots, points.collect())
    }

    /// A polynomial spline: all weights are one.
    ///
    /// # Errors
    /// As for [`new`](Self::new).
    pub fn bspline(degree: usize, points: &[[f64; D]], knots: Vec<f64>) -> Result<Self, NurbsError> {
        Self::new(degree, points, &alloc::vec![1.0; points.len()], knots)
    }

    /// A polynomial spline over evenly spaced knots from 0 to 1.
    ///
    /// # Errors
    /// As for [`new`](Self::new).
    pub fn uniform(degree: usize, points: &[[f64; D]]) -> Result<Self, NurbsError> {
        let knots = Knots::uniform(degree, points.len())?;
        Self::with_knots(knots, points, &alloc::vec![1.0; points.len()])
    }

    /// A polynomial over `[0, 1]` in Bezier form, of a degree one below the number of control points.
    ///
    /// # Errors
    /// As for [`new`](Self::new).
    pub fn bezier(points: &[[f64; D]]) -> Result<Self, NurbsError> {
        Self::rational_bezier(points, &alloc::vec![1.0; points.len()])
    }

    /// A rational polynomial over `[0, 1]` in Bezier form, of a degree one below the number of control points.
    ///
    /// # Errors
    /// As for [`new`](Self::new).
    pub fn rational_bezier(points: &[[f64; D]], weights: &[f64]) -> Result<Self, NurbsError> {
        Self::with_knots(Knots::bezier(points.len().saturating_sub(1), 0.0, 1.0)?, points, weights)
    }

    /// A curve with these weighted control points over checked knots.
    ///
    /// # Errors
    /// As for [`new`](Self::new).
    pub fn from_homogeneous(knots: Knots, points: Vec<Homogeneous<D>>) -> Result<Self, NurbsError> {
        check_counts(knots.degree(), points.len(), knots.as_slice().len())?;
        check_weights(points.iter().map(|h| h.weight))?;
        for (index, h) in points.iter().enumerate() {
            check_point(index, &h.point())?;
        }
        Ok(Self { knots, points })
    }

    /// What an exact operation made of a checked curve: convex combinations, which stay within its bounds.
    pub(super) fn unchecked(knots: Knots, points: Vec<Homogeneous<D>>) -> Self {
        Self { knots, points }
    }

    /// The degree.
    #[inline]
    #[must_use]
    pub fn degree(&self) -> usize {
        self.knots.degree()
    }

    /// The knots.
    #[inline]
    #[must_use]
    pub fn knots(&self) -> &Knots {
        &self.knots
    }

    /// The control points with their weights.
    #[inline]
    #[must_use]
    pub fn homogeneous_points(&self) -> &[Homogeneous<D>] {
        &self.points
    }

    /// The control points.
    pub fn control_points(&self) -> impl Iterator<Item = [f64; D]> + '_ {
        self.points.iter().map(Homogeneous::point)
    }

    /// The weights.
    pub fn weights(&self) -> impl Iterator<Item = f64> + '_ {
        self.points.iter().map(|h| h.weight)
    }

    /// The interval of the parameter, from the first to the last knot.
    #[must_use]
    pub fn domain(&self) -> Interval {
        self.knots.domain()
    }

    /// The first point.
    #[must_use]
    pub fn start(&self) -> [f64; D] {
        self.points.first().map_or([0.0; D], Homogeneous::point)
    }

    /// The last point.
    #[must_use]
    pub fn end(&self) -> [f64; D] {
        self.points.last().map_or([0.0; D], Homogeneous::point)
    }

    pub(super) fn into_parts(self) -> (Knots, Vec<Homogeneous<D>>) {
        (self.knots, self.points)
    }
}

fn check_counts(degree: usize, points: usize, knots: usize) -> Result<(), NurbsError> {
    check_degree(degree)?;
    if points <= degree {
        return Err(NurbsError::PointCount { points, least: degree + 1 });
    }
    if knots != points + degree + 1 {
        return Err(NurbsError::KnotCount { knots, needed: points + degree + 1 });
    }
    Ok(())
}

fn check_weights(weights: impl Iterator<Item = f64> + Clone) -> Result<(), NurbsError> {
    let mut largest = 0.0_f64;
    for (index, value) in weights.clone().enumerate() {
        if !(1.0 / MOST_WEIGHT..=MOST_WEIGHT).contains(&value) {
            return Err(NurbsError::Weight { index, value });
        }
        largest = largest.max(value);
    }
    match weights.enumerate().find(|(_, value)| *value < LEAST_RATIO * largest) {
        Some((index, value)) => Err(NurbsError::WeightRatio { index, value, largest }),
        None => Ok(()),
    }
}

fn check_coordinates<'a, const D: usize>(
    points: impl Iterator<Item = &'a [f64; D]>,
) -> Result<(), NurbsError> {
    points.enumerate().try_for_each(|(index, point)| check_point(index, point))
}

/// Finite coordinates of a magnitude whose powers stay in range.
pub(super) fn check_point<const D: usize>(index: usize, point: &[f64; D]) -> Result<(), NurbsError> {
    let outside = |x: &f64| x.is_nan() || x.abs() > MOST_COORDINATE;
    match point.iter().position(outside) {
        Some(axis) => {
            let value = point.get(axis).copied().unwrap_or(f64::NAN);
            Err(NurbsError::Coordinate { index, axis, value })
        }
        None => Ok(()),
    }
}
