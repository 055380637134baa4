//! Knot removal.

use alloc::vec::Vec;

use super::geometry::distance;
use super::{Homogeneous, Knots, NurbsCurve, NurbsError};

impl<const D: usize> NurbsCurve<D> {
    /// A curve with the inner knot `u` once less, and a bound in m of how far it is from this one at the same parameter.
    ///
    /// Where the knot can go without a trace, as after its insertion, the deviation is rounding; else the control points
    /// that putting the knot back would give differ from the old ones all by the same amount, which is the least that the
    /// largest can be.
    ///
    /// # Errors
    /// A negative tolerance, no such inner knot, or a bound above the tolerance, in m, which the error carries.
    pub fn without_knot(&self, u: f64, tolerance: f64) -> Result<(Self, f64), NurbsError> {
        if tolerance.is_nan() || tolerance < 0.0 {
            return Err(NurbsError::Tolerance(tolerance));
        }
        let domain = self.domain();
        let knot = self.knots().snapped(u);
        if self.knots().multiplicity(u) == 0 || knot <= domain.lower || knot >= domain.upper {
            return Err(NurbsError::NoKnot(u));
        }
        let degree = self.degree();
        let mut all = self.knots().as_slice().to_vec();
        let at = all.partition_point(|k| *k < knot);
        all.remove(at);
        let points = remove(degree, &all, self.homogeneous_points(), knot);
        let positive = |h: &Homogeneous<D>| h.weight > 0.0 && h.weighted.iter().all(|x| x.is_finite());
        let refused = |deviation| Err(NurbsError::Removal { knot, deviation, tolerance });
        if !points.iter().all(positive) {
            return refused(f64::INFINITY);
        }
        let Ok(reduced) = Self::from_homogeneous(Knots::unchecked(degree, all), points) else {
            return refused(f64::INFINITY);
        };
        let again = reduced.with_knot(knot, 1)?;
        let deviation = deviation(degree, self.homogeneous_points(), again.homogeneous_points());
        if deviation <= tolerance { Ok((reduced, deviation)) } else { refused(deviation) }
    }
}

/// The control points over `knots`, which have `u` once less.
///
/// Putting it back is `P_i = (1 - a_i) Q_(i-1) + a_i Q_i`, one equation more than there are unknown points `Q`. The sum
/// of `l_i P_i` with `l_(i+1) / l_i = -a_i / (1 - a_(i+1))` knows no inner `Q`, so that what it misses is spread evenly over
/// the `P_i`; then the equations agree, and are solved from both sides to where the larger share changes.
fn remove<const D: usize>(
    degree: usize,
    knots: &[f64],
    old: &[Homogeneous<D>],
    u: f64,
) -> Vec<Homogeneous<D>> {
    let at = knots.partition_point(|knot| *knot <= u);
    let copies = knots.iter().take(at).rev().take_while(|knot| **knot >= u).count();
    let first = at.saturating_sub(degree + 1);
    let equations = degree - copies.min(degree - 1);
    let share = |i: usize| match (knots.get(i), knots.get(i + degree)) {
        (Some(low), Some(high)) => (u - low) / (high - low),
        _ => 0.5,
    };
    let shares: Vec<f64> = (first + 1..=first + equations).map(share).collect();
    let mut points: Vec<Homogeneous<D>> = old.get(first + 1..=first + equations).unwrap_or_default().to_vec();
    let (Some(before), Some(after)) = (old.get(first), old.get(first + equations + 1)) else {
        return old.to_vec();
    };

    let mut factors = alloc::vec![1.0];
    for (here, next) in shares.iter().zip(shares.iter().skip(1)) {
        let last = factors.last().copied().unwrap_or(1.0);
        factors.push(-last * here / (1.0 - next));
    }
    let ends = (shares.first().copied().unwrap_or(0.5), shares.last().copied().unwrap_or(0.5));
    let last = factors.last().copied().unwrap_or(1.0);
    let known = before.combined(-(1.0 - ends.0), after, -last * ends.1);
    let missed = points.iter().zip(&factors).fold(known, |sum, (p, factor)| sum.combined(1.0, p, *factor));
    let total: f64 = factors.iter().map(|factor| factor.abs()).sum();
    for (point, factor) in points.iter_mut().zip(&factors) {
        *point = point.combined(1.0, &missed, -factor.signum() / total);
    }

    // Shares fall from left to right: from the left while more of the point is the unknown one, then from the right.
    let split = shares.iter().take_while(|share| **share >= 0.5).count().min(equations - 1);
    let mut solved = Vec::with_capacity(equations - 1);
    let mut known = *before;
    for (point, share) in points.iter().zip(&shares).take(split) {
        known = point.combined(1.0 / share, &known, -(1.0 - share) / share);
        solved.push(known);
    }
    let mut known = *after;
    let mut from_the_right = Vec::with_capacity(equations);
    for (point, share) in points.iter().zip(&shares).skip(split + 1).rev() {
        known = point.combined(1.0 / (1.0 - share), &known, -share / (1.0 - share));
        from_the_right.push(known);
    }
    solved.extend(from_the_right.into_iter().rev());
    let (left, right) =
        (old.get(..=first).unwrap_or_default(), old.get(first + equations + 1..).unwrap_or_default());
    left.iter().chain(&solved).chain(right).copied().collect()
}

/// A bound of the distance at the same parameter of two curves over the same knots: from `C - C2 = sum N_i ((A_i - B_i) -
/// C2 (w_i - v_i)) / sum N_i w_i` it is the largest of `(v_i |P_i - Q_i| + |w_i - v_i| |P_i - C2|) / w_i`, and `C2` lies
/// among the control points around.
fn deviation<const D: usize>(degree: usize, ours: &[Homogeneous<D>], others: &[Homogeneous<D>]) -> f64 {
    let mut most = 0.0_f64;
    for (index, (one, other)) in ours.iter().zip(others).enumerate() {
        if one == other {
            continue;
        }
        let (point, apart) = (one.point(), distance(&one.point(), &other.point()));
        let around = others.iter().take(index + degree + 1).skip(index.saturating_sub(degree));
        let reach = around.fold(0.0_f64, |reach, h| reach.max(distance(&point, &h.point())));
        let (w, v) = (one.weight, other.weight);
        most = most.max((v * apart + (w - v).abs() * reach) / w);
    }
    most
}
