//! What the switching function asks for.

use profiles::switched::Arc;

use super::costate::Costate;
use super::newton::Optimum;
use super::structure::{Stay, Structure};
use super::task::Task;

/// A part of the switching function that is nothing.
const NOTHING: f64 = 1e-7;
/// Samples of an arc for each rad of the fastest mode, and the most there are.
const DENSITY: f64 = 4.0;
const MOST: f64 = 20_000.0;

/// An interval of an arc in which the switching function asks for something else.
#[derive(Debug, Clone, Copy)]
struct Wanted {
    arc: usize,
    /// Times into the arc.
    from: f64,
    to: f64,
    /// How much, in units of the switching function.
    by: f64,
}

/// What the switching function says of a motion.
pub(super) enum Verdict {
    /// There is none shorter.
    Optimal,
    /// A shorter one has this structure.
    Better(Structure),
    /// It cannot be told.
    Unknown,
}

/// What the switching function asks for most, by samples.
pub(super) fn verdict(task: &Task, structure: &Structure, optimum: &Optimum) -> Verdict {
    let costate = Costate::new(task, structure, optimum);
    let zeros = task.zeros.iter().map(|zero| zero.pole().im);
    let fastest = zeros.chain(structure.places.iter().map(|place| place.pole.im)).fold(1.0, f64::max);
    let mut most: Option<Wanted> = None;
    let mut scale = 0.0_f64;
    for (index, (arc, state)) in structure.arcs.iter().zip(costate.states()).enumerate() {
        // What must not be negative along the arc: a derivative of the switching function, and its sign.
        let (order, sign) = match structure.stay(index) {
            _ if arc.jerk != 0.0 => (0, arc.jerk.signum()),
            Some(Stay::Velocity(limit)) => (2, limit.signum()),
            Some(Stay::Acceleration(limit)) => (1, -limit.signum()),
            None => return Verdict::Unknown,
        };
        let count = (4.0 + arc.duration * fastest * DENSITY).floor();
        if count > MOST {
            return Verdict::Unknown;
        }
        let step = arc.duration / count;
        let samples: Vec<f64> = (0..=count as usize)
            .map(|k| {
                let values = costate.at(index, state.time + step * k as f64);
                scale = scale.max(values[0].abs());
                (-sign * values[order]).max(0.0)
            })
            .collect();
        for (first, run) in runs(&samples) {
            let (from, to) = (step * (first as f64 - 0.5), step * ((first + run.len()) as f64 - 0.5));
            let (from, to) = (from.max(0.0), to.min(arc.duration));
            let largest = run.iter().copied().fold(0.0, f64::max);
            let by = largest * (to - from).powi(order as i32);
            if most.is_none_or(|most| by > most.by) {
                most = Some(Wanted { arc: index, from, to, by });
            }
        }
    }
    match most.filter(|wanted| wanted.by > NOTHING * scale) {
        Some(wanted) => Verdict::Better(with(task, structure, wanted)),
        None => Verdict::Optimal,
    }
}

/// Runs of positive samples, with the index of their first one.
fn runs(samples: &[f64]) -> Vec<(usize, &[f64])> {
    let mut runs = Vec::new();
    let mut rest = samples;
    while let Some(skipped) = rest.iter().position(|sample| *sample > 0.0) {
        let run = rest.get(skipped..).unwrap_or_default();
        let length = run.iter().position(|sample| *sample <= 0.0).unwrap_or(run.len());
        let (run, after) = run.split_at(length);
        runs.push((samples.len() - after.len() - length, run));
        rest = after;
    }
    runs
}

/// With another jerk in an interval of an arc.
fn with(task: &Task, structure: &Structure, Wanted { arc: index, from, to, .. }: Wanted) -> Structure {
    let Some(arc) = structure.arcs.get(index) else { return structure.clone() };
    let (middle, width) = (0.5 * (from + to), to - from);
    let piece = |jerk: f64, duration: f64| Arc { jerk, duration: duration.max(0.0) };
    let Some(stay) = structure.stay(index).filter(|_| arc.jerk == 0.0) else {
        let pieces =
            [piece(arc.jerk, from), piece(task.full(-arc.jerk), width), piece(arc.jerk, arc.duration - to)];
        return structure.replaced(index, &pieces, |_| vec![]);
    };
    // Away from the limit and back to it, for about half of the interval.
    let pieces = match stay {
        Stay::Velocity(limit) => {
            let part = 0.15 * width;
            let (away, back) = (task.full(-limit), task.full(limit));
            vec![
                piece(0.0, middle - 2.0 * part),
                piece(away, part),
                piece(back, 2.0 * part),
                piece(away, part),
                piece(0.0, arc.duration - middle - 2.0 * part),
            ]
        }
        Stay::Acceleration(limit) => {
            let part = 0.3 * width;
            vec![
                piece(0.0, middle - part),
                piece(task.full(-limit), part),
                piece(task.full(limit), part),
                piece(0.0, arc.duration - middle - part),
            ]
        }
    };
    structure.replaced(index, &pieces, |first| stay.contacts(first + pieces.len() - 1))
}
