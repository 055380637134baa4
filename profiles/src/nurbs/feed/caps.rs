//! How fast each cell may be run through.

use alloc::vec::Vec;

use super::FeedLimits;
use super::block::Block;
use super::cell::Bounds;
use super::enclosure::Enclosure;
use super::path::{Cell, Node, Path};
use super::steps::{jumps, longest_step};
use crate::quantities::{Interval, Limits, Real};

/// A cell, or a few in sequence, with what the feed may do there.
#[derive(Debug, Clone, Copy)]
pub(super) struct Capped<const D: usize> {
    /// Way from the start of the curve to the ends, m.
    pub(super) start: f64,
    pub(super) end: f64,
    pub(super) bounds: Bounds<D>,
    /// Highest feed by the command, axis velocities, chord error and jumps of the curvature, m/s.
    pub(super) speed: f64,
    /// Highest constant feed: axis accelerations and jerks too, m/s.
    pub(super) cruise: f64,
    /// Acceleration and jerk of the feed that the axes could take if the curve were straight.
    pub(super) acceleration: f64,
    pub(super) feed_jerk: f64,
    /// Jerk left to every axis besides the jumps of the curvature, m/s^3.
    pub(super) jerk: [Interval; D],
}

impl<const D: usize> Capped<D> {
    /// This one and the next one as one.
    pub(super) fn joined(self, next: Self) -> Self {
        let mut jerk = self.jerk;
        for (own, other) in jerk.iter_mut().zip(next.jerk) {
            *own = Interval::new(own.lower.max(other.lower), own.upper.min(other.upper));
        }
        Self {
            start: self.start,
            end: next.end,
            bounds: self.bounds.joined(&next.bounds),
            speed: self.speed.min(next.speed),
            cruise: self.cruise.min(next.cruise),
            acceleration: self.acceleration.min(next.acceleration),
            feed_jerk: self.feed_jerk.min(next.feed_jerk),
            jerk,
        }
    }
}

/// The parts between stops, in sequence.
pub(super) fn blocks<const D: usize>(path: &Path<D>, limits: &FeedLimits<D>) -> Vec<Block<D>> {
    let mut blocks = Vec::new();
    let mut first = 0;
    for (index, node) in path.nodes.iter().enumerate().skip(1) {
        if node.stop {
            let cells = path.cells.get(first..index).unwrap_or_default();
            let nodes = path.nodes.get(first + 1..index).unwrap_or_default();
            blocks.push(Block::new(capped(cells, nodes, limits)));
            first = index;
        }
    }
    blocks
}

fn capped<const D: usize>(cells: &[Cell<D>], inner: &[Node<D>], limits: &FeedLimits<D>) -> Vec<Capped<D>> {
    let jumps = jumps(cells, inner, limits);
    let one = |(index, cell): (usize, &Cell<D>)| {
        let step = longest_step(cells, index, &jumps, limits);
        let mut reserved = [0.0; D];
        jumps.iter().for_each(|jump| jump.reserve(cell, &mut reserved));
        cap(cell, step / limits.period(), &reserved, limits)
    };
    cells.iter().enumerate().map(one).collect()
}

fn cap<const D: usize>(
    cell: &Cell<D>,
    by_step: f64,
    reserved: &[f64; D],
    limits: &FeedLimits<D>,
) -> Capped<D> {
    let mut speed = by_step.min(limits.feed());
    let (mut square, mut cube) = (f64::INFINITY, f64::INFINITY);
    let (mut acceleration, mut feed_jerk) = (f64::INFINITY, f64::INFINITY);
    let mut left = limits.axes().each_ref().map(Limits::jerk);
    let bounds = &cell.bounds;
    let geometry = bounds.tangent.iter().zip(&bounds.bend).zip(&bounds.twist);
    for (((axis, jerk), reserved), ((tangent, bend), twist)) in
        limits.axes().iter().zip(&mut left).zip(reserved).zip(geometry)
    {
        *jerk = Interval::new(jerk.lower + reserved, jerk.upper - reserved);
        speed = speed.min(most(*tangent, axis.velocity()));
        square = square.min(most(*bend, axis.acceleration()));
        cube = cube.min(most(*twist, *jerk));
        let tangent = tangent.magnitude();
        let smaller = |bounds: Interval| bounds.upper.min(-bounds.lower);
        acceleration = acceleration.min(smaller(axis.acceleration()) / tangent);
        feed_jerk = feed_jerk.min(smaller(*jerk) / tangent);
    }
    let cruise = speed.min(Real::sqrt(square)).min(Real::cbrt(cube));
    let (start, end) = (cell.start, cell.end);
    Capped { start, end, bounds: *bounds, speed, cruise, acceleration, feed_jerk, jerk: left }
}

/// The largest factor with which `value` stays within `bounds`.
fn most(value: Enclosure, bounds: Interval) -> f64 {
    let upper = if value.upper > 0.0 { bounds.upper / value.upper } else { f64::INFINITY };
    let lower = if value.lower < 0.0 { bounds.lower / value.lower } else { f64::INFINITY };
    upper.min(lower)
}
