//! The structure of the shortest train, from amplitudes on a grid of times.

use super::error::ShortestTrainError;
use super::task::{Task, Train};
use crate::programme::{Affine, Programme};

/// Instants of the grid.
const INSTANTS: usize = 81;
/// What counts as met on the grid: the accuracy of the solver.
const MET: f64 = 1e-7;
/// Bisections of the duration: to a thousandth.
const BISECTIONS: usize = 12;
/// The longest train that is looked for, in rad of the slowest mode.
const LONGEST: f64 = 200.0;

/// A train near the shortest that the grid allows, of the amplitudes that are not less than `visible` times the largest.
pub(super) fn structure(task: &Task, visible: f64) -> Result<Train, ShortestTrainError> {
    let mut longer = 2.0;
    while on_grid(task, longer).is_none_or(|(short, _)| short > MET) {
        longer *= 1.5;
        if longer > LONGEST {
            return Err(ShortestTrainError::Infeasible { longest: longer / 1.5 * task.unit });
        }
    }
    let mut shorter = 0.0;
    let mut best = None;
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (shorter + longer);
        match on_grid(task, middle) {
            Some((short, _)) if short <= MET => longer = middle,
            Some((short, train)) => {
                shorter = middle;
                // Just too short the best amplitudes are unique, and few; longer they are many ways to do it.
                best = Some((short, train));
            }
            None => shorter = middle,
        }
    }
    match best {
        Some((_, train)) => Ok(gathered(&train, visible)),
        None => Err(ShortestTrainError::NotConverged { violation: f64::INFINITY }),
    }
}

/// The amplitudes on a grid of this duration that come nearest to what is asked, and by how much they miss it.
fn on_grid(task: &Task, duration: f64) -> Option<(f64, Train)> {
    let signed = task.demand > 1.0;
    let columns = if signed { 2 * INSTANTS } else { INSTANTS };
    let miss = columns;
    let mut cost = vec![0.0; columns + 1];
    cost[miss] = 1.0;
    let mut programme = Programme::new(cost);
    let sign = |k: usize| if k < INSTANTS { 1.0 } else { -1.0 };
    let time = |k: usize| duration * (k % INSTANTS) as f64 / (INSTANTS - 1) as f64;
    let sum = |weights: &dyn Fn(usize) -> f64, constant: f64| Affine {
        terms: (0..columns).map(|k| (k, weights(k))).collect(),
        constant,
    };
    programme.zero(sum(&sign, -1.0));
    (0..=columns).for_each(|k| programme.positive(Affine { terms: vec![(k, 1.0)], constant: 0.0 }));
    if signed {
        programme.positive(sum(&|_| -1.0, task.demand));
    }
    let places = task.samples(duration, 12.0).concat();
    let weights: Vec<_> = (0..columns).map(|k| task.weights(duration - time(k), &places).values).collect();
    for (row, bound) in task.bounds(&places).into_iter().enumerate() {
        programme.cone(
            Affine { terms: vec![(miss, 1.0)], constant: bound },
            sum(&|k| weights[k][row].re * sign(k), 0.0),
            sum(&|k| weights[k][row].im * sign(k), 0.0),
        );
    }
    let x = programme.solved()?;
    let amplitudes = (0..INSTANTS).map(|k| x[k] - if signed { x[INSTANTS + k] } else { 0.0 });
    let train = Train { times: (0..INSTANTS).map(time).collect(), amplitudes: amplitudes.collect() };
    Some((x[miss].max(0.0), train))
}

/// Neighbours of one sign become one impulse, in their middle.
fn gathered(train: &Train, visible: f64) -> Train {
    let largest = train.amplitudes.iter().fold(0.0_f64, |most, a| most.max(a.abs()));
    let mut gathered = Train { times: vec![], amplitudes: vec![] };
    let mut joined = false;
    for (t, a) in train.times.iter().zip(&train.amplitudes) {
        if a.abs() < visible * largest {
            joined = false;
            continue;
        }
        match (gathered.times.last_mut(), gathered.amplitudes.last_mut()) {
            (Some(time), Some(amplitude)) if joined && *amplitude * a > 0.0 => {
                let both = *amplitude + a;
                *time = (*time * *amplitude + t * a) / both;
                *amplitude = both;
            }
            _ => {
                gathered.times.push(*t);
                gathered.amplitudes.push(*a);
            }
        }
        joined = true;
    }
    // A train starts at zero, and lasts as long as the grid.
    if let Some(first) = gathered.times.first().copied() {
        gathered.times.iter_mut().for_each(|t| *t -= first);
    }
    gathered
}
