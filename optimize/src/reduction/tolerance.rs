//! Knots for a tolerance.

use profiles::nurbs::{Knots, NurbsCurve};

use super::deviation::Difference;
use super::error::ReductionError;
use super::options::{Criterion, Reduction};
use super::reduce::{Reduced, kept, onto};

/// Control points beyond which a tolerance counts as out of reach.
const MOST_POINTS: usize = 4096;

/// The least squares deviate by at most so many times the optimum where it is worth a try.
const NEAR: f64 = 8.0;

/// Halves spans until the curve is met within the tolerance.
pub(super) fn within<const D: usize>(
    curve: &NurbsCurve<D>,
    tolerance: f64,
    degree: usize,
    reduction: &Reduction,
) -> Result<Reduced<D>, ReductionError> {
    let mut knots = kept(curve, degree)?;
    let quick = Reduction { criterion: Criterion::MeanSquare, ..reduction.clone() };
    loop {
        let mut found = onto(curve, knots.clone(), &quick)?;
        let near = found.deviation.at_most <= NEAR * tolerance;
        if found.deviation.at_most > tolerance && near && reduction.criterion == Criterion::Largest {
            found = onto(curve, knots.clone(), reduction)?;
        }
        if found.deviation.at_most <= tolerance {
            return Ok(found);
        }
        let points = knots.points();
        let refined = halved(curve, &found.curve, &knots, tolerance);
        match refined.filter(|refined| refined.points() <= MOST_POINTS) {
            Some(refined) => knots = refined,
            None => {
                let deviation = found.deviation.at_most;
                return Err(ReductionError::NotReached { points, deviation, tolerance });
            }
        }
    }
}

/// The knots with another one in the middle of every span that deviates too much; none where that is too fine.
fn halved<const D: usize>(
    curve: &NurbsCurve<D>,
    reduced: &NurbsCurve<D>,
    knots: &Knots,
    tolerance: f64,
) -> Option<Knots> {
    let pieces = Difference::new(curve, reduced).ok()?.deviations();
    let middles = pieces.iter().filter(|(_, deviation)| *deviation > tolerance);
    let mut inner: Vec<f64> = middles.map(|((from, to), _)| 0.5 * (from + to)).collect();
    inner.extend_from_slice(knots.inner());
    inner.sort_unstable_by(f64::total_cmp);
    let domain = knots.domain();
    Knots::clamped(knots.degree(), domain.lower, &inner, domain.upper).ok()
}
