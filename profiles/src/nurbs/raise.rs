//! Degree raising.

use super::insert::insert;
use super::knots::check_degree;
use super::{Homogeneous, Knots, NurbsCurve, NurbsError};

impl<const D: usize> NurbsCurve<D> {
    /// The same curve with a degree `times` higher; every knot is there `times` more often.
    ///
    /// # Errors
    /// A degree above 15.
    ///
    /// # References
    /// H. Prautzsch, Degree elevation of B-spline curves, Computer Aided Geometric Design 1, 1984.
    pub fn raised(&self, times: usize) -> Result<Self, NurbsError> {
        check_degree(self.degree().saturating_add(times))?;
        (0..times).try_fold(self.clone(), |curve, _| curve.raised_once())
    }

    /// A control point of the raised curve is the blossom at `degree + 1` knots: the mean of the old blossom with each of
    /// them left out. Those are control points of the old curve over the new knots without every `(degree + 1)`-th one, in
    /// `degree + 1` ways, so that nothing but convex combinations is made.
    fn raised_once(&self) -> Result<Self, NurbsError> {
        let degree = self.degree();
        let stride = degree + 1;
        let raised = Knots::new(degree + 1, self.knots().with_each_once_more())?;
        let count = raised.points();
        let mut sums = alloc::vec![Homogeneous::ZERO; count];
        for offset in 0..stride {
            let (mut knots, mut points) =
                (self.knots().as_slice().to_vec(), self.homogeneous_points().to_vec());
            // A knot of which no copy is left out goes in once more.
            let mut position = 0;
            for (knot, multiplicity) in raised.distinct() {
                let mut copies = position..position + multiplicity;
                let inside = position > 0 && copies.end < raised.as_slice().len();
                if inside && !copies.any(|copy| copy % stride == offset) {
                    insert(degree, &mut knots, &mut points, knot);
                }
                position += multiplicity;
            }
            let mut left_out = 0;
            for (index, sum) in sums.iter_mut().enumerate() {
                left_out += usize::from(index > 0 && index % stride == offset);
                if let Some(point) = points.get(index - left_out) {
                    *sum = sum.combined(1.0, point, 1.0);
                }
            }
        }
        let mut points = sums;
        points.iter_mut().for_each(|sum| *sum = sum.divided(stride as f64));
        // The ends stay to the bit.
        let ends = self.homogeneous_points();
        if let (Some(to), Some(from)) = (points.first_mut(), ends.first()) {
            *to = *from;
        }
        if let (Some(to), Some(from)) = (points.last_mut(), ends.last()) {
            *to = *from;
        }
        Ok(Self::unchecked(raised, points))
    }
}
