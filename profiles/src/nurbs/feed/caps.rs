//! How fast each cell may be run through.

use alloc::vec::Vec;

use super::FeedLimits;
use super::enclosure::Enclosure;
use super::path::{Cell, Node, Path};
use crate::quantities::{Interval, Real};

/// A cell with what the feed may do on it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Capped<const D: usize> {
    pub(super) cell: Cell<D>,
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

/// A part of the path between two stops.
#[derive(Debug, Clone)]
pub(super) struct Block<const D: usize> {
    pub(super) cells: Vec<Capped<D>>,
}

impl<const D: usize> Block<D> {
    pub(super) fn start(&self) -> f64 {
        self.cells.first().map_or(0.0, |c| c.cell.start)
    }

    pub(super) fn end(&self) -> f64 {
        self.cells.last().map_or(0.0, |c| c.cell.end)
    }

    /// Index of the cell in which the way `s` lies.
    pub(super) fn cell_at(&self, s: f64) -> usize {
        self.cells.partition_point(|c| c.cell.end <= s).min(self.cells.len().saturating_sub(1))
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
            blocks.push(Block { cells: capped(cells, nodes, limits) });
            first = index;
        }
    }
    blocks
}

fn capped<const D: usize>(cells: &[Cell<D>], inner: &[Node<D>], limits: &FeedLimits<D>) -> Vec<Capped<D>> {
    let reach = limits.feed() * limits.period();
    let one = |(index, cell): (usize, &Cell<D>)| {
        let step = longest_step(cells, index, reach, limits);
        let jump = jumps_near(cells, inner, cell, reach);
        cap(cell, step / limits.period(), &jump, limits)
    };
    cells.iter().enumerate().map(one).collect()
}

/// The longest step that keeps the chord error wherever it begins, as long as a part of it lies in the cell, m.
///
/// A step of length `l` in the cell meets another one at the distance `d` only if `l > d`, and then may be no longer
/// than that one allows.
fn longest_step<const D: usize>(cells: &[Cell<D>], index: usize, reach: f64, limits: &FeedLimits<D>) -> f64 {
    let Some(cell) = cells.get(index) else { return 0.0 };
    let mut longest = reach.min(limits.longest_step(cell.bounds.curvature));
    let (before, after) = cells.split_at(index);
    for other in before.iter().rev() {
        let gap = cell.start - other.end;
        if gap >= longest {
            break;
        }
        longest = longest.min(limits.longest_step(other.bounds.curvature).max(gap));
    }
    for other in after.iter().skip(1) {
        let gap = other.start - cell.end;
        if gap >= longest {
            break;
        }
        longest = longest.min(limits.longest_step(other.bounds.curvature).max(gap));
    }
    longest
}

/// The sum of all jumps of the second derivative that a period could hold together with a part of the cell, 1/m.
fn jumps_near<const D: usize>(cells: &[Cell<D>], inner: &[Node<D>], cell: &Cell<D>, reach: f64) -> [f64; D] {
    let first = cells.partition_point(|c| c.end < cell.start - reach);
    let mut sum = [0.0; D];
    let near = cells.iter().zip(inner).skip(first).take_while(|(c, _)| c.end <= cell.end + reach);
    for (_, node) in near {
        sum.iter_mut().zip(node.jump).for_each(|(sum, jump)| *sum += jump);
    }
    sum
}

fn cap<const D: usize>(cell: &Cell<D>, by_chord: f64, jump: &[f64; D], limits: &FeedLimits<D>) -> Capped<D> {
    let feed = limits.feed();
    let mut speed = by_chord.min(feed);
    let (mut square, mut cube) = (f64::INFINITY, f64::INFINITY);
    let (mut acceleration, mut feed_jerk) = (f64::INFINITY, f64::INFINITY);
    let mut left = limits.axes().each_ref().map(crate::quantities::Limits::jerk);
    let bounds = &cell.bounds;
    let geometry = bounds.tangent.iter().zip(&bounds.bend).zip(&bounds.twist);
    for (((axis, jerk), jump), ((tangent, bend), twist)) in
        limits.axes().iter().zip(&mut left).zip(jump).zip(geometry)
    {
        let smaller = jerk.upper.min(-jerk.lower);
        // Where the curvature jumps the acceleration does: at most half of what the jerk allows in a period.
        if *jump > 0.0 && smaller < f64::INFINITY {
            let share = (0.5 * smaller).min(jump * (feed * feed) / limits.period());
            speed = speed.min(Real::sqrt(share * limits.period() / jump));
            *jerk = Interval::new(jerk.lower + share, jerk.upper - share);
        }
        speed = speed.min(most(*tangent, axis.velocity()));
        square = square.min(most(*bend, axis.acceleration()));
        cube = cube.min(most(*twist, *jerk));
        let tangent = tangent.magnitude();
        let smaller = |bounds: Interval| bounds.upper.min(-bounds.lower);
        acceleration = acceleration.min(smaller(axis.acceleration()) / tangent);
        feed_jerk = feed_jerk.min(smaller(*jerk) / tangent);
    }
    let cruise = speed.min(Real::sqrt(square)).min(Real::cbrt(cube));
    Capped { cell: *cell, speed, cruise, acceleration, feed_jerk, jerk: left }
}

/// The largest factor with which `value` stays within `bounds`.
fn most(value: Enclosure, bounds: Interval) -> f64 {
    let upper = if value.upper > 0.0 { bounds.upper / value.upper } else { f64::INFINITY };
    let lower = if value.lower < 0.0 { bounds.lower / value.lower } else { f64::INFINITY };
    upper.min(lower)
}
