//! The shortest motion of a given structure, from afar.

use profiles::switched::Arc;

use super::Motion;
use super::asked::Asked;
use super::task::{Place, Task};
use crate::programme::{Affine, Programme};

/// Prices of a violation in units of time, one after the other until none is left.
const PENALTIES: [f64; 3] = [100.0, 1e4, 1e6];
/// A violation that is left to Newton's method.
const SMALL: f64 = 1e-7;
/// A gain that the solver cannot tell from nothing.
const NOTHING: f64 = 1e-10;
/// The first step, and the shortest one, as parts of the S-curve's duration.
const FIRST: f64 = 0.05;
const REST: f64 = 1e-9;

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
    let merit = |motion: &Motion, asked: &Asked| motion.duration() + penalty * asked.violation();
    let mut motion = *start;
    let mut asked = Asked::of(task, places, &motion);
    let mut value = merit(&motion, &asked);
    let mut trust = FIRST;
    for _ in 0..steps {
        if trust < REST {
            break;
        }
        let Some((next, predicted)) = stepped(&motion, &asked, penalty, trust) else {
            trust *= 0.25;
            continue;
        };
        let expected = value - predicted;
        if expected < NOTHING {
            break;
        }
        let next_asked = Asked::of(task, places, &next);
        let next_value = merit(&next, &next_asked);
        let gained = (value - next_value) / expected;
        if gained > 0.0 {
            (motion, value, asked) = (next, next_value, next_asked);
        }
        trust *= if gained > 0.75 {
            2.0
        } else if gained > 0.1 {
            1.0
        } else {
            0.25
        };
    }
    motion
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
