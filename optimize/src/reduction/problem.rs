//! A reduction as numbers: the curve about the origin and of size one, the unknowns of the reduced one.

use profiles::nurbs::{Homogeneous, Knots, MAX_DEGREE, NurbsCurve, Side};

use super::error::ReductionError;
use super::options::{Ends, Weights};

/// How far free weights may go beyond the curve's.
const WEIGHT_RATIO: f64 = 10.0;

/// What is known of one parameter.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sample<const D: usize> {
    pub(super) u: f64,
    /// The curve there, and the weight of its homogeneous point.
    pub(super) point: [f64; D],
    pub(super) weight: f64,
    /// The control points of the reduced curve that act there.
    pub(super) first: usize,
    basis: [f64; MAX_DEGREE + 1],
    count: usize,
}

impl<const D: usize> Sample<D> {
    pub(super) fn basis(&self) -> &[f64] {
        &self.basis[..self.count]
    }

    /// The reduced curve there, in homogeneous coordinates.
    #[inline]
    pub(super) fn homogeneous(&self, points: &[Homogeneous<D>]) -> Homogeneous<D> {
        let mut sum = Homogeneous { weighted: [0.0; D], weight: 0.0 };
        for (basis, point) in self.basis().iter().zip(points.iter().skip(self.first)) {
            for (sum, x) in sum.weighted.iter_mut().zip(&point.weighted) {
                *sum += basis * x;
            }
            sum.weight += basis * point.weight;
        }
        sum
    }

    /// `C W - N`, the deviation times the weight, and the weight of the reduced curve.
    #[inline]
    pub(super) fn residual(&self, points: &[Homogeneous<D>]) -> ([f64; D], f64) {
        let Homogeneous { weighted, weight } = self.homogeneous(points);
        let mut residual = self.point;
        residual.iter_mut().zip(&weighted).for_each(|(c, n)| *c = *c * weight - n);
        (residual, weight)
    }

    /// The distance of both curves.
    #[inline]
    pub(super) fn distance(&self, points: &[Homogeneous<D>]) -> f64 {
        let (residual, weight) = self.residual(points);
        norm(&residual) / weight
    }
}

/// A control point near an end that is not free: `X = a along + w through`, with what is missing fixed.
#[derive(Debug, Clone, Copy)]
pub(super) struct Tied<const D: usize> {
    pub(super) index: usize,
    /// A direction of length one, with `a > 0`.
    pub(super) along: Option<[f64; D]>,
    /// The point, if the weight is free.
    pub(super) through: Option<[f64; D]>,
    /// The end point that `a along` starts from.
    pub(super) from: [f64; D],
}

impl<const D: usize> Tied<D> {
    /// `a` of a control point, where it has one.
    pub(super) fn reach(&self, points: &[Homogeneous<D>]) -> Option<f64> {
        let (along, point) = (self.along?, points.get(self.index)?);
        let from = self.from.iter().zip(&point.weighted).map(|(p, x)| x - p * point.weight);
        Some(from.zip(&along).map(|(x, d)| x * d).sum())
    }
}

pub(super) struct Problem<const D: usize> {
    /// About the origin, of size one, with a first weight of one.
    pub(super) curve: NurbsCurve<D>,
    pub(super) knots: Knots,
    pub(super) tied: Vec<Tied<D>>,
    /// Whether weights are free, between which bounds, and what the last is beside the first if that is kept.
    pub(super) weights_free: bool,
    pub(super) weight_range: (f64, f64),
    pub(super) last_weight: Option<f64>,
    pub(super) size: f64,
    centre: [f64; D],
    weight: f64,
}

impl<const D: usize> Problem<D> {
    /// The problem and a first guess that keeps its ends.
    pub(super) fn new(
        curve: &NurbsCurve<D>,
        knots: Knots,
        weights: &Weights,
        ends: Ends,
    ) -> Result<(Self, Vec<Homogeneous<D>>), ReductionError> {
        let (centre, size) = frame(curve);
        let weight = curve.weights().next().unwrap_or(1.0);
        let into = |h: &Homogeneous<D>| {
            let mut weighted = h.weighted;
            weighted.iter_mut().zip(&centre).for_each(|(x, c)| *x = (*x - c * h.weight) / (size * weight));
            Homogeneous { weighted, weight: h.weight / weight }
        };
        let points = curve.homogeneous_points().iter().map(into).collect();
        let normal = NurbsCurve::from_homogeneous(curve.knots().clone(), points)?;
        let bounds =
            normal.weights().fold((1.0_f64, 1.0_f64), |(least, most), w| (least.min(w), most.max(w)));
        let mut problem = Self {
            weights_free: matches!(weights, Weights::Free | Weights::Inner),
            weight_range: (bounds.0 / WEIGHT_RATIO, bounds.1 * WEIGHT_RATIO),
            last_weight: matches!(weights, Weights::Inner).then(|| normal.weights().last().unwrap_or(1.0)),
            tied: Vec::new(),
            curve: normal,
            knots,
            size,
            centre,
            weight,
        };
        let guess = problem.guess(weights)?;
        problem.tie(&guess, ends)?;
        let guess = problem.with_ends(guess);
        Ok((problem, guess))
    }

    /// The points of the curve where each control point acts most, with its weights or those given.
    fn guess(&self, weights: &Weights) -> Result<Vec<Homogeneous<D>>, ReductionError> {
        let points = self.knots.points();
        let own = self.knots.greville().map(|u| self.curve.homogeneous(u, Side::After));
        let given = match weights {
            Weights::Free | Weights::Inner => return Ok(own.collect()),
            Weights::Ones => vec![1.0; points],
            Weights::Given(given) => given.clone(),
        };
        // What the curve would refuse in the end is refused here.
        NurbsCurve::with_knots(self.knots.clone(), &vec![[0.0; D]; points], &given)?;
        let first = given.first().copied().unwrap_or(1.0);
        Ok(own.zip(&given).map(|(h, w)| Homogeneous::new(h.point(), w / first)).collect())
    }

    /// Ties the control points at both ends.
    fn tie(&mut self, guess: &[Homogeneous<D>], ends: Ends) -> Result<(), ReductionError> {
        let last = guess.len() - 1;
        let (start, end) = (self.curve.start(), self.curve.end());
        for (index, from) in [(0, start), (last, end)] {
            let through = self.weights_free.then_some(from);
            self.tied.push(Tied { index, along: None, through, from });
        }
        if ends == Ends::Tangents {
            if last < 3 {
                return Err(ReductionError::TooFewForTangents(guess.len()));
            }
            let domain = self.curve.domain();
            // A curve leaves its end towards the next control point.
            let (after, before) = match self.curve.homogeneous_points() {
                [_, after, .., before, _] => (after.point(), before.point()),
                // Of a parabola, its only inner point.
                [_, inner, _] => (inner.point(), inner.point()),
                _ => (end, start),
            };
            for (index, u, from, to) in
                [(1, domain.lower, start, after), (last - 1, domain.upper, end, before)]
            {
                let along = direction(from, to).ok_or(ReductionError::NoTangent(u))?;
                let through = self.weights_free.then_some(from);
                self.tied.push(Tied { index, along: Some(along), through, from });
            }
        }
        Ok(())
    }

    /// Moves the tied control points to where they are tied.
    fn with_ends(&self, mut points: Vec<Homogeneous<D>>) -> Vec<Homogeneous<D>> {
        for tied in &self.tied {
            let reach = tied.reach(&points).map(|reach| reach.max(1e-3));
            let Some(point) = points.get_mut(tied.index) else { continue };
            let along = tied.along.unwrap_or([0.0; D]).map(|d| d * reach.unwrap_or(0.0));
            for ((x, p), a) in point.weighted.iter_mut().zip(&tied.from).zip(&along) {
                *x = p * point.weight + a;
            }
        }
        points
    }

    pub(super) fn sample(&self, u: f64) -> Sample<D> {
        let own = self.curve.homogeneous(u, Side::After);
        let basis = self.knots.basis(u, Side::After);
        let mut values = [0.0; MAX_DEGREE + 1];
        values.iter_mut().zip(basis.values()).for_each(|(to, from)| *to = *from);
        Sample {
            u,
            point: own.point(),
            weight: own.weight,
            first: basis.first(),
            basis: values,
            count: basis.values().len(),
        }
    }

    /// The intervals between neighbouring knots of either curve.
    pub(super) fn spans(&self) -> Vec<(f64, f64)> {
        let own = self.curve.knots();
        let more = self.knots.distinct().map(|(knot, _)| knot).filter(|knot| own.multiplicity(*knot) == 0);
        let mut all: Vec<f64> = own.distinct().map(|(knot, _)| knot).chain(more).collect();
        all.sort_unstable_by(f64::total_cmp);
        all.iter().zip(all.iter().skip(1)).map(|(from, to)| (*from, *to)).collect()
    }

    /// Whether weights and reaches lie inside their bounds.
    pub(super) fn inside(&self, points: &[Homogeneous<D>]) -> bool {
        let (least, most) = self.weight_range;
        let weights = points.iter().all(|h| h.weight > least && h.weight < most);
        (weights || !self.weights_free)
            && self.tied.iter().all(|tied| tied.reach(points).is_none_or(|reach| reach > 0.0))
    }

    /// The control points with the sum that weights are kept to: a common factor means nothing.
    pub(super) fn scaled(&self, mut points: Vec<Homogeneous<D>>) -> Vec<Homogeneous<D>> {
        let own: f64 = self.knots.greville().map(|u| self.curve.homogeneous(u, Side::After).weight).sum();
        let factor = own / points.iter().map(|h| h.weight).sum::<f64>();
        if self.weights_free && factor.is_finite() && factor > 0.0 {
            for h in &mut points {
                *h = Homogeneous { weighted: h.weighted.map(|x| x * factor), weight: h.weight * factor };
            }
        }
        points
    }

    /// The reduced curve where the curve is; its ends to the bit, the last one to a rounding where its weight changes.
    pub(super) fn restored(
        &self,
        points: &[Homogeneous<D>],
        curve: &NurbsCurve<D>,
    ) -> Result<NurbsCurve<D>, ReductionError> {
        let factor = self.weight / points.first().map_or(1.0, |h| h.weight);
        let back = |h: &Homogeneous<D>| {
            let mut weighted = h.weighted;
            weighted.iter_mut().zip(&self.centre).for_each(|(x, c)| {
                *x = (*x * self.size + c * h.weight) * factor;
            });
            Homogeneous { weighted, weight: h.weight * factor }
        };
        let mut points: Vec<Homogeneous<D>> = points.iter().map(back).collect();
        let ends = curve.homogeneous_points();
        if let (Some(to), Some(from)) = (points.first_mut(), ends.first()) {
            *to = *from;
        }
        if let (Some(to), Some(from)) = (points.last_mut(), ends.last()) {
            let ratio = to.weight / from.weight;
            // A weight that is kept leaves the point as it is.
            *to = if (ratio - 1.0).abs() < 4.0 * f64::EPSILON {
                *from
            } else {
                Homogeneous::new(from.point(), to.weight)
            };
        }
        Ok(NurbsCurve::from_homogeneous(self.knots.clone(), points)?)
    }
}

/// Centre of the box of the control points, and its diagonal; one for a single point.
pub(super) fn frame<const D: usize>(curve: &NurbsCurve<D>) -> ([f64; D], f64) {
    let start = curve.start();
    let (mut lower, mut upper) = (start, start);
    for point in curve.control_points() {
        lower.iter_mut().zip(&point).for_each(|(low, x)| *low = low.min(*x));
        upper.iter_mut().zip(&point).for_each(|(up, x)| *up = up.max(*x));
    }
    let (mut centre, mut sides) = (lower, upper);
    centre.iter_mut().zip(&upper).for_each(|(c, up)| *c = 0.5 * (*c + up));
    sides.iter_mut().zip(&lower).for_each(|(side, low)| *side -= low);
    let size = norm(&sides);
    (centre, if size > 0.0 { size } else { 1.0 })
}

pub(super) fn norm<const D: usize>(vector: &[f64; D]) -> f64 {
    vector.iter().map(|x| x * x).sum::<f64>().sqrt()
}

pub(super) fn dot<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// The direction from one point to another, for points of a curve of size one.
fn direction<const D: usize>(from: [f64; D], to: [f64; D]) -> Option<[f64; D]> {
    let mut along = to;
    along.iter_mut().zip(&from).for_each(|(x, y)| *x -= y);
    let length = norm(&along);
    // Points that differ by roundings have no direction.
    (length > 1e-12).then(|| along.map(|x| x / length))
}
