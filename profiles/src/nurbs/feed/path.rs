//! A curve cut into cells: lengths, bounds, and places where to stop.

use alloc::vec::Vec;

use super::cell::{Bounds, Piece, Resolution, Verdict};
use super::{FeedError, FeedLimits};
use crate::nurbs::geometry::angle_between;
use crate::nurbs::{ArcLength, Side};
use crate::quantities::Interval;

/// The most cells of a curve.
const MOST_CELLS: usize = 1 << 17;

/// Cells of a curve at least, so that ramps find places to begin and to end at.
const LEAST_CELLS: f64 = 96.0;

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

impl<const D: usize> Node<D> {
    const STOP: Self = Self { stop: true, jump: [0.0; D] };
}

/// A curve as cells from its start to its end.
#[derive(Debug, Clone)]
pub(super) struct Path<const D: usize> {
    pub(super) cells: Vec<Cell<D>>,
    /// One more than cells.
    pub(super) nodes: Vec<Node<D>>,
}

impl<const D: usize> Path<D> {
    pub(super) fn new(arc: &ArcLength<D>, limits: &FeedLimits<D>) -> Result<Self, FeedError> {
        let pieces: Vec<Piece<D>> = arc.curve().bezier_segments().into_iter().map(Piece::of).collect();
        let polygon: f64 = pieces.iter().map(Piece::polygon).sum();
        let resolution = resolution(polygon, limits);
        let mut builder = Builder { arc, path: Self::empty(), singular: false };
        for piece in pieces {
            let mut waiting = alloc::vec![piece];
            let mut joint = true;
            while let Some(mut piece) = waiting.pop() {
                match piece.look(&resolution) {
                    Verdict::Bounded(bounds) => {
                        builder.add(piece.to, bounds, joint);
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
        builder.path.nodes.push(Node::STOP);
        if builder.path.cells.is_empty() { Err(FeedError::Length(0.0)) } else { Ok(builder.path) }
    }

    fn empty() -> Self {
        Self { cells: Vec::new(), nodes: Vec::new() }
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
    arc: &'a ArcLength<D>,
    path: Path<D>,
    /// Whether the next node is one at which the curve has no direction.
    singular: bool,
}

impl<const D: usize> Builder<'_, D> {
    fn add(&mut self, to: f64, bounds: Bounds<D>, joint: bool) {
        let node = match self.path.cells.last() {
            None => Node::STOP,
            Some(_) if self.singular => Node::STOP,
            Some(before) if joint => self.joint(before.to),
            Some(_) => Node { stop: false, ..Node::STOP },
        };
        let from = self.arc.curve().domain().lower;
        let (from, start) = self.path.cells.last().map_or((from, 0.0), |cell| (cell.to, cell.end));
        self.singular = false;
        self.path.nodes.push(node);
        self.path.cells.push(Cell { from, to, start, end: self.arc.length_at(to), bounds });
    }

    /// A point without direction: the cell before it goes on to it, or the cell after it begins with it.
    fn skip(&mut self, to: f64) {
        self.singular = true;
        if let Some(cell) = self.path.cells.last_mut() {
            cell.to = to;
            cell.end = self.arc.length_at(to);
        }
    }

    /// What the curve does at a knot.
    fn joint(&self, u: f64) -> Node<D> {
        let [before, after] = [Side::Before, Side::After].map(|side| self.arc.curve().by_length(u, side));
        let (Some([_, t0, k0, _]), Some([_, t1, k1, _])) = (before, after) else {
            return Node::STOP;
        };
        let mut jump = [0.0; D];
        for ((jump, a), b) in jump.iter_mut().zip(k0).zip(k1) {
            *jump = (b - a).abs();
        }
        Node { stop: angle_between(&t0, &t1) > CORNER_ANGLE, jump }
    }
}

/// How well derivatives must be known on a curve with a control polygon of this length, m.
fn resolution<const D: usize>(polygon: f64, limits: &FeedLimits<D>) -> Resolution<D> {
    let smaller = |bounds: Interval| bounds.upper.min(-bounds.lower);
    let period = limits.period();
    Resolution {
        acceleration: limits.axes().each_ref().map(|axis| smaller(axis.acceleration())),
        jerk: limits.axes().each_ref().map(|axis| smaller(axis.jerk())),
        chord: 8.0 * limits.chord_error() / (period * period),
        feed: limits.feed(),
        longest: polygon / LEAST_CELLS,
        shortest: polygon * POINT,
    }
}
