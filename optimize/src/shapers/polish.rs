//! Times and amplitudes of the shortest train of a given structure.

use nalgebra::{DMatrix, DVector};
use profiles::Complex;

use super::task::{Place, Task, Train};
use crate::programme::{Affine, Programme};
use crate::trust::Trust;

/// Prices of a violation in units of time, one after the other until none is left: zeros of neighbouring modes are worth
/// more time than most.
const PENALTIES: [f64; 3] = [200.0, 1e4, 1e6];
/// A violation that is left to the exact solution of the zeros.
const SMALL: f64 = 1e-6;
/// Steps in rad of the slowest mode and parts of the sum of impulses.
const TRUST: Trust = Trust { first: 0.2, most: 0.5, rest: 1e-7, nothing: 1e-11, steps: 80 };

/// The shortest train near `start` that does what is asked at the zeros and at `places`, by linear programmes over its
/// times and amplitudes within a region of trust.
pub(super) fn shortened(task: &Task, start: &Train, places: &[Place]) -> Train {
    let mut train = start.clone();
    for penalty in PENALTIES {
        train = priced(task, &train, places, penalty);
        if task.violation(&train, places) <= SMALL {
            break;
        }
    }
    train
}

/// The train near `start` that is shortest if a violation costs `penalty`.
fn priced(task: &Task, start: &Train, places: &[Place], penalty: f64) -> Train {
    let merit = |train: &Train| train.duration() + penalty * task.violation(train, places).max(0.0);
    TRUST.descend(start.clone(), merit, |train, trust| stepped(task, train, places, penalty, trust))
}

/// Where the linear programme about `train` leads, and the merit that it predicts.
fn stepped(task: &Task, train: &Train, places: &[Place], penalty: f64, trust: f64) -> Option<(Train, f64)> {
    let n = train.times.len();
    // Unknowns: changes of the amplitudes, changes of the times but the first, and the violation.
    let (time, miss) = (|k: usize| n + k - 1, 2 * n - 1);
    let mut cost = vec![0.0; 2 * n];
    cost[miss] = penalty;
    if n > 1 {
        cost[time(n - 1)] = 1.0;
    }
    let mut programme = Programme::new(cost);
    let one = |k: usize, coefficient: f64, constant: f64| Affine { terms: vec![(k, coefficient)], constant };
    let sum: f64 = train.amplitudes.iter().sum();
    programme.zero(Affine { terms: (0..n).map(|k| (k, 1.0)).collect(), constant: sum - 1.0 });
    programme.positive(one(miss, 1.0, 0.0));
    let magnitudes: f64 = train.amplitudes.iter().map(|a| a.abs()).sum();
    for (k, a) in train.amplitudes.iter().enumerate() {
        programme.positive(one(k, a.signum(), a.abs()));
        programme.positive(one(k, 1.0, trust));
        programme.positive(one(k, -1.0, trust));
    }
    if task.demand > 1.0 {
        let terms = train.amplitudes.iter().enumerate().map(|(k, a)| (k, -a.signum()));
        programme.positive(Affine { terms: terms.collect(), constant: task.demand - magnitudes });
    }
    for k in 1..n {
        programme.positive(one(time(k), 1.0, trust));
        programme.positive(one(time(k), -1.0, trust));
        let mut terms = vec![(time(k), 1.0)];
        if k > 1 {
            terms.push((time(k - 1), -1.0));
        }
        programme.positive(Affine { terms, constant: train.times[k] - train.times[k - 1] });
    }
    let gradients = gradients(task, train, places);
    let sums = task.sums(train, places);
    for ((gradient, value), bound) in gradients.iter().zip(sums).zip(task.bounds(places)) {
        let part = |of: fn(Complex<f64>) -> f64| Affine {
            terms: gradient.iter().enumerate().map(|(k, g)| (k, of(*g))).collect(),
            constant: of(value),
        };
        programme.cone(one(miss, 1.0, bound), part(|z| z.re), part(|z| z.im));
    }
    let x = programme.solved()?;
    let mut next = train.clone();
    next.amplitudes.iter_mut().zip(&x).for_each(|(a, change)| *a += change);
    next.times.iter_mut().skip(1).zip(&x[n..]).for_each(|(t, change)| *t += change);
    // The solver meets the order of the times to its accuracy.
    for k in 1..n {
        next.times[k] = next.times[k].max(next.times[k - 1]);
    }
    let predicted = next.duration() + penalty * x[miss].max(0.0);
    Some((next, predicted))
}

/// The gradients of everything that is asked, by the amplitudes and by the times but the first.
fn gradients(task: &Task, train: &Train, places: &[Place]) -> Vec<Vec<Complex<f64>>> {
    let n = train.times.len();
    let mut gradients = vec![vec![Complex::default(); 2 * n - 1]; task.zeros() + places.len()];
    for (k, (t, a)) in train.times.iter().zip(&train.amplitudes).enumerate() {
        let weights = task.weights(train.duration() - t, places);
        for ((gradient, value), slope) in gradients.iter_mut().zip(weights.values).zip(weights.slopes) {
            gradient[k] = value;
            // Less time is left after a later impulse, and more where the last one is later.
            if k > 0 {
                gradient[n + k - 1] -= slope * *a;
            }
            if n > 1 {
                gradient[2 * n - 2] += slope * *a;
            }
        }
    }
    gradients
}

/// Takes the zeros to rounding by the smallest change of times and amplitudes (Newton's method with the least norm).
pub(super) fn with_exact_zeros(task: &Task, start: &Train) -> Train {
    let mut train = start.clone();
    let n = train.times.len();
    let residuals = |train: &Train| {
        let zeros = task.sums(train, &[]).into_iter().flat_map(|value| [value.re, value.im]);
        let sum: f64 = train.amplitudes.iter().sum();
        DVector::from_iterator(2 * task.zeros() + 1, zeros.chain([sum - 1.0]))
    };
    let mut best = residuals(&train).amax();
    for _ in 0..8 {
        let gradients = gradients(task, &train, &[]);
        let rows = 2 * gradients.len() + 1;
        let jacobian = DMatrix::from_fn(rows, 2 * n - 1, |row, column| match gradients.get(row / 2) {
            Some(gradient) if row % 2 == 0 => gradient[column].re,
            Some(gradient) => gradient[column].im,
            None => f64::from(u8::from(column < n)),
        });
        let Some(svd) = jacobian.try_svd(true, true, f64::EPSILON, 1000) else { break };
        let Ok(step) = svd.solve(&residuals(&train), 1e-12) else { break };
        let mut next = train.clone();
        next.amplitudes.iter_mut().zip(step.iter()).for_each(|(a, change)| *a -= change);
        next.times.iter_mut().skip(1).zip(step.iter().skip(n)).for_each(|(t, change)| *t -= change);
        let left = residuals(&next).amax();
        if left >= best || left.is_nan() || !next.times.is_sorted() {
            break;
        }
        (train, best) = (next, left);
    }
    train
}
