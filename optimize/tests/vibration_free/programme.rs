//! The optimum against a linear programme that knows nothing of switches: jerk constant in equal intervals, limits at the
//! grid.

use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettings, DefaultSolver, IPSolver, SolverStatus, SupportedConeT};
use optimize::vibration_free::Robustness;
use profiles::{Complex, Interval, Profile};
use proptest::prelude::*;

use super::tasks::{Task, a_task, config, zeros};

/// Rows `expression >= 0` or `= 0`, as triplets.
#[derive(Default)]
struct Rows {
    entries: Vec<(usize, usize, f64)>,
    constants: Vec<f64>,
}

impl Rows {
    fn add(&mut self, constant: f64, terms: &[(usize, f64)]) {
        let row = self.constants.len();
        self.entries.extend(terms.iter().map(|&(column, value)| (row, column, value)));
        self.constants.push(constant);
    }
}

/// How far the axis gets in `duration`, as a part of the distance, with `n` equal intervals; unknown are jerk, acceleration
/// and velocity at every grid point, each as a part of what a jerk of one makes of it.
pub(crate) fn reached(task: &Task, robustness: Robustness, duration: f64, n: usize) -> f64 {
    let limits = if task.distance < 0.0 { task.limits.mirrored() } else { task.limits };
    let dt = duration / n as f64;
    let j_unit = limits.jerk().magnitude();
    let (a_unit, v_unit) = (j_unit * duration, j_unit * duration * duration);
    let h = 1.0 / n as f64;
    let (j, a, v) = (|k: usize| k, |k: usize| n + k, |k: usize| 2 * n + 1 + k);
    let mut equal = Rows::default();
    for k in [0, n] {
        equal.add(0.0, &[(a(k), 1.0)]);
        equal.add(0.0, &[(v(k), 1.0)]);
    }
    for k in 0..n {
        equal.add(0.0, &[(a(k + 1), 1.0), (a(k), -1.0), (j(k), -h)]);
        equal.add(0.0, &[(v(k + 1), 1.0), (v(k), -1.0), (a(k), -h), (j(k), -0.5 * h * h)]);
    }
    for mode in &task.modes {
        let p = mode.pole();
        // The primitives of e^(p s) and s e^(p s), with s the time left.
        let plain = |s: f64| (p * s).exp() / p;
        let slope = |s: f64| (p * s).exp() * (p * s - 1.0) / (p * p);
        let ends = |k: usize| (duration - dt * k as f64, duration - dt * (k as f64 + 1.0));
        let mut row = |of: &dyn Fn(usize) -> f64| {
            let terms: Vec<_> = (0..n).map(|k| (j(k), of(k))).collect();
            let largest = terms.iter().map(|term| term.1.abs()).fold(0.0, f64::max);
            equal.add(0.0, &terms.iter().map(|&(k, value)| (k, value / largest)).collect::<Vec<_>>());
        };
        let first = |k: usize| -> Complex<f64> { plain(ends(k).0) - plain(ends(k).1) };
        let second = |k: usize| -> Complex<f64> { slope(ends(k).0) - slope(ends(k).1) };
        row(&|k| first(k).re);
        row(&|k| first(k).im);
        if robustness == Robustness::DoubleZero {
            row(&|k| second(k).re);
            row(&|k| second(k).im);
        }
    }
    let mut positive = Rows::default();
    let mut keep = |index: usize, bounds: Interval, unit: f64| {
        if bounds.upper.is_finite() {
            positive.add(bounds.upper / unit, &[(index, -1.0)]);
        }
        if bounds.lower.is_finite() {
            positive.add(-bounds.lower / unit, &[(index, 1.0)]);
        }
    };
    for k in 0..n {
        keep(j(k), limits.jerk(), j_unit);
        if k > 0 {
            keep(a(k), limits.acceleration(), a_unit);
            keep(v(k), limits.velocity(), v_unit);
        }
    }
    // The way, as a part of the distance: v_k h + a_k h^2 / 2 + j_k h^3 / 6, summed.
    let unit = v_unit * duration / task.distance.abs();
    let mut cost = vec![0.0; 3 * n + 2];
    for k in 0..n {
        cost[j(k)] = -unit * h * h * h / 6.0;
        cost[a(k)] = -unit * h * h / 2.0;
        cost[v(k)] = -unit * h;
    }
    let first = equal.constants.len();
    let columns = cost.len();
    let (mut i, mut k, mut values) = (vec![], vec![], vec![]);
    let shifted = positive.entries.iter().map(|&(row, column, value)| (row + first, column, value));
    for (row, column, value) in equal.entries.iter().copied().chain(shifted) {
        i.push(row);
        k.push(column);
        values.push(-value);
    }
    let right: Vec<f64> = equal.constants.iter().chain(&positive.constants).copied().collect();
    let cones =
        [SupportedConeT::ZeroConeT(first), SupportedConeT::NonnegativeConeT(positive.constants.len())];
    let matrix = CscMatrix::new_from_triplets(right.len(), columns, i, k, values);
    let settings = DefaultSettings { verbose: false, max_threads: 1, ..DefaultSettings::default() };
    let none = CscMatrix::zeros((columns, columns));
    let mut solver =
        DefaultSolver::new(&none, &cost, &matrix, &right, &cones, settings).expect("a programme");
    solver.solve();
    match solver.solution.status {
        SolverStatus::Solved | SolverStatus::AlmostSolved => -solver.solution.obj_val,
        // Too short a time for the zeros of a grid.
        _ => 0.0,
    }
}

/// No longer than the programme's, but for `part` of it; the grid itself costs less than `grid`.
fn no_longer(
    task: &Task,
    robustness: Robustness,
    n: usize,
    part: f64,
    grid: f64,
) -> Result<(), TestCaseError> {
    let planned = task.planned(robustness)?.duration();
    // Where a programme gets there in less time there is a shorter move than the planned one.
    let early = reached(task, robustness, planned / (1.0 + part), n);
    prop_assert!(early < 1.0, "planned {planned}, on a grid {early} of the distance in {part} less");
    // And it does get there in a little more.
    let late = reached(task, robustness, planned * (1.0 + grid), n);
    prop_assert!(late >= 1.0, "planned {planned}, on a grid {late} of the distance in {grid} more");
    Ok(())
}

fn rows() -> [Task; 6] {
    let task = |distance, modes: &[(f64, f64)]| Task::new(distance, [0.5, 5.0, 200.0], modes);
    [
        task(0.1, &[(8.0, 0.02)]),
        task(0.1, &[(20.0, 0.02)]),
        task(0.02, &[(12.0, 0.05)]),
        task(0.1, &[(8.0, 0.02), (18.4, 0.02)]),
        task(0.1, &[(20.0, 0.02), (46.0, 0.02)]),
        task(0.02, &[(12.0, 0.05), (27.6, 0.05)]),
    ]
}

#[test]
fn published_moves_are_no_longer_than_on_a_coarse_grid() {
    for task in rows() {
        for robustness in [Robustness::None, Robustness::DoubleZero] {
            no_longer(&task, robustness, 200, 1e-3, 2e-3).expect("no longer");
        }
    }
}

#[test]
#[cfg_attr(debug_assertions, ignore = "seconds for each of the moves, minutes where others work too")]
fn published_moves_are_no_longer_than_on_a_grid_of_two_thousand() {
    for task in rows() {
        for robustness in [Robustness::None, Robustness::DoubleZero] {
            no_longer(&task, robustness, 2000, 1e-3, 1e-4).expect("no longer");
        }
    }
}

proptest! {
    #![proptest_config(config(16))]

    #[test]
    fn random_moves_are_no_longer_than_on_a_coarse_grid(task in a_task(2, true), robustness in zeros()) {
        no_longer(&task, robustness, 200, 1e-3, 1e-2)?;
    }
}
