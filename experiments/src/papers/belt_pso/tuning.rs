//! The swarm that tunes the S-curve, the grid it is judged by, and the shortest curve that does no worse than the paper's.

use anyhow::{Context as _, Result};
use argmin::core::{CostFunction, Error, Executor};
use identify::Signal;
use optimize::{Cost, FitnessWeights, ParticleSwarm, Schedule, SwarmOptions};
use profiles::Interval;

use super::drive::{Drive, figures};
use super::setup::{
    COMMAND, FACTORS, GOOD_ENOUGH, LARGEST_JERK, LONGEST_PHASE, STEP, SWARM, TARGET, WEIGHTS, held, s_curve,
    speed,
};

/// This file, from the root of the repository.
pub(super) const FILE: &str = file!();

/// The fitness (15) of an S-curve on a drive.
pub(super) struct Tuning<'a> {
    pub(super) drive: &'a Drive,
    weights: FitnessWeights,
}

impl<'a> Tuning<'a> {
    pub(super) fn new(drive: &'a Drive) -> Result<Self> {
        let [error, effort, overshoot, penalty] = WEIGHTS;
        Ok(Self { drive, weights: FitnessWeights::new(error, effort, overshoot, penalty)? })
    }

    pub(super) fn fitness(&self, jerk: f64, phase: f64) -> Result<f64> {
        let curve = s_curve(jerk, phase)?;
        let command = held(speed(&curve));
        let output = self.drive.respond(&command);
        Ok(self.weights.of(&Signal::sampled(&output, STEP)?, &command, 0.0, TARGET)?.total())
    }
}

impl CostFunction for &Tuning<'_> {
    type Param = Vec<f64>;
    type Output = Cost;

    fn cost(&self, candidate: &Vec<f64>) -> Result<Cost, Error> {
        let [jerk, phase] = candidate[..] else { return Ok(Cost::Failed) };
        Ok(Cost::from(self.fitness(jerk, phase)?))
    }
}

/// What the swarm found and how.
pub(super) struct Tuned {
    pub(super) jerk: f64,
    pub(super) phase: f64,
    pub(super) fitness: f64,
    /// The best fitness after every iteration.
    pub(super) history: Vec<(f64, f64)>,
}

/// The swarm as the paper sets it.
pub(super) fn swarm(tuning: &Tuning<'_>, seed: u64, iterations: u64) -> Result<Tuned> {
    let (inertia, pull) = FACTORS;
    let options = SwarmOptions {
        inertia: Schedule::Constant(inertia),
        cognitive: Schedule::Constant(pull),
        social: Schedule::Constant(pull),
        target: Some(GOOD_ENOUGH),
        ..SwarmOptions::new(SWARM.0, iterations)
    };
    // The smallest are far from anything that moves, and none is zero.
    let bounds = [
        Interval::new(1e-3 * LARGEST_JERK, LARGEST_JERK),
        Interval::new(1e-3 * LONGEST_PHASE, LONGEST_PHASE),
    ];
    let result = Executor::new(tuning, ParticleSwarm::new(&bounds, options, seed)?).run()?;
    let swarm = result.solver.swarm();
    let (best, cost) = swarm.best();
    let [jerk, phase] = *best else { anyhow::bail!("two dimensions") };
    let history =
        swarm.history().iter().filter_map(|p| Some((p.iteration as f64, p.best.value()?))).collect();
    Ok(Tuned { jerk, phase, fitness: cost.value().context("no curve found")?, history })
}

/// The least fitness on two grids of peak speeds and phase times: half to one and a half of the printed command by 0.1 to 2 s,
/// which is wherever the swarm can get near the target, and 5 % about the command by 0.3 to 1.3 s.
pub(super) fn grid(tuning: &Tuning<'_>, steps: u32) -> Result<f64> {
    let place = |(from, to): (f64, f64), k: u32| from + (to - from) * f64::from(k) / f64::from(steps);
    let mut best = f64::INFINITY;
    for (speeds, phases) in [((0.5, 1.5), (0.1, LONGEST_PHASE)), ((0.95, 1.05), (0.3, 1.3))] {
        for (i, j) in (0..=steps).flat_map(|i| (0..=steps).map(move |j| (i, j))) {
            let (speed, phase) = (COMMAND * place(speeds, i), place(phases, j));
            let jerk = speed / (phase * phase);
            if jerk <= LARGEST_JERK {
                best = best.min(tuning.fitness(jerk, phase)?);
            }
        }
    }
    Ok(best)
}

/// Overshoot and settling against the phase time of a curve to the printed command.
pub(super) fn course(drive: &Drive, phases: &[f64]) -> Result<Vec<(f64, f64, f64)>> {
    let one = |phase: &f64| {
        let curve = s_curve(COMMAND / (phase * phase), *phase)?;
        let (overshoot, settling) = figures(&drive.respond(&held(speed(&curve))))?;
        Ok((*phase, overshoot, settling))
    };
    phases.iter().map(one).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_seed_gives_one_answer_and_every_seed_the_same_within_a_part_in_a_thousand() {
        let drive = Drive::new(0.2014, 0.0921).expect("drive");
        let tuning = Tuning::new(&drive).expect("weights");
        let of = |seed| swarm(&tuning, seed, SWARM.1).expect("found");
        let (first, again) = (of(1), of(1));
        let bits = |found: &Tuned| [found.jerk, found.phase, found.fitness].map(f64::to_bits);
        assert_eq!(bits(&first), bits(&again));
        assert_eq!(first.history.len(), 1 + SWARM.1 as usize);
        let best = grid(&tuning, 100).expect("grid");
        for seed in 1..=5 {
            let found = of(seed);
            // The grid is 0.1 % of the speed and 10 ms wide.
            assert!(found.fitness < 1.001 * best, "seed {seed}: {} and {best}", found.fitness);
        }
    }

    #[test]
    fn a_curve_that_hardly_moves_is_fined() {
        let drive = Drive::new(0.2014, 0.0921).expect("drive");
        let tuning = Tuning::new(&drive).expect("weights");
        let [.., penalty] = WEIGHTS;
        assert!(tuning.fitness(100.0, 1.0).expect("runs") > penalty);
        assert!(tuning.fitness(COMMAND, 1.0).expect("runs") < penalty);
    }
}
