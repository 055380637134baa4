//! What can be wrong with a train or a filter, with the number that is wrong.

use thiserror::Error;

/// An impulse train that cannot be.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum TrainError {
    /// No impulse at all.
    #[error("a train needs at least one impulse")]
    Empty,
    /// More impulses than the train has room for.
    #[error("a train of {needed} impulses does not fit into one of {capacity}")]
    Capacity {
        /// Impulses there would be.
        needed: usize,
        /// Impulses there is room for.
        capacity: usize,
    },
    /// An amplitude that is infinite or NaN.
    #[error("the amplitude of impulse {index} must be finite, got {value}")]
    Amplitude {
        /// Which impulse, from zero.
        index: usize,
        /// Its amplitude.
        value: f64,
    },
    /// A time that is not finite, negative, or before that of the impulse ahead of it, s.
    #[error("the time of impulse {index} must be finite and not before {earliest} s, got {value} s")]
    Time {
        /// Which impulse, from zero.
        index: usize,
        /// Its time, s.
        value: f64,
        /// The earliest time it may have, s.
        earliest: f64,
    },
    /// Amplitudes that add up to nothing, so that no set-point would be reached.
    #[error("the amplitudes must not add up to {0}")]
    Sum(f64),
}

/// A delay filter that cannot be.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum DelayFilterError {
    /// A delay that is not positive and finite, s.
    #[error("the delay must be positive and finite, got {0} s")]
    Delay(f64),
    /// A delay of so nearly whole periods of a mode with so little damping that the impulses would be huge.
    #[error(
        "a delay of {delay} s is {turns} periods of the mode, whose zeros would need impulses up to {largest:e}"
    )]
    WholePeriods {
        /// The delay, s.
        delay: f64,
        /// The delay in damped periods.
        turns: f64,
        /// The largest amplitude that would be needed.
        largest: f64,
    },
    /// A delay for which the middle impulse is negative.
    #[error(
        "positive impulses need a delay of 1/4 to 3/4 of a period beyond whole ones, {delay} s is {turns} periods"
    )]
    Negative {
        /// The delay, s.
        delay: f64,
        /// The delay in damped periods.
        turns: f64,
    },
}

/// A delay line that cannot be.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum DelayLineError {
    /// A period that is not positive and finite, s.
    #[error("the period must be positive and finite, got {0} s")]
    Period(f64),
    /// A period too long to see the mode: half a damped period or more.
    #[error("a mode with a damped period of {damped_period} s cannot be sampled every {period} s")]
    Undersampled {
        /// The sampling period, s.
        period: f64,
        /// The damped period of the mode, s.
        damped_period: f64,
    },
    /// A train longer than the history that is kept.
    #[error("the train reaches {needed} samples back, the line keeps {capacity}")]
    History {
        /// Samples needed.
        needed: f64,
        /// Samples kept.
        capacity: usize,
    },
    /// More taps than the line has room for: two an impulse, one where it falls on a sample.
    #[error("the line has room for {capacity} taps, the train needs more")]
    Taps {
        /// Taps there is room for.
        capacity: usize,
    },
    /// Taps that add up to nothing once the delays are split.
    #[error("the taps must not add up to {0}")]
    Sum(f64),
}
