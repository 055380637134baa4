//! Knot insertion.

use alloc::vec::Vec;

use super::{Homogeneous, Knots, NurbsCurve, NurbsError};

impl<const D: usize> NurbsCurve<D> {
    /// The same curve with the knot `u` `times` more often. A parameter within 16 roundings of a knot is that knot.
    ///
    /// # Errors
    /// A parameter that is not inside the domain, or a multiplicity above the degree.
    pub fn with_knot(&self, u: f64, times: usize) -> Result<Self, NurbsError> {
        let (knots, mut points) = self.clone().into_parts();
        let degree = knots.degree();
        let domain = knots.domain();
        let u = knots.snapped(u);
        if !(u > domain.lower && u < domain.upper) {
            return Err(NurbsError::Parameter { value: u, lower: domain.lower, upper: domain.upper });
        }
        let multiplicity = knots.multiplicity(u) + times;
        if multiplicity > degree {
            return Err(NurbsError::Multiplicity { knot: u, multiplicity, most: degree });
        }
        let mut all = knots.into_vec();
        for _ in 0..times {
            insert(degree, &mut all, &mut points, u);
        }
        Ok(Self::unchecked(Knots::new(degree, all)?, points))
    }

    /// The same curve with all of `knots` in addition to its own; a repeated one goes in as often.
    ///
    /// # Errors
    /// As for [`with_knot`](Self::with_knot).
    pub fn refined(&self, knots: &[f64]) -> Result<Self, NurbsError> {
        knots.iter().try_fold(self.clone(), |curve, knot| curve.with_knot(*knot, 1))
    }
}

/// Puts `u`, which lies inside the domain and is there less than `degree` times, into the knots once more (Boehm).
///
/// Every new control point is a convex combination of two old ones.
///
/// # References
/// W. Boehm, Inserting new knots into B-spline curves, Computer-Aided Design 12, 1980,
/// <https://doi.org/10.1016/0010-4485(80)90154-2>
pub(super) fn insert<const D: usize>(
    degree: usize,
    knots: &mut Vec<f64>,
    points: &mut Vec<Homogeneous<D>>,
    u: f64,
) {
    // knots[at - 1] <= u < knots[at]
    let at = knots.partition_point(|knot| *knot <= u);
    let first = at.saturating_sub(degree + 1);
    let Some(kept) = points.get(first).copied() else { return };
    points.insert(first, kept);
    for index in first + 1..=first + degree {
        let (Some(low), Some(high)) = (knots.get(index), knots.get(index + degree)) else { return };
        // Every old point has moved one up: these two were the ones at index - 1 and at index.
        let Some([here, next, ..]) = points.get_mut(index..) else { return };
        *here = here.blended(next, (u - low) / (high - low));
    }
    knots.insert(at, u);
}
