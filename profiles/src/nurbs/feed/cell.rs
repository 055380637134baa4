//! A short piece of a curve and what its derivatives along the arc are at most.

use alloc::vec::Vec;

use super::enclosure::{Enclosure, Scalar};
use super::jet::{Coordinates, ORDERS, along_arc, quotient};
use crate::nurbs::geometry::{distance, dot, norm};
use crate::nurbs::{BezierSegment, Homogeneous};
use crate::quantities::Real;

/// The derivatives of the path along its arc over a piece of it, enclosed axis by axis.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bounds<const D: usize> {
    /// Unit tangent `dr/ds`.
    pub(super) tangent: [Enclosure; D],
    /// `d^2 r/ds^2`, 1/m.
    pub(super) bend: [Enclosure; D],
    /// `d^3 r/ds^3`, 1/m^2.
    pub(super) twist: [Enclosure; D],
    /// Largest curvature, 1/m.
    pub(super) curvature: f64,
}

impl<const D: usize> Bounds<D> {
    /// The bounds over two pieces.
    pub(super) fn joined(&self, other: &Self) -> Self {
        let mut all = *self;
        let rows = [
            (&mut all.tangent, &other.tangent),
            (&mut all.bend, &other.bend),
            (&mut all.twist, &other.twist),
        ];
        for (own, other) in rows.into_iter().flat_map(|(own, other)| own.iter_mut().zip(other)) {
            *own = Enclosure::new(own.lower.min(other.lower), own.upper.max(other.upper));
        }
        all.curvature = all.curvature.max(other.curvature);
        all
    }
}

/// What the derivatives of a path cost: how well they must be known, and how long a cell may be.
#[derive(Debug, Clone, Copy)]
pub(super) struct Resolution<const D: usize> {
    /// Limits of acceleration in m/s^2 and of jerk in m/s^3 of every axis.
    pub(super) acceleration: [f64; D],
    pub(super) jerk: [f64; D],
    /// Largest chord error over an eighth of the period squared, m/s^2.
    pub(super) chord: f64,
    /// Highest feed, m/s.
    pub(super) feed: f64,
    /// Longest cell, m.
    pub(super) longest: f64,
    /// Length below which a piece is a point, m.
    pub(super) shortest: f64,
}

impl<const D: usize> Resolution<D> {
    /// The second derivative in units of the limits: one over the square of the highest feed that they allow.
    fn bend(&self, bend: &[f64; D]) -> f64 {
        largest_part(bend, &self.acceleration).max(norm(bend) / self.chord)
    }

    /// The third derivative in units of the limits: one over the cube of the highest feed.
    fn twist(&self, twist: &[f64; D]) -> f64 {
        largest_part(twist, &self.jerk)
    }

    /// Up to which values second and third derivatives are hardly felt at the highest feed that they allow here.
    fn unfelt(&self, bend: &[f64; D], twist: &[f64; D]) -> (f64, f64) {
        let by_bend = 1.0 / Real::sqrt(self.bend(bend));
        let feed = self.feed.min(by_bend).min(1.0 / Real::cbrt(self.twist(twist)));
        (UNFELT / (feed * feed), UNFELT / (feed * feed * feed))
    }
}

fn largest_part<const D: usize>(values: &[f64; D], limits: &[f64; D]) -> f64 {
    values.iter().zip(limits).map(|(value, limit)| value.abs() / limit).fold(0.0, f64::max)
}

/// A rational polynomial piece in Bezier form, over its own parameter from 0 to 1.
#[derive(Debug, Clone)]
pub(super) struct Piece<const D: usize> {
    pub(super) from: f64,
    pub(super) to: f64,
    /// Counted from one of them: only differences matter, and the smaller the numbers the smaller their roundings.
    points: Vec<Homogeneous<D>>,
    /// How far the bounds of the piece before it was halved were from being good enough, and for how many halvings that
    /// has not become better.
    excess: f64,
    stalled: u32,
}

/// What a look at a piece says.
pub(super) enum Verdict<const D: usize> {
    /// It is short enough to bound it well.
    Bounded(Bounds<D>),
    /// Its halves have to be looked at.
    Coarse,
    /// It is a point at which the curve has no direction.
    Singular,
}

impl<const D: usize> Piece<D> {
    pub(super) fn of(segment: BezierSegment<D>) -> Self {
        let BezierSegment { from, to, points } = segment;
        Self { from, to, points: centred(points), excess: f64::INFINITY, stalled: 0 }
    }

    /// Length of the control polygon, m: the piece is not longer.
    pub(super) fn polygon(&self) -> f64 {
        let ends = self.points.iter().zip(self.points.iter().skip(1));
        ends.map(|(a, b)| distance(&a.point(), &b.point())).sum()
    }

    /// Both halves.
    pub(super) fn halves(self) -> (Self, Self) {
        let middle = 0.5 * (self.from + self.to);
        let (from, to, excess, stalled) = (self.from, self.to, self.excess, self.stalled);
        let mut right = Vec::with_capacity(self.points.len());
        let mut left = Vec::with_capacity(self.points.len());
        let mut points = self.points;
        while let (Some(first), Some(last)) = (points.first(), points.last()) {
            left.push(*first);
            right.push(*last);
            blend_once(&mut points);
        }
        right.reverse();
        let half = |from, to, points| Self { from, to, points: centred(points), excess, stalled };
        (half(from, middle, left), half(middle, to, right))
    }

    /// Bounds by the mean value theorem: a derivative lies as near to its value in the middle as the next one times
    /// half the length of the piece says, and that one is bounded by interval arithmetic with the control points.
    pub(super) fn look(&mut self, resolution: &Resolution<D>) -> Verdict<D> {
        let polygon = self.polygon();
        let is_point = polygon <= resolution.shortest;
        let undecided = if is_point { Verdict::Singular } else { Verdict::Coarse };
        let Some((jets, middle)) = self.jets() else { return undecided };
        let (Some((speed, [tangent, bend, twist, next])), Some((_, middle))) =
            (along_arc(&jets), along_arc(&middle))
        else {
            return undecided;
        };
        // Of the whole piece, and from the middle of its parameter to either end.
        let (length, half) = (speed.upper.min(polygon), (0.5 * speed.upper).min(polygon));
        let [middle_tangent, middle_bend, middle_twist, _] = middle;
        let around = Enclosure::around_zero(half);
        let bounds = Bounds {
            tangent: near(&middle_tangent, &bend, around, &tangent),
            bend: near(&middle_bend, &twist, around, &bend),
            twist: near(&middle_twist, &next, around, &twist),
            curvature: curvature(&middle_bend, &middle_twist, [&bend, &twist, &next], half),
        };
        let (bend_unfelt, twist_unfelt) = resolution.unfelt(&middle_bend, &middle_twist);
        let bend_of = |bend: &[Enclosure; D]| resolution.bend(&bend.map(Enclosure::magnitude));
        let twist_of = |twist: &[Enclosure; D]| resolution.twist(&twist.map(Enclosure::magnitude));
        let excess = [
            speed.upper / (MOST_UNEVEN * speed.lower),
            length * bounds.curvature / MOST_TURN,
            length * bend_of(&twist) / (BEND_WIDTH * bend_of(&bounds.bend).max(bend_unfelt)),
            length * twist_of(&next) / (TWIST_WIDTH * twist_of(&bounds.twist).max(twist_unfelt)),
        ];
        let excess = excess.into_iter().fold(0.0, f64::max);
        self.stalled = if excess > STALL * self.excess { self.stalled + 1 } else { 0 };
        self.excess = excess;
        // Where halving does not help, the bounds are those of roundings: they hold, if loosely.
        let is_fine = length <= resolution.longest && (excess <= 1.0 || self.stalled > MOST_STALLED);
        if (is_fine || is_point) && bounds.curvature.is_finite() {
            Verdict::Bounded(bounds)
        } else {
            undecided
        }
    }

    /// Taylor coefficients of the coordinates by the own parameter: over the piece and in its middle.
    fn jets(&self) -> Option<(Coordinates<Enclosure, D>, Coordinates<f64, D>)> {
        let mut points = self.points.clone();
        let (mut above, mut below) = ([[Enclosure::ZERO; ORDERS]; D], [Enclosure::ZERO; ORDERS]);
        let (mut middle, mut weight) = ([[0.0; ORDERS]; D], [0.0; ORDERS]);
        for order in 0..ORDERS {
            if points.is_empty() {
                break;
            }
            let value = middle_of(points.clone());
            set(&mut below, order, Enclosure::hull(points.iter().map(|h| h.weight)));
            set(&mut weight, order, value.weight);
            for (axis, (above, middle)) in above.iter_mut().zip(&mut middle).enumerate() {
                let coordinate = |h: &Homogeneous<D>| h.weighted.get(axis).copied().unwrap_or(0.0);
                set(above, order, Enclosure::hull(points.iter().map(coordinate)));
                set(middle, order, coordinate(&value));
            }
            // The next Taylor coefficient: differences times what is left of the degree over the order.
            let factor = (points.len() - 1) as f64 / (order + 1) as f64;
            let differences = points.iter().zip(points.iter().skip(1));
            points = differences.map(|(a, b)| a.difference(b, factor)).collect();
        }
        let mut over = [[Enclosure::ZERO; ORDERS]; D];
        for (to, jet) in over.iter_mut().zip(&above) {
            *to = quotient(jet, &below)?;
        }
        let mut at = [[0.0; ORDERS]; D];
        for (to, jet) in at.iter_mut().zip(&middle) {
            *to = quotient(jet, &weight)?;
        }
        Some((over, at))
    }
}

/// Longest over shortest speed by the parameter in a cell: so much for quadrature.
const MOST_UNEVEN: f64 = 2.5;

/// Largest angle by which a cell turns, rad.
const MOST_TURN: f64 = 0.25;

/// Width of the bounds of the second and of the third derivative over a cell, as a part of them.
const BEND_WIDTH: f64 = 0.1;
const TWIST_WIDTH: f64 = 0.3;

/// Part of a limit that a derivative may take before it has to be known well.
const UNFELT: f64 = 0.25;

/// Halving a piece makes its bounds at least so much better, until rounding does not let it, so many times.
const STALL: f64 = 0.8;
const MOST_STALLED: u32 = 3;

/// A bound of the curvature by that in the middle of a piece, 1/m: `k^2` has the derivatives `2 k . b` and
/// `2 (b . b + k . c)` by the arc, the second one taken over the whole piece.
fn curvature<const D: usize>(
    bend: &[f64; D],
    twist: &[f64; D],
    [k, b, c]: [&[Enclosure; D]; 3],
    half: f64,
) -> f64 {
    let terms = k.iter().zip(b).zip(c).map(|((k, b), c)| b.square() + *k * *c);
    let second = terms.fold(Enclosure::ZERO, |sum, term| sum + term).magnitude();
    Real::sqrt(dot(bend, bend) + 2.0 * half * dot(bend, twist).abs() + half * half * second)
}

/// The points counted from the one in the middle.
fn centred<const D: usize>(mut points: Vec<Homogeneous<D>>) -> Vec<Homogeneous<D>> {
    let centre = points.get(points.len() / 2).map_or([0.0; D], Homogeneous::point);
    for point in &mut points {
        let weight = point.weight;
        point.weighted.iter_mut().zip(centre).for_each(|(x, c)| *x -= c * weight);
    }
    points
}

fn set<T>(values: &mut [T], index: usize, value: T) {
    if let Some(place) = values.get_mut(index) {
        *place = value;
    }
}

/// Within `slope * half` of `middle`, and within what is known already.
fn near<const D: usize>(
    middle: &[f64; D],
    slope: &[Enclosure; D],
    half: Enclosure,
    known: &[Enclosure; D],
) -> [Enclosure; D] {
    let mut bounds = *known;
    for ((bound, middle), slope) in bounds.iter_mut().zip(middle).zip(slope) {
        let mean = *slope * half + Enclosure::from_f64(*middle);
        bound.lower = bound.lower.max(mean.lower);
        bound.upper = bound.upper.min(mean.upper);
    }
    bounds
}

/// One level of de Casteljau's scheme in the middle: one point less.
fn blend_once<const D: usize>(points: &mut Vec<Homogeneous<D>>) {
    let mut rest = &mut points[..];
    while let [here, tail @ ..] = rest {
        if let Some(next) = tail.first() {
            *here = here.combined(0.5, next, 0.5);
        }
        rest = tail;
    }
    points.pop();
}

fn middle_of<const D: usize>(mut points: Vec<Homogeneous<D>>) -> Homogeneous<D> {
    while points.len() > 1 {
        blend_once(&mut points);
    }
    points.first().copied().unwrap_or(Homogeneous::ZERO)
}
