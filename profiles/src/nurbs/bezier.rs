//! The polynomial pieces of a curve.

use alloc::vec::Vec;

use super::insert::insert;
use super::{Homogeneous, Knots, NurbsCurve};

/// One rational polynomial piece of a curve in Bezier form.
#[derive(Debug, Clone, PartialEq)]
pub struct BezierSegment<const D: usize> {
    /// Parameter where the piece starts.
    pub from: f64,
    /// Parameter where it ends.
    pub to: f64,
    /// Its control points, one more than the degree.
    pub points: Vec<Homogeneous<D>>,
}

impl<const D: usize> NurbsCurve<D> {
    /// The same curve with every inner knot as often as the degree, so that its control points are those of its Bezier
    /// pieces, neighbours sharing one.
    #[must_use]
    pub fn decomposed(&self) -> Self {
        let degree = self.degree();
        let (old, mut points) = self.clone().into_parts();
        let mut all = old.as_slice().to_vec();
        for (knot, multiplicity) in old.distinct() {
            for _ in multiplicity..degree {
                insert(degree, &mut all, &mut points, knot);
            }
        }
        Self::unchecked(Knots::unchecked(degree, all), points)
    }

    /// The pieces between distinct knots, in sequence.
    #[must_use]
    pub fn bezier_segments(&self) -> Vec<BezierSegment<D>> {
        let whole = self.decomposed();
        let knots: Vec<f64> = whole.knots().distinct().map(|(knot, _)| knot).collect();
        let pieces = whole.homogeneous_points().windows(self.degree() + 1).step_by(self.degree());
        let spans = knots.iter().zip(knots.iter().skip(1));
        let segment = |((from, to), points): ((&f64, &f64), &[Homogeneous<D>])| BezierSegment {
            from: *from,
            to: *to,
            points: points.to_vec(),
        };
        spans.zip(pieces).map(segment).collect()
    }
}
