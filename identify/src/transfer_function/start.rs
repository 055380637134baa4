//! Where the search starts: least squares on filtered data, refined by instruments.

use faer::{Mat, linalg::solvers::Solve};

use super::Hold;
use super::fit::{Model, Problem};
use super::roots::{monic, roots};
use crate::least_squares::{back_substitute, triangle};

/// Models from filters of every bandwidth the record can hold, the best first.
///
/// The equation `A y = B u`, filtered by `1/F`, is linear in the coefficients. With `F` of one guessed bandwidth its
/// least squares give a first model; with `F = A` of the last model and the output of that model as instrument, noise
/// no longer pulls the estimate (simplified refined instrumental variable).
///
/// # References
/// P. C. Young, "Recursive Estimation and Time-Series Analysis", 2nd ed., Springer, 2011,
/// doi:10.1007/978-3-642-21981-8; H. Garnier, L. Wang (eds.), "Identification of Continuous-time Models from Sampled
/// Data", Springer, 2008, doi:10.1007/978-1-84800-161-9.
pub(super) fn starts(problem: &Problem<'_>) -> Vec<Model> {
    const FASTEST: f64 = 1.5;
    const MOST: usize = 12;
    const ROUNDS: usize = 5;
    let slowest = 2.0 / problem.samples() as f64;
    let count = (((FASTEST / slowest).log2() / 0.8).ceil() as usize).clamp(2, MOST);
    let ratio = (FASTEST / slowest).powf(1.0 / (count - 1) as f64);
    let mut found: Vec<Model> = (0..count)
        .filter_map(|k| {
            let step = slowest * ratio.powi(k as i32);
            let filter = monic(&vec![profiles::Complex::new(-1.0, 0.0); problem.options.poles]);
            let mut best: Option<Model> = None;
            let mut next = regression(problem, &filter, step, None);
            for _ in 0..ROUNDS {
                let Some(model) = next.and_then(|a| nearest(problem, a, step)) else { break };
                if best.as_ref().is_some_and(|best| model.square > 0.999 * best.square) {
                    break;
                }
                next = problem
                    .simulated(&model)
                    .and_then(|output| regression(problem, &stable(&model.a)?, step, Some(&output)));
                best = Some(model);
            }
            best
        })
        .collect();
    found.sort_by(|a, b| a.square.total_cmp(&b.square));
    found
}

/// The better of the model of a denominator and of its mirror image in the left half plane.
fn nearest(problem: &Problem<'_>, a: Vec<f64>, step: f64) -> Option<Model> {
    let mirrored = stable(&a).filter(|mirrored| *mirrored != a).and_then(|a| problem.model(a, step));
    match (problem.model(a, step), mirrored) {
        (Some(model), Some(mirrored)) if mirrored.square < model.square => Some(mirrored),
        (model, mirrored) => model.or(mirrored),
    }
}

/// The denominator with its poles in the left half plane; untouched if they are.
fn stable(a: &[f64]) -> Option<Vec<f64>> {
    let all: Vec<f64> = a.iter().copied().chain([1.0]).collect();
    let mut poles = roots(&all)?;
    if poles.iter().all(|pole| pole.re < 0.0) {
        return Some(a.to_vec());
    }
    // On the axis a filter would ring for good.
    poles.iter_mut().for_each(|pole| pole.re = -pole.re.abs().max(1e-3 * pole.norm()));
    Some(monic(&poles))
}

/// The denominator that obeys the filtered equation best, with the noise-free output as instrument if there is one.
fn regression(
    problem: &Problem<'_>,
    filter: &[f64],
    step: f64,
    instrument: Option<&[f64]>,
) -> Option<Vec<f64>> {
    let (n, samples) = (filter.len(), problem.samples());
    let output = problem.filtered(filter, step, problem.output, Hold::First)?;
    let others = {
        let mut others: Vec<f64> = problem
            .filtered(filter, step, problem.input, problem.options.hold)?
            .into_iter()
            .take(problem.options.zeros + 1)
            .flatten()
            .collect();
        if problem.options.initial_state {
            others.extend(problem.freed(filter, step)?.iter().take(n).flatten());
        }
        if problem.options.offset {
            others.extend(
                problem.filtered(filter, step, &vec![1.0; samples], Hold::Zero)?.iter().take(1).flatten(),
            );
        }
        others
    };
    let with = |y: &[Vec<f64>]| -> Vec<f64> {
        y.iter().take(n).flatten().map(|y| -y).chain(others.iter().copied()).collect()
    };
    let goal = output.get(n)?;
    let columns = with(&output);
    let size = columns.len() / samples;
    let solution = match instrument {
        None => {
            let mut entries = columns;
            entries.extend_from_slice(goal);
            back_substitute(&triangle(&entries, samples), 0, size, size)?
        }
        Some(instrument) => {
            let instruments = with(&problem.filtered(filter, step, instrument, Hold::First)?);
            let scaled = |entries: &[f64], i: usize| {
                let column = &entries[i * samples..(i + 1) * samples];
                let norm = column.iter().map(|x| x * x).sum::<f64>().sqrt().max(f64::MIN_POSITIVE);
                column.iter().map(|x| x / norm).collect::<Vec<f64>>()
            };
            let z: Vec<Vec<f64>> = (0..size).map(|i| scaled(&instruments, i)).collect();
            let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
            let matrix =
                Mat::from_fn(size, size, |i, j| dot(&z[i], &columns[j * samples..(j + 1) * samples]));
            let right = Mat::from_fn(size, 1, |i, _| dot(&z[i], goal));
            let solution = matrix.partial_piv_lu().solve(right);
            (0..size).map(|i| solution[(i, 0)]).collect()
        }
    };
    solution.iter().all(|x| x.is_finite()).then(|| solution.into_iter().take(n).collect())
}
