//! The shortest motion of a given structure, from afar.

use profiles::switched::Arc;

use super::Motion;
use super::asked::Asked;
use super::task::{Place, Task};
use crate::programme::{Affine, Programme};
use crate::trust::Trust;

/// Prices of a violation in units of time, one after the other until none is left.
const PENALTIES: [f64; 3] = [100.0, 1e4, 1e6];
/// A violation that is left to Newton's method.
const SMALL: f64 = 1e-7;
/// Steps in parts of the S-curve's duration.
const TRUST: Trust = Trust { first: 0.05, most: f64::INFINITY, rest: 1e-9, nothing: 1e-10, steps: 0 };

/// The shortest motion near `arcs` that leaves no more than is tolerated at `places`, by a sequence of linear (or
/// second-order cone) programmes over the durations within a region of trust, in at most so many steps for each price.
///
/// A limit that is met shows as an arc that lasts, one that is not as an arc of no duration: no structure is presumed but
/// for the order of the arcs.
pub(super) fn settled(task: &Task, arcs: &[Arc], places: &[Place], steps: usize) -> Option<Motion> {
    let mut motion = Motion::new(task.from, arcs)?;
    for penalty in PENALTIES {
        motion = priced(task, places, &motion, penalty, steps);
        if Asked::of(task, places, &motion).violation() <= SMALL {
            break;
        }
    }
    Some(motion)
}

/// The motion that is shortest if a violation costs `penalty`.
fn priced(task: &Task, places: &[Place], start: &Motion, penalty: f64, steps: usize) -> Motion {
    let asked = |motion: Motion| (motion, Asked::of(task, places, &motion));
    let trust = Trust { steps, ..TRUST };
    let merit = |(motion, asked): &(Motion, Asked)| motion.duration() + penalty * asked.violation();
    let step = |(motion, known): &(Motion, Asked), trust: f64| {
        let (next, predicted) = stepped(motion, known, penalty, trust)?;
        Some((asked(next), predicted))
    };
    trust.descend(asked(*start), merit, step).0
}

/// Where the programme about `motion` leads, and the merit that it predicts.
fn stepped(motion: &Motion, asked: &Asked, penalty: f64, trust: f64) -> Option<(Motion, f64)> {
    let n = motion.arcs().len();
    let mut cost = vec![1.0; n + 1];
    cost[n] = penalty;
    let mut programme = Programme::new(cost);
    let one = |k: usize, coefficient: f64, constant: f64| Affine { terms: vec![(k, coefficient)], constant };
    programme.positive(one(n, 1.0, 0.0));
    for (k, arc) in motion.arcs().iter().enumerate() {
        programme.positive(one(k, 1.0, trust.min(arc.duration)));
        programme.positive(one(k, -1.0, trust));
    }
    asked.add_to(&mut programme, n);
    let x = programme.solved()?;
    let changed = motion.arcs().iter().zip(&x);
    let arcs: Vec<Arc> =
        changed.map(|(arc, change)| Arc { duration: (arc.duration + change).max(0.0), ..*arc }).collect();
    let predicted = motion.duration() + x.iter().take(n).sum::<f64>() + penalty * x[n].max(0.0);
    Some((Motion::new(motion.start_velocity(), &arcs)?, predicted))
}
