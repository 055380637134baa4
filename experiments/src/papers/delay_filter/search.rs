//! The search for what the paper leaves out of its loops.

use anyhow::{Context as _, Result, ensure};
use optimize::{Cost, simplex};

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

/// Searches from every one of `starts`, a loop and a band each, with at most `iterations` of the simplex method.
pub(super) fn search(starts: &[(LoopParameters, f64)], iterations: u64, step: &dyn Fn()) -> Result<Found> {
    let first = starts.first().context("a start")?;
    let start_cost = cost(&unknowns(&first.0, first.1))?;
    let (mut found, mut evaluations): (Option<Found>, u64) = (None, 0);
    for (start, band) in starts {
        let start = unknowns(start, *band);
        // A loop that cannot be made or runs away is no candidate.
        let costs = |unknowns: &[f64]| {
            step();
            cost(unknowns).map_or(Cost::Failed, Cost::Ok)
        };
        // A third more of each unknown in turn.
        let result = simplex(costs, &start, &[0.3; 5], iterations)?;
        evaluations += result.evaluations;
        let (loops, band) = loops(&result.best).context("five unknowns")?;
        let cost = result.cost.value().context("a cost")?;
        if found.as_ref().is_none_or(|found| cost < found.cost) {
            found = Some(Found { loops, band, cost, start_cost, evaluations: 0 });
        }
    }
    let found = found.context("no start")?;
    Ok(Found { evaluations, ..found })
}
