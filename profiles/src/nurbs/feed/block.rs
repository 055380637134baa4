//! A part of the curve between two stops: its cells, and groups of them.

use alloc::vec::Vec;
use core::ops::Range;

use super::caps::Capped;

/// Cells of a group, and groups of a larger one.
const GROUP: usize = 8;

/// A part of the curve between two stops.
#[derive(Debug, Clone)]
pub(super) struct Block<const D: usize> {
    /// The cells, then groups of them, groups of groups and so on, each bounded like a cell: what holds for a group
    /// need not be asked of its cells.
    levels: Vec<Vec<Capped<D>>>,
}

impl<const D: usize> Block<D> {
    pub(super) fn new(cells: Vec<Capped<D>>) -> Self {
        let mut levels = alloc::vec![cells];
        while let Some(below) = levels.last().filter(|below| below.len() > GROUP) {
            let group = |cells: &[Capped<D>]| cells.iter().copied().reduce(Capped::joined);
            let above = below.chunks(GROUP).filter_map(group).collect();
            levels.push(above);
        }
        Self { levels }
    }

    pub(super) fn cells(&self) -> &[Capped<D>] {
        self.levels.first().map_or(&[], |cells| cells)
    }

    /// Way from the start of the curve to the ends, m.
    pub(super) fn start(&self) -> f64 {
        self.cells().first().map_or(0.0, |c| c.start)
    }

    pub(super) fn end(&self) -> f64 {
        self.cells().last().map_or(0.0, |c| c.end)
    }

    /// How far rounding may put the end of a ramp beyond a place, m.
    pub(super) fn rounding(&self) -> f64 {
        16.0 * f64::EPSILON * self.end()
    }

    /// Index of the cell in which the way `s` lies.
    pub(super) fn index_at(&self, s: f64) -> usize {
        self.cells().partition_point(|c| c.end <= s).min(self.cells().len().saturating_sub(1))
    }

    /// The cell in which the way `s` lies.
    pub(super) fn cell_at(&self, s: f64) -> Option<&Capped<D>> {
        self.cells().get(self.index_at(s))
    }

    /// The cells between two places; the first of them also where there is nothing between.
    pub(super) fn touched(&self, from: f64, to: f64) -> Range<usize> {
        self.touched_after(self.index_at(from + self.rounding()), to)
    }

    /// The cell with this index and those after it up to a place.
    pub(super) fn touched_after(&self, first: usize, to: f64) -> Range<usize> {
        let end = to - self.rounding();
        let rest = self.cells().get(first + 1..).unwrap_or_default();
        // Mostly they are few.
        let near = rest.iter().take(GROUP).take_while(|c| c.start < end).count();
        let more = if near == GROUP { rest.partition_point(|c| c.start < end) } else { near };
        first..first + 1 + more
    }

    /// Whether something holds for all of these cells: asked of the largest groups first, and of a part of a group only
    /// where it does not hold for the whole.
    pub(super) fn all(&self, cells: Range<usize>, holds: &impl Fn(&Capped<D>) -> bool) -> bool {
        self.groups(cells).all(|(level, index)| self.holds(level, index, holds))
    }

    fn holds(&self, level: usize, index: usize, holds: &impl Fn(&Capped<D>) -> bool) -> bool {
        let Some(group) = self.levels.get(level).and_then(|groups| groups.get(index)) else { return true };
        let parts = GROUP * index..GROUP * (index + 1);
        holds(group) || (level > 0 && parts.into_iter().all(|part| self.holds(level - 1, part, holds)))
    }

    /// The largest groups that these cells make up.
    pub(super) fn joined(&self, cells: Range<usize>) -> impl Iterator<Item = &Capped<D>> {
        self.groups(cells).filter_map(|(level, index)| self.levels.get(level)?.get(index))
    }

    /// Level and index of the largest groups that these cells make up, in sequence.
    fn groups(&self, cells: Range<usize>) -> impl Iterator<Item = (usize, usize)> + use<D> {
        let Range { mut start, end } = cells;
        let highest = self.levels.len().saturating_sub(1);
        core::iter::from_fn(move || {
            if start >= end {
                return None;
            }
            let (mut level, mut size) = (0, 1);
            while level < highest && start % (GROUP * size) == 0 && start + GROUP * size <= end {
                (level, size) = (level + 1, GROUP * size);
            }
            let index = start / size;
            start += size;
            Some((level, index))
        })
    }
}
