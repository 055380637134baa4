//! From a grid to the optimum.

use super::band;
use super::error::VibrationFreeError;
use super::exchange::{Found, exchanged, shorter};
use super::grid::OnGrid;
use super::reading;
use super::task::Task;

/// Cells of the first grid for each rad of the fastest mode, and the fewest and the most there are.
const DENSITY: f64 = 1.5;
const FEWEST: f64 = 64.0;
const MOST: f64 = 240.0;
/// Cells into which one near a switch is cut.
const PARTS: usize = 3;
/// A distance close enough to that asked for to cut cells again.
const NEAR: f64 = 3e-3;
/// And one that tells the structure.
const TELLING: f64 = 0.1;
/// Grids at which Newton's method gets aid, which takes longer than a finer grid.
const AIDED: &[usize] = &[3, 4, 5, 6, 7];
/// The same for bands, with which a programme takes longer yet.
const AIDED_WITH_BANDS: &[usize] = &[3, 5];

/// The shortest motion: the duration in which the furthest motion on a grid gets to the goal by the secant rule, and from
/// every grid but the first, where the jerk switches, the optimum by exchange.
pub(super) fn searched(task: &Task) -> Result<Found, VibrationFreeError> {
    // The places of bands grow from grid to grid.
    let mut task = task.clone();
    let poles = task.zeros.iter().map(|zero| zero.pole()).chain(task.places.iter().map(|place| place.pole));
    let fastest = poles.map(|pole| pole.norm()).fold(0.0, f64::max);
    let count = (DENSITY * fastest).clamp(FEWEST, MOST) as usize;
    let mut cells = vec![1.0; count];
    let (mut early, mut late) = (1.0, task.longest);
    let mut duration = 1.0 + 0.2 * (task.longest - 1.0);
    let mut last: Option<(f64, f64)> = None;
    let mut best: Option<Found> = None;
    let mut missed = f64::INFINITY;
    let aided = if task.bands.is_empty() { AIDED } else { AIDED_WITH_BANDS };
    for round in 0..=aided.iter().copied().max().unwrap_or(0) {
        let unit = duration / cells.iter().sum::<f64>();
        let Some(found) = OnGrid::furthest(&task, cells.iter().map(|cell| cell * unit).collect()) else {
            break;
        };
        let beyond = found.reached - 1.0;
        let arcs = found.arcs();
        task.add_places(band::peaks(&task, &arcs), &arcs);
        missed = beyond.abs();
        if round > 0 && missed < TELLING {
            let structure = reading::structure(&task, &found);
            match structure
                .and_then(|structure| exchanged(&task, structure, None, usize::from(aided.contains(&round))))
            {
                Some(found) if found.multipliers.is_some() => return Ok(found),
                Some(found) => best = Some(shorter(best, found)),
                None => {}
            }
        }
        if round == 0 || missed < NEAR {
            cells = reading::refined(&task, &found, PARTS);
        }
        if beyond < 0.0 {
            early = duration;
        } else {
            late = duration;
        }
        // Distances grow with time about as fast as the fastest velocity.
        let slope = last.map_or(2.0 / duration, |(before, value)| (beyond - value) / (duration - before));
        last = Some((duration, beyond));
        duration -= beyond / slope;
        if !(duration > early && duration < late) {
            duration = 0.5 * (early + late);
        }
    }
    best.ok_or(VibrationFreeError::NotConverged { violation: missed })
}
