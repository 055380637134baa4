//! How long a step of one period may be, wherever it begins, as long as a part of it lies in a cell.

use alloc::vec::Vec;

use super::FeedLimits;
use super::path::{Cell, Node};
use crate::quantities::{Interval, Limits, Real};

/// Part of the jerk of an axis that a jump of its acceleration may take for a period.
const SHARE: f64 = 0.5;

/// A place where the curvature jumps, and with it the acceleration.
///
/// No period holds it and another place further away than `longest`. With all jumps up to there the accelerations step by
/// at most `reserved` times the period, so that over any period an axis changes its acceleration by no more than its jerk
/// allows.
#[derive(Debug, Clone, Copy)]
pub(super) struct Jump<const D: usize> {
    /// Way from the start of the curve, m.
    way: f64,
    /// Longest step that may hold it, m.
    longest: f64,
    /// Jerk of every axis that it takes, m/s^3.
    reserved: [f64; D],
}

/// The jumps of the curvature inside a block, in sequence.
pub(super) fn jumps<const D: usize>(
    cells: &[Cell<D>],
    inner: &[Node<D>],
    limits: &FeedLimits<D>,
) -> Vec<Jump<D>> {
    let jump = |(cell, node): (&Cell<D>, &Node<D>)| (cell.end, node.jump);
    let all = cells.iter().zip(inner).map(jump).filter(|(_, jump)| jump.iter().any(|j| *j > 0.0));
    let all: Vec<(f64, [f64; D])> = all.collect();
    (0..all.len()).filter_map(|index| Jump::new(&all, index, limits)).collect()
}

impl<const D: usize> Jump<D> {
    fn new(all: &[(f64, [f64; D])], index: usize, limits: &FeedLimits<D>) -> Option<Self> {
        let (way, mut sum) = *all.get(index)?;
        let mut longest = longest_over(&sum, limits);
        let (before, after) = all.split_at(index);
        let (mut before, mut after) = (before.iter().rev().peekable(), after.iter().skip(1).peekable());
        loop {
            // The next one further away on either side.
            let left = before.peek().map_or(f64::INFINITY, |(other, _)| way - other);
            let right = after.peek().map_or(f64::INFINITY, |(other, _)| other - way);
            if left.min(right) >= longest {
                break;
            }
            let next = if left < right { before.next() } else { after.next() };
            let Some((_, jump)) = next else { break };
            sum.iter_mut().zip(jump).for_each(|(sum, jump)| *sum += jump);
            longest = longest_over(&sum, limits).max(left.min(right));
        }
        let mut reserved = [0.0; D];
        for ((reserved, sum), axis) in reserved.iter_mut().zip(sum).zip(limits.axes()) {
            *reserved = share(sum, axis, limits);
        }
        Some(Self { way, longest, reserved })
    }

    /// Distance from a cell, m.
    fn gap(&self, cell: &Cell<D>) -> f64 {
        (cell.start - self.way).max(self.way - cell.end).max(0.0)
    }

    /// Takes what it needs from the jerk left on a cell that a period may hold together with it.
    pub(super) fn reserve(&self, cell: &Cell<D>, reserved: &mut [f64; D]) {
        if self.gap(cell) < self.longest {
            reserved.iter_mut().zip(self.reserved).for_each(|(most, own)| *most = most.max(own));
        }
    }
}

/// Jerk that jumps of the second derivative by `sum` take: what they need at full feed, and no more than their share.
fn share<const D: usize>(sum: f64, axis: &Limits, limits: &FeedLimits<D>) -> f64 {
    let Interval { lower, upper } = axis.jerk();
    let needed = sum * (limits.feed() * limits.feed()) / limits.period();
    if needed > 0.0 { needed.min(SHARE * upper.min(-lower)) } else { 0.0 }
}

/// The longest step over jumps of the second derivative by `sum`: `sum v^2` is the share of the jerk times the period.
fn longest_over<const D: usize>(sum: &[f64; D], limits: &FeedLimits<D>) -> f64 {
    let period = limits.period();
    let step = |(sum, axis): (&f64, &Limits)| {
        let speed = Real::sqrt(share(*sum, axis, limits) * period / sum);
        if *sum > 0.0 { speed * period } else { f64::INFINITY }
    };
    sum.iter().zip(limits.axes()).map(step).fold(limits.feed() * period, f64::min)
}

/// The longest step that keeps the chord error and the jerk at jumps wherever it begins, as long as a part of it lies in
/// the cell, m.
///
/// Another cell, or a jump, at the distance `d` is met only by a step longer than `d`, which then may be no longer than
/// that one allows. So the longest of all steps through a place is no longer than the place with the highest feed allows.
pub(super) fn longest_step<const D: usize>(
    cells: &[Cell<D>],
    index: usize,
    jumps: &[Jump<D>],
    limits: &FeedLimits<D>,
) -> f64 {
    let reach = limits.feed() * limits.period();
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
    for jump in jumps {
        longest = longest.min(jump.longest.max(jump.gap(cell)));
    }
    longest
}
