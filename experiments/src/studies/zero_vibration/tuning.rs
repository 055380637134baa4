//! The two methods that are not told what a mode is but searched on the axis: by the time until the load is at rest.

use anyhow::{Context as _, Result};
use argmin::core::{CostFunction, Error, Executor};
use optimize::{Cost, ParticleSwarm, SwarmOptions};
use profiles::{FivePhase, Interval};

use super::command::Command;
use super::setup::{Task, limits};
use super::simulation::{Watch, course};

/// This file, from the root of the repository.
pub(super) const FILE: &str = file!();

/// Particles and iterations: one unknown.
const SWARM: (usize, u64) = (8, 12);
/// Corners of the low-pass that are tried, as parts of the frequency of the mode, and how many.
const CORNERS: (f64, f64, u32) = (0.2, 5.0, 24);

/// The five-phase curve for a phase time: as fast as the limits allow.
fn curve(task: &Task, phase: f64) -> Result<FivePhase> {
    let limits = limits()?;
    let peaks = [
        limits.velocity().upper,
        limits.acceleration().upper * phase,
        limits.jerk().upper * phase * phase,
        // Of a move without a cruise; less by a few roundings, for the ramps must not be longer than the move.
        0.5 * task.length / phase * (1.0 - 4.0 * f64::EPSILON),
    ];
    let peak = peaks.into_iter().fold(f64::INFINITY, f64::min);
    Ok(FivePhase::over_distance(task.length, 0.0, peak, phase)?)
}

/// Time until the load is at rest, s, of the mode as it is told.
fn settled(task: &Task, command: &Command) -> Result<f64> {
    course(command, task.mode, Watch { band: task.band(), until: 0.0 })?.settled(task.length, task.band())
}

struct Search<'a>(&'a Task);

impl CostFunction for Search<'_> {
    type Param = Vec<f64>;
    type Output = Cost;

    fn cost(&self, candidate: &Vec<f64>) -> Result<Cost, Error> {
        let [phase] = candidate[..] else { return Ok(Cost::Failed) };
        Ok(Cost::from(settled(self.0, &Command::new(curve(self.0, phase)?))?))
    }
}

/// The five-phase curve whose phase time a swarm finds, from the shortest within the limits to a damped period more.
pub(super) fn five_phase(task: &Task, seed: u64) -> Result<Command> {
    let shortest = FivePhase::rest_to_rest(task.length, &limits()?)?.phase_time();
    let bounds = [Interval::new(shortest, shortest + task.mode.damped_period())];
    let options = SwarmOptions::new(SWARM.0, SWARM.1);
    // The grid is what is spread over the processors.
    let swarm = ParticleSwarm::new(&bounds, options, seed)?.sequential();
    let result = Executor::new(Search(task), swarm).run()?;
    let (best, _) = result.solver.swarm().best();
    let [phase] = *best else { anyhow::bail!("one unknown") };
    Ok(Command::new(curve(task, phase)?))
}

/// A command behind the low-pass of the corner with which the load is at rest soonest.
pub(super) fn low_pass(task: &Task, command: impl Fn() -> Result<Command>) -> Result<Command> {
    let (from, to, count) = CORNERS;
    let mut best: Option<(f64, Command)> = None;
    for k in 0..=count {
        let part = from * (to / from).powf(f64::from(k) / f64::from(count));
        let candidate = command()?.with_low_pass(part * task.mode.angular_frequency());
        let time = settled(task, &candidate)?;
        if best.as_ref().is_none_or(|(least, _)| time < *least) {
            best = Some((time, candidate));
        }
    }
    best.map(|(_, command)| command).context("no corner")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_swarm_is_as_good_as_a_dense_scan() {
        for (length, hz, damping) in
            [(0.1, 8.0, 0.02), (0.02, 12.0, 0.05), (0.005, 4.0, 0.1), (0.002, 40.0, 0.02)]
        {
            let task = Task::new(length, hz, damping).unwrap();
            let shortest = FivePhase::rest_to_rest(length, &limits().unwrap()).unwrap().phase_time();
            let scanned = (0..=500)
                .map(|k| shortest + task.mode.damped_period() * f64::from(k) / 500.0)
                .map(|phase| settled(&task, &Command::new(curve(&task, phase).unwrap())).unwrap())
                .fold(f64::INFINITY, f64::min);
            for seed in 1..4 {
                let found = settled(&task, &five_phase(&task, seed).unwrap()).unwrap();
                // A hundred candidates of a cost with many kinks.
                assert!(found < 1.005 * scanned, "{task:?}: {found} {scanned}");
            }
        }
    }
}
