//! The reduction of a curve.

use profiles::nurbs::{Homogeneous, Knots, NurbsCurve};

use super::deviation::{Deviation, Difference, check_domain};
use super::error::ReductionError;
use super::exchange::least_largest;
use super::mean_square::mean_square;
use super::options::{Criterion, Reduction, Target, Weights};
use super::problem::Problem;
use super::tolerance::within;

/// A curve as close as this, as a part of its size, is the curve: roundings are larger.
const EXACT: f64 = 1e-13;

/// What a reduction has made of a curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Reduced<const D: usize> {
    /// The reduced curve.
    pub curve: NurbsCurve<D>,
    /// How far it is from the given one, with a bound that holds everywhere.
    pub deviation: Deviation,
    /// No curve with these knots, ends, and weights inside their bounds deviates by less; 0 where nothing is known.
    pub optimum: f64,
}

/// A curve of a lower degree that runs close to `curve`, parameter by parameter, and through its ends.
///
/// Least squares in homogeneous coordinates find a curve that is reducible to rounding. From there the largest distance
/// is made small: the sets `|C W - N| <= t W` for control points `N` and weights `W` of the reduced curve are convex, so
/// that a central path leads to the global optimum for the given knots, weights free or fixed; samples are added where
/// the distance is largest until there is nothing above their optimum.
///
/// ```
/// use optimize::reduce_degree;
/// use optimize::reduction::Reduction;
/// use profiles::nurbs::NurbsCurve;
///
/// let points = [[-5.0, 0.0], [-7.0, 2.0], [-3.0, 5.0], [2.0, 6.0], [5.0, 3.0], [3.0, 0.0]];
/// let quintic = NurbsCurve::bezier(&points)?;
/// let quartic = reduce_degree(&quintic, &Reduction::to(4))?;
/// assert!(quartic.deviation.at_most < 1.14e-3 && quartic.optimum > 1.12e-3);
/// // Four spans at most keep a parabola within a tenth.
/// let parabola = reduce_degree(&quintic, &Reduction::within(0.1, Some(2)))?;
/// assert!(parabola.deviation.at_most <= 0.1 && parabola.curve.homogeneous_points().len() <= 6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// A degree that is not below the curve's, knots over another interval, weights that fit no curve, tangents where the
/// curve has none, a tolerance that is not positive or is not met.
///
/// # References
/// M. Eck, "Least squares degree reduction of Bezier curves", Computer-Aided Design 27 (1995),
/// <https://doi.org/10.1016/0010-4485(95)00008-3>: ends kept, several degrees at once.
pub fn reduce_degree<const D: usize>(
    curve: &NurbsCurve<D>,
    reduction: &Reduction,
) -> Result<Reduced<D>, ReductionError> {
    match &reduction.target {
        Target::Degree(degree) => onto(curve, kept(curve, *degree)?, reduction),
        Target::Knots(knots) => {
            check_degree(curve, knots.degree())?;
            check_domain(curve, knots.domain())?;
            onto(curve, knots.clone(), reduction)
        }
        Target::Tolerance { tolerance, degree } => {
            if !(*tolerance > 0.0 && tolerance.is_finite()) {
                return Err(ReductionError::Tolerance(*tolerance));
            }
            if let Weights::Given(given) = &reduction.weights {
                return Err(ReductionError::WeightsWithoutKnots(given.len()));
            }
            if let Some(degree) = degree {
                return within(curve, *tolerance, *degree, reduction);
            }
            let mut best: Option<Reduced<D>> = None;
            let mut failed = ReductionError::Degree { degree: 0, curve: curve.degree() };
            for degree in 1..curve.degree() {
                let points = |reduced: &Reduced<D>| reduced.curve.homogeneous_points().len();
                match within(curve, *tolerance, degree, reduction) {
                    Ok(found) if best.as_ref().is_none_or(|best| points(&found) < points(best)) => {
                        best = Some(found);
                    }
                    Ok(_) => {}
                    Err(error) => failed = error,
                }
            }
            best.ok_or(failed)
        }
    }
}

fn check_degree<const D: usize>(curve: &NurbsCurve<D>, degree: usize) -> Result<(), ReductionError> {
    if (1..curve.degree()).contains(&degree) {
        Ok(())
    } else {
        Err(ReductionError::Degree { degree, curve: curve.degree() })
    }
}

/// The knots of the curve for a lower degree: as smooth at each inner knot as the curve is.
pub(super) fn kept<const D: usize>(curve: &NurbsCurve<D>, degree: usize) -> Result<Knots, ReductionError> {
    check_degree(curve, degree)?;
    let domain = curve.domain();
    let steps = curve.degree() - degree;
    let inside = |(knot, _): &(f64, usize)| *knot > domain.lower && *knot < domain.upper;
    let times = |(knot, m): (f64, usize)| std::iter::repeat_n(knot, m.saturating_sub(steps).max(1));
    let inner: Vec<f64> = curve.knots().distinct().filter(inside).flat_map(times).collect();
    Ok(Knots::clamped(degree, domain.lower, &inner, domain.upper)?)
}

/// The reduction onto known knots.
pub(super) fn onto<const D: usize>(
    curve: &NurbsCurve<D>,
    knots: Knots,
    reduction: &Reduction,
) -> Result<Reduced<D>, ReductionError> {
    let (problem, guess) = Problem::new(curve, knots, &reduction.weights, reduction.ends)?;
    let fitted = fitted(&problem, guess);
    let first = judged(curve, &problem, &fitted, 0.0)?;
    if reduction.criterion == Criterion::MeanSquare || first.deviation.attained <= EXACT * problem.size {
        return Ok(first);
    }
    let (points, optimum) = least_largest(&problem, fitted);
    let second = judged(curve, &problem, &points, optimum * problem.size)?;
    // They differ by roundings only where the curve is nearly reducible.
    let better = second.deviation.at_most <= first.deviation.at_most;
    Ok(if better { second } else { Reduced { optimum: second.optimum, ..first } })
}

/// The least squares with free weights; with those of the guess where the free ones leave their bounds.
fn fitted<const D: usize>(problem: &Problem<D>, guess: Vec<Homogeneous<D>>) -> Vec<Homogeneous<D>> {
    for free in [true, false] {
        if free <= problem.weights_free {
            let fitted = mean_square(problem, guess.clone(), free);
            if problem.inside(&fitted) {
                return fitted;
            }
        }
    }
    guess
}

fn judged<const D: usize>(
    curve: &NurbsCurve<D>,
    problem: &Problem<D>,
    points: &[Homogeneous<D>],
    optimum: f64,
) -> Result<Reduced<D>, ReductionError> {
    let reduced = problem.restored(points, curve)?;
    let deviation = Difference::new(curve, &reduced)?.largest();
    Ok(Reduced { curve: reduced, deviation, optimum })
}
