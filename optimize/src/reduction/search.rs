//! Degree reduction as a problem for any solver.

use argmin::core::{CostFunction, Error};
use profiles::Interval;
use profiles::nurbs::{Knots, NurbsCurve};

use super::deviation::check_domain;
use super::error::ReductionError;
use super::sampled::{FixedKnots, FreeKnots};
use crate::cost::Cost;

/// Two free knots are at least this part of the domain apart.
const KNOT_GAP: f64 = 1e-4;

/// How far the box of the points reaches beyond the control points of the curve, in the diagonal of theirs.
const MARGIN: f64 = 0.5;

/// How far weights may go beyond the curve's.
const WEIGHT_RATIO: f64 = 5.0;

/// What of the reduced curve a search is free to choose. The end points are kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Freed {
    /// The control points.
    Points,
    /// The control points and all weights but the first: a common factor means nothing.
    PointsAndWeights,
    /// The control points, all weights but the first, and the inner knots.
    All,
}

/// The search for a curve of a lower degree that runs close to a given one, for any solver: the unknowns are the inner
/// control points, coordinate by coordinate, then the weights, then the inner knots in any order; the cost is the largest
/// distance at evenly spaced parameters, in the unit of the curve.
///
/// With fixed knots the basis functions at the samples are computed once.
///
/// ```
/// use argmin::core::{Executor, State};
/// use optimize::reduction::{Criterion, Freed, Reduction, ReductionSearch};
/// use optimize::{GeneticOptions, GeneticSwarm, reduce_degree};
/// use profiles::nurbs::NurbsCurve;
///
/// let points = [[-5.0, 0.0], [-7.0, 2.0], [-3.0, 5.0], [2.0, 6.0], [5.0, 3.0], [3.0, 0.0]];
/// let quintic = NurbsCurve::bezier(&points)?;
/// let start = reduce_degree(&quintic, &Reduction { criterion: Criterion::MeanSquare, ..Reduction::to(3) })?;
///
/// let search = ReductionSearch::new(&quintic, &start.curve, Freed::PointsAndWeights, 101)?;
/// let solver = GeneticSwarm::new(search.bounds(), GeneticOptions::new(100, 100), 1)?;
/// let result = Executor::new(search.clone(), solver).run()?;
/// let found = search.curve(result.solver.search().best().0)?;
/// assert_eq!(found.degree(), 3);
/// # Ok::<(), argmin::core::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct ReductionSearch<const D: usize> {
    freed: Freed,
    knots: Knots,
    /// First and last point.
    ends: [[f64; D]; 2],
    /// Of the start.
    weights: Vec<f64>,
    bounds: Vec<Interval>,
    /// The start, as unknowns.
    guess: Vec<f64>,
    fixed: FixedKnots<D>,
    free: FreeKnots<D>,
}

impl<const D: usize> ReductionSearch<D> {
    /// A search from `curve` to the degree of `start`, which gives what is not freed: its knots, its weights.
    ///
    /// The box holds the control points of the curve and half of their diagonal on each side, weights from a fifth of
    /// the smallest to five times the largest of the curve over the first, and the whole domain for knots.
    ///
    /// # Errors
    /// A degree that is not below the curve's, a start over another interval, fewer than 2 or more than 1 000 000 samples,
    /// nothing to search.
    pub fn new(
        curve: &NurbsCurve<D>,
        start: &NurbsCurve<D>,
        freed: Freed,
        samples: usize,
    ) -> Result<Self, ReductionError> {
        check_domain(curve, start.domain())?;
        if start.degree() >= curve.degree() {
            return Err(ReductionError::Degree { degree: start.degree(), curve: curve.degree() });
        }
        if !(2..=1_000_000).contains(&samples) {
            return Err(ReductionError::Samples(samples));
        }
        let first = start.weights().next().unwrap_or(1.0);
        let mut search = Self {
            freed,
            knots: start.knots().clone(),
            ends: [curve.start(), curve.end()],
            weights: start.weights().map(|w| w / first).collect(),
            bounds: Vec::new(),
            guess: Vec::new(),
            fixed: FixedKnots::new(curve, start.knots(), samples),
            free: FreeKnots::new(curve, samples),
        };
        let inner = search.weights.len().saturating_sub(2);
        search.guess = start.control_points().skip(1).take(inner).flatten().collect();
        search.bounds = (0..inner).flat_map(|_| search.box_of(curve)).collect();
        if freed != Freed::Points {
            search.guess.extend(search.weights.iter().skip(1));
            let first = curve.weights().next().unwrap_or(1.0);
            let range = |(low, high): (f64, f64), w: f64| (low.min(w / first), high.max(w / first));
            let (low, high) = curve.weights().fold((1.0, 1.0), range);
            let weights = Interval::new(low / WEIGHT_RATIO, high * WEIGHT_RATIO);
            search.bounds.resize(search.guess.len(), weights);
        }
        if freed == Freed::All {
            search.guess.extend_from_slice(start.knots().inner());
            search.bounds.resize(search.guess.len(), start.domain());
        }
        if search.guess.is_empty() {
            return Err(ReductionError::NoUnknowns);
        }
        Ok(search)
    }

    fn box_of(&self, curve: &NurbsCurve<D>) -> [Interval; D] {
        let mut sides = curve.start().map(|x| Interval::new(x, x));
        for point in curve.control_points() {
            for (side, x) in sides.iter_mut().zip(point) {
                *side = Interval::new(side.lower.min(x), side.upper.max(x));
            }
        }
        let widths = sides.iter().map(|side| (side.upper - side.lower).powi(2));
        let margin = MARGIN * widths.sum::<f64>().sqrt();
        let margin = if margin > 0.0 { margin } else { 1.0 };
        sides.map(|side| Interval::new(side.lower - margin, side.upper + margin))
    }

    /// The box to search, one interval per unknown.
    #[must_use]
    pub fn bounds(&self) -> &[Interval] {
        &self.bounds
    }

    /// The start as a candidate, brought into the box.
    #[must_use]
    pub fn guess(&self) -> Vec<f64> {
        self.guess.iter().zip(&self.bounds).map(|(x, b)| x.max(b.lower).min(b.upper)).collect()
    }

    /// What is free.
    #[must_use]
    pub fn freed(&self) -> Freed {
        self.freed
    }

    /// The curve that a candidate stands for.
    ///
    /// # Errors
    /// A candidate of another length; knots or weights that make no curve.
    pub fn curve(&self, candidate: &[f64]) -> Result<NurbsCurve<D>, ReductionError> {
        let (points, weights, inner) = self.parts(candidate)?;
        let mut curve = vec![self.ends[0]];
        curve.extend(points.chunks_exact(D).filter_map(|point| <[f64; D]>::try_from(point).ok()));
        curve.push(self.ends[1]);
        let mut all = self.weights.clone();
        all.iter_mut().skip(1).zip(weights).for_each(|(to, from)| *to = *from);
        let knots = match self.freed {
            Freed::All => {
                let mut inner = inner.to_vec();
                inner.sort_unstable_by(f64::total_cmp);
                let domain = self.knots.domain();
                Knots::clamped(self.knots.degree(), domain.lower, &inner, domain.upper)?
            }
            Freed::Points | Freed::PointsAndWeights => self.knots.clone(),
        };
        Ok(NurbsCurve::with_knots(knots, &curve, &all)?)
    }

    /// The largest distance at the samples, in the unit of the curve; a weight that is not positive and knots that are too
    /// close are infeasible, by as much as they are.
    #[must_use]
    pub fn cost(&self, candidate: &[f64]) -> Cost {
        let Ok((points, weights, inner)) = self.parts(candidate) else { return Cost::Failed };
        if candidate.iter().any(|x| !x.is_finite()) {
            return Cost::Failed;
        }
        let short = weights.iter().fold(0.0_f64, |short, w| short.max(f64::MIN_POSITIVE - w));
        if short > 0.0 {
            return Cost::Infeasible(short);
        }
        // With all control points in a row: weighted coordinates, then the weight.
        let mut row = Vec::with_capacity(self.weights.len() * (D + 1));
        let [start, end] = &self.ends;
        let all = std::iter::once(&start[..]).chain(points.chunks_exact(D)).chain(std::iter::once(&end[..]));
        let free = weights.iter().map(Some).chain(std::iter::repeat(None));
        let weights = self.weights.iter().zip(std::iter::once(None).chain(free));
        for (point, (fixed, free)) in all.zip(weights) {
            let weight = *free.unwrap_or(fixed);
            row.extend(point.iter().map(|x| x * weight));
            row.push(weight);
        }
        if self.freed != Freed::All {
            return self.fixed.largest(&row).into();
        }
        let degree = self.knots.degree();
        let domain = self.knots.domain();
        let mut knots = Vec::with_capacity(inner.len() + 2 * (degree + 1));
        knots.resize(degree + 1, domain.lower);
        knots.extend_from_slice(inner);
        knots[degree + 1..].sort_unstable_by(f64::total_cmp);
        knots.resize(knots.len() + degree + 1, domain.upper);
        let least = KNOT_GAP * (domain.upper - domain.lower);
        let near = knots[degree..knots.len() - degree].windows(2);
        let short = near.map(|pair| least - (pair[1] - pair[0])).fold(0.0, f64::max);
        if short > 0.0 { Cost::Infeasible(short) } else { self.free.largest(degree, &knots, &row).into() }
    }

    /// Points, weights and knots of a candidate.
    fn parts<'a>(&self, candidate: &'a [f64]) -> Result<Parts<'a>, ReductionError> {
        let (given, unknowns) = (candidate.len(), self.guess.len());
        let points = self.weights.len().saturating_sub(2) * D;
        let weights = if self.freed == Freed::Points { 0 } else { self.weights.len() - 1 };
        let parts = candidate.split_at_checked(points).and_then(|(points, rest)| {
            let (weights, knots) = rest.split_at_checked(weights)?;
            Some((points, weights, knots))
        });
        parts.filter(|_| given == unknowns).ok_or(ReductionError::Candidate { given, unknowns })
    }
}

type Parts<'a> = (&'a [f64], &'a [f64], &'a [f64]);

impl<const D: usize> CostFunction for ReductionSearch<D> {
    type Param = Vec<f64>;
    type Output = Cost;

    fn cost(&self, candidate: &Vec<f64>) -> Result<Cost, Error> {
        Ok(Self::cost(self, candidate))
    }
}
