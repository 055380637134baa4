//! One rational piece as polynomials, in units of its own.

use super::bernstein::Bernstein;
use super::{BezierSegment, Homogeneous};

/// A Bezier piece moved to the origin, one long and with weights up to one: what is computed from it neither cancels nor
/// leaves the range, whatever the units of the curve.
#[derive(Debug, Clone)]
pub(super) struct Piece<const D: usize> {
    pub(super) from: f64,
    pub(super) to: f64,
    /// What was the length one, in the unit of the curve.
    pub(super) scale: f64,
    pub(super) weighted: [Bernstein; D],
    pub(super) weight: Bernstein,
}

impl<const D: usize> Piece<D> {
    /// The segment with `origin` moved to zero.
    pub(super) fn new(segment: &BezierSegment<D>, origin: &[f64; D]) -> Self {
        let weight = segment.points.iter().fold(0.0_f64, |most, h| most.max(h.weight));
        let weight = if weight > 0.0 { weight } else { 1.0 };
        let mut moved = segment.points.clone();
        let mut scale = 0.0_f64;
        for h in &mut moved {
            let point = h.point();
            h.weight /= weight;
            for ((x, p), o) in h.weighted.iter_mut().zip(point).zip(origin) {
                *x = p - o;
                scale = scale.max(x.abs());
            }
        }
        // A piece that is one point, the origin, has no length to measure by.
        let scale = if scale > 0.0 { scale } else { 1.0 };
        let weighted = core::array::from_fn(|axis| {
            let x = |h: &Homogeneous<D>| h.weighted.get(axis).map_or(0.0, |x| x / scale * h.weight);
            Bernstein::new(moved.iter().map(x))
        });
        // A polynomial has the constant one for a weight, in degree zero.
        let even = moved.iter().all(|h| h.weight >= 1.0);
        let weight = Bernstein::new(moved.iter().map(|h| h.weight).take(if even { 1 } else { moved.len() }));
        Self { from: segment.from, to: segment.to, scale, weighted, weight }
    }

    /// The squared distance from the origin times the squared weight.
    pub(super) fn squared_distance(&self) -> Bernstein {
        Bernstein::sum(self.weighted.iter().map(Bernstein::squared))
    }

    /// The largest squared distance of a control point from the origin.
    pub(super) fn farthest(&self) -> f64 {
        let squared = |index: usize| -> f64 {
            let weight = self.weight.coefficients().get(index).copied().unwrap_or(1.0);
            let x = |x: &Bernstein| x.coefficients().get(index).map_or(0.0, |x| (x / weight) * (x / weight));
            self.weighted.iter().map(x).sum()
        };
        let degree = self.weighted.first().map_or(0, Bernstein::degree);
        (0..=degree).map(squared).fold(0.0, f64::max)
    }

    /// The halves, in the units of the whole.
    pub(super) fn split(&self) -> (Self, Self) {
        let middle = 0.5 * (self.from + self.to);
        let (light, heavy) = self.weight.split();
        let (mut left, mut right) = (self.clone(), self.clone());
        for ((x, l), r) in self.weighted.iter().zip(&mut left.weighted).zip(&mut right.weighted) {
            (*l, *r) = x.split();
        }
        (left.weight, right.weight) = (light, heavy);
        (left.to, right.from) = (middle, middle);
        (left, right)
    }

    /// The derivative by the local parameter, times the squared weight.
    pub(super) fn hodograph(&self) -> [Bernstein; D] {
        self.weighted.each_ref().map(|x| match self.weight.degree() {
            0 => x.derivative(),
            _ => x.wronskian(&self.weight),
        })
    }
}
