//! The largest move of a log from rest to rest.

use super::rest::rests;
use super::{Log, Rest};
use crate::response_class::{ClassifiedResponse, ResponseClassifier};
use crate::signal::Signal;

/// A move between two rests.
#[derive(Debug, Clone, Copy)]
pub(super) struct Step {
    before: Rest,
    after: Rest,
    command: f64,
    from: f64,
    to: f64,
}

/// The move over which the command goes farthest; none where no move has a rest on both sides.
pub(super) fn largest(log: &Log<'_>) -> Option<Step> {
    const TOLERANCES: [f64; 3] = [1e-6, 1e-3, 1e-2];
    /// Of a rest at the start of the log a few samples will do: the axis has stood there.
    const FEWEST: usize = 4;
    const LEAST: usize = 32;
    let range = log.command_range();
    if range <= 0.0 {
        return None;
    }
    let standing = |log: &Log<'_>, tolerance: f64| {
        let mut found = rests(log.command, tolerance, FEWEST);
        found.retain(|rest| rest.first == 0 || rest.samples() >= LEAST);
        found
    };
    let found = TOLERANCES.iter().map(|part| standing(log, part * range)).find(|r| r.len() > 1)?;
    let steps = found.windows(2).filter_map(|pair| {
        let (before, after) = (*pair.first()?, *pair.last()?);
        let command = |at: usize| log.command.get(at).copied();
        let moved = command(after.end.checked_sub(1)?)? - command(before.end.checked_sub(1)?)?;
        // At rest the response is where it stands last.
        let (from, to) = (mean_of_end(log.response, before)?, mean_of_end(log.response, after)?);
        // A drift or the end of an excitation is no move.
        (moved.abs() >= 0.5 * range).then_some(Step { before, after, command: moved, from, to })
    });
    steps.max_by(|a, b| a.command.abs().total_cmp(&b.command.abs()))
}

/// Mean of the last eighth of a rest.
fn mean_of_end(response: &[f64], rest: Rest) -> Option<f64> {
    let first = rest.end.checked_sub((rest.samples() / 8).max(1))?;
    let values = response.get(first..rest.end)?;
    Some(values.iter().sum::<f64>() / values.len() as f64)
}

impl Step {
    /// What the response moves by over what the command does.
    pub(super) fn gain(&self) -> f64 {
        (self.to - self.from) / self.command
    }

    /// The class of the response; none where it does not move by more than its noise.
    pub(super) fn class(&self, log: &Log<'_>, noise: f64, quantum: f64) -> Option<ClassifiedResponse> {
        let length = (self.to - self.from).abs();
        // Above the peak-to-peak noise of any record, and a count and a half of the sensor.
        let prominence = (10.0 * noise).max(1.5 * quantum) / length;
        if prominence.is_nan() || prominence >= 0.5 {
            return None;
        }
        let values = log.response.get(self.before.end..self.after.end)?;
        let rule = ResponseClassifier::default();
        let rule = ResponseClassifier {
            prominence: prominence.max(rule.prominence),
            threshold: (0.6 * prominence).max(rule.threshold),
            ..rule
        };
        rule.classify(&Signal::sampled(values, log.period).ok()?, self.from, self.to).ok()
    }
}
