//! What every method does with a task, and what that comes to over many.

use anyhow::{Context as _, Result};
use rayon::prelude::*;

use super::command::{Command, part_left};
use super::methods::{METHODS, Method};
use super::setup::{BAND, OFF, Task};
use super::simulation::{Watch, course};

/// This file, from the root of the repository.
pub(super) const FILE: &str = file!();

/// Two times as near as this are equal, s: what a straight line between two samples may be off.
const EQUAL: f64 = 1e-5;

/// One method on one task.
#[derive(Clone, Copy, Debug)]
pub(super) struct Judged {
    /// When the command is at rest, s.
    pub(super) duration: f64,
    /// Move and settling with the plant as it is told, s.
    pub(super) nominal: f64,
    /// The longer one of the plants that are off, s.
    pub(super) off: f64,
    /// Vibration at the end that the plant as it is told keeps, and the larger one of the plants that are off, of the move.
    pub(super) left: (f64, f64),
    /// What simulation and closed form differ by at most, of the move.
    pub(super) disagreement: f64,
    /// Whether it is proven to be the shortest of its kind; none where the search for it did not converge.
    pub(super) proven: Option<bool>,
}

impl Judged {
    /// A move that there is not.
    fn missing() -> Self {
        let never = f64::INFINITY;
        Self {
            duration: never,
            nominal: never,
            off: never,
            left: (0.0, 0.0),
            disagreement: 0.0,
            proven: None,
        }
    }
}

/// The command of a method; a search may fail and is counted, a formula may not.
fn planned(method: &Method, task: &Task, seed: u64) -> Result<Option<Command>> {
    match method.plan(task, seed) {
        Err(_) if method.is_optimum() => Ok(None),
        command => command.map(Some),
    }
}

/// When the command of a method is at rest, s; infinite where there is none.
pub(super) fn duration(method: &Method, task: &Task, seed: u64) -> Result<f64> {
    Ok(planned(method, task, seed)?.map_or(f64::INFINITY, |command| command.duration(BAND)))
}

/// All methods on one task, in their order.
pub(super) fn judge(task: &Task, seed: u64) -> Result<Vec<Judged>> {
    METHODS
        .iter()
        .map(|method| {
            let Some(command) = planned(method, task, seed)? else { return Ok(Judged::missing()) };
            let mut judged = Judged {
                duration: command.duration(BAND),
                nominal: 0.0,
                off: 0.0,
                left: (0.0, 0.0),
                disagreement: 0.0,
                proven: Some(command.proven),
            };
            for part in [1.0 - OFF, 1.0, 1.0 + OFF] {
                let mode = task.mode_at(part)?;
                let course = course(&command, mode, Watch { band: task.band(), until: 0.0 })?;
                let settled = course.settled(task.length, task.band())?;
                let left = part_left(&command, mode, task.length)?;
                if mode == task.mode {
                    (judged.nominal, judged.left.0) = (settled, left);
                } else {
                    judged.off = judged.off.max(settled);
                    judged.left.1 = judged.left.1.max(left);
                }
                judged.disagreement = judged.disagreement.max(course.disagreement.abs() / task.length);
            }
            Ok(judged)
        })
        .collect::<Result<_>>()
        .with_context(|| format!("{task:?}"))
}

/// All methods on all tasks, in their order, whatever the number of threads.
pub(super) fn judge_all(tasks: &[Task], seed: u64, done: impl Fn() + Sync) -> Result<Vec<Vec<Judged>>> {
    let judged = |task: &Task| {
        let judged = judge(task, seed);
        done();
        judged
    };
    tasks.par_iter().map(judged).collect()
}

/// Whether the plant is as it was told.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Plant {
    Nominal,
    Off,
}

impl Plant {
    pub(super) fn id(self) -> &'static str {
        match self {
            Self::Nominal => "nominal",
            Self::Off => "off",
        }
    }

    /// Move and settling, s.
    pub(super) fn time(self, judged: &Judged) -> f64 {
        match self {
            Self::Nominal => judged.nominal,
            Self::Off => judged.off,
        }
    }
}

/// The method that is at rest soonest; of equal ones the first.
pub(super) fn winner(judged: &[Judged], plant: Plant) -> usize {
    let least = judged.iter().map(|j| plant.time(j)).fold(f64::INFINITY, f64::min);
    judged.iter().position(|j| plant.time(j) <= least + EQUAL).unwrap_or(0)
}

/// Mean and median of how much sooner one method is at rest than another, where there are both, s.
pub(super) fn saved(all: &[Vec<Judged>], plant: Plant, by: usize, over: usize) -> (f64, f64) {
    let mut saved: Vec<f64> =
        all.iter().map(|j| plant.time(&j[over]) - plant.time(&j[by])).filter(|s| s.is_finite()).collect();
    saved.sort_by(f64::total_cmp);
    let mean = saved.iter().sum::<f64>() / saved.len() as f64;
    let middle = saved.len() / 2;
    let median = if saved.len() % 2 == 1 { saved[middle] } else { 0.5 * (saved[middle - 1] + saved[middle]) };
    (mean, median)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn judged(nominal: f64, off: f64) -> Judged {
        Judged { duration: 0.1, nominal, off, left: (0.0, 0.0), disagreement: 0.0, proven: Some(false) }
    }

    #[test]
    fn the_first_of_equals_wins() {
        let all = [
            judged(0.3, 0.9),
            judged(0.2 + 0.5 * EQUAL, 0.5),
            judged(0.2, 0.5),
            judged(0.2, 0.5 - 2.0 * EQUAL),
        ];
        assert_eq!((winner(&all, Plant::Nominal), winner(&all, Plant::Off)), (1, 3));
    }

    #[test]
    fn savings_by_hand() {
        let all =
            [(0.3, 0.1), (0.2, 0.3), (0.9, 0.2)].map(|(over, by)| vec![judged(over, 0.0), judged(by, 0.0)]);
        // 0.2, -0.1 and 0.7
        let (mean, median) = saved(&all, Plant::Nominal, 1, 0);
        assert!((mean - 0.8 / 3.0).abs() < 1e-15 && (median - 0.2).abs() < 1e-15, "{mean} {median}");
        let (_, median) = saved(&all[..2], Plant::Nominal, 1, 0);
        assert!((median - 0.05).abs() < 1e-15, "{median}");
    }
}
