//! What a response says of its vibration: the paper's reading, the exact one, and a fit.

use anyhow::Result;
use identify::{
    ClassifiedResponse, DecrementError, ResponseClass, ResponseClassifier, Signal, SinusoidOptions,
    fit_damped_sinusoids,
};
use profiles::Mode;

use super::servo::Response;

/// This file, from the root of the repository.
pub(super) const FILE: &str = file!();

/// A damping ratio and an undamped angular frequency in rad/s.
pub(super) type Vibration = (f64, f64);

/// What table 2 says of a response.
pub(super) struct Reading {
    pub(super) class: ResponseClass,
    /// Into the band, s; `None` where the record ends before.
    pub(super) settling: Option<f64>,
    /// By the formulas (9), (10), (13), (14) as printed, for small damping.
    pub(super) printed: Option<Vibration>,
    /// By the exact forms from the same peaks.
    pub(super) exact: Option<Vibration>,
    /// The damping ratio by (13) from the first peak and the trough after it, whatever the class.
    pub(super) half_cycle: Option<f64>,
}

/// Reads a move to `target`, whose settling band is `band`, a part of the move.
pub(super) fn read(response: &Response, target: f64, band: f64) -> Result<Reading> {
    let signal = Signal::sampled(&response.load, response.period)?;
    let classified = classify(&response.load, response.period, target, THRESHOLD)?;
    let decrement = classified.decrement(&signal, target).ok().flatten();
    let printed = decrement.and_then(|d| {
        let z = d.small_damping_ratio();
        (z < 1.0).then(|| (z, d.damped_angular_frequency() / (1.0 - z * z).sqrt()))
    });
    Ok(Reading {
        class: classified.class,
        settling: signal.settling_time(target, band * target.abs()).ok(),
        printed,
        exact: decrement.map(|d| (d.damping_ratio(), d.angular_frequency())),
        half_cycle: match classified.half_cycle(&signal, target) {
            Ok(decrement) => decrement.map(|decrement| decrement.small_damping_ratio()),
            Err(DecrementError::Growing { damping_ratio, .. }) => Some(damping_ratio),
            Err(_) => None,
        },
    })
}

/// Peaks nearer to the target than this part of the move are dropped.
const THRESHOLD: f64 = 1e-4;

/// Every local maximum counts that is not nearer to the target than `threshold`, a part of the move.
fn classify(angle: &[f64], period: f64, target: f64, threshold: f64) -> Result<ClassifiedResponse> {
    let classifier = ResponseClassifier { threshold, prominence: 0.0, ..ResponseClassifier::default() };
    Ok(classifier.classify(&Signal::sampled(angle, period)?, 0.0, target)?)
}

/// The class by other readings of a rule that the paper leaves open: of the motor's angle, with every peak however small,
/// and with the peaks above 1 % of the move alone.
pub(super) fn other_classes(response: &Response, target: f64) -> Result<[(&'static str, ResponseClass); 3]> {
    let class = |angle: &[f64], threshold| -> Result<ResponseClass> {
        Ok(classify(angle, response.period, target, threshold)?.class)
    };
    Ok([
        ("motor", class(&response.motor(), THRESHOLD)?),
        ("every-peak", class(&response.load, 0.0)?),
        ("coarse", class(&response.load, 0.01)?),
    ])
}

/// The smallest amplitude of a mode that counts, as a part of the largest: below what an encoder of 20 bits shows.
const SEEN: f64 = 1e-6;

/// The modes of a fit of damped sinusoids to what follows `start` in s, the one that swings longest for its size first; none
/// where there is none. Without noise the fit goes on to describe its own rounding: what is below [`SEEN`] is not counted.
pub(super) fn fitted(response: &Response, start: f64) -> Vec<Mode> {
    let tail = response.load.get(response.index(start)..).unwrap_or_default();
    let Ok(decay) = fit_damped_sinusoids(tail, response.period, &SinusoidOptions::default()) else {
        return Vec::new();
    };
    let lasting = decay.lasting_mode().map(|estimate| estimate.mode);
    let largest = decay.modes.iter().map(|estimate| estimate.amplitude).fold(0.0, f64::max);
    let seen = decay.modes.iter().filter(|estimate| estimate.amplitude > SEEN * largest);
    let others = seen.map(|estimate| estimate.mode).filter(|mode| Some(*mode) != lasting);
    lasting.into_iter().chain(others).collect()
}

/// Of some modes the one whose pole is nearest to that of a vibration.
pub(super) fn nearest(modes: &[Mode], (damping, frequency): Vibration) -> Option<Mode> {
    let wanted = Mode::new(frequency, damping).ok()?.pole();
    let distance = |mode: &Mode| (mode.pole() - wanted).norm();
    modes.iter().copied().min_by(|a, b| distance(a).total_cmp(&distance(b)))
}
