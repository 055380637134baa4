//! A curve cut into cells: lengths, bounds, and places where to stop.

use alloc::vec::Vec;

use super::arc::arc_length;
use super::cell::{Bounds, Piece, Resolution, Verdict, distance, norm};
use super::{FeedError, FeedLimits};
use crate::nurbs::{NurbsCurve, Side};
use crate::quantities::{Interval, Real};

/// The most cells of a curve.
const MOST_CELLS: usize = 1 << 17;

/// Cells of a curve at least, so that ramps find places to begin and to end at.
const LEAST_CELLS: f64 = 96.0;

/// How much of a limit a derivative may take before it has to be known well.
const UNFELT: f64 = 0.05;

/// Angle from which on a bend at a knot is a corner, rad: less is rounding of the curve.
const CORNER_ANGLE: f64 = 1e-9;

/// Length of a piece that is a point, as a part of the curve.
const POINT: f64 = 1e-13;

/// A piece of the curve with its bounds.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cell<const D: usize> {
    /// Parameters of the ends.
    pub(super) from: f64,
    pub(super) to: f64,
    /// Arc length from the start of the curve to the ends, m.
    pub(super) start: f64,
    pub(super) end: f64,
    pub(super) bounds: Bounds<D>,
}

/// Where two cells meet.
#[derive(Debug, Clone, Copy)]
pub(super) struct Node<const D: usize> {
    /// Whether the curve has a corner here or no direction, or begins or ends.
    pub(super) stop: bool,
    /// Magnitude of the jump of the second derivative by arc length, axis by axis, 1/m.
    pub(super) jump: [f64; D],
}

/// A curve as cells from its start to its end.
#[derive(Debug, Clone)]
pub(super) struct Path<const D: usize> {
    pub(super) cells: Vec<Cell<D>>,
    /// One more than cells.
    pub(super) nodes: Vec<Node<D>>,
    pub(super) length: f64,
}

impl<const D: usize> Path<D> {
    pub(super) fn new(curve: &NurbsCurve<D>, limits: &FeedLimits<D>) -> Result<Self, FeedError> {
        let pieces: Vec<Piece<D>> = curve.bezier_segments().into_iter().map(Piece::of).collect();
        let polygon: f64 = pieces.iter().map(Piece::polygon).sum();
        if !(polygon > 0.0 && polygon.is_finite()) {
            return Err(FeedError::Length(polygon));
        }
        let resolution = resolution(polygon, limits);
        let mut builder = Builder { curve, path: Self::empty(), singular: false };
        for piece in pieces {
            let mut waiting = alloc::vec![piece];
            let mut joint = true;
            while let Some(piece) = waiting.pop() {
                match piece.look(&resolution) {
                    Verdict::Bounded(bounds) => {
                        builder.add(piece.from, piece.to, bounds, joint);
                        joint = false;
                    }
                    Verdict::Coarse => {
                        let (left, right) = piece.halves();
                        waiting.push(right);
                        waiting.push(left);
                    }
                    Verdict::Singular => builder.skip(piece.to),
                }
                if builder.path.cells.len() + waiting.len() > MOST_CELLS {
                    let parameter = builder.path.cells.last().map_or(f64::NAN, |cell| cell.to);
                    return Err(FeedError::TooRough { most: MOST_CELLS, parameter });
                }
            }
        }
        builder.finish()
    }

    fn empty() -> Self {
        Self { cells: Vec::new(), nodes: Vec::new(), length: 0.0 }
    }

    /// Index of the cell in which the way `s` from the start lies.
    pub(super) fn cell_at(&self, s: f64) -> usize {
        self.cells.partition_point(|cell| cell.end <= s).min(self.cells.len().saturating_sub(1))
    }

    /// A bound of the curvature between two places, 1/m.
    pub(super) fn curvature(&self, from: f64, to: f64) -> f64 {
        let cells = self.cells.get(self.cell_at(from)..).unwrap_or_default();
        let touched = cells.iter().take_while(|cell| cell.start < to);
        touched.map(|cell| cell.bounds.curvature).fold(0.0, f64::max)
    }
}

struct Builder<'a, const D: usize> {
    curve: &'a NurbsCurve<D>,
    path: Path<D>,
    /// Whether the next node is one at which the curve has no direction.
    singular: bool,
}

impl<const D: usize> Builder<'_, D> {
    fn add(&mut self, from: f64, to: f64, bounds: Bounds<D>, joint: bool) {
        let before = self.path.cells.last().map(|cell| (cell.to, cell.end));
        let (from, start) = before.unwrap_or((self.curve.domain().lower.min(from), 0.0));
        let node = match before {
            None => Node { stop: true, jump: [0.0; D] },
            Some(_) if self.singular => Node { stop: true, jump: [0.0; D] },
            Some(_) if joint => self.joint(from),
            Some(_) => Node { stop: false, jump: [0.0; D] },
        };
        self.singular = false;
        self.path.nodes.push(node);
        let end = start + arc_length(self.curve, from, to);
        self.path.cells.push(Cell { from, to, start, end, bounds });
    }

    /// A point without direction: the cell before it goes on to it, or the cell after it begins with it.
    fn skip(&mut self, to: f64) {
        self.singular = true;
        if let Some(cell) = self.path.cells.last_mut() {
            cell.end += arc_length(self.curve, cell.to, to);
            cell.to = to;
        }
    }

    /// What the curve does at a knot.
    fn joint(&self, u: f64) -> Node<D> {
        let [before, after] = [Side::Before, Side::After].map(|side| tangent_and_bend(self.curve, u, side));
        let (Some((t0, k0)), Some((t1, k1))) = (before, after) else {
            return Node { stop: true, jump: [0.0; D] };
        };
        // Between unit vectors the chord is twice the sine of half the angle.
        let angle = 2.0 * Real::atan2(distance(&t0, &t1), Real::sqrt(sum_square(&t0, &t1)));
        let mut jump = [0.0; D];
        for ((jump, a), b) in jump.iter_mut().zip(k0).zip(k1) {
            *jump = (b - a).abs();
        }
        Node { stop: angle > CORNER_ANGLE, jump }
    }

    fn finish(mut self) -> Result<Path<D>, FeedError> {
        self.path.nodes.push(Node { stop: true, jump: [0.0; D] });
        let length = self.path.cells.last().map_or(0.0, |cell| cell.end);
        self.path.length = length;
        if length > 0.0 && length.is_finite() { Ok(self.path) } else { Err(FeedError::Length(length)) }
    }
}

fn sum_square<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    a.iter().zip(b).map(|(x, y)| (x + y) * (x + y)).sum()
}

/// Unit tangent and second derivative by arc length on one side of `u`; `None` without speed.
fn tangent_and_bend<const D: usize>(
    curve: &NurbsCurve<D>,
    u: f64,
    side: Side,
) -> Option<([f64; D], [f64; D])> {
    let [_, first, second] = curve.derivatives_from(u, side);
    let speed = norm(&first);
    let tangent = first.map(|x| x / speed);
    let along: f64 = second.iter().zip(&tangent).map(|(a, t)| a * t).sum();
    let mut bend = second;
    for (bend, t) in bend.iter_mut().zip(&tangent) {
        *bend = (*bend - along * t) / (speed * speed);
    }
    bend.iter().chain(&tangent).all(|x| x.is_finite()).then_some((tangent, bend))
}

/// How well derivatives must be known: well where they take more than a small part of a limit at full feed.
fn resolution<const D: usize>(polygon: f64, limits: &FeedLimits<D>) -> Resolution {
    let smaller = |bounds: Interval| bounds.upper.min(-bounds.lower);
    let feed = limits.feed();
    let least = |of: fn(&crate::quantities::Limits) -> Interval| {
        limits.axes().iter().map(of).map(smaller).fold(f64::INFINITY, f64::min)
    };
    let (acceleration, jerk) = (least(|axis| axis.acceleration()), least(|axis| axis.jerk()));
    let step = feed * limits.period();
    let by_chord = 8.0 * limits.chord_error() / (step * step);
    Resolution {
        bend: UNFELT * by_chord.min(acceleration / (feed * feed)),
        twist: UNFELT * jerk / (feed * feed * feed),
        longest: polygon / LEAST_CELLS,
        shortest: polygon * POINT,
    }
}
