//! What is asked of a motion, to first order in the durations of its arcs.

use profiles::Interval;
use profiles::switched::{SwitchState, Zero};

use super::Motion;
use super::task::{Place, Task};
use crate::programme::{Affine, Programme};

/// An expression of changes of the durations.
struct Line {
    value: f64,
    slopes: Vec<f64>,
}

impl Line {
    /// As an expression of a programme, with the variable `miss` added.
    fn with(&self, sign: f64, miss: usize) -> Affine {
        let slopes = self.slopes.iter().enumerate().filter(|(_, slope)| **slope != 0.0);
        let terms = slopes.map(|(k, slope)| (k, sign * slope)).chain([(miss, 1.0)]);
        Affine { terms: terms.collect(), constant: sign * self.value }
    }
}

/// Everything that is asked, each in units of its own size.
pub(super) struct Asked {
    /// Must be zero.
    equal: Vec<Line>,
    /// Must not be negative.
    least: Vec<Line>,
    /// Must not be longer than one.
    disks: Vec<[Line; 2]>,
}

impl Asked {
    pub(super) fn of(task: &Task, places: &[Place], motion: &Motion) -> Self {
        let mut asked = Self { equal: vec![], least: vec![], disks: vec![] };
        let n = motion.arcs().len();
        let states: Vec<SwitchState> = motion.states().collect();
        let largest = |of: fn(&SwitchState) -> f64| states.iter().map(of).fold(1.0, f64::max);
        let (a_unit, v_unit) = (largest(|s| s.acceleration.abs()), largest(|s| s.velocity.abs()));
        let mut scales = vec![a_unit, v_unit];
        scales.extend(task.goal.distance.map(|_| 1.0));
        for zero in &task.zeros {
            scales.extend(std::iter::repeat_n(task.full_jerk() / zero.pole().norm(), zero.conditions()));
        }
        let line = |value: f64, gradient: &[f64], unit: f64| Line {
            value: value / unit,
            slopes: gradient.iter().take(n).map(|slope| slope / unit).collect(),
        };
        let mut scale = scales.into_iter();
        motion.conditions(&task.goal, &task.zeros, &[], |condition| {
            asked.equal.push(line(condition.value, &condition.gradient, scale.next().unwrap_or(1.0)));
        });
        for place in places {
            let mut parts = Vec::new();
            motion.conditions(&task.goal, &[Zero::at(place.pole, false)], &[], |condition| {
                parts.push(line(condition.value, &condition.gradient, place.tolerated));
            });
            if let (Some(im), Some(re)) = (parts.pop(), parts.pop()) {
                asked.disks.push([re, im]);
            }
        }
        // Derivatives of acceleration and velocity at a time `t` by the durations of the arcs that end before.
        let columns = |t: f64, arcs: usize, order: usize| -> Vec<f64> {
            let ends = states.iter().skip(1).zip(motion.arcs()).take(arcs);
            ends.map(|(end, arc)| end.column(arc.jerk, t - end.time)[order]).collect()
        };
        let mut within = |value: f64, bounds: Interval, slopes: &[f64], unit: f64| {
            for (bound, sign) in [(bounds.lower, 1.0), (bounds.upper, -1.0)] {
                if bound.is_finite() {
                    let slopes = slopes.iter().map(|slope| sign * slope / unit).collect();
                    asked.least.push(Line { value: sign * (value - bound) / unit, slopes });
                }
            }
        };
        for (index, (state, arc)) in states.iter().zip(motion.arcs()).enumerate() {
            if index > 0 {
                let [steep, fast] = [0, 1].map(|order| columns(state.time, index, order));
                within(state.acceleration, task.acceleration, &steep, a_unit);
                within(state.velocity, task.velocity, &fast, v_unit);
            }
            let turn = -state.acceleration / arc.jerk;
            if arc.jerk != 0.0 && turn > 0.0 && turn < arc.duration {
                let fast = columns(state.time + turn, index, 1);
                within(state.advanced(arc.jerk, turn).velocity, task.velocity, &fast, v_unit);
            }
        }
        asked
    }

    /// By how much anything that is asked is missed.
    pub(super) fn violation(&self) -> f64 {
        let equal = self.equal.iter().map(|line| line.value.abs());
        let least = self.least.iter().map(|line| -line.value);
        let disks = self.disks.iter().map(|[re, im]| re.value.hypot(im.value) - 1.0);
        equal.chain(least).chain(disks).fold(0.0, f64::max)
    }

    /// Adds all of it to a programme over the changes of the durations and the variable `miss`, by which it may be missed.
    pub(super) fn add_to(&self, programme: &mut Programme, miss: usize) {
        for line in &self.equal {
            programme.positive(line.with(1.0, miss));
            programme.positive(line.with(-1.0, miss));
        }
        for line in &self.least {
            programme.positive(line.with(1.0, miss));
        }
        for [re, im] in &self.disks {
            let part = |line: &Line| {
                let mut part = line.with(1.0, miss);
                part.terms.pop();
                part
            };
            programme.cone(Affine { terms: vec![(miss, 1.0)], constant: 1.0 }, part(re), part(im));
        }
    }
}
