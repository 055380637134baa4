//! Why a log does not say which modes an axis has, with the number that is in the way.

use thiserror::Error;

use crate::error::{SignalError, SinusoidError, TransferFunctionError};

/// Why a log does not say which modes an axis has.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum LogError {
    /// A signal that cannot be.
    #[error(transparent)]
    Signal(#[from] SignalError),
    /// Too few samples to tell a mode from anything.
    #[error("{samples} samples are too few, modes need {needed}")]
    TooShort {
        /// Samples of the log.
        samples: usize,
        /// Samples needed.
        needed: usize,
    },
    /// A command or a response that never changes.
    #[error("the {quantity} is {value} throughout: nothing was moved or nothing was measured")]
    Still {
        /// Which column.
        quantity: &'static str,
        /// Its only value.
        value: f64,
    },
    /// The command is never at rest for long enough to listen to what goes on swinging.
    #[error(
        "after no move does the command rest for the {needed} samples that a free decay needs; the longest rest has \
         {longest}"
    )]
    NoRest {
        /// Samples of the longest rest after a move.
        longest: usize,
        /// Samples needed.
        needed: usize,
    },
    /// The command rests, and the response does not swing beyond its noise.
    #[error(
        "no mode stands out where the command rests after a move ({rests} in the log): the response then moves by {movement} \
         about its end, its noise has a standard deviation of {noise}"
    )]
    NothingSwings {
        /// Rests after a move that were looked at.
        rests: usize,
        /// Largest distance of the response from its last values while the command rests, in the unit of the response.
        movement: f64,
        /// Standard deviation of the noise, in the unit of the response.
        noise: f64,
    },
    /// What swings is gone within a swing: there is nothing to suppress.
    #[error(
        "the response swings at {angular_frequency} rad/s with a damping ratio of {damping_ratio} and is at rest after \
         one swing: a vibrating mode has at most {largest}"
    )]
    Overdamped {
        /// Undamped angular frequency, rad/s.
        angular_frequency: f64,
        /// Damping ratio.
        damping_ratio: f64,
        /// The largest damping ratio of a mode.
        largest: f64,
    },
    /// What swings is too small to be told from the resolution of the sensor and the other modes.
    #[error("a mode at {angular_frequency} rad/s swings by {amplitude} only, least to tell is {least}")]
    Faint {
        /// Undamped angular frequency, rad/s.
        angular_frequency: f64,
        /// Its amplitude, in the unit of the response.
        amplitude: f64,
        /// The least amplitude that counts.
        least: f64,
    },
    /// A mode in one part of the log and in no other, or one whose numbers are known to no better than themselves.
    #[error(
        "a mode at {angular_frequency} rad/s is found in {found} of {views} views of the log, with a standard deviation \
         of {deviation} rad/s: too vague to plan with"
    )]
    Vague {
        /// Undamped angular frequency, rad/s.
        angular_frequency: f64,
        /// Its standard deviation, rad/s.
        deviation: f64,
        /// Views in which it was found.
        found: usize,
        /// All views.
        views: usize,
    },
    /// Models without a mode explain the response as well.
    #[error(
        "the response follows the command without a mode: the best model without one leaves {without}, with one {with}"
    )]
    Rigid {
        /// Standard deviation of what the best model without a mode leaves, in the unit of the response.
        without: f64,
        /// Standard deviation of what the best model with modes leaves; infinite if there is no such model.
        with: f64,
    },
    /// A free decay that cannot be fitted.
    #[error(transparent)]
    Decay(#[from] SinusoidError),
    /// A response that is no response to the command.
    #[error(transparent)]
    Transfer(#[from] TransferFunctionError),
}
