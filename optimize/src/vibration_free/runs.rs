//! Motions of given switches whose jerk is free.

use nalgebra::{DMatrix, DVector};
use profiles::Interval;
use profiles::switched::{Arc, Goal, SwitchState, Zero};

use super::band;
use super::task::{Place, Task};
use crate::programme::{Affine, Programme};

/// Room left in limits for the last correction, as a part of them.
const ROOM: f64 = 1e-6;
/// What end and zeros may be missed by where the largest coefficient is one.
const MISSED: f64 = 1e-12;
/// Room left in what is tolerated of a band, as a part of it.
const BAND_ROOM: f64 = 1e-5;
/// Times that places of a band are added.
const FILLINGS: usize = 8;

/// Runs of constant jerk of given lengths: end, zeros, limits and bands are then linear (or convex) in the jerk.
pub(super) struct Runs<'a> {
    task: &'a Task,
    lengths: Vec<f64>,
}

/// Conditions on the jerk of the runs: `rows . jerk = right`.
struct Ends {
    rows: DMatrix<f64>,
    right: DVector<f64>,
}

impl<'a> Runs<'a> {
    /// The gentlest motion that leaves no more of any band than is tolerated, between the places of the task too.
    pub(super) fn kept(task: &Task, lengths: Vec<f64>) -> Option<Vec<Arc>> {
        let mut task = task.clone();
        for _ in 0..FILLINGS {
            let arcs = Runs { task: &task, lengths: lengths.clone() }.gentlest()?;
            if band::is_kept(&task, &arcs) {
                return Some(arcs);
            }
            task.add_places(band::peaks(&task, &arcs), &arcs);
        }
        None
    }

    /// The motion whose jerk takes the smallest part of its limits, its end and its zeros to rounding; none where there is
    /// none.
    fn gentlest(&self) -> Option<Vec<Arc>> {
        let jerk = self.exact(self.programme()?)?;
        Some(
            jerk.iter()
                .zip(&self.lengths)
                .map(|(jerk, length)| Arc { jerk: *jerk, duration: *length })
                .collect(),
        )
    }

    fn duration(&self) -> f64 {
        self.lengths.iter().sum()
    }

    /// For each run its length and the time after it.
    fn places(&self) -> Vec<(f64, f64)> {
        let mut rest = self.duration();
        let places = self.lengths.iter().map(|length| {
            rest = (rest - length).max(0.0);
            (*length, rest)
        });
        places.collect()
    }

    /// What a jerk of one in each run leaves of a pole at the end, real and imaginary part, and of its derivative.
    fn responses(&self, zero: &Zero) -> Vec<[f64; 4]> {
        let places = self.places();
        let left = places.iter().map(|(length, rest)| {
            let pushed = zero.after(Default::default(), &Arc { jerk: 1.0, duration: *length });
            let [q, r] = zero.after(pushed, &Arc { jerk: 0.0, duration: *rest });
            [q.re, q.im, r.re, r.im]
        });
        left.collect()
    }

    /// What must hold exactly: the end and the zeros.
    fn ends(&self) -> Ends {
        let at_rest = SwitchState::default();
        let pushed: Vec<SwitchState> = self
            .places()
            .iter()
            .map(|(length, rest)| at_rest.advanced(1.0, *length).advanced(0.0, *rest))
            .collect();
        let Goal { velocity, distance } = self.task.goal;
        let mut rows: Vec<(Vec<f64>, f64)> = vec![
            (pushed.iter().map(|state| state.acceleration).collect(), 0.0),
            (pushed.iter().map(|state| state.velocity).collect(), velocity - self.task.from),
        ];
        if let Some(distance) = distance {
            let way = self.task.from * self.duration();
            rows.push((pushed.iter().map(|state| state.position).collect(), distance - way));
        }
        for zero in &self.task.zeros {
            let responses = self.responses(zero);
            rows.extend((0..zero.conditions()).map(|k| (responses.iter().map(|r| r[k]).collect(), 0.0)));
        }
        // Each with a largest coefficient of one.
        let largest =
            |row: &[f64]| row.iter().fold(f64::MIN_POSITIVE, |largest: f64, c| largest.max(c.abs()));
        rows.iter_mut().for_each(|(row, right)| {
            let unit = largest(row);
            row.iter_mut().for_each(|c| *c /= unit);
            *right /= unit;
        });
        Ends {
            rows: DMatrix::from_fn(rows.len(), self.lengths.len(), |i, k| rows[i].0[k]),
            right: DVector::from_iterator(rows.len(), rows.iter().map(|(_, right)| *right)),
        }
    }

    /// The jerk of the runs with the smallest part of its limits, if that is no more than all of them.
    fn programme(&self) -> Option<Vec<f64>> {
        let n = self.lengths.len();
        let unit = self.task.full_jerk();
        let mut cost = vec![0.0; n + 1];
        cost[n] = 1.0;
        let mut programme = Programme::new(cost);
        let Ends { rows, right } = self.ends();
        for (row, right) in rows.row_iter().zip(right.iter()) {
            let terms = row.iter().map(|c| c * unit).enumerate().collect();
            programme.zero(Affine { terms, constant: -right });
        }
        for Place { pole, tolerated } in &self.task.places {
            let responses = self.responses(&Zero::at(*pole, false));
            let part = |k: usize| Affine {
                terms: responses.iter().map(|r| r[k] * unit / tolerated).enumerate().collect(),
                constant: 0.0,
            };
            programme.cone(Affine { terms: vec![], constant: 1.0 - BAND_ROOM }, part(0), part(1));
        }
        for k in 0..n {
            for (sign, limit) in [(1.0, self.task.jerk.upper), (-1.0, -self.task.jerk.lower)] {
                programme.positive(Affine { terms: vec![(k, -sign), (n, limit / unit)], constant: 0.0 });
            }
        }
        let mut within = |terms: Vec<(usize, f64)>, start: f64, bounds: Interval| {
            for (sign, bound) in [(-1.0, bounds.upper), (1.0, bounds.lower)] {
                if bound.is_finite() {
                    let terms = terms.iter().map(|(k, c)| (*k, sign * c / bound.abs())).collect();
                    let constant = sign * (start - bound) / bound.abs() - ROOM;
                    programme.positive(Affine { terms, constant });
                }
            }
        };
        let lengths = &self.lengths;
        for end in 1..n {
            // Acceleration and velocity at the start of a run, and the middle Bernstein coefficient of its velocity.
            let mut rest: f64 = lengths[..end].iter().sum();
            let (mut steep, mut fast, mut middle) = (vec![], vec![], vec![]);
            for (k, length) in lengths[..end].iter().enumerate() {
                rest -= length;
                let (a, v) = (length * unit, length * (rest.max(0.0) + 0.5 * length) * unit);
                steep.push((k, a));
                fast.push((k, v));
                middle.push((k, v + 0.5 * a * lengths[end]));
            }
            within(steep, 0.0, self.task.acceleration);
            within(fast, self.task.from, self.task.velocity);
            within(middle, self.task.from, self.task.velocity);
        }
        let (x, part) = programme.solved_to(1e-9)?;
        (part <= 1.0 - ROOM).then(|| x.iter().take(n).map(|jerk| jerk * unit).collect())
    }

    /// The jerk nearest to a solution of the programme with which end and zeros hold to rounding.
    fn exact(&self, jerk: Vec<f64>) -> Option<Vec<f64>> {
        let Ends { rows, right } = self.ends();
        let mut jerk = DVector::from_vec(jerk);
        let svd = rows.clone().try_svd(true, true, f64::EPSILON, 1000)?;
        for _ in 0..3 {
            let missed = &rows * &jerk - &right;
            jerk -= svd.solve(&missed, 1e-12).ok()?;
        }
        let missed = (&rows * &jerk - &right).amax();
        (missed <= MISSED).then(|| jerk.iter().copied().collect())
    }
}
