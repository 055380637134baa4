//! From jerk on a grid to arcs, and to a finer grid.

use profiles::switched::{Arc, Zero};

use super::Motion;
use super::band::peaks;
use super::grid::OnGrid;
use super::structure::{Blur, Structure, push};
use super::task::{Place, Task};

/// A part of the full jerk that is all of it, or none.
const LEVEL: f64 = 0.005;
/// A part of what is tolerated that makes a band full on a grid.
const FULL: f64 = 0.95;

/// The structure of jerk on a grid.
///
/// A cell with a part of the full jerk is one in which the jerk switches. Beside a cell that is full it continues that
/// one; what is left of it is no jerk at a limit only if it lasts for a cell or more, else the moment in which the sign
/// changes, or a short stretch of the other sign.
pub(super) fn structure(task: &Task, found: &OnGrid) -> Option<Structure> {
    let finest = found.cells.iter().copied().fold(f64::INFINITY, f64::min);
    let blur = Blur { shortest: 0.02 * finest, acceleration: 0.05, velocity: 0.01, turn: 0.0 };
    let structure = Structure::of(task, &cleared(task, &stretches(task, found)), blur)?;
    Some(if task.bands.is_empty() { structure } else { with_bands(task, found, structure) })
}

/// With the places at which bands are full on the grid, and with durations that leave there what the grid does: what is left
/// depends so much on them that reading them off does not tell.
fn with_bands(task: &Task, found: &OnGrid, structure: Structure) -> Structure {
    let cells = found.arcs();
    let full = |place: &Place| place.part(&cells) >= FULL;
    let places: Vec<Place> = peaks(task, &cells).into_iter().filter(full).collect();
    let left: Vec<Zero> =
        places.iter().map(|place| Zero::at(place.pole, false).with_rest(place.response(&cells))).collect();
    let near = Motion::new(task.from, &structure.arcs)
        .and_then(|motion| motion.corrected(&task.goal, &left, &structure.contacts));
    let arcs = near.map_or(structure.arcs, |motion| motion.arcs().to_vec());
    Structure { arcs, places, ..structure }
}

/// An arc and the longest of the cells in which it lies.
type Stretch = (Arc, f64);

/// Full and no jerk as the cells have it.
fn stretches(task: &Task, found: &OnGrid) -> Vec<Stretch> {
    let parts: Vec<f64> = found.jerk.iter().map(|jerk| jerk / task.full(*jerk)).collect();
    let full_beside = |k: Option<usize>, jerk: f64| {
        let beside = k.and_then(|k| parts.get(k).zip(found.jerk.get(k)));
        beside.is_some_and(|(part, other)| *part > 0.5 && other * jerk > 0.0)
    };
    let mut stretches: Vec<Stretch> = Vec::new();
    let mut add = |jerk: f64, duration: f64, cell: f64| match stretches.last_mut() {
        Some((last, longest)) if last.jerk.total_cmp(&jerk).is_eq() => {
            last.duration += duration;
            *longest = longest.max(cell);
        }
        _ => stretches.push((Arc { jerk, duration }, cell)),
    };
    for (k, ((part, jerk), cell)) in parts.iter().zip(&found.jerk).zip(&found.cells).enumerate() {
        let full = task.full(*jerk);
        let (pushed, rest) = (part * cell, (1.0 - part) * cell);
        if *part > 1.0 - LEVEL {
            add(full, *cell, *cell);
        } else if *part < LEVEL {
            add(0.0, *cell, *cell);
        } else if full_beside(k.checked_sub(1), *jerk) || !full_beside(Some(k + 1), *jerk) {
            add(full, pushed, *cell);
            add(0.0, rest, *cell);
        } else {
            add(0.0, rest, *cell);
            add(full, pushed, *cell);
        }
    }
    stretches
}

/// The arcs, with what is shorter than a cell taken for what it stands for.
fn cleared(task: &Task, stretches: &[Stretch]) -> Vec<Arc> {
    let mut arcs = Vec::new();
    for (k, (arc, cell)) in stretches.iter().enumerate() {
        let neighbours = k.checked_sub(1).and_then(|k| stretches.get(k)).zip(stretches.get(k + 1));
        if arc.jerk != 0.0 || arc.duration > 0.999 * cell {
            push(&mut arcs, arc.jerk, arc.duration);
        } else if let Some(((before, _), (after, _))) = neighbours {
            let (first, second) = (before.jerk, after.jerk);
            if first * second > 0.0 && arc.duration > 0.02 * cell {
                // No jerk on average: half of the time the other way.
                push(&mut arcs, first, 0.25 * arc.duration);
                push(&mut arcs, task.full(-first), 0.5 * arc.duration);
                push(&mut arcs, first, 0.25 * arc.duration);
            } else {
                push(&mut arcs, first, 0.5 * arc.duration);
                push(&mut arcs, second, 0.5 * arc.duration);
            }
        }
    }
    arcs
}

/// The cells again, those near a switch cut in `parts`.
pub(super) fn refined(task: &Task, found: &OnGrid, parts: usize) -> Vec<f64> {
    // Full up, full down, none, or a part of its own.
    let level = |k: usize| {
        let jerk = found.jerk.get(k).copied().unwrap_or(0.0);
        let part = jerk / task.full(jerk);
        if part < LEVEL {
            0
        } else if part > 1.0 - LEVEL {
            if jerk > 0.0 { 1 } else { -1 }
        } else {
            k as i64 + 2
        }
    };
    let last = found.cells.len().saturating_sub(1);
    let mut cells = Vec::new();
    for (k, cell) in found.cells.iter().enumerate() {
        let here = level(k);
        let switches = here > 1 || level(k.saturating_sub(1)) != here || level((k + 1).min(last)) != here;
        let count = if switches { parts } else { 1 };
        cells.extend(std::iter::repeat_n(cell / count as f64, count));
    }
    cells
}
