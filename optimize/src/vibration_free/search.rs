//! From a grid to the optimum.

use super::band;
use super::error::VibrationFreeError;
use super::exchange::{Found, exchanged, shorter};
use super::grid::OnGrid;
use super::reading;
use super::runs::Runs;
use super::shaped::shaped;
use super::structure::Structure;
use super::task::Task;
use super::{MOST_ARCS, Motion};

/// Cells of the first grid for each rad of the fastest mode, and the fewest and the most there are.
const DENSITY: f64 = 1.5;
const FEWEST: f64 = 64.0;
const MOST: f64 = 240.0;
/// By how much longer than the shortest a motion is tried with a jerk that is not always full.
const LONGER: [f64; 11] = [3e-4, 6e-4, 1e-3, 2e-3, 4e-3, 8e-3, 0.02, 0.05, 0.2, 0.5, 1.0];
/// Bisections between the longest that fails and the shortest that does not.
const BISECTIONS: usize = 4;
/// The most cells of a finer grid.
const FINEST: usize = 480;
/// Cells into which one near a switch is cut.
const PARTS: usize = 3;
/// A distance close enough to that asked for to cut cells again.
const NEAR: f64 = 3e-3;
/// And one that tells the structure.
const TELLING: f64 = 0.1;
/// A distance that is none.
const NOWHERE: f64 = 1e-12;
/// The most grids.
const ROUNDS: usize = 14;
/// Of the grids that tell the structure, those at which Newton's method gets aid, which takes longer than a finer grid.
const AIDED: &[usize] = &[3, 4, 5];
/// The same for bands, with which a programme takes longer yet.
const AIDED_WITH_BANDS: &[usize] = &[3, 5];

/// The shortest motion: the duration in which the furthest motion on a grid gets to the goal, by the secant rule for its
/// logarithm, and from every grid but the first, where the jerk switches, the optimum by exchange.
pub(super) fn searched(task: &Task) -> Result<Found, VibrationFreeError> {
    // The places of bands grow from grid to grid.
    let mut task = task.clone();
    let count = (DENSITY * task.fastest()).clamp(FEWEST, MOST) as usize;
    let mut cells = vec![1.0; count];
    let (mut early, mut late) = (1.0, task.longest);
    let mut duration = 1.0 + 0.2 * (task.longest - 1.0);
    let mut last: Option<(f64, f64)> = None;
    let mut best: Option<Found> = None;
    let mut missed = f64::INFINITY;
    let mut runs = vec![];
    let aided = if task.bands.is_empty() { AIDED } else { AIDED_WITH_BANDS };
    let mut told = 0;
    for round in 0..ROUNDS {
        let unit = duration / cells.iter().sum::<f64>();
        let Some(found) = OnGrid::furthest(&task, cells.iter().map(|cell| cell * unit).collect()) else {
            break;
        };
        let beyond = found.reached - 1.0;
        let arcs = found.arcs();
        task.add_places(band::peaks(&task, &arcs), &arcs);
        missed = beyond.abs();
        if round > 0 && missed < TELLING {
            told += 1;
            let structure = reading::structure(&task, &found);
            match structure.and_then(|structure| exchanged(&task, structure, None, aided.contains(&told))) {
                Some(found) if found.is_proven() => return Ok(found),
                Some(found) => best = Some(shorter(best, found)),
                None => {}
            }
        }
        runs = reading::runs(&task, &found);
        if round == 0 || missed < NEAR {
            let finer = reading::refined(&task, &found, PARTS);
            if finer.len() <= FINEST {
                cells = finer;
            }
        }
        if beyond < 0.0 {
            early = duration;
        } else {
            late = duration;
        }
        if aided.last().is_none_or(|last| told >= *last) {
            break;
        }
        // Distances grow with a power of the time.
        let here = (duration.ln(), found.reached.max(NOWHERE).ln());
        let power = last.map_or(2.0, |before| (here.1 - before.1) / (here.0 - before.0));
        last = Some(here);
        duration *= (-here.1 / power).exp();
        if !(duration > early && duration < late) {
            duration = 0.5 * (early + late);
        }
    }
    let shaped = shaped(&task).map(|motion| {
        let structure = Structure { arcs: motion.arcs().to_vec(), ..Structure::default() };
        Found { structure, motion, multipliers: None }
    });
    // Nothing here is proven: what lasts longer than the grid says is not the best there is.
    let close = |found: &Found| found.motion.duration() <= duration * (1.0 + LONGER[1]);
    let freely = if best.as_ref().is_some_and(close) { None } else { freely(&task, &runs, duration) };
    shaped
        .into_iter()
        .chain(freely)
        .fold(best, |best, found| Some(shorter(best, found)))
        .ok_or(VibrationFreeError::NotConverged { violation: missed })
}

/// A motion in little more than the shortest time whose jerk is not always full: with the runs of a grid, where these are no
/// more than a motion may have, or equal ones.
fn freely(task: &Task, runs: &[f64], shortest: f64) -> Option<Found> {
    let equal = [1.0; MOST_ARCS];
    let grids = [runs, &equal].into_iter().filter(|grid| grid.len() <= MOST_ARCS);
    let at = |longer: f64| grids.clone().find_map(|grid| on(task, grid, shortest * (1.0 + longer)));
    let mut early = 0.0;
    for late in LONGER {
        let Some(mut best) = at(late) else {
            early = late;
            continue;
        };
        let mut late = late;
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (early + late);
            match at(middle) {
                Some(found) => (best, late) = (found, middle),
                None => early = middle,
            }
        }
        return Some(best);
    }
    None
}

/// A motion on a grid, of a duration.
fn on(task: &Task, grid: &[f64], duration: f64) -> Option<Found> {
    let unit = duration / grid.iter().sum::<f64>();
    let cells: Vec<f64> = grid.iter().map(|cell| cell * unit).collect();
    let arcs = Runs::kept(task, cells)?;
    let motion = Motion::new(task.from, &arcs)?;
    let structure = Structure { arcs, ..Structure::default() };
    Some(Found { structure, motion, multipliers: None })
}
