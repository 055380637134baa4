//! The equations of a Newton step over the control points that are free.

use profiles::nurbs::Homogeneous;

use super::band::Band;
use super::problem::{Problem, Sample, Tied, dot};

/// What a sample adds to the Hessian: it depends on the control points by the reduced curve there only.
#[derive(Debug, Clone, Copy)]
pub(super) struct Curvature<const D: usize> {
    pub(super) points: [[f64; D]; D],
    pub(super) mixed: [f64; D],
    pub(super) weights: f64,
}

/// A Hessian and right sides; the unknowns of a control point are its weighted coordinates and, if weights are free, its
/// weight.
pub(super) struct System<const D: usize> {
    hessian: Band,
    each: usize,
    tied: Vec<Tied<D>>,
    reach: usize,
    count: usize,
}

impl<const D: usize> System<D> {
    pub(super) fn new(problem: &Problem<D>) -> Self {
        let each = D + usize::from(problem.weights_free);
        let (count, reach) = (problem.knots.points(), problem.knots.degree());
        let hessian = Band::new(count * each, (reach + 1) * each);
        Self { hessian, each, tied: problem.tied.clone(), reach, count }
    }

    /// Zero on the right side.
    pub(super) fn right(&self) -> Vec<f64> {
        vec![0.0; self.count * self.each]
    }

    pub(super) fn clear(&mut self) {
        self.hessian.clear();
    }

    /// Adds what a sample adds to the Hessian.
    pub(super) fn add(&mut self, sample: &Sample<D>, curvature: &Curvature<D>) {
        let each = self.each;
        let with_weights = each > D;
        for (a, basis_a) in sample.basis().iter().enumerate() {
            let row = (sample.first + a) * each;
            for (b, basis_b) in sample.basis().iter().enumerate().take(a + 1) {
                let column = (sample.first + b) * each;
                let factor = basis_a * basis_b;
                for (s, (points, mixed)) in curvature.points.iter().zip(&curvature.mixed).enumerate() {
                    let entries = self.hessian.entries(row + s, column);
                    entries.iter_mut().zip(points).for_each(|(entry, x)| *entry += factor * x);
                    // On the diagonal the row ends before its weight.
                    if with_weights && let (Some(entry), true) = (entries.get_mut(D), a != b) {
                        *entry += factor * mixed;
                    }
                }
                if with_weights {
                    let entries = self.hessian.entries(row + D, column);
                    entries.iter_mut().zip(&curvature.mixed).for_each(|(entry, x)| *entry += factor * x);
                    if let Some(entry) = entries.get_mut(D) {
                        *entry += factor * curvature.weights;
                    }
                }
            }
        }
    }

    /// Adds what a sample adds to a right side.
    pub(super) fn add_right(&self, right: &mut [f64], sample: &Sample<D>, by: &Homogeneous<D>) {
        let blocks = right.chunks_exact_mut(self.each).skip(sample.first);
        for (block, basis) in blocks.zip(sample.basis()) {
            let (points, weight) = block.split_at_mut(D);
            points.iter_mut().zip(&by.weighted).for_each(|(sum, x)| *sum += basis * x);
            weight.iter_mut().for_each(|sum| *sum += basis * by.weight);
        }
    }

    /// Goes from control points to the unknowns of those that are tied, in a right side.
    pub(super) fn tie_right(&self, right: &mut [f64]) {
        for tied in &self.tied {
            if let Some(block) = right.chunks_exact_mut(self.each).nth(tied.index) {
                project(tied, block);
            }
        }
    }

    /// Goes from control points to the unknowns of those that are tied, in the Hessian: the first is `a`, then come
    /// some without meaning, the last is the weight.
    pub(super) fn tie(&mut self) {
        let each = self.each;
        for tied in self.tied.clone() {
            let own = tied.index * each;
            let from = tied.index.saturating_sub(self.reach) * each;
            let to = (tied.index + self.reach + 1).min(self.count) * each;
            for other in (from..to).filter(|other| !(own..own + each).contains(other)) {
                let mut block = self.column(own, other);
                project(&tied, &mut block);
                self.write(own, other, &block);
            }
            let mut whole: Vec<Vec<f64>> = (own..own + each).map(|column| self.column(own, column)).collect();
            whole.iter_mut().for_each(|column| project(&tied, column));
            for s in 0..each {
                let mut row: Vec<f64> = whole.iter().map(|column| column[s]).collect();
                project(&tied, &mut row);
                whole.iter_mut().zip(&row).for_each(|(column, x)| column[s] = *x);
            }
            for (s, column) in whole.iter().enumerate() {
                self.write(own, own + s, column);
            }
            for s in 0..each {
                let meant = (s == 0 && tied.along.is_some()) || (s == D && tied.through.is_some());
                if let (Some(entry), false) = (self.hessian.at(own + s, own + s), meant) {
                    *entry = 1.0;
                }
            }
        }
    }

    fn column(&mut self, own: usize, other: usize) -> Vec<f64> {
        (own..own + self.each).map(|row| self.hessian.at(row, other).map_or(0.0, |entry| *entry)).collect()
    }

    fn write(&mut self, own: usize, other: usize, block: &[f64]) {
        for (row, x) in (own..).zip(block) {
            if let Some(entry) = self.hessian.at(row, other) {
                *entry = *x;
            }
        }
    }

    /// Adds to one diagonal entry: unknown `slot` of a control point.
    pub(super) fn add_diagonal(&mut self, index: usize, slot: usize, x: f64) {
        let row = index * self.each + slot;
        if let Some(entry) = self.hessian.at(row, row) {
            *entry += x;
        }
    }

    pub(super) fn factor(&mut self) {
        self.hessian.factor();
    }

    pub(super) fn solve(&self, right: &mut [f64]) {
        self.hessian.solve(right);
    }

    /// The index in a right side of an unknown of a control point.
    pub(super) fn unknown(&self, index: usize, slot: usize) -> usize {
        index * self.each + slot
    }

    /// The step of the control points that belongs to one of the unknowns.
    pub(super) fn step(&self, solution: &[f64]) -> Vec<Homogeneous<D>> {
        let block = |block: &[f64]| {
            let mut weighted = [0.0; D];
            weighted.iter_mut().zip(block).for_each(|(to, from)| *to = *from);
            Homogeneous { weighted, weight: block.get(D).copied().unwrap_or(0.0) }
        };
        let mut steps: Vec<_> = solution.chunks_exact(self.each).map(block).collect();
        for tied in &self.tied {
            if let Some(step) = steps.get_mut(tied.index) {
                let reach = step.weighted.first().copied().unwrap_or(0.0);
                let weight = if tied.through.is_some() { step.weight } else { 0.0 };
                let (along, through) = (tied.along.unwrap_or([0.0; D]), tied.through.unwrap_or([0.0; D]));
                step.weight = weight;
                for ((x, along), through) in step.weighted.iter_mut().zip(&along).zip(&through) {
                    *x = reach * along + weight * through;
                }
            }
        }
        steps
    }
}

/// The derivative by the unknowns of a tied control point, from that by the point.
fn project<const D: usize>(tied: &Tied<D>, block: &mut [f64]) {
    let mut points = [0.0; D];
    points.iter_mut().zip(block.iter()).for_each(|(to, from)| *to = *from);
    let weight = block.get(D).copied().unwrap_or(0.0);
    block.fill(0.0);
    if let (Some(along), Some(first)) = (tied.along, block.first_mut()) {
        *first = dot(&along, &points);
    }
    if let (Some(through), Some(last)) = (tied.through, block.get_mut(D)) {
        *last = dot(&through, &points) + weight;
    }
}

/// Control points a part of a step further.
pub(super) fn stepped<const D: usize>(
    points: &[Homogeneous<D>],
    step: &[Homogeneous<D>],
    part: f64,
) -> Vec<Homogeneous<D>> {
    let moved = |(point, step): (&Homogeneous<D>, &Homogeneous<D>)| {
        let mut weighted = point.weighted;
        weighted.iter_mut().zip(&step.weighted).for_each(|(x, d)| *x += part * d);
        Homogeneous { weighted, weight: point.weight + part * step.weight }
    };
    points.iter().zip(step).map(moved).collect()
}
