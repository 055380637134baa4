//! What a log of command and response says of an axis.

mod decay;
mod error;
mod pool;
mod rest;
mod step;
mod transfer;

use profiles::Mode;

use crate::error::SignalError;
use crate::response_class::ClassifiedResponse;
use crate::signal::Signal;
use decay::{decays, median, rests_after_moves};
pub use error::LogError;
use pool::{Pooled, pooled};
pub use rest::Rest;

/// A log of an axis: what it was told and what it did, sampled together.
#[derive(Debug, Clone, Copy)]
pub struct Log<'a> {
    period: f64,
    command: &'a [f64],
    response: &'a [f64],
}

/// Where the modes of a log are looked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Route {
    /// In what goes on swinging while the command rests; where nothing does, in the transfer function.
    #[default]
    Either,
    /// In what goes on swinging while the command rests.
    FreeDecay,
    /// In the transfer function from command to response.
    TransferFunction,
}

/// What counts as a mode.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct LogOptions {
    /// Where modes are looked for.
    pub route: Route,
    /// The largest damping ratio of a mode; what swings with more is at rest after a swing.
    pub largest_damping: f64,
    /// The smallest amplitude of a mode, as a part of the largest mode's.
    pub least_part: f64,
    /// The most modes reported.
    pub most: usize,
}

impl Default for LogOptions {
    /// Either route, a damping ratio up to 0.5, an amplitude from 1 % of the largest, four modes.
    fn default() -> Self {
        Self { route: Route::Either, largest_damping: 0.5, least_part: 0.01, most: 4 }
    }
}

/// A mode of an axis as its log shows it.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct LogMode {
    /// Undamped angular frequency in rad/s and damping ratio.
    pub mode: Mode,
    /// Standard deviation of the undamped angular frequency that the next move has to reckon with, rad/s.
    pub frequency_deviation: f64,
    /// Standard deviation of the damping ratio.
    pub damping_deviation: f64,
    /// Largest amplitude in the log, in the unit of the response.
    pub amplitude: f64,
    /// How far the response swings under a command by which a load on a spring, driven at the other end of it, swings by
    /// one: in units of the response over those of the command. None where the log's command does not drive the mode.
    pub participation: Option<f64>,
    /// Views of the log in which the mode was found: windows of a decay, or models.
    pub found: usize,
}

/// A curve beside the response of a log.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Fitted {
    /// The sample of the log at which it begins.
    pub first: usize,
    /// A value for this sample and those after it, in the unit of the response.
    pub values: Vec<f64>,
}

/// What a log says of an axis.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct LogModes {
    /// Where the modes were found: never [`Route::Either`].
    pub route: Route,
    /// The modes, at least one, the largest amplitude first.
    pub modes: Vec<LogMode>,
    /// Views of the log that were compared: windows of decays, or models.
    pub views: usize,
    /// Rests of the command after a move.
    pub rests: Vec<Rest>,
    /// Poles and zeros of the best transfer function, where one was fitted.
    pub order: Option<(usize, usize)>,
    /// Gain of that transfer function at frequency zero.
    pub dc_gain: Option<f64>,
    /// Samples averaged to one before the fit.
    pub block: usize,
    /// The model's curve.
    pub fitted: Fitted,
    /// How much of the response it reproduces where it stands, percent: [`fit_percentage`](crate::fit_percentage).
    pub fit: f64,
    /// Standard deviation of what it leaves, in the unit of the response.
    pub residual: f64,
}

/// What can be said of a log whether it has a mode or not.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct LogFigures {
    /// Standard deviation of the noise from sample to sample, in the unit of the response.
    pub noise: f64,
    /// Step between values of the response where all are multiples of one: the count of an encoder; else zero.
    pub quantum: f64,
    /// What the response moves by over what the command does, from rest to rest; none where the log shows no such move.
    pub gain: Option<f64>,
    /// The response to the largest move of the command, by its class; none where the log shows no move from rest to rest.
    pub class: Option<ClassifiedResponse>,
}

impl<'a> Log<'a> {
    /// A log sampled every `period` s.
    ///
    /// # Errors
    /// Columns of different lengths or of fewer than 64 samples, values that are not finite, a period that is not
    /// positive and finite, a response that never changes.
    pub fn new(period: f64, command: &'a [f64], response: &'a [f64]) -> Result<Self, LogError> {
        const FEWEST: usize = 64;
        if command.len() != response.len() {
            return Err(SignalError::Lengths { times: command.len(), values: response.len() }.into());
        }
        Signal::sampled(command, period)?;
        Signal::sampled(response, period)?;
        if response.len() < FEWEST {
            return Err(LogError::TooShort { samples: response.len(), needed: FEWEST });
        }
        if range(response) <= 0.0 {
            return Err(LogError::Still { quantity: "response", value: response[0] });
        }
        Ok(Self { period, command, response })
    }

    /// Sample period, s.
    #[must_use]
    pub fn period(&self) -> f64 {
        self.period
    }

    fn command_range(&self) -> f64 {
        range(self.command)
    }

    /// Noise, resolution, gain and class.
    #[must_use]
    pub fn figures(&self) -> LogFigures {
        let (noise, quantum) = (self.noise(), quantum(self.response));
        let step = step::largest(self);
        LogFigures {
            noise,
            quantum,
            gain: step.map(|step| step.gain()),
            class: step.and_then(|step| step.class(self, noise, quantum)),
        }
    }

    /// From third differences, which hold little of what is slow: the median of their magnitudes is `0.6745 sqrt(20)`
    /// times the standard deviation of white noise.
    fn noise(&self) -> f64 {
        let third: Vec<f64> = self
            .response
            .windows(4)
            .filter_map(|w| <[f64; 4]>::try_from(w).ok())
            .map(|[a, b, c, d]| (d - 3.0 * c + 3.0 * b - a).abs())
            .collect();
        median(&third) / (0.6745 * 20_f64.sqrt())
    }
}

/// The modes of an axis from a log of its command and its response.
///
/// While the command rests the response decays freely: [`fit_damped_sinusoids`](crate::fit_damped_sinusoids) in windows
/// of every rest that follows a move. Where nothing is found there, transfer functions of several orders are fitted to
/// the whole log ([`fit_transfer_function`](crate::fit_transfer_function)). Deviations hold the noise, its colour, and
/// the differences between windows or orders: what the next move has to reckon with. A command that never moves makes
/// the log one decay, after a blow.
///
/// ```
/// use identify::{Log, LogOptions, identify_log};
///
/// // A load on a spring after a step of its drive, with a ripple that is no mode.
/// let command: Vec<f64> = (0..2000).map(|n| if n < 100 { 0.0 } else { 1.0 }).collect();
/// let swing = |t: f64| (-4.0 * t).exp() * (80.0 * t).cos();
/// let response: Vec<f64> = (0..2000)
///     .map(|n| (f64::from(n) - 100.0) * 1e-3)
///     .map(|t| if t < 0.0 { 0.0 } else { 1.0 - swing(t) } + 1e-4 * (t * 1e5).sin())
///     .collect();
/// let found = identify_log(&Log::new(1e-3, &command, &response)?, &LogOptions::default())?;
/// let mode = found.modes[0];
/// assert!((mode.mode.damped_angular_frequency() - 80.0).abs() < 0.01);
/// assert!((mode.mode.damping_ratio() - 0.05).abs() < 1e-3);
/// assert!((mode.participation.ok_or("not driven")? - 1.0).abs() < 0.01);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Why there is no mode: see [`LogError`].
pub fn identify_log(log: &Log<'_>, options: &LogOptions) -> Result<LogModes, LogError> {
    match options.route {
        Route::FreeDecay => from_decays(log, options),
        Route::TransferFunction => from_transfers(log, options),
        // A command that never moves has no transfer function.
        Route::Either if log.command_range() <= 0.0 => from_decays(log, options),
        Route::Either if rested(log) => from_decays(log, options)
            .or_else(|why| from_transfers(log, options).map_err(|other| telling(why, other))),
        Route::Either => from_transfers(log, options)
            .or_else(|other| from_decays(log, options).map_err(|why| telling(why, other))),
    }
}

/// Whether the command rests after moves for a good part of the log; in a short rest slow modes cannot be told.
fn rested(log: &Log<'_>) -> bool {
    const GOOD: f64 = 0.2;
    let rests: usize = rests_after_moves(log).iter().map(Rest::samples).sum();
    rests as f64 >= GOOD * log.response.len() as f64
}

/// Of two reasons the one that says more of the axis.
fn telling(decay: LogError, transfer: LogError) -> LogError {
    match (decay, transfer) {
        (LogError::NoRest { .. }, other) => other,
        (why, _) => why,
    }
}

fn from_decays(log: &Log<'_>, options: &LogOptions) -> Result<LogModes, LogError> {
    const NEEDED: usize = 32;
    let rests = rests_after_moves(log);
    if rests.is_empty() {
        let longest = rest::rests(log.command, 1e-2 * log.command_range(), 1);
        let longest = longest.iter().filter(|rest| rest.first > 0).map(Rest::samples).max().unwrap_or(0);
        return Err(LogError::NoRest { longest, needed: NEEDED });
    }
    let quantum = quantum(log.response);
    let found = decays(log, rests, log.noise(), quantum);
    if let Some(why) = found.why {
        return Err(why);
    }
    let modes = selected(&pooled(&found.views), found.views.len(), quantum, options, found.nothing)?;
    let fitted = found.fitted.unwrap_or(Fitted { first: 0, values: Vec::new() });
    Ok(LogModes {
        route: Route::FreeDecay,
        modes,
        views: found.views.len(),
        rests: found.rests,
        order: None,
        dc_gain: None,
        block: 1,
        fitted,
        fit: found.fit,
        residual: found.noise,
    })
}

fn from_transfers(log: &Log<'_>, options: &LogOptions) -> Result<LogModes, LogError> {
    if log.command_range() <= 0.0 {
        let value = log.command.first().copied().unwrap_or(0.0);
        return Err(LogError::Still { quantity: "command", value });
    }
    let found = transfer::transfers(log)?;
    let modes =
        selected(&pooled(&found.views), found.views.len(), quantum(log.response), options, found.nothing)?;
    Ok(LogModes {
        route: Route::TransferFunction,
        modes,
        views: found.views.len(),
        rests: rests_after_moves(log),
        order: Some(found.order),
        dc_gain: Some(found.gain),
        block: found.block,
        fitted: found.fitted,
        fit: found.fit,
        residual: found.noise,
    })
}

/// The groups that are modes; the reason of the strongest where none is, `nothing` where there are no groups.
fn selected(
    groups: &[Pooled],
    views: usize,
    quantum: f64,
    options: &LogOptions,
    nothing: LogError,
) -> Result<Vec<LogMode>, LogError> {
    /// Deviation of the frequency over it, and of the damping ratio, beyond which a mode is a guess.
    const VAGUE: f64 = 0.1;
    /// Norm of a mode over that of the noise below which it may be noise.
    const SURE: f64 = 5.0;
    let strongest = groups
        .iter()
        .filter(|group| group.mode.damping <= options.largest_damping)
        .map(|group| group.mode.amplitude)
        .fold(0.0, f64::max);
    let least = quantum.max(options.least_part * strongest);
    let judged = |group: &Pooled| {
        let seen = group.mode;
        let (angular_frequency, deviation) = (seen.frequency, seen.frequency_deviation);
        let mode = group.mode().filter(|_| seen.damping <= options.largest_damping);
        let Some(mode) = mode else {
            let (damping_ratio, largest) = (seen.damping, options.largest_damping);
            return Err(LogError::Overdamped { angular_frequency, damping_ratio, largest });
        };
        if seen.amplitude < least {
            return Err(LogError::Faint { angular_frequency, amplitude: seen.amplitude, least });
        }
        // By most views: a model too large has modes of its own in every one.
        let confirmed = 2 * group.found > views;
        let vague = deviation > VAGUE * angular_frequency || seen.damping_deviation > VAGUE;
        if !confirmed || vague || seen.significance < SURE {
            return Err(LogError::Vague { angular_frequency, deviation, found: group.found, views });
        }
        Ok(LogMode {
            mode,
            frequency_deviation: deviation,
            damping_deviation: seen.damping_deviation,
            amplitude: seen.amplitude,
            participation: seen.participation,
            found: group.found,
        })
    };
    let (mut modes, mut why) = (Vec::new(), None);
    for group in groups {
        match judged(group) {
            Ok(mode) => modes.push(mode),
            Err(reason) => why = why.or(Some(reason)),
        }
    }
    modes.sort_by(|a, b| b.amplitude.total_cmp(&a.amplitude));
    modes.truncate(options.most.max(1));
    if modes.is_empty() { Err(why.unwrap_or(nothing)) } else { Ok(modes) }
}

fn range(values: &[f64]) -> f64 {
    let (least, most) =
        values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(*x), b.max(*x)));
    most - least
}

/// The largest step of which all differences are multiples, if it is coarser than a thousandth of the range; else zero.
fn quantum(values: &[f64]) -> f64 {
    let range = range(values);
    let steps = || values.windows(2).map(|w| (w[1] - w[0]).abs()).filter(|d| *d > 1e-9 * range);
    let least = steps().fold(f64::INFINITY, f64::min);
    if !(least < f64::INFINITY && least > 1e-5 * range) {
        return 0.0;
    }
    let multiple = |d: f64| (d / least - (d / least).round()).abs() < 1e-3;
    if steps().all(multiple) { least } else { 0.0 }
}
