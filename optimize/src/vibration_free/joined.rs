//! Two vibration-free ramps with a cruise between them.

use profiles::switched::Arc;
use profiles::{Limits, Mode, Profile};

use super::exchange::{Found, exact, exchanged, shorter};
use super::motion::VibrationFreeMove;
use super::structure::{Blur, Structure};
use super::task::Task;
use super::{Request, Robustness};

/// Limits that ramps meet are met to rounding.
const EXACT: Blur = Blur { shortest: 1e-13, acceleration: 1e-9, velocity: 1e-9, turn: 1e-9 };

/// The best motion near one that gets to the limit of the velocity by the shortest ramp that leaves nothing, and back: what a
/// long motion comes close to, however many periods of the modes it lasts.
///
/// None for a change of velocity, with bands (what both ramps leave adds up), or where the distance is too short for both.
pub(super) fn joined(
    task: &Task,
    request: Request,
    limits: &Limits,
    modes: &[Mode],
    robustness: Robustness,
) -> Option<Found> {
    let Request::Move { distance } = request else { return None };
    if matches!(robustness, Robustness::Band { .. }) {
        return None;
    }
    let bounds = limits.velocity();
    let speed = if distance < 0.0 { bounds.lower } else { bounds.upper };
    if !speed.is_finite() {
        return None;
    }
    let ramp =
        |from, to| VibrationFreeMove::planned(Request::Ramp { from, to }, limits, modes, robustness).ok();
    let (up, down) = (ramp(0.0, speed)?, ramp(speed, 0.0)?);
    let way = |ramp: &VibrationFreeMove| ramp.sample(ramp.duration()).position;
    let cruise = (distance - way(&up) - way(&down)) / speed;
    if !(cruise > 0.0 && cruise.is_finite()) {
        return None;
    }
    let unit = task.length / task.time.powi(3);
    let arcs: Vec<Arc> = [up.arcs(), &[Arc { jerk: 0.0, duration: cruise }], down.arcs()]
        .concat()
        .iter()
        .map(|arc| Arc { jerk: task.known(arc.jerk / unit), duration: arc.duration / task.time })
        .collect();
    let structure = Structure::of(task, &arcs, EXACT)?;
    let found = [exact(task, &structure), exchanged(task, structure, None, false)];
    found.into_iter().flatten().fold(None, |best, found| Some(shorter(best, found)))
}
