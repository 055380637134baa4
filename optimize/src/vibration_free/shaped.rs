//! The S-curve through a zero-vibration shaper for every mode, as a motion that no optimum is longer than.

use std::f64::consts::PI;

use profiles::switched::{Arc, Zero};

use super::task::Task;
use super::{MOST_ARCS, Motion};

/// Instants closer than this, as a part of the S-curve's duration, are one.
const SAME: f64 = 1e-14;

/// The S-curve convolved with impulses half a damped period apart, two for a zero and three for a double one; none with bands,
/// or where it would have too many arcs.
pub(super) fn shaped(task: &Task) -> Option<Motion> {
    if !task.bands.is_empty() || task.zeros.is_empty() {
        return None;
    }
    let mut jumps = jumps(&task.plain);
    for zero in &task.zeros {
        let train = train(zero);
        let delayed = |jump: Jump| train.iter().map(move |(delay, part)| jump.delayed(*delay, *part));
        jumps = jumps.iter().copied().flat_map(delayed).collect();
        if jumps.len() > 4 * MOST_ARCS {
            return None;
        }
    }
    jumps.sort_by(|a, b| a.instant().total_cmp(&b.instant()));
    let mut arcs: Vec<Arc> = Vec::new();
    let mut jerk = 0.0;
    for (k, jump) in jumps.iter().enumerate() {
        jerk += jump.by;
        let length = jumps.get(k + 1).map_or(0.0, |next| next.since(jump));
        if length > SAME {
            arcs.push(Arc { jerk, duration: length });
        }
    }
    Motion::new(task.from, &arcs)
}

/// A jump of the jerk.
#[derive(Debug, Clone, Copy)]
struct Jump {
    by: f64,
    /// When it is, counted from `from`: the start or the end of the S-curve, so that short arcs of a long motion keep their
    /// length.
    after: f64,
    from: f64,
}

impl Jump {
    fn delayed(self, delay: f64, part: f64) -> Self {
        Self { by: self.by * part, after: self.after + delay, ..self }
    }

    fn instant(&self) -> f64 {
        self.from + self.after
    }

    fn since(&self, before: &Self) -> f64 {
        (self.from - before.from) + (self.after - before.after)
    }
}

/// The jumps of arcs: those of the first half from the start, the others from the end.
fn jumps(arcs: &[Arc]) -> Vec<Jump> {
    let end: f64 = arcs.iter().map(|arc| arc.duration).sum();
    let mut after = 0.0;
    let mut before = 0.0;
    let mut jumps = Vec::new();
    for arc in arcs.iter().chain([&Arc::default()]) {
        jumps.push(Jump { by: arc.jerk - before, after, from: 0.0 });
        after += arc.duration;
        before = arc.jerk;
    }
    let mut left = 0.0;
    for (jump, arc) in jumps.iter_mut().rev().zip([Arc::default()].iter().chain(arcs.iter().rev())) {
        left += arc.duration;
        if jump.after > 0.5 * end {
            (jump.after, jump.from) = (-left, end);
        }
    }
    jumps
}

/// Delays and parts of the impulses that a zero takes.
fn train(zero: &Zero) -> Vec<(f64, f64)> {
    let half = PI / zero.pole().im;
    let left = (zero.pole().re * half).exp();
    let unit = 1.0 + left;
    if zero.is_double() {
        let [a, b, c] = [1.0, 2.0 * left, left * left].map(|part| part / (unit * unit));
        vec![(0.0, a), (half, b), (2.0 * half, c)]
    } else {
        vec![(0.0, 1.0 / unit), (half, left / unit)]
    }
}
