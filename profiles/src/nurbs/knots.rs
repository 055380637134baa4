//! Knot vectors: checked once, searched often.

use alloc::vec::Vec;

use super::{MAX_DEGREE, NurbsError};
use crate::quantities::{Interval, Real};

/// Largest magnitude of a knot, and of one over the length of a parameter interval.
const MOST: f64 = 1e30;

/// Distinct knots are this many roundings apart: fewer, and hardly a parameter lies between them.
const ROUNDINGS: f64 = 16.0;

/// From which side a curve is looked at where its derivatives jump.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Side {
    /// From smaller parameters.
    Before,
    /// From larger parameters.
    #[default]
    After,
}

/// A clamped knot vector and the degree that goes with it.
///
/// The first and the last knot are there `degree + 1` times, so that a curve begins in its first and ends in its last
/// control point; an inner knot is there at most `degree` times, which leaves a corner but no gap.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(try_from = "super::unchecked::UncheckedKnots", into = "super::unchecked::UncheckedKnots")
)]
pub struct Knots {
    degree: usize,
    all: Vec<f64>,
    // The ends, which every evaluation needs.
    lower: f64,
    upper: f64,
    // Equal parts of the domain, four for every span; how many inner knots lie before each part.
    parts_per_unit: f64,
    before_part: Vec<u32>,
}

impl Knots {
    /// The knots as they are, for curves of this degree.
    ///
    /// # Errors
    /// A degree outside `[1, 15]`, fewer than `2 (degree + 1)` knots, a knot that is not finite or smaller than the
    /// one before, ends without their multiplicity, inner knots with more than the degree, distinct knots closer
    /// than 16 roundings, or an interval that is shorter than 1e-30 or longer than 1e30.
    pub fn new(degree: usize, knots: Vec<f64>) -> Result<Self, NurbsError> {
        check_degree(degree)?;
        let needed = 2 * (degree + 1);
        if knots.len() < needed {
            return Err(NurbsError::KnotCount { knots: knots.len(), needed });
        }
        let mut before = f64::NEG_INFINITY;
        for (index, knot) in knots.iter().copied().enumerate() {
            if !(knot >= before && knot.abs() <= MOST) {
                return Err(NurbsError::Knot { index, value: knot });
            }
            before = knot;
        }
        let knots = Self::unchecked(degree, knots);
        check_interval(knots.lower, knots.upper)?;
        let mut index = 0;
        for (knot, multiplicity) in knots.distinct() {
            if index > 0 {
                let before = knots.all.get(index - 1).copied().unwrap_or(knots.lower);
                let (gap, least) = (knot - before, knots.rounding());
                if gap < least {
                    return Err(NurbsError::KnotGap { index, gap, least });
                }
            }
            let end = match (index == 0, index + multiplicity == knots.all.len()) {
                (true, _) => Some("first"),
                (_, true) => Some("last"),
                _ => None,
            };
            match end {
                Some(end) if multiplicity != degree + 1 => {
                    return Err(NurbsError::Unclamped { end, multiplicity, needed: degree + 1 });
                }
                None if multiplicity > degree => {
                    return Err(NurbsError::Multiplicity { knot, multiplicity, most: degree });
                }
                _ => {}
            }
            index += multiplicity;
        }
        Ok(knots)
    }

    /// Knots of a single polynomial piece over `[lower, upper]`.
    ///
    /// # Errors
    /// As for [`new`](Self::new).
    pub fn bezier(degree: usize, lower: f64, upper: f64) -> Result<Self, NurbsError> {
        Self::clamped(degree, lower, &[], upper)
    }

    /// Evenly spaced knots over `[0, 1]` for so many control points.
    ///
    /// # Errors
    /// A degree outside `[1, 15]`, or fewer than `degree + 1` control points.
    pub fn uniform(degree: usize, points: usize) -> Result<Self, NurbsError> {
        check_degree(degree)?;
        let spans = points.checked_sub(degree).filter(|spans| *spans > 0);
        let spans = spans.ok_or(NurbsError::PointCount { points, least: degree + 1 })?;
        let inner: Vec<f64> = (1..spans).map(|k| k as f64 / spans as f64).collect();
        Self::clamped(degree, 0.0, &inner, 1.0)
    }

    /// `lower` and `upper` as often as they must be there, and `inner` between them.
    ///
    /// # Errors
    /// As for [`new`](Self::new).
    pub fn clamped(degree: usize, lower: f64, inner: &[f64], upper: f64) -> Result<Self, NurbsError> {
        check_degree(degree)?;
        let end = |knot| core::iter::repeat_n(knot, degree + 1);
        Self::new(degree, end(lower).chain(inner.iter().copied()).chain(end(upper)).collect())
    }

    /// The degree.
    #[must_use]
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// All knots, repeated ones as often as they are there.
    #[must_use]
    pub fn as_slice(&self) -> &[f64] {
        &self.all
    }

    /// The knots between the ends, repeated ones as often as they are there.
    #[must_use]
    pub fn inner(&self) -> &[f64] {
        self.all.get(self.degree + 1..self.points()).unwrap_or_default()
    }

    /// How many control points go with these knots.
    #[must_use]
    pub fn points(&self) -> usize {
        self.all.len() - self.degree - 1
    }

    /// From the first to the last knot.
    #[must_use]
    pub fn domain(&self) -> Interval {
        Interval::new(self.lower, self.upper)
    }

    /// The distinct knots in ascending order, each with its multiplicity.
    pub fn distinct(&self) -> impl Iterator<Item = (f64, usize)> + '_ {
        #[expect(clippy::float_cmp, reason = "a repeated knot has the same bits")]
        self.all.chunk_by(|a, b| a == b).filter_map(|run| run.first().map(|knot| (*knot, run.len())))
    }

    /// How often `knot` is there; a parameter within 16 roundings of a knot is that knot.
    #[must_use]
    pub fn multiplicity(&self, knot: f64) -> usize {
        self.all.iter().filter(|k| (**k - knot).abs() < self.rounding()).count()
    }

    /// The parameter of each control point by the mean of `degree` knots (Greville), which is where it acts most.
    pub fn greville(&self) -> impl Iterator<Item = f64> + '_ {
        let mean = move |run: &[f64]| run.iter().sum::<f64>() / self.degree as f64;
        let run = self.all.get(1..self.all.len() - 1).unwrap_or_default();
        run.windows(self.degree).map(move |run| mean(run).clamped(self.lower, self.upper))
    }

    /// The knot at `u` where there is one within rounding, else `u`.
    pub(super) fn snapped(&self, u: f64) -> f64 {
        let near = |k: &&f64| (**k - u).abs() < self.rounding();
        self.all.iter().find(near).copied().unwrap_or(u)
    }

    /// Parameters closer than this are one.
    pub(super) fn rounding(&self) -> f64 {
        ROUNDINGS * f64::EPSILON * self.lower.abs().max(self.upper.abs())
    }

    /// `u` brought into the domain; the start for NaN.
    #[inline]
    pub(super) fn within(&self, u: f64) -> f64 {
        // As two instructions where a clamp that knows NaN is twenty.
        let above = if u > self.lower { u } else { self.lower };
        if above < self.upper { above } else { self.upper }
    }

    /// The first of the `degree + 1` control points that act at `u`, a parameter of the domain.
    #[inline]
    pub(super) fn first_acting(&self, u: f64, side: Side) -> usize {
        // Knots of earlier parts are smaller than u and those of later parts larger: few are left to search.
        let part = part_of(u, self.lower, self.parts_per_unit);
        let (from, to) = match self.before_part.get(part..) {
            Some([from, to, ..]) => (*from as usize, *to as usize),
            _ => (0, self.inner().len()),
        };
        let offset = self.degree + 1;
        let some = self.all.get(offset + from..offset + to).unwrap_or_default();
        // Never inside the empty span of a repeated knot, at both ends of the domain neither.
        from + match side {
            Side::Before => some.partition_point(|knot| *knot < u),
            Side::After => some.partition_point(|knot| *knot <= u),
        }
    }

    /// The `2 degree` knots that matter in the span whose first acting control point is `first`.
    #[inline]
    pub(super) fn local(&self, first: usize) -> &[f64] {
        self.all.get(first + 1..first + 1 + 2 * self.degree).unwrap_or_default()
    }

    /// Knots that an exact operation made of checked ones.
    pub(super) fn unchecked(degree: usize, all: Vec<f64>) -> Self {
        let (lower, upper) = (all.first().copied().unwrap_or(0.0), all.last().copied().unwrap_or(0.0));
        let inner = all.get(degree + 1..all.len().saturating_sub(degree + 1)).unwrap_or_default();
        let parts = 4 * (inner.len() + 1);
        let parts_per_unit = parts as f64 / (upper - lower);
        let before = |part| inner.partition_point(|knot| part_of(*knot, lower, parts_per_unit) < part) as u32;
        let before_part = (0..=parts + 1).map(before).collect();
        Self { degree, all, lower, upper, parts_per_unit, before_part }
    }

    /// Every distinct knot once more than it is there.
    pub(super) fn with_each_once_more(&self) -> Vec<f64> {
        self.distinct()
            .flat_map(|(knot, multiplicity)| core::iter::repeat_n(knot, multiplicity + 1))
            .collect()
    }

    pub(super) fn into_vec(self) -> Vec<f64> {
        self.all
    }
}

/// The part of the domain that `u` lies in; the end is a part of its own.
#[inline]
fn part_of(u: f64, lower: f64, parts_per_unit: f64) -> usize {
    ((u - lower) * parts_per_unit) as u32 as usize
}

/// Degrees that fit the buffers.
pub(super) fn check_degree(degree: usize) -> Result<(), NurbsError> {
    if (1..=MAX_DEGREE).contains(&degree) {
        Ok(())
    } else {
        Err(NurbsError::Degree { degree, most: MAX_DEGREE })
    }
}

/// Intervals in which powers of the length stay in range, and in which parameters can be told apart.
pub(super) fn check_interval(lower: f64, upper: f64) -> Result<(), NurbsError> {
    let length = upper - lower;
    let coarse = ROUNDINGS * f64::EPSILON * lower.abs().max(upper.abs());
    if length >= (1.0 / MOST).max(coarse) && length <= MOST {
        Ok(())
    } else {
        Err(NurbsError::Domain { lower, upper })
    }
}
