//! The swarm with a genetic pool as a solver of argmin.

use argmin::argmin_error;
use argmin::core::{CostFunction, Error, Problem, Solver, TerminationStatus};
use profiles::Interval;

use super::config::GeneticOptions;
use super::core::Breeding;
use crate::cost::Cost;
use crate::error::SwarmError;
use crate::swarm::{Population, Reported, evaluate, terminate};

/// A particle swarm whose worse part breeds: [`Breeding`] run by argmin, one generation of particles and children per
/// iteration.
///
/// The cost is any `CostFunction` of `Vec<f64>` whose output is an `f64` or a [`Cost`]; an error from it is a
/// [`Cost::Failed`] and the search goes on. Evaluations run on the current rayon pool, with the same result on any
/// number of threads. The best cost of argmin's state is infinite as long as nothing feasible has been found, and its
/// count of evaluations goes on after a resume.
///
/// ```
/// use argmin::core::{CostFunction, Error, Executor, State};
/// use optimize::{GeneticOptions, GeneticSwarm};
/// use profiles::Interval;
///
/// struct Sphere;
/// impl CostFunction for Sphere {
///     type Param = Vec<f64>;
///     type Output = f64;
///     fn cost(&self, x: &Vec<f64>) -> Result<f64, Error> {
///         Ok(x.iter().map(|x| x * x).sum())
///     }
/// }
///
/// let bounds = [Interval::new(-5.0, 5.0); 3];
/// for options in [
///     GeneticOptions::new(40, 200),
///     GeneticOptions { pool: 0.0, ..GeneticOptions::new(40, 200) },
///     GeneticOptions::genetic(40, 600),
/// ] {
///     let result = Executor::new(Sphere, GeneticSwarm::new(&bounds, options, 1)?).run()?;
///     assert!(result.state().get_best_cost() < 1e-3);
/// }
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct GeneticSwarm {
    search: Breeding,
    sequential: bool,
    /// Room for the costs of a generation.
    #[cfg_attr(feature = "serde", serde(skip))]
    costs: Vec<Cost>,
}

impl From<Breeding> for GeneticSwarm {
    /// A solver that goes on with a search, told or not.
    fn from(search: Breeding) -> Self {
        Self { search, sequential: false, costs: Vec::new() }
    }
}

impl GeneticSwarm {
    /// A solver with a new population.
    ///
    /// # Errors
    /// As [`Breeding::new`].
    pub fn new(bounds: &[Interval], options: GeneticOptions, seed: u64) -> Result<Self, SwarmError> {
        Breeding::new(bounds, options, seed).map(Self::from)
    }

    /// The same, evaluating on the calling thread: faster for a cost of a few microseconds or less.
    #[must_use]
    pub fn sequential(self) -> Self {
        Self { sequential: true, ..self }
    }

    /// The search, with its history.
    #[must_use]
    pub fn search(&self) -> &Breeding {
        &self.search
    }

    /// Evaluates one generation, or what is left of it, and reports it.
    fn generation<O>(&mut self, problem: &mut Problem<O>, state: Population) -> Result<Reported, Error>
    where
        O: CostFunction<Param = Vec<f64>> + Sync,
        O::Output: Into<Cost>,
    {
        let Some(function) = problem.problem.as_ref() else {
            return Err(argmin_error!(NotInitialized, "`GeneticSwarm`: there is no problem to solve"));
        };
        loop {
            evaluate(function, self.search.ask(), self.sequential, &mut self.costs);
            if self.search.tell(&self.costs)?.is_some() {
                return Ok(self.report(problem, state));
            }
        }
    }

    /// Writes the best of the search into argmin's state.
    fn report<O>(&self, problem: &mut Problem<O>, state: Population) -> Reported {
        // Not added to: after a resume argmin counts from zero, the search does not.
        problem.counts.insert("cost_count", self.search.evaluations());
        self.search.swarm().report(state)
    }
}

impl<O> Solver<O, Population> for GeneticSwarm
where
    O: CostFunction<Param = Vec<f64>> + Sync,
    O::Output: Into<Cost>,
{
    fn name(&self) -> &'static str {
        "genetic particle swarm"
    }

    fn init(&mut self, problem: &mut Problem<O>, state: Population) -> Result<Reported, Error> {
        // A search that was stepped before goes on from where it is.
        if self.search.history().is_empty() {
            self.generation(problem, state)
        } else {
            Ok(self.report(problem, state))
        }
    }

    fn next_iter(&mut self, problem: &mut Problem<O>, state: Population) -> Result<Reported, Error> {
        self.generation(problem, state)
    }

    fn terminate(&mut self, _state: &Population) -> TerminationStatus {
        terminate(self.search.stop())
    }
}
