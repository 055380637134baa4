//! The search for what the paper leaves out of its loops.

use std::cell::Cell;

use anyhow::{Context as _, Result, ensure};
use argmin::core::{CostFunction, Error, Executor, State};
use argmin::solver::neldermead::NelderMead;

use super::reading::{Reading, read};
use super::servo::{LoopParameters, Servo};
use super::setup::{CONTROL_RATE, HORIZON, SYSTEMS, System, command};
use profiles::{Profile, Real};

/// This file, from the root of the repository.
pub(super) const FILE: &str = file!();

/// What a damping ratio, a frequency or a settling time may be off by, in parts, to cost the logarithm of two.
const DAMPING: f64 = 0.1;
const FREQUENCY: f64 = 0.05;
const SETTLING: f64 = 0.1;
/// What another class, or no vibration where one is printed, costs.
const CLASS: f64 = 50.0;
/// What a loop that does not run costs.
const UNSTABLE: f64 = 1e6;
/// The largest bandwidth of the current loop, rad/s: half a radian to a tick.
const LARGEST_BANDWIDTH: f64 = 0.5 * CONTROL_RATE as f64;

/// The loops found and what it took.
pub(super) struct Found {
    pub(super) loops: LoopParameters,
    /// Settling band, a part of the move.
    pub(super) band: f64,
    pub(super) cost: f64,
    /// The cost of the loops the search started from.
    pub(super) start_cost: f64,
    /// How many sets of loops were run.
    pub(super) evaluations: u64,
}

/// Logarithms of the five unknowns, in which the search moves; through `libm`, so that it goes the same way everywhere.
fn unknowns(loops: &LoopParameters, band: f64) -> Vec<f64> {
    let LoopParameters { velocity_integral, current_bandwidth, spring_damping, load_damping } = *loops;
    [velocity_integral, current_bandwidth, spring_damping, load_damping, band].map(Real::ln).to_vec()
}

fn loops(unknowns: &[f64]) -> Option<(LoopParameters, f64)> {
    let [velocity_integral, current_bandwidth, spring_damping, load_damping, band] = *unknowns else {
        return None;
    };
    let loops = LoopParameters {
        velocity_integral: Real::exp(velocity_integral),
        current_bandwidth: Real::exp(current_bandwidth),
        spring_damping: Real::exp(spring_damping),
        load_damping: Real::exp(load_damping),
    };
    Some((loops, Real::exp(band)))
}

/// How far a reading is from table 2: `ln(1 + d^2)` for each number that is `d` slacks off, so that one that no loop meets does
/// not outweigh those that it could.
fn distance(system: &System, reading: &Reading) -> f64 {
    let part = |ours: f64, printed: f64, slack: f64| Real::ln(1.0 + ((ours / printed - 1.0) / slack).powi(2));
    let mut cost = reading.settling.map_or(CLASS, |settling| part(settling, system.settling, SETTLING));
    if reading.class != system.class {
        cost += CLASS;
    }
    if let Some((damping, frequency)) = system.vibration {
        cost +=
            reading.printed.map_or(CLASS, |(z, w)| part(z, damping, DAMPING) + part(w, frequency, FREQUENCY));
    }
    cost
}

/// The sum over the four systems, for one set of unknowns.
fn cost(unknowns: &[f64]) -> Result<f64> {
    let command = command()?;
    let (loops, band) = loops(unknowns).context("five unknowns")?;
    ensure!(loops.current_bandwidth <= LARGEST_BANDWIDTH, "too fast for the tick");
    let target = command.sample(command.duration()).position;
    let mut cost = 0.0;
    for system in &SYSTEMS {
        let response = Servo::new(system, &loops)?.run(|t| command.sample(t).position, HORIZON, 1)?;
        cost += distance(system, &read(&response, target, band)?);
    }
    Ok(cost)
}

struct Problem<'a> {
    step: &'a dyn Fn(),
}

impl CostFunction for Problem<'_> {
    type Param = Vec<f64>;
    type Output = f64;

    fn cost(&self, unknowns: &Vec<f64>) -> Result<f64, Error> {
        (self.step)();
        // A loop that cannot be made or runs away is no candidate.
        Ok(cost(unknowns).unwrap_or(UNSTABLE))
    }
}

/// Searches from every one of `starts`, a loop and a band each, with at most `iterations` of the simplex method of Nelder
/// and Mead.
pub(super) fn search(starts: &[(LoopParameters, f64)], iterations: u64, step: &dyn Fn()) -> Result<Found> {
    let (mut found, mut evaluations): (Option<Found>, u64) = (None, 0);
    let first = starts.first().context("a start")?;
    let start_cost = cost(&unknowns(&first.0, first.1))?;
    for (start, band) in starts {
        let origin = unknowns(start, *band);
        // The simplex: the start, and a third more of each unknown in turn.
        let corners = (0..origin.len()).map(|k| {
            let mut corner = origin.clone();
            corner[k] += 0.3;
            corner
        });
        let simplex: Vec<Vec<f64>> = std::iter::once(origin.clone()).chain(corners).collect();
        let counted = Cell::new(0);
        let count = || {
            counted.set(counted.get() + 1);
            step();
        };
        let problem = Problem { step: &count };
        let solver = NelderMead::new(simplex).with_sd_tolerance(1e-6)?;
        let result = Executor::new(problem, solver).configure(|state| state.max_iters(iterations)).run()?;
        evaluations += counted.get();
        let state = result.state();
        let (loops, band) = loops(state.get_best_param().context("no best")?).context("five unknowns")?;
        let cost = state.get_best_cost();
        if found.as_ref().is_none_or(|found| cost < found.cost) {
            found = Some(Found { loops, band, cost, start_cost, evaluations: 0 });
        }
    }
    let found = found.context("no start")?;
    Ok(Found { evaluations, ..found })
}
