//! The structure of the optimum, by a linear programme on a grid of time.

use profiles::switched::Arc;
use profiles::{Complex, Interval};

use super::task::{Place, Task};
use crate::programme::{Affine, Programme};

/// Jerk on a grid.
#[derive(Debug, Clone)]
pub(super) struct OnGrid {
    /// Length of each cell.
    pub(super) cells: Vec<f64>,
    /// Jerk of each cell.
    pub(super) jerk: Vec<f64>,
    /// Distance (change of velocity) that is reached; one is asked.
    pub(super) reached: f64,
}

impl OnGrid {
    /// The cells as arcs.
    pub(super) fn arcs(&self) -> Vec<Arc> {
        self.jerk.iter().zip(&self.cells).map(|(jerk, cell)| Arc { jerk: *jerk, duration: *cell }).collect()
    }

    /// The furthest motion in the sum of `cells` (the largest change of velocity), its jerk constant in each of them.
    ///
    /// Unknown are jerk, acceleration and velocity at the grid. Acceleration is linear in a cell, so that its limit holds;
    /// velocity is a parabola whose middle Bernstein coefficient is kept within the limit too, so that it holds in between.
    pub(super) fn furthest(task: &Task, cells: Vec<f64>) -> Option<Self> {
        let layout = Layout::of(task, &cells);
        let mut programme = Programme::new(layout.cost());
        layout.add_dynamics(&mut programme);
        add_zeros(task, &cells, layout.j_unit, &mut programme);
        layout.add_limits(&mut programme);
        let (x, value) = programme.solved_to(1e-8)?;
        let jerk = x.iter().take(cells.len()).map(|j| j * layout.j_unit).collect();
        let reached = layout.reached(value);
        Some(Self { cells, jerk, reached })
    }
}

/// The unknowns of the programme, with full jerk and the mean cell as units.
struct Layout<'a> {
    task: &'a Task,
    /// Lengths of the cells.
    steps: Vec<f64>,
    /// Length of the mean cell.
    unit: f64,
    j_unit: f64,
    /// Whether the way is given, and the velocity at the start. Where it is free it is this velocity that is sought: that at
    /// the end may lie on its limit.
    moves: bool,
}

impl<'a> Layout<'a> {
    fn of(task: &'a Task, cells: &[f64]) -> Self {
        let unit = cells.iter().sum::<f64>() / cells.len() as f64;
        let steps = cells.iter().map(|cell| cell / unit).collect();
        Self { task, steps, unit, j_unit: task.full_jerk(), moves: task.goal.distance.is_some() }
    }

    fn a_unit(&self) -> f64 {
        self.j_unit * self.unit
    }

    fn v_unit(&self) -> f64 {
        self.a_unit() * self.unit
    }

    fn from(&self) -> f64 {
        self.task.from / self.v_unit()
    }

    /// Index of the jerk of a cell.
    fn j(k: usize) -> usize {
        k
    }

    /// Index of the acceleration at the start of a cell but the first.
    fn a(&self, k: usize) -> usize {
        self.steps.len() + k - 1
    }

    /// Index of the velocity at the start of a cell; of the first one, where it is sought.
    fn v(&self, k: usize) -> usize {
        let n = self.steps.len();
        if k == 0 { 3 * n - 2 } else { 2 * n - 1 + k - 1 }
    }

    /// The way with the other sign, but for what the velocity at the start makes of it in the first cell; or that velocity.
    fn cost(&self) -> Vec<f64> {
        let n = self.steps.len();
        if !self.moves {
            let mut cost = vec![0.0; 3 * n - 1];
            cost[self.v(0)] = 1.0;
            return cost;
        }
        let mut cost = vec![0.0; 3 * n - 2];
        for (k, d) in self.steps.iter().enumerate() {
            cost[Self::j(k)] -= d.powi(3) / 6.0;
            if k > 0 {
                cost[self.a(k)] -= d * d / 2.0;
                cost[self.v(k)] -= d;
            }
        }
        cost
    }

    /// The distance, or the change of velocity, for a minimum of the cost.
    fn reached(&self, minimum: f64) -> f64 {
        if self.moves {
            let first = self.steps.first().copied().unwrap_or(0.0);
            (self.from() * first - minimum) * self.v_unit() * self.unit
        } else {
            self.task.goal.velocity - minimum * self.v_unit()
        }
    }

    /// Acceleration and velocity follow from the jerk, to rest at the end.
    fn add_dynamics(&self, programme: &mut Programme) {
        let n = self.steps.len();
        for (k, d) in self.steps.iter().enumerate() {
            let mut slope = Affine { terms: vec![(Self::j(k), *d)], constant: 0.0 };
            let mut rise = Affine { terms: vec![(Self::j(k), 0.5 * d * d)], constant: 0.0 };
            if k > 0 {
                slope.terms.push((self.a(k), 1.0));
                rise.terms.extend([(self.a(k), *d), (self.v(k), 1.0)]);
            } else if self.moves {
                rise.constant += self.from();
            } else {
                rise.terms.push((self.v(0), 1.0));
            }
            if k + 1 < n {
                slope.terms.push((self.a(k + 1), -1.0));
                rise.terms.push((self.v(k + 1), -1.0));
            } else {
                rise.constant -= self.task.goal.velocity / self.v_unit();
            }
            programme.zero(slope);
            programme.zero(rise);
        }
    }

    fn add_limits(&self, programme: &mut Programme) {
        let mut within = |terms: &[(usize, f64)], bounds: Interval, unit: f64| {
            if bounds.upper.is_finite() {
                let terms = terms.iter().map(|(k, c)| (*k, -c)).collect();
                programme.positive(Affine { terms, constant: bounds.upper / unit });
            }
            if bounds.lower.is_finite() {
                programme.positive(Affine { terms: terms.to_vec(), constant: -bounds.lower / unit });
            }
        };
        let Task { velocity, acceleration, jerk, .. } = self.task;
        for (k, d) in self.steps.iter().enumerate() {
            within(&[(Self::j(k), 1.0)], *jerk, self.j_unit);
            if k > 0 {
                within(&[(self.a(k), 1.0)], *acceleration, self.a_unit());
                within(&[(self.v(k), 1.0)], *velocity, self.v_unit());
                within(&[(self.v(k), 1.0), (self.a(k), 0.5 * d)], *velocity, self.v_unit());
            }
        }
    }
}

/// Nothing is left of the zeros, and of the bands no more than is tolerated.
fn add_zeros(task: &Task, cells: &[f64], j_unit: f64, programme: &mut Programme) {
    for zero in &task.zeros {
        for terms in responses(zero.pole(), cells, zero.is_double()) {
            programme.zero(Affine { terms, constant: 0.0 });
        }
    }
    for Place { pole, tolerated } in &task.places {
        let factor = j_unit / tolerated;
        let scaled = |terms: Vec<(usize, f64)>| Affine {
            terms: terms.into_iter().map(|(k, c)| (k, c * factor)).collect(),
            constant: 0.0,
        };
        let mut rows = responses(*pole, cells, false).into_iter().map(scaled);
        let (re, im) = (rows.next().unwrap_or_default(), rows.next().unwrap_or_default());
        programme.cone(Affine { terms: vec![], constant: 1.0 }, re, im);
    }
}

/// What a jerk of one in each cell adds to the response of a pole at the end, real and imaginary part, and to its
/// derivative, scaled.
fn responses(pole: Complex<f64>, cells: &[f64], double: bool) -> Vec<Vec<(usize, f64)>> {
    let duration: f64 = cells.iter().sum();
    let mut rows = vec![vec![]; if double { 4 } else { 2 }];
    let mut rest = duration;
    for (k, d) in cells.iter().enumerate() {
        rest -= d;
        let turn = (pole * d).exp();
        let later = (pole * rest).exp();
        let phi = (turn - 1.0) / pole;
        // integral of s e^(p s), with s the time left, over a cell that ends the motion
        let ramp = (turn * (pole * d - 1.0) + 1.0) / (pole * pole);
        let first = later * phi;
        let second = later * (phi * rest + ramp) / duration;
        for (row, value) in rows.iter_mut().zip([first.re, first.im, second.re, second.im]) {
            row.push((k, value));
        }
    }
    rows
}
