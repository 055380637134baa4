//! The swarm as a solver of argmin.

use argmin::core::{
    CostFunction, Error, KV, PopulationState, Problem, Solver, TerminationReason, TerminationStatus,
};
use argmin::{argmin_error, kv};
use profiles::Interval;
use rayon::prelude::*;

use super::config::{Stop, SwarmOptions};
use super::core::Swarm;
use crate::cost::Cost;
use crate::error::SwarmError;

/// A [`Swarm`] run by argmin, with its executor's observers, time limit and checkpoints.
///
/// The cost is any `CostFunction` of `Vec<f64>` whose output is an `f64` or a [`Cost`]; an error from it is a
/// [`Cost::Failed`] and the search goes on. Evaluations run on the current rayon pool, with the same result on any
/// number of threads. The best cost of argmin's state is infinite as long as nothing feasible has been found, and its
/// count of evaluations goes on after a resume.
///
/// ```
/// use argmin::core::{CostFunction, Error, Executor, State};
/// use optimize::{ParticleSwarm, SwarmOptions};
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
/// let solver = ParticleSwarm::new(&[Interval::new(-5.0, 5.0); 3], SwarmOptions::new(40, 100), 1)?;
/// let result = Executor::new(Sphere, solver).run()?;
/// assert!(result.state().get_best_cost() < 1e-6);
/// assert_eq!(result.solver.swarm().evaluations(), 101 * 40);
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ParticleSwarm {
    swarm: Swarm,
    sequential: bool,
    /// Room for the costs of a generation.
    #[cfg_attr(feature = "serde", serde(skip))]
    costs: Vec<Cost>,
}

impl From<Swarm> for ParticleSwarm {
    /// A solver that goes on with a swarm, told or not.
    fn from(swarm: Swarm) -> Self {
        Self { swarm, sequential: false, costs: Vec::new() }
    }
}

impl ParticleSwarm {
    /// A solver with a new swarm.
    ///
    /// # Errors
    /// As [`Swarm::new`].
    pub fn new(bounds: &[Interval], options: SwarmOptions, seed: u64) -> Result<Self, SwarmError> {
        Swarm::new(bounds, options, seed).map(Self::from)
    }

    /// The same, evaluating on the calling thread: faster for a cost of a few microseconds or less.
    #[must_use]
    pub fn sequential(self) -> Self {
        Self { sequential: true, ..self }
    }

    /// The swarm, with its history.
    #[must_use]
    pub fn swarm(&self) -> &Swarm {
        &self.swarm
    }

    /// Evaluates one generation and reports it.
    fn generation<O>(&mut self, problem: &mut Problem<O>, state: Population) -> Result<Reported, Error>
    where
        O: CostFunction<Param = Vec<f64>> + Sync,
        O::Output: Into<Cost>,
    {
        let Some(function) = problem.problem.as_ref() else {
            return Err(argmin_error!(NotInitialized, "`ParticleSwarm`: there is no problem to solve"));
        };
        evaluate(function, self.swarm.ask(), self.sequential, &mut self.costs);
        self.swarm.tell(&self.costs)?;
        Ok(self.report(problem, state))
    }

    /// Writes the best of the swarm into argmin's state.
    fn report<O>(&self, problem: &mut Problem<O>, state: Population) -> Reported {
        // Not added to: after a resume argmin counts from zero, the swarm does not.
        problem.counts.insert("cost_count", self.swarm.evaluations());
        self.swarm.report(state)
    }
}

impl Swarm {
    /// Writes the best into argmin's state, and the last generation into its log.
    pub(crate) fn report(&self, mut state: Population) -> Reported {
        let (position, cost) = self.best();
        if cost != Cost::Failed {
            let mut individual = state.take_prev_individual().unwrap_or_default();
            individual.clear();
            individual.extend_from_slice(position);
            state = state.individual(individual).cost(cost.value().unwrap_or(f64::INFINITY));
        }
        let log = self.history().last().map(|progress| {
            let failed = progress.failed as u64;
            kv!("spread" => progress.spread; "failed" => failed;)
        });
        (state, log)
    }
}

/// The costs of candidates, on the current rayon pool or on this thread.
pub(crate) fn evaluate<O>(function: &O, candidates: &[Vec<f64>], sequential: bool, costs: &mut Vec<Cost>)
where
    O: CostFunction<Param = Vec<f64>> + Sync,
    O::Output: Into<Cost>,
{
    let cost = |x: &Vec<f64>| function.cost(x).map_or(Cost::Failed, Into::into);
    costs.resize(candidates.len(), Cost::Failed);
    if sequential {
        costs.iter_mut().zip(candidates).for_each(|(slot, x)| *slot = cost(x));
    } else {
        costs.par_iter_mut().zip(candidates).for_each(|(slot, x)| *slot = cost(x));
    }
}

/// Why a search is over, as argmin says it.
pub(crate) fn terminate(stop: Option<Stop>) -> TerminationStatus {
    let reason = match stop {
        None => return TerminationStatus::NotTerminated,
        Some(Stop::Target) => TerminationReason::TargetCostReached,
        Some(Stop::Iterations) => TerminationReason::MaxItersReached,
        Some(Stop::Stalled) => TerminationReason::SolverConverged,
    };
    TerminationStatus::Terminated(reason)
}

/// argmin's state; its population is the swarm's own and stays empty.
pub(crate) type Population = PopulationState<Vec<f64>, f64>;
pub(crate) type Reported = (Population, Option<KV>);

impl<O> Solver<O, Population> for ParticleSwarm
where
    O: CostFunction<Param = Vec<f64>> + Sync,
    O::Output: Into<Cost>,
{
    fn name(&self) -> &'static str {
        "particle swarm"
    }

    fn init(&mut self, problem: &mut Problem<O>, state: Population) -> Result<Reported, Error> {
        // A swarm that was stepped before goes on from where it is.
        if self.swarm.history().is_empty() {
            self.generation(problem, state)
        } else {
            Ok(self.report(problem, state))
        }
    }

    fn next_iter(&mut self, problem: &mut Problem<O>, state: Population) -> Result<Reported, Error> {
        self.generation(problem, state)
    }

    fn terminate(&mut self, _state: &Population) -> TerminationStatus {
        terminate(self.swarm.stop())
    }
}
