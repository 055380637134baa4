//! Certain bounds of curvature and speed over an interval.

use super::bernstein::Bernstein;
use super::piece::Piece;
use super::{Homogeneous, NurbsCurve};
use crate::quantities::{Interval, Real};

/// A bound is at most this much beyond what is reached, relative to it.
const SLACK: f64 = 1e-3;

/// Halvings after which a denominator that may still vanish does.
const MOST_HALVINGS: u32 = 40;

/// Squared curvature below which a piece of size one is straight to rounding.
const STRAIGHT: f64 = 1e-24;

/// Halvings in all, after which a bound is as good as it is.
const MOST_WORK: u32 = 4096;

/// A quotient of two polynomials of the same degree over `[0, 1]`, the lower one not negative.
struct Quotient {
    above: Bernstein,
    below: Bernstein,
    halvings: u32,
}

impl Quotient {
    /// The largest quotient of coefficients, which the values never exceed; infinite where a coefficient below is not
    /// positive.
    fn upper(&self) -> f64 {
        let pairs = self.above.coefficients().iter().zip(self.below.coefficients());
        pairs.map(|(a, b)| if *b > 0.0 { a / b } else { f64::INFINITY }).fold(0.0, f64::max)
    }

    /// The larger value at the ends.
    fn reached(&self) -> f64 {
        let value = |a: Option<&f64>, b: Option<&f64>| match (a, b) {
            (Some(a), Some(b)) if *b > 0.0 => a / b,
            _ => 0.0,
        };
        let (above, below) = (self.above.coefficients(), self.below.coefficients());
        value(above.first(), below.first()).max(value(above.last(), below.last()))
    }

    fn part(&self, from: f64, to: f64) -> Self {
        Self { above: self.above.part(from, to), below: self.below.part(from, to), halvings: self.halvings }
    }

    fn halves(&self) -> [Self; 2] {
        let ((a, b), (c, d)) = (self.above.split(), self.below.split());
        let halvings = self.halvings + 1;
        [Self { above: a, below: c, halvings }, Self { above: b, below: d, halvings }]
    }
}

/// A bound of the quotient, at most `SLACK` above its largest value relatively or below `floor`; infinite where it has a
/// pole.
fn largest(quotient: Quotient, floor: f64) -> f64 {
    let mut reached = quotient.reached();
    let (mut bound, mut work) = (0.0_f64, 0);
    let mut open = alloc::vec![quotient];
    while let Some(quotient) = open.pop() {
        let upper = quotient.upper();
        let close = upper <= floor.max(reached * (1.0 + SLACK));
        if close || quotient.halvings >= MOST_HALVINGS || work >= MOST_WORK {
            bound = bound.max(upper);
            if bound.is_infinite() {
                break;
            }
        } else {
            work += 1;
            let [left, right] = quotient.halves();
            reached = reached.max(left.reached()).max(right.reached());
            // The steeper half first: what it reaches closes others.
            open.extend(if left.upper() > right.upper() { [right, left] } else { [left, right] });
        }
    }
    bound
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
            let squared = largest(squared_curvature(piece).part(from, to), STRAIGHT);
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
            let quotient = squared_speed(piece).part(from, to);
            let unit = piece.scale / (piece.to - piece.from);
            let inverse =
                Quotient { above: quotient.below.clone(), below: quotient.above.clone(), halvings: 0 };
            let (fast, slow) = (largest(quotient, 0.0), largest(inverse, 0.0));
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

/// With `H = w^2 dC/dt`: `k^2 = |H x H'|^2 w^4 / |H|^6`.
fn squared_curvature<const D: usize>(piece: &Piece<D>) -> Quotient {
    let hodograph = piece.hodograph();
    let pairs =
        hodograph.iter().enumerate().flat_map(|(k, a)| hodograph.iter().skip(k + 1).map(move |b| (a, b)));
    let cross = Bernstein::sum(pairs.map(|(a, b)| b.wronskian(a).squared()));
    let speed = Bernstein::sum(hodograph.iter().map(Bernstein::squared));
    let below = speed.squared().times(&speed);
    let above = cross.times(&piece.weight.squared().squared());
    // A curve on a line, or one of degree one, has no pair of directions: its numerator is the constant zero.
    let missing = below.degree().saturating_sub(above.degree());
    Quotient { above: above.raised(missing), below, halvings: 0 }
}

/// `|dC/dt|^2 = |H|^2 / w^4`.
fn squared_speed<const D: usize>(piece: &Piece<D>) -> Quotient {
    let speed = Bernstein::sum(piece.hodograph().iter().map(Bernstein::squared));
    let below = piece.weight.squared().squared();
    let missing = below.degree().saturating_sub(speed.degree());
    Quotient { above: speed.raised(missing), below, halvings: 0 }
}
