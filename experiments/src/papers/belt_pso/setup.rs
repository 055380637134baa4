//! What the paper prints of its belt drive, and what had to be chosen.

use std::f64::consts::TAU;

use anyhow::Result;
use profiles::{FivePhase, Profile};

/// This file, from the root of the repository.
pub(super) const FILE: &str = file!();

// Section 4 of the paper.
/// Output that is wanted, pulse/s.
pub(super) const TARGET: f64 = 50_000.0;
/// Command that gives it, pulse/s.
pub(super) const COMMAND: f64 = 43_490.0;
/// Jerk found by the paper, pulse/s^3.
pub(super) const JERK: f64 = 38_564.0;
/// Time of a phase found by the paper, s.
pub(super) const PHASE: f64 = 1.062;
/// Frequency of the peak of the spectrum, rad/s.
pub(super) const PEAK: f64 = 1.177 * TAU;
/// Peak of the output under the trapezoid, pulse/s: 66 % over 50 000, where the paper prints 86 %.
pub(super) const TRAPEZOID_PEAK: f64 = 83_000.0;
/// Settling times under the trapezoid and under the S-curve, s.
pub(super) const SETTLINGS: [f64; 2] = [1.8, 2.2];
/// Settling band, a part of the output that is wanted.
pub(super) const BAND: f64 = 0.05;
/// Command of the near-step for the identification, pulse/s.
pub(super) const NEAR_STEP: f64 = 30_000.0;
/// Sampling rate of the log, Hz.
pub(super) const LOG_RATE: f64 = 75.0;
/// Time in which the trapezoid rises, s: printed 1 s, and meant 1 ms.
pub(super) const RISE: f64 = 1e-3;
/// Particles and iterations of the swarm.
pub(super) const SWARM: (usize, u64) = (50, 30);
/// Inertia and both pulls of the swarm.
pub(super) const FACTORS: (f64, f64) = (0.4, 2.0);
/// Fitness at which the paper's swarm stops.
pub(super) const GOOD_ENOUGH: f64 = 10.0;
/// Largest phase time, s.
pub(super) const LONGEST_PHASE: f64 = 2.0;

// Not printed, or printed wrong.
/// Largest jerk, pulse/s^3: the printed 10 000 excludes the printed optimum, and cannot reach the output wanted.
pub(super) const LARGEST_JERK: f64 = 100_000.0;
/// How long a response is looked at, s.
pub(super) const HORIZON: f64 = 6.0;
/// Step of the simulation, s.
pub(super) const STEP: f64 = 1e-3;
/// Weight of the error, 1/(pulse), of the command, 1/(pulse), of the overshoot, 1/s, and the penalty.
pub(super) const WEIGHTS: [f64; 4] = [3e-4, 0.0, 100.0, 100.0];

/// The S-curve up to the speed of `jerk` and `phase` and beyond the horizon.
pub(super) fn s_curve(jerk: f64, phase: f64) -> Result<FivePhase> {
    Ok(FivePhase::new(0.0, jerk, phase, HORIZON)?)
}

/// The command of the trapezoid, pulse/s.
pub(super) fn trapezoid(speed: f64) -> impl Fn(f64) -> f64 {
    move |t| speed * (t / RISE).clamp(0.0, 1.0)
}

/// The mean of a command over each step of the simulation, to second order, as the drive holds it.
pub(super) fn held(command: impl Fn(f64) -> f64) -> Vec<f64> {
    let steps = (HORIZON / STEP).round() as usize;
    (0..=steps).map(|k| command((k as f64 + 0.5) * STEP)).collect()
}

/// The speed of a profile as a command.
pub(super) fn speed(profile: &FivePhase) -> impl Fn(f64) -> f64 + '_ {
    |t| profile.sample(t).velocity
}
