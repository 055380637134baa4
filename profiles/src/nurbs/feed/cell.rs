//! A short piece of a curve and what its derivatives along the arc are at most.

use alloc::vec::Vec;

use super::enclosure::{Enclosure, Scalar};
use super::jet::{Coordinates, ORDERS, along_arc, quotient};
use crate::nurbs::geometry::{distance, norm};
use crate::nurbs::{BezierSegment, Homogeneous};

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

/// Below which derivatives of a path need not be known well, and how long a cell may be.
#[derive(Debug, Clone, Copy)]
pub(super) struct Resolution {
    /// Curvature that no limit feels, 1/m.
    pub(super) bend: f64,
    /// Third derivative that no limit feels, 1/m^2.
    pub(super) twist: f64,
    /// Longest cell, m.
    pub(super) longest: f64,
    /// Length below which a piece is a point, m.
    pub(super) shortest: f64,
}

/// A rational polynomial piece in Bezier form, over its own parameter from 0 to 1.
#[derive(Debug, Clone)]
pub(super) struct Piece<const D: usize> {
    pub(super) from: f64,
    pub(super) to: f64,
    points: Vec<Homogeneous<D>>,
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
        Self { from: segment.from, to: segment.to, points: segment.points }
    }

    /// Length of the control polygon, m: the piece is not longer.
    pub(super) fn polygon(&self) -> f64 {
        let ends = self.points.iter().zip(self.points.iter().skip(1));
        ends.map(|(a, b)| distance(&a.point(), &b.point())).sum()
    }

    /// Both halves.
    pub(super) fn halves(mut self) -> (Self, Self) {
        let middle = 0.5 * (self.from + self.to);
        let mut right = Vec::with_capacity(self.points.len());
        let mut left = Vec::with_capacity(self.points.len());
        while let (Some(first), Some(last)) = (self.points.first(), self.points.last()) {
            left.push(*first);
            right.push(*last);
            blend_once(&mut self.points);
        }
        right.reverse();
        let left = Self { from: self.from, to: middle, points: left };
        (left, Self { from: middle, to: self.to, points: right })
    }

    /// Bounds by the mean value theorem: a derivative lies as near to its value in the middle as the next one times
    /// half the length of the piece says, and that one is bounded by interval arithmetic with the control points.
    pub(super) fn look(&self, resolution: &Resolution) -> Verdict<D> {
        let polygon = self.polygon();
        let undecided = if polygon <= resolution.shortest { Verdict::Singular } else { Verdict::Coarse };
        let Some((jets, middle)) = self.jets() else { return undecided };
        let (Some((speed, [tangent, bend, twist, next])), Some((_, middle))) =
            (along_arc(&jets), along_arc(&middle))
        else {
            return undecided;
        };
        let length = speed.upper.min(polygon);
        let [middle_tangent, middle_bend, middle_twist, _] = middle;
        let half = Enclosure::around_zero(0.5 * length);
        let bounds = Bounds {
            tangent: near(&middle_tangent, &bend, half, &tangent),
            bend: near(&middle_bend, &twist, half, &bend),
            twist: near(&middle_twist, &next, half, &twist),
            curvature: norm(&middle_bend) + 0.5 * length * norm(&twist.map(Enclosure::magnitude)),
        };
        let most = |values: &[Enclosure; D]| values.iter().fold(0.0_f64, |m, x| m.max(x.magnitude()));
        let is_fine = length <= resolution.longest
            && speed.upper <= MOST_UNEVEN * speed.lower
            && length * bounds.curvature <= MOST_TURN
            && length * most(&twist) <= BEND_WIDTH * most(&bounds.bend).max(resolution.bend)
            && length * most(&next) <= TWIST_WIDTH * most(&bounds.twist).max(resolution.twist);
        match (is_fine, bounds.curvature.is_finite()) {
            (true, _) => Verdict::Bounded(bounds),
            (false, true) if polygon <= resolution.shortest => Verdict::Bounded(bounds),
            _ => undecided,
        }
    }

    /// Taylor coefficients of the coordinates by the own parameter: over the piece and in its middle.
    fn jets(&self) -> Option<(Coordinates<Enclosure, D>, Coordinates<f64, D>)> {
        let mut points = self.points.clone();
        // Counted from a point of the piece, coordinates are as small as the piece.
        let centre = points.get(points.len() / 2)?.point();
        for point in &mut points {
            let weight = point.weight;
            point.weighted.iter_mut().zip(centre).for_each(|(x, c)| *x -= c * weight);
        }
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
