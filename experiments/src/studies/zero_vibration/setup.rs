//! What is moved, how far, and what counts as rest.

use anyhow::Result;
use plants::TwoInertia;
use profiles::{Limits, Mode};

/// This file, from the root of the repository.
pub(super) const FILE: &str = file!();

/// Limits of velocity, acceleration and jerk, m/s, m/s^2, m/s^3.
const LIMITS: (f64, f64, f64) = (0.5, 5.0, 200.0);
/// Limit of snap of the one law that has it, m/s^4: the jerk is reached in 10 ms, where the acceleration takes 25 ms.
const SNAP: f64 = 2e4;
/// Distance from the target that counts as rest, as a part of the move.
pub(super) const BAND: f64 = 1e-3;
/// How far the frequency of the plant may be off what a method was told, as a part of it.
pub(super) const OFF: f64 = 0.1;

/// Lengths of the moves of the grid, m.
const LENGTHS: [f64; 6] = [0.002, 0.005, 0.01, 0.02, 0.05, 0.1];
/// Frequencies of the grid, Hz.
const FREQUENCIES: [f64; 10] = [4.0, 8.0, 12.0, 16.0, 20.0, 24.0, 28.0, 32.0, 36.0, 40.0];
/// Damping ratios of the grid.
pub(super) const DAMPINGS: [f64; 2] = [0.02, 0.1];

/// Masses of motor and load, kg.
const MASSES: (f64, f64) = (10.0, 5.0);

/// A move to be made, and the mode that a method is told of.
#[derive(Clone, Copy, Debug)]
pub(super) struct Task {
    /// m
    pub(super) length: f64,
    pub(super) mode: Mode,
}

impl Task {
    pub(super) fn new(length: f64, hz: f64, damping: f64) -> Result<Self> {
        Ok(Self { length, mode: Mode::from_hz(hz, damping)? })
    }

    /// Distance from the target that counts as rest, m.
    pub(super) fn band(&self) -> f64 {
        BAND * self.length
    }

    /// The mode of a plant whose frequency is `part` of what was told.
    pub(super) fn mode_at(&self, part: f64) -> Result<Mode> {
        Ok(Mode::new(part * self.mode.angular_frequency(), self.mode.damping_ratio())?)
    }
}

/// The limits of every move.
pub(super) fn limits() -> Result<Limits> {
    let (velocity, acceleration, jerk) = LIMITS;
    Ok(Limits::new(velocity, acceleration, jerk)?)
}

/// The limits with that of snap.
pub(super) fn limits_of_snap() -> Result<Limits> {
    Ok(limits()?.with_snap(SNAP)?)
}

/// The grid, damping by damping, length by length; a corner of it in a quick run.
pub(super) fn grid(quick: bool) -> Result<Vec<Task>> {
    let (lengths, frequencies) = if quick { (2, 3) } else { (LENGTHS.len(), FREQUENCIES.len()) };
    let mut tasks = Vec::new();
    for damping in DAMPINGS {
        for length in LENGTHS.iter().take(lengths) {
            for hz in FREQUENCIES.iter().take(frequencies) {
                tasks.push(Task::new(*length, *hz, damping)?);
            }
        }
    }
    Ok(tasks)
}

/// The tasks whose time optimum was computed as a linear programme before there was a planner, with their names in rows.
pub(super) fn computed() -> Result<[(&'static str, Task); 3]> {
    Ok([
        ("8hz", Task::new(0.1, 8.0, 0.02)?),
        ("20hz", Task::new(0.1, 20.0, 0.02)?),
        ("12hz", Task::new(0.02, 12.0, 0.05)?),
    ])
}

/// The axis that vibrates freely in `mode`: with the reduced mass `m = m_m m_l / (m_m + m_l)` a spring of `m w^2` and a damper
/// of `2 z w m`.
pub(super) fn axis(mode: Mode) -> Result<TwoInertia> {
    let (motor, load) = MASSES;
    let reduced = motor * load / (motor + load);
    let (w, z) = (mode.angular_frequency(), mode.damping_ratio());
    Ok(TwoInertia::new(motor, load, reduced * w * w)?.with_damping(0.0, 2.0 * z * w * reduced, 0.0)?)
}
