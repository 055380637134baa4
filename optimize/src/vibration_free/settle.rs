//! The shortest motion of a given structure.

use profiles::switched::{Arc, Contact};

use super::Motion;
use super::task::Task;
use crate::programme::{Affine, Programme};

/// Prices of a violation in units of time.
const PENALTIES: [f64; 3] = [100.0, 1e4, 1e6];
/// A violation that is left to Newton's method.
const SMALL: f64 = 1e-7;
/// A gain that the solver cannot tell from nothing.
const NOTHING: f64 = 1e-10;
const REST: f64 = 1e-9;

/// An expression of the durations that must be zero, or must not be negative, and its derivatives.
struct Row {
    value: f64,
    derivatives: Vec<f64>,
    equal: bool,
}

/// Everything that is asked of a motion, each scaled to its own size.
fn rows(task: &Task, motion: &Motion) -> Vec<Row> {
    let mut rows = Vec::new();
    let n = motion.arcs().len();
    let states: Vec<_> = motion.states().collect();
    let a_unit = states.iter().map(|s| s.acceleration.abs()).fold(1.0, f64::max);
    let v_unit = states.iter().map(|s| s.velocity.abs()).fold(1.0, f64::max);
    let ends = 2 + usize::from(task.goal.distance.is_some());
    let mut scales = vec![a_unit, v_unit, 1.0];
    scales.truncate(ends);
    for zero in &task.zeros {
        let unit = task.full_jerk() / zero.pole().norm();
        scales.extend(std::iter::repeat_n(unit, 2));
        if zero.is_double() {
            scales.extend(std::iter::repeat_n(unit, 2));
        }
    }
    let mut scale = scales.iter();
    motion.conditions(&task.goal, &task.zeros, &[], |condition| {
        let unit = scale.next().copied().unwrap_or(1.0);
        let derivatives = condition.gradient.iter().take(n).map(|d| d / unit).collect();
        rows.push(Row { value: condition.value / unit, derivatives, equal: true });
    });
    let mut limit = |contact: Contact, bound: f64, unit: f64, sign: f64| {
        if bound.is_finite() {
            let mut last = None;
            motion.conditions(&task.goal, &[], &[contact], |condition| {
                last =
                    Some((condition.value, condition.gradient.iter().take(n).copied().collect::<Vec<_>>()));
            });
            if let Some((value, derivatives)) = last {
                let derivatives = derivatives.iter().map(|d| sign * d / unit).collect();
                rows.push(Row { value: sign * value / unit, derivatives, equal: false });
            }
        }
    };
    for (arc, (state, stretch)) in states.iter().zip(motion.arcs()).enumerate() {
        if arc > 0 {
            for (bound, sign) in [(task.acceleration.lower, 1.0), (task.acceleration.upper, -1.0)] {
                limit(Contact::Acceleration { arc, value: bound }, bound, a_unit, sign);
            }
            for (bound, sign) in [(task.velocity.lower, 1.0), (task.velocity.upper, -1.0)] {
                limit(Contact::Velocity { arc, value: bound }, bound, v_unit, sign);
            }
        }
        let turn = -state.acceleration / stretch.jerk;
        if stretch.jerk != 0.0 && turn > 0.0 && turn < stretch.duration {
            for (bound, sign) in [(task.velocity.lower, 1.0), (task.velocity.upper, -1.0)] {
                limit(Contact::Turn { arc, value: bound }, bound, v_unit, sign);
            }
        }
    }
    rows
}

fn violation(rows: &[Row]) -> f64 {
    rows.iter().map(|row| if row.equal { row.value.abs() } else { -row.value }).fold(0.0, f64::max)
}

/// The shortest motion near `arcs`, in at most so many steps.
pub(super) fn settled(task: &Task, arcs: &[Arc], steps: usize) -> Option<Motion> {
    let mut motion = Motion::new(task.from, arcs)?;
    for penalty in PENALTIES {
        motion = priced(task, &motion, penalty, steps);
        if violation(&rows(task, &motion)) <= SMALL {
            break;
        }
    }
    Some(motion)
}

fn priced(task: &Task, start: &Motion, penalty: f64, steps: usize) -> Motion {
    let mut motion = *start;
    let mut asked = rows(task, &motion);
    let merit = |motion: &Motion, rows: &[Row]| motion.duration() + penalty * violation(rows);
    let mut value = merit(&motion, &asked);
    let mut trust = 0.05;
    for _ in 0..steps {
        if trust < REST {
            break;
        }
        let Some((next, predicted)) = stepped(task, &motion, &asked, penalty, trust) else {
            trust *= 0.25;
            continue;
        };
        let expected = value - predicted;
        if expected < NOTHING {
            break;
        }
        let next_rows = rows(task, &next);
        let next_value = merit(&next, &next_rows);
        let gained = (value - next_value) / expected;
        if gained > 0.0 {
            (motion, value, asked) = (next, next_value, next_rows);
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

fn stepped(task: &Task, motion: &Motion, asked: &[Row], penalty: f64, trust: f64) -> Option<(Motion, f64)> {
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
    for row in asked {
        let mut terms: Vec<_> =
            row.derivatives.iter().copied().enumerate().filter(|(_, d)| *d != 0.0).collect();
        terms.push((n, 1.0));
        if row.equal {
            let other = row.derivatives.iter().map(|d| -d).enumerate().filter(|(_, d)| *d != 0.0);
            let other = other.chain([(n, 1.0)]).collect();
            programme.positive(Affine { terms: other, constant: -row.value });
        }
        programme.positive(Affine { terms, constant: row.value });
    }
    let (x, _) = programme.solved_to(1e-11)?;
    let arcs: Vec<Arc> = motion
        .arcs()
        .iter()
        .zip(&x)
        .map(|(arc, change)| Arc { duration: (arc.duration + change).max(0.0), ..*arc })
        .collect();
    let predicted = motion.duration() + x.iter().take(n).sum::<f64>() + penalty * x[n].max(0.0);
    Some((Motion::new(task.from, &arcs)?, predicted))
}
