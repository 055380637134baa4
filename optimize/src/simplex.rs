//! The simplex method of Nelder and Mead, for a handful of unknowns and costs that are not smooth.

use std::cell::{Cell, RefCell};

use argmin::core::{CostFunction, Error, Executor, State};
use argmin::solver::neldermead::NelderMead;

use crate::cost::Cost;
use crate::error::SimplexError;

/// What a candidate without a cost counts for argmin, which knows numbers only: more than any cost, and comparable.
const WORST: f64 = f64::MAX;

/// What a search found.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SimplexResult {
    /// The best candidate.
    pub best: Vec<f64>,
    /// Its cost.
    pub cost: Cost,
    /// How many candidates were evaluated.
    pub evaluations: u64,
}

/// The least `cost` that argmin's simplex method finds in at most `iterations` from the simplex of `start` and of a step in
/// each unknown in turn. It ends too when the costs of the simplex are equal to rounding.
///
/// A candidate that is infeasible or whose evaluation fails is worse than any other and never ends the search. Cost and
/// result are the same in every run.
///
/// ```
/// use optimize::{Cost, simplex};
///
/// // Rosenbrock's valley, with a wall at x = -1.5 that cannot be evaluated beyond.
/// let valley = |x: &[f64]| {
///     let (x, y) = (x[0], x[1]);
///     if x < -1.5 { Cost::Failed } else { Cost::Ok((1.0 - x).powi(2) + 100.0 * (y - x * x).powi(2)) }
/// };
/// let found = simplex(valley, &[-1.2, 1.0], &[0.5, 0.5], 400)?;
/// assert!((found.best[0] - 1.0).abs() < 1e-6 && (found.best[1] - 1.0).abs() < 1e-6);
/// # Ok::<(), optimize::SimplexError>(())
/// ```
///
/// # Errors
/// No unknowns, steps of another number, a number that is not finite or a step of zero, or no candidate with a cost.
///
/// # References
/// J. A. Nelder, R. Mead, "A simplex method for function minimization", The Computer Journal 7 (1965) 308-313,
/// <https://doi.org/10.1093/comjnl/7.4.308>.
pub fn simplex(
    cost: impl FnMut(&[f64]) -> Cost,
    start: &[f64],
    steps: &[f64],
    iterations: u64,
) -> Result<SimplexResult, SimplexError> {
    if start.is_empty() || steps.len() != start.len() {
        return Err(SimplexError::Lengths { unknowns: start.len(), steps: steps.len() });
    }
    for (index, (&value, &step)) in start.iter().zip(steps).enumerate() {
        if !(value.is_finite() && step.is_finite() && step != 0.0) {
            return Err(SimplexError::Number { index, value, step });
        }
    }
    let corners = (0..start.len()).map(|k| {
        let moved = start.iter().zip(steps).enumerate();
        moved.map(|(j, (value, step))| if j == k { value + step } else { *value }).collect()
    });
    let corners: Vec<Vec<f64>> = std::iter::once(start.to_vec()).chain(corners).collect();
    let problem = Counted { cost: RefCell::new(cost), evaluations: Cell::new(0) };
    let failed = |error: Error| SimplexError::Solver(error.to_string());
    let solver = NelderMead::new(corners).with_sd_tolerance(f64::EPSILON).map_err(failed)?;
    let executor = Executor::new(&problem, solver).configure(|state| state.max_iters(iterations));
    let result = executor.run().map_err(failed)?;
    let evaluations = problem.evaluations.get();
    let state = result.state();
    match state.get_best_param() {
        Some(best) if state.get_best_cost() < WORST => {
            Ok(SimplexResult { best: best.clone(), cost: Cost::Ok(state.get_best_cost()), evaluations })
        }
        _ => Err(SimplexError::NoCandidate { evaluations }),
    }
}

struct Counted<F> {
    cost: RefCell<F>,
    evaluations: Cell<u64>,
}

impl<F: FnMut(&[f64]) -> Cost> CostFunction for &Counted<F> {
    type Param = Vec<f64>;
    type Output = f64;

    fn cost(&self, candidate: &Vec<f64>) -> Result<f64, Error> {
        self.evaluations.set(self.evaluations.get() + 1);
        let cost = (self.cost.borrow_mut())(candidate);
        Ok(cost.checked().value().unwrap_or(WORST))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bowl_in_three_unknowns() {
        let centre = [3.0, -2.0, 0.5];
        let bowl = |x: &[f64]| Cost::Ok(x.iter().zip(centre).map(|(x, c)| (x - c) * (x - c)).sum());
        let found = simplex(bowl, &[0.0; 3], &[1.0, -1.0, 0.1], 500).expect("a minimum");
        for (x, c) in found.best.iter().zip(centre) {
            // The cost is flat to rounding within the root of the machine epsilon.
            assert!((x - c).abs() < 1e-6, "{found:?}");
        }
        assert!(found.evaluations > 10);
    }

    #[test]
    fn the_iterations_are_a_limit() {
        let mut seen = 0;
        let slope = |x: &[f64]| {
            seen += 1;
            Cost::Ok(-x[0])
        };
        let found = simplex(slope, &[0.0], &[1.0], 5).expect("better and better");
        assert!(found.evaluations <= 2 + 5 * 4 && found.best[0] > 1.0);
        assert_eq!(seen, found.evaluations);
    }

    #[test]
    fn failures_and_nan_are_worst_and_never_fatal() {
        let cliff = |x: &[f64]| match x[0] {
            x if x < 0.0 => Cost::Failed,
            x if x > 4.0 => Cost::Ok(f64::NAN),
            x => Cost::Ok((x - 3.9) * (x - 3.9)),
        };
        let found = simplex(cliff, &[-1.0], &[2.0], 200).expect("a minimum");
        assert!((found.best[0] - 3.9).abs() < 1e-6);
        let nothing = simplex(|_| Cost::Infeasible(1.0), &[0.0], &[1.0], 10);
        assert!(matches!(nothing, Err(SimplexError::NoCandidate { evaluations }) if evaluations > 0));
    }

    #[test]
    fn bad_starts_are_named() {
        let bowl = |x: &[f64]| Cost::Ok(x[0] * x[0]);
        assert_eq!(simplex(bowl, &[], &[], 9), Err(SimplexError::Lengths { unknowns: 0, steps: 0 }));
        assert_eq!(simplex(bowl, &[1.0], &[], 9), Err(SimplexError::Lengths { unknowns: 1, steps: 0 }));
        assert_eq!(
            simplex(bowl, &[1.0], &[0.0], 9),
            Err(SimplexError::Number { index: 0, value: 1.0, step: 0.0 })
        );
        assert!(matches!(simplex(bowl, &[f64::NAN], &[1.0], 9), Err(SimplexError::Number { index: 0, .. })));
    }
}
