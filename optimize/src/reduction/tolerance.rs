//! Knots for a tolerance.

use profiles::nurbs::{Knots, NurbsCurve};

use super::deviation::Difference;
use super::error::ReductionError;
use super::options::{Criterion, Reduction};
use super::reduce::{Reduced, kept, onto};

/// Control points beyond which a tolerance counts as out of reach.
const MOST_POINTS: usize = 4096;

/// The optimum is looked for up to so many control points; beyond, least squares are good enough.
const MOST_FOR_OPTIMUM: usize = 64;

/// Least squares deviate by about this many times the optimum where it is worth a try.
const NEAR: f64 = 8.0;

/// As few spans as meet the tolerance, the knots where the deviation of all spans is about the same.
pub(super) fn within<const D: usize>(
    curve: &NurbsCurve<D>,
    tolerance: f64,
    degree: usize,
    reduction: &Reduction,
) -> Result<Reduced<D>, ReductionError> {
    let knots = kept(curve, degree)?;
    let mut spacing = Spacing::new(curve, knots, tolerance, reduction);
    // The most spans that are known not to do.
    let mut fewest = 0;
    let mut spans = spacing.segments.len();
    let mut best = loop {
        let tried = spacing.attempt(spans)?;
        if tried.found.deviation.at_most <= tolerance {
            break (spans, tried.found);
        }
        let points = tried.found.curve.homogeneous_points().len();
        if points >= MOST_POINTS || tried.stuck {
            let deviation = tried.found.deviation.at_most;
            return Err(ReductionError::NotReached { points, deviation, tolerance });
        }
        fewest = spans;
        spans = spacing.needed(spans, tried.found.deviation.at_most);
    };
    // What was needed was an estimate: fewer may do.
    while best.0 > fewest + 1 {
        let middle = usize::midpoint(fewest, best.0);
        let tried = spacing.attempt(middle)?;
        if tried.found.deviation.at_most <= tolerance {
            best = (middle, tried.found);
        } else {
            fewest = middle;
        }
    }
    Ok(best.1)
}

struct Attempt<const D: usize> {
    found: Reduced<D>,
    /// No knots lie any closer.
    stuck: bool,
}

/// Where the knots of so many spans belong.
struct Spacing<'a, const D: usize> {
    curve: &'a NurbsCurve<D>,
    /// Those of the curve, which stay.
    kept: Knots,
    tolerance: f64,
    reduction: &'a Reduction,
    quick: Reduction,
    /// Between neighbouring knots of the curve.
    segments: Vec<(f64, f64)>,
    /// Spans with the share of the spans that each should be divided into, from the last fit.
    shares: Vec<((f64, f64), f64)>,
}

impl<'a, const D: usize> Spacing<'a, D> {
    fn new(curve: &'a NurbsCurve<D>, kept: Knots, tolerance: f64, reduction: &'a Reduction) -> Self {
        let distinct: Vec<f64> = kept.distinct().map(|(knot, _)| knot).collect();
        let segments: Vec<_> =
            distinct.iter().zip(distinct.iter().skip(1)).map(|(from, to)| (*from, *to)).collect();
        let quick = Reduction { criterion: Criterion::MeanSquare, ..reduction.clone() };
        let shares = segments.iter().map(|span| (*span, span.1 - span.0)).collect();
        Self { curve, kept, tolerance, reduction, quick, segments, shares }
    }

    /// Fits so many spans, their knots moved twice to where they belong.
    fn attempt(&mut self, spans: usize) -> Result<Attempt<D>, ReductionError> {
        let mut best: Option<(Knots, Reduced<D>)> = None;
        for _ in 0..3 {
            let Ok(knots) = self.placed(spans) else { break };
            let found = onto(self.curve, knots.clone(), &self.quick)?;
            self.learn(&found.curve)?;
            if best.as_ref().is_none_or(|(_, best)| found.deviation.at_most < best.deviation.at_most) {
                best = Some((knots, found));
            }
            if spans == self.segments.len() {
                // Nothing to move.
                break;
            }
        }
        let Some((knots, found)) = best else {
            let found = onto(self.curve, self.kept.clone(), &self.quick)?;
            return Ok(Attempt { found, stuck: true });
        };
        let deviation = found.deviation.at_most;
        let worth = self.reduction.criterion == Criterion::Largest
            && deviation > self.tolerance
            && deviation <= NEAR * self.tolerance
            && knots.points() <= MOST_FOR_OPTIMUM;
        let found = if worth { onto(self.curve, knots, self.reduction)? } else { found };
        Ok(Attempt { found, stuck: false })
    }

    /// Shares by the deviation of a fit: one of a span falls as the length to the power of degree plus one.
    fn learn(&mut self, fit: &NurbsCurve<D>) -> Result<(), ReductionError> {
        let pieces = Difference::new(self.curve, fit)?.deviations();
        let order = self.kept.degree() as f64 + 1.0;
        let share = |deviation: f64| profiles::Real::powf(deviation / self.tolerance, 1.0 / order);
        let most = pieces.iter().map(|(_, deviation)| share(*deviation)).fold(0.0, f64::max);
        // A span that is exact by chance is not left without any.
        let shares = pieces.iter().map(|(span, deviation)| (*span, share(*deviation).max(1e-3 * most)));
        self.shares = shares.collect();
        Ok(())
    }

    /// More spans than did not do, as many as the deviation with them lets expect.
    fn needed(&self, spans: usize, deviation: f64) -> usize {
        let order = self.kept.degree() as f64 + 1.0;
        let factor = profiles::Real::powf(deviation / self.tolerance, 1.0 / order);
        let expected = (spans as f64 * factor).ceil();
        (expected as usize).clamp(spans + 1, 4 * spans)
    }

    /// The knots of the curve, and between them as many more, at equal sums of the shares.
    fn placed(&self, spans: usize) -> Result<Knots, ReductionError> {
        let sums: Vec<f64> = self.segments.iter().map(|segment| self.within(*segment, segment.1)).collect();
        let mut counts = vec![1_usize; sums.len()];
        for _ in sums.len()..spans {
            // One more where it is most needed.
            let need = |index: &usize| sums[*index] / counts[*index] as f64;
            let next = (0..sums.len()).max_by(|a, b| need(a).total_cmp(&need(b)));
            next.into_iter().for_each(|index| counts[index] += 1);
        }
        let mut inner = self.kept.inner().to_vec();
        for ((segment, sum), count) in self.segments.iter().zip(&sums).zip(&counts) {
            inner.extend((1..*count).map(|k| self.place(*segment, sum * k as f64 / *count as f64)));
        }
        inner.sort_unstable_by(f64::total_cmp);
        let domain = self.kept.domain();
        Ok(Knots::clamped(self.kept.degree(), domain.lower, &inner, domain.upper)?)
    }

    /// The part of the shares between the start of a segment and `u`.
    fn within(&self, segment: (f64, f64), u: f64) -> f64 {
        let part = |((from, to), share): &((f64, f64), f64)| {
            let overlap = to.min(u) - from.max(segment.0);
            share * (overlap / (to - from)).max(0.0)
        };
        self.shares.iter().map(part).sum()
    }

    /// Where the shares from the start of a segment on have a sum.
    fn place(&self, segment: (f64, f64), sum: f64) -> f64 {
        let mut left = sum;
        let inside = |((from, to), _): &&((f64, f64), f64)| *to > segment.0 && *from < segment.1;
        for ((from, to), share) in self.shares.iter().filter(inside) {
            let (start, end) = (from.max(segment.0), to.min(segment.1));
            let here = share * (end - start) / (to - from);
            if left <= here {
                return start + (end - start) * left / here;
            }
            left -= here;
        }
        segment.1
    }
}
