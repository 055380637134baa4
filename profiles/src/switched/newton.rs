//! Durations that meet the conditions.

use super::{Contact, Goal, Switched, Zero};
use crate::quantities::Real;

/// Newton steps before a correction is given up.
const STEPS: usize = 24;
/// A step, as a part of the duration, after which a method that converges quadratically has got to rounding.
const CLOSE: f64 = 1e-9;
/// What is left of a derivative, of which the largest is one, that others determine.
const DEPENDENT: f64 = 1e-13;

/// Linear conditions on `N` unknowns at most, taken in one after the other: rows `q_k` that are orthonormal, and the
/// smallest solution `sum of y_k q_k` of those so far.
struct Conditions<const N: usize> {
    rows: [[f64; N]; N],
    weights: [f64; N],
    len: usize,
}

impl<const N: usize> Conditions<N> {
    /// Adds `row . x = value`; none where earlier conditions determine the row.
    fn add(&mut self, row: &[f64; N], value: f64) -> Option<()> {
        let largest = row.iter().fold(0.0, |largest: f64, x| largest.max(x.abs()));
        let mut rest = row.map(|x| x / largest);
        let mut value = value / largest;
        // Twice, as the first time leaves rounding of what it takes away.
        for _ in 0..2 {
            for (known, weight) in self.rows.iter().zip(self.weights).take(self.len) {
                let along = dot(known, &rest);
                rest.iter_mut().zip(known).for_each(|(x, y)| *x -= along * y);
                value -= along * weight;
            }
        }
        let length = Real::sqrt(dot(&rest, &rest));
        if length.is_nan() || length <= DEPENDENT {
            return None;
        }
        *self.rows.get_mut(self.len)? = rest.map(|x| x / length);
        *self.weights.get_mut(self.len)? = value / length;
        self.len += 1;
        Some(())
    }

    fn solution(&self) -> [f64; N] {
        let mut solution = [0.0; N];
        for (row, weight) in self.rows.iter().zip(self.weights).take(self.len) {
            solution.iter_mut().zip(row).for_each(|(x, y)| *x += weight * y);
        }
        solution
    }
}

fn dot<const N: usize>(a: &[f64; N], b: &[f64; N]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

impl<const N: usize> Switched<N> {
    /// The same structure with durations that meet the conditions to rounding, by Newton's method from the durations it
    /// has. Where there are fewer conditions than arcs every step is the smallest one (in the sense of least squares), so
    /// that the motion stays close to what it was: an optimum stays one but for the square of the correction.
    ///
    /// None where the conditions are more than the arcs or depend on each other, where the method does not converge, or
    /// where a duration would be negative.
    #[must_use]
    pub fn corrected(&self, goal: &Goal, zeros: &[Zero], contacts: &[Contact]) -> Option<Self> {
        let mut motion = *self;
        let mut before = f64::INFINITY;
        for _ in 0..STEPS {
            let step = motion.step(goal, zeros, contacts)?;
            let size = step.iter().fold(0.0, |size: f64, x| size.max(x.abs()));
            let duration = motion.duration();
            // Steps no longer shrink where rounding has the word.
            if !size.is_finite() || (size >= 0.5 * before && size < CLOSE * duration) {
                break;
            }
            if size > 4.0 * before || size > 4.0 * duration {
                return None;
            }
            for (arc, step) in motion.arcs_mut().iter_mut().zip(step) {
                arc.duration -= step;
            }
            before = size;
            if size <= f64::EPSILON * duration {
                break;
            }
        }
        let converged = before < CLOSE * motion.duration();
        (converged && motion.arcs().iter().all(|arc| arc.duration >= 0.0)).then_some(motion)
    }

    /// The smallest change of the durations that takes the conditions away, to first order.
    fn step(&self, goal: &Goal, zeros: &[Zero], contacts: &[Contact]) -> Option<[f64; N]> {
        let mut known = Conditions { rows: [[0.0; N]; N], weights: [0.0; N], len: 0 };
        let mut good = true;
        self.conditions(goal, zeros, contacts, |condition| {
            good = good && known.add(&condition.gradient, condition.value).is_some();
        });
        (good && known.len <= self.len).then(|| known.solution())
    }
}
