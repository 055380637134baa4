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

    /// The furthest motion in the sum of `cells`, its jerk constant in each of them.
    ///
    /// Unknown are jerk, acceleration and velocity at the grid. Acceleration is linear in a cell, so that its limit holds;
    /// velocity is a parabola whose middle Bernstein coefficient is kept within the limit too, so that it holds in between.
    pub(super) fn furthest(task: &Task, cells: Vec<f64>) -> Option<Self> {
        let n = cells.len();
        let moves = task.goal.distance.is_some();
        let (j, a, v) = (|k: usize| k, |k: usize| n + k - 1, |k: usize| 2 * n - 1 + k - 1);
        let unknowns = if moves { 3 * n - 2 } else { 3 * n - 1 };
        // Full jerk and the middle cell as units.
        let unit = cells.iter().sum::<f64>() / n as f64;
        let j_unit = task.full_jerk();
        let (a_unit, v_unit, x_unit) = (j_unit * unit, j_unit * unit.powi(2), j_unit * unit.powi(3));
        let steps: Vec<f64> = cells.iter().map(|cell| cell / unit).collect();
        let from = task.from / v_unit;
        let mut cost = vec![0.0; unknowns];
        if moves {
            for (k, d) in steps.iter().enumerate() {
                cost[j(k)] -= d.powi(3) / 6.0;
                if k > 0 {
                    cost[a(k)] -= d * d / 2.0;
                    cost[v(k)] -= d;
                }
            }
        } else {
            cost[v(n)] = -1.0;
        }
        let mut programme = Programme::new(cost);
        for (k, d) in steps.iter().enumerate() {
            let mut slope = Affine { terms: vec![(j(k), *d)], constant: 0.0 };
            let mut rise = Affine { terms: vec![(j(k), 0.5 * d * d)], constant: 0.0 };
            if k > 0 {
                slope.terms.push((a(k), 1.0));
                rise.terms.extend([(a(k), *d), (v(k), 1.0)]);
            } else {
                rise.constant += from;
            }
            if k + 1 < n {
                slope.terms.push((a(k + 1), -1.0));
            }
            if k + 1 < n || !moves {
                rise.terms.push((v(k + 1), -1.0));
            } else {
                rise.constant -= task.goal.velocity / v_unit;
            }
            programme.zero(slope);
            programme.zero(rise);
        }
        for zero in &task.zeros {
            for terms in responses(zero.pole(), &cells, zero.is_double()) {
                programme.zero(Affine { terms, constant: 0.0 });
            }
        }
        for Place { pole, tolerated } in &task.places {
            let factor = j_unit / tolerated;
            let scaled = |terms: Vec<(usize, f64)>| Affine {
                terms: terms.into_iter().map(|(k, c)| (k, c * factor)).collect(),
                constant: 0.0,
            };
            let mut rows = responses(*pole, &cells, false).into_iter().map(scaled);
            let (re, im) = (rows.next().unwrap_or_default(), rows.next().unwrap_or_default());
            programme.cone(Affine { terms: vec![], constant: 1.0 }, re, im);
        }
        let mut within = |terms: &[(usize, f64)], bounds: Interval, unit: f64| {
            if bounds.upper.is_finite() {
                let terms = terms.iter().map(|(k, c)| (*k, -c)).collect();
                programme.positive(Affine { terms, constant: bounds.upper / unit });
            }
            if bounds.lower.is_finite() {
                programme.positive(Affine { terms: terms.to_vec(), constant: -bounds.lower / unit });
            }
        };
        for (k, d) in steps.iter().enumerate() {
            within(&[(j(k), 1.0)], task.jerk, j_unit);
            if k > 0 {
                within(&[(a(k), 1.0)], task.acceleration, a_unit);
                within(&[(v(k), 1.0)], task.velocity, v_unit);
                within(&[(v(k), 1.0), (a(k), 0.5 * d)], task.velocity, v_unit);
            }
        }
        let (x, value) = programme.solved_to(1e-8)?;
        let first = steps.first().copied().unwrap_or(0.0);
        let jerk = x.iter().take(n).map(|j| j * j_unit).collect();
        let reached = if moves { (from * first - value) * x_unit } else { -value * v_unit - task.from };
        Some(Self { cells, jerk, reached })
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
