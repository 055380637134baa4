//! Certain bounds of curvature and speed over an interval.

use super::bernstein::Bernstein;
use super::bounds::{Halved, Quotient, largest};
use super::piece::Piece;
use super::{Homogeneous, NurbsCurve};
use crate::quantities::{Interval, Real};

/// Squared curvature below which a piece of size one is straight to rounding.
const STRAIGHT: f64 = 1e-24;

/// A part of a span by `H = w^2 dC/dt`, its derivative and the weight, `t` being the parameter of the whole span.
///
/// Products are made anew for every part: near a place where the curve is slow those of a larger part would be roundings.
struct Motion<const D: usize> {
    hodograph: [Bernstein; D],
    slope: [Bernstein; D],
    weight: Bernstein,
}

impl<const D: usize> Motion<D> {
    fn of(piece: &Piece<D>, from: f64, to: f64) -> Self {
        let hodograph = piece.hodograph();
        let slope = hodograph.each_ref().map(|h| h.derivative().part(from, to));
        Self { hodograph: hodograph.map(|h| h.part(from, to)), slope, weight: piece.weight.part(from, to) }
    }

    /// `|H|^2`.
    fn speed(&self) -> Bernstein {
        Bernstein::sum(self.hodograph.iter().map(Bernstein::squared))
    }

    /// `k^2 = |H x H'|^2 w^4 / |H|^6`.
    fn squared_curvature(&self) -> Quotient {
        let both = || self.hodograph.iter().zip(&self.slope);
        let pairs = both().enumerate().flat_map(|(k, a)| both().skip(k + 1).map(move |b| (a, b)));
        let area = |((h, slope), (g, other)): ((&Bernstein, &Bernstein), (&Bernstein, &Bernstein))| {
            h.times(other).plus(-1.0, &g.times(slope)).squared()
        };
        let cross = Bernstein::sum(pairs.map(area));
        let (speed, weight) = (self.speed(), self.weight.squared());
        Quotient::new(cross.times(&weight.squared()), speed.squared().times(&speed))
    }

    /// `|dC/dt|^2 = |H|^2 / w^4`.
    fn squared_speed(&self) -> Quotient {
        Quotient::new(self.speed(), self.weight.squared().squared())
    }

    fn inverse_squared_speed(&self) -> Quotient {
        Quotient::new(self.weight.squared().squared(), self.speed())
    }
}

impl<const D: usize> Halved for Motion<D> {
    fn halves(&self) -> [Self; 2] {
        [false, true].map(|upper| {
            let of = |polynomial: &Bernstein| polynomial.half(upper);
            Self {
                hodograph: self.hodograph.each_ref().map(of),
                slope: self.slope.each_ref().map(of),
                weight: of(&self.weight),
            }
        })
    }
}

impl<const D: usize> NurbsCurve<D> {
    /// A bound of the curvature between two parameters, 1/m: never below the largest curvature there (corners aside) and
    /// at most 0.1 % above it unless the radius is beyond 1e12 times the size of a span; infinite where the curve stands
    /// still, as in a cusp.
    ///
    /// A smooth arc of length `s` stays within `bound s^2 / 8` of its chord.
    #[must_use]
    pub fn curvature_bound(&self, from: f64, to: f64) -> f64 {
        let mut bound = 0.0_f64;
        self.for_spans_between(from, to, |piece, from, to| {
            // What another span has reached already need not be found here.
            let known = bound * piece.scale;
            let floor = STRAIGHT.max(known * known);
            let squared = largest(Motion::of(piece, from, to), floor, Motion::squared_curvature).bound;
            bound = bound.max(Real::sqrt(squared) / piece.scale);
        });
        bound
    }

    /// A range that holds `|dC/du|` between two parameters, in m per unit of the parameter: its upper end at most 0.1 %
    /// above the largest speed there and its lower end at most 0.1 % below the smallest; zero where the curve stands
    /// still.
    #[must_use]
    pub fn speed_bounds(&self, from: f64, to: f64) -> Interval {
        let mut bounds = Interval::new(f64::INFINITY, 0.0);
        self.for_spans_between(from, to, |piece, from, to| {
            let unit = piece.scale / (piece.to - piece.from);
            let motion = || Motion::of(piece, from, to);
            let (known_fast, known_slow) = (bounds.upper / unit, unit / bounds.lower);
            let fast = largest(motion(), known_fast * known_fast, Motion::squared_speed).bound;
            let slow = largest(motion(), known_slow * known_slow, Motion::inverse_squared_speed).bound;
            bounds.upper = bounds.upper.max(unit * Real::sqrt(fast));
            bounds.lower = bounds.lower.min(unit / Real::sqrt(slow));
        });
        bounds
    }

    /// Every span between two parameters, which are brought into the domain, about its own start, and which part of it
    /// lies between them.
    fn for_spans_between(&self, from: f64, to: f64, mut found: impl FnMut(&Piece<D>, f64, f64)) {
        let (from, to) = (self.knots().within(from), self.knots().within(to));
        let (from, to) = if from <= to { (from, to) } else { (to, from) };
        let mut at = from;
        loop {
            let segment = self.span_segment(at);
            let origin = segment.points.first().map_or([0.0; D], Homogeneous::point);
            let local = |u: f64| ((u - segment.from) / (segment.to - segment.from)).clamped(0.0, 1.0);
            found(&Piece::new(&segment, &origin), local(from), local(to));
            if segment.to >= to || segment.to <= at {
                break;
            }
            at = segment.to;
        }
    }
}
