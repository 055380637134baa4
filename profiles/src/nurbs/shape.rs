//! Parts of a curve, and the same curve over another parameter.

use super::{Knots, NurbsCurve, NurbsError};
use crate::quantities::Real;

impl<const D: usize> NurbsCurve<D> {
    /// The curve up to `u` and from there on, each over its part of the domain. A parameter within 16 roundings of a knot
    /// is that knot.
    ///
    /// # Errors
    /// A parameter that is not inside the domain.
    pub fn split(&self, u: f64) -> Result<(Self, Self), NurbsError> {
        let u = self.knots().snapped(u);
        let degree = self.degree();
        let missing = degree.saturating_sub(self.knots().multiplicity(u));
        let (knots, points) = self.with_knot(u, missing)?.into_parts();
        let all = knots.as_slice();
        // The first of the copies of u; the point that they tie the curve to has the index one below.
        let at = all.partition_point(|knot| *knot < u);
        let (before, after) = all.split_at(at);
        let left = before.iter().copied().chain(core::iter::repeat_n(u, degree + 1));
        let right = core::iter::once(u).chain(after.iter().copied());
        let left = Knots::unchecked(degree, left.collect());
        let right = Knots::unchecked(degree, right.collect());
        let shared = at - 1;
        let (first, last) = (points.get(..at), points.get(shared..));
        Ok((
            Self::unchecked(left, first.unwrap_or_default().to_vec()),
            Self::unchecked(right, last.unwrap_or_default().to_vec()),
        ))
    }

    /// The curve from parameter `from` to parameter `to`, over that part of the domain.
    ///
    /// # Errors
    /// An end outside the domain, or ends that are not at least 16 roundings apart.
    pub fn part(&self, from: f64, to: f64) -> Result<Self, NurbsError> {
        let domain = self.domain();
        let (from, to) = (self.knots().snapped(from), self.knots().snapped(to));
        for value in [from, to] {
            if !domain.contains(value) {
                return Err(NurbsError::Parameter { value, lower: domain.lower, upper: domain.upper });
            }
        }
        if to - from < self.knots().rounding() {
            return Err(NurbsError::Domain { lower: from, upper: to });
        }
        let curve = if to < domain.upper { self.split(to)?.0 } else { self.clone() };
        if from > domain.lower { Ok(curve.split(from)?.1) } else { Ok(curve) }
    }

    /// The same curve run through from its end to its start, over the same domain.
    #[must_use]
    pub fn reversed(&self) -> Self {
        let domain = self.domain();
        let (knots, mut points) = self.clone().into_parts();
        points.reverse();
        let degree = knots.degree();
        // The ends to the bit, which the sum may miss.
        let turned = |u: f64| match u {
            u if u <= domain.lower => domain.upper,
            u if u >= domain.upper => domain.lower,
            u => (domain.lower + (domain.upper - u)).clamped(domain.lower, domain.upper),
        };
        let mut all = knots.into_vec();
        all.reverse();
        all.iter_mut().for_each(|knot| *knot = turned(*knot));
        Self::unchecked(Knots::unchecked(degree, all), points)
    }

    /// The same curve over the parameter interval `[lower, upper]`.
    ///
    /// # Errors
    /// An interval without length, shorter than 1e-30 or longer than 1e30, or so far from zero that distinct knots would
    /// come closer than 16 roundings.
    pub fn with_domain(&self, lower: f64, upper: f64) -> Result<Self, NurbsError> {
        super::knots::check_interval(lower, upper)?;
        let domain = self.domain();
        let (knots, points) = self.clone().into_parts();
        let degree = knots.degree();
        let mut all = knots.into_vec();
        for knot in &mut all {
            let t = (*knot - domain.lower) / (domain.upper - domain.lower);
            *knot = ((1.0 - t) * lower + t * upper).clamped(lower, upper);
        }
        Ok(Self::unchecked(Knots::new(degree, all)?, points))
    }
}
